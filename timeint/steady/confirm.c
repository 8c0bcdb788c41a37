/* confirm.c - see confirm.h. */
#include "timeint/steady/confirm.h"

#include <string.h>

#include "timeint/steady/orbit.h"
#include "timeint/steady/period_map.h"

enum {
  CONFIRM_STEPS = 8, /* 0.3^8 = 7e-5: slower than that Newton with variational equations is cheaper */
  SLOWED_STEPS = 3,  /* of 0.02: to 1e-5 of what slowed modes change */
  USUAL_STEPS = 2000 /* of a period, or fewer: on such ones its scatter was measured */
};
static const double contracts = 0.3; /* [last step] a step no shorter than that leads nowhere */
/* [size] A step of a large structure that short, and no shorter than the last, is the scatter of CVODE's periods: of
 * fast modes it is not known beforehand. */
static const double scatter_seen = 1e-6;
static const double coarse_scatter = 0.02; /* [expected step] what coarse periods may scatter, at worst */
static const double chord_leaves =
    0.05;                             /* [last step] twice what was seen; once that is attainable, periods are fine */
static const double as_expected = 10; /* [expected step] a longer one is not taken */

/* map->phi: Phi of the exact law in closed form along the k periods from ti->y on, or of a large structure next to
 * there. Its factors. */
static hc_status factor_closed_form(period_map *map)
{
  const hc_status st =
      period_map_borrows(map) ? period_map_borrow(map, false) : period_map_matrix_by(map, map->ti->closed_form->map);
  return st == HC_OK ? period_map_factor(map) : st;
}

/* k periods from map->iterate on, measured unless r is NULL; map->step: from the orbit to map->iterate, *length of it.
 * ti->y is where the periods end. */
static hc_status integrate_and_step(period_map *map, double *length, timeint_result *r)
{
  timeint *ti = map->ti;
  hc_status st = HC_OK;
  if (ti->periods + map->k > ti->how.max_periods) return HC_NOT_SETTLED;
  if (!hc_monitor_tick(map->monitor, -1)) return HC_INTERRUPTED;
  memcpy(ti->y, map->iterate, sizeof *ti->y * (size_t)map->n);
  if (r) st = orbit_measure(ti, map->k, r);
  for (int i = 0; !r && i < map->k && st == HC_OK; ++i, ++ti->periods)
    st = integrate_period(ti->in, &ti->scaled, ti->y, NULL, NULL);
  if (st != HC_OK) return st;
  *length = period_map_step(map, map->iterate, ti->y);
  return isfinite(*length) ? HC_OK : HC_NOT_FINITE;
}

static void take_step(period_map *map)
{
  for (int i = 0; i < map->n; ++i) map->iterate[i] -= map->step[i];
}

/* The first steps of a large structure, whose orbit is about `off` [L] away: with periods as coarse as the step that is
 * expected allows. */
static hc_status confirm_coarsely(period_map *map, double off, double attainable)
{
  timeint *ti = map->ti;
  const double fine = ti->tolerance, by_tolerance = attainable / fine;
  hc_status st = HC_OK;
  for (double expected = off; chord_leaves * expected > attainable && st == HC_OK;) {
    double length = NAN;
    st = timeint_set_tolerance(ti, fmin(fmax(coarse_scatter * expected / by_tolerance, fine), CONFIRM_COARSEST));
    if (st == HC_OK) st = integrate_and_step(map, &length, NULL);
    if (st != HC_OK || !(length <= as_expected * expected)) break;
    take_step(map);
    expected = chord_leaves * length;
  }
  const hc_status back = timeint_set_tolerance(ti, fine);
  return st == HC_OK ? back : st;
}

hc_status confirm_orbit(timeint *ti, int k, double goal, double off, const hc_monitor *monitor, shoot_report *found,
                        timeint_result *r)
{
  period_map *map = ti->map;
  double length = INFINITY, last = INFINITY;
  const double size = timeint_scaled_size(ti);
  const bool large = period_map_borrows(map);
  period_map_begin(map, k, monitor);
  hc_status st = factor_closed_form(map);
  if (st == HC_OK) st = period_map_attainable(map, &found->attainable);
  if (st == HC_OK && large) st = confirm_coarsely(map, off, found->attainable);
  for (int tries = 0; st == HC_OK; ++tries) {
    st = integrate_and_step(map, &length, r);
    found->distance = length;
    if (st != HC_OK || length <= (large ? fmax(goal, found->attainable) : goal)) break;
    if (tries == CONFIRM_STEPS || !(length <= contracts * last)) { /* as near as periods can tell, or not at all */
      /* Errors of steps add up as their square root does: a period of many scatters by more. */
      const double steps = (double)(integrate_steps(ti->in) - ti->steps0) / (double)ti->periods;
      const double within = large ? scatter_seen * size : found->attainable * sqrt(fmax(steps / USUAL_STEPS, 1));
      if (length <= within) found->attainable = fmax(found->attainable, length);
      else st = HC_NOT_CONVERGED;
      break;
    }
    take_step(map);
    if (!(timeint_distance(ti, map->iterate, map->before) <= ORBIT_REGULARISED_WITHIN * size)) st = HC_NOT_CONVERGED;
    last = length;
  }
  if (st != HC_OK) memcpy(ti->y, map->before, sizeof *ti->y * (size_t)map->n);
  else orbit_fill(ti, k, TIMEINT_BY_SHOOTING, found, r);
  return st;
}

hc_status confirm_slowed(timeint *ti, int k, const hc_monitor *monitor)
{
  period_map *map = ti->slowed->map;
  period_map_begin(ti->map, k, monitor);
  period_map_begin(map, k, monitor);
  hc_status st = period_map_find_matrix(ti->map);
  if (st == HC_OK) st = period_map_borrow(map, false);
  if (st == HC_OK) st = period_map_factor(map);
  for (int steps = 0; steps < SLOWED_STEPS && st == HC_OK; ++steps) {
    double length;
    st = integrate_and_step(map, &length, NULL);
    if (st == HC_OK) take_step(map);
  }
  if (st == HC_OK) memcpy(ti->slowed->y, map->iterate, sizeof *map->iterate * (size_t)map->n);
  return st;
}
