/* transitions.c - see transitions.h: what happens to a contact, in the order it happens. The search for one crossing is crossing.c's. */
#include "hbm/transitions.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "hbm/crossing.h"

static const double TWO_PI = 6.283185307179586476925;

void motion_table_fill(int n_harm, double *table)
{
  for (int i = 0; i < TRANSITIONS_GRID; ++i)
    for (int h = 1; h <= n_harm; ++h) {
      double th = TWO_PI * ((long)h * i % TRANSITIONS_GRID) / TRANSITIONS_GRID;
      table[2 * (i * n_harm + h - 1)] = cos(th);
      table[2 * (i * n_harm + h - 1) + 1] = sin(th);
    }
}

static void fill_coordinate(motion_grid *g, int d)
{
  int n_harm = g->m.n_harm;
  const double *X = g->m.X[d];
  for (int i = 0; i < TRANSITIONS_GRID; ++i) {
    const double *t = g->table + 2 * (size_t)i * n_harm;
    double x = X[0], d1 = 0, d2 = 0;
    for (int h = 1; h <= n_harm; ++h) {
      double c = t[2 * h - 2], s = t[2 * h - 1], a = X[2 * h - 1], b = X[2 * h];
      double even = a * c + b * s, odd = b * c - a * s;
      x += even;
      d1 += h * odd;
      d2 -= (double)h * h * even;
    }
    g->node[i].d[0][d] = x;
    g->node[i].d[1][d] = d1;
    g->node[i].d[2][d] = d2;
  }
}

void motion_grid_fill(motion_grid *g, const motion *m, const double *table)
{
  g->m = *m;
  g->table = table;
  for (int d = 0; d < m->n_dof; ++d) fill_coordinate(g, d);
  for (int i = 0; i < TRANSITIONS_GRID; ++i) g->node[i].th = TWO_PI * i / TRANSITIONS_GRID;
  g->node[TRANSITIONS_GRID] = g->node[0];
  g->node[TRANSITIONS_GRID].th = TWO_PI;
}

/* Everything about one contact while its period is walked through. */
typedef struct walk {
  const motion_grid *grid;
  const moving_contact *c;
  guard normal;        /* g; its negative is searched for touch-down */
  guard stick[2];      /* p_s = mu kn (v + gap) - s kt u, the part of q_s that does not change; s = +1, -1 */
  guard slip[2];       /* r_s */
  contact_piece now;   /* the piece under way; from, state, held, origin, slope */
  contact_piece *piece;
  int n, cap;
  bool recording, friction;
} walk;

static int index_of(int s) { return s < 0; }

static guard make_guard(const walk *w, int order, double of_u, double of_v, double constant)
{
  double a[MOTION_MAX_DOF] = {0};
  for (int d = 0; d < w->grid->m.n_dof; ++d) a[d] = of_u * w->c->cu[d] + of_v * w->c->cv[d];
  return guard_make(&w->grid->m, order, a, constant);
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
static void hold(walk *w, int s, const motion_node *at)
{
  const contact *law = &w->c->law;
  w->now.held = -s * guard_value(&w->stick[index_of(s)], at);
  w->now.origin = at->th;
  for (int d = 0; d < w->grid->m.n_dof; ++d) w->now.slope[d] = law->kt * w->c->cu[d] - s * law->mu * law->kn * w->c->cv[d];
}

/* Between two nodes in contact: pieces end where a guard falls through 0. */
static hc_status walk_between(walk *w, motion_node a, const motion_node *b)
{
  hc_status st = HC_OK;
  while (st == HC_OK && a.th < b->th) {
    motion_node root, other;
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
    a = root;
    if (++w->now.transitions > 64 * (w->grid->m.n_harm + 1)) return HC_CHATTER;
    if (!contact_slip_sign(w->now.state) && guard_value(&w->slip[index_of(s)], &root) <= 0) {
      /* |T| over mu N and coming back: no slip but rounding, as where T and N vanish together. The slider gives way by as much. */
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

/* From a to b, grid nodes in between, in contact all the way. */
static hc_status walk_contact(walk *w, motion_node a, const motion_node *b)
{
  hc_status st = HC_OK;
  if (!w->friction) return HC_OK;
  const double step = TWO_PI / TRANSITIONS_GRID;
  for (long i = (long)floor(a.th / step) + 1; st == HC_OK && a.th < b->th; ++i) {
    motion_node next = w->grid->node[i % TRANSITIONS_GRID];
    next.th = i * step;
    if (next.th <= a.th) continue;
    if (next.th >= b->th) next = *b;
    st = walk_between(w, a, &next);
    a = next;
  }
  return st;
}

/* Touch-down at `at`: T = N = 0 and w = u; slips at once if the slip guard says so. */
static void touch(walk *w, const motion_node *at)
{
  const contact *law = &w->c->law;
  double u = 0, du = 0, dv = 0;
  for (int d = 0; d < w->grid->m.n_dof; ++d) {
    u += w->c->cu[d] * at->d[0][d];
    du += w->c->cu[d] * at->d[1][d];
    dv += w->c->cv[d] * at->d[1][d];
  }
  w->now.from = w->now.origin = at->th;
  w->now.held = law->kt * u;
  w->now.state = contact_on_touch(law, du, dv);
  /* d held = kt (du_origin + u' d th), d th = -dv_origin/v' moves with the instant of contact */
  double along = dv > 0 ? du / dv : 0;
  for (int d = 0; d < w->grid->m.n_dof; ++d) {
    double direct = w->c->cu[d], moved = along * w->c->cv[d];
    w->now.slope[d] = fabs(direct - moved) > 4 * DBL_EPSILON * fabs(direct) ? law->kt * (direct - moved) : 0;
  }
}

/* First angle in [a, until] where the guard falls through 0, over grid nodes. */
static bool first_over_grid(const walk *w, const guard *g, motion_node a, double until, motion_node *root)
{
  const double step = TWO_PI / TRANSITIONS_GRID;
  for (long i = (long)floor(a.th / step) + 1; a.th < until; ++i) {
    motion_node next = w->grid->node[i % TRANSITIONS_GRID];
    next.th = i * step;
    if (next.th <= a.th) continue;
    if (crossing_first(&w->grid->m, g, &a, &next, root)) return root->th < until;
    a = next;
  }
  return false;
}

/* Contact is lost somewhere: from a separated angle once around, touch-down to lift-off. */
static hc_status walk_intermittent(walk *w, motion_node a)
{
  guard touch_down = guard_negative(&w->normal);
  double end = a.th + TWO_PI;
  hc_status st = HC_OK;
  motion_node on, off;
  w->recording = true;
  while (st == HC_OK && first_over_grid(w, &touch_down, a, end, &on)) {
    touch(w, &on);
    if (!first_over_grid(w, &w->normal, on, end, &off)) { off = a; off.th = end; } /* rounding at the start angle */
    st = walk_contact(w, on, &off);
    if (st == HC_OK) st = close_piece(w, off.th);
    a = off;
  }
  return st;
}

/* Contact is never lost: the slider's own history repeats after one period from w = 0 (a period maps w like a clamp). */
static hc_status walk_closed(walk *w)
{
  const motion_node *start = &w->grid->node[0], *end = &w->grid->node[TRANSITIONS_GRID];
  double low = -guard_value(&w->stick[0], start), high = guard_value(&w->stick[1], start);
  w->now.state = w->friction ? CONTACT_STICK : CONTACT_SLIP_PLUS;
  w->now.held = w->friction ? fmin(fmax(0, low), high) : 0;
  if (w->now.held != 0) hold(w, low > 0 ? 1 : -1, start);
  hc_status st = walk_contact(w, *start, end);
  contact_piece first = w->now;
  w->recording = true;
  w->now.from = 0;
  w->now.transitions = 0;
  w->now.origin -= w->now.origin >= TWO_PI ? TWO_PI : 0;
  if (st == HC_OK) st = walk_contact(w, *start, end);
  if (st == HC_OK) st = close_piece(w, TWO_PI);
  if (st != HC_OK) return st;
  bool same = w->now.state == first.state && (first.state != CONTACT_STICK || fabs(w->now.held - first.held) <= 1e-11 * guard_scale(&w->stick[0]));
  return same ? HC_OK : HC_NOT_CLOSED;
}

hc_status transitions_find(const motion_grid *grid, const moving_contact *c, int cap, contact_piece *piece, int *n)
{
  walk w = {.grid = grid, .c = c, .piece = piece, .cap = cap};
  *n = 0;
  if (!(c->law.kn > 0)) return HC_OK;
  make_guards(&w);
  if (guard_upper(&w.normal) <= 0) return HC_OK; /* never touches, whatever the phase */
  motion_node apart;
  hc_status st;
  bool separates = false;
  if (guard_lower(&w.normal) < 0) {
    for (int i = 0; i < TRANSITIONS_GRID && !separates; ++i)
      if (guard_value(&w.normal, &grid->node[i]) < 0) { separates = true; apart = grid->node[i]; }
    if (!separates) separates = first_over_grid(&w, &w.normal, grid->node[0], TWO_PI, &apart);
  }
  st = separates ? walk_intermittent(&w, apart) : walk_closed(&w);
  *n = w.n;
  return st;
}
