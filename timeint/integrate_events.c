/* integrate_events.c - see integrate_events.h.
 *
 * Root functions of a contact, six, so that a period allocates nothing: the guards of its state, which end it where
 * they fall through 0, and the rates of these, which end nothing. Without them a guard could fall and rise within
 * one step unseen: CVODE's search for the root of the rate between evaluates all functions there
 * (integrate_exact.c). Functions that are not there are 1; none is ever exactly 0, which CVODE answers with an error.
 *
 * A guard that has fallen at the beginning of a phase, or with another contact's in the same instant, is passed at
 * once. The monodromy matrix is structure_variations.h's. */
#include "timeint/integrate_events.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "numerics/sundials_compat.h"
#include "timeint/circle_angle.h"
#include "timeint/integrate_cvode.h"
#include "timeint/structure_equations.h"
#include "timeint/structure_variations.h"

static const double at_end = 64 * DBL_EPSILON; /* nearer to 2 pi CVODE would answer CV_TOO_CLOSE to a restart */
static const double stiff = 60; /* largest decay rate over lowest frequency, from where on BDF takes fewer steps */
static const double longest_step = 0.2; /* [rad] measure.c integrates a quintic over each */

enum {
  MAX_STEPS = 1000000,    /* between transitions */
  MAX_STANDSTILLS = 1000, /* returns of CVODE in succession that do not advance theta */
  ROOTS = 2 * TRACK_GUARDS
};

typedef struct events { /* from integrate_new_events, to integrate_free; not shared between threads */
  cvode_integrator base;
  int n, n_contacts;
  double tolerance;
  contact_track *track;       /* [n_contacts] now */
  contact_forces_linear *law; /* [n_contacts] of these states */
  int *info;                  /* [n_contacts][ROOTS] what CVODE says of the root functions */
  double *rate;               /* [n_equations] dy where the guards' rates are wanted */
  int n_circles, n_equations; /* 2 n, and an angle for each circle */
  circle_angle *angle;        /* [n_circles] */
  int *angle_of;              /* [n_contacts] that of a circle's first direction; else -1 */
  double *phi;                /* [n_circles] where sliders are wanted */
  int passed;                 /* events since the period began */
  bool varies;                /* the monodromy is asked for */
  structure_variations variations;
  phase_modes *modes; /* for them */
} events;

static circle_motion circle_at(const events *in, int j, const double *y)
{
  circle_motion at;
  scaled_circle_motion(in->base.m, j, y, at.u, &at.v);
  scaled_circle_motion(in->base.m, j, y + in->n, at.du, &at.dv);
  return at;
}

/* T of the circles that slip, out of the forces dy + n, and the rates of all angles. */
static void subtract_circles(const events *in, const double *y, double *dy)
{
  for (int i = 0; i < in->n_circles; ++i) {
    const circle_angle *a = &in->angle[i];
    const int j = a->contact, n = in->n;
    const scaled_contact *c = &in->base.m->contact[j];
    const double phi = y[2 * n + i], *t = in->base.m->base->tangent + (size_t)j * (size_t)n;
    const circle_motion at = circle_at(in, j, y);
    dy[2 * n + i] = circle_angle_rate(a, &in->track[j], c, &at, phi);
    if (!circle_track_turns(&in->track[j])) continue;
    const double limit = c->law.kt * circle_track_radius(c, at.v), pull[2] = {limit * cos(phi), limit * sin(phi)};
    for (int k = 0; k < n; ++k) dy[n + k] -= pull[0] * t[k] + pull[1] * t[n + k];
  }
}

static void phase_rhs(const events *in, double theta, const double *y, double *dy)
{
  const scaled_model *m = in->base.m;
  const int n = in->n;
  structure_linear_force(m, theta, y, dy + n);
  for (int j = 0; j < in->n_contacts; ++j) {
    const contact_forces_linear *f = &in->law[j];
    const double *t = m->base->tangent + (size_t)j * (size_t)n, *normal = m->base->normal + (size_t)j * (size_t)n;
    double u, v;
    scaled_contact_motion(m, j, y, &u, &v);
    const double along = f->t_u * u + f->t_v * v + f->t_0, across = f->n_v * v + f->n_0;
    for (int i = 0; i < n; ++i) dy[n + i] -= along * t[i] + across * normal[i];
  }
  subtract_circles(in, y, dy);
  memcpy(dy, y + n, (size_t)n * sizeof *dy);
}

static int rhs(sunrealtype theta, N_Vector y, N_Vector dy, void *self)
{
  events *in = self;
  double sum = 0;
  phase_rhs(in, theta, NV_DATA_S(y), NV_DATA_S(dy));
  for (int i = 0; i < in->n_equations; ++i) sum += NV_Ith_S(dy, i);
  if (isfinite(sum)) return 0;
  in->base.not_finite = true;
  return -1;
}

static void fill_linear(const scaled_model *m, size_t ld, double *a)
{
  const modal_base *b = m->base;
  const size_t n = (size_t)m->n;
  memset(a, 0, ld * ld * sizeof *a);
  for (size_t col = 0; col < n; ++col) {
    double *by_x = a + col * ld + n, *by_p = a + (n + col) * ld;
    by_p[col] = 1;
    if (b->diagonal_K) by_x[col] = -m->by_K * b->K[col];
    if (b->diagonal_C) by_p[n + col] = -m->by_C * b->C[col];
    for (size_t row = 0; row < n && !b->diagonal_K; ++row) by_x[row] = -m->by_K * b->K[col * n + row];
    for (size_t row = 0; row < n && !b->diagonal_C; ++row) by_p[n + row] = -m->by_C * b->C[col * n + row];
  }
}

/* What circles that slip add. */
static void fill_circles(const events *in, const double *y, size_t ld, double *a)
{
  const scaled_model *m = in->base.m;
  const size_t n = (size_t)in->n;
  for (int i = 0; i < in->n_circles; ++i) {
    const int j = in->angle[i].contact;
    const size_t phi = 2 * n + (size_t)i;
    const double *t = m->base->tangent + (size_t)j * n, *normal = m->base->normal + (size_t)j * n;
    if (!circle_track_turns(&in->track[j])) continue;
    const circle_motion at = circle_at(in, j, y);
    const angle_slopes s = circle_angle_slopes(&in->angle[i], &in->track[j], &m->contact[j], &at, y[phi]);
    for (size_t k = 0; k < 2; ++k)
      for (size_t row = 0; row < n; ++row) {
        for (size_t col = 0; col < n; ++col) a[col * ld + n + row] -= t[k * n + row] * s.t_v[k] * normal[col];
        a[phi * ld + n + row] -= t[k * n + row] * s.t_phi[k];
      }
    for (size_t col = 0; col < n; ++col) {
      a[col * ld + phi] = s.rate_v * normal[col];
      a[(n + col) * ld + phi] = s.rate_u[0] * t[col] + s.rate_u[1] * t[n + col];
    }
    a[phi * ld + phi] = s.rate_phi;
  }
}

static int jacobian(sunrealtype theta, N_Vector y, N_Vector dy, SUNMatrix jac, void *self, N_Vector t1, N_Vector t2,
                    N_Vector t3)
{
  (void)theta, (void)dy, (void)t1, (void)t2, (void)t3;
  const events *in = self;
  const scaled_model *m = in->base.m;
  const size_t n = (size_t)in->n, ld = (size_t)in->n_equations;
  double *a = SM_DATA_D(jac);
  fill_linear(m, ld, a);
  for (int j = 0; j < in->n_contacts; ++j) {
    const contact_forces_linear *f = &in->law[j];
    const double *t = m->base->tangent + (size_t)j * n, *normal = m->base->normal + (size_t)j * n;
    for (size_t col = 0; col < n; ++col) {
      const double along = f->t_u * t[col] + f->t_v * normal[col], across = f->n_v * normal[col];
      if (along == 0 && across == 0) continue;
      for (size_t row = 0; row < n; ++row) a[col * ld + n + row] -= t[row] * along + normal[row] * across;
    }
  }
  fill_circles(in, NV_DATA_S(y), ld, a);
  return 0;
}

/* The guards of contact j at a motion: the value and rate of each; how many. With u'', v'' in bend. */
static int guards_at(const events *in, int j, const contact_motion *at, const double bend[2],
                     track_guard guard[TRACK_GUARDS])
{
  const double u[TRACK_ORDER + 1] = {at->u, at->du, 0.5 * bend[0]}, v[TRACK_ORDER + 1] = {at->v, at->dv, 0.5 * bend[1]};
  return contact_track_guards(&in->track[j], &in->base.m->contact[j], u, v, guard);
}

static void motion_at(const events *in, int j, const double *y, const double *dy, contact_motion *at, double bend[2])
{
  const scaled_model *m = in->base.m;
  scaled_contact_motion(m, j, y, &at->u, &at->v);
  scaled_contact_motion(m, j, y + in->n, &at->du, &at->dv);
  if (dy) scaled_contact_motion(m, j, dy + in->n, &bend[0], &bend[1]);
}

static angle_motion angle_motion_at(const events *in, int j, double theta, const double *y, const double *dy)
{
  angle_motion now = {.at = circle_at(in, j, y), .theta = theta, .phi = y[2 * in->n + in->angle_of[j]]};
  scaled_circle_motion(in->base.m, j, dy + in->n, now.bend, &now.normal_bend);
  return now;
}

/* All guards of contact j at theta and y, where its rate is dy; none of a circle's second direction. */
static int guards_of(const events *in, int j, double theta, const double *y, const double *dy,
                     track_guard guard[TRACK_GUARDS])
{
  const scaled_contact *c = &in->base.m->contact[j];
  contact_motion at;
  double bend[2] = {0};
  if (c->second) return 0;
  if (c->circle) {
    const angle_motion now = angle_motion_at(in, j, theta, y, dy);
    return circle_angle_guards(&in->angle[in->angle_of[j]], &in->track[j], c, &now, guard);
  }
  motion_at(in, j, y, dy, &at, bend);
  return guards_at(in, j, &at, bend, guard);
}

/* CVODE multiplies values on either side of a root: this must not underflow. */
static double never_zero(double g) { return g != 0 ? g : -1e-100; }

static int roots(sunrealtype theta, N_Vector y, sunrealtype *g, void *self)
{
  events *in = self;
  const double *z = NV_DATA_S(y);
  phase_rhs(in, theta, z, in->rate);
  for (int i = 0; i < ROOTS * in->n_contacts; ++i) g[i] = 1;
  for (int j = 0; j < in->n_contacts; ++j, g += ROOTS) {
    track_guard guard[TRACK_GUARDS];
    const int n = guards_of(in, j, theta, z, in->rate, guard);
    for (int i = 0; i < n; ++i) {
      g[i] = never_zero(guard[i].g[0]);
      g[TRACK_GUARDS + i] = never_zero(guard[i].g[1]);
    }
  }
  return 0;
}

static void use_states(events *in)
{
  for (int j = 0; j < in->n_contacts; ++j) in->law[j] = contact_track_forces(&in->track[j], &in->base.m->contact[j]);
}

/* The directions of circles that slip, from their angles. */
static void follow_angles(events *in)
{
  const double *phi = NV_DATA_S(in->base.y) + 2 * in->n;
  for (int i = 0; i < in->n_circles; ++i) {
    contact_track *t = &in->track[in->angle[i].contact];
    if (!circle_track_turns(t)) continue;
    t[0].along = cos(phi[i]);
    t[1].along = sin(phi[i]);
  }
}

/* In motion from theta on: its angle, and the direction that it has at a touch. */
static void begin_angle(events *in, int j, double theta)
{
  double *y = NV_DATA_S(in->base.y);
  circle_angle *a = &in->angle[in->angle_of[j]];
  contact_track *t = &in->track[j];
  a->opens = false;
  if (!circle_track_turns(t)) return;
  y[2 * in->n + in->angle_of[j]] = atan2(t[1].along, t[0].along);
  if (!t->fresh) return;
  t[0].fresh = t[1].fresh = false;
  phase_rhs(in, theta, y, in->rate);
  const angle_motion now = angle_motion_at(in, j, theta, y, in->rate);
  circle_angle_open(a, &in->base.m->contact[j], &now);
}

/* The circle whose first direction is j. That its angle is held, or no more, is no change of state. */
static hc_status pass_circle(events *in, int j, track_event event, double theta, int *count)
{
  const contact_track before[2] = {in->track[j], in->track[j + 1]};
  const scaled_contact *c = &in->base.m->contact[j];
  const circle_motion at = circle_at(in, j, NV_DATA_S(in->base.y));
  hc_status st = HC_OK;
  const bool changes = event != TRACK_TURNS && event != TRACK_HOLDS;
  if (++in->passed > 8 * integrate_most_transitions(in->n_contacts)) return HC_CHATTER;
  if (changes && ++*count > integrate_most_transitions(in->n_contacts)) return HC_CHATTER;
  if (changes && in->varies) st = structure_variations_advance(&in->variations, in->base.m, in->track, theta);
  if (st != HC_OK) return st;
  circle_track_pass(&in->track[j], c, event, &at);
  if (changes && in->varies) {
    structure_variations_circle(&in->variations, in->base.m, j, before, &in->track[j], &at);
    structure_variations_follow(&in->variations, in->base.m, in->track, NV_DATA_S(in->base.y));
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
  if (in->base.m->contact[j].circle) return pass_circle(in, j, event, theta, count);
  motion_at(in, j, NV_DATA_S(in->base.y), NULL, &at, NULL);
  ++in->passed;
  if (++*count > integrate_most_transitions(in->n_contacts)) return HC_CHATTER;
  hc_status st = in->varies ? structure_variations_advance(&in->variations, in->base.m, in->track, theta) : HC_OK;
  if (st != HC_OK) return st;
  contact_track_pass(&in->track[j], &in->base.m->contact[j], event, &at);
  if (in->varies && in->track[j].state == CONTACT_STICK)
    structure_variations_stick(&in->variations, in->base.m, j, before, &at);
  if (in->varies) structure_variations_follow(&in->variations, in->base.m, in->track, NV_DATA_S(in->base.y));
  use_states(in);
  return HC_OK;
}

/* Guards that have fallen already and go on falling; until there is none. */
static hc_status pass_fallen(events *in, double theta, int *count)
{
  for (bool more = true; more;) {
    more = false;
    for (int j = 0; j < in->n_contacts; ++j) {
      track_guard guard[TRACK_GUARDS];
      const double *y = NV_DATA_S(in->base.y);
      phase_rhs(in, theta, y, in->rate);
      const int n = guards_of(in, j, theta, y, in->rate, guard);
      for (int i = 0; i < n; ++i) {
        if (!(guard[i].g[0] <= guard[i].noise && guard[i].g[1] < -guard[i].noise)) continue;
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
  phase_rhs(in, theta, y, in->rate);
  for (int j = 0; j < in->n_contacts && st == HC_OK; ++j) {
    track_guard guard[TRACK_GUARDS];
    const int n = guards_of(in, j, theta, y, in->rate, guard);
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
    int flag = CVode(in->base.cv, TWO_PI, in->base.y, &theta, watch ? CV_ONE_STEP : CV_NORMAL);
    if (flag != CV_SUCCESS && flag != CV_TSTOP_RETURN && flag != CV_ROOT_RETURN)
      return integrate_translate(&in->base, flag);
    if (TWO_PI - theta <= at_end * TWO_PI) theta = TWO_PI;
    standstills = theta > before ? 0 : standstills + 1;
    if (standstills > MAX_STANDSTILLS) break;
    hc_status st = watch && theta > before ? watch(self, &in->base.base, before, theta) : HC_OK;
    if (st == HC_OK && flag == CV_ROOT_RETURN) st = pass_roots(in, theta, count);
    if (st != HC_OK) return st;
  }
  return integrate_check_end(&in->base, theta, in->n_equations);
}

/* Which contacts are circles. */
static void find_circles(events *in)
{
  int i = 0;
  in->passed = 0;
  for (int j = 0; j < in->n_contacts; ++j) {
    in->angle_of[j] = in->base.m->contact[j].circle ? i : -1;
    if (in->angle_of[j] < 0) continue;
    in->angle[i++] = (circle_angle){.contact = j, .held_pull = fmax(1e-17, 1e-3 * in->tolerance)};
  }
  in->n_circles = i;
  for (; i < in->n_equations - 2 * in->n; ++i) NV_Ith_S(in->base.y, 2 * in->n + i) = 0; /* without friction */
}

static hc_status begin(events *in, const double *y, int *count)
{
  double size = 0;
  for (int i = 0; i < in->base.m->n_states; ++i) size += fabs(y[i]);
  if (!isfinite(size)) return HC_NOT_FINITE;
  memcpy(NV_DATA_S(in->base.y), y, 2 * (size_t)in->n * sizeof *y);
  find_circles(in);
  for (int j = 0; j < in->n_contacts; ++j) {
    const scaled_contact *c = &in->base.m->contact[j];
    contact_motion at;
    if (c->circle) {
      const circle_motion both = circle_at(in, j, y);
      circle_track_begin(&in->track[j], c, &both, y + 2 * in->n + j);
      begin_angle(in, j, 0);
    } else if (!c->second) {
      motion_at(in, j, y, NULL, &at, NULL);
      in->track[j] = contact_track_begin(c, &at, y[2 * in->n + j]);
    }
  }
  use_states(in);
  if (in->varies) {
    in->variations.theta = 0;
    structure_variations_begin(&in->variations, in->base.m, in->track, y);
    structure_variations_follow(&in->variations, in->base.m, in->track, y);
  }
  return pass_fallen(in, 0, count);
}

/* Sliders of the motion y (order 0), or their rates where y is its derivative; circles that slip in the directions of
 * their angles phi[n_circles]. */
static void set_sliders(const events *in, int order, const double *phi, double *y)
{
  double *w = y + 2 * in->n;
  for (int j = 0; j < in->n_contacts; j += scaled_directions(in->base.m, j)) {
    const scaled_contact *c = &in->base.m->contact[j];
    const contact_track *t = &in->track[j];
    contact_motion at;
    motion_at(in, j, y, NULL, &at, NULL);
    const bool sticks = t->state == CONTACT_STICK && c->law.has_friction;
    if (c->circle) {
      contact_track circle[2] = {t[0], t[1]};
      const circle_motion both = circle_at(in, j, y);
      const double angle = phi[in->angle_of[j]];
      if (circle_track_turns(t)) circle[0].along = cos(angle), circle[1].along = sin(angle);
      if (order == 0) circle_track_slider(circle, c, &both, w + j);
      else circle_track_slider_rate(circle, c, both.u, both.v, w + j);
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
  if (st == HC_OK && monodromy) st = structure_variations_advance(&in->variations, m, in->track, TWO_PI);
  if (st != HC_OK) return st;
  memcpy(y, NV_DATA_S(in->base.y), 2 * (size_t)in->n * sizeof *y);
  follow_angles(in);
  set_sliders(in, 0, NV_DATA_S(in->base.y) + 2 * in->n, y);
  if (monodromy) structure_variations_end(&in->variations, m, in->track, y, monodromy);
  return HC_OK;
}

static hc_status dense(const integrator *base, double theta, int order, double *y)
{
  const events *in = (const events *)base;
  if (CVodeGetDky(in->base.cv, theta, order, in->base.dky) != CV_SUCCESS) return HC_BUG; /* theta outside the step */
  memcpy(y, NV_DATA_S(in->base.dky), 2 * (size_t)in->n * sizeof *y);
  memcpy(in->phi, NV_DATA_S(in->base.dky) + 2 * in->n, (size_t)in->n_circles * sizeof *in->phi);
  if (order == 1 && in->n_circles > 0) {
    if (CVodeGetDky(in->base.cv, theta, 0, in->base.dky) != CV_SUCCESS) return HC_BUG;
    memcpy(in->phi, NV_DATA_S(in->base.dky) + 2 * in->n, (size_t)in->n_circles * sizeof *in->phi);
  }
  if (order <= 1) set_sliders(in, order, in->phi, y);
  return HC_OK;
}

static contact_state state(const integrator *base, int j, const double *y)
{
  (void)y;
  return ((const events *)base)->track[j].state;
}

static void release(integrator *base)
{
  events *in = (events *)base;
  structure_variations_free(&in->variations);
  phase_modes_free(in->modes);
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
                                       .fourier = integrate_no_fourier,
                                       .state = state,
                                       .tolerance = integrate_cvode_tolerance,
                                       .free = release};

/* What fails here is memory, whatever the flag (integrate_exact.c). */
static hc_status make_cvode(events *in)
{
  N_VConst(0.0, in->base.y);
  int flag = CVodeInit(in->base.cv, rhs, 0.0, in->base.y); /* first: the other calls need it */
  if (flag == CV_SUCCESS && in->n_contacts > 0) flag = CVodeRootInit(in->base.cv, ROOTS * in->n_contacts, roots);
  if (flag != CV_SUCCESS) return HC_NO_MEMORY;
  for (int i = 0; i < ROOTS * in->n_contacts; ++i) in->info[i] = i % ROOTS < TRACK_GUARDS ? -1 : 0; /* guards fall */
  const int flags[] = {
      HC_CVODE_QUIET(in->base.cv),
      CVodeSStolerances(in->base.cv, in->tolerance, in->tolerance),
      CVodeSetUserData(in->base.cv, in),
      CVodeSetLinearSolver(in->base.cv, in->base.ls, in->base.jac),
      CVodeSetJacFn(in->base.cv, jacobian),
      in->n_contacts > 0 ? CVodeSetRootDirection(in->base.cv, in->info) : CV_SUCCESS,
      CVodeSetEtaFixedStepBounds(in->base.cv, 0.9, 1.2), /* integrate_exact.c */
      CVodeSetNoInactiveRootWarn(in->base.cv),
      CVodeSetMaxStep(in->base.cv, longest_step),
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
  in->track = calloc(contacts + 1, sizeof *in->track);
  in->law = calloc(contacts + 1, sizeof *in->law);
  in->info = calloc(ROOTS * contacts + 1, sizeof *in->info);
  in->n_equations = 2 * base->n + base->n_circles;
  in->rate = calloc((size_t)in->n_equations + (size_t)base->n_circles, sizeof *in->rate);
  in->angle = calloc((size_t)base->n_circles + 1, sizeof *in->angle);
  in->angle_of = calloc(contacts + 1, sizeof *in->angle_of);
  const bool enough = in->track && in->law && in->info && in->rate && in->angle && in->angle_of;
  hc_status st = enough ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) in->phi = in->rate + in->n_equations;
  if (st == HC_OK) st = phase_modes_new(base, PHASE_MODES_STIFF, &in->modes);
  if (st == HC_OK) st = structure_variations_make(&in->variations, base, in->modes);
  if (st == HC_OK) st = integrate_make_parts(&in->base, in->n_equations, bdf ? CV_BDF : CV_ADAMS, NULL);
  if (st == HC_OK) st = make_cvode(in);
  if (st == HC_OK) {
    *out = &in->base.base;
    return HC_OK;
  }
  release(&in->base.base);
  return st;
}
