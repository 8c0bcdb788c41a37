/* motion_series.c - see motion_series.h. Proof: tests/timeint/test_structure.c. */
#include "timeint/closed_form/motion_series.h"

#include <float.h>
#include <string.h>

#include "numerics/exponentials.h"
#include "numerics/norm.h"
#include "numerics/roots.h"
#include "numerics/wide_vectors.h"

enum { TERMS = TRACK_TERMS };

hc_status motion_series_make(motion_series *s, const modal_base *base, workspace *w)
{
  const size_t n = (size_t)base->n, contacts = (size_t)base->n_contacts, loads = (size_t)base->n_loads;
  *s = (motion_series){.n = base->n, .n_contacts = base->n_contacts};
  s->x = workspace_doubles(w, TERMS * n);
  s->force = workspace_doubles(w, n);
  s->u = workspace_doubles(w, TERMS * contacts);
  s->v = workspace_doubles(w, TERMS * contacts);
  s->q = workspace_doubles(w, 2 * contacts);
  s->pull = workspace_doubles(w, 2 * contacts);
  s->load = workspace_doubles(w, 2 * loads);
  s->law = workspace_array(w, contacts, sizeof *s->law);
  s->turning = workspace_array(w, (size_t)base->n_planar, sizeof *s->turning);
  return w->failed ? HC_NO_MEMORY : contact_rows_make(&s->rows, base, w);
}

/* Coefficient k of every contact's motion. */
static void project(motion_series *s, int k)
{
  contact_rows_motion(&s->rows, s->x + (size_t)k * (size_t)s->n, s->q);
  for (int j = 0; j < s->n_contacts; ++j) {
    const size_t at = (size_t)j * TERMS + (size_t)k;
    s->u[at] = contact_rows_at(s->q, s->rows.along[j]);
    s->v[at] = contact_rows_at(s->q, s->rows.across[j]);
  }
}

static void add_pull(motion_series *s, int row, double force)
{
  if (row >= 0) s->pull[row] += force;
}

/* Adds T of turning slips to coefficient k of the forces. */
static void add_turning(motion_series *s, const scaled_model *m, int k)
{
  for (planar_series *c = s->turning; c < s->turning + s->n_turning; ++c) {
    double pull[2];
    planar_series_next(c, &m->contact[c->contact], k, pull);
    for (int a = 0; a < 2; ++a) add_pull(s, s->rows.along[c->contact + a], pull[a]);
  }
}

/* The tau up to which the truncation error is rounding of the motion or of 1, its typical size. */
static double reach(const motion_series *s)
{
  const size_t n = (size_t)s->n;
  double size = 1;
  for (size_t k = 0; k < 3; ++k) size = fmax(size, norm_max(s->n, s->x + k * n));
  double tau = INFINITY;
  for (int k = TRACK_ORDER - 1; k <= TRACK_ORDER; ++k) {
    const double term = norm_max(s->n, s->x + (size_t)k * n);
    if (!(term > 0) && !isnan(term)) continue;
    tau = fmin(tau, pow(0.25 * DBL_EPSILON * size / term, 1.0 / k)); /* the rate's term is k/tau times as large */
    if (isnan(term) || isnan(tau)) return 0;
  }
  return tau;
}

static double expand(motion_series *s, const scaled_model *m, double theta)
{
  const modal_base *b = m->base;
  const size_t n = (size_t)s->n;
  for (int k = 0; k + 2 <= TRACK_ORDER; ++k) {
    const double *x = s->x + (size_t)k * n;
    double *force = s->force, *next = s->x + (size_t)(k + 2) * n;
    memset(force, 0, n * sizeof *force);
    /* The loads' coefficient k, from that of their cosine and sine. */
    for (int l = 0; l < b->n_loads; ++l) {
      double *c = s->load + 2 * l;
      const double h = b->harmonic[l], before = c[0];
      if (k == 0) c[0] = cos(h * theta), c[1] = sin(h * theta);
      else c[0] = -h * c[1] / k, c[1] = h * before / k;
      const double by = scaled_by_load(m, l), by_cosine = by * c[0], by_sine = by * c[1];
      const double *cosine = b->cosine + (size_t)l * (size_t)s->n, *sine = b->sine + (size_t)l * (size_t)s->n;
      for (int i = 0; i < s->n; ++i) force[i] += by_cosine * cosine[i] + by_sine * sine[i];
    }
    modal_base_subtract_K(b, m->by_K, x, force);
    modal_base_subtract_C(b, m->by_C * (k + 1), x + n, force);
    memset(s->pull, 0, (size_t)s->rows.count * sizeof *s->pull);
    /* Linear contact forces of coefficient k; constants only in coefficient 0. */
    for (int j = 0; j < s->n_contacts; ++j) {
      const contact_forces_linear *f = &s->law[j];
      const size_t at = (size_t)j * TERMS + (size_t)k;
      add_pull(s, s->rows.along[j], f->t_u * s->u[at] + f->t_v * s->v[at] + (k == 0 ? f->t_0 : 0));
      add_pull(s, s->rows.across[j], f->n_v * s->v[at] + (k == 0 ? f->n_0 : 0));
    }
    add_turning(s, m, k);
    contact_rows_pull(&s->rows, 1, s->pull, force);
    for (size_t i = 0; i < n; ++i) next[i] = force[i] / ((k + 1) * (k + 2));
    project(s, k + 2);
  }
  for (int k = TRACK_ORDER - 1; k <= TRACK_ORDER; ++k) add_turning(s, m, k); /* for their directions */
  double tau = reach(s);
  for (int i = 0; i < s->n_turning; ++i) tau = fmin(tau, planar_series_reach(&s->turning[i]));
  return tau;
}

/* Decides which slips keep their direction (law_kind.h); returns the longest step for which that is valid. */
static double hold(const motion_series *s, const scaled_model *m, contact_track *track)
{
  double reach = INFINITY;
  for (int j = 0; j < m->n_contacts; j += scaled_directions(m, j)) {
    const scaled_contact *c = &m->contact[j];
    if (!c->kind->hold || contact_slip_sign(track[j].state) == 0) continue;
    const double *u = s->u + (size_t)j * TERMS, *v = s->v + (size_t)j * TERMS; /* of two directions */
    const contact_motion at = {.u = {u[0], u[TERMS]}, .v = v[0], .du = {u[1], u[TERMS + 1]}, .dv = v[1]};
    reach = fmin(reach, c->kind->hold(&track[j], c, &at));
  }
  return reach;
}

double motion_series_begin(motion_series *s, const scaled_model *m, contact_track *track, double theta, const double *y,
                           double *held)
{
  memcpy(s->x, y, 2 * (size_t)s->n * sizeof *y);
  project(s, 0);
  project(s, 1);
  *held = hold(s, m, track);
  s->n_turning = 0;
  for (int j = 0; j < s->n_contacts; ++j) {
    const size_t at = (size_t)j * TERMS;
    s->law[j] = contact_track_forces(&track[j], &m->contact[j]);
    if (track[j].turns && m->contact[j].direction == 0)
      planar_series_begin(&s->turning[s->n_turning++], j, &track[j], s->u + at, s->v + at);
  }
  return expand(s, m, theta);
}

WIDE_VECTORS void motion_series_at(const motion_series *s, double tau, int order, double *out)
{
  const int n = s->n;
  double *restrict sum = out, *restrict slope = out + n;
  memset(out, 0, 2 * (size_t)n * sizeof *out);
  for (int k = TERMS - 1; k >= order; --k) {
    const double *restrict x = s->x + (size_t)k * (size_t)n, by = order == 0 ? 1 : k;
    for (int i = 0; i < n; ++i) {
      slope[i] = slope[i] * tau + sum[i];
      sum[i] = sum[i] * tau + by * x[i];
    }
  }
}

/* The first derivative of the sum with respect to tau. */
static double series_slope(const double *c, double tau)
{
  double f = 0;
  for (int k = TERMS; k-- > 1;) f = f * tau + k * c[k];
  return f;
}

contact_motion motion_series_contact(const motion_series *s, int j, int directions, double tau)
{
  const double *u = s->u + (size_t)j * TERMS, *v = s->v + (size_t)j * TERMS;
  contact_motion at = {.v = series_value(v, tau), .dv = series_slope(v, tau)};
  for (int a = 0; a < directions; ++a, u += TERMS) at.u[a] = series_value(u, tau), at.du[a] = series_slope(u, tau);
  return at;
}

static const planar_series *turning_of(const motion_series *s, int j)
{
  for (int i = 0; i < s->n_turning; ++i)
    if (s->turning[i].contact == j) return &s->turning[i];
  return NULL;
}

void motion_series_direction(const motion_series *s, int j, double tau, contact_track *t)
{
  const planar_series *turning = turning_of(s, j);
  double e[2];
  if (!turning) return;
  planar_series_direction(turning, tau, e);
  for (int a = 0; a < 2; ++a) t[a].along = e[a];
}

void motion_series_turn(const motion_series *s, double tau, contact_track *track)
{
  for (int i = 0; i < s->n_turning; ++i) {
    contact_track *t = &track[s->turning[i].contact];
    motion_series_direction(s, s->turning[i].contact, tau, t);
    for (int a = 0; a < 2; ++a) t[a].fresh = t[a].fresh && !(tau > 0);
  }
}

int motion_series_guards(const motion_series *s, const scaled_model *m, const contact_track *track, int j,
                         track_guard guard[TRACK_GUARDS])
{
  const double *u = s->u + (size_t)j * TERMS, *v = s->v + (size_t)j * TERMS;
  const scaled_contact *c = &m->contact[j];
  const int n = contact_track_guards(&track[j], c, u, v, guard);
  if (!track[j].turns) return n;
  planar_series_guard(turning_of(s, j), c, guard[n].g);
  guard[n].event = TRACK_STICKS;
  guard[n].noise = contact_track_rate_noise(c, hypot(u[1], u[1 + TERMS]), v[1]);
  return n + 1;
}

void motion_series_of(const motion_series *s, const double *row, double *r)
{
  for (int k = 0; k < TERMS; ++k) r[k] = dot_product(s->n, row, s->x + (size_t)k * (size_t)s->n);
}

double series_value(const double *c, double tau)
{
  double f = 0;
  for (int k = TERMS; k-- > 0;) f = f * tau + c[k];
  return f;
}

static double value_and_slope(const void *c, double tau, double *slope)
{
  *slope = series_slope(c, tau);
  return series_value(c, tau);
}

/* sum_{k>=1} |c_k| h^k, and a bound of the second derivative on [0, h]. */
static void bounds(const double *c, double h, double *change, double *bend)
{
  double power = 1;
  *change = fabs(c[1]) * h;
  *bend = 0;
  for (int k = 2; k < TERMS; ++k, power *= h) {
    *bend += k * (k - 1) * fabs(c[k]) * power;
    *change += fabs(c[k]) * power * h * h;
  }
}

double series_first_fall(const track_guard *guard, double h)
{
  const double *c = guard->g;
  double change, bend;
  bounds(c, h, &change, &bend);
  if (c[0] > change) return INFINITY;
  if (c[0] < -guard->noise) return 0;
  for (double tau = 0; tau < h;) {
    const double f = series_value(c, tau), slope = series_slope(c, tau);
    const double safe = safe_step(fmax(f, 0) + guard->noise, slope, bend);
    const double one_way = slope < 0 ? fmin(h - tau, -slope / bend) : 0; /* it falls at least that far */
    double next = tau + safe;
    if (f < -guard->noise) return tau;
    if (one_way > safe) {
      if (series_value(c, tau + one_way) < 0)
        return root_falling(value_and_slope, c, tau, f, tau + one_way, tau + 0.5 * one_way, 0);
      next = tau + one_way;
    }
    if (!(next > tau)) return tau; /* NaN, or a root here */
    tau = next;
  }
  return INFINITY;
}
