/* method.c - see method.h. */
#include "compare/accuracy/method.h"

#include <stdlib.h>

bool method_is_hbm(bench_method m) { return m == BENCH_HBM_EXACT || m == BENCH_HBM_SAMPLED; }

compare_setup method_setup(const compare_setup *setup, bench_method method, int harmonics, int samples,
                           double regularisation, double tolerance)
{
  compare_setup own = *setup;
  transient_settings *t = &own.transient;
  if (method_is_hbm(method)) {
    own.hbm.harmonics = harmonics;
    own.hbm.force = method == BENCH_HBM_EXACT ? HBM_FORCE_EXACT : HBM_FORCE_SAMPLED;
    if (samples > 0) own.hbm.samples = samples;
    return own;
  }
  const bool marches = method == BENCH_EXACT_MARCHING || method == BENCH_REGULARISED_MARCHING;
  t->law = regularisation > 0 ? TRANSIENT_LAW_REGULARISED : TRANSIENT_LAW_EXACT;
  if (regularisation > 0) t->regularisation = regularisation;
  t->regularisation_error = 0; /* its error is to be measured */
  t->tolerance = tolerance;
  t->method = method == BENCH_CLOSED_SHOOTING ? TRANSIENT_METHOD_CLOSED_FORM : TRANSIENT_METHOD_CVODE;
  t->scout = method == BENCH_EXACT_SCOUTED || method == BENCH_REGULARISED_SCOUTED;
  t->steady = marches ? TRANSIENT_STEADY_MARCH : TRANSIENT_STEADY_SHOOTING;
  return own;
}

static double quantile(int n, const double *v, double at)
{
  if (n == 0) return NAN;
  double rank = at * (n - 1);
  int i = (int)rank;
  return i + 1 < n ? v[i] + (rank - i) * (v[i + 1] - v[i]) : v[n - 1];
}

void method_quartiles(int n, double *v, double *low, double *median, double *high)
{
  qsort(v, (size_t)n, sizeof *v, ascending);
  *low = quantile(n, v, 0.25);
  *median = quantile(n, v, 0.5);
  *high = quantile(n, v, 0.75);
}
