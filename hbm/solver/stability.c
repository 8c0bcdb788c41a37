/* stability.c - see stability.h. */
#include "hbm/solver/stability.h"

#include <math.h>

#include "hbm/solver/corrector.h"
#include "hbm/solver/hbm_solver_impl.h"

/* A structure of more degrees of freedom is large; with planar friction, whose slip is followed step by step, one of
 * more states, and beyond 50 degrees of freedom nothing is known of it. */
enum { LARGE = 50, LARGE_WITH_PLANAR = 12 };

bool hbm_stability_is_costly(const hbm_solver *s)
{
  const model *m = s->model;
  return m->n > LARGE || (model_has_circle(m) && m->n + m->n_contacts > LARGE_WITH_PLANAR);
}

bool hbm_stability_is_unknown(const hbm_solver *s) { return s->model->n > LARGE && model_has_circle(s->model); }

hc_status hbm_multipliers(hbm_solver *s, const contact_forces *orbit, double omega, hbm_stability *out)
{
  *out = (hbm_stability){NAN, NAN, NAN, NAN, NAN, NAN, 0, NAN, false};
  if (hbm_stability_is_unknown(s)) return HC_OK;
  hc_status st = s->monodromy ? HC_OK : monodromy_new(s->model, &s->monodromy);
  return st == HC_OK ? monodromy_stability(s->monodromy, s->model, orbit, omega, out) : st;
}

hc_status hbm_stability_at(hbm_solver *s, double omega, const double *X, hbm_stability *out)
{
  const contact_forces *orbit;
  contact_report report;
  int det_sign;
  hc_status st = hbm_located_orbit(s, X, &orbit, &report);
  if (st == HC_OK) st = hbm_multipliers(s, orbit, omega, out);
  if (st != HC_OK) return st;
  bool regular = hbm_det_sign_at(s, omega, X, &det_sign) == HC_OK;
  out->agrees = regular && (det_sign > 0) == (out->fold > 0);
  return HC_OK;
}

int hbm_stability_verdict(const hbm_stability *st)
{
  bool clear = fabs(st->multiplier - 1) > 1e-9; /* false for NaN */
  if (!clear || !st->agrees) return 0;
  return st->multiplier < 1 ? 1 : -1;
}
