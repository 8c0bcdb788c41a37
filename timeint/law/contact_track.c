/* contact_track.c - see contact_track.h. Proof: tests/timeint/test_structure.c, test_circle.c, test_families.c. */
#include "timeint/law/contact_track.h"

#include <float.h>

#include "numerics/base/constants.h"

static const double rounding = 16 * DBL_EPSILON; /* rounding of sums of a few terms, relative to their sizes */

/* Noise of the guards; motions are of the order of 1. */
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

double contact_track_limit(const scaled_contact *c, double v)
{
  return c->law.mu * (c->law.kn * (v + c->law.gap) + c->law.load);
}

double contact_track_radius(const scaled_contact *c, double v) { return contact_track_limit(c, v) / c->law.kt; }

/* |a| in the contact's directions. */
static double size_of(const scaled_contact *c, const double *a)
{
  return c->kind->directions == 1 ? fabs(a[0]) : hypot(a[0], a[1]);
}

static void set_state(contact_track *t, const scaled_contact *c, contact_state state)
{
  for (int a = 0; a < c->kind->directions; ++a) {
    t[a].state = state;
    t[a].since_start = t[a].fresh = t[a].turns = false;
  }
}

/* Sets slip along e; with one tangent the state is its sign. */
static void set_slip(contact_track *t, const scaled_contact *c)
{
  const bool turns = c->kind->directions > 1;
  set_state(t, c, !turns && t->along < 0 ? CONTACT_SLIP_MINUS : CONTACT_SLIP_PLUS);
  for (int a = 0; a < c->kind->directions; ++a) t[a].turns = turns;
}

static void set_direction(contact_track *t, const scaled_contact *c, const double *along)
{
  const double size = size_of(c, along);
  for (int a = 0; a < c->kind->directions; ++a) t[a].along = size > 0 ? along[a] / size : a == 0;
}

static void rest_on_limit(contact_track *t, const scaled_contact *c, const contact_motion *at)
{
  const double radius = contact_track_radius(c, at->v);
  for (int a = 0; a < c->kind->directions; ++a) t[a].rest = at->u[a] - radius * t[a].along;
}

/* kt s */
static double slide(const contact_track *t, const scaled_contact *c, const double *du, double dv)
{
  double along = 0;
  for (int a = 0; a < c->kind->directions; ++a) along += du[a] * t[a].along;
  return c->law.kt * along - c->law.mu * c->law.kn * dv;
}

static void find_state(contact_track *t, const scaled_contact *c, const contact_motion *at, const double *w)
{
  const law_regularised *law = &c->law;
  double s[2] = {0};
  if (!(law->kn > 0 ? at->v + law->gap > 0 : law->load > 0)) return;
  for (int a = 0; a < c->kind->directions; ++a) {
    t[a].state = CONTACT_STICK;
    t[a].rest = w[a];
    s[a] = at->u[a] - w[a];
  }
  if (!law->has_friction) return;
  const double size = size_of(c, s), spare = contact_track_limit(c, at->v) - law->kt * size;
  const bool within = spare > contact_track_force_noise(c, size_of(c, at->u), at->v, size_of(c, w));
  for (int a = 0; a < c->kind->directions; ++a) t[a].since_start = within;
  if (within) return;
  set_direction(t, c, size > 0 ? s : at->du);
  rest_on_limit(t, c, at);
  if (slide(t, c, at->du, at->dv) > 0) set_slip(t, c);
}

void contact_track_begin(contact_track *t, const scaled_contact *c, const contact_motion *at, const double *w)
{
  for (int a = 0; a < c->kind->directions; ++a) t[a] = (contact_track){.state = CONTACT_SEPARATED, .from = w[a]};
  find_state(t, c, at, w);
  for (int a = 0; a < c->kind->directions; ++a) t[a].most = t->state == CONTACT_SEPARATED ? INFINITY : 0;
}

/* V + gap, or minus that; then the guards of the law. */
int contact_track_conditions(const contact_track *t, const scaled_contact *c, track_condition conditions[TRACK_GUARDS])
{
  const bool apart = t->state == CONTACT_SEPARATED;
  int n = 0;
  if (c->law.kn > 0)
    conditions[n++] =
        (track_condition){.event = apart ? TRACK_TOUCHES : TRACK_SEPARATES, .by_v = apart ? -1 : 1, .gap = c->law.gap};
  return apart || !c->law.has_friction || !c->kind->conditions ? n : n + c->kind->conditions(t, c, conditions + n);
}

bool contact_track_is_linear(const contact_track *t, const scaled_contact *c)
{
  return !c->kind->curved_guards || t->state == CONTACT_SEPARATED;
}

double contact_track_noise(const track_condition *g, const scaled_contact *c, const contact_motion *at)
{
  if (g->of_rates) return contact_track_rate_noise(c, at->du[0], at->dv);
  if (g->event == TRACK_SEPARATES || g->event == TRACK_TOUCHES) return contact_track_distance_noise(c, at->v);
  return contact_track_force_noise(c, at->u[0], at->v, g->from_u);
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
  const contact_motion at = {.u = {u[0]}, .v = v[0], .du = {u[1]}, .dv = v[1]};
  const int n = contact_track_conditions(t, c, conditions);
  for (int i = 0; i < n; ++i) {
    guard[i].event = conditions[i].event;
    guard[i].noise = contact_track_noise(&conditions[i], c, &at);
    expand(&conditions[i], u, v, guard[i].g);
  }
  return contact_track_is_linear(t, c) ? n : n + c->kind->curved_guards(t, c, u, v, guard + n);
}

void contact_track_pass(contact_track *t, const scaled_contact *c, track_event event, const contact_motion *at)
{
  const int directions = c->kind->directions;
  double s[2] = {0};
  switch (event) {
  case TRACK_SEPARATES: set_state(t, c, CONTACT_SEPARATED); return;
  case TRACK_SLIPS_PLUS:
  case TRACK_SLIPS_MINUS:
    for (int a = 0; a < directions; ++a) s[a] = at->u[a] - t[a].rest;
    if (directions == 1) s[0] = event == TRACK_SLIPS_PLUS ? 1 : -1; /* also valid where T and N vanish together */
    set_direction(t, c, s);
    set_slip(t, c);
    return;
  case TRACK_STICKS:
    rest_on_limit(t, c, at);
    set_state(t, c, CONTACT_STICK);
    return;
  case TRACK_TURNS:
  case TRACK_HOLDS:
    for (int a = 0; a < directions; ++a) t[a].turns = event == TRACK_TURNS, t[a].fresh = false;
    return;
  case TRACK_TOUCHES:
    for (int a = 0; a < directions; ++a) t[a].rest = at->u[a];
    set_state(t, c, CONTACT_STICK);
    if (!c->law.has_friction || !(c->law.kt * size_of(c, at->du) > c->law.mu * c->law.kn * at->dv)) return;
    set_direction(t, c, at->du);
    set_slip(t, c);
    for (int a = 0; a < directions; ++a) t[a].fresh = t[a].turns;
    return;
  }
}

void contact_track_slider(const contact_track *t, const scaled_contact *c, const contact_motion *at, double *w)
{
  const bool free = !c->law.has_friction || t->state == CONTACT_SEPARATED;
  const double radius = free ? 0 : fmax(contact_track_radius(c, at->v), 0);
  for (int a = 0; a < c->kind->directions; ++a)
    w[a] = t->state == CONTACT_STICK && !free ? t[a].rest : at->u[a] - (radius > 0 ? radius * t[a].along : 0);
}

void contact_track_slider_rate(const contact_track *t, const scaled_contact *c, const contact_motion *rates, double *dw)
{
  const bool free = !c->law.has_friction || t->state == CONTACT_SEPARATED;
  const double s = free || t->state == CONTACT_STICK ? 0 : slide(t, c, rates->u, rates->v) / c->law.kt;
  for (int a = 0; a < c->kind->directions; ++a) dw[a] = free ? rates->u[a] : s * t[a].along;
}

void contact_track_end(contact_track *t, int n_contacts, const double *w)
{
  for (int j = 0; j < n_contacts; ++j) {
    const double far = t[j].state == CONTACT_SEPARATED ? INFINITY : fabs(w[j] - t[j].from);
    if (!(far <= t[j].most)) t[j].most = far;
  }
}

void contact_track_note(contact_track *t, const scaled_contact *c, const contact_motion *at)
{
  double w[2];
  contact_track_slider(t, c, at, w);
  contact_track_end(t, c->kind->directions, w);
}

void contact_track_note_turn(contact_track *t, const scaled_contact *c, double turn)
{
  for (int a = 0; a < c->kind->directions && !(fabs(turn) <= TWO_PI / 4); ++a) t[a].most = INFINITY;
}

contact_forces_linear contact_track_forces(const contact_track *t, const scaled_contact *c)
{
  const law_regularised *law = &c->law;
  if (t->state == CONTACT_SEPARATED) return (contact_forces_linear){.n_0 = -c->preload};
  contact_forces_linear f = {.n_v = law->kn, .n_0 = law->gap > 0 ? 0 : law->kn * law->gap}; /* N - N0 = kn V for gap <=
                                                                                               0: no cancellation */
  if (!law->has_friction || t->turns) return f;
  if (t->state == CONTACT_STICK) {
    f.t_u = law->kt;
    f.t_0 = -law->kt * t->rest;
    f.t_w = -law->kt;
  } else {
    f.t_v = t->along * law->mu * law->kn;
    f.t_0 = t->along * law->mu * (law->kn * law->gap + law->load);
  }
  return f;
}

double contact_track_vary_touch(const contact_motion *at, int a, double du, double dv)
{
  return at->dv != 0 ? du - at->du[a] * dv / at->dv : du;
}

double contact_track_vary_slider(const contact_track *t, const scaled_contact *c, double du, double dv)
{
  if (!c->law.has_friction || t->state == CONTACT_SEPARATED) return du;
  return du - t->along * c->law.mu * c->law.kn / c->law.kt * dv;
}
