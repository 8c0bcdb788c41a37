/* truth.h - what a point should be: the solutions of harmonic balance with exact forces and many harmonics; private
 * to compare/verify/. */
#ifndef HC_VERIFY_TRUTH_H
#define HC_VERIFY_TRUTH_H

#include "compare/verify/truth/report.h"

/* The case's sweep, widened to the points, but not to more than `far` times beyond either end. */
void verify_window(const compare_setup *setup, const verify_data *data, double *from, double *to);

/* out->rows, count, harmonics, checked, ...: the truth at each point, of as many harmonics as the referee asks for. */
hc_status verify_truth(const compare_setup *setup, const verify_data *data, const hc_monitor *monitor,
                       verify_report *out);

#endif
