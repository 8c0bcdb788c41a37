/* test_roots.c - scalar searches against roots and minima known from mathematics, with functions that are smooth,
 * flat, have a jump or a kink, fail or are NaN. */
#include <float.h>

#include "numerics/roots.h"
#include "tests/check.h"

typedef struct watched { /* a function under search */
  double (*f)(double);
  double a, b;         /* the ends: no evaluation is to be made there */
  int calls, fails_at; /* the call that fails; 0: none */
  double last;
} watched;

static hc_status value_of(void *self, double x, double *f)
{
  watched *w = self;
  assert_true(x > fmin(w->a, w->b) && x < fmax(w->a, w->b));
  w->last = x;
  *f = w->f(x);
  return ++w->calls == w->fails_at ? HC_STALLED : HC_OK;
}

static double cubic(double x) { return x * x * x - 2 * x - 5; } /* Wallis's */
static double fixed_cosine(double x) { return cos(x) - x; }
static double growth(double x) { return exp(x) - 3; }
static double saturated(double x) { return atan(50 * (x - 1.0 / 3)); }
static double flat(double x) { return pow(x - 0.7, 9); }
static double jump(double x) { return x > 0.7 ? 1e9 : -1e-9; }
static double pole(double x) { return x > 0.7 ? 1 / (x - 0.7) : x < 0.7 ? 1 / (x - 0.7) : INFINITY; }

static const struct {
  const char *name;
  double (*f)(double);
  double a, b, root;
  bool simple; /* the root is, and the function is smooth over the whole bracket */
} cases[] = {
    {"cubic", cubic, 2, 3, 2.0945514815423265914823865405793, true},
    {"cos x = x", fixed_cosine, 0, 1, 0.73908513321516064165531208767387, true},
    {"exp", growth, -1, 4, 1.0986122886681096913952452369225, true},
    {"atan", saturated, -2, 9, 1.0 / 3, false},
    {"ninth power", flat, 0, 1, 0.7, false},
};
enum { CASES = sizeof cases / sizeof *cases };

/* A step is at least 4 roundings of x; the values near the root are known to some roundings of what they are made of,
 * below 10 for the cubic at 2.09, divided by the derivative, 11: another rounding or so of x. Half of either is x's
 * last bit. Flat: (x - 0.7)^9 is exact in sign. */
static double reach(double tolerance, double root) { return tolerance + 8 * DBL_EPSILON * root; }

static void roots_are_found_from_either_side(CHECK_STATE)
{
  for (int i = 0; i < CASES; ++i)
    for (int swapped = 0; swapped < 2; ++swapped)
      for (double tolerance = 1e-2; tolerance > 1e-17; tolerance /= 10) {
        double a = swapped ? cases[i].b : cases[i].a, b = swapped ? cases[i].a : cases[i].b;
        watched w = {.f = cases[i].f, .a = a, .b = b};
        CHECK_FILLED(root_point, root, root_between(value_of, &w, a, w.f(a), b, w.f(b), tolerance, &root));
        CHECK_NEAR(root.x, cases[i].root, reach(tolerance, cases[i].root), "%s to %g", cases[i].name, tolerance);
        assert_true(root.f == w.f(root.x));
        assert_int_equal(root.evaluations, w.calls);
        /* the secant's order 1.6 multiplies the correct digits 1, 2, 3, 5, 8, 13, 21: seven, two that close the
         * bracket, and as many again before it converges */
        if (cases[i].simple) CHECK_LE(w.calls, 11, "%s to %g", cases[i].name, tolerance);
      }
}

/* Interpolation is of no use: one half at each step, but for the secant at the start; one more for a rounding up, and
 * one for the last step, which is as long as the tolerance allows. */
static void jumps_and_poles_cost_a_bisection(CHECK_STATE)
{
  double (*const f[])(double) = {jump, pole};
  for (int i = 0; i < 2; ++i) {
    for (int infinite = 0; infinite < 2; ++infinite) {
      watched w = {.f = f[i], .a = -3, .b = 4};
      double fb = infinite ? INFINITY : w.f(4);
      CHECK_FILLED(root_point, root, root_between(value_of, &w, -3, w.f(-3), 4, fb, 1e-12, &root));
      CHECK_NEAR(root.x, 0.7, 1e-12, "%d", i);
      CHECK_LE(w.calls, log2(7 / 1e-12) + 3, "%d", i);
    }
  }
}

static double line(double x) { return x - 0.25; }

static void a_straight_line_takes_one_evaluation(CHECK_STATE)
{
  watched w = {.f = line, .a = -0.75, .b = 2.25};
  CHECK_FILLED(root_point, root, root_between(value_of, &w, -0.75, -1, 2.25, 2, 1e-9, &root));
  assert_true(root.x == 0.25 && root.f == 0 && root.evaluations == 1);
}

/* 0 counts as not positive. At an end it is the answer if nothing between changes sign. */
static void an_end_may_be_the_root(CHECK_STATE)
{
  watched w = {.f = sin, .a = 0, .b = 1};
  CHECK_FILLED(root_point, root, root_between(value_of, &w, 0, 0, 1, sin(1), 1e-9, &root));
  CHECK_NEAR(root.x, 0, 1e-9, "at a");
  w.a = 1, w.b = 0;
  assert_int_equal(root_between(value_of, &w, 1, sin(1), 0, 0, 1e-9, &root), HC_OK);
  CHECK_NEAR(root.x, 0, 1e-9, "at b");
  w.a = PI, w.b = 7; /* 0 at a, below it at once, and back at 2 pi */
  assert_int_equal(root_between(value_of, &w, PI, 0, 7, sin(7), 1e-9, &root), HC_OK);
  CHECK_NEAR(root.x, 2 * PI, 1e-9, "beyond a");
}

static void what_is_no_bracket_is_refused(CHECK_STATE)
{
  static const double bad[][4] = {{0, 1, 1, 2},    {0, -1, 1, -2},  {0, 0, 1, -1},       {0, NAN, 1, 1},
                                  {0, -1, 1, NAN}, {NAN, -1, 1, 1}, {0, -1, INFINITY, 1}};
  watched w = {.f = sin};
  root_point root;
  for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
    const double *k = bad[i];
    assert_int_equal(root_between(value_of, &w, k[0], k[1], k[2], k[3], 1e-9, &root), HC_BAD_INPUT);
  }
  static const double no_valley[][6] = {
      {0, 1, 1, 2, 2, 3}, {0, 3, 1, 2, 2, 1}, {0, 1, 0, 0, 1, 1}, {1, 1, 0.5, 0, 0, 1}, {0, 1, 0.5, NAN, 1, 1}};
  for (size_t i = 0; i < sizeof no_valley / sizeof *no_valley; ++i) {
    const double *v = no_valley[i];
    assert_int_equal(root_minimum(value_of, &w, v[0], v[1], v[2], v[3], v[4], v[5], 1e-9, &root), HC_BAD_INPUT);
  }
  assert_int_equal(w.calls, 0);
}

static double holed(double x) { return x > 0.4 && x < 0.9 ? NAN : x - 0.7; }
static double parabola(double x) { return (x - 0.7) * (x - 0.7) + 1e-3 * x; }

/* The function's own status comes back at once, NaN is HC_NOT_FINITE, and what is known by then is kept. */
static void a_failure_ends_the_search(CHECK_STATE)
{
  root_point root;
  for (int at = 1; at < 5; ++at) {
    watched w = {.f = cubic, .a = -9, .b = 9, .fails_at = at};
    assert_int_equal(root_between(value_of, &w, -9, cubic(-9), 9, cubic(9), 1e-15, &root), HC_STALLED);
    assert_int_equal(w.calls, at);
    assert_int_equal(root.evaluations, at);
    CHECK_LE(fabs(root.f), fabs(cubic(9)), "no worse than the ends");
    assert_true(root.f == cubic(root.x));
    watched v = {.f = parabola, .a = -9, .b = 9, .fails_at = at};
    hc_status st = root_minimum(value_of, &v, -9, parabola(-9), 0, parabola(0), 9, parabola(9), 1e-15, &root);
    assert_int_equal(st, HC_STALLED);
    CHECK_LE(root.f, parabola(0), "no worse than the start");
    assert_true(root.x != v.last);
  }
  watched w = {.f = holed, .a = 0, .b = 1};
  assert_int_equal(root_between(value_of, &w, 0, -0.7, 1, 0.3, 1e-9, &root), HC_NOT_FINITE);
  assert_int_equal(root_minimum(value_of, &w, 0, 1, 0.5, 0, 1, 1, 1e-9, &root), HC_NOT_FINITE);
}

static double tiny_jump(double x) { return x > 1e-300 ? 1 : -1; }

/* Next to 0 a rounding of x is no bound: 1000 halvings lead to 1e-300, 200 are made. */
static void a_search_that_would_not_end_is_given_up(CHECK_STATE)
{
  watched w = {.f = tiny_jump, .a = -1, .b = 0.9};
  root_point root;
  assert_int_equal(root_between(value_of, &w, -1, -1, 0.9, 1, 0, &root), HC_NOT_CONVERGED);
  assert_int_equal(w.calls, ROOTS_MAX_EVALUATIONS);
  CHECK_LE(fabs(root.x), 1e-50, "the best so far");
}

static double cosh_at(double x) { return cosh(x - 1.25); }
static double kink(double x) { return fabs(x - 0.3) + 0.2 * x; }
static double quartic(double x) { return pow(x + 0.6, 4); }
static double lopsided(double x) { return x - log(x); }
static double terrace(double x) { return x < 0.5 ? 1 - x : 0.5; }

/* f known to u |f| hides where its minimum lies to sqrt(2 u |f|/f''): 1.5e-8 of cosh and x - log x. */
static void minima_are_found(CHECK_STATE)
{
  static const struct {
    double (*f)(double);
    double a, m, b, lowest;
    int at_most;
  } at[] = {
      /* order 1.3 of parabolas multiplies digits by 1.3 a step: 1e-8 from 1 takes 11; two more close the bracket;
       * golden section would take log(range/1e-8)/log(1.618) = 41 */
      {cosh_at, -1, 0.5, 3, 1.25, 16},
      {lopsided, 0.1, 2, 9, 1, 20},
      /* no parabola helps: at worst two steps for one of golden section */
      {kink, -2, 0, 4, 0.3, 82},
      {quartic, -3, 0, 1, -0.6, 82},
  };
  for (size_t i = 0; i < sizeof at / sizeof *at; ++i)
    for (double tolerance = 1e-3; tolerance > 1e-8; tolerance /= 10) {
      watched w = {.f = at[i].f, .a = at[i].a, .b = at[i].b};
      root_point low;
      hc_status st = root_minimum(value_of, &w, w.a, w.f(w.a), at[i].m, w.f(at[i].m), w.b, w.f(w.b), tolerance, &low);
      assert_int_equal(st, HC_OK);
      CHECK_NEAR(low.x, at[i].lowest, tolerance + 2e-8, "%zu to %g", i, tolerance);
      assert_true(low.f == w.f(low.x));
      assert_int_equal(low.evaluations, w.calls);
      CHECK_LE(w.calls, at[i].at_most, "%zu to %g", i, tolerance);
    }
  watched w = {.f = terrace, .a = 0, .b = 1}; /* any place on the terrace is a minimum */
  CHECK_FILLED(root_point, low, root_minimum(value_of, &w, 0, 1, 0.75, 0.5, 1, 0.5, 1e-6, &low));
  assert_true(low.f == 0.5 && low.x >= 0.5);
}

static double cusp_at;
static double cusp(double x) { return sqrt(fabs(x - cusp_at)) + (x > cusp_at ? 0.1 : 0); }

/* No parabola fits a cusp, and the last point is anywhere in the last bracket: of 200 cusps some are next to its end.
 * Golden section alone takes log(3/1e-4)/log(1.618) = 22, and each of its steps may follow a parabola in vain. */
static void a_minimum_is_as_near_as_was_asked(CHECK_STATE)
{
  double farthest = 0;
  for (int i = 0; i < 200; ++i) {
    root_point low;
    watched w = {.f = cusp, .a = -1, .b = 2};
    cusp_at = 0.3 + i / 500.0;
    double m = cusp_at - 0.01;
    hc_status st = root_minimum(value_of, &w, -1, cusp(-1), m, cusp(m), 2, cusp(2), 1e-4, &low);
    assert_int_equal(st, HC_OK);
    CHECK_NEAR(low.x, cusp_at, 1e-4, "%d", i);
    CHECK_LE(w.calls, 44, "%d", i);
    farthest = fmax(farthest, fabs(low.x - cusp_at));
  }
  CHECK_LE(2e-5, farthest, "the tolerance is put to use");
}

static hc_status beyond(void *self, double x, bool *is)
{
  watched *w = self;
  *is = w->f(x) > 0;
  return ++w->calls == w->fails_at ? HC_STALLED : HC_OK;
}

static void a_change_is_bisected(CHECK_STATE)
{
  for (int swapped = 0; swapped < 2; ++swapped) {
    watched w = {.f = swapped ? cos : jump}; /* cos x > 0 below pi/2 */
    double a = swapped ? 3 : 0, b = swapped ? -1 : 1, at = swapped ? PI / 2 : 0.7;
    CHECK_FILLED(root_point, change, root_change(beyond, &w, a, b, 1e-9, &change));
    assert_true(w.f(change.x) > 0 && w.f(change.before) <= 0);
    CHECK_LE(fabs(change.x - change.before), 1e-9, "%d", swapped);
    CHECK_NEAR(change.x, at, 1e-9, "%d", swapped);
    assert_int_equal(w.calls, (int)ceil(log2(fabs(b - a) / 1e-9)));
    assert_int_equal(change.evaluations, w.calls);
    w.calls = 0, w.fails_at = 5;
    assert_int_equal(root_change(beyond, &w, a, b, 1e-9, &change), HC_STALLED);
    assert_int_equal(w.calls, 5);
  }
}

/* A change at `at`, and a guess of it that is off by curvature times the square of the width between the two nearest
 * points at which it was asked, as that of a straight line through them would be. */
typedef struct guessed {
  double at, second_from, second_to; /* beyond, too; ends before the change at `at` */
  double before, beyond, curvature;
  int calls, fails_at;
  bool guess_fails;
} guessed;

static bool is_past(const guessed *g, double x) { return x > g->at || (x > g->second_from && x < g->second_to); }

static hc_status past(void *self, double x, bool *is)
{
  guessed *g = self;
  *is = is_past(g, x);
  *(*is ? &g->beyond : &g->before) = x;
  return ++g->calls == g->fails_at ? HC_STALLED : HC_OK;
}

static hc_status likely_past(void *self, double x, bool *is)
{
  const guessed *g = self;
  const double width = g->beyond - g->before;
  *is = is_past(g, x - g->curvature * width * width);
  return g->guess_fails ? HC_NOT_FINITE : HC_OK;
}

/* A guess that is off by c w^2 at the width w is found to half the margin: it holds where
 * c w^2 is less than the other half. With c = 0.015 and w = 1, then 1/16, it always does: widths of two margins, 6e-2,
 * 2e-4, 4e-9, and 5e-12 by the tolerance, take two questions each. */
static void a_good_guess_saves_questions(CHECK_STATE)
{
  for (int i = 0; i < 50; ++i) {
    guessed g = {.at = 0.05 + 0.0179 * i, .before = 0, .beyond = 1, .curvature = 0.015};
    CHECK_FILLED(root_point, change, root_change_guided(past, likely_past, &g, 0, 1, 1e-11, &change));
    CHECK_LE(fabs(change.x - change.before), 1e-11, "%d", i);
    assert_true(change.before <= g.at && g.at < change.x);
    CHECK_LE(g.calls, 8, "%d", i);
    assert_int_equal(change.evaluations, g.calls);
  }
}

/* Each round halves the bracket whatever the guess, for three questions at most: 3 log2(1e11) = 111. */
static void a_bad_guess_is_survived(CHECK_STATE)
{
  static const double off[] = {1e9, -1e9, 7, -0.5}; /* always before, always beyond, and in between */
  for (int i = 0; i < 8; ++i) {
    guessed g = {.at = 0.3 + 0.1 * i / 8, .before = 0, .beyond = 1, .curvature = off[i % 4], .guess_fails = i > 3};
    CHECK_FILLED(root_point, change, root_change_guided(past, likely_past, &g, 0, 1, 1e-11, &change));
    CHECK_LE(fabs(change.x - change.before), 1e-11, "%d", i);
    assert_true(change.before <= g.at && g.at < change.x);
    CHECK_LE(g.calls, 111, "%d", i);
    g.calls = 0, g.fails_at = 5, g.before = 0, g.beyond = 1;
    assert_int_equal(root_change_guided(past, likely_past, &g, 0, 1, 1e-11, &change), HC_STALLED);
    assert_int_equal(g.calls, 5);
  }
}

/* Downwards, too; a tolerance below rounding ends at 4 roundings. */
static void the_first_change_that_is_guessed_is_found(CHECK_STATE)
{
  guessed g = {.at = 0.9, .second_from = 0.3, .second_to = 0.5, .before = 0, .beyond = 1};
  CHECK_FILLED(root_point, change, root_change_guided(past, likely_past, &g, 0, 1, 0, &change));
  CHECK_NEAR(change.x, 0.3, 4 * DBL_EPSILON * 0.3, "%d", 0);
  watched w = {.f = cos};
  assert_int_equal(root_change_guided(beyond, beyond, &w, 3, -1, 1e-9, &change), HC_OK);
  CHECK_NEAR(change.x, PI / 2, 1e-9, "%d", 1);
  assert_true(change.x < change.before);
  assert_int_equal(root_change_guided(beyond, beyond, &w, 3, NAN, 1e-9, &change), HC_BAD_INPUT);
}

CHECK_TESTS("numerics.roots", 30, roots_are_found_from_either_side, jumps_and_poles_cost_a_bisection,
            an_end_may_be_the_root, what_is_no_bracket_is_refused, a_failure_ends_the_search,
            a_search_that_would_not_end_is_given_up, minima_are_found, a_minimum_is_as_near_as_was_asked,
            a_straight_line_takes_one_evaluation, a_change_is_bisected, a_good_guess_saves_questions,
            a_bad_guess_is_survived, the_first_change_that_is_guessed_is_found)
