/* integrate_exact.c - see integrate.h. X and P by CVODE, one smooth right-hand side a phase (phase.h), from
 * transition to transition; the sliders follow from the phase. Adams: nothing here is stiff but a huge damping.
 *
 * Root functions, always four, so that a period allocates nothing:
 *     up - X,  X - down                      end the phase where they fall through 0
 *     P                                      ends it if some contact slips
 *     P'                                     ends nothing
 * P and P' are there to be looked at: in a step whose ends lie inside the phase X can only leave it beyond a turning
 * point; CVODE goes for that root of P, finds X outside there, and takes the crossing before it. P' does the same
 * for two roots of P in one step. So nothing that lasts longer than CVODE's root tolerance (100 roundings of theta)
 * is stepped over, unless P has four roots in one step. In a phase that nothing can end all four are 1. None is ever
 * exactly 0: a function that stays 0 is an error or a warning to CVODE, depending on when.
 *
 * A transition located within dtheta makes an error of order dtheta^2, the force being continuous; CVODE's 1e-13
 * leaves nothing to polish.
 *
 * Monodromy: between transitions the variations obey a linear equation with constant coefficients, so they are carried
 * along in closed form. */
#include "timeint/integrate_private.h"

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
#include "model/linear.h"
#include "numerics/sundials_compat.h"
#include "timeint/phase.h"

static const double at_end = 64 * DBL_EPSILON; /* nearer to 2 pi CVODE would answer CV_TOO_CLOSE to a restart */

enum {
  MAX_STEPS = 1000000,   /* between transitions: a thousand times what a hard period takes */
  MAX_TRANSITIONS = 1000 /* per period: 16 contacts that open, slip, stick, slip, stick and close make 96 an
                            oscillation */
};

enum { ROOT_UP, ROOT_DOWN, ROOT_TURN, ROOT_BEND, ROOTS };

typedef struct exact { /* from integrate_new_exact, to integrate_free; not shared between threads */
  integrator base;
  int n; /* number of states                                              */
  double tolerance;
  const scaled_model *m; /* of the period under way; the caller's                         */
  phase phase;           /* now                                                           */
  bool varies;           /* the monodromy is asked for                                        */
  double varied;         /* theta up to which `monodromy` has come                            */
  double monodromy[SCALED_MAX_STATES * SCALED_MAX_STATES]; /* by columns; rows of W while stuck */
} exact;

static int rhs(sunrealtype theta, N_Vector y, N_Vector dy, void *self)
{
  exact *in = self;
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
  const exact *in = self;
  double *a = SM_DATA_D(jac);
  a[0] = 0, a[1] = -in->phase.k; /* by X */
  a[2] = 1, a[3] = -in->m->c;    /* by P */
  return 0;
}

/* CVODE multiplies values on either side of a root: this must not underflow. */
static double never_zero(double g) { return g != 0 ? g : -1e-100; }

static int roots(sunrealtype theta, N_Vector y, sunrealtype *g, void *self)
{
  const exact *in = self;
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
static hc_status make_cvode(exact *in)
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
  integrate_free_parts(base);
  free(base);
}

/* Variations from in->varied to theta: dX'' + c dX' + k dX = sum_j share_j dW_j, a column at a time. The response to
 * a constant force 1 from rest is (1 - e00)/k in X and e01 in P. */
static void vary_to(exact *in, double theta)
{
  const phase *ph = &in->phase;
  const double span = theta - in->varied, c = in->m->c;
  double e[2][2];
  linear_free_motion(1, c, ph->k, span, e);
  const double step = ph->k != 0 ? (1 - e[0][0]) / ph->k : c != 0 ? (span - e[0][1]) / c : 0.5 * span * span;
  for (int q = 0; q < in->n; ++q) {
    double *z = in->monodromy + q * in->n, pull = 0, x = z[SCALED_X], p = z[SCALED_P];
    for (int j = 0; j < in->m->n_contacts; ++j) pull += phase_share(ph, j) * z[SCALED_W + j];
    z[SCALED_X] = e[0][0] * x + e[0][1] * p + step * pull;
    z[SCALED_P] = e[1][0] * x + e[1][1] * p + e[0][1] * pull;
  }
  in->varied = theta;
}

/* Sliders that have just come to rest. */
static void vary_held(exact *in, const phase *before)
{
  for (int j = 0; j < in->m->n_contacts; ++j) {
    const phase_contact *pc = &in->phase.contact[j];
    if (pc->state != CONTACT_STICK || (before && before->contact[j].state == CONTACT_STICK)) continue;
    for (int q = 0; q < in->n; ++q) {
      double *z = in->monodromy + q * in->n;
      z[SCALED_W + j] = pc->own ? (q == SCALED_W + j ? 1.0 : 0.0) : pc->held_by_x * z[SCALED_X];
    }
  }
}

static void vary_begin(exact *in)
{
  memset(in->monodromy, 0, sizeof in->monodromy);
  in->monodromy[SCALED_X] = 1;
  in->monodromy[SCALED_P + in->n] = 1;
  in->varied = 0;
  vary_held(in, NULL);
}

/* Into monodromy[n*n], with the rows of sliders that are tied to X. */
static void vary_end(exact *in, double *monodromy)
{
  vary_to(in, TWO_PI);
  memcpy(monodromy, in->monodromy, sizeof *monodromy * (size_t)(in->n * in->n));
  for (int j = 0; j < in->m->n_contacts; ++j) {
    double rest, by_x;
    phase_slider(&in->phase, j, &rest, &by_x);
    if (phase_share(&in->phase, j) != 0) continue;
    for (int q = 0; q < in->n; ++q) monodromy[SCALED_W + j + q * in->n] = by_x * monodromy[SCALED_X + q * in->n];
  }
}

/* CVODE from theta on, in the phase as it is. */
static hc_status start(exact *in, double theta)
{
  int flag = CVodeReInit(in->base.cv, theta, in->base.y);
  if (flag == CV_SUCCESS) flag = CVodeSetStopTime(in->base.cv, TWO_PI);
  return integrate_translate(&in->base, flag);
}

/* CVODE stopped on a root at theta. */
static hc_status transition(exact *in, double theta, int *count)
{
  int info[ROOTS] = {0};
  int flag = CVodeGetRootInfo(in->base.cv, info);
  if (flag != CV_SUCCESS) return integrate_translate(&in->base, flag);
  const int way = info[ROOT_TURN] ? info[ROOT_TURN] : info[ROOT_UP] ? 1 : info[ROOT_DOWN] ? -1 : 0;
  if (!way) return HC_OK;
  const phase before = in->phase;
  const int n = phase_next(&in->phase, NV_DATA_S(in->base.y)[SCALED_X], way, info[ROOT_TURN] != 0);
  if (!n) return HC_OK;
  if ((*count += n) > MAX_TRANSITIONS) return HC_CHATTER;
  if (in->varies) {
    phase after = in->phase;
    in->phase = before;
    vary_to(in, theta);
    in->phase = after;
    vary_held(in, &before);
  }
  if (theta == TWO_PI) return HC_OK;
  hc_status st = integrate_add_counts(&in->base);
  return st == HC_OK ? start(in, theta) : st;
}

/* To the end of the period. Unwatched, CVODE returns at roots only; the steps are the same. At tout == tstop 6.4
 * says CV_SUCCESS, 7 says CV_TSTOP_RETURN. */
static hc_status run(exact *in, integrate_watch *watch, void *self, int *count)
{
  sunrealtype theta = 0;
  for (int still = 0; theta < TWO_PI;) {
    sunrealtype before = theta;
    int flag = CVode(in->base.cv, TWO_PI, in->base.y, &theta, watch ? CV_ONE_STEP : CV_NORMAL);
    if (flag != CV_SUCCESS && flag != CV_TSTOP_RETURN && flag != CV_ROOT_RETURN)
      return integrate_translate(&in->base, flag);
    if (TWO_PI - theta <= at_end * TWO_PI) theta = TWO_PI;
    still = theta > before ? 0 : still + 1;
    if (still > MAX_TRANSITIONS) break;
    hc_status st = watch ? watch(self, &in->base, before, theta) : HC_OK;
    if (st == HC_OK && flag == CV_ROOT_RETURN) st = transition(in, theta, count);
    if (st != HC_OK) return st;
  }
  return integrate_check_end(&in->base, theta, 2);
}

static void take_state(const exact *in, double *y)
{
  memcpy(y, NV_DATA_S(in->base.y), 2 * sizeof *y);
  for (int j = 0; j < in->m->n_contacts; ++j) {
    double rest, by_x;
    phase_slider(&in->phase, j, &rest, &by_x);
    y[SCALED_W + j] = rest + by_x * y[SCALED_X];
  }
}

static hc_status period(integrator *base, const scaled_model *m, double *y, double *monodromy, integrate_watch *watch,
                        void *self)
{
  exact *in = (exact *)base;
  if (m->n_states != in->n) return HC_BUG;
  in->m = m;
  in->base.not_finite = false;
  in->varies = monodromy != NULL;
  base->flag = CV_SUCCESS;
  int count = phase_begin(&in->phase, m, y);
  if (count < 0) return HC_NOT_FINITE;
  if (monodromy) vary_begin(in);
  memcpy(NV_DATA_S(in->base.y), y, 2 * sizeof *y);
  hc_status st = start(in, 0);
  if (st == HC_OK) st = run(in, watch, self, &count);
  hc_status counted = integrate_add_counts(&in->base);
  base->switches += count;
  if (st == HC_OK) st = counted;
  if (st != HC_OK) return st;
  take_state(in, y);
  if (monodromy) vary_end(in, monodromy);
  return HC_OK;
}

static hc_status dense(const integrator *base, double theta, int order, double *y)
{
  const exact *in = (const exact *)base;
  if (CVodeGetDky(in->base.cv, theta, order, in->base.dky) != CV_SUCCESS) return HC_BUG; /* theta outside the step */
  memcpy(y, NV_DATA_S(in->base.dky), 2 * sizeof *y);
  for (int j = 0; j < in->m->n_contacts; ++j) {
    double rest, by_x;
    phase_slider(&in->phase, j, &rest, &by_x);
    y[SCALED_W + j] = (order == 0 ? rest : 0) + by_x * y[SCALED_X];
  }
  return HC_OK;
}

static bool slides(const integrator *base, int j, const double *y)
{
  (void)y; /* the phase knows */
  return contact_slip_sign(((const exact *)base)->phase.contact[j].state) != 0;
}

static const integrator_class class = {.period = period, .dense = dense, .slides = slides, .free = release};

hc_status integrate_new_exact(int n_states, double tolerance, integrator **out)
{
  *out = NULL;
  if (n_states < SCALED_W || n_states > SCALED_MAX_STATES) return HC_BAD_INPUT;
  exact *in = calloc(1, sizeof *in); /* zeroed, so free works half-built */
  if (!in) return HC_NO_MEMORY;
  in->base.does = &class;
  in->n = n_states;
  in->tolerance = tolerance;
  hc_status st = integrate_make_parts(&in->base, 2, CV_ADAMS);
  if (st == HC_OK) st = make_cvode(in);
  if (st == HC_OK) {
    *out = &in->base;
    return HC_OK;
  }
  release(&in->base);
  return st;
}
