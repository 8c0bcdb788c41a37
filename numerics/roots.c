/* roots.c - see roots.h. Proof: tests/numerics/test_roots.c. */
#include "numerics/roots.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

static double at_least_rounding(double tolerance, double x) { return fmax(tolerance, 4 * DBL_EPSILON * fabs(x)); }

/* HC_NOT_CONVERGED if no more evaluation is allowed. */
static hc_status count_evaluation(root_point *out)
{
  return out->evaluations++ < ROOTS_MAX_EVALUATIONS ? HC_OK : HC_NOT_CONVERGED;
}

static hc_status evaluate(root_function *f, void *self, double x, root_point *out, double *value)
{
  hc_status st = count_evaluation(out);
  if (st == HC_OK) st = f(self, x, value);
  return st == HC_OK && isnan(*value) ? HC_NOT_FINITE : st;
}

/* a: the newest point; b: the end of the bracket on the other side; c: the point that a replaced as an end. */
typedef struct bracket {
  double a, fa, b, fb, c, fc;
} bracket;

/* Next point as a fraction of the way from a to b: zero of x as a quadratic in f through the three points.
 * Chandrupatla's condition: that quadratic is monotone over the bracket; else one half. */
static double part_of_way(const bracket *k)
{
  double xi = (k->a - k->b) / (k->c - k->b), phi = (k->fa - k->fb) / (k->fc - k->fb);
  if (!(phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)) return 0.5;
  return k->fa / (k->fb - k->fa) * (k->fc / (k->fb - k->fc)) +
         (k->c - k->a) / (k->b - k->a) * (k->fa / (k->fc - k->fa)) * (k->fb / (k->fc - k->fb));
}

hc_status root_between(root_function *f, void *self, double a, double fa, double b, double fb, double tolerance,
                       root_point *out)
{
  bracket k = {a, fa, b, fb, a, fa};
  *out = (root_point){NAN, NAN, 0, NAN};
  if (!isfinite(a) || !isfinite(b) || !(!isnan(fa) && !isnan(fb) && (fa > 0) != (fb > 0))) return HC_BAD_INPUT;
  double part = isfinite(fa - fb) ? fa / (fa - fb) : 0.5; /* the secant */
  for (;;) {
    bool by_low = fabs(k.fa) <= fabs(k.fb);
    out->x = by_low ? k.a : k.b;
    out->f = by_low ? k.fa : k.fb;
    double width = fabs(k.b - k.a), wanted = at_least_rounding(tolerance, out->x);
    if (width <= wanted) return HC_OK;
    double least = fmin(0.5, 0.5 * wanted / width), value;
    double x = k.a + fmin(fmax(part, least), 1 - least) * (k.b - k.a);
    hc_status st = evaluate(f, self, x, out, &value);
    if (st != HC_OK) return st;
    if ((value > 0) == (k.fa > 0)) k.c = k.a, k.fc = k.fa;
    else k.c = k.b, k.fc = k.fb, k.b = k.a, k.fb = k.fa;
    k.a = x, k.fa = value;
    if (value == 0) {
      out->x = x, out->f = 0;
      return HC_OK;
    }
    part = part_of_way(&k);
  }
}

/* The three lowest points, f(x) <= f(w) <= f(v), between the ends a and b. */
typedef struct valley {
  double a, b, x, fx, w, fw, v, fv;
} valley;

/* Step from x to the lowest point of the parabola through the three; NaN where they lie on a line. */
static double parabola_step(const valley *k)
{
  double r = (k->x - k->w) * (k->fx - k->fv), q = (k->x - k->v) * (k->fx - k->fw);
  double p = (k->x - k->v) * q - (k->x - k->w) * r, twice = 2 * (q - r);
  return twice != 0 ? -p / twice : NAN;
}

/* A new point, in the place of an end and of one of the three lowest points. */
static void insert_point(valley *k, double u, double fu)
{
  if (fu <= k->fx) {
    if (u < k->x) k->b = k->x;
    else k->a = k->x;
    k->v = k->w, k->fv = k->fw;
    k->w = k->x, k->fw = k->fx;
    k->x = u, k->fx = fu;
    return;
  }
  if (u < k->x) k->a = u;
  else k->b = u;
  if (fu <= k->fw || k->w == k->x) {
    k->v = k->w, k->fv = k->fw;
    k->w = u, k->fw = fu;
  } else if (fu <= k->fv || k->v == k->x || k->v == k->w) {
    k->v = u, k->fv = fu;
  }
}

hc_status root_minimum(root_function *f, void *self, double a, double fa, double m, double fm, double b, double fb,
                       double tolerance, root_point *out)
{
  const double golden = 0.38196601125010515; /* (3 - sqrt 5)/2 */
  *out = (root_point){NAN, NAN, 0, NAN};
  if (!(a < m && m < b && fm <= fa && fm <= fb)) return HC_BAD_INPUT;
  valley k = {a, b, m, fm, fa <= fb ? a : b, fmin(fa, fb), fa <= fb ? b : a, fmax(fa, fb)};
  double step = b - a, before = step; /* the last step and the one before it */
  for (;;) {
    out->x = k.x, out->f = k.fx;
    double wanted = at_least_rounding(tolerance, k.x), least = 0.5 * wanted, fu;
    if (fmax(k.x - k.a, k.b - k.x) <= wanted) return HC_OK;
    double next = parabola_step(&k), u = k.x + next;
    if (u > k.a && u < k.b && fabs(next) < 0.5 * fabs(before)) {
      before = step;
      /* next to an end, whose value is known: a least step towards the middle instead */
      if (u - k.a < wanted || k.b - u < wanted) next = copysign(least, 0.5 * (k.a + k.b) - k.x);
    } else {
      before = k.x >= 0.5 * (k.a + k.b) ? k.a - k.x : k.b - k.x;
      next = golden * before;
    }
    step = fabs(next) >= least ? next : copysign(least, next);
    u = k.x + step;
    hc_status st = evaluate(f, self, u, out, &fu);
    if (st != HC_OK) return st;
    insert_point(&k, u, fu);
  }
}

/* A predicate's change lies between out->before and out->x. */
typedef struct change_search {
  root_predicate *beyond, *likely;
  void *self;
  root_point *out;
} change_search;

static double width_of(const change_search *k) { return k->out->x - k->out->before; }

/* Evaluate `beyond` at x and move that end of the bracket to x; *is_beyond: its value. */
static hc_status ask_beyond(change_search *k, double x, bool *is_beyond)
{
  *is_beyond = false;
  hc_status st = count_evaluation(k->out);
  if (st == HC_OK) st = k->beyond(k->self, x, is_beyond);
  if (st != HC_OK) return st;
  *(*is_beyond ? &k->out->x : &k->out->before) = x;
  return HC_OK;
}

static hc_status ask_middle(change_search *k)
{
  bool is_beyond;
  return ask_beyond(k, 0.5 * (k->out->before + k->out->x), &is_beyond);
}

hc_status root_change(root_predicate *beyond, void *self, double a, double b, double tolerance, root_point *out)
{
  *out = (root_point){b, 1, 0, a};
  change_search k = {beyond, NULL, self, out};
  if (!isfinite(a) || !isfinite(b)) return HC_BAD_INPUT;
  hc_status st = HC_OK;
  while (st == HC_OK && fabs(width_of(&k)) > at_least_rounding(tolerance, out->x)) st = ask_middle(&k);
  return st;
}

/* *x: first change of `likely`, scanned in eighths of the bracket, to within `margin`. False if `likely` fails. */
static bool find_likely_change(const change_search *k, double margin, double *x)
{
  const double eighth = width_of(k) / 8;
  double a = k->out->before, b = k->out->x;
  bool is_beyond = false;
  for (int i = 1; i < 8 && !is_beyond; ++i) {
    const double next = k->out->before + i * eighth;
    if (k->likely(k->self, next, &is_beyond) != HC_OK) return false;
    *(is_beyond ? &b : &a) = next;
  }
  while (fabs(b - a) > margin) {
    *x = 0.5 * (a + b);
    if (*x == a || *x == b) break;
    if (k->likely(k->self, *x, &is_beyond) != HC_OK) return false;
    *(is_beyond ? &b : &a) = *x;
  }
  *x = 0.5 * (a + b);
  return true;
}

static bool is_between(const change_search *k, double x) { return (x - k->out->before) * (k->out->x - x) > 0; }

/* Evaluate `beyond` at `margin` on either side of the likely change. *held: `likely` was right at both. */
static hc_status ask_around(change_search *k, double margin, bool *held)
{
  const double step = copysign(margin, width_of(k));
  double likely = NAN;
  bool is_beyond = false;
  hc_status st = HC_OK;
  *held = find_likely_change(k, margin, &likely);
  if (*held && is_between(k, likely - step)) {
    st = ask_beyond(k, likely - step, &is_beyond);
    *held = !is_beyond;
  }
  if (st == HC_OK && *held && is_between(k, likely + step)) {
    st = ask_beyond(k, likely + step, &is_beyond);
    *held = is_beyond;
  }
  return st;
}

hc_status root_change_guided(root_predicate *beyond, root_predicate *likely, void *self, double a, double b,
                             double tolerance, root_point *out)
{
  const double first = 1.0 / 32, worst = 0.25; /* [width] first and largest margin */
  *out = (root_point){b, 1, 0, a};
  change_search k = {beyond, likely, self, out};
  double part = first;
  if (!isfinite(a) || !isfinite(b)) return HC_BAD_INPUT;
  for (;;) {
    const double width = fabs(width_of(&k)), wanted = at_least_rounding(tolerance, out->x);
    bool held;
    if (width <= wanted) return HC_OK;
    hc_status st = ask_around(&k, fmax(part * width, 0.25 * wanted), &held);
    part = held ? 2 * part * part : fmin(8 * part, worst); /* the width has shrunk to two margins */
    if (st == HC_OK && !held && fabs(width_of(&k)) > 0.5 * width) st = ask_middle(&k);
    if (st != HC_OK) return st;
  }
}

double root_falling(sloped_function *f, const void *self, double a, double fa, double b, double x, double origin)
{
  if (!(fa > 0)) return a;
  for (int it = 0; it < ROOTS_MAX_EVALUATIONS; ++it) {
    double slope;
    const double value = f(self, x, &slope);
    if (value > 0) a = x;
    else b = x;
    double next = x - value / slope;
    if (fabs(next - x) <= 2 * DBL_EPSILON * (1 + x + origin)) break;
    if (!(next > a && next < b)) next = 0.5 * (a + b);
    if (next == x) break;
    x = next;
  }
  return x;
}
