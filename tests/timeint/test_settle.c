/* test_settle.c - the estimate against sequences whose limit is known: settled neither too early nor never. */
#include "numerics/random.h"
#include "tests/check.h"

#include "timeint/steady/settle.h"

typedef struct map {
  double radius, angle, second; /* second > 0: real multipliers radius and second instead of a complex pair */
} map;

/* One step of z -> J z; a complex pair in the metric of an ellipse 3 : 1, so that drifts oscillate. */
static void step(const map *m, double *z)
{
  if (m->second > 0) {
    z[0] *= m->radius, z[1] *= m->second;
    return;
  }
  double x = z[0], y = z[1] / 3, c = m->radius * cos(m->angle), s = m->radius * sin(m->angle);
  z[0] = c * x - s * y;
  z[1] = 3 * (s * x + c * y);
}

static double size(const double *z) { return fmax(fabs(z[0]), fabs(z[1])); }

/* Steps until settled within goal, the true distance then in *distance; 0 if not within `most`. */
static int settle_after(const map *m, double prior, double goal, double scatter, int most, double *distance,
                        settle_estimate *e)
{
  double z[2] = {1, 1};
  uint64_t seed = 1;
  CHECK_MADE(settle, s, settle_new(2, &s));
  settle_start(s, prior);
  int n = 0, done = 0;
  e->multiple = 0;
  *distance = INFINITY;
  while (!done && n < most) {
    double shown[2] = {7 + z[0], 5 + z[1]}; /* the fixed point is (7, 5) */
    settle_push(s, shown);
    *distance = size(z);
    if (n % (prior > 0.99 ? 16 : 1) == 0)
      *e = settle_judge(s, goal); /* slow ones: now and then, for the test's
                                                                         speed */
    done = e->multiple > 0;
    step(m, z);
    z[0] += 0.5 * scatter * random_signed(&seed), z[1] += 0.5 * scatter * random_signed(&seed);
    ++n;
  }
  settle_free(s);
  return done ? n : 0;
}

/* The bound |z_n - z*| <= D/(1 - rho^m): never below the truth where rho is; above it by no more than 3 (the ellipse) *
 * 2/(1 - e^-2) at the longest stride. So it settles, and at the latest when the truth is goal/21: log(1/goal *
 * 21)/log(1/rho) steps and 2 baselines (512 at most, and 17). */
static void never_early_never_late(CHECK_STATE)
{
  const double radius[] = {0.3, 0.84, 0.97, 0.99888}, angle[] = {0, 0.01, 0.3, 1.5, 3.1, PI}, goal = 1e-9;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 6; ++j) {
      map m = {radius[i], angle[j], 0};
      double d;
      settle_estimate e;
      int latest = (int)(log(21 * sqrt(10) / goal) / -log(radius[i])) + 1100;
      int n = settle_after(&m, radius[i], goal, 0, latest, &d, &e);
      CHECK_LE(1, n, "never: radius %g angle %g", radius[i], angle[j]);
      CHECK_LE(d, goal, "early: radius %g angle %g", radius[i], angle[j]);
      assert_int_equal(e.multiple, 1);
    }
}

/* Near a fold: the slow multiplier is much closer to 1 than damping says. The measured rate is exact but for
 * rounding of 7 + z, 1e-15 of a drift of goal (1 - rho) >= 1e-13: 1 % of the ratio of two at worst, 1 %/b of rho, b
 * >= 256 the longest baseline (16 times a power of 2), 4e-5 against 1 - rho = 1e-4: 40 % of the distance; at 0.999 a
 * hundredth of that. */
static void slow_real_multiplier_is_measured(CHECK_STATE)
{
  const double slow[] = {0.95, 0.99, 0.999, 0.9999}, goal = 1e-9;
  for (int i = 0; i < 4; ++i) {
    map m = {0.7, 0, slow[i]};
    double d;
    settle_estimate e;
    int n = settle_after(&m, 0.83, goal, 0, (int)(50 / (1 - slow[i])), &d, &e);
    CHECK_LE(1, n, "never: %g", slow[i]);
    CHECK_LE(d, (slow[i] > 0.9995 ? 1.4 : 1.01) * goal, "early: %g", slow[i]);
  }
}

/* Noise of s a step leaves the state s/sqrt(2 (1 - rho)) off (half of that, being uniform, in rms). A goal of 20
 * times this can be met; D over 1 - rho alone would ask for s/(1 - rho), 47 times more than the first at rho =
 * 0.99888. A goal of a tenth cannot be met, and must not be said to be. */
static void noise_is_neither_contraction_nor_doom(CHECK_STATE)
{
  const double radius[] = {0.84, 0.99888}, scatter = 1e-9;
  for (int i = 0; i < 2; ++i) {
    map m = {radius[i], 0.5, 0};
    double d, reach = scatter / sqrt(2 * (1 - radius[i]));
    settle_estimate e;
    int most = (int)(40 / (1 - radius[i])) + 2000;
    int n = settle_after(&m, radius[i], 20 * reach, scatter, most, &d, &e);
    CHECK_LE(1, n, "reachable: %g", radius[i]);
    CHECK_LE(d, 20 * reach, "true distance: %g", radius[i]);
    assert_int_equal(settle_after(&m, radius[i], 0.1 * reach, scatter, most, &d, &e), 0);
  }
}

/* A drift that does not shrink has no limit. */
static void no_limit_is_never_settled(CHECK_STATE)
{
  double d;
  map turning = {1, 0.7, 0}, growing = {1.001, 0, 0.5};
  CHECK_FILLED(settle_estimate, e, settle_after(&turning, 0.84, 1e-3, 0, 5000, &d, &e));
  assert_int_equal(settle_after(&growing, 0.84, 1e-3, 0, 5000, &d, &e), 0);
  settle *s; /* a constant creep: D_m grows with m */
  assert_int_equal(settle_new(1, &s), HC_OK);
  settle_start(s, 0.84);
  for (int n = 0; n < 5000; ++n) {
    double z = 1e-6 * n;
    settle_push(s, &z);
    assert_int_equal(settle_judge(s, 1e-5).multiple, 0);
  }
  settle_free(s);
}

/* A cycle of k points reached at the rate 0.8 a step: k is found, and not before the state is within goal of it. */
static void cycles_are_counted(CHECK_STATE)
{
  for (int k = 2; k <= SETTLE_MAX_MULTIPLE; ++k) {
    CHECK_MADE(settle, s, settle_new(1, &s));
    settle_start(s, 0.84);
    settle_estimate e = {0};
    double off = 1;
    int n = 0;
    for (; n < 1000 && e.multiple == 0; ++n, off *= 0.8) {
      double z = (n % k == 0) + off;
      settle_push(s, &z);
      e = settle_judge(s, 1e-9);
    }
    assert_int_equal(e.multiple, k);
    CHECK_LE(off / 0.8, 1e-9, "k=%d", k);
    settle_free(s);
  }
}

/* After settle_restart nothing older counts. */
static void restart_forgets(CHECK_STATE)
{
  CHECK_MADE(settle, s, settle_new(1, &s));
  settle_start(s, 0.5);
  double z = 1;
  for (int n = 0; n < 100; ++n) settle_push(s, &z);
  assert_int_equal(settle_judge(s, 1e-9).multiple, 1);
  settle_restart(s);
  assert_int_equal(settle_judge(s, 1e-9).multiple, 0);
  CHECK_LE(1, isinf(settle_drift(s)), "one point has no drift");
  settle_free(s);
}

CHECK_TESTS("timeint.settle", 120, never_early_never_late, slow_real_multiplier_is_measured,
            noise_is_neither_contraction_nor_doom, no_limit_is_never_settled, cycles_are_counted, restart_forgets)
