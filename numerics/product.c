/* product.c - see product.h. Four columns of A times four rows of B go onto four columns of C at once: 32 operations
 * for 8 numbers read and 4 written. A is taken in blocks that stay in the cache while all of C's columns pass. */
#include "numerics/product.h"

#include <stddef.h>

#include "base/wide_vectors.h"

enum { ROWS = 128, INNER = 64, STEP = 4 };

static size_t at(int row, int column, int ld) { return (size_t)row + (size_t)column * (size_t)ld; }

/* Four columns c of C -= A[m][4] B[4][4]. That they do not overlap is said where gcc heeds it: at parameters. */
WIDE_VECTORS static void four_by_four(int m, const double *restrict A, int lda, const double *restrict B, int ldb,
                                      double *restrict c0, double *restrict c1, double *restrict c2,
                                      double *restrict c3)
{
  const double *restrict b1 = B + ldb, *restrict b2 = b1 + ldb, *restrict b3 = b2 + ldb;
  for (int i = 0; i < m; ++i) {
    const double a = A[i], e = A[at(i, 1, lda)], f = A[at(i, 2, lda)], g = A[at(i, 3, lda)];
    c0[i] -= a * B[0] + e * B[1] + f * B[2] + g * B[3];
    c1[i] -= a * b1[0] + e * b1[1] + f * b1[2] + g * b1[3];
    c2[i] -= a * b2[0] + e * b2[1] + f * b2[2] + g * b2[3];
    c3[i] -= a * b3[0] + e * b3[1] + f * b3[2] + g * b3[3];
  }
}

/* One column of C, one column of A at a time. */
WIDE_VECTORS static void one_by_one(int m, int k, const double *A, int lda, const double *b, double *restrict c)
{
  for (int l = 0; l < k; ++l) {
    const double *restrict a = A + at(0, l, lda), factor = b[l];
    for (int i = 0; i < m; ++i) c[i] -= factor * a[i];
  }
}

static void subtract_block(int m, int n, int k, const double *A, int lda, const double *B, int ldb, double *C, int ldc)
{
  const int whole_k = k - k % STEP, whole_n = n - n % STEP;
  for (int j = 0; j < whole_n; j += STEP) {
    for (int l = 0; l < whole_k; l += STEP)
      four_by_four(m, A + at(0, l, lda), lda, B + at(l, j, ldb), ldb, C + at(0, j, ldc), C + at(0, j + 1, ldc),
                   C + at(0, j + 2, ldc), C + at(0, j + 3, ldc));
    for (int c = j; c < j + STEP && whole_k < k; ++c)
      one_by_one(m, k - whole_k, A + at(0, whole_k, lda), lda, B + at(whole_k, c, ldb), C + at(0, c, ldc));
  }
  for (int c = whole_n; c < n; ++c) one_by_one(m, k, A, lda, B + at(0, c, ldb), C + at(0, c, ldc));
}

void product_subtract(int m, int n, int k, const double *A, int lda, const double *B, int ldb, double *C, int ldc)
{
  for (int l = 0; l < k; l += INNER)
    for (int i = 0; i < m; i += ROWS)
      subtract_block(m - i < ROWS ? m - i : ROWS, n, k - l < INNER ? k - l : INNER, A + at(i, l, lda), lda,
                     B + at(l, 0, ldb), ldb, C + at(i, 0, ldc), ldc);
}
