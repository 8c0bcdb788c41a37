/* contact_force.h - the contact forces of the motion that hbmcheck contact is asked about, and in words what the
 * exact law does along it. */
#ifndef HC_CONTACT_FORCE_H
#define HC_CONTACT_FORCE_H

#include "command/contact_motion.h"
#include "hbm/given_motion.h"
#include "output/table.h"

enum { CONTACT_EXACT = GIVEN_EXACT }; /* in place of a number of samples */

/* F[n_dof (2H+1)] [force]: what drives each coordinate of m->X, of one contact T (T_1, T_2) and N, by n_time
 * samples a period or CONTACT_EXACT. HC_BAD_INPUT: too few samples; errors of given_motion_force. */
hc_status contact_force_of(const contact_motion *m, hbm_restart restart, int n_time, double *F);

/* Remarks under the table: when each contact sticks and slips; of one contact extrema, slip path and work, too. Errors
 * as above. */
hc_status contact_force_note(table *t, const cli_common *common, const contact_motion *m);

#endif
