/* exact_force.h - contact force harmonics from displacement harmonics without sampling, hence without aliasing. Between
 * transitions the force is linear in the motion. With the transitions located (transitions.h) its Fourier integrals
 * follow from the Fourier coefficients of piecewise constant functions, in closed form. libm only; nothing is allocated
 * after exact_force_new. */
#pragma once

#include "hbm/contact/contact_evaluator.h"

typedef struct exact_force exact_force;

/* For n_dof coordinates (1 or 2) of n_harm harmonics under n_contacts contacts (copied). */
hc_status exact_force_new(int n_harm, int n_dof, int n_contacts, const moving_contact *contacts, exact_force **out);
void exact_force_free(exact_force *e);

/* F[n_dof (2H+1)] [force]: for each coordinate d the harmonics of sum_j cu_jd T_j + cv_jd (N_j - N0_j), at X (same
 * layout) [length]. jac[row + ld col], ld = n_dof (2H+1): dF/dX, unless NULL. report may be NULL. HC_NOT_FINITE,
 * HC_CHATTER (more transitions than a motion of H harmonics should cause), HC_NOT_CLOSED. */
hc_status exact_force_eval(exact_force *e, const double *X, double *F, double *jac, contact_report *report);

/* w[n_contacts] [length]: each contact's slider at th = 0 on the closed orbit of the last evaluation. */
void exact_force_sliders(const exact_force *e, double *w);

/* The intervals of contact j found by the last evaluation. */
const contact_interval *exact_force_intervals(const exact_force *e, int j, int *n);

extern const contact_evaluator exact_force_evaluator; /* of one contact with one tangent */
