/* planar_panel_sums.c - a panel of slip in the force of a circle and its Jacobian, see planar_force_impl.h. */
#include <math.h>
#include <string.h>

#include "base/constants.h"
#include "hbm/planar/planar_force_impl.h"
#include "hbm/planar/wide_vectors.h"
#include "numerics/dense.h"
#include "numerics/rotate.h"
#include "numerics/series.h"

enum { N = COLLOCATION_POINTS };

typedef struct slip_points {
  double weight[N]; /* width a[last][i]/pi: of Fourier's integrals */
  double cosine[N], sine[N], R[N], pull[N];
} slip_points;

/* 1, cos, sin .. and their rates at the points of a panel, [N][n_coef]. */
static void fill_bases(planar_force *f, const planar_panel *p)
{
  const size_t L = (size_t)f->n_coef;
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
WIDE_VECTORS static void solve_columns(double A[N][2 * N])
{
  for (int k = 0; k < N; ++k) {
    const double inverse = 1 / A[k][k];
    for (int j = 0; j < 2 * N; ++j) A[k][j] *= inverse;
    for (int i = 0; i < N; ++i)
      if (i != k) subtract_row(A[i][k], A[k], A[i]);
  }
}

/* d phi at the points: (R + h a pull) d slope = du'.e_perp - slope dR - pull d phi0, d phi = d phi0 + h a d slope. With
 * Q = h a (R + h pull a)^-1 it is (1 - Q pull) d phi0 + Q (du'.e_perp - slope dR). */
static void follow_angle(planar_force *f, const planar_panel *p, const slip_points *q)
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
  double by_du[2][N][N], by_dv[N][N];
  for (int i = 0; i < N; ++i) {
    double *to = f->node + (size_t)i * (size_t)f->n_col, kept = 1;
    for (int j = 0; j < N; ++j) {
      const double Q = A[j][N + i];
      kept -= Q * q->pull[j];
      by_du[0][i][j] = -Q * q->sine[j];
      by_du[1][i][j] = Q * q->cosine[j];
      by_dv[i][j] = -Q * p->slope[j] * per_v;
    }
    for (int k = 0; k < f->n_col; ++k) to[k] = kept * f->dphi[k];
  }
  for (int d = 0; d < 2; ++d) dense_add_product(L, N, N, 1, f->rate, L, by_du[d][0], N, 1, f->node + d * L, f->n_col);
  if (f->n_dof == 3) dense_add_product(L, N, N, 1, f->base, L, by_dv[0], N, 1, f->node + 2 * L, f->n_col);
  memcpy(f->dphi, f->node + (size_t)(N - 1) * (size_t)f->n_col, (size_t)f->n_col * sizeof *f->dphi);
}

/* d(R e) = R e_perp d phi + e dR at a point, times its weight. */
static void fill_change(const planar_force *f, const slip_points *q, int i, double *restrict first,
                        double *restrict second)
{
  const size_t L = (size_t)f->n_coef;
  const double *restrict dphi = f->node + (size_t)i * (size_t)f->n_col, *base = f->base + (size_t)i * (size_t)f->n_coef;
  const double R = q->weight[i] * q->R[i], e = q->weight[i] * f->motion.per_v, c = q->cosine[i], s = q->sine[i];
  for (int k = 0; k < f->n_col; ++k) first[k] = -R * s * dphi[k], second[k] = R * c * dphi[k];
  for (size_t k = 0; f->motion.v && k < L; ++k)
    first[2 * L + k] += e * c * base[k], second[2 * L + k] += e * s * base[k];
}

/* Its integrals with the harmonics; of a mean half of that. */
static void add_slip_derivatives(planar_force *f, const slip_points *q)
{
  const size_t n = (size_t)f->n_col;
  const int L = f->n_coef;
  double *change[2] = {f->node + N * n, f->node + 2 * N * n};
  for (int i = 0; i < N; ++i) fill_change(f, q, i, change[0] + (size_t)i * n, change[1] + (size_t)i * n);
  dense_transpose(L, N, f->base, f->test);
  for (int i = 0; i < N; ++i) f->test[i] = 0.5;
  for (int d = 0; d < 2; ++d)
    dense_add_product(f->n_col, L, N, 1, change[d], f->n_col, f->test, N, 1, f->by + (size_t)(d * L) * n, f->n_col);
}

void planar_panel_sums(planar_force *f, const planar_panel *p, bool derive)
{
  const int L = f->n_coef;
  slip_points q;
  evaluate_points(f, p, &q);
  for (int i = 0; i < N; ++i) {
    const double *base = f->base + (size_t)i * (size_t)f->n_coef;
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
