/* dense.c - see dense.h. The one file that calls BLAS and LAPACK. Their Fortran interface is called as it is: LAPACKE
 * would only add memory of its own. Every CHARACTER argument has its length behind the others. */
#include "numerics/dense.h"

#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/norm.h"
#include "numerics/wide_vectors.h"

void dsygvd_(const int *type, const char *job, const char *half, const int *n, double *a, const int *lda, double *b,
             const int *ldb, double *w, double *work, const int *lwork, int *iwork, const int *liwork, int *info,
             size_t job_length, size_t half_length);
void dgemm_(const char *transpose_a, const char *transpose_b, const int *m, const int *n, const int *k,
            const double *alpha, const double *a, const int *lda, const double *b, const int *ldb, const double *beta,
            double *c, const int *ldc, size_t a_length, size_t b_length);
void dgetrf_(const int *m, const int *n, double *a, const int *lda, int *pivot, int *info);
void dgetrs_(const char *transposed, const int *n, const int *columns, const double *a, const int *lda,
             const int *pivot, double *b, const int *ldb, int *info, size_t transposed_length);
void dgeqp3_(const int *m, const int *n, double *a, const int *lda, int *pivot, double *tau, double *work,
             const int *lwork, int *info);
void dorgqr_(const int *m, const int *n, const int *k, double *a, const int *lda, const double *tau, double *work,
             const int *lwork, int *info);
void dgeev_(const char *left, const char *right, const int *n, double *a, const int *lda, double *re, double *im,
            double *vl, const int *ldvl, double *vr, const int *ldvr, double *work, const int *lwork, int *info,
            size_t left_length, size_t right_length);
void zgetrf_(const int *m, const int *n, double complex *a, const int *lda, int *pivot, int *info);
void zgetri_(const int *n, double complex *a, const int *lda, const int *pivot, double complex *work, const int *lwork,
             int *info);
void zgetrs_(const char *transposed, const int *n, const int *columns, const double complex *a, const int *lda,
             const int *pivot, double complex *b, const int *ldb, int *info, size_t transposed_length);

/* OpenBLAS, if it replaces the reference BLAS, may start threads; this program wants one. Built without any (Debian's
 * libopenblas0-serial 0.3.21 and 0.3.29) it must not be called from two threads at once: they get the same workspace,
 * and 7 of 1000 factors of 20 rows are wrong when four threads ask for them. Its calls are then serialised. Other BLAS
 * lack these symbols. */
void openblas_set_num_threads(int threads) __attribute__((weak));
int openblas_get_parallel(void) __attribute__((weak)); /* 0: built without threads */
void blas_thread_shutdown_(void) __attribute__((weak));

static pthread_mutex_t turn = PTHREAD_MUTEX_INITIALIZER;
static bool takes_turns;

__attribute__((constructor)) static void keep_to_one_thread(void)
{
  if (openblas_set_num_threads) openblas_set_num_threads(1);
  takes_turns = openblas_get_parallel && openblas_get_parallel() == 0;
}

void dense_end_idle_threads(void)
{
  if (blas_thread_shutdown_) blas_thread_shutdown_();
}

#define IN_TURN(call)                                                                                                  \
  ((void)(takes_turns && pthread_mutex_lock(&turn)), (call), (void)(takes_turns && pthread_mutex_unlock(&turn)))

static size_t square(int n) { return (size_t)n * (size_t)n; }

/* ---- products ------------------------------------------------------------------------------------ */

void dense_multiply(int m, int n, int k, const double *A, const double *B, double *C)
{
  dense_add_product(m, n, k, 1, A, m, B, k, 0, C, m);
}

static void add_small_product(int m, int n, int k, double alpha, const double *A, int lda, const double *B, int ldb,
                              double beta, double *C, int ldc)
{
  for (int j = 0; j < n; ++j) {
    double *restrict c = C + (size_t)j * (size_t)ldc;
    for (int i = 0; i < m; ++i) c[i] = beta == 0 ? 0 : beta * c[i];
    for (int l = 0; l < k; ++l) {
      const double by = alpha * B[(size_t)j * (size_t)ldb + (size_t)l];
      const double *restrict a = A + (size_t)l * (size_t)lda;
      for (int i = 0; i < m; ++i) c[i] += by * a[i];
    }
  }
}

void dense_add_product(int m, int n, int k, double alpha, const double *A, int lda, const double *B, int ldb,
                       double beta, double *C, int ldc)
{
  enum { MOST_OF_B = 16, MOST_ROWS = 64 }; /* sizes up to which loops are faster than a call */
  const int rows_of_B = ldb > 0 ? ldb : 1; /* 1 for an empty sum, too */
  if ((long)n * k <= MOST_OF_B && m <= MOST_ROWS) {
    add_small_product(m, n, k, alpha, A, lda, B, ldb, beta, C, ldc);
    return;
  }
  if (m > 0 && n > 0) IN_TURN(dgemm_("N", "N", &m, &n, &k, &alpha, A, &lda, B, &rows_of_B, &beta, C, &ldc, 1, 1));
}

/* sum += alpha A x */
WIDE_VECTORS static void add_columns(size_t rows, int n, double alpha, const double *A, const double *x,
                                     double *restrict sum)
{
  const double *restrict column = A;
  int j = 0;
  for (; j + 4 <= n; j += 4, column += 4 * rows) { /* sum[i] is loaded and stored once for four columns */
    const double a = alpha * x[j], b = alpha * x[j + 1], c = alpha * x[j + 2], d = alpha * x[j + 3];
    for (size_t i = 0; i < rows; ++i)
      sum[i] += (a * column[i] + b * column[i + rows]) + (c * column[i + 2 * rows] + d * column[i + 3 * rows]);
  }
  for (; j < n; ++j, column += rows) {
    const double a = alpha * x[j];
    for (size_t i = 0; i < rows; ++i) sum[i] += a * column[i];
  }
}

void dense_times_vector(int m, int n, double alpha, const double *A, const double *x, double beta, double *y)
{
  for (int i = 0; i < m && beta != 1; ++i) y[i] = beta == 0 ? 0 : beta * y[i];
  add_columns((size_t)m, n, alpha, A, x, y);
}

/* Four partial sums side by side, with the alignment of a double. */
typedef double four __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));

#define FOUR_AT(a) (*(const four *)(a))
#define SUM_OF(s)  (((s)[0] + (s)[1]) + ((s)[2] + (s)[3]))

WIDE_VECTORS void dense_rows_times_vector(int n, int rows, const double *A, const double *x, double *y)
{
  const size_t length = (size_t)n;
  int r = 0;
  for (const double *a = A; r + 4 <= rows; r += 4, a += 4 * length) { /* x is loaded once for four rows */
    const double *b = a + length, *c = b + length, *d = c + length;
    four p = {0}, q = {0}, s = {0}, t = {0};
    size_t i = 0;
    for (; i + 4 <= length; i += 4) {
      const four z = FOUR_AT(x + i);
      p += FOUR_AT(a + i) * z, q += FOUR_AT(b + i) * z, s += FOUR_AT(c + i) * z, t += FOUR_AT(d + i) * z;
    }
    y[r] = SUM_OF(p), y[r + 1] = SUM_OF(q), y[r + 2] = SUM_OF(s), y[r + 3] = SUM_OF(t);
    for (; i < length; ++i)
      y[r] += a[i] * x[i], y[r + 1] += b[i] * x[i], y[r + 2] += c[i] * x[i], y[r + 3] += d[i] * x[i];
  }
  for (; r < rows; ++r) y[r] = dot_product(n, A + (size_t)r * length, x);
}

void dense_transpose(int rows, int columns, const double *A, double *B)
{
  enum { TILE = 16 }; /* source and target tiles stay in the cache */
  for (int j = 0; j < columns; j += TILE)
    for (int i = 0; i < rows; i += TILE)
      for (int c = j; c < columns && c < j + TILE; ++c)
        for (int r = i; r < rows && r < i + TILE; ++r)
          B[(size_t)c + (size_t)r * (size_t)columns] = A[(size_t)r + (size_t)c * (size_t)rows];
}

void dense_congruence(int n, int m, const double *A, const double *B, double *work, double *C)
{
  double *BA = work, *turned = work + (size_t)n * (size_t)m;
  dense_multiply(n, m, n, B, A, BA);
  dense_transpose(n, m, A, turned);
  dense_multiply(m, m, n, turned, BA, C);
}

bool dense_is_diagonal(int n, const double *A, int ld)
{
  double largest = 0, beside = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      double *of = i == j ? &largest : &beside;
      *of = fmax(*of, fabs(A[(size_t)i + (size_t)j * (size_t)ld]));
    }
  return beside <= 8 * ld * DBL_EPSILON * largest;
}

bool dense_is_symmetric(int n, const double *A)
{
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < j; ++i) {
      const double a = A[(size_t)i + (size_t)j * (size_t)n], b = A[(size_t)j + (size_t)i * (size_t)n];
      if (!(fabs(a - b) <= 4 * DBL_EPSILON * (fabs(a) + fabs(b)))) return false;
    }
  return true;
}

/* ---- eigenvectors and spans ---------------------------------------------------------------------- */

hc_status dense_modes(int n, const double *K, const double *M, double *lambda, double *phi)
{
  if (n == 1) { /* by one division: the same bits with every LAPACK */
    if (!(*M > 0)) return HC_SINGULAR;
    *lambda = *K / *M, *phi = 1 / sqrt(*M);
    return HC_OK;
  }
  const int type = 1, work_length = 1 + 6 * n + 2 * n * n, integer_length = 3 + 5 * n;
  double *work = malloc(((size_t)work_length + square(n)) * sizeof *work), *mass = work ? work + work_length : NULL;
  int *integers = malloc((size_t)integer_length * sizeof *integers), info = 0;
  hc_status st = work && integers ? HC_OK : HC_NO_MEMORY;
  if (st == HC_OK) {
    memcpy(phi, K, square(n) * sizeof *phi);
    memcpy(mass, M, square(n) * sizeof *mass);
    IN_TURN(dsygvd_(&type, "V", "L", &n, phi, &n, mass, &n, lambda, work, &work_length, integers, &integer_length,
                    &info, 1, 1));
    if (info > n) st = HC_SINGULAR;
    else if (info != 0) st = HC_NOT_CONVERGED;
  }
  free(work);
  free(integers);
  return st;
}

/* QR with column pivoting of A[rows][n] in place; then tau[], pivots counted from 0, and the numerical rank. */
static hc_status pivoted_qr(int n, int rows, double *A, double tolerance, int *pivot, double *tau, double *work,
                            int work_length, int *rank)
{
  int info = 0;
  const int most = rows < n ? rows : n;
  memset(pivot, 0, (size_t)rows * sizeof *pivot); /* 0: free to move */
  IN_TURN(dgeqp3_(&n, &rows, A, &n, pivot, tau, work, &work_length, &info));
  if (info != 0) return HC_BUG;
  for (int i = 0; i < rows; ++i) --pivot[i];
  *rank = 0;
  while (*rank < most && fabs(A[(size_t)*rank * (size_t)(n + 1)]) > tolerance * fabs(A[0])) ++*rank;
  return HC_OK;
}

hc_status dense_span(int n, int rows, const double *const *row, double tolerance, int *rank, int *pivot, double *basis,
                     double *triangle)
{
  const int wide = rows > n ? rows : n, work_length = 3 * wide + 1 + 32 * wide, most = rows < n ? rows : n;
  double *A = calloc((size_t)wide * (size_t)n, sizeof *A), *tau = calloc((size_t)wide, sizeof *tau),
         *work = calloc((size_t)work_length, sizeof *work);
  int info = 0;
  hc_status st = A && tau && work ? HC_OK : HC_NO_MEMORY;
  for (int i = 0; i < rows && st == HC_OK; ++i) { /* a/|a|, or 0 */
    const double length = norm_2(n, row[i]);
    for (int k = 0; k < n; ++k) A[(size_t)i * (size_t)n + (size_t)k] = length > 0 ? row[i][k] / length : 0;
  }
  if (st == HC_OK) st = pivoted_qr(n, rows, A, tolerance, pivot, tau, work, work_length, rank);
  if (st == HC_OK) {
    for (int c = 0; c < *rank; ++c)
      for (int r = 0; r < *rank; ++r)
        triangle[(size_t)c * (size_t)*rank + (size_t)r] = r <= c ? A[(size_t)c * (size_t)n + (size_t)r] : 0;
    memcpy(basis, A, (size_t)most * (size_t)n * sizeof *basis);
    IN_TURN(dorgqr_(&n, &n, &most, basis, &n, tau, work, &work_length, &info));
    if (info != 0) st = HC_BUG;
  }
  free(A);
  free(tau);
  free(work);
  return st;
}

/* Column k of vectors as LAPACK stores them: a complex pair has the real parts, then the imaginary parts of its first
 * vector. */
static void unpack_vector(size_t n, const double *vectors, size_t k, double im, double complex *to)
{
  const double *x = vectors + (im < 0 ? k - 1 : k) * n, *y = x + n;
  for (size_t i = 0; i < n; ++i) to[i] = im > 0 ? x[i] + I * y[i] : im < 0 ? x[i] - I * y[i] : x[i];
}

hc_status dense_eigen(int n, double *A, double complex *lambda, double complex *V, double complex *W)
{
  const int work_length = 8 * n;
  const size_t rows = (size_t)n, left = W ? square(n) : 0;
  double *re = malloc((2 * rows + square(n) + left + (size_t)work_length) * sizeof *re);
  int info = 0;
  if (!re) return HC_NO_MEMORY;
  double *im = re + rows, *vectors = im + rows, *of_left = vectors + square(n), *work = of_left + left;
  IN_TURN(dgeev_(W ? "V" : "N", V ? "V" : "N", &n, A, &n, re, im, W ? of_left : NULL, &n, vectors, &n, work,
                 &work_length, &info, 1, 1));
  for (size_t k = 0; k < rows && info == 0; ++k) {
    lambda[k] = re[k] + I * im[k];
    if (V) unpack_vector(rows, vectors, k, im[k], V + k * rows);
    if (W) unpack_vector(rows, of_left, k, im[k], W + k * rows);
  }
  free(re);
  return info == 0 ? HC_OK : HC_NOT_CONVERGED;
}

/* ---- LU factors ------------------------------------------------------------------------------------ */

/* x -= L x for the columns of a PANEL, which start at x's row: four columns at a time, so that x is loaded and stored
 * once. */
enum { PANEL = 4 };
static inline void subtract_panel(int n, const double *a, int ld, double *restrict x)
{
  const double *b = a + ld, *c = b + ld, *d = c + ld, x0 = x[0], x1 = x[1] - x0 * a[1],
               x2 = x[2] - x0 * a[2] - x1 * b[2], x3 = x[3] - x0 * a[3] - x1 * b[3] - x2 * c[3];
  x[1] = x1, x[2] = x2, x[3] = x3;
  for (int i = PANEL; i < n; ++i) x[i] = x[i] - x0 * a[i] - x1 * b[i] - x2 * c[i] - x3 * d[i];
}

/* x -= x[k] times column k of L. */
static inline void subtract_column(int n, const double *A, int k, double *restrict x)
{
  const double *column = A + n * k, factor = x[k];
  for (int i = k + 1; i < n; ++i) x[i] -= factor * column[i];
}

/* Moves column k's pivot (counted from 1) into place and turns the column into L's; false if the pivot is 0. */
static bool take_pivot(int n, double *A, int k, int *pivot)
{
  double *column = A + n * k;
  int p = k;
  for (int i = k + 1; i < n; ++i)
    if (fabs(column[i]) > fabs(column[p])) p = i;
  *pivot = p + 1;
  if (!(fabs(column[p]) > 0)) return false;
  for (int j = 0; j < n && p != k; ++j) {
    const double kept = A[k + n * j];
    A[k + n * j] = A[p + n * j];
    A[p + n * j] = kept;
  }
  const double inverse = 1 / column[k];
  for (int i = k + 1; i < n; ++i) column[i] *= inverse;
  return true;
}

/* dgetrf for small matrices, where LAPACK's calls cost more than they gain (table in dense.h). */
static bool factor_small(int n, double *A, int *pivot)
{
  for (int first = 0; first < n; first += PANEL) {
    const int end = first + PANEL < n ? first + PANEL : n;
    for (int k = first; k < end; ++k) {
      if (!take_pivot(n, A, k, pivot + k)) return false;
      for (int j = k + 1; j < end; ++j) subtract_column(n, A, k, A + n * j);
    }
    for (int j = end; j < n; ++j) subtract_panel(n - first, A + n * first + first, n, A + n * j + first);
  }
  return true;
}

hc_status dense_factor(int n, double *A, int *pivot)
{
  int info = 0;
  if (n > DENSE_SMALL) IN_TURN(dgetrf_(&n, &n, A, &n, pivot, &info));
  else if (!factor_small(n, A, pivot)) return HC_SINGULAR;
  if (info != 0) return HC_SINGULAR;
  for (int i = 0; i < n; ++i)
    if (!isfinite(A[(size_t)i * (size_t)(n + 1)])) return HC_SINGULAR;
  return HC_OK;
}

static void solve_small(int n, const double *restrict A, const int *pivot, double *restrict x)
{
  for (int k = 0; k < n; ++k) {
    const double kept = x[k];
    x[k] = x[pivot[k] - 1];
    x[pivot[k] - 1] = kept;
  }
  int k = 0;
  for (; k + PANEL <= n; k += PANEL) subtract_panel(n - k, A + n * k + k, n, x + k);
  for (; k < n; ++k) subtract_column(n, A, k, x);
  for (k = n - 1; k >= 0; --k) {
    const double *column = A + n * k, xk = x[k] /= column[k];
    for (int i = 0; i < k; ++i) x[i] -= xk * column[i];
  }
}

void dense_solve(int n, const double *A, const int *pivot, int columns, double *X)
{
  int info = 0;
  if (n > DENSE_SMALL) IN_TURN(dgetrs_("N", &n, &columns, A, &n, pivot, X, &n, &info, 1));
  else
    for (int k = 0; k < columns; ++k) solve_small(n, A, pivot, X + n * k);
}

int dense_sign(int n, const double *A, const int *pivot)
{
  int sign = 1;
  for (int k = 0; k < n; ++k) {
    if (A[(size_t)k * (size_t)(n + 1)] < 0) sign = -sign;
    if (pivot[k] != k + 1) sign = -sign;
  }
  return sign;
}

hc_status dense_factor_complex(int n, double complex *A, int *pivot)
{
  int info = 0;
  IN_TURN(zgetrf_(&n, &n, A, &n, pivot, &info));
  if (info != 0) return HC_SINGULAR;
  for (int i = 0; i < n; ++i)
    if (!isfinite(cabs(A[(size_t)i * (size_t)(n + 1)]))) return HC_SINGULAR;
  return HC_OK;
}

void dense_solve_complex(int n, const double complex *A, const int *pivot, bool transposed, int columns,
                         double complex *B)
{
  int info = 0;
  IN_TURN(zgetrs_(transposed ? "T" : "N", &n, &columns, A, &n, pivot, B, &n, &info, 1));
}

hc_status dense_invert_complex(int n, double complex *A, int *pivot, double complex *work)
{
  const int length = DENSE_INVERT_WORK * n;
  int info = 0;
  const hc_status st = dense_factor_complex(n, A, pivot);
  if (st == HC_OK) IN_TURN(zgetri_(&n, A, &n, pivot, work, &length, &info));
  return info == 0 ? st : HC_SINGULAR;
}
