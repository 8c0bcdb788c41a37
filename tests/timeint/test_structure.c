/* test_structure.c - time integration of structures: against an independent program, against the closed form of one
 * degree of freedom, and its two integrators of the exact law against each other. */

#include "tests/scene_parts.h"
#include "tests/timeint/drawn.h"
#include "tests/timeint/scenes.h"
#include "tests/timeint/structure_rows.h"

/* ---- an independent program -------------------------------------------------------------------------- */

static const transient_settings from_rest = CLOSED_FORM(1e-10, 20000);

/* By a program of its own: matrix exponentials between events that are bisected to rounding, in NumPy. */
static void periods_meet_the_reference(CHECK_STATE)
{
  static const struct {
    const char *name;
    int rows;
  } cases[] = {{"jenkins2", 2}, {"chain3", 12},   {"tangent_normal_F50", 4}, {"tangent_normal_F100", 2},
               {"wedge_F2", 6}, {"wedge_F10", 6}, {"wedge_F20", 6}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    const structure_case c = structure_case_named(cases[k].name, 3);
    check_structure_rows_all_ways(c.model, cases[k].name, cases[k].rows);
    model_free(c.model);
  }
}

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
      CHECK_MADE(model, two, model_new(1, 2, m[0]->n_contacts, 1, &two));
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
  static double y[MOST], z[MOST], phi[MOST * MOST];
  const int n = d->scaled.n_states, moving = 2 * d->scaled.n;
  memset(y, 0, sizeof y);
  assert_true(n <= MOST);
  CHECK_MADE(integrator, in, integrate_new_closed_form(d->base, INTERVAL_MODES_STIFF, &in));
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
      CHECK_MADE(timeint, ti, timeint_new(m[k], &how, &ti));
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

CHECK_TESTS_WITH("timeint.structure", 120, read_structure_rows, NULL, periods_meet_the_reference,
                 series_and_closed_form_agree, series_and_events_agree, monodromy_is_the_derivative,
                 monodromy_of_many_columns, newton_solves_the_equations, other_coordinates_change_nothing,
                 a_massless_freedom_is_refused)
