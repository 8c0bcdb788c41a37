/* referee.h - the referee of a comparison: time integration with the exact law, started on an HBM solution. */
#pragma once

#include "compare/compare_settings.h"
#include "hbm/hbm.h"
#include "timeint/steady/steady.h"

/* A handle for timeint_orbit of the setup's model with the exact law. It shares with `beside`, if that is not NULL,
 * what is found in closed form. */
hc_status comparison_referee(const compare_setup *setup, timeint *beside, timeint **out);

/* state[timeint_n_states]: x(t), x'(t) and sliders at t = 0 of an HBM solution, where its transient starts. */
hc_status comparison_orbit_start(hbm_solver *hbm, const double *X, double omega, double *state);
