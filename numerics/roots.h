/* roots.h - roots and minima of a function of one variable between two ends. The function may fail, and may be
 * costly: every evaluation is counted, and none is made at an end, whose values the caller has. libm only, nothing is
 * allocated.
 *
 * What the searches have in common: HC_BAD_INPUT where the ends do not enclose what is searched for (an end or a value
 * that is NaN included), HC_NOT_FINITE where the function is NaN, HC_NOT_CONVERGED after ROOTS_MAX_EVALUATIONS, else
 * the status of the function if that is not HC_OK; *out then holds the best point so far. A tolerance is absolute; less
 * than 4 roundings of x count as 4 roundings. */
#pragma once

#include <stdbool.h>

#include "numerics/base/status.h"

enum { ROOTS_MAX_EVALUATIONS = 200 };

typedef struct root_point {
  double x, f;     /* f(x) */
  int evaluations; /* spent by the search */
  double before;   /* of root_change...: the nearest point seen on this side of the change */
} root_point;

/* *f = f(x); self is the caller's. */
typedef hc_status root_function(void *self, double x, double *f);
/* *beyond: does x lie beyond the change? */
typedef hc_status root_predicate(void *self, double x, bool *beyond);

/* Where f changes sign between a and b (either may be the greater), f(a) = fa and f(b) = fb: one is > 0, the other
 * <= 0. Inverse quadratic interpolation where the last three points say that it holds, else bisection (Chandrupatla,
 * Adv. Eng. Softw. 28 (1997) 145). The change lies within `tolerance` of out->x, unless out->f is 0. */
hc_status root_between(root_function *f, void *self, double a, double fa, double b, double fb, double tolerance,
                       root_point *out);

/* A minimum of f between a and b (a < b), m between them being no higher than either end: f(m) = fm <= f(a) = fa,
 * f(b) = fb. Parabolas through the three lowest points, else golden section (Brent 1973, ch. 5). out->x is within
 * `tolerance` of a minimum of a function that has only one there; f being flat, the
 * error is at least about sqrt(DBL_EPSILON) of x where f'' x^2 is about as large as f. */
hc_status root_minimum(root_function *f, void *self, double a, double fa, double m, double fm, double b, double fb,
                       double tolerance, root_point *out);

/* Where a predicate changes, false at a and true at b, by bisection. out->x lies beyond the change and within
 * `tolerance` of it (b itself if nothing nearer does); out->f is 1. */
hc_status root_change(root_predicate *beyond, void *self, double a, double b, double tolerance, root_point *out);

/* The same where `likely` guesses at little cost what `beyond` would say, the better the nearer the points at which it
 * was asked. Each round finds where the guess changes first, in eighths and then by bisection, and asks `beyond` on
 * either side of it, at a distance that shrinks as long as the guess holds; where it does not, at the middle. `likely`
 * is not counted, and where it fails, it is as if it were wrong. */
hc_status root_change_guided(root_predicate *beyond, root_predicate *likely, void *self, double a, double b,
                             double tolerance, root_point *out);

typedef double sloped_function(const void *self, double x, double *slope); /* f(x) and its slope, without failure */
/* The root in [a, b], where f falls from f(a) = fa >= 0 to below 0 without turning: Newton from x, kept inside by
 * bisection, to the rounding of origin + x. */
double root_falling(sloped_function *f, const void *self, double a, double fa, double b, double x, double origin);
