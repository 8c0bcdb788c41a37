/* continuation.c - the response curve from one end of the sweep to the other.
 *
 *   predict   cubic Hermite through the last two points and their tangents, extrapolated by the step h (the tangent
 *             alone at first)
 *   correct   natural: Newton at the predicted omega; arc-length (Keller): Newton in the plane through the
 *             prediction, across the path
 *   judge     how far the corrector moved the prediction tells the error e of interpolating the new stretch:
 *             extrapolation leaves x''''(h_p + h)^2 h^2/24, interpolation x'''' h^4/384. The step is chosen to keep
 *             that at TOLERANCE.
 *
 * `auto` steps naturally until the curve gets steep or Newton fails, then by arc-length, and returns when the curve
 * is flat again. It goes on from a point only forward along its own tangent, so it cannot retrace its path. Lengths:
 * curve.h. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/between.h"
#include "hbm/curve.h"
#include "hbm/path.h"
#include "hbm/start.h"
#include "numerics/series.h"

static const double TOLERANCE = 1e-4; /* of interpolation, relative to |X| */
static const double H_FIRST = 0.02, H_MAX = 0.5, H_MIN = 1e-11;
static const double H_CORNER = 1e-4; /* below: a corner in the curve rather than curvature; accept a kink */
static const double FAR = 4;
static const double H_TURN = 1e-9;           /* steps that fail below this are at a corner to be turned */
static const double LINEAR_NEAR = 1e-2;      /* the linear response counts as the predicted solution within this */
static const double STEEP = 0.2, FLAT = 0.6; /* share of omega in the unit tangent: leave natural steps, take them up
                                                again */
enum { MAX_POINTS = 200000, FLAT_STEPS = 6 };

/* Prediction into X, omega; its direction into dX, d_omega (unit length). Returns interpolation error / prediction
 * error. */
static double predict(path *p, double h)
{
  const hbm_curve *c = p->curve;
  int last = c->n - 1;
  double x_scale = path_size(p), ratio = 1.0 / 16;
  hbm_segment seg = {.length = 0};
  if (c->n >= 2) seg = hbm_segment_between(c, last - 1);
  if (c->n >= 2 && h <= 4 * seg.length && !p->fresh) {
    hbm_segment_at(&seg, 1 + h / seg.length, p->X, &p->omega, p->dX, &p->d_omega);
    ratio = h * h / (16 * (seg.length + h) * (seg.length + h));
  } else {
    const double *X = hbm_curve_X(c, last), *dX = hbm_curve_dX(c, last);
    const hbm_point *q = &c->points[last];
    double step = h / sqrt(path_metric(p, x_scale, dX, q->d_omega, dX, q->d_omega));
    for (int i = 0; i < c->n_coef; ++i) p->X[i] = X[i] + step * dX[i];
    memcpy(p->dX, dX, (size_t)c->n_coef * sizeof(double));
    p->omega = q->omega + step * q->d_omega;
    p->d_omega = q->d_omega;
  }
  hbm_trim(p->s, c->n_coef, p->X);
  hbm_trim(p->s, c->n_coef, p->dX);
  double length = sqrt(path_metric(p, x_scale, p->dX, p->d_omega, p->dX, p->d_omega));
  for (int i = 0; i < c->n_coef; ++i) p->dX[i] /= length;
  p->d_omega /= length;
  memcpy(p->P, p->X, (size_t)c->n_coef * sizeof(double));
  p->omega_p = p->omega;
  return ratio;
}

static hc_status correct_natural(path *p)
{
  p->d_omega = 1;
  p->sign = 1; /* of the linear equations: det Z_h = (K - M h^2 omega^2)^2 + (C h omega)^2 */
  if (p->s->how.skip_linear && hbm_linear_point(p->s, p->omega, LINEAR_NEAR, p->X, p->dX, &p->point)) return HC_OK;
  hc_status st = hbm_solve_fixed(p->s, p->omega, path_size(p), p->X, &p->point);
  if (st == HC_OK) st = hbm_tangent_fixed(p->s, p->X, p->dX);
  p->sign = newton_sign(p->s->fixed);
  return st;
}

/* The plane across (dX, d_omega), metric weights included. */
static void fill_normal(path *p)
{
  int n = p->s->sys.n, first = p->s->sys.first;
  double x_scale = path_size(p), omega_scale = p->curve->omega_scale;
  for (int i = 0; i < n; ++i) p->normal[i] = p->dX[i + first] / (x_scale * x_scale);
  p->normal[n] = p->d_omega / (omega_scale * omega_scale);
}

hc_status path_correct_in_plane(path *p)
{
  double x_scale = path_size(p), omega_scale = p->curve->omega_scale;
  fill_normal(p);
  hc_status st = hbm_solve_plane(p->s, p->normal, x_scale, omega_scale, p->X, &p->omega, &p->point);
  p->sign = newton_sign(p->s->plane);
  return st == HC_OK ? hbm_tangent_plane(p->s, p->dX, &p->d_omega) : st;
}

/* Make the trial tangent keep the curve's sense. Returns cos of the angle to the last tangent; *forward: the step
 * went along both. */
static double orient(path *p, bool *forward)
{
  const hbm_curve *c = p->curve;
  int n = c->n_coef, last = c->n - 1;
  double x_scale = path_size(p), *chord = p->chord;
  const double *X0 = hbm_curve_X(c, last), *dX0 = hbm_curve_dX(c, last);
  double d_omega0 = c->points[last].d_omega;
  for (int i = 0; i < n; ++i) chord[i] = p->X[i] - X0[i];
  if (p->sign != p->sense) {
    for (int i = 0; i < n; ++i) p->dX[i] = -p->dX[i];
    p->d_omega = -p->d_omega;
  }
  double w = p->omega - c->points[last].omega;
  *forward =
      path_metric(p, x_scale, p->dX, p->d_omega, chord, w) > 0 && path_metric(p, x_scale, dX0, d_omega0, chord, w) > 0;
  if (p->natural && !(p->d_omega * p->direction > 0)) *forward = false;
  double a = path_metric(p, x_scale, dX0, d_omega0, dX0, d_omega0),
         b = path_metric(p, x_scale, p->dX, p->d_omega, p->dX, p->d_omega);
  return path_metric(p, x_scale, dX0, d_omega0, p->dX, p->d_omega) / sqrt(a * b);
}

static bool may_go_natural(const path *p) { return p->s->how.continuation != HBM_CONTINUATION_ARCLENGTH; }
static bool may_go_arclength(const path *p) { return p->s->how.continuation != HBM_CONTINUATION_NATURAL; }

static void switch_to_arclength(path *p)
{
  p->natural = false;
  p->flat_steps = 0;
  p->curve->arclength = true;
}

/* One trial step of length h. HC_OK and accepted, or HC_OK and not, or why Newton failed. p->h becomes the next step
 * to try. */
static hc_status try_step(path *p, bool *accepted)
{
  double ratio = predict(p, p->h);
  *accepted = false;
  if (p->natural && !(p->direction * (p->omega - p->curve->points[p->curve->n - 1].omega) > 0)) {
    p->h *= 0.4;
    return HC_NOT_CONVERGED;
  }
  hc_status st = p->natural ? correct_natural(p) : path_correct_in_plane(p);
  p->curve->iterations += p->point.iterations;
  if (st != HC_OK) {
    p->h *= 0.4;
    return st;
  }
  bool forward;
  double cosine = orient(p, &forward), moved = path_correction(p, p->curve->omega_scale),
         error = ratio * path_correction(p, p->resolution);
  bool corner = p->h <= H_CORNER;
  double scale = p->s->step_scale, tolerance = TOLERANCE * scale * scale * scale * scale;
  double grow = 0.9 * pow(tolerance / fmax(error, 1e-12 * tolerance), 0.25);
  bool good = forward && (corner ? moved <= p->h || (p->natural && path_agrees_backwards(p, p->h))
                                 : moved <= 0.25 * p->h && cosine >= 0.7 && error <= 4 * tolerance);
  if (p->point.iterations > 8) grow = fmin(grow, 0.7);
  p->h *= good ? fmin(2, fmax(0.4, grow)) : fmin(0.5, fmax(0.2, grow));
  if (corner && good) p->h = fmax(p->h, 2 * H_MIN);
  p->h = fmin(p->h, H_MAX * scale);
  *accepted = good;
  return HC_OK;
}

/* Round a corner too sharp for a plane across the old tangent, as where a nearly rigid contact is made or lost: the
 * equations a step h beyond the corner tell the direction there (their kernel, with the sense of the curve), and the
 * step is taken along that. */
static hc_status turn_corner(path *p, double h, bool *accepted)
{
  const hbm_curve *c = p->curve;
  const hbm_point *tip = &c->points[c->n - 1];
  const double *X0 = hbm_curve_X(c, c->n - 1), *dX0 = hbm_curve_dX(c, c->n - 1);
  int sign;
  p->fresh = true; /* extrapolating across a corner is no use */
  predict(p, h);
  fill_normal(p);
  hc_status st = hbm_kernel_at(p->s, p->normal, p->X, p->omega, p->dX, &p->d_omega, &sign);
  if (st != HC_OK || sign == 0) return st != HC_OK ? st : HC_SINGULAR;
  double x_scale = path_size(p), length = sqrt(path_metric(p, x_scale, p->dX, p->d_omega, p->dX, p->d_omega));
  length = sign == p->sense ? length : -length;
  for (int i = 0; i < c->n_coef; ++i) {
    p->dX[i] /= length;
    p->X[i] = p->P[i] = X0[i] + h * p->dX[i];
  }
  p->d_omega /= length;
  p->omega = p->omega_p = tip->omega + h * p->d_omega;
  st = path_correct_in_plane(p);
  p->curve->iterations += p->point.iterations;
  if (st != HC_OK) return st;
  if (p->sign != p->sense) {
    for (int i = 0; i < c->n_coef; ++i) p->dX[i] = -p->dX[i];
    p->d_omega = -p->d_omega;
  }
  for (int i = 0; i < c->n_coef; ++i) p->chord[i] = p->X[i] - X0[i];
  bool onward = path_metric(p, x_scale, p->dX, p->d_omega, p->chord, p->omega - tip->omega) > 0;
  bool back = path_metric(p, x_scale, dX0, tip->d_omega, p->chord, p->omega - tip->omega) <
              -0.99 * h * sqrt(path_metric(p, x_scale, dX0, tip->d_omega, dX0, tip->d_omega)); /* the way it came */
  *accepted = onward && !back && path_correction(p, c->omega_scale) <= h;
  return HC_OK;
}

/* Corners of growing size, up to what a step may be where there is a kink at all. */
static bool try_corners(path *p)
{
  bool accepted = false;
  for (double h = H_TURN; h <= H_CORNER && !accepted; h *= 4)
    if (turn_corner(p, h, &accepted) != HC_OK) accepted = false;
  if (accepted) p->h = H_TURN;
  return accepted;
}

static hc_status accept(path *p)
{
  hbm_curve *c = p->curve;
  const hbm_point *before = &c->points[c->n - 1];
  p->point.d_omega = p->d_omega;
  p->point.branch = before->branch + ((before->d_omega > 0) != (p->d_omega > 0));
  c->turning_points = p->point.branch;
  double flat = path_flatness(p);
  p->fresh = false;
  hc_status st = hbm_curve_append(c, c->n_coef, p->X, p->dX, &p->point);
  if (st != HC_OK) return st;
  c->linear += p->point.iterations == 0;
  if (p->natural) {
    if (flat < STEEP && may_go_arclength(p)) switch_to_arclength(p);
  } else {
    bool forward = p->direction * p->d_omega > 0;
    p->flat_steps = flat > FLAT && forward ? p->flat_steps + 1 : 0;
    if (p->flat_steps >= FLAT_STEPS && may_go_natural(p)) p->natural = true;
  }
  return HC_OK;
}

/* End the curve exactly on a limit of the sweep that its last step crossed. */
static hc_status land_on(path *p, double limit)
{
  hbm_curve *c = p->curve;
  hbm_curve on_limit = {.omega_scale = c->omega_scale};
  if (c->points[c->n - 1].omega == limit) return HC_OK;
  hc_status st = hbm_segment_solutions(p->s, c, c->n - 2, limit, false, &on_limit);
  if (st == HC_OK && on_limit.n == 0) st = HC_NOT_CONVERGED;
  --c->n; /* the tip outside gives way to the limit itself */
  if (st == HC_OK) st = hbm_curve_append(c, c->n_coef, on_limit.X, on_limit.dX, on_limit.points);
  hbm_curve_free(&on_limit);
  return st;
}

/* Is the sweep over? Yes past its end; also where the branch turned back past its start and did not come back within
 * a factor FAR: it is then cut where it left. In between (a loop of a superharmonic resonance across the start) it
 * is followed outside the sweep. */
static hc_status finish_at_limit(path *p, bool *done)
{
  hbm_curve *c = p->curve;
  double omega = c->points[c->n - 1].omega;
  *done = p->direction * (omega - p->to) >= 0;
  if (*done) return land_on(p, p->to);
  if (p->direction * (omega - p->from) >= 0) {
    p->left = 0;
    return HC_OK;
  }
  if (!p->left) p->left = c->n - 1;
  *done = c->left_at_start = p->direction > 0 ? omega < p->from / FAR : omega > p->from * FAR;
  if (!*done) return HC_OK;
  c->n = p->left + 1;
  c->turning_points = c->points[p->left].branch;
  return land_on(p, p->from);
}

static hc_status trace(hbm_solver *s, double from, double to, bool from_afar, const hc_monitor *monitor,
                       hbm_curve *curve);

/* The solution at p->from by the curve that comes down from well above every resonance, where inertia rules and any
 * guess will do. */
static hc_status solve_from_afar(path *p, const hc_monitor *monitor)
{
  const model *m = p->s->model;
  const hc_monitor aside = {hc_monitor_tick_aside, (void *)monitor};
  hbm_curve down = {0};
  double far = FAR * fmax(p->from, sqrt(model_max_stiffness(m) / m->mass));
  hc_status st = trace(p->s, far, p->from, false, &aside, &down);
  if (st == HC_OK && down.left_at_start) st = HC_NOT_CONVERGED;
  if (st == HC_OK) {
    memcpy(p->X, hbm_curve_X(&down, down.n - 1), (size_t)p->s->sys.n_coef * sizeof(double));
    st = hbm_solve_fixed(p->s, p->from, hbm_norm(p->s->sys.n_coef, p->X), p->X, &p->point);
  }
  hbm_curve_free(&down);
  return st;
}

static hc_status first_point(path *p, const hc_monitor *monitor)
{
  hbm_curve *c = p->curve;
  hc_status st = hbm_solve_start(p->s, p->from, monitor, p->X, &p->point);
  if (st != HC_OK && st != HC_NO_MEMORY && st != HC_INTERRUPTED && p->from_afar) st = solve_from_afar(p, monitor);
  if (st == HC_OK) st = hbm_tangent_fixed(p->s, p->X, p->dX);
  if (st != HC_OK) return st;
  p->sense = newton_sign(p->s->fixed) * (p->direction > 0 ? 1 : -1);
  for (int i = 0; i < c->n_coef; ++i) p->dX[i] *= p->direction;
  p->point.d_omega = p->direction;
  p->point.branch = 0;
  return hbm_curve_append(c, c->n_coef, p->X, p->dX, &p->point);
}

static double progress(const path *p)
{
  double part = (p->curve->points[p->curve->n - 1].omega - p->from) / (p->to - p->from);
  return fmin(1, fmax(0, part));
}

static hc_status follow(path *p, const hc_monitor *monitor)
{
  hbm_curve *c = p->curve;
  hc_status st = first_point(p, monitor);
  if (st == HC_OK) st = path_adapt(p);
  bool done = p->from == p->to;
  while (st == HC_OK && !done && !p->more_samples) {
    if (c->n >= MAX_POINTS) return HC_TOO_MANY_POINTS;
    if (!hc_monitor_tick(monitor, progress(p))) return HC_INTERRUPTED;
    bool accepted;
    hc_status step = try_step(p, &accepted);
    if (step == HC_NO_MEMORY) return step;
    if (accepted) {
      st = accept(p);
      if (st == HC_OK) st = path_adapt(p);
      if (st == HC_OK) st = finish_at_limit(p, &done);
      if (st == HC_OK && done) {
        st = path_adapt(p); /* the limit is a point of its own */
        double last = c->points[c->n - 1].omega;
        done = last == p->to || (c->left_at_start && last == p->from); /* unless it went back from there */
      }
      continue;
    }
    ++c->rejected;
    if (p->natural && may_go_arclength(p) && (step != HC_OK || p->h < H_FIRST)) switch_to_arclength(p);
    if (p->h < H_TURN && !p->natural && p->turned != c->n && try_corners(p)) {
      if ((st = accept(p)) == HC_OK) st = finish_at_limit(p, &done);
      p->fresh = true;
      continue;
    }
    if (p->h < H_TURN) p->turned = c->n; /* once a point */
    if (p->h < H_MIN) return step != HC_OK ? step : HC_STEP_TOO_SMALL;
  }
  return st;
}

static hc_status path_new(path *p)
{
  size_t n = (size_t)p->curve->n_coef;
  p->X = calloc(5 * n + 1, sizeof(double)); /* one block: X, dX, P, chord, normal */
  if (!p->X) return HC_NO_MEMORY;
  p->dX = p->X + n;
  p->P = p->dX + n;
  p->chord = p->P + n;
  p->normal = p->chord + n;
  return HC_OK;
}

/* One way through the sweep with the equations as they are, but for harmonics: auto. *more_samples: it should be
 * gone again with more of them. */
static hc_status trace_once(path *p, const hc_monitor *monitor, bool *more_samples)
{
  hbm_curve *c = p->curve;
  c->n = c->turning_points = c->linear = 0;
  c->inaccurate = c->left_at_start = false;
  p->h = H_FIRST;
  p->natural = may_go_natural(p);
  c->arclength = !p->natural;
  hc_status st = path_new(p);
  if (st == HC_OK) st = follow(p, monitor);
  free(p->X);
  bool gave_up = st != HC_OK && st != HC_NO_MEMORY && st != HC_INTERRUPTED; /* at a kink that more samples may smooth */
  *more_samples = p->more_samples || (gave_up && p->s->finer_samples && p->s->n_time < REFINE_MOST_SAMPLES);
  return st;
}

static hc_status trace(hbm_solver *s, double from, double to, bool from_afar, const hc_monitor *monitor,
                       hbm_curve *curve)
{
  const path start = {
      .s = s, .from_afar = from_afar, .curve = curve, .from = from, .to = to, .direction = to >= from ? 1 : -1};
  bool adapts = s->how.harmonics == HBM_AUTO, more_samples;
  curve->n_coef = adapts ? series_length(REFINE_MOST_HARMONICS) : s->sys.n_coef;
  curve->omega_scale = fmax(fabs(to - from) / 4, 1e-3 * from);
  long before = s->sys.evaluations;
  hc_status st;
  do {
    path p = start;
    p.resolution = fmin(curve->omega_scale, fmax(0.5 * s->model->damping / s->model->mass, 1e-6 * from));
    st = trace_once(&p, monitor, &more_samples);
    if (more_samples && (st = hbm_solver_resize(s, s->sys.n_harm, 2 * s->n_time)) != HC_OK) break;
  } while (more_samples);
  if (adapts && st != HC_NO_MEMORY) {
    hc_status cut = path_compact(s, curve);
    if (st == HC_OK) st = cut;
  }
  curve->evaluations = s->sys.evaluations - before;
  return curve->end = st;
}

hc_status hbm_trace(hbm_solver *s, double from, double to, const hc_monitor *monitor, hbm_curve *curve)
{
  if (!(from > 0 && to > 0 && isfinite(from) && isfinite(to)) || curve->n) return HC_BAD_INPUT;
  return trace(s, from, to, true, monitor, curve);
}
