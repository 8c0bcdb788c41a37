/* circle_aft_jacobian.c - dF/dX of circle_aft.h. While in contact dT = kt (du - dw) at every sample: kt du over them by
 * one more FFT (force_jacobian.h), and dw, a row for each of w_1 and w_2, carried from sample to sample by the slopes
 * of the steps (circle_slider.h). The rows are by X and by the slider before sample 0, whose own dependence on X closes
 * the period at the end: dw_0 = A dw_0 + B dX. While it sticks the rows stay, and the harmonics at its samples are
 * summed first. Costs 4 n_dof (2H+1)^2 operations a sample that slips. */
#include <math.h>
#include <string.h>

#include "hbm/circle_aft_impl.h"
#include "hbm/force_jacobian.h"
#include "numerics/series.h"

static int columns(const circle_aft *a) { return a->n_dof * series_length(a->n_harm); }

/* basis[m] = harmonic m at sample i. */
static void harmonics_at(const circle_aft *a, int i, double *basis)
{
  int at = 0;
  basis[0] = 1;
  for (int h = 1; h <= a->n_harm; ++h) {
    if ((at += i) >= a->n_time) at -= a->n_time;
    basis[2 * h - 1] = creal(a->root[at]);
    basis[2 * h] = cimag(a->root[at]);
  }
}

/* by = slope of the step applied to it, and to the motion at the samples before and after. */
static void carry(circle_aft *a, const circle_slope *s)
{
  const int length = series_length(a->n_harm), n = columns(a);
  const double radius = a->law.mu * a->law.kn / a->law.kt;
  double *by[2] = {a->by[0], a->by[1]};
  for (int q = 0; q < n + 2; ++q) {
    const double b0 = by[0][q], b1 = by[1][q];
    for (int d = 0; d < 2; ++d) by[d][q] = s->w[d][0] * b0 + s->w[d][1] * b1;
  }
  for (int d = 0; d < 2; ++d)
    for (int c = 0; c < a->n_dof; ++c) {
      const double weight = c < 2 ? 1 : radius, from = weight * s->from[d][c], to = weight * s->to[d][c];
      double *row = by[d] + c * length;
      for (int m = 0; m < length; ++m) row[m] += from * a->basis[0][m] + to * a->basis[1][m];
    }
}

/* whole -= kt dw at the samples whose harmonics add up to `sum`. */
static void subtract(circle_aft *a, const double *restrict sum)
{
  const int length = series_length(a->n_harm), n = columns(a) + 2;
  const double scale = 2 * a->law.kt / a->n_time;
  for (int q = 0; q < n; ++q)
    for (int d = 0; d < 2; ++d) {
      double *restrict to = a->whole + ((size_t)q * 2 + (size_t)d) * (size_t)length;
      const double weight = scale * a->by[d][q];
      if (weight == 0) continue;
      to[0] -= 0.5 * weight * sum[0];
      for (int m = 1; m < length; ++m) to[m] -= weight * sum[m];
    }
}

static void subtract_held(circle_aft *a)
{
  const size_t bytes = (size_t)series_length(a->n_harm) * sizeof(double);
  subtract(a, a->held);
  memset(a->held, 0, bytes);
}

static void clear_rows(circle_aft *a)
{
  for (int d = 0; d < 2; ++d) memset(a->by[d], 0, ((size_t)columns(a) + 2) * sizeof(double));
}

/* One step to sample i, whose harmonics are in basis[1]; with `forces`, what T does there. */
static void differentiate_step(circle_aft *a, int i, circle_move move, const circle_slope *slope, bool forces)
{
  const int length = series_length(a->n_harm);
  if (move != CIRCLE_HELD && forces) subtract_held(a);
  if (move == CIRCLE_APART && circle_slider_forgets(a->restart)) clear_rows(a);
  if (move == CIRCLE_SLIPPED || move == CIRCLE_PLACED) {
    harmonics_at(a, i ? i - 1 : a->n_time - 1, a->basis[0]);
    carry(a, slope);
  }
  if (!forces) return;
  if (move == CIRCLE_SLIPPED) subtract(a, a->basis[1]);
  else if (move != CIRCLE_APART)
    for (int m = 0; m < length; ++m) a->held[m] += a->basis[1][m];
}

/* The rows carried on over a period that begins with the slider w. */
static void differentiate_period(circle_aft *a, bool entering, double w[2], bool forces)
{
  circle_slope slope;
  for (int i = 0; i < a->n_time; ++i) {
    const circle_move move = circle_aft_step(a, i, entering, w, &slope);
    harmonics_at(a, i, a->basis[1]);
    differentiate_step(a, i, move, &slope, forces);
  }
  if (forces) subtract_held(a);
}

static void start_rows(circle_aft *a)
{
  clear_rows(a);
  a->by[0][columns(a)] = a->by[1][columns(a) + 1] = 1;
}

/* by[d][q] of X = that of the slider which a period with these rows brings back to where it was. False where any comes
 * back. */
static bool close_rows(circle_aft *a)
{
  const int n = columns(a);
  double A[2][2] = {{a->by[0][n], a->by[0][n + 1]}, {a->by[1][n], a->by[1][n + 1]}};
  bool closed = true;
  for (int q = 0; q < n && closed; ++q) {
    double b[2] = {a->by[0][q], a->by[1][q]};
    closed = circle_aft_fixed_point(A, b, b);
    a->by[0][q] = b[0];
    a->by[1][q] = b[1];
  }
  return closed;
}

/* by = dw_0/dX of an orbit that sticks. */
static void rows_of_history(circle_aft *a)
{
  double w[2] = {0};
  if (a->orbit == CIRCLE_GUESSED) {
    memcpy(w, a->last, sizeof w);
    start_rows(a);
    differentiate_period(a, false, w, false);
    if (close_rows(a)) return;
    w[0] = w[1] = 0;
  }
  clear_rows(a);
  for (int pass = 0; pass < a->passes; ++pass) differentiate_period(a, pass == 0, w, false);
}

/* The columns by the slider before sample 0, times what that depends on. */
static void add_start(circle_aft *a)
{
  const int n = columns(a), rows = 2 * series_length(a->n_harm);
  const double *by_start[2] = {a->whole + (size_t)n * (size_t)rows, a->whole + ((size_t)n + 1) * (size_t)rows};
  for (int q = 0; q < n; ++q)
    for (int d = 0; d < 2; ++d) {
      const double weight = a->by[d][q];
      double *to = a->whole + (size_t)q * (size_t)rows;
      for (int p = 0; p < rows && weight != 0; ++p) to[p] += weight * by_start[d][p];
    }
}

/* jac += the matrix of a stiffness that acts at the samples in contact, from a coordinate to its own force. */
static void add_contact_stiffness(circle_aft *a, double stiffness, int d, double *jac)
{
  const size_t length = (size_t)series_length(a->n_harm), ld = (size_t)columns(a);
  for (int i = 0; i < a->n_time; ++i) a->sample[i] = a->move[i] == CIRCLE_APART ? 0 : stiffness;
  circle_aft_to_series(a, 2 * a->n_harm, a->symbol);
  force_jacobian_add(a->n_harm, a->symbol, (int)ld, jac + (ld + 1) * (size_t)d * length);
}

void circle_aft_jacobian(circle_aft *a, double *jac)
{
  const size_t n = (size_t)columns(a), rows = 2 * (size_t)series_length(a->n_harm);
  double w[2] = {a->start[0], a->start[1]};
  memset(a->whole, 0, rows * (n + 2) * sizeof(double));
  start_rows(a);
  differentiate_period(a, a->orbit == CIRCLE_ONE_PASS, w, true);
  const bool closed = a->orbit == CIRCLE_CLOSED && close_rows(a);
  if (a->orbit == CIRCLE_ONE_PASS) clear_rows(a);
  else if (!closed) rows_of_history(a);
  add_start(a);
  memset(jac, 0, n * n * sizeof(double));
  for (size_t q = 0; q < n; ++q) memcpy(jac + q * n, a->whole + q * rows, rows * sizeof(double));
  for (int d = 0; d < 2; ++d) add_contact_stiffness(a, a->law.kt, d, jac);
  if (a->n_dof == 3) add_contact_stiffness(a, 2 * a->law.kn, 2, jac);
}
