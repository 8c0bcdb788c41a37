/* gauss.h - integrals by Gauss's rule of sixteen points (Abramowitz and Stegun 1964, table 25.4) on panels of equal
 * width. Exact for polynomials of degree 31 on each. Nothing is allocated, nothing can fail. */
#pragma once

/* Callback: value[2] = two functions at x. */
typedef void gauss_functions(const void *self, double x, double value[2]);

/* sum[k] = integral of value[k] over [from, to], n_panels >= 1. */
void gauss_integrals(gauss_functions *f, const void *self, double from, double to, int n_panels, double sum[2]);

/* Nodes in (-1, 1), ascending, and weights of the rule, or of that of four points (exact for degree 7), for other
 * numbers of functions: i = 0..points-1, points = GAUSS_POINTS or GAUSS_FEW. */
enum { GAUSS_POINTS = 16, GAUSS_FEW = 4 };
double gauss_node(int points, int i);
double gauss_weight(int points, int i);
