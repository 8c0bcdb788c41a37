/* crossing.h - the first angle where a guard, a trigonometric polynomial plus a constant, falls through 0 in an
 * interval. libm only. */
#ifndef HC_CROSSING_H
#define HC_CROSSING_H

#include <stdbool.h>

#include "numerics/series_grid.h"

typedef struct guard {
  int dim, order; /* f = sum a[d] x_d^(order) + constant */
  double a[SERIES_MAX_DIM], constant;
  double size;                   /* bound of |f - mean - constant| */
  double mean;                   /* of f without the constant */
  double bound1, bound2, bound3; /* of |f'|, |f''|, |f'''| */
  double noise; /* f is not told from 0 below this: rounding of f itself, and of the angles it is evaluated at */
} guard;

guard guard_make(const series_vector *m, int order, const double *a, double constant);
guard guard_negative(const guard *g);

double guard_value(const guard *g, const series_node *at);

/* Bounds of f over the whole period. */
static inline double guard_lower(const guard *g) { return g->mean + g->constant - g->size; }
static inline double guard_upper(const guard *g) { return g->mean + g->constant + g->size; }

/* The size of what f is made of: rounding errors are relative to it. */
double guard_scale(const guard *g);

/* f >= 0 at a (to rounding). The first angle in (a, b] where it becomes negative, with its node; false if there is
 * none. Excursions below 0 that are not distinguishable from rounding do not count. */
bool crossing_first(const series_vector *m, const guard *g, const series_node *a, const series_node *b,
                    series_node *root);

#endif
