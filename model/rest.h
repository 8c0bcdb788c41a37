/* rest.h - a model seen from where it rests under its static loads (harmonic 0): x = rest + y, and y alone is solved
 * for, so that lengths, tolerances and rounding are those of the vibration, whatever the static position.
 *
 *     K rest + sum_j [ t_j T_j + n_j (N_j - N0_j) ] = p_0      sliders from w = 0, put into the cone at once
 *
 * Of y: gaps are gap + n_j.rest, sliders w - t_j.rest; a polynomial f(v) is expanded about n_j.rest, its slope there
 * belongs to K. What is left of p_0 are the static tractions, sum t_j T_j. Which rest is taken changes no motion: where
 * none is found it is 0, and y = x. */
#pragma once

#include "model/model.h"

/* *out, to be freed by model_free: m in y; rest[n]. Without a load of harmonic 0 rest = 0, and *out is m to the last
 * bit. HC_NO_MEMORY: *out is NULL. */
hc_status model_about_rest(const model *m, model **out, double *rest);
