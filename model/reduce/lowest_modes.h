/* lowest_modes.h - the lowest modes of a large structure: ARPACK, shifted and inverted by a factor. */
#pragma once

#include "model/casefile/structure.h"
#include "model/modes.h"
#include "model/reduce/factor.h"

/* A phi = lambda M phi, A being what f is the factor of, M symmetric and positive semidefinite: beside the `known`
 * modes that are in lambda[] and phi[][n], the `more` lowest others behind them, ascending, phi^T M phi = 1, rows that
 * are held 0. *found: how many; fewer, but at least one, where there are not so many; 0: none is left. HC_NO_MEMORY,
 * HC_NOT_CONVERGED. The same arguments give the same bits. */
hc_status lowest_modes(factor *f, const sparse *M, const bool *held, int known, int more, double *lambda, double *phi,
                       int *found);

/* The `count` lowest modes of s, which is_sparse, its contacts apart or all stuck, into modes[count], *found of them.
 * Damping is NaN with contacts stuck where it is modal: it takes all modes to tell. HC_SINGULAR: neither K nor M holds
 * a motion; and as lowest_modes. */
hc_status lowest_of_structure(const scene_structure *s, bool stuck, int count, model_mode *modes, int *found);
