/* integrate.h - CVODE for one period of the forcing at a time; every flag of CVODE ends here.
 *
 * A period is the phase theta = 0 .. 2 pi, and CVODE starts afresh in each. That costs the start at order 1 (README.md has
 * the figure), and buys two things: theta never grows, so 20 000 periods lose no accuracy; and one period is a function of the
 * state alone, the same bits in giving the same bits out, so that successive states converge to a fixed point of it. Had
 * the step history been kept, each period would be cut into other steps, and the drift would level off at their error. */
#ifndef HC_TIMEINT_INTEGRATE_H
#define HC_TIMEINT_INTEGRATE_H

#include "cases/status.h"
#include "timeint/model.h"

typedef struct integrator integrator;

/* Called after each internal step of a watched period, which led from theta0 to theta1. */
typedef hc_status integrate_watch(void *self, const integrator *in, double theta0, double theta1);

/* An integrator of n_states equations, in steps whose error is `tolerance` of the states (and of 1, for states near 0). */
hc_status integrate_new(int n_states, double tolerance, integrator **out);
void integrate_free(integrator *in);

/* Another tolerance from the next period on; allocates nothing. */
hc_status integrate_tolerance(integrator *in, double tolerance);

/* Carry y[n_states] through one period of *m. `watch` may be NULL. On failure y is left where it was. */
hc_status integrate_period(integrator *in, const model *m, double *y, integrate_watch *watch, void *self);

/* Inside a watch: the state (order 0) or its derivative (order 1) at theta0 <= theta <= theta1, from the step's own polynomial,
 * as good as the step itself. y[n_states]. */
hc_status integrate_dense(const integrator *in, double theta, int order, double *y);

/* Steps and right-hand sides since integrate_new, and the last flag CVODE gave other than success. */
long integrate_steps(const integrator *in);
long integrate_rhs(const integrator *in);
int integrate_flag(const integrator *in);

#endif
