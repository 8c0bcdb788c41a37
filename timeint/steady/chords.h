/* chords.h - to the orbit of a large structure in closed form, or with modes slowed: Newton's steps with a borrowed
 * matrix (period_map.h), kept as long as they contract. A plain period costs 1/25 to 1/150 of a matrix. The whole
 * structure begins with the orbit of the slowed one, whose periods cost a fifth. */
#pragma once

#include "timeint/steady/period_map.h"

/* map->iterate, from ti->y, to where |z - F^k(z)| <= enough [L] or the orbit is no farther than goal [L], by steps no
 * longer than `reach` [L]. HC_NOT_CONVERGED if steps do not contract with new matrices either; HC_NOT_FINITE; errors of
 * period_map_at and period_map_borrow. */
hc_status chords_to_orbit(period_map *map, double reach, double enough, double goal);
