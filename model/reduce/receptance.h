/* receptance.h - how far the receptance of a reduced structure is from that of the large one. */
#pragma once

#include "model/casefile/scene.h"
#include "model/reduce/craig_bampton.h"

typedef struct receptance receptance;

typedef struct receptance_error {
  double error; /* [1] at most 1 */
  double omega; /* [rad/time] where */
  bool stuck;   /* with the contacts stuck; else apart */
} receptance_error;

/* The receptance H between the directions of contacts, loads and responses of sc's structure, from all modes that cb
 * has, at frequencies of sc's sweep and its harmonics up to 3: evenly spread ones and the resonances, the contacts all
 * apart and all stuck. HC_NO_MEMORY, or as model_modes and structure_resolve_damping. */
hc_status receptance_new(const craig_bampton *cb, const scene *sc, receptance **out);
void receptance_free(receptance *r);

/* The largest relative error with the first `modes` modes alone, in the Frobenius norm, of harmonic h divided by h^2,
 * as forces of motions with kinks fall with h:
 *     dH = -H R H,    |dH|/|H|/h^2,    R from craig_bampton_rest
 * where that bound does not hold: 1. at, if not NULL: there alone. */
receptance_error receptance_compare(receptance *r, int modes, const receptance_error *at);
