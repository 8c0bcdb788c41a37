/* scene_solvers.h - solvers and evaluators of what a case file says, for those who have a scene in hand. Each makes the
 * scene's model, gives it to the solver, which copies it, and frees it. Errors are those of the solver's own _new. */
#pragma once

#include "hbm/forces/contact_forces.h"
#include "hbm/hbm.h"
#include "model/casefile/scene.h"
#include "timeint/steady/steady.h"
#include "timeint/steady/sweep.h"

enum { SCENE_MAX_STATES = TIMEINT_W + SCENE_MAX_CONTACTS };

/* A state of a scene's model, with room for as many contacts as a scene may have; `all` is what timeint.h takes. */
typedef union scene_state {
  struct {
    double x, v, w[SCENE_MAX_CONTACTS];
  };
  double all[SCENE_MAX_STATES];
} scene_state;

hc_status scene_hbm_solver(const scene *sc, hbm_solver **out);
hc_status scene_timeint(const scene *sc, timeint **out);
hc_status scene_forces(const scene *sc, hbm_force force, int n_harm, int n_time, contact_forces **out);
