/* planar_slider.c - see planar_slider.h.
 *
 * Slip along a straight motion is known in closed form. Let d be the displacement of u in the step, of length l and
 * direction n, delta the angle from n to e, e = (u - w)/r. With e' = (u'.e_perp/r) e_perp and u' = d, r = r0 + t (r1 -
 * r0):
 *
 *     delta' = -l sin(delta)/r(t)      tan(delta_1/2) = E tan(delta_0/2)      E = exp(-l M)      M = integral of dt/r
 *
 * so e turns towards n; where contact has just been made (r0 = 0) M is infinite and e = n at once. While it turns, s =
 * u'.e - r' only grows: slip begins inside a step, where |u - w| = r, but ends at samples only. With c = cos(delta_0),
 * A = 1 + c and B = 1 - c, no angles are needed:
 *
 *     cos(delta_1) = (A - B E^2)/(A + B E^2)      sin(delta_1) = G sin(delta_0)      G = 2 E/(A + B E^2)
 *
 * The instant t at which slip begins does not matter to first order: sticking longer turns u - w as slip turns e. Hence
 *
 *     d phi_1 = G d phi_0 + (1 - G) d psi - sin(delta_1) d(l M),    phi = psi + delta,   d psi = n_perp.dd/l
 *     d phi_0 = e_perp.(du_0 (1 - t) + du_1 t - dw)/r(t)            dw_1 = du_1 - e_1 dr_1 - r_1 e_1_perp d phi_1 */
#include "hbm/planar/planar_slider.h"

#include <float.h>
#include <math.h>
#include <string.h>

static double dot(const double a[2], const double b[2]) { return a[0] * b[0] + a[1] * b[1]; }

static double norm(const double a[2]) { return sqrt(dot(a, a)); }

/* True if |u - w| <= r up to rounding: w = u - r e, on the circle, has not slipped. */
static bool stays(const planar_sample *to, const double w[2], double distance)
{
  const double size = fabs(to->u[0]) + fabs(to->u[1]) + fabs(w[0]) + fabs(w[1]);
  return distance <= to->r + 4 * DBL_EPSILON * (size + to->r);
}

/* Derivatives [1/length] of phi at the end of a step, by u and r at its start and end, and by w at its start. */
typedef struct turning {
  double from[3], to[3], w[2];
} turning;

/* dw at the end of a step of slip, from its direction e there and the derivatives of phi. */
static void slope_of_slip(const planar_sample *to, const double e[2], const turning *phi, planar_slope *slope)
{
  const double perp[2] = {-e[1], e[0]};
  for (int d = 0; d < 2; ++d) {
    const double arm = -to->r * perp[d];
    for (int c = 0; c < 3; ++c) {
      slope->from[d][c] = arm * phi->from[c];
      slope->to[d][c] = arm * phi->to[c];
    }
    for (int c = 0; c < 2; ++c) slope->w[d][c] = arm * phi->w[c];
    slope->to[d][d] += 1;
    slope->to[d][2] -= e[d];
  }
}

/* ---- radial return ----------------------------------------------------------------------------- */

planar_move planar_slider_enter(const planar_sample *to, double w[2], planar_slope *slope)
{
  const double q[2] = {to->u[0] - w[0], to->u[1] - w[1]}, size = norm(q);
  if (stays(to, w, size)) return PLANAR_HELD;
  const double e[2] = {q[0] / size, q[1] / size};
  for (int d = 0; d < 2; ++d) w[d] = to->u[d] - to->r * e[d];
  if (!slope) return PLANAR_SLIPPED;
  const double turn[2] = {-e[1] / size, e[0] / size};
  const turning phi = {.to = {turn[0], turn[1]}, .w = {-turn[0], -turn[1]}};
  slope_of_slip(to, e, &phi, slope);
  return PLANAR_SLIPPED;
}

/* Contact was made since `from`: w is u there. */
static planar_move return_after_separation(const planar_sample *from, const planar_sample *to, double w[2],
                                           planar_slope *slope)
{
  for (int d = 0; d < 2; ++d) w[d] = from->u[d];
  if (slope) *slope = (planar_slope){.w = {{1, 0}, {0, 1}}};
  const planar_move move = planar_slider_enter(to, w, slope);
  for (int d = 0; d < 2 && slope; ++d)
    for (int c = 0; c < 2; ++c) {
      slope->from[d][c] = slope->w[d][c];
      slope->w[d][c] = 0;
    }
  return move == PLANAR_HELD ? PLANAR_PLACED : move;
}

/* ---- along the line ------------------------------------------------------------------------------ */

/* A step with slip from the fraction t of it on. */
typedef struct slip_line {
  double t, r_t;        /* [1] fraction of the step at which slip begins; r there [length] */
  double length, n[2];  /* [length] of u's displacement in the step; its direction */
  double e0[2], e1[2];  /* direction e where slip begins, and at the end */
  double M;             /* [1/length] integral of dt/r over the slip */
  double by_r0, by_r1;  /* -dM/dr_0, -dM/dr_1 */
  double G, one_less_G; /* d phi_1/d phi_0, and 1 - G */
  double sin_1;         /* sin(delta_1) */
} slip_line;

/* log(1 + x)/x, and the integral over 0..1 of (1 - s)/(1 + s x)^2, for x > -1; of 1/(1 + s x)^2 it is 1/(1 + x). Near 0
 * by the series of the integral, of (-x)^k/(k + 2), whose tenth term is below 1e-18 there. */
static void shares_of_radius(double x, double *mean, double *first)
{
  static const double term[] = {1. / 2, 1. / 3, 1. / 4, 1. / 5, 1. / 6, 1. / 7, 1. / 8, 1. / 9, 1. / 10, 1. / 11};
  if (fabs(x) > 0.02) {
    *mean = log1p(x) / x;
    *first = (1 - *mean) / x;
    return;
  }
  *first = 0;
  for (int k = sizeof term / sizeof *term - 1; k >= 0; --k) *first = term[k] - x * *first;
  *mean = 1 - x * *first;
}

/* The first t >= 0 where |p + t d| = r + t dr, which is passed before t = 1; |p| <= r but for rounding. */
static double slip_begins(const double p[2], const double d[2], double r, double dr)
{
  const double a = dot(d, d) - dr * dr, b = dot(p, d) - r * dr;
  const double c = fmin((norm(p) - r) * (norm(p) + r), 0);
  const double root = sqrt(fmax(b * b - a * c, 0));
  const double t = b > 0 ? -c / (b + root) : (root - b) / a;
  return fmin(fmax(t, 0), 1);
}

static void slope_of_line(const planar_sample *to, const slip_line *l, planar_slope *slope)
{
  const double toward[2] = {-l->e0[1] * l->G / l->r_t, l->e0[0] * l->G / l->r_t};
  const double per_way = l->length > 0 ? l->one_less_G / l->length : l->M;
  const double way[2] = {-l->n[1] * per_way - l->sin_1 * l->M * l->n[0], l->n[0] * per_way - l->sin_1 * l->M * l->n[1]};
  turning phi;
  for (int d = 0; d < 2; ++d) {
    phi.from[d] = toward[d] * (1 - l->t) - way[d];
    phi.to[d] = toward[d] * l->t + way[d];
    phi.w[d] = -toward[d];
  }
  phi.from[2] = l->sin_1 * l->length * l->by_r0;
  phi.to[2] = l->sin_1 * l->length * l->by_r1;
  slope_of_slip(to, l->e1, &phi, slope);
}

static planar_move go_along_line(const planar_sample *from, const planar_sample *to, double w[2], planar_slope *slope)
{
  const double q[2] = {to->u[0] - w[0], to->u[1] - w[1]};
  if (stays(to, w, norm(q))) return PLANAR_HELD; /* nor did it slip before: |u - w| - r is convex */
  const double p[2] = {from->u[0] - w[0], from->u[1] - w[1]}, d[2] = {to->u[0] - from->u[0], to->u[1] - from->u[1]};
  slip_line l = {.t = slip_begins(p, d, from->r, to->r - from->r), .length = norm(d)};
  l.r_t = from->r + l.t * (to->r - from->r);
  for (int k = 0; k < 2; ++k) l.e0[k] = p[k] + l.t * d[k];
  const double by_size = 1 / norm(l.e0), by_length = 1 / l.length, by_r = 1 / l.r_t;
  for (int k = 0; k < 2; ++k) l.e0[k] *= by_size;
  for (int k = 0; k < 2; ++k) l.n[k] = l.length > 0 ? d[k] * by_length : l.e0[k];
  const double *n = l.n, *e = l.e0, c = dot(n, e), s = n[0] * e[1] - n[1] * e[0];
  const double A = c < 0 ? s * s / (1 - c) : 1 + c, B = c > 0 ? s * s / (1 + c) : 1 - c;
  double mean, first;
  const double change = (to->r - l.r_t) * by_r, part = (1 - l.t) * by_r;
  shares_of_radius(change, &mean, &first);
  l.M = part * mean;
  const double E = exp(-l.length * l.M), by_whole = 1 / (A + B * E * E);
  l.G = 2 * E * by_whole;
  l.sin_1 = l.G * s;
  const double cos_1 = (A - B * E * E) * by_whole;
  l.e1[0] = cos_1 * n[0] - l.sin_1 * n[1];
  l.e1[1] = cos_1 * n[1] + l.sin_1 * n[0];
  for (int k = 0; k < 2; ++k) w[k] = to->u[k] - to->r * l.e1[k];
  if (!slope) return PLANAR_SLIPPED;
  const double last = 1 / (1 + change) - first;
  l.by_r0 = part * part * first;
  l.by_r1 = part * by_r * (l.t * (first + last) + (1 - l.t) * last);
  l.one_less_G = -expm1(-l.length * l.M) * (A - B * E) * by_whole;
  slope_of_line(to, &l, slope);
  return PLANAR_SLIPPED;
}

/* Contact is made: the slider starts at the point of the line with r = 0, and slips at once, along the line, if u moves
 * faster than r grows. */
static planar_move touch_on_line(const planar_sample *from, const planar_sample *to, double w[2], planar_slope *slope)
{
  const double rise = to->r - from->r, t = -from->r / rise;
  const double d[2] = {to->u[0] - from->u[0], to->u[1] - from->u[1]}, length = norm(d);
  if (slope) memset(slope, 0, sizeof *slope);
  if ((1 - t) * length > to->r) {
    const double e[2] = {d[0] / length, d[1] / length}, turn[2] = {-e[1] / length, e[0] / length};
    const turning phi = {.from = {-turn[0], -turn[1]}, .to = {turn[0], turn[1]}};
    for (int k = 0; k < 2; ++k) w[k] = to->u[k] - to->r * e[k];
    if (slope) slope_of_slip(to, e, &phi, slope);
    return PLANAR_SLIPPED;
  }
  for (int k = 0; k < 2; ++k) w[k] = from->u[k] + t * d[k];
  for (int k = 0; k < 2 && slope; ++k) {
    slope->from[k][k] = 1 - t;
    slope->to[k][k] = t;
    slope->from[k][2] = -d[k] * to->r / (rise * rise);
    slope->to[k][2] = d[k] * from->r / (rise * rise);
  }
  return PLANAR_PLACED;
}

/* ---- either --------------------------------------------------------------------------------------- */

planar_move planar_slider_step(hbm_restart restart, const planar_sample *from, const planar_sample *to, double w[2],
                               planar_slope *slope)
{
  const bool on_line = restart == HBM_RESTART_INTERPOLATED;
  if (!(to->r > 0)) {
    for (int d = 0; d < 2; ++d) w[d] = to->u[d];
    return PLANAR_APART;
  }
  if (!(from->r > 0)) return on_line ? touch_on_line(from, to, w, slope) : return_after_separation(from, to, w, slope);
  return on_line ? go_along_line(from, to, w, slope) : planar_slider_enter(to, w, slope);
}
