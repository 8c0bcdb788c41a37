/* line.c - the truth's curve in the file's quantity, for a drawing: its points, and some between them, since a drawing
 * joins them by straight lines. */
#include <stdlib.h>

#include "compare/verify/truth_impl.h"
#include "hbm/segment.h"

enum { BETWEEN = 4 }; /* steps from one point of the curve to the next */

static hc_status put(truth *t, double omega, const double *X, int stable)
{
  measured m;
  hc_status st = truth_measure(t, omega, X, &m);
  if (st == HC_OK) t->out->line[t->out->n_line++] = (verify_line){omega, m.value, stable};
  return st;
}

hc_status truth_line(truth *t)
{
  const hbm_curve *c = &t->curve;
  verify_report *out = t->out;
  double *X = malloc(((size_t)c->n_coef + 1) * sizeof *X);
  out->n_line = 0;
  out->line = calloc((size_t)BETWEEN * (size_t)c->n + 1, sizeof *out->line);
  hc_status st = X && out->line ? HC_OK : HC_NO_MEMORY;
  for (int k = 0; k < c->n && st == HC_OK; ++k) {
    const double *here = c->X + (size_t)k * (size_t)c->n_coef;
    const int stable = truth_stable(t, c->points[k].omega, here, &st);
    if (st == HC_OK) st = put(t, c->points[k].omega, here, stable);
    if (k + 1 == c->n) break;
    const hbm_segment segment = hbm_segment_between(c, k);
    for (int i = 1; i < BETWEEN && st == HC_OK; ++i) {
      double omega;
      hbm_segment_at(&segment, (double)i / BETWEEN, X, &omega, NULL, NULL);
      st = put(t, omega, X, stable);
    }
  }
  free(X);
  return st;
}
