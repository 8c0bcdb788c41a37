/* period_map.c - see period_map.h. */
#include "timeint/steady/period_map.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/dense.h"
#include "timeint/closed_form/series_columns.h"

/* [omega] A matrix serves as far away where no multiplier is asked for: steps that do not contract with it renew it. */
static const double same_frequency = 2e-4;
/* [size] A state as near has the same matrix but for some 1e-4. */
static const double same_matrix = 1e-4;
enum { REST_TRIES = 4 }; /* of keep_at_rest; the second shows, as a rule, that all rest */

/* [L] rounding of the sums that make a step */
static const double rounding_of_step = 20 * DBL_EPSILON;
/* Steps of a period whose rounding adds up. In closed form a large structure takes 1000 to 4000, whose errors die away:
 * 1.3e-13 was seen, 30 times rounding_of_step. */
enum { CLOSED_FORM_STEPS = 10, LARGE_CLOSED_FORM_STEPS = 100, CVODE_STEPS = 1000 };

/* ---- made and freed ------------------------------------------------------------------------------------ */

hc_status period_map_new(timeint *ti, period_map **out)
{
  *out = NULL;
  period_map *map = calloc(1, sizeof *map);
  if (!map) return HC_NO_MEMORY;
  map->ti = ti;
  map->n = ti->n;
  double **const vectors[] = {&map->z,     &map->f,       &map->travel, &map->kept.at, &map->before,
                              &map->first, &map->iterate, &map->step,   &map->vector};
  double **const matrices[] = {&map->phi, &map->kept.phi, &map->factors, &map->one_period, &map->product};
  const size_t n = (size_t)map->n;
  workspace *w = &map->memory;
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; ++i) *vectors[i] = workspace_doubles(w, n);
  for (size_t i = 0; i < sizeof matrices / sizeof *matrices; ++i) *matrices[i] = workspace_doubles(w, n * n);
  map->pivot = workspace_array(w, n, sizeof *map->pivot);
  if (!w->failed) {
    *out = map;
    return HC_OK;
  }
  period_map_free(map);
  return HC_NO_MEMORY;
}

void period_map_free(period_map *map)
{
  if (!map) return;
  workspace_free(&map->memory);
  free(map);
}

void period_map_borrow_from(period_map *map, period_map *lender) { map->lender = lender->lender = lender; }

bool period_map_borrows(const period_map *map) { return map->lender != NULL; }

bool period_map_has_coarse(const period_map *map) { return !map->lender && integrate_has_coarse(map->ti->in); }

void period_map_begin(period_map *map, int k, const hc_monitor *monitor)
{
  double *const starts[] = {map->before, map->iterate, map->z};
  for (size_t i = 0; i < sizeof starts / sizeof *starts; ++i)
    memcpy(starts[i], map->ti->y, sizeof *map->z * (size_t)map->n);
  map->k = k;
  map->monitor = monitor;
  map->known = map->begun = map->measures = false;
}

/* ---- periods --------------------------------------------------------------------------------------------- */

/* The period just integrated. A circle's two directions rest or slip as one. */
static void note_travel(period_map *map)
{
  const timeint *ti = map->ti;
  const int moving = 2 * ti->n_dof;
  for (int i = moving; i < map->n; ++i) {
    const int j = scaled_first(&ti->scaled, i - moving), n = scaled_directions(&ti->scaled, j);
    for (int a = 0; a < n; ++a) map->travel[i] = fmax(map->travel[i], integrate_travel(ti->in, j + a));
  }
}

/* y goes on by a period; phi, that of the i periods before it, becomes that of i + 1. */
static hc_status add_period(period_map *map, bool coarse, int i, double *y, double *phi)
{
  double *of_period = i == 0 ? phi : map->one_period;
  hc_status st =
      (coarse ? integrate_coarse_monodromy : integrate_monodromy)(map->ti->in, &map->ti->scaled, y, of_period);
  if (st != HC_OK || i == 0) return st;
  memcpy(map->product, phi, sizeof *phi * (size_t)(map->n * map->n));
  dense_multiply(map->n, map->n, map->n, map->one_period, map->product, phi);
  return HC_OK;
}

/* y goes on by k periods; phi becomes their matrix. */
static hc_status follow_with_matrix(period_map *map, int k, bool coarse, const hc_monitor *monitor, double *y,
                                    double *phi)
{
  hc_status st = HC_OK;
  for (int i = 0; i < k && st == HC_OK; ++i)
    st = hc_monitor_tick(monitor, -1) ? add_period(map, coarse, i, y, phi) : HC_INTERRUPTED;
  return st;
}

/* map->f becomes F^k(map->f), map->phi the matrix of these k periods. */
static hc_status integrate_k_periods(period_map *map, period_matrix matrix)
{
  timeint *ti = map->ti;
  const bool measured = map->measures && map->k == 1;
  const long transitions = integrate_transitions(ti->in);
  memset(map->travel, 0, (size_t)map->n * sizeof *map->travel);
  if (measured) {
    measure_begin(&ti->measure, &ti->scaled);
    measure_period(&ti->measure, map->f);
    ti->measured = false;
    ti->last.k = 0;
  }
  for (int i = 0; i < map->k; ++i) {
    if (ti->periods >= ti->how.max_periods - map->k) return HC_NOT_SETTLED; /* k are kept for the report */
    if (!hc_monitor_tick(map->monitor, -1)) return HC_INTERRUPTED;
    integrate_watch *watch = measured ? measure_step : NULL;
    hc_status st = matrix != PERIODS_ALONE ? add_period(map, matrix == PERIODS_COARSE_MATRIX, i, map->f, map->phi)
                                           : integrate_period(ti->in, &ti->scaled, map->f, watch, &ti->measure);
    if (st != HC_OK) return st;
    ++ti->periods;
    note_travel(map);
  }
  map->events = integrate_transitions(ti->in) - transitions;
  if (measured) timeint_note_measured(ti, 1, map->f, (int)map->events, 1);
  return HC_OK;
}

hc_status period_map_at(period_map *map, const double *z, period_matrix matrix)
{
  const size_t bytes = sizeof *z * (size_t)map->n;
  if (map->lender) matrix = PERIODS_ALONE;
  if (map->known && map->matrix >= matrix && memcmp(map->z, z, bytes) == 0) return HC_OK;
  memcpy(map->z, z, bytes);
  memcpy(map->f, z, bytes);
  hc_status st = integrate_k_periods(map, matrix);
  map->known = st == HC_OK;
  map->matrix = matrix;
  if (map->known && !map->begun) memcpy(map->first, map->f, bytes), map->begun = true;
  return st;
}

double period_map_scatter(const period_map *map)
{
  const timeint *ti = map->ti;
  if (ti->how.method == TRANSIENT_METHOD_CLOSED_FORM)
    return map->k * (ti->slowed ? LARGE_CLOSED_FORM_STEPS : CLOSED_FORM_STEPS) * rounding_of_step;
  return map->k * fmax(integrate_scatter(ti->in) * ti->tolerance, CVODE_STEPS * rounding_of_step);
}

/* ---- matrices of another map ------------------------------------------------------------------------------- */

/* A state i of map `from` times that is one of map `to`, in one unit of length. */
static double unit_ratio(const period_map *to, const period_map *from, int i)
{
  const int n = to->ti->n_dof;
  return i < 2 * n ? to->ti->base->slowed[i % n] / from->ti->base->slowed[i % n] : 1;
}

/* The equations of the map's handle at that omega in that unit of length, wherever its own motion is. */
static void use_equations(period_map *map, double omega, double length)
{
  timeint *ti = map->ti;
  scaled_make(&ti->scaled, ti->model, &ti->how, omega, length);
}

/* Those of its own motion, once it has one. */
static void use_own_equations(period_map *map)
{
  if (map->ti->omega > 0) use_equations(map, map->ti->omega, map->ti->length);
}

void period_map_began_with(period_map *map, const period_map *lender)
{
  const double unit = lender->ti->length / map->ti->length;
  for (int i = 0; i < map->n; ++i) map->first[i] = lender->first[i] / unit_ratio(lender, map, i) * unit;
  map->begun = true;
}

static bool is_unit_row(int n, const double *phi, int i)
{
  for (int j = 0; j < n; ++j)
    if (phi[i + j * n] != (i == j)) return false;
  return true;
}

/* True if slider i rested in the last periods, but for a slip as small as rounding. */
static bool rested(const period_map *map, int i)
{
  return map->travel[i] <= MEASURE_RESTS * timeint_scaled_size(map->ti) * map->ti->sizes.of[i];
}

/* Sliders that rest all period from map->z on (or slip by rounding) are moved in y, the lender's state there, until
 * they rest in its period, too, whose motion is a little another. */
static hc_status keep_at_rest(const period_map *map, period_map *lender, double *y)
{
  const timeint *ti = map->ti;
  const double size = timeint_scaled_size(ti);
  bool moved = true;
  lender->known = false;
  for (int tries = 0; tries < REST_TRIES && moved; ++tries) {
    moved = false;
    memcpy(lender->f, y, sizeof *y * (size_t)map->n);
    memset(lender->travel, 0, sizeof *y * (size_t)map->n);
    for (int k = 0; k < map->k; ++k) {
      hc_status st = integrate_period(lender->ti->in, &lender->ti->scaled, lender->f, NULL, NULL);
      if (st != HC_OK) return st;
      note_travel(lender);
    }
    for (int i = 2 * ti->n_dof; i < map->n; ++i) {
      if (!(rested(map, i) && lender->travel[i] > 0 && isfinite(lender->travel[i]))) continue;
      const double moves = fmin(size * ti->sizes.of[i], state_sizes_slider(&ti->sizes, i - 2 * ti->n_dof) / ti->length);
      y[i] += copysign(lender->travel[i] + same_matrix * moves, lender->f[i] - y[i]);
      moved = true;
    }
  }
  return HC_OK;
}

/* The lender's matrix is found anew, at map->z. */
static hc_status renew(period_map *map)
{
  const timeint *ti = map->ti;
  period_map *lender = map->lender;
  kept_matrix *kept = &lender->kept;
  double *y = lender->vector;
  kept->k = 0;
  hc_status st = timeint_slow_modes(lender->ti, ti->omega);
  if (st != HC_OK) return st;
  use_equations(lender, ti->omega, ti->length);
  for (int i = 0; i < map->n; ++i) kept->at[i] = y[i] = map->z[i] * unit_ratio(lender, map, i);
  if (map->known && lender != map) st = keep_at_rest(map, lender, y);
  const long events = integrate_transitions(lender->ti->in);
  if (st == HC_OK) st = follow_with_matrix(lender, map->k, false, map->monitor, y, kept->phi);
  kept->events = integrate_transitions(lender->ti->in) - events;
  use_own_equations(lender);
  if (st != HC_OK) return st;
  kept->k = map->k;
  kept->omega = ti->omega;
  kept->length = ti->length;
  kept->fastest = lender->ti->fastest;
  return HC_OK;
}

bool period_map_can_borrow(const period_map *map)
{
  const period_map *lender = map->lender;
  const kept_matrix *kept = &lender->kept;
  const double within = map->ti->no_multipliers ? same_frequency * map->ti->omega : 0;
  return kept->k == map->k && kept->fastest == lender->ti->fastest && fabs(kept->omega - map->ti->omega) <= within;
}

/* map->phi: the lender's, converted. */
static void take_kept(period_map *map)
{
  const period_map *lender = map->lender;
  const int n = map->n;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      map->phi[i + j * n] = lender->kept.phi[i + j * n] * unit_ratio(lender, map, j) / unit_ratio(lender, map, i);
}

hc_status period_map_borrow(period_map *map, bool anew)
{
  const hc_status st = anew || !period_map_can_borrow(map) ? renew(map) : HC_OK;
  if (st == HC_OK) take_kept(map);
  return st;
}

/* What the lender keeps becomes the matrix of the periods from map->z on, whose contacts do not change, by the map
 * itself: as little work then. */
static hc_status give_own_matrix(period_map *map)
{
  period_map *lender = map->lender;
  kept_matrix *kept = &lender->kept;
  const int n = map->n;
  memcpy(map->vector, map->z, (size_t)n * sizeof *map->z);
  const hc_status st = follow_with_matrix(map, map->k, false, map->monitor, map->vector, map->phi);
  for (int j = 0; j < n && st == HC_OK; ++j) {
    kept->at[j] = map->z[j] * unit_ratio(lender, map, j);
    for (int i = 0; i < n; ++i)
      kept->phi[i + j * n] = map->phi[i + j * n] * unit_ratio(lender, map, i) / unit_ratio(lender, map, j);
  }
  kept->events = 0;
  kept->omega = map->ti->omega;
  kept->length = map->ti->length;
  return st;
}

/* [L/size] How far map->z is from where the lender's matrix is of. */
static double distance_of_kept(const period_map *map, const period_map *lender)
{
  double apart = 0;
  for (int i = 0; i < map->n; ++i) {
    const double at = lender->kept.at[i] / unit_ratio(lender, map, i) * lender->kept.length / map->ti->length;
    apart = fmax(apart, fabs(map->z[i] - at) / map->ti->sizes.of[i]);
  }
  return apart;
}

/* True if a slider that rested slips along the lender's matrix. */
static bool slips_where_rested(const period_map *map, const period_map *lender)
{
  for (int i = 2 * map->ti->n_dof; i < map->n; ++i)
    if (rested(map, i) && !is_unit_row(map->n, lender->kept.phi, i)) return true;
  return false;
}

/* Where nothing changes at the contacts, but did on the lender's periods, as slowed modes shake them or from a point
 * where they still slip, its matrix is of another motion, however near. */
hc_status period_map_find_matrix(period_map *map)
{
  const timeint *ti = map->ti;
  period_map *lender = map->lender;
  if (!lender) return HC_OK;
  if (!period_map_can_borrow(map)) return period_map_borrow(map, true);
  const bool other = lender != map,
             exact = ti->how.method == TRANSIENT_METHOD_CLOSED_FORM && map->n <= SERIES_COLUMNS_SQUARED;
  if (exact && other && map->events == 0 && lender->kept.events > 0) {
    const hc_status st = give_own_matrix(map);
    if (st == HC_OK) take_kept(map);
    return st;
  }
  const double apart = ti->no_multipliers ? 0 : distance_of_kept(map, lender);
  const bool anew =
      !(apart <= same_matrix * timeint_scaled_size(ti)) || (apart > 0 && other && slips_where_rested(map, lender));
  return period_map_borrow(map, anew);
}

hc_status period_map_matrix_by(period_map *map, period_map *other)
{
  memcpy(map->vector, map->z, sizeof *map->z * (size_t)map->n);
  use_equations(other, map->ti->omega, map->ti->length);
  const hc_status st = follow_with_matrix(other, map->k, true, map->monitor, map->vector, map->phi);
  use_own_equations(other);
  return st;
}

/* ---- the step to a fixed point --------------------------------------------------------------------------- */

bool period_map_is_free(const period_map *map, int i)
{
  if (i < 2 * map->ti->n_dof) return false;
  if (!map->known) return is_unit_row(map->n, map->phi, i);
  return rested(map, i) || (map->f[i] == map->z[i] && is_unit_row(map->n, map->phi, i));
}

void period_map_jacobian(const period_map *map, double *jac)
{
  const int n = map->n;
  for (int i = 0; i < n; ++i) {
    const bool stays = period_map_is_free(map, i);
    for (int j = 0; j < n; ++j) jac[i + j * n] = (i == j) - (stays ? 0 : map->phi[i + j * n]);
  }
}

hc_status period_map_factor(period_map *map)
{
  period_map_jacobian(map, map->factors);
  return dense_factor(map->n, map->factors, map->pivot);
}

double period_map_step(period_map *map, const double *from, const double *to)
{
  for (int i = 0; i < map->n; ++i) map->step[i] = from[i] - to[i];
  dense_solve(map->n, map->factors, map->pivot, 1, map->step);
  return timeint_norm(map->ti, map->step);
}

hc_status period_map_attainable(period_map *map, double *out)
{
  double sum = 0, *column = map->vector;
  for (int j = 0; j < map->n; ++j) {
    for (int i = 0; i < map->n; ++i) column[i] = i == j ? map->ti->sizes.of[j] : 0;
    dense_solve(map->n, map->factors, map->pivot, 1, column);
    const double length = timeint_norm(map->ti, column);
    sum += length * length;
  }
  *out = sqrt(sum) * period_map_scatter(map);
  return *out < timeint_scaled_size(map->ti) ? HC_OK : HC_SINGULAR;
}
