/* exponentials.c - see exponentials.h. Proof: tests/numerics/test_exponentials.c. */
#include "numerics/exponentials.h"

#include <float.h>
#include <stddef.h>

#include "numerics/roots.h"

static const double rounding = 64 * DBL_EPSILON; /* relative rounding error of a term, its input included */
static const double nothing = 1e-3;              /* [noise] largest sum of terms that the search may neglect */

/* e^{rate tau}, and its modulus. */
static double complex exponential(double complex rate, double tau, double *size)
{
  const double turn = cimag(rate) * tau;
  *size = exp(creal(rate) * tau);
  if (turn == 0 || *size == 0) return *size;
  return *size * cos(turn) + I * (*size * sin(turn));
}

double exponential_sum_at(const exponentials *e, const exponential_sum *s, double tau, double *slope)
{
  double f = s->constant, rises = 0, size;
  for (int k = 0; k < e->n; ++k) {
    const double complex z = s->by[k] * exponential(e->rate[k], tau, &size);
    f += creal(z);
    rises += creal(e->rate[k] * z);
  }
  if (slope) *slope = rises;
  return f;
}

double complex exponential_quotient(double complex z)
{
  const double a = creal(z), b = cimag(z), half = sin(0.5 * b);
  if (a == 0 && b == 0) return 1;
  return (expm1(a) * cos(b) - 2 * half * half + I * (exp(a) * sin(b))) / z;
}

void exponential_sum_measure(const exponentials *e, exponential_sum *s)
{
  double sum = fabs(s->constant);
  for (int k = 0; k < e->n; ++k) sum += s->size[k] = cabs(s->by[k]);
  s->noise = fmax(s->noise, rounding * sum);
}

typedef struct searched_sum {
  const exponentials *e;
  const exponential_sum *s;
} searched_sum;

static double sum_at(const void *self, double tau, double *slope)
{
  const searched_sum *in = self;
  return exponential_sum_at(in->e, in->s, tau, slope);
}

/* Bounds of a sum at a point: value, slope, bound of the second derivative over h, and the step over which it is proven
 * not to fall below -noise. */
typedef struct outlook {
  double f, slope, bend, safe;
} outlook;

static double growth(double complex rate, double h) { return creal(rate) > 0 ? exp(creal(rate) * h) : 1; }

/* A step from tau, at most h, over which the sum stays positive, or falls through 0 once, at *root (else INFINITY). */
static double clear_step(const exponentials *e, const exponential_sum *s, double tau, double h, double *root)
{
  outlook o = {.f = s->constant};
  double fast = 0; /* the sizes of the terms not yet added */
  for (int k = 0; k < e->n; ++k) fast += s->size[k] * e->size[k] * growth(e->rate[k], h);
  for (int k = 0; k <= e->n; ++k) {
    const double room = o.f - fast + s->noise;
    if (room > 0) o.safe = fmax(o.safe, safe_step(room, o.slope, o.bend));
    if (k == e->n || fast <= nothing * s->noise) break;
    const double complex z = s->by[k] * e->now[k], rate = e->rate[k];
    const double size = s->size[k] * e->size[k] * growth(rate, h);
    o.f += creal(z);
    o.slope += creal(rate * z);
    o.bend += creal(rate * conj(rate)) * size;
    fast = fmax(fast - size, 0);
  }
  o.safe = fmax(o.safe, safe_step(fmax(o.f, 0) + (1 - nothing) * s->noise, o.slope, o.bend));
  *root = INFINITY;
  if (!(o.f >= -s->noise)) return *root = tau, 0; /* NaN, too */
  if (o.safe >= h) return h;
  const double one_way = o.slope < 0 ? fmin(h, -o.slope / o.bend) : 0; /* it falls at least that far */
  if (!(one_way > o.safe)) return o.safe;
  if (!(exponential_sum_at(e, s, tau + one_way, NULL) < 0)) return one_way;
  *root = root_falling(sum_at, &(searched_sum){e, s}, tau, o.f, tau + one_way, tau + 0.5 * one_way, 0);
  return one_way;
}

int exponentials_first_fall(exponentials *e, int n_sums, const exponential_sum *sums, double from, double to,
                            double *at)
{
  /* longest: no term grows by more than a factor e over it. */
  double most = 0;
  for (int k = 0; k < e->n; ++k) most = fmax(most, creal(e->rate[k]));
  const double longest = 1 / most;
  int first = -1;
  for (double tau = from; tau < to;) {
    double h = fmin(to - tau, longest);
    for (int k = 0; k < e->n; ++k) e->now[k] = exponential(e->rate[k], tau, &e->size[k]);
    for (int i = 0; i < n_sums; ++i) {
      double root, clear = clear_step(e, &sums[i], tau, h, &root);
      if (!(tau + clear > tau)) root = tau; /* no step is short enough: a root here */
      if (root < to || (root == to && first < 0)) {
        to = root;
        first = i;
        clear = root - tau;
      }
      h = fmin(h, clear);
    }
    if (!(tau + h > tau)) break;
    tau += h;
  }
  *at = to;
  return first;
}
