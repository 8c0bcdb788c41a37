/* test_structure.c - harmonic balance of structures drawn at random: the Jacobian is the derivative, and another way to
 * write the same structure changes nothing. */
#include "hbm/hbm.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "tests/hbm/random_structures.h"

enum { MOST = 4000 };

static hbm_settings settings(int harmonics)
{
  return (hbm_settings){.harmonics = harmonics,
                        .keep_mean = true,
                        .force = HBM_FORCE_EXACT,
                        .samples = 256,
                        .tolerance = 1e-13,
                        .accuracy = 1e-4,
                        .skip_linear = true};
}

/* ---- the Jacobian ------------------------------------------------------------------------------- */

static void random_state(uint64_t *seed, const hbm_system *sys, double *X)
{
  for (int c = 0; c < 2 * sys->n_harm + 1; ++c)
    for (int d = 0; d < sys->dim; ++d) X[c * sys->dim + d] = 0.3 * random_signed(seed) / (1 + c * c / 4.0);
}

/* (R(X + h V, omega + h w) - R(X - h V, omega - h w))/(2 h); false where the order of states changes on the way. */
static bool difference(hbm_system *sys, double omega, double w, const double *X, const double *V, double h, double *D)
{
  static double Y[MOST], plus[MOST], minus[MOST];
  const int transitions = sys->report.transitions;
  memcpy(Y, X, (size_t)sys->n_coef * sizeof *Y);
  for (int i = 0; i < sys->n; ++i) Y[sys->first + i] = X[sys->first + i] + h * V[i];
  assert_int_equal(hbm_system_residual(sys, omega + h * w, Y, plus), HC_OK);
  bool same = sys->report.transitions == transitions;
  for (int i = 0; i < sys->n; ++i) Y[sys->first + i] = X[sys->first + i] - h * V[i];
  assert_int_equal(hbm_system_residual(sys, omega - h * w, Y, minus), HC_OK);
  same &= sys->report.transitions == transitions;
  for (int i = 0; i < sys->n; ++i) D[i] = (plus[i] - minus[i]) / (2 * h);
  return same;
}

/* Along a random direction of (X, omega). Extrapolated central differences of 1e-4 and 2e-4 are good to h^4 times fifth
 * derivatives, of the order of 1e-10 of the forces, and rounding of forces over h, 1e-11; where high derivatives are
 * larger, as near a graze, those of 2e-4 and 4e-4 tell, and the direction is passed over. */
static bool jacobian_matches(hbm_system *sys, uint64_t *seed, double omega, const double *X, double *worst)
{
  static double V[MOST], D[3][MOST], R[MOST], by_omega[MOST], jac[MOST * 400];
  const double h = 1e-4, w = random_signed(seed);
  bool same = true;
  double scale = 0, apart = 0, off = 0;
  random_state(seed, sys, V);
  assert_true(sys->n <= 400);
  assert_int_equal(hbm_system_residual(sys, omega, X, R), HC_OK);
  for (int k = 0; k < 3; ++k) {
    assert_int_equal(hbm_system_residual(sys, omega, X, R), HC_OK);
    same &= difference(sys, omega, w, X, V, ldexp(h, k), D[k]);
  }
  assert_int_equal(hbm_system_residual(sys, omega, X, R), HC_OK);
  hbm_system_jacobian(sys, omega, sys->n, jac);
  hbm_system_domega(sys, omega, X, by_omega);
  for (int i = 0; i < sys->n; ++i) {
    double J = by_omega[i] * w;
    for (int q = 0; q < sys->n; ++q) J += jac[q * sys->n + i] * V[q];
    const double fine = (4 * D[0][i] - D[1][i]) / 3, coarse = (4 * D[1][i] - D[2][i]) / 3;
    scale = larger(scale, fabs(J));
    apart = fmax(apart, fabs(fine - coarse));
    off = larger(off, fabs(fine - J));
  }
  if (!same || apart > 1e-7 * scale) return false;
  *worst = larger(*worst, off / scale);
  return true;
}

/* The most that was compared, and how many structures whose contacts' directions are dependent: as coordinates there
 * are fewer than directions and than DOFs. */
typedef struct reach_of {
  int n, contacts, harmonics, deficient, without_mean;
} reach_of;

static void reach(reach_of *most, const model *m, const hbm_system *sys)
{
  int directions = 1; /* the first response's */
  for (int j = 0; j < m->n_contacts; ++j) directions += (m->contacts[j].law.kt > 0) + (m->contacts[j].law.kn > 0);
  if (m->n > most->n) most->n = m->n;
  if (m->n_contacts > most->contacts) most->contacts = m->n_contacts;
  if (sys->n_harm > most->harmonics) most->harmonics = sys->n_harm;
  most->without_mean += sys->first > 0;
  most->deficient += sys->dim < directions && sys->dim < m->n;
}

/* To n = 30 with 12 contacts, H to 20; every tenth without harmonic 0. Of sampled forces the same. */
static void jacobian_is_the_derivative(CHECK_STATE)
{
  uint64_t seed = 11;
  int compared[2] = {0}, tried[2] = {0};
  reach_of reached = {0};
  double worst = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const bool large = trial % 40 == 4; /* the most there is */
    const int n = large ? 30 : random_int(&seed, 2, trial % 4 ? 8 : 30);
    const int contacts = large ? 12 : random_int(&seed, 1, trial % 4 ? 5 : 12);
    const int H = trial % 40 == 1 ? 20 : random_int(&seed, 1, trial % 8 == 1 ? 20 : 4), sampled = trial % 3 == 2;
    model *m = random_structure(&seed, n, contacts);
    hbm_settings how = settings(H);
    double X[MOST];
    how.keep_mean = trial % 10 != 0;
    how.force = sampled ? HBM_FORCE_SAMPLED : HBM_FORCE_EXACT;
    CHECK_FILLED(hbm_system, sys, hbm_system_init(&sys, m, &how, H, 256, NULL));
    assert_true(sys.dim <= n && sys.dim <= 2 * contacts + 1);
    for (int k = 0; k < 3 && sys.n <= 400; ++k) {
      random_state(&seed, &sys, X);
      for (int i = 0; i < sys.first; ++i) X[i] = 0;
      const bool told = jacobian_matches(&sys, &seed, 3 + 9 * random_unit(&seed), X, &worst);
      compared[sampled] += told;
      ++tried[sampled];
      if (told) reach(&reached, m, &sys);
    }
    hbm_system_clear(&sys);
    model_free(m);
  }
  CHECK_LE(worst, 1e-8, "Jacobian");
  assert_true(reached.n == 30 && reached.contacts == 12 && reached.harmonics == 20);
  assert_true(reached.deficient > 20 && reached.without_mean > 10);
  assert_true(compared[0] > tried[0] / 2 && compared[1] > tried[1] / 4);
}

/* ---- the same structure in other words ------------------------------------------------------------ */

/* The first solution at omega: its responses' series x[2][2H+1]. False where none is found. */
static bool solve(const model *m, int H, double omega, double (*x)[2 * 20 + 1], contact_regime *regime)
{
  const hbm_settings how = settings(H);
  hbm_point point;
  hbm_measures measures;
  static double X[MOST];
  CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &how, &s));
  const bool found = hbm_first_solution(s, omega, NULL, X, &point) == HC_OK;
  for (int r = 0; r < 2 && found; ++r) assert_int_equal(hbm_response(s, omega, X, r, x[r]), HC_OK);
  if (found) assert_int_equal(hbm_measure(s, X, &measures), HC_OK);
  if (found) *regime = measures.contact.regime;
  hbm_solver_free(s);
  return found;
}

static void check_the_same(int H, double (*x)[41], double (*y)[41], double tolerance, const char *what)
{
  double size = 0, off = 0;
  for (int r = 0; r < 2; ++r)
    for (int c = 0; c < 2 * H + 1; ++c) {
      size = larger(size, fabs(x[r][c]));
      off = larger(off, fabs(x[r][c] - y[r][c]));
    }
  CHECK_LE(off, tolerance * size, "%s", what);
}

static void random_permutation(uint64_t *seed, int n, double *Q)
{
  int at[64];
  for (int i = 0; i < n; ++i) at[i] = i;
  for (int i = n - 1; i > 0; --i) {
    const int k = random_int(seed, 0, i), kept = at[i];
    at[i] = at[k];
    at[k] = kept;
  }
  for (int i = 0; i < n * n; ++i) Q[i] = 0;
  for (int j = 0; j < n; ++j) Q[j * n + at[j]] = 1;
}

/* x = 1000 x': lengths in thousandths. Forces stay. */
static model *in_other_units(const model *m)
{
  const double length = 1000;
  CHECK_MADE(model, u, model_copy(m, &u));
  for (int i = 0; i < m->n * m->n; ++i) u->mass[i] /= length, u->damping[i] /= length, u->stiffness[i] /= length;
  for (int j = 0; j < m->n_contacts; ++j) {
    u->contacts[j].law.kt /= length;
    u->contacts[j].law.kn /= length;
    u->contacts[j].law.gap *= length;
  }
  return u;
}

/* Every contact twice, of half the stiffness and load. */
static model *with_contacts_split(const model *m)
{
  const size_t vector = (size_t)m->n * sizeof(double);
  CHECK_MADE(model, s, model_copy_sized(m, 2 * m->n_contacts, m->n_responses, &s));
  for (int j = 0; j < 2 * m->n_contacts; ++j) {
    const model_contact *of = &m->contacts[j / 2];
    s->contacts[j].law = of->law;
    s->contacts[j].law.kt /= 2, s->contacts[j].law.kn /= 2, s->contacts[j].law.load /= 2;
    memcpy(s->contacts[j].tangent, of->tangent, vector);
    memcpy(s->contacts[j].normal, of->normal, vector);
  }
  return s;
}

/* 1e-11 of the largest coefficient: rounding of the change of coordinates, n^2 units, times the condition of the
 * equations, which for these structures is below 1e4. */
static void another_way_to_write_it_changes_nothing(CHECK_STATE)
{
  uint64_t seed = 5;
  int solved = 0, separated = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const int n = random_int(&seed, 2, 12), H = random_int(&seed, 1, 7);
    const double omega = 3 + 12 * random_unit(&seed);
    double Q[64 * 64], x[2][41], y[2][41];
    contact_regime regime, other;
    model *m = random_structure(&seed, n, random_int(&seed, 1, 5));
    if (solve(m, H, omega, x, &regime)) {
      ++solved;
      separated += regime == CONTACT_SEPARATES;
      /* An orthogonal matrix: Householder's reflection by a random vector, after another. */
      double A[64 * 64];
      for (int i = 0; i < n * n; ++i) Q[i] = i % (n + 1) == 0;
      for (int k = 0; k < 2; ++k) {
        double v[64], size = 0;
        for (int i = 0; i < n; ++i) v[i] = random_signed(&seed), size += v[i] * v[i];
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i) {
            A[j * n + i] = Q[j * n + i];
            for (int l = 0; l < n; ++l) A[j * n + i] -= 2 / size * v[i] * v[l] * Q[j * n + l];
          }
        memcpy(Q, A, (size_t)(n * n) * sizeof *Q);
      }
      model *turned = turned_structure(m, Q);
      random_permutation(&seed, n, Q);
      model *permuted = turned_structure(m, Q), *scaled = in_other_units(m), *split = with_contacts_split(m);
      assert_true(solve(turned, H, omega, y, &other));
      check_the_same(H, x, y, 1e-11, "rotated");
      assert_true(solve(permuted, H, omega, y, &other));
      check_the_same(H, x, y, 1e-11, "permuted");
      assert_true(solve(split, H, omega, y, &other));
      check_the_same(H, x, y, 1e-11, "contacts split");
      assert_true(solve(scaled, H, omega, y, &other));
      for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 2 * H + 1; ++c) y[r][c] /= 1000;
      check_the_same(H, x, y, 1e-11, "other units");
      model_free(turned);
      model_free(permuted);
      model_free(scaled);
      model_free(split);
    }
    model_free(m);
  }
  assert_true(solved > 50 && separated > 15);
}

/* Case 2 of the paper, n times, coupled by nothing: each is case 2 alone. Newton starts next to that: along a path all
 * of them would turn at once, and no single tangent is left. */
static void copies_are_each_the_one(CHECK_STATE)
{
  enum { COPIES = 4 };
  double x[2][41], y[2][41];
  const contact law = {.kt = 100, .kn = 1000, .mu = 0.3, .gap = -5};
  CHECK_MADE(model, one, model_oscillator(1, 0.4, 40, 100, 1, &one));
  CHECK_MADE(model, many, model_new(COPIES, 1, COPIES, 2, &many));
  one->contacts[0].law = law;
  model_direction(45, one->contacts[0].tangent, one->contacts[0].normal);
  many->loads[0].harmonic = 1;
  for (int i = 0; i < COPIES; ++i) {
    many->mass[i * (COPIES + 1)] = 1;
    many->damping[i * (COPIES + 1)] = 0.4;
    many->stiffness[i * (COPIES + 1)] = 40;
    many->loads[0].cosine[i] = 100;
    many->contacts[i].law = law;
    model_direction(45, many->contacts[i].tangent + i, many->contacts[i].normal + i);
  }
  many->responses[0] = many->responses[COPIES + 2] = 1;
  const hbm_settings how = settings(10);
  for (double omega = 5.5; omega < 9; omega += 0.5) {
    double X[21], all[COPIES * 21];
    CHECK_MADE(hbm_solver, s, hbm_solver_new(one, &how, &s));
    CHECK_FILLED(hbm_point, point, hbm_first_solution(s, omega, NULL, X, &point));
    hbm_solver_free(s);
    for (int c = 0; c < 21; ++c) {
      x[0][c] = x[1][c] = X[c];
      for (int i = 0; i < COPIES; ++i) all[c * COPIES + i] = (1 + 1e-3 * (i + 1)) * X[c];
    }
    assert_int_equal(hbm_solver_new(many, &how, &s), HC_OK);
    assert_int_equal(hbm_n_coefficients(s), COPIES * 21);
    assert_int_equal(hbm_solve(s, omega, all, &point), HC_OK);
    for (int r = 0; r < 2; ++r) assert_int_equal(hbm_response(s, omega, all, r, y[r]), HC_OK);
    hbm_solver_free(s);
    check_the_same(10, x, y, 1e-12, "copies");
  }
  model_free(one);
  model_free(many);
}

/* Two bodies that nothing couples; forces on the first, its gap and its preload are `size` times as large. */
static model *two_bodies(double size)
{
  const contact law = {.kt = 30, .mu = 0.5, .load = 1.2};
  CHECK_MADE(model, m, model_new(2, 1, 2, 1, &m));
  m->loads[0].harmonic = 1;
  m->responses[0] = 1;
  for (int i = 0; i < 2; ++i) {
    const double times = i ? 1 : size;
    m->mass[3 * i] = 1;
    m->stiffness[3 * i] = 100 + 20 * i;
    m->damping[3 * i] = 0.2;
    m->loads[0].cosine[i] = times;
    m->contacts[i].law = law;
    m->contacts[i].law.load *= times;
    m->contacts[i].tangent[i] = 1;
  }
  return m;
}

/* At the tolerance that users have, 1e-10: were a row compared with the forces on all bodies, the small one would be
 * left as its guess was. 2.2e-13 of the largest force, the least that a row is compared with times the tolerance, is
 * 2.2e-7 of its own; with the last Newton step its square. */
static void a_small_body_beside_a_large_one(CHECK_STATE)
{
  enum { HARMONICS = 5 };
  const double size = 1e-6;
  model *alike = two_bodies(1), *unlike = two_bodies(size);
  hbm_settings how = settings(HARMONICS);
  how.tolerance = 1e-10;
  for (double omega = 9.3; omega < 12; omega += 0.4) {
    double x[2][2 * (2 * HARMONICS + 1)];
    for (int k = 0; k < 2; ++k) {
      CHECK_MADE(hbm_solver, s, hbm_solver_new(k ? unlike : alike, &how, &s));
      CHECK_FILLED(hbm_point, point, hbm_first_solution(s, omega, NULL, x[k], &point));
      hbm_solver_free(s);
    }
    for (int c = 0; c <= 2 * HARMONICS; ++c)
      CHECK_NEAR(x[1][2 * c], size * x[0][2 * c], 1e-12 * size, "omega %g, coefficient %d", omega, c);
  }
  model_free(alike);
  model_free(unlike);
}

/* 50 x + 100 (x - 0.1) = 20: x = 0.2, N = 10; a stop at 1 is out of reach. */
static void contacts_at_rest(CHECK_STATE)
{
  double N[2];
  const hbm_settings how = settings(1);
  CHECK_MADE(model, m, model_new(2, 1, 2, 1, &m));
  m->mass[0] = m->mass[3] = 1;
  m->stiffness[0] = m->stiffness[3] = 50;
  m->loads[0].cosine[0] = 20;
  for (int j = 0; j < 2; ++j) {
    m->contacts[j].law = (contact){.kn = 100, .gap = j ? -1 : -0.1};
    m->contacts[j].normal[0] = 1;
  }
  m->responses[0] = 1;
  CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &how, &s));
  assert_int_equal(hbm_preloads(s, N), HC_OK);
  CHECK_NEAR(N[0], 10, 1e-13, "pressed on");
  CHECK_NEAR(N[1], 0, 0, "out of reach");
  hbm_solver_free(s);
  model_free(m);
}

/* A load of harmonic 5 and one of 1: auto keeps five harmonics from the first point on, and nowhere fewer. */
static void auto_keeps_the_loads(CHECK_STATE)
{
  uint64_t seed = 3;
  model *m = random_structure(&seed, 3, 1);
  hbm_settings how = settings(HBM_AUTO);
  hbm_curve curve = {0};
  how.accuracy = 1e-2; /* met by fewer */
  m->loads[0].harmonic = 5;
  for (int i = 0; i < m->n; ++i) m->loads[0].cosine[i] *= 1e-3; /* too little to keep them for */
  CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &how, &s));
  assert_int_equal(hbm_trace(s, 20, 40, NULL, &curve), HC_OK);
  for (int k = 0; k < curve.n; ++k) assert_true(curve.points[k].harmonics >= 5);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  model_free(m);
}

CHECK_TESTS("hbm.structure", 120, jacobian_is_the_derivative, another_way_to_write_it_changes_nothing,
            copies_are_each_the_one, contacts_at_rest, auto_keeps_the_loads, a_small_body_beside_a_large_one)
