/* integrate.h - one period of the forcing at a time, by CVODE or in closed form.
 *
 * A period is the phase theta = 0 .. 2 pi, and CVODE starts afresh in each. The cost is a start at order 1. The gain:
 * theta never exceeds 2 pi, so 20 000 periods lose no accuracy; and one period is a function of the state alone, the
 * same bits in giving the same bits out, so that successive states converge to a fixed point of it. With the step
 * history kept, each period would be cut into other steps, and the drift would level off at their error.
 *
 * One interface, three ways. integrate_regularised.h: the equations of scaled.h as they stand, by CVODE.
 * integrate_events.h: the exact law by CVODE, event-driven: one smooth right-hand side for each set of contact states,
 * from one change of state (transition) to the next.
 * integrate_closed_form.h: the same law without CVODE, to rounding. */
#pragma once

#include "numerics/base/status.h"
#include "timeint/law/scaled.h"

typedef struct integrator integrator;

/* [rad] The longest step of a watched period. measure.h integrates a response over each by a quintic through both ends
 * where the integrator has no integrals of its own: 0.2^7/100800 = 1e-10 of the response's sixth derivative. */
#define INTEGRATE_LONGEST_STEP 0.2

/* Called after each internal step of a watched period, which led from theta0 to theta1; a transition of the exact
 * law ends a step. */
typedef hc_status integrate_watch(void *self, const integrator *in, double theta0, double theta1);

void integrate_free(integrator *in);

/* What periods hear between their steps, until something else is given; returned is what it was before. A period takes
 * up to ten million steps: friction in a plane whose limit is next to nothing follows its direction in steps of the
 * time in which the contact slips by the limit over kt. NULL: nothing. */
const hc_monitor *integrate_hear(integrator *in, const hc_monitor *monitor);

/* Another tolerance from the next period on; allocates nothing. */
hc_status integrate_tolerance(integrator *in, double tolerance);

/* Carry y[n_states] through one period of *m. `watch` may be NULL. On failure y is unchanged. HC_INTEGRATOR,
 * HC_NOT_FINITE, HC_NO_MEMORY, HC_INTERRUPTED, what `watch` answers; exact law: HC_CHATTER after too many
 * transitions. */
hc_status integrate_period(integrator *in, const scaled_model *m, double *y, integrate_watch *watch, void *self);

/* As integrate_period, with monodromy[n_states * n_states], by columns: d y[i](2 pi) / d y[j](0) at [i + j n_states];
 * on a periodic orbit it is the monodromy matrix. It comes from the variational equations; with smooth contacts in
 * integrate_events.h from central differences, off by some 1e-8. Contact forces are continuous, so the saltation matrix
 * of a transition is the identity. A slider that the law ties to x at theta = 0 (slipping, separated) has a column of
 * zeros. */
hc_status integrate_monodromy(integrator *in, const scaled_model *m, double *y, double *monodromy);

/* The same with a matrix of which each step leaves out 1e-6, up to 4e-4 in a period as was seen: for Newton, where it
 * takes less (integrate_has_coarse). */
hc_status integrate_coarse_monodromy(integrator *in, const scaled_model *m, double *y, double *monodromy);
bool integrate_has_coarse(const integrator *in);

/* Inside a watch: the state (order 0) or its derivative (order 1) at theta0 <= theta <= theta1, from the step's own
 * polynomial, as good as the step itself. y[n_states]. */
hc_status integrate_dense(const integrator *in, double theta, int order, double *y);

/* Inside a watch: response r at the angles theta + i step, i = 0..count-1, all in the step. */
hc_status integrate_samples(const integrator *in, int r, double theta, double step, int count, double *x);

/* Inside a watch: the integrals of response r, times 1, cos(theta), sin(theta), over the step, to rounding; false if
 * this integrator cannot tell. */
bool integrate_fourier(const integrator *in, int r, double out[3]);

/* Inside a watch: the largest and the least value of response r in the step, to rounding; false if this integrator
 * cannot tell: then its steps are so short that the response turns at most twice in one. */
bool integrate_extremes(const integrator *in, int r, double *max, double *min);

/* Inside a watch: the state of contact j in the step, at whose end the state is y. */
contact_state integrate_contact(const integrator *in, int j, const double *y);

/* Inside a watch: the derivative of the state, and the states of all contacts, at the end of the step, where the state
 * is y. */
void integrate_at_end(const integrator *in, const scaled_model *m, double theta, const double *y, double *rate,
                      contact_state *states);

/* How far the slider of contact j was, in the last period, from where that began: the largest |W - W(0)| at its changes
 * of state; INFINITY where it separated, or this integrator cannot tell. */
double integrate_travel(const integrator *in, int j);

/* [tolerance] By how much a period may change when it is cut into other steps; 0 in closed form. */
double integrate_scatter(const integrator *in);

/* Periods begun since the integrator was made. */
long integrate_periods(const integrator *in);

/* Steps, right-hand sides and transitions since the integrator was made, and the last flag CVODE gave other than
 * success. */
long integrate_steps(const integrator *in);
long integrate_rhs(const integrator *in);
long integrate_transitions(const integrator *in);
int integrate_flag(const integrator *in);
