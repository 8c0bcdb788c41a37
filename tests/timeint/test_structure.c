/* test_structure.c - time integration of structures: against an independent program, against the closed form of one
 * degree of freedom, and its two integrators of the exact law against each other. */

#include "tests/hbm/structure_cases.h"
#include "tests/scene_parts.h"
#include "tests/timeint/drawn.h"
#include "tests/timeint/scenes.h"

/* ---- an independent program -------------------------------------------------------------------------- */

/* Steady states from rest of a program of its own: matrix exponentials between events that are bisected to rounding, in
 * NumPy; good to 1e-11 of the largest response or better. Rows whose sliders all move. */
static const struct {
  const char *name;
  double omega;
  int response;
  double amplitude, harmonic_1, mean;
} reference[] = {
    /* clang-format off */
    {"tangent_normal_F50", 3.6, 0, 14.1579031360266, 14.1782068436638, -0.208309753694245},
    {"tangent_normal_F50", 3.6, 1, 0.167116481133304, 0.167116481133306, 2.38095238095238},
    {"tangent_normal_F50", 4, 0, 15.6097394925558, 15.6161996748961, -0.0567294132400068},
    {"tangent_normal_F50", 4, 1, 0.183803655523452, 0.183803655523453, 2.38095238095238},
    {"tangent_normal_F100", 3.6, 0, 44.4356933545562, 44.2998083134138, -0.285654600652777},
    {"tangent_normal_F100", 3.6, 1, 0.334232962266608, 0.334232962266608, 2.38095238095239},
    {"jenkins2", 25.9068, 0, 0.150348871884704, 0.15037127692166, 9.8514193063024e-17},
    {"jenkins2", 25.9068, 1, 0.0405521891989902, 0.0329292265056202, -3.73902966868978e-18},
    {"wedge_F2", 32, 0, 0.010957546762243, 0.0109674844364442, 0.00402775110293924},
    {"wedge_F2", 32, 1, 0.00622254989709726, 0.00595562053281267, 0.00195630333164701},
    {"wedge_F2", 32, 2, 0.00132743955633313, 0.00114445691390123, 0.0144439003160062},
    {"wedge_F2", 35, 0, 0.0154498887333161, 0.015472858153297, 0.00387865689237188},
    {"wedge_F2", 35, 1, 0.011321592842826, 0.0106072119875933, 0.00290456883223291},
    {"wedge_F2", 35, 2, 0.00376705698378799, 0.0031873665323406, 0.0142177070540303},
    {"wedge_F10", 33, 0, 0.0896197026231505, 0.0896859351250362, 0.00387957424948941},
    {"wedge_F10", 33, 1, 0.0574528770627704, 0.0504448157212626, 0.0026601577112341},
    {"wedge_F10", 33, 2, 0.0332049812908881, 0.0328650362177119, 0.0142190987914964},
    {"wedge_F10", 34, 0, 0.0586432158349455, 0.0586148707983118, 0.00379908780396793},
    {"wedge_F10", 34, 1, 0.0361957745042306, 0.0331660646119632, 0.00272288846534648},
    {"wedge_F10", 34, 2, 0.0217465542281751, 0.0209489090209505, 0.0140969914904276},
    {"wedge_F20", 34, 0, 0.11456221499136, 0.114538702745644, 0.00379121018368099},
    {"wedge_F20", 34, 1, 0.0733584129299158, 0.0688409208691281, 0.00329100291368231},
    {"wedge_F20", 34, 2, 0.0414249397811129, 0.0418372343321775, 0.0140605738267528},
    {"wedge_F20", 36, 0, 0.0651822850379419, 0.0650893170128941, 0.0038315422801798},
    {"wedge_F20", 36, 1, 0.0406020654696326, 0.0394368899507791, 0.00325113798734266},
    {"wedge_F20", 36, 2, 0.0224447163399405, 0.0232622308317077, 0.0141462287063607},
    {"chain3", 0.8, 0, 0.0529414883538888, 0.0512747388048564, 1.82191928478107e-15},
    {"chain3", 0.8, 1, 0.101484248208186, 0.100845073916077, 2.07345004895763e-15},
    {"chain3", 0.8, 2, 0.0738152653722873, 0.0741397600606952, 1.03859725854424e-15},
    {"chain3", 1.2585, 0, 0.249044036309041, 0.237952036245923, -0.0134258836088605},
    {"chain3", 1.2585, 1, 0.303653232135342, 0.291725567624466, -0.0329259398451604},
    {"chain3", 1.2585, 2, 0.50326391634254, 0.50147263877405, -0.0388252503208297},
    {"chain3", 1.2684, 0, 0.247832534886173, 0.237070913583328, -0.0141929017743368},
    {"chain3", 1.2684, 1, 0.302699630435079, 0.291100935415141, -0.034774607076041},
    {"chain3", 1.2684, 2, 0.518753533226735, 0.51686740116487, -0.0413954297766208},
    {"chain3", 1.9, 0, 0.180492902053465, 0.162287912778369, 2.66747761756485e-16},
    {"chain3", 1.9, 1, 0.23265780701998, 0.236593185773618, 1.79091442539502e-16},
    {"chain3", 1.9, 2, 0.146765057048231, 0.146894778165766, 9.40684782339931e-17},
    /* clang-format on */
};
enum { N_REFERENCE = sizeof reference / sizeof *reference };

/* Every row of one case by that way; tolerance relative to the largest response there. */
static void check_reference(const char *name, transient_settings how, double tolerance)
{
  const structure_case c = structure_case_named(name, 3);
  timeint *ti;
  double *state = calloc((size_t)(2 * c.model->n + c.model->n_contacts), sizeof *state), omega = 0, largest = 0;
  static timeint_result r;
  assert_int_equal(timeint_new(c.model, &how, &ti), HC_OK);
  for (int i = 0; i < N_REFERENCE; ++i) {
    if (strcmp(reference[i].name, name) != 0) continue;
    if (reference[i].omega != omega) {
      omega = reference[i].omega;
      timeint_rest(ti, state);
      assert_int_equal(timeint_steady(ti, omega, state, NULL, &r), HC_OK);
      assert_int_equal(r.period_multiple, 1);
      largest = 0;
      for (int k = i; k < N_REFERENCE && reference[k].omega == omega; ++k)
        largest = fmax(largest, reference[k].amplitude);
    }
    assert_int_equal(timeint_response(ti, reference[i].response, &r), HC_OK);
    const int what = reference[i].response;
    CHECK_NEAR(r.amplitude, reference[i].amplitude, tolerance * largest, "%s at %g, %d", name, omega, what);
    CHECK_NEAR(r.harmonic_1, reference[i].harmonic_1, tolerance * largest, "%s at %g, %d", name, omega, what);
    CHECK_NEAR(r.mean, reference[i].mean, tolerance * largest, "%s at %g, %d: mean", name, omega, what);
  }
  timeint_free(ti);
  model_free(c.model);
  free(state);
}

static const char *const named[] = {"jenkins2", "chain3",    "tangent_normal_F50", "tangent_normal_F100",
                                    "wedge_F2", "wedge_F10", "wedge_F20"};
static const transient_settings from_rest = CLOSED_FORM(1e-10, 20000);

static void check_cases(transient_settings how, double tolerance)
{
  for (size_t k = 0; k < sizeof named / sizeof *named; ++k) check_reference(named[k], how, tolerance);
}

static void periods_meet_the_reference(CHECK_STATE) { meet_the_reference(check_cases); }

/* ---- one degree of freedom ----------------------------------------------------------------------------- */

/* Case 2 of the paper and others by series and in closed form: other code from transition to transition. Each is exact
 * but for rounding, of some thousand steps. */
static void series_and_closed_form_agree(CHECK_STATE)
{
  const scene scenes[] = {scene_c2(), scene_b10(), scene_a10()};
  const double omegas[] = {5, 8, 9, 11, 16};
  long transitions[2] = {0, 0};
  for (size_t k = 0; k < sizeof scenes / sizeof *scenes; ++k)
    for (size_t w = 0; w < sizeof omegas / sizeof *omegas; ++w) {
      model *m[2];
      modal_base *base[2];
      integrator *in[2];
      scaled_contact contacts[2][SCENE_MAX_CONTACTS];
      scaled_model scaled[2];
      double y[2][SCENE_MAX_STATES] = {{0.1, -0.2}, {0.1, -0.2}};
      transient_settings how = scenes[k].transient;
      how.law = TRANSIENT_LAW_EXACT;
      assert_int_equal(scene_model(&scenes[k], &m[0]), HC_OK);
      /* The same model with a second load, of no force: then its motion goes by series. */
      model *two;
      assert_int_equal(model_new(1, 2, m[0]->n_contacts, 1, &two), HC_OK);
      *two->mass = *m[0]->mass, *two->damping = *m[0]->damping, *two->stiffness = *m[0]->stiffness, *two->responses = 1;
      two->loads[0].harmonic = 1, *two->loads[0].cosine = model_force(m[0]);
      two->loads[1].harmonic = 2;
      for (int j = 0; j < m[0]->n_contacts; ++j) {
        two->contacts[j].law = m[0]->contacts[j].law;
        *two->contacts[j].tangent = *m[0]->contacts[j].tangent, *two->contacts[j].normal = *m[0]->contacts[j].normal;
      }
      m[1] = two;
      for (int i = 0; i < 2; ++i) {
        assert_int_equal(modal_base_new(m[i], &base[i]), HC_OK);
        scaled[i] = (scaled_model){.base = base[i], .contact = contacts[i]};
        scaled_make(&scaled[i], m[i], &how, omegas[w], 10);
        assert_int_equal(integrate_new_closed_form(base[i], INFINITY, &in[i]), HC_OK);
      }
      const int n = scaled[0].n_states;
      for (int period = 0; period < 3; ++period) { /* rounding grows by the multipliers, to 1e3 in three periods */
        double phi[2][SCENE_MAX_STATES * SCENE_MAX_STATES];
        for (int i = 0; i < 2; ++i) assert_int_equal(integrate_monodromy(in[i], &scaled[i], y[i], phi[i]), HC_OK);
        for (int i = 0; i < n; ++i)
          CHECK_NEAR(y[1][i], y[0][i], 1e-11, "scene %zu at %g, period %d, state %d", k, omegas[w], period, i);
        for (int i = 0; i < n * n; ++i)
          CHECK_NEAR(phi[1][i], phi[0][i], 1e-9 * fmax(1, fabs(phi[0][i])), "scene %zu at %g, [%d, %d]", k, omegas[w],
                     i % n, i / n);
      }
      for (int i = 0; i < 2; ++i) {
        transitions[i] += integrate_transitions(in[i]);
        integrate_free(in[i]);
        modal_base_free(base[i]);
        model_free(m[i]);
      }
    }
  CHECK_LE(50, (double)transitions[0], "transitions");
  assert_int_equal(transitions[0], transitions[1]);
}

/* ---- random structures ---------------------------------------------------------------------------------- */

static void draw_of_size(uint64_t *seed, transient_law law, int n, int contacts, drawn *d)
{
  d->m = random_structure(seed, n, contacts);
  scale_drawn(d, law, 3 + 10 * random_unit(seed));
}

static void draw(uint64_t *seed, transient_law law, drawn *d)
{
  const int n = random_int(seed, 1, 6);
  draw_of_size(seed, law, n, random_int(seed, 1, 5), d);
}

static void series_and_events_agree(CHECK_STATE)
{
  int changing;
  check_series_and_events(draw, 60, 1e-8, &changing);
  assert_true(changing > 45);
}

/* Column q of phi, at y, against differences of the period map: of e and 2 e, extrapolated, where the order of
 * transitions stays; where it does not the map has but one derivative less, and the test would compare nothing: those
 * are few. How many of its entries are off. */
static int differences_off(const drawn *d, integrator *in, const double *y, const double *phi, int q)
{
  double end[2][2][MOST];
  const int moving = 2 * d->scaled.n;
  int off = 0;
  for (int k = 0; k < 2; ++k)
    for (int side = 0; side < 2; ++side) {
      double *z = end[k][side];
      memcpy(z, y, sizeof end[k][side]);
      z[q] += (side ? 1 : -1) * ldexp(1e-5, k);
      /* Where state q of y moves by that much, sliders that are tied to the motion go with it. */
      if (q < moving) {
        const double by = z[q] - y[q];
        const int n = d->scaled.n;
        for (int j = 0; j < d->scaled.n_contacts; ++j) {
          const double *t = d->scaled.base->tangent + j * n, *normal = d->scaled.base->normal + j * n;
          const contact_motion at = scaled_motion_at(&d->scaled, j, y);
          contact_track begun;
          contact_track_begin(&begun, &d->scaled.contact[j], &at, &y[2 * n + j]);
          if (begun.since_start || q >= n) continue;
          z[2 * n + j] += contact_track_vary_slider(&begun, &d->scaled.contact[j], by * t[q], by * normal[q]);
        }
      }
      assert_int_equal(integrate_period(in, &d->scaled, z, NULL, NULL), HC_OK);
    }
  for (int i = 0; i < moving; ++i) {
    const double one = (end[0][1][i] - end[0][0][i]) / 2e-5, two = (end[1][1][i] - end[1][0][i]) / 4e-5;
    const double smooth = (4 * one - two) / 3;
    off += !(fabs(phi[i + q * d->scaled.n_states] - smooth) <= 1e-6);
  }
  return off;
}

/* Periods of d from rest, and the monodromy matrix of the one that follows: every step-th column of the motion, and
 * those of sliders that stick. */
static void check_monodromy(const drawn *d, int step, int *compared, int *off)
{
  integrator *in;
  static double y[MOST], z[MOST], phi[MOST * MOST];
  const int n = d->scaled.n_states, moving = 2 * d->scaled.n;
  memset(y, 0, sizeof y);
  assert_true(n <= MOST);
  assert_int_equal(integrate_new_closed_form(d->base, INTERVAL_MODES_STIFF, &in), HC_OK);
  for (int period = 0; period < 3; ++period) assert_int_equal(integrate_period(in, &d->scaled, y, NULL, NULL), HC_OK);
  memcpy(z, y, sizeof y);
  assert_int_equal(integrate_monodromy(in, &d->scaled, z, phi), HC_OK);
  for (int q = 0; q < n; q += q < moving ? step : 1) {
    if (q >= moving) {
      const contact_motion at = scaled_motion_at(&d->scaled, q - moving, y);
      contact_track begun;
      contact_track_begin(&begun, &d->scaled.contact[q - moving], &at, &y[q]);
      if (!begun.since_start) continue; /* tied to the motion */
    }
    *compared += moving;
    *off += differences_off(d, in, y, phi, q);
  }
  integrate_free(in);
}

static void monodromy_is_the_derivative(CHECK_STATE)
{
  uint64_t seed = 7;
  int compared = 0, off = 0;
  for (int trial = 0; trial < 40; ++trial) {
    drawn d;
    draw(&seed, TRANSIENT_LAW_EXACT, &d);
    check_monodromy(&d, 1, &compared, &off);
    undraw(&d);
  }
  CHECK_LE(off, 0.02 * compared, "of %d derivatives", compared);
}

/* More columns than series_columns.c takes at once. */
static void monodromy_of_many_columns(CHECK_STATE)
{
  uint64_t seed = 12;
  int compared = 0, off = 0;
  for (int trial = 0; trial < 4; ++trial) {
    drawn d;
    draw_of_size(&seed, TRANSIENT_LAW_EXACT, 40, 8, &d);
    check_monodromy(&d, 7, &compared, &off);
    undraw(&d);
  }
  CHECK_LE(off, 0.02 * compared, "of %d derivatives", compared);
}

static void newton_solves_the_equations(CHECK_STATE) { check_newton(draw); }

/* x = Q y changes no response: rounding, and what the settling leaves of 1e-12. */
static void other_coordinates_change_nothing(CHECK_STATE)
{
  uint64_t seed = 5;
  transient_settings how = from_rest;
  how.tolerance = 1e-12;
  for (int trial = 0, settled = 0; trial < 12 || settled < 6; ++trial) {
    const int n = random_int(&seed, 2, 5);
    double Q[25] = {0}, y[2][MOST] = {{0}};
    static timeint_result r[2];
    hc_status st[2];
    model *m[2] = {random_structure(&seed, n, random_int(&seed, 1, 4)), NULL};
    for (int i = 0; i < n * n; ++i) Q[i] = random_signed(&seed) + (i % (n + 1) == 0 ? 2 : 0);
    m[1] = turned_structure(m[0], Q);
    for (int k = 0; k < 2; ++k) {
      timeint *ti;
      assert_int_equal(timeint_new(m[k], &how, &ti), HC_OK);
      st[k] = timeint_steady(ti, 7, y[k], NULL, &r[k]);
      if (st[k] == HC_OK) assert_int_equal(timeint_response(ti, 1, &r[k]), HC_OK);
      timeint_free(ti);
      model_free(m[k]);
    }
    assert_int_equal(st[0], st[1]);
    if (st[0] != HC_OK) continue;
    ++settled;
    CHECK_NEAR(r[0].amplitude, r[1].amplitude, 1e-10 * r[0].amplitude, "trial %d", trial);
    CHECK_NEAR(r[0].mean, r[1].mean, 1e-10 * (r[0].amplitude + fabs(r[0].mean)), "trial %d: mean", trial);
    for (int i = 0; i < TIMEINT_WAVE; ++i)
      CHECK_NEAR(r[0].wave[i], r[1].wave[i], 1e-10 * (r[0].amplitude + fabs(r[0].mean)), "trial %d [%d]", trial, i);
  }
}

/* A mass matrix that is not positive definite: said, not integrated. */
static void a_massless_freedom_is_refused(CHECK_STATE)
{
  uint64_t seed = 2;
  model *m = random_structure(&seed, 3, 1);
  timeint *ti;
  for (int i = 0; i < 3; ++i) m->mass[3 + i] = m->mass[3 * i + 1] = 0;
  assert_int_equal(timeint_new(m, &from_rest, &ti), HC_SINGULAR);
  assert_null(ti);
  model_free(m);
}

CHECK_TESTS("timeint.structure", 120, periods_meet_the_reference, series_and_closed_form_agree, series_and_events_agree,
            monodromy_is_the_derivative, monodromy_of_many_columns, newton_solves_the_equations,
            other_coordinates_change_nothing, a_massless_freedom_is_refused)
