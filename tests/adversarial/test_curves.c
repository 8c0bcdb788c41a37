/* test_curves.c - cases/adversarial on curves and motions as a whole: resonance almost undamped, sweeps that end on a
 * fold or run down, branches that one direction reaches, the most harmonics, nothing at all. */
#include "tests/adversarial/scenes.h"

#include <complex.h>

static const double SOLVED = 1e-11; /* as in test_contacts.c */

/* x = Re(F0/(K - M w^2 + i C w) e^{i w t}), by both; K and M w^2 cancel to eps K, against C w = 2e-6: relative
 * 1e-16/2e-6 = 1e-10. */
static void resonance_has_its_closed_form(CHECK_STATE)
{
  scene sc = load("zeta_1e-6", NULL);
  CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
  for (int i = 0; i < sc.compare.omega.n; ++i) {
    double w = sc.compare.omega.v[i];
    double complex x = sc.structure->loads->amplitude /
                       (*sc.structure->stiffness.v - *sc.structure->mass.v * w * w + I * *sc.structure->damping.v * w);
    hbm_curve at = solutions(&sc, w);
    scene_state y = {.x = 0};
    assert_int_equal(at.n, 1);
    CHECK_NEAR(at.X[1], creal(x), 1e-10 * cabs(x), "cos at %g", w);
    CHECK_NEAR(at.X[2], -cimag(x), 1e-10 * cabs(x), "sin at %g", w);
    CHECK_FILLED(timeint_result, r, timeint_steady(ti, w, y.all, NULL, &r));
    CHECK_NEAR(r.a1, creal(x), 1e-10 * cabs(x), "transient's cos at %g", w);
    CHECK_NEAR(r.b1, -cimag(x), 1e-10 * cabs(x), "transient's sin at %g", w);
    hbm_curve_free(&at);
  }
  timeint_free(ti);
}

/* With the contact in reach, one harmonic: the same curve from either end; what the force puts in, pi F0 |X1
 * sin(phase)|, the damper takes, pi C w |X1|^2, this contact, bilinear, nothing: F0 X[2] = C w |X1|^2. */
static void resonance_with_a_contact_balances_its_energy(CHECK_STATE)
{
  scene sc = LOAD("zeta_1e-6_contact", "hbm.harmonics=1"),
        down = LOAD("zeta_1e-6_contact", "hbm.harmonics=1", "sweep.omega=1.1,0.9");
  for (int i = 0; i < sc.compare.omega.n; ++i) {
    double w = sc.compare.omega.v[i];
    hbm_curve at = solutions(&sc, w), back = solutions(&down, w);
    assert_int_equal(at.n, back.n);
    for (int k = 0; k < at.n; ++k) {
      const double *X = solution(&at, k);
      double A = hypot(X[1], X[2]);
      const double solved = 1e-10 * *sc.structure->stiffness.v * A * A; /* hbm.tolerance, of K A, times A */
      CHECK_NEAR(sc.structure->loads->amplitude * X[2], *sc.structure->damping.v * w * A * A, solved,
                 "solution %d at %g", k, w);
      CHECK_NEAR(A, hypot(solution(&back, at.n - 1 - k)[1], solution(&back, at.n - 1 - k)[2]), 1e-6 * A,
                 "solution %d at %g, from above", k, w);
    }
    hbm_curve_free(&at);
    hbm_curve_free(&back);
  }
}

/* Where the curve of case 2 turns, in the order it meets them. */
static int folds(const scene *sc, hbm_special *out, int cap)
{
  hbm_curve curve = {0};
  hbm_special *all;
  int n, found = 0;
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(sc, &s));
  assert_int_equal(hbm_trace(s, sc->omega_from, sc->omega_to, NULL, &curve), HC_OK);
  assert_int_equal(hbm_specials(s, &curve, &all, &n), HC_OK);
  for (int i = 0; i < n; ++i)
    if (all[i].kind == HBM_TURNING_POINT && found < cap) out[found++] = all[i];
  free(all);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  return found;
}

/* The sweep ends on the fold, and beside it. Never an error, and the last point is on the sweep's end, an even
 * number of turns on: either before the fold, or after having gone round both (a tip shorter than the curve's own
 * accuracy, 1e-4 of X, so (1e-4)^2 of omega, may be gone round though it is outside). Well before it the end is met
 * first; beyond it there is no missing both turns. */
static void a_sweep_that_ends_on_a_fold(CHECK_STATE)
{
  scene sc = load("grazing", NULL);
  hbm_special fold[2];
  assert_int_equal(folds(&sc, fold, 2), 2);
  static const double beside[] = {-1e-6, -1e-9, -1e-12, 0, 1e-12, 1e-9, 1e-6};
  for (int i = 0; i < 7; ++i) {
    hbm_curve curve = {0};
    sc.omega_to = fold[0].omega * (1 + beside[i]);
    CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
    assert_int_equal(hbm_trace(s, sc.omega_from, sc.omega_to, NULL, &curve), HC_OK);
    const hbm_point *last = &curve.points[curve.n - 1];
    assert_true(last->omega == sc.omega_to);
    assert_true(last->branch == 0 || last->branch == 2);
    if (beside[i] <= -1e-6 || beside[i] >= 1e-9) assert_int_equal(last->branch, beside[i] < 0 ? 0 : 2);
    hbm_curve_free(&curve);
    hbm_solver_free(s);
  }
}

/* Upwards and downwards, the same solutions in opposite order. */
static void downwards_is_upwards_backwards(CHECK_STATE)
{
  scene down = load("downwards", NULL), up = LOAD("downwards", "sweep.omega=3,20");
  for (int i = 0; i < down.compare.omega.n; ++i) {
    hbm_curve p = solutions(&up, down.compare.omega.v[i]), q = solutions(&down, down.compare.omega.v[i]);
    assert_int_equal(p.n, q.n);
    for (int k = 0; k < p.n; ++k) {
      const double *X = solution(&p, k), *Y = solution(&q, p.n - 1 - k);
      for (int j = 0; j < p.n_coef; ++j)
        CHECK_NEAR(X[j], Y[j], SOLVED * norm_of(p.n_coef, X), "X[%d] at %g", j, p.points[k].omega);
    }
    hbm_curve_free(&p);
    hbm_curve_free(&q);
  }
}

/* gap1 at 16: three solutions on the curve; the transient swept down arrives on the last, up on the first. */
static void both_directions_reach_their_branch(CHECK_STATE)
{
  scene sc = LOAD("isolated", "transient.law=exact", "transient.start=down");
  hbm_curve at = solutions(&sc, 16);
  assert_int_equal(at.n, 3);
  static const double expected[] = {0.29934624719, 7.36591479229}; /* transient_exact.csv */
  for (int down = 0; down < 2; ++down) {
    CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
    scene_state y = {.x = 0};
    assert_int_equal(timeint_sweep(ti, down ? sc.omega_to : sc.omega_from, 16, y.all, NULL), HC_OK);
    CHECK_FILLED(timeint_result, r, timeint_steady(ti, 16, y.all, NULL, &r));
    CHECK_NEAR(r.amplitude, expected[down], 1e-8 * expected[down], "down %d", down);
    timeint_free(ti);
  }
  hbm_curve_free(&at);
}

/* Nothing moves: zeros, not NaN. */
static void no_force_is_rest(CHECK_STATE)
{
  scene sc = load("no_force", NULL);
  for (double gap = -1; gap <= 1; ++gap) {
    sc.structure->contacts[0].given.law.gap = gap;
    hbm_curve at = solutions(&sc, 9);
    assert_int_equal(at.n, 1);
    CHECK_LE(norm_of(at.n_coef, at.X), 0, "gap %g", gap);
    hbm_curve_free(&at);
  }
}

/* Held by a soft, long spring: alpha = 0 with kt cos^2 and the limit mu N cos, but for N's changing by v/gap = 1e-9. */
static void a_contact_of_friction_alone(CHECK_STATE)
{
  scene sc = load("friction_only", NULL), flat = scene_own(&sc);
  flat.structure->contacts[0].given.angle_deg = 0;
  flat.structure->contacts[0].given.law = (contact){.kt = 50, .kn = 40, .mu = 0.1 * sqrt(0.5), .gap = 1};
  same_answers(&sc, &flat, 1, 1e-7); /* v/gap = 4e-9 at most, and a response up to ten times as steep */
}

/* Contact forces of 4e-7 x at most against K x = 40 x: off the linear answer by 4e-7 |X|/|F0| at most. */
static void a_contact_of_next_to_no_stiffness(CHECK_STATE)
{
  scene sc = load("soft", NULL);
  for (int i = 0; i < sc.compare.omega.n; ++i) {
    double w = sc.compare.omega.v[i];
    double complex x = sc.structure->loads->amplitude /
                       (*sc.structure->stiffness.v - *sc.structure->mass.v * w * w + I * *sc.structure->damping.v * w);
    hbm_curve at = solutions(&sc, w);
    double off = cabs(at.X[1] - I * at.X[2] - x) / cabs(x);
    CHECK_LE(off, 4e-7 * cabs(x) / sc.structure->loads->amplitude, "at %g", w);
    CHECK_LE(1e-11, off, "it does touch at %g", w);
    hbm_curve_free(&at);
  }
}

CHECK_TESTS("adversarial.curves", 900, resonance_has_its_closed_form, resonance_with_a_contact_balances_its_energy,
            a_sweep_that_ends_on_a_fold, downwards_is_upwards_backwards, both_directions_reach_their_branch,
            no_force_is_rest, a_contact_of_friction_alone, a_contact_of_next_to_no_stiffness)
