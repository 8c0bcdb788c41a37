/* between.c - see between.h. */
#include "hbm/curve/between.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/curve/segment.h"
#include "hbm/solver/corrector.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "numerics/norm.h"
#include "numerics/roots.h"

/* Is X one of the solutions at[before..]? */
static bool found_already(const hbm_curve *at, int before, int n_coef, const double *X)
{
  for (int j = before; j < at->n; ++j) {
    const double *Y = hbm_curve_X(at, j);
    double apart = 0;
    for (int i = 0; i < n_coef; ++i) apart = hypot(apart, X[i] - Y[i]);
    if (apart <= 1e-9 * norm_2(n_coef, X)) return true;
  }
  return false;
}

/* A solution at omega, found from guess or, if that is NULL, from nothing, appended unless it is there already: one of
 * at[before..]. */
static hc_status append_solution(hbm_solver *s, const hbm_curve *c, const double *guess, double omega, int before,
                                 hbm_curve *at)
{
  hbm_candidate x;
  hc_status st = hbm_candidate_new(c->n_coef, &x);
  if (st != HC_OK) return st;
  const double size = guess ? norm_2(c->n_coef, guess) : 0;
  if (guess) memcpy(x.X, guess, (size_t)c->n_coef * sizeof *guess);
  memset(x.dX, 0, (size_t)c->n_coef * sizeof *x.dX);
  st = guess ? hbm_solve_fixed(s, omega, size, x.X, &x.point) : hbm_solve_first(s, omega, x.X, &x.point);
  if (st == HC_OK && !found_already(at, before, c->n_coef, x.X))
    st = hbm_curve_append(at, c->n_coef, x.X, x.dX, &x.point);
  free(x.X);
  return st;
}

/* Planes across the interpolant may miss the curve at an edge of slip: from both ends of a segment, at omega. */
static hc_status solve_from_ends(hbm_solver *s, const hbm_curve *c, int k, double omega, int before, hbm_curve *at)
{
  for (int end = k; end <= k + 1; ++end)
    if (append_solution(s, c, hbm_curve_X(c, end), omega, before, at) == HC_NO_MEMORY) return HC_NO_MEMORY;
  return at->n > before ? HC_OK : HC_NOT_CONVERGED;
}

/* Solutions that are there twice: interpolants of steep segments may overshoot into the next one. */
static void drop_twins(hbm_curve *at, int before)
{
  const size_t row = (size_t)at->n_coef * sizeof(double);
  int n = before;
  for (int i = before; i < at->n; ++i) {
    const int all = at->n;
    at->n = n;
    const bool twin = found_already(at, before, at->n_coef, hbm_curve_X(at, i));
    at->n = all;
    if (twin) continue;
    at->points[n] = at->points[i];
    memmove(hbm_curve_X(at, n), hbm_curve_X(at, i), row);
    memmove(hbm_curve_dX(at, n), hbm_curve_dX(at, i), row);
    ++n;
  }
  at->n = n;
}

hc_status hbm_curve_at(hbm_solver *s, const hbm_curve *c, double omega, hbm_curve *at)
{
  const int before = at->n;
  hc_status worst = HC_OK;
  at->omega_scale = c->omega_scale;
  at->asked = true;
  for (int k = 0; k + 1 < c->n; ++k) {
    hc_status st = hbm_segment_solutions(s, c, k, omega, k + 2 == c->n, at);
    if (st != HC_OK && s->edges) st = solve_from_ends(s, c, k, omega, before, at);
    if (st != HC_OK) worst = st;
  }
  if (s->edges) drop_twins(at, before);
  const bool stopped = at->n == before && c->n > 0 && c->end != HC_OK;
  return stopped && s->edges ? append_solution(s, c, NULL, omega, before, at) : worst;
}

/* The two segments that meet at the highest point, by a position: -1 is the point before, 0 the highest, 1 the point
 * after. */
typedef struct peak_search {
  hbm_solver *s;
  const hbm_curve *c;
  int top;          /* index of the highest point */
  hbm_candidate *x; /* the solution at the last position */
} peak_search;

static hc_status minus_amplitude_at(void *self, double position, double *minus_amplitude)
{
  const peak_search *p = self;
  const int k = position < 0 ? p->top - 1 : p->top;
  hbm_measures m;
  hc_status st = hbm_segment_point(p->s, p->c, k, position - (k - p->top), p->x);
  if (st == HC_OK) st = hbm_measure(p->s, p->x->X, &m);
  *minus_amplitude = st == HC_OK ? -m.amplitude : NAN;
  return st;
}

/* amplitude[3]: of the highest point and its neighbours. */
static hc_status refine_peak(hbm_solver *s, const hbm_curve *c, int top, const double *amplitude, hbm_candidate *x,
                             hbm_curve *peak)
{
  const double tolerance =
      1e-7; /* at a maximum the amplitude changes with the square: 1e-7 in position is 1e-14 in it */
  peak_search p = {s, c, top, x};
  root_point found;
  double value;
  hc_status st =
      root_minimum(minus_amplitude_at, &p, -1, -amplitude[0], 0, -amplitude[1], 1, -amplitude[2], tolerance, &found);
  if (st == HC_BAD_INPUT) return st;
  /* any other failure is that of a solve between the points: found.x is then the highest one solved for before */
  if (minus_amplitude_at(&p, found.x, &value) != HC_OK) return HC_NOT_CONVERGED;
  return hbm_curve_append(peak, c->n_coef, x->X, x->dX, &x->point);
}

hc_status hbm_curve_peak(hbm_solver *s, const hbm_curve *c, hbm_curve *peak)
{
  int top = -1;
  double before = NAN, beside[3] = {NAN, -1, NAN}; /* amplitudes: of the point before; around the highest one */
  for (int k = 0; k < c->n; ++k) {
    hbm_measures m;
    hc_status st = hbm_measure(s, hbm_curve_X(c, k), &m);
    if (st != HC_OK) return st;
    if (m.amplitude > beside[1]) {
      beside[0] = before;
      beside[1] = m.amplitude;
      top = k;
    }
    if (k == top + 1) beside[2] = m.amplitude;
    before = m.amplitude;
  }
  if (top < 0) return HC_BAD_INPUT;
  peak->omega_scale = c->omega_scale;
  if (top == 0 || top == c->n - 1) /* an end of the sweep: the peak may lie outside */
    return hbm_curve_append(peak, c->n_coef, hbm_curve_X(c, top), hbm_curve_dX(c, top), &c->points[top]);
  hbm_candidate x;
  hc_status st = hbm_candidate_new(c->n_coef, &x);
  if (st != HC_OK) return st;
  st = refine_peak(s, c, top, beside, &x, peak);
  free(x.X);
  return st;
}
