/* outcomes.h - the words a check ends with. */
#ifndef HC_STRESS_OUTCOMES_H
#define HC_STRESS_OUTCOMES_H

#include "stress/stress.h"

/* A NaN error agrees with nothing. */
stress_check stress_skip(stress_reason why);
stress_check stress_agree(double error, double bound);
stress_check stress_explain(stress_reason why, double error, double bound);
stress_check stress_find(stress_reason why, double error, double bound);

/* Agreed up to `least`; beyond it, but within what the scene's own sensitivity makes of errors, ill-conditioned. */
stress_check stress_agree_within(double error, double least, double sensitive);

/* The words for a solver's status; a bug is a finding. */
stress_check stress_refusal(hc_status st);

#endif
