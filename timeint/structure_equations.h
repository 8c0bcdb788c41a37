/* structure_equations.h - the equations of scaled.h of a structure, for solvers that take a right-hand side; scaled_rhs
 * and scaled_jacobian call these. */
#ifndef HC_STRUCTURE_EQUATIONS_H
#define HC_STRUCTURE_EQUATIONS_H

#include "timeint/law_circle.h"
#include "timeint/scaled.h"

/* dy[n_states] at theta and y. Answers whether all of it is finite. */
bool structure_rhs(const scaled_model *m, double theta, const double *y, double *dy);

/* jac[n_states * n_states] by columns. */
void structure_jacobian(const scaled_model *m, const double *y, double *jac);

/* Derivatives of the regularised law of that contact at u, v and w; of one direction alone in [0]. */
circle_derivatives structure_law(const scaled_contact *c, const double *u, double v, const double *w);

/* out[n] := p(theta) - by_C C P - by_K K X: all but the contacts. */
void structure_linear_force(const scaled_model *m, double theta, const double *y, double *out);

#endif
