/* planar_rest.c - see planar_rest.h. */
#include "hbm/planar/planar_rest.h"

#include <float.h>

#include "numerics/base/constants.h"
#include "numerics/crossing.h"

enum { MAX_EXCHANGES = 100, MAX_NEWTON = 30, MOST_HOLD = 3 };

/* ---- where stick ends --------------------------------------------------------------------------------------
 *
 * A slider that sticks begins to slip at the first angle where
 *
 *     g = R^2 - |u - w|^2,      a trigonometric polynomial of degree 2H,
 *
 * falls through 0 (numerics/crossing.h). g is computed as (R - |u - w|)(R + |u - w|): its terms are as large as the
 * squares of u, however small R is, and their difference would be rounding. */

typedef struct stick_guard {
  const planar_motion *m;
  double w[2];
  planar_point last; /* the motion at the angle evaluated last */
} stick_guard;

static guarded_point guard_at(const stick_guard *s, const planar_point *p)
{
  const double t1 = p->u[0] - s->w[0], t2 = p->u[1] - s->w[1], size = sqrt(t1 * t1 + t2 * t2);
  return (guarded_point){.th = p->th,
                         .f = (p->R - size) * (p->R + size),
                         .d1 = 2 * (p->R * p->dR - t1 * p->du[0] - t2 * p->du[1]),
                         .d2 = 2 * (p->dR * p->dR + p->R * p->ddR - p->du[0] * p->du[0] - p->du[1] * p->du[1] -
                                    t1 * p->ddu[0] - t2 * p->ddu[1])};
}

static guarded_point guard_new_at(void *self, double th)
{
  stick_guard *s = self;
  s->last = planar_motion_at(s->m, th);
  return guard_at(s, &s->last);
}

bool planar_stick_ends(const planar_motion *m, const planar_point *grid, const double w[2], const planar_point *from,
                       double to, planar_point *root)
{
  /* pulled: bound of |u - w| on an interval of the grid that begins in stick: largest R plus the change of u. */
  const double *U = m->of_u, *R = m->of_R, step = TWO_PI / SERIES_GRID;
  const double pulled = fmin(R[0] + U[1] * step, U[0] + hypot(w[0], w[1]));
  stick_guard stick = {m, {w[0], w[1]}, *from};
  guarded s = {.at = guard_new_at, .self = &stick};
  s.bound2 = 2 * (R[1] * R[1] + R[0] * R[2] + U[1] * U[1] + pulled * U[2]);
  s.bound3 = 2 * (3 * R[1] * R[2] + R[0] * R[3] + 3 * U[1] * U[2] + pulled * U[3]);
  s.noise = DBL_EPSILON * R[0] * (32 * (U[0] + hypot(w[0], w[1]) + R[0]) + 64 * (R[1] + U[1]));
  const planar_point *next = grid + (int)(from->th * (SERIES_GRID / TWO_PI));
  guarded_point a = guard_at(&stick, from), found;
  while (next->th <= a.th) ++next;
  while (a.th < to) {
    const planar_point end = next->th < to ? *next : planar_motion_at(m, to);
    const guarded_point b = guard_at(&stick, &end);
    if (guarded_first(&s, a, b, &found)) {
      *root = found.th == stick.last.th ? stick.last : found.th == end.th ? end : planar_motion_at(m, found.th);
      return true;
    }
    a = b;
    ++next;
  }
  return false;
}

/* ---- the disc that a place is farthest out of ------------------------------------------------------------- */

/* h(w, th) = |u - w| - R and its derivatives by th. */
typedef struct disc_distance {
  double h, rate, bend;
} disc_distance;

static disc_distance distance_at(const planar_point *p, const double w[2])
{
  const double t1 = p->u[0] - w[0], t2 = p->u[1] - w[1], length = fmax(sqrt(t1 * t1 + t2 * t2), DBL_MIN);
  const double e1 = t1 / length, e2 = t2 / length, across = p->du[1] * e1 - p->du[0] * e2;
  return (disc_distance){.h = length - p->R,
                         .rate = p->du[0] * e1 + p->du[1] * e2 - p->dR,
                         .bend = p->ddu[0] * e1 + p->ddu[1] * e2 + across * across / length - p->ddR};
}

/* The angle of a maximum of h, within one step of the grid from th: Newton, or bisection where that leaves the bracket.
 * One more step from an angle accurate to 1e-9 gives it to rounding. */
static planar_point climb(const planar_motion *m, const double w[2], double th)
{
  enum { MOST_STEPS = 60 };
  const double step = TWO_PI / SERIES_GRID;
  double low = th - step, high = th + step;
  planar_point p = planar_motion_at(m, th);
  bool last = false;
  for (int i = 0; i < MOST_STEPS && !last; ++i) {
    const disc_distance at = distance_at(&p, w);
    last = fabs(at.rate) <= 1e-9 * -at.bend;
    if (at.rate > 0) low = p.th;
    else high = p.th;
    double next = p.th - at.rate / at.bend;
    if (!(at.bend < 0 && next > low && next < high)) next = last ? p.th : 0.5 * (low + high);
    if (next != p.th) p = planar_motion_at(m, next);
    last |= !(high > low);
  }
  return p;
}

/* The disc of largest h at w into *out; returns that h. Maxima are searched between nodes of the grid where h rises at
 * the one and falls at the next. */
static double farthest(const planar_motion *m, const planar_point *grid, const double w[2], planar_point *out)
{
  enum { N_GRID = SERIES_GRID };
  disc_distance at[N_GRID];
  double most = -INFINITY;
  for (int i = 0; i < N_GRID; ++i) at[i] = distance_at(&grid[i], w);
  for (int i = 0; i < N_GRID; ++i) {
    const disc_distance *a = &at[i], *b = &at[(i + 1) % N_GRID];
    if (!(a->rate >= 0 && b->rate <= 0)) continue;
    const planar_point top = climb(m, w, a->h > b->h ? grid[i].th : grid[i + 1].th);
    const double h = distance_at(&top, w).h;
    if (!(h > most)) continue;
    most = h;
    *out = top;
  }
  return most;
}

static const double ONE_INSTANT = 1e-6; /* [rad] maxima closer than this are one instant; they are located to 1e-9 */

/* h = |u - w| - R; e: direction of u - w. */
static double outside(const planar_point *disc, const double w[2], double e[2])
{
  const double t1 = disc->u[0] - w[0], t2 = disc->u[1] - w[1], length = hypot(t1, t2);
  e[0] = length > 0 ? t1 / length : 1, e[1] = length > 0 ? t2 / length : 0;
  return length - disc->R;
}

/* Solves e_i.dw + dv = away_i for dw and dv; false if the system is singular. */
static bool move_three(const double e[][2], const double away[3], double dw[2], double *dv)
{
  const double a = e[0][0] - e[2][0], b = e[0][1] - e[2][1], c = e[1][0] - e[2][0], d = e[1][1] - e[2][1];
  const double x = away[0] - away[2], y = away[1] - away[2], det = a * d - b * c;
  if (!(fabs(det) > sqrt(DBL_EPSILON) * hypot(a, b) * hypot(c, d))) return false;
  dw[0] = (d * x - b * y) / det;
  dw[1] = (a * y - c * x) / det;
  *dv = away[2] - e[2][0] * dw[0] - e[2][1] * dw[1];
  return true;
}

/* ---- exchange ------------------------------------------------------------------------------------------ */

/* The best candidate for c so far. */
typedef struct choice {
  const planar_point *disc[1 + MOST_HOLD]; /* the new disc, then those that determined c before */
  int n;
  double worst; /* [length] largest h of all these discs at best.centre */
  planar_rest best;
} choice;

/* Takes w, determined by disc[0], disc[j] and disc[k] (index 0: none), as c if its largest h is the least so far. */
static void consider(choice *c, const double w[2], int j, int k)
{
  double worst = -INFINITY, e[2];
  for (int i = 0; i < c->n; ++i) worst = fmax(worst, outside(c->disc[i], w, e));
  if (!(worst < c->worst)) return;
  c->worst = worst;
  c->best = (planar_rest){.centre = {w[0], w[1]},
                          .room = -worst,
                          .n = 1 + (j > 0) + (k > 0),
                          .at = {*c->disc[0], *c->disc[j], *c->disc[k]}};
}

/* The point with equal h of disc[0] and disc[j] on the line through their centres. */
static void consider_two(choice *c, int j)
{
  const planar_point *a = c->disc[0], *b = c->disc[j];
  const double way[2] = {b->u[0] - a->u[0], b->u[1] - a->u[1]}, D = hypot(way[0], way[1]);
  if (!(D > fabs(a->R - b->R))) return; /* one lies in the other */
  const double part = 0.5 * (D + a->R - b->R) / D;
  consider(c, (double[2]){a->u[0] + part * way[0], a->u[1] + part * way[1]}, j, 0);
}

/* The point with equal h of disc[0], disc[j] and disc[k]: Newton from `from`; h are convex. */
static void consider_three(choice *c, int j, int k, const double from[2], double noise)
{
  const planar_point *const disc[] = {c->disc[0], c->disc[j], c->disc[k]};
  double w[2] = {from[0], from[1]}, e[3][2], h[3], dw[2], v;
  for (int i = 0; i < MAX_NEWTON; ++i) {
    for (int m = 0; m < 3; ++m) h[m] = outside(disc[m], w, e[m]);
    const double apart = fmax(fabs(h[0] - h[2]), fabs(h[1] - h[2]));
    if (apart <= 0.25 * noise) break;
    if (!move_three((const double(*)[2])e, h, dw, &v)) return;
    w[0] += dw[0], w[1] += dw[1];
  }
  consider(c, w, j, k);
}

static void exchange(planar_rest *r, const planar_point *next, double noise)
{
  const planar_rest before = *r;
  choice c = {.disc = {next, &before.at[0], &before.at[1], &before.at[2]}, .n = 1 + before.n, .worst = INFINITY};
  consider(&c, next->u, 0, 0);
  for (int j = 1; j <= before.n; ++j) consider_two(&c, j);
  for (int j = 1; j <= before.n; ++j)
    for (int k = j + 1; k <= before.n; ++k) {
      consider_three(&c, j, k, before.centre, noise);
      consider_three(&c, j, k, c.best.centre, noise);
    }
  *r = c.best;
}

/* ---- where it is ----------------------------------------------------------------------------------------- */

/* Rotation of the direction e of disc i, turned - by_c q, where q = dc.e_perp. The instant of largest h shifts by dth:
 * with U = u'.e_perp, B = -h'' > 0 and L = |u - c|
 *
 *     L turn = across + U dth - q,      B dth = rate + U (across - q)/L
 *
 * If B is 0 to rounding, dth = 0. */
static void turn_of(const planar_rest *r, int i, const planar_disc_change *change, double *turned, double *by_c)
{
  const planar_point *p = &r->at[i];
  const double *e = r->e[i], L = r->length[i], U = p->du[1] * e[0] - p->du[0] * e[1];
  const double terms[] = {p->ddu[0] * e[0] + p->ddu[1] * e[1], U * U / L, -p->ddR};
  const double B = -(terms[0] + terms[1] + terms[2]);
  const bool shifts = B > 16 * DBL_EPSILON * (fabs(terms[0]) + terms[1] + fabs(terms[2]));
  *by_c = (1 + (shifts ? U * U / (L * B) : 0)) / L;
  *turned = *by_c * change->across + (shifts ? U * change->rate / (B * L) : 0);
}

/* Moves the instants to the maxima of h at c; before, they belong to c before the last exchange. */
static void locate(const planar_motion *m, planar_rest *r)
{
  const int held = r->n;
  r->n = 0;
  for (int i = 0; i < held; ++i) {
    planar_point *at = &r->at[r->n];
    *at = climb(m, r->centre, r->at[i].th);
    bool known = false;
    for (int k = 0; k < r->n; ++k) known |= fabs(at->th - r->at[k].th) <= ONE_INSTANT;
    if (known) continue;
    r->length[r->n] = outside(at, r->centre, r->e[r->n]) + at->R;
    ++r->n;
  }
}

/* c between two discs, to rounding: where e_1 + e_2 = 0 and both h are equal, by one step of Newton. The exchange
 * leaves instants off by the root of rounding, and c by as much across the line. */
static void centre_between_two(planar_rest *r)
{
  const double *e = r->e[0], *f = r->e[1], h[] = {r->length[0] - r->at[0].R, r->length[1] - r->at[1].R};
  const double along = 0.5 * (h[0] - h[1]), mismatch = e[1] * f[0] - e[0] * f[1];
  double by_c[2], turned;
  for (int i = 0; i < 2; ++i) turn_of(r, i, &(planar_disc_change){0}, &turned, &by_c[i]);
  const double across = -mismatch / (by_c[0] + by_c[1]);
  r->centre[0] += along * e[0] - across * e[1];
  r->centre[1] += along * e[1] + across * e[0];
  r->room = -0.5 * (h[0] + h[1]);
}

/* Is w = 0 in the discs of all instants? */
static bool zero_holds(const planar_motion *m, const planar_point *grid)
{
  const double zero[2] = {0};
  double e[2];
  planar_point root;
  return outside(&grid[0], zero, e) <= 0 && !planar_stick_ends(m, grid, zero, &grid[0], TWO_PI, &root);
}

hc_status planar_rest_find(const planar_motion *m, const planar_point *grid, bool asked, planar_rest *out)
{
  enum { NEWTON_STEPS = 2 };
  /* Half of the excursion that does not count as slip (planar_motion_noise). */
  const double noise = 8 * DBL_EPSILON * (m->of_u[0] + m->of_R[0]);
  *out = (planar_rest){.room = INFINITY};
  if (asked && zero_holds(m, grid)) return out->exists = out->asked = true, HC_OK;
  for (int i = 0; i < MAX_EXCHANGES; ++i) {
    planar_point next;
    if (!(farthest(m, grid, out->centre, &next) <= noise - out->room)) {
      exchange(out, &next, noise);
      continue;
    }
    locate(m, out);
    for (int k = 0; k < NEWTON_STEPS && out->n == 2; ++k) {
      centre_between_two(out);
      locate(m, out);
    }
    const double size = hypot(out->centre[0], out->centre[1]);
    const double part = !(out->room > 0) ? 1 : size > out->room ? 1 - out->room / size : 0;
    out->exists = out->room >= -noise;
    for (int d = 0; d < 2; ++d) out->w[d] = part * out->centre[d];
    /* Maxima of h between nodes of the grid that farthest() did not see. */
    double e[2];
    if (!out->exists || !planar_stick_ends(m, grid, out->w, &grid[0], TWO_PI, &next)) return HC_OK;
    next = climb(m, out->w, next.th);
    if (outside(&next, out->w, e) <= noise) return HC_OK;
    exchange(out, &next, noise);
  }
  return HC_NOT_CONVERGED;
}

/* ---- how it moves ---------------------------------------------------------------------------------------- */

/* dc and dv = d(-room), from h_i = -room; to first order the shift of the instants does not matter, h being stationary
 * there. With two discs c lies between their centres, so both directions rotate by the same; the second's e_perp has
 * the opposite sign. */
static void move_centre(const planar_rest *r, const planar_disc_change *change, double dc[2], double *dv)
{
  const double away[] = {change[0].away, r->n > 1 ? change[1].away : 0, r->n > 2 ? change[2].away : 0};
  const double *e = r->e[0];
  if (r->n == 3 && move_three(r->e, away, dc, dv)) return;
  double along = change[0].away + change[0].radius, across = change[0].across;
  *dv = -change[0].radius; /* with one disc c is its centre */
  if (r->n > 1) {
    double turned[2], by_c[2];
    for (int i = 0; i < 2; ++i) turn_of(r, i, &change[i], &turned[i], &by_c[i]);
    along = 0.5 * (away[0] - away[1]);
    *dv = 0.5 * (away[0] + away[1]);
    across = (turned[0] - turned[1]) / (by_c[0] + by_c[1]);
  }
  dc[0] = along * e[0] - across * e[1];
  dc[1] = along * e[1] + across * e[0];
}

void planar_rest_move(const planar_rest *r, const planar_disc_change *change, double dw[2])
{
  double dc[2], dv;
  const double size = hypot(r->centre[0], r->centre[1]), room = fmax(r->room, 0);
  dw[0] = dw[1] = 0;
  if (r->asked || size <= room) return;
  move_centre(r, change, dc, &dv);
  const double o[2] = {r->centre[0] / size, r->centre[1] / size}, along = o[0] * dc[0] + o[1] * dc[1];
  for (int d = 0; d < 2; ++d) dw[d] = dc[d] + dv * o[d] - room / size * (dc[d] - along * o[d]);
}

/* most: bounds the work on a curve that chatters. bisections: more than omega has bits. */
const slip_edges planar_edges = {.too_short = 1e-4, .located = 1e-6, .most = 100, .bisections = 60};
