/* exact.h - contact force harmonics from displacement harmonics without sampling: no aliasing. Between transitions
 * the force is linear in the motion, so with the transitions located (transitions.h) its Fourier integrals are
 * elementary: everything comes from the coefficients of piecewise constant functions. libm only; nothing is
 * allocated after exact_new. */
#ifndef HC_EXACT_H
#define HC_EXACT_H

#include "hbm/contact_report.h"
#include "hbm/transitions.h"
#include "model/model.h"

typedef struct exact exact;

/* For n_dof coordinates (1 or 2) of n_harm harmonics under n_contacts contacts (copied). */
hc_status exact_new(int n_harm, int n_dof, int n_contacts, const moving_contact *contacts, exact **out);
void exact_free(exact *e);

/* The same for the contacts of a model (copied), moved by its one coordinate x. */
hc_status exact_new_of_model(int n_harm, const model *m, exact **out);

/* F[n_dof (2H+1)] [force]: for each coordinate d the harmonics of sum_j cu_jd T_j + cv_jd (N_j - N0_j), at X (same
 * layout) [length]. jac[row + ld col], ld = n_dof (2H+1): dF/dX, unless NULL. report may be NULL. HC_NOT_FINITE,
 * HC_CHATTER (more transitions than a motion of H harmonics should cause), HC_NOT_CLOSED. */
hc_status exact_eval(exact *e, const double *X, double *F, double *jac, contact_report *report);

/* w[n_contacts] [length]: each contact's slider at th = 0 on the closed orbit of the last evaluation. */
void exact_sliders(const exact *e, double *w);

/* The pieces of contact j found by the last evaluation. */
const contact_piece *exact_pieces(const exact *e, int j, int *n);

#endif
