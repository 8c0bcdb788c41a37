/* transitions.c - see transitions.h: what happens to a contact, in the order it happens. The search for one crossing
 * is numerics/crossing.c's. */
#include "hbm/transitions.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/constants.h"
#include "numerics/crossing.h"

/* Everything about one contact while its period is walked through. */
typedef struct walk {
  const series_grid *grid;
  const moving_contact *c;
  guard normal;      /* g; its negative is searched for touch-down */
  guard stick[2];    /* p_s = mu kn (v + gap) - s kt u, the part of q_s that does not change; s = +1, -1 */
  guard slip[2];     /* r_s */
  contact_piece now; /* the piece under way; from, state, held, origin, held_by_x */
  contact_piece *piece;
  int n, cap;
  bool recording, friction;
} walk;

static int index_of(int s) { return s < 0; }

static guard make_guard(const walk *w, int order, double of_u, double of_v, double constant)
{
  double a[SERIES_MAX_DIM] = {0};
  for (int d = 0; d < w->grid->m.dim; ++d) a[d] = of_u * w->c->cu[d] + of_v * w->c->cv[d];
  guard g = guard_make(&w->grid->m, order, a, constant);
  /* u and v may cancel (kt cos = mu kn sin): rounding is relative to what they were before, and to how far off a
   * touch-down may be located */
  double before = 16 * fabs(constant);
  for (int d = 0; d < w->grid->m.dim; ++d) {
    double weight = fabs(of_u * w->c->cu[d]) + fabs(of_v * w->c->cv[d]);
    before += weight * (16 * w->grid->size[order][d] + 32 * w->grid->size[order + 1][d]);
  }
  g.noise = fmax(g.noise, DBL_EPSILON * before);
  return g;
}

static void make_guards(walk *w)
{
  const contact *law = &w->c->law;
  double friction = law->mu * law->kn;
  w->normal = make_guard(w, 0, 0, 1, law->gap);
  w->friction = friction > 0 && law->kt > 0;
  if (!w->friction) return;
  for (int s = 1; s >= -1; s -= 2) {
    w->stick[index_of(s)] = make_guard(w, 0, -s * law->kt, friction, friction * law->gap);
    w->slip[index_of(s)] = make_guard(w, 1, s * law->kt, -friction, 0);
  }
}

/* q_s for the slider as it is held now. */
static guard held_guard(const walk *w, int s)
{
  guard q = w->stick[index_of(s)];
  q.constant += s * w->now.held;
  return q;
}

static hc_status close_piece(walk *w, double to)
{
  if (!w->recording || !(to > w->now.from)) return HC_OK;
  if (w->n == w->cap) return HC_CHATTER;
  w->piece[w->n] = w->now;
  w->piece[w->n++].to = to;
  return HC_OK;
}

/* The slider comes to rest at `at` after slipping with sign s: held = -s p_s(at). */
static void hold(walk *w, int s, const series_node *at)
{
  const contact *law = &w->c->law;
  w->now.held = -s * guard_value(&w->stick[index_of(s)], at);
  w->now.origin = at->th;
  for (int d = 0; d < w->grid->m.dim; ++d)
    w->now.held_by_x[d] = law->kt * w->c->cu[d] - s * law->mu * law->kn * w->c->cv[d];
}

/* Between two nodes in contact: pieces end where a guard falls through 0. */
static hc_status walk_between(walk *w, series_node a, const series_node *b)
{
  hc_status st = HC_OK;
  double here = -1; /* the last transition's angle, and how many there have been */
  int times = 0;
  while (st == HC_OK && a.th < b->th) {
    series_node root, other;
    int s = contact_slip_sign(w->now.state);
    bool found;
    if (s) {
      found = crossing_first(&w->grid->m, &w->slip[index_of(s)], &a, b, &root);
    } else {
      guard plus = held_guard(w, 1), minus = held_guard(w, -1);
      found = crossing_first(&w->grid->m, &plus, &a, b, &root);
      bool back = crossing_first(&w->grid->m, &minus, &a, found ? &root : b, &other);
      s = back ? -1 : 1;
      if (back) root = other;
      found |= back;
    }
    if (!found) return HC_OK;
    times = root.th > here ? 0 : times + 1;
    here = root.th;
    if (times > 3) { /* T, N and their rates are all 0 to rounding: what follows shows a little later, where they
                        still are */
      a = series_vector_at(&w->grid->m, fmin(here + 1e-8, b->th));
      if (!contact_slip_sign(w->now.state))
        w->now.held = 0.5 * (guard_value(&w->stick[1], &a) - guard_value(&w->stick[0], &a));
      continue;
    }
    a = root;
    if (++w->now.transitions > 64 * (w->grid->m.n_harm + 1)) return HC_CHATTER;
    if (!contact_slip_sign(w->now.state) && guard_value(&w->slip[index_of(s)], &root) <= 0 && times == 0) {
      /* |T| over mu N and coming back: no slip but rounding, as where T and N vanish together. The slider gives way
       * by as much. */
      w->now.held = -s * guard_value(&w->stick[index_of(s)], &root);
      continue;
    }
    st = close_piece(w, root.th);
    w->now.from = root.th;
    if (contact_slip_sign(w->now.state)) {
      hold(w, s, &root);
      w->now.state = CONTACT_STICK;
    } else {
      w->now.state = s > 0 ? CONTACT_SLIP_PLUS : CONTACT_SLIP_MINUS;
    }
  }
  return st;
}

/* The grid node after angle th. */
static const series_node *node_after(const walk *w, double th)
{
  const series_node *node = w->grid->node + (int)(th * (SERIES_GRID / TWO_PI));
  while (node->th <= th) ++node;
  return node;
}

/* From a to b, grid nodes in between, in contact all the way. */
static hc_status walk_contact(walk *w, const series_node *a, const series_node *b)
{
  hc_status st = HC_OK;
  if (!w->friction) return HC_OK;
  for (const series_node *next = node_after(w, a->th); st == HC_OK && a->th < b->th; a = next++) {
    if (next->th >= b->th) return walk_between(w, *a, b);
    st = walk_between(w, *a, next);
  }
  return st;
}

/* The state of a contact that carries no tangential force: T = kt u with kt = 0, or mu N with mu = 0. */
static contact_state frictionless(const contact *law) { return law->kt > 0 ? CONTACT_SLIP_PLUS : CONTACT_STICK; }

/* Touch-down at `at`: T = N = 0 and w = u; slips at once if the slip guard says so. */
static void touch(walk *w, const series_node *at)
{
  const contact *law = &w->c->law;
  double u = 0, du = 0, dv = 0;
  for (int d = 0; d < w->grid->m.dim; ++d) {
    u += w->c->cu[d] * at->d[0][d];
    du += w->c->cu[d] * at->d[1][d];
    dv += w->c->cv[d] * at->d[1][d];
  }
  w->now.from = w->now.origin = at->th;
  w->now.held = law->kt * u;
  w->now.state = w->friction ? contact_on_touch(law, du, dv) : frictionless(law);
  /* d held = kt (du_origin + u' d th), d th = -dv_origin/v' moves with the instant of contact */
  double along = dv > 0 ? du / dv : 0;
  for (int d = 0; d < w->grid->m.dim; ++d) {
    double direct = w->c->cu[d], moved = along * w->c->cv[d];
    w->now.held_by_x[d] = fabs(direct - moved) > 4 * DBL_EPSILON * fabs(direct) ? law->kt * (direct - moved) : 0;
  }
}

/* First angle in [a, until) where the guard falls through 0, over grid nodes. */
static bool first_over_grid(const walk *w, const guard *g, const series_node *a, double until, series_node *root)
{
  for (const series_node *next = node_after(w, a->th); a->th < until; a = next++)
    if (crossing_first(&w->grid->m, g, a, next, root)) return root->th < until;
  return false;
}

/* Contact is lost somewhere: from a separated angle once around, touch-down to lift-off. */
static hc_status walk_intermittent(walk *w, series_node a)
{
  guard touch_down = guard_negative(&w->normal);
  double end = a.th + TWO_PI;
  hc_status st = HC_OK;
  series_node on, off;
  w->recording = true;
  while (st == HC_OK && first_over_grid(w, &touch_down, &a, end, &on)) {
    touch(w, &on);
    if (!first_over_grid(w, &w->normal, &on, end, &off)) {
      off = a;
      off.th = end;
    } /* rounding at the start angle */
    st = walk_contact(w, &on, &off);
    if (st == HC_OK) st = close_piece(w, off.th);
    a = off;
  }
  return st;
}

/* Contact is never lost: the slider's own history repeats after one period from w = 0 (a period maps w like a
 * clamp). */
static hc_status walk_closed(walk *w)
{
  const series_node *start = &w->grid->node[0], *end = &w->grid->node[SERIES_GRID];
  double low = -guard_value(&w->stick[0], start), high = guard_value(&w->stick[1], start);
  w->now.state = w->friction ? CONTACT_STICK : frictionless(&w->c->law);
  w->now.held = w->friction ? fmin(fmax(0, low), high) : 0;
  if (w->now.held != 0) hold(w, low > 0 ? 1 : -1, start);
  hc_status st = walk_contact(w, start, end);
  contact_piece first = w->now;
  w->recording = true;
  w->now.from = 0;
  w->now.transitions = 0;
  w->now.origin -= w->now.origin >= TWO_PI ? TWO_PI : 0;
  if (st == HC_OK) st = walk_contact(w, start, end);
  if (st == HC_OK) st = close_piece(w, TWO_PI);
  if (st != HC_OK) return st;
  bool same = w->now.state == first.state &&
              (first.state != CONTACT_STICK || fabs(w->now.held - first.held) <= 1e-11 * guard_scale(&w->stick[0]));
  return same ? HC_OK : HC_NOT_CLOSED;
}

hc_status transitions_find(const series_grid *grid, const moving_contact *c, int cap, contact_piece *piece, int *n)
{
  walk w = {.grid = grid, .c = c, .piece = piece, .cap = cap};
  *n = 0;
  if (!(c->law.kn > 0)) return HC_OK;
  make_guards(&w);
  /* mu kn or more overflows */
  if (w.friction && !isfinite(guard_scale(&w.stick[0]) + guard_scale(&w.slip[0]))) return HC_NOT_FINITE;
  if (guard_upper(&w.normal) <= 0) return HC_OK; /* never touches, whatever the phase */
  series_node apart;
  hc_status st;
  bool separates = false;
  if (guard_lower(&w.normal) < 0) {
    for (int i = 0; i < SERIES_GRID && !separates; ++i)
      if (guard_value(&w.normal, &grid->node[i]) < 0) {
        separates = true;
        apart = grid->node[i];
      }
    if (!separates) separates = first_over_grid(&w, &w.normal, &grid->node[0], TWO_PI, &apart);
  }
  st = separates ? walk_intermittent(&w, apart) : walk_closed(&w);
  *n = w.n;
  return st;
}
