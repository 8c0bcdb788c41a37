/* transitions.c - see transitions.h. A period is scanned from one change of state to the next; the search for one
 * crossing is numerics/crossing.c's. */
#include "hbm/contact/transitions.h"

#include <float.h>
#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/crossing.h"

/* One contact while its period is scanned. */
typedef struct scan {
  const series_grid *grid;
  const moving_contact *c;
  guard normal;         /* g; touch-down is where -g falls through 0 */
  guard stick[2];       /* p_s = mu kn (v + gap) - s kt u: q_s without s held; s = +1, -1 */
  guard slip[2];        /* r_s */
  bool friction;        /* stick and slip are set: the contact has a tangential force */
  contact_interval now; /* the interval under way, but for its end */
  bool recording;       /* intervals go into interval[cap], n so far */
  contact_interval *interval;
  int n, cap;
} scan;

/* Index into stick[] and slip[]. */
static int sign_index(int s) { return s < 0; }

static guard make_guard(const scan *w, int order, double of_u, double of_v, double constant)
{
  double a[SERIES_MAX_DIM] = {0};
  for (int d = 0; d < w->grid->m.dim; ++d) a[d] = of_u * w->c->cu[d] + of_v * w->c->cv[d];
  guard g = guard_make(&w->grid->m, order, a, constant);
  /* The parts of u and v may cancel (kt cos = mu kn sin). Rounding is relative to the parts, of the values and, for the
   * error of the angle, of the derivatives. */
  double parts = 16 * fabs(constant);
  for (int d = 0; d < w->grid->m.dim; ++d) {
    double weight = fabs(of_u * w->c->cu[d]) + fabs(of_v * w->c->cv[d]);
    parts += weight * (16 * w->grid->size[order][d] + 32 * w->grid->size[order + 1][d]);
  }
  g.noise = fmax(g.noise, DBL_EPSILON * parts);
  return g;
}

static void make_guards(scan *w)
{
  const contact *law = &w->c->law;
  const double friction = law->mu * law->kn, always_closed = 1;
  w->normal = make_guard(w, 0, 0, law->load > 0 ? 0 : 1, law->load > 0 ? always_closed : law->gap);
  w->friction = contact_has_friction(law);
  if (!w->friction) return;
  for (int s = 1; s >= -1; s -= 2) {
    w->stick[sign_index(s)] = make_guard(w, 0, -s * law->kt, friction, friction * law->gap + law->mu * law->load);
    w->slip[sign_index(s)] = make_guard(w, 1, s * law->kt, -friction, 0);
  }
}

/* q_s for the slider where it is now. */
static guard stick_guard(const scan *w, int s)
{
  guard q = w->stick[sign_index(s)];
  q.constant += s * w->now.held;
  return q;
}

static hc_status close_interval(scan *w, double to)
{
  if (!w->recording || !(to > w->now.from)) return HC_OK;
  if (w->n == w->cap) return HC_CHATTER;
  w->interval[w->n] = w->now;
  w->interval[w->n++].to = to;
  return HC_OK;
}

/* held where slip with sign s, or the limit |T| = mu N, is reached: q_s = 0, so held = -s p_s. */
static double held_at_limit(const scan *w, int s, const series_node *at)
{
  return -s * guard_value(&w->stick[sign_index(s)], at);
}

/* The slider comes to rest at `at` after slipping with sign s. */
static void come_to_rest(scan *w, int s, const series_node *at)
{
  const contact *law = &w->c->law;
  w->now.held = held_at_limit(w, s, at);
  w->now.origin = at->th;
  for (int d = 0; d < w->grid->m.dim; ++d)
    w->now.held_by_x[d] = law->kt * w->c->cu[d] - s * law->mu * law->kn * w->c->cv[d];
}

/* First angle in (a, b] where the state ends, in contact: slip with *sign, or stick by slip with *sign. */
static bool first_change(const scan *w, const series_node *a, const series_node *b, series_node *root, int *sign)
{
  const series_vector *m = &w->grid->m;
  *sign = contact_slip_sign(w->now.state);
  if (*sign) return crossing_first(m, &w->slip[sign_index(*sign)], a, b, root);
  guard plus = stick_guard(w, 1), minus = stick_guard(w, -1);
  series_node earlier;
  bool found = crossing_first(m, &plus, a, b, root);
  bool found_minus = crossing_first(m, &minus, a, found ? root : b, &earlier);
  *sign = found_minus ? -1 : 1;
  if (found_minus) *root = earlier;
  return found || found_minus;
}

enum { MAX_CHANGES_AT_ANGLE = 3, MAX_CHANGES_PER_HARMONIC = 64 };

/* From a to b, neighbouring nodes, in contact all the way. */
static hc_status scan_interval(scan *w, series_node a, const series_node *b)
{
  hc_status st = HC_OK;
  double last_root = -1;
  int repeated = 0; /* changes in a row, each located no later than the one before it */
  while (st == HC_OK && a.th < b->th) {
    series_node root;
    int s;
    if (!first_change(w, &a, b, &root, &s)) return HC_OK;
    repeated = root.th > last_root ? 0 : repeated + 1;
    last_root = root.th;
    if (repeated > MAX_CHANGES_AT_ANGLE) {
      /* Where T, N and their rates are all 0 to rounding at angle th, which state follows cannot be told there. It
       * can a little later, where they are still small: the scan goes on from that angle, a stuck slider in the
       * middle of its limits. */
      const double little = 1e-8;
      series_node later = series_vector_at(&w->grid->m, fmin(last_root + little, b->th));
      if (!contact_slip_sign(w->now.state))
        w->now.held = 0.5 * (guard_value(&w->stick[1], &later) - guard_value(&w->stick[0], &later));
      a = later;
      continue;
    }
    a = root;
    if (++w->now.transitions > MAX_CHANGES_PER_HARMONIC * (w->grid->m.n_harm + 1)) return HC_CHATTER;
    bool returns = !contact_slip_sign(w->now.state) && guard_value(&w->slip[sign_index(s)], &root) <= 0;
    /* |T| exceeds mu N by rounding and decreases already, as where T and N vanish together: stick goes on with the
     * slider moved to the limit. */
    if (returns && repeated == 0) w->now.held = held_at_limit(w, s, &root);
    else {
      /* Slip with sign s ends at `at` in stick, or stick in slip with sign s. */
      st = close_interval(w, root.th);
      w->now.from = root.th;
      if (contact_slip_sign(w->now.state)) {
        come_to_rest(w, s, &root);
        w->now.state = CONTACT_STICK;
      } else {
        w->now.state = s > 0 ? CONTACT_SLIP_PLUS : CONTACT_SLIP_MINUS;
      }
    }
  }
  return st;
}

/* The grid node after angle th. */
static const series_node *node_after(const scan *w, double th)
{
  const series_node *node = w->grid->node + (int)(th * (SERIES_GRID / TWO_PI));
  while (node->th <= th) ++node;
  return node;
}

/* From a to b, grid nodes in between, in contact all the way. */
static hc_status scan_contact(scan *w, const series_node *a, const series_node *b)
{
  hc_status st = HC_OK;
  if (!w->friction) return HC_OK;
  for (const series_node *next = node_after(w, a->th); st == HC_OK && a->th < b->th; a = next++) {
    if (next->th >= b->th) return scan_interval(w, *a, b);
    st = scan_interval(w, *a, next);
  }
  return st;
}

/* The state of a contact that carries no tangential force: T = kt u with kt = 0, or mu N with mu = 0. */
static contact_state frictionless(const contact *law) { return law->kt > 0 ? CONTACT_SLIP_PLUS : CONTACT_STICK; }

/* First angle in [a, until) where the guard falls through 0, over grid nodes. */
static bool first_over_grid(const scan *w, const guard *g, const series_node *a, double until, series_node *root)
{
  for (const series_node *next = node_after(w, a->th); a->th < until; a = next++)
    if (crossing_first(&w->grid->m, g, a, next, root)) return root->th < until;
  return false;
}

/* Contact is lost somewhere: one period from an angle of separation, from each touch-down to the next lift-off. */
static hc_status scan_with_separations(scan *w, series_node a)
{
  guard separated = guard_negative(&w->normal); /* positive while separated */
  double end = a.th + TWO_PI;
  hc_status st = HC_OK;
  series_node on, off;
  w->recording = true;
  while (st == HC_OK && first_over_grid(w, &separated, &a, end, &on)) {
    /* Touch-down at `at`: T = N = 0 and w = u, in stick or in slip by the velocities there. */
    const contact *law = &w->c->law;
    double u = 0, du = 0, dv = 0;
    for (int d = 0; d < w->grid->m.dim; ++d) {
      u += w->c->cu[d] * on.d[0][d];
      du += w->c->cu[d] * on.d[1][d];
      dv += w->c->cv[d] * on.d[1][d];
    }
    w->now.from = w->now.origin = on.th;
    w->now.held = law->kt * u;
    w->now.state = w->friction ? contact_on_touch(law, du, dv) : frictionless(law);
    /* d held = kt (du_origin + u' d th); the angle of touch-down moves by d th = -dv_origin/v' */
    double u_per_v = dv > 0 ? du / dv : 0;
    for (int d = 0; d < w->grid->m.dim; ++d) {
      double fixed_angle = w->c->cu[d], moved_angle = u_per_v * w->c->cv[d], sum = fixed_angle - moved_angle;
      w->now.held_by_x[d] = fabs(sum) > 4 * DBL_EPSILON * fabs(fixed_angle) ? law->kt * sum : 0;
    }
    if (!first_over_grid(w, &w->normal, &on, end, &off)) { /* by rounding: the end is an angle of separation */
      off = a;
      off.th = end;
    }
    st = scan_contact(w, &on, &off);
    if (st == HC_OK) st = close_interval(w, off.th);
    a = off;
  }
  return st;
}

/* Contact is never lost: a first period from w = rest settles the slider (a period maps w like a clamp, README.md), the
 * second is recorded. */
static hc_status scan_without_separation(scan *w)
{
  const series_node *start = &w->grid->node[0], *end = &w->grid->node[SERIES_GRID];
  double low = -guard_value(&w->stick[0], start), high = guard_value(&w->stick[1], start);
  w->now.state = w->friction ? CONTACT_STICK : frictionless(&w->c->law);
  const double asked = w->c->law.kt * w->c->rest;
  w->now.held = w->friction ? fmin(fmax(asked, low), high) : 0;
  if (w->now.held != asked) come_to_rest(w, low > asked ? 1 : -1, start);
  hc_status st = scan_contact(w, start, end);
  contact_interval settled = w->now;
  w->recording = true;
  w->now.from = 0;
  w->now.transitions = 0;
  w->now.origin -= w->now.origin >= TWO_PI ? TWO_PI : 0;
  if (st == HC_OK) st = scan_contact(w, start, end);
  if (st == HC_OK) st = close_interval(w, TWO_PI);
  if (st != HC_OK) return st;
  bool same_held = fabs(w->now.held - settled.held) <= 1e-11 * guard_scale(&w->stick[0]);
  bool closed = w->now.state == settled.state && (settled.state != CONTACT_STICK || same_held);
  return closed ? HC_OK : HC_NOT_CLOSED;
}

/* An angle of the first period at which the contact is separated. */
static bool find_separation(const scan *w, series_node *apart)
{
  const series_grid *grid = w->grid;
  if (!(guard_lower(&w->normal) < 0)) return false;
  for (int i = 0; i < SERIES_GRID; ++i)
    if (guard_value(&w->normal, &grid->node[i]) < 0) {
      *apart = grid->node[i];
      return true;
    }
  return first_over_grid(w, &w->normal, &grid->node[0], TWO_PI, apart);
}

hc_status transitions_find(const series_grid *grid, const moving_contact *c, int cap, contact_interval *interval,
                           int *n)
{
  scan w = {.grid = grid, .c = c, .interval = interval, .cap = cap};
  *n = 0;
  if (!(c->law.kn > 0 || c->law.load > 0)) return HC_OK;
  make_guards(&w);
  bool finite = !w.friction || isfinite(guard_scale(&w.stick[0]) + guard_scale(&w.slip[0]));
  if (!finite) return HC_NOT_FINITE;
  if (guard_upper(&w.normal) <= 0) return HC_OK; /* never touches, whatever the phase */
  series_node apart;
  hc_status st = find_separation(&w, &apart) ? scan_with_separations(&w, apart) : scan_without_separation(&w);
  *n = w.n;
  return st;
}

contact_report transitions_report(int n, const contact_interval *interval)
{
  contact_report r = {.regime = CONTACT_LINEAR};
  double touching = 0;
  bool slips = false;
  for (int i = 0; i < n; ++i) {
    /* An interval is followed by another one (one change, or none if both are parts of the same state), or by a
     * separation and then an interval (two). */
    const contact_interval *p = &interval[i], *next = &interval[(i + 1) % n];
    const bool meets = next->from == p->to || next->from == p->to - TWO_PI;
    touching += p->to - p->from;
    slips |= contact_slip_sign(p->state) != 0;
    r.transitions += meets ? next->state != p->state : 2;
  }
  if (n == 0) return r;
  r.regime = touching < TWO_PI * (1 - 1e-15) ? CONTACT_SEPARATES : slips ? CONTACT_SLIPS : CONTACT_STUCK;
  r.free_sliders = r.regime == CONTACT_STUCK;
  return r;
}

const contact_interval *contact_interval_at(int n, const contact_interval *interval, double th)
{
  for (int i = 0; i < n; ++i)
    for (int turn = -1; turn <= 1; ++turn)
      if (th + turn * TWO_PI >= interval[i].from && th + turn * TWO_PI <= interval[i].to) return &interval[i];
  return NULL;
}

double contact_interval_traction(const contact *law, const contact_interval *at, double u, double normal)
{
  if (!at) return 0;
  return at->state == CONTACT_STICK ? law->kt * u - at->held : contact_slip_sign(at->state) * law->mu * normal;
}
