/* test_aft.c - contact force harmonics by sampling: orders of the error in 1/N, and the same sums done the slow way.
 * Closed forms: test_exact.c, to whose forces these tend.
 *
 * Euler-Maclaurin with kinks. The mean over N equidistant angles misses the integral of g over a period, divided by
 * 2 pi, by a sum over the places where the m-th derivative of g jumps by J_m, at a fraction t of a step s = 2 pi/N:
 * s^{m+1} J_m B_{m+1}(t) / ((m+1)! 2 pi), where |B_2| <= 1/6, |B_3| <= 0.0482, |B_4| <= 1/30, |B_5| <= 0.0245. With
 * g = f cos h th or f sin h th, f continuous and made of constants and A cos th: |jump of f^(j)| <= J of A's size
 * for j >= 1, hence |J_m| <= J ((1 + h)^m - h^m), and a tail falling like (1 + h) s/(2 pi). */
#include "tests/hbm/scene_forces.h"
#include "tests/hbm/slow_aft.h"

static slow_aft slow; /* too large for a stack */

/* Error of the h-th coefficient from one kink: first derivative jumps by J1, higher ones by at most J. For (1 + h) s
 * < 0.15 pi. */
static double kink_error(int h, int n_time, double J1, double J)
{
  /* 1.3: the tail, ratio below 0.15, and room */
  static const double c[] = {0, 1.0 / 12, 0.0482 / 6, 1.0 / 720, 1.3 * 0.0245 / 120};
  double s = 2 * PI / n_time, sum = c[1] * s * s * J1;
  assert_true((1 + h) * s < 0.15 * PI);
  for (int m = 2; m <= 4; ++m) sum += c[m] * pow(s, m + 1) * J * (pow(1 + h, m) - pow(h, m));
  return (h ? 2 : 1) * sum / (2 * PI);
}

static scene one_contact(double kt, double kn, double mu, double gap, double angle_deg)
{
  scene sc = scene_oscillator(1, 0, 1, 0);
  scene_add_contact(&sc, (scene_contact){{.kt = kt, .kn = kn, .mu = mu, .gap = gap}, angle_deg});
  return sc;
}

/* What one evaluation in a workspace of its own finds besides the force. */
typedef struct aft_result {
  contact_report report;
  double w[SCENE_MAX_CONTACTS]; /* sliders at th = 0 */
} aft_result;

static hc_status eval_once(const scene *sc, int n_harm, int n_time, const double *X, double *F, double *jac,
                           aft_result *out)
{
  contact_forces *a;
  hc_status st = scene_forces(sc, HBM_FORCE_SAMPLED, n_harm, n_time, &a);
  if (st == HC_OK) st = forces_eval(a, n_harm, X, F, jac, out ? &out->report : NULL);
  if (st == HC_OK && out) contact_forces_sliders(a, out->w);
  contact_forces_free(a);
  return st;
}

/* The first cosine of k max(g + A cos th, 0), docs/theory.md section 11. */
static double unilateral(double k, double g, double A)
{
  const double p = acos(-g / A);
  return k / PI * (2 * g * sin(p) + A * (p + sin(p) * cos(p)));
}

/* Case 2 never slips (kt cos < mu kn sin), so from the touch on its force is (kt c^2 + kn s^2) (x - x_touch),
 * x_touch = -gap/s: the unilateral spring again. Largest error of the first harmonic, relative to A, over 64 shifts
 * within a step and 32 amplitudes A, 10 to 10.1: these move the two kinks against each other by more than a step, N
 * >= 512, for 1 % of A is 1.4 % of p = 0.63. */
static double case_2_error(int restart, int n_time)
{
  scene sc = scene_named("c2", 1, true, n_time);
  sc.hbm.restart = restart;
  double worst = 0;
  CHECK_MADE(contact_forces, a, scene_forces(&sc, HBM_FORCE_SAMPLED, 1, n_time, &a));
  for (int k = 0; k < 64 * 32; ++k) {
    double X[3] = {-1, 10 + k % 32 / 320.0, 0}, Y[3], F[3], G[3], shift = k / 32 * 2 * PI / n_time / 64;
    double exact = unilateral(550, X[0] + sc.structure->contacts[0].given.law.gap / sqrt(0.5), X[1]);
    shift_motion(1, X, shift, Y);
    assert_int_equal(forces_eval(a, 1, Y, F, NULL, NULL), HC_OK);
    shift_motion(1, F, -shift, G);
    worst = larger(worst, hypot(G[1] - exact, G[2]) / X[1]);
  }
  contact_forces_free(a);
  return worst;
}

/* Restarted on the last separated sample, w lags the touch by a part f of a step, D = A sin p s, and the sample
 * itself lies (1 - f) D beyond. There T = kt c (1 - f + f) D must not exceed mu N = mu kn s (1 - f) D = r kt c (1 -
 * f) D, r = 3, else it slips until the lag is (r - 1)(1 - f) D: the lag is min(f, (r - 1)(1 - f)) D, at worst (1 -
 * 1/r) D = 2/3 D, and stays for the whole contact (but for an instant of slip at its end). The first harmonic is
 * then off by kt c^2 (2/3) A sin p s (2/pi) sin p; 64 shifts miss at most 1/64 of it, and kinks add second-order
 * terms. Restarted at the interpolated touch, w is exact, as u and v are proportional, and only the kinks are left. */
static void restarts_of_the_slider(CHECK_STATE)
{
  /* the largest p, at A = 10.1 */
  double g = -1 - 5 / sqrt(0.5), sin_p = sqrt(1 - g * g / (10.1 * 10.1)), sample[4], touch[4];
  for (int i = 0; i < 4; ++i) {
    int N = 512 << (2 * i);
    double s = 2 * PI / N, lag = 100 * 0.5 * (2.0 / 3) * s * sin_p * sin_p * 2 / PI,
           kinks = 2 * kink_error(1, N, 550 * sin_p, 550);
    double rounding = 550 * 2 * (20 + 4 * log2(N)) * DBL_EPSILON; /* slow_tolerance, H = 1, sum |X| + gap < 2 A */
    sample[i] = case_2_error(HBM_RESTART_SAMPLE, N);
    touch[i] = case_2_error(HBM_RESTART_INTERPOLATED, N);
    CHECK_LE(sample[i], lag + kinks + rounding, "N=%d", N);
    CHECK_LE((1 - 1.0 / 64) * lag - kinks, sample[i] + rounding, "N=%d", N);
    CHECK_LE(touch[i], kinks + rounding, "N=%d", N);
    if (!i) continue;
    double order_sample = log2(sample[i - 1] / sample[i]) / 2, order_touch = log2(touch[i - 1] / touch[i]) / 2;
    print_message("N = %5d: error of F1, restarted on a sample %.1e A (order %.2f), at the touch %.1e A (order %.2f)\n",
                  N, sample[i], order_sample, touch[i], order_touch);
    /* the worst kinks B_2(t1) + B_2(t2) = 1/3 - |t1| - |t2| are met to 1/128 and, as amplitudes fall at random, some
     * 1/32: 15 % of 1/3, 0.1 in the order */
    CHECK_NEAR(order_sample, 1, 0.1, "N=%d", N);
    CHECK_NEAR(order_touch, 2, 0.1, "N=%d", N);
  }
}

/* Every size, odd ones and 2H + 1 included, several contacts, both restarts; the slider of the report too. */
static void agrees_with_the_slow_way(CHECK_STATE)
{
  static const struct {
    int H, N;
  } sizes[] = {{1, 3}, {1, 5}, {2, 5}, {3, 7}, {1, 64}, {5, 33}, {10, 128}, {50, 101}, {50, 512}};
  uint64_t seed = 6;
  int regimes[4] = {0};
  double X[101], F[101], slowF[101];
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i)
    for (int trial = 0; trial < 60; ++trial) {
      int H = sizes[i].H, N = sizes[i].N;
      scene sc = random_contacts(&seed, 1 + trial % 4);
      sc.hbm.restart = trial % 2 ? HBM_RESTART_SAMPLE : HBM_RESTART_INTERPOLATED;
      random_motion(&seed, H, 1, trial % 3, X);
      CHECK_FILLED(aft_result, got, eval_once(&sc, H, N, X, F, NULL, &got));
      slow_force(&slow, &sc, H, N, X, slowF);
      double tolerance = slow_tolerance(&sc, H, N, X);
      for (int p = 0; p < 2 * H + 1; ++p)
        CHECK_NEAR(F[p], slowF[p], tolerance, "H=%d N=%d trial %d, row %d", H, N, trial, p);
      for (int j = 0; j < sc.structure->n_contacts; ++j) {
        /* w = u - T/kt: stiffness of F over kt. kt = 0 leaves w free, and a contact without friction has none. */
        const contact *c = &sc.structure->contacts[j].given.law;
        if (c->kt > 0 && contact_has_friction(c))
          CHECK_NEAR(got.w[j], slow.w[j], tolerance / c->kt + tolerance, "w, H=%d N=%d trial %d", H, N, trial);
      }
      ++regimes[got.report.regime];
    }
  for (int r = CONTACT_STUCK; r <= CONTACT_SEPARATES; ++r) assert_true(regimes[r] > 0); /* the cases cover them */
}

/* A step of the law maps w to the nearest point of an interval (or to a constant, after a separation). Such maps are
 * closed under composition, so a period is one too, and applying it twice is applying it once: a second period finds
 * the slider settled, whatever the motion. That is exact but for rounding: the clamp's ends have errors of a few eps.
 * aft.c relies on it and returns HC_NOT_CLOSED if it fails. */
static void the_slider_closes_in_one_pass(CHECK_STATE)
{
  static const int sizes[] = {5, 16, 101, 256};
  uint64_t seed = 7;
  double X[101], F[101];
  for (int trial = 0; trial < 2000; ++trial) {
    int N = sizes[trial % 4], H = 1 + (int)((N - 3) / 2.0 * fabs(random_signed(&seed)));
    if (H > 50) H = 50;
    scene sc = random_contacts(&seed, 2);
    sc.hbm.restart = trial % 2;
    random_motion(&seed, H, pow(10, 2 * random_signed(&seed)), trial % 3, X);
    assert_int_equal(eval_once(&sc, H, N, X, F, NULL, NULL), HC_OK);
    if (trial % 10) continue;
    slow_force(&slow, &sc, H, N, X, F);
    double size = sum_abs(2 * H + 1, X), w_size = size; /* w = u - mu N/kt */
    for (int j = 0; j < 2; ++j) {
      const contact *c = &sc.structure->contacts[j].given.law;
      if (c->kt > 0) w_size = fmax(w_size, size + c->mu * c->kn / c->kt * (size + fabs(c->gap)));
    }
    CHECK_LE(slow.moved, 8 * DBL_EPSILON * w_size, "trial %d", trial);
  }
}

/* Forces add: to the rounding of N additions and one transform more. */
static void contacts_add(CHECK_STATE)
{
  enum { H = 6, N = 50, N_COEF = 2 * H + 1 };
  uint64_t seed = 8;
  double X[N_COEF], F[N_COEF], G[N_COEF], sum[N_COEF], jac[N_COEF * N_COEF], one[N_COEF * N_COEF],
      jac_sum[N_COEF * N_COEF];
  for (int trial = 0; trial < 100; ++trial) {
    scene sc = random_contacts(&seed, trial % 10 ? 4 : SCENE_MAX_CONTACTS);
    double stiffness = 0;
    random_motion(&seed, H, 1, 1, X);
    aft_result all, single;
    assert_int_equal(eval_once(&sc, H, N, X, F, jac, &all), HC_OK);
    memset(sum, 0, sizeof sum);
    memset(jac_sum, 0, sizeof jac_sum);
    int transitions = 0;
    contact_regime strongest = CONTACT_LINEAR;
    for (int j = 0; j < sc.structure->n_contacts; ++j) {
      scene alone = scene_own(&sc);
      scene_keep_contacts(&alone, 1);
      alone.structure->contacts[0].given = sc.structure->contacts[j].given;
      assert_int_equal(eval_once(&alone, H, N, X, G, one, &single), HC_OK);
      for (int p = 0; p < N_COEF; ++p) sum[p] += G[p];
      for (int p = 0; p < N_COEF * N_COEF; ++p) jac_sum[p] += one[p];
      transitions += single.report.transitions;
      if (single.report.regime > strongest) strongest = single.report.regime;
      assert_true(single.w[0] == all.w[j]);
      stiffness += slow_stiffness(&sc.structure->contacts[j].given);
    }
    double tolerance = slow_tolerance(&sc, H, N, X);
    for (int p = 0; p < N_COEF; ++p) CHECK_NEAR(F[p], sum[p], tolerance, "trial %d row %d", trial, p);
    /* symbol by FFT, then sums over up to N/2 stick intervals of both */
    for (int p = 0; p < N_COEF * N_COEF; ++p)
      CHECK_NEAR(jac[p], jac_sum[p], 4 * (log2(N) + N) * DBL_EPSILON * stiffness, "trial %d, %d", trial, p);
    assert_int_equal(transitions, all.report.transitions);
    assert_int_equal(strongest, all.report.regime);
  }
}

/* No contacts, and contacts that stay apart or stuck: known without sampling. */
static void linear_motions(CHECK_STATE)
{
  enum { H = 3, N = 16, N_COEF = 2 * H + 1 };
  double X[N_COEF] = {0.1, 0.5, -0.2, 0.1, 0, 0, 0.05}, F[N_COEF], jac[N_COEF * N_COEF];
  aft_result got;
  for (int n = 0; n <= 1; ++n) {
    scene sc = one_contact(2, 3, 0.3, -5, 45); /* |v| < 1: apart */
    scene_keep_contacts(&sc, n);
    assert_int_equal(eval_once(&sc, H, N, X, F, jac, &got), HC_OK);
    for (int p = 0; p < N_COEF; ++p) assert_true(F[p] == 0);
    for (int p = 0; p < N_COEF * N_COEF; ++p) assert_true(jac[p] == 0);
    assert_int_equal(got.report.regime, CONTACT_LINEAR);
    assert_int_equal(got.report.transitions, 0);
  }
  scene sc = one_contact(2, 3, 0.3, 50, 45); /* |T| <= 2 < 0.3 * 3 * 49: stuck at w = 0 */
  assert_int_equal(eval_once(&sc, H, N, X, F, jac, &got), HC_OK);
  double k = scene_stuck_stiffness(&sc.structure->contacts[0].given), tolerance = slow_tolerance(&sc, H, N, X);
  for (int p = 0; p < N_COEF; ++p) {
    CHECK_NEAR(F[p], k * X[p], tolerance, "row %d", p);
    for (int q = 0; q < N_COEF; ++q)
      CHECK_NEAR(jac[p + N_COEF * q], p == q ? k : 0, 4 * log2(N) * DBL_EPSILON * k, "row %d column %d", p, q);
  }
  assert_int_equal(got.report.regime, CONTACT_STUCK);
  assert_true(got.w[0] == 0 && got.report.transitions == 0);
}

static void bad_input(CHECK_STATE)
{
  scene sc = one_contact(2, 3, 0.3, -0.1, 45);
  contact_forces *a = (contact_forces *)&sc;
  assert_int_equal(scene_forces(&sc, HBM_FORCE_SAMPLED, 0, 16, &a), HC_BAD_INPUT);
  assert_null(a);
  assert_int_equal(scene_forces(&sc, HBM_FORCE_SAMPLED, HBM_MAX_HARMONICS + 1, 4096, &a), HC_BAD_INPUT);
  assert_int_equal(scene_forces(&sc, HBM_FORCE_SAMPLED, 8, 16, &a), HC_BAD_INPUT); /* 2H + 1 = 17 are needed */
  assert_null(a);
  contact_forces_free(NULL);
  static const double bad[] = {NAN, INFINITY, -INFINITY};
  assert_int_equal(scene_forces(&sc, HBM_FORCE_SAMPLED, 2, 16, &a), HC_OK);
  for (int i = 0; i < 3; ++i)
    for (int at = 0; at < 5; ++at) {
      double X[5] = {0.1, 0.2, 0.3, 0.4, 0.5}, F[5], jac[25];
      X[at] = bad[i];
      assert_int_equal(forces_eval(a, 2, X, F, jac, NULL), HC_NOT_FINITE);
      X[at] = 1;
      assert_int_equal(forces_eval(a, 2, X, F, jac, NULL), HC_OK); /* and it works on */
    }
  contact_forces_free(a);
}

CHECK_TESTS("hbm.aft", 120, restarts_of_the_slider, agrees_with_the_slow_way, the_slider_closes_in_one_pass,
            contacts_add, linear_motions, bad_input)
