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
  double *rate;               /* [2 n] dy where the guards' rates are wanted */
  bool varies;                /* the monodromy is asked for */
  structure_variations variations;
  phase_modes *modes; /* for them */
} events;

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
  memcpy(dy, y + n, (size_t)n * sizeof *dy);
}

static int rhs(sunrealtype theta, N_Vector y, N_Vector dy, void *self)
{
  events *in = self;
  double sum = 0;
  phase_rhs(in, theta, NV_DATA_S(y), NV_DATA_S(dy));
  for (int i = 0; i < 2 * in->n; ++i) sum += NV_Ith_S(dy, i);
  if (isfinite(sum)) return 0;
  in->base.not_finite = true;
  return -1;
}

static void fill_linear(const scaled_model *m, double *a)
{
  const modal_base *b = m->base;
  const size_t n = (size_t)m->n, ld = 2 * n;
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

static int jacobian(sunrealtype theta, N_Vector y, N_Vector dy, SUNMatrix jac, void *self, N_Vector t1, N_Vector t2,
                    N_Vector t3)
{
  (void)theta, (void)y, (void)dy, (void)t1, (void)t2, (void)t3;
  const events *in = self;
  const scaled_model *m = in->base.m;
  const size_t n = (size_t)in->n;
  double *a = SM_DATA_D(jac);
  fill_linear(m, a);
  for (int j = 0; j < in->n_contacts; ++j) {
    const contact_forces_linear *f = &in->law[j];
    const double *t = m->base->tangent + (size_t)j * n, *normal = m->base->normal + (size_t)j * n;
    for (size_t col = 0; col < n; ++col) {
      const double along = f->t_u * t[col] + f->t_v * normal[col], across = f->n_v * normal[col];
      if (along == 0 && across == 0) continue;
      for (size_t row = 0; row < n; ++row) a[col * 2 * n + n + row] -= t[row] * along + normal[row] * across;
    }
  }
  return 0;
}

/* CVODE multiplies values on either side of a root: this must not underflow. */
static double never_zero(double g) { return g != 0 ? g : -1e-100; }

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

static int roots(sunrealtype theta, N_Vector y, sunrealtype *g, void *self)
{
  events *in = self;
  const double *z = NV_DATA_S(y);
  phase_rhs(in, theta, z, in->rate);
  for (int i = 0; i < ROOTS * in->n_contacts; ++i) g[i] = 1;
  for (int j = 0; j < in->n_contacts; ++j, g += ROOTS) {
    track_guard guard[TRACK_GUARDS];
    contact_motion at;
    double bend[2] = {0};
    motion_at(in, j, z, in->rate, &at, bend);
    const int n = guards_at(in, j, &at, bend, guard);
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

static hc_status pass(events *in, int j, track_event event, const contact_motion *at, double theta, int *count)
{
  const contact_state before = in->track[j].state;
  if (++*count > integrate_most_transitions(in->n_contacts)) return HC_CHATTER;
  hc_status st = in->varies ? structure_variations_advance(&in->variations, in->base.m, in->track, theta) : HC_OK;
  if (st != HC_OK) return st;
  contact_track_pass(&in->track[j], &in->base.m->contact[j], event, at);
  if (in->varies && in->track[j].state == CONTACT_STICK)
    structure_variations_stick(&in->variations, in->base.m, j, before, at);
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
      contact_motion at;
      double bend[2] = {0};
      phase_rhs(in, theta, NV_DATA_S(in->base.y), in->rate);
      motion_at(in, j, NV_DATA_S(in->base.y), in->rate, &at, bend);
      const int n = guards_at(in, j, &at, bend, guard);
      for (int i = 0; i < n; ++i) {
        if (!(guard[i].g[0] <= guard[i].noise && guard[i].g[1] < -guard[i].noise)) continue;
        hc_status st = pass(in, j, guard[i].event, &at, theta, count);
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
  const int before = *count;
  hc_status st = HC_OK;
  for (int j = 0; j < in->n_contacts && st == HC_OK; ++j) {
    track_guard guard[TRACK_GUARDS];
    contact_motion at;
    double bend[2] = {0};
    motion_at(in, j, NV_DATA_S(in->base.y), NULL, &at, bend);
    const int n = guards_at(in, j, &at, bend, guard);
    for (int i = 0; i < n; ++i) {
      if (!in->info[j * ROOTS + i]) continue;
      st = pass(in, j, guard[i].event, &at, theta, count);
      break;
    }
  }
  if (st == HC_OK && *count > before) st = pass_fallen(in, theta, count);
  if (st != HC_OK || *count == before || theta == TWO_PI) return st;
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
  return integrate_check_end(&in->base, theta, 2 * in->n);
}

static hc_status begin(events *in, const double *y, int *count)
{
  double size = 0;
  for (int i = 0; i < in->base.m->n_states; ++i) size += fabs(y[i]);
  if (!isfinite(size)) return HC_NOT_FINITE;
  memcpy(NV_DATA_S(in->base.y), y, 2 * (size_t)in->n * sizeof *y);
  for (int j = 0; j < in->n_contacts; ++j) {
    contact_motion at;
    motion_at(in, j, y, NULL, &at, NULL);
    in->track[j] = contact_track_begin(&in->base.m->contact[j], &at, y[2 * in->n + j]);
  }
  use_states(in);
  if (in->varies) {
    in->variations.theta = 0;
    structure_variations_begin(&in->variations, in->base.m, in->track, y);
  }
  return pass_fallen(in, 0, count);
}

static void set_sliders(const events *in, double *y)
{
  for (int j = 0; j < in->n_contacts; ++j) {
    contact_motion at;
    motion_at(in, j, y, NULL, &at, NULL);
    y[2 * in->n + j] = contact_track_slider(&in->track[j], &in->base.m->contact[j], &at);
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
  set_sliders(in, y);
  if (monodromy) structure_variations_end(&in->variations, m, in->track, y, monodromy);
  return HC_OK;
}

static hc_status dense(const integrator *base, double theta, int order, double *y)
{
  const events *in = (const events *)base;
  if (CVodeGetDky(in->base.cv, theta, order, in->base.dky) != CV_SUCCESS) return HC_BUG; /* theta outside the step */
  memcpy(y, NV_DATA_S(in->base.dky), 2 * (size_t)in->n * sizeof *y);
  if (order == 0) set_sliders(in, y);
  for (int j = 0; j < in->n_contacts && order == 1; ++j) {
    contact_motion at;
    motion_at(in, j, y, NULL, &at, NULL);
    const bool sticks = in->track[j].state == CONTACT_STICK && in->base.m->contact[j].law.has_friction;
    y[2 * in->n + j] = sticks ? 0 : contact_track_vary_slider(&in->track[j], &in->base.m->contact[j], at.u, at.v);
  }
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
  in->rate = calloc(2 * (size_t)base->n, sizeof *in->rate);
  hc_status st = in->track && in->law && in->info && in->rate ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) st = phase_modes_new(base, PHASE_MODES_STIFF, &in->modes);
  if (st == HC_OK) st = structure_variations_make(&in->variations, base, in->modes);
  if (st == HC_OK) st = integrate_make_parts(&in->base, 2 * base->n, bdf ? CV_BDF : CV_ADAMS, NULL);
  if (st == HC_OK) st = make_cvode(in);
  if (st == HC_OK) {
    *out = &in->base.base;
    return HC_OK;
  }
  release(&in->base.base);
  return st;
}
