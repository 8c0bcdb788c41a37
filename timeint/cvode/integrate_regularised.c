/* integrate_regularised.c - see integrate.h. Everything is made in integrate_new_regularised; a period allocates
 * nothing. The columns of the monodromy matrix are CVODES' forward sensitivities to y(0), switched off in periods
 * without; a period with them takes other steps of the same tolerance: y is as good, but not the same bits. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cvodes/cvodes.h>
#include <cvodes/cvodes_ls.h>
#include <nvector/nvector_serial.h>

#include "numerics/base/constants.h"
#include "numerics/sundials_compat.h"
#include "timeint/cvode/integrate_cvode.h"
#include "timeint/cvode/structure_newton.h"

static const double variation_tolerance = 1e-6; /* relative and absolute tolerance of the variations, which are about
                                                   1 */

enum {
  MAX_ERROR_FAILS = 20, /* per step: at a corner the step is sometimes 1e4 times too long */
  MAX_NEWTON_FAILS = 30
};

typedef struct regularised { /* from integrate_new_regularised, to integrate_free; not shared between threads */
  cvode_integrator base;
  int n; /* number of states */
  structure_newton newton;
  N_Vector *s;                /* [n][n] d y / d y_j(0), j = 0..n-1: CVODES calls them sensitivities */
  structure_newton variation; /* d y'/d y for the variations' right-hand side */
  double *s_tolerance;        /* [n] absolute tolerance of each s_j; copied by CVODES */
} regularised;

static bool rate(cvode_integrator *base, double theta, const double *y, double *dy)
{
  return structure_newton_rate(&((regularised *)base)->newton, base->m, theta, y, dy, NULL);
}

static void linearise(cvode_integrator *base, const double *y)
{
  structure_newton_linearise(&((regularised *)base)->newton, base->m, y);
}

static bool factor(cvode_integrator *base, double gamma)
{
  return structure_newton_factor(&((regularised *)base)->newton, base->m, gamma);
}

static void solve(cvode_integrator *base, double *r) { structure_newton_solve(&((regularised *)base)->newton, r); }

static const cvode_equations equations = {rate, linearise, factor, solve};

/* The variational equations s_j' = J s_j. */
static int variation_rhs(int n, sunrealtype theta, N_Vector y, N_Vector dy, N_Vector *s, N_Vector *ds, void *self,
                         N_Vector t1, N_Vector t2)
{
  (void)theta, (void)dy, (void)t1, (void)t2;
  regularised *in = self;
  structure_newton_linearise(&in->variation, in->base.m, NV_DATA_S(y));
  for (int j = 0; j < n; ++j) structure_newton_multiply(&in->variation, in->base.m, NV_DATA_S(s[j]), NV_DATA_S(ds[j]));
  return 0;
}

/* The error test includes the variations, with a coarse tolerance. Without them a step may pass over a corner that
 * hardly changes y and put the monodromy matrix off by 4e-3 (measured; with them 3e-5 at worst), which costs Newton a
 * step and can hide a fold. CV_STAGGERED: y is solved for first, then all variations; solving for both at once
 * (CV_SIMULTANEOUS) cost as much and was no more accurate. */
static hc_status make_variations(regularised *in)
{
  for (int j = 0; j < in->n; ++j) {
    N_VConst(0.0, in->s[j]);
    in->s_tolerance[j] = variation_tolerance;
  }
  if (!hc_room_for(0)) return HC_NO_MEMORY;
  int flag = CVodeSensInit(in->base.cv, in->n, CV_STAGGERED, variation_rhs, in->s); /* first: the other calls need it */
  if (flag != CV_SUCCESS) return HC_NO_MEMORY;
  const int flags[] = {
      CVodeSensSStolerances(in->base.cv, variation_tolerance, in->s_tolerance),
      CVodeSetSensErrCon(in->base.cv, 1),
      CVodeSensToggleOff(in->base.cv),
  };
  return integrate_set_up(flags, sizeof flags / sizeof *flags);
}

static hc_status make_parts(regularised *in, const modal_base *base)
{
  hc_status st = structure_newton_make(&in->newton, base, &in->base.memory);
  if (st == HC_OK) st = structure_newton_make(&in->variation, base, &in->base.memory);
  if (st == HC_OK) st = integrate_make_parts(&in->base, in->n, CV_BDF, &equations);
  if (st != HC_OK) return st;
  const int flags[] = {CVodeSetMaxErrTestFails(in->base.cv, MAX_ERROR_FAILS),
                       CVodeSetMaxConvFails(in->base.cv, MAX_NEWTON_FAILS)};
  st = integrate_set_up(flags, sizeof flags / sizeof *flags);
  in->s = N_VCloneVectorArray(in->n, in->base.y); /* memory: tested in integrate_make_parts */
  in->s_tolerance = workspace_doubles(&in->base.memory, (size_t)in->n);
  return in->s && in->s_tolerance ? st : HC_NO_MEMORY;
}

static void release(integrator *base)
{
  regularised *in = (regularised *)base;
  if (in->s) N_VDestroyVectorArray(in->s, in->n);
  integrate_free_parts(&in->base);
  free(base);
}

/* To the end of the period in one call. At tout == tstop 6.4 says CV_SUCCESS, 7 says CV_TSTOP_RETURN. */
static hc_status integrate_unwatched(regularised *in)
{
  sunrealtype theta = 0;
  int flag = CVode(in->base.cv, TWO_PI, in->base.y, &theta, CV_NORMAL);
  hc_status st = flag == CV_TSTOP_RETURN ? HC_OK : integrate_translate(&in->base, flag);
  return st == HC_OK ? integrate_check_end(&in->base, theta, in->n) : st;
}

/* The same steps, one call each. */
static hc_status integrate_watched(regularised *in, integrate_watch *watch, void *self)
{
  for (sunrealtype theta = 0;;) {
    sunrealtype before = theta;
    int flag = CVode(in->base.cv, TWO_PI, in->base.y, &theta, CV_ONE_STEP);
    if (flag != CV_SUCCESS && flag != CV_TSTOP_RETURN) return integrate_translate(&in->base, flag);
    bool last = flag == CV_TSTOP_RETURN || !(theta < TWO_PI);
    /* a step that does not advance theta ends here too: HC_INTEGRATOR */
    hc_status st = last || !(theta > before) ? integrate_check_end(&in->base, theta, in->n) : HC_OK;
    if (st == HC_OK) st = watch(self, &in->base.base, before, theta);
    if (st != HC_OK || last) return st;
  }
}

static hc_status period(integrator *base, const scaled_model *m, double *y, double *monodromy, integrate_watch *watch,
                        void *self)
{
  regularised *in = (regularised *)base;
  const size_t bytes = sizeof *y * (size_t)in->n;
  in->base.m = m;
  hc_status st = integrate_begin_period(&in->base);
  double size = 0;
  for (int i = 0; i < in->n; ++i) size += fabs(y[i]);
  if (st == HC_OK && !isfinite(size)) st = HC_NOT_FINITE;
  if (st != HC_OK) return st;
  memcpy(NV_DATA_S(in->base.y), y, bytes);
  int flag = CVodeReInit(in->base.cv, 0.0, in->base.y);
  for (int j = 0; monodromy && j < in->n; ++j) {
    N_VConst(0.0, in->s[j]);
    NV_Ith_S(in->s[j], j) = 1;
  }
  if (flag == CV_SUCCESS)
    flag = monodromy ? CVodeSensReInit(in->base.cv, CV_STAGGERED, in->s) : CVodeSensToggleOff(in->base.cv);
  if (flag == CV_SUCCESS) flag = CVodeSetStopTime(in->base.cv, TWO_PI);
  st = integrate_translate(&in->base, flag);
  if (st == HC_OK) st = watch ? integrate_watched(in, watch, self) : integrate_unwatched(in);
  hc_status counted = integrate_add_counts(&in->base);
  if (st == HC_OK) st = counted;
  if (st == HC_OK && monodromy) {
    sunrealtype theta;
    st = integrate_translate(&in->base, CVodeGetSens(in->base.cv, &theta, in->s));
    for (int j = 0; j < in->n; ++j) memcpy(monodromy + j * in->n, NV_DATA_S(in->s[j]), bytes);
  }
  if (st == HC_OK) memcpy(y, NV_DATA_S(in->base.y), bytes);
  return st;
}

static hc_status dense(const integrator *base, double theta, int order, double *y)
{
  const regularised *in = (const regularised *)base;
  if (CVodeGetDky(in->base.cv, theta, order, in->base.dky) != CV_SUCCESS) return HC_BUG; /* theta outside the step */
  memcpy(y, NV_DATA_S(in->base.dky), sizeof *y * (size_t)in->n);
  return HC_OK;
}

static contact_state state(const integrator *base, int j, const double *y)
{
  return scaled_contact_state(((const regularised *)base)->base.m, j, y);
}

static void at_end(const integrator *base, double theta, const double *y, double *rate, contact_state *states)
{
  const regularised *in = (const regularised *)base;
  structure_newton_rate(&in->newton, in->base.m, theta, y, rate, states); /* finite: CVODE has just been here */
}

static const integrator_class class = {.period = period,
                                       .dense = dense,
                                       .samples = integrate_dense_samples,
                                       .fourier = integrate_no_fourier,
                                       .state = state,
                                       .at_end = at_end,
                                       .tolerance = integrate_cvode_tolerance,
                                       .free = release};

hc_status integrate_new_regularised(const modal_base *base, double tolerance, integrator **out)
{
  *out = NULL;
  regularised *in = calloc(1, sizeof *in); /* zeroed, so free works half-built */
  if (!in) return HC_NO_MEMORY;
  in->base.base.does = &class;
  in->base.base.scatter = INTEGRATE_BDF_SCATTER;
  in->base.tolerance = tolerance;
  in->base.n_sized = in->n = 2 * base->n + base->n_contacts;
  hc_status st = make_parts(in, base);
  if (st == HC_OK) st = make_variations(in);
  if (st == HC_OK) {
    *out = &in->base.base;
    return HC_OK;
  }
  release(&in->base.base);
  return st;
}
