/* marched_law.h - the contact law by marching, for tests that must not use the evaluators they test: motions are Taylor
 * polynomials over a short step, the state of each contact is followed, and the first change on a step is bisected.
 * Written from the law as model/contact_law.h states it; nothing of hbm/ or of the law's own functions is used.
 *
 *     x(t0 + s) = sum_k x[k] s^k,  k = 0..TAYLOR */
#pragma once

#include "model/contact_law.h"
#include "tests/check.h"

/* With steps of |lambda| s <= 1.5 the first term left out is 1.5^21/21! = 1e-16 of the sum. */
enum { TAYLOR = 20 };

static inline double taylor_at(const double *x, double s)
{
  double sum = x[TAYLOR];
  for (int k = TAYLOR - 1; k >= 0; --k) sum = sum * s + x[k];
  return sum;
}

static inline double taylor_slope(const double *x, double s)
{
  double sum = TAYLOR * x[TAYLOR];
  for (int k = TAYLOR - 1; k >= 1; --k) sum = sum * s + k * x[k];
  return sum;
}

/* x[TAYLOR + 1] of the series X[2 n_harm + 1] at t: derivatives turn a_h - i b_h by i h omega. */
static inline void taylor_of_series(int n_harm, const double *X, double omega, double t, double *x)
{
  memset(x, 0, (TAYLOR + 1) * sizeof *x);
  x[0] = X[0];
  for (int h = 1; h <= n_harm; ++h) {
    const double a = X[2 * h - 1], b = X[2 * h], w = h * omega, c = cos(w * t), s = sin(w * t);
    double even = a * c + b * s, odd = -a * s + b * c; /* the derivatives over w^k, in turns */
    double factor = 1;
    for (int k = 0; k <= TAYLOR; ++k) {
      x[k] += factor * even;
      factor *= w / (k + 1);
      const double next = -even;
      even = odd;
      odd = next;
    }
  }
}

typedef enum marched_state { APART, STUCK, SLIDES_UP, SLIDES_DOWN } marched_state;

typedef struct marched {
  contact law;
  marched_state state;
  double w;     /* [length] while stuck */
  int changes;  /* of state, counted by who marches */
  double loose; /* [time] not stuck, of the last period, likewise */
  bool never;   /* never slips: its friction is thought larger */
  bool changed; /* just now: its guards begin at 0, give or take rounding */
} marched;

static inline bool marched_has_tangent(const contact *c)
{
  return c->kt > 0 && c->mu > 0 && (c->kn > 0 || c->load > 0);
}
static inline int marched_sign(marched_state st) { return (st == SLIDES_UP) - (st == SLIDES_DOWN); }

/* N - N0 and T of coefficient k, from those of u and v. */
static inline void marched_force(const marched *m, int k, double u, double v, double *change, double *T)
{
  const contact *c = &m->law;
  const double rest = c->gap > 0 ? c->kn * c->gap : 0;
  double N = m->state == APART ? 0 : c->kn * v;
  if (k == 0 && m->state != APART) N += c->kn * c->gap + c->load;
  *change = k == 0 ? N - rest - c->load : N;
  *T = 0;
  if (!marched_has_tangent(c)) return;
  if (m->state == STUCK) *T = c->kt * (u - (k == 0 ? m->w : 0));
  else *T = marched_sign(m->state) * c->mu * N;
}

/* What must stay positive in the state, g[i] as polynomials, at most 3; to[i]: the state after. */
static inline int marched_guards(const marched *m, const double *u, const double *v, double g[3][TAYLOR + 1],
                                 marched_state to[3])
{
  const contact *c = &m->law;
  int n = 0;
  if (m->state == APART) {
    for (int k = 0; k <= TAYLOR; ++k) g[0][k] = -v[k];
    g[0][0] -= c->gap;
    to[0] = STUCK; /* or sliding: marched_change decides */
    return 1;
  }
  if (c->kn > 0) {
    memcpy(g[n], v, sizeof g[n]);
    g[n][0] += c->gap;
    to[n++] = APART;
  }
  if (!marched_has_tangent(c) || m->never) return n;
  if (m->state == STUCK) {
    for (int s = 1; s >= -1; s -= 2) {
      for (int k = 0; k <= TAYLOR; ++k) g[n][k] = c->mu * c->kn * v[k] - s * c->kt * u[k];
      g[n][0] += c->mu * (c->kn * c->gap + c->load) + s * c->kt * m->w;
      to[n++] = s > 0 ? SLIDES_UP : SLIDES_DOWN;
    }
    return n;
  }
  const int s = marched_sign(m->state);
  memset(g[n], 0, sizeof g[n]);
  for (int k = 0; k < TAYLOR; ++k) g[n][k] = (k + 1) * (s * c->kt * u[k + 1] - c->mu * c->kn * v[k + 1]);
  to[n++] = STUCK;
  return n;
}

/* Where g is least on [low, high] if its slope changes sign there from - to +, else high. */
static inline double marched_least(const double *g, double low, double high)
{
  if (!(taylor_slope(g, low) < 0 && taylor_slope(g, high) > 0)) return high;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    if (taylor_slope(g, middle) < 0) low = middle;
    else high = middle;
  }
  return high;
}

/* The first s on (low, high] with g < 0, between the ends only where it may dip there; bisected to rounding; NAN
 * where there is none. */
static inline double marched_falls(const double *g, bool dips, double low, double high)
{
  if (dips && taylor_at(g, high) >= 0) high = marched_least(g, low, high); /* a dip between the ends */
  if (taylor_at(g, high) >= 0) return NAN;
  for (int k = 0; k < 80; ++k) {
    const double middle = 0.5 * (low + high);
    if (taylor_at(g, middle) >= 0) low = middle;
    else high = middle;
  }
  return high;
}

/* The first s in (0, h] where a guard has fallen below 0; h if there is none (*which = -1). A step is looked at in
 * eight parts, and at the least value on each. */
static inline double marched_first_change(const marched *m, const double *u, const double *v, double h, int *which)
{
  enum { PARTS = 8 };
  double g[3][TAYLOR + 1], first = h;
  marched_state to[3];
  const int n = marched_guards(m, u, v, g, to);
  *which = -1;
  for (int i = 0; i < n; ++i)
    for (int p = 0; p < PARTS && h * p / PARTS < first; ++p) {
      const double at = marched_falls(g[i], p > 0 || !m->changed, h * p / PARTS, h * (p + 1) / PARTS);
      if (isnan(at)) continue;
      if (*which < 0 || at < first) first = at, *which = i;
      break;
    }
  return first;
}

/* The change number `which` of marched_first_change, at s. */
static inline void marched_change(marched *m, const double *u, const double *v, double s, int which)
{
  const contact *c = &m->law;
  double g[3][TAYLOR + 1];
  marched_state to[3];
  marched_guards(m, u, v, g, to);
  const double at_u = taylor_at(u, s), at_v = taylor_at(v, s);
  const double N = c->kn * (at_v + c->gap) + c->load;
  m->changed = true;
  if (m->state == APART) {
    const double pull = c->kt * taylor_slope(u, s), limit = c->mu * c->kn * taylor_slope(v, s);
    m->w = at_u;
    m->state = !marched_has_tangent(c) || fabs(pull) <= limit ? STUCK : pull > 0 ? SLIDES_UP : SLIDES_DOWN;
    return;
  }
  if (to[which] == STUCK) m->w = at_u - marched_sign(m->state) * c->mu * N / c->kt;
  m->state = to[which];
}

/* The state at the motion's start from a slider at w: put into the cone at once. */
static inline void marched_begin(marched *m, const double *u, const double *v, double w)
{
  const contact *c = &m->law;
  const double N = c->kn * (v[0] + c->gap) + c->load, limit = c->mu * N;
  m->w = w;
  m->state = STUCK;
  m->changed = true;
  if (c->kn > 0 && !(v[0] + c->gap > 0)) {
    m->state = APART;
    return;
  }
  if (!marched_has_tangent(c)) return;
  for (int s = 1; s >= -1; s -= 2)
    if (s * c->kt * (u[0] - w) >= limit) {
      m->w = u[0] - s * limit / c->kt;
      if (s * c->kt * u[1] - c->mu * c->kn * v[1] > 0) m->state = s > 0 ? SLIDES_UP : SLIDES_DOWN;
    }
}

/* Where the slider is. */
static inline double marched_slider(const marched *m, double u, double v)
{
  const contact *c = &m->law;
  if (m->state == STUCK) return m->w;
  if (m->state == APART || c->kt == 0) return u;
  return u - marched_sign(m->state) * c->mu * (c->kn * (v + c->gap) + c->load) / c->kt;
}
