/* inverse.h - the inverse of a dense complex matrix by columns, faster than by the reference LAPACK. */
#ifndef HC_INVERSE_H
#define HC_INVERSE_H

#include <complex.h>
#include <stddef.h>

#include "base/status.h"

/* Numbers in `work` of inverse_complex. */
size_t inverse_room(int n);

/* inverse[n][n] of A[n][n], apart from each other; pivot[n], work[inverse_room(n)]. HC_SINGULAR for a pivot that is 0
 * or not finite. Gauss and Jordan with partial pivoting: 8 n^3 operations, errors as of LU but for a small factor. */
hc_status inverse_complex(int n, const double complex *A, int *pivot, double *work, double complex *inverse);

#endif
