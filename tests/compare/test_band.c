/* test_band.c - bands of steady states over where free sliders rest. References: one-mass oscillators with the normal
 * force that a rest gives (the seat's cases in cases/bands), an event-driven integrator and an arc-length code in the
 * rest that share nothing with hbmcheck (the wedge), and marching from drawn sliders. */
#include "numerics/random.h"
#include "tests/case_scene.h"
#include "tests/oscillator.h"
#include "tests/scene_runs.h"

/* Amplitude at omega of a mass on a slider of constant normal force N: the seat's mass where its slider rests at w,
 * N = 1 + w/3. */
static double of_mass(double omega, double N)
{
  const transient_settings how = {.law = TRANSIENT_LAW_EXACT,
                                  .method = TRANSIENT_METHOD_CLOSED_FORM,
                                  .regularisation = 1e-4,
                                  .tolerance = 1e-12,
                                  .max_periods = 20000};
  scene sc = scene_oscillator(1, 0.05, 1, 0.5);
  scene_add_contact(&sc, (scene_contact){.law = {.kt = 1, .mu = 0.5}, .preload = N});
  model *m;
  timeint_result r;
  double state[8];
  assert_int_equal(scene_model(&sc, &m), HC_OK);
  CHECK_MADE(timeint, ti, timeint_new(m, &how, &ti));
  timeint_rest(ti, state);
  assert_int_equal(timeint_steady(ti, omega, state, NULL, &r), HC_OK);
  timeint_free(ti);
  model_free(m);
  return r.amplitude;
}

/* The largest such amplitude for N between a and b, by golden section to 1e-9 of its place. */
static double largest_of_mass(double omega, double a, double b)
{
  const double golden = 0.6180339887498949;
  double x = b - golden * (b - a), y = a + golden * (b - a), fx = of_mass(omega, x), fy = of_mass(omega, y);
  while (b - a > 1e-8)
    if (fx > fy) b = y, y = x, fy = fx, x = b - golden * (b - a), fx = of_mass(omega, x);
    else a = x, x = y, fx = fy, y = a + golden * (b - a), fy = of_mass(omega, y);
  return fmax(fx, fy);
}

static void compare_case(const char *name, int n_set, const char *const *set, comparison *c)
{
  scene sc = case_scene(name, n_set, set);
  assert_int_equal(scene_comparison_run(&sc, NULL, c), HC_OK);
  case_clear(&sc);
}

static void check_band(const char *name, const char *where, band_kind kind, double low, double high)
{
  const char *const set[] = {where};
  comparison c;
  compare_case(name, 1, set, &c);
  const comparison_row *r = &c.rows[0];
  assert_int_equal(c.n_rows, 1);
  assert_int_equal(r->band.kind, kind);
  CHECK_NEAR(r->band.low / low, 1, 1e-9, "%s, %s: least amplitude", name, where);
  CHECK_NEAR(r->band.high / high, 1, 1e-9, "%s, %s: largest amplitude", name, where);
  assert_int_equal(r->verdict, VERDICT_FAMILY);
  assert_int_equal(comparison_exit_code(&c), 0);
  comparison_clear(&c);
}

static void the_seats_ends_are_those_of_one_mass(CHECK_STATE)
{
  check_band("bands/seat", "compare.omega=1.15", BAND_EXACT, of_mass(1.15, 1.2), of_mass(1.15, 0.8));
  check_band("bands/two_holds", "compare.omega=1.15", BAND_AT_LEAST, of_mass(1.15, 1.2), of_mass(1.15, 0.8));
}

/* At 1.2 the amplitude is largest between the ends. */
static void an_extremum_between_the_ends_is_found(CHECK_STATE)
{
  check_band("bands/seat", "compare.omega=1.2", BAND_EXACT, of_mass(1.2, 0.8), largest_of_mass(1.2, 0.8, 1.2));
}

/* Values to eleven digits, by the reference of the head comment. At 217 the least lies next to where the other slider
 * ceases to slip, and the ends alone miss two thirds of the width. */
static void the_wedges_bands_are_the_references(CHECK_STATE)
{
  static const struct {
    const char *where;
    double low, high;
  } at[] = {{"compare.frequency=217", 3.9073982557e-5, 4.4588057328e-5},
            {"compare.frequency=219", 4.1384718598e-5, 5.5310374429e-5},
            {"compare.frequency=215", 3.0211448365e-5, 3.9217153243e-5}};
  for (size_t i = 0; i < sizeof at / sizeof *at; ++i)
    check_band("bands/wedge", at[i].where, BAND_EXACT, at[i].low, at[i].high);
}

/* The next frequency's solution begins its sliders where it would without the band before. */
static void a_band_leaves_no_trace(CHECK_STATE)
{
  const char *const off[] = {"compare.frequency=[217, 219]", "compare.band=off"};
  comparison with, without;
  compare_case("bands/wedge", 1, off, &with);
  compare_case("bands/wedge", 2, off, &without);
  assert_int_equal(with.n_rows, 2);
  for (int i = 0; i < 2; ++i)
    CHECK_NEAR(with.rows[i].hbm.amplitude / without.rows[i].hbm.amplitude, 1, 1e-10, "row %d", i);
  comparison_clear(&with);
  comparison_clear(&without);
}

/* The family is the same whichever of its members the solution is: sliders that begin elsewhere, inside or beyond a
 * limit. */
static void every_member_has_the_same_band(CHECK_STATE)
{
  static const char *const wedge[] = {"transient.rest={b: 0}", "transient.rest={b: 9e-5}", "transient.rest={b: 1e-3}"},
                           *const holds[] = {"transient.rest={hold: 0}", "transient.rest={hold: 0.2, help: -0.1}",
                                             "transient.rest={hold: -2, help: 0.1}"};
  for (int c = 0; c < 2; ++c) {
    double low = NAN, high = NAN;
    for (int i = 0; i < 3; ++i) {
      const char *const set[] = {c ? holds[i] : wedge[i], c ? "compare.omega=1.15" : "compare.frequency=219"};
      comparison of;
      compare_case(c ? "bands/two_holds" : "bands/wedge", 2, set, &of);
      const band *b = &of.rows[0].band;
      assert_true(b->confirmed);
      if (i == 0) low = b->low, high = b->high;
      CHECK_NEAR(b->low / low, 1, 1e-9, "%s: least amplitude", set[0]);
      CHECK_NEAR(b->high / high, 1, 1e-9, "%s: largest amplitude", set[0]);
      comparison_clear(&of);
    }
  }
}

/* By the argument of band.h: no system is solved for it. */
static void constant_normal_forces_need_no_search(CHECK_STATE)
{
  scene sc = case_scene("bands/constant", 0, NULL);
  model *m;
  hbm_point point;
  band bands[2];
  assert_int_equal(scene_model(&sc, &m), HC_OK);
  CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &sc.hbm, &s));
  double *X = calloc((size_t)hbm_n_coefficients(s), sizeof *X);
  assert_int_equal(hbm_first_solution(s, 1.15, NULL, X, &point), HC_OK);
  CHECK_MADE(band_search, b, band_search_new(m, s, NULL, &b));
  assert_int_equal(band_find(b, 1.15, X, NULL, bands), HC_OK);
  for (int r = 0; r < 2; ++r) {
    assert_int_equal(bands[r].kind, BAND_EXACT);
    assert_true(band_width(&bands[r]) == 0);
  }
  assert_int_equal(band_solves(b), 0);
  band_search_free(b);
  hbm_solver_free(s);
  model_free(m);
  free(X);
  case_clear(&sc);
}

/* A transient that begins with the rest of an end, but a millionth of it farther in, stays there. */
static void transients_stay_on_the_ends(CHECK_STATE)
{
  static const struct {
    double w, amplitude;
  } ends[] = {{0.6, 0}, {-0.6, 0}};
  for (size_t i = 0; i < 2; ++i) {
    char set[64];
    snprintf(set, sizeof set, "transient.rest={hold: %.17g}", ends[i].w * (1 - 1e-6));
    const char *const sets[] = {set, "compare.band=off"};
    comparison c;
    compare_case("bands/seat", 2, sets, &c);
    CHECK_NEAR(c.rows[0].transient.amplitude / of_mass(1.15, 1 + ends[i].w / 3), 1, 1e-6, "w = %g", ends[i].w);
    assert_int_equal(c.rows[0].transient.free_sliders, 1);
    assert_int_equal(c.rows[0].band.kind, BAND_NOT_ASKED);
    comparison_clear(&c);
  }
}

static void the_gate_may_limit_the_width(CHECK_STATE)
{
  static const struct {
    double most;
    int failures;
  } gates[] = {{0.1, 1}, {0.2, 0}, {0, 0}};
  for (size_t i = 0; i < sizeof gates / sizeof *gates; ++i) {
    scene sc = case_scene("bands/seat", 0, NULL);
    comparison c;
    gate_case g;
    sc.gate.band = gates[i].most; /* the band's half width is 0.1257 */
    assert_int_equal(scene_comparison_run(&sc, NULL, &c), HC_OK);
    assert_int_equal(scene_gate_judge("seat", &sc, &c, &g), HC_OK);
    assert_int_equal(g.failures, gates[i].failures);
    assert_int_equal(g.errors, 0);
    gate_clear(&g);
    comparison_clear(&c);
    case_clear(&sc);
  }
}

/* ---- drawn structures ---------------------------------------------------------------------------------- */

enum { MASSES = 3, SLIDERS = 2 };

static double random_between(uint64_t *at, double low, double high) { return low + (high - low) * random_unit(at); }

/* A chain of masses that slide on each other's seats: each contact's normal force is that of another mass. */
static model *draw_structure(uint64_t *at)
{
  model *m;
  assert_int_equal(model_new(MASSES, 1, SLIDERS, 1, &m), HC_OK);
  for (int i = 0; i < MASSES; ++i) {
    m->mass[i * (MASSES + 1)] = random_between(at, 0.5, 2);
    m->damping[i * (MASSES + 1)] = random_between(at, 0.05, 0.2);
    m->stiffness[i * (MASSES + 1)] = random_between(at, 1, 2);
    for (int k = 0; k < i; ++k)
      m->stiffness[i + MASSES * k] = m->stiffness[k + MASSES * i] = random_between(at, -0.2, 0.1);
  }
  m->loads[0].harmonic = 1;
  m->loads[0].cosine[0] = random_between(at, 0.3, 1);
  for (int j = 0; j < SLIDERS; ++j) {
    model_contact *c = &m->contacts[j];
    c->law = (contact){.kt = random_between(at, 0.5, 2),
                       .kn = random_between(at, 0.5, 2),
                       .mu = random_between(at, 0.3, 0.8),
                       .gap = random_between(at, 0.5, 2)};
    c->tangent[j] = 1;
    c->normal[(j + 1) % MASSES] = 1;
  }
  m->responses[0] = 1;
  return m;
}

/* Marches from the solution's state with drawn sliders; how many settled on a motion of one period. */
static int march_from_drawn(const model *m, hbm_solver *s, double omega, const double *X, const band *of, int starts,
                            uint64_t *at)
{
  const transient_settings how = {.law = TRANSIENT_LAW_EXACT,
                                  .method = TRANSIENT_METHOD_CLOSED_FORM,
                                  .start = TRANSIENT_START_REST,
                                  .regularisation = 1e-4,
                                  .tolerance = 1e-9,
                                  .max_periods = 2000};
  double state[2 * MASSES + SLIDERS];
  int settled = 0;
  CHECK_MADE(timeint, ti, timeint_new(m, &how, &ti));
  for (int i = 0; i < starts; ++i) {
    timeint_result r;
    assert_int_equal(comparison_orbit_start(s, X, omega, state), HC_OK);
    for (int j = 0; j < SLIDERS; ++j) { /* within the limit at that instant, N being kn (v + gap) */
      const contact *law = &m->contacts[j].law;
      const double room = law->mu * contact_normal(law, state[(j + 1) % MASSES]) / law->kt;
      state[2 * MASSES + j] = state[j] + random_between(at, -1, 1) * room;
    }
    if (timeint_steady(ti, omega, state, NULL, &r) != HC_OK || r.period_multiple != 1) continue;
    ++settled;
    CHECK_LE(of->low * (1 - 1e-7), r.amplitude, "start %d: %.9g is below %.9g .. %.9g", i, r.amplitude, of->low,
             of->high);
    CHECK_LE(r.amplitude, of->high * (1 + 1e-7), "start %d: %.9g is above %.9g .. %.9g", i, r.amplitude, of->low,
             of->high);
  }
  timeint_free(ti);
  return settled;
}

/* No steady state that drawn sliders come to lies outside a band that is said to be exact. */
static void drawn_sliders_come_to_rest_inside(CHECK_STATE)
{
  const int structures = check_long ? 10 : 3, starts = check_long ? 100 : 30;
  const hbm_settings how = {.harmonics = 15, .keep_mean = true, .tolerance = 1e-12, .iterations = 20};
  uint64_t at = 6001;
  int exact = 0, settled = 0;
  for (int tried = 0; exact < structures && tried < 100 * structures; ++tried) {
    model *m = draw_structure(&at);
    const double omega = random_between(&at, 0.7, 1.8);
    compare_setup setup = {.model = m,
                           .transient = {.law = TRANSIENT_LAW_EXACT,
                                         .method = TRANSIENT_METHOD_CLOSED_FORM,
                                         .regularisation = 1e-4,
                                         .tolerance = 1e-11,
                                         .max_periods = 2000}};
    hbm_point point;
    band of;
    timeint *referee;
    CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &how, &s));
    double *X = calloc((size_t)hbm_n_coefficients(s), sizeof *X);
    assert_int_equal(comparison_referee(&setup, NULL, &referee), HC_OK);
    CHECK_MADE(band_search, b, band_search_new(m, s, referee, &b));
    if (hbm_first_solution(s, omega, NULL, X, &point) == HC_OK && band_find(b, omega, X, NULL, &of) == HC_OK &&
        of.kind == BAND_EXACT && of.confirmed && band_width(&of) > 1e-3) {
      ++exact;
      settled += march_from_drawn(m, s, omega, X, &of, starts, &at);
    }
    band_search_free(b);
    timeint_free(referee);
    hbm_solver_free(s);
    model_free(m);
    free(X);
  }
  print_message("%d bands, %d motions settled inside\n", exact, settled);
  assert_int_equal(exact, structures);
  assert_true(settled >= structures * starts / 2);
}

CHECK_TESTS_AND_LONG("band", 300,
                     (the_seats_ends_are_those_of_one_mass, an_extremum_between_the_ends_is_found,
                      the_wedges_bands_are_the_references, constant_normal_forces_need_no_search,
                      a_band_leaves_no_trace, every_member_has_the_same_band, transients_stay_on_the_ends,
                      the_gate_may_limit_the_width, drawn_sliders_come_to_rest_inside),
                     (drawn_sliders_come_to_rest_inside))
