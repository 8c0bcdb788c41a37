/* scene_solvers.c - see scene_solvers.h. */
#include "study/scene_solvers.h"

#include "compare/first_guess.h"

hc_status scene_hbm_solver(const scene *sc, hbm_solver **out)
{
  model *m;
  *out = NULL;
  hc_status st = scene_model(sc, &m);
  if (st == HC_OK) st = guided_hbm_solver_new(m, &sc->hbm, out);
  model_free(m);
  return st;
}

hc_status scene_timeint(const scene *sc, timeint **out)
{
  model *m;
  *out = NULL;
  hc_status st = scene_model(sc, &m);
  if (st == HC_OK) st = timeint_new(m, &sc->transient, out);
  model_free(m);
  return st;
}

hc_status scene_aft(const scene *sc, int n_harm, int n_time, aft **out)
{
  model *m;
  *out = NULL;
  hc_status st = scene_model(sc, &m);
  if (st == HC_OK) st = aft_new_of_model(m, sc->hbm.restart, n_harm, n_time, out);
  model_free(m);
  return st;
}

hc_status scene_exact(const scene *sc, int n_harm, exact_force **out)
{
  model *m;
  *out = NULL;
  hc_status st = scene_model(sc, &m);
  if (st == HC_OK) st = exact_force_new_of_model(n_harm, m, out);
  model_free(m);
  return st;
}
