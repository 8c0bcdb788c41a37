/* lowest_modes.h - the lowest modes of a large structure: ARPACK, shifted and inverted by a factor. */
#ifndef HC_REDUCE_LOWEST_MODES_H
#define HC_REDUCE_LOWEST_MODES_H

#include "reduce/factor.h"

/* A phi = lambda M phi, A being what f is the factor of, M symmetric and positive semidefinite: beside the `known` modes
 * that are in lambda[] and phi[][n], the `more` lowest others behind them, ascending, phi^T M phi = 1, rows that are
 * held 0. *found: how many, fewer where M gives no more of them mass. known + more < n. HC_NO_MEMORY, HC_NOT_CONVERGED.
 * The same arguments give the same bits. */
hc_status lowest_modes(factor *f, const sparse *M, const bool *held, int known, int more, double *lambda, double *phi,
                       int *found);

#endif
