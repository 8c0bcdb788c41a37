/* modes.h - natural frequencies of a model's linear limits: every contact apart, or every contact stuck. */
#pragma once

#include "model/model.h"

/* K' phi = omega^2 M phi with the symmetric part of K, and of the stuck contacts' stiffness where `stuck`: omega2[n]
 * ascending [1/time^2], negative where the structure is driven away; phi[n][n] in columns, phi^T M phi = 1.
 * HC_NO_MEMORY; HC_SINGULAR if M is not positive definite; HC_NOT_CONVERGED. */
hc_status model_modes(const model *m, bool stuck, double *omega2, double *phi);

/* A mode of one of the two limits. */
typedef struct model_mode {
  double omega;   /* [rad/time] NaN where the structure is driven away */
  double damping; /* [1] of critical; NaN without a frequency */
} model_mode;

/* modes[n], ascending. HC_NO_MEMORY, and the errors of model_modes. */
hc_status model_mode_list(const model *m, bool stuck, model_mode *modes);

/* What steps in omega are measured by. */
typedef struct model_scales {
  double highest;    /* [rad/time] the highest natural frequency, contacts stuck */
  double half_width; /* [rad/time] the least half width of a resonance, c/2 with c = phi^T C phi; 0 without damping */
} model_scales;

/* Errors of model_modes. */
hc_status model_find_scales(const model *m, model_scales *out);
