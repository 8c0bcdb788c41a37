/* full_equations.h - the equations of motion of a structure, nothing condensed, at a harmonic-balance solution: what
 * is left of them in each harmonic. Contact forces by marching the law along the motion and integrating by Gauss and
 * Legendre's rule between its changes: motions are Taylor polynomials x(t0 + s) = sum_k x[k] s^k, k = 0..TAYLOR, over
 * a short step, and the first change on a step is bisected. Written from the law as model/contact_law.h states it;
 * nothing of hbm/ or of the law's own functions is used. */
#pragma once

#include "model/model.h"
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

enum { FULL_MAX_DOFS = 16, FULL_MAX_LENGTH = 64, FULL_NODES = 12, FULL_STEPS = 64 /* a period at least */ };

typedef struct full_motion {
  const model *m;
  int n_harm;
  double omega;
  double x[FULL_MAX_DOFS][FULL_MAX_LENGTH]; /* series of every DOF */
} full_motion;

/* Nodes and weights on [0, 1]: Newton on the Legendre polynomial. */
static inline void gauss_legendre(double *node, double *weight)
{
  for (int i = 0; i < FULL_NODES; ++i) {
    double z = cos(0.5 * TWO_PI * (i + 0.75) / (FULL_NODES + 0.5)), slope = 1;
    for (int it = 0; it < 50; ++it) {
      double p = 1, before = 0;
      for (int k = 1; k <= FULL_NODES; ++k) {
        const double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = FULL_NODES * (z * p - before) / (z * z - 1);
      z -= p / slope;
    }
    node[i] = 0.5 * (1 + z);
    weight[i] = 1 / ((1 - z * z) * slope * slope);
  }
}

static inline void along_direction(int n, const double *direction, double (*x)[TAYLOR + 1], double *u)
{
  memset(u, 0, (TAYLOR + 1) * sizeof *u);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k <= TAYLOR; ++k) u[k] += direction[i] * x[i][k];
}

/* u and v of contact j next to t. */
static inline void full_contact_motion(const full_motion *f, int j, double t, double *u, double *v)
{
  double x[FULL_MAX_DOFS][TAYLOR + 1];
  for (int i = 0; i < f->m->n; ++i) taylor_of_series(f->n_harm, f->x[i], f->omega, t, x[i]);
  along_direction(f->m->n, f->m->contacts[j].tangent, x, u);
  along_direction(f->m->n, f->m->contacts[j].normal, x, v);
}

/* The integrals of the force over [t, t + s], times omega/pi, added to T and N [2H+1] (the mean's: twice it). */
static inline void add_integrals(const full_motion *f, const marched *c, const double *u, const double *v, double t,
                                 double s, double *T, double *N)
{
  double node[FULL_NODES], weight[FULL_NODES], traction[TAYLOR + 1], change[TAYLOR + 1];
  gauss_legendre(node, weight);
  for (int k = 0; k <= TAYLOR; ++k) marched_force(c, k, u[k], v[k], &change[k], &traction[k]);
  for (int q = 0; q < FULL_NODES; ++q) {
    const double at = s * node[q], part = weight[q] * s * 2 * f->omega / TWO_PI;
    const double of_T = part * taylor_at(traction, at), of_N = part * taylor_at(change, at);
    T[0] += of_T, N[0] += of_N;
    for (int h = 1; h <= f->n_harm; ++h) {
      const double cosine = cos(h * f->omega * (t + at)), sine = sin(h * f->omega * (t + at));
      T[2 * h - 1] += of_T * cosine, N[2 * h - 1] += of_N * cosine;
      T[2 * h] += of_T * sine, N[2 * h] += of_N * sine;
    }
  }
}

/* Contact j from w = 0 at t = 0 through three periods; T and N [2H+1] of the last one. *c is its state at
 * the end, and of the last period how often that changed and how long it was not stuck. */
static inline void march_contact(const full_motion *f, int j, marched *c, double *T, double *N)
{
  const double period = TWO_PI / f->omega;
  const int steps = FULL_STEPS + 8 * f->n_harm;
  double u[TAYLOR + 1], v[TAYLOR + 1];
  memset(T, 0, FULL_MAX_LENGTH * sizeof *T);
  memset(N, 0, FULL_MAX_LENGTH * sizeof *N);
  *c = (marched){.law = f->m->contacts[j].law};
  full_contact_motion(f, j, 0, u, v);
  marched_begin(c, u, v, 0);
  for (int k = 0; k < 3 * steps; ++k) {
    if (k % steps == 0) c->changes = 0, c->loose = 0;
    double t = period * (k % steps) / steps;
    const double end = period * (k % steps + 1) / steps;
    while (t < end) {
      int which;
      full_contact_motion(f, j, t, u, v);
      const double s = marched_first_change(c, u, v, end - t, &which);
      if (k >= 2 * steps) add_integrals(f, c, u, v, t, s, T, N);
      c->changed = false;
      if (c->state != STUCK) c->loose += s;
      if (which >= 0) marched_change(c, u, v, s, which), ++c->changes;
      t = which >= 0 ? t + s : end;
      assert_true(c->changes < 10 * steps);
    }
  }
  T[0] /= 2, N[0] /= 2;
}

/* What the equations of x leave in any harmonic of any DOF, relative to the largest force that they are made of. */
static inline double full_residual(const full_motion *f)
{
  const model *m = f->m;
  static double left[FULL_MAX_DOFS][FULL_MAX_LENGTH];
  double T[FULL_MAX_LENGTH], N[FULL_MAX_LENGTH], scale = 0, worst = 0;
  memset(left, 0, sizeof left);
  for (int i = 0; i < m->n; ++i)
    for (int k = 0; k < m->n; ++k) {
      const double M = m->mass[k * m->n + i], C = m->damping[k * m->n + i], K = m->stiffness[k * m->n + i];
      const double *x = f->x[k];
      left[i][0] += K * x[0];
      scale = fmax(scale, fabs(K * x[0]));
      for (int h = 1; h <= f->n_harm; ++h) {
        const double w = h * f->omega, a = x[2 * h - 1], b = x[2 * h];
        left[i][2 * h - 1] += (K - w * w * M) * a + w * C * b;
        left[i][2 * h] += (K - w * w * M) * b - w * C * a;
        scale = fmax(scale, (fabs(K) + w * w * fabs(M) + w * fabs(C)) * (fabs(a) + fabs(b)));
      }
    }
  for (int j = 0; j < m->n_contacts; ++j) {
    marched c;
    march_contact(f, j, &c, T, N);
    for (int i = 0; i < m->n; ++i)
      for (int k = 0; k <= 2 * f->n_harm; ++k) {
        const double force = m->contacts[j].tangent[i] * T[k] + m->contacts[j].normal[i] * N[k];
        left[i][k] += force;
        scale = fmax(scale, fabs(force));
      }
  }
  for (int l = 0; l < m->n_loads; ++l)
    for (int i = 0; i < m->n; ++i) {
      const int h = m->loads[l].harmonic;
      left[i][h ? 2 * h - 1 : 0] -= m->loads[l].cosine[i];
      if (h) left[i][2 * h] -= m->loads[l].sine[i];
      scale = fmax(scale, fabs(m->loads[l].cosine[i]));
    }
  for (int i = 0; i < m->n; ++i) worst = larger(worst, norm_max(2 * f->n_harm + 1, left[i]));
  return worst / scale;
}
