/* one_contact.h - one contact of a structure by itself, in a motion x[2H+1][n] of all degrees of freedom: its force as
 * hbm/ locates it, and its law stepped through. A contact with two tangents and one limit, two of the model's
 * (model.h), is taken as one. */
#ifndef HC_STRESS_ONE_CONTACT_H
#define HC_STRESS_ONE_CONTACT_H

#include "stress/solved_structure.h"

enum { ONE_CONTACT_MOST = 3 };

typedef struct one_contact {
  const contact *law; /* of a circle: of either half */
  bool circle;
  int n_dof; /* u, v; of a circle u_1, u_2, and v where N varies; 0: it belongs to the contact before it */
  const double *direction[ONE_CONTACT_MOST]; /* [n] */
  double stiffness[ONE_CONTACT_MOST];        /* [force/length] of the whole contact along each */
  double *motion, *force;                    /* [n_dof][2H+1] coordinates, and T and N - N0 along them */
  contact_report report;
} one_contact;

/* The located force of contact j in the motion x. HC_NO_MEMORY and the errors of exact_force_eval, circle_force_eval;
 * one_contact_clear in any case. */
hc_status one_contact_locate(const solved_structure *s, int j, const double *x, one_contact *c);
void one_contact_clear(one_contact *c);

/* Numbers in motion or force. */
size_t one_contact_length(const solved_structure *s, const one_contact *c);

/* turn[2 N]: cos and sin of all angles of a period of N steps. */
void one_contact_turn(int N, double *turn);

/* The law stepped through N instants a period, from w = 0 until the slider has settled: harmonics force[n_dof][2H+1] of
 * one period more. A circle's slider goes along the line between samples, as in hbm/circle_slider.h. false: after 2^23
 * instants it still has not settled. */
bool one_contact_step(const one_contact *c, int n_harm, int N, const double *turn, double *force);

#endif
