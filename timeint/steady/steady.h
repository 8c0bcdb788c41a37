/* steady.h - the steady state of a model at one frequency, and the periodic orbit next to a state. */
#pragma once

#include "timeint/timeint.h"
#include "timeint/timeint_result.h"

const char *timeint_method_name(timeint_method method); /* "closed_form", "shooting", "anderson", "march" */

/* From `state` at omega to the steady state as the settings say; `state` becomes a point on the orbit, *result its
 * measures.
 *     auto      where the motion goes. With start: hbm the state is taken for a point next to an orbit: that orbit is
 *               the answer if it is stable; if not, the motion leaves it (left_orbit).
 *     shooting  the period-1 orbit next to the state, stable or not.
 *     march     period after period.
 * HC_OK: settled. HC_NOT_SETTLED after max_periods, HC_APERIODIC when nothing repeats within 16 periods and neighbours
 * drift apart, or the motion runs on a torus, HC_CREEPS where the structure slides on (escape.h): in all *result is the
 * last period. HC_UNBOUNDED, without one but where it grows by as much each period. HC_INTEGRATOR, HC_NOT_FINITE,
 * HC_CHATTER; HC_NOT_CONVERGED, HC_SINGULAR, HC_STALLED from shooting alone; HC_BAD_INPUT, HC_NO_MEMORY,
 * HC_INTERRUPTED. */
hc_status timeint_steady(timeint *ti, double omega, double *state, const hc_monitor *monitor, timeint_result *result);

/* The orbit of k forcing periods next to `state` by Newton on the period map, stable or not, whatever
 * transient.steady_state says; the multiplier tells which. Errors as timeint_steady with shooting. 1 <= k <= 16; the
 * orbit may be a shorter one run through several times. */
hc_status timeint_orbit(timeint *ti, double omega, int k, double *state, const hc_monitor *monitor,
                        timeint_result *result);

/* The orbit of k periods through a state that lies next to it already, as that of the same equations integrated with
 * another tolerance does: not looked for. Errors as
 * timeint_orbit. */
hc_status timeint_again(timeint *ti, double omega, int k, double *state, const hc_monitor *monitor,
                        timeint_result *result);

/* r[0..n-1]->predicted: the error that the time integration itself expects in the measures of the first n responses:
 * r[0] is the last result of this handle, to which `state` belongs, r[i] what timeint_response made of it. From its own
 * equations only:
 *     integration     distance from the orbit, and the scatter of periods times |(I - Phi)^-1|
 *     regularisation  twice the change by half of it: it is of first order, or better
 *     slowed modes    the change of the exact law's orbit by them (mass_scaling.h), and the distance from that one's
 * With transient.scout that is one plain period of the regularised law, none of the exact. HC_OK, also where nothing
 * can be said (NaN); HC_NO_MEMORY, HC_INTERRUPTED. */
hc_status timeint_predict(timeint *ti, const double *state, const hc_monitor *monitor, int n, timeint_result *r);

/* *r, the last result of this handle, becomes that of response i (counted from 0) of the same periods: its measures.
 * Where the handle has only remembered the orbit its periods are integrated once more. Errors of integration;
 * HC_BAD_INPUT: there is no such response. */
hc_status timeint_response(timeint *ti, int i, timeint_result *r);

/* With transient.scout a handle remembers the orbits it found last, and gives them again to a start that leads to one
 * of them. Forget them: the next is integrated whatever it is. */
void timeint_forget(timeint *ti);

/* Stable by its multiplier: +1; -1 not; 0 unknown, or within 1e-9 of the border. */
int timeint_stability(const timeint_result *result);
