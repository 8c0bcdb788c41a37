/* verdict.h - the verdicts of `compare`, of oscillators and structures alike. */
#ifndef HC_STRESS_VERDICT_H
#define HC_STRESS_VERDICT_H

#include "base/status.h"
#include "stress/outcomes.h"

/* The worst of all rows of one comparison, by verdict.c's table; *predicted: the worst of what the rows' errors are of
 * what both sides said beforehand. HC_NO_MEMORY goes to *fatal. */
stress_check stress_hold_verdicts(const scene *sc, const hc_monitor *monitor, hc_status *fatal,
                                  stress_check *predicted);

#endif
