/* planar_aft.h - force harmonics of one contact with two tangents under the law of the circle (planar_slider.h), by
 * sampling: aft.c for motions in a plane. Coordinates are u_1, u_2 and, with n_dof = 3, v; with 2 the normal force is
 * constant. Forces are T_1, T_2 and N - N0 of both halves (model.h); the given law is that of one half.
 *
 * With the restarts `interpolated` and `sample` a slider that can rest all period is placed by planar_rest.h, from the
 * motion itself: from samples the instants that hold it would jump. Where no rest exists, and by a slider that was
 * plugged in (slider.h), it begins with w = 0 at th = 0, is moved into the circle there, and followed until it returns
 * to its place a period before, or for one period. make: HC_BAD_INPUT, HC_NO_MEMORY. evaluate: HC_NOT_FINITE;
 * HC_NOT_CLOSED if it does not return within 400 periods; allocates nothing; report may be NULL. jacobian: that of the
 * sampled F, aliasing included. dw/dX is that of the closed orbit where it slips or separates, of the rest position, or
 * of the periods from w = 0. */
#pragma once

#include "hbm/contact/contact_evaluator.h"

extern const contact_evaluator planar_aft_evaluator;
