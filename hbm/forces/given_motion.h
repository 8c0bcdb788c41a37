/* given_motion.h - contact forces under a prescribed motion: of one degree of freedom that moves all of its contacts,
 * or of one contact under its own u (u_1, u_2) and v.
 *
 * A contact with two tangents is two halves (model.h), whose normal forces add up. Without a common limit each half is
 * a contact with one tangent, moved by its own u and the common v; with a common limit (circle) and friction the two
 * are evaluated together. */
#pragma once

#include "hbm/hbm_settings.h"
#include "model/moving_contact.h"

enum {
  GIVEN_EXACT = 0,    /* value of n_time for exact forces */
  GIVEN_MOST_DOF = 3, /* u_1, u_2, v */
  GIVEN_MOST_COEF = 2 * HBM_MAX_HARMONICS + 1
};

typedef struct given_motion {
  bool pair, circle; /* pair: one contact with two tangents; circle: with one limit for both */
  int n_harm, n_dof, n_contacts;
  const moving_contact *contacts; /* [n_contacts] moved by X; a pair has one entry, with the law of either half */
  const double *X;                /* [n_dof][2 n_harm + 1] [length] x; or u and v; or u_1, u_2 and v */
} given_motion;

/* Contact j of the model, CONTACT_ALONE or CONTACT_FIRST, under its own u and v; stored in *place, which must live as
 * long. The caller sets n_harm and X. */
given_motion given_motion_of_contact(const model *of, int j, moving_contact *place);

/* F[n_dof][2 n_harm + 1] [force] on each coordinate, for one contact T (T_1, T_2) and N - N0; by n_time samples a
 * period, or GIVEN_EXACT. HC_BAD_INPUT: too few samples; errors of exact_force_eval, planar_force_eval, aft_evaluator
 * and planar_aft_evaluator. */
hc_status given_motion_force(const given_motion *m, hbm_restart restart, int n_time, double *F);

/* True if its two tangents have a common limit and friction, and are evaluated together. */
bool given_motion_is_planar(const given_motion *m);

/* Number of coordinates of planar_force and planar_aft under that law: 2 without a normal spring, since N is then
 * constant. */
int given_motion_planar_dof(const contact *law);

/* N0 of one contact [force], from its gap and its load, both halves together. */
double given_motion_preload(const given_motion *m);
