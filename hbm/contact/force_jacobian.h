/* force_jacobian.h - the Jacobian dF/dX of force harmonics when the force's stiffness along the orbit is piecewise
 * constant.
 *
 * F(th) = k(th) x(th) + rest, with k's own Fourier coefficients (mean k0, cosines C_m, sines S_m, m <= 2H). Products
 * of two trigonometric functions become sums, so dF/dX is Toeplitz + Hankel in C and S: for example
 *
 *     d(cosine p of F)/d(cosine q of x) = (C_|p-q| + C_{p+q})/2,      C_0 = 2 k0
 */
#pragma once

/* Coefficients of the symbol k(th): the series convention with 2 n_harm harmonics. */
static inline int force_jacobian_symbol_length(int n_harm) { return 4 * n_harm + 1; }

/* jac[row + ld col], rows and columns 0 .. 2 n_harm, += the Toeplitz + Hankel matrix of symbol[4 n_harm + 1]
 * [force/length]. */
void force_jacobian_add(int n_harm, const double *symbol, int ld, double *jac);
