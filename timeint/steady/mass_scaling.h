/* mass_scaling.h - when the fastest modes of a large structure are slowed, and what that costs.
 *
 * A structure reduced from a finite-element mesh has modes thousands of times faster than its load. To contacts they
 * are springs, yet steps follow the fastest. By CVODE, and where the closed form needs a monodromy matrix, they are
 * therefore given more mass (modal_base_slowed): all modes beyond MASS_SCALING_FASTEST times omega are as fast as
 * that. The closed form's own periods are always the whole model's; an orbit is that of its period map, whatever
 * matrix Newton takes. What CVODE's orbits are off by it is measured, between orbits of the closed form with and
 * without, and is part of transient_predicted. */
#pragma once

#include "timeint/law/modal_base.h"

/* [omega] Of the plates (cases/structures/plates.yaml, 138 Hz) amplitudes are off by 1.8e-5, 1.1e-6, 4e-7, 3e-9 with
 * 100, 200, 400, 800, and a chord step with that matrix leaves 0.17, 0.02 of the distance with 100, 200. */
#define MASS_SCALING_FASTEST 200.0

/* Structures of up to so many modes have theirs as they are: periods are short (interval_modes.h, too). */
enum { MASS_SCALING_MODES = 64 };

/* May modes of that structure be slowed at any omega? Not where its stiffness is not symmetric. */
bool mass_scaling_may_pay(const modal_base *whole);

/* [rad/time] The fastest mode to be left at omega: MASS_SCALING_FASTEST omega, to within 9 %, so that neighbouring
 * frequencies have the same; INFINITY where that is not half of what the structure has. */
double mass_scaling_fastest(const modal_base *whole, double omega);
