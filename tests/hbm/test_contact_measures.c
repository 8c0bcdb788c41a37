/* test_contact_measures.c - what a contact does over a period: closed forms, and the balance of work of solutions. */
#include <float.h>

#include "hbm/hbm.h"
#include "numerics/norm.h"
#include "tests/hbm/random_structures.h"

enum { H = 9, LENGTH = 2 * H + 1 };

static contact_period measure(const contact *law, const double *u, const double *v)
{
  CHECK_FILLED(contact_period, out, contact_measures_of(law, H, u, v, &out));
  return out;
}

/* ---- closed forms -------------------------------------------------------------------------------- */

/* u = u0 + A cos(h th - phi) under constant N, R = mu N/kt < A: two slips of 2 (A - R) in each of h cycles, so work = 4
 * h mu N (A - R). The rounding of u, a few DBL_EPSILON (|u0| + A) at each of 4 h transitions, moves a transition, where
 * the slip begins or ends, and with it the path by as much; that of the integrals is relative. */
static void a_jenkins_element_loses_the_closed_form_work(CHECK_STATE)
{
  const double excess[] = {1e-8, 1e-3, 0.3, 5, 1000}, v[LENGTH] = {0};
  for (int i = 0; i < 5; ++i)
    for (int h = 1; h <= H; h += 4) {
      const contact law = {.kt = 20, .mu = 0.4, .load = 3};
      const double R = law.mu * law.load / law.kt, A = R * (1 + excess[i]), u0 = 0.7, phi = 0.4;
      double u[LENGTH] = {u0};
      u[2 * h - 1] = A * cos(phi), u[2 * h] = A * sin(phi);
      const contact_period p = measure(&law, u, v);
      const double path = 4 * h * R * excess[i], rounding = 4 * h * 8 * DBL_EPSILON * (u0 + A);
      assert_int_equal(p.regime, CONTACT_SLIPS);
      CHECK_NEAR(p.slip_distance, path, rounding, "A/R - 1 = %g, h = %d", excess[i], h);
      CHECK_NEAR(p.work, law.mu * law.load * path, law.mu * law.load * rounding, "A/R - 1 = %g", excess[i]);
      assert_true(p.traction_max == law.mu * law.load && p.normal_min == law.load && p.normal_max == law.load);
    }
}

/* Never at the limit, from w = 0: T = kt u, whose extremum kt (|u0| + A) is no angle of any grid. */
static void a_stuck_contact_does_no_work(CHECK_STATE)
{
  const contact law = {.kt = 20, .mu = 0.4, .kn = 50, .gap = 1};
  double u[LENGTH] = {-0.1}, v[LENGTH] = {0};
  u[9] = 0.2 * cos(1.1), u[10] = 0.2 * sin(1.1); /* 0.2 cos(5 th - 1.1) */
  v[13] = 0.3 * cos(0.2), v[14] = 0.3 * sin(0.2);
  const contact_period p = measure(&law, u, v);
  assert_int_equal(p.regime, CONTACT_STUCK);
  assert_true(p.work == 0 && p.slip_distance == 0);
  CHECK_NEAR(p.traction_max, 20 * 0.3, 8 * DBL_EPSILON * 6, "T");
  CHECK_NEAR(p.normal_min, 50 * 0.7, 8 * DBL_EPSILON * 65, "least N");
  CHECK_NEAR(p.normal_max, 50 * 1.3, 8 * DBL_EPSILON * 65, "most N");
}

/* v = V cos(th - phi), gap < 0, u = +-b v: w = u at touch-down, and kt b > mu kn makes it slip at once, forward while v
 * rises. From the top, v = V, it sticks: T = mu N_max - kt b (V - v) falls to -mu N where (kt b + mu kn) (V - v) = 2 mu
 * N_max; then it slips back until it lifts off. |dw| = (b - mu kn/kt) dv on the way up, over y = v + gap from 0 to c =
 * V + gap, and (b + mu kn/kt) |dv| on the way down, from y1 = c - 2 mu kn c/(kt b + mu kn) to 0; and mu N = mu kn y. */
static void a_contact_that_separates_loses_the_closed_form_work(CHECK_STATE)
{
  const contact law = {.kt = 100, .mu = 0.3, .kn = 60, .gap = -0.4};
  const double V = 1, phi = 0.77, b = 0.5;
  for (int s = -1; s <= 1; s += 2) {
    double u[LENGTH] = {0}, v[LENGTH] = {0};
    v[1] = V * cos(phi), v[2] = V * sin(phi);
    for (int i = 0; i < LENGTH; ++i) u[i] = s * b * v[i];
    const contact_period p = measure(&law, u, v);
    const double friction = law.mu * law.kn, c = V + law.gap;
    const double up = b - friction / law.kt, down = b + friction / law.kt;
    const double y1 = c - 2 * friction * c / (law.kt * b + friction);
    assert_int_equal(p.regime, CONTACT_SEPARATES);
    assert_true(p.normal_min == 0);
    CHECK_NEAR(p.normal_max, law.kn * c, 16 * DBL_EPSILON * law.kn, "N");
    CHECK_NEAR(p.traction_max, friction * c, 16 * DBL_EPSILON * law.kn, "T at the top");
    CHECK_NEAR(p.slip_distance, up * c + down * y1, 64 * DBL_EPSILON, "path"); /* of numbers of the order of 1 */
    CHECK_NEAR(p.work, friction * (up * c * c + down * y1 * y1) / 2, 64 * DBL_EPSILON * friction, "work");
  }
}

/* A closed unilateral spring, and an open contact: no friction, no traction, no work. */
static void without_friction_there_is_no_traction(CHECK_STATE)
{
  const contact spring = {.kn = 50, .gap = 2}, smooth = {.kn = 50, .kt = 10, .gap = 2}, apart = {.kn = 50, .gap = -2};
  double v[LENGTH] = {0, 1}, u[LENGTH] = {0, 3};
  contact_period p = measure(&spring, u, v);
  assert_true(p.regime == CONTACT_STUCK && p.traction_max == 0 && p.work == 0 && p.slip_distance == 0);
  CHECK_NEAR(p.normal_min, 50, 50 * 8 * DBL_EPSILON, "N");
  p = measure(&smooth, u, v);
  assert_true(p.traction_max == 0 && p.work == 0);
  p = measure(&apart, u, v);
  assert_true(p.regime == CONTACT_LINEAR && p.normal_max == 0 && p.normal_min == 0);
}

static void what_is_no_motion_is_refused(CHECK_STATE)
{
  const contact law = {.kn = 50, .gap = 2};
  double u[LENGTH] = {0}, v[LENGTH] = {0};
  contact_period out;
  assert_int_equal(contact_measures_of(&law, 0, u, v, &out), HC_BAD_INPUT);
  v[3] = NAN;
  assert_int_equal(contact_measures_of(&law, H, u, v, &out), HC_NOT_FINITE);
  v[3] = 0, u[4] = 1e141;
  assert_int_equal(contact_measures_of(&law, H, u, v, &out), HC_NOT_FINITE);
}

/* ---- the balance of work --------------------------------------------------------------------------- */

/* d, where it is not 0: one DOF, or one minus another. Of such directions the Gram determinant is an integer: they are
 * dependent or far from it. */
static void make_plain(uint64_t *seed, int n, double *d)
{
  if (norm_2(n, d) == 0) return;
  memset(d, 0, (size_t)n * sizeof *d);
  d[random_int(seed, 0, n - 1)] = -1;
  d[random_int(seed, 0, n - 1)] = 1;
}

enum { MOST_N = 8, MOST_CONTACTS = 5, MOST_X = LENGTH * (2 * MOST_CONTACTS + 1) };

/* closed integral x' . C dx = pi omega sum h^2 (a . C a + b . C b), for a symmetric C. */
static double damped(const model *m, double omega, double (*x)[LENGTH])
{
  double sum = 0;
  for (int c = 1; c < LENGTH; ++c)
    for (int i = 0; i < m->n; ++i)
      for (int k = 0; k < m->n; ++k)
        sum += PI * omega * ((c + 1) / 2) * ((c + 1) / 2) * x[i][c] * m->damping[k * m->n + i] * x[k][c];
  return sum;
}

/* The equations, multiplied by x' and integrated: input = C's share + sum of closed integrals T_j du_j, with no
 * truncation error, for x has the harmonics of the equations alone, and a normal force does no work over a period. A
 * residual of 1e-13 of the forces that make it up leaves as much of the work of each of them; those of K and M exceed
 * the input by the quality of the resonance, of the order of 10 at most, so 1e-12 of the input. (Of directions drawn at
 * random some are nearly dependent, and x is recovered with as many digits less.) */
static void what_goes_in_is_dissipated(CHECK_STATE)
{
  uint64_t seed = 4;
  int solved = 0, slipped = 0, opened = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const int n = random_int(&seed, 1, MOST_N), n_contacts = random_int(&seed, 1, MOST_CONTACTS);
    model *drawn = random_structure(&seed, n, n_contacts), *m;
    assert_int_equal(model_copy_all_seen(drawn, &m), HC_OK);
    model_free(drawn);
    for (int j = 0; j < n_contacts; ++j) {
      make_plain(&seed, n, m->contacts[j].tangent);
      make_plain(&seed, n, m->contacts[j].normal);
    }
    const hbm_settings how = {.harmonics = H,
                              .keep_mean = true,
                              .force = HBM_FORCE_EXACT,
                              .tolerance = 1e-14,
                              .accuracy = 1e-4,
                              .skip_linear = trial % 2};
    const double omega = 3 + 9 * random_unit(&seed);
    double X[MOST_X] = {0}, x[MOST_N][LENGTH], work = 0;
    hbm_point point;
    contact_period period[MOST_CONTACTS];
    CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &how, &s));
    if (hbm_first_solution(s, omega, NULL, X, &point) == HC_OK && point.residual <= 1e-13) {
      for (int i = 0; i < n; ++i) assert_int_equal(hbm_response(s, omega, X, i, x[i]), HC_OK);
      assert_int_equal(hbm_measure_contacts(s, omega, X, period), HC_OK);
      for (int j = 0; j < n_contacts; ++j) {
        assert_true(period[j].normal_min <= period[j].normal_max && period[j].work >= 0);
        work += period[j].work;
        slipped += period[j].work > 0;
        opened += period[j].regime == CONTACT_SEPARATES;
      }
      /* closed integral p . dx over a period: load k does pi k (p_k . b_k - q_k . a_k), x = a cos + b sin. */
      double in = 0;
      for (int l = 0; l < m->n_loads; ++l) {
        const int k = m->loads[l].harmonic;
        for (int i = 0; i < m->n && k > 0; ++i)
          in += PI * k * (m->loads[l].cosine[i] * x[i][2 * k] - m->loads[l].sine[i] * x[i][2 * k - 1]);
      }
      CHECK_NEAR(in, work + damped(m, omega, x), 1e-12 * in, "trial %d, n = %d, friction %g", trial, n, work / in);
      ++solved;
    }
    hbm_solver_free(s);
    model_free(m);
  }
  assert_true(solved > 80 && slipped > 80 && opened > 40);
}

CHECK_TESTS("hbm.contact_measures", 60, a_jenkins_element_loses_the_closed_form_work, a_stuck_contact_does_no_work,
            a_contact_that_separates_loses_the_closed_form_work, without_friction_there_is_no_traction,
            what_is_no_motion_is_refused, what_goes_in_is_dissipated)
