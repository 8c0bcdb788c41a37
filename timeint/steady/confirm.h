/* confirm.h - an orbit that is known in closed form (scout.h), confirmed by CVODE: Newton on z = F^k(z) with F^k
 * CVODE's own periods and, as its matrix, that of the exact law in closed form. With the exact law the two differ by
 * integration errors: one period shows that the orbit closes. The regularised law's map and matrix differ by the order
 * of the regularisation: each step contracts by that factor, and costs a plain period instead of one with variational
 * equations. */
#ifndef HC_TIMEINT_CONFIRM_H
#define HC_TIMEINT_CONFIRM_H

#include "timeint/steady/shoot.h"
#include "timeint/steady/steady.h"

typedef struct confirm confirm;

/* For the states of ti, whose scout is there. HC_NO_MEMORY. */
hc_status confirm_new(timeint *ti, confirm **out);
void confirm_free(confirm *c);

/* From ti->y to within goal [L] of the orbit of k periods next to it; its measures into *r, found->distance from it,
 * found->attainable; found's multiplier and free sliders are the caller's. HC_NOT_CONVERGED if the steps do not
 * contract, HC_SINGULAR; HC_NOT_SETTLED after max_periods; what integration answers; HC_INTERRUPTED. ti->y is then
 * where it was. */
hc_status confirm_orbit(confirm *c, int k, double goal, const hc_monitor *monitor, shoot_report *found,
                        timeint_result *r);

#endif
