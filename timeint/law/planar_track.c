/* planar_track.c - see planar_track.h. Proof: tests/timeint/test_circle.c. */
#include "timeint/law/planar_track.h"

#include <math.h>

static const double held_pull = 1e-17; /* what a wrong direction of T could change of a rate until N = 0 */
static const double held_time = 1e-13; /* [rad] too short for steps */

double planar_track_radius(const scaled_contact *c, double v)
{
  return c->law.mu * (c->law.kn * (v + c->law.gap) + c->law.load) / c->law.kt;
}

static void set_state(contact_track t[2], contact_state state) { t[0].state = t[1].state = state; }

static void set_direction(contact_track t[2], double e1, double e2)
{
  const double size = hypot(e1, e2);
  t[0].along = size > 0 ? e1 / size : 1;
  t[1].along = size > 0 ? e2 / size : 0;
}

static void rest_on_circle(contact_track t[2], const scaled_contact *c, const planar_contact_motion *at)
{
  const double radius = planar_track_radius(c, at->v);
  for (int a = 0; a < 2; ++a) t[a].rest = at->u[a] - radius * t[a].along;
}

/* kt s */
static double slide(const contact_track t[2], const scaled_contact *c, const double du[2], double dv)
{
  return c->law.kt * (du[0] * t[0].along + du[1] * t[1].along) - c->law.mu * c->law.kn * dv;
}

void planar_track_begin(contact_track t[2], const scaled_contact *c, const planar_contact_motion *at, const double w[2])
{
  const law_regularised *law = &c->law;
  const double s[2] = {at->u[0] - w[0], at->u[1] - w[1]}, size = hypot(s[0], s[1]);
  for (int a = 0; a < 2; ++a) t[a] = (contact_track){.state = CONTACT_SEPARATED};
  if (!(law->kn > 0 ? at->v + law->gap > 0 : law->load > 0)) return;
  for (int a = 0; a < 2; ++a) t[a] = (contact_track){.state = CONTACT_STICK, .rest = w[a]};
  const double spare = law->kt * (planar_track_radius(c, at->v) - size);
  t[0].since_start = t[1].since_start =
      spare > contact_track_force_noise(c, hypot(at->u[0], at->u[1]), at->v, hypot(w[0], w[1]));
  if (t->since_start) return;
  t[0].limit = t[1].limit = 1;
  if (size > 0) set_direction(t, s[0], s[1]);
  else set_direction(t, at->du[0], at->du[1]);
  rest_on_circle(t, c, at);
  if (slide(t, c, at->du, at->dv) > 0) set_state(t, CONTACT_SLIP_PLUS);
}

void planar_track_stick_guard(const contact_track t[2], const scaled_contact *c, const double *u1, const double *u2,
                              const double *v, track_guard *guard)
{
  const law_regularised *law = &c->law;
  const double *const u[2] = {u1, u2};
  double f[3][TRACK_TERMS]; /* mu N, T_1, T_2 */
  for (int k = 0; k < TRACK_TERMS; ++k) {
    f[0][k] = law->mu * law->kn * v[k];
    for (int a = 0; a < 2; ++a) f[1 + a][k] = law->kt * u[a][k];
  }
  f[0][0] = law->mu * (law->kn * (v[0] + law->gap) + law->load);
  for (int a = 0; a < 2; ++a) f[1 + a][0] = law->kt * (u[a][0] - t[a].rest);
  for (int k = 0; k < TRACK_TERMS; ++k) {
    guard->g[k] = 0;
    for (int i = 0; i <= k; ++i) guard->g[k] += f[0][i] * f[0][k - i] - f[1][i] * f[1][k - i] - f[2][i] * f[2][k - i];
  }
  const double noise = contact_track_force_noise(c, hypot(u1[0], u2[0]), v[0], hypot(t[0].rest, t[1].rest));
  guard->event = TRACK_SLIPS_PLUS;
  guard->noise = noise * (noise + fabs(f[0][0]) + hypot(f[1][0], f[2][0]));
}

bool planar_track_holds(const contact_track t[2], const scaled_contact *c, const planar_contact_motion *at,
                        double *left)
{
  const double distance = at->v + c->law.gap;
  *left = INFINITY;
  if (t->state != CONTACT_SLIP_PLUS || t->fresh || !(c->law.kn > 0) || !(at->dv < 0)) return false;
  *left = distance / -at->dv;
  return c->law.mu * c->law.kn * distance * *left < held_pull || *left < held_time;
}

void planar_track_pass(contact_track t[2], const scaled_contact *c, track_event event, const planar_contact_motion *at)
{
  const law_regularised *law = &c->law;
  const double speed = hypot(at->du[0], at->du[1]);
  const bool slips = law->kt * speed > law->mu * law->kn * at->dv;
  for (int a = 0; a < 2; ++a) t[a].since_start = t[a].fresh = t[a].held = false;
  switch (event) {
  case TRACK_SEPARATES: set_state(t, CONTACT_SEPARATED); return;
  case TRACK_SLIPS_PLUS:
  case TRACK_SLIPS_MINUS:
    set_state(t, CONTACT_SLIP_PLUS);
    set_direction(t, at->u[0] - t[0].rest, at->u[1] - t[1].rest);
    return;
  case TRACK_STICKS:
    rest_on_circle(t, c, at);
    set_state(t, CONTACT_STICK);
    return;
  case TRACK_TURNS: return;
  case TRACK_HOLDS: t[0].held = t[1].held = true; return;
  case TRACK_TOUCHES:
    for (int a = 0; a < 2; ++a) t[a].rest = at->u[a];
    set_state(t, slips ? CONTACT_SLIP_PLUS : CONTACT_STICK);
    if (!slips) return;
    set_direction(t, at->du[0], at->du[1]);
    t[0].fresh = t[1].fresh = true;
    return;
  }
}

void planar_track_slider(const contact_track t[2], const scaled_contact *c, const planar_contact_motion *at,
                         double w[2])
{
  const double radius = t->state == CONTACT_SEPARATED ? 0 : planar_track_radius(c, at->v);
  for (int a = 0; a < 2; ++a)
    w[a] = t->state == CONTACT_STICK ? t[a].rest : at->u[a] - radius * (radius > 0 ? t[a].along : 0);
}

void planar_track_slider_rate(const contact_track t[2], const scaled_contact *c, const double du[2], double dv,
                              double dw[2])
{
  const double s = slide(t, c, du, dv) / c->law.kt;
  for (int a = 0; a < 2; ++a)
    dw[a] = t->state == CONTACT_STICK ? 0 : t->state == CONTACT_SEPARATED ? du[a] : s * t[a].along;
}
