/* planar_series.c - see planar_series.h. Proof: tests/timeint/test_circle.c. */
#include "timeint/closed_form/planar_series.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* sum of a_i b_{k-i}, i = from .. to. */
static double product(const double *a, const double *b, int k, int from, int to)
{
  double sum = 0;
  for (int i = from; i <= to; ++i) sum += a[i] * b[k - i];
  return sum;
}

void planar_series_begin(planar_series *s, const contact_track t[2], const double *u1, const double *u2,
                         const double *v)
{
  s->fresh = t->fresh;
  s->u[0] = u1;
  s->u[1] = u2;
  s->v = v;
  s->e[0][0] = t[0].along;
  s->e[1][0] = t[1].along;
}

/* (U'.e_perp)_k, with e up to `known`. */
static double across(const planar_series *s, int k, int known)
{
  return product(s->e[0], s->rate[1], k, 0, known) - product(s->e[1], s->rate[0], k, 0, known);
}

/* Coefficient k of e from q up to k - 1, which is q_{k-1} = turn where that is not known yet. */
static void expand_direction(planar_series *s, int k)
{
  s->e[0][k] = -product(s->turn, s->e[1], k - 1, 0, k - 1) / k;
  s->e[1][k] = product(s->turn, s->e[0], k - 1, 0, k - 1) / k;
}

/* q_{k-1} and e_k. */
static void turn(planar_series *s, double kt, int k)
{
  const double *limit = s->limit;
  if (!s->fresh) {
    s->turn[k - 1] = (kt * across(s, k - 1, k - 1) - product(limit, s->turn, k - 1, 1, k - 1)) / limit[0];
    expand_direction(s, k);
    return;
  }
  const double size = s->rate[0][0] * s->e[0][0] + s->rate[1][0] * s->e[1][0];
  s->turn[k - 1] = 0;
  expand_direction(s, k);
  const double rest = kt * across(s, k, k) - product(limit, s->turn, k, 2, k);
  s->turn[k - 1] = rest / (limit[1] + kt * size / k);
  expand_direction(s, k);
}

void planar_series_next(planar_series *s, const scaled_contact *c, int k, double pull[2])
{
  const law_regularised *law = &c->law;
  const double friction = law->mu * law->kn;
  s->limit[k] = friction * s->v[k];
  if (k == 0) s->limit[0] = s->fresh ? 0 : friction * (s->v[0] + law->gap) + law->mu * law->load;
  for (int a = 0; a < 2; ++a) s->rate[a][k] = k + 1 < TRACK_TERMS ? (k + 1) * s->u[a][k + 1] : 0;
  if (k > 0 && s->fresh && k + 1 == TRACK_TERMS) s->e[0][k] = s->e[1][k] = s->turn[k - 1] = 0;
  else if (k > 0) turn(s, law->kt, k);
  for (int a = 0; a < 2; ++a) pull[a] = product(s->limit, s->e[a], k, 0, k);
}

double planar_series_reach(const planar_series *s)
{
  double tau = INFINITY;
  for (int k = TRACK_ORDER - 2; k < TRACK_ORDER; ++k) {
    const double term = hypot(s->e[0][k], s->e[1][k]);
    if (isnan(term)) return 0;
    if (term > 0) tau = fmin(tau, pow(0.25 * DBL_EPSILON / term, 1.0 / k));
  }
  return tau;
}

void planar_series_direction(const planar_series *s, double tau, double e[2])
{
  for (int a = 0; a < 2; ++a) {
    e[a] = 0;
    for (int k = TRACK_TERMS; k-- > 0;) e[a] = e[a] * tau + s->e[a][k];
  }
  const double size = hypot(e[0], e[1]);
  e[0] /= size, e[1] /= size;
}

void planar_series_guard(const planar_series *s, const scaled_contact *c, double *g)
{
  for (int k = 0; k < TRACK_ORDER; ++k) {
    const double slide = product(s->e[0], s->rate[0], k, 0, k) + product(s->e[1], s->rate[1], k, 0, k);
    g[k] = c->law.kt * slide - (k + 1) * s->limit[k + 1];
  }
  g[TRACK_ORDER] = 0;
}
