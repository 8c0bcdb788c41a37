/* planar_slip.c - see planar_slip.h. A panel's slopes are found by Newton. Where s falls through 0 within it, the panel
 * is computed again up to there, so that phi at its end has the accuracy of a panel's end.
 *
 * Touch-down, R = 0: the equation is singular, phi = direction of u', and differentiating it once gives the slope of
 * the one branch that is regular, phi' = u''.e_perp/(|u'| + R'). All others tend to it as R grows. Lift-off while it
 * slips: phi - (direction of u') goes like R^k, k = |u'|/|R'| being any number > 0. Panels shrink towards it
 * geometrically, with a tolerance that grows with what is left of the force's integral, R times the angle left. */
#include "hbm/planar/planar_slip.h"

#include <float.h>
#include <string.h>

#include "numerics/rotate.h"
#include "numerics/wide_vectors.h"

enum { N = COLLOCATION_POINTS, MAX_NEWTON = 12, MAX_STEPS = 60 };

static const double least_width = 1e-10; /* [rad] least width of a panel, unless the remaining angle is less */

static double turned(const double x[2], double phi) { return x[1] * cos(phi) - x[0] * sin(phi); } /* x.e_perp */
static double along(const double x[2], double phi) { return x[0] * cos(phi) + x[1] * sin(phi); }  /* x.e */

static bool is_singular(const planar_motion *m, const planar_point *p) { return !(p->R > planar_motion_noise(m)); }

double planar_slip_slope(const planar_motion *m, const planar_point *p, double phi)
{
  if (is_singular(m, p)) return turned(p->ddu, phi) / (along(p->du, phi) + p->dR);
  return turned(p->du, phi) / p->R;
}

double planar_slip_speed(const planar_point *p, double phi) { return along(p->du, phi) - p->dR; }

double planar_slip_acceleration(const planar_motion *m, const planar_point *p, double phi)
{
  return along(p->ddu, phi) + turned(p->du, phi) * planar_slip_slope(m, p, phi) - p->ddR;
}

double planar_panel_angle(const collocation *c, const planar_panel *p, double th)
{
  const double h = p->to - p->from;
  return p->phi0 + h * collocation_rise(c, p->slope, h > 0 ? (th - p->from) / h : 1);
}

/* cosines and sines of phi0 + rise. */
static inline void turn_all(double phi0, double c, double s, const double rise[N], double cosine[N], double sine[N])
{
  bool near = true;
  for (int i = 0; i < N; ++i) near = near && fabs(rise[i]) <= ROTATE_MOST;
  if (near) rotate(N, c, s, rise, cosine, sine);
  else
    for (int i = 0; i < N; ++i) cosine[i] = cos(phi0 + rise[i]), sine[i] = sin(phi0 + rise[i]);
}

void planar_panel_directions(const planar_panel *p, double cosine[N], double sine[N])
{
  double rise[N];
  for (int i = 0; i < N; ++i) rise[i] = p->phi[i] - p->phi0;
  turn_all(p->phi0, cos(p->phi0), sin(p->phi0), rise, cosine, sine);
}

/* ---- one panel ------------------------------------------------------------------------------------ */

/* Whole rows, zeros included: loops of constant length are faster. */
static inline void subtract_row(double factor, const double *restrict row, double *restrict from)
{
  for (int j = 0; j < N + 2; ++j) from[j] -= factor * row[j];
}

typedef struct panel_points {
  planar_rates at;
  double rise[N];      /* [rad] phi - phi0 */
  double cosine, sine; /* of phi0 */
  double speed[N];     /* s at the points */
  double mismatch;     /* [rad] last two Legendre coefficients of the slope times the width */
} panel_points;

/* phi from the slopes. */
static inline void set_angles(const collocation *c, planar_panel *p, panel_points *q)
{
  const double h = p->to - p->from;
  double rise[N] = {0};
  for (int j = 0; j < N; ++j)
    for (int i = 0; i < N; ++i) rise[i] += c->by_point[j][i] * p->slope[j];
  for (int i = 0; i < N; ++i) q->rise[i] = h * rise[i], p->phi[i] = p->phi0 + q->rise[i];
}

/* One step of Newton for the slopes; returns the change of phi [rad], not finite if the matrix is singular. */
WIDE_VECTORS static double newton_step(const collocation *c, planar_panel *p, panel_points *q)
{
  const double h = p->to - p->from, *restrict u = q->at.du[0], *restrict v = q->at.du[1];
  double A[N][N + 2], cosine[N], sine[N], pull[N], turn[N], moved = 0;
  turn_all(p->phi0, q->cosine, q->sine, q->rise, cosine, sine);
  for (int i = 0; i < N; ++i) {
    pull[i] = u[i] * cosine[i] + v[i] * sine[i];
    turn[i] = v[i] * cosine[i] - u[i] * sine[i] - q->at.R[i] * p->slope[i];
    q->speed[i] = pull[i] - q->at.dR[i];
  }
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) A[i][j] = h * pull[i] * c->a[i][j];
    A[i][i] += q->at.R[i];
    A[i][N] = turn[i];
    A[i][N + 1] = -pull[i];
  }
  /* Gauss's elimination: A x = b for both right-hand sides, the last two columns, in place. Without row exchanges: A is
   * a diagonal >= 0 plus Radau's matrix with rows multiplied by numbers > 0 while it slips, for which elimination is
   * stable. If not, Newton fails, and a narrower panel is tried, whose diagonal has more weight. */
  double inverse[N];
  for (int k = 0; k < N; ++k) {
    inverse[k] = 1 / A[k][k];
    for (int i = k + 1; i < N; ++i) subtract_row(A[i][k] * inverse[k], A[k], A[i]);
  }
  for (int k = N - 1; k >= 0; --k) {
    A[k][N] *= inverse[k], A[k][N + 1] *= inverse[k];
    for (int i = 0; i < k; ++i) A[i][N] -= A[i][k] * A[k][N], A[i][N + 1] -= A[i][k] * A[k][N + 1];
  }
  p->growth = 1;
  for (int i = 0; i < N; ++i) {
    p->slope[i] += A[i][N];
    moved += h * fabs(A[i][N]); /* a sum keeps NaN, a maximum may not */
    p->slope_growth[i] = A[i][N + 1];
    p->growth += h * c->a[N - 1][i] * A[i][N + 1];
  }
  set_angles(c, p, q);
  return moved;
}

/* Solves the panel from p->from, p->phi0 to p->to, starting with the slopes in p. False if Newton does not converge, or
 * q->mismatch clearly exceeds `hopeless` [rad] on the way. */
static bool make_panel(const collocation *c, const planar_motion *m, double enough, double hopeless, planar_panel *p,
                       panel_points *q)
{
  planar_motion_rates(m, c, p->from, p->to, &q->at);
  memcpy(p->du, q->at.du, sizeof p->du);
  memcpy(p->R, q->at.R, sizeof p->R);
  q->cosine = cos(p->phi0), q->sine = sin(p->phi0);
  set_angles(c, p, q);
  double moved = 1;
  for (int k = 0; k < MAX_NEWTON && moved > enough; ++k) {
    moved = newton_step(c, p, q);
    /* The two last coefficients of the slope, as an angle. */
    double last = 0, before = 0;
    for (int j = 0; j < N; ++j) last += c->mode[N - 1][j] * p->slope[j], before += c->mode[N - 2][j] * p->slope[j];
    q->mismatch = (p->to - p->from) * (fabs(last) + fabs(before)) / (2 * N);
    const double beyond = moved < 1 ? moved * moved : 1; /* [rad] what the next step may still change */
    if (!(q->mismatch <= hopeless + beyond)) return false;
  }
  return moved <= enough;
}

/* Shortens the panel to end at `to`, with slopes interpolated from the present ones as first guess. */
static void shorten(const collocation *c, double to, planar_panel *p)
{
  const double part = (to - p->from) / (p->to - p->from);
  double slope[N];
  collocation_slopes(c, p->slope, 0, part, slope);
  p->to = to;
  for (int i = 0; i < N; ++i) p->slope[i] = isfinite(slope[i]) ? slope[i] : 0;
}

/* ---- where slip ends -------------------------------------------------------------------------------- */

/* s at an angle of the panel, with its derivative. */
static double speed_at(const planar_slip *s, const planar_panel *p, double th, planar_point *at, double *rate)
{
  const double phi = planar_panel_angle(s->c, p, th);
  *at = planar_motion_at(s->m, th);
  *rate = planar_slip_acceleration(s->m, at, phi);
  return planar_slip_speed(at, phi);
}

/* Angle [rad] where s falls through 0, once, in (low, high]. */
static double resting_angle(const planar_slip *s, const planar_panel *p, double low, double high)
{
  planar_point at;
  double th = 0.5 * (low + high);
  for (int i = 0; i < MAX_STEPS && high - low > 4 * DBL_EPSILON * high; ++i) {
    double rate;
    const double speed = speed_at(s, p, th, &at, &rate);
    if (speed > 0) low = th;
    else high = th;
    double next = th - speed / rate;
    if (fabs(next - th) <= 1e-13) return next > low && next <= high ? next : th;
    th = next > low && next < high ? next : 0.5 * (low + high);
  }
  return high;
}

/* The minimum of s in [low, high], given that an inner point has less than both ends; *at_angle: where. */
static double least_speed(const planar_slip *s, const planar_panel *p, double low, double high, double *at_angle)
{
  planar_point at;
  double rate, speed = 0;
  *at_angle = 0.5 * (low + high);
  for (int i = 0; i < MAX_STEPS && high - low > 1e-8 * (p->to - p->from); ++i) {
    *at_angle = 0.5 * (low + high);
    speed = speed_at(s, p, *at_angle, &at, &rate);
    if (rate < 0) low = *at_angle;
    else high = *at_angle;
  }
  return speed;
}

/* True if the parabola through three samples of s falls below half of the middle one, so that the minimum must be
 * computed. For a resolved slope the samples are dense enough for a parabola. */
static bool may_dip(double t0, double s0, double t1, double s1, double t2, double s2)
{
  const double left = (s1 - s0) / (t1 - t0), right = (s2 - s1) / (t2 - t1), bend = (right - left) / (t2 - t0);
  if (!(bend > 0)) return false;
  const double middle = 0.5 * (t0 + t1) - 0.5 * left / bend,
               least = s0 + left * (middle - t0) + bend * (middle - t0) * (middle - t1);
  return !(least > 0.5 * s1);
}

/* *th: where s first falls through 0 on the panel; first: s at p->from. False if it does not. */
static bool comes_to_rest(const planar_slip *s, const planar_panel *p, const panel_points *q, double first, double *th)
{
  const double noise = 16 * DBL_EPSILON * (s->m->of_u[1] + s->m->of_R[1]);
  double t[N + 1], speed[N + 1];
  t[0] = p->from, speed[0] = first;
  for (int i = 0; i < N; ++i) t[i + 1] = q->at.th[i], speed[i + 1] = q->speed[i];
  for (int i = 1; i <= N; ++i) {
    if (speed[i] < -noise) {
      *th = resting_angle(s, p, t[i - 1], t[i]);
      return true;
    }
    const bool lowest = i < N && speed[i] <= speed[i - 1] && speed[i] <= speed[i + 1];
    double angle = t[i];
    if (lowest && may_dip(t[i - 1], speed[i - 1], t[i], speed[i], t[i + 1], speed[i + 1]) &&
        least_speed(s, p, t[i - 1], t[i + 1], &angle) < -noise) {
      *th = resting_angle(s, p, t[i - 1], angle);
      return true;
    }
  }
  return false;
}

/* ---- panel by panel ---------------------------------------------------------------------------------- */

/* [rad] The widest panel: integrands are products of phi with harmonics, up to 3 n_harm in all; the rule, of degree 2 n
 * - 2, integrates them to rounding if their phase varies by at most 4 rad to either side of the middle. */
static double widest(const planar_motion *m) { return 8.0 / (3 * m->n_harm); }

/* [rad] Width of the next panel, at most 1.5 times the extrapolated distance to s = 0. */
static double width_to_try(const planar_slip *s, const planar_point *at, double phi, double left)
{
  double width = s->width > 0 ? s->width : 0.5 * widest(s->m);
  const double speed = planar_slip_speed(at, phi), rate = planar_slip_acceleration(s->m, at, phi);
  if (rate < 0 && speed > 0) width = fmin(width, fmax(least_width, -1.5 * speed / rate));
  if (s->part < 1) width = fmin(width, s->part * left);
  return width < 0.95 * left ? width : left;
}

/* [1] Weight of a panel's error in the integral of the force, relative to a panel at the largest force. */
static double share(const planar_slip *s, const planar_point *at, double left, bool lifts_off)
{
  const double R = s->m->of_R[0];
  return lifts_off && at->dR < 0 ? fmin(1, fabs(at->R) / R * left) : 1;
}

/* phi'' from the equation, differentiated once; 0 where it is singular. */
static double bend_at(const planar_motion *m, const planar_point *at, double phi, double slope)
{
  if (is_singular(m, at)) return 0;
  return (turned(at->ddu, phi) - (along(at->du, phi) + at->dR) * slope) / at->R;
}

/* First guess of the slopes from phi' and phi'' at the panel's beginning. */
static void guess_from_start(const planar_slip *s, const planar_point *at, double phi, planar_panel *p)
{
  const double first = planar_slip_slope(s->m, at, phi), bend = bend_at(s->m, at, phi, first);
  for (int i = 0; i < N; ++i) p->slope[i] = first + bend * (p->to - p->from) * s->c->x[i];
}

/* [rad] Step of Newton at which it stops: the next one would be about its square. */
static double enough(const planar_slip *s) { return s->resolved > PLANAR_RESOLVED ? 1e-3 : 1e-7; }

/* The next panel with its points, made and resolved. */
static hc_status next_panel(planar_slip *s, const planar_point *at, double phi, double to, bool lifts_off,
                            panel_points *q)
{
  const double left = to - at->th;
  if (s->n == s->cap) return HC_CHATTER;
  planar_panel *p = &s->panel[s->n];
  const double allowed = s->resolved / sqrt(share(s, at, left, lifts_off));
  double width = width_to_try(s, at, phi, left);
  *p = (planar_panel){.from = at->th, .to = width < left ? at->th + width : to, .phi0 = phi};
  /* First guess where slip continues: the slopes of the panel before, extrapolated if not too far. */
  const planar_panel *before = s->n > 0 ? p - 1 : p;
  const bool goes_on = s->n > 0 && before->to == p->from && before->phi[N - 1] == p->phi0;
  const double ratio = (p->to - p->from) / (before->to - before->from);
  if (goes_on && ratio < 3) collocation_slopes(s->c, before->slope, 1, ratio, p->slope);
  else guess_from_start(s, at, phi, p);
  for (int tries = 0;; ++tries) {
    const bool made = make_panel(s->c, s->m, enough(s), width > least_width ? allowed : INFINITY, p, q);
    const double factor = isfinite(q->mismatch) ? 0.9 * pow(allowed / (q->mismatch + 1e-300), 1.0 / N) : 0.25;
    if ((made && q->mismatch <= allowed) || width <= least_width) {
      if (tries == 0) s->part = fmin(1, 1.5 * s->part);
      if (width < left || tries == 0) s->width = fmin(widest(s->m), width * fmin(2.5, factor));
      return HC_OK;
    }
    width *= fmax(0.1, fmin(0.8, factor));
    if (lifts_off && width > 0.75 * left) width = 0.75 * left;
    if (lifts_off) s->part = width / left;
    shorten(s->c, at->th + width, p);
    if (!(q->mismatch < 1e-3)) guess_from_start(s, at, phi, p);
  }
}

hc_status planar_slip_follow(planar_slip *s, const planar_point *from, double phi, double to, bool lifts_off,
                             slip_end *end)
{
  panel_points q;
  s->part = 1;
  *end = (slip_end){*from, phi, false};
  while (end->at.th < to && !end->rests) {
    const hc_status st = next_panel(s, &end->at, end->phi, to, lifts_off, &q);
    if (st != HC_OK) return st;
    planar_panel *p = &s->panel[s->n++];
    double rest;
    end->rests = comes_to_rest(s, p, &q, planar_slip_speed(&end->at, end->phi), &rest);
    if (end->rests) shorten(s->c, rest, p);
    if (end->rests && !make_panel(s->c, s->m, enough(s), INFINITY, p, &q)) return HC_NOT_CONVERGED;
    end->at = planar_motion_at(s->m, p->to);
    end->phi = p->phi[N - 1];
  }
  return HC_OK;
}
