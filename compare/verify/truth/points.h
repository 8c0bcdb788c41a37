/* points.h - what the judged points tell without any other equations: which branch they run along, noise and
 * outliers; private to compare/verify/. */
#ifndef HC_VERIFY_POINTS_H
#define HC_VERIFY_POINTS_H

#include "base/message.h"
#include "compare/verify/truth/report.h"

/* How often omega turns back along the file, as along a curve with folds. */
int points_reversals(const verify_data *d);

/* CAUSE_OTHER_BRANCH (the rows that hopped get that verdict) or CAUSE_UNSTABLE, if every judged point lies on a
 * solution and they run along the wrong one; else 0. */
verify_causes points_branches(verify_report *r);

/* r->noise: the standard deviation of (value - nearest)/scale from point to point, whatever is the same for neighbours
 * taken out: 1.4826 median |d|/sqrt(6) of second differences d along each branch. NaN for fewer than ten points.
 * HC_NO_MEMORY. */
hc_status points_estimate_noise(verify_report *r);

/* Rows that differ by no more than the gate and four standard deviations `said`, and no more than noise may on the
 * average of up to 25 neighbours, match. HC_NO_MEMORY. */
hc_status points_allow_noise(verify_report *r, double said);

/* CAUSE_OUTLIER: few points, none beside another, are far off, and all others lie on the truth; else 0. */
verify_causes points_outliers(const verify_report *r);

/* CAUSE_NOISE: r->noise is all that is wrong, everywhere alike; else 0. HC_NO_MEMORY. */
hc_status points_scatter(const verify_report *r, verify_causes *out);

/* " (line 7: 35 % off)" of outliers, " (by 1 % from one to the next)" of noise, or nothing. */
void points_say(message *m, const verify_report *r);

#endif
