/* test_curve.c - response curves: closed forms of linear sweeps, the reference rows and peaks with sampled forces. */
#include "tests/hbm/curve_reference.h"

/* A whole sweep, up or down, its points and between them, and its peak: F0/(C sqrt(k/M - C^2/4M^2)) at w^2 = k/M -
 * C^2/2M^2. */
static void check_linear_sweep(const scene *sc, double k, contact_regime regime, double from, double to,
                               const char *what)
{
  traced t = trace(sc, from, to, what);
  const hbm_curve *c = &t.curve;
  assert_int_equal(t.status, HC_OK);
  assert_int_equal(c->turning_points, 0);
  assert_true(c->points[0].omega == from && c->points[c->n - 1].omega == to);
  for (int i = 0; i < c->n; ++i) {
    check_linear_point(sc, k, c->X + (size_t)i * c->n_coef, c->points[i].omega, what);
    if (i) assert_true((c->points[i].omega > c->points[i - 1].omega) == (to > from));
  }
  hbm_measures m;
  for (int i = 0; i <= 40; ++i) {
    double omega = i == 40 ? to : from + i * (to - from) / 40;
    hbm_curve at = {0};
    assert_int_equal(hbm_curve_at(t.s, c, omega, &at), HC_OK);
    assert_int_equal(at.n, 1);
    assert_true(at.points[0].omega == omega);
    check_linear_point(sc, k, at.X, omega, what);
    assert_int_equal(hbm_measure(t.s, at.X, &m), HC_OK);
    assert_int_equal(m.contact.regime, regime);
    hbm_curve_free(&at);
  }
  hbm_curve peak = {0};
  assert_int_equal(hbm_curve_peak(t.s, c, &peak), HC_OK);
  assert_int_equal(peak.n, 1);
  assert_int_equal(hbm_measure(t.s, peak.X, &m), HC_OK);
  double damping = *sc->structure->damping.v / *sc->structure->mass.v,
         top = sc->structure->loads->amplitude /
               (*sc->structure->mass.v * damping * sqrt(k / *sc->structure->mass.v - damping * damping / 4));
  double omega_top = sqrt(k / *sc->structure->mass.v - damping * damping / 2);
  /* a maximum: an omega off by e costs x''/x e^2/2 = (2/damping)^2 e^2/2, and no search can tell e where
   * that is below the rounding r of the amplitude: e <= (damping/2) sqrt(2 r), r the linear tolerance; the amplitude
   * is as good as that rounding, twice for the comparison */
  double rounding = linear_tolerance(sc, k, omega_top, 1) / top;
  CHECK_NEAR(m.amplitude, top, 4 * rounding * top, "%s: peak", what);
  CHECK_NEAR(peak.points[0].omega, omega_top, 4 * damping / 2 * sqrt(2 * rounding) + 1e-7 * fabs(to - from), "%s: peak",
             what);
  hbm_curve_free(&peak);
  free_traced(&t);
}

/* No contact; preloaded and never slipping (a10 with 1 N: 0.18 at resonance, below mu kn gap/(kt cos + mu kn sin) =
 * 0.26); never touching (b10 with 1 N: 0.4 sin 45 < 0.5). The paper's Table 10 likewise, where the resonance is 2800
 * times sharper. The numbers there lose 4 digits more. */
static void linear_sweeps(CHECK_STATE)
{
  static const int orders[] = {1, 5, 10};
  for (int i = 0; i < 3; ++i)
    for (int keep_mean = 0; keep_mean <= 1; ++keep_mean)
      for (int down = 0; down <= 1; ++down) {
        scene stuck = scene_named("a10", orders[i], keep_mean, 64),
              apart = scene_named("b10", orders[i], keep_mean, 64);
        double from = down ? 20 : 3, to = 23 - from;
        stuck.structure->loads->amplitude = apart.structure->loads->amplitude = 1;
        scene bare = scene_own(&apart);
        scene_keep_contacts(&bare, 0);
        check_linear_sweep(&bare, 40, CONTACT_LINEAR, from, to, "no contact");
        check_linear_sweep(&apart, 40, CONTACT_LINEAR, from, to, "apart");
        check_linear_sweep(&stuck, 190, CONTACT_STUCK, from, to, "stuck");
        CHECK_LE(linear_tolerance(&stuck, 190, 13.78, 1) / 0.18, 1e-12,
                 "what the tolerance comes to, where it is largest");
        scene sharp = scene_named("r2", orders[i], keep_mean, 64);
        sharp.structure->loads->amplitude = 1; /* 3.5e-3 at resonance, far from 0.2 */
        check_linear_sweep(&sharp, 8e5, CONTACT_LINEAR, down ? 850 : 600, down ? 600 : 850, "apart, sharp");
      }
}

/* What sampling costs at N = 4096: kinks of the force miss s^2/12 = 2e-7 of their size times K x, s = 2 pi/N, and
 * the solution answers with at most the Q of 16 (r2: 2800, but the contact adds a force 1000 times smaller than K x)
 * or the steepness near a fold, 10 or so where rows are listed: 3e-5 of the amplitude. 1e-4 is held; found is 5e-6. */
static const double SAMPLED = 1e-4;

/* The reference peaks are good to 1e-6, their omega to 1e-3; a flat top hides the error of omega. */
static int check_peak(const traced *t, const char *name, int n_harm, int keep_mean)
{
  int checked = 0;
  for (int i = 0; i < n_peaks; ++i) {
    const reference_peak *r = &peaks[i];
    if (strcmp(r->name, name) || r->n_harm != n_harm || r->keep_mean != keep_mean) continue;
    hbm_curve peak = {0};
    assert_int_equal(hbm_curve_peak(t->s, &t->curve, &peak), HC_OK);
    CHECK_FILLED(hbm_measures, m, hbm_measure(t->s, peak.X, &m));
    CHECK_NEAR(m.amplitude, r->amplitude, (SAMPLED + 1e-6) * r->amplitude, "%s H=%d static=%d", name, n_harm,
               keep_mean);
    CHECK_NEAR(peak.points[0].omega, r->omega, 1.5e-3 * r->omega, "%s H=%d static=%d", name, n_harm, keep_mean);
    hbm_curve_free(&peak);
    ++checked;
  }
  return checked;
}

/* c2kn1e4, harmonic 0 kept: only H = 1. With kn = 1e4, 4096 samples make hundreds of false turning points
 * (test_paper.c) and take 20 s for the rest. Without harmonic 0 its reference peaks are where the reference sweep
 * ended, near 20, the curve still rising: no peaks. */
static void reference_rows_and_peaks(CHECK_STATE)
{
  static const int orders[] = {1, 5, 10};
  int n_checked = 0, n_tops = 0;
  for (int i = 0; i < N_REFERENCE_SCENES; ++i)
    for (int o = 0; o < 3; ++o)
      for (int keep_mean = 0; keep_mean <= 1; ++keep_mean) {
        const reference_scene *r = &reference_scenes[i];
        bool hard = !strcmp(r->name, "c2kn1e4");
        if (hard && keep_mean && o > 0) continue;
        scene sc = scene_named(r->name, orders[o], keep_mean, 4096);
        traced t = whole(&sc, r->omega_from, r->omega_to, r->name);
        n_checked += check_rows(n_rows, rows, &t, r->name, orders[o], keep_mean, false, SAMPLED);
        if (!(hard && !keep_mean)) n_tops += check_peak(&t, r->name, orders[o], keep_mean);
        free_traced(&t);
      }
  print_message("%d rows, %d peaks\n", n_checked, n_tops);
  assert_true(n_checked == 516 && n_tops == 43);
}

/* Arc-length only takes the same curve: every row of these scenes at H = 5 with harmonic 0. */
static void arclength_only(CHECK_STATE)
{
  static const char *const names[] = {"a10", "b10", "c2", "r2"};
  for (int i = 0; i < 4; ++i) {
    scene sc = scene_named(names[i], 5, true, 4096);
    sc.hbm.continuation = HBM_CONTINUATION_ARCLENGTH;
    traced t = trace(&sc, sc.omega_from, sc.omega_to, names[i]);
    assert_true(t.status == HC_OK && t.curve.arclength);
    int listed = 0;
    for (int j = 0; j < n_rows; ++j)
      listed += !strcmp(rows[j].name, names[i]) && rows[j].n_harm == 5 && rows[j].keep_mean;
    assert_true(listed >= 7); /* reference frequencies of a scene, test_exact_reference.c */
    assert_int_equal(check_rows(n_rows, rows, &t, names[i], 5, true, false, SAMPLED), listed);
    free_traced(&t);
  }
}

CHECK_TESTS_WITH("hbm.curve", 300, read_references, NULL, linear_sweeps, reference_rows_and_peaks, arclength_only)
