/* truth.c - see truth.h. The number of harmonics starts at LEAST_HARMONICS, or twice the case's, and is doubled until
 * the solutions are within a tenth of the gate of the exact law's orbits: a verdict is then wrong only for points
 * within that of the limit. */
#include "compare/verify/truth/truth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/gate_limits.h"
#include "compare/motion.h"
#include "compare/response.h"
#include "compare/verify/truth/solutions.h"
#include "compare/work_limit.h"
#include "hbm/curve/segment.h"
#include "numerics/base/constants.h"
#include "numerics/base/workspace.h"
#include "numerics/series.h"

/* ---- the acceleration of a motion that is a solution, from the equation of motion. The series of x'' would need some
 * 1000 harmonics for three digits, as its coefficients decay like 1/k^2; x and x' need far fewer. ---- */

enum { SAMPLES = 4096, SETTLING = 2 }; /* a period; periods before the one that counts */

/* An instant, with the sliders then. */
typedef struct instant {
  double th;
  series_jet x;
  double *w; /* [n_contacts] */
} instant;

static series_jet motion_at(const verify_motion *motion, double th)
{
  return series_at(motion->n_harm, motion->X, cos(th), sin(th));
}

/* x'' at to->th, the sliders being from->w before; to->x and to->w get what they are then. */
static double follow(const model *m, const verify_motion *motion, const instant *from, instant *to)
{
  to->x = motion_at(motion, to->th);
  double force = model_force(m) * cos(to->th) - *m->damping * motion->omega * to->x.d1 - *m->stiffness * to->x.x;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    const double u = *c->tangent * to->x.x, v = *c->normal * to->x.x, v_before = *c->normal * from->x.x;
    double traction = 0, w = from->w[j];
    /* The slider where the contact touches again between two instants: on the chord of u, where that of v + gap is
     * 0. */
    if (v_before + c->law.gap < 0 && v + c->law.gap > 0) {
      const double open = *c->normal * from->x.x + c->law.gap, closed = *c->normal * to->x.x + c->law.gap,
                   part = open / (open - closed);
      w = *c->tangent * (from->x.x + part * (to->x.x - from->x.x));
    }
    if (contact_has_friction(&c->law)) contact_step(&c->law, u, v, &w, &traction);
    to->w[j] = w;
    force -= *c->tangent * traction + *c->normal * contact_normal_change(&c->law, v);
  }
  return force / *m->mass;
}

/* The largest sign x'' within a sample of `top`, from the instant `before` that; by golden sections, since x'' has one
 * maximum there, smooth or a kink. */
static double refine(const model *m, const verify_motion *motion, int sign, const instant *before, instant *try)
{
  const double golden = 0.6180339887498949;
  double low = before->th, high = low + 2 * TWO_PI / SAMPLES, most = -INFINITY;
  double a[2] = {high - golden * (high - low), low + golden * (high - low)}, f[2];
  for (int i = 0; i < 2; ++i) try->th = a[i], f[i] = sign * follow(m, motion, before, try);
  while (high - low > 1e-8 * TWO_PI / SAMPLES) {
    const int worse = f[0] < f[1] ? 0 : 1;
    if (worse == 0) low = a[0], a[0] = a[1], f[0] = f[1], a[1] = low + golden * (high - low);
    else high = a[1], a[1] = a[0], f[1] = f[0], a[0] = high - golden * (high - low);
    try->th = a[1 - worse];
    f[1 - worse] = sign * follow(m, motion, before, try);
    most = fmax(most, fmax(f[0], f[1]));
  }
  return most;
}

size_t acceleration_room(const model *m) { return 4 * (size_t)m->n_contacts + 1; }

double acceleration_amplitude(const model *m, const verify_motion *motion, double *room)
{
  const size_t n = (size_t)m->n_contacts, bytes = n * sizeof *room;
  instant here = {.th = 0, .x = motion_at(motion, 0), .w = room}, next = {.w = room + n};
  instant before[2] = {{.w = room + 2 * n}, {.w = room + 3 * n}}; /* the instants before the largest, the smallest */
  double most[2] = {-INFINITY, -INFINITY};                        /* of x'' and -x'' */
  for (int i = 1; i <= (SETTLING + 1) * SAMPLES; ++i) {
    next.th = TWO_PI * i / SAMPLES;
    const double a = follow(m, motion, &here, &next);
    for (int k = 0; k < 2 && i > SETTLING * SAMPLES; ++k) {
      if (!((k ? -a : a) > most[k])) continue;
      most[k] = k ? -a : a;
      before[k].th = here.th;
      before[k].x = here.x;
      memcpy(before[k].w, here.w, bytes);
    }
    double *const free_w = here.w;
    here = next;
    next.w = free_w;
  }
  for (int k = 0; k < 2; ++k) most[k] = fmax(most[k], refine(m, motion, k ? -1 : 1, &before[k], &next));
  return 0.5 * (most[0] + most[1]);
}

/* ---- what is at hand ---- */

enum { LEAST_HARMONICS = 20, ENOUGH_HARMONICS = 80, DEARER = 4, MOST_COARSER = 2 }; /* 20 and 40 */

typedef struct truth {
  const compare_setup *setup;
  const verify_data *data;
  const hc_monitor *monitor;
  verify_report *out;
  verify_curves *curves;
  response_curve response, coarser[MOST_COARSER]; /* among these; of fewer harmonics each, from the first on */
  int n_coarser;
  timeint *referee;
  workspace memory;
  double *state; /* [n_states] of the referee's */
  double from, to;
  double near_error;                        /* [1] the largest error of the truth that is not another motion's */
  double *room;                             /* acceleration_room */
  double series[2 * HBM_MAX_HARMONICS + 1]; /* of a response */
  bool incomplete;                          /* of the row that is judged a solution is not known, or its measures */
} truth;

/* A solution as the file's quantity is taken of it. */
typedef struct measured {
  double value, scale;
  bool mean_free;
} measured;

static const double window_factor = 7; /* a little over 2 pi: mixed units are seen from there */

void verify_window(const compare_setup *setup, const verify_data *data, double *from, double *to)
{
  number_list ends = {.n = 2, .v = {INFINITY, 0}};
  const double low = fmin(setup->omega_from, setup->omega_to) / window_factor,
               high = fmax(setup->omega_from, setup->omega_to) * window_factor;
  for (int i = 0; i < data->n; ++i) {
    double omega = data->points[i].omega;
    if (omega < low || omega > high) continue;
    ends.v[0] = fmin(ends.v[0], omega);
    ends.v[1] = fmax(ends.v[1], omega);
  }
  if (!(ends.v[0] <= ends.v[1])) ends.n = 0;
  comparison_sweep(setup->omega_from, setup->omega_to, &ends, from, to);
}

static double verify_gate(const compare_setup *setup, const verify_quantity *q)
{
  const discrepancy *most = &setup->limits->most;
  if (q->kind == KIND_MEAN) return most->mean;
  return q->kind == KIND_HARMONIC && q->harmonic == 1 ? most->harmonic_1 : most->amplitude;
}

/* ---- one point ---- */

/* +1, -1, or 0: unknown. *st becomes HC_NO_MEMORY if that is why. */
static int truth_stable(truth *t, double omega, const double *X, hc_status *st)
{
  hbm_stability s;
  hc_status known = hbm_stability_at(t->response.hbm, omega, X, &s);
  if (known == HC_NO_MEMORY) *st = known;
  return known == HC_OK ? hbm_stability_verdict(&s) : 0;
}

/* HC_OK, or why it cannot be measured. */
static hc_status truth_measure(truth *t, double omega, const double *X, measured *out)
{
  hbm_measures m;
  verify_motion motion;
  hc_status st = verify_motion_of_solution(t->response.hbm, omega, X, t->data->response, t->series, &m, &motion);
  if (st != HC_OK) return st;
  const verify_quantity *q = &t->data->quantity;
  const bool mean_free = m.contact.free_sliders > 0;
  if (q->kind == KIND_ACCELERATION) {
    st = hbm_sliders(t->response.hbm, X, t->room);
    const double amplitude = st == HC_OK ? acceleration_amplitude(t->setup->model, &motion, t->room) : NAN;
    *out = (measured){amplitude, amplitude, mean_free};
    return st;
  }
  *out = (measured){verify_quantity_of(q, &motion), verify_quantity_scale(q, &motion), mean_free};
  return HC_OK;
}

/* The nearest of the solutions *at to the row's value, or -1; its measures into *nearest. */
static int truth_nearest(truth *t, const hbm_curve *at, const verify_row *row, measured *nearest)
{
  int best = -1;
  double least = INFINITY;
  for (int k = 0; k < at->n; ++k) {
    measured m;
    const bool known = truth_measure(t, row->omega, at->X + (size_t)k * at->n_coef, &m) == HC_OK;
    t->incomplete |= !known;
    if (!known) continue;
    double d = fabs(m.value - row->value);
    if (d < least) least = d, best = k, *nearest = m;
  }
  return best;
}

/* Every solution of the curve at omega; where the curve ended before, one found without it. HC_NO_MEMORY. t->incomplete
 * where one that the curve has was not found. */
static hc_status truth_at(truth *t, double omega, hbm_curve *at)
{
  if (omega < fmin(t->from, t->to) || omega > fmax(t->from, t->to)) return HC_OK;
  const hc_status found = hbm_curve_at(t->response.hbm, &t->response.curve, omega, at);
  if (found == HC_NO_MEMORY) return found;
  t->incomplete |= found != HC_OK;
  if (at->n > 0) return HC_OK;
  double *X = calloc((size_t)t->response.curve.n_coef, sizeof *X);
  hbm_point point;
  hc_status st = X ? hbm_first_solution(t->response.hbm, omega, NULL, X, &point) : HC_NO_MEMORY;
  at->n_coef = t->response.curve.n_coef;
  if (st == HC_OK && (at->X = X) && (at->points = calloc(1, sizeof point))) {
    at->points[0] = point;
    at->points[0].omega = omega;
    at->points[0].branch = 0;
    at->n = at->cap = 1;
    return HC_OK;
  }
  if (at->X != X) free(X);
  return st == HC_NO_MEMORY || at->X ? HC_NO_MEMORY : HC_OK;
}

/* ---- a point held against the curve around its omega: at a turning point, where the slope is infinite, the least
 * shift of omega would leave a right point without a solution near. */

/* A frequency counts as right to this part of the gate, relative. */
static const double omega_part = 0.1;

/* A piece of the curve within that of a point's omega: the values on it, from its ends. */
typedef struct piece {
  double low, high;
  const hbm_curve *at; /* the solutions at one end */
  int k;               /* the number of the one whose value is nearest the point's */
  measured end;        /* of that */
} piece;

/* Is the branch walked towards higher omegas, and its upper end a turning point to the next one? */
static bool walked_upwards(const truth *t, int branch) { return (branch % 2 == 0) == (t->to > t->from); }

static int number_of_branch(const hbm_curve *at, int branch)
{
  for (int k = 0; k < at->n; ++k)
    if (at->points[k].branch == branch) return k;
  return -1;
}

/* The piece from solution a of *at to solution b of *other, if it is nearer to the row's value than *best. */
static void try_piece(truth *t, const verify_row *row, const hbm_curve *at, int a, const hbm_curve *other, int b,
                      double *least, piece *best)
{
  measured ma, mb;
  if (truth_measure(t, at->points[a].omega, at->X + (size_t)a * at->n_coef, &ma) != HC_OK) return;
  if (truth_measure(t, other->points[b].omega, other->X + (size_t)b * other->n_coef, &mb) != HC_OK) return;
  const double low = fmin(ma.value, mb.value), high = fmax(ma.value, mb.value),
               away = fmax(fmax(low - row->value, row->value - high), 0);
  if (!(away < *least)) return;
  const bool first = fabs(ma.value - row->value) <= fabs(mb.value - row->value);
  *least = away;
  *best = (piece){low, high, first ? at : other, first ? a : b, first ? ma : mb};
}

/* The nearest piece between the solutions `below` and `above` the row's omega; false: there is none. */
static bool nearest_piece(truth *t, const verify_row *row, const hbm_curve *below, const hbm_curve *above, piece *best)
{
  double least = INFINITY;
  for (int k = 0; k < below->n; ++k) {
    const int branch = below->points[k].branch, across = number_of_branch(above, branch),
              next = number_of_branch(below, branch + 1);
    if (across >= 0) try_piece(t, row, below, k, above, across, &least, best);
    else if (next >= 0 && walked_upwards(t, branch)) try_piece(t, row, below, k, below, next, &least, best);
  }
  for (int k = 0; k < above->n; ++k) {
    const int branch = above->points[k].branch, next = number_of_branch(above, branch + 1);
    if (number_of_branch(below, branch) < 0 && next >= 0 && !walked_upwards(t, branch))
      try_piece(t, row, above, k, above, next, &least, best);
  }
  return least < INFINITY;
}

/* A row that differs is held against the pieces of the curve around its omega. HC_NO_MEMORY. */
static hc_status truth_look_around(truth *t, verify_row *row)
{
  const double part = omega_part * t->out->gate;
  hbm_curve below = {0}, above = {0};
  piece best = {.at = &below};
  hc_status st = truth_at(t, row->omega * (1 - part), &below);
  if (st == HC_OK) st = truth_at(t, row->omega * (1 + part), &above);
  if (st == HC_OK && nearest_piece(t, row, &below, &above, &best)) {
    const double nearest = fmin(fmax(row->value, best.low), best.high),
                 error = discrepancy_relative(row->value - nearest, best.end.scale);
    if (error <= t->out->gate) {
      const hbm_point *p = &best.at->points[best.k];
      row->nearest = nearest;
      row->scale = best.end.scale;
      row->error = error;
      row->branch = p->branch;
      row->stable = truth_stable(t, p->omega, best.at->X + (size_t)best.k * best.at->n_coef, &st);
    }
  }
  hbm_curve_free(&below);
  hbm_curve_free(&above);
  return st;
}

/* ---- the truth at some of the points against the exact law's periodic orbits next to it. */

enum { MOST_CHECKS = 20, MOST_HELD = 200, MOST_GATES = 10, MOST_MISSES = 3 }; /* beyond MOST_GATES: another motion */
static const double from_rest = 1;                                            /* [s] that a motion from rest may take */

/* The file's quantity, of the orbit next to the row's solution, by as many harmonics as its samples tell apart. */
static measured orbit_measured(const truth *t, const timeint_result *orbit)
{
  enum { HARMONICS = 200 };
  double X[2 * HARMONICS + 1];
  const periodic_motion wave = motion_of_transient(orbit);
  const verify_quantity *q = &t->data->quantity;
  motion_harmonics(&wave, HARMONICS, X);
  X[0] = orbit->mean;
  X[1] = orbit->a1;
  X[2] = orbit->b1;
  const verify_motion motion = {
      .omega = orbit->omega, .max = orbit->max, .min = orbit->min, .n_harm = HARMONICS, .X = X};
  if (q->kind == KIND_ACCELERATION) {
    memset(t->room, 0, (size_t)t->setup->model->n_contacts * sizeof *t->room);
    const double amplitude = acceleration_amplitude(t->setup->model, &motion, t->room);
    return (measured){amplitude, amplitude, false};
  }
  const double value = q->kind == KIND_RMS ? orbit->rms : verify_quantity_of(q, &motion);
  return (measured){value, verify_quantity_scale(q, &motion), motion_mean_is_free(orbit)};
}

static const measured nothing = {NAN, NAN, false};

/* *orbit, the referee's last, becomes that of the file's response. */
static hc_status of_response(const truth *t, timeint_result *orbit)
{
  return t->data->response > 0 ? timeint_response(t->referee, t->data->response, orbit) : HC_OK;
}

/* *of_orbit: the orbit next to the solution on that branch, or, where the branch is not there, next to the one nearest
 * to the row; a value of NaN where there is none. Its multiplier; *m: of the solution. HC_INTERRUPTED, HC_NO_MEMORY. */
static hc_status orbit_beside(truth *t, const verify_row *row, int branch, measured *m, measured *of_orbit,
                              double *multiplier)
{
  hbm_curve at = {0};
  timeint_result orbit;
  *of_orbit = nothing;
  hc_status st = truth_at(t, row->omega, &at), found = HC_NOT_CONVERGED;
  int k = st == HC_OK ? number_of_branch(&at, branch) : -1;
  if (k < 0 || truth_measure(t, row->omega, at.X + (size_t)k * at.n_coef, m) != HC_OK)
    k = st == HC_OK ? truth_nearest(t, &at, row, m) : -1;
  if (k >= 0) {
    found = comparison_orbit_start(t->response.hbm, at.X + (size_t)k * at.n_coef, row->omega, t->state);
    if (found == HC_OK) found = timeint_orbit(t->referee, row->omega, 1, t->state, t->monitor, &orbit);
    if (found == HC_OK) found = of_response(t, &orbit);
    if (found == HC_INTERRUPTED || found == HC_NO_MEMORY) st = found;
  }
  hbm_curve_free(&at);
  const bool known = found == HC_OK && !(verify_quantity_of_mean(&t->data->quantity) && motion_mean_is_free(&orbit));
  if (known) *of_orbit = orbit_measured(t, &orbit), *multiplier = orbit.multiplier;
  return st;
}

/* The same, counted, and the error of the solution. */
static hc_status check_row(truth *t, const verify_row *row, double *of_orbit, double *multiplier)
{
  measured m = {0}, orbit;
  const hc_status st = orbit_beside(t, row, row->branch, &m, &orbit, multiplier);
  *of_orbit = orbit.value;
  if (isnan(*of_orbit)) return ++t->out->unchecked, st;
  const double error = discrepancy_relative(*of_orbit - m.value, m.scale);
  ++t->out->checked;
  t->out->checked_error = fmax(t->out->checked_error, error);
  if (error <= MOST_GATES * t->out->gate) t->near_error = fmax(t->near_error, error);
  return st;
}

/* At most MOST_CHECKS points, spread over the file: out->checked, unchecked, checked_error. HC_INTERRUPTED,
 * HC_NO_MEMORY. */
static hc_status truth_check(truth *t)
{
  verify_report *out = t->out;
  hc_status st = HC_OK;
  double of_orbit, multiplier;
  int n = out->n_rows < MOST_CHECKS ? out->n_rows : MOST_CHECKS;
  out->checked = out->unchecked = 0;
  out->checked_error = t->near_error = 0;
  for (int i = 0; i < n && st == HC_OK; ++i) {
    const verify_row *row = &out->rows[n > 1 ? (int)((long)i * (out->n_rows - 1) / (n - 1)) : 0];
    if (row->branch >= 0 && !row->skipped) st = check_row(t, row, &of_orbit, &multiplier);
    if (st == HC_OK && !hc_monitor_tick(t->monitor, -1)) st = HC_INTERRUPTED;
  }
  return st;
}

/* A truth is not known to be exact if no point of it could be checked. */
static bool truth_is_exact(const truth *t)
{
  return t->out->checked_error <= 0.1 * t->out->gate && (t->out->checked > 0 || t->out->unchecked == 0);
}

/* A row that differs by less than the error of the truth itself is not judged. */
static void leave_open(const truth *t, verify_row *row)
{
  if (row->verdict == VERDICT_DIFFERS && row->error <= t->out->gate + t->near_error)
    row->verdict = VERDICT_SOLVER_FAILED;
}

static void lies_on_orbit(truth *t, verify_row *row, double multiplier)
{
  row->stable = multiplier < 1 ? 1 : multiplier > 1 ? -1 : 0;
  row->verdict = row->stable < 0 ? VERDICT_UNSTABLE : VERDICT_MATCH;
  ++t->out->on_orbits;
}

/* Compares the row with the exact law's orbit next to the truth. A row on that orbit matches. Without an orbit, a row
 * that differs is not judged; with an orbit far from the truth, only if it differs by more than the truth's error. */
static hc_status hold_against_orbit(truth *t, verify_row *row)
{
  double of_orbit, multiplier = NAN;
  const hc_status st = check_row(t, row, &of_orbit, &multiplier);
  if (st != HC_OK) return st;
  const bool differs = row->verdict == VERDICT_DIFFERS;
  const double error = discrepancy_relative(row->value - of_orbit, row->scale);
  if (isnan(of_orbit)) {
    if (differs) *row = verify_row_unjudged(&(verify_point){row->omega, row->value, row->line});
    return HC_OK;
  }
  const bool near = discrepancy_relative(of_orbit - row->nearest, row->scale) <= MOST_GATES * t->out->gate;
  if (error <= row->error) row->nearest = of_orbit, row->error = error;
  if (!(error <= t->out->gate)) {
    if (!near) leave_open(t, row);
    return HC_OK;
  }
  lies_on_orbit(t, row, multiplier);
  return HC_OK;
}

/* Where the truth is not exact, or its curve ended early. */
static hc_status hold_against_orbits(truth *t)
{
  verify_report *out = t->out;
  hc_status st = HC_OK;
  const bool exact = truth_is_exact(t);
  if (exact && t->response.curve.end == HC_OK) return st;
  int held = 0;
  for (; held < out->n_rows && held < MOST_HELD && st == HC_OK; ++held) {
    verify_row *row = &out->rows[held];
    if (row->branch >= 0 && !row->skipped && (!exact || verify_row_differs(row))) st = hold_against_orbit(t, row);
    if (st == HC_OK && !hc_monitor_tick(t->monitor, -1)) st = HC_INTERRUPTED;
  }
  for (int i = held; i < out->n_rows; ++i) leave_open(t, &out->rows[i]);
  return st;
}

/* The motion from rest, which may be on a branch that the curve does not reach; NaN where it has not period 1. */
static hc_status orbit_from_rest(truth *t, const verify_row *row, measured *of_orbit, double *multiplier)
{
  work_limit limit = {.outer = t->monitor, .until = thread_seconds() + from_rest};
  const hc_monitor monitor = {work_limit_tick, &limit};
  timeint_result orbit;
  timeint_rest(t->referee, t->state);
  const hc_status found = timeint_steady(t->referee, row->omega, t->state, &monitor, &orbit);
  const bool known = found == HC_OK && orbit.period_multiple == 1 && of_response(t, &orbit) == HC_OK;
  *of_orbit = known ? orbit_measured(t, &orbit) : nothing;
  *multiplier = 0; /* it has settled */
  return found == HC_NO_MEMORY || limit.stopped ? found : HC_OK;
}

static hc_status orbit_beside_curve(truth *t, const verify_row *row, measured *of_orbit, double *multiplier)
{
  measured m;
  return orbit_beside(t, row, -1, &m, of_orbit, multiplier);
}

/* Compares rows that differ or could not be judged with other orbits. Ends after MOST_MISSES rows in turn that do not
 * match. */
static hc_status hold_against_others(truth *t, hc_status (*other)(truth *, const verify_row *, measured *, double *))
{
  verify_report *out = t->out;
  hc_status st = HC_OK;
  for (int i = 0, misses = 0; i < out->n_rows && misses < MOST_MISSES && st == HC_OK; ++i) {
    verify_row *row = &out->rows[i];
    double multiplier = NAN;
    measured of_orbit;
    if (!verify_row_differs(row)) continue;
    st = other(t, row, &of_orbit, &multiplier);
    const double scale = isnan(row->scale) ? of_orbit.scale : row->scale,
                 error = discrepancy_relative(row->value - of_orbit.value, scale);
    const bool on_it = error <= out->gate;
    misses = on_it ? 0 : misses + 1;
    if (!on_it) continue;
    row->nearest = of_orbit.value;
    row->scale = scale;
    row->error = error;
    row->branch = -1;
    lies_on_orbit(t, row, multiplier);
  }
  return st;
}

/* Curves of fewer harmonics may be of another branch, where the first solution was another. */
static hc_status hold_against_coarser(truth *t)
{
  hc_status st = HC_OK;
  for (int i = 0; i < t->n_coarser && st == HC_OK; ++i) {
    const response_curve finest = t->response;
    t->response = t->coarser[i];
    st = hold_against_others(t, orbit_beside_curve);
    t->response = finest;
  }
  return st;
}

/* ---- each point, and the number of harmonics ---- */

verify_row verify_row_unjudged(const verify_point *p)
{
  verify_row row = {.omega = p->omega, .value = p->value, .line = p->line, .branch = -1};
  row.nearest = row.scale = row.error = NAN;
  row.verdict = VERDICT_SOLVER_FAILED;
  return row;
}

/* The row's solution becomes number k of *at, measured as m. */
static void row_takes(const truth *t, const hbm_curve *at, int k, const measured *m, verify_row *row)
{
  row->branch = at->points[k].branch;
  row->nearest = m->value;
  row->scale = m->scale;
  row->free_sliders = m->mean_free;
  row->skipped = m->mean_free && verify_quantity_of_mean(&t->data->quantity);
  row->error = row->skipped ? NAN : discrepancy_relative(row->value - row->nearest, m->scale);
}

/* The solution nearest to the row, number k, is unstable. Another may be stable, and is taken if it is within the gate,
 * too: next to each other, the value does not tell them apart. */
static void look_for_stable(truth *t, const hbm_curve *at, int k, verify_row *row, hc_status *st)
{
  for (int j = 0; j < at->n; ++j) {
    const double *X = at->X + (size_t)j * (size_t)at->n_coef;
    measured m;
    if (j == k || truth_stable(t, row->omega, X, st) <= 0) continue;
    row->stable_too = true;
    verify_row other = *row;
    if (truth_measure(t, row->omega, X, &m) != HC_OK) continue;
    row_takes(t, at, j, &m, &other);
    other.stable = 1;
    if (!(other.error <= t->out->gate)) continue;
    *row = other;
    return;
  }
}

static hc_status judge_point(truth *t, const verify_point *p, verify_row *row)
{
  hbm_curve at = {0};
  measured m = {0};
  *row = verify_row_unjudged(p);
  t->incomplete = false;
  hc_status st = truth_at(t, p->omega, &at);
  int k = st == HC_OK ? truth_nearest(t, &at, row, &m) : -1;
  if (k >= 0 && at.points) {
    row->solutions = at.n;
    row_takes(t, &at, k, &m, row);
    row->stable = truth_stable(t, p->omega, at.X + (size_t)k * at.n_coef, &st);
    if (!row->skipped && !(row->error <= t->out->gate) && st == HC_OK) st = truth_look_around(t, row);
    row->stable_too = row->stable > 0;
    if (row->stable < 0) look_for_stable(t, &at, k, row, &st);
    row->verdict = row->skipped                    ? VERDICT_MATCH
                   : !(row->error <= t->out->gate) ? (t->incomplete ? VERDICT_SOLVER_FAILED : VERDICT_DIFFERS)
                   : row->stable < 0               ? VERDICT_UNSTABLE
                                                   : VERDICT_MATCH;
  }
  hbm_curve_free(&at);
  return st;
}

/* ---- all points ---- */

/* The curve with H harmonics, and everything on it. */
static hc_status with_harmonics(truth *t, int harmonics)
{
  const response_curve *curve;
  if (t->response.hbm) t->coarser[t->n_coarser++] = t->response;
  const hc_status st = verify_curve_of(t->curves, t->setup, harmonics, t->from, t->to, t->monitor, &curve);
  t->response = curve ? *curve : (response_curve){.hbm = NULL};
  if (!curve) return st;
  t->out->harmonics = harmonics;
  t->out->curve_end = t->response.curve.end;
  t->out->curve_omega = t->response.curve.n ? t->response.curve.points[t->response.curve.n - 1].omega : t->from;
  if (st != HC_OK) return st;
  hc_status judged = HC_OK;
  t->out->n_rows = 0;
  for (int i = 0; i < t->data->n && judged == HC_OK; ++i) {
    judged = judge_point(t, &t->data->points[i], &t->out->rows[i]);
    if (judged == HC_OK) t->out->n_rows = i + 1;
    if (!hc_monitor_tick(t->monitor, 0.5 * (i + 1) / t->data->n)) judged = HC_INTERRUPTED;
  }
  return judged == HC_OK ? truth_check(t) : judged;
}

enum { BETWEEN = 4 }; /* steps from one point of the curve to the next */

static hc_status put_line_point(truth *t, double omega, const double *X, int stable)
{
  measured m;
  hc_status st = truth_measure(t, omega, X, &m);
  if (st == HC_OK) t->out->line[t->out->n_line++] = (verify_line){omega, m.value, stable};
  return st;
}

hc_status verify_truth(const compare_setup *setup, const verify_data *data, double until, const hc_monitor *monitor,
                       verify_curves *curves, verify_report *out)
{
  truth t = {.setup = setup, .data = data, .monitor = monitor, .curves = curves, .out = out};
  out->gate = verify_gate(setup, &data->quantity);
  out->rows = calloc((size_t)data->n, sizeof *out->rows);
  verify_window(setup, data, &t.from, &t.to);
  compare_setup referee = *setup;
  referee.transient.start = TRANSIENT_START_REST; /* one on HBM's orbits would look for one next to rest */
  if (!model_is_smooth(setup->model)) referee.transient.method = TRANSIENT_METHOD_CLOSED_FORM;
  hc_status st = out->rows ? comparison_referee(&referee, NULL, &t.referee) : HC_NO_MEMORY;
  if (st == HC_OK) t.state = workspace_doubles(&t.memory, (size_t)timeint_n_states(t.referee));
  t.room = workspace_doubles(&t.memory, acceleration_room(setup->model));
  if (t.memory.failed) st = HC_NO_MEMORY;
  int harmonics = 2 * setup->hbm.harmonics; /* 0 for auto */
  harmonics = harmonics < LEAST_HARMONICS     ? LEAST_HARMONICS
              : harmonics > HBM_MAX_HARMONICS ? HBM_MAX_HARMONICS
                                              : harmonics;
  for (bool again = true; again && st == HC_OK; harmonics *= 2) {
    const double began = thread_seconds();
    st = with_harmonics(&t, harmonics);
    const double now = thread_seconds(), next = DEARER * (now - began); /* [s] of twice as many harmonics */
    again = !truth_is_exact(&t) && 2 * harmonics <= ENOUGH_HARMONICS && now + next < until;
  }
  if (st == HC_OK) st = hold_against_orbits(&t);
  if (st == HC_OK) st = hold_against_coarser(&t);
  if (st == HC_OK) st = hold_against_others(&t, orbit_from_rest);
  /* The curve as it is drawn into out->line: its points, and some between them, since a drawing joins them by straight
   * lines. HC_NO_MEMORY, or why it cannot be measured. */
  if (st == HC_OK && data->with_line) {
    const hbm_curve *c = &t.response.curve;
    double *X = malloc(((size_t)c->n_coef + 1) * sizeof *X);
    out->n_line = 0;
    out->line = calloc((size_t)BETWEEN * (size_t)c->n + 1, sizeof *out->line);
    st = X && out->line ? HC_OK : HC_NO_MEMORY;
    for (int k = 0; k < c->n && st == HC_OK; ++k) {
      const double *here = c->X + (size_t)k * (size_t)c->n_coef;
      const int stable = truth_stable(&t, c->points[k].omega, here, &st);
      if (st == HC_OK) st = put_line_point(&t, c->points[k].omega, here, stable);
      if (k + 1 == c->n) break;
      const hbm_segment segment = hbm_segment_between(c, k);
      for (int i = 1; i < BETWEEN && st == HC_OK; ++i) {
        double omega;
        hbm_segment_at(&segment, (double)i / BETWEEN, X, &omega, NULL, NULL);
        st = put_line_point(&t, omega, X, stable);
      }
    }
    free(X);
  }
  workspace_free(&t.memory);
  timeint_free(t.referee);
  return st;
}
