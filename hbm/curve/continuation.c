/* continuation.c - the response curve from one end of the sweep to the other, by steps of a predictor and a corrector.
 *
 *   predict   cubic Hermite through the last two points and their tangents, extrapolated by the arc length h (the last
 *             tangent alone at first)
 *   correct   natural: Newton at the predicted omega; arc-length (Keller): Newton in the plane through the
 *             prediction, across the predicted tangent
 *   error     how far the corrector moved the prediction tells the error e of interpolating the new segment:
 *             extrapolation leaves x''''(h_p + h)^2 h^2/24, h_p being the last segment's length, interpolation
 *             x'''' h^4/384. The next step is chosen to keep e at TOLERANCE.
 *
 * `auto` steps naturally until the curve gets steep or Newton fails, then by arc-length, and returns when the curve is
 * flat again. From a point it continues only forward along the curve's tangent, so it cannot retrace its path.
 * `fixed_step` does none of this: path_fixed_step. */
#include "hbm/curve/continuation.h"

#include <stdlib.h>
#include <string.h>

#include "hbm/curve/growth.h"
#include "hbm/curve/path.h"
#include "hbm/curve/segment.h"
#include "hbm/solver/corrector.h"
#include "hbm/solver/linear_solution.h"
#include "numerics/base/trace.h"
#include "numerics/base/workspace.h"
#include "numerics/norm.h"

/* [1] tolerated interpolation error in the metric, that is of the contact with the largest one. Less for sampled
 * forces: they have spurious turning points between samples, which longer steps would pass over. */
static const double TOLERANCE = 2e-4, TOLERANCE_SAMPLED = 1e-4;
static const double STEP_FIRST = 0.02, STEP_MAX = 0.5, STEP_MIN = 1e-11;
static const double STEP_CORNER = 1e-4; /* [1] step length at or below which the curve is taken to have a corner, and a
                                           kink is accepted */
static const double STEP_ROUND = 1e-9;  /* [1] step length below which, after a failure, a step round the corner is
                                           tried */
static const double LOOP_RANGE = 4;     /* factor beyond the start of the sweep up to which a loop is followed */
static const double LONGER = 4; /* factor between successive trial lengths of a step round a corner or over a join */
static const double LESS = 0.1; /* a failed step over a join is tried again when steps are shorter by this factor */
static const double LONGEST_OVER = 16; /* longest step over a join, in units of the step that failed */
static const double LEAST_PART = 1e-6; /* first relative change of the vibration in a step over a join, in units of that
                                          step */
enum { CLOSER = 20 }; /* halvings of that change: the curvatures of the two sides may differ by a factor of thousands */
static const double LINEAR_NEAR = 1e-2;      /* [1] largest distance from the prediction at which the linear response is
                                                taken as solution */
static const double STEEP = 0.2, FLAT = 0.6; /* flatness below which natural steps end; above which they resume */

/* The step's controller. A trial is accepted as smooth if the corrector moved the prediction by at most MOST_MOVED of
 * the step, the tangent turned by less than 45 degrees (LEAST_COSINE), and the error is at most MOST_ERROR tolerances:
 * the step was then at most 4^(1/4) = 1.4 times too long, which is within the uncertainty of the estimate. The next
 * step is chosen for the tolerance, times SAFETY, within growth factors as in solvers of differential equations; after
 * MANY_ITERATIONS of Newton it is at most SHRINK_SLOW times as long. */
static const double MOST_MOVED = 0.25, LEAST_COSINE = 0.7, MOST_ERROR = 4, SAFETY = 0.9;
static const double SHRINK_ACCEPTED = 0.4, GROW_ACCEPTED = 2, SHRINK_REFUSED = 0.2, GROW_REFUSED = 0.5;
static const double SHRINK_FAILED = 0.4, SHRINK_SLOW = 0.7;
enum { MANY_ITERATIONS = 8 };

enum { FEW_HARMONICS = 6 }; /* harmonics of the ramp whose solution is the guess for twice as many or more */

/* SWEEP_UNITS: length of a sweep in the curve's metric; with STEP_MAX it takes at least eight steps. LEAST_UNIT: least
 * unit of omega, relative to omega, for a sweep of one frequency. NARROWEST: least resonance width, relative to omega,
 * by which errors in omega are measured. */
static const double SWEEP_UNITS = 4, LEAST_UNIT = 1e-3, NARROWEST = 1e-6;
static const double WAY_BACK = -0.99; /* cosine to the last tangent (172 degrees) below which a step retraces the
                                         curve */
enum { MAX_POINTS = 200000, FLAT_STEPS = 6 };

static bool steps_are_fixed(const hbm_solver *s) { return s->how.continuation == HBM_CONTINUATION_FIXED_STEP; }
static bool arclength_allowed(const path *p) { return p->s->how.continuation != HBM_CONTINUATION_NATURAL; }

static bool natural_allowed(const path *p)
{
  return p->s->how.continuation == HBM_CONTINUATION_AUTO || p->s->how.continuation == HBM_CONTINUATION_NATURAL;
}

static void switch_to_arclength(path *p)
{
  p->natural = false;
  p->flat_steps = 0;
  p->curve->arclength = true;
}

static hc_status correct_natural(path *p)
{
  p->d_omega = 1;
  p->det_sign = 1; /* for the linear response: det Z_h = (K - M h^2 omega^2)^2 + (C h omega)^2 > 0 */
  if (p->s->how.skip_linear && hbm_linear_point(p->s, p->omega, LINEAR_NEAR, p->X, p->dX, &p->point)) return HC_OK;
  hc_status st = hbm_solve_fixed(p->s, p->omega, p->X, &p->point);
  if (st == HC_OK) st = hbm_tangent_fixed(p->s, p->X, p->dX);
  p->det_sign = newton_sign(p->s->fixed);
  return st;
}

static void fill_chord(path *p)
{
  const double *X0 = hbm_curve_X(p->curve, p->curve->n - 1);
  for (int i = 0; i < p->curve->n_coef; ++i) p->chord[i] = p->X[i] - X0[i];
}

/* The cosine of the angle between two directions. */
static double cosine(const path *p, const double *aX, double a_omega, const double *bX, double b_omega)
{
  return path_inner(p, aX, a_omega, bX, b_omega) /
         sqrt(path_inner(p, aX, a_omega, aX, a_omega) * path_inner(p, bX, b_omega, bX, b_omega));
}

/* Turn the trial's tangent forward. Returns its cosine to the last tangent; *forward: the step has a positive component
 * along both. */
static double orient(path *p, bool *forward)
{
  const hbm_curve *c = p->curve;
  const hbm_point *last = &c->points[c->n - 1];
  const double d_omega0 = last->d_omega, w = p->omega - last->omega;
  const double *dX0 = hbm_curve_dX(c, c->n - 1), *chord = p->chord;
  fill_chord(p);
  path_orient_tangent(p);
  bool along_trial = path_inner(p, p->dX, p->d_omega, chord, w) > 0;
  bool along_last = path_inner(p, dX0, d_omega0, chord, w) > 0;
  bool turned_back = p->natural && !(p->d_omega * p->direction > 0);
  *forward = along_trial && along_last && !turned_back;
  return cosine(p, dX0, d_omega0, p->dX, p->d_omega);
}

/* The trial in one line, before the next step is chosen; objection: why it is refused, or NULL. */
static void trace_trial(const path *p, const char *objection)
{
  if (!trace_on(TRACE_curve)) return;
  trace_line(TRACE_curve, "%s %.9g  amplitude %.6g  step %.3g %s  newton %d  %s%s", p->s->ramp ? "ramp" : "omega",
             p->omega, hbm_amplitude_at(p->s, p->X), p->step, p->natural ? "natural" : "along the arc",
             p->point.iterations, objection ? "refused: " : "point", objection ? objection : "");
}

/* True if the corrected trial is accepted. Sets p->step to the next length, or to a shorter one for another trial.
 * ratio: as returned by path_predict. */
static bool check_trial(path *p, double ratio)
{
  bool forward;
  double turned = orient(p, &forward), moved = path_correction(p, p->curve->omega_scale),
         error = ratio * path_correction(p, p->resolution);
  double scale = p->s->step_scale, tolerance = p->s->how.force == HBM_FORCE_SAMPLED ? TOLERANCE_SAMPLED : TOLERANCE;
  tolerance *= scale * scale * scale * scale;
  bool corner = p->step <= STEP_CORNER;
  bool kink = moved <= p->step || (p->natural && path_agrees_backwards(p, p->step));
  const char *objection = !forward                             ? "it runs back"
                          : corner                             ? (kink ? NULL : "it jumps at a corner")
                          : !(moved <= MOST_MOVED * p->step)   ? "the corrector moved it"
                          : !(turned >= LEAST_COSINE)          ? "the tangent turned"
                          : !(error <= MOST_ERROR * tolerance) ? "the interpolation errs"
                                                               : NULL;
  const bool accepted = !objection;
  trace_trial(p, objection);
  double growth = SAFETY * pow(tolerance / fmax(error, 1e-12 * tolerance), 0.25);
  if (p->point.iterations > MANY_ITERATIONS) growth = fmin(growth, SHRINK_SLOW);
  p->step *=
      accepted ? fmin(GROW_ACCEPTED, fmax(SHRINK_ACCEPTED, growth)) : fmin(GROW_REFUSED, fmax(SHRINK_REFUSED, growth));
  if (corner && accepted) p->step = fmax(p->step, 2 * STEP_MIN);
  p->step = fmin(p->step, STEP_MAX * scale);
  return accepted;
}

/* Predicts and corrects one step. HC_OK with *accepted, or the status with which there is no trial. p->step becomes the
 * next step length. */
static hc_status trial_step(path *p, bool *accepted)
{
  double ratio = path_predict(p, p->step);
  *accepted = false;
  bool onward = p->direction * (p->omega - p->curve->points[p->curve->n - 1].omega) > 0;
  if (p->natural && !onward) {
    p->step *= SHRINK_FAILED;
    return HC_NOT_CONVERGED;
  }
  p->s->predicted = true;
  hc_status st = p->natural ? correct_natural(p) : path_correct_in_plane(p);
  p->s->predicted = false;
  p->curve->iterations += p->point.iterations;
  if (st == HC_OK) *accepted = check_trial(p, ratio);
  else trace_trial(p, hc_status_text(st)), p->step *= SHRINK_FAILED;
  return st;
}

/* The trial: h from the last point along the trial's tangent, which becomes of unit length. */
static void predict_along_own_tangent(path *p, double h)
{
  const hbm_curve *c = p->curve;
  const double *X0 = hbm_curve_X(c, c->n - 1), length = path_length(p, p->dX, p->d_omega);
  for (int i = 0; i < c->n_coef; ++i) {
    p->dX[i] /= length;
    p->X[i] = p->X_predicted[i] = X0[i] + h * p->dX[i];
  }
  p->d_omega /= length;
  p->omega = p->omega_predicted = c->points[c->n - 1].omega + h * p->d_omega;
}

/* A step of length h round a corner too sharp for a plane across the old tangent, as where a nearly rigid contact is
 * made or lost. The direction beyond the corner is the kernel of the equations at a point h along the old tangent,
 * turned by the curve's orientation; the prediction is made along it. */
static hc_status step_round_corner(path *p, double h, bool *accepted)
{
  const hbm_curve *c = p->curve;
  const hbm_point *last = &c->points[c->n - 1];
  const double *dX0 = hbm_curve_dX(c, c->n - 1);
  int det_sign;
  p->tangent_only = true; /* an extrapolation of the last segment is not valid beyond the corner */
  path_predict(p, h);
  path_fill_normal(p);
  hc_status st = hbm_kernel_at(p->s, p->normal, p->X, p->omega, p->dX, &p->d_omega, &det_sign);
  if (st != HC_OK || det_sign == 0) return st != HC_OK ? st : HC_SINGULAR;
  p->det_sign = det_sign;
  path_orient_tangent(p);
  predict_along_own_tangent(p, h);
  st = path_correct_in_plane(p);
  p->curve->iterations += p->point.iterations;
  if (st != HC_OK) return st;
  path_orient_tangent(p);
  fill_chord(p);
  const double w = p->omega - last->omega;
  bool onward = path_inner(p, p->dX, p->d_omega, p->chord, w) > 0;
  bool the_way_it_came = cosine(p, dX0, last->d_omega, p->chord, w) < WAY_BACK;
  *accepted = onward && !the_way_it_came && path_correction(p, c->omega_scale) <= h;
  return HC_OK;
}

/* Steps round a corner of growing length, up to STEP_CORNER. */
static bool round_corner(path *p)
{
  bool accepted = false;
  for (double h = STEP_ROUND; h <= STEP_CORNER && !accepted; h *= LONGER)
    if (step_round_corner(p, h, &accepted) != HC_OK) accepted = false;
  if (accepted) p->step = STEP_ROUND;
  return accepted;
}

/* ---- joins of rest and slip ---------------------------------------------------------------------------- */

/* A join is the point of a curve where the set of possible rest positions of a slider shrinks to one (planar_rest.h).
 * On the side of rest the curve is smooth. On the side of slip it moves along the lens of two discs by a parameter s,
 * with omega linear plus quadratic in s: dX/domega is unbounded towards the join, and omega may turn back close to it.
 * Corners of the same kind lie where other discs come to hold a slider. The far side is searched for in planes across
 * the last tangent, before and behind the last point, then across the direction found there, from starts at which other
 * contacts rest, or are held by other discs. The orientation distinguishes the continuation from the way back. */

/* Hash of the trial's contact pattern: which contacts rest all period, by how many discs, and whether at w = 0. 0: the
 * forces could not be evaluated. */
static uint64_t resting(path *p)
{
  const contact_forces *f = p->s->sys.contacts;
  uint64_t mark = 1;
  if (hbm_system_contact(&p->s->sys, p->X, false) != HC_OK) return 0;
  for (int j = 0; j < p->s->model->n_contacts; ++j) {
    const planar_cycle *c = contact_forces_planar(f, j);
    const bool rests = contact_forces_regime(f, j) == CONTACT_STUCK;
    mark = 31 * mark + (uint64_t)(rests ? 1 + (c ? 2 * c->rest.n + (c->rest.w[0] != 0 || c->rest.w[1] != 0) : 0) : 0);
  }
  return mark;
}

static bool rests_like(path *p, uint64_t before)
{
  const uint64_t now = resting(p);
  return now == 0 || now == before;
}

/* Sets the trial to the prediction with its harmonics above the mean multiplied by factor. */
static void vibrate_by(path *p, double factor)
{
  for (int i = p->s->sys.dim; i < p->curve->n_coef; ++i) p->X[i] = factor * p->X_predicted[i];
}

/* Sets the trial to the prediction with its vibration changed, relatively by at most LONGEST_OVER h, so that its
 * contact pattern differs from `before`; among such starts to that of least residual: next to the join the force varies
 * like a square root, and from a start farther from the join than the solution Newton ends on the wrong side. False if
 * there is none. */
static bool start_beyond(path *p, uint64_t before, double h, double sign)
{
  vibrate_by(p, 1);
  const bool is_beyond = !rests_like(p, before); /* the prediction itself */
  const double most = LONGEST_OVER * h;
  double near = 0, far = LEAST_PART * h, best = 0, least = INFINITY, residual;
  for (;; near = far, far *= LONGER) {
    vibrate_by(p, 1 + sign * far);
    if (!(far < most) || rests_like(p, before) == is_beyond) break;
  }
  if (!(far < most) && !is_beyond) return false;
  for (int i = 0; i < CLOSER && far < most; ++i) {
    const double middle = near + 0.5 * (far - near);
    vibrate_by(p, 1 + sign * middle);
    *(rests_like(p, before) == is_beyond ? &far : &near) = middle;
  }
  const double edge = !(far < most) ? 0 : is_beyond ? near : far, away = is_beyond ? -1 : 1;
  double part = h;
  while (part > LEAST_PART * LEAST_PART * h) {
    const double there = fmax(0, edge + away * part);
    part /= LONGER;
    vibrate_by(p, 1 + sign * there);
    if (rests_like(p, before) || hbm_residual_at(p->s, p->omega, p->X, &residual) != HC_OK) continue;
    if (residual < least) least = residual, best = there;
  }
  vibrate_by(p, 1 + sign * best);
  return least < INFINITY;
}

/* Solves in the plane at the length h along the last tangent, from start_beyond with the vibration enlarged or reduced
 * by sign. If that is far off or fails, solves again in the plane across the direction of the curve there (trial's
 * tangent or kernel): the last tangent does not lead beyond the join where the slider begins to drift, or at a sharp
 * corner. True if the contact pattern differs from `before` and the curve continues forward. */
static bool step_over_join(path *p, uint64_t before, double h, double sign)
{
  const hbm_curve *c = p->curve;
  p->tangent_only = true;
  path_predict(p, h);
  for (int turn = 0; turn < 2; ++turn) {
    if (turn > 0) predict_along_own_tangent(p, fabs(h));
    if (!start_beyond(p, before, fabs(h), sign)) return false;
    hc_status st = path_correct_in_plane(p);
    p->curve->iterations += p->point.iterations;
    const bool found = st == HC_OK && !rests_like(p, before);
    if (st != HC_OK && turn == 0) st = hbm_kernel_at(p->s, p->normal, p->X, p->omega, p->dX, &p->d_omega, &p->det_sign);
    if (st != HC_OK || p->det_sign == 0) return false;
    path_orient_tangent(p);
    fill_chord(p);
    const double w = p->omega - c->points[c->n - 1].omega;
    const bool onward = path_inner(p, p->dX, p->d_omega, p->chord, w) > 0;
    if (found && onward && path_correction(p, c->omega_scale) <= fabs(h)) return true;
  }
  return false;
}

/* Passes a join that lies within the failed step, by the shortest step that leads to the other side. False if none
 * does. */
static bool pass_join(path *p)
{
  hbm_curve *c = p->curve;
  const double longest = LONGEST_OVER * p->step;
  bool accepted = false;
  double h = p->step;
  if (p->edges++ >= p->s->edges->most) return false;
  memcpy(p->X, hbm_curve_X(c, c->n - 1), (size_t)c->n_coef * sizeof *p->X);
  const uint64_t before = resting(p);
  while (h <= longest) {
    for (int way = 0; way < 4 && !accepted; ++way)
      accepted = step_over_join(p, before, way < 2 ? h : -h, way % 2 ? 1 : -1);
    if (accepted) break;
    h *= LONGER;
  }
  if (!accepted) return false;
  ++c->edges;
  c->edge_omega = fmax(c->edge_omega, fabs(p->omega / c->points[c->n - 1].omega - 1));
  c->edge_motion = fmax(c->edge_motion, h);
  p->step = h;
  return true;
}

/* Appends the trial to the curve, and selects natural or arc-length steps by the flatness there. */
static hc_status append_trial(path *p)
{
  hbm_curve *c = p->curve;
  const hbm_point *before = &c->points[c->n - 1];
  p->point.d_omega = p->d_omega;
  p->point.branch = before->branch + ((before->d_omega > 0) != (p->d_omega > 0));
  c->turning_points = p->point.branch;
  double flatness = path_flatness(p);
  p->tangent_only = false;
  hc_status st = hbm_curve_append(c, c->n_coef, p->X, p->dX, &p->point);
  if (st != HC_OK) return st;
  c->linear += p->point.iterations == 0;
  if (p->natural) {
    if (flatness < STEEP && arclength_allowed(p)) switch_to_arclength(p);
  } else {
    bool forward = p->direction * p->d_omega > 0;
    p->flat_steps = flatness > FLAT && forward ? p->flat_steps + 1 : 0;
    if (p->flat_steps >= FLAT_STEPS && natural_allowed(p)) p->natural = true;
  }
  return HC_OK;
}

/* End the curve exactly on a limit of the sweep that its last step crossed. beyond: the last point is outside and is
 * replaced; else the curve turned back between the last two points, and stays unchanged if no solution is found on the
 * limit. */
static hc_status end_on(path *p, double limit, bool beyond)
{
  hbm_curve *c = p->curve;
  hbm_curve on_limit = {0};
  if (c->points[c->n - 1].omega == limit) return HC_OK;
  hc_status st = hbm_segment_solutions(p->s, c, c->n - 2, limit, false, &on_limit);
  if (st == HC_OK && on_limit.n == 0) st = HC_NOT_CONVERGED;
  if (st == HC_OK || beyond) --c->n; /* the point behind the limit is replaced by the one on it */
  if (st == HC_OK) st = hbm_curve_append(c, c->n_coef, on_limit.X, on_limit.dX, on_limit.points);
  hbm_curve_free(&on_limit);
  return st;
}

/* True if the interpolant between the last two points, both inside the sweep, reaches its end and turns back. */
static bool turned_past_end(const path *p)
{
  const hbm_curve *c = p->curve;
  const hbm_point *last = &c->points[c->n - 1];
  if (c->n < 2 || (last[-1].d_omega > 0) == (last->d_omega > 0)) return false;
  const hbm_segment seg = hbm_segment_between(c, c->n - 2);
  return p->direction * (hbm_segment_farthest(&seg, p->direction) - p->to) >= 0;
}

/* *done: the sweep is over, past its end, or because the branch turned back past its start by a factor LOOP_RANGE: the
 * curve is then cut where it left the sweep. Until then (a loop of a superharmonic resonance across the start) it is
 * followed outside the sweep. */
static hc_status end_at_limit(path *p, bool *done)
{
  hbm_curve *c = p->curve;
  double omega = c->points[c->n - 1].omega;
  *done = p->direction * (omega - p->to) >= 0;
  if (*done) return end_on(p, p->to, true);
  if (turned_past_end(p)) { /* an error of end_on: only the interpolant does, not the curve */
    *done = end_on(p, p->to, false) == HC_OK;
    if (*done) return HC_OK;
  }
  const double behind = p->course->behind;
  if (p->direction * (omega - behind) >= 0) {
    p->first_outside = 0;
    return HC_OK;
  }
  if (!p->first_outside) p->first_outside = c->n - 1;
  *done = c->left_at_start = p->direction > 0 ? omega < behind / LOOP_RANGE : omega > behind * LOOP_RANGE;
  if (!*done) return HC_OK;
  c->n = p->first_outside + 1;
  c->turning_points = c->points[p->first_outside].branch;
  return end_on(p, behind, true);
}

/* *known: the last point lies on the curve itself, which is then closed, or on a known part. */
static hc_status is_known_from_here(path *p, bool *known)
{
  enum { NEIGHBOURS = 4 }; /* last segments, not searched: after a turn the last point lies close to them */
  hbm_curve *c = p->curve;
  const hbm_curve *others = p->course->known;
  const int last = c->n - 1;
  int segment;
  *known = false;
  if (p->s->ramp || steps_are_fixed(p->s)) return HC_OK;
  hc_status st = hbm_curve_passes(p->s, c, last - NEIGHBOURS, c, last, true, &segment);
  c->closed = st == HC_OK && segment >= 0;
  if (st == HC_OK && others) st = hbm_curve_passes(p->s, others, others->n, c, last, false, &c->met_segment);
  c->met = st == HC_OK && others && c->met_segment >= 0;
  /* the last segment crosses the symmetric branch: beyond is the mirror image of this branch */
  c->met |= others && hbm_on_either_side(p->s, c->n_coef, hbm_curve_X(c, last - 1), hbm_curve_X(c, last));
  *known = c->closed || c->met;
  return st;
}

static hc_status first_point(path *p, const hc_monitor *monitor)
{
  hbm_curve *c = p->curve;
  hbm_solver *s = p->s;
  const path_seed *seed = p->course->seed;
  if (seed) memcpy(p->X, seed->X, (size_t)s->sys.n_coef * sizeof *p->X);
  if (seed && seed->dX) {
    memcpy(p->dX, seed->dX, (size_t)s->sys.n_coef * sizeof *p->dX);
    p->orientation = seed->orientation;
    p->point = (hbm_point){.omega = p->from, .d_omega = seed->d_omega, .harmonics = s->sys.n_harm, .error = NAN};
    switch_to_arclength(p);
    return hbm_curve_append(c, c->n_coef, p->X, p->dX, &p->point);
  }
  if (s->ramp) hbm_ramp_start(s->ramp, &s->sys, p->X);
  hc_status st = s->ramp || seed ? hbm_solve_fixed(s, p->from, p->X, &p->point)
                                 : hbm_first_solution(s, p->from, monitor, p->X, &p->point);
  bool no_solution = st != HC_OK && st != HC_NO_MEMORY && st != HC_INTERRUPTED;
  /* The solution at p->from as the end of a curve that comes down from well above every resonance: inertia dominates
   * there, and Newton converges from the linear response. */
  if (no_solution && p->course->may_come_from_above) {
    const hc_monitor aside = {hc_monitor_tick_aside, (void *)monitor};
    hbm_curve down = {0};
    double high = LOOP_RANGE * fmax(p->from, p->s->sys.scales.highest);
    const path_course from_above = {high, p->from, high, .seed = NULL};
    st = path_trace(p->s, &from_above, &aside, &down);
    if (st == HC_OK && down.left_at_start) st = HC_NOT_CONVERGED;
    if (st == HC_OK) {
      memcpy(p->X, hbm_curve_X(&down, down.n - 1), (size_t)p->s->sys.n_coef * sizeof(double));
      st = hbm_solve_fixed(p->s, p->from, p->X, &p->point);
    }
    hbm_curve_free(&down);
  }
  if (st == HC_OK) st = hbm_tangent_fixed(p->s, p->X, p->dX);
  if (st != HC_OK) return st;
  p->omega = p->from;
  p->orientation = newton_sign(p->s->fixed) * (p->direction > 0 ? 1 : -1);
  p->point.even_sign = path_even_sign(p);
  if (p->point.even_sign) p->orientation *= p->point.even_sign;
  for (int i = 0; i < c->n_coef; ++i) p->dX[i] *= p->direction;
  p->point.d_omega = p->direction;
  p->point.branch = 0;
  return hbm_curve_append(c, c->n_coef, p->X, p->dX, &p->point);
}

/* Fraction of the sweep that is done, by omega of the last point, in 0..1. */
static double part_done(const path *p)
{
  double part = (p->curve->points[p->curve->n - 1].omega - p->from) / (p->to - p->from);
  return fmin(1, fmax(0, part));
}

/* After an accepted step: append the trial, adapt the harmonics there, and end the curve if it left the sweep. */
static hc_status accept_trial(path *p, bool *done)
{
  hbm_curve *c = p->curve;
  hc_status st = append_trial(p);
  if (st == HC_OK) st = path_adapt(p);
  if (st == HC_OK) st = end_at_limit(p, done);
  bool known = false;
  if (st == HC_OK && !*done) st = is_known_from_here(p, &known);
  if (known) *done = true;
  if (st != HC_OK || !*done || known) return st;
  st = path_adapt(p); /* the limit is a point of its own */
  double last = c->points[c->n - 1].omega;
  *done =
      last == p->to || (c->left_at_start && last == p->course->behind); /* false if the adaptation dropped that point */
  return st;
}

/* After a step that was not accepted; step_status: HC_OK, or why there was no trial. Switches from natural to
 * arc-length steps, or tries a step over a join or round a corner, once for each point (over a join again for much
 * shorter steps). HC_OK: continue, with a shorter step if no point was added. */
static hc_status recover(path *p, hc_status step_status, bool *done)
{
  hbm_curve *c = p->curve;
  ++c->rejected;
  bool natural_fails = step_status != HC_OK || p->step < STEP_FIRST;
  if (p->natural && arclength_allowed(p) && natural_fails) switch_to_arclength(p);
  const slip_edges *edges = p->s->edges;
  const bool nearer = p->points_at_last_edge != c->n || p->step <= LESS * p->step_at_last_edge;
  const bool at_edge = edges && p->step < edges->too_short && nearer;
  bool at_corner = p->step < STEP_ROUND;
  const bool joined = at_edge && !p->natural && pass_join(p);
  bool past = joined;
  if (!past) past = at_corner && !p->natural && p->points_at_last_corner != c->n && round_corner(p);
  if (past) {
    TRACE(curve, "omega %.9g  %s", p->omega, joined ? "over a join of rest and slip" : "round a corner");
    hc_status st = append_trial(p);
    if (st == HC_OK) c->points[c->n - 1].over_join = joined;
    if (st == HC_OK) st = end_at_limit(p, done);
    p->tangent_only = true;
    return st;
  }
  if (at_edge) p->points_at_last_edge = c->n, p->step_at_last_edge = p->step;
  if (at_corner) p->points_at_last_corner = c->n;
  if (p->step < STEP_MIN) return step_status != HC_OK ? step_status : HC_STEP_TOO_SMALL;
  return HC_OK;
}

hc_status path_settle(hbm_solver *s, hbm_curve *c, int left)
{
  int settled = steps_are_fixed(s) ? c->n - left : c->settled;
  hc_status st = steps_are_fixed(s) ? HC_OK : hbm_curve_add_summits(s, c, left, &settled);
  if (st == HC_OK) st = hbm_curve_settle(c, left ? settled : c->n);
  return st;
}

/* Settles the points that can no longer change: not the last point nor those outside the sweep, which a point on a
 * limit may replace; none where harmonics or samples adapt. */
static hc_status settle_path(path *p)
{
  const int n = p->curve->n, left = p->first_outside ? n - p->first_outside : 1;
  const bool adapts = p->s->finer_harmonics || p->s->finer_samples;
  if (adapts || p->s->ramp || !p->course->may_come_from_above) return HC_OK;
  hc_status st = path_settle(p->s, p->curve, left);
  if (p->first_outside) p->first_outside += p->curve->n - n;
  return st;
}

/* HC_UNBOUNDED where the curve goes to infinity at the frequency of its last point. Only steep curves are examined:
 * where E is 1e6 W (growth.h), a relative change of omega by 1e-7 changes the amplitude by 100 %. */
static hc_status end_without_bound(const path *p)
{
  const hbm_point *last = &p->curve->points[p->curve->n - 1];
  const double steep = 1e-5; /* [1] d ln omega/d(motion), the largest that is examined */
  bool grows;
  if (p->s->ramp || !(path_flatness(p) * p->curve->omega_scale <= steep * last->omega)) return HC_OK;
  const hc_status st = hbm_growth(p->s, last->omega, hbm_curve_X(p->curve, p->curve->n - 1), &grows);
  return st == HC_NO_MEMORY ? st : st == HC_OK && grows ? HC_UNBOUNDED : HC_OK;
}

static hc_status follow(path *p, const hc_monitor *monitor)
{
  hbm_curve *c = p->curve;
  const hbm_solver *s = p->s;
  hc_status st = first_point(p, monitor);
  if (st == HC_OK) st = path_adapt(p);
  if (p->s->stopped) return HC_INTERRUPTED;
  bool done = p->from == p->to;
  while (st == HC_OK && !done && !p->more_samples) {
    if (c->n >= MAX_POINTS) return HC_TOO_MANY_POINTS;
    if (!hc_monitor_tick(monitor, part_done(p))) return HC_INTERRUPTED;
    bool accepted;
    p->s->done = p->course->may_come_from_above ? part_done(p) : -1;
    hc_status step_status = steps_are_fixed(s) ? path_fixed_step(p, &accepted) : trial_step(p, &accepted);
    bool no_other_step = !accepted && steps_are_fixed(s);
    if (step_status == HC_NO_MEMORY || no_other_step) return step_status;
    st = accepted ? accept_trial(p, &done) : recover(p, step_status, &done);
    if (st == HC_OK && accepted && !done) st = settle_path(p);
    if (st == HC_OK && accepted && !done) st = end_without_bound(p);
    if (p->s->stopped) return HC_INTERRUPTED;
  }
  return st;
}

/* Traces the course once, with a fixed number of samples. *more_samples: it should be traced again with more. */
static hc_status trace_once(path *p, const hc_monitor *monitor, bool *more_samples)
{
  hbm_curve *c = p->curve;
  c->n = c->turning_points = c->linear = c->edges = c->settled = 0;
  c->edge_omega = c->edge_motion = 0;
  c->inaccurate = c->left_at_start = c->closed = c->met = false;
  p->step = STEP_FIRST;
  p->natural = natural_allowed(p);
  c->arclength = !p->natural;
  const size_t n = (size_t)c->n_coef;
  workspace rows = {0};
  p->X = workspace_doubles(&rows, n), p->dX = workspace_doubles(&rows, n);
  p->X_predicted = workspace_doubles(&rows, n), p->chord = workspace_doubles(&rows, n);
  p->missed = workspace_doubles(&rows, n);
  p->normal = workspace_doubles(&rows, n + 1);
  hc_status st = rows.failed ? HC_NO_MEMORY : follow(p, monitor);
  workspace_free(&rows);
  bool gave_up = st != HC_OK && st != HC_NO_MEMORY && st != HC_INTERRUPTED &&
                 st != HC_UNBOUNDED; /* at a kink that more samples may smooth */
  *more_samples = p->more_samples || (gave_up && p->s->finer_samples && p->s->n_time < REFINE_MOST_SAMPLES);
  return st;
}

hc_status path_trace(hbm_solver *s, const path_course *course, const hc_monitor *monitor, hbm_curve *curve)
{
  const double from = course->from, to = course->to;
  const path start = {.s = s,
                      .curve = curve,
                      .course = course,
                      .from = from,
                      .to = to,
                      .direction = to >= from ? 1 : -1,
                      .kinked = model_has_kinks(s->model)};
  bool adapts = s->how.harmonics == HBM_AUTO, more_samples;
  curve->n_coef = adapts ? hbm_system_length(&s->sys, REFINE_MOST_HARMONICS) : s->sys.n_coef;
  hbm_curve_measure_by(curve, s->sys.metric, fmax(fabs(to - course->behind) / SWEEP_UNITS, LEAST_UNIT * from));
  long before = s->sys.evaluations;
  hc_status st;
  do {
    path p = start;
    p.resolution = fmin(curve->omega_scale, fmax(s->sys.scales.half_width, NARROWEST * from));
    if (s->ramp) p.resolution = curve->omega_scale;
    st = trace_once(&p, monitor, &more_samples);
    if (more_samples && (st = hbm_solver_resize(s, s->sys.n_harm, 2 * s->n_time)) != HC_OK) break;
  } while (more_samples);
  if (adapts && st != HC_NO_MEMORY) {
    hc_status cut = path_finish(s, curve);
    if (st == HC_OK) st = cut;
  }
  curve->evaluations = s->sys.evaluations - before;
  curve->ends_at = curve->n > 0 ? curve->points[curve->n - 1].omega : from;
  TRACE(curve, "ends at %.9g after %d points, %ld refused: %s%s", curve->ends_at, curve->n, (long)curve->rejected,
        hc_status_text(st),
        curve->closed ? ", closed"
        : curve->met  ? ", it met another part"
                      : "");
  return curve->end = st;
}

hc_status hbm_trace(hbm_solver *s, double from, double to, const hc_monitor *monitor, hbm_curve *curve)
{
  bool in_range = from > 0 && to > 0 && isfinite(from) && isfinite(to);
  bool adapts = s->finer_harmonics || s->finer_samples;
  if (!in_range || curve->n || (adapts && steps_are_fixed(s))) return HC_BAD_INPUT;
  s->monitor = monitor;
  s->done = -1;
  s->stopped = false;
  const path_course whole = {from, to, .behind = from, .may_come_from_above = !s->ramp};
  hc_status st = path_trace(s, &whole, monitor, curve);
  if (st == HC_INTERRUPTED || s->ramp) hbm_curve_settle(curve, curve->n);
  else if (st != HC_NO_MEMORY) {
    const hc_status settled = path_settle(s, curve, 0);
    if (st == HC_OK) st = settled;
  }
  s->monitor = NULL;
  s->stopped = false;
  return st;
}

void hbm_scale_steps(hbm_solver *s, double scale) { s->step_scale = scale > 0 && scale <= 1 ? scale : 1; }

/* ---- a first solution ----------------------------------------------------------------------------------- */

/* Each is tried where all before it failed:
 *     Newton from the linear response
 *     sampled forces: Newton from the solution with exact forces, found in the same way
 *     exact forces: quick ramps (ramp.h), of the damping, then of the force
 *     Newton from the guess of hbm_solver_take_guess
 *     slow ramps, of the damping, then of the force: followed like a response curve, round folds and corners
 * The end of a ramp is solved again with the model's own equations. The guess may take long: before the ramps it was
 * slower in 68 of 500 structures of `stress` (89 s for all instead of 22) and faster in three. Steps of quick ramps are
 * QUICK_STEPS times as long and solved to QUICK_TOLERANCE: six of seven slow first solutions are found 1.3 to 10 times
 * as fast. At a tolerance of 1e-5 half of the ramps fail. Slow ramps of 1173 scenes of `stress`: median 43 points, 99th
 * percentile 246, maximum 806 (1200 steps). */
static const double QUICK_STEPS = 2, QUICK_TOLERANCE = 1e-7;
enum { MOST_QUICK_STEPS = 1000, MOST_SLOW_STEPS = 1500, HALVINGS = 2 };

/* The monitor of a ramp: counts its steps, whose ticks carry the part done; ticks inside solves of large systems carry
 * -1. */
typedef struct ramp_watch {
  const hc_monitor *outer;
  int left;     /* number of steps left */
  bool stopped; /* true if the outer monitor asked to stop */
} ramp_watch;

static bool watch_step(void *self, double done)
{
  ramp_watch *w = self;
  w->stopped = !hc_monitor_tick(w->outer, -1); /* `done` is the ramp's, not that of the caller's work */
  return !w->stopped && (done < 0 || w->left-- > 0);
}

/* The curve along the ramp. Harmonics and samples stay fixed, and the linear closed form, valid only for a sweep of
 * omega, is off. */
static hc_status trace_ramp(hbm_solver *s, const hbm_ramp *ramp, const hc_monitor *monitor, hbm_curve *curve)
{
  const hbm_settings how = s->how;
  const double step_scale = s->step_scale;
  refinement *const harmonics = s->finer_harmonics, *const samples = s->finer_samples;
  s->how.harmonics = s->sys.n_harm;
  s->how.skip_linear = false;
  s->how.continuation = HBM_CONTINUATION_AUTO;
  s->finer_harmonics = s->finer_samples = NULL;
  s->step_scale = ramp->quick ? QUICK_STEPS : 1;
  if (ramp->quick) s->how.tolerance = fmax(s->how.tolerance, QUICK_TOLERANCE);
  s->ramp = ramp;
  hc_status st = hbm_trace(s, ramp->from, 1, monitor, curve);
  s->ramp = NULL;
  hbm_ramp_leave(&s->sys);
  s->step_scale = step_scale;
  s->finer_harmonics = harmonics;
  s->finer_samples = samples;
  s->how = how;
  return st == HC_OK && curve->left_at_start ? HC_NOT_CONVERGED : st;
}

static hc_status follow_ramp(hbm_solver *s, hbm_ramp_kind kind, bool quick, double omega, const hc_monitor *monitor,
                             double *X, hbm_point *point)
{
  hbm_ramp ramp = hbm_ramp_of(kind, &s->sys, omega);
  ramp.quick = quick;
  ramp_watch watch = {.outer = monitor, .left = quick ? MOST_QUICK_STEPS : MOST_SLOW_STEPS};
  const hc_monitor step = {watch_step, &watch};
  hbm_curve curve = {0};
  hc_status st = trace_ramp(s, &ramp, &step, &curve);
  if (st == HC_INTERRUPTED && !watch.stopped) st = HC_NOT_CONVERGED;
  if (st == HC_OK) {
    memcpy(X, hbm_curve_X(&curve, curve.n - 1), (size_t)s->sys.n_coef * sizeof(double));
    st = hbm_solve_fixed(s, omega, X, point);
    point->iterations += curve.iterations;
  }
  hbm_curve_free(&curve);
  return st;
}

typedef hc_status first_solution(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point);

static bool may_go_on(hc_status st) { return st != HC_OK && st != HC_INTERRUPTED && st != HC_NO_MEMORY; }

/* Solves from X, a solution with `fewer` harmonics or as many. If Newton fails, by way of the number of harmonics in
 * the middle, recursively at most `halvings` times. */
static hc_status with_more_harmonics(hbm_solver *s, int fewer, int halvings, double omega, double *X, hbm_point *point)
{
  const int middle = (fewer + s->sys.n_harm) / 2;
  for (int i = hbm_system_length(&s->sys, fewer); i < s->sys.n_coef; ++i) X[i] = 0;
  hc_status st = hbm_solve_fixed(s, omega, X, point);
  if (!may_go_on(st) || halvings == 0 || middle == fewer) return st;
  hbm_settings how = s->how;
  hbm_solver *other;
  how.harmonics = middle;
  if ((st = hbm_solver_new(s->model, &how, &other)) != HC_OK) return st;
  st = with_more_harmonics(other, fewer, halvings - 1, omega, X, point);
  s->solves += other->solves;
  hbm_solver_free(other);
  return st == HC_OK ? with_more_harmonics(s, middle, halvings - 1, omega, X, point) : st;
}

/* Solves from the solution that `find` finds with the settings `how`, of as many harmonics or fewer. */
static hc_status from_other(hbm_solver *s, const hbm_settings *how, first_solution *find, double omega,
                            const hc_monitor *monitor, double *X, hbm_point *point)
{
  hbm_solver *other;
  hc_status st = hbm_solver_new(s->model, how, &other);
  if (st != HC_OK) return st;
  other->guess = (hbm_guess){.ask = s->guess.ask, .self = s->guess.self}; /* s owns it */
  st = find(other, omega, monitor, X, point);
  const int iterations = point->iterations;
  if (st == HC_OK) st = with_more_harmonics(s, other->sys.n_harm, HALVINGS, omega, X, point);
  point->iterations += iterations;
  s->solves += other->solves;
  hbm_solver_free(other);
  return st;
}

/* For sampled forces: a path with exact forces has no spurious turning points, and costs less than one with many
 * samples. */
static hc_status from_exact_forces(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  hbm_settings how = s->how;
  how.force = HBM_FORCE_EXACT;
  how.harmonics = s->sys.n_harm;
  return from_other(s, &how, hbm_first_solution, omega, monitor, X, point);
}

static hc_status from_linear_response(hbm_solver *s, double omega, const hc_monitor *monitor, double *X,
                                      hbm_point *point)
{
  (void)monitor;
  hbm_linear_response(&s->sys, omega, X);
  return hbm_solve_fixed(s, omega, X, point);
}

static hc_status by_quick_ramp(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  hc_status st = from_linear_response(s, omega, monitor, X, point);
  return may_go_on(st) ? follow_ramp(s, HBM_RAMP_DAMPING, true, omega, monitor, X, point) : st;
}

/* A quick ramp of the damping; with many harmonics first one with FEW_HARMONICS, which takes a tenth of the time or
 * less. */
static hc_status by_quick_ramps(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  hbm_settings how = s->how;
  hc_status st = HC_NOT_CONVERGED;
  how.harmonics = FEW_HARMONICS;
  if (s->sys.n_harm >= 2 * FEW_HARMONICS) st = from_other(s, &how, by_quick_ramp, omega, monitor, X, point);
  return may_go_on(st) ? follow_ramp(s, HBM_RAMP_DAMPING, true, omega, monitor, X, point) : st;
}

static hc_status from_guess(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  double *x = malloc((size_t)s->model->n * (size_t)series_length(s->sys.n_harm) * sizeof *x);
  hc_status st = x ? s->guess.ask(s->guess.self, s->model, omega, s->sys.n_harm, monitor, x) : HC_NO_MEMORY;
  if (st == HC_OK) hbm_guess_of(s, x, X);
  free(x);
  if (st != HC_OK) return st;
  for (int i = 0; i < s->sys.first; ++i) X[i] = 0;
  return hbm_solve_fixed(s, omega, X, point);
}

static hc_status by_quick_force(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  return follow_ramp(s, HBM_RAMP_FORCE, true, omega, monitor, X, point);
}

static hc_status by_slow_damping(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  return follow_ramp(s, HBM_RAMP_DAMPING, false, omega, monitor, X, point);
}

static hc_status by_slow_force(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  return follow_ramp(s, HBM_RAMP_FORCE, false, omega, monitor, X, point);
}

hc_status hbm_first_solution(hbm_solver *s, double omega, const hc_monitor *monitor, double *X, hbm_point *point)
{
  const bool exact = s->how.force == HBM_FORCE_EXACT;
  const struct {
    const char *name;
    first_solution *find;
    bool applies;
  } ways[] = {
      {"from the linear response", from_linear_response, true},
      {"from the solution with exact forces", from_exact_forces, !exact},
      {"by a quick ramp of the damping", by_quick_ramps, exact},
      {"by a quick ramp of the force", by_quick_force, exact},
      {"from the guess", from_guess, s->guess.ask != NULL},
      {"by a slow ramp of the damping", by_slow_damping, true},
      {"by a slow ramp of the force", by_slow_force, true},
  };
  hc_status st = HC_NOT_CONVERGED;
  for (size_t i = 0; i < sizeof ways / sizeof *ways && may_go_on(st); ++i) {
    if (!ways[i].applies) continue;
    st = ways[i].find(s, omega, monitor, X, point);
    TRACE(first, "%d unknowns at omega %.9g, %s: %s", s->sys.n_coef, omega, ways[i].name, hc_status_text(st));
  }
  return st;
}

hc_status hbm_solve(hbm_solver *s, double omega, double *X, hbm_point *point)
{
  if (!is_zero(s->sys.n_coef, X)) return hbm_solve_fixed(s, omega, X, point); /* X = 0: no guess is given */
  hc_status st = hbm_first_solution(s, omega, NULL, X, point);
  if (st != HC_OK) memset(X, 0, (size_t)s->sys.n_coef * sizeof(double));
  return st;
}
