/* given_motion.h - contact forces of a motion that is given, not solved for: of one degree of freedom that moves all
 * of its contacts, or of one contact under its own u (u_1, u_2) and v.
 *
 * A contact with two tangents is two halves (model.h), whose normal forces add up. Under the square law each half is a
 * contact with one tangent, moved by its own u and the v of both; where they share a limit, and with friction, the two
 * are evaluated together. */
#pragma once

#include "hbm/hbm_settings.h"
#include "model/moving_contact.h"

enum {
  GIVEN_EXACT = 0,    /* in place of a number of samples */
  GIVEN_MOST_DOF = 3, /* u_1, u_2, v */
  GIVEN_MOST_COEF = 2 * HBM_MAX_HARMONICS + 1
};

typedef struct given_motion {
  bool pair, circle; /* one contact with two tangents; and one limit for both */
  int n_harm, n_dof, n_contacts;
  const moving_contact *contacts; /* [n_contacts] moved by X; of a pair one, either half's law, moved by u and v */
  const double *X;                /* [n_dof][2 n_harm + 1] [length] x; or u and v; or u_1, u_2 and v */
} given_motion;

/* Contact j of the model, CONTACT_ALONE or CONTACT_FIRST, as one that moves by itself, in *place, which must live as
 * long. n_harm and X are left to be set. */
given_motion given_motion_of_contact(const model *of, int j, moving_contact *place);

/* F[n_dof][2 n_harm + 1] [force]: what drives each coordinate, of one contact T (T_1, T_2) and N - N0, by n_time
 * samples a period or GIVEN_EXACT. HC_BAD_INPUT: too few samples; errors of exact_force_eval, planar_force_eval,
 * aft_eval and planar_aft_evaluator. */
hc_status given_motion_force(const given_motion *m, hbm_restart restart, int n_time, double *F);

/* Are its two tangents evaluated together? Without friction they share no limit. */
bool given_motion_is_planar(const given_motion *m);

/* Coordinates of planar_force and planar_aft under that law: without a normal spring N does not vary. */
int given_motion_planar_dof(const contact *law);

/* N0 of one contact [force]: that of its gap and of its load, of both halves. */
double given_motion_preload(const given_motion *m);
