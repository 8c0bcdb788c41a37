/* closed_form_start.h - where a motion goes, found in closed form at microseconds a period, then confirmed by CVODE
 * (transient.scout). ti->closed_form is a handle of its own: the same model and settings, the exact law in closed form.
 * What is reported are CVODE's periods; the closed form decides which orbit, of how many periods, or that there is
 * none. */
#pragma once

#include "timeint/steady/steady.h"

/* ti->closed_form, and what else is needed with it. HC_NO_MEMORY. */
hc_status closed_start_new(timeint *ti);

/* The same with another handle's. */
hc_status closed_start_share(timeint *ti, timeint *closed_form);

/* From state[n] to the steady state (orbit_of 0) or to the orbit of orbit_of periods next to it, as timeint_steady and
 * timeint_orbit do by CVODE alone, from a timeint_begin on. !*done: the closed form found nothing that CVODE's periods
 * confirm; *r is then as it was, and the motion at `state` again. */
hc_status closed_start_steady(timeint *ti, int orbit_of, const double *state, const hc_monitor *monitor,
                              timeint_result *r, bool *done);

/* The orbit *r that was reached from ti->closed_form_state in closed form, and given out as `state`. */
void closed_start_remember(timeint *ti, const double *state, const timeint_result *r);

/* The orbit of k periods next to ti->y, without looking for it. !*done: CVODE's periods do not confirm that there is
 * one; the motion is where it was. */
hc_status closed_start_confirm(timeint *ti, int k, const hc_monitor *monitor, timeint_result *r, bool *done);

/* What is known of the remembered orbit through `state`: where the closed form's was, start[n], and the predictions
 * [responses], to be read or filled, NaN so far; NULL: it is not remembered. */
motion_error *closed_start_predictions(timeint *ti, const double *state, const double **start);
