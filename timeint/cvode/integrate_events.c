/* integrate_events.c - see integrate_events.h. What holds between two changes of contact state is events_interval.h's;
 * here is what happens at one, and from the first to the last of a period.
 *
 * A guard that has fallen at the beginning of an interval, or with another contact's in the same instant, is passed at
 * once. The monodromy matrix is fundamental_matrix.h's. */
#include "timeint/cvode/integrate_events.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "numerics/sundials_compat.h"
#include "timeint/cvode/events_interval.h"

static const double at_end = 64 * DBL_EPSILON; /* nearer to 2 pi CVODE would answer CV_TOO_CLOSE to a restart */
static const double stiff = 60; /* largest decay rate over lowest frequency, from where on BDF takes fewer steps */

enum {
  MAX_STEPS = 1000000,   /* between transitions */
  MAX_STANDSTILLS = 1000 /* returns of CVODE in succession that do not advance theta */
};

static void use_states(events *in)
{
  for (int j = 0; j < in->n_contacts; ++j) in->law[j] = contact_track_forces(&in->track[j], &in->base.m->contact[j]);
}

/* The directions of circles that slip, from their angles. */
static void follow_angles(events *in)
{
  const double *phi = NV_DATA_S(in->base.y) + 2 * in->n;
  for (int i = 0; i < in->n_planar; ++i) {
    contact_track *t = &in->track[in->angle[i].contact];
    if (!planar_track_turns(t)) continue;
    t[0].along = cos(phi[i]);
    t[1].along = sin(phi[i]);
  }
}

/* The circle whose first direction is j, where it stops turning, or the period ends. */
static void note_turn(events *in, int j)
{
  const int i = in->angle_of[j];
  if (planar_track_turns(&in->track[j]))
    slider_travel_note_turn(&in->travel, j, NV_DATA_S(in->base.y)[2 * in->n + i] - in->angle[i].began);
}

/* In motion from theta on: its angle, and the direction that it has at a touch. */
static void begin_angle(events *in, int j, double theta)
{
  double *y = NV_DATA_S(in->base.y);
  planar_angle *a = &in->angle[in->angle_of[j]];
  contact_track *t = &in->track[j];
  a->opens = false;
  if (!planar_track_turns(t)) return;
  a->began = y[2 * in->n + in->angle_of[j]] = atan2(t[1].along, t[0].along);
  if (!t->fresh) return;
  t[0].fresh = t[1].fresh = false;
  events_rate(in, theta, y, in->rate);
  const angle_motion now = events_angle_motion_at(in, j, theta, y, in->rate);
  planar_angle_open(a, &in->base.m->contact[j], &now);
}

/* The circle whose first direction is j. That its angle is held, or no more, is no change of state. */
static hc_status pass_planar(events *in, int j, track_event event, double theta, int *count)
{
  const contact_track before[2] = {in->track[j], in->track[j + 1]};
  const scaled_contact *c = &in->base.m->contact[j];
  const planar_contact_motion at = events_planar_at(in, j, NV_DATA_S(in->base.y));
  hc_status st = HC_OK;
  const bool changes = event != TRACK_TURNS && event != TRACK_HOLDS;
  if (++in->passed > 8 * integrate_most_transitions(in->n_contacts)) return HC_CHATTER;
  if (changes && ++*count > integrate_most_transitions(in->n_contacts)) return HC_CHATTER;
  if (changes && in->varies) st = fundamental_matrix_advance(&in->variations, in->base.m, in->track, theta);
  if (st != HC_OK) return st;
  note_turn(in, j);
  planar_track_pass(&in->track[j], c, event, &at);
  slider_travel_note_planar(&in->travel, c, in->track, j, &at);
  if (changes && in->varies) {
    fundamental_matrix_planar(&in->variations, in->base.m, j, before, &in->track[j], &at);
    fundamental_matrix_follow(&in->variations, in->base.m, in->track, NV_DATA_S(in->base.y));
  }
  use_states(in);
  begin_angle(in, j, theta);
  return HC_OK;
}

static hc_status pass(events *in, int j, track_event event, double theta, int *count)
{
  const contact_state before = in->track[j].state;
  contact_motion at;
  follow_angles(in);
  if (in->base.m->contact[j].circle) return pass_planar(in, j, event, theta, count);
  events_motion_at(in, j, NV_DATA_S(in->base.y), NULL, &at, NULL);
  ++in->passed;
  *count += contact_track_counts(&in->track[j], event, theta);
  if (*count > integrate_most_transitions(in->n_contacts)) return HC_CHATTER;
  hc_status st = in->varies ? fundamental_matrix_advance(&in->variations, in->base.m, in->track, theta) : HC_OK;
  if (st != HC_OK) return st;
  contact_track_pass(&in->track[j], &in->base.m->contact[j], event, &at);
  slider_travel_note(&in->travel, &in->base.m->contact[j], in->track, j, &at);
  if (in->varies && in->track[j].state == CONTACT_STICK)
    fundamental_matrix_stick(&in->variations, in->base.m, j, before, &at);
  if (in->varies) fundamental_matrix_follow(&in->variations, in->base.m, in->track, NV_DATA_S(in->base.y));
  use_states(in);
  return HC_OK;
}

/* Has the guard fallen, and does it go on falling? At rest its second derivative says; a circle has none. */
static bool goes_on_falling(const events *in, int j, const track_guard *guard)
{
  const double *g = guard->g, noise = guard->noise;
  if (!(g[0] <= noise)) return false;
  return g[1] < -noise || (g[1] <= noise && !in->base.m->contact[j].circle && g[2] < -noise);
}

/* Guards that have fallen already and go on falling; until there is none. */
static hc_status pass_fallen(events *in, double theta, int *count)
{
  for (bool more = true; more;) {
    more = false;
    for (int j = 0; j < in->n_contacts; ++j) {
      track_guard guard[TRACK_GUARDS];
      const double *y = NV_DATA_S(in->base.y);
      events_rate(in, theta, y, in->rate);
      const int n = events_guards(in, j, theta, y, in->rate, guard);
      for (int i = 0; i < n; ++i) {
        if (!goes_on_falling(in, j, &guard[i])) continue;
        hc_status st = pass(in, j, guard[i].event, theta, count);
        if (st != HC_OK) return st;
        more = true;
        break;
      }
    }
  }
  return HC_OK;
}

/* CVODE from theta on, in the states as they are. */
static hc_status start(events *in, double theta)
{
  int flag = CVodeReInit(in->base.cv, theta, in->base.y);
  if (flag == CV_SUCCESS) flag = CVodeSetStopTime(in->base.cv, TWO_PI);
  return integrate_translate(&in->base, flag);
}

/* CVODE stopped on roots at theta. A contact's first guard, which is that of separation or touch, counts before its
 * others. */
static hc_status pass_roots(events *in, double theta, int *count)
{
  int flag = CVodeGetRootInfo(in->base.cv, in->info);
  if (flag != CV_SUCCESS) return integrate_translate(&in->base, flag);
  const int before = in->passed;
  const double *y = NV_DATA_S(in->base.y);
  hc_status st = HC_OK;
  events_rate(in, theta, y, in->rate);
  for (int j = 0; j < in->n_contacts && st == HC_OK; ++j) {
    track_guard guard[TRACK_GUARDS];
    const int n = events_guards(in, j, theta, y, in->rate, guard);
    for (int i = 0; i < n; ++i) {
      if (!in->info[j * EVENTS_ROOTS + i]) continue;
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

/* Which contacts are circles. */
static void find_planar_contacts(events *in)
{
  int i = 0;
  in->passed = 0;
  for (int j = 0; j < in->n_contacts; ++j) {
    in->angle_of[j] = in->base.m->contact[j].circle ? i : -1;
    if (in->angle_of[j] < 0) continue;
    in->angle[i++] = (planar_angle){.contact = j, .held_pull = fmax(1e-17, 1e-3 * in->tolerance)};
  }
  in->n_planar = i;
  for (; i < in->n_equations - 2 * in->n; ++i) NV_Ith_S(in->base.y, 2 * in->n + i) = 0; /* without friction */
}

static hc_status begin(events *in, const double *y, int *count)
{
  double size = 0;
  for (int i = 0; i < in->base.m->n_states; ++i) size += fabs(y[i]);
  if (!isfinite(size)) return HC_NOT_FINITE;
  memcpy(NV_DATA_S(in->base.y), y, 2 * (size_t)in->n * sizeof *y);
  find_planar_contacts(in);
  for (int j = 0; j < in->n_contacts; ++j) {
    const scaled_contact *c = &in->base.m->contact[j];
    contact_motion at;
    if (c->circle) {
      const planar_contact_motion both = events_planar_at(in, j, y);
      planar_track_begin(&in->track[j], c, &both, y + 2 * in->n + j);
      begin_angle(in, j, 0);
    } else if (!c->second) {
      events_motion_at(in, j, y, NULL, &at, NULL);
      in->track[j] = contact_track_begin(c, &at, y[2 * in->n + j]);
    }
  }
  use_states(in);
  slider_travel_begin(&in->travel, in->track, y + 2 * in->n);
  if (in->varies) {
    in->variations.theta = 0;
    fundamental_matrix_begin(&in->variations, in->base.m, in->track, y);
    fundamental_matrix_follow(&in->variations, in->base.m, in->track, y);
  }
  return pass_fallen(in, 0, count);
}

/* Sliders of the motion y (order 0), or their rates where y is its derivative; circles that slip in the directions of
 * their angles phi[n_planar]. */
static void set_sliders(const events *in, int order, const double *phi, double *y)
{
  double *w = y + 2 * in->n;
  for (int j = 0; j < in->n_contacts; j += scaled_directions(in->base.m, j)) {
    const scaled_contact *c = &in->base.m->contact[j];
    const contact_track *t = &in->track[j];
    contact_motion at;
    events_motion_at(in, j, y, NULL, &at, NULL);
    const bool sticks = t->state == CONTACT_STICK && c->law.has_friction;
    if (c->circle) {
      contact_track circle[2] = {t[0], t[1]};
      const planar_contact_motion both = events_planar_at(in, j, y);
      const double angle = phi[in->angle_of[j]];
      if (planar_track_turns(t)) circle[0].along = cos(angle), circle[1].along = sin(angle);
      if (order == 0) planar_track_slider(circle, c, &both, w + j);
      else planar_track_slider_rate(circle, c, both.u, both.v, w + j);
    } else if (order == 0) {
      w[j] = contact_track_slider(t, c, &at);
    } else {
      w[j] = sticks ? 0 : contact_track_vary_slider(t, c, at.u, at.v);
    }
  }
}

static hc_status period(integrator *base, const scaled_model *m, double *y, double *monodromy, integrate_watch *watch,
                        void *self)
{
  events *in = (events *)base;
  int count = 0;
  if (m->n != in->n || m->n_contacts != in->n_contacts) return HC_BUG;
  in->base.m = m;
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
  follow_angles(in);
  for (int i = 0; i < in->n_planar; ++i) note_turn(in, in->angle[i].contact);
  set_sliders(in, 0, NV_DATA_S(in->base.y) + 2 * in->n, y);
  slider_travel_end(&in->travel, in->track, y + 2 * in->n);
  if (monodromy) fundamental_matrix_end(&in->variations, m, in->track, y, monodromy);
  return HC_OK;
}

static hc_status dense(const integrator *base, double theta, int order, double *y)
{
  const events *in = (const events *)base;
  if (CVodeGetDky(in->base.cv, theta, order, in->base.dky) != CV_SUCCESS) return HC_BUG; /* theta outside the step */
  memcpy(y, NV_DATA_S(in->base.dky), 2 * (size_t)in->n * sizeof *y);
  memcpy(in->phi, NV_DATA_S(in->base.dky) + 2 * in->n, (size_t)in->n_planar * sizeof *in->phi);
  if (order == 1 && in->n_planar > 0) {
    if (CVodeGetDky(in->base.cv, theta, 0, in->base.dky) != CV_SUCCESS) return HC_BUG;
    memcpy(in->phi, NV_DATA_S(in->base.dky) + 2 * in->n, (size_t)in->n_planar * sizeof *in->phi);
  }
  if (order <= 1) set_sliders(in, order, in->phi, y);
  return HC_OK;
}

/* The step's motion solves a linear equation, and so its integrals follow from its ends. */
static bool fourier(const integrator *base, int i, double out[3])
{
  const events *in = (const events *)base;
  const scaled_model *m = in->base.m;
  if (!in->is_single ||
      !motion_single_integrals(m, in->track, in->theta0, in->began, in->theta1, NV_DATA_S(in->base.y), out))
    return false;
  for (int k = 0; k < 3; ++k) out[k] *= m->base->response[i];
  return true;
}

static contact_state state(const integrator *base, int j, const double *y)
{
  (void)y;
  return ((const events *)base)->track[j].state;
}

static double travel(const integrator *base, int j) { return ((const events *)base)->travel.most[j]; }

static void release(integrator *base)
{
  events *in = (events *)base;
  fundamental_matrix_free(&in->variations);
  slider_travel_free(&in->travel);
  interval_modes_free(in->modes);
  integrate_free_parts(&in->base);
  free(in->track);
  free(in->law);
  free(in->info);
  free(in->rate);
  free(in->angle);
  free(in->angle_of);
  free(base);
}

static const integrator_class class = {.period = period,
                                       .dense = dense,
                                       .samples = integrate_dense_samples,
                                       .fourier = fourier,
                                       .state = state,
                                       .travel = travel,
                                       .tolerance = integrate_cvode_tolerance,
                                       .free = release};

/* What fails here is memory, whatever the flag (CVodeSetLinearSolver's CVLS_MEM_FAIL is the number
 * of CV_CONV_FAILURE). */
static hc_status make_cvode(events *in)
{
  N_VConst(0.0, in->base.y);
  int flag = CVodeInit(in->base.cv, events_rhs, 0.0, in->base.y); /* first: the other calls need it */
  if (flag == CV_SUCCESS && in->n_contacts > 0)
    flag = CVodeRootInit(in->base.cv, EVENTS_ROOTS * in->n_contacts, events_roots);
  if (flag != CV_SUCCESS) return HC_NO_MEMORY;
  for (int i = 0; i < EVENTS_ROOTS * in->n_contacts; ++i)
    in->info[i] = i % EVENTS_ROOTS < TRACK_GUARDS ? -1 : 0; /* guards fall */
  const int flags[] = {
      HC_CVODE_QUIET(in->base.cv),
      CVodeSStolerances(in->base.cv, in->tolerance, in->tolerance),
      CVodeSetUserData(in->base.cv, in),
      CVodeSetLinearSolver(in->base.cv, in->base.ls, in->base.jac),
      CVodeSetJacFn(in->base.cv, events_jacobian),
      in->n_contacts > 0 ? CVodeSetRootDirection(in->base.cv, in->info) : CV_SUCCESS,
      CVodeSetEtaFixedStepBounds(in->base.cv, 0.9, 1.2), /* from 0, 1.5: a third fewer steps, and a tenth of the
                                                            error (c2 at omega 9) */
      CVodeSetNoInactiveRootWarn(in->base.cv),
      CVodeSetMaxStep(in->base.cv, INTEGRATE_LONGEST_STEP),
      CVodeSetMaxNumSteps(in->base.cv, MAX_STEPS),
      CVodeSetMaxHnilWarns(in->base.cv, -1),
  };
  return integrate_first_flag(flags, sizeof flags / sizeof *flags) == CV_SUCCESS ? HC_OK : HC_NO_MEMORY;
}

hc_status integrate_new_events(const modal_base *base, double tolerance, integrator **out)
{
  const size_t contacts = (size_t)base->n_contacts;
  *out = NULL;
  events *in = calloc(1, sizeof *in); /* zeroed, so free works half-built */
  if (!in) return HC_NO_MEMORY;
  const bool bdf = base->decay > stiff * base->lowest;
  in->base.base.does = &class;
  in->base.base.scatter = bdf ? INTEGRATE_BDF_SCATTER : INTEGRATE_ADAMS_SCATTER;
  in->n = base->n;
  in->n_contacts = base->n_contacts;
  in->tolerance = tolerance;
  in->is_single = motion_single_fits(base) && base->n_planar == 0;
  in->track = calloc(contacts + 1, sizeof *in->track);
  in->law = calloc(contacts + 1, sizeof *in->law);
  in->info = calloc(EVENTS_ROOTS * contacts + 1, sizeof *in->info);
  in->n_equations = 2 * base->n + base->n_planar;
  in->rate = calloc((size_t)in->n_equations + (size_t)base->n_planar, sizeof *in->rate);
  in->angle = calloc((size_t)base->n_planar + 1, sizeof *in->angle);
  in->angle_of = calloc(contacts + 1, sizeof *in->angle_of);
  const bool enough = in->track && in->law && in->info && in->rate && in->angle && in->angle_of;
  hc_status st = enough ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) in->phi = in->rate + in->n_equations;
  if (st == HC_OK) st = interval_modes_new(base, INTERVAL_MODES_STIFF, &in->modes);
  if (st == HC_OK) st = fundamental_matrix_make(&in->variations, base, in->modes);
  if (st == HC_OK) st = slider_travel_make(&in->travel, base->n_contacts);
  if (st == HC_OK) st = integrate_make_parts(&in->base, in->n_equations, bdf ? CV_BDF : CV_ADAMS, NULL);
  if (st == HC_OK) st = make_cvode(in);
  if (st == HC_OK) {
    *out = &in->base.base;
    return HC_OK;
  }
  release(&in->base.base);
  return st;
}
