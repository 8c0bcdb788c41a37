/* lapack_of_one.c - LAPACK for one degree of freedom: Debian has no Fortran compiler for WebAssembly. Of the routines
 * that numerics/dense.c calls, an oscillator's harmonic balance needs the pivoted QR factors of a matrix with one row,
 * LU factors and products of real matrices, and the LU factors and the inverse of a complex number. Everything else
 * belongs to structures, which the lab refuses by name (lab_scene.h), or has another way (eigenvectors: a matrix
 * exponential); asked for all the same, it answers as LAPACK does to an argument that is out of range, and dense.h
 * with a status. Arguments are LAPACK's. */
#include <complex.h>
#include <math.h>
#include <stddef.h>

enum { REFUSED = -1 };

/* A P = Q R of A[1][n]: Q = 1, R is A with its largest entry first. */
void dgeqp3_(const int *m, const int *n, double *a, const int *lda, int *pivot, double *tau, double *work,
             const int *lwork, int *info)
{
  int largest = 0;
  (void)work, (void)lwork;
  *info = *m == 1 && *lda == 1 ? 0 : REFUSED;
  if (*info != 0 || *n < 1) return;
  for (int i = 0; i < *n; ++i) {
    pivot[i] = i + 1;
    if (fabs(a[i]) > fabs(a[largest])) largest = i;
  }
  const double first = a[0];
  a[0] = a[largest];
  a[largest] = first;
  pivot[0] = largest + 1;
  pivot[largest] = 1;
  tau[0] = 0;
}

/* Q = 1 of those. */
void dorgqr_(const int *m, const int *n, const int *k, double *a, const int *lda, const double *tau, double *work,
             const int *lwork, int *info)
{
  (void)k, (void)tau, (void)work, (void)lwork;
  *info = *m == 1 && *n == 1 && *lda == 1 ? 0 : REFUSED;
  if (*info == 0) a[0] = 1;
}

/* ---- LU factors of a number ---- */

void zgetrf_(const int *m, const int *n, double complex *a, const int *lda, int *pivot, int *info)
{
  *info = *m == 1 && *n == 1 && *lda == 1 ? a[0] == 0 : REFUSED;
  if (*info != REFUSED) pivot[0] = 1;
}

void zgetrs_(const char *transposed, const int *n, const int *columns, const double complex *a, const int *lda,
             const int *pivot, double complex *b, const int *ldb, int *info, size_t transposed_length)
{
  (void)transposed, (void)pivot, (void)transposed_length;
  *info = *n == 1 && *lda == 1 && *ldb == 1 ? 0 : REFUSED;
  for (int i = 0; *info == 0 && i < *columns; ++i) b[i] /= a[0];
}

/* ---- of structures ------------------------------------------------------------------------------------ */

void dsygvd_(const int *type, const char *job, const char *half, const int *n, double *a, const int *lda, double *b,
             const int *ldb, double *w, double *work, const int *lwork, int *iwork, const int *liwork, int *info,
             size_t job_length, size_t half_length)
{
  (void)type, (void)job, (void)half, (void)n, (void)a, (void)lda, (void)b, (void)ldb, (void)w, (void)work;
  (void)lwork, (void)iwork, (void)liwork, (void)job_length, (void)half_length;
  *info = REFUSED;
}

void dgeev_(const char *left, const char *right, const int *n, double *a, const int *lda, double *re, double *im,
            double *vl, const int *ldvl, double *vr, const int *ldvr, double *work, const int *lwork, int *info,
            size_t left_length, size_t right_length)
{
  (void)left, (void)right, (void)n, (void)a, (void)lda, (void)re, (void)im, (void)vl, (void)ldvl, (void)vr;
  (void)ldvr, (void)work, (void)lwork, (void)left_length, (void)right_length;
  *info = REFUSED;
}

/* A = P L U in its place. */
void dgetrf_(const int *m, const int *n, double *a, const int *lda, int *pivot, int *info)
{
  *info = 0;
  for (int k = 0; k < *n && k < *m; ++k) {
    double *first = a + *lda * k;
    int p = k;
    for (int i = k + 1; i < *m; ++i)
      if (fabs(first[i]) > fabs(first[p])) p = i;
    pivot[k] = p + 1;
    if (first[p] == 0 && *info == 0) *info = k + 1;
    if (first[p] == 0) continue;
    for (int j = 0; j < *n && p != k; ++j) {
      const double kept = a[k + *lda * j];
      a[k + *lda * j] = a[p + *lda * j];
      a[p + *lda * j] = kept;
    }
    for (int i = k + 1; i < *m; ++i) first[i] /= first[k];
    for (int j = k + 1; j < *n; ++j)
      for (int i = k + 1; i < *m; ++i) a[i + *lda * j] -= a[k + *lda * j] * first[i];
  }
}

/* B := A^-1 B by those; not transposed. */
void dgetrs_(const char *transposed, const int *n, const int *columns, const double *a, const int *lda,
             const int *pivot, double *b, const int *ldb, int *info, size_t transposed_length)
{
  (void)transposed_length;
  *info = *transposed == 'N' ? 0 : REFUSED;
  for (int j = 0; j < *columns && *info == 0; ++j) {
    double *x = b + *ldb * j;
    for (int k = 0; k < *n; ++k) {
      const double kept = x[k];
      x[k] = x[pivot[k] - 1];
      x[pivot[k] - 1] = kept;
    }
    for (int k = 0; k < *n; ++k)
      for (int i = k + 1; i < *n; ++i) x[i] -= x[k] * a[i + *lda * k];
    for (int k = *n - 1; k >= 0; --k) {
      x[k] /= a[k + *lda * k];
      for (int i = 0; i < k; ++i) x[i] -= x[k] * a[i + *lda * k];
    }
  }
}

/* 1/a of those. */
void zgetri_(const int *n, double complex *a, const int *lda, const int *pivot, double complex *work, const int *lwork,
             int *info)
{
  (void)pivot, (void)work, (void)lwork;
  *info = *n == 1 && *lda == 1 ? 0 : REFUSED;
  if (*info == 0) a[0] = 1 / a[0];
}

/* C := alpha A B + beta C. */
void dgemm_(const char *transpose_a, const char *transpose_b, const int *m, const int *n, const int *k,
            const double *alpha, const double *a, const int *lda, const double *b, const int *ldb, const double *beta,
            double *c, const int *ldc, size_t a_length, size_t b_length)
{
  (void)transpose_a, (void)transpose_b, (void)a_length, (void)b_length; /* "N", "N" */
  for (int j = 0; j < *n; ++j)
    for (int i = 0; i < *m; ++i) {
      double sum = 0;
      for (int l = 0; l < *k; ++l) sum += a[i + *lda * l] * b[l + *ldb * j];
      double *to = c + i + *ldc * j;
      *to = *beta == 0 ? *alpha * sum : *alpha * sum + *beta * *to;
    }
}

/* y := alpha A x + beta y. */
void dgemv_(const char *transposed, const int *m, const int *n, const double *alpha, const double *a, const int *lda,
            const double *x, const int *step_x, const double *beta, double *y, const int *step_y,
            size_t transposed_length)
{
  (void)transposed, (void)step_x, (void)step_y, (void)transposed_length; /* "N", 1, 1 */
  for (int i = 0; i < *m; ++i) {
    double sum = 0;
    for (int j = 0; j < *n; ++j) sum += a[i + *lda * j] * x[j];
    y[i] = *beta == 0 ? *alpha * sum : *alpha * sum + *beta * y[i];
  }
}
