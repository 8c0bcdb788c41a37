/* test_first_solution.c - a solution without a guess, where Newton does not find one from the linear response.
 *
 * The scenes are from `stress` with seed 1, their numbers cut to six digits. Each was refused as long as a ramp was
 * climbed by steps of a fixed force, or of fixed contacts, which cannot pass a turning point. */

#include "hbm/solver/hbm_solver_impl.h"
#include "tests/case_scene.h"
#include "tests/hbm/scene_forces.h"
#include "tests/hbm/traced.h"

typedef struct refused_scene {
  int number; /* in `stress` */
  double mass, damping, stiffness, force, omega;
  int harmonics;
  bool keep_mean;
  int first, n_contacts; /* of contacts[] */
} refused_scene;

static const scene_contact contacts[] =
    {/* {kt, kn, mu, gap}, angle */
     {{5.91968e6, 12.4587, 0.905489, 6.64868}, 44.9307}, {{46657.9, 90.9853, 1.53903, -3.59653}, 42.05},
     {{7.54754, 1.65891e7, 2.01654, -5.3765}, 63.1828},  {{4.2352e6, 737120, 2.6039, -2.74013}, 7.00167},
     {{2.78082e7, 2652.15, 1.22005, -8.35954}, 60.3603}, {{1.89802e6, 1.80238e7, 2.77875, 0}, 53.1828},
     {{3.29166e7, 3.56064e7, 2.87262, 0}, 1.80321},      {{265256, 2.15168e7, 1.6514, -6.75849}, 39.6938},
     {{375.021, 3419.4, 2.71303, 9.4987}, 29.0737},      {{203.504, 1249.3, 2.28725, 9.29152}, 71.3591},
     {{4.42956e6, 71065.5, 1.9591, 9.69597}, 58.6052},   {{278136, 79.3898, 0.176502, 0.968238}, 48.0783},
     {{5640.3, 797.307, 0.0610838, -6.38971}, 7.08275},  {{2.5396e6, 1.47714e6, 2.47364, -5.05752}, 13.2475},
     {{26.0257, 30.6151, 2.87443, 9.92598}, 32.769},     {{5.32598, 3.91331e6, 1.28057, 0}, 65.4507},
     {{15398.5, 1053.05, 0.759191, -1.26563}, 7.83370},  {{2.13774e6, 203.559, 2.6761, 4.44309}, 81.3103}};

/* Four contacts of very different stiffness; no damping, and no gap, so that no force is so small that nothing happens
 * at the contacts; one contact; without harmonic 0; a force far above all preloads. */
static const refused_scene refused[] = {{715, 32.5011, 4.08431, 36.2477, 42951.3, 3.36358, 2, true, 0, 4},
                                        {1015, 1.8113, 0, 178.109, 2.48831e-5, 18.9741, 2, true, 4, 2},
                                        {4191, 0.547904, 0.00251013, 126.902, 0.115976, 25.9515, 10, true, 6, 1},
                                        {4235, 28.1606, 10.9018, 4.71827, 14265.5, 2.99595, 10, false, 7, 1},
                                        {7487, 0.483621, 0.0649952, 79.4067, 952810, 238.314, 12, true, 8, 4}};

enum { SCENES = sizeof refused / sizeof *refused, MOST_COEF = 201 };

/* The ramp of the damping turns more than 140 times and does not arrive within 4000 steps. */
static const refused_scene winding = {8473, 0.0945991, 1.00573, 88.3824, 67480.8, 67.4139, 24, false, 12, 3};

/* Newton finds a solution with 6 harmonics from the linear response, and from that one with 27, but not with 48. */
static const refused_scene by_halves = {7019, 44.1028, 0.365633, 1.32293, 0.000594733, 2.27873, 48, true, 15, 3};

static scene scene_of(const refused_scene *r)
{
  scene sc = scene_named("b10", r->harmonics, r->keep_mean, 64);
  sc.hbm.force = HBM_FORCE_EXACT;
  sc.structure = scene_oscillator(r->mass, r->damping, r->stiffness, r->force).structure;
  for (int j = 0; j < r->n_contacts; ++j) scene_add_contact(&sc, contacts[r->first + j]);
  return sc;
}

/* Without a guess: what is tested are the ramps (tests/compare/test_first_guess.c has the guess). */
static hc_status unguided_solver(const scene *sc, hbm_solver **out)
{
  CHECK_MADE(model, m, scene_model(sc, &m));
  const hc_status st = hbm_solver_new(m, &sc->hbm, out);
  model_free(m);
  return st;
}

static hbm_solver *solver_of(const refused_scene *r)
{
  const scene sc = scene_of(r);
  CHECK_MADE(hbm_solver, s, unguided_solver(&sc, &s));
  return s;
}

/* |R| against the forces it is made of, both added here, from the scene and an evaluator of its own. 10 times
 * hbm.tolerance is what a solver may leave. */
static void check_solution(const refused_scene *r, const double *X, const char *what)
{
  const scene sc = scene_of(r);
  double F[MOST_COEF], size = r->force, worst = 0;
  CHECK_MADE(contact_forces, e, scene_forces(&sc, HBM_FORCE_EXACT, r->harmonics, 0, &e));
  assert_int_equal(forces_eval(e, r->harmonics, X, F, NULL, NULL), HC_OK);
  contact_forces_free(e);
  if (r->keep_mean) worst = fabs(r->stiffness * X[0] + F[0]);
  else assert_true(X[0] == 0);
  size += fabs(r->stiffness * X[0]) + fabs(F[0]);
  for (int h = 1; h <= r->harmonics; ++h) {
    const double w = h * r->omega, k = r->stiffness - r->mass * w * w, c = r->damping * w;
    const double a = X[2 * h - 1], b = X[2 * h], f = h == 1 ? r->force : 0;
    worst = larger(worst, larger(fabs(k * a + c * b + F[2 * h - 1] - f), fabs(k * b - c * a + F[2 * h])));
    size += (r->stiffness + r->mass * w * w + c) * hypot(a, b) + hypot(F[2 * h - 1], F[2 * h]);
  }
  CHECK_LE(worst, 1e-9 * size, "%s, scene %d", what, r->number);
}

/* The solver is as if no ramp had been followed. */
static void check_left(const hbm_solver *s, const scene *sc)
{
  assert_null(s->ramp);
  assert_true(s->sys.more_damping == 0 && s->sys.force_factor == 1);
  assert_int_equal(s->how.harmonics, sc->hbm.harmonics);
  assert_int_equal(s->how.continuation, sc->hbm.continuation);
  assert_int_equal(s->how.skip_linear, sc->hbm.skip_linear);
  assert_true(s->step_scale == 1 && !s->finer_harmonics == (sc->hbm.harmonics != HBM_AUTO));
}

static void scenes_once_refused_are_solved(CHECK_STATE)
{
  for (int i = 0; i < SCENES; ++i) {
    const scene sc = scene_of(&refused[i]);
    double X[MOST_COEF];
    hbm_point point;
    hbm_solver *s = solver_of(&refused[i]);
    hc_status st = hbm_first_solution(s, refused[i].omega, NULL, X, &point);
    if (st != HC_OK) fail_msg("scene %d: %s", refused[i].number, hc_status_text(st));
    check_left(s, &sc);
    check_solution(&refused[i], X, "hbm_first_solution");
    CHECK_NEAR(point.omega, refused[i].omega, 0, "scene %d", refused[i].number);
    hbm_solver_free(s);
  }
}

/* From 200 unknowns on Newton's iterations ask the monitor, too; they are no steps of a ramp. */
static void a_ramp_of_many_unknowns_has_as_many_steps(CHECK_STATE)
{
  refused_scene many = refused[0];
  double X[MOST_COEF];
  many.harmonics = (MOST_COEF - 1) / 2;
  hbm_solver *s = solver_of(&many);
  assert_true(hbm_has_many_unknowns(s));
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, many.omega, NULL, X, &point));
  check_solution(&many, X, "many unknowns");
  hbm_solver_free(s);
}

static bool has_no_gap(const refused_scene *r)
{
  for (int j = 0; j < r->n_contacts; ++j)
    if (contacts[r->first + j].law.gap == 0) return true;
  return false;
}

/* Each ramp by itself; that of the force only where a small force leaves the contacts alone. */
static void either_ramp_ends_on_a_solution(CHECK_STATE)
{
  for (int i = 0; i < SCENES; ++i)
    for (int kind = HBM_RAMP_DAMPING; kind <= HBM_RAMP_FORCE; ++kind) {
      if (kind == HBM_RAMP_FORCE && has_no_gap(&refused[i])) continue;
      hbm_solver *s = solver_of(&refused[i]);
      const hbm_ramp ramp = hbm_ramp_of((hbm_ramp_kind)kind, &s->sys, refused[i].omega);
      hbm_curve curve = {0};
      s->ramp = &ramp;
      hc_status st = hbm_trace(s, ramp.from, 1, NULL, &curve);
      if (st != HC_OK || curve.left_at_start) fail_msg("scene %d, ramp %d: %d", refused[i].number, kind, (int)st);
      check_solution(&refused[i], hbm_curve_X(&curve, curve.n - 1), kind == HBM_RAMP_FORCE ? "force" : "damping");
      hbm_curve_free(&curve);
      hbm_solver_free(s);
    }
}

/* dR/dp by central differences of h. R is linear in phi; D is an exponential of rate * p: the next term
 * is (rate h)^2/6 of the derivative. Rounding: 8 units of the forces over h. */
static void derivative_along_a_ramp(CHECK_STATE)
{
  const double h = 1e-4, places[2] = {1.4, 0.3};
  const refused_scene *r = &refused[0];
  const double X[5] = {-0.1, 2, -3, 0.6, 0.8};
  hbm_solver *s = solver_of(r);
  for (int kind = HBM_RAMP_DAMPING; kind <= HBM_RAMP_FORCE; ++kind) {
    const hbm_ramp ramp = hbm_ramp_of((hbm_ramp_kind)kind, &s->sys, r->omega);
    double before[5], after[5], dR[5], largest = 0;
    hbm_ramp_set(&ramp, places[kind] - h, &s->sys);
    assert_int_equal(hbm_system_residual(&s->sys, r->omega, X, before), HC_OK);
    hbm_ramp_set(&ramp, places[kind] + h, &s->sys);
    assert_int_equal(hbm_system_residual(&s->sys, r->omega, X, after), HC_OK);
    double all, moved;
    hbm_system_sizes(&s->sys, r->omega, &all, &moved);
    const double rounding = 8 * DBL_EPSILON * all / h;
    hbm_ramp_derivative(&ramp, places[kind], &s->sys, X, dR);
    hbm_ramp_leave(&s->sys);
    for (int i = 0; i < 5; ++i) {
      const double next = kind == HBM_RAMP_DAMPING ? ramp.rate * ramp.rate * h * h / 6 * fabs(dR[i]) : 0;
      CHECK_NEAR((after[i] - before[i]) / (2 * h), dR[i], 1.01 * next + rounding, "ramp %d, row %d", kind, i);
      largest = fmax(largest, fabs(dR[i]));
    }
    assert_true(largest > 1e3 * rounding); /* else the test says nothing */
  }
  hbm_solver_free(s);
}

/* At its end a ramp's equations are the model's, to the bit. */
static void a_ramp_ends_at_the_model(CHECK_STATE)
{
  hbm_solver *s = solver_of(&refused[0]);
  for (int kind = HBM_RAMP_DAMPING; kind <= HBM_RAMP_FORCE; ++kind) {
    const hbm_ramp ramp = hbm_ramp_of((hbm_ramp_kind)kind, &s->sys, refused[0].omega);
    hbm_ramp_set(&ramp, 1, &s->sys);
    assert_true(s->sys.more_damping == 0 && s->sys.force_factor == 1);
    hbm_ramp_set(&ramp, ramp.from, &s->sys);
    assert_true(s->sys.more_damping != 0 || s->sys.force_factor != 1);
    hbm_ramp_leave(&s->sys);
  }
  hbm_solver_free(s);
}

static bool tick_any(void *self, double done)
{
  tick_counter *c = self;
  c->outside |= done >= 0; /* how much of the work a ramp is, is not known */
  return ++c->ticks < c->stop;
}

/* A quick ramp that winds is given up after 1000 steps, here that of few harmonics, and another is tried. Whether that
 * one arrives, rounding decides, in three of five of neighbouring frequencies. */
static void another_ramp_where_one_takes_too_long(CHECK_STATE)
{
  refused_scene r = winding;
  double X[MOST_COEF];
  tick_counter watch = {0};
  bool arrived = false;
  for (int k = 0; k < 10 && !arrived; ++k, r.omega *= 1 + 1e-5) {
    hbm_point point;
    watch = (tick_counter){.stop = 5000};
    hbm_solver *s = solver_of(&r);
    const hc_status st = hbm_first_solution(s, r.omega, &(hc_monitor){tick_any, &watch}, X, &point);
    assert_true(watch.ticks > 1000);
    assert_true(st == HC_OK || st == HC_NOT_CONVERGED);
    if (st == HC_OK) {
      assert_true(point.iterations > watch.ticks - 1000); /* one a step at least */
      check_solution(&r, X, "winding");
      arrived = watch.ticks <= 2000;
    }
    hbm_solver_free(s);
  }
  assert_true(arrived);
}

/* At one of neighbouring frequencies at least, as rounding decides. */
static void the_last_ramp_arrives(CHECK_STATE)
{
  double X[MOST_COEF];
  scene sc = case_scene("../tests/hbm/last_ramp", 0, NULL);
  hc_status st = HC_NOT_CONVERGED;
  CHECK_MADE(hbm_solver, s, unguided_solver(&sc, &s));
  for (int k = 1; k <= 24 && st != HC_OK; ++k)
    st = hbm_first_solution(s, sc.omega_from * (1 + 1e-3 * k), NULL, X, &(hbm_point){0});
  assert_int_equal(st, HC_OK);
  hbm_solver_free(s);
  case_clear(&sc);
}

/* No ramp where the linear response leads to a solution, with 6 harmonics, or to one with fewer, by halves. */
static void more_harmonics_by_halves(CHECK_STATE)
{
  refused_scene r = by_halves;
  for (int few = 0; few < 2; ++few, r.harmonics = 6) {
    double X[MOST_COEF];
    tick_counter watch = {.stop = 1}; /* each step of a ramp ticks */
    hbm_solver *s = solver_of(&r);
    CHECK_FILLED(hbm_point, point, hbm_first_solution(s, r.omega, &(hc_monitor){tick_any, &watch}, X, &point));
    assert_int_equal(watch.ticks, 0);
    check_solution(&r, X, "by halves");
    hbm_solver_free(s);
  }
}

/* How a response curve is to be followed is not how a ramp is. */
static void settings_for_curves_do_not_reach_ramps(CHECK_STATE)
{
  const refused_scene *r = &refused[0];
  double X[2][MOST_COEF];
  int iterations[2];
  for (int other = 0; other < 2; ++other) {
    scene sc = scene_of(r);
    if (other) {
      sc.hbm.skip_linear = true;
      sc.hbm.continuation = HBM_CONTINUATION_NATURAL;
    }
    CHECK_MADE(hbm_solver, s, unguided_solver(&sc, &s));
    if (other) hbm_scale_steps(s, 0.1);
    CHECK_FILLED(hbm_point, point, hbm_first_solution(s, r->omega, NULL, X[other], &point));
    iterations[other] = point.iterations;
    assert_true(s->step_scale == (other ? 0.1 : 1) && s->how.skip_linear == (other == 1));
    assert_int_equal(s->how.continuation, sc.hbm.continuation);
    hbm_solver_free(s);
  }
  assert_int_equal(iterations[0], iterations[1]);
  assert_memory_equal(X[0], X[1], (size_t)(2 * r->harmonics + 1) * sizeof **X);
}

/* Stopped at any step, the solver is whole: it then finds what a fresh one finds, to the bit. Sampled equations are
 * stopped in the ramp of exact ones. */
static void a_ramp_can_be_stopped(CHECK_STATE)
{
  const refused_scene *r = &refused[0];
  for (int sampled = 0; sampled < 2; ++sampled) {
    scene sc = scene_of(r);
    double X[MOST_COEF], Y[MOST_COEF];
    if (sampled) sc.hbm.force = HBM_FORCE_SAMPLED, sc.hbm.samples = 256;
    CHECK_MADE(hbm_solver, fresh, unguided_solver(&sc, &fresh));
    CHECK_MADE(hbm_solver, s, unguided_solver(&sc, &s));
    CHECK_FILLED(hbm_point, point, hbm_first_solution(fresh, r->omega, NULL, Y, &point));
    for (int stop = 1; stop <= 32; stop *= 2) {
      tick_counter watch = {.stop = stop};
      const hc_monitor monitor = {tick_any, &watch};
      assert_int_equal(hbm_first_solution(s, r->omega, &monitor, X, &point), HC_INTERRUPTED);
      assert_int_equal(watch.ticks, stop);
      assert_false(watch.outside);
      check_left(s, &sc);
      assert_int_equal(hbm_first_solution(s, r->omega, NULL, X, &point), HC_OK);
      assert_memory_equal(X, Y, (size_t)(2 * r->harmonics + 1) * sizeof *X);
    }
    hbm_solver_free(s);
    hbm_solver_free(fresh);
  }
}

/* The solver adapts while a curve is traced; its first point may come from a ramp, which does not. */
static void adapting_solvers_follow_ramps_too(CHECK_STATE)
{
  static const int which[] = {0, 2, 3};
  for (int i = 0; i < 3; ++i) {
    const refused_scene *r = &refused[which[i]];
    scene sc = scene_of(r);
    sc.hbm.harmonics = HBM_AUTO;
    sc.hbm.accuracy = 0.5;
    traced t = trace(&sc, r->omega, r->omega, "auto");
    assert_int_equal(t.status, HC_OK);
    assert_int_equal(t.curve.n, 1);
    check_left(t.s, &sc);
    free_traced(&t);
  }
}

CHECK_TESTS("hbm.first_solution", 300, scenes_once_refused_are_solved, a_ramp_of_many_unknowns_has_as_many_steps,
            either_ramp_ends_on_a_solution, derivative_along_a_ramp, another_ramp_where_one_takes_too_long,
            the_last_ramp_arrives, more_harmonics_by_halves, settings_for_curves_do_not_reach_ramps,
            a_ramp_ends_at_the_model, a_ramp_can_be_stopped, adapting_solvers_follow_ramps_too)
