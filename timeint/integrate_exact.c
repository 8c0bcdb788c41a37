/* integrate_exact.c - see integrate_exact.h.
 *
 * Root functions, always four, so that a period allocates nothing:
 *     up - X,  X - down                      end the phase where they fall through 0
 *     P                                      ends the phase if some contact slips
 *     P'                                     ends nothing
 * P is a root function also where nothing slips, and P' always, so that no end is stepped over. If both ends of a step
 * lie inside the phase, X can have left it only around a turning point, a root of P. CVODE's search for that root
 * evaluates all functions next to it, where X is outside, and so returns the crossing, which comes first. Two turning
 * points in one step leave the sign of P as it was; the search for the root of P' between them separates them in the
 * same way. So an excursion longer than CVODE's root tolerance (100 roundings of theta) is found, unless P has four
 * roots in one step.
 * In a phase that nothing can end all four functions are 1. None is ever exactly 0: CVODE answers a function that stays
 * 0 with an error or a warning.
 *
 * A transition found with an error dtheta changes the state by order dtheta^2 only, since the force is continuous;
 * CVODE's dtheta is 1e-13, so the transition needs no refinement.
 *
 * The monodromy matrix is variations.h's. */
#include "timeint/integrate_exact.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cvodes/cvodes.h>
#include <cvodes/cvodes_ls.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "base/constants.h"
#include "numerics/sundials_compat.h"
#include "timeint/integrate_cvode.h"
#include "timeint/modal_motion.h"
#include "timeint/phase.h"
#include "timeint/variations.h"

static const double at_end = 64 * DBL_EPSILON; /* nearer to 2 pi CVODE would answer CV_TOO_CLOSE to a restart */

enum {
  MAX_STEPS = 1000000,   /* between transitions: a thousand times what a hard period takes */
  MAX_STANDSTILLS = 1000 /* returns of CVODE in succession that do not advance theta */
};

enum { ROOT_UP, ROOT_DOWN, ROOT_TURN, ROOT_BEND, ROOTS };

typedef struct event_driven { /* from integrate_new_exact, to integrate_free; not shared between threads */
  cvode_integrator base;
  int n; /* number of states */
  double tolerance;
  phase phase, before; /* now; before the last transition */
  bool varies;         /* the monodromy is asked for */
  variations variations;
  double theta, begun[2]; /* where the watched step under way began, and X, P there */
  double ends;            /* where it ends */
} event_driven;

static int rhs(sunrealtype theta, N_Vector y, N_Vector dy, void *self)
{
  event_driven *in = self;
  const double *z = NV_DATA_S(y);
  double *dz = NV_DATA_S(dy);
  dz[SCALED_X] = z[SCALED_P];
  dz[SCALED_P] = phase_force(&in->phase, cos(theta), z[SCALED_X], z[SCALED_P]);
  if (isfinite(dz[SCALED_X] + dz[SCALED_P])) return 0;
  in->base.not_finite = true;
  return -1;
}

static int jacobian(sunrealtype theta, N_Vector y, N_Vector dy, SUNMatrix jac, void *self, N_Vector t1, N_Vector t2,
                    N_Vector t3)
{
  (void)theta, (void)y, (void)dy, (void)t1, (void)t2, (void)t3;
  const event_driven *in = self;
  double *a = SM_DATA_D(jac);
  a[0] = 0, a[1] = -in->phase.k;   /* by X */
  a[2] = 1, a[3] = -in->base.m->c; /* by P */
  return 0;
}

/* CVODE multiplies values on either side of a root: this must not underflow. */
static double never_zero(double g) { return g != 0 ? g : -1e-100; }

static int roots(sunrealtype theta, N_Vector y, sunrealtype *g, void *self)
{
  const event_driven *in = self;
  const phase *ph = &in->phase;
  const double *z = NV_DATA_S(y);
  for (int i = 0; i < ROOTS; ++i) g[i] = 1;
  if (!phase_ends(ph)) return 0;
  if (ph->up < INFINITY) g[ROOT_UP] = never_zero(ph->up - z[SCALED_X]);
  if (ph->down > -INFINITY) g[ROOT_DOWN] = never_zero(z[SCALED_X] - ph->down);
  g[ROOT_TURN] = never_zero(z[SCALED_P]);
  g[ROOT_BEND] = never_zero(phase_force(ph, cos(theta), z[SCALED_X], z[SCALED_P]));
  return 0;
}

/* What fails here is memory, whatever the flag: CVodeSetLinearSolver's CVLS_MEM_FAIL is the number of
 * CV_CONV_FAILURE. */
static hc_status make_cvode(event_driven *in)
{
  int falls[ROOTS] = {[ROOT_UP] = -1, [ROOT_DOWN] = -1}; /* 0: either way */
  N_VConst(0.0, in->base.y);
  int flag = CVodeInit(in->base.cv, rhs, 0.0, in->base.y); /* first: the other calls need it */
  if (flag == CV_SUCCESS) flag = CVodeRootInit(in->base.cv, ROOTS, roots);
  if (flag != CV_SUCCESS) return HC_NO_MEMORY;
  const int flags[] = {
      HC_CVODE_QUIET(in->base.cv),
      CVodeSStolerances(in->base.cv, in->tolerance, in->tolerance),
      CVodeSetUserData(in->base.cv, in),
      CVodeSetLinearSolver(in->base.cv, in->base.ls, in->base.jac),
      CVodeSetJacFn(in->base.cv, jacobian),
      CVodeSetRootDirection(in->base.cv, falls),
      CVodeSetEtaFixedStepBounds(in->base.cv, 0.9, 1.2), /* from 0, 1.5: a third fewer steps, and a tenth of the
                                                            error (c2 at omega 9) */
      CVodeSetNoInactiveRootWarn(in->base.cv),
      CVodeSetMaxNumSteps(in->base.cv, MAX_STEPS),
      CVodeSetMaxHnilWarns(in->base.cv, -1),
  };
  return integrate_first_flag(flags, sizeof flags / sizeof *flags) == CV_SUCCESS ? HC_OK : HC_NO_MEMORY;
}

static void release(integrator *base)
{
  event_driven *in = (event_driven *)base;
  free(in->phase.contact);
  free(in->before.contact);
  free(in->variations.matrix);
  integrate_free_parts(&in->base);
  free(base);
}

/* CVODE from theta on, in the phase as it is. */
static hc_status start(event_driven *in, double theta)
{
  int flag = CVodeReInit(in->base.cv, theta, in->base.y);
  if (flag == CV_SUCCESS) flag = CVodeSetStopTime(in->base.cv, TWO_PI);
  return integrate_translate(&in->base, flag);
}

/* CVODE stopped on a root at theta. */
static hc_status pass_root(event_driven *in, double theta, int *count)
{
  int info[ROOTS] = {0};
  int flag = CVodeGetRootInfo(in->base.cv, info);
  if (flag != CV_SUCCESS) return integrate_translate(&in->base, flag);
  const int way = info[ROOT_TURN] ? info[ROOT_TURN] : info[ROOT_UP] ? 1 : info[ROOT_DOWN] ? -1 : 0;
  if (!way) return HC_OK;
  phase_copy(&in->before, &in->phase);
  const int n = phase_next(&in->phase, NV_DATA_S(in->base.y)[SCALED_X], way, info[ROOT_TURN] != 0);
  if (!n) return HC_OK;
  if ((*count += n) > integrate_most_transitions(in->base.m->n_contacts)) return HC_CHATTER;
  if (in->varies) {
    variations_advance(&in->variations, &in->before, theta);
    variations_stick(&in->variations, &in->phase, &in->before);
  }
  if (theta == TWO_PI) return HC_OK;
  hc_status st = integrate_add_counts(&in->base);
  return st == HC_OK ? start(in, theta) : st;
}

static void begin_step(event_driven *in, double theta)
{
  in->theta = theta;
  memcpy(in->begun, NV_DATA_S(in->base.y), sizeof in->begun);
}

/* From theta = 0 to the end of the period. Unwatched, CVODE returns at roots only; the steps are the same. At tout ==
 * tstop version 6.4 says CV_SUCCESS, 7 says CV_TSTOP_RETURN. */
static hc_status integrate_to_end(event_driven *in, integrate_watch *watch, void *self, int *count)
{
  sunrealtype theta = 0;
  begin_step(in, 0);
  for (int standstills = 0; theta < TWO_PI;) {
    sunrealtype before = theta;
    int flag = CVode(in->base.cv, TWO_PI, in->base.y, &theta, watch ? CV_ONE_STEP : CV_NORMAL);
    if (flag != CV_SUCCESS && flag != CV_TSTOP_RETURN && flag != CV_ROOT_RETURN)
      return integrate_translate(&in->base, flag);
    if (TWO_PI - theta <= at_end * TWO_PI) theta = TWO_PI;
    standstills = theta > before ? 0 : standstills + 1;
    if (standstills > MAX_STANDSTILLS) break;
    in->ends = theta;
    hc_status st = watch ? watch(self, &in->base.base, before, theta) : HC_OK;
    begin_step(in, theta);
    if (st == HC_OK && flag == CV_ROOT_RETURN) st = pass_root(in, theta, count);
    if (st != HC_OK) return st;
  }
  return integrate_check_end(&in->base, theta, 2);
}

static hc_status period(integrator *base, const scaled_model *m, double *y, double *monodromy, integrate_watch *watch,
                        void *self)
{
  event_driven *in = (event_driven *)base;
  if (m->n_states != in->n) return HC_BUG;
  in->base.m = m;
  in->varies = monodromy != NULL;
  hc_status st = integrate_begin_period(&in->base);
  if (st != HC_OK) return st;
  int count = phase_begin(&in->phase, m, y);
  if (count < 0) return HC_NOT_FINITE;
  if (monodromy) variations_begin(&in->variations, &in->phase);
  memcpy(NV_DATA_S(in->base.y), y, 2 * sizeof *y);
  st = start(in, 0);
  if (st == HC_OK) st = integrate_to_end(in, watch, self, &count);
  hc_status counted = integrate_add_counts(&in->base);
  base->transitions += count;
  if (st == HC_OK) st = counted;
  if (st != HC_OK) return st;
  memcpy(y, NV_DATA_S(in->base.y), 2 * sizeof *y);
  phase_set_sliders(&in->phase, 0, y);
  if (monodromy) variations_end(&in->variations, &in->phase, monodromy);
  return HC_OK;
}

static hc_status dense(const integrator *base, double theta, int order, double *y)
{
  const event_driven *in = (const event_driven *)base;
  if (CVodeGetDky(in->base.cv, theta, order, in->base.dky) != CV_SUCCESS) return HC_BUG; /* theta outside the step */
  memcpy(y, NV_DATA_S(in->base.dky), 2 * sizeof *y);
  phase_set_sliders(&in->phase, order, y);
  return HC_OK;
}

/* The motion of the step solves the phase's linear equation, and so its integrals follow from its ends. */
static bool fourier(const integrator *base, int r, double out[3])
{
  (void)r;
  const event_driven *in = (const event_driven *)base;
  const mode one = mode_make(in->base.m->c, in->phase.k);
  double d = -in->phase.d, x[2] = {in->begun[0], NV_Ith_S(in->base.y, 0)},
         p[2] = {in->begun[1], NV_Ith_S(in->base.y, 1)};
  double complex f = in->base.m->f;
  const modal_motion motion = {.n = 1, .theta = in->theta, .mode = &one, .q = x, .p = p, .d = &d, .f = &f};
  const modal_point from = {.q = x, .p = p}, to = {.tau = in->ends - in->theta, .q = x + 1, .p = p + 1};
  return modal_fourier(&motion, 0, &from, &to, out);
}

static contact_state state(const integrator *base, int j, const double *y)
{
  (void)y; /* the phase has it */
  return ((const event_driven *)base)->phase.contact[j].state;
}

/* One contact more than there are: calloc of nothing may answer NULL. */
static hc_status make_memory(event_driven *in)
{
  const size_t n = (size_t)in->n, contacts = n - SCALED_W + 1;
  in->phase.contact = calloc(contacts, sizeof *in->phase.contact);
  in->before.contact = calloc(contacts, sizeof *in->before.contact);
  in->variations = (variations){.n = in->n, .matrix = calloc(n * n, sizeof(double))};
  return in->phase.contact && in->before.contact && in->variations.matrix ? HC_OK : HC_NO_MEMORY;
}

static const integrator_class class = {.period = period,
                                       .dense = dense,
                                       .samples = integrate_dense_samples,
                                       .fourier = fourier,
                                       .state = state,
                                       .tolerance = integrate_cvode_tolerance,
                                       .free = release};

hc_status integrate_new_exact(int n_states, double tolerance, integrator **out)
{
  *out = NULL;
  if (n_states < SCALED_W) return HC_BAD_INPUT;
  event_driven *in = calloc(1, sizeof *in); /* zeroed, so free works half-built */
  if (!in) return HC_NO_MEMORY;
  in->base.base.does = &class;
  in->base.base.scatter = INTEGRATE_ADAMS_SCATTER;
  in->n = n_states;
  in->tolerance = tolerance;
  hc_status st = make_memory(in);
  if (st == HC_OK) st = integrate_make_parts(&in->base, 2, CV_ADAMS, NULL);
  if (st == HC_OK) st = make_cvode(in);
  if (st == HC_OK) {
    *out = &in->base.base;
    return HC_OK;
  }
  release(&in->base.base);
  return st;
}
