/* law_planar.c - see law_kind.h: the two directions of a contact with two tangents under the law of the circle. u, w, S
 * and T are vectors of the plane. Regularised (law_regularised.h), for either direction's half of N:
 *
 *     S  = kt (u - w)
 *     w' = e max(|S| - mu N, 0)/eta,  e = S/|S|
 *     T  = S, limited to |T| <= mu N; `overstress`: T = S
 * width -> 0, eta -> 0 give the exact law. Where w moves, |S| exceeds mu N by eta |w'|: T is exact except for its
 * direction, which turns as if R = mu N/kt were larger by eta |w'|/kt. So where the direction of slip turns the error
 * is of first order in eta (law_regularised.h: second).
 *
 * Under the exact law (contact_track.h) its guards are
 *     stick  (mu N)^2 - |T|^2        slip  kt s, of the series of e (planar_series.h) or, by CVODE, its angle
 * Shortly before N = 0 the direction e turns ever faster, but no longer affects the motion: it is then kept constant
 * (held).
 *
 * CVODE carries the angle of e as a state: T = mu N e, phi' = kt (U'.e_perp)/(mu N). At touch-down that is 0/0. The
 * only solution that stays bounded backwards in time starts along U', with
 *     phi'_0 = beta psi'/(1 + beta),   beta = kt |U'|/(mu kn V'),   psi' = U''.e_perp/|U'|: the turn of U'
 * and phi grows at that rate for the first `opening` [rad] of theta: its error is of second order in `opening`, and
 * changes a rate of the motion by fourth order (third as beta -> 1). Before N = 0 phi is held once its effect is small.
 * The guard of stick is mu N - |T| there, which is valid at N = 0, too. Proof: tests/timeint/test_law.c,
 * test_circle.c. */
#include "timeint/law/contact_track.h"

static const double held_pull = 1e-17; /* while the direction is held: largest change of a rate, until N = 0, that its
                                          error can cause */
static const double held_time = 1e-13; /* [rad] time to N = 0 that is too short for steps */
static const double opening = 1e-4;    /* [rad] of theta after a touch during which phi' is constant */

/* The spring's force S, its length, the limit mu N, and the excess of |S| over it, 0 in stick. */
typedef struct overload {
  double s[2], size, limit, excess;
} overload;

static overload load_of(const law_regularised *c, const double u[2], double n, const double w[2])
{
  overload o = {.s = {c->kt * (u[0] - w[0]), c->kt * (u[1] - w[1])}, .limit = c->mu * n};
  o.size = hypot(o.s[0], o.s[1]);
  o.excess = o.size > o.limit ? o.size - o.limit : 0;
  return o;
}

static planar_value evaluate(const law_regularised *c, const contact_motion *at, const double *w)
{
  const double *u = at->u, v = at->v;
  const law_value normal = law_regularised_eval(c, 0, v, 0); /* T = 0: of N alone */
  planar_value r = {.n = normal.n, .change = normal.change};
  if (!c->has_friction) return r;
  const overload o = load_of(c, u, normal.n, w);
  for (int a = 0; a < 2; ++a) {
    const double e = o.excess > 0 ? o.s[a] / o.size : 0;
    r.t[a] = o.excess > 0 && !c->overstress ? o.limit * e : o.s[a];
    r.rate[a] = o.excess * e / c->eta;
  }
  return r;
}

static planar_derivatives derivatives(const law_regularised *c, const contact_motion *at, const double *w)
{
  const double *u = at->u, v = at->v;
  const double n = law_regularised_eval(c, 0, v, 0).n;
  planar_derivatives r = {.n_v = law_regularised_derivatives(c, 0, v, 0).n_v};
  if (!c->has_friction) return r;
  const overload o = load_of(c, u, n, w);
  const double kept = o.excess > 0 ? o.limit / o.size : 1; /* factor of the part of kt that turns T */
  for (int a = 0; a < 2; ++a) {
    const double e = o.excess > 0 ? o.s[a] / o.size : 0;
    for (int b = 0; b < 2; ++b) {
      const double along = e * (o.excess > 0 ? o.s[b] / o.size : 0), unit = a == b;
      r.t_u[a][b] = c->kt * (c->overstress ? unit : kept * (unit - along));
      r.rate_u[a][b] = c->kt / c->eta * ((1 - kept) * unit + kept * along);
    }
    r.t_v[a] = c->overstress ? 0 : c->mu * r.n_v * e;
    r.rate_v[a] = -c->mu * r.n_v * e / c->eta;
  }
  return r;
}

/* The guard (mu N)^2 - |kt (U - rest)|^2 of stick, as a series; that of slip is planar_series_guard. */
static int curved_guards(const contact_track *t, const scaled_contact *c, const double *u, const double *v,
                         track_guard guard[TRACK_GUARDS])
{
  const law_regularised *law = &c->law;
  double f[3][TRACK_TERMS]; /* mu N, T_1, T_2 */
  if (t->state != CONTACT_STICK) return 0;
  for (int k = 0; k < TRACK_TERMS; ++k) {
    f[0][k] = law->mu * law->kn * v[k];
    for (int a = 0; a < 2; ++a) f[1 + a][k] = law->kt * u[a * TRACK_TERMS + k];
  }
  f[0][0] = contact_track_limit(c, v[0]);
  for (int a = 0; a < 2; ++a) f[1 + a][0] = law->kt * (u[a * TRACK_TERMS] - t[a].rest);
  for (int k = 0; k < TRACK_TERMS; ++k) {
    guard->g[k] = 0;
    for (int i = 0; i <= k; ++i) guard->g[k] += f[0][i] * f[0][k - i] - f[1][i] * f[1][k - i] - f[2][i] * f[2][k - i];
  }
  const double noise = contact_track_force_noise(c, hypot(u[0], u[TRACK_TERMS]), v[0], hypot(t[0].rest, t[1].rest));
  guard->event = TRACK_SLIPS_PLUS;
  guard->noise = noise * (noise + fabs(f[0][0]) + hypot(f[1][0], f[2][0]));
  return 1;
}

/* A change between held and turning e is no transition. */
static int counts(contact_track *t, track_event event, double theta)
{
  (void)t, (void)theta;
  return event != TRACK_TURNS && event != TRACK_HOLDS;
}

static double hold(contact_track *t, const scaled_contact *c, const contact_motion *at)
{
  const double distance = at->v + c->law.gap, left = at->dv < 0 ? distance / -at->dv : INFINITY; /* to N = 0 [rad] */
  const bool ends = !t->fresh && c->law.kn > 0 && at->dv < 0;
  const bool holds = ends && (c->law.mu * c->law.kn * distance * left < held_pull || left < held_time);
  t[0].turns = t[1].turns = !holds;
  return holds ? 4 * left : INFINITY;
}

/* ---- by CVODE: the angle phi of e = (cos phi, sin phi) ---------------------------------------------------- */

static double own_begin(contact_track *t)
{
  t->opens = (law_opening){.began = atan2(t[1].along, t[0].along)};
  return t->opens.began;
}

static void own_follow(contact_track *t, double phi)
{
  t[0].along = cos(phi);
  t[1].along = sin(phi);
}

static double friction_of(const scaled_contact *c) { return c->law.mu * c->law.kn; }

static void own_open(contact_track *t, const scaled_contact *c, const law_instant *now)
{
  const double *du = now->at.du, speed = hypot(du[0], du[1]);
  const double turn = (now->bend[1] * du[0] - now->bend[0] * du[1]) / (speed * speed);
  const double pull = c->law.kt * speed;
  t->opens.opens = true;
  t->opens.until = now->theta + opening;
  t->opens.rate = turn * pull / (friction_of(c) * now->at.dv + pull);
}

static law_pull pull(const contact_track *t, const scaled_contact *c, const contact_motion *at, double phi)
{
  const double limit = contact_track_limit(c, at->v), e[2] = {cos(phi), sin(phi)};
  const double turn = c->law.kt * (at->du[1] * e[0] - at->du[0] * e[1]) / limit;
  return (law_pull){.t = {limit * e[0], limit * e[1]}, .rate = t->opens.opens ? t->opens.rate : turn};
}

static law_slopes slopes(const contact_track *t, const scaled_contact *c, const contact_motion *at, double phi)
{
  const double limit = contact_track_limit(c, at->v), e[2] = {cos(phi), sin(phi)}, by = c->law.kt / limit;
  law_slopes s = {.t_v = {friction_of(c) * e[0], friction_of(c) * e[1]}, .t_own = {-limit * e[1], limit * e[0]}};
  if (t->opens.opens) return s;
  s.rate_du[0] = -by * e[1];
  s.rate_du[1] = by * e[0];
  s.rate_own = -by * (at->du[0] * e[0] + at->du[1] * e[1]);
  s.rate_v = -(s.rate_du[0] * at->du[0] + s.rate_du[1] * at->du[1]) * friction_of(c) / limit;
  return s;
}

static track_guard guard_of(track_event event, double value, double rate, double noise)
{
  return (track_guard){.event = event, .noise = noise, .g = {value, rate}};
}

/* kt U'.e - mu kn V'. */
static track_guard end_of_slip(const scaled_contact *c, const law_instant *now, double turn)
{
  const double e[2] = {cos(now->own), sin(now->own)}, kt = c->law.kt, *du = now->at.du;
  const double value = kt * (du[0] * e[0] + du[1] * e[1]) - friction_of(c) * now->at.dv;
  const double rate = kt * (now->bend[0] * e[0] + now->bend[1] * e[1] + turn * (du[1] * e[0] - du[0] * e[1])) -
                      friction_of(c) * now->normal_bend;
  return guard_of(TRACK_STICKS, value, rate, contact_track_rate_noise(c, hypot(du[0], du[1]), now->at.dv));
}

/* Guard mu kn (V + gap)^2 + may_change V': negative where the limit mu kn (V + gap), times the time left (V + gap)/-V',
 * is below may_change. */
static track_guard start_of_hold(const scaled_contact *c, const law_instant *now, double may_change)
{
  const double d = now->at.v + c->law.gap;
  return guard_of(TRACK_HOLDS, friction_of(c) * d * d + may_change * now->at.dv,
                  2 * friction_of(c) * d * now->at.dv + may_change * now->normal_bend, 0);
}

static int own_guards(const contact_track *t, const scaled_contact *c, const law_instant *now, double may_change,
                      track_guard guard[TRACK_GUARDS])
{
  const double apart = t->state == CONTACT_SEPARATED ? -1 : 1;
  int n = 0;
  if (c->law.kn > 0)
    guard[n++] = guard_of(apart < 0 ? TRACK_TOUCHES : TRACK_SEPARATES, apart * (now->at.v + c->law.gap),
                          apart * now->at.dv, contact_track_distance_noise(c, now->at.v));
  if (t->state == CONTACT_SEPARATED) return n;
  if (t->state == CONTACT_STICK) {
    /* mu N - |T|; where T = 0 the rate of |T| is kt |U'|. */
    const double s[2] = {now->at.u[0] - t[0].rest, now->at.u[1] - t[1].rest}, size = hypot(s[0], s[1]);
    const double grows =
        size > 0 ? (s[0] * now->at.du[0] + s[1] * now->at.du[1]) / size : hypot(now->at.du[0], now->at.du[1]);
    const double noise =
        contact_track_force_noise(c, hypot(now->at.u[0], now->at.u[1]), now->at.v, hypot(t[0].rest, t[1].rest));
    guard[n++] = guard_of(TRACK_SLIPS_PLUS, contact_track_limit(c, now->at.v) - c->law.kt * size,
                          friction_of(c) * now->at.dv - c->law.kt * grows, noise);
    return n;
  }
  if (!t->turns) {
    guard[n++] = guard_of(TRACK_TURNS, -now->at.dv, -now->normal_bend, 0);
    return n;
  }
  guard[n++] = end_of_slip(c, now, pull(t, c, &now->at, now->own).rate);
  if (t->opens.opens) guard[n++] = guard_of(TRACK_TURNS, t->opens.until - now->theta, -1, 0);
  else if (c->law.kn > 0) guard[n++] = start_of_hold(c, now, may_change);
  return n;
}

const law_kind law_planar = {.directions = 2,
                             .evaluate = evaluate,
                             .derivatives = derivatives,
                             .curved_guards = curved_guards,
                             .counts = counts,
                             .hold = hold,
                             .own_begin = own_begin,
                             .own_open = own_open,
                             .own_follow = own_follow,
                             .pull = pull,
                             .slopes = slopes,
                             .own_guards = own_guards};
