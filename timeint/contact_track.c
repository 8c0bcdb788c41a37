/* contact_track.c - see contact_track.h. Proof: tests/timeint/test_structure.c. */
#include "timeint/contact_track.h"

#include <float.h>
#include <math.h>

static const double rounding = 16 * DBL_EPSILON; /* of sums of a few terms, relative to their sizes */

static contact law_of(const scaled_contact *c)
{
  return (contact){.kt = c->law.kt, .kn = c->law.kn, .mu = c->law.mu, .gap = c->law.gap, .load = c->law.load};
}

/* Rounding of the guards; motions are of the order of 1. */
static double distance_noise(const scaled_contact *c, double v) { return rounding * (1 + fabs(v) + fabs(c->law.gap)); }

static double force_noise(const scaled_contact *c, double u, double v, double w)
{
  const law_regularised *law = &c->law;
  return rounding *
         (law->kt * (1 + fabs(u) + fabs(w)) + law->mu * (law->kn * (1 + fabs(v) + fabs(law->gap)) + law->load));
}

static double rate_noise(const scaled_contact *c, double du, double dv)
{
  return rounding * (c->law.kt * (1 + fabs(du)) + c->law.mu * c->law.kn * (1 + fabs(dv)));
}

static contact_state slip(int sign) { return sign > 0 ? CONTACT_SLIP_PLUS : CONTACT_SLIP_MINUS; }

/* W in slip(sign). */
static double slipping_slider(const scaled_contact *c, int sign, double u, double v)
{
  return u - sign * c->law.mu * (c->law.kn * (v + c->law.gap) + c->law.load) / c->law.kt;
}

contact_track contact_track_begin(const scaled_contact *c, const contact_motion *at, double w)
{
  const contact law = law_of(c);
  contact_track t = {.state = CONTACT_SEPARATED};
  if (!(contact_normal(&law, at->v) > 0)) return t;
  t = (contact_track){.state = CONTACT_STICK, .rest = w};
  if (!c->law.has_friction) return t;
  const int sign = at->u > w ? 1 : -1;
  t.since_start = contact_guard_stick(&law, sign, at->u, at->v, w) > force_noise(c, at->u, at->v, w);
  if (t.since_start) return t;
  t.limit = sign;
  t.rest = slipping_slider(c, sign, at->u, at->v);
  if (contact_guard_slip(&law, sign, at->du, at->dv) > 0) t.state = slip(sign);
  return t;
}

/* mu N - sign kt (U - rest). */
static void guard_of_stick(const contact_track *t, const scaled_contact *c, int sign, const double *u, const double *v,
                           track_guard *guard)
{
  const double kt = sign * c->law.kt, limit = c->law.mu * c->law.kn;
  guard->event = sign > 0 ? TRACK_SLIPS_PLUS : TRACK_SLIPS_MINUS;
  guard->noise = force_noise(c, u[0], v[0], t->rest);
  for (int k = 0; k <= TRACK_ORDER; ++k) guard->g[k] = limit * v[k] - kt * u[k];
  guard->g[0] = limit * (v[0] + c->law.gap) + c->law.mu * c->law.load - kt * (u[0] - t->rest);
}

/* sign kt U' - mu kn V'. */
static void guard_of_slip(const scaled_contact *c, int sign, const double *u, const double *v, track_guard *guard)
{
  const double kt = sign * c->law.kt, limit = c->law.mu * c->law.kn;
  guard->event = TRACK_STICKS;
  guard->noise = rate_noise(c, u[1], v[1]);
  for (int k = 0; k < TRACK_ORDER; ++k) guard->g[k] = (k + 1) * (kt * u[k + 1] - limit * v[k + 1]);
  guard->g[TRACK_ORDER] = 0;
}

/* V + gap, or minus that. */
static void guard_of_contact(const contact_track *t, const scaled_contact *c, const double *v, track_guard *guard)
{
  const double way = t->state == CONTACT_SEPARATED ? -1 : 1;
  guard->event = way > 0 ? TRACK_SEPARATES : TRACK_TOUCHES;
  guard->noise = distance_noise(c, v[0]);
  for (int k = 0; k <= TRACK_ORDER; ++k) guard->g[k] = way * v[k];
  guard->g[0] = way * (v[0] + c->law.gap);
}

int contact_track_guards(const contact_track *t, const scaled_contact *c, const double *u, const double *v,
                         track_guard guard[TRACK_GUARDS])
{
  const int sign = contact_slip_sign(t->state);
  int n = 0;
  if (c->law.kn > 0) guard_of_contact(t, c, v, &guard[n++]);
  if (t->state == CONTACT_SEPARATED || !c->law.has_friction) return n;
  if (sign != 0) {
    guard_of_slip(c, sign, u, v, &guard[n++]);
  } else {
    guard_of_stick(t, c, 1, u, v, &guard[n++]);
    guard_of_stick(t, c, -1, u, v, &guard[n++]);
  }
  return n;
}

void contact_track_pass(contact_track *t, const scaled_contact *c, track_event event, const contact_motion *at)
{
  const contact law = law_of(c);
  t->since_start = false;
  switch (event) {
  case TRACK_SEPARATES: t->state = CONTACT_SEPARATED; return;
  case TRACK_SLIPS_PLUS: t->state = CONTACT_SLIP_PLUS; return;
  case TRACK_SLIPS_MINUS: t->state = CONTACT_SLIP_MINUS; return;
  case TRACK_STICKS:
    t->rest = slipping_slider(c, contact_slip_sign(t->state), at->u, at->v);
    t->state = CONTACT_STICK;
    return;
  case TRACK_TOUCHES:
    t->rest = at->u;
    t->state = c->law.has_friction ? contact_on_touch(&law, at->du, at->dv) : CONTACT_STICK;
    return;
  }
}

double contact_track_slider(const contact_track *t, const scaled_contact *c, const contact_motion *at)
{
  if (!c->law.has_friction || t->state == CONTACT_SEPARATED) return at->u;
  if (t->state == CONTACT_STICK) return t->rest;
  return slipping_slider(c, contact_slip_sign(t->state), at->u, at->v);
}

contact_forces_linear contact_track_forces(const contact_track *t, const scaled_contact *c)
{
  const law_regularised *law = &c->law;
  const int sign = contact_slip_sign(t->state);
  if (t->state == CONTACT_SEPARATED) return (contact_forces_linear){.n_0 = -c->preload};
  contact_forces_linear f = {.n_v = law->kn, .n_0 = law->gap > 0 ? 0 : law->kn * law->gap}; /* N0 is left out, not added
                                                                                              and subtracted */
  if (!law->has_friction) return f;
  if (sign != 0) {
    f.t_v = sign * law->mu * law->kn;
    f.t_0 = sign * law->mu * (law->kn * law->gap + law->load);
  } else {
    f.t_u = law->kt;
    f.t_0 = -law->kt * t->rest;
    f.t_w = -law->kt;
  }
  return f;
}

double contact_track_vary_rest(const scaled_contact *c, contact_state before, const contact_motion *at, double du,
                               double dv)
{
  const int sign = contact_slip_sign(before);
  if (before == CONTACT_SEPARATED) return at->dv != 0 ? du - at->du * dv / at->dv : du;
  return du - sign * c->law.mu * c->law.kn / c->law.kt * dv;
}

double contact_track_vary_slider(const contact_track *t, const scaled_contact *c, double du, double dv)
{
  if (!c->law.has_friction || t->state == CONTACT_SEPARATED) return du;
  return du - contact_slip_sign(t->state) * c->law.mu * c->law.kn / c->law.kt * dv;
}
