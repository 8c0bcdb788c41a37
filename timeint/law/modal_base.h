/* modal_base.h - a structure in the modes of its linear part, contacts open: the coordinates of time integration.
 *
 *     x = shape q,   shape = phi/s,   phi^T M phi = 1,  K_sym phi = M phi diag(omega_i^2)      q [length]
 *     q'' + C q' + K q = p(t) - s^2 sum_j [ t_j T_j + n_j (N_j - N0_j) ]
 *     u_j = t_j . q,  v_j = n_j . q,  r = r . q                        (rows t_j shape, n_j shape, r shape, written
 * t_j ...) All modes are kept, so this is exact; s scales q so that q = 1 is a motion of about 1 at the contacts and
 * responses. C and K are stored as diagonals if they are diagonal in the modes (symmetric K, Rayleigh or modal damping)
 * up to rounding of the matrices' entries, else full. */
#pragma once

#include <stdbool.h>

#include "model/model.h"

typedef struct modal_base { /* from modal_base_new, to modal_base_free; only read in between */
  int n, n_contacts, n_loads, n_responses;
  int n_planar;                /* number of contacts with two tangents under the law of the circle */
  bool is_smooth;              /* true if any contact's law is smooth */
  double s;                    /* [mass^-1/2] */
  double *shape, *inverse;     /* [n][n] by columns: x = shape q, q = inverse x */
  bool diagonal_K, diagonal_C; /* true: only the diagonal K[i], C[i] is stored */
  double *K, *C;               /* [n] or [n][n] by columns: [1/time^2], [1/time] */
  double *tangent, *normal;    /* [n_contacts][n] [1] */
  int *harmonic;               /* [n_loads] */
  int *inertial;               /* [n_loads] same block: true for loads proportional to omega^2 */
  double *cosine, *sine;       /* [n_loads][n] [length/time^2] of p(t) */
  double *response;            /* [n_responses][n] [1] */
  double highest;              /* [rad/time] highest natural frequency, contacts stuck */
  double lowest;               /* [rad/time] lowest nonzero natural frequency, contacts stuck */
  double decay;                /* [1/time] >= 0: largest C_ii, the decay rate of a mode without stiffness */
  double slowest;              /* [1/time] >= 0: least C_ii/2, the decay rate of an underdamped mode */
  double *slowed;              /* [n] divisor of the mode's frequency by modal_base_slowed; 1: unchanged */
  double *numbers;             /* memory of all arrays of doubles */
} modal_base;

/* HC_NO_MEMORY; HC_SINGULAR if M is not positive definite; HC_NOT_CONVERGED. *out is then NULL. */
hc_status modal_base_new(const model *m, modal_base **out);
void modal_base_free(modal_base *b); /* NULL is allowed */

/* A copy of b, of model m, with mass added to modes faster than `fastest` [rad/time] so that their frequency is
 * `fastest` (mass scaling): with a_i = omega_i/fastest, q_i = q_i of the copy / a_i,
 *     K_ii = fastest^2,   C_ij = C_ij of b/sqrt(a_i a_j),   rows t_ji, n_ji, r_i, loads: those of b/a_i
 * Their static compliance phi phi^T/omega_i^2 and their damping ratios are unchanged; at frequency Omega their
 * compliance is larger by the part (Omega/fastest)^2. Requires diagonal K. HC_NO_MEMORY: *out is NULL. */
hc_status modal_base_slowed(const modal_base *b, const model *m, double fastest, modal_base **out);

/* q[n] of x[n], and x of q. */
void modal_base_to_modes(const modal_base *b, const double *x, double *q);
void modal_base_to_model(const modal_base *b, const double *q, double *x);

/* out[n] -= by K x; out[n] -= by C x. */
void modal_base_subtract_K(const modal_base *b, double by, const double *x, double *out);
void modal_base_subtract_C(const modal_base *b, double by, const double *x, double *out);
