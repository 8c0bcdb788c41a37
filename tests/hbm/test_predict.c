/* test_predict.c - what hbm_predict says an HBM solution is off by, against what it is off by: the distance to the
 * solution of 80 harmonics with exact forces and harmonic 0, which is off by (30/80)^3 = 1/19 of H = 30 itself. The
 * rule that both must keep is the one predictions are used by: three times. */

#include "compare/study/scene_solvers.h"
#include "tests/hbm/scenes.h"

enum { TRUTH = 80, MOST = 2 * HBM_MAX_HARMONICS + 1 };

/* A solution, what solves it, and the motion it should be. */
typedef struct solved {
  hbm_solver *s, *fine;
  double omega, X[MOST];
  periodic_motion motion, truth;
} solved;

static periodic_motion motion_of(hbm_solver *s, const double *X)
{
  CHECK_FILLED(hbm_measures, m, hbm_measure(s, X, &m));
  return motion_of_series(hbm_n_harmonics(s), X, m.max, m.min);
}

/* The solution of *sc at omega, and the true one next to it with `fine` harmonics. */
static solved solve(scene sc, double omega, int fine)
{
  solved r = {.omega = omega};
  double Y[MOST] = {0};
  assert_int_equal(scene_hbm_solver(&sc, &r.s), HC_OK);
  CHECK_FILLED(hbm_point, point, hbm_first_solution(r.s, omega, NULL, r.X, &point));
  r.motion = motion_of(r.s, r.X);
  memcpy(Y, r.X, (size_t)series_length(sc.hbm.harmonics) * sizeof *Y);
  sc.hbm.harmonics = fine;
  sc.hbm.force = HBM_FORCE_EXACT;
  sc.hbm.keep_mean = true;
  assert_int_equal(scene_hbm_solver(&sc, &r.fine), HC_OK);
  assert_int_equal(hbm_solve(r.fine, omega, Y, &point), HC_OK);
  r.truth = motion_of(r.fine, Y);
  return r;
}

static void clear(solved *r)
{
  hbm_solver_free(r->s);
  hbm_solver_free(r->fine);
}

static motion_error predicted(const solved *r, const double *X)
{
  CHECK_FILLED(motion_error, e, hbm_predict(r->s, r->omega, X, &e));
  return e;
}

/* Three times, both ways. Of the amplitude and harmonic 1 the prediction may be larger: they may agree by chance. */
static void expect_tracked(const solved *r, const motion_error *e, const char *what)
{
  const motion_distance d = motion_between(&r->motion, &r->truth);
  const double A = r->truth.amplitude;
  CHECK_LE(d.amplitude, 3 * e->amplitude, "%s", what);
  CHECK_LE(d.harmonic_1, 3 * e->harmonic_1, "%s", what);
  CHECK_LE(d.waveform, 3 * e->waveform, "%s", what);
  CHECK_LE(e->waveform, 3 * d.waveform + 1e-12 * A, "%s", what);
  CHECK_LE(e->amplitude, 3 * d.amplitude + 0.1 * d.waveform + 1e-12 * A, "%s", what);
  CHECK_LE(e->harmonic_1, 3 * d.harmonic_1 + 0.1 * d.waveform + 1e-12 * A, "%s", what);
}

/* c2 touches and leaves; a10 at these omegas slips and never leaves. */
static const struct {
  const char *name;
  double omega;
} places[] = {{"c2", 5.8}, {"c2", 6}, {"c2", 6.5}, {"c2", 7}, {"a10", 13.5}, {"a10", 14}, {"a10", 14.5}};
enum { N_PLACES = sizeof places / sizeof *places };

static void prediction_tracks_truncation(CHECK_STATE)
{
  static const int harmonics[] = {1, 2, 3, 5, 7, 10, 14, 20, 30};
  for (int i = 0; i < N_PLACES; ++i)
    for (size_t k = 0; k < sizeof harmonics / sizeof *harmonics; ++k) {
      char what[64];
      solved r = solve(exact_scene(places[i].name, harmonics[k], true), places[i].omega, TRUTH);
      const motion_error e = predicted(&r, r.X);
      snprintf(what, sizeof what, "%s at %g, H = %d", places[i].name, places[i].omega, harmonics[k]);
      assert_true(e.waveform > 1e-9 * r.truth.amplitude); /* there is something to predict */
      expect_tracked(&r, &e, what);
      clear(&r);
    }
}

/* Twice as many as 120 are too many: half as many tell, H = 200 is the truth, and (120/200)^3 = 1/5 of the error is its
 * own. */
static void prediction_tracks_truncation_of_many_harmonics(CHECK_STATE)
{
  for (int i = 0; i < N_PLACES; ++i) {
    char what[64];
    solved r = solve(exact_scene(places[i].name, 120, true), places[i].omega, HBM_MAX_HARMONICS);
    const motion_error e = predicted(&r, r.X);
    const motion_distance d = motion_between(&r.motion, &r.truth);
    snprintf(what, sizeof what, "%s at %g", places[i].name, places[i].omega);
    CHECK_LE(d.waveform, 3 * e.waveform, "%s", what);
    CHECK_LE(e.waveform, 5 * d.waveform, "%s", what);
    clear(&r);
    scene most = exact_scene(places[i].name, HBM_MAX_HARMONICS, true);
    r = solve(most, places[i].omega, HBM_MAX_HARMONICS);
    CHECK_LE(predicted(&r, r.X).waveform, e.waveform, "%s, H = 200", what);
    clear(&r);
  }
}

/* N = 64 and H = 20: what is off is aliasing, a hundred times the truncation and more in c2. */
static void prediction_tracks_aliasing(CHECK_STATE)
{
  for (int i = 0; i < N_PLACES; ++i) {
    char what[64];
    solved r = solve(scene_named(places[i].name, 20, true, 64), places[i].omega, TRUTH);
    const motion_error e = predicted(&r, r.X);
    snprintf(what, sizeof what, "%s at %g, N = 64", places[i].name, places[i].omega);
    expect_tracked(&r, &e, what);
    clear(&r);
  }
}

/* Without harmonic 0: c2 is 8 to 24 % off. */
static void prediction_tracks_a_mean_left_out(CHECK_STATE)
{
  for (int i = 0; i < 4; ++i) {
    scene sc = exact_scene(places[i].name, 10, true);
    sc.hbm.keep_mean = false;
    solved r = solve(sc, places[i].omega, TRUTH);
    const motion_error e = predicted(&r, r.X);
    const motion_distance d = motion_between(&r.motion, &r.truth);
    assert_true(d.amplitude > 0.05 * r.truth.amplitude);
    CHECK_LE(d.amplitude, 3 * e.amplitude, "c2 at %g", places[i].omega);
    CHECK_LE(d.waveform, 3 * e.waveform, "c2 at %g", places[i].omega);
    clear(&r);
  }
}

/* A solution spoilt on purpose: what was done to it is off, and is seen. */
static void a_mistake_is_predicted(CHECK_STATE)
{
  enum { H = 10 };
  for (int i = 0; i < N_PLACES; ++i) {
    solved r = solve(exact_scene(places[i].name, H, true), places[i].omega, TRUTH);
    const double good = predicted(&r, r.X).waveform;
    int large = 0;
    for (int lost = 0; lost <= H; ++lost)
      for (int negated = 0; negated < 2; ++negated) {
        double Y[MOST];
        memcpy(Y, r.X, sizeof Y);
        for (int k = lost ? 2 * lost - 1 : 0; k <= 2 * lost; ++k) Y[k] = negated ? -Y[k] : 0;
        const periodic_motion spoilt = motion_of(r.s, Y);
        const double off = motion_between(&spoilt, &r.truth).waveform;
        const motion_error e = predicted(&r, Y);
        CHECK_LE(off, 3 * e.waveform, "%s at %g, harmonic %d %s", places[i].name, places[i].omega, lost,
                 negated ? "negated" : "lost");
        large += e.waveform > 10 * good;
      }
    assert_true(large >= 2); /* harmonic 1, of which they all have plenty */
    clear(&r);
  }
}

/* Along omega the error of the amplitude passes through 0 where that of the waveform does not, and so does what the
 * finer equations say, elsewhere. */
static void chance_agreement_is_not_relied_on(CHECK_STATE)
{
  enum { H = 10, STEPS = 1000 };
  solved r = solve(exact_scene("c2", H, true), 5.8, TRUTH);
  double Y[MOST] = {0}, before = 0;
  hbm_point point;
  int zeros = 0;
  memcpy(Y, r.X, sizeof Y);
  for (int k = 0; k <= STEPS; ++k) {
    r.omega = 5.8 + 1.5 * k / STEPS;
    assert_int_equal(hbm_solve(r.s, r.omega, r.X, &point), HC_OK);
    assert_int_equal(hbm_solve(r.fine, r.omega, Y, &point), HC_OK);
    r.motion = motion_of(r.s, r.X);
    r.truth = motion_of(r.fine, Y);
    const motion_error e = predicted(&r, r.X);
    const motion_distance d = motion_between(&r.motion, &r.truth);
    CHECK_LE(d.amplitude, 3 * e.amplitude, "omega %g", r.omega);
    CHECK_LE(d.harmonic_1, 3 * e.harmonic_1, "omega %g", r.omega);
    CHECK_LE(d.waveform, 3 * e.waveform, "omega %g", r.omega);
    const double now = r.motion.amplitude - r.truth.amplitude;
    zeros += now * before < 0;
    before = now;
  }
  assert_true(zeros > 0);
  clear(&r);
}

/* The motion of 9.2 on the resonant branch, told to be one of 9.22 and more, beyond the fold at 9.2096: Newton goes
 * anywhere. The only solution there is a fifth as large. */
static void a_solution_that_is_not_there_is_far_off(CHECK_STATE)
{
  scene sc = exact_scene("c2", 10, true);
  solved r = solve(sc, 7.2, TRUTH);
  hbm_curve c = {0}, at = {0};
  motion_error e;
  assert_int_equal(hbm_trace(r.s, 7, 10, NULL, &c), HC_OK);
  assert_int_equal(hbm_curve_at(r.s, &c, 9.2, &at), HC_OK);
  assert_int_equal(at.n, 3);
  const double A = motion_of(r.s, at.X).amplitude;
  for (int k = 0; k < 200; ++k) {
    r.omega = 9.22 + 0.005 * k;
    if (hbm_predict(r.s, r.omega, at.X, &e) != HC_OK) continue;
    CHECK_LE(0.8 * A, 3 * e.amplitude, "omega %g", r.omega);
    CHECK_LE(0.8 * A, 3 * e.harmonic_1, "omega %g", r.omega);
    CHECK_LE(0.8 * A, 3 * e.waveform, "omega %g", r.omega);
  }
  hbm_curve_free(&at);
  hbm_curve_free(&c);
  clear(&r);
}

/* What was asked before leaves no trace. */
static void prediction_repeats_itself(CHECK_STATE)
{
  solved r = solve(exact_scene("c2", 10, true), 6.5, TRUTH);
  double Y[MOST];
  for (int k = 0; k < 21; ++k) Y[k] = -3 * r.X[k];
  const motion_error first = predicted(&r, r.X);
  motion_error again;
  hbm_predict(r.s, 7, Y, &again);
  again = predicted(&r, r.X);
  assert_true(again.amplitude == first.amplitude && again.harmonic_1 == first.harmonic_1);
  assert_true(again.waveform == first.waveform);
  clear(&r);
}

/* Where nothing touches, the closed form is off by rounding: more than nothing, and not much. */
static void prediction_of_a_linear_response_is_rounding(CHECK_STATE)
{
  for (int n_harm = 1; n_harm <= 30; n_harm += 29) {
    solved r = solve(exact_scene("c2", n_harm, true), 5, TRUTH);
    const motion_error e = predicted(&r, r.X);
    const double A = r.truth.amplitude, bound = 1e-12 * A; /* forces 4 times the forcing, resonance 20: 1e3 roundings */
    assert_true(e.amplitude > DBL_EPSILON * A && e.harmonic_1 > DBL_EPSILON * A && e.waveform > DBL_EPSILON * A);
    CHECK_LE(e.amplitude, bound, "H = %d", n_harm);
    CHECK_LE(e.harmonic_1, bound, "H = %d", n_harm);
    CHECK_LE(e.waveform, bound, "H = %d", n_harm);
    clear(&r);
  }
}

static void what_is_no_number_predicts_none(CHECK_STATE)
{
  static const double bad[] = {NAN, INFINITY, -INFINITY, 1e308};
  for (int force = 0; force < 2; ++force) {
    scene sc = exact_scene("c2", 10, true);
    sc.hbm.force = force ? HBM_FORCE_SAMPLED : HBM_FORCE_EXACT;
    solved r = solve(sc, 6, TRUTH);
    for (size_t b = 0; b < sizeof bad / sizeof *bad; ++b)
      for (int k = 0; k < 21; ++k) {
        double Y[MOST];
        motion_error e = {0};
        memcpy(Y, r.X, sizeof Y);
        Y[k] = bad[b];
        if (hbm_predict(r.s, 6, Y, &e) == HC_OK)
          CHECK_LE(1e100, fmin(e.amplitude, e.waveform), "X[%d] = %g", k, bad[b]);
        else assert_true(isnan(e.amplitude) && isnan(e.harmonic_1) && isnan(e.waveform));
      }
    motion_error e = {0};
    assert_int_not_equal(hbm_predict(r.s, NAN, r.X, &e), HC_OK);
    assert_true(isnan(e.amplitude) && isnan(e.harmonic_1) && isnan(e.waveform));
    assert_int_equal(hbm_predict(r.s, 6, r.X, &e), HC_OK); /* and is none the worse for it */
    expect_tracked(&r, &e, "after numbers that were none");
    clear(&r);
  }
}

/* hbm.harmonics: auto changes the number under way. */
static void prediction_follows_the_number_of_harmonics(CHECK_STATE)
{
  scene sc = exact_scene("c2", HBM_AUTO, true);
  sc.hbm.accuracy = 1e-4;
  hbm_curve c = {0}, at = {0};
  double X[MOST];
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, 6, NULL, X, &point));
  CHECK_FILLED(motion_error, few, hbm_predict(s, 6, X, &few));
  assert_int_equal(hbm_trace(s, 5.5, 6.5, NULL, &c), HC_OK);
  assert_true(hbm_n_harmonics(s) > point.harmonics);
  assert_int_equal(hbm_curve_at(s, &c, 6, &at), HC_OK);
  assert_int_equal(at.n, 1);
  CHECK_FILLED(motion_error, many, hbm_predict(s, 6, at.X, &many));
  CHECK_LE(many.waveform, 0.1 * few.waveform, "H = %d, then %d", point.harmonics, hbm_n_harmonics(s));
  hbm_curve_free(&at);
  hbm_curve_free(&c);
  hbm_solver_free(s);
}

CHECK_TESTS("hbm.predict", 60, prediction_tracks_truncation, prediction_tracks_truncation_of_many_harmonics,
            prediction_tracks_aliasing, prediction_tracks_a_mean_left_out, a_mistake_is_predicted,
            chance_agreement_is_not_relied_on, a_solution_that_is_not_there_is_far_off, prediction_repeats_itself,
            prediction_of_a_linear_response_is_rounding, what_is_no_number_predicts_none,
            prediction_follows_the_number_of_harmonics)
