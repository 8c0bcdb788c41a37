/* law_planar.c - see law_kind.h: the two directions of a contact with two tangents under the law of the circle. u, w, S
 * and T are vectors of the plane. Regularised (law_regularised.h), for either direction's half of N:
 *
 *     S  = kt (u - w)
 *     w' = e max(|S| - mu N, 0)/eta,  e = S/|S|
 *     T  = S, limited to |T| <= mu N; `overstress`: T = S
 * width -> 0, eta -> 0 give the exact law. Where w moves, S is longer than mu N by eta |w'|: T is exact but for its
 * direction, which turns as if R = mu N/kt were longer by eta |w'|/kt. So where a slider creeps along the circle the
 * error is first order in eta (law_regularised.h: second).
 *
 * Under the exact law (contact_track.h) its guards are
 *     stick  (mu N)^2 - |T|^2        slip  kt s, of the series of e (planar_series.h) or its angle (planar_angle.h)
 * Shortly before N = 0 the direction e has no time left to turn the motion, but turns the faster itself: it is then
 * held. Proof: tests/timeint/test_law.c, test_circle.c. */
#include "timeint/law/contact_track.h"

static const double held_pull = 1e-17; /* what a wrong direction of T could change of a rate until N = 0 */
static const double held_time = 1e-13; /* [rad] too short for steps */

/* The spring's force, and by how much it is longer than the limit. */
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

static planar_value evaluate(const law_regularised *c, const double *u, double v, const double *w)
{
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

static planar_derivatives derivatives(const law_regularised *c, const double *u, double v, const double *w)
{
  const double n = law_regularised_eval(c, 0, v, 0).n;
  planar_derivatives r = {.n_v = law_regularised_derivatives(c, 0, v, 0).n_v};
  if (!c->has_friction) return r;
  const overload o = load_of(c, u, n, w);
  const double kept = o.excess > 0 ? o.limit / o.size : 1; /* of what turns the force */
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

/* (mu N)^2 - |kt (U - rest)|^2 of a contact that sticks; the series of e has that of one that slips. */
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

/* That e is held, or no more, is no change of state. */
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

const law_kind law_planar = {.directions = 2,
                             .evaluate = evaluate,
                             .derivatives = derivatives,
                             .curved_guards = curved_guards,
                             .counts = counts,
                             .hold = hold};
