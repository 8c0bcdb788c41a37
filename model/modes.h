/* modes.h - natural frequencies of a model's linear limits: all contacts open, or all contacts stuck. */
#pragma once

#include "model/model.h"

/* K' phi = omega^2 M phi, K' being the symmetric part of K, if `stuck` plus the stuck contacts' stiffness: omega2[n]
 * ascending [1/time^2], negative for unstable modes; phi[n][n] in columns, phi^T M phi = 1. HC_NO_MEMORY; HC_SINGULAR
 * if M is not positive definite; HC_NOT_CONVERGED. */
hc_status model_modes(const model *m, bool stuck, double *omega2, double *phi);

/* A mode of one of the two limits. */
typedef struct model_mode {
  double omega;   /* [rad/time] NaN for an unstable mode */
  double damping; /* [1] damping ratio; NaN if omega is 0 or NaN */
} model_mode;

/* modes[n], ascending. HC_NO_MEMORY, and the errors of model_modes. */
hc_status model_mode_list(const model *m, bool stuck, model_mode *modes);

/* Frequency scales of a model, for steps in omega. */
typedef struct model_scales {
  double highest;    /* [rad/time] highest natural frequency, contacts stuck */
  double half_width; /* [rad/time] least half width of a resonance, c/2 with c = phi^T C phi; 0 without damping */
} model_scales;

/* Errors of model_modes. */
hc_status model_find_scales(const model *m, model_scales *out);
