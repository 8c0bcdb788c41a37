/* exponentials.h - sums of exponentials, g(tau) = constant + Re sum_k by_k e^{rate_k tau}; where one falls through 0.
 * Nothing is allocated, libm only.
 *
 * Each step of the search is so short that a bound proves g positive over it. For any split at k, the slow terms are
 * bounded by their second derivatives, the fast ones by their sizes:
 *     g(tau + h) >= slow + slow' h - h^2/2 sum_slow |rate|^2 |by e^{rate tau}| - sum_fast |by e^{rate tau}|
 * and the best split is used: a fast mode of negligible amplitude does not shorten the step. No root is missed except
 * an excursion of less than the noise. */
#pragma once

#include <complex.h>
#include <math.h>

typedef struct exponentials { /* arrays are not owned */
  int n;
  const double complex *rate; /* [n] best ascending by modulus, which gives close bounds */
  double complex *now;        /* [n] e^{rate tau} at the tau of the search */
  double *size;               /* [n] their moduli */
} exponentials;

typedef struct exponential_sum {
  double constant, noise; /* g = constant + Re sum_k by_k e^{rate_k tau}; negative if below -noise */
  double complex *by;     /* [n] */
  double *size;           /* [n] |by_k|, required by the search; else NULL */
} exponential_sum;

/* The value and the derivative at tau; slope may be NULL. */
double exponential_sum_at(const exponentials *e, const exponential_sum *s, double tau, double *slope);

/* (e^z - 1)/z without cancellation; 1 at 0. */
double complex exponential_quotient(double complex z);

/* Fills s->size, and raises s->noise to at least the rounding of the sum. */
void exponential_sum_measure(const exponentials *e, exponential_sum *s);

/* Index of the first of n_sums that falls through 0 between `from` and `to`, *at: where; -1 if none does. A sum below
 * -noise at `from` counts as falling there. */
int exponentials_first_fall(exponentials *e, int n_sums, const exponential_sum *sums, double from, double to,
                            double *at);

/* Step over which a function with this value, slope and bound of its second derivative is proven positive: the tau up
 * to which f + slope tau - bound tau^2/2 >= 0; f, bound >= 0. May be INFINITY. */
static inline double safe_step(double f, double slope, double bound)
{
  const double root = sqrt(slope * slope + 2 * bound * f);
  if (slope < 0) return 2 * f / (root - slope); /* without cancellation */
  return bound > 0 ? (slope + root) / bound : INFINITY;
}
