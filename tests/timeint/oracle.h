/* oracle.h - the exact law's motion in closed form, a period at a time, with a law of its own: states by name,
 * guards looked at 4000 times a period, then bisected. What lasts less than 2 pi/4000 it may miss. */
#pragma once

#include "model/linear.h"
#include "tests/check.h"
#include "timeint/law/scaled.h"

enum { SCAN = 4000 };
typedef enum { APART, STUCK, PLUS, MINUS } how;
typedef struct oracle {
  const scaled_model *m;
  how state[SCENE_MAX_CONTACTS];
  double held[SCENE_MAX_CONTACTS];
  double theta, x, p;
  int events;
} oracle;

static inline double slip_of(how s) { return s == PLUS ? 1 : s == MINUS ? -1 : 0; }

/* X, P at theta of the linear equation of the states as they are. */
static inline void oracle_move(const oracle *o, double theta, double *x, double *p)
{
  double k = scene_k(o->m), d = 0, e[2][2];
  for (int j = 0; j < o->m->n_contacts; ++j) {
    const scaled_contact *c = &o->m->contact[j];
    d -= c->preload * scene_sine(o->m, c);
    if (o->state[j] == APART) continue;
    double normal = scene_sine(o->m, c) + slip_of(o->state[j]) * c->law.mu * scene_cosine(o->m, c);
    k += normal * c->law.kn * scene_sine(o->m, c);
    d += normal * c->law.kn * c->law.gap;
    if (o->state[j] != STUCK || !c->law.has_friction) continue;
    k += c->law.kt * scene_cosine(o->m, c) * scene_cosine(o->m, c);
    d -= c->law.kt * scene_cosine(o->m, c) * o->held[j];
  }
  double complex X = linear_response(1, scene_c(o->m), k, scene_f(o->m), 1), now = X * cexp(I * o->theta),
                 then = X * cexp(I * theta);
  double x0 = o->x - creal(now) + d / k, p0 = o->p - creal(I * now);
  linear_free_motion(1, scene_c(o->m), k, theta - o->theta, e);
  *x = e[0][0] * x0 + e[0][1] * p0 + creal(then) - d / k;
  *p = e[1][0] * x0 + e[1][1] * p0 + creal(I * then);
}

/* The state contact j should be in after x, p: its own while no guard is below 0. */
static inline how oracle_next(const oracle *o, int j, double x, double p)
{
  const scaled_contact *c = &o->m->contact[j];
  const double u = scene_cosine(o->m, c) * x, g = scene_sine(o->m, c) * x + c->law.gap,
               limit = c->law.mu * c->law.kn * g;
  if (!(c->law.kn > 0)) return APART;
  if (o->state[j] == APART) {
    if (!(g > 0)) return APART;
    return c->law.has_friction && c->law.kt * scene_cosine(o->m, c) > c->law.mu * c->law.kn * scene_sine(o->m, c)
               ? PLUS
               : STUCK;
  }
  if (g < 0) return APART;
  if (!c->law.has_friction) return STUCK;
  double s = slip_of(o->state[j]), t = c->law.kt * (u - o->held[j]),
         rate = (s * c->law.kt * scene_cosine(o->m, c) - c->law.mu * c->law.kn * scene_sine(o->m, c)) * p;
  if (s != 0) return rate < 0 ? STUCK : o->state[j];
  const double slack = 1e-13 * c->law.kt; /* on the limit since it stuck, or T and N vanishing together */
  return t > limit + slack ? PLUS : t < -limit - slack ? MINUS : STUCK;
}

static inline bool oracle_changes(const oracle *o, double x, double p)
{
  bool any = false;
  for (int j = 0; j < o->m->n_contacts; ++j) any = any || oracle_next(o, j, x, p) != o->state[j];
  return any;
}

static inline void oracle_switch(oracle *o)
{
  for (int j = 0; j < o->m->n_contacts; ++j) {
    const scaled_contact *c = &o->m->contact[j];
    how next = oracle_next(o, j, o->x, o->p), was = o->state[j];
    if (next == STUCK && was == APART) o->held[j] = scene_cosine(o->m, c) * -c->law.gap / scene_sine(o->m, c);
    if (next == STUCK && slip_of(was) != 0)
      o->held[j] = scene_cosine(o->m, c) * o->x -
                   slip_of(was) * c->law.mu * c->law.kn * (scene_sine(o->m, c) * o->x + c->law.gap) / c->law.kt;
    o->events += next != was;
    o->state[j] = next;
  }
}

static inline void oracle_period(oracle *o)
{
  o->theta = 0;
  for (int i = 1; i <= SCAN;) {
    double to = 2 * PI * i / SCAN, x, p;
    oracle_move(o, to, &x, &p);
    if (!oracle_changes(o, x, p)) {
      o->theta = to, o->x = x, o->p = p, ++i; /* small steps: nothing accumulates but rounding */
      continue;
    }
    double low = o->theta, high = to;
    for (int b = 0; b < 60; ++b) {
      double mid = 0.5 * (low + high);
      oracle_move(o, mid, &x, &p);
      if (oracle_changes(o, x, p)) high = mid;
      else low = mid;
    }
    oracle_move(o, high, &x, &p);
    o->theta = high, o->x = x, o->p = p;
    oracle_switch(o);
  }
}

static inline double oracle_slider(const oracle *o, int j)
{
  const scaled_contact *c = &o->m->contact[j];
  if (o->state[j] == APART || !c->law.has_friction) return scene_cosine(o->m, c) * o->x;
  if (o->state[j] == STUCK) return o->held[j];
  return scene_cosine(o->m, c) * o->x -
         slip_of(o->state[j]) * c->law.mu * c->law.kn * (scene_sine(o->m, c) * o->x + c->law.gap) / c->law.kt;
}
