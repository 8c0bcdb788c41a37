/* test_crossing.c - the first angle where a trigonometric polynomial falls through 0: against dense sampling, and
 * against roots that are known. Here "noise" is what crossing.c does not distinguish from 0, eps (16 scale +
 * 32 sqrt(size bound2)), which is also the error of an evaluation: dips shallower than that may be found or not. */
#include "numerics/crossing.h"
#include "tests/hbm/scenes.h"

enum { MAX_HARM = 200, MAX_COEF = 2 * MAX_HARM + 1 };

static double noise_of(const guard *g) { return DBL_EPSILON * (16 * guard_scale(g) + 32 * sqrt(g->size * g->bound2)); }

/* A derivative of f at th in extended precision: an own evaluation, by turning z = exp(i h th) step by step (H long
 * double eps: 2e-17). */
static long double slow_value(const series_vector *m, const guard *g, int derivative, long double th)
{
  long double f = derivative ? 0 : g->constant, c = cosl(th), s = sinl(th);
  int order = g->order + derivative;
  for (int d = 0; d < m->dim; ++d) {
    const double *X = m->X[d];
    long double ch = 1, sh = 0;
    if (order == 0) f += (long double)g->a[d] * X[0];
    for (int h = 1; h <= m->n_harm; ++h) {
      long double next = ch * c - sh * s, a = X[2 * h - 1], b = X[2 * h], factor = g->a[d];
      sh = ch * s + sh * c;
      ch = next;
      for (int k = 0; k < order; ++k) {
        long double turned = b;
        b = -a;
        a = turned;
        factor *= h;
      }
      f += factor * (a * ch + b * sh);
    }
  }
  return f;
}

typedef struct outcome {
  bool found;
  double root;
} outcome;

/* Over the whole turn from `from`, in `steps` intervals, as transitions.c does it. */
static outcome search_turn(const series_vector *m, const guard *g, double from, int steps)
{
  series_node a = series_vector_at(m, from), root;
  for (int i = 1; i <= steps; ++i) {
    series_node b = series_vector_at(m, from + 2 * PI * i / steps);
    if (crossing_first(m, g, &a, &b, &root)) {
      assert_true(root.th >= a.th && root.th <= b.th);
      return (outcome){true, root.th};
    }
    a = b;
  }
  return (outcome){false, 0};
}

/* A found root is one: f there is 0 to noise; beyond it, within what a derivative or a curvature needs for that, f is
 * below; before it nothing is. The last is seen by sampling 8 H + 64 times a turn and descending from each sample
 * that is a local minimum. Returns the deepest dip before `to`. */
static double deepest_before(const series_vector *m, const guard *g, double from, double to, double *where)
{
  int n = 8 * m->n_harm + 64;
  double step = 2 * PI / n, deepest = INFINITY;
  long double before = slow_value(m, g, 0, from), here = before;
  for (int i = 0; from + i * step < to; ++i) {
    double th = from + i * step, next = fmin(th + step, to);
    long double after = slow_value(m, g, 0, next);
    if (here <= before && here <= after) { /* minimum between the neighbours: bisect f' */
      long double lo = i ? th - step : th, hi = next, f = here;
      if (slow_value(m, g, 1, lo) < 0 && slow_value(m, g, 1, hi) > 0) {
        for (int it = 0; it < 40; ++it) {
          long double mid = 0.5L * (lo + hi);
          if (slow_value(m, g, 1, mid) < 0) lo = mid;
          else hi = mid;
        }
        f = slow_value(m, g, 0, lo);
      }
      f = fminl(f, here);
      if (f < deepest) {
        deepest = (double)f;
        *where = (double)lo;
      }
    }
    if (after < deepest) {
      deepest = (double)after;
      *where = next;
    }
    before = here;
    here = after;
  }
  return deepest;
}

/* What the polynomial's own evaluation may be off by at angles up to 4 pi: recurrences lose up to 2 H eps of |f'|'s
 * size. */
static double slack_of(const series_vector *m, const guard *g)
{
  return 3 * noise_of(g) + 16 * DBL_EPSILON * (m->n_harm + 4) * (guard_scale(g) + sqrt(g->size * g->bound2));
}

static void check_search(const series_vector *m, const guard *g, double from, int steps, const char *what, int *n_found)
{
  double slack = slack_of(m, g), where = 0;
  if (slow_value(m, g, 0, from) < slack) return; /* must start above 0 */
  outcome o = search_turn(m, g, from, steps);
  double to = o.found ? o.root : from + 2 * PI, deepest = deepest_before(m, g, from, to, &where);
  CHECK_LE(-deepest, slack, "%s: missed a dip at %.17g, before %.17g (%s)", what, where, to,
           o.found ? "root" : "the end");
  if (!o.found) return;
  ++*n_found;
  CHECK_LE((double)fabsl(slow_value(m, g, 0, o.root)), slack, "%s: f at the root %.17g", what, o.root);
  /* f < 0 soon: within the distance where the largest derivative it can have there would take it below -slack, doubled
   * until it does */
  double ahead = 1e-12;
  while (ahead < 0.1 && slow_value(m, g, 0, o.root + ahead) >= 0) ahead *= 2;
  CHECK_LE(ahead, 3e-2 / sqrt(m->n_harm), "%s: f does not fall below 0 after %.17g", what, o.root);
}

static void random_polynomials(CHECK_STATE)
{
  static const int orders[] = {1, 2, 3, 5, 10, 20, 50, 100, 200};
  static double X[MAX_COEF], Y[MAX_COEF];
  uint64_t seed = 20;
  int n_found = 0, n_all = 0;
  for (int o = 0; o < 9; ++o)
    for (int trial = 0; trial < (orders[o] <= 20 ? 60 : 8); ++trial) {
      int H = orders[o], n_dof = 1 + trial % 2, order = trial / 2 % 2;
      random_motion(&seed, H, 1, trial % 5 * 0.75, X);
      random_motion(&seed, H, 1, 1, Y);
      series_vector m = {H, n_dof, {X, Y}};
      double a[2] = {random_signed(&seed), random_signed(&seed)};
      guard g = guard_make(&m, order, a, 0);
      g.constant = 0.5 * (random_signed(&seed) + 0.6) * g.size;
      char what[80];
      snprintf(what, sizeof what, "H=%d dofs=%d order=%d trial=%d", H, n_dof, order, trial);
      for (int turn = 0; turn < 3; ++turn, ++n_all) {
        double from = PI * (1 + random_signed(&seed));
        if (slow_value(&m, &g, 0, from) < 0) { /* its negative starts above */
          guard down = guard_negative(&g);
          check_search(&m, &down, from, 1 << (trial % 6), what, &n_found);
        } else {
          check_search(&m, &g, from, 1 << (trial % 6), what, &n_found);
        }
      }
    }
  print_message("%d of %d searches found a root\n", n_found, n_all);
  assert_true(n_found > n_all / 4 && n_found < n_all);
}

/* The deepest minimum of a random f, put at +-depth around 0 and at 0: what is deeper than noise is found, what
 * stays above 0 is not. */
static void grazing(CHECK_STATE)
{
  static const int orders[] = {1, 2, 3, 5, 10, 20, 50, 100, 200};
  static const double depths[] = {0, 1e-15, 1e-14, 1e-13, 1e-12, 1e-10, 1e-8, 1e-5};
  static double X[MAX_COEF];
  uint64_t seed = 5;
  int seen = 0, told = 0;
  for (int o = 0; o < 9; ++o)
    for (int trial = 0; trial < (orders[o] <= 20 ? 30 : 6); ++trial) {
      int H = orders[o], order = trial % 2;
      random_motion(&seed, H, 1, 1 + trial % 3 * 0.75, X);
      series_vector m = {H, 1, {X}};
      double one = 1, low = 0;
      guard g = guard_make(&m, order, &one, 0);
      /* 0.2, more than two samples, beyond a turn: a minimum next to 0 has neighbours on both sides there */
      double deepest = deepest_before(&m, &g, 0, 2 * PI + 0.2, &low);
      for (int d = 0; d < 8; ++d)
        for (int sign = -1; sign <= 1; sign += 2) {
          g.constant = -deepest - sign * depths[d] * g.size; /* sign +1: dips below 0 */
          double from = low + 1.3 + random_signed(&seed), slack = slack_of(&m, &g);
          if (slow_value(&m, &g, 0, from) < slack) continue;
          outcome found = search_turn(&m, &g, from, 1 << (trial % 6));
          double depth = sign * depths[d] * g.size;
          if (depth > slack) {
            ++seen;
            if (!found.found)
              fail_msg("H=%d order=%d: a dip of %g at %.17g is missed (noise %g)", H, order, depth, low, noise_of(&g));
            CHECK_LE((double)fabsl(slow_value(&m, &g, 0, found.root)), slack, "H=%d order=%d depth %g", H, order,
                     depth);
            double away = remainder(found.root - low, 2 * PI);
            CHECK_LE(away, 1e-12, "H=%d: a falling root lies before the minimum", H);
          } else if (-depth > slack) {
            ++told;
            if (found.found)
              fail_msg("H=%d order=%d: a minimum of %g at %.17g is taken for a crossing", H, order, -depth, low);
          }
        }
    }
  print_message("%d dips, %d minima above 0\n", seen, told);
  assert_true(seen > 300 && told > 300);
}

/* f = (1 - cos(h th)): double roots at all 2 pi k/h, exactly grazing; with a constant of +-1e-12 and +-1e-15 added,
 * dips by that or none. And f = +-sin^3 th, triple: found where it falls, to the cube root of noise. */
static void roots_that_are_known(CHECK_STATE)
{
  static double X[MAX_COEF];
  static const double shifts[] = {0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-3, -1e-3};
  double one = 1;
  for (int h = 1; h <= MAX_HARM; h = h < 8 ? h + 1 : 5 * h)
    for (int s = 0; s < 7; ++s) {
      memset(X, 0, sizeof X);
      X[0] = 1;
      X[2 * h - 1] = -1;
      series_vector m = {MAX_HARM, 1, {X}};
      guard g = guard_make(&m, 0, &one, shifts[s]);
      double from = 1.1 / h;
      outcome o = search_turn(&m, &g, from, 32);
      if (shifts[s] >= 0 && o.found) fail_msg("h=%d: 1 - cos + %g has no crossing", h, shifts[s]);
      if (-shifts[s] > slack_of(&m, &g)) {
        assert_true(o.found);
        double exact = (2 * PI - acos(1 + shifts[s])) / h; /* acos(1 - e) is good to eps/sqrt(2 e) */
        CHECK_NEAR(o.root, exact, 2 * slack_of(&m, &g) / (h * sqrt(-2 * shifts[s])) + 8 * DBL_EPSILON,
                   "h=%d, 1 - cos(h th) %g", h, shifts[s]);
      }
    }
  memset(X, 0, sizeof X);
  X[2] = 0.75;
  X[6] = -0.25;
  series_vector m = {3, 1, {X}};
  for (int sign = -1; sign <= 1; sign += 2) {
    double a = sign;
    guard g = guard_make(&m, 0, &a, 0);
    double from = sign > 0 ? 1 : 4;
    outcome o = search_turn(&m, &g, from, 32);
    assert_true(o.found);
    CHECK_NEAR(o.root, sign > 0 ? PI : 2 * PI, cbrt(slack_of(&m, &g)), "%d sin^3", sign);
  }
}

/* Simple roots: f = cos(h (th - t0)) falls through 0 at t0 + pi/(2h) to a few eps of the angle, and from every
 * starting angle the next one is found. */
static void simple_roots_to_rounding(CHECK_STATE)
{
  static double X[MAX_COEF];
  double one = 1;
  uint64_t seed = 9;
  for (int h = 1; h <= MAX_HARM; ++h) {
    double t0 = random_signed(&seed) / h, from = t0 + 0.999 * random_signed(&seed) * PI / (2 * h);
    memset(X, 0, sizeof X);
    X[2 * h - 1] = cos(h * t0);
    X[2 * h] = sin(h * t0);
    series_vector m = {MAX_HARM, 1, {X}};
    guard g = guard_make(&m, 0, &one, 0);
    outcome o = search_turn(&m, &g, from, 32);
    assert_true(o.found);
    CHECK_NEAR(o.root, t0 + PI / (2 * h), 2 * slack_of(&m, &g) / h + 8 * DBL_EPSILON, "h=%d", h);
  }
}

static void constants_and_zero(CHECK_STATE)
{
  static double X[MAX_COEF];
  static const double constants[] = {0, 1, 1e-300, 1e300, DBL_MIN};
  for (int i = 0; i < 5; ++i)
    for (int order = 0; order <= 1; ++order) {
      memset(X, 0, sizeof X);
      series_vector m = {i % 2 ? MAX_HARM : 1, 1, {X}};
      double one = 1;
      guard g = guard_make(&m, order, &one, constants[i]);
      assert_false(search_turn(&m, &g, 0.3, 32).found);
      if (!order) { /* a mean that cancels the constant */
        X[0] = -constants[i];
        g = guard_make(&m, 0, &one, constants[i]);
        assert_false(search_turn(&m, &g, 0.3, 32).found);
      }
    }
  memset(X, 0, sizeof X); /* a rounding error's worth of motion on a constant that is 0 to rounding: nothing to find,
                             and nothing to search for long */
  X[0] = 1;
  for (int i = 1; i < MAX_COEF; ++i) X[i] = 1e-19;
  series_vector m = {MAX_HARM, 1, {X}};
  double one = 1;
  guard g = guard_make(&m, 0, &one, -1);
  assert_false(search_turn(&m, &g, 0.3, 32).found);
}

/* Flat contacts, f = (1 + cos th)^k / 2^k + shift, a root of order 2k at pi: what costs most. Bounded by the
 * watchdog; k <= 4 here. */
static void flat_minima(CHECK_STATE)
{
  for (int k = 1; k <= 4; ++k)
    for (int i = -1; i <= 1; ++i) {
      double X[2 * 4 + 1] = {0}, p[9] = {1}, one = 1;
      for (int step = 0; step < 2 * k; ++step) /* ((1 + cos)/2)^k = cos^2k(th/2): binomials */
        for (int j = step + 1; j > 0; --j) p[j] += p[j - 1];
      for (int h = 0; h <= k; ++h) X[h ? 2 * h - 1 : 0] = (h ? 2 : 1) * p[k - h] / pow(4, k);
      series_vector m = {4, 1, {X}};
      guard g = guard_make(&m, 0, &one, i * 1e-10);
      outcome o = search_turn(&m, &g, 0.3, 32);
      if (o.found != (i < 0)) fail_msg("k=%d shift %d: %s", k, i, o.found ? "found" : "not found");
      if (i < 0) CHECK_NEAR((double)slow_value(&m, &g, 0, o.root), 0, slack_of(&m, &g), "k=%d", k);
    }
}

/* series_vector_at and the bounds that proofs rest on. */
static void nodes_and_bounds(CHECK_STATE)
{
  static double X[MAX_COEF], Y[MAX_COEF];
  uint64_t seed = 77;
  for (int H = 1; H <= MAX_HARM; H = H < 10 ? H + 3 : 3 * H) {
    random_motion(&seed, H, 1, 1, X);
    random_motion(&seed, H, 1, 2, Y);
    series_vector m = {H, 2, {X, Y}};
    for (int order = 0; order <= 1; ++order) {
      double a[2] = {random_signed(&seed), random_signed(&seed)};
      guard g = guard_make(&m, order, a, random_signed(&seed)), down = guard_negative(&g);
      for (int i = 0; i < 50; ++i) {
        double th = 2 * PI * (1 + random_signed(&seed));
        series_node node = series_vector_at(&m, th);
        double f = (double)slow_value(&m, &g, 0, th);
        CHECK_NEAR(guard_value(&g, &node), f, slack_of(&m, &g), "H=%d order=%d", H, order);
        assert_true(guard_value(&down, &node) == -guard_value(&g, &node));
        CHECK_LE(f, guard_upper(&g) + slack_of(&m, &g), "H=%d", H);
        CHECK_LE(guard_lower(&g), f + slack_of(&m, &g), "H=%d", H);
        CHECK_LE(fabs((double)slow_value(&m, &g, 2, th)), g.bound2 * (1 + 1e-12), "H=%d", H);
        CHECK_LE(fabs((double)slow_value(&m, &g, 3, th)), g.bound3 * (1 + 1e-12), "H=%d", H);
      }
    }
  }
}

CHECK_TESTS("numerics.crossing", 120, nodes_and_bounds, random_polynomials, grazing, roots_that_are_known,
            simple_roots_to_rounding, constants_and_zero, flat_minima)
