/* orbit.h - an orbit found, measured and reported. */
#pragma once

#include "timeint/steady/shoot.h"
#include "timeint/steady/steady.h"

/* [L] The distance within which an orbit counts as found: transient.tolerance times the motion's size, or what the
 * integration's own errors allow. */
double orbit_goal(const timeint *ti);

/* [size] The largest regularisation, 0.1, moves an orbit by some percent: one farther away is another, of which the
 * multiplier known says nothing. */
#define ORBIT_REGULARISED_WITHIN 0.2

/* [size] An orbit no farther from a state is next to it. */
#define ORBIT_NEXT_TO 0.02

/* ti->y onto the orbit of k periods next to it, no farther away than `reach` [L] a Newton step: by Newton, else by
 * Anderson. Errors of Newton; ti->y is then unchanged. */
hc_status orbit_find(timeint *ti, int k, double reach, const hc_monitor *monitor, timeint_method *method,
                     shoot_report *found);

/* The k periods from ti->y on, measured into *r; period_multiple: after how many of them the state has returned. What
 * integration answers. */
hc_status orbit_measure(timeint *ti, int k, timeint_result *r);

/* Into *r, measured before: what is known of the orbit found by `method`. */
void orbit_fill(const timeint *ti, int k, timeint_method method, const shoot_report *found, timeint_result *r);

/* Both, for the orbit through ti->y. */
hc_status orbit_report(timeint *ti, int k, timeint_method method, const shoot_report *found, timeint_result *r);

/* The next period, where the motion repeats itself after none: measured into *r, period_multiple 0. `why`, or what
 * integration answers. */
hc_status orbit_report_none(timeint *ti, hc_status why, timeint_result *r);

/* Keeps each response's least and largest amplitude of one period among the next ones, for results of a motion that
 * does not repeat; the motion stays where it is. */
hc_status orbit_watch(timeint *ti);
