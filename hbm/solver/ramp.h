/* ramp.h - a path from a system whose solution is known to the model's own equations, at one omega. While a solver
 * follows a ramp, its place p on it stands where omega stands otherwise: as the parameter of the curve that
 * continuation.c traces, turning points and corners included. D and phi: system.h.
 *
 *     damping   p from 2 to 1:   D = most (exp(rate (p - 1)) - 1) / (exp(rate) - 1)
 *     force     p from 1e-4 to 1:  phi = p */
#pragma once

#include "hbm/solver/system.h"

typedef enum hbm_ramp_kind { HBM_RAMP_DAMPING, HBM_RAMP_FORCE } hbm_ramp_kind;

typedef struct hbm_ramp {
  hbm_ramp_kind kind;
  double omega;      /* [rad/time] */
  double from;       /* [1] p at the start; at the end it is 1 */
  double most, rate; /* of D: [force time/length], [1] */
  bool quick;        /* by plain Newton of few iterations (corrector.c) */
} hbm_ramp;

hbm_ramp hbm_ramp_of(hbm_ramp_kind kind, const hbm_system *sys, double omega);

/* A guess X[n_coef] for the start of the ramp, the linear response there; *sys is left there. */
void hbm_ramp_start(const hbm_ramp *r, hbm_system *sys, double *X);

/* The equations become those at p; hbm_ramp_leave: the model's own. */
void hbm_ramp_set(const hbm_ramp *r, double p, hbm_system *sys);
void hbm_ramp_leave(hbm_system *sys);

/* dR/dp [n] at X and p. */
void hbm_ramp_derivative(const hbm_ramp *r, double p, hbm_system *sys, const double *X, double *dR);
