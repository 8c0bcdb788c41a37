/* start.h - the first point of a response curve. */
#ifndef HC_HBM_START_H
#define HC_HBM_START_H

#include "hbm/hbm.h"

/* Harmonics X[2H+1] of the linear response at omega with every contact as the static state leaves it: stuck where it is preloaded
 * (gap > 0), apart otherwise. Closed form: x = F0 / (K' - M omega^2 + i C omega). Returns its norm. */
double hbm_linear_response(const scene *sc, double omega, int n_harm, double *X);

#endif
