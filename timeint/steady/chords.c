/* chords.c - see chords.h. */
#include "timeint/steady/chords.h"

#include <string.h>

#include "numerics/base/trace.h"
#include "timeint/steady/shoot.h"

enum {
  CHORD_STEPS = 60,  /* steps that leave half each come from 1 to rounding in 52 */
  CHORD_IDLE = 3,    /* idle steps before the matrix is renewed, which costs 25 to 150 of them */
  CHORD_RENEWALS = 3 /* matrices without which steps do not contract: then there is no orbit */
};
static const double chord_contracts = 0.5; /* [least residual] a step that leaves more is idle */
static const double chord_leads_away = 10; /* [least residual] the matrix is renewed at once where one leaves that */
/* [last ratio of two steps' lengths] The ratio expected of the next two: the next point is measured where that leads
 * onto the orbit. A wrong guess costs a period. */
static const double chord_contracts_to = 0.1;
static const double near_orbit = 1e-7;     /* [size] distance to which the slowed orbit is found: the whole model's is
                                              1e-6 off; a slider that travels less may rest on the orbit itself */
static const double resolves_rest = 1e-11; /* [size] distance to the orbit at which such a slider no longer moves */

/* True if a slider of the whole model slips, but travels less than near_orbit in a period. */
static bool has_slider_nearly_at_rest(const period_map *map)
{
  const timeint *ti = map->ti;
  const double least = near_orbit * timeint_scaled_size(ti);
  for (int i = 2 * ti->n_dof; i < map->n && ti->slowed; ++i)
    if (map->travel[i] > 0 && map->travel[i] <= least * ti->sizes.of[i]) return true;
  return false;
}

/* Steps with one matrix as long as some of them contract: one that does not may have let sliders slip to where they
 * rest. */
static hc_status by_chords(period_map *map, double reach, double enough, double near)
{
  const timeint *ti = map->ti;
  double *z = map->iterate, least = INFINITY, last = 0;
  for (int steps = 0, renewals = 0, idle = 0; steps < CHORD_STEPS; ++steps) {
    hc_status st = period_map_at(map, z, PERIODS_MATRIX);
    if (st != HC_OK) return st;
    const double residual = timeint_distance(ti, z, map->f);
    const bool near_rest = has_slider_nearly_at_rest(map);
    TRACE(steady, "omega %.9g: chord step %d: residual %.3g", ti->omega, steps, residual / ti->length);
    if (residual <= enough && !near_rest) return HC_OK;
    idle = residual <= chord_contracts * least ? 0 : idle + 1;
    least = fmin(least, residual);
    const bool renewed = idle > CHORD_IDLE || residual > chord_leads_away * least;
    if (renewed && ++renewals > CHORD_RENEWALS) return HC_NOT_CONVERGED;
    if (renewed) least = residual, idle = 0;
    if (renewed || steps == 0) {
      st = period_map_borrow(map, renewed);
      if (st == HC_OK) st = period_map_factor(map);
    }
    if (st != HC_OK) return st;
    const double length = period_map_step(map, z, map->f), share = length > reach ? reach / length : 1;
    if (!isfinite(length)) return HC_NOT_FINITE;
    if (length <= near && (length <= resolves_rest * timeint_scaled_size(ti) || !near_rest)) return HC_OK;
    const double shorter = steps > 0 ? chord_contracts_to * fmin(length / last, 1) : chord_contracts_to;
    map->measures = ti->slowed && shorter * length <= near;
    last = length;
    for (int i = 0; i < map->n; ++i) z[i] -= share * map->step[i];
  }
  return HC_NOT_CONVERGED;
}

/* map->iterate, from ti->y, onto the orbit next to it of the slowed structure: as near to that of ti as slowed modes
 * leave it. If there is none it stays. */
static hc_status begin_with_slowed(period_map *map, double reach, double enough)
{
  timeint *ti = map->ti, *slowed = ti->slowed;
  period_map *of = slowed->map;
  double *state = ti->point[0];
  timeint_get_state(ti, state);
  hc_status st = timeint_begin(slowed, ti->omega, state);
  if (st != HC_OK || !isfinite(slowed->fastest)) return st; /* nothing is slowed at this frequency */
  const double unit = slowed->length / ti->length;
  period_map_begin(of, map->k, map->monitor);
  st = by_chords(of, reach / unit, fmax(enough, period_map_scatter(of)) / unit,
                 near_orbit * timeint_scaled_size(slowed));
  if (st == HC_OK) st = period_map_find_matrix(of);
  if (st != HC_OK) return shoot_found_no_orbit(st) ? HC_OK : st;
  memcpy(slowed->y, of->iterate, sizeof *slowed->y * (size_t)map->n);
  timeint_get_state(slowed, state);
  timeint_take_state(ti, state, map->iterate);
  period_map_began_with(map, of);
  return HC_OK;
}

/* True if the start is nearer to the orbit than the slowed one's is, by a residual that is known to leave a tenth of
 * it. Only where there is a matrix, and none is asked for. */
static bool starts_next_to(period_map *map)
{
  return map->ti->no_multipliers && period_map_can_borrow(map) &&
         period_map_at(map, map->iterate, PERIODS_MATRIX) == HC_OK &&
         timeint_distance(map->ti, map->z, map->f) <= SHOOT_SHARE_OF_GOAL * near_orbit * timeint_scaled_size(map->ti);
}

hc_status chords_to_orbit(period_map *map, double reach, double enough, double goal)
{
  const hc_status st = map->ti->slowed && !starts_next_to(map) ? begin_with_slowed(map, reach, enough) : HC_OK;
  return st == HC_OK ? by_chords(map, reach, enough, SHOOT_SHARE_OF_GOAL * goal) : st;
}
