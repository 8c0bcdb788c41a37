/* test_trace.c - how a trace goes and how it may end: turning points that are real, folds, limits, interruptions,
 * nonsense. */
#include "tests/hbm/scene_forces.h"
#include "tests/hbm/traced.h"

/* Sign of det dR/dX of the fixed form at X, omega, by elimination with pivots; Z as in system.h, dF from the
 * contacts. */
static int sign_of_determinant(const scene *sc, contact_forces *a, const double *X, double omega)
{
  enum { MAX = 21 };
  static double F[MAX], J[MAX * MAX];
  int H = sc->hbm.harmonics, n = 2 * H + 1, sign = 1;
  assert_true(n <= MAX);
  assert_int_equal(forces_eval(a, H, X, F, J, NULL), HC_OK);
  J[0] += *sc->structure->stiffness.v;
  for (int h = 1; h <= H; ++h) {
    int i = 2 * h - 1;
    J[i + n * i] += *sc->structure->stiffness.v - *sc->structure->mass.v * h * h * omega * omega;
    J[i + 1 + n * (i + 1)] += *sc->structure->stiffness.v - *sc->structure->mass.v * h * h * omega * omega;
    J[i + n * (i + 1)] += *sc->structure->damping.v * h * omega;
    J[i + 1 + n * i] -= *sc->structure->damping.v * h * omega;
  }
  for (int k = sc->hbm.keep_mean ? 0 : 1; k < n; ++k) {
    int top = k;
    for (int i = k + 1; i < n; ++i) top = fabs(J[i + n * k]) > fabs(J[top + n * k]) ? i : top;
    if (top != k) sign = -sign;
    for (int j = k; j < n; ++j) {
      double swap = J[k + n * j];
      J[k + n * j] = J[top + n * j];
      J[top + n * j] = swap;
    }
    if (J[k + n * k] < 0) sign = -sign;
    for (int i = k + 1; i < n; ++i)
      for (int j = n - 1; j >= k; --j) J[i + n * j] -= J[i + n * k] / J[k + n * k] * J[k + n * j];
  }
  return sign;
}

/* Along a curve that is followed one way, omega rises where det dR/dX has one sign and falls where it has the other
 * (the tangent is the kernel of [dR/dX dR/domega], whose bordered determinant keeps its sign, through folds and
 * through kinks). A point that breaks this was reached against the curve's direction: a false turning point, or a
 * curve retraced. */
static void turning_points_are_real(CHECK_STATE)
{
  static const struct {
    const char *name;
    int H, keep_mean, N;
  } runs[] = {{"a10", 1, 0, 4096},  {"a10", 1, 1, 4096}, {"a10", 5, 1, 4096},     {"b10", 1, 1, 4096},
              {"b10", 5, 0, 128},   {"c2", 1, 0, 1024},  {"c2", 5, 1, 4096},      {"c2", 10, 1, 512},
              {"gap1", 1, 1, 4096}, {"gap1", 5, 0, 256}, {"c2kn1e4", 1, 1, 4096}, {"r2", 5, 1, 4096},
              {"r1", 1, 0, 4096}};
  int wrong = 0;
  for (size_t i = 0; i < sizeof runs / sizeof *runs; ++i)
    for (int down = 0; down <= 1; ++down) {
      scene sc = scene_named(runs[i].name, runs[i].H, runs[i].keep_mean, runs[i].N);
      traced t = trace(&sc, down ? sc.omega_to : sc.omega_from, down ? sc.omega_from : sc.omega_to, runs[i].name);
      const hbm_curve *c = &t.curve;
      CHECK_MADE(contact_forces, a, scene_forces(&sc, HBM_FORCE_SAMPLED, runs[i].H, runs[i].N, &a));
      int first = 0, bad = 0;
      for (int k = 0; k < c->n; ++k) {
        int sign = sign_of_determinant(&sc, a, c->X + (size_t)k * c->n_coef, c->points[k].omega) *
                   (c->points[k].d_omega > 0 ? 1 : -1);
        if (!k) first = sign;
        else if (sign != first) ++bad;
      }
      if (bad)
        print_error("%s H=%d static=%d N=%d %s: %d of %d points against the curve's direction, %d turning points\n",
                    runs[i].name, runs[i].H, runs[i].keep_mean, runs[i].N, down ? "down" : "up", bad, c->n,
                    c->turning_points);
      wrong += bad;
      contact_forces_free(a);
      free_traced(&t);
    }
  assert_int_equal(wrong, 0);
}

/* Case B with 10 N: a natural trace must stop at the fold that arc-length passes, say why, and keep what it has.
 * Case A gets through. The fold is met from below: solutions end like sqrt(fold - omega), and steps shrink until the
 * next would pass it: within 1e-3. */
static void natural_continuation_stops_at_the_fold(CHECK_STATE)
{
  static const int orders[] = {1, 5};
  for (int o = 0; o < 2; ++o)
    for (int keep_mean = 0; keep_mean <= 1; ++keep_mean) {
      scene sc = scene_named("b10", orders[o], keep_mean, 1024);
      traced whole = trace(&sc, 3, 20, "b10");
      double fold = 0;
      for (int k = 0; k < whole.curve.n && whole.curve.points[k].omega > 0.99 * fold; ++k)
        fold = fmax(fold, whole.curve.points[k].omega);
      assert_true(whole.curve.arclength && whole.status == HC_OK && whole.curve.turning_points >= 2);
      sc.hbm.continuation = HBM_CONTINUATION_NATURAL;
      traced t = trace(&sc, 3, 20, "b10, natural");
      const hbm_curve *c = &t.curve;
      double last = c->points[c->n - 1].omega;
      print_message("b10 H=%d static=%d: fold at %.6f, natural stops at %.6f: %s\n", orders[o], keep_mean, fold, last,
                    hc_status_text(t.status));
      assert_int_not_equal(t.status, HC_OK);
      assert_int_not_equal(t.status, HC_INTERRUPTED); /* that would be a loop */
      assert_false(c->arclength);
      CHECK_NEAR(last, fold, 2e-3 * fold, "H=%d static=%d", orders[o], keep_mean);
      free_traced(&t);
      free_traced(&whole);
      sc = scene_named("a10", orders[o], false, 1024);
      sc.hbm.continuation = HBM_CONTINUATION_NATURAL;
      t = trace(&sc, 3, 20, "a10, natural");
      assert_int_equal(t.status, HC_OK);
      assert_true(t.curve.points[t.curve.n - 1].omega == 20 && !t.curve.arclength && t.curve.turning_points == 0);
      free_traced(&t);
    }
}

/* Case 2 from 8.5 down on the separated branch. It ends grazing at 7.337 (closed form 7.3371828168 for any H: the
 * motion is still linear there), turns up past the start to the fold at 9.21, then down to the end of the sweep. */
static void a_branch_that_turns_back(CHECK_STATE)
{
  scene sc = scene_named("c2", 5, true, 4096);
  traced t = trace(&sc, 8.5, 3, "c2 down from 8.5");
  const hbm_curve *c = &t.curve;
  double lowest = 8.5;
  for (int k = 0; k < c->n && c->points[k].branch == 0; ++k) lowest = fmin(lowest, c->points[k].omega);
  assert_int_equal(t.status, HC_OK);
  assert_true(!c->left_at_start && c->turning_points % 2 == 0 && c->points[c->n - 1].omega == 3);
  CHECK_NEAR(lowest, 7.3371828168, 1e-3 * 7.34, "points, not the turn itself: steps there are short, 1e-3 is ample");
  hbm_curve at = {0};
  assert_int_equal(hbm_curve_at(t.s, c, 8, &at), HC_OK);
  assert_int_equal(at.n, 3);
  check_linear_point(&sc, 40, at.X, 8, "the branch it came on");
  hbm_curve_free(&at);
  free_traced(&t);
}

/* Nearly rigid and without harmonic 0 the fold is beyond 4 times the start: the curve is cut where it left the
 * sweep. */
static void a_branch_that_leaves(CHECK_STATE)
{
  scene sc = scene_named("c2", 1, false, 64);
  sc.structure->contacts[0].given.law.kn = 1e7;
  sc.hbm.force = HBM_FORCE_EXACT;
  traced t = trace(&sc, 8.5, 3, "nearly rigid, down from 8.5");
  const hbm_curve *c = &t.curve;
  assert_int_equal(t.status, HC_OK);
  assert_true(c->left_at_start && c->turning_points == 1 && c->points[c->n - 1].omega == 8.5);
  for (int k = 0; k < c->n; ++k) CHECK_LE(c->points[k].omega, 8.5, "point %d", k);
  free_traced(&t);
}

static void interruption_keeps_points(CHECK_STATE)
{
  scene sc = scene_named("c2", 5, true, 256);
  traced whole = trace(&sc, 3, 20, "c2");
  for (int stop = 1; stop <= 40; stop += 13) {
    tick_counter watch = {.stop = stop};
    hc_monitor monitor = {tick, &watch};
    hbm_curve c = {0};
    assert_int_equal(hbm_trace(whole.s, 3, 20, &monitor, &c), HC_INTERRUPTED);
    assert_int_equal(c.end, HC_INTERRUPTED);
    assert_int_equal(watch.ticks, stop);
    assert_false(watch.outside);
    assert_in_range(c.n, 1, stop);
    check_curve(&c, 3, 20, "interrupted");
    for (int i = 0; i < c.n * c.n_coef; ++i) assert_true(c.X[i] == whole.curve.X[i]); /* the same points, bit by bit */
    hbm_curve_free(&c);
  }
  free_traced(&whole);
}

/* Hard scenes with few samples: the trace ends, its status is one of the method's, and no point lies outside
 * (check_curve). */
static void always_an_end_with_a_reason(CHECK_STATE)
{
  uint64_t seed = 12;
  int ends[64] = {0}, back = 0;
  for (int trial = 0; trial < 60; ++trial) {
    static const char *const names[] = {"a10", "b10", "c2", "gap1"};
    static const int orders[] = {1, 3, 5};
    int n_harm = orders[trial % 3], n_time = 16 + trial % 5 * 9;
    scene sc = scene_named(names[trial % 4], n_harm, trial / 4 % 2, n_time);
    sc.hbm.restart = trial / 8 % 2;
    sc.hbm.continuation = trial % 5 == 4   ? HBM_CONTINUATION_NATURAL
                          : trial % 5 == 3 ? HBM_CONTINUATION_ARCLENGTH
                                           : HBM_CONTINUATION_AUTO;
    if (trial % 6 == 5) {
      for (int j = 1; j < 3; ++j) scene_add_contact(&sc, sc.structure->contacts[0].given);
      sc.structure->contacts[1].given.angle_deg = 20;
      sc.structure->contacts[2].given.law.gap *= -0.5;
    }
    double low = 0.05 + 2 * fabs(random_signed(&seed)), high = low + 25 * fabs(random_signed(&seed));
    tick_counter watch = {.stop = 4000}; /* a curve with a false turn at every sample may be longer: stopped here */
    hc_monitor monitor = {tick, &watch};
    hbm_curve c = {0};
    CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
    double from = trial % 2 ? high : low, to = trial % 2 ? low : high;
    hc_status st = hbm_trace(s, from, to, &monitor, &c);
    assert_int_equal(st, c.end);
    check_curve(&c, from, to, "rough");
    if (st == HC_INTERRUPTED && c.n < 1000)
      fail_msg("trial %d: %d steps for %d points, the last at %.17g: a loop", trial, watch.ticks, c.n,
               c.points[c.n - 1].omega);
    ++ends[st];
    back += c.left_at_start;
    hbm_curve_free(&c);
    hbm_solver_free(s);
  }
  for (int st = 0; st < 64; ++st)
    if (ends[st]) print_message("%d of 60: %s\n", ends[st], hc_status_text((hc_status)st));
  print_message("%d of 60 turned back past the start\n", back);
  assert_int_equal(ends[HC_BUG] + ends[HC_BAD_INPUT] + ends[HC_NO_MEMORY], 0);
}

static void sweeps_that_make_no_sense(CHECK_STATE)
{
  scene sc = scene_named("b10", 1, true, 64);
  traced t = trace(&sc, 6, 6, "a point"); /* one frequency is allowed */
  assert_true(t.status == HC_OK && t.curve.n == 1 && t.curve.points[0].omega == 6);
  assert_int_equal(hbm_trace(t.s, 3, 20, NULL, &t.curve), HC_BAD_INPUT); /* not empty */
  assert_int_equal(t.curve.n, 1);
  static const double bad[] = {0, -1, NAN, INFINITY};
  for (int i = 0; i < 4; ++i)
    for (int end = 0; end < 2; ++end) {
      hbm_curve c = {0};
      tick_counter watch = {.stop = 1000};
      hc_monitor monitor = {tick, &watch};
      hc_status st = hbm_trace(t.s, end ? 3 : bad[i], end ? bad[i] : 3, &monitor, &c);
      hbm_curve_free(&c);
      if (st != HC_BAD_INPUT) fail_msg("a sweep with an end at %g: %s", bad[i], hc_status_text(st));
    }
  free_traced(&t);
  hbm_solver *s = t.s;
  sc.hbm.samples = 2;
  assert_int_equal(scene_hbm_solver(&sc, &s), HC_BAD_INPUT);
  assert_null(s);
  hbm_solver_free(NULL);
}

static void solving_from_nonsense(CHECK_STATE)
{
  enum { H = 3, N_COEF = 2 * H + 1 };
  scene sc = scene_named("c2", H, true, 64);
  hbm_point point;
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
  static const double bad[] = {NAN, INFINITY, -INFINITY};
  for (int i = 0; i < 3; ++i) {
    double X[N_COEF] = {0.1, 0.2}, before[N_COEF];
    X[3] = bad[i];
    memcpy(before, X, sizeof X);
    assert_int_equal(hbm_solve(s, 6, X, &point), HC_NOT_FINITE);
    assert_memory_equal(X, before, sizeof X);
    X[3] = 0;
    memcpy(before, X, sizeof X);
    assert_int_not_equal(hbm_solve(s, bad[i], X, &point), HC_OK);
    assert_memory_equal(X, before, sizeof X);
  }
  double X[N_COEF] = {0}; /* no guess */
  assert_int_equal(hbm_solve(s, 4, X, &point), HC_OK);
  check_linear_point(&sc, 40, X, 4, "apart"); /* 4.16 < 5 sqrt 2 */
  hbm_solver_free(s);
}

CHECK_TESTS("hbm.trace", 200, turning_points_are_real, natural_continuation_stops_at_the_fold, a_branch_that_turns_back,
            a_branch_that_leaves, interruption_keeps_points, always_an_end_with_a_reason, sweeps_that_make_no_sense,
            solving_from_nonsense)
