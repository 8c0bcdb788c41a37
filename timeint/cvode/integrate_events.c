/* integrate_events.c - see integrate.h: the equations that CVODE integrates in an interval between two changes of
 * contact state, the root functions that end it, changes of state, and a period.
 *
 * A contact has six root functions, so that a period allocates nothing: the guards of its state, which end it where
 * they fall through 0, and their rates, which end nothing. Without the rates a guard could fall and rise unseen within
 * a step; CVODE's search for the root of the rate evaluates all functions in between. Unused functions are 1; none is
 * exactly 0, which is an error for CVODE.
 *
 * Guards that are already negative at the beginning of an interval, or fall in the same instant as another contact's,
 * are passed at once. The monodromy matrix is fundamental_matrix.h's. */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/norm.h"
#include "numerics/sundials_compat.h"
#include "timeint/closed_form/fundamental_matrix.h"
#include "timeint/closed_form/motion_single.h"
#include "timeint/cvode/events_newton.h"
#include "timeint/cvode/integrate_cvode.h"

static const double at_end = 64 * DBL_EPSILON; /* [2 pi] distance from the end within which CVODE answers a restart with
                                                  CV_TOO_CLOSE */
static const double stiff = 60; /* largest decay rate over lowest frequency above which BDF takes fewer steps than
                                   Adams */

enum {
  ROOTS = 2 * TRACK_GUARDS,
  MAX_STANDSTILLS = 1000 /* returns of CVODE in succession that do not advance theta */
};

typedef struct events { /* from integrate_new_events, to integrate_free; not shared between threads */
  cvode_integrator base;
  int n, n_contacts;
  bool is_single;                  /* the structure is of motion_single.h */
  double theta0, theta1, began[2]; /* bounds of the current step; X, X' at its beginning */
  contact_track *track;            /* [n_contacts] current contact states */
  contact_forces_linear *law;      /* [n_contacts] linear forces in these states */
  int *info;                       /* [n_contacts][ROOTS] CVODE's root information */
  double *rate;                    /* [n_equations] work: dy, for the rates of guards */
  int n_own, n_equations;          /* number of contacts' own states (law_kind.h), the angles of e; equations: 2 n and
                                      most own states */
  int *own_of;                     /* [n_contacts] index of the contact's own state; -1: none */
  double *own;                     /* [n_own] work: own states at an angle of dense output */
  events_newton newton;
  double held_pull; /* largest change of a rate until N = 0 that keeping e constant may cause */
  int passed;       /* number of events since the period began */
  bool is_smooth;   /* a contact's law is smooth: the monodromy matrix is then from differences */
  bool varies;      /* this period computes the monodromy matrix */
  fundamental_matrix variations;
  interval_modes *modes; /* of the variations; or NULL */
} events;

/* ---- equations -------------------------------------------------------------------------------------- */

/* Forces that are not linear in the motion, and the rates of contacts' own states into dy. */
static void add_curved(const events *in, const double *y, double *dy)
{
  const step_equations *step = &in->newton.step;
  const int n = in->n;
  memset(dy + 2 * n, 0, (size_t)(in->n_equations - 2 * n) * sizeof *dy); /* without friction, too */
  if (in->n_own == 0 && !in->is_smooth) return;
  for (int j = 0; j < in->n_contacts; j += scaled_directions(in->base.m, j)) {
    const scaled_contact *c = &in->base.m->contact[j];
    const int own = in->own_of[j];
    if (!in->track[j].turns && !c->kind->smooth) continue;
    const contact_motion at = scaled_motion_at(in->base.m, j, y);
    const law_pull pull = c->kind->pull(&in->track[j], c, &at, own >= 0 ? y[2 * n + own] : 0);
    if (own >= 0) dy[2 * n + own] = pull.rate;
    for (int a = 0; a < c->kind->directions; ++a) step_equations_add(step->force, step->rows.along[j + a], pull.t[a]);
    step_equations_add(step->force, step->rows.across[j], pull.n);
  }
}

/* dy at y, in the current contact states. */
static void events_rate(const events *in, double theta, const double *y, double *dy)
{
  const scaled_model *m = in->base.m;
  const step_equations *step = &in->newton.step;
  const int n = in->n;
  scaled_linear_force(m, theta, y, dy + n);
  contact_rows_motion(&step->rows, y, step->q);
  memset(step->force, 0, (size_t)step->n_rows * sizeof *step->force);
  for (int j = 0; j < in->n_contacts; ++j) {
    const contact_forces_linear *f = &in->law[j];
    const double u = contact_rows_at(step->q, step->rows.along[j]), v = contact_rows_at(step->q, step->rows.across[j]);
    step_equations_add(step->force, step->rows.along[j], f->t_u * u + f->t_v * v + f->t_0);
    step_equations_add(step->force, step->rows.across[j], f->n_v * v + f->n_0);
  }
  add_curved(in, y, dy);
  contact_rows_pull(&step->rows, 1, step->force, dy + n);
  memcpy(dy, y + n, (size_t)n * sizeof *dy);
}

static bool rate(cvode_integrator *base, double theta, const double *y, double *dy)
{
  const events *in = (const events *)base;
  double sum = 0;
  events_rate(in, theta, y, dy);
  for (int i = 0; i < in->n_equations; ++i) sum += dy[i];
  return isfinite(sum);
}

static void linearise(cvode_integrator *base, const double *y)
{
  events_newton_linearise(&((events *)base)->newton, base->m, y);
}

static bool factor(cvode_integrator *base, double gamma)
{
  return events_newton_factor(&((events *)base)->newton, base->m, gamma);
}

static void solve(cvode_integrator *base, double *r) { events_newton_solve(&((events *)base)->newton, r); }

static const cvode_equations equations = {rate, linearise, factor, solve};

/* ---- guards ------------------------------------------------------------------------------------------- */

static law_instant instant_at(const events *in, int j, double theta, const double *y, const double *dy)
{
  law_instant now = {.at = scaled_motion_at(in->base.m, j, y), .theta = theta};
  scaled_contact_motion(in->base.m, j, dy + in->n, now.bend, &now.normal_bend);
  if (in->own_of[j] >= 0) now.own = y[2 * in->n + in->own_of[j]];
  return now;
}

/* The guards of contact j at theta and y with rate dy; returns their number. g[0], g[1]: value and rate, g[2], without
 * an own state: half the second derivative. */
static int events_guards(const events *in, int j, double theta, const double *y, const double *dy,
                         track_guard guard[TRACK_GUARDS])
{
  const scaled_contact *c = &in->base.m->contact[j];
  const law_instant now = instant_at(in, j, theta, y, dy);
  if (in->own_of[j] >= 0) return c->kind->own_guards(&in->track[j], c, &now, in->held_pull, guard);
  const double u[TRACK_TERMS] = {now.at.u[0], now.at.du[0], 0.5 * now.bend[0]};
  const double v[TRACK_TERMS] = {now.at.v, now.at.dv, 0.5 * now.normal_bend};
  return contact_track_guards(&in->track[j], c, u, v, guard);
}

/* CVODE multiplies values on either side of a root: this must not underflow. */
static double never_zero(double g) { return g != 0 ? g : -1e-100; }

static int events_roots(sunrealtype theta, N_Vector y, sunrealtype *g, void *self)
{
  events *in = self;
  const double *z = NV_DATA_S(y);
  events_rate(in, theta, z, in->rate);
  for (int i = 0; i < ROOTS * in->n_contacts; ++i) g[i] = 1;
  for (int j = 0; j < in->n_contacts; j += scaled_directions(in->base.m, j)) {
    track_guard guard[TRACK_GUARDS];
    const int n = events_guards(in, j, theta, z, in->rate, guard);
    for (int i = 0; i < n; ++i) {
      g[j * ROOTS + i] = never_zero(guard[i].g[0]);
      g[j * ROOTS + TRACK_GUARDS + i] = never_zero(guard[i].g[1]);
    }
  }
  return 0;
}

/* ---- changes of state ---------------------------------------------------------------------------------- */

static void use_states(events *in)
{
  for (int j = 0; j < in->n_contacts; ++j) in->law[j] = contact_track_forces(&in->track[j], &in->base.m->contact[j]);
}

static double *own_states(const events *in) { return NV_DATA_S(in->base.y) + 2 * in->n; }

/* Sets the direction in t[], the tracks of contact j, from its own state in own[n_own]. */
static void follow_own(const events *in, int j, const double *own, contact_track *t)
{
  if (t->turns) in->base.m->contact[j].kind->own_follow(t, own[in->own_of[j]]);
}

/* Notes the turn of contact j's direction, at an event or at the end of the period. */
static void note_turn(events *in, int j)
{
  contact_track *t = &in->track[j];
  if (t->turns) contact_track_note_turn(t, &in->base.m->contact[j], own_states(in)[in->own_of[j]] - t->opens.began);
}

/* Sets the own state of contact j at theta, and the start of the turn after a touch. */
static void begin_own(events *in, int j, double theta)
{
  const scaled_contact *c = &in->base.m->contact[j];
  double *y = NV_DATA_S(in->base.y);
  contact_track *t = &in->track[j];
  if (!t->turns || !c->kind->own_begin) return; /* only laws with an own state turn */
  own_states(in)[in->own_of[j]] = c->kind->own_begin(t);
  if (!t->fresh) return;
  for (int a = 0; a < c->kind->directions; ++a) t[a].fresh = false;
  events_rate(in, theta, y, in->rate);
  const law_instant now = instant_at(in, j, theta, y, in->rate);
  c->kind->own_open(t, c, &now);
}

/* Passes the event of contact j at theta. TRACK_TURNS and TRACK_HOLDS are no changes of state, and do not concern the
 * monodromy matrix. */
static hc_status pass(events *in, int j, track_event event, double theta, int *count)
{
  const scaled_contact *c = &in->base.m->contact[j];
  contact_track *t = &in->track[j];
  const bool varies = in->varies && event != TRACK_TURNS && event != TRACK_HOLDS;
  const contact_motion at = scaled_motion_at(in->base.m, j, NV_DATA_S(in->base.y));
  for (int i = 0; i < in->n_contacts; i += scaled_directions(in->base.m, i))
    follow_own(in, i, own_states(in), &in->track[i]);
  const contact_track before[2] = {t[0], t[c->kind->directions - 1]};
  *count += c->kind->counts(t, event, theta);
  const int most = integrate_most_transitions(in->n_contacts);
  if (*count > most || (++in->passed > 8 * most && in->own_of[j] >= 0)) return HC_CHATTER;
  hc_status st = varies ? fundamental_matrix_advance(&in->variations, in->base.m, in->track, theta) : HC_OK;
  if (st != HC_OK) return st;
  note_turn(in, j);
  contact_track_pass(t, c, event, &at);
  contact_track_note(t, c, &at);
  if (varies) {
    fundamental_matrix_pass(&in->variations, in->base.m, j, before, t, &at);
    fundamental_matrix_follow(&in->variations, in->base.m, in->track, NV_DATA_S(in->base.y));
  }
  use_states(in);
  begin_own(in, j, theta);
  return HC_OK;
}

/* True if the guard is at or below 0 and falls further. If its rate is 0 the second derivative decides; that of an own
 * state's guard is unknown, 0. */
static bool goes_on_falling(const track_guard *guard)
{
  const double *g = guard->g, noise = guard->noise;
  if (!(g[0] <= noise)) return false;
  return g[1] < -noise || (g[1] <= noise && g[2] < -noise);
}

/* Passes guards that have fallen and fall further, until there is none. */
static hc_status pass_fallen(events *in, double theta, int *count)
{
  for (bool more = true; more;) {
    more = false;
    for (int j = 0; j < in->n_contacts; j += scaled_directions(in->base.m, j)) {
      track_guard guard[TRACK_GUARDS];
      const double *y = NV_DATA_S(in->base.y);
      events_rate(in, theta, y, in->rate);
      const int n = events_guards(in, j, theta, y, in->rate, guard);
      for (int i = 0; i < n; ++i) {
        if (!goes_on_falling(&guard[i])) continue;
        hc_status st = pass(in, j, guard[i].event, theta, count);
        if (st != HC_OK) return st;
        more = true;
        break;
      }
    }
  }
  return HC_OK;
}

/* Restarts CVODE at theta, in the current contact states. */
static hc_status start(events *in, double theta)
{
  int flag = CVodeReInit(in->base.cv, theta, in->base.y);
  if (flag == CV_SUCCESS) flag = CVodeSetStopTime(in->base.cv, TWO_PI);
  return integrate_translate(&in->base, flag);
}

/* Passes the roots on which CVODE stopped at theta. A contact's first guard, separation or touch, has priority over its
 * others. */
static hc_status pass_roots(events *in, double theta, int *count)
{
  int flag = CVodeGetRootInfo(in->base.cv, in->info);
  if (flag != CV_SUCCESS) return integrate_translate(&in->base, flag);
  const int before = in->passed;
  const double *y = NV_DATA_S(in->base.y);
  hc_status st = HC_OK;
  events_rate(in, theta, y, in->rate);
  for (int j = 0; j < in->n_contacts && st == HC_OK; j += scaled_directions(in->base.m, j)) {
    track_guard guard[TRACK_GUARDS];
    const int n = events_guards(in, j, theta, y, in->rate, guard);
    for (int i = 0; i < n; ++i) {
      if (!in->info[j * ROOTS + i]) continue;
      st = pass(in, j, guard[i].event, theta, count);
      break;
    }
  }
  if (st == HC_OK && in->passed > before) st = pass_fallen(in, theta, count);
  if (st != HC_OK || in->passed == before || theta == TWO_PI) return st;
  st = integrate_add_counts(&in->base);
  return st == HC_OK ? start(in, theta) : st;
}

/* From theta = 0 to the end of the period. At tout == tstop version 6.4 says CV_SUCCESS, 7 says CV_TSTOP_RETURN. */
static hc_status integrate_to_end(events *in, integrate_watch *watch, void *self, int *count)
{
  sunrealtype theta = 0;
  for (int standstills = 0; theta < TWO_PI;) {
    sunrealtype before = theta;
    memcpy(in->began, NV_DATA_S(in->base.y), sizeof in->began);
    int flag = CVode(in->base.cv, TWO_PI, in->base.y, &theta, watch ? CV_ONE_STEP : CV_NORMAL);
    if (flag != CV_SUCCESS && flag != CV_TSTOP_RETURN && flag != CV_ROOT_RETURN)
      return integrate_translate(&in->base, flag);
    if (TWO_PI - theta <= at_end * TWO_PI) theta = TWO_PI;
    standstills = theta > before ? 0 : standstills + 1;
    if (standstills > MAX_STANDSTILLS) break;
    in->theta0 = before, in->theta1 = theta;
    hc_status st = watch && theta > before ? watch(self, &in->base.base, before, theta) : HC_OK;
    if (st == HC_OK && flag == CV_ROOT_RETURN) st = pass_roots(in, theta, count);
    if (st != HC_OK) return st;
  }
  return integrate_check_end(&in->base, theta, in->n_equations);
}

static hc_status begin(events *in, const double *y, int *count)
{
  double size = 0;
  for (int i = 0; i < in->base.m->n_states; ++i) size += fabs(y[i]);
  if (!isfinite(size)) return HC_NOT_FINITE;
  memcpy(NV_DATA_S(in->base.y), y, 2 * (size_t)in->n * sizeof *y);
  /* Indices of the contacts' own states. */
  in->n_own = 0;
  for (int j = 0; j < in->n_contacts; ++j) {
    const scaled_contact *c = &in->base.m->contact[j];
    in->own_of[j] = c->kind->own_begin && c->direction == 0 ? in->n_own++ : -1;
  }
  for (int i = in->n_own; i < in->n_equations - 2 * in->n; ++i) own_states(in)[i] = 0; /* without friction */
  in->passed = 0;
  for (int j = 0; j < in->n_contacts; j += scaled_directions(in->base.m, j)) {
    const contact_motion at = scaled_motion_at(in->base.m, j, y);
    contact_track_begin(&in->track[j], &in->base.m->contact[j], &at, y + 2 * in->n + j);
    begin_own(in, j, 0);
  }
  use_states(in);
  hc_status st =
      in->varies ? fundamental_matrix_begin(&in->variations, in->base.m, in->track, y, in->base.base.coarse) : HC_OK;
  return st == HC_OK ? pass_fallen(in, 0, count) : st;
}

/* integrate_turn: the direction of contact j's slip from in->own. */
static void turn(const void *self, int j, contact_track *t)
{
  const events *in = self;
  follow_own(in, j, in->own, t);
}

static hc_status period(integrator *base, const scaled_model *m, double *y, double *monodromy, integrate_watch *watch,
                        void *self);

/* The step h of central differences, for laws that are nonlinear over a motion or velocity `a`: truncation error
 * (h/a)^2, rounding of a period 1e-12/h. */
static double difference_step(const scaled_model *m, const double *y)
{
  double a = 1;
  for (int j = 0; j < m->n_contacts; ++j) {
    const scaled_contact *c = &m->contact[j];
    const contact_motion at = scaled_motion_at(m, j, y);
    const double moves = hypot(at.v, at.dv) / norm_max(m->n, m->base->normal + (size_t)j * (size_t)m->n);
    if (c->kind->smooth) a = fmin(a, c->kind->bend ? c->kind->bend(&c->law) : moves);
  }
  return fmax(1e-4 * pow(a, 2. / 3), 1e-8);
}

/* The monodromy matrix by central differences of the period map: error about 1e-8 for laws that are nonlinear over a
 * motion of 1. A coarse matrix uses one-sided differences. */
static hc_status differ(events *in, const double *y, double *monodromy)
{
  const scaled_model *m = in->base.m;
  const size_t n = (size_t)m->n_states;
  const double h = difference_step(m, y);
  const long transitions = in->base.base.transitions;
  const bool coarse = in->base.base.coarse;
  double *ends = calloc(2 * n, sizeof *ends);
  hc_status st = ends ? HC_OK : HC_NO_MEMORY;
  memset(monodromy, 0, n * n * sizeof *monodromy);
  for (size_t j = 0; j < n; ++j) {
    if (j >= 2 * (size_t)m->n && !m->contact[j - 2 * (size_t)m->n].law.has_friction) continue; /* no slider */
    for (size_t s = 0; s < (coarse && j > 0 ? 1 : 2) && st == HC_OK; ++s) {
      memcpy(ends + s * n, y, n * sizeof *y);
      if (s == 0 || !coarse) ends[s * n + j] += s ? -h : h;
      st = period(&in->base.base, m, ends + s * n, NULL, NULL, NULL);
    }
    const double apart = coarse ? h : 2 * h;
    for (size_t i = 0; i < n && st == HC_OK; ++i) monodromy[j * n + i] = (ends[i] - ends[n + i]) / apart;
  }
  in->base.base.transitions = transitions;
  free(ends);
  return st;
}

static hc_status period(integrator *base, const scaled_model *m, double *y, double *monodromy, integrate_watch *watch,
                        void *self)
{
  events *in = (events *)base;
  int count = 0;
  if (m->n != in->n || m->n_contacts != in->n_contacts) return HC_BUG;
  in->base.m = m;
  if (in->is_smooth && monodromy) {
    hc_status st = differ(in, y, monodromy);
    if (st != HC_OK) return st;
    monodromy = NULL;
  }
  in->varies = monodromy != NULL;
  hc_status st = integrate_begin_period(&in->base);
  if (st == HC_OK) st = begin(in, y, &count);
  if (st == HC_OK) st = start(in, 0);
  if (st == HC_OK) {
    st = integrate_to_end(in, watch, self, &count);
    hc_status counted = integrate_add_counts(&in->base);
    if (st == HC_OK) st = counted;
  }
  base->transitions += count;
  if (st == HC_OK && monodromy) st = fundamental_matrix_advance(&in->variations, m, in->track, TWO_PI);
  if (st != HC_OK) return st;
  memcpy(y, NV_DATA_S(in->base.y), 2 * (size_t)in->n * sizeof *y);
  for (int j = 0; j < in->n_contacts; j += scaled_directions(m, j)) {
    follow_own(in, j, own_states(in), &in->track[j]);
    note_turn(in, j);
  }
  integrate_sliders(in->track, m, 0, NULL, NULL, y); /* directions of slips are already set from own states */
  contact_track_end(in->track, in->n_contacts, y + 2 * in->n);
  if (monodromy) fundamental_matrix_end(&in->variations, m, in->track, y, monodromy);
  return HC_OK;
}

static hc_status dense(const integrator *base, double theta, int order, double *y)
{
  const events *in = (const events *)base;
  if (CVodeGetDky(in->base.cv, theta, order, in->base.dky) != CV_SUCCESS) return HC_BUG; /* theta outside the step */
  memcpy(y, NV_DATA_S(in->base.dky), 2 * (size_t)in->n * sizeof *y);
  memcpy(in->own, NV_DATA_S(in->base.dky) + 2 * in->n, (size_t)in->n_own * sizeof *in->own);
  if (order == 1 && in->n_own > 0) {
    if (CVodeGetDky(in->base.cv, theta, 0, in->base.dky) != CV_SUCCESS) return HC_BUG;
    memcpy(in->own, NV_DATA_S(in->base.dky) + 2 * in->n, (size_t)in->n_own * sizeof *in->own);
  }
  if (order <= 1) integrate_sliders(in->track, in->base.m, order, turn, in, y);
  return HC_OK;
}

/* The step's motion solves a linear equation, and so its integrals follow from its ends. */
static bool fourier(const integrator *base, int i, double out[3])
{
  const events *in = (const events *)base;
  const scaled_model *m = in->base.m;
  if (!in->is_single || in->is_smooth ||
      !motion_single_integrals(m, in->track, in->theta0, in->began, in->theta1, NV_DATA_S(in->base.y), out))
    return false;
  for (int k = 0; k < 3; ++k) out[k] *= m->base->response[i];
  return true;
}

static void release(integrator *base)
{
  events *in = (events *)base;
  interval_modes_free(in->modes);
  integrate_free_parts(&in->base);
  free(base);
}

static const integrator_class class = {.period = period,
                                       .dense = dense,
                                       .samples = integrate_dense_samples,
                                       .fourier = fourier,
                                       .tolerance = integrate_cvode_tolerance,
                                       .free = release};

static hc_status make_roots(events *in)
{
  const int n = ROOTS * in->n_contacts;
  if (n > 0 && CVodeRootInit(in->base.cv, n, events_roots) != CV_SUCCESS) return HC_NO_MEMORY;
  for (int i = 0; i < n; ++i) in->info[i] = i % ROOTS < TRACK_GUARDS ? -1 : 0; /* guards fall */
  const int flags[] = {
      n > 0 ? CVodeSetRootDirection(in->base.cv, in->info) : CV_SUCCESS,
      CVodeSetEtaFixedStepBounds(in->base.cv, 0.9, 1.2), /* from 0, 1.5: a third fewer steps, and a tenth of the
                                                            error (c2 at omega 9) */
      CVodeSetNoInactiveRootWarn(in->base.cv),
      CVodeSetMaxStep(in->base.cv, INTEGRATE_LONGEST_STEP),
  };
  return integrate_set_up(flags, sizeof flags / sizeof *flags);
}

hc_status integrate_new_events(const modal_base *base, double tolerance, integrator **out)
{
  const size_t contacts = (size_t)base->n_contacts;
  *out = NULL;
  events *in = calloc(1, sizeof *in); /* zeroed, so free works half-built */
  if (!in) return HC_NO_MEMORY;
  const bool bdf = base->decay > stiff * base->lowest;
  in->base.base.does = &class;
  in->is_smooth = base->is_smooth;
  in->base.base.has_coarse = base->n_planar > 0 || base->is_smooth;
  in->base.base.scatter = bdf ? INTEGRATE_BDF_SCATTER : INTEGRATE_ADAMS_SCATTER;
  in->n = base->n;
  in->n_contacts = base->n_contacts;
  in->base.tolerance = tolerance;
  in->base.n_sized = 2 * base->n;
  in->held_pull = fmax(1e-17, 1e-3 * tolerance);
  in->is_single = motion_single_fits(base) && base->n_planar == 0;
  in->n_equations = 2 * base->n + base->n_planar;
  workspace *w = &in->base.memory;
  in->base.base.track = in->track = workspace_array(w, contacts, sizeof *in->track);
  in->law = workspace_array(w, contacts, sizeof *in->law);
  in->info = workspace_array(w, ROOTS * contacts, sizeof *in->info);
  in->rate = workspace_doubles(w, (size_t)in->n_equations);
  in->own = workspace_doubles(w, (size_t)base->n_planar);
  in->own_of = workspace_array(w, contacts, sizeof *in->own_of);
  hc_status st = interval_modes_new(base, INTERVAL_MODES_STIFF, &in->modes);
  if (st == HC_OK) st = fundamental_matrix_make(&in->variations, base, in->modes, w);
  if (st == HC_OK) st = events_newton_make(&in->newton, base, in->track, in->law, in->own_of, w);
  if (st == HC_OK) st = integrate_make_parts(&in->base, in->n_equations, bdf ? CV_BDF : CV_ADAMS, &equations);
  if (st == HC_OK) st = make_roots(in);
  if (st == HC_OK) {
    *out = &in->base.base;
    return HC_OK;
  }
  release(&in->base.base);
  return st;
}
