/* measure.c - see measure.h. Proof: tests/timeint/test_measure.c. */
#include "timeint/period/measure.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/norm.h"
#include "numerics/roots.h"

hc_status measure_make(measure *me, int n_states, int n_responses, int n_contacts, workspace *w)
{
  const size_t n = (size_t)n_states, contacts = (size_t)n_contacts;
  *me = (measure){.n_responses = n_responses, .n_contacts = n_contacts};
  me->response = workspace_array(w, (size_t)n_responses, sizeof *me->response);
  me->state = workspace_array(w, contacts, sizeof *me->state);
  me->seen = workspace_array(w, contacts, 1);
  me->slider = workspace_doubles(w, 2 * contacts);
  me->range = workspace_array(w, 2 * contacts, sizeof *me->range);
  double **const states[] = {&me->end, &me->end_rate, &me->inside};
  for (size_t i = 0; i < 3; ++i) *states[i] = workspace_doubles(w, n);
  me->circle = workspace_doubles(w, 2 * (size_t)TIMEINT_WAVE);
  if (w->failed) return HC_NO_MEMORY;
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    me->circle[2 * i] = cos(TWO_PI * i / TIMEINT_WAVE);
    me->circle[2 * i + 1] = sin(TWO_PI * i / TIMEINT_WAVE);
  }
  return HC_OK;
}

void measure_begin(measure *me, const scaled_model *m)
{
  me->m = m;
  me->periods = me->next = 0;
  me->no_integrals = false;
  memset(me->seen, 0, (size_t)me->n_contacts);
  for (int j = 0; j < me->n_contacts; ++j) me->slider[2 * j] = INFINITY, me->slider[2 * j + 1] = -INFINITY;
  for (int r = 0; r < 2 * me->n_contacts; ++r) me->range[r] = (contact_range){.min = INFINITY, .max = -INFINITY};
  for (int i = 0; i < me->n_responses; ++i) me->response[i] = (response_measure){.max = -INFINITY, .min = INFINITY};
}

static void extend(response_measure *r, double x)
{
  if (x > r->max) r->max = x;
  if (x < r->min) r->min = x;
}

/* The instants of the wave from me->next to theta1. */
static hc_status add_instants(measure *me, const integrator *in, double theta1)
{
  const double step = TWO_PI / TIMEINT_WAVE;
  int last = me->next;
  while (last < TIMEINT_WAVE && TWO_PI * last / TIMEINT_WAVE <= theta1) ++last;
  const int count = last - me->next;
  for (int i = 0; i < me->n_responses && count > 0; ++i) {
    response_measure *r = &me->response[i];
    hc_status st = integrate_samples(in, i, TWO_PI * me->next / TIMEINT_WAVE, step, count, r->wave + me->next);
    if (st != HC_OK) return st;
    /* Sums over the instants of a whole period. */
    if (last == TIMEINT_WAVE) {
      for (int k = 0; k < TIMEINT_WAVE; ++k) {
        const double x = r->wave[k];
        r->sum += x;
        r->sum_sq += x * x;
        r->sum_cos += x * me->circle[2 * k];
        r->sum_sin += x * me->circle[2 * k + 1];
      }
    }
  }
  me->next = last;
  return HC_OK;
}

/* Integral over h of a function with value, first and second derivative g[end][3] at its two ends, by the quintic
 * through them: error h^7/100800 times the sixth derivative. */
static double integral_of(double h, double g[2][3])
{
  return h / 2 * (g[0][0] + g[1][0]) + h * h / 10 * (g[0][1] - g[1][1]) + h * h * h / 120 * (g[0][2] + g[1][2]);
}

/* A response: r, r', r''. */
typedef struct jet {
  double x, p, a;
} jet;

static jet jet_of(const scaled_model *m, int i, const double *y, const double *rate)
{
  return (jet){scaled_response(m, i, y), scaled_response(m, i, y + m->n), scaled_response(m, i, rate + m->n)};
}

/* Stores the start of the next step. */
static void begin_step(response_measure *r, const jet *at)
{
  r->x = at->x;
  r->p = at->p;
  r->a = at->a;
  extend(r, r->x);
}

/* Extends the ranges of U and V of all contacts by the state y, h after the previous one; h = 0: start of a period. */
static void extend_ranges(measure *me, double h, const double *y)
{
  const modal_base *b = me->m->base;
  const size_t n = (size_t)me->m->n, contacts = (size_t)me->n_contacts;
  for (size_t j = 0; j < 2 * contacts; ++j) {
    const double *row = j < contacts ? b->tangent + j * n : b->normal + (j - contacts) * n;
    contact_range *r = &me->range[j];
    const double x = dot_product(me->m->n, row, y), p = dot_product(me->m->n, row, y + n);
    double peak = x;
    if (h > 0 && r->p * p < 0) { /* place where the rate, interpolated linearly, is 0 */
      const double t = r->p / (r->p - p), s = 1 - t;
      peak = s * s * ((1 + 2 * t) * r->x + t * h * r->p) + t * t * ((1 + 2 * s) * x - s * h * p);
    }
    r->min = fmin(r->min, fmin(x, peak));
    r->max = fmax(r->max, fmax(x, peak));
    r->x = x;
    r->p = p;
  }
}

void measure_period(measure *me, const double *y)
{
  ++me->periods;
  me->next = 1;
  extend_ranges(me, 0, y);
  scaled_rhs(me->m, 0, y, me->end_rate); /* not finite: then CVODE fails in its first step */
  for (int i = 0; i < me->n_responses; ++i) {
    const jet at = jet_of(me->m, i, y, me->end_rate);
    me->response[i].wave[0] = at.x;
    begin_step(&me->response[i], &at);
  }
}

/* The derivative of a response's rate, of the given order (0: the rate itself), by dense output. */
typedef struct dense_rate {
  const integrator *in;
  const scaled_model *m;
  int response, order;
  double *y;
} dense_rate;

static hc_status rate_at(void *self, double theta, double *rate)
{
  const dense_rate *d = self;
  hc_status st = integrate_dense(d->in, theta, d->order, d->y);
  *rate = scaled_response(d->m, d->response, d->y + d->m->n);
  return st;
}

/* A root of dense_rate between t0 and t1, where it has the values f0 and f1 of opposite sign. me->inside: the state
 * there. */
static hc_status find_root(measure *me, const integrator *in, int i, int order, double t0, double f0, double t1,
                           double f1, double *root)
{
  dense_rate d = {in, me->m, i, order, me->inside};
  root_point found;
  hc_status st = root_between(rate_at, &d, t0, f0, t1, f1, 4 * DBL_EPSILON * t1, &found);
  *root = found.x;
  return st == HC_OK ? integrate_dense(in, found.x, 0, me->inside) : st;
}

/* The peak of response i between t0, where its rate is p0, and t1, where it is p1, if the rate changes sign. */
static hc_status add_peak(measure *me, const integrator *in, int i, double t0, double p0, double t1, double p1)
{
  double t;
  if ((p0 > 0) == (p1 > 0)) return HC_OK; /* a rate of 0 at an end of the step: begin_step has x there */
  hc_status st = find_root(me, in, i, 0, t0, p0, t1, p1, &t);
  if (st == HC_OK) extend(&me->response[i], scaled_response(me->m, i, me->inside));
  return st;
}

/* The peaks in the step from t0 to t1: the integrator's extremes, else roots of the rate, which changes sign at most
 * twice. */
static hc_status add_peaks(measure *me, const integrator *in, int i, double t0, double t1, const jet *end)
{
  const double p0 = me->response[i].p, a0 = me->response[i].a, p1 = end->p, a1 = end->a;
  double t, max, min;
  if (integrate_extremes(in, i, &max, &min)) {
    extend(&me->response[i], max);
    extend(&me->response[i], min);
    return HC_OK;
  }
  bool turns = (p0 > 0) == (p1 > 0) && (a0 > 0) != (a1 > 0) && (a0 > 0) != (p0 > 0);
  if (!turns) return add_peak(me, in, i, t0, p0, t1, p1);
  hc_status st = find_root(me, in, i, 1, t0, a0, t1, a1, &t); /* the rate comes nearest to 0 here */
  const double p = scaled_response(me->m, i, me->inside + me->m->n);
  if (st == HC_OK) st = add_peak(me, in, i, t0, p0, t, p);
  return st == HC_OK ? add_peak(me, in, i, t, p, t1, p1) : st;
}

unsigned char measure_seen(contact_state state)
{
  if (state == CONTACT_SEPARATED) return SEEN_SEPARATED;
  return state == CONTACT_STICK ? SEEN_STUCK : SEEN_SLIPPING;
}

hc_status measure_step(void *self, const integrator *in, double theta0, double theta1)
{
  measure *me = self;
  double *y = me->end;
  hc_status st = add_instants(me, in, theta1);
  if (st != HC_OK) return st;
  st = integrate_dense(in, theta1, 0, y);
  if (st != HC_OK) return st;
  integrate_at_end(in, me->m, theta1, y, me->end_rate, me->state);
  for (int i = 0; i < me->n_responses; ++i) {
    const jet end = jet_of(me->m, i, y, me->end_rate);
    /* Integrals of response i, times 1, cos, sin, over the step from theta0 to theta1: the integrator's, or from both
     * ends. After a step too long for that the sums over the instants are used instead. */
    response_measure *r = &me->response[i];
    double step[3] = {0};
    const double h = theta1 - theta0, ends[2][3] = {{r->x, r->p, r->a}, {end.x, end.p, end.a}};
    if (!integrate_fourier(in, i, step)) {
      double plain[2][3], by_cos[2][3], by_sin[2][3];
      me->no_integrals = me->no_integrals || h > INTEGRATE_LONGEST_STEP;
      for (int e = 0; e < 2; ++e) {
        const double co = cos(e ? theta1 : theta0), si = sin(e ? theta1 : theta0);
        const double x = ends[e][0], p = ends[e][1], bend = ends[e][2] - x;
        for (int k = 0; k < 3; ++k) plain[e][k] = ends[e][k];
        by_cos[e][0] = x * co, by_cos[e][1] = p * co - x * si, by_cos[e][2] = bend * co - 2 * p * si;
        by_sin[e][0] = x * si, by_sin[e][1] = p * si + x * co, by_sin[e][2] = bend * si + 2 * p * co;
      }
      step[0] = integral_of(h, plain);
      step[1] = integral_of(h, by_cos);
      step[2] = integral_of(h, by_sin);
    }
    for (int k = 0; k < 3; ++k) r->integral[k] += step[k];
    if ((st = add_peaks(me, in, i, theta0, theta1, &end)) != HC_OK) return st;
    begin_step(&me->response[i], &end);
  }
  for (int j = 0; j < me->m->n_contacts; ++j) {
    const double w = y[2 * me->m->n + j];
    me->seen[j] |= measure_seen(me->state[j]);
    me->slider[2 * j] = fmin(me->slider[2 * j], w);
    me->slider[2 * j + 1] = fmax(me->slider[2 * j + 1], w);
  }
  const int looks = 1 + (int)((theta1 - theta0) / INTEGRATE_LONGEST_STEP);
  const double look = (theta1 - theta0) / looks;
  for (int i = 1; i < looks && st == HC_OK; ++i) {
    st = integrate_dense(in, theta0 + i * look, 0, me->inside);
    extend_ranges(me, look, me->inside);
  }
  extend_ranges(me, look, y);
  return st;
}

void measure_vibration(const measure *me, double length, double *vibration)
{
  const int rows = 2 * me->n_contacts;
  for (int r = 0; r < rows; ++r) vibration[r] = motion_amplitude(me->range[r].max, me->range[r].min) * length;
  for (int i = 0; i < me->n_responses; ++i)
    vibration[rows + i] = motion_amplitude(me->response[i].max, me->response[i].min) * length;
}

int measure_resting_sliders(const measure *me)
{
  double range = 0;
  int resting = 0;
  for (int i = 0; i < me->n_responses; ++i) range = fmax(range, me->response[i].max - me->response[i].min);
  for (int j = 0; j < me->m->n_contacts; j += scaled_directions(me->m, j)) {
    const bool leaves = !me->m->contact[j].law.has_friction || me->seen[j] & SEEN_SEPARATED;
    double path = 0;
    for (int a = j; a < j + scaled_directions(me->m, j); ++a) {
      const double own = me->m->size ? me->m->size[2 * me->m->n + a] : 1;
      path = fmax(path, (me->slider[2 * a + 1] - me->slider[2 * a]) / own);
    }
    resting += !leaves && path <= MEASURE_RESTS * range;
  }
  return resting;
}

contact_regime measure_seen_regime(unsigned char seen, const contact *law)
{
  if (contact_never_opens(law) || (law->smooth != CONTACT_KINKED && seen == SEEN_STUCK)) return CONTACT_BENDS;
  if (!(seen & (SEEN_STUCK | SEEN_SLIPPING))) return CONTACT_LINEAR;
  if (seen & SEEN_SEPARATED) return CONTACT_SEPARATES;
  return seen & SEEN_SLIPPING ? CONTACT_SLIPS : CONTACT_STUCK;
}

void measure_report(const measure *me, const model *from, int i, double length, timeint_result *r)
{
  const response_measure *of = &me->response[i];
  const double n = (double)TIMEINT_WAVE * me->periods;
  r->max = of->max * length;
  r->min = of->min * length;
  r->amplitude = motion_amplitude(of->max, of->min) * length;
  r->rms = sqrt(of->sum_sq / n) * length;
  const double span = TWO_PI * me->periods;
  r->mean = (me->no_integrals ? of->sum / n : of->integral[0] / span) * length;
  r->a1 = 2 * (me->no_integrals ? of->sum_cos / n : of->integral[1] / span) * length;
  r->b1 = 2 * (me->no_integrals ? of->sum_sin / n : of->integral[2] / span) * length;
  r->harmonic_1 = hypot(r->a1, r->b1);
  for (int k = 0; k < TIMEINT_WAVE; ++k) r->wave[k] = of->wave[k] * length;
  r->regime = CONTACT_LINEAR;
  for (int j = 0; j < from->n_contacts; ++j) {
    r->regime = contact_regime_larger(r->regime, measure_seen_regime(me->seen[j], &from->contacts[j].law));
  }
}
