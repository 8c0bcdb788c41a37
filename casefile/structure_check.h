/* structure_check.h - what the matrices of a structure must be: rules, without words. */
#ifndef HC_STRUCTURE_CHECK_H
#define HC_STRUCTURE_CHECK_H

#include <stdbool.h>

#include "base/message.h"
#include "casefile/structure.h"

/* Is A[n][n] not symmetric, beyond the 1e-10 of its diagonal that a reduction leaves? Then the first such entry, from
 * 0, i > j. */
bool structure_unsymmetric(int n, const double *A, int *i, int *j);

/* *order = 0 for a symmetric M[n][n] that is positive definite beyond rounding; else the order of its first leading
 * minor that is not positive. HC_NO_MEMORY. */
hc_status structure_not_definite(int n, const double *M, int *order);

/* A motion x[n], largest entry 1, that neither K nor any contact resists: *free_motion = true if there is one. The
 * stiffness then is singular to rounding with every contact stuck, kt t t^T + kn n n^T each where it can hold; at_rest:
 * each that is pressed on without a load. HC_NO_MEMORY. */
hc_status structure_free_motion(const scene_structure *s, bool at_rest, double *x, bool *free_motion);

/* The same of a motion that M[n][n], symmetric, gives no kinetic energy to. HC_NO_MEMORY. */
hc_status structure_massless_motion(int n, const double *M, double *x, bool *massless);

/* *omega [rad/time] of the first mode of M and K that C takes no energy from, beyond rounding; -1: there is none.
 * s->damping.v is resolved. HC_NO_MEMORY, HC_NOT_CONVERGED. */
hc_status structure_undamped_mode(const scene_structure *s, double *omega);

/* The degrees of freedom that move most, at most four, in words; x is used up. */
void structure_describe_motion(const scene_structure *s, double *x, message *m);

/* s->damping.v from the kind of damping: alpha M + beta K; or for modal damping M Phi diag(2 z omega) Phi^T M, the
 * columns of Phi being the modes of M and K with Phi^T M Phi = 1 (Craig and Kurdila, Fundamentals of Structural
 * Dynamics, 2006, chapter 10), K being symmetric then. HC_BAD_INPUT if a mode's omega^2 is negative beyond rounding;
 * HC_NO_MEMORY, HC_NOT_CONVERGED. */
hc_status structure_resolve_damping(scene_structure *s);

#endif
