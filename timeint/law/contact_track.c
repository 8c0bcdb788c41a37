/* contact_track.c - see contact_track.h. Proof: tests/timeint/test_structure.c. */
#include "timeint/law/contact_track.h"

#include <float.h>
#include <math.h>

static const double rounding = 16 * DBL_EPSILON; /* of sums of a few terms, relative to their sizes */

static const double at_once = 1e-6; /* [rad] around a turn or a touch a slip that long moves the slider by its square */

static contact law_of(const scaled_contact *c)
{
  return (contact){.kt = c->law.kt, .kn = c->law.kn, .mu = c->law.mu, .gap = c->law.gap, .load = c->law.load};
}

/* Rounding of the guards; motions are of the order of 1. */
double contact_track_distance_noise(const scaled_contact *c, double v)
{
  return rounding * (1 + fabs(v) + fabs(c->law.gap));
}

double contact_track_force_noise(const scaled_contact *c, double u, double v, double w)
{
  const law_regularised *law = &c->law;
  return rounding *
         (law->kt * (1 + fabs(u) + fabs(w)) + law->mu * (law->kn * (1 + fabs(v) + fabs(law->gap)) + law->load));
}

double contact_track_rate_noise(const scaled_contact *c, double du, double dv)
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
  t.since_start = contact_guard_stick(&law, sign, at->u, at->v, w) > contact_track_force_noise(c, at->u, at->v, w);
  if (t.since_start) return t;
  t.limit = sign;
  t.rest = slipping_slider(c, sign, at->u, at->v);
  if (contact_guard_slip(&law, sign, at->du, at->dv) > 0) t.state = slip(sign);
  return t;
}

/* mu N - sign kt (U - rest). */
static track_condition end_of_stick(const contact_track *t, const scaled_contact *c, int sign)
{
  return (track_condition){.event = sign > 0 ? TRACK_SLIPS_PLUS : TRACK_SLIPS_MINUS,
                           .by_u = -sign * c->law.kt,
                           .by_v = c->law.mu * c->law.kn,
                           .from_u = t->rest,
                           .gap = c->law.gap,
                           .constant = c->law.mu * c->law.load};
}

/* sign kt U' - mu kn V'. */
static track_condition end_of_slip(const scaled_contact *c, int sign)
{
  return (track_condition){
      .event = TRACK_STICKS, .of_rates = true, .by_u = sign * c->law.kt, .by_v = -c->law.mu * c->law.kn};
}

/* V + gap, or minus that. */
static track_condition end_of_contact(const contact_track *t, const scaled_contact *c)
{
  const bool apart = t->state == CONTACT_SEPARATED;
  return (track_condition){.event = apart ? TRACK_TOUCHES : TRACK_SEPARATES, .by_v = apart ? -1 : 1, .gap = c->law.gap};
}

int contact_track_conditions(const contact_track *t, const scaled_contact *c, track_condition conditions[TRACK_GUARDS])
{
  const int sign = contact_slip_sign(t->state);
  int n = 0;
  if (c->law.kn > 0) conditions[n++] = end_of_contact(t, c);
  if (t->state == CONTACT_SEPARATED || !c->law.has_friction || c->circle || c->second) return n;
  if (sign != 0) {
    conditions[n++] = end_of_slip(c, sign);
  } else {
    conditions[n++] = end_of_stick(t, c, 1);
    conditions[n++] = end_of_stick(t, c, -1);
  }
  return n;
}

double contact_track_noise(const track_condition *g, const scaled_contact *c, const contact_motion *at)
{
  if (g->of_rates) return contact_track_rate_noise(c, at->du, at->dv);
  if (g->event == TRACK_SEPARATES || g->event == TRACK_TOUCHES) return contact_track_distance_noise(c, at->v);
  return contact_track_force_noise(c, at->u, at->v, g->from_u);
}

static void expand(const track_condition *g, const double *u, const double *v, double *series)
{
  if (g->of_rates) {
    for (int k = 0; k < TRACK_ORDER; ++k) series[k] = (k + 1) * (g->by_u * u[k + 1] + g->by_v * v[k + 1]);
    series[TRACK_ORDER] = 0;
    return;
  }
  for (int k = 0; k <= TRACK_ORDER; ++k) series[k] = g->by_v * v[k] + g->by_u * u[k];
  series[0] = g->by_v * (v[0] + g->gap) + g->constant + g->by_u * (u[0] - g->from_u);
}

int contact_track_guards(const contact_track *t, const scaled_contact *c, const double *u, const double *v,
                         track_guard guard[TRACK_GUARDS])
{
  track_condition conditions[TRACK_GUARDS];
  const contact_motion at = {u[0], v[0], u[1], v[1]};
  const int n = contact_track_conditions(t, c, conditions);
  for (int i = 0; i < n; ++i) {
    guard[i].event = conditions[i].event;
    guard[i].noise = contact_track_noise(&conditions[i], c, &at);
    expand(&conditions[i], u, v, guard[i].g);
  }
  return n;
}

int contact_track_counts(contact_track *t, track_event event, double theta)
{
  const bool slipped = contact_slip_sign(t->state) != 0, no_length = slipped && theta - t->changed <= at_once;
  t->changed = event == TRACK_TOUCHES ? -INFINITY : theta;
  if (no_length && event == TRACK_SEPARATES) return 0;
  return no_length && event == TRACK_STICKS ? -1 : 1;
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
  case TRACK_TURNS:
  case TRACK_HOLDS: return;
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
    const bool circle = c->circle || c->second;
    const double along = circle ? t->held ? t->along : 0 : sign;
    f.t_v = along * law->mu * law->kn;
    f.t_0 = along * law->mu * (law->kn * law->gap + law->load);
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
