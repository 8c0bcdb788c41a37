/* scene_solvers.c - see scene_solvers.h. */
#include "compare/study/scene_solvers.h"

#include "compare/first_guess.h"

/* What `call` makes of m, the scene's model. */
#define MADE_OF_MODEL(call)                                                                                            \
  model *m;                                                                                                            \
  *out = NULL;                                                                                                         \
  hc_status st = scene_model(sc, &m);                                                                                  \
  if (st == HC_OK) st = (call);                                                                                        \
  model_free(m);                                                                                                       \
  return st

hc_status scene_hbm_solver(const scene *sc, hbm_solver **out)
{
  MADE_OF_MODEL(guided_hbm_solver_new(m, &sc->hbm, out));
}

hc_status scene_timeint(const scene *sc, timeint **out) { MADE_OF_MODEL(timeint_new(m, &sc->transient, out)); }

hc_status scene_forces(const scene *sc, hbm_force force, int n_harm, int n_time, contact_forces **out)
{
  const evaluator_settings how = {.n_harm = n_harm, .n_time = n_time, .slider = {.restart = sc->hbm.restart}};
  MADE_OF_MODEL(contact_forces_new(m, NULL, force, &how, out));
}
