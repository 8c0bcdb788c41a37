/* planar_panel_sums.c - a panel of slip in the force of a circle and its Jacobian, see planar_force_impl.h. */
#include <math.h>
#include <string.h>

#include "base/constants.h"
#include "base/wide_vectors.h"
#include "hbm/planar/planar_force_impl.h"
#include "numerics/rotate.h"
#include "numerics/series.h"

enum { N = COLLOCATION_POINTS };

typedef struct slip_points {
  double weight[N]; /* width a[last][i]/pi: of Fourier's integrals */
  double cosine[N], sine[N], R[N], pull[N];
} slip_points;

/* 1, cos, sin .. and their rates at the points of a panel, [N][n_base]. */
static void fill_bases(planar_force *f, const planar_panel *p)
{
  const size_t L = (size_t)f->n_base;
  const double width = p->to - p->from, middle = p->from + 0.5 * width;
  double x[N], c[N], s[N], ch[N], sh[N];
  for (int i = 0; i < N; ++i) x[i] = width * (f->rule.x[i] - 0.5);
  rotate(N, cos(middle), sin(middle), x, c, s);
  for (size_t i = 0; i < N; ++i) ch[i] = 1, sh[i] = 0, f->base[i * L] = 1, f->rate[i * L] = 0;
  for (size_t h = 1; h <= (size_t)f->n_harm; ++h) {
    for (int i = 0; i < N; ++i) series_turn(c[i], s[i], &ch[i], &sh[i]);
    for (size_t i = 0; i < N; ++i) {
      double *base = f->base + i * L + 2 * h, *rate = f->rate + i * L + 2 * h;
      base[-1] = ch[i], base[0] = sh[i];
      rate[-1] = -(double)h * sh[i], rate[0] = (double)h * ch[i];
    }
  }
}

static void evaluate_points(planar_force *f, const planar_panel *p, slip_points *q)
{
  const double width = p->to - p->from;
  planar_panel_directions(p, q->cosine, q->sine);
  for (int i = 0; i < N; ++i) {
    q->weight[i] = width * f->rule.a[N - 1][i] / PI;
    q->R[i] = p->R[i];
    q->pull[i] = p->du[0][i] * q->cosine[i] + p->du[1][i] * q->sine[i];
  }
  fill_bases(f, p);
}

/* Whole rows of a loop of constant length. */
static inline void subtract_row(double factor, const double *restrict row, double *restrict from)
{
  for (int j = 0; j < 2 * N; ++j) from[j] -= factor * row[j];
}

/* B := A^-1 B, [A | B] being the two in one: the matrix of planar_slip.c, which needs no exchange of rows. */
static inline void solve_columns(double A[N][2 * N])
{
  for (int k = 0; k < N; ++k) {
    const double inverse = 1 / A[k][k];
    for (int j = 0; j < 2 * N; ++j) A[k][j] *= inverse;
    for (int i = 0; i < N; ++i)
      if (i != k) subtract_row(A[i][k], A[k], A[i]);
  }
}

/* to += sum over the points of y[i] times row i of b, [N][n]. */
WIDE_VECTORS static void add_rows(int n, const double y[N], const double *restrict b, double *restrict to)
{
  _Static_assert(N == 10, "ten rows are written out: a loop over them is three times slower");
  const double *b0 = b, *b1 = b + n, *b2 = b1 + n, *b3 = b2 + n, *b4 = b3 + n, *b5 = b4 + n, *b6 = b5 + n, *b7 = b6 + n,
               *b8 = b7 + n, *b9 = b8 + n;
  for (int k = 0; k < n; ++k)
    to[k] += ((y[0] * b0[k] + y[1] * b1[k]) + (y[2] * b2[k] + y[3] * b3[k])) +
             ((y[4] * b4[k] + y[5] * b5[k]) + (y[6] * b6[k] + y[7] * b7[k])) + (y[8] * b8[k] + y[9] * b9[k]);
}

/* d phi at the points: (R + h a pull) d slope = du'.e_perp - slope dR - pull d phi0, d phi = d phi0 + h a d slope. With
 * Q = h a (R + h pull a)^-1 it is (1 - Q pull) d phi0 + Q (du'.e_perp - slope dR). */
WIDE_VECTORS static void follow_angle(planar_force *f, const planar_panel *p, const slip_points *q)
{
  const int L = f->n_coef;
  const double h = p->to - p->from, per_v = f->motion.per_v;
  double A[N][2 * N]; /* both transposed */
  for (int j = 0; j < N; ++j) {
    for (int i = 0; i < N; ++i) A[j][i] = h * q->pull[i] * f->rule.by_point[j][i];
    for (int i = 0; i < N; ++i) A[j][N + i] = h * f->rule.by_point[j][i];
    A[j][j] += q->R[j];
  }
  solve_columns(A);
  for (int i = 0; i < N; ++i) {
    double *to = f->node + (size_t)i * (size_t)f->n_col, kept = 1, Q[N];
    for (int j = 0; j < N; ++j) Q[j] = A[j][N + i];
    for (int j = 0; j < N; ++j) kept -= Q[j] * q->pull[j];
    for (int k = 0; k < f->n_col; ++k) to[k] = kept * f->dphi[k];
    double a[N], b[N], c[N];
    for (int j = 0; j < N; ++j) {
      a[j] = -Q[j] * q->sine[j];
      b[j] = Q[j] * q->cosine[j];
      c[j] = -Q[j] * p->slope[j] * per_v;
    }
    add_rows(f->n_base, a, f->rate, to);
    add_rows(f->n_base, b, f->rate, to + L);
    if (f->n_dof == 3) add_rows(f->n_base, c, f->base, to + 2 * L);
  }
  memcpy(f->dphi, f->node + (size_t)(N - 1) * (size_t)f->n_col, (size_t)f->n_col * sizeof *f->dphi);
}

/* d(R e) = R e_perp d phi + e dR at a point, times its weight. */
static void fill_change(const planar_force *f, const slip_points *q, int i, double *restrict first,
                        double *restrict second)
{
  const size_t L = (size_t)f->n_coef;
  const double *restrict dphi = f->node + (size_t)i * (size_t)f->n_col, *base = f->base + (size_t)i * (size_t)f->n_base;
  const double R = q->weight[i] * q->R[i], e = q->weight[i] * f->motion.per_v, c = q->cosine[i], s = q->sine[i];
  for (int k = 0; k < f->n_col; ++k) first[k] = -R * s * dphi[k], second[k] = R * c * dphi[k];
  for (size_t k = 0; f->motion.v && k < L; ++k)
    first[2 * L + k] += e * c * base[k], second[2 * L + k] += e * s * base[k];
}

/* Its integrals with the harmonics; of a mean half of that. */
WIDE_VECTORS static void add_slip_derivatives(planar_force *f, const slip_points *q)
{
  const size_t L = (size_t)f->n_coef, n = (size_t)f->n_col;
  double *change[2] = {f->node + N * n, f->node + 2 * N * n};
  for (int i = 0; i < N; ++i) fill_change(f, q, i, change[0] + (size_t)i * n, change[1] + (size_t)i * n);
  for (size_t row = 0; row < L; ++row) {
    double y[N];
    for (size_t i = 0; i < N; ++i) y[i] = row > 0 ? f->base[i * (size_t)f->n_base + row] : 0.5;
    for (size_t d = 0; d < 2; ++d) add_rows(f->n_col, y, change[d], f->by + (d * L + row) * n);
  }
}

void planar_panel_sums(planar_force *f, const planar_panel *p, bool derive)
{
  const int L = f->n_coef;
  slip_points q;
  evaluate_points(f, p, &q);
  for (int i = 0; i < N; ++i) {
    const double *base = f->base + (size_t)i * (size_t)f->n_base;
    const double T[2] = {q.weight[i] * q.R[i] * q.cosine[i], q.weight[i] * q.R[i] * q.sine[i]};
    for (int d = 0; d < 2; ++d) {
      f->F[d * L] += 0.5 * T[d];
      for (int row = 1; row < L; ++row) f->F[d * L + row] += T[d] * base[row];
    }
  }
  if (!derive) return;
  follow_angle(f, p, &q);
  add_slip_derivatives(f, &q);
}
