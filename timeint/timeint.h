/* timeint.h - time integration of a model with CVODE: the handle and its states. The way into this folder: steady.h has
 * steady states and orbits, sweep.h carries a state to another frequency.
 *
 *     x' = v,   M v' = p(omega t) - C v - K x - sum_j [ t_j T_j + n_j (N_j - N0_j) ]          p: the loads of model.h
 *
 * with the contact law of model/contact_law.h, exact or regularised (law_regularised.h) as transient.law says.
 * A state is an array of timeint_n_states doubles, memory of the caller: x [length], v [length/time], and the slider
 * w_j [length] of contact j. Inside, the motion is about static equilibrium (model/rest.h). Phase: t = 0 is that of the
 * loads in model.h; every state passed in or out is at a whole number of periods 2 pi/omega. Handles are opaque, one a
 * thread. Not here: harmonic balance, verdicts. */
#pragma once

#include "model/model.h"
#include "numerics/base/status.h"
#include "timeint/transient_settings.h"

/* Where in an oscillator's state x and v are, and the slider of contact 0; a structure's has n of x, n of v, then w. */
enum { TIMEINT_X, TIMEINT_V, TIMEINT_W };

typedef struct timeint timeint;

/* A workspace for m and how its steady states are found (both copied). HC_BAD_INPUT, HC_NO_MEMORY; HC_SINGULAR,
 * HC_NOT_CONVERGED of modal_base_new: *out is NULL. */
hc_status timeint_new(const model *m, const transient_settings *how, timeint **out);
void timeint_free(timeint *ti);

/* The closed form of a large structure, of which CVODE with the exact law would confirm no more than what it slows
 * (steady/mass_scaling.h), one more owner's; else NULL. */
timeint *timeint_closed_form_of(timeint *ti);

/* The same for the model and transient.scout of `of`, with which it shares what it finds in closed form; either may be
 * freed first. Of the exact law and a large structure it is that closed form itself, with the tolerance it has. Not for
 * another thread than that of `of`; what is found in closed form counts as periods of `of`. */
hc_status timeint_new_beside(timeint *of, const transient_settings *how, timeint **out);

/* Does CVODE see modes slowed at omega (steady/mass_scaling.h)? */
bool timeint_slows_modes(const timeint *ti, double omega);

/* Orbits are asked for, not their multipliers, which are then NAN where each would need a matrix of its own: of a large
 * structure those of a neighbouring frequency do for its steps. */
void timeint_leave_multipliers(timeint *ti);

/* Adds the periods integrated since the handle was made, by CVODE and in closed form; of no handle (NULL) none. */
void timeint_count(const timeint *ti, long *by_cvode, long *closed_form);

/* Doubles in a state: 2 n + the model's contacts. */
int timeint_n_states(const timeint *ti);

/* state[timeint_n_states]: at rest under the static loads, v = 0, sliders where they begin (model.h); x = 0 where
 * there are no loads. */
void timeint_rest(const timeint *ti, double *state);
