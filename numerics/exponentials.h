/* exponentials.h - sums of exponentials, g(tau) = constant + Re sum_k by_k e^{rate_k tau}; where one falls through 0.
 * Nothing is allocated, libm only.
 *
 * The search steps only as far as a bound lets g stay positive. Split at any k, the slow terms are bounded by their
 * second derivatives, the fast ones by their sizes alone:
 *     g(tau + h) >= slow + slow' h - h^2/2 sum_slow |rate|^2 |by e^{rate tau}| - sum_fast |by e^{rate tau}|
 * and the split that reaches farthest counts: a fast mode that hardly moves, or has died away, costs nothing. No root
 * is missed but an excursion below -noise. */
#pragma once

#include <complex.h>
#include <math.h>

typedef struct exponentials { /* the arrays are the owner's */
  int n;
  const double complex *rate; /* [n] by modulus, the smallest first, as far as the bounds shall be close */
  double complex *now;        /* [n] e^{rate tau} where the search is */
  double *size;               /* [n] their moduli */
} exponentials;

typedef struct exponential_sum {
  double constant, noise; /* below -noise it is negative */
  double complex *by;     /* [n] */
  double *size;           /* [n] their moduli, for the search; or NULL */
} exponential_sum;

/* The value and the derivative at tau; slope may be NULL. */
double exponential_sum_at(const exponentials *e, const exponential_sum *s, double tau, double *slope);

/* e^z - 1 without cancellation, over z; 1 at 0. */
double complex exponential_quotient(double complex z);

/* s->size, and noise raised to the rounding of the sum. */
void exponential_sum_measure(const exponentials *e, exponential_sum *s);

/* The first of n_sums to fall through 0 between `from` and `to`: its number and *at where; -1 if none does. One below
 * -noise at `from` has fallen there. */
int exponentials_first_fall(exponentials *e, int n_sums, const exponential_sum *sums, double from, double to,
                            double *at);

/* How far any function surely stays positive, from its value, slope and a bound of its second derivative: the tau up to
 * which f + slope tau - bound tau^2/2 >= 0; f, bound >= 0. INFINITY: for ever. */
static inline double safe_step(double f, double slope, double bound)
{
  const double root = sqrt(slope * slope + 2 * bound * f);
  if (slope < 0) return 2 * f / (root - slope); /* without cancellation */
  return bound > 0 ? (slope + root) / bound : INFINITY;
}
