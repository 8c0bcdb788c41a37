/* guesses.c - weights of the norm, and the approximate inverse B of dF/dy. A proof is valid for any of them; good ones
 * lead to few substeps, and to success of Krawczyk's test. */
#include "proof/orbit.h"
#include <math.h>

/* ---- weights ---- */

static double upper(const arb_t x)
{
  LOCAL(mag) m = {0};
  arb_get_mag(m, x);
  return mag_get_d(m);
}

static slong weight_of(double log2) { return lround(fmax(-4000, fmin(4000, log2))); }

/* |A_ij| of the accelerations, row i, by Z_j, scaled with the weights of x. */
static double weighed(const orbit *o, const orbit_segment *s, int i, int j)
{
  return ldexp(upper(arb_mat_entry(s->a, o->n + i, j)), (int)((j < o->n ? s->weight[j] : 0) - s->weight[i]));
}

/* Powers of two that balance A: for x such that rows and columns of the stiffness are of one size (Osborne), for v
 * larger by Omega, for loads and sliders Omega^2/|f|, limited relative to the scale of x. Any choice is valid; a good
 * one gives few substeps. */
void guess_weights(const orbit *o, orbit_segment *s)
{
  enum { ROOM = 20, SWEEPS = 8 };
  const int n = o->n;
  double stiffness = 0;
  for (int i = 0; i < SWEEPS * n; i++) {
    double row = 0, column = 0;
    for (int j = 0; j < n; j++) {
      row += j == i % n ? 0 : weighed(o, s, i % n, j);
      column += j == i % n ? 0 : weighed(o, s, j, i % n);
    }
    if (row > 0 && column > 0) s->weight[i % n] = weight_of((double)s->weight[i % n] + log2(row / column) / 2);
  }
  for (int i = 0; i < n; i++) {
    double sum = 0;
    for (int j = 0; j < n; j++) sum += weighed(o, s, i, j);
    stiffness = fmax(stiffness, sum);
  }
  if (!(stiffness > 0)) stiffness = pow(upper(o->omega), 2);
  const double frequency = log2(stiffness) / 2, most = ROOM - log2(upper(o->scale));
  for (int j = n; j < s->size; j++) {
    s->weight[j] = j < 2 * n ? s->weight[j - n] + weight_of(frequency) : weight_of(frequency);
    if (j < 2 * n) continue;
    int pair = j; /* cosine and sine get the same weight */
    if (j > 2 * n && j <= 2 * n + 2 * o->harmonics) pair = (j - 2 * n) % 2 ? j + 1 : j - 1;
    double load = 0;
    for (int i = 0; i < n; i++) load = fmax(load, fmax(weighed(o, s, i, j), weighed(o, s, i, pair)));
    s->weight[j] = weight_of(load > 0 ? fmin(2 * frequency - log2(load), most) : most);
  }
}

/* ---- the approximate inverse ---- */

static double number_near(const arb_t x) { return arf_get_d(arb_midref(x), ARF_RND_NEAR); }

/* a[n][n] becomes its inverse, by Gauss-Jordan with row pivots; its accuracy does not matter for a proof. swap: [n] */
static bool invert(double *a, int n, int *swap)
{
  for (int k = 0; k < n; k++) {
    int best = k;
    for (int i = k + 1; i < n; i++)
      if (fabs(a[(size_t)i * n + k]) > fabs(a[(size_t)best * n + k])) best = i;
    swap[k] = best;
    double *pivot = a + (size_t)k * n, *other = a + (size_t)best * n;
    const double scale = 1 / other[k];
    if (!isfinite(scale)) return false;
    for (int c = 0; c < n && best != k; c++) {
      const double x = pivot[c];
      pivot[c] = other[c];
      other[c] = x;
    }
    pivot[k] = 1;
    for (int c = 0; c < n; c++) pivot[c] *= scale;
    for (int i = 0; i < n; i++) {
      double *row = a + (size_t)i * n;
      const double factor = row[k];
      if (i == k || factor == 0) continue;
      row[k] = 0;
      for (int c = 0; c < n; c++) row[c] -= factor * pivot[c];
    }
  }
  for (int k = n - 1; k >= 0; k--)
    for (int i = 0; i < n && swap[k] != k; i++) {
      double *row = a + (size_t)i * n, x = row[k];
      row[k] = row[swap[k]];
      row[swap[k]] = x;
    }
  return true;
}

/* B: the inverse of `middle` with scaled columns and equilibrated rows, without which stiff cases look singular. */
bool guess_inverse(krawczyk *k)
{
  const orbit *o = k->o;
  const jacobian *d = &k->derivative;
  const int n = o->unknowns, stride = 2 * o->n + 1;
  LOCAL(pool) own = {0};
  double *rows = pool_take(own, POOL_BYTES, (size_t)n * sizeof *rows);
  int *swap = pool_take(own, POOL_BYTES, (size_t)n * sizeof *swap);
  for (int r = 0; r < n; r++) {
    double *row = k->inverse + (size_t)r * n;
    for (int c = 0; c < n; c++) row[c] = 0;
    for (int e = d->row[r]; e < d->row[r + 1]; e++)
      row[d->column[e]] += k->middle[e] * number_near(o->scale + d->column[e] % stride);
    for (int c = 0; c < n; c++) rows[r] = fmax(rows[r], fabs(row[c]));
    for (int c = 0; c < n; c++) row[c] /= rows[r];
  }
  bool fine = invert(k->inverse, n, swap);
  for (int r = 0; r < n && fine; r++)
    for (int c = 0; c < n; c++) {
      double *entry = k->inverse + (size_t)r * n + c;
      *entry *= number_near(o->scale + r % stride) / rows[c];
      fine = fine && isfinite(*entry);
    }
  return fine;
}
