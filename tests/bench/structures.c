/* structures.c - what n, the contacts and the harmonics cost: a clamped bar of n masses under tip force with Jenkins
 * elements along it, refined without changing what it is. For each: milliseconds to make the solver, microseconds a
 * condensation at a new omega, microseconds a Newton iteration at a fixed omega (residual, Jacobian, LU), the curve's
 * milliseconds a point, and exponents fitted to the last three rows. Least of several; one thread. */
#include "base/constants.h"
#include "hbm/hbm.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "numerics/dense.h"
#include "tests/bench/bench.h"

typedef enum bar_damping { RAYLEIGH, MODAL, DASHPOTS } bar_damping;
static const char *const damping_names[] = {"Rayleigh", "modal", "dashpots"};

typedef struct bar {
  int n, contacts, harmonics;
  bar_damping damping;
} bar;

static void damp(const bar *b, model *m)
{
  const size_t n = (size_t)b->n;
  for (size_t i = 0; i < n * n; ++i) m->damping[i] = 0.02 * m->mass[i] + 2e-4 * m->stiffness[i];
  for (size_t i = 0; i < 5 && b->damping == DASHPOTS; ++i) m->damping[(i + 1) * n / 6 * (n + 1)] += 0.02;
  if (b->damping != MODAL) return;
  double *room = malloc((3 * n + 1) * n * sizeof *room), *phi = room + n, *P = phi + n * n, *turned = P + n * n;
  if (dense_modes(b->n, m->stiffness, m->mass, room, phi) != HC_OK) abort();
  dense_multiply(b->n, b->n, b->n, m->mass, phi, P);
  for (size_t k = 0; k < n; ++k)
    for (size_t i = 0; i < n; ++i) P[k * n + i] *= sqrt(0.02 * sqrt(room[k]));
  dense_transpose(b->n, b->n, P, turned);
  dense_multiply(b->n, b->n, b->n, P, turned, m->damping);
  free(room);
}

static model *make_bar(const bar *b)
{
  const size_t n = (size_t)b->n;
  const double k = 4 / (PI * PI) * b->n;
  model *m;
  if (model_new(b->n, 1, b->contacts, 2, &m) != HC_OK) abort();
  for (size_t i = 0; i < n; ++i) {
    m->mass[i * (n + 1)] = 1.0 / b->n;
    m->stiffness[i * (n + 1)] = i + 1 < n ? 2 * k : k;
    if (i + 1 < n) m->stiffness[i * n + i + 1] = m->stiffness[(i + 1) * n + i] = -k;
  }
  damp(b, m);
  m->loads[0].harmonic = 1;
  m->loads[0].cosine[n - 1] = 0.3;
  for (int j = 0; j < b->contacts; ++j) {
    m->contacts[j].law = (contact){.kt = 0.4 / b->contacts, .mu = 1, .load = 0.4 / b->contacts};
    m->contacts[j].tangent[(size_t)(j + 1) * n / (size_t)b->contacts - 1] = 1;
  }
  m->responses[n - 1] = m->responses[n + n / 2] = 1;
  return m;
}

typedef struct cost {
  double setup, condensation, iteration, point;
  int unknowns, points;
} cost;

/* At the solver's omega: one Newton iteration in its parts. */
static double time_iteration(hbm_solver *s, double omega, const double *X)
{
  const size_t n = (size_t)s->sys.n;
  double *jac = malloc(n * n * sizeof *jac), *Y = malloc((size_t)s->sys.n_coef * sizeof *Y), *R = malloc(n * sizeof *R);
  int *pivot = malloc(n * sizeof *pivot);
  double best = INFINITY;
  for (int k = 0; k < 15; ++k) {
    for (int i = 0; i < s->sys.n_coef; ++i) Y[i] = (1 + 1e-6 * k) * X[i];
    const double start = cpu_ms();
    if (hbm_system_residual(&s->sys, omega, Y, R) != HC_OK) abort();
    hbm_system_jacobian(&s->sys, omega, s->sys.n, jac);
    dense_factor(s->sys.n, jac, pivot);
    dense_solve(s->sys.n, jac, pivot, 1, R);
    best = fmin(best, cpu_ms() - start);
  }
  free(jac);
  free(Y);
  free(R);
  free(pivot);
  return best;
}

/* The slope of log y over log x. */
static double exponent(int n, const double *x, const double *y)
{
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 0; i < n; ++i) {
    const double a = log(x[i]), b = log(y[i]);
    sx += a, sy += b, sxx += a * a, sxy += a * b;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

enum { ROWS = 6 };

static void run(const char *what, int rows, const bar *bars, const double *x)
{
  double setup[ROWS], condensing[ROWS], iteration[ROWS], point[ROWS];
  printf("%s\n   n  contacts  H  damping   unknowns  setup ms  condensation us  iteration us  point us  points\n",
         what);
  for (int i = 0; i < rows; ++i) {
    const bar *b = &bars[i];
    const hbm_settings how = {.harmonics = b->harmonics, .keep_mean = true, .tolerance = 1e-10, .skip_linear = true};
    cost c = {.condensation = INFINITY, .point = INFINITY};
    model *m = make_bar(b);
    hbm_solver *s;
    double start = cpu_ms();
    if (hbm_solver_new(m, &how, &s) != HC_OK) abort();
    c.setup = cpu_ms() - start;
    c.unknowns = s->sys.n;
    condensation_at(s->sys.linear, 1.2, 0);
    for (int k = 0; k < 15; ++k) {
      start = cpu_ms();
      condensation_at(s->sys.linear, 0.8 + 0.01 * k, 0);
      c.condensation = fmin(c.condensation, cpu_ms() - start);
    }
    for (int k = 0; k < 3; ++k) {
      hbm_curve curve = {0};
      start = cpu_ms();
      if (hbm_trace(s, 0.6, 1.6, NULL, &curve) != HC_OK) printf("curve: %s\n", hc_status_text(curve.end));
      c.points = curve.n;
      c.point = fmin(c.point, (cpu_ms() - start) / curve.n);
      if (k == 2) c.iteration = time_iteration(s, curve.points[curve.n / 2].omega, hbm_curve_X(&curve, curve.n / 2));
      hbm_curve_free(&curve);
    }
    hbm_solver_free(s);
    model_free(m);
    setup[i] = c.setup, condensing[i] = c.condensation, iteration[i] = c.iteration, point[i] = c.point;
    printf("%4d  %8d %2d  %-8s  %8d  %8.1f  %15.1f  %12.1f  %8.1f  %6d\n", b->n, b->contacts, b->harmonics,
           damping_names[b->damping], c.unknowns, c.setup, 1e3 * c.condensation, 1e3 * c.iteration, 1e3 * c.point,
           c.points);
    fflush(stdout);
  }
  const int from = rows > 3 ? rows - 3 : 0, n = rows - from;
  printf("last to first: condensation %.2f, iteration %.2f, point %.2f\n", condensing[rows - 1] / condensing[0],
         iteration[rows - 1] / iteration[0], point[rows - 1] / point[0]);
  printf("exponents: setup %.2f, condensation %.2f, iteration %.2f, point %.2f\n\n",
         exponent(n, x + from, setup + from), exponent(n, x + from, condensing + from),
         exponent(n, x + from, iteration + from), exponent(n, x + from, point + from));
}

int main(int argc, char **argv)
{
  const int most = argc > 1 ? atoi(argv[1]) : 1000;
  const int ns[] = {10, 30, 100, 300, 1000}, contacts[] = {2, 4, 8, 16, 32}, harmonics[] = {3, 7, 15, 31, 63};
  bar bars[ROWS];
  double x[ROWS];
  for (bar_damping d = RAYLEIGH; d <= DASHPOTS; ++d) {
    int rows = 0;
    for (int i = 0; i < 5 && ns[i] <= (d == DASHPOTS && most > 300 ? 300 : most); ++i, ++rows)
      bars[i] = (bar){ns[i], 2, 7, d}, x[i] = ns[i];
    run("over n", rows, bars, x);
  }
  for (int i = 0; i < 5; ++i) bars[i] = (bar){100, contacts[i], 5, RAYLEIGH}, x[i] = contacts[i];
  run("over contacts, as many as coordinates", 5, bars, x);
  for (int i = 0; i < 5; ++i) bars[i] = (bar){100, 2, harmonics[i], RAYLEIGH}, x[i] = 2 * harmonics[i] + 1;
  run("over harmonics (exponents of 2 H + 1)", 5, bars, x);
  return 0;
}
