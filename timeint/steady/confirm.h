/* confirm.h - an orbit that is known nearly, confirmed by periods of the handle's own with another's matrix. */
#pragma once

#include "timeint/steady/shoot.h"
#include "timeint/timeint_result.h"

/* CVODE's coarsest tolerance on the way to an orbit: periods scatter by up to 250 times that, 2.5e-6. */
#define CONFIRM_COARSEST 1e-8

/* From ti->y to within goal [L] of the orbit of k periods next to it, which is known in closed form (ti->closed_form):
 * Newton with F^k CVODE's own periods and, as its matrix, that of the exact law in closed form. With the exact law the
 * two differ by integration errors: one period shows that the orbit closes. The regularised law's map and matrix differ
 * by the order of the regularisation: each step contracts by that factor, and costs a plain period instead of one with
 * variational equations. off [L]: about how far the orbit is, 0 where not known; of a large structure the first steps
 * are by coarser periods then. *r: its measures; found->distance from it, found->attainable; found's multiplier and
 * free sliders are the caller's. HC_NOT_CONVERGED if the steps do not contract, HC_SINGULAR; HC_NOT_SETTLED after
 * max_periods; what integration answers; HC_INTERRUPTED. ti->y is then where it was. */
hc_status confirm_orbit(timeint *ti, int k, double goal, double off, const hc_monitor *monitor, shoot_report *found,
                        timeint_result *r);

/* ti->slowed, which is at the orbit of k periods of ti itself, onto its own next to it: by that orbit's matrix. Errors
 * as above. */
hc_status confirm_slowed(timeint *ti, int k, const hc_monitor *monitor);
