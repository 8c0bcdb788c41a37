/* scout.h - where a motion goes, found in closed form at microseconds a period, then confirmed by CVODE
 * (transient.scout). The scout is a handle of its own: the same model and settings, the exact law in closed form. What
 * is reported are CVODE's periods; the scout decides which orbit, of how many periods, or that there is none. */
#ifndef HC_TIMEINT_SCOUT_H
#define HC_TIMEINT_SCOUT_H

#include "timeint/steady/steady.h"

/* ti->scout for ti, if its settings ask for one, and what else is needed with it. HC_NO_MEMORY; scout_free in any
 * case. */
hc_status scout_new(timeint *ti);
void scout_free(timeint *ti);

/* From state[n] to the steady state (orbit_of 0) or to the orbit of orbit_of periods next to it, as timeint_steady and
 * timeint_orbit do without a scout, from a timeint_begin on. !*done: the scout found nothing that CVODE's periods
 * confirm; *r is then as it was, and the motion at `state` again. */
hc_status scout_steady(timeint *ti, int orbit_of, const double *state, const hc_monitor *monitor, timeint_result *r,
                       bool *done);

/* The orbit of k periods next to ti->y, without looking for it. !*done: CVODE's periods do not confirm that there is
 * one; the motion is where it was. */
hc_status scout_confirm(timeint *ti, int k, const hc_monitor *monitor, timeint_result *r, bool *done);

/* [responses] The predictions of the remembered orbit through `state`, to be read or filled, NaN so far; NULL: it is
 * not remembered. */
motion_error *scout_predictions(timeint *ti, const double *state);

#endif
