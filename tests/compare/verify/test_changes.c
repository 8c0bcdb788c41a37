/* test_changes.c - the models with one mistake in them, by what the mistake makes of chain3: M = 1, C = 0.02 K, K =
 * [2 -1 0; -1 2 -1; 0 -1 2] with the eigenvalues 2 - sqrt(2), 2, 2 + sqrt(2); two sliders and a stop. */

#include "compare/verify/equations/changes.h"
#include "hbm/solver/system.h"
#include "numerics/random.h"
#include "tests/check.h"
#include "tests/compare/verify/curves.h"

enum { DOFS = 3, ENTRIES = DOFS * DOFS };
static const double rounding = 1e-13; /* some tens of operations on numbers of order 1 */

static model *of_case(const char *path)
{
  scene sc = curve_scene(path);
  CHECK_MADE(model, m, scene_model(&sc, &m));
  case_clear(&sc);
  return m;
}

static model *changed(const model *m, verify_change change, double factor, int which, verify_mistakes *mistakes)
{
  const verify_changed how = {change, factor, which};
  double offset[8];
  *mistakes = (verify_mistakes){0};
  assert_true(m->n_responses <= 8);
  CHECK_MADE(model, out, verify_changed_model(m, &how, true, &out, offset, mistakes));
  return out;
}

/* With M = 1 modal damping of one ratio z has C C = 4 z^2 K. Mode k has the ratio 0.01 omega_k, and z is their mean
 * times the factor. */
static void damping_of_one_ratio(CHECK_STATE)
{
  model *m = of_case("cases/structures/chain3.yaml");
  verify_mistakes none;
  model *theirs = changed(m, CHANGE_DAMPING_MODAL, 1.5, 0, &none);
  const double root = sqrt(2), mean = (sqrt(2 - root) + root + sqrt(2 + root)) / 3, z = 1.5 * 0.01 * mean;
  for (int i = 0; i < DOFS; ++i)
    for (int k = 0; k < DOFS; ++k) {
      double square = 0;
      for (int j = 0; j < DOFS; ++j) square += theirs->damping[i + DOFS * j] * theirs->damping[j + DOFS * k];
      CHECK_NEAR(square, 4 * z * z * m->stiffness[i + DOFS * k], rounding, "%d, %d", i, k);
    }
  assert_false(none.hysteretic);
  model_free(theirs);
  model_free(m);
}

/* trace C = 0.12 is that of 0.04 M and of 0.02 K; hysteretic damping is i C whose C is 0.02 K times the root of
 * trace K/trace M = 2, which is where the two dissipate the same. */
static void damping_of_a_matrix(CHECK_STATE)
{
  static const struct kind {
    verify_change change;
    bool of_mass, hysteretic;
    double share;
  } all[] = {{CHANGE_DAMPING_OF_M, true, false, 0.04},
             {CHANGE_DAMPING_OF_K, false, false, 0.02},
             {CHANGE_HYSTERETIC, false, true, 0.02 * 1.41421356237309505}};
  model *m = of_case("cases/structures/chain3.yaml"), *none;
  const verify_changed of_its_kind = {CHANGE_DAMPING_OF_K, 3, 0};
  double offset[8];
  verify_mistakes nothing = {0};
  assert_int_equal(verify_changed_model(m, &of_its_kind, true, &none, offset, &nothing), HC_BAD_INPUT);
  m->damping[0] += 0.02, m->damping[4] -= 0.02; /* no longer proportional to K, of the same trace */
  for (size_t a = 0; a < sizeof all / sizeof *all; ++a) {
    verify_mistakes mistakes;
    model *theirs = changed(m, all[a].change, 3, 0, &mistakes);
    const double *like = all[a].of_mass ? m->mass : m->stiffness;
    for (int i = 0; i < ENTRIES; ++i) CHECK_NEAR(theirs->damping[i], 3 * all[a].share * like[i], rounding, "%d", i);
    assert_int_equal(mistakes.hysteretic, all[a].hysteretic);
    model_free(theirs);
  }
  model_free(m);
}

/* Contacts are numbered from 1, 0 is all that rub: the stop does not. */
static void friction_of_the_other_sign(CHECK_STATE)
{
  static const unsigned turned[] = {3, 1, 2};
  model *m = of_case("cases/structures/chain3.yaml");
  verify_mistakes mistakes;
  double offset[8];
  for (int which = 0; which < 3; ++which) {
    model_free(changed(m, CHANGE_FRICTION_SIGN, 1, which, &mistakes));
    assert_int_equal(mistakes.turned, turned[which]);
    assert_int_equal(mistakes.mean, FRICTION_MEAN);
  }
  const verify_changed stop = {CHANGE_FRICTION_SIGN, 1, 3};
  model *theirs;
  mistakes = (verify_mistakes){0};
  assert_int_equal(verify_changed_model(m, &stop, true, &theirs, offset, &mistakes), HC_BAD_INPUT);
  model_free(changed(m, CHANGE_SLIDER_MEAN, 1, 0, &mistakes));
  assert_int_equal(mistakes.mean, FRICTION_MEAN_OF_U);
  model_free(changed(m, CHANGE_FRICTION_MEAN, 1, 0, &mistakes));
  assert_int_equal(mistakes.mean, FRICTION_NO_MEAN);
  assert_int_equal(mistakes.turned, 0);
  model_free(m);
}

/* t' = c t - s n, n' = s t + c n of the one contact, 20 degrees; the other's directions stay. */
static void a_contact_is_turned(CHECK_STATE)
{
  model *m = of_case("cases/structures/wedge_F10.yaml");
  verify_mistakes none;
  const double angle = 20 * 3.14159265358979324 / 180, c = cos(angle), s = sin(angle);
  model *theirs = changed(m, CHANGE_TURNED, 20, 2, &none);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < DOFS; ++i) {
      const double t = m->contacts[j].tangent[i], n = m->contacts[j].normal[i];
      CHECK_NEAR(theirs->contacts[j].tangent[i], j ? c * t - s * n : t, rounding, "%d, %d", j, i);
      CHECK_NEAR(theirs->contacts[j].normal[i], j ? s * t + c * n : n, rounding, "%d, %d", j, i);
    }
  model_free(theirs);
  model_free(m);
}

/* P K P of the permutation P, and the contacts' directions as they were. */
static void matrices_are_numbered_otherwise(CHECK_STATE)
{
  static const int place[DOFS] = {2, 1, 0}, first = 0, last = 2;
  model *m = of_case("cases/structures/chain3.yaml");
  verify_mistakes none;
  for (int i = 0; i < ENTRIES; ++i) m->mass[i] += 0.01 * i, m->damping[i] += 0.02 * i, m->stiffness[i] += 0.03 * i;
  model *theirs = changed(m, CHANGE_MATRICES_EXCHANGED, 1, 1 + DOFS * first + last, &none);
  for (int k = 0; k < DOFS; ++k)
    for (int i = 0; i < DOFS; ++i) {
      const int to = i + DOFS * k, from = place[i] + DOFS * place[k];
      assert_true(theirs->mass[to] == m->mass[from] && theirs->damping[to] == m->damping[from]);
      assert_true(theirs->stiffness[to] == m->stiffness[from]);
    }
  for (int j = 0; j < m->n_contacts; ++j)
    for (int i = 0; i < DOFS; ++i) assert_true(theirs->contacts[j].tangent[i] == m->contacts[j].tangent[i]);
  model_free(theirs);
  model_free(m);
}

/* dR/dX and dR/domega of the equations with a mistake plugged in, against central differences. Their error is about
 * rounding/step = 1e-11, and by X step^2 times a third derivative that grows towards transitions, of 1e5 at these
 * motions; odd harmonics alone leave no force in the others. */
static void plugged_equations_have_their_derivatives(CHECK_STATE)
{
  enum { H = 3, LENGTH = DOFS * (2 * H + 1) };
  static const verify_mistakes all[] = {{.odd_only = true},           {.mean_error = 1},          {.turned = 3},
                                        {.mean = FRICTION_MEAN_OF_U}, {.mean = FRICTION_NO_MEAN}, {.hysteretic = true}};
  const double omega = 1.3, step = 1e-5, by_X = 1e-4, tolerance = 1e-6;
  model *m = of_case("cases/structures/chain3.yaml");
  uint64_t seed = 3;
  for (size_t a = 0; a < sizeof all / sizeof *all; ++a) {
    verify_mistakes wrong = all[a];
    hbm_settings how = {.harmonics = H, .keep_mean = true};
    hbm_system sys;
    double X[LENGTH], d[LENGTH], Y[LENGTH], R[2][LENGTH], by_omega[LENGTH];
    static double jac[LENGTH * LENGTH];
    verify_plug_in(&wrong, &how);
    assert_int_equal(hbm_system_init(&sys, m, &how, H, 0, NULL), HC_OK);
    assert_int_equal(sys.n, LENGTH);
    for (int i = 0; i < LENGTH; ++i) X[i] = 0.4 * random_signed(&seed) / (1 + i / DOFS), d[i] = random_signed(&seed);
    for (int side = 0; side < 2; ++side) {
      for (int i = 0; i < LENGTH; ++i) Y[i] = X[i] + (side ? step : -step) * d[i];
      assert_int_equal(hbm_system_residual(&sys, omega, Y, R[side]), HC_OK);
    }
    assert_int_equal(hbm_system_residual(&sys, omega, X, Y), HC_OK);
    for (int i = 0; i < LENGTH && wrong.odd_only; ++i)
      if ((i / DOFS + 1) / 2 % 2 == 0) assert_true(sys.F[i] == 0);
    hbm_system_jacobian(&sys, omega, LENGTH, jac);
    hbm_system_domega(&sys, omega, X, by_omega);
    for (int i = 0; i < LENGTH; ++i) {
      double slope = 0;
      for (int k = 0; k < LENGTH; ++k) slope += jac[i + LENGTH * k] * d[k];
      CHECK_NEAR(slope, (R[1][i] - R[0][i]) / (2 * step), by_X, "mistake %zu, row %d", a, i);
    }
    for (int side = 0; side < 2; ++side)
      assert_int_equal(hbm_system_residual(&sys, omega + (side ? step : -step), X, R[side]), HC_OK);
    for (int i = 0; i < LENGTH; ++i)
      CHECK_NEAR(by_omega[i], (R[1][i] - R[0][i]) / (2 * step), tolerance, "mistake %zu, row %d", a, i);
    hbm_system_clear(&sys);
  }
  model_free(m);
}

CHECK_TESTS("verify.changes", 60, damping_of_one_ratio, damping_of_a_matrix, friction_of_the_other_sign,
            a_contact_is_turned, matrices_are_numbered_otherwise, plugged_equations_have_their_derivatives)
