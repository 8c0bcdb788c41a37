/* segment_solutions.c - see segment_solutions.h. Newton at a fixed omega may converge to a solution other than the one
 * meant, since others are close near turning points. Its answer counts only if it is next to the interpolant, measured
 * by the segment's length, and if it was not found already from another sigma. */
#include "hbm/curve/segment_solutions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/curve/segment.h"
#include "hbm/solver/corrector.h"
#include "hbm/solver/hbm_solver_impl.h"

enum { MAX_HALVINGS = 40 };

hc_status hbm_candidate_new(int n_coef, hbm_candidate *out)
{
  size_t n = (size_t)n_coef + 1;
  double *block = calloc(3 * n, sizeof *block);
  if (!block) return HC_NO_MEMORY;
  *out = (hbm_candidate){.X = block, .dX = block + n, .guess = block + 2 * n};
  return HC_OK;
}

static double distance(int n, const double *a, const double *b)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sqrt(sum);
}

/* Of a solution next to segment k that moves in the direction d_omega. */
static int branch_on_segment(const hbm_curve *c, int k, double d_omega)
{
  const hbm_point *a = &c->points[k];
  return (d_omega > 0) == (a->d_omega > 0) ? a->branch : a[1].branch;
}

/* Newton at omega from the interpolant at sigma. False: no solution next to it. */
static bool solve_at(hbm_solver *s, const hbm_curve *c, int k, const hbm_segment *seg, double sigma, double omega,
                     hbm_candidate *x)
{
  double at, d_omega;
  size_t bytes = (size_t)c->n_coef * sizeof(double);
  x->point = (hbm_point){.omega = omega};
  hbm_segment_at(seg, sigma, x->X, &at, x->dX, &d_omega);
  hbm_truncate(s, c->n_coef, x->X);
  hbm_truncate(s, c->n_coef, x->dX);
  memcpy(x->guess, x->X, bytes);
  if (hbm_solve_fixed(s, omega, seg->x_scale, x->X, &x->point) != HC_OK) return false;
  const double near = (0.1 * seg->length + 1e-8) * seg->x_scale;
  if (!(distance(c->n_coef, x->X, x->guess) <= near)) return false;
  if (hbm_tangent_fixed(s, x->X, x->dX) != HC_OK) return false;
  double sign = d_omega < 0 ? -1 : 1;
  for (int i = 0; i < c->n_coef; ++i) x->dX[i] *= sign;
  x->point.d_omega = sign;
  x->point.branch = branch_on_segment(c, k, d_omega);
  return true;
}

hc_status hbm_segment_point(hbm_solver *s, const hbm_curve *c, int k, double sigma, hbm_candidate *x)
{
  hbm_segment between = hbm_segment_between(c, k), *seg = &between;
  double d_omega, *normal = x->guess;
  int n = s->sys.n, first = s->sys.first;
  hbm_segment_at(seg, sigma, x->X, &x->point.omega, x->dX, &d_omega);
  hbm_truncate(s, c->n_coef, x->X);
  hbm_truncate(s, c->n_coef, x->dX);
  for (int i = 0; i < n; ++i) normal[i] = x->dX[i + first] / (seg->x_scale * seg->x_scale);
  normal[n] = d_omega / (seg->omega_scale * seg->omega_scale);
  double omega = x->point.omega;
  hc_status st = hbm_solve_plane(s, normal, seg->x_scale, seg->omega_scale, x->X, &omega, &x->point);
  if (st == HC_OK) st = hbm_tangent_plane(s, x->dX, &x->point.d_omega);
  x->point.branch = branch_on_segment(c, k, x->point.d_omega);
  return st;
}

/* A curve of three points: the ends of segment k and one between them. */
static hc_status halve(hbm_solver *s, const hbm_curve *c, int k, const hbm_segment *seg, hbm_candidate *x,
                       hbm_curve *halves)
{
  hc_status st = hbm_segment_point(s, c, k, 0.5, x);
  halves->omega_scale = c->omega_scale;
  if (st == HC_OK) st = hbm_curve_append(halves, c->n_coef, seg->X0, seg->dX0, &c->points[k]);
  if (st == HC_OK) st = hbm_curve_append(halves, c->n_coef, x->X, x->dX, &x->point);
  return st == HC_OK ? hbm_curve_append(halves, c->n_coef, seg->X1, seg->dX1, &c->points[k + 1]) : st;
}

/* Is x one of the solutions out[first..]? */
static bool found_before(const hbm_curve *out, int first, const hbm_candidate *x, double x_scale)
{
  for (int j = first; j < out->n; ++j)
    if (!(distance(out->n_coef, x->X, hbm_curve_X(out, j)) > 1e-9 * x_scale)) return true;
  return false;
}

/* The solutions on segment k of c, which is the curve or, after a halving, three points of it. */
static hc_status search(hbm_solver *s, const hbm_curve *c, int k, double omega, bool include_end, int halvings_left,
                        hbm_candidate *x, hbm_curve *out)
{
  hbm_segment seg = hbm_segment_between(c, k);
  double sigma[3];
  int crossings = hbm_segment_find(&seg, omega, include_end, sigma), before = out->n;
  bool all_found = true;
  for (int i = 0; i < crossings && all_found; ++i) {
    all_found = solve_at(s, c, k, &seg, sigma[i], omega, x) && !found_before(out, before, x, seg.x_scale);
    if (all_found && hbm_curve_append(out, c->n_coef, x->X, x->dX, &x->point) != HC_OK) return HC_NO_MEMORY;
  }
  if (all_found) return HC_OK;
  out->n = before;
  if (halvings_left == 0) return HC_NOT_CONVERGED;
  hbm_curve halves = {0};
  hc_status st = halve(s, c, k, &seg, x, &halves);
  if (st == HC_OK) st = search(s, &halves, 0, omega, false, halvings_left - 1, x, out);
  if (st == HC_OK) st = search(s, &halves, 1, omega, include_end, halvings_left - 1, x, out);
  hbm_curve_free(&halves);
  return st;
}

hc_status hbm_segment_solutions(hbm_solver *s, const hbm_curve *c, int k, double omega, bool include_end,
                                hbm_curve *out)
{
  hbm_candidate x;
  hc_status st = hbm_candidate_new(c->n_coef, &x);
  if (st != HC_OK) return st;
  st = search(s, c, k, omega, include_end, MAX_HALVINGS, &x, out);
  free(x.X);
  return st;
}
