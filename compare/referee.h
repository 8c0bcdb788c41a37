/* referee.h - the exact law's time integration that HBM solutions are held against, and where it starts beside one. */
#pragma once

#include "compare/compare_settings.h"
#include "hbm/hbm.h"
#include "timeint/steady/steady.h"

/* The time integration that HBM solutions are held against: the model, with the exact law. For timeint_orbit.
 * It shares with `beside`, if that is not NULL, what is found in closed form. */
hc_status comparison_referee(const compare_setup *setup, timeint *beside, timeint **out);

/* state[timeint_n_states]: x(t), x'(t) and sliders at t = 0 of an HBM solution, where its transient starts. */
hc_status comparison_orbit_start(hbm_solver *hbm, const double *X, double omega, double *state);
