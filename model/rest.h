/* rest.h - a model in displacements y from its rest position under static loads (harmonic 0), x = rest + y, so that
 * lengths, tolerances and rounding are those of the vibration, whatever the static position.
 *
 *     K rest + sum_j [ t_j T_j + n_j (N_j - N0_j) ] = p_0      sliders from w = 0, moved within the limit in one step
 *
 * In y gaps are gap + n_j.rest, sliders w - t_j.rest; a polynomial f(v) is expanded about n_j.rest, its slope there is
 * added to K. p_0 becomes the static tractions, sum t_j T_j. The choice of `rest` does not change the motion x: if none
 * is found it is 0, and y = x. */
#pragma once

#include "model/model.h"

/* *out, to be freed by model_free: m in y; rest[n]. Without a load of harmonic 0 rest = 0, and *out equals m exactly.
 * HC_NO_MEMORY: *out is NULL. */
hc_status model_about_rest(const model *m, model **out, double *rest);
