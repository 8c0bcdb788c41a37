/* narrowing.c - see narrowing.h. */
#include "hbm/curve/narrowing.h"

#include <string.h>

#include "hbm/curve/segment.h"

static const double SHORTEST = 1e-7; /* ends that are right to 1e-13 of the segment: 1e-6 of the part */

hc_status hbm_narrowing_start(hbm_narrowing *p, const hbm_curve *c, int k)
{
  hc_status st = HC_OK;
  p->ends.n = 0;
  p->ends.omega_scale = c->omega_scale;
  p->from = 0;
  p->to = 1;
  for (int end = k; end <= k + 1 && st == HC_OK; ++end)
    st = hbm_curve_append(&p->ends, c->n_coef, hbm_curve_X(c, end), hbm_curve_dX(c, end), &c->points[end]);
  return st;
}

static double part_of(const hbm_narrowing *p, double sigma) { return (sigma - p->from) / (p->to - p->from); }

void hbm_narrowing_guess(const hbm_narrowing *p, double sigma, double *X, double *omega)
{
  const hbm_segment between = hbm_segment_between(&p->ends, 0);
  hbm_segment_at(&between, part_of(p, sigma), X, omega, NULL, NULL);
}

hc_status hbm_narrowing_point(hbm_solver *s, const hbm_narrowing *p, double sigma, hbm_candidate *x)
{
  return hbm_segment_point(s, &p->ends, 0, part_of(p, sigma), x);
}

void hbm_narrowing_move(hbm_narrowing *p, bool first, double sigma, const hbm_candidate *x)
{
  const int end = first ? 0 : 1;
  const size_t bytes = (size_t)p->ends.n_coef * sizeof(double);
  if (!((first ? p->to - sigma : sigma - p->from) >= SHORTEST)) return;
  *(first ? &p->from : &p->to) = sigma;
  p->ends.points[end] = x->point;
  memcpy(hbm_curve_X(&p->ends, end), x->X, bytes);
  memcpy(hbm_curve_dX(&p->ends, end), x->dX, bytes);
}
