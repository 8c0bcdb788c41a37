/* contact_motion.h - the motion that hbmcheck contact is asked about: x of one degree of freedom, which moves all of
 * its contacts, or u and v of one contact; of a contact with two tangents u_1, u_2 and v. */
#ifndef HC_CONTACT_MOTION_H
#define HC_CONTACT_MOTION_H

#include "command/cli.h"
#include "hbm/given_motion.h"

enum { CONTACT_X, CONTACT_U, CONTACT_U2, CONTACT_V, CONTACT_MOTIONS };
typedef struct contact_options {
  const char *contact;                 /* NULL: not given */
  const char *motion[CONTACT_MOTIONS]; /* the same */
  const char *slider;                  /* the same */
  number_list samples;
  const char *plot; /* NULL: no drawing */
} contact_options;

enum { CONTACT_MOST_COEF = GIVEN_MOST_COEF, CONTACT_MOST_DOF = GIVEN_MOST_DOF };

typedef struct contact_motion {
  int one;          /* which contact of the case, -1: all */
  int in_model;     /* the same of its model */
  bool pair;        /* it has two tangents */
  bool circle;      /* and one limit for both */
  double slider[2]; /* [length] where it starts: taken off u, or u_1 and u_2 */
  int n_harm, n_dof, n_contacts;
  moving_contact *contacts; /* [n_contacts] moved by X; of a pair one, either half's law (model.h) moved by u and v */
  double given[CONTACT_MOTIONS][CONTACT_MOST_COEF]; /* [length] x; or u - slider, of two tangents both, and v */
  double X[CONTACT_MOST_DOF * CONTACT_MOST_COEF];   /* [n_dof][2 n_harm + 1] x; u and v; or u_1, u_2 and v */
} contact_motion;

/* What the options ask for, with as many harmonics as the motion or the case has, at least 1. 0, or the exit code after
 * the message. Free with contact_motion_clear in any case. */
int contact_motion_find(const cli_common *common, const contact_options *own, contact_motion *m);
void contact_motion_clear(contact_motion *m);

#endif
