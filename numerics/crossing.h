/* crossing.h - the first angle in an interval where a guard falls through 0; a guard is any function with bounds of its
 * derivatives, or a trigonometric polynomial plus a constant. libm only. */
#pragma once

#include <stdbool.h>

#include "numerics/series.h"

typedef struct guarded_point {
  double th, f, d1, d2; /* the angle, f, f', f'' */
} guarded_point;

typedef struct guarded {
  guarded_point (*at)(void *self, double th);
  void *self;
  double noise, bound2, bound3; /* rounding error of f; bound of |f''|; bound of |f'''| or INFINITY */
} guarded;

/* *root: first angle in (a, b] where f, >= 0 at a to rounding, becomes negative; false if there is none. None is
 * missed, double roots (grazing) included, except excursions below 0 by less than `noise`. */
bool guarded_first(const guarded *s, guarded_point a, guarded_point b, guarded_point *root);

/* f(th) = sum a[d] x_d^(order)(th) + constant; order 0: values, 1: first derivatives. */
typedef struct guard {
  int dim, order;
  double a[SERIES_MAX_DIM], constant;
  double size;                   /* bound of |f - mean - constant| */
  double mean;                   /* mean of f without the constant */
  double bound1, bound2, bound3; /* bounds of |f'|, |f''|, |f'''| */
  double noise;                  /* rounding error of f and by its angle */
} guard;

guard guard_make(const series_vector *m, int order, const double *a, double constant);
guard guard_negative(const guard *g); /* the guard -f */

double guard_value(const guard *g, const series_node *at);

/* Bounds of f over the whole period. */
static inline double guard_lower(const guard *g) { return g->mean + g->constant - g->size; }
static inline double guard_upper(const guard *g) { return g->mean + g->constant + g->size; }

/* Sum of the sizes of f's terms, to which its rounding errors are relative. */
double guard_scale(const guard *g);

/* guarded_first of a guard, with the node of the root. */
bool crossing_first(const series_vector *m, const guard *g, const series_node *a, const series_node *b,
                    series_node *root);

/* Largest and smallest value of sum a[d] x_d on [from, to], to rounding: every extremum is found. */
void guard_extrema(const series_vector *m, const double *a, double from, double to, double *max, double *min);
