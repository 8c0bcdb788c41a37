/* fixed_step.c - arc-length continuation as a simple code has it (hbm.continuation: fixed_step), to show which failures
 * belong to the continuation and not to the equations:
 *
 *   predict   along the last point's tangent, always by the arc length hbm.step
 *   correct   plain Newton in the plane across that tangent, at most hbm.iterations of them
 *   tangent   the one that points along the last: normal . t = 1 (corrector.h) sees to it
 *
 * What converges is a point of the curve, wherever it is; what does not ends the curve. There is no shorter step to try
 * again with, no line search, no rule for corners, and no orientation by a determinant: the curve may turn round at a
 * kink and retrace its path. The first point, and the curve's end on the sweep's limit, are found as always. */
#include "hbm/curve/fixed_step.h"

#include "hbm/solver/corrector.h"

hc_status fixed_step(path *p, bool *accepted)
{
  hbm_curve *c = p->curve;
  p->tangent_only = true;
  path_predict(p, p->s->how.step * p->s->step_scale);
  path_fill_normal(p);
  hc_status st = hbm_solve_plane_plainly(p->s, p->normal, path_size(p), c->omega_scale, p->X, &p->omega, &p->point);
  c->iterations += p->point.iterations;
  if (st == HC_OK) st = hbm_tangent_plane(p->s, p->dX, &p->d_omega);
  *accepted = st == HC_OK;
  return st;
}
