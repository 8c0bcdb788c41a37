/* truth.h - what the points should be, and what they tell by themselves; private to compare/verify/. */
#pragma once

#include "compare/verify/truth/report.h"
#include "compare/verify/truth/solutions.h"
#include "numerics/base/message.h"

/* ---- truth.c: the solutions of harmonic balance with exact forces and many harmonics ---- */

/* The case's sweep, widened to the points, but not to more than `far` times beyond either end. */
void verify_window(const compare_setup *setup, const verify_data *data, double *from, double *to);

/* out->rows, count, harmonics, checked, ...: the truth at each point, of as many harmonics as the referee asks for, as
 * far as they can be expected to be solved `until` then [s] of the thread's clock; where that is not exact, points
 * that differ are compared with the referee's orbits themselves; what then differs, or could not be judged, with orbits
 * next to the curves of fewer harmonics, and with the motion from rest. Curves come from, or go to, *curves. */
hc_status verify_truth(const compare_setup *setup, const verify_data *data, double until, const hc_monitor *monitor,
                       verify_curves *curves, verify_report *out);

/* The row of a point of which nothing is known. */
verify_row verify_row_unjudged(const verify_point *p);

/* Sliders that acceleration_amplitude works with: doubles, of a model. */
size_t acceleration_room(const model *m);

/* (max x'' - min x'')/2 [length/time^2] of the motion's series X of one mass, with
 *     M x'' = F0 cos(th) - C x' - K x - sum_j [ t_j T_j + n_j (N_j - N0_j) ],      th = omega t
 * on 4096 samples of the third period from the sliders room[n_contacts] at th = 0, and around the largest and the
 * smallest of them to 1e-8 of a sample. A slider restarts at the interpolated instant of touch. room[] is
 * overwritten. */
double acceleration_amplitude(const model *m, const verify_motion *motion, double *room);

/* ---- points.c: what the judged points tell without any other equations: which branch they run along, noise and
 * outliers ---- */

/* How often omega turns back along the file, as along a curve with folds. */
int points_reversals(const verify_data *d);

/* CAUSE_OTHER_BRANCH (the rows that hopped get that verdict) or CAUSE_UNSTABLE, if every judged point lies on a
 * solution and they run along the wrong one; else 0. */
verify_causes points_branches(verify_report *r);

/* r->noise: the standard deviation of (value - nearest)/scale from point to point, whatever is the same for neighbours
 * taken out: 1.4826 median |d|/sqrt(6) of second differences d along each branch. NaN for fewer than ten points.
 * With r->noise_said > 0, rows that differ by no more than the gate and four standard deviations of that, and no more
 * than noise may on the average of up to 25 neighbours, match. HC_NO_MEMORY. */
hc_status points_noise(verify_report *r);

/* CAUSE_OUTLIER: few points, none beside another, are far off, and all others lie on the truth; else 0. */
verify_causes points_outliers(const verify_report *r);

/* CAUSE_NOISE: r->noise is all that is wrong, everywhere alike; else 0. HC_NO_MEMORY. */
hc_status points_scatter(const verify_report *r, verify_causes *out);

/* CAUSE_INTERPOLATED: points that differ lie on the chords of their neighbours in the file, and the truth does not. */
verify_causes points_interpolated(const verify_report *r);

/* CAUSE_NOT_CONVERGED: points far off between right ones; or all over the place. */
verify_causes points_scattered(const verify_report *r);
hc_status points_anywhere(const verify_report *r, verify_causes *out); /* HC_NO_MEMORY */

/* " (line 7: 35 % off)" of outliers, " (by 1 % from one to the next)" of noise, or nothing. */
void points_say(message *m, const verify_report *r);
