/* collocation.c - see collocation.h. Legendre's polynomials P_n are orthogonal under the rule's own sums up to degree
 * n - 1, which gives weights, coefficients and integrals without a linear system. */
#include "numerics/collocation.h"

enum { N = COLLOCATION_POINTS };

/* P_0 .. P_N at t in [-1, 1]. */
static void legendre(double t, double P[N + 1])
{
  P[0] = 1;
  P[1] = t;
  for (int n = 1; n < N; ++n) P[n + 1] = ((2 * n + 1) * t * P[n] - n * P[n - 1]) / (n + 1);
}

/* Integrals of P_0 .. P_(N-1) from -1 to t. */
static void integrals(double t, double I[N])
{
  double P[N + 1];
  legendre(t, P);
  I[0] = t + 1;
  for (int n = 1; n < N; ++n) I[n] = (P[n + 1] - P[n - 1]) / (2 * n + 1);
}

static double radau(int points, double t)
{
  double P[N + 1];
  legendre(t, P);
  return P[points - 1] - P[points];
}

static double bisect(int points, double low, double high)
{
  const int positive = radau(points, low) > 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    if ((radau(points, middle) > 0) == positive) low = middle;
    else high = middle;
  }
  return 0.5 * (low + high);
}

/* Points are the roots of P_(points-1) - P_points; neighbours are farther apart than the steps of this scan. */
static void find_points(int points, double t[N])
{
  enum { STEPS = 40 * N };
  int n = 0;
  t[points - 1] = 1;
  for (int i = 0; i < STEPS - 1 && n < points - 1; ++i) {
    const double low = -1 + 2.0 * i / STEPS, high = -1 + 2.0 * (i + 1) / STEPS;
    if ((radau(points, low) > 0) != (radau(points, high) > 0)) t[n++] = bisect(points, low, high);
  }
}

void collocation_radau(int points, double *x, double *a)
{
  double t[N], P[N][N + 1], I[N][N];
  find_points(points, t);
  for (int i = 0; i < points; ++i) {
    x[i] = 0.5 * (t[i] + 1);
    legendre(t[i], P[i]);
    integrals(t[i], I[i]);
  }
  for (int j = 0; j < points; ++j) {
    double kernel = 0; /* as in collocation_fill */
    for (int n = 0; n < points; ++n) kernel += (n + 0.5) * P[j][n] * P[j][n];
    for (int i = 0; i < points; ++i) {
      a[i * points + j] = 0;
      for (int n = 0; n < points; ++n) a[i * points + j] += 0.5 * I[i][n] * (n + 0.5) * P[j][n] / kernel;
    }
  }
}

void collocation_fill(collocation *c)
{
  double t[N], P[N][N + 1], I[N][N];
  find_points(N, t);
  for (int i = 0; i < N; ++i) {
    c->x[i] = 0.5 * (t[i] + 1);
    legendre(t[i], P[i]);
    integrals(t[i], I[i]);
  }
  for (int j = 0; j < N; ++j) {
    double kernel = 0; /* 1/weight on [-1, 1] */
    for (int n = 0; n < N; ++n) kernel += (n + 0.5) * P[j][n] * P[j][n];
    for (int n = 0; n < N; ++n) c->mode[n][j] = (n + 0.5) * P[j][n] / kernel;
  }
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      c->a[i][j] = 0;
      for (int n = 0; n < N; ++n) c->a[i][j] += 0.5 * I[i][n] * c->mode[n][j];
      c->by_point[j][i] = c->a[i][j];
    }
}

void collocation_slopes(const collocation *c, const double k[N], double start, double part, double slopes[N])
{
  double t[N], last[N], P[N], coefficient[N];
  for (int n = 0; n < N; ++n) {
    coefficient[n] = 0;
    for (int j = 0; j < N; ++j) coefficient[n] += c->mode[n][j] * k[j];
  }
  for (int i = 0; i < N; ++i) {
    t[i] = 2 * (start + part * c->x[i]) - 1;
    last[i] = 1, P[i] = t[i];
    slopes[i] = coefficient[0] + coefficient[1] * t[i];
  }
  for (int n = 1; n < N - 1; ++n) {
    const double ahead = (2 * n + 1) / (n + 1.0), behind = n / (n + 1.0);
    for (int i = 0; i < N; ++i) {
      const double next = ahead * t[i] * P[i] - behind * last[i];
      last[i] = P[i], P[i] = next;
      slopes[i] += coefficient[n + 1] * next;
    }
  }
}

double collocation_rise(const collocation *c, const double k[N], double x)
{
  double I[N], sum = 0;
  integrals(2 * x - 1, I);
  for (int n = 0; n < N; ++n) {
    double coefficient = 0;
    for (int j = 0; j < N; ++j) coefficient += c->mode[n][j] * k[j];
    sum += 0.5 * I[n] * coefficient;
  }
  return sum;
}
