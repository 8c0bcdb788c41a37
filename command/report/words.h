/* words.h - the verdict and its reasons in words a person can act on, as HTML. */
#ifndef HC_REPORT_WORDS_H
#define HC_REPORT_WORDS_H

#include "command/report/report.h"

void words_verdict(const report_data *d, FILE *to);    /* does it agree, in a sentence; how many of each verdict */
void words_what_to_do(const report_data *d, FILE *to); /* worst point; harmonics and samples that suffice */
void words_gate(const report_data *d, FILE *to);       /* table: allowed, worst found, where */

/* Where the amplitudes of one motion differ most [rad/time]; NaN: nothing was compared. */
double words_worst_omega(const report_data *d);

#endif
