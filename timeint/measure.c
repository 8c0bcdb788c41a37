/* measure.c - see measure.h. Proof: tests/timeint/test_measure.c. */
#include "timeint/measure.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/constants.h"
#include "numerics/roots.h"

void measure_begin(measure *me, const scaled_model *m)
{
  memset(me, 0, sizeof *me);
  me->m = m;
  me->max = -INFINITY;
  me->min = INFINITY;
}

static void extend(measure *me, double x)
{
  if (x > me->max) me->max = x;
  if (x < me->min) me->min = x;
}

static void take_instant(measure *me, double x)
{
  double theta = TWO_PI * me->next / TIMEINT_WAVE;
  me->sum += x;
  me->sum_sq += x * x;
  me->sum_cos += x * cos(theta);
  me->sum_sin += x * sin(theta);
  me->wave[me->next++] = x;
}

/* At the end of a step, and at the start of a period (`in` NULL): where the next step begins. */
static void take_end(measure *me, const integrator *in, double theta, const double *y)
{
  double dy[SCALED_MAX_STATES];
  scaled_rhs(me->m, theta, y, dy); /* finite: CVODE has just been here */
  memcpy(me->y, y, sizeof *y * (size_t)me->m->n_states);
  me->a = dy[SCALED_P];
  extend(me, y[SCALED_X]);
  for (int j = 0; j < me->m->n_contacts; ++j) me->slides = me->slides || (in && integrate_slides(in, j, y));
}

void measure_period(measure *me, const double *y)
{
  ++me->periods;
  me->next = 0;
  take_end(me, NULL, 0, y);
  take_instant(me, y[SCALED_X]);
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

static hc_status take_peak(measure *me, const integrator *in, double t0, double p0, double t1, double p1)
{
  double y[SCALED_MAX_STATES], t;
  if ((p0 > 0) == (p1 > 0)) return HC_OK; /* p = 0 at an end was taken as a step's end */
  hc_status st = find_root(in, 0, t0, p0, t1, p1, y, &t);
  if (st == HC_OK) extend(me, y[SCALED_X]);
  return st;
}

/* Peaks of x between me->y at t0 and y, a at t1: where P changes sign, at most twice in a step. */
static hc_status take_peaks(measure *me, const integrator *in, double t0, double t1, const double *y, double a)
{
  double p0 = me->y[SCALED_P], p1 = y[SCALED_P], mid[SCALED_MAX_STATES], t;
  bool turns = (p0 > 0) == (p1 > 0) && (me->a > 0) != (a > 0) && (me->a > 0) != (p0 > 0);
  if (!turns) return take_peak(me, in, t0, p0, t1, p1);
  hc_status st = find_root(in, 1, t0, me->a, t1, a, mid, &t); /* P comes nearest to 0 here */
  if (st == HC_OK) st = take_peak(me, in, t0, p0, t, mid[SCALED_P]);
  return st == HC_OK ? take_peak(me, in, t, mid[SCALED_P], t1, p1) : st;
}

hc_status measure_step(void *self, const integrator *in, double theta0, double theta1)
{
  measure *me = self;
  double y[SCALED_MAX_STATES], dy[SCALED_MAX_STATES];
  for (double t; me->next < TIMEINT_WAVE && (t = TWO_PI * me->next / TIMEINT_WAVE) <= theta1;) {
    hc_status st = integrate_dense(in, t, 0, y);
    if (st != HC_OK) return st;
    take_instant(me, y[SCALED_X]);
  }
  hc_status st = integrate_dense(in, theta1, 0, y);
  if (st != HC_OK) return st;
  scaled_rhs(me->m, theta1, y, dy);
  if ((st = take_peaks(me, in, theta0, theta1, y, dy[SCALED_P])) != HC_OK) return st;
  take_end(me, in, theta1, y);
  return HC_OK;
}

/* The strongest thing contact c does while its motion covers [min, max]. */
static contact_regime regime_of(const model_contact *c, double min, double max, bool slides)
{
  const double sine = c->normal;
  if (!(c->law.kn > 0) || !(sine * max + c->law.gap > 0)) return CONTACT_LINEAR; /* never touched */
  if (sine * min + c->law.gap < 0) return CONTACT_SEPARATES;
  return slides ? CONTACT_SLIPS : CONTACT_STUCK;
}

void measure_report(const measure *me, const model *from, double length, timeint_result *r)
{
  const double n = (double)TIMEINT_WAVE * me->periods;
  r->max = me->max * length;
  r->min = me->min * length;
  r->amplitude = 0.5 * (me->max - me->min) * length;
  r->mean = me->sum / n * length;
  r->rms = sqrt(me->sum_sq / n) * length;
  r->a1 = 2 * me->sum_cos / n * length;
  r->b1 = 2 * me->sum_sin / n * length;
  r->harmonic_1 = hypot(r->a1, r->b1);
  for (int i = 0; i < TIMEINT_WAVE; ++i) r->wave[i] = me->wave[i] * length;
  r->regime = CONTACT_LINEAR;
  for (int j = 0; j < from->n_contacts; ++j) {
    contact_regime one = regime_of(&from->contacts[j], r->min, r->max, me->slides);
    if (one > r->regime) r->regime = one;
  }
}
