/* kick.c - does a motion stay on its orbit where linear theory cannot tell?
 *
 * A slider that never slips, and whose traction just reaches the limit, sticks on one side of the orbit and slips on
 * the other: the period map has a corner there. Its multipliers are those of the side that sticks, and a motion pushed
 * to the other one may be carried off for good. So it is pushed to both, by a little, and followed period after period.
 */
#include <math.h>
#include <string.h>

#include "compare/comparison_private.h"

static const double push = 1e-5; /* of the motion's size */
enum { MOST_PERIODS = 5000 };

static hc_status follow(comparison_work *w, timeint *ti, double omega, double by, timeint_result *r)
{
  const int n = w->setup->model->n;
  double size = 0, *y = w->scratch;
  memcpy(y, w->state, (size_t)w->out->n_states * sizeof *y);
  for (int i = 0; i < n; ++i) size = fmax(size, hypot(y[i], y[n + i] / omega));
  for (int i = 0; i < n; ++i) y[i] += (i % 2 ? -by : by) * size;
  return timeint_steady(ti, omega, y, w->monitor, r);
}

bool solution_is_at_corner(const comparison_row *row)
{
  return row->transient.free_sliders > 0 && hbm_stability_verdict(&row->stability) == 0;
}

hc_status solution_kick(comparison_work *w, double omega, int side, timeint_result *r)
{
  transient_settings how = w->setup->transient;
  timeint *ti;
  how.law = TRANSIENT_LAW_EXACT;
  how.method = TRANSIENT_METHOD_CLOSED_FORM;
  how.steady = TRANSIENT_STEADY_MARCH;
  how.scout = how.richardson = false;
  if (how.max_periods > MOST_PERIODS) how.max_periods = MOST_PERIODS;
  hc_status st = timeint_new(w->setup->model, &how, &ti);
  if (st == HC_OK) st = follow(w, ti, omega, side * push, r);
  timeint_free(ti);
  return st;
}
