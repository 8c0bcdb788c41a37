/* confirm.c - see confirm.h. */
#include "timeint/steady/confirm.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/dense.h"
#include "numerics/floquet.h"
#include "numerics/norm.h"
#include "timeint/steady/orbit.h"
#include "timeint/steady/timeint_private.h"

static const double contracts = 0.3; /* a Newton step no shorter than that part of the last one leads nowhere */
enum { MOST_STEPS = 8 };

struct confirm { /* from confirm_new, to confirm_free */
  timeint *ti;
  int n;
  double *matrix;                     /* [n][n] I - Phi^k, then its factors */
  double *phi, *one_period, *product; /* [n][n] */
  double *before, *z, *step;          /* [n] */
  int *pivot;                         /* [n] */
  double *memory;                     /* of all the doubles */
};

hc_status confirm_new(timeint *ti, confirm **out)
{
  *out = NULL;
  confirm *c = calloc(1, sizeof *c);
  if (!c) return HC_NO_MEMORY;
  const size_t n = (size_t)ti->n;
  double **const matrices[] = {&c->matrix, &c->phi, &c->one_period, &c->product};
  double **const vectors[] = {&c->before, &c->z, &c->step};
  c->ti = ti;
  c->n = ti->n;
  c->memory = calloc(4 * n * n + 3 * n, sizeof *c->memory);
  c->pivot = calloc(n, sizeof *c->pivot);
  if (!c->memory || !c->pivot) {
    confirm_free(c);
    return HC_NO_MEMORY;
  }
  for (size_t i = 0; i < 4; ++i) *matrices[i] = c->memory + i * n * n;
  for (size_t i = 0; i < 3; ++i) *vectors[i] = c->memory + 4 * n * n + i * n;
  *out = c;
  return HC_OK;
}

void confirm_free(confirm *c)
{
  if (!c) return;
  free(c->memory);
  free(c->pivot);
  free(c);
}

static bool is_unit_row(const confirm *c, int i)
{
  for (int j = 0; j < c->n; ++j)
    if (c->phi[i + j * c->n] != (i == j)) return false;
  return true;
}

/* I - Phi^k of the exact law along the k periods from ti->y on, factored. The equation of a slider that stays wherever
 * it is becomes: go where the period takes it. */
static hc_status make_matrix(confirm *c, int k)
{
  timeint *ti = c->ti, *scout = ti->scout;
  const size_t bytes = sizeof *c->phi * (size_t)(c->n * c->n);
  scaled_make(&scout->scaled, ti->model, &scout->how, ti->omega, ti->length);
  memcpy(c->z, ti->y, sizeof *c->z * (size_t)c->n);
  for (int i = 0; i < k; ++i) {
    hc_status st = integrate_monodromy(scout->in, &scout->scaled, c->z, i == 0 ? c->phi : c->one_period);
    if (st != HC_OK) return st;
    if (i == 0) continue;
    memcpy(c->product, c->phi, bytes);
    dense_multiply(c->n, c->n, c->n, c->one_period, c->product, c->phi);
  }
  for (int i = 0; i < c->n; ++i) {
    const bool stays = i >= 2 * c->ti->n_dof && is_unit_row(c, i);
    for (int j = 0; j < c->n; ++j) c->matrix[i + j * c->n] = (i == j) - (stays ? 0 : c->phi[i + j * c->n]);
  }
  return dense_factor(c->n, c->matrix, c->pivot);
}

/* [L] The scatter of k periods times |(I - Phi^k)^-1| (Frobenius norm). */
static double attainable(confirm *c, int k)
{
  double sum = 0;
  for (int j = 0; j < c->n; ++j) {
    for (int i = 0; i < c->n; ++i) c->step[i] = i == j;
    dense_solve(c->n, c->matrix, c->pivot, 1, c->step);
    for (int i = 0; i < c->n; ++i) sum += c->step[i] * c->step[i];
  }
  return sqrt(sum) * orbit_scatter(c->ti, k);
}

/* k periods from c->z on, measured; c->step: from the orbit to c->z, *length of it. */
static hc_status try_orbit(confirm *c, int k, const hc_monitor *monitor, double *length, timeint_result *r)
{
  timeint *ti = c->ti;
  if (ti->periods + k > ti->how.max_periods) return HC_NOT_SETTLED;
  if (!hc_monitor_tick(monitor, -1)) return HC_INTERRUPTED;
  memcpy(ti->y, c->z, sizeof *c->z * (size_t)c->n);
  hc_status st = orbit_measure(ti, k, r);
  if (st != HC_OK) return st;
  for (int i = 0; i < c->n; ++i) c->step[i] = c->z[i] - ti->y[i];
  dense_solve(c->n, c->matrix, c->pivot, 1, c->step);
  *length = norm_2(c->n, c->step);
  return isfinite(*length) ? HC_OK : HC_NOT_FINITE;
}

hc_status confirm_orbit(confirm *c, int k, double goal, const hc_monitor *monitor, shoot_report *found,
                        timeint_result *r)
{
  timeint *ti = c->ti;
  const size_t bytes = sizeof *c->z * (size_t)c->n;
  double length = INFINITY, last = INFINITY;
  const double size = timeint_motion_size(ti) / ti->length;
  memcpy(c->before, ti->y, bytes);
  hc_status st = make_matrix(c, k);
  if (st == HC_OK) found->attainable = attainable(c, k);
  memcpy(c->z, c->before, bytes);
  for (int tries = 0; st == HC_OK; ++tries) {
    st = try_orbit(c, k, monitor, &length, r);
    found->distance = length;
    if (st != HC_OK || length <= goal) break;
    if (tries == MOST_STEPS || !(length <= contracts * last)) { /* as near as periods can tell, or not at all */
      if (!(length <= found->attainable)) st = HC_NOT_CONVERGED;
      break;
    }
    for (int i = 0; i < c->n; ++i) c->z[i] -= c->step[i];
    if (!(distance_2(c->n, c->z, c->before) <= ORBIT_REGULARISED_WITHIN * size)) st = HC_NOT_CONVERGED;
    last = length;
  }
  if (st != HC_OK) memcpy(ti->y, c->before, bytes);
  else orbit_fill(ti, k, TIMEINT_BY_SHOOTING, found, r);
  return st;
}
