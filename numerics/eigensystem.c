/* eigensystem.c - see eigensystem.h. Proof: tests/numerics/test_eigensystem.c. */
#include "numerics/eigensystem.h"
#include "numerics/norm.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "numerics/dense.h"

static const double same = 1e-11;              /* relative distance of two eigenvalues below which they count as one,
                                                  with one eigenspace */
static const double one_space = 1e-14;         /* largest coupling within such an eigenspace, relative to the
                                                  eigenvalues */
static const double converged = 1e-9;          /* largest step E at which Newton ends; the error is then its square */
static const double lapack = 64 * DBL_EPSILON; /* [largest eigenvalue] LAPACK's error of any eigenvalue */
static const double most_skewed = 1e4;         /* largest |w_k| |v_k|, the loss of accuracy; 1 for orthogonal
                                                  eigenvectors */
enum { MOST_STEPS = 5 };

static size_t square(int n) { return (size_t)n * (size_t)n; }

hc_status eigensystem_make(eigensystem *e, int n, workspace *w)
{
  const size_t size = (size_t)n;
  double complex **const matrices[] = {&e->V, &e->W, &e->factors, &e->correction};
  e->n = n;
  for (size_t i = 0; i < 4; ++i) *matrices[i] = workspace_array(w, square(n), sizeof(double complex));
  e->lambda = workspace_array(w, size, sizeof *e->lambda);
  e->values = workspace_array(w, size, sizeof *e->values);
  e->vectors = workspace_array(w, square(n), sizeof *e->vectors);
  e->residual = workspace_array(w, square(n), sizeof *e->residual);
  e->narrow = workspace_doubles(w, square(n));
  e->pivot = workspace_array(w, size, sizeof *e->pivot);
  return w->failed ? HC_NO_MEMORY : HC_OK;
}

/* to += a b */
static void add_product(wide_complex *to, wide_complex a, wide_complex b)
{
  to->re += a.re * b.re - a.im * b.im;
  to->im += a.re * b.im + a.im * b.re;
}

static wide_complex widen(double complex z) { return (wide_complex){creal(z), cimag(z)}; }
static double complex narrow(wide_complex z) { return (double)z.re + I * (double)z.im; }

/* factors: LU of V. A zero pivot makes W not finite, which most_skewed rejects. */
static void factor(eigensystem *e)
{
  for (size_t i = 0; i < square(e->n); ++i) e->factors[i] = narrow(e->vectors[i]);
  (void)dense_factor_complex(e->n, e->factors, e->pivot);
}

/* One Newton step; largest[2]: measures of convergence, see below. */
static void improve(eigensystem *e, const long double *A, double least, double largest[2])
{
  const size_t n = (size_t)e->n;
  factor(e);
  /* residual = A V - V D */
  for (size_t j = 0; j < n; ++j) {
    const wide_complex *v = e->vectors + j * n, minus = {-e->values[j].re, -e->values[j].im};
    wide_complex *r = e->residual + j * n;
    memset(r, 0, n * sizeof *r);
    for (size_t k = 0; k < n; ++k)
      for (size_t i = 0; i < n; ++i) {
        r[i].re += A[k * n + i] * v[k].re;
        r[i].im += A[k * n + i] * v[k].im;
      }
    for (size_t i = 0; i < n; ++i) add_product(&r[i], minus, v[i]);
  }
  for (size_t i = 0; i < n * n; ++i) e->correction[i] = narrow(e->residual[i]);
  dense_solve_complex(e->n, e->factors, e->pivot, false, e->n, e->correction);
  largest[0] = largest[1] = 0;
  for (size_t j = 0; j < n; ++j) {
    double complex *F = e->correction + j * n;
    e->values[j].re += creal(F[j]);
    e->values[j].im += cimag(F[j]);
  }
  /* F becomes E, column by column; largest[0]: largest |E_ij|; largest[1]: largest |F_ij/(|D_i| + |D_j|)| among
   * eigenvalues that count as one: no farther apart than `least`, or relatively than `same`. */
  for (size_t j = 0; j < n; ++j) {
    double complex *F = e->correction + j * n;
    const double complex at = narrow(e->values[j]);
    for (size_t i = 0; i < (size_t)e->n; ++i) {
      const double complex other = narrow(e->values[i]), apart = at - other;
      const double size = cabs(at) + cabs(other);
      const bool one = !(cabs(apart) > fmax(least, same * size));
      const double entry = i == j || cabs(F[i]) == 0 ? 0 : cabs(F[i]) / (one ? size : cabs(apart));
      largest[one] = larger(largest[one], entry);
      F[i] = i == j || one ? 0 : F[i] / apart;
    }
  }
  wide_complex *better = e->residual;
  memcpy(better, e->vectors, n * n * sizeof *better);
  for (size_t j = 0; j < n; ++j)
    for (size_t k = 0; k < n; ++k) {
      const wide_complex by = widen(e->correction[j * n + k]);
      for (size_t i = 0; i < n && (by.re != 0 || by.im != 0); ++i)
        add_product(&better[j * n + i], e->vectors[k * n + i], by);
    }
  memcpy(e->vectors, better, n * n * sizeof *better);
}

/* W = V^-1 from the factors and one Newton step, W += W (1 - V W). Computed by columns, stored by rows. */
static void invert(eigensystem *e)
{
  const size_t n = (size_t)e->n;
  factor(e);
  double complex *inverse = e->correction;
  memset(inverse, 0, n * n * sizeof *inverse);
  for (size_t i = 0; i < n; ++i) inverse[i * (n + 1)] = 1;
  dense_solve_complex(e->n, e->factors, e->pivot, false, e->n, inverse);
  memset(e->residual, 0, n * n * sizeof *e->residual);
  for (size_t j = 0; j < n; ++j) {
    wide_complex *left = e->residual + j * n;
    for (size_t k = 0; k < n; ++k) {
      const wide_complex by = widen(-inverse[j * n + k]);
      for (size_t i = 0; i < n; ++i) add_product(&left[i], e->vectors[k * n + i], by);
    }
    left[j].re += 1;
  }
  for (size_t i = 0; i < n * n; ++i) e->V[i] = narrow(e->residual[i]);
  dense_solve_complex(e->n, e->factors, e->pivot, false, e->n, e->V);
  for (size_t j = 0; j < n; ++j)
    for (size_t k = 0; k < n; ++k) e->W[k * n + j] = inverse[j * n + k] + e->V[j * n + k];
  for (size_t i = 0; i < n * n; ++i) e->V[i] = narrow(e->vectors[i]);
}

static double length(size_t n, const double complex *a)
{
  double sum = 0;
  for (size_t i = 0; i < n; ++i) sum += creal(a[i] * conj(a[i]));
  return sqrt(sum);
}

hc_status eigensystem_find(eigensystem *e, const long double *A)
{
  const size_t n = (size_t)e->n;
  double left[2] = {INFINITY, INFINITY}, size = 0;
  for (size_t i = 0; i < n * n; ++i) {
    e->narrow[i] = (double)A[i];
    size = hypot(size, e->narrow[i]);
  }
  if (!isfinite(size)) return HC_NOT_FINITE;
  hc_status st = dense_eigen(e->n, e->narrow, e->lambda, e->V, NULL);
  if (st != HC_OK) return st;
  for (size_t i = 0; i < n * n; ++i) e->vectors[i] = widen(e->V[i]);
  for (size_t k = 0; k < n; ++k) e->values[k] = widen(e->lambda[k]);
  for (int steps = 0; !(steps > 1 && left[0] <= converged && left[1] <= one_space); ++steps) {
    if (steps == MOST_STEPS) return HC_SINGULAR;
    improve(e, A, steps == 0 ? lapack * size : 0, left); /* first step: eigenvalues closer than LAPACK's error count as
                                                            one */
  }
  invert(e);
  /* Real eigenvalues get exactly real vectors. */
  for (size_t k = 0; k < n; ++k) {
    const bool real = cimag(e->lambda[k]) == 0;
    e->lambda[k] = real ? (double)e->values[k].re : narrow(e->values[k]);
    for (size_t i = 0; i < n && real; ++i) {
      e->V[k * n + i] = creal(e->V[k * n + i]);
      e->W[k * n + i] = creal(e->W[k * n + i]);
    }
  }
  for (size_t k = 0; k < n; ++k)
    if (!(length(n, e->V + k * n) * length(n, e->W + k * n) <= most_skewed)) return HC_SINGULAR;
  return HC_OK;
}
