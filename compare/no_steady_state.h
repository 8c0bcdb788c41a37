/* no_steady_state.h - why there is no periodic motion, where harmonic balance has found none. */
#pragma once

#include "compare/compare_settings.h"
#include "timeint/steady/steady.h"

/* Why there is no periodic motion at omega: what the transient from rest says in 3 s. HC_CREEPS, r->drift;
 * HC_UNBOUNDED; HC_OK: not known. state[n_states] is overwritten. HC_NO_MEMORY, HC_INTERRUPTED. */
hc_status steady_state_lacks(timeint *ti, double omega, double *state, const hc_monitor *monitor, timeint_result *r);

/* HC_CREEPS of these, *response the one that moves on most, counted from 0, by *drift; HC_OK at once where more than
 * contacts holds the structure. */
hc_status steady_state_creeps(const compare_setup *setup, double omega, const hc_monitor *monitor, int *response,
                              double *drift);
