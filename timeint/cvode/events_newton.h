/* events_newton.h - the linear equations of an implicit step of a structure with the exact law, between two changes of
 * contact state. y = (x, p, z), z being the own states of contacts (law_kind.h), the angles of slips that turn:
 *
 *     (I - gamma J) (x, p, z) = (a, b, d):   step_equations.h with
 *     f_j = t_u u_j + t_v v_j of contact_track_forces;   where it turns also f_k += s_v v + s_z z, with
 *     z = d + gamma (r_v v + r_z z + sum_k r_k t_k . p),   gamma t_k . p = u_k - t_k . a;   of smooth laws also
 *     t_du t . p, and n_v of theirs
 *
 * Nothing is allocated after events_newton_make. */
#pragma once

#include "timeint/cvode/step_equations.h"
#include "timeint/law/contact_track.h"

typedef struct events_newton {
  step_equations step;
  const contact_track *track;       /* [n_contacts] not owned, as are the next two */
  const contact_forces_linear *law; /* [n_contacts] */
  const int *own_of;                /* [n_contacts] index of the contact's entry of z; -1: none */
  law_slopes *slopes;               /* [n_contacts] the law's derivatives, valid where `curved` */
  bool *curved;                     /* [n_contacts] true for contacts whose slip turns and for smooth laws */
} events_newton;

/* Arrays are memory's. HC_NO_MEMORY. */
hc_status events_newton_make(events_newton *s, const modal_base *base, const contact_track *track,
                             const contact_forces_linear *law, const int *own_of, workspace *memory);

/* The law's derivatives at y. */
void events_newton_linearise(events_newton *s, const scaled_model *m, const double *y);

/* Factors the equations for gamma and *m's coefficients; false: singular. */
bool events_newton_factor(events_newton *s, const scaled_model *m, double gamma);

/* r[] := (I - gamma J)^-1 r. */
void events_newton_solve(events_newton *s, double *r);
