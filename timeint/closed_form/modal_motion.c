/* modal_motion.c - see modal_motion.h. Proof: tests/timeint/test_modal_motion.c. */
#include "timeint/closed_form/modal_motion.h"

#include <math.h>

#include "model/linear.h"
#include "numerics/exponentials.h"
#include "numerics/roots.h"

static const double near_resonance = 0.25;  /* |k - 1 + i c| below which r is computed as a divided difference */
static const double resonant_digits = 1e-3; /* |k - 1 + i c| below which an integral, divided by it, loses three
                                               digits */
static const double longest_step = 1.5;     /* [rad] longest step with one bound of g'' */
enum { RESTART = 32 };

mode mode_make(double c, double k)
{
  const double complex by = k - 1 + I * c;
  const bool resonant = cabs(by) < near_resonance;
  return (mode){.c = c,
                .k = k,
                .response = resonant ? 0 : 1 / by,
                .resonant = resonant,
                .soft = fabs(k) < MODE_SOFT,
                .grows = k < 0 ? sqrt(-k) : 0};
}

/* (e^{i tau} - e^{root tau})/(i - root), whose limit where root = i is tau e^{i tau}. */
static double complex divided_difference(double complex root, double tau)
{
  return cexp(root * tau) * tau * exponential_quotient((I - root) * tau);
}

static void advance(const mode *m, double tau, mode_flow *out)
{
  linear_free_motion(1, m->c, m->k, tau, out->e);
  out->s = m->soft ? linear_step_response(m->c, m->k, tau) : (1 - out->e[0][0]) / m->k;
  if (m->resonant) {
    /* Near resonance c^2/4 < k: the roots are -c/2 +- i w, w near 1. */
    const double w = sqrt(m->k - 0.25 * m->c * m->c);
    const double complex one = -0.5 * m->c + I * w, two = conj(one);
    const double complex first = divided_difference(one, tau), second = divided_difference(two, tau);
    out->r = (first - second) / (one - two);
    out->dr = (one * first - two * second) / (one - two);
    return;
  }
  const double co = cos(tau), si = sin(tau);
  out->r = (co - out->e[0][0] + I * (si - out->e[0][1])) * m->response;
  out->dr = (-si - out->e[1][0] + I * (co - out->e[1][1])) * m->response;
}

/* (*q, *p) of a mode under d + Re(f e^{i tau}), after the time of the flow. */
static void move(const mode_flow *flow, double d, double complex f, double *q, double *p)
{
  const double x = *q, v = *p;
  *q = flow->e[0][0] * x + flow->e[0][1] * v + d * flow->s + creal(f * flow->r);
  *p = flow->e[1][0] * x + flow->e[1][1] * v + d * flow->e[0][1] + creal(f * flow->dr);
}

static double complex on_circle(double theta) { return cos(theta) + I * sin(theta); }

modal_point modal_at(const modal_motion *m, double tau)
{
  const double complex turn = on_circle(m->theta), force = m->f * on_circle(m->theta + tau);
  modal_point at = {.tau = tau, .q = m->q, .p = m->p};
  mode_flow flow;
  advance(&m->mode, tau, &flow);
  move(&flow, m->d, m->f * turn, &at.q, &at.p);
  at.a = m->d + creal(force) - m->mode.c * at.p - m->mode.k * at.q;
  at.j = -cimag(force) - m->mode.c * at.a - m->mode.k * at.p;
  return at;
}

static double guard_value(const modal_guard *g, const modal_point *at)
{
  return g->constant + g->by_q * at->q + g->by_p * at->p;
}

static double guard_slope(const modal_guard *g, const modal_point *at) { return g->by_q * at->p + g->by_p * at->a; }

/* Bound of |g''| from the point on, over h. */
static double guard_bound(const modal_motion *m, const modal_guard *g, const modal_point *at, double h)
{
  const double k = fabs(m->mode.k), more = cabs(m->f) * h, grow = m->mode.grows > 0 ? exp(m->mode.grows * h) : 1;
  return fabs(g->by_q) * (sqrt(at->a * at->a + k * at->p * at->p) + more) * grow +
         fabs(g->by_p) * (sqrt(at->j * at->j + k * at->a * at->a) + more) * grow;
}

typedef struct searched_guard {
  const modal_motion *m;
  const modal_guard *g;
  long *evaluations;
} searched_guard;

static double guard_at(const void *self, double tau, double *slope)
{
  const searched_guard *in = self;
  const modal_point at = modal_at(in->m, tau);
  ++*in->evaluations;
  *slope = guard_slope(in->g, &at);
  return guard_value(in->g, &at);
}

/* A step from *now, at most h, over which the guard stays positive, or falls through 0 once, at *root (else
 * INFINITY). */
static double clear_step(const modal_motion *m, const modal_guard *g, const modal_point *now, double h, double *root,
                         long *evaluations)
{
  const double f = guard_value(g, now), slope = guard_slope(g, now), bound = guard_bound(m, g, now, h);
  const double safe = safe_step(fmax(f, 0) + g->noise, slope, bound);
  *root = INFINITY;
  if (f < -g->noise) return *root = now->tau, 0;
  if (safe >= h) return h;
  const double one_way = slope < 0 ? fmin(h, -slope / bound) : 0; /* it falls at least that far */
  if (!(one_way > safe)) return safe;
  const modal_point at = modal_at(m, now->tau + one_way);
  const double end = guard_value(g, &at);
  ++*evaluations;
  if (end >= 0) return one_way;
  const searched_guard self = {m, g, evaluations};
  *root = root_falling(guard_at, &self, now->tau, f, now->tau + one_way, now->tau + one_way * f / (f - end), m->theta);
  return one_way;
}

int modal_first_crossing(const modal_motion *m, double span, int n_guards, const modal_guard *guards, modal_point *at,
                         long *evaluations)
{
  const double longest = m->mode.grows * longest_step > 1 ? 1 / m->mode.grows : longest_step;
  double limit = span;
  int first = -1;
  ++*evaluations;
  for (*at = modal_at(m, 0); at->tau < limit;) {
    const double tau = at->tau;
    double h = fmin(limit - tau, longest);
    for (int i = 0; i < n_guards; ++i) {
      double root, clear = clear_step(m, &guards[i], at, h, &root, evaluations);
      if (root < limit || (root == limit && first < 0)) {
        limit = root;
        first = i;
        clear = root - tau;
      }
      h = fmin(h, clear);
    }
    const double next = tau + h < limit ? tau + h : limit;
    *at = modal_at(m, next);
    ++*evaluations;
    if (!(next > tau)) break; /* NaN, or a root here */
  }
  return first;
}

void modal_samples(const modal_motion *m, double from, double step, int count, double *samples)
{
  mode_flow one, start;
  const double complex turn = on_circle(step);
  advance(&m->mode, step, &one);
  for (int k = 0; k < count; k += RESTART) { /* rounding adds up over 32 samples only */
    const double theta = from + k * step;
    double q = m->q, p = m->p;
    advance(&m->mode, theta - m->theta, &start);
    move(&start, m->d, m->f * on_circle(m->theta), &q, &p);
    double complex f = m->f * on_circle(theta);
    for (int j = k; j < count && j < k + RESTART; ++j) {
      samples[j] = q;
      move(&one, m->d, f, &q, &p);
      f *= turn;
    }
  }
}

/* The equation of the mode times e^{-i theta} (or 1), integrated by parts: the integrals of q follow from values at the
 * ends, with J of the force:  (k - 1 + i c) int q e^{-i theta} = J - [p e^{-i theta}] - (i + c) [q e^{-i theta}]. */
bool modal_fourier(const modal_motion *m, const modal_point *from, const modal_point *to, double out[3])
{
  const double c = m->mode.c, k = m->mode.k, d = m->d;
  const double complex by = k - 1 + I * c, f = m->f;
  if (m->mode.soft || cabs(by) < resonant_digits) return false;
  const double start = m->theta + from->tau, end = m->theta + to->tau;
  const double complex u0 = conj(on_circle(start)), u1 = conj(on_circle(end)); /* e^{-i theta} */
  const double complex q = to->q * u1 - from->q * u0, p = to->p * u1 - from->p * u0;
  const double complex force = I * d * (u1 - u0) + 0.5 * f * (end - start) + 0.25 * I * conj(f) * (u1 * u1 - u0 * u0);
  const double complex first = (force - p - (I + c) * q) / by;
  const double load = d * (end - start) + cimag(f * conj(u1 - u0));
  out[0] = (load - (to->p - from->p) - c * (to->q - from->q)) / k;
  out[1] = creal(first);
  out[2] = -cimag(first);
  return true;
}
