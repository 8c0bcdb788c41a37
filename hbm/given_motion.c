/* given_motion.c - see given_motion.h. */
#include "hbm/given_motion.h"

#include <string.h>

#include "hbm/aft.h"
#include "hbm/circle_aft.h"
#include "hbm/circle_force.h"
#include "hbm/exact_force.h"
#include "numerics/series.h"

given_motion given_motion_of_contact(const model *of, int j, moving_contact *place)
{
  const model_contact *c = &of->contacts[j];
  const bool pair = c->pair != CONTACT_ALONE;
  *place = (moving_contact){.law = c->law, .cu = {1, 0}, .cv = {0, 1}};
  return (given_motion){
      .pair = pair, .circle = pair && c->circle, .n_dof = 2 + pair, .n_contacts = 1, .contacts = place};
}

bool given_motion_in_circle(const given_motion *m) { return m->circle && contact_has_friction(&m->contacts->law); }

int given_motion_circle_dof(const contact *law) { return law->kn > 0 ? 3 : 2; }

static hc_status evaluate_exactly(const given_motion *m, int n_dof, const double *X, double *F)
{
  exact_force *e = NULL;
  hc_status st = exact_force_new(m->n_harm, n_dof, m->n_contacts, m->contacts, &e);
  if (st == HC_OK) st = exact_force_eval(e, X, F, NULL, NULL);
  exact_force_free(e);
  return st;
}

static hc_status evaluate_sampled(const given_motion *m, hbm_restart restart, int n_time, int n_dof, const double *X,
                                  double *F)
{
  aft *a = NULL;
  hc_status st = aft_new(m->n_harm, n_time, restart, n_dof, m->n_contacts, m->contacts, &a);
  if (st == HC_OK) st = aft_eval(a, X, F, NULL, NULL);
  aft_free(a);
  return st;
}

static hc_status evaluate(const given_motion *m, hbm_restart restart, int n_time, int n_dof, const double *X, double *F)
{
  if (n_time == GIVEN_EXACT) return evaluate_exactly(m, n_dof, X, F);
  return evaluate_sampled(m, restart, n_time, n_dof, X, F);
}

static hc_status circle_exactly(const given_motion *m, double *F)
{
  const contact *law = &m->contacts->law;
  circle_force *f = NULL;
  hc_status st = circle_force_new(m->n_harm, given_motion_circle_dof(law), law, &f);
  if (st == HC_OK) st = circle_force_eval(f, m->X, F, NULL, NULL);
  circle_force_free(f);
  return st;
}

static hc_status circle_sampled(const given_motion *m, hbm_restart restart, int n_time, double *F)
{
  const contact *law = &m->contacts->law;
  circle_aft *a = NULL;
  hc_status st = circle_aft_new(m->n_harm, n_time, restart, given_motion_circle_dof(law), law, &a);
  if (st == HC_OK) st = circle_aft_eval(a, m->X, F, NULL);
  circle_aft_free(a);
  return st;
}

static hc_status halves(const given_motion *m, hbm_restart restart, int n_time, double *F)
{
  const int n = series_length(m->n_harm);
  double x[2 * GIVEN_MOST_COEF], f[2 * GIVEN_MOST_COEF];
  hc_status st = HC_OK;
  for (int d = 0; d < 2 && st == HC_OK; ++d) {
    memcpy(x, m->X + d * n, (size_t)n * sizeof *x);
    memcpy(x + n, m->X + 2 * n, (size_t)n * sizeof *x);
    st = evaluate(m, restart, n_time, 2, x, f);
    for (int i = 0; i < n && st == HC_OK; ++i) {
      F[d * n + i] = f[i];
      F[2 * n + i] += f[n + i];
    }
  }
  return st;
}

hc_status given_motion_force(const given_motion *m, hbm_restart restart, int n_time, double *F)
{
  memset(F, 0, (size_t)m->n_dof * (size_t)series_length(m->n_harm) * sizeof *F);
  if (!m->pair) return evaluate(m, restart, n_time, m->n_dof, m->X, F);
  if (!given_motion_in_circle(m)) return halves(m, restart, n_time, F);
  return n_time == GIVEN_EXACT ? circle_exactly(m, F) : circle_sampled(m, restart, n_time, F);
}

double given_motion_preload(const given_motion *m)
{
  const contact *law = &m->contacts->law;
  const int halves = m->pair ? 2 : 1;
  return halves * (contact_preload(law) + law->load);
}
