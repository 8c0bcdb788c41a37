/* test_aft_jacobian.c - the Jacobian of the sampled contact force against differences, and what time shifts do to
 * both. */
#include "tests/hbm/scene_forces.h"
#include "tests/hbm/slow_aft.h"

enum { MAX_H = 50, MAX_COEF = 2 * MAX_H + 1 };

static slow_aft slow; /* too large for a stack */
static double jac[MAX_COEF * MAX_COEF], shifted_jac[MAX_COEF * MAX_COEF];

static uint64_t pattern_at(const scene *sc, int H, int N, const double *X, double *F)
{
  slow_force(&slow, sc, H, N, X, F);
  return slow.pattern;
}

/* As long as every sample keeps its state, F is linear in X: stuck, slipping and separated samples are, and where a
 * contact restarts u = w is either a sample or (u and v being proportional) the constant -gap cos/sin. So a central
 * difference has no truncation error at any step that keeps the states, which the slow way reports (at -step, 0 and
 * +step, settling period included); other directions are skipped, and counted. Left is rounding: of F, twice its
 * tolerance over 2 step, and of the product J d. */
static void jacobian_equals_central_differences(CHECK_STATE)
{
  static const struct {
    int H, N;
  } sizes[] = {{1, 5}, {1, 64}, {3, 7}, {5, 33}, {10, 128}, {25, 200}, {50, 101}, {50, 256}};
  const double step = 1e-7;
  uint64_t seed = 9;
  int checked = 0, skipped = 0, regimes[4] = {0};
  double X[MAX_COEF], d[MAX_COEF], plus[MAX_COEF], minus[MAX_COEF], F[MAX_COEF], F_plus[MAX_COEF], F_minus[MAX_COEF],
      unused[MAX_COEF];
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i)
    for (int trial = 0; trial < (sizes[i].H < 20 ? 200 : 24); ++trial) {
      int H = sizes[i].H, N = sizes[i].N, n = 2 * H + 1;
      scene sc = random_contacts(&seed, 1 + trial % 3);
      sc.hbm.restart = trial / 2 % 2 ? HBM_RESTART_SAMPLE : HBM_RESTART_INTERPOLATED;
      CHECK_MADE(contact_forces, a, scene_forces(&sc, HBM_FORCE_SAMPLED, H, N, &a));
      random_motion(&seed, H, 1, 1 + trial % 3, X);
      CHECK_FILLED(contact_report, report, forces_eval(a, H, X, F, jac, &report));
      uint64_t pattern = pattern_at(&sc, H, N, X, unused);
      double noise = slow_tolerance(&sc, H, N, X), stiffness = 0;
      for (int j = 0; j < sc.structure->n_contacts; ++j) stiffness += slow_stiffness(&sc.structure->contacts[j].given);
      for (int direction = 0; direction < 4; ++direction) {
        random_motion(&seed, H, 1, direction % 2, d);
        double size = sum_abs(n, d);
        for (int p = 0; p < n; ++p) {
          plus[p] = X[p] + step * d[p] / size;
          minus[p] = X[p] - step * d[p] / size;
          d[p] = (plus[p] - minus[p]) / (2 * step); /* as it came out */
        }
        if (pattern_at(&sc, H, N, plus, unused) != pattern || pattern_at(&sc, H, N, minus, unused) != pattern) {
          ++skipped;
          continue;
        }
        ++checked;
        assert_int_equal(forces_eval(a, H, plus, F_plus, NULL, NULL), HC_OK);
        assert_int_equal(forces_eval(a, H, minus, F_minus, NULL, NULL), HC_OK);
        for (int p = 0; p < n; ++p) {
          double product = 0;
          for (int q = 0; q < n; ++q) product += jac[p + n * q] * d[q];
          CHECK_NEAR(product, (F_plus[p] - F_minus[p]) / (2 * step),
                     noise / step + 4 * (n + N) * DBL_EPSILON * stiffness, "H=%d N=%d trial %d direction %d row %d", H,
                     N, trial, direction, p);
        }
      }
      ++regimes[report.regime];
      contact_forces_free(a);
    }
  print_message("%d directions checked, %d skipped for a changed state\n", checked, skipped);
  assert_true(skipped < checked / 20);
  for (int r = CONTACT_STUCK; r <= CONTACT_SEPARATES; ++r) assert_true(regimes[r] > 20);
}

/* Per harmonic, a shift by an angle is a rotation S: F(S X) = S F(X), J(S X) = S J(X) S'. Shifts by whole steps only
 * move the samples around, so this holds for every N, and where th = 0 falls (amid stick, slip or separation) must
 * not matter. X rounds again when shifted, and a sample that sits on a change of state may change over: random ones
 * do not. Rounding: of F as ever; J's is that of its symbol and of its N/2 or less stick intervals, N steps of at
 * most an eps of the stiffness, and two rotations. The shifted X, off by 2 eps, moves F by that. A slider that has been
 * pushed until friction just holds it (shakedown) touches its limit at one sample to rounding: that is a slip or not,
 * with the same force and Jacobian, so states are not compared there. */
static void whole_steps_only_rotate(CHECK_STATE)
{
  static const struct {
    int H, N;
  } sizes[] = {{1, 5}, {1, 16}, {3, 7}, {7, 64}, {20, 101}};
  uint64_t seed = 10;
  int told = 0;
  double X[MAX_COEF], Y[MAX_COEF], F[MAX_COEF], G[MAX_COEF], rotated[MAX_COEF], row[MAX_COEF];
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i)
    for (int trial = 0; trial < 60; ++trial) {
      int H = sizes[i].H, N = sizes[i].N, n = 2 * H + 1, steps = 1 + trial * 7 % (N - 1);
      double shift = 2 * PI * steps / N, stiffness = 0;
      scene sc = random_contacts(&seed, 1 + trial % 3);
      sc.hbm.restart = trial / 2 % 2;
      for (int j = 0; j < sc.structure->n_contacts; ++j) stiffness += slow_stiffness(&sc.structure->contacts[j].given);
      random_motion(&seed, H, 1, 1, X);
      shift_motion(H, X, shift, Y);
      CHECK_MADE(contact_forces, a, scene_forces(&sc, HBM_FORCE_SAMPLED, H, N, &a));
      CHECK_FILLED(contact_report, here, forces_eval(a, H, X, F, jac, &here));
      CHECK_FILLED(contact_report, there, forces_eval(a, H, Y, G, shifted_jac, &there));
      contact_forces_free(a);
      slow_force(&slow, &sc, H, N, X, row);
      if (slow.never_slips)
        continue; /* w, and so the mean of T, is what the settling period left, which began at th
                                         = 0 */
      double tolerance = slow_tolerance(&sc, H, N, X), jac_tolerance = 8 * (n + N) * DBL_EPSILON * stiffness;
      shift_motion(H, F, shift, rotated);
      for (int p = 0; p < n; ++p)
        CHECK_NEAR(G[p], rotated[p], 2 * tolerance, "H=%d N=%d trial %d, row %d", H, N, trial, p);
      for (int p = 0; p < n; ++p) { /* J S' by rows: a row is a motion too, but for the mean */
        for (int q = 0; q < n; ++q) row[q] = jac[p + n * q];
        shift_motion(H, row, shift, rotated);
        for (int q = 0; q < n; ++q) jac[p + n * q] = rotated[q];
      }
      for (int q = 0; q < n; ++q) {
        shift_motion(H, jac + n * q, shift, rotated);
        for (int p = 0; p < n; ++p)
          CHECK_NEAR(shifted_jac[p + n * q], rotated[p], jac_tolerance, "H=%d N=%d trial %d, row %d column %d", H, N,
                     trial, p, q);
      }
      if (slow.rests) continue;
      assert_int_equal(here.regime, there.regime);
      assert_int_equal(here.transitions, there.transitions);
      ++told;
    }
  CHECK_LE(100, told, "of 300 motions");
}

CHECK_TESTS("hbm.aft_jacobian", 150, jacobian_equals_central_differences, whole_steps_only_rotate)
