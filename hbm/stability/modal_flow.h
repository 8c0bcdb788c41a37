/* modal_flow.h - how a perturbation of a large structure's orbit moves, in the modes of the structure without contacts
 * (M = 1, C and K diagonal), with contacts of one tangent or of two under one limit:
 *
 *     eta_k'' + c_k eta_k' + lambda_k eta_k = -sum over contact directions b_k f
 *     f = kt du - dheld stuck,  mu kn dv slipping,  kt (e dR + e_perp y) of a circle that slips (planar_flow.h);  kn dv
 *
 * by Radau's collocation (order 9) between changes of contact. At the points of a step each mode is a small matrix
 * times the contact forces, so what is solved for are motions of the contacts in touch, few and the same for all
 * columns. What is much faster than the step decays within it, as Radau's method does, and follows as a spring.
 *
 * Steps resolve every mode that keeps half of itself over a period: 1e-8 of its multiplier where steps are cheap. The
 * others, F, ring after changes of contact; left out, that is 1e-6 of the largest multiplier of
 * cases/structures/plates.yaml (by steps a fourth as long). They are left to decay only if they would:
 *   - damping leaves less than half of each over a period
 *   - a change of the state of contact j moves the energy of F by no more than the part k_j b_j^T Omega^-2 b_j, and all
 *     changes together by less than half of what damping takes
 *   - in the states of all contacts at sixteen instants of the period the roots of s^2 + c s + Omega^2 + K_j in F, for
 *     a circle that slips with its stiffness across slip, are to the left of -c/4, c the least damping in F. K_j is
 *     not symmetric where a contact slips: mu kn t n^T can make two modes of neighbouring frequencies flutter.
 * The third holds if an energy x* L11 x + 2 x* L12 v + v* L22 v falls that fast: with K_j = S + N, N skew, r = c/4,
 *     L11 = Omega^2 + S + C^2/2 + a,    L12 = C/2,    L22 = 1 + b,
 *     b_kl = 2 N_kl/(omega_k^2 - omega_l^2),    a = N + b Omega^2
 *     Q = -dL/dt - 2 r L:    Q11 = sym(C (Omega^2 + K_j)) - 2 r L11,    Q12 = (b K_j)^T - r C,
 *     Q22 = C + b C + C b - 2 r L22
 * where L and Q are positive definite: beside a diagonal of ones, the entries' Frobenius norm is below 1, less the
 * largest entry between a mode's displacement and its own velocity, which is left out of the norm. b takes out of Q12
 * what N couples at frequencies apart, b < 0.02; elsewhere it is 0 and -N stays.
 * Where there is no such energy, the roots themselves are computed, in n^3 operations.
 * Where the third fails, F is only what must be stable in all states: with z the shape of a motion in F, m = z* z,
 * c = z* C z, k = z* K z and i nu = z* N z of the skew part N of K_j, m s^2 + c s + k + i nu has its roots on the left
 * if and only if m nu^2 < c^2 k (Metelitsyn 1952, Dokl. Akad. Nauk SSSR 86, 31-34). With c_k >= 2 zeta omega_k,
 *     |Omega^-1/2 N Omega^-1/2| < 2 zeta omega_F,      omega_F the lowest frequency in F,
 * is enough, since z* Omega z <= sqrt(m z* Omega^2 z). Half of the right side is demanded, and |N| is bounded by the
 * norms of all tangents and all normals together. All other modes are then followed in steps of at most 3 rad, which
 * take 1e-4 of an oscillation. Not proved: that a mode of F moves apart from the slow ones, which shake it far below
 * its frequency. */
#pragma once

#include <complex.h>

#include "hbm/contact/transitions.h"
#include "hbm/planar/planar_flow.h"
#include "model/model.h"

typedef struct modal_flow modal_flow;

/* HC_BAD_INPUT where K is not symmetric or modes do not diagonalise C; HC_SINGULAR, HC_NOT_CONVERGED of the modes,
 * HC_NO_MEMORY: *out is NULL. m is copied. */
hc_status modal_flow_new(const model *m, modal_flow **out);
void modal_flow_free(modal_flow *f); /* NULL is allowed */

/* The model in its modes: x are modal coordinates. */
const model *modal_flow_model(const modal_flow *f);

/* Step widths for an orbit at omega on which contacts change `changes` times a period. */
void modal_flow_begin(modal_flow *f, double omega, int changes);

/* The same in the state the contacts are in at th, arguments as below: narrower if modes that are left to decay would
 * not. HC_NO_MEMORY. */
hc_status modal_flow_check(modal_flow *f, const contact_interval *const *interval, int n_slipping,
                           const planar_slipping *slipping, double th);

/* root[2 n] of perturbations, exp(s t), where all contacts stay in one state, none slipping with two tangents; what
 * that takes, and steps of modal_flow_begin's width for a period, in operations. HC_NO_MEMORY, HC_NOT_CONVERGED. */
hc_status modal_flow_roots(const modal_flow *f, const contact_interval *const *interval, double complex *root);
double modal_flow_operations_of_roots(const modal_flow *f);
double modal_flow_operations(const modal_flow *f);

/* As planar_flow_advance, in modal coordinates. */
hc_status modal_flow_advance(modal_flow *f, const contact_interval *const *interval, int n_slipping,
                             const planar_slipping *slipping, double from, double to, double omega, int columns,
                             double *phi);
