/* between.c - see between.h. Newton at a fixed omega is only as good as its guess, and near turning points other
 * solutions are close: an answer counts if it is where interpolation said, to a small part of the stretch, and if no
 * two crossings gave the same one. */
#include "hbm/between.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/curve.h"
#include "hbm/solver.h"
#include "numerics/roots.h"

enum { MAX_HALVINGS = 40 };

hc_status hbm_candidate_new(int n_coef, hbm_candidate *out)
{
  size_t n = (size_t)n_coef + 1; /* guess doubles as a plane's normal, one longer */
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

/* Newton at omega from the interpolant at sigma. False: not next to it. */
static bool solve_at(hbm_solver *s, const hbm_curve *c, int k, const hbm_segment *seg, double sigma, double omega,
                     hbm_candidate *x)
{
  double at, d_omega;
  size_t bytes = (size_t)c->n_coef * sizeof(double);
  x->point = (hbm_point){.omega = omega};
  hbm_segment_at(seg, sigma, x->X, &at, x->dX, &d_omega);
  hbm_trim(s, c->n_coef, x->X);
  hbm_trim(s, c->n_coef, x->dX);
  memcpy(x->guess, x->X, bytes);
  if (hbm_solve_fixed(s, omega, seg->x_scale, x->X, &x->point) != HC_OK) return false;
  if (!(distance(c->n_coef, x->X, x->guess) <= (0.1 * seg->length + 1e-8) * seg->x_scale)) return false;
  if (hbm_tangent_fixed(s, x->X, x->dX) != HC_OK) return false;
  double sign = d_omega < 0 ? -1 : 1;
  for (int i = 0; i < c->n_coef; ++i) x->dX[i] *= sign;
  x->point.d_omega = sign;
  const hbm_point *a = &c->points[k];
  x->point.branch = (d_omega > 0) == (a->d_omega > 0) ? a->branch : a[1].branch;
  return true;
}

hc_status hbm_segment_point(hbm_solver *s, const hbm_curve *c, int k, double sigma, hbm_candidate *x)
{
  hbm_segment between = hbm_segment_between(c, k), *seg = &between;
  double d_omega, *normal = x->guess;
  int n = s->sys.n, first = s->sys.first;
  hbm_segment_at(seg, sigma, x->X, &x->point.omega, x->dX, &d_omega);
  hbm_trim(s, c->n_coef, x->X);
  hbm_trim(s, c->n_coef, x->dX);
  for (int i = 0; i < n; ++i) normal[i] = x->dX[i + first] / (seg->x_scale * seg->x_scale);
  normal[n] = d_omega / (seg->omega_scale * seg->omega_scale);
  double omega = x->point.omega;
  hc_status st = hbm_solve_plane(s, normal, seg->x_scale, seg->omega_scale, x->X, &omega, &x->point);
  if (st == HC_OK) st = hbm_tangent_plane(s, x->dX, &x->point.d_omega);
  const hbm_point *a = &c->points[k];
  x->point.branch = (x->point.d_omega > 0) == (a->d_omega > 0) ? a->branch : a[1].branch;
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

static hc_status search(hbm_solver *s, const hbm_curve *c, int k, double omega, bool last, int halvings,
                        hbm_candidate *x, hbm_curve *out)
{
  hbm_segment seg = hbm_segment_between(c, k);
  double sigma[3];
  int found = hbm_segment_find(&seg, omega, last, sigma), before = out->n;
  bool good = true;
  for (int i = 0; i < found && good; ++i) {
    good = solve_at(s, c, k, &seg, sigma[i], omega, x);
    for (int j = before; j < out->n && good; ++j)
      good = distance(c->n_coef, x->X, out->X + (size_t)j * c->n_coef) > 1e-9 * seg.x_scale;
    if (good && hbm_curve_append(out, c->n_coef, x->X, x->dX, &x->point) != HC_OK) return HC_NO_MEMORY;
  }
  if (good) return HC_OK;
  out->n = before;
  if (halvings == 0) return HC_NOT_CONVERGED;
  hbm_curve halves = {0};
  hc_status st = halve(s, c, k, &seg, x, &halves);
  if (st == HC_OK) st = search(s, &halves, 0, omega, false, halvings - 1, x, out);
  if (st == HC_OK) st = search(s, &halves, 1, omega, last, halvings - 1, x, out);
  hbm_curve_free(&halves);
  return st;
}

hc_status hbm_segment_solutions(hbm_solver *s, const hbm_curve *c, int k, double omega, bool last, hbm_curve *out)
{
  hbm_candidate x;
  hc_status st = hbm_candidate_new(c->n_coef, &x);
  if (st != HC_OK) return st;
  st = search(s, c, k, omega, last, MAX_HALVINGS, &x, out);
  free(x.X);
  return st;
}

hc_status hbm_curve_at(hbm_solver *s, const hbm_curve *c, double omega, hbm_curve *at)
{
  hc_status worst = HC_OK;
  at->omega_scale = c->omega_scale;
  for (int k = 0; k + 1 < c->n; ++k) {
    hc_status st = hbm_segment_solutions(s, c, k, omega, k + 2 == c->n, at);
    if (st != HC_OK) worst = st;
  }
  return worst;
}

/* The curve beside its highest point, by a position from -1 (the point before) over 0 to 1 (the point after). */
typedef struct summit {
  hbm_solver *s;
  const hbm_curve *c;
  int top;
  hbm_candidate *x; /* the point at the last position */
} summit;

static hc_status below_summit(void *self, double position, double *minus_amplitude)
{
  const summit *p = self;
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
  const double tolerance = 1e-7; /* the amplitude is flat there: 1e-7 in position is 1e-14 in it */
  summit p = {s, c, top, x};
  root_point found;
  double value;
  hc_status st =
      root_minimum(below_summit, &p, -1, -amplitude[0], 0, -amplitude[1], 1, -amplitude[2], tolerance, &found);
  if (st == HC_BAD_INPUT) return st;
  /* where a point between could not be solved for, the highest one that could is the answer */
  if (below_summit(&p, found.x, &value) != HC_OK) return HC_NOT_CONVERGED;
  return hbm_curve_append(peak, c->n_coef, x->X, x->dX, &x->point);
}

hc_status hbm_curve_peak(hbm_solver *s, const hbm_curve *c, hbm_curve *peak)
{
  int top = -1;
  double before = NAN, beside[3] = {NAN, -1, NAN}; /* amplitudes: of the point before; around the highest one */
  for (int k = 0; k < c->n; ++k) {
    hbm_measures m;
    hc_status st = hbm_measure(s, c->X + (size_t)k * c->n_coef, &m);
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
