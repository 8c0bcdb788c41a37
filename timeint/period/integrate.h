/* integrate.h - one period of the forcing at a time, by CVODE or in closed form.
 *
 * A period is the phase theta = 0 .. 2 pi, and CVODE starts afresh in each. This costs a start at order 1, and has two
 * advantages: theta never exceeds 2 pi, so 20 000 periods lose no accuracy; and a period is a function of the state
 * alone, bit for bit, so that successive states converge to its fixed point. With the step history kept, each period
 * would have other steps, and states would converge only to their error. */
#pragma once

#include "numerics/base/status.h"
#include "timeint/law/scaled.h"

typedef struct integrator integrator;

/* [rad] The longest step of a watched period. measure.h integrates a response over each by a quintic through both ends
 * where the integrator has no integrals of its own: 0.2^7/100800 = 1e-10 of the response's sixth derivative. */
#define INTEGRATE_LONGEST_STEP 0.2

/* Callback after each internal step theta0..theta1 of a watched period; a transition of the exact law ends a step. */
typedef hc_status integrate_watch(void *self, const integrator *in, double theta0, double theta1);

/* integrate_regularised.c: the regularised law, the equations of scaled.h by BDF with the analytic Jacobian of
 * structure_newton.h. They are stiff: a slipping slider relaxes at the rate 1/regularisation. tolerance > 0: error of a
 * step, relative to the states' sizes. HC_BAD_INPUT, HC_NO_MEMORY. */
hc_status integrate_new_regularised(const modal_base *base, double tolerance, integrator **out);

/* integrate_events.c: the exact law by CVODE, one smooth right-hand side for each set of contact states, from one
 * change of state (transition) to the next; guards are those of contact_track.h. Adams' method, or BDF where damping
 * makes the structure stiff: where its largest rate is 60 times the lowest natural frequency or more (beam16: 4000
 * steps a period, not 22 000). A contact with two tangents that slips under the law of the circle adds the angle of its
 * traction to the states (law_planar.c). tolerance as before. HC_BAD_INPUT, HC_NO_MEMORY. */
hc_status integrate_new_events(const modal_base *base, double tolerance, integrator **out);

/* integrate_closed_form.c: the exact law without CVODE, transient.method: closed_form. While no contact changes its
 * state the motion is the exponential of a linear equation: a power series, summed to rounding (motion_series.h), or of
 * a stiff structure, whose series would take thousands of steps, its complex modes (motion_modes.h). A change of state
 * is a root of guards that are polynomials or sums of exponentials; none is missed except excursions below rounding.
 * Period map, monodromy matrix, peaks and harmonics have no error but rounding: there is no tolerance. Complex modes
 * are used where the fastest rate is more than `stiff` times omega (INTERVAL_MODES_STIFF of interval_modes.h; 0:
 * wherever they exist; INFINITY: never). HC_NO_MEMORY. */
hc_status integrate_new_closed_form(const modal_base *base, double stiff, integrator **out);

void integrate_free(integrator *in);

/* Sets the monitor that is called between steps of periods, NULL: none; returns the previous one. A period takes up to
 * ten million steps: with friction in a plane and a very small limit a step is the time in which the contact slips by
 * limit/kt. */
const hc_monitor *integrate_hear(integrator *in, const hc_monitor *monitor);

/* Sets the tolerance from the next period on; allocates nothing. */
hc_status integrate_tolerance(integrator *in, double tolerance);

/* Carry y[n_states] through one period of *m. `watch` may be NULL. On failure y is unchanged. HC_INTEGRATOR,
 * HC_UNBOUNDED, HC_NOT_FINITE, HC_NO_MEMORY, HC_INTERRUPTED, a status of `watch`; exact law: HC_CHATTER after too many
 * transitions. */
hc_status integrate_period(integrator *in, const scaled_model *m, double *y, integrate_watch *watch, void *self);

/* As integrate_period, with monodromy[n_states * n_states], by columns: d y[i](2 pi) / d y[j](0) at [i + j n_states];
 * on a periodic orbit it is the monodromy matrix. It comes from the variational equations; with smooth contacts in
 * integrate_events.c from central differences, with an error of about 1e-8. Contact forces are continuous, so the
 * saltation matrix of a transition is the identity. A slider that follows from x at theta = 0 (slipping, separated) has
 * a column of zeros. */
hc_status integrate_monodromy(integrator *in, const scaled_model *m, double *y, double *monodromy);

/* The same with a coarse matrix, for Newton: each step has a truncation error of 1e-6, a period up to 4e-4 as measured.
 * Falls back to the accurate one unless integrate_has_coarse. */
hc_status integrate_coarse_monodromy(integrator *in, const scaled_model *m, double *y, double *monodromy);
bool integrate_has_coarse(const integrator *in);

/* Inside a watch: the state (order 0) or its derivative (order 1) at theta0 <= theta <= theta1, from the step's own
 * polynomial, as accurate as the step. y[n_states]. */
hc_status integrate_dense(const integrator *in, double theta, int order, double *y);

/* Inside a watch: response r at the angles theta + i step, i = 0..count-1, all in the step. */
hc_status integrate_samples(const integrator *in, int r, double theta, double step, int count, double *x);

/* Inside a watch: the integrals of response r, times 1, cos(theta), sin(theta), over the step, to rounding; false if
 * not available. */
bool integrate_fourier(const integrator *in, int r, double out[3]);

/* Inside a watch: the largest and the least value of response r in the step, to rounding; false if not available: then
 * steps are so short that the response turns at most twice in one. */
bool integrate_extremes(const integrator *in, int r, double *max, double *min);

/* Inside a watch: the state of contact j in the step, at whose end the state is y. */
contact_state integrate_contact(const integrator *in, int j, const double *y);

/* Inside a watch: the derivative of the state, and the states of all contacts, at the end of the step, where the state
 * is y. */
void integrate_at_end(const integrator *in, const scaled_model *m, double theta, const double *y, double *rate,
                      contact_state *states);

/* Largest |W - W(0)| of slider j in the last period, at changes of state; INFINITY if contact j separated, or if not
 * available. */
double integrate_travel(const integrator *in, int j);

/* [tolerance] Possible change of a period's result by another choice of steps; 0 in closed form. */
double integrate_scatter(const integrator *in);

/* Periods begun since the integrator was made. */
long integrate_periods(const integrator *in);

/* Steps, right-hand sides and transitions since the integrator was made; CVODE's last flag other than success. */
long integrate_steps(const integrator *in);
long integrate_rhs(const integrator *in);
long integrate_transitions(const integrator *in);
int integrate_flag(const integrator *in);
