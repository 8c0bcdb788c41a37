/* rests.c - see rests.h. */
#include "hbm/solver/rests.h"

#include <string.h>

#include "hbm/solver/hbm_solver_impl.h"
#include "numerics/norm.h"

void hbm_start_sliders(hbm_solver *s, const double *w)
{
  const int n = s->model->n_contacts;
  double *const at = s->slider_starts;
  for (int j = 0; j < n; ++j) at[j] = w ? w[j] : s->model->contacts[j].rest;
  s->started = !is_zero(n, at);
  s->sys.evaluated = false;
  contact_forces_start(s->sys.contacts, at);
  if (s->orbit) contact_forces_start(s->orbit, at);
}

hc_status hbm_free_sliders(hbm_solver *s, const double *X, double *w, bool *free)
{
  const model *m = s->model;
  const hc_status st = hbm_sliders(s, X, w);
  for (int j = 0; j < m->n_contacts && st == HC_OK; ++j) {
    const model_contact *c = &m->contacts[j];
    free[j] = contact_forces_regime(s->sys.contacts, j) == CONTACT_STUCK && contact_has_friction(&c->law) &&
              !is_zero(m->n, c->tangent);
  }
  return st;
}

hc_status hbm_rest_tangent(hbm_solver *s, int j, double *dX)
{
  const hbm_system *sys = &s->sys;
  const double kt = s->model->contacts[j].law.kt, *t = condensation_tangent(sys->linear, j);
  memset(s->z, 0, (size_t)sys->n * sizeof *s->z);
  memset(dX, 0, (size_t)sys->n_coef * sizeof *dX);
  if (sys->first > 0) return HC_OK; /* no means: nothing that w could move */
  for (int d = 0; d < sys->dim; ++d) s->z[d] = kt * t[d];
  const hc_status st = newton_backsolve(s->fixed, s->z);
  if (st == HC_OK) memcpy(dX, s->z, (size_t)sys->n * sizeof *dX);
  return st;
}

double hbm_distance(const hbm_solver *s, const double *X, const double *Y)
{
  const metric_at at = hbm_metric_at(s, X);
  return metric_distance(&at, X, Y);
}
