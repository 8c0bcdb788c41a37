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
 * Steps resolve every mode that keeps half of itself over a period, to 1e-8, and every mode that contacts could make
 * unstable. Those above, F, are left to decay because they would, in each state of the contacts. With z the shape of a
 * motion in F, m = z* z, c = z* C z, k = z* K z, and i nu = z* N z of the skew part N of the slipping contacts'
 * stiffness (mu kn times half of t n^T - n t^T), m s^2 + c s + k + i nu = 0 has its roots on the left if and only if
 * m nu^2 < c^2 k (Metelitsyn 1952, Dokl. Akad. Nauk 86, 31-34). With c_k >= 2 zeta omega_k that holds if
 *     |Omega^-1/2 N Omega^-1/2| < 2 zeta omega_F,      omega_F the lowest frequency in F,
 * since z* Omega z <= sqrt(m z* Omega^2 z). Half of the right side is demanded here, and |N| is bounded by the norms of
 * all tangents and all normals. A change of state j moves the energy of F by the part k_j b_j^T Omega^-2 b_j at most;
 * all changes of a period together must be less than what damping takes. Not proved: a mode of F is taken to move
 * apart from those that are resolved, which shake it far below its frequency. */
#ifndef HC_HBM_MODAL_FLOW_H
#define HC_HBM_MODAL_FLOW_H

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

/* What steps of that width take for a period, in operations. */
double modal_flow_operations(const modal_flow *f);

/* As planar_flow_advance, in modal coordinates. */
hc_status modal_flow_advance(modal_flow *f, const contact_interval *const *interval, int n_slipping,
                             const planar_slipping *slipping, double from, double to, double omega, int columns,
                             double *phi);

#endif
