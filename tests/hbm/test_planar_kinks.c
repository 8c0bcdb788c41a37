/* test_planar_kinks.c - the Jacobian of located forces of a contact with two tangents where an interval is about to
 * appear or to vanish: slip that begins exactly at touch-down, a normal force that just touches zero, a traction
 * that just touches its limit, a slider that just comes to rest. On each side of such a motion X0, along a direction
 * d,
 *
 *     F(X0 + h d) = F0 + h D + c h^(3/2) + ...          h > 0
 *
 * in powers of h^(1/2): what a parabola cuts off is as long as the root of how far it is beyond. D is found three
 * times: from the forces, from the Jacobian as h falls to 0, and from the Jacobian at X0. */
#include "hbm/planar/planar_force.h"
#include "tests/hbm/planar_scenes.h"

enum { H = 2, LENGTH = 2 * H + 1, ROWS = 3 * LENGTH, LEVELS = 5, MAX_LETTERS = 256 };

/* ---- one side ---------------------------------------------------------------------------------------- */

/* The limit for h -> 0 of what is y[k] at h/4^k and goes on in powers of h^(1/2); how much the last of them changed. */
static double limit(double y[LEVELS], double *change)
{
  for (int k = 1; k < LEVELS; ++k) {
    *change = fabs(y[LEVELS - 1] - y[LEVELS - 2]) / (pow(2, k) - 1);
    for (int i = LEVELS - 1; i >= k; --i) y[i] += (y[i] - y[i - 1]) / (pow(2, k) - 1);
  }
  return y[LEVELS - 1];
}

/* F, and the Jacobian there times d. */
static void evaluate(planar_force *f, const double *X, const double *d, double *F, double *product)
{
  static double jac[ROWS * ROWS];
  assert_int_equal(planar_force_eval(f, X, F, jac, NULL), HC_OK);
  circle_product(ROWS, jac, d, product);
}

typedef struct one_sided {
  double of_forces[ROWS], of_jacobians[ROWS]; /* D, twice */
  double unsure;                              /* how much the last extrapolation changed them at most */
} one_sided;

/* D for h of that sign. */
static one_sided from_one_side(planar_force *f, const double *X, const double *F0, const double *d, double sign)
{
  one_sided out = {.unsure = 0};
  double forces[LEVELS][ROWS], jacobians[LEVELS][ROWS], Y[ROWS], F[ROWS], y[LEVELS], change;
  for (int k = 0; k < LEVELS; ++k) {
    const double h = sign * 1e-3 * pow(4, -k);
    for (int i = 0; i < ROWS; ++i) Y[i] = X[i] + h * d[i];
    evaluate(f, Y, d, F, jacobians[k]);
    for (int i = 0; i < ROWS; ++i) forces[k][i] = (F[i] - F0[i]) / h;
  }
  for (int i = 0; i < ROWS; ++i) {
    for (int k = 0; k < LEVELS; ++k) y[k] = forces[k][i];
    out.of_forces[i] = limit(y, &change);
    out.unsure = fmax(out.unsure, change);
    for (int k = 0; k < LEVELS; ++k) y[k] = jacobians[k][i];
    out.of_jacobians[i] = limit(y, &change);
    out.unsure = fmax(out.unsure, change);
  }
  return out;
}

static double distance(const double *a, const double *b)
{
  double most = 0;
  for (int i = 0; i < ROWS; ++i) most = larger(most, fabs(a[i] - b[i]));
  return most;
}

static planar_force *make(const contact *whole)
{
  const contact half = circle_half(*whole);
  CHECK_MADE(planar_force, f, planar_force_new(H, 3, &half, &f));
  return f;
}

/* What was seen, and how far off at most. */
typedef struct tally {
  int checked, skipped, kinks;
  double of_sides, at_edge;
} tally;

/* At X0 along d, unless D is not known well enough from the forces. Their rounding, some 1e-15 of (kt + kn) |d|, over a
 * step down to 4e-6, and that extrapolated: 1e-8 of it. The edge is known to roundings, and the Jacobian beside it
 * moves with the root of how far it is, hence 1e-6 at X0. */
static void check_edge(planar_force *f, const contact *law, const double *X, const double *d, tally *t)
{
  const double size = (law->kt + law->kn) * sum_abs(ROWS, d);
  double F0[ROWS], at[ROWS];
  evaluate(f, X, d, F0, at);
  const one_sided after = from_one_side(f, X, F0, d, 1), before = from_one_side(f, X, F0, d, -1);
  const double unsure = fmax(after.unsure, before.unsure) / size;
  if (!(unsure <= 1e-9) && ++t->skipped) return;
  ++t->checked;
  t->kinks += distance(after.of_forces, before.of_forces) > 1e-3 * size;
  const double of_sides =
      larger(distance(after.of_forces, after.of_jacobians), distance(before.of_forces, before.of_jacobians)) / size;
  const double at_edge = fmin(distance(at, after.of_forces), distance(at, before.of_forces)) / size;
  CHECK_LE(of_sides, 1e-8 + 10 * unsure, "edge %d, beside it", t->checked);
  CHECK_LE(at_edge, 1e-6, "edge %d, on it", t->checked);
  t->of_sides = fmax(t->of_sides, of_sides);
  t->at_edge = fmax(t->at_edge, at_edge);
}

static void print_tally(const char *what, const tally *t)
{
  print_message("%s: %d checked (%d with a kink), %d skipped; beside %.1e, on it %.1e\n", what, t->checked, t->kinks,
                t->skipped, t->of_sides, t->at_edge);
}

/* ---- edges that are made ------------------------------------------------------------------------------- */

/* kt |u'| = mu kn v' at touch-down. Which of stick and slip follows is up to what comes next, both do, and phi' of slip
 * that follows a short stick is (something small)/R, R nearly 0. */
static void slip_that_begins_at_touch_down(CHECK_STATE)
{
  uint64_t seed = 41;
  tally t = {0};
  int outruns = 0;
  for (int trial = 0; trial < 100; ++trial) {
    double X[ROWS], d[ROWS], *v = X + 2 * LENGTH;
    random_plane_motion(&seed, H, 1, X);
    random_plane_motion(&seed, H, 1, d);
    const double th = PI * random_signed(&seed), c = cos(th), s = sin(th);
    if (series_at(H, v, c, s).d1 < 0)
      for (int i = 0; i < LENGTH; ++i) v[i] = -v[i];
    const series_jet at = series_at(H, v, c, s), a = series_at(H, X, c, s), b = series_at(H, X + LENGTH, c, s);
    const double speed = hypot(a.d1, b.d1);
    contact law = {.kn = 1.3, .mu = 0.5, .gap = -at.x};
    law.kt = law.mu * law.kn * at.d1 / speed;
    planar_force *f = make(&law);
    check_edge(f, &law, X, d, &t);
    outruns += law.kt * (a.d1 * a.d2 + b.d1 * b.d2) / speed > law.mu * law.kn * at.d2;
    planar_force_free(f);
  }
  print_tally("slip from touch-down", &t);
  assert_true(t.checked > 40 && t.kinks == 0);
  assert_in_range(outruns, 20, 80);
}

/* N touches 0 at one angle; on one side it never separates. */
static void a_graze_of_the_normal_force(CHECK_STATE)
{
  uint64_t seed = 42;
  tally t = {0};
  for (int trial = 0; trial < 100; ++trial) {
    double X[ROWS], d[ROWS], max, min;
    random_plane_motion(&seed, H, 1, X);
    random_plane_motion(&seed, H, 1, d);
    series_extrema(H, X + 2 * LENGTH, &max, &min);
    const contact law = {.kt = 0.9, .kn = 1.3, .mu = 0.5, .gap = -min};
    planar_force *f = make(&law);
    check_edge(f, &law, X, d, &t);
    planar_force_free(f);
  }
  print_tally("graze of the normal force", &t);
  assert_true(t.checked > 40 && t.kinks == 0);
}

/* kt u = mu N all the while: every instant is an edge. T = mu N, whichever state says so. */
static void at_the_limit_all_the_while(CHECK_STATE)
{
  const contact law = {.kt = 0.75, .kn = 1.5, .mu = 0.5};
  double X[ROWS] = {0}, F[ROWS];
  planar_force *f = make(&law);
  X[1] = 0.6, X[LENGTH + 1] = 0.8, X[2 * LENGTH + 1] = 1;
  assert_int_equal(planar_force_eval(f, X, F, NULL, NULL), HC_OK);
  for (int i = 0; i < LENGTH; ++i) {
    CHECK_NEAR(F[i], 0.6 * law.mu * F[2 * LENGTH + i], 1e-7, "coefficient %d", i);
    CHECK_NEAR(F[LENGTH + i], 0.8 * law.mu * F[2 * LENGTH + i], 1e-7, "coefficient %d", i);
  }
  planar_force_free(f);
}

/* ---- edges that are found ------------------------------------------------------------------------------- */

/* Its states, each contact begun with a bar: |ts|s. */
static void spell(planar_force *f, const double *X, char out[MAX_LETTERS])
{
  double F[ROWS];
  int n = 0;
  assert_int_equal(planar_force_eval(f, X, F, NULL, NULL), HC_OK);
  const planar_cycle *c = planar_force_cycle(f);
  for (int i = 0; i < c->n && n < MAX_LETTERS - 2; ++i) {
    if (c->interval[i].begin == PLANAR_TOUCHES) out[n++] = '|';
    out[n++] = c->interval[i].state == CONTACT_STICK ? 't' : 's';
  }
  out[n] = 0;
}

static void along(const double *A, const double *d, double part, double *X)
{
  for (int i = 0; i < ROWS; ++i) X[i] = A[i] + part * d[i];
}

/* The first change of states met by halving the way from A to A + d/3: X there, and the states on both sides. false if
 * the ends have the same. */
static bool find_edge(planar_force *f, const double *A, const double *d, double *X, char before[], char after[])
{
  double low = 0, high = 1.0 / 3;
  char now[MAX_LETTERS];
  spell(f, A, before);
  along(A, d, high, X);
  spell(f, X, after);
  if (strcmp(before, after) == 0) return false;
  while (high - low > DBL_EPSILON / 8) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    along(A, d, middle, X);
    spell(f, X, now);
    if (strcmp(now, before) == 0) {
      low = middle;
      continue;
    }
    high = middle;
    strcpy(after, now);
  }
  along(A, d, high, X);
  return true;
}

static int count_bars(const char *spelt)
{
  int n = 0;
  for (; *spelt; ++spelt) n += *spelt == '|';
  return n;
}

/* Random contacts that come and go, at whatever edge lies between two motions: a graze of N (another number of
 * bars), a touch-down that slips or sticks, or an interval within contact. At those of friction's limit F has a
 * kink: a slider is pushed on one side and not on the other. */
static void edges_between_motions(CHECK_STATE)
{
  uint64_t seed = 43;
  tally grazes = {0}, touches = {0}, inside = {0};
  for (int trial = 0; trial < 900; ++trial) {
    const contact law = random_circle(&seed);
    double A[ROWS], d[ROWS], X[ROWS];
    char before[MAX_LETTERS], after[MAX_LETTERS];
    random_plane_motion(&seed, H, 1, A);
    random_plane_motion(&seed, H, 1, d);
    if (law.kn == 0) continue;
    planar_force *f = make(&law);
    spell(f, A, before);
    if (before[0] == '|' && find_edge(f, A, d, X, before, after)) {
      const bool same_bars = count_bars(before) == count_bars(after), first = before[1] != after[1];
      check_edge(f, &law, X, d, !same_bars ? &grazes : first ? &touches : &inside);
    }
    planar_force_free(f);
  }
  print_tally("found, normal force", &grazes);
  print_tally("found, touch-down", &touches);
  print_tally("found, within contact", &inside);
  assert_true(grazes.checked > 10 && touches.checked > 10 && inside.checked > 10);
  assert_true(grazes.kinks == 0 && touches.kinks == 0 && inside.kinks > 3);
}

CHECK_TESTS("hbm.planar_kinks", 300, slip_that_begins_at_touch_down, a_graze_of_the_normal_force,
            at_the_limit_all_the_while, edges_between_motions)
