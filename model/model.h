/* model.h - what is simulated: one mass on a spring and a damper, and any number of contacts in parallel on it.
 *
 *     M x'' + C x' + K x + sum_j [ t_j T_j + n_j (N_j - N0_j) ] = F0 cos(omega t)
 *     u_j = t_j x   tangential motion        v_j = n_j x   normal motion        (t_j, n_j: directions)
 *
 * x [length] is measured from the static equilibrium; the contact law (T, N) is contact_law.h's. Any consistent set of
 * units. A model owns its memory. Solvers read it and never change it. How it is solved stands in hbm/hbm_settings.h
 * and timeint/transient_settings.h. Source: Colonna et al. 2025, eq. 1-12 ([1] in README.md). */
#ifndef HC_MODEL_H
#define HC_MODEL_H

#include "base/status.h"
#include "model/contact_law.h"

typedef struct model_contact {
  contact law;
  double tangent, normal; /* [1] direction: u = tangent x, v = normal x */
} model_contact;

typedef struct model {
  double mass;      /* M [force time^2/length] > 0 */
  double damping;   /* C [force time/length] */
  double stiffness; /* K [force/length] */
  double force;     /* F0 [force] */
  int n_contacts;
  model_contact *contacts; /* [n_contacts], the model's own; NULL if there are none */
} model;

/* A model with room for n_contacts >= 0 contacts, everything 0, to fill in and to free with model_free.
 * HC_BAD_INPUT for a negative number, HC_NO_MEMORY: *out is NULL. */
hc_status model_new(int n_contacts, model **out);

/* A copy in memory of its own. HC_NO_MEMORY: *out is NULL. */
hc_status model_copy(const model *m, model **out);

void model_free(model *m); /* NULL is allowed */

/* (tangent, normal) = (cos, sin) of the angle [deg] between x and the contact's tangent, exact at 0 and 90 degrees. */
void model_direction(double angle_deg, double *tangent, double *normal);

/* Stiffness [force/length] that x sees of a contact while it sticks: kt t^2 + kn n^2. */
double model_stuck_stiffness(const model_contact *c);

/* Largest stiffness [force/length] that x can see: K and every contact stuck. */
double model_max_stiffness(const model *m);

#endif
