/* contact_watch.h - what each contact does along the periods that a steady state repeats (model/contact_period.h): the
 * time integration's side of hbm/contact/contact_measures.h, from its own dense output and its own law.
 *
 *     exact law          work = integral of mu N |w'| over slip      regularised     work = closed integral of T u'
 *
 * Both are sums over the integrator's steps, of Gauss's sixteen points on panels no longer than the stiffest linear
 * state's quarter period; four on steps much shorter. A step of the exact law has one contact state, and what is
 * integrated there is smooth: the rule is exact to rounding, the work as good as the motion. The regularised law has
 * corners inside steps; CVODE cuts its steps there until they do not matter. Extrema of N and T are at ends of steps,
 * at points of the rule, or where u' or v' changes sign between these: found as roots, to rounding. */
#pragma once

#include "model/contact_period.h"
#include "timeint/steady/steady.h"

/* out[n_contacts]: along the periods of *r, the last result of this handle, which are integrated once more; where it
 * repeats after k periods the work and the slip path are those of one, on average. Of the two directions of a circle
 * each has half of N; |T|, path and work in the plane are in the first's. HC_NO_MEMORY, errors of integration. */
hc_status timeint_contacts(timeint *ti, const timeint_result *r, contact_period *out);

/* room[n_contacts][2] [force]: of each contact that sticks all along these periods the least of mu N - T and of
 * mu N + T; of a circle's first direction the least of mu N - |T|, twice. Meaningless of others. Errors as of
 * timeint_contacts. */
hc_status timeint_slider_rooms(timeint *ti, const timeint_result *r, double (*room)[2]);
