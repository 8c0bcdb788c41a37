/* measure.c - see measure.h. Proof: tests/timeint/test_measure.c. */
#include "timeint/measure.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/constants.h"
#include "model/periodic_motion.h"
#include "numerics/roots.h"

static const double longest_quintic = 0.2; /* [rad] 0.2^7/100800 = 1e-10 of the sixth derivative, for one step */

hc_status measure_make(measure *me, int n_states)
{
  const size_t n = (size_t)n_states;
  *me = (measure){.end = calloc(n, sizeof(double)),
                  .end_rate = calloc(n, sizeof(double)),
                  .inside = calloc(n, sizeof(double)),
                  .circle = calloc((size_t)TIMEINT_WAVE * 2, sizeof(double))};
  if (!me->end || !me->end_rate || !me->inside || !me->circle) return HC_NO_MEMORY;
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    me->circle[2 * i] = cos(TWO_PI * i / TIMEINT_WAVE);
    me->circle[2 * i + 1] = sin(TWO_PI * i / TIMEINT_WAVE);
  }
  return HC_OK;
}

void measure_free(measure *me)
{
  free(me->circle);
  free(me->end);
  free(me->end_rate);
  free(me->inside);
}

void measure_begin(measure *me, const scaled_model *m)
{
  *me = (measure){.m = m,
                  .max = -INFINITY,
                  .min = INFINITY,
                  .circle = me->circle,
                  .end = me->end,
                  .end_rate = me->end_rate,
                  .inside = me->inside};
}

static void extend(measure *me, double x)
{
  if (x > me->max) me->max = x;
  if (x < me->min) me->min = x;
}

/* Sums over the instants of a whole period. */
static void add_sums(measure *me)
{
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    const double x = me->wave[i];
    me->sum += x;
    me->sum_sq += x * x;
    me->sum_cos += x * me->circle[2 * i];
    me->sum_sin += x * me->circle[2 * i + 1];
  }
}

/* The instants of the wave from me->next to theta1. */
static hc_status add_instants(measure *me, const integrator *in, double theta1)
{
  const double step = TWO_PI / TIMEINT_WAVE;
  int last = me->next;
  while (last < TIMEINT_WAVE && TWO_PI * last / TIMEINT_WAVE <= theta1) ++last;
  const int count = last - me->next;
  if (count == 0) return HC_OK;
  hc_status st = integrate_samples(in, TWO_PI * me->next / TIMEINT_WAVE, step, count, me->wave + me->next);
  me->next = last;
  if (st == HC_OK && last == TIMEINT_WAVE) add_sums(me);
  return st;
}

/* Integral over h of what has the values, first and second derivatives g[end][3] at its two ends: of the quintic
 * through them, off by h^7/100800 of the sixth derivative. */
static double integral_of(double h, double g[2][3])
{
  return h / 2 * (g[0][0] + g[1][0]) + h * h / 10 * (g[0][1] - g[1][1]) + h * h * h / 120 * (g[0][2] + g[1][2]);
}

/* Integrals of X, X cos, X sin over the step from theta0, where it began, to theta1 at the state y, P' = a: the
 * integrator's, or from both ends. Not over a step so long that this is not as good as the step itself: then sums over
 * the instants must do. */
static void add_integrals(measure *me, const integrator *in, double theta0, double theta1, const double *y, double a)
{
  double step[3] = {0};
  const double h = theta1 - theta0, ends[2][3] = {{me->x, me->p, me->a}, {y[SCALED_X], y[SCALED_P], a}};
  if (!integrate_fourier(in, step)) {
    double plain[2][3], by_cos[2][3], by_sin[2][3];
    me->no_integrals = me->no_integrals || h > longest_quintic;
    for (int i = 0; i < 2; ++i) {
      const double co = cos(i ? theta1 : theta0), si = sin(i ? theta1 : theta0);
      const double x = ends[i][0], p = ends[i][1], bend = ends[i][2] - x;
      for (int k = 0; k < 3; ++k) plain[i][k] = ends[i][k];
      by_cos[i][0] = x * co, by_cos[i][1] = p * co - x * si, by_cos[i][2] = bend * co - 2 * p * si;
      by_sin[i][0] = x * si, by_sin[i][1] = p * si + x * co, by_sin[i][2] = bend * si + 2 * p * co;
    }
    step[0] = integral_of(h, plain);
    step[1] = integral_of(h, by_cos);
    step[2] = integral_of(h, by_sin);
  }
  for (int i = 0; i < 3; ++i) me->integral[i] += step[i];
}

/* Where the next step begins: state y, P' = a. */
static void begin_step(measure *me, const double *y, double a)
{
  me->x = y[SCALED_X];
  me->p = y[SCALED_P];
  me->a = a;
  extend(me, me->x);
}

void measure_period(measure *me, const double *y)
{
  ++me->periods;
  me->wave[0] = y[SCALED_X];
  me->next = 1;
  scaled_rhs(me->m, 0, y, me->end_rate); /* not finite: then CVODE fails in its first step */
  begin_step(me, y, me->end_rate[SCALED_P]);
}

/* P's derivative of the given order (0: P itself) by CVODE's dense output. */
typedef struct dense_rate {
  const integrator *in;
  int order;
  double *y;
} dense_rate;

static hc_status rate_at(void *self, double theta, double *rate)
{
  const dense_rate *d = self;
  hc_status st = integrate_dense(d->in, theta, d->order, d->y);
  *rate = d->y[SCALED_P];
  return st;
}

/* A root of it between t0 and t1, where it has the values f0 and f1 of opposite sign. y: the state there. */
static hc_status find_root(const integrator *in, int order, double t0, double f0, double t1, double f1, double *y,
                           double *root)
{
  dense_rate d = {in, order, y};
  root_point found;
  hc_status st = root_between(rate_at, &d, t0, f0, t1, f1, 4 * DBL_EPSILON * t1, &found);
  *root = found.x;
  return st == HC_OK ? integrate_dense(in, found.x, 0, y) : st;
}

/* The peak of x between t0, where P = p0, and t1, where P = p1, if P changes sign. */
static hc_status add_peak(measure *me, const integrator *in, double t0, double p0, double t1, double p1)
{
  double t;
  if ((p0 > 0) == (p1 > 0)) return HC_OK; /* P = 0 at an end of the step: begin_step has x there */
  hc_status st = find_root(in, 0, t0, p0, t1, p1, me->inside, &t);
  if (st == HC_OK) extend(me, me->inside[SCALED_X]);
  return st;
}

/* The peaks of x in the step from t0, where it began, to t1, where P = p1 and P' = a1: P changes sign at most twice. */
static hc_status add_peaks(measure *me, const integrator *in, double t0, double t1, double p1, double a1)
{
  const double p0 = me->p;
  double t;
  bool turns = (p0 > 0) == (p1 > 0) && (me->a > 0) != (a1 > 0) && (me->a > 0) != (p0 > 0);
  if (!turns) return add_peak(me, in, t0, p0, t1, p1);
  hc_status st = find_root(in, 1, t0, me->a, t1, a1, me->inside, &t); /* P comes nearest to 0 here */
  const double p = me->inside[SCALED_P];
  if (st == HC_OK) st = add_peak(me, in, t0, p0, t, p);
  return st == HC_OK ? add_peak(me, in, t, p, t1, p1) : st;
}

hc_status measure_step(void *self, const integrator *in, double theta0, double theta1)
{
  measure *me = self;
  double *y = me->end;
  hc_status st = add_instants(me, in, theta1);
  if (st != HC_OK) return st;
  st = integrate_dense(in, theta1, 0, y);
  if (st != HC_OK) return st;
  scaled_rhs(me->m, theta1, y, me->end_rate); /* finite: CVODE has just been here */
  const double a = me->end_rate[SCALED_P];
  add_integrals(me, in, theta0, theta1, y, a);
  if ((st = add_peaks(me, in, theta0, theta1, y[SCALED_P], a)) != HC_OK) return st;
  begin_step(me, y, a);
  for (int j = 0; j < me->m->n_contacts; ++j) me->slips = me->slips || integrate_slips(in, j, y);
  return HC_OK;
}

/* The strongest thing contact c does while its motion covers [min, max]. */
static contact_regime regime_of(const model_contact *c, double min, double max, bool slips)
{
  const double sine = *c->normal;
  if (!(c->law.kn > 0) || !(sine * max + c->law.gap > 0)) return CONTACT_LINEAR; /* never touched */
  if (sine * min + c->law.gap < 0) return CONTACT_SEPARATES;
  return slips ? CONTACT_SLIPS : CONTACT_STUCK;
}

void measure_report(const measure *me, const model *from, double length, timeint_result *r)
{
  const double n = (double)TIMEINT_WAVE * me->periods;
  r->max = me->max * length;
  r->min = me->min * length;
  r->amplitude = motion_amplitude(me->max, me->min) * length;
  r->rms = sqrt(me->sum_sq / n) * length;
  const double span = TWO_PI * me->periods;
  r->mean = (me->no_integrals ? me->sum / n : me->integral[0] / span) * length;
  r->a1 = 2 * (me->no_integrals ? me->sum_cos / n : me->integral[1] / span) * length;
  r->b1 = 2 * (me->no_integrals ? me->sum_sin / n : me->integral[2] / span) * length;
  r->harmonic_1 = hypot(r->a1, r->b1);
  for (int i = 0; i < TIMEINT_WAVE; ++i) r->wave[i] = me->wave[i] * length;
  r->regime = CONTACT_LINEAR;
  for (int j = 0; j < from->n_contacts; ++j) {
    contact_regime one = regime_of(&from->contacts[j], r->min, r->max, me->slips);
    if (one > r->regime) r->regime = one;
  }
}
