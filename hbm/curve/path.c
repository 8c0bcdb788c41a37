/* path.c - see path.h. */
#include "hbm/curve/path.h"

#include <string.h>

#include "hbm/curve/segment.h"
#include "hbm/solver/corrector.h"
#include "numerics/norm.h"

metric_at path_metric(const path *p) { return hbm_curve_metric(p->curve, p->curve->n - 1); }

double path_inner(const path *p, const double *aX, double a_omega, const double *bX, double b_omega)
{
  const metric_at at = path_metric(p);
  return metric_inner(&at, aX, bX) + a_omega * b_omega / (p->curve->omega_scale * p->curve->omega_scale);
}

double path_length(const path *p, const double *aX, double a_omega)
{
  const metric_at at = path_metric(p);
  return hypot(metric_length(&at, aX), a_omega / p->curve->omega_scale);
}

double path_correction(const path *p, double omega_unit)
{
  const metric_at at = path_metric(p);
  return hypot(metric_distance(&at, p->X, p->X_predicted), (p->omega - p->omega_predicted) / omega_unit);
}

bool path_agrees_backwards(const path *p, double h)
{
  const hbm_curve *c = p->curve;
  const metric_at at = path_metric(p);
  const double *X0 = hbm_curve_X(c, c->n - 1), step = (p->omega - c->points[c->n - 1].omega) / p->d_omega;
  for (int i = 0; i < c->n_coef; ++i) p->missed[i] = p->X[i] - X0[i] - step * p->dX[i];
  return metric_length(&at, p->missed) <= h;
}

double path_flatness(const path *p)
{
  return fabs(p->d_omega) / p->curve->omega_scale / path_length(p, p->dX, p->d_omega);
}

/* MOST_LENGTHS: the last segment's cubic is extrapolated by at most so many of its lengths; beyond, its tangent is.
 * RATIO: the ratio of errors of continuation.c, h^4/384 to (h_p + h)^2 h^2/24, is RATIO h^2/(h_p + h)^2; for the
 * tangent alone h_p = 0. */
static const double MOST_LENGTHS = 4, RATIO = 24.0 / 384;

double path_predict(path *p, double h)
{
  const hbm_curve *c = p->curve;
  int last = c->n - 1;
  double ratio = RATIO;
  hbm_segment seg = {.length = 0};
  if (c->n >= 2) seg = hbm_segment_between(c, last - 1);
  if (c->n >= 2 && h <= MOST_LENGTHS * seg.length && !p->tangent_only) {
    hbm_segment_at(&seg, 1 + h / seg.length, p->X, &p->omega, p->dX, &p->d_omega);
    ratio = RATIO * h * h / ((seg.length + h) * (seg.length + h));
  } else {
    const double *X = hbm_curve_X(c, last), *dX = hbm_curve_dX(c, last);
    const hbm_point *q = &c->points[last];
    const double scale = h / path_length(p, dX, q->d_omega);
    for (int i = 0; i < c->n_coef; ++i) p->X[i] = X[i] + scale * dX[i];
    memcpy(p->dX, dX, (size_t)c->n_coef * sizeof(double));
    p->omega = q->omega + scale * q->d_omega;
    p->d_omega = q->d_omega;
  }
  hbm_truncate(p->s, c->n_coef, p->X);
  hbm_truncate(p->s, c->n_coef, p->dX);
  const double length = path_length(p, p->dX, p->d_omega);
  for (int i = 0; i < c->n_coef; ++i) p->dX[i] /= length;
  p->d_omega /= length;
  memcpy(p->X_predicted, p->X, (size_t)c->n_coef * sizeof(double));
  p->omega_predicted = p->omega;
  return ratio;
}

int path_even_sign(path *p)
{
  const bool asked = p->s->on_symmetric && !p->s->ramp;
  return asked ? hbm_even_sign(p->s, p->omega, p->X) : 0;
}

void path_orient_tangent(path *p)
{
  p->point.even_sign = path_even_sign(p);
  /* Where its symmetry breaks the determinant changes its sign, and the curve does not turn: the symmetric block's
   * decides. Without kinks the tangent turns little in a step: it goes on along the last one at branch points of
   * whatever symmetry, of equal sectors, too. */
  const int sign = p->point.even_sign ? p->det_sign * p->point.even_sign : p->det_sign;
  if (!p->kinked) {
    const hbm_curve *c = p->curve;
    const double *dX = hbm_curve_dX(c, c->n - 1);
    const bool onward = path_inner(p, p->dX, p->d_omega, dX, c->points[c->n - 1].d_omega) > 0;
    p->orientation = onward ? sign : -sign;
  }
  if (sign == p->orientation) return;
  for (int i = 0; i < p->curve->n_coef; ++i) p->dX[i] = -p->dX[i];
  p->d_omega = -p->d_omega;
}

void path_fill_normal(path *p)
{
  const int n = p->s->sys.n, first = p->s->sys.first;
  const double omega_scale = p->curve->omega_scale;
  const metric_at at = path_metric(p);
  metric_apply(&at, p->dX, p->normal);
  memmove(p->normal, p->normal + first, (size_t)n * sizeof *p->normal);
  p->normal[n] = p->d_omega / (omega_scale * omega_scale);
}

hc_status path_correct_in_plane(path *p)
{
  path_fill_normal(p);
  hc_status st = hbm_solve_plane(p->s, p->normal, p->curve->omega_scale, p->X, &p->omega, &p->point);
  p->det_sign = newton_sign(p->s->plane);
  return st == HC_OK ? hbm_tangent_plane(p->s, p->dX, &p->d_omega) : st;
}

/* ---- a step of the plainest continuation ------------------------------------------------------------- */

/* Arc-length continuation as a simple code has it (hbm.continuation: fixed_step), to show which failures belong to the
 * continuation and not to the equations:
 *
 *   predict   along the last point's tangent, always by the arc length hbm.step
 *   correct   plain Newton in the plane across that tangent, at most hbm.iterations of them
 *   tangent   the one that points along the last: normal . t = 1 (corrector.h) sees to it
 *
 * A step that converges near the prediction gives a point of the curve. One that does not converge, or converges
 * farther from the prediction than a kink of 76 degrees explains, ends the curve: the point may be on another branch.
 * There is no shorter step to try again with, no line search, no rule for corners, and no orientation by a determinant:
 * the curve may turn round at a kink and retrace its path. The first point, and the curve's end on the sweep's limit,
 * are found as always. */
static const double FIXED_MOVED = 4; /* largest correction, in steps: tan(76 degrees) */

hc_status path_fixed_step(path *p, bool *accepted)
{
  hbm_curve *c = p->curve;
  p->tangent_only = true;
  const double h = p->s->how.step * p->s->step_scale;
  path_predict(p, h);
  path_fill_normal(p);
  hc_status st = hbm_solve_plane_plainly(p->s, p->normal, c->omega_scale, p->X, &p->omega, &p->point);
  c->iterations += p->point.iterations;
  if (st == HC_OK) st = hbm_tangent_plane(p->s, p->dX, &p->d_omega);
  if (st == HC_OK && !(path_correction(p, c->omega_scale) <= FIXED_MOVED * h)) st = HC_JUMPED;
  *accepted = st == HC_OK;
  return st;
}

/* ---- harmonics and samples ---------------------------------------------------------------------------- */

/* The number of harmonics changes along the curve, as the last point needs it. The number of samples N does not:
 * turning points of sampled equations depend on N, so a curve that needs more samples starts again with twice as
 * many. */

/* Harmonics are dropped after POINTS_BEFORE_DROPPING successive points at which they came to less than DROPPABLE of
 * hbm.accuracy: successive numbers of harmonics differ by a factor of 1.4, so errors, which fall like H^-3, grow by
 * 2.8. After a failure WAITED_LONGER times as many further points must pass before the next attempt. */
enum { POINTS_BEFORE_DROPPING = 4, WAITED_LONGER = 4 };
static const double DROPPABLE = 0.05;

/* The trial: the last point solved again with the equations as they are now, at its omega if it is an end of the sweep
 * (ends stay where they are), else across its own tangent. */
static hc_status correct_last(path *p)
{
  hbm_curve *c = p->curve;
  const hbm_point *last = &c->points[c->n - 1];
  bool end_of_sweep = c->n == 1 || last->omega == p->to || last->omega == p->from;
  if (!end_of_sweep) return path_correct_in_plane(p);
  hc_status st = hbm_solve_fixed(p->s, p->omega, p->X, &p->point);
  if (st != HC_OK) return st;
  p->d_omega = 1;
  st = hbm_tangent_fixed(p->s, p->X, p->dX);
  p->det_sign = newton_sign(p->s->fixed);
  return st;
}

/* Solve the last point of the curve again. Its tangent is turned by the orientation, which is the same for coarser and
 * finer equations (a further harmonic adds a block of positive determinant); its old tangent may belong to a fold that
 * only the coarser equations have. */
static hc_status redo_last(path *p)
{
  hbm_curve *c = p->curve;
  hbm_point *last = &c->points[c->n - 1];
  double *X = hbm_curve_X(c, c->n - 1), *dX = hbm_curve_dX(c, c->n - 1);
  size_t bytes = (size_t)c->n_coef * sizeof(double);
  hbm_truncate(p->s, c->n_coef, X);
  hbm_truncate(p->s, c->n_coef, dX);
  memcpy(p->X, X, bytes);
  memcpy(p->dX, dX, bytes);
  p->omega = last->omega;
  p->d_omega = last->d_omega;
  hc_status st = correct_last(p);
  c->iterations += p->point.iterations;
  if (st != HC_OK) return st;
  path_orient_tangent(p);
  if (c->n > 1) last->branch = last[-1].branch + ((last[-1].d_omega > 0) != (p->d_omega > 0));
  c->turning_points = last->branch;
  memcpy(X, p->X, bytes);
  memcpy(dX, p->dX, bytes);
  last->omega = p->omega;
  last->d_omega = p->d_omega;
  last->residual = p->point.residual;
  last->harmonics = p->s->sys.n_harm;
  last->iterations += p->point.iterations;
  p->tangent_only = true;
  return HC_OK;
}

/* Other harmonics, and the last point solved again with them. Where the new equations have no solution near it (it is
 * on a fold of the old ones alone), it is dropped, and the point before is tried, at last the first. */
static hc_status change_harmonics(path *p, int n_harm)
{
  hc_status st = hbm_solver_resize(p->s, n_harm, p->s->n_time);
  if (st != HC_OK) return st;
  st = redo_last(p);
  while (st != HC_OK && st != HC_NO_MEMORY && p->curve->n > 1) {
    --p->curve->n;
    if (p->first_outside >= p->curve->n) p->first_outside = 0;
    p->step *= 0.5;
    st = redo_last(p);
  }
  return st;
}

/* More harmonics until the last point meets hbm.accuracy; *too_few: true if the curve must start again with more
 * samples first. */
static hc_status add_harmonics(path *p, bool *too_few)
{
  hbm_solver *s = p->s;
  hbm_curve *c = p->curve;
  const double accuracy = s->how.accuracy;
  hc_status st = HC_OK;
  *too_few = false;
  while (st == HC_OK && (s->finer_harmonics || s->finer_samples)) {
    hbm_point *last = &c->points[c->n - 1];
    const double *X = hbm_curve_X(c, c->n - 1);
    double by_harmonics = s->finer_harmonics ? refinement_error(s->finer_harmonics, last->omega, s->sys.n_harm, X) : 0;
    double by_samples = s->finer_samples ? refinement_error(s->finer_samples, last->omega, s->sys.n_harm, X) : 0;
    last->error = fmax(by_harmonics, by_samples);
    int n_harm = by_harmonics > accuracy ? refine_next_harmonics(s->sys.n_harm, true) : s->sys.n_harm;
    bool want_samples = s->finer_samples && (by_samples > accuracy || s->n_time < 4 * n_harm);
    *too_few = want_samples && s->n_time < REFINE_MOST_SAMPLES;
    if (*too_few) return HC_OK;
    if (n_harm == s->sys.n_harm) {
      c->inaccurate |= last->error > accuracy;
      return HC_OK;
    }
    st = change_harmonics(p, n_harm);
    p->droppable_points = 0;
  }
  return st;
}

hc_status path_adapt(path *p)
{
  hbm_solver *s = p->s;
  bool too_few_samples;
  hc_status st = add_harmonics(p, &too_few_samples);
  p->more_samples |= too_few_samples;
  if (st != HC_OK || too_few_samples) return st;
  const int fewer = refine_next_harmonics(s->sys.n_harm, false), kept = hbm_system_length(&s->sys, fewer);
  bool has_spare = s->finer_harmonics && s->sys.n_harm > 1 && fewer >= model_highest_load(s->model);
  const metric_at at = path_metric(p);
  bool droppable = has_spare && metric_tail(&at, kept) < DROPPABLE * s->how.accuracy;
  p->droppable_points = droppable ? p->droppable_points + 1 : 0;
  if (p->droppable_points < POINTS_BEFORE_DROPPING) return HC_OK;
  int before = s->sys.n_harm;
  p->droppable_points = 0;
  st = change_harmonics(p, refine_next_harmonics(before, false));
  if (st == HC_OK) st = path_adapt(p); /* estimates the error, and adds them again if it is too large */
  if (s->sys.n_harm >= before) p->droppable_points = -WAITED_LONGER * POINTS_BEFORE_DROPPING;
  return st;
}

hc_status path_finish(hbm_solver *s, hbm_curve *c)
{
  int most = 1, before = c->n_coef;
  for (int k = 0; k < c->n; ++k) most = c->points[k].harmonics > most ? c->points[k].harmonics : most;
  int n = hbm_system_length(&s->sys, most);
  for (int k = 0; k < c->n; ++k) {
    memmove(c->X + (size_t)k * n, c->X + (size_t)k * before, (size_t)n * sizeof(double));
    memmove(c->dX + (size_t)k * n, c->dX + (size_t)k * before, (size_t)n * sizeof(double));
  }
  c->n_coef = n;
  return most == s->sys.n_harm ? HC_OK : hbm_solver_resize(s, most, s->n_time);
}
