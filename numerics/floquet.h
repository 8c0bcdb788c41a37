/* floquet.h - multipliers of a periodic orbit from its monodromy matrix. */
#pragma once

#include <complex.h>

#include "numerics/base/status.h"

typedef struct floquet floquet;

/* For matrices up to n x n; work space for sizes up to 64 x 64 is allocated here. HC_NO_MEMORY. */
hc_status floquet_new(int n, floquet **out);
void floquet_free(floquet *f);

/* lambda[m]: eigenvalues of the rows and columns active[m] of phi, whose element (i, j) is phi[i * row + j * column].
 * HC_BAD_INPUT: m > n; HC_NOT_FINITE, HC_NOT_CONVERGED; HC_NO_MEMORY where m > 64. */
hc_status floquet_multipliers(floquet *f, const double *phi, int row, int column, int m, const int *active,
                              double complex *lambda);

/* The multiplier of largest modulus; 0 if m is 0. */
double complex floquet_largest(int m, const double complex *lambda);
