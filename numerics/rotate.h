/* rotate.h - cosines and sines of several angles near one whose cosine and sine are known, by polynomials, which the
 * compiler vectorises, instead of a call of libm for each. Needs nothing, allocates nothing. */
#pragma once

/* [rad] The polynomials' remainders, x^22/22! and x^23/23!, are below 0.15 roundings of 1 up to here. */
#define ROTATE_MOST 1.6

/* cosine[i] + j sine[i] = (c + j s) exp(j x[i]), |x[i]| <= ROTATE_MOST, i = 0..n-1: errors of at most 3 roundings of 1
 * beside those of c and s. */
static inline void rotate(int n, double c, double s, const double *restrict x, double *restrict cosine,
                          double *restrict sine)
{
  for (int i = 0; i < n; ++i) {
    const double y = x[i] * x[i];
    double less = 1 / 2432902008176640000.0, turn = 1 / 51090942171709440000.0; /* 1/20!, 1/21! */
    less = less * y - 1 / 6402373705728000.0, turn = turn * y - 1 / 121645100408832000.0;
    less = less * y + 1 / 20922789888000.0, turn = turn * y + 1 / 355687428096000.0;
    less = less * y - 1 / 87178291200.0, turn = turn * y - 1 / 1307674368000.0;
    less = less * y + 1 / 479001600.0, turn = turn * y + 1 / 6227020800.0;
    less = less * y - 1 / 3628800.0, turn = turn * y - 1 / 39916800.0;
    less = less * y + 1 / 40320.0, turn = turn * y + 1 / 362880.0;
    less = less * y - 1 / 720.0, turn = turn * y - 1 / 5040.0;
    less = less * y + 1 / 24.0, turn = turn * y + 1 / 120.0;
    less = (less * y - 0.5) * y, turn = turn * y - 1 / 6.0;
    turn = x[i] + x[i] * (turn * y);
    cosine[i] = c + (c * less - s * turn); /* less = cos x - 1, turn = sin x */
    sine[i] = s + (s * less + c * turn);
  }
}
