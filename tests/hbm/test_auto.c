/* test_auto.c - hbm.harmonics: auto and hbm.samples: auto keep hbm.accuracy, what they cost, and every switch that
 * saves work changes nothing else. */
#include "compare/study/scene_solvers.h"
#include "tests/hbm/scenes.h"

typedef struct solved_curve {
  hbm_solver *s;
  hbm_curve c;
} solved_curve;

static scene accurate_scene(const char *name, int n_harm)
{
  scene sc = exact_scene(name, n_harm, true);
  sc.hbm.skip_linear = true;
  sc.hbm.accuracy = 1e-4;
  return sc;
}

static solved_curve traced(const scene *sc)
{
  solved_curve r = {0};
  assert_int_equal(scene_hbm_solver(sc, &r.s), HC_OK);
  hc_status st = hbm_trace(r.s, sc->omega_from, sc->omega_to, NULL, &r.c);
  if (st != HC_OK)
    fail_msg("K=%g kn=%g gap=%g H=%d N=%d accuracy=%g: %s after %d points, at omega %.12g with H=%d N=%d",
             *sc->structure->stiffness.v, sc->structure->contacts[0].given.law.kn,
             sc->structure->contacts[0].given.law.gap, sc->hbm.harmonics, sc->hbm.samples, sc->hbm.accuracy,
             hc_status_text(st), r.c.n, r.c.n ? r.c.points[r.c.n - 1].omega : 0, hbm_n_harmonics(r.s),
             hbm_n_samples(r.s));
  return r;
}

static void free_curve(solved_curve *r)
{
  hbm_curve_free(&r->c);
  hbm_solver_free(r->s);
}

/* Largest distance, relative to the solution, of a's solutions at omega from the nearest of b's; infinite where they
 * are not equally many. */
static double distance_at(const solved_curve *a, const solved_curve *b, double omega)
{
  hbm_curve at = {0}, bt = {0};
  double worst = 0;
  assert_int_equal(hbm_curve_at(a->s, &a->c, omega, &at), HC_OK);
  assert_int_equal(hbm_curve_at(b->s, &b->c, omega, &bt), HC_OK);
  if (at.n != bt.n || at.n == 0) worst = INFINITY;
  int most = at.n_coef > bt.n_coef ? at.n_coef : bt.n_coef;
  for (int i = 0; i < at.n && isfinite(worst); ++i) {
    double best = INFINITY;
    for (int j = 0; j < bt.n; ++j) {
      double sum = 0, size = 0;
      for (int k = 0; k < most; ++k) {
        double x = k < at.n_coef ? hbm_curve_X(&at, i)[k] : 0, y = k < bt.n_coef ? hbm_curve_X(&bt, j)[k] : 0;
        sum += (x - y) * (x - y);
        size += y * y;
      }
      best = fmin(best, sqrt(sum / size));
    }
    worst = fmax(worst, best);
  }
  hbm_curve_free(&at);
  hbm_curve_free(&bt);
  return worst;
}

enum { FREQUENCIES = 12 };

/* Spread over the sweep, clear of its ends; but r2, a narrow resonance, only touches between 707.013 and its fold at
 * 708.747: there, and a little to either side. */
static void frequencies(const scene *sc, double omega[FREQUENCIES])
{
  bool narrow = *sc->structure->stiffness.v == 8e5;
  double from = narrow ? 706.5 : sc->omega_from, to = narrow ? 709 : sc->omega_to;
  for (int i = 0; i < FREQUENCIES; ++i) omega[i] = from + (to - from) * (i + 0.37) / FREQUENCIES;
}

static double worst_distance(const solved_curve *a, const solved_curve *b, const double *omega, int n)
{
  double worst = 0;
  for (int i = 0; i < n; ++i) worst = fmax(worst, distance_at(a, b, omega[i]));
  return worst;
}

static const char *const names[] = {"c2", "b10", "gap1", "r2"};

/* The estimate is one Newton step of twice the harmonics: the error but for the error of 2H, a sixteenth of it once
 * H^-4 has set in and at worst as large as it; and solutions between points use the most harmonics of the curve, so
 * can only be better. Hence 2 times the accuracy, and 3 near folds where the second order of the step shows. H = 60
 * itself is wrong by (10/60)^4 of H = 10: c2 1e-8. */
static void auto_harmonics_keep_the_accuracy(CHECK_STATE)
{
  static const int ladder[] = {1, 2, 3, 5, 7, 10, 14, 20, 28, 40, 56};
  static const double accuracies[] = {1e-2, 1e-3, 1e-4};
  for (size_t q = 0; q < sizeof names / sizeof *names; ++q) {
    scene sc = accurate_scene(names[q], 60);
    solved_curve reference = traced(&sc);
    double omega[FREQUENCIES + 1];
    frequencies(&sc, omega);
    for (int a = 0; a < 3; ++a) {
      sc.hbm.harmonics = HBM_AUTO;
      sc.hbm.accuracy = accuracies[a];
      solved_curve r = traced(&sc);
      assert_false(r.c.inaccurate);
      CHECK_LE(worst_distance(&r, &reference, omega, FREQUENCIES), 3 * accuracies[a], "%s, accuracy %g, H=%d", names[q],
               accuracies[a], hbm_n_harmonics(r.s));
      for (int k = 0; k + 1 < r.c.n; ++k)
        CHECK_LE(r.c.points[k].error, accuracies[a], "%s, accuracy %g, point %d", names[q], accuracies[a], k);
      /* The most harmonics' point of an auto curve. */
      int k = 0;
      for (int i = 1; i < r.c.n; ++i)
        if (r.c.points[i].harmonics > r.c.points[k].harmonics) k = i;
      omega[FREQUENCIES] = r.c.points[k].omega;
      int need = 0;
      for (size_t i = 0; i < sizeof ladder / sizeof *ladder && !need; ++i) {
        sc.hbm.harmonics = ladder[i];
        solved_curve fixed = {0};
        assert_int_equal(scene_hbm_solver(&sc, &fixed.s), HC_OK);
        if (hbm_trace(fixed.s, sc.omega_from, sc.omega_to, NULL, &fixed.c) == HC_OK &&
            worst_distance(&fixed, &reference, omega, FREQUENCIES + 1) <= accuracies[a])
          need = ladder[i];
        free_curve(&fixed);
      }
      print_message("%-5s accuracy %g: H up to %d, needed %d\n", names[q], accuracies[a], hbm_n_harmonics(r.s), need);
      assert_true(need > 0);
      assert_true(hbm_n_harmonics(r.s) <= 4 * need); /* next to a fold of r2, where the estimate grows */
      free_curve(&r);
    }
    free_curve(&reference);
  }
}

/* Each point's own row is as accurate as its `error` says: solved again with 60 harmonics from that row, at its
 * omega. A step back to fewer harmonics is taken on a tail of 0.05 accuracy, and its effect on the kept ones is not
 * measured until the next point: hence 3 here too. */
static void harmonics_follow_the_curve(CHECK_STATE)
{
  for (size_t q = 0; q < sizeof names / sizeof *names; ++q) {
    scene sc = accurate_scene(names[q], HBM_AUTO);
    sc.hbm.accuracy = 1e-3;
    solved_curve r = traced(&sc);
    sc.hbm.harmonics = 60;
    CHECK_MADE(hbm_solver, fine, scene_hbm_solver(&sc, &fine));
    int fewest = 1000, most = 0, checked = 0;
    for (int k = 0; k < r.c.n; ++k) {
      const double *row = hbm_curve_X(&r.c, k);
      int h = r.c.points[k].harmonics;
      if (h < fewest) fewest = h;
      if (h > most) most = h;
      for (int i = 2 * h + 1; i < r.c.n_coef; ++i) assert_true(row[i] == 0);
      double X[121] = {0}, sum = 0, size = 0;
      memcpy(X, row, (size_t)r.c.n_coef * sizeof *X);
      hbm_point point;
      if (hbm_solve(fine, r.c.points[k].omega, X, &point) != HC_OK) continue; /* beyond the fold of 60 harmonics */
      for (int i = 0; i < 121; ++i) {
        double d = X[i] - (i < r.c.n_coef ? row[i] : 0);
        sum += d * d;
        size += X[i] * X[i];
      }
      if (sqrt(sum / size) > 0.1) continue; /* another branch, next to a fold */
      CHECK_LE(sqrt(sum / size), 3e-3, "%s, omega %g, point %d, H=%d, said %g", names[q], r.c.points[k].omega, k, h,
               r.c.points[k].error);
      ++checked;
    }
    print_message("%-5s harmonics %d to %d over %d points, %d checked\n", names[q], fewest, most, r.c.n, checked);
    assert_true(fewest < most);
    assert_true(checked >= r.c.n * 9 / 10);
    assert_int_equal(hbm_n_harmonics(r.s), most);
    assert_int_equal(r.c.n_coef, 2 * most + 1);
    hbm_solver_free(fine);
    free_curve(&r);
  }
}

/* Sampling errs like 1/N^2, so that N against 2N shows 3/4 of it, 4/3 of the accuracy; with the restart interpolated
 * it is not monotone: 3. */
static void auto_samples_keep_the_accuracy(CHECK_STATE)
{
  static const double accuracies[] = {1e-2, 1e-3, 1e-4};
  for (size_t q = 0; q < sizeof names / sizeof *names; ++q) {
    scene sc = accurate_scene(names[q], 5);
    solved_curve reference = traced(&sc);
    double omega[FREQUENCIES];
    frequencies(&sc, omega);
    sc.hbm.force = HBM_FORCE_SAMPLED;
    sc.hbm.samples = HBM_AUTO;
    int before = 0;
    for (int a = 0; a < 3; ++a) {
      sc.hbm.accuracy = accuracies[a];
      solved_curve r = traced(&sc);
      assert_false(r.c.inaccurate);
      double worst = worst_distance(&r, &reference, omega, FREQUENCIES);
      print_message("%-5s accuracy %g: %d samples, worst %.1e\n", names[q], accuracies[a], hbm_n_samples(r.s), worst);
      CHECK_LE(worst, 3 * accuracies[a], "%s, accuracy %g, N=%d", names[q], accuracies[a], hbm_n_samples(r.s));
      assert_true(hbm_n_samples(r.s) >= before);
      before = hbm_n_samples(r.s);
      free_curve(&r);
    }
    free_curve(&reference);
  }
}

/* A point solved leaves a residual at 1e-10 of its forces or, polished once more, at rounding; the closed form at
 * rounding. Forces to motions: at most the resonance's K/(C w) = 5e3 for r2 (lightly damped) but polished 1e-16
 * each: 1e-9 is far above. So too for natural against arc-length steps. */
static void shortcuts_change_no_solution(CHECK_STATE)
{
  for (size_t q = 0; q < sizeof names / sizeof *names; ++q) {
    scene sc = accurate_scene(names[q], 7);
    double omega[FREQUENCIES];
    frequencies(&sc, omega);
    solved_curve plain = traced(&sc);
    sc.hbm.skip_linear = false;
    solved_curve solved = traced(&sc);
    assert_true(plain.c.linear > 0);
    assert_int_equal(solved.c.linear, 0);
    assert_true(solved.c.iterations > plain.c.iterations);
    CHECK_LE(worst_distance(&plain, &solved, omega, FREQUENCIES), 1e-9, "%s: skip_linear", names[q]);
    sc.hbm.skip_linear = true;
    sc.hbm.continuation = HBM_CONTINUATION_ARCLENGTH;
    solved_curve arc = traced(&sc);
    assert_true(arc.c.arclength);
    assert_int_equal(arc.c.turning_points, plain.c.turning_points);
    CHECK_LE(worst_distance(&arc, &plain, omega, FREQUENCIES), 1e-9, "%s: arc-length", names[q]);
    free_curve(&plain);
    free_curve(&solved);
    free_curve(&arc);
  }
}

/* Every switch off: numbers as given, the same at every point, no estimate, no arc-length, no closed form. a10 with
 * 1 N stays away from folds. */
static void every_switch_can_be_turned_off(CHECK_STATE)
{
  scene sc = accurate_scene("a10", 5);
  sc.structure->loads->amplitude = 1;
  sc.hbm.force = HBM_FORCE_SAMPLED;
  sc.hbm.samples = 256;
  sc.hbm.skip_linear = false;
  sc.hbm.continuation = HBM_CONTINUATION_NATURAL;
  solved_curve r = traced(&sc);
  assert_false(r.c.arclength);
  assert_int_equal(r.c.linear, 0);
  assert_int_equal(hbm_n_harmonics(r.s), 5);
  assert_int_equal(hbm_n_samples(r.s), 256);
  assert_int_equal(r.c.n_coef, 11);
  for (int k = 0; k < r.c.n; ++k) {
    assert_int_equal(r.c.points[k].harmonics, 5);
    assert_true(isnan(r.c.points[k].error));
    assert_true(r.c.points[k].iterations > 0);
  }
  free_curve(&r);
  sc.hbm.samples = HBM_AUTO; /* one auto without the other */
  r = traced(&sc);
  assert_int_equal(r.c.n_coef, 11);
  assert_true(isfinite(r.c.points[r.c.n - 2].error));
  free_curve(&r);
}

CHECK_TESTS("hbm.auto", 300, auto_harmonics_keep_the_accuracy, harmonics_follow_the_curve,
            auto_samples_keep_the_accuracy, shortcuts_change_no_solution, every_switch_can_be_turned_off)
