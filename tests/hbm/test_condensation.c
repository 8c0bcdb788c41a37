/* test_condensation.c - a large structure seen from its contacts, however it is damped: held against the structure's
 * own equations, solved whole by LU, in which nothing is condensed and no modes are taken. */
#include "hbm/structure/condensation.h"
#include "numerics/dense.h"
#include "tests/hbm/random_structures.h"

enum { N = 60, CONTACTS = 3, H = 5, DIM = 8 };

typedef enum damping { RAYLEIGH, MODAL, LOCAL, ANY, GYROSCOPIC, DAMPINGS } damping;
static const char *const names[] = {"Rayleigh", "modal", "dashpots beside Rayleigh", "any", "gyroscopic"};

/* Natural frequencies from 4 to 300. */
static model *large_structure(uint64_t *seed, damping how)
{
  model *m = random_structure(seed, N, CONTACTS);
  m->loads[1].harmonic = 2;
  m->loads[1].inertial = true;
  for (int j = 0; j < N; ++j)
    for (int i = 0; i < N; ++i) m->stiffness[j * N + i] *= (1 + i / 2.0) * (1 + j / 2.0);
  for (int j = 0; j < N; ++j) /* but for rounding it is */
    for (int i = 0; i < j; ++i) m->stiffness[j * N + i] = m->stiffness[i * N + j];
  for (int i = 0; i < N * N && how != ANY; ++i) m->damping[i] = 0.1 * m->mass[i] + 1e-3 * m->stiffness[i];
  /* M Phi diag(2 z omega) Phi^T M, a ratio of its own for each mode. */
  if (how == MODAL) {
    double lambda[N], *phi = malloc(4 * N * N * sizeof *phi), *P = phi + N * N, *turned = P + N * N;
    assert_int_equal(dense_modes(N, m->stiffness, m->mass, lambda, phi), HC_OK);
    dense_multiply(N, N, N, m->mass, phi, P);
    for (int k = 0; k < N; ++k) {
      const double share = sqrt(2 * (0.005 + 0.02 * random_unit(seed)) * sqrt(lambda[k]));
      for (int i = 0; i < N; ++i) P[k * N + i] *= share;
    }
    dense_transpose(N, N, P, turned);
    dense_multiply(N, N, N, P, turned, m->damping);
    free(phi);
  }
  if (how == LOCAL) m->damping[7 * (N + 1)] += 300, m->damping[N * N - 1] += 5; /* overdamped: real poles, too */
  for (int k = 0; k < 10 && how == GYROSCOPIC; ++k) {
    const int i = random_int(seed, 0, N - 2);
    m->damping[i + 1 + N * i] += 2, m->damping[i + N * (i + 1)] -= 2;
  }
  return m;
}

static double complex dot_complex(const double *a, const double complex *x, int n)
{
  double complex sum = 0;
  for (int i = 0; i < n; ++i) sum += a[i] * x[i];
  return sum;
}

/* x of harmonic h under the loads and contact forces T, N: Z x = p - sum t T + n N. */
static void solve_whole(const model *m, double omega, double more, int h, const double complex *T,
                        const double complex *force, double complex *x)
{
  double complex *Z = malloc(N * N * sizeof *Z);
  int pivot[N];
  double trace = 0;
  const double w = h * omega;
  for (int i = 0; i < N; ++i) trace += m->mass[i * (N + 1)];
  for (int i = 0; i < N * N; ++i)
    Z[i] = m->stiffness[i] - w * w * m->mass[i] + I * w * (m->damping[i] + more * N / trace * m->mass[i]);
  for (int i = 0; i < N; ++i) {
    x[i] = 0;
    for (int l = 0; l < m->n_loads; ++l)
      if (m->loads[l].harmonic == h)
        x[i] += (m->loads[l].inertial ? omega * omega : 1) * (m->loads[l].cosine[i] - I * m->loads[l].sine[i]);
    for (int j = 0; j < CONTACTS; ++j) x[i] -= m->contacts[j].tangent[i] * T[j] + m->contacts[j].normal[i] * force[j];
  }
  assert_int_equal(dense_factor_complex(N, Z, pivot), HC_OK);
  dense_solve_complex(N, Z, pivot, false, 1, x);
  free(Z);
}

static double complex random_complex(uint64_t *seed)
{
  const double re = random_signed(seed);
  return re + I * random_signed(seed);
}

/* q of S q = p - F for random contact forces has the contacts' motions and the responses of x. All of it is linear:
 * rounding, sqrt(60) units, is multiplied by the condition of Z (1e4: frequencies from 4 to 300): 1.7e-11 of the
 * motion, with whichever BLAS. */
static void check_harmonic(uint64_t *seed, const model *m, condensation *c, double omega, double more, int h,
                           const char *what)
{
  double complex T[CONTACTS], force[CONTACTS], x[N], q[DIM], S[DIM * DIM], row[DIM], rest;
  const int dim = condensation_dim(c);
  int pivot[DIM];
  double off = 0, size = 0;
  for (int j = 0; j < CONTACTS; ++j) T[j] = 5 * random_complex(seed), force[j] = 5 * random_complex(seed);
  for (int j = 0; j < CONTACTS && h == 0; ++j) T[j] = creal(T[j]), force[j] = creal(force[j]);
  solve_whole(m, omega, more, h, T, force, x);
  memcpy(S, condensation_stiffness(c, h), (size_t)(dim * dim) * sizeof *S);
  for (int d = 0; d < dim; ++d) {
    q[d] = 0;
    for (int l = 0; l < m->n_loads; ++l)
      if (m->loads[l].harmonic == h) q[d] += condensation_load(c, l)[d];
    for (int j = 0; j < CONTACTS; ++j)
      q[d] -= condensation_tangent(c, j)[d] * T[j] + condensation_normal(c, j)[d] * force[j];
  }
  assert_int_equal(dense_factor_complex(dim, S, pivot), HC_OK);
  dense_solve_complex(dim, S, pivot, false, 1, q);
  for (int j = 0; j < CONTACTS; ++j) {
    const double complex u = dot_complex(m->contacts[j].tangent, x, N), v = dot_complex(m->contacts[j].normal, x, N);
    off = larger(off, cabs(dot_complex(condensation_tangent(c, j), q, dim) - u));
    off = larger(off, cabs(dot_complex(condensation_normal(c, j), q, dim) - v));
    size = fmax(size, fmax(cabs(u), cabs(v)));
  }
  for (int r = 0; r < m->n_responses; ++r) {
    const double complex whole = dot_complex(m->responses + r * N, x, N);
    condensation_response(c, h, r, 1, row, &rest);
    for (int d = 0; d < dim; ++d) rest += row[d] * q[d];
    off = larger(off, cabs(rest - whole));
    size = fmax(size, cabs(whole));
  }
  CHECK_LE(off, 1.7e-11 * size, "%s, omega %g, D %g, harmonic %d", what, omega, more, h);
}

/* Low omegas, where most modes come in by the series, high ones, where none does, and the series made anew. */
static void condensed_is_the_whole(CHECK_STATE)
{
  uint64_t seed = 4;
  const double omegas[] = {0.3, 0.35, 1, 4.4, 7, 30, 0.1, 70};
  for (int how = 0; how < DAMPINGS; ++how) {
    model *m = large_structure(&seed, how);
    CHECK_MADE(condensation, c, condensation_new(m, H, &c));
    assert_in_range(condensation_dim(c), 2, DIM);
    for (size_t k = 0; k < sizeof omegas / sizeof *omegas; ++k)
      for (int ramp = 0; ramp < 2; ++ramp) {
        assert_int_equal(condensation_at(c, omegas[k], 2 * ramp), HC_OK);
        const bool poles = how != RAYLEIGH && how != MODAL; /* are those of D = 0 */
        for (int h = 1; h <= H; ++h) assert_int_equal(condensation_is_by_modes(c, h), !(poles && ramp));
        for (int h = 0; h <= H; ++h) check_harmonic(&seed, m, c, omegas[k], 2 * ramp, h, names[how]);
      }
    condensation_free(c);
    model_free(m);
  }
}

/* The tangent of one contact is that of another but for a part of 1e-6: the forces that hold q are of the size of the
 * structure's own, not 1e12 times as large, and the coordinates are as good as others (check_harmonic's bound). With
 * rows no shorter than 0.1 of their own, P is at most of that order for each of the DIM. */
static void nearly_dependent_directions(CHECK_STATE)
{
  uint64_t seed = 11;
  model *m = large_structure(&seed, RAYLEIGH);
  double largest = 0, size = 0;
  for (int i = 0; i < N; ++i) m->contacts[1].tangent[i] = m->contacts[0].tangent[i] + 1e-6 * m->contacts[1].tangent[i];
  CHECK_MADE(condensation, c, condensation_new(m, H, &c));
  const int dim = condensation_dim(c);
  assert_int_equal(condensation_at(c, 4.4, 0), HC_OK);
  for (int i = 0; i < N * N; ++i) largest = fmax(largest, fabs(m->stiffness[i]));
  for (int i = 0; i < dim * dim; ++i) size = larger(size, condensation_sizes(c, 0)[i]);
  CHECK_LE(size, 1e4 * largest, "static stiffness of q");
  for (int h = 0; h <= H; ++h) check_harmonic(&seed, m, c, 4.4, 0, h, "nearly dependent");
  condensation_free(c);
  model_free(m);
}

typedef enum by { BY_OMEGA, BY_DAMPING } by;

static condensation_change change_of(const condensation *c, by what, int h)
{
  return what == BY_OMEGA ? condensation_by_omega(c, h) : condensation_by_damping(c, h);
}

static void values_at(condensation *c, by what, double at, int h, double complex *S, double complex *p)
{
  const int dim = condensation_dim(c);
  assert_int_equal(condensation_at(c, what == BY_OMEGA ? at : 6, what == BY_OMEGA ? 0 : at), HC_OK);
  memcpy(S, condensation_stiffness(c, h), (size_t)(dim * dim) * sizeof *S);
  memcpy(p, condensation_load(c, 1), (size_t)dim * sizeof *p);
}

/* The derivative of values[n] by central differences of h and 2 h, extrapolated: off by h^4 f^(5)/4 and rounding/h. */
static double worst_difference(int n, const double complex *d, double h, double complex (*f)[DIM * DIM])
{
  double off = 0, size = 0;
  for (int i = 0; i < n; ++i) {
    const double complex fine = (f[1][i] - f[0][i]) / (2 * h), coarse = (f[3][i] - f[2][i]) / (4 * h);
    off = larger(off, cabs((4 * fine - coarse) / 3 - d[i]));
    size = fmax(size, cabs(d[i]));
  }
  return off / size;
}

/* A resonance at 6, half as wide as d = 0.06 or more, makes f^(5) = 120 f'/d^4: h = 3e-4 errs by 4 (h/d)^4 = 3e-9 next
 * to one, and rounding of 1e-13 of S over h by 3e-10 of S: less than 1e-7 in all. */
static void changes_are_derivatives(CHECK_STATE)
{
  uint64_t seed = 8;
  const double h = 3e-4;
  for (int how = 0; how < DAMPINGS; ++how)
    for (by what = BY_OMEGA; what <= BY_DAMPING; ++what) {
      model *m = large_structure(&seed, how);
      double complex S[4][DIM * DIM], p[4][DIM * DIM], dS[DIM * DIM], dp[DIM];
      const double start = what == BY_OMEGA ? 6 : 1;
      CHECK_MADE(condensation, c, condensation_new(m, H, &c));
      const int dim = condensation_dim(c);
      for (int k = 0; k < 4; ++k) values_at(c, what, start + (k % 2 ? h : -h) * (k / 2 + 1), 2, S[k], p[k]);
      values_at(c, what, start, 2, dS, dp);
      for (int e = 0; e < dim; ++e) {
        double complex unit[DIM] = {0};
        unit[e] = 1;
        condensation_stiffness_change(c, 2, change_of(c, what, 2), unit, dS + e * dim);
      }
      condensation_load_change(c, 1, change_of(c, what, 2), dp);
      CHECK_LE(worst_difference(dim * dim, dS, h, S), 1e-7, "dS, %s, %d", names[how], what);
      CHECK_LE(worst_difference(dim, dp, h, p), 1e-7, "dp, %s, %d", names[how], what);
      condensation_free(c);
      model_free(m);
    }
}

/* A mass beside the structure, without damping, at its resonance: nothing is known of it then, asked twice, or after
 * that of another frequency. */
static void a_resonance_of_the_rest_is_refused(CHECK_STATE)
{
  CHECK_MADE(model, m, model_new(3, 1, 1, 1, &m));
  for (int i = 0; i < 3; ++i) m->mass[4 * i] = 1, m->stiffness[4 * i] = 4 + 3 * i;
  m->stiffness[5] = m->stiffness[7] = -2;
  m->loads[0] = (model_load){.harmonic = 1, .cosine = m->loads[0].cosine, .sine = m->loads[0].sine};
  m->loads[0].cosine[2] = m->responses[2] = m->contacts[0].tangent[2] = 1;
  m->contacts[0].law = (contact){.kt = 10, .mu = 0.5, .load = 1};
  CHECK_MADE(condensation, c, condensation_new(m, 1, &c));
  for (int again = 0; again < 2; ++again) {
    assert_int_equal(condensation_at(c, 2.5, 0), HC_OK);
    assert_int_equal(condensation_at(c, 2, 0), HC_NOT_FINITE);
    assert_int_equal(condensation_at(c, 2, 0), HC_NOT_FINITE);
  }
  condensation_free(c);
  model_free(m);
}

CHECK_TESTS("hbm.condensation", 120, condensed_is_the_whole, nearly_dependent_directions, changes_are_derivatives,
            a_resonance_of_the_rest_is_refused)
