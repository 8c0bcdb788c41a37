/* monodromy.c - see monodromy.h. */
#include "hbm/stability/monodromy.h"

#include <stdlib.h>

#include "hbm/stability/variation.h"
#include "numerics/base/trace.h"
#include "numerics/floquet.h"

struct monodromy {
  const multiplier_method *how;
  void *method;           /* of how */
  variation *v;           /* the method's */
  int count;              /* of lambda */
  double complex *lambda; /* [n_states] */
};

hc_status monodromy_new(const model *m, const multiplier_method *how, monodromy **out)
{
  monodromy *w = *out = calloc(1, sizeof *w);
  if (!w) return HC_NO_MEMORY;
  w->how = how;
  hc_status st = how->make(m, &w->method, &w->v);
  if (st == HC_OK) w->lambda = malloc((size_t)w->v->n_states * sizeof *w->lambda);
  if (st == HC_OK && w->lambda) return HC_OK;
  monodromy_free(w);
  *out = NULL;
  return st == HC_OK ? HC_NO_MEMORY : st;
}

void monodromy_free(monodromy *w)
{
  if (!w) return;
  w->how->free(w->method);
  free(w->lambda);
  free(w);
}

/* m of n states have multipliers, those that outlast the longest interval: the others' are 0. */
static void summarise(int n, int m, const double complex *lambda, hbm_stability *out)
{
  double complex flip = 1, fold = 1, all = 1;
  const double complex largest = floquet_largest(m, lambda);
  for (int i = 0; i < m; ++i) {
    flip *= 1 + lambda[i];
    fold *= 1 - lambda[i];
    all *= lambda[i];
  }
  const double size_of_largest = cabs(largest);
  *out = (hbm_stability){.multiplier = size_of_largest,
                         .re = creal(largest),
                         .im = cimag(largest),
                         .pair = NAN,
                         .low = size_of_largest,
                         .high = size_of_largest};
  for (int i = 0; i < m; ++i) {
    const double size = cabs(lambda[i]);
    if (!(cimag(lambda[i]) > 0)) continue; /* one of the two */
    out->pairs_outside += size > 1 + 1e-10;
    if (!(fabs(size - 1) >= fabs(out->pair - 1))) out->pair = size;
  }
  out->flip = creal(flip);
  out->fold = creal(fold);
  out->determinant = m < n ? 0 : creal(all);
}

hc_status monodromy_stability(monodromy *w, const contact_forces *orbit, double omega, hbm_stability *out)
{
  w->count = 0;
  hc_status st = variation_begin(w->v, orbit, omega);
  if (st == HC_OK) st = w->how->find(w->method, &w->count, w->lambda);
  if (st != HC_OK) return st;
  summarise(2 * w->v->n, w->count, w->lambda, out);
  out->of_motion = !variation_never_changes(w->v);
  TRACE(stability, "omega %.9g: %d multipliers, the largest %.6g%+.6gi", omega, w->count, out->re, out->im);
  return HC_OK;
}

int monodromy_multipliers(const monodromy *w, const double complex **lambda)
{
  *lambda = w->lambda;
  return w->count;
}
