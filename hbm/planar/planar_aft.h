/* planar_aft.h - force harmonics of one contact with two tangents under the law of the circle (planar_slider.h), by
 * sampling: aft.h for motions in a plane. Coordinates are u_1, u_2 and, with n_dof = 3, v; with 2 the normal force does
 * not vary; forces T_1, T_2 and N - N0 of both halves (model.h), which have the law that is given.
 *
 * A slider that is always held rests where planar_rest.h says, of the motion itself: by its samples the instants that
 * hold it would jump. Where there is no such place, and by a rule that was plugged in (slider.h), it begins with w = 0
 * at th = 0, is put into the circle there at once, and dragged until it comes back to where it was a period before, or
 * for one period.
 * make: HC_BAD_INPUT, HC_NO_MEMORY. evaluate: HC_NOT_FINITE; HC_NOT_CLOSED if it does not come back within 400 periods;
 * allocates nothing; report may be NULL. jacobian: that of the sampled F, aliasing included. Where it slips, the
 * slider's closed orbit moves with X; else it stays where the first periods have dragged it. */
#pragma once

#include "hbm/contact/contact_evaluator.h"

extern const contact_evaluator planar_aft_evaluator;
