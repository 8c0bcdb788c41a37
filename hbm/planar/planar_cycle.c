/* planar_cycle.c - see planar_cycle.h. */
#include "hbm/planar/planar_cycle.h"

#include <float.h>
#include <string.h>

#include "numerics/base/constants.h"

enum { N = COLLOCATION_POINTS };

/* ---- the last step, to first order ------------------------------------------------------------------------ */

/* When a pass nearly closes, it is corrected to the closed orbit by the variational equations of the force's
 * derivatives (planar_force.c): w while it sticks, phi while it slips. A correction by d leaves an error of about d^2
 * in phi; ends of intervals are not moved, and integrals over intervals err by d^2, too, since the force is continuous
 * there. [rad] The largest correction of phi: */
static const double SHIFT_MOST = 3e-9;

/* d phi = -e_perp.dw/length, u - w having this length and the direction phi. */
static double turn(double phi, double length, const double dw[2])
{
  return (dw[0] * sin(phi) - dw[1] * cos(phi)) / length;
}

/* d w = -R e_perp d phi. */
static void swing(double phi, double R, double dphi, double dw[2])
{
  dw[0] = R * sin(phi) * dphi;
  dw[1] = -R * cos(phi) * dphi;
}

/* Carries dw or *dphi into interval i, from the start of the period or from the previous interval. */
static void shift_into(const planar_cycle *c, int i, double dw[2], double *dphi)
{
  const planar_interval *p = &c->interval[i];
  const bool slips = p->state != CONTACT_STICK;
  if (p->begin == PLANAR_STARTS) {
    const planar_point *at = &c->grid[0];
    const double t1 = at->u[0] - c->start[0], t2 = at->u[1] - c->start[1], length = hypot(t1, t2), phi = atan2(t2, t1);
    if (!slips && !(length > at->R)) return;
    *dphi = turn(phi, length, dw);
    if (!slips) swing(phi, at->R, *dphi, dw);
  } else if (p->state != p[-1].state) {
    const double R = planar_motion_at(c->m, p->from).R;
    const planar_panel *first = c->slip.panel + p->panel;
    if (slips) *dphi = turn(first->phi0, R, dw);
    else swing(p[-1].n_panels > 0 ? c->slip.panel[p[-1].panel + p[-1].n_panels - 1].phi[N - 1] : 0, R, *dphi, dw);
  }
}

/* Changes phi of a panel by dphi at its beginning; returns the change at its end. */
static double move_panel(const collocation *c, planar_panel *p, double dphi)
{
  const double h = p->to - p->from;
  double grown[N];
  for (int i = 0; i < N; ++i) grown[i] = 1;
  for (int j = 0; j < N; ++j)
    for (int i = 0; i < N; ++i) grown[i] += h * c->by_point[j][i] * p->slope_growth[j];
  p->phi0 += dphi;
  for (int i = 0; i < N; ++i) {
    p->phi[i] += dphi * grown[i];
    p->slope[i] += dphi * p->slope_growth[i];
  }
  return dphi * p->growth;
}

/* Corrects the last pass, always in contact, for a change dw0 [length] of its start. False, and nothing is changed, if
 * phi would change by more than SHIFT_MOST. */
static bool shift_pass(planar_cycle *c, const double dw0[2])
{
  double dw[2] = {dw0[0], dw0[1]}, dphi = 0;
  /* A pass does not increase distances, so w changes by no more than its start. */
  for (int i = 0; i < c->n; ++i) {
    const planar_interval *p = &c->interval[i];
    if (p->state == CONTACT_STICK) continue;
    const double R = planar_motion_at(c->m, p->from).R;
    if (!(hypot(dw[0], dw[1]) <= SHIFT_MOST * R)) return false;
  }
  for (int i = 0; i < c->n; ++i) {
    planar_interval *p = &c->interval[i];
    shift_into(c, i, dw, &dphi);
    for (int d = 0; d < 2 && p->state == CONTACT_STICK; ++d) p->w[d] += dw[d];
    for (int k = p->panel; k < p->panel + p->n_panels; ++k) dphi = move_panel(c->slip.c, &c->slip.panel[k], dphi);
  }
  for (int d = 0; d < 2; ++d) c->start[d] += dw0[d];
  return true;
}

enum { MAX_CHANGES_PER_HARMONIC = 64, MAX_CHANGES_AT_ANGLE = 3, MAX_NEWTON = 20, MAX_PASSES = 100 };

/* The slider during a pass. */
typedef struct slider {
  bool slips;
  double w[2], dw[2][2]; /* while it sticks: position and d w/d w0 */
  double phi, dphi[2];   /* while it slips: direction and d phi/d w0 */
  double way[2];         /* displacement of w since th = 0, integrated from its rate */
  planar_begin begin;    /* start of the current interval */
} slider;

/* ---- changes of state ------------------------------------------------------------------------------ */

/* Slip begins: phi is the direction of u - w, d phi = -e_perp . dw/length with length = |u - w|. */
static void set_direction(slider *k, const planar_point *at)
{
  const double t1 = at->u[0] - k->w[0], t2 = at->u[1] - k->w[1], length = hypot(t1, t2);
  k->phi = atan2(t2, t1);
  for (int j = 0; j < 2; ++j) k->dphi[j] = length > 0 ? (t2 * k->dw[0][j] - t1 * k->dw[1][j]) / (length * length) : 0;
}

/* w = u - R e. */
static void set_position(slider *k, const planar_point *at)
{
  const double cosine = cos(k->phi), sine = sin(k->phi);
  k->w[0] = at->u[0] - at->R * cosine;
  k->w[1] = at->u[1] - at->R * sine;
  for (int j = 0; j < 2; ++j) {
    k->dw[0][j] = at->R * sine * k->dphi[j];
    k->dw[1][j] = -at->R * cosine * k->dphi[j];
  }
}

/* True if a slider at the limit slips: s > 0, or s = 0 to rounding and s' > 0. */
static bool slips_at_limit(const planar_cycle *c, const planar_point *at, double phi)
{
  const double noise = 16 * DBL_EPSILON * (c->m->of_u[1] + c->m->of_R[1]), speed = planar_slip_speed(at, phi);
  return speed > noise || (speed > -noise && planar_slip_acceleration(c->m, at, phi) > 0);
}

/* Stick has reached its limit at `at`: slip, or stick with the slider moved to the limit where |u - w| exceeds it by
 * rounding and decreases already. */
static void leave_stick(const planar_cycle *c, slider *k, const planar_point *at)
{
  const double dw[2][2] = {{k->dw[0][0], k->dw[0][1]}, {k->dw[1][0], k->dw[1][1]}};
  set_direction(k, at);
  k->slips = slips_at_limit(c, at, k->phi);
  if (k->slips) return;
  set_position(k, at);
  memcpy(k->dw, dw, sizeof dw);
}

/* State at th = 0 from w, moved into the circle. */
static void start(const planar_cycle *c, slider *k, const double w[2])
{
  const planar_point *at = &c->grid[0];
  *k = (slider){.begin = PLANAR_STARTS, .w = {w[0], w[1]}, .dw = {{1, 0}, {0, 1}}};
  const double beyond = hypot(at->u[0] - w[0], at->u[1] - w[1]) - at->R;
  if (beyond < -4 * planar_motion_noise(c->m)) return;
  set_direction(k, at);
  k->slips = slips_at_limit(c, at, k->phi);
  if (k->slips || beyond > 0) set_position(k, at);
}

/* ---- from change to change --------------------------------------------------------------------------- */

static hc_status close_interval(planar_cycle *c, slider *k, double from, double to, int first_panel)
{
  if (!(to > from)) return HC_OK;
  if (c->n == c->cap) return HC_CHATTER;
  c->interval[c->n++] = (planar_interval){.from = from,
                                          .to = to,
                                          .state = k->slips ? CONTACT_SLIP_PLUS : CONTACT_STICK,
                                          .begin = k->begin,
                                          .w = {k->w[0], k->w[1]},
                                          .panel = first_panel,
                                          .n_panels = k->slips ? c->slip.n - first_panel : 0};
  k->begin = PLANAR_GOES_ON;
  return HC_OK;
}

/* Stick from *at to its end; *at moves there. */
static hc_status stick(planar_cycle *c, slider *k, planar_point *at, double to)
{
  planar_point root;
  const bool ends = planar_stick_ends(c->m, c->grid, k->w, at, to, &root);
  const hc_status st = close_interval(c, k, at->th, ends ? root.th : to, 0);
  if (ends) *at = root;
  else *at = planar_motion_at(c->m, to);
  if (ends) leave_stick(c, k, at);
  return st;
}

/* way += integral of s e over a panel. */
static void add_way(const planar_cycle *c, const planar_panel *p, double way[2])
{
  const double width = p->to - p->from;
  double cosine[N], sine[N];
  planar_rates r;
  planar_panel_directions(p, cosine, sine);
  planar_motion_rates(c->m, c->slip.c, p->from, p->to, &r);
  for (int i = 0; i < N; ++i) {
    const double path = width * c->slip.c->a[N - 1][i] * (r.du[0][i] * cosine[i] + r.du[1][i] * sine[i] - r.dR[i]);
    way[0] += path * cosine[i];
    way[1] += path * sine[i];
  }
}

static hc_status slip(planar_cycle *c, slider *k, planar_point *at, double to)
{
  const int first = c->slip.n;
  slip_end end;
  hc_status st = planar_slip_follow(&c->slip, at, k->phi, to, !c->always, &end);
  if (st == HC_OK) st = close_interval(c, k, at->th, end.at.th, first);
  for (int i = first; i < c->slip.n; ++i) {
    for (int j = 0; j < 2; ++j) k->dphi[j] *= c->slip.panel[i].growth;
    add_way(c, &c->slip.panel[i], k->way);
  }
  *at = end.at;
  k->phi = end.phi;
  k->slips = !end.rests;
  if (end.rests) set_position(k, at);
  return st;
}

/* Where u - w, R and their rates are 0 to rounding the next state cannot be decided: the search continues a little
 * later, sticking, with the slider moved into the circle. */
static void skip_degenerate(const planar_cycle *c, slider *k, planar_point *at, double to)
{
  const double little = 1e-8;
  if (k->slips) set_position(k, at);
  *at = planar_motion_at(c->m, fmin(at->th + little, to));
  k->slips = false;
  if (!(hypot(at->u[0] - k->w[0], at->u[1] - k->w[1]) > at->R)) return;
  set_direction(k, at);
  set_position(k, at);
}

/* In contact from *at to the angle `to`. */
static hc_status follow(planar_cycle *c, slider *k, planar_point at, double to)
{
  hc_status st = HC_OK;
  for (int repeated = 0; st == HC_OK && at.th < to;) {
    const double before = at.th;
    st = k->slips ? slip(c, k, &at, to) : stick(c, k, &at, to);
    repeated = at.th - before > 4 * DBL_EPSILON * (1 + before) ? 0 : repeated + 1;
    if (repeated > MAX_CHANGES_AT_ANGLE) skip_degenerate(c, k, &at, to);
    if (++c->changes > MAX_CHANGES_PER_HARMONIC * (c->m->n_harm + 1)) st = HC_CHATTER;
  }
  if (k->slips) set_position(k, &at);
  return st;
}

/* ---- passes ------------------------------------------------------------------------------------------ */

static void begin_pass(planar_cycle *c)
{
  c->n = 0;
  c->slip.n = 0;
  c->changes = 0;
}

/* One pass from w0, which becomes the slider at its end; A[row][col] = d(that)/d w0. moved: end - w0, by integrating
 * the rate of w if w0 was not moved into the circle: more accurate than the difference when small. */
static hc_status go_round(planar_cycle *c, double w[2], double A[2][2], double moved[2])
{
  slider k;
  begin_pass(c);
  c->start[0] = w[0], c->start[1] = w[1];
  start(c, &k, w);
  const bool jumped = k.slips || k.w[0] != w[0] || k.w[1] != w[1];
  const hc_status st = follow(c, &k, c->grid[0], TWO_PI);
  for (int d = 0; d < 2; ++d) {
    moved[d] = jumped ? k.w[d] - w[d] : k.way[d];
    w[d] = k.w[d];
  }
  memcpy(A, k.dw, sizeof k.dw);
  return st;
}

static hc_status follow_contacts(planar_cycle *c)
{
  hc_status st = HC_OK;
  begin_pass(c);
  for (int i = 0; i < c->n_contacts && st == HC_OK; ++i) {
    const planar_point at = planar_motion_at(c->m, c->contact[i].from);
    slider k = {.begin = PLANAR_TOUCHES,
                .w = {at.u[0], at.u[1]},
                .slips = hypot(at.du[0], at.du[1]) > at.dR,
                .phi = atan2(at.du[1], at.du[0])};
    st = follow(c, &k, at, c->contact[i].to);
  }
  return st;
}

/* [length] */
static double size_of(const planar_cycle *c) { return c->m->of_u[0] + c->m->of_R[0]; }

static double length_of(const double x[2]) { return hypot(x[0], x[1]); }

typedef struct closing {
  double w[2], end[2], distance; /* [length] start of a pass, its end, and their distance */
  double step[2];                /* [length] Newton's step from w, or end - w */
  double left;                   /* [1] bound of the derivative of the end by the start */
} closing;

static hc_status try_from(planar_cycle *c, const double w[2], closing *out)
{
  double A[2][2], end[2] = {w[0], w[1]}, moved[2];
  const hc_status st = go_round(c, end, A, moved);
  *out = (closing){.w = {w[0], w[1]}, .end = {end[0], end[1]}, .step = {moved[0], moved[1]}};
  out->distance = hypot(out->step[0], out->step[1]);
  out->left = hypot(hypot(A[0][0], A[0][1]), hypot(A[1][0], A[1][1]));
  /* Newton's step (1 - A)^-1 step; the plain step if that does not exist, or is longer than size_of(c). */
  const double a = 1 - A[0][0], b = -A[0][1], d = -A[1][0], e = 1 - A[1][1], det = a * e - b * d;
  const double x = (e * out->step[0] - b * out->step[1]) / det, y = (a * out->step[1] - d * out->step[0]) / det;
  if (fabs(det) > DBL_EPSILON && hypot(x, y) <= size_of(c)) out->step[0] = x, out->step[1] = y;
  return st;
}

/* Newton from the last pass until its step is rounding. A step that does not shrink is halved, unless the pass closes
 * to `enough`. Progress is judged by the step, not by end - w: at the onset of slip a pass moves w little, wherever it
 * starts. */
static hc_status close_by_newton(planar_cycle *c, closing *now, bool *closed)
{
  const double rounding = 64 * DBL_EPSILON * size_of(c), enough = 1e-11 * size_of(c);
  closing next;
  hc_status st = HC_OK;
  *closed = false;
  for (int i = 0; i < MAX_NEWTON && st == HC_OK && length_of(now->step) > rounding; ++i) {
    const bool last_pass = c->start[0] == now->w[0] && c->start[1] == now->w[1], forgets = now->left <= 0.5;
    *closed = c->may_shift && last_pass && forgets && shift_pass(c, now->step);
    if (*closed) return HC_OK;
    st = try_from(c, (double[2]){now->w[0] + now->step[0], now->w[1] + now->step[1]}, &next);
    if (st != HC_OK) return st;
    const bool better = length_of(next.step) < length_of(now->step);
    if (better || !(now->distance <= enough)) *now = next;
    else if (length_of(now->step) <= enough) break;
    else now->step[0] *= 0.5, now->step[1] *= 0.5;
  }
  *closed = st == HC_OK && now->distance <= enough;
  if (*closed && (c->start[0] != now->w[0] || c->start[1] != now->w[1])) st = try_from(c, now->w, now);
  return st;
}

/* Two passes from w, the first with rough panels: the second forgets most of its error. */
static hc_status begin_roughly(planar_cycle *c, const double w[2], closing *last)
{
  c->slip.resolved = PLANAR_ROUGH;
  const hc_status st = try_from(c, w, last);
  c->slip.resolved = PLANAR_RESOLVED;
  c->slip.width *= pow(PLANAR_RESOLVED / PLANAR_ROUGH, 1.0 / COLLOCATION_POINTS);
  return st == HC_OK ? try_from(c, (double[2]){last->end[0], last->end[1]}, last) : st;
}

/* The closed orbit that slips: Newton from the centre found by planar_rest.h, or after further passes where Newton
 * fails. */
static hc_status close_slip(planar_cycle *c)
{
  closing now;
  bool closed = false;
  hc_status st = begin_roughly(c, c->rest.w, &now);
  for (int passes = 0; passes < MAX_PASSES && st == HC_OK && !closed; ++passes) {
    if (passes % 10 == 0) st = close_by_newton(c, &now, &closed);
    if (st == HC_OK && !closed) st = try_from(c, (double[2]){now.end[0], now.end[1]}, &now);
  }
  return st == HC_OK && !closed ? HC_NOT_CLOSED : st;
}

/* ---- rest ---------------------------------------------------------------------------------------------- */

/* Finds c->rest; if it exists, the cycle is one stick interval. */
static hc_status find_rest(planar_cycle *c)
{
  const hc_status st = planar_rest_find(c->m, c->grid, c->asked, &c->rest);
  if (st != HC_OK || !c->rest.exists) return st;
  begin_pass(c);
  c->n = 1;
  c->interval[0] = (planar_interval){.to = TWO_PI, .state = CONTACT_STICK, .w = {c->rest.w[0], c->rest.w[1]}};
  return st;
}

hc_status planar_cycle_find(planar_cycle *c)
{
  c->rest.exists = false;
  c->slip.resolved = PLANAR_RESOLVED;
  if (!c->always) return follow_contacts(c);
  const hc_status st = find_rest(c);
  return st == HC_OK && !c->rest.exists ? close_slip(c) : st;
}

/* ---- what was found ------------------------------------------------------------------------------------ */

void planar_cycle_slider(const planar_cycle *c, double w[2])
{
  const planar_point *zero = &c->grid[0];
  w[0] = zero->u[0], w[1] = zero->u[1];
  for (int i = 0; i < c->n; ++i) {
    const planar_interval *p = &c->interval[i];
    if (p->from > 0 && p->to < TWO_PI) continue;
    if (p->state == CONTACT_STICK) {
      w[0] = p->w[0], w[1] = p->w[1];
      return;
    }
    const double th = p->from > 0 ? TWO_PI : 0;
    for (int k = p->panel; k < p->panel + p->n_panels; ++k) {
      const planar_panel *q = &c->slip.panel[k];
      if (th < q->from || th > q->to) continue;
      const double phi = planar_panel_angle(c->slip.c, q, th);
      w[0] = zero->u[0] - zero->R * cos(phi), w[1] = zero->u[1] - zero->R * sin(phi);
    }
    return;
  }
}
