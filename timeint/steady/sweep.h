/* sweep.h - a state carried from one frequency to another as on a shaker, so that it stays on its branch. */
#pragma once

#include "timeint/timeint.h"

/* Carry state[timeint_n_states] from omega_from to omega_to [rad/time] in frequency steps small enough to stay on a
 * branch, partially settling at each; with the exact law whatever the settings' law. It does not settle at omega_to:
 * call timeint_steady for that. HC_BAD_INPUT, HC_INTERRUPTED, and what integration answers. */
hc_status timeint_sweep(timeint *ti, double omega_from, double omega_to, double *state, const hc_monitor *monitor);
