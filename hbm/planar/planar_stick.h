/* planar_stick.h - where a slider that sticks begins to slip: the first angle where
 *
 *     g = R^2 - |u - w|^2,      a trigonometric polynomial of degree 2H,
 *
 * falls through 0. None is missed, double roots (grazing) included: an interval is dismissed only where bounds of g''
 * and g''' prove it empty, as numerics/crossing.h does for guards that are linear in the motion. */
#ifndef HC_HBM_PLANAR_STICK_H
#define HC_HBM_PLANAR_STICK_H

#include <stdbool.h>

#include "hbm/planar/planar_motion.h"

/* The first such angle in (from, to], 0 <= from < to <= from + 2 pi and from <= 2 pi; false if there is none. grid: of
 * planar_motion_grid. g >= 0 at `from`, to rounding; excursions below 0 by no more than rounding do not count. */
bool planar_stick_ends(const planar_motion *m, const planar_point *grid, const double w[2], const planar_point *from,
                       double to, planar_point *root);

#endif
