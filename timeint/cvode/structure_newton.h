/* structure_newton.h - the linear equations of an implicit step of a structure with the regularised law,
 *
 *     (I - gamma J) (x, p, w) = (a, b, d),   J that of scaled.h: step_equations.h with
 *     w_j = d_j + gamma (r_u (u_j - w_j) + r_v v_j),   f_j = t_u (u_j - w_j) + t_v v_j
 *
 * where two directions share the law of a circle r_u, t_u are matrices of two rows. Nothing is allocated after
 * structure_newton_make. */
#pragma once

#include "timeint/cvode/step_equations.h"

typedef struct structure_newton {
  step_equations step;
  planar_derivatives *law; /* [n_contacts] the law's derivatives at the last structure_newton_linearise */
  double (*share)[2][2];   /* [n_contacts] (1 + gamma r_u)^-1 */
  double *dq;              /* [n_rows] rates of the rows' motion, if a law depends on them */
} structure_newton;

/* Arrays are memory's. HC_NO_MEMORY. */
hc_status structure_newton_make(structure_newton *s, const modal_base *base, workspace *memory);

/* dy[n_states] at theta and y[n_states], the same as scaled_rhs, and, unless that is NULL, state[n_contacts], as
 * scaled_contact_state. True if all of dy is finite. */
bool structure_newton_rate(const structure_newton *s, const scaled_model *m, double theta, const double *y, double *dy,
                           contact_state *state);

/* The law's derivatives at y. */
void structure_newton_linearise(structure_newton *s, const scaled_model *m, const double *y);

/* Factors the equations for gamma and *m's coefficients; false: singular. */
bool structure_newton_factor(structure_newton *s, const scaled_model *m, double gamma);

/* r[n_states] := (I - gamma J)^-1 r. */
void structure_newton_solve(structure_newton *s, double *r);

/* out[n_states] := J z. */
void structure_newton_multiply(structure_newton *s, const scaled_model *m, const double *z, double *out);
