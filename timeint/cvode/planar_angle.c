/* planar_angle.c - see planar_angle.h. Proof: tests/timeint/test_circle.c. */
#include "timeint/cvode/planar_angle.h"

#include <math.h>

static const double opening = 1e-4; /* [rad] */

static double friction_of(const scaled_contact *c) { return c->law.mu * c->law.kn; }

void planar_angle_open(planar_angle *a, const scaled_contact *c, const angle_motion *now)
{
  const double *du = now->at.du, speed = hypot(du[0], du[1]);
  const double turn = (now->bend[1] * du[0] - now->bend[0] * du[1]) / (speed * speed);
  const double pull = c->law.kt * speed;
  a->opens = true;
  a->until = now->theta + opening;
  a->rate = turn * pull / (friction_of(c) * now->at.dv + pull);
}

double planar_angle_rate(const planar_angle *a, const contact_track t[2], const scaled_contact *c,
                         const contact_motion *at, double phi)
{
  if (!t->turns || a->opens) return t->turns ? a->rate : 0;
  return c->law.kt * (at->du[1] * cos(phi) - at->du[0] * sin(phi)) / contact_track_limit(c, at->v);
}

angle_slopes planar_angle_slopes(const planar_angle *a, const contact_track t[2], const scaled_contact *c,
                                 const contact_motion *at, double phi)
{
  const double limit = contact_track_limit(c, at->v), e[2] = {cos(phi), sin(phi)}, by = c->law.kt / limit;
  angle_slopes s = {.t_v = {friction_of(c) * e[0], friction_of(c) * e[1]}, .t_phi = {-limit * e[1], limit * e[0]}};
  if (!t->turns || a->opens) return s;
  s.rate_u[0] = -by * e[1];
  s.rate_u[1] = by * e[0];
  s.rate_phi = -by * (at->du[0] * e[0] + at->du[1] * e[1]);
  s.rate_v = -(s.rate_u[0] * at->du[0] + s.rate_u[1] * at->du[1]) * friction_of(c) / limit;
  return s;
}

static track_guard guard_of(track_event event, double value, double rate, double noise)
{
  return (track_guard){.event = event, .noise = noise, .g = {value, rate}};
}

/* mu N - |T|; where T = 0 its rate is that of the T to come. */
static track_guard end_of_stick(const contact_track t[2], const scaled_contact *c, const contact_motion *at)
{
  const double s[2] = {at->u[0] - t[0].rest, at->u[1] - t[1].rest}, size = hypot(s[0], s[1]);
  const double grows = size > 0 ? (s[0] * at->du[0] + s[1] * at->du[1]) / size : hypot(at->du[0], at->du[1]);
  const double noise = contact_track_force_noise(c, hypot(at->u[0], at->u[1]), at->v, hypot(t[0].rest, t[1].rest));
  return guard_of(TRACK_SLIPS_PLUS, contact_track_limit(c, at->v) - c->law.kt * size,
                  friction_of(c) * at->dv - c->law.kt * grows, noise);
}

/* kt U'.e - mu kn V'. */
static track_guard end_of_slip(const scaled_contact *c, const angle_motion *now, double turn)
{
  const double e[2] = {cos(now->phi), sin(now->phi)}, kt = c->law.kt, *du = now->at.du;
  const double value = kt * (du[0] * e[0] + du[1] * e[1]) - friction_of(c) * now->at.dv;
  const double rate = kt * (now->bend[0] * e[0] + now->bend[1] * e[1] + turn * (du[1] * e[0] - du[0] * e[1])) -
                      friction_of(c) * now->normal_bend;
  return guard_of(TRACK_STICKS, value, rate, contact_track_rate_noise(c, hypot(du[0], du[1]), now->at.dv));
}

/* mu kn (V + gap)^2 + held_pull V': mu kn times the square of the time left, times the speed of it, is small. */
static track_guard start_of_hold(const planar_angle *a, const scaled_contact *c, const angle_motion *now)
{
  const double d = now->at.v + c->law.gap;
  return guard_of(TRACK_HOLDS, friction_of(c) * d * d + a->held_pull * now->at.dv,
                  2 * friction_of(c) * d * now->at.dv + a->held_pull * now->normal_bend, 0);
}

int planar_angle_guards(const planar_angle *a, const contact_track t[2], const scaled_contact *c,
                        const angle_motion *now, track_guard guard[TRACK_GUARDS])
{
  const double apart = t->state == CONTACT_SEPARATED ? -1 : 1;
  int n = 0;
  if (c->law.kn > 0)
    guard[n++] = guard_of(apart < 0 ? TRACK_TOUCHES : TRACK_SEPARATES, apart * (now->at.v + c->law.gap),
                          apart * now->at.dv, contact_track_distance_noise(c, now->at.v));
  if (t->state == CONTACT_SEPARATED) return n;
  if (t->state == CONTACT_STICK) {
    guard[n++] = end_of_stick(t, c, &now->at);
    return n;
  }
  if (!t->turns) {
    guard[n++] = guard_of(TRACK_TURNS, -now->at.dv, -now->normal_bend, 0);
    return n;
  }
  guard[n++] = end_of_slip(c, now, planar_angle_rate(a, t, c, &now->at, now->phi));
  if (a->opens) guard[n++] = guard_of(TRACK_TURNS, a->until - now->theta, -1, 0);
  else if (c->law.kn > 0) guard[n++] = start_of_hold(a, c, now);
  return n;
}
