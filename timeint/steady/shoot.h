/* shoot.h - a periodic orbit as a fixed point of the period map: z = F^k(z), F one period of the forcing.
 *
 * Newton (KINSOL): z - F^k(z) = 0 with the Jacobian I - Phi, Phi the monodromy matrix from the variational equations.
 * Quadratic where F is smooth, which it is unless the orbit grazes a transition; the number of periods it takes does
 * not depend on the damping. The slider of a contact that sticks all the time is at a fixed point of F wherever it is:
 * its row of Phi is that of the identity. It stays where the start put it and is counted as free; the rest of the
 * orbit is unique given that. So does one that travels less than MEASURE_RESTS in a period: a contact that shakes down
 * comes to rest on the edge of slip, where F has one derivative on either side, and the rounding of an orbit already
 * found would choose between them; that of slip nearly has a multiplier 1, and its Newton step leads away. Anderson
 * (KINSOL's fixed point) needs no Phi: used where Newton fails. Of a large structure in closed form Phi is that of
 * ti->slowed, nearly its own at a tenth of the cost, and kept as long as steps contract (chord steps). Works on ti->y
 * in the unit of length ti->length, at CVODE's present tolerance. */
#pragma once

#include <complex.h>

#include "timeint/steady/steady.h"

typedef struct shoot shoot;

typedef struct shoot_report {
  double distance;   /* [L] |(I - Phi)^-1 (F^k(z) - z)|: how far the orbit still is, to first order */
  double attainable; /* [L] no orbit can be found to better than this: the scatter of periods times |(I - Phi)^-1| */
  double moved;      /* [L] from the start to the orbit */
  double nonlinear;  /* [1] |F^k(z0) - z* - Phi (z0 - z*)| / |z0 - z*|, z0 the start: 0 where F^k is linear between
                       z0 and z* */
  double complex multiplier; /* the largest, free sliders left out; on the edge of slip of the side that sticks */
  int free_sliders;
} shoot_report;

hc_status shoot_new(timeint *ti, shoot **out);
void shoot_free(shoot *s);

/* From ti->y to the orbit of k periods, Newton steps no longer than `reach` [L]; ti->y becomes a point on it. On
 * failure ti->y is unchanged. goal [L]: the distance from the orbit at which to stop; where the scatter of
 * integrated periods, times |(I - Phi)^-1|, is larger, that distance; report->distance says how far it came.
 * HC_SINGULAR, HC_STALLED, HC_NOT_CONVERGED; HC_NOT_SETTLED after max_periods; what integrate_monodromy answers;
 * HC_INTERRUPTED. */
hc_status shoot_newton(shoot *s, int k, double reach, double goal, const hc_monitor *monitor, shoot_report *report);
hc_status shoot_anderson(shoot *s, int k, double goal, const hc_monitor *monitor, shoot_report *report);

/* ti->slowed, which is at the orbit of k periods of ti itself, onto its own next to it: by that orbit's matrix. Errors
 * of shoot_newton. */
hc_status shoot_slowed(shoot *s, int k, const hc_monitor *monitor);

/* Answers that mean there is no orbit next to the start that Newton or Anderson could find, and nothing worse. */
bool shoot_found_no_orbit(hc_status st);

/* z[n]: the direction, of length 1, in which neighbours of the last orbit leave it fastest (or approach it slowest):
 * the power iteration on Phi. */
void shoot_direction(shoot *s, double *z);

/* ---- an orbit found, measured, confirmed ---- */

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

/* Measured, and with what is known of its finding, for the orbit through ti->y. */
hc_status orbit_report(timeint *ti, int k, timeint_method method, const shoot_report *found, timeint_result *r);

/* The next period, where the motion repeats itself after none: measured into *r, period_multiple 0. `why`, or what
 * integration answers. */
hc_status orbit_report_none(timeint *ti, hc_status why, timeint_result *r);

/* From ti->y to within goal [L] of the orbit of k periods next to it, which is known in closed form (ti->closed_form):
 * Newton with F^k CVODE's own periods and, as its matrix, that of the exact law in closed form. With the exact law the
 * two differ by integration errors: one period shows that the orbit closes. The regularised law's map and matrix differ
 * by the order of the regularisation: each step contracts by that factor, and costs a plain period instead of one with
 * variational equations. off [L]: about how far the orbit is, 0 where not known; of a large structure the first steps
 * are by coarser periods then. *r: its measures; found->distance from it, found->attainable; found's multiplier and
 * free sliders are the caller's. HC_NOT_CONVERGED if the steps do not contract, HC_SINGULAR; HC_NOT_SETTLED after
 * max_periods; what integration answers; HC_INTERRUPTED. ti->y is then where it was. */
hc_status shoot_confirm(shoot *s, int k, double goal, double off, const hc_monitor *monitor, shoot_report *found,
                        timeint_result *r);
