/* roots.h - roots and minima of a function of one variable between two ends. The function may fail, and may be costly:
 * every evaluation is counted, and none is made at an end, whose values the caller passes. libm only, nothing is
 * allocated.
 *
 * Common to all: HC_BAD_INPUT if the ends do not enclose a root, minimum or change (also if an end or a value is NaN),
 * HC_NOT_FINITE if the function is NaN, HC_NOT_CONVERGED after ROOTS_MAX_EVALUATIONS, else the function's status if not
 * HC_OK; *out then holds the best point so far. Tolerances are absolute, and at least 4 roundings of x. */
#pragma once

#include <stdbool.h>

#include "numerics/base/status.h"

enum { ROOTS_MAX_EVALUATIONS = 200 };

typedef struct root_point {
  double x, f;     /* f(x) */
  int evaluations; /* number of evaluations by the search */
  double before;   /* root_change and root_change_guided: nearest evaluated point before the change */
} root_point;

/* Callback: *f = f(x). */
typedef hc_status root_function(void *self, double x, double *f);
/* Callback: *beyond = true if x lies beyond the change. */
typedef hc_status root_predicate(void *self, double x, bool *beyond);

/* A sign change of f between a and b, in any order, where f(a) = fa and f(b) = fb, one > 0, the other <= 0. Inverse
 * quadratic interpolation where the last three points justify it, else bisection (Chandrupatla, Adv. Eng. Softw. 28
 * (1997) 145). The change lies within `tolerance` of out->x, unless out->f is 0. */
hc_status root_between(root_function *f, void *self, double a, double fa, double b, double fb, double tolerance,
                       root_point *out);

/* A minimum of f between a and b, a < m < b, with f(m) = fm not above f(a) = fa and f(b) = fb. Parabolas through the
 * three lowest points, else golden section (Brent 1973, ch. 5). out->x is within `tolerance` of the minimum if there is
 * only one; since f is flat there, the error is at least about sqrt(DBL_EPSILON) x if f'' x^2 is about f. */
hc_status root_minimum(root_function *f, void *self, double a, double fa, double m, double fm, double b, double fb,
                       double tolerance, root_point *out);

/* The change of a predicate, false at a and true at b, by bisection. out->x lies beyond the change and within
 * `tolerance` of it (possibly b itself); out->f is 1. */
hc_status root_change(root_predicate *beyond, void *self, double a, double b, double tolerance, root_point *out);

/* The same with a cheap approximation `likely` of `beyond`, which may improve as the search closes in. Each round
 * locates the first change of `likely`, in eighths and then by bisection, and evaluates `beyond` on either side of it,
 * at a margin that shrinks while `likely` is right; if it is wrong, in the middle. Evaluations of `likely` are not
 * counted; its failures count as wrong. */
hc_status root_change_guided(root_predicate *beyond, root_predicate *likely, void *self, double a, double b,
                             double tolerance, root_point *out);

typedef double sloped_function(const void *self, double x, double *slope); /* f(x) and its slope; cannot fail */
/* The root in [a, b], over which f falls monotonically from f(a) = fa >= 0 to below 0: Newton from x, safeguarded by
 * bisection, to the rounding of origin + x. */
double root_falling(sloped_function *f, const void *self, double a, double fa, double b, double x, double origin);
