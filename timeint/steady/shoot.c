/* shoot.c - see shoot.h. Newton itself is numerics/newton.h. Residual and Jacobian are asked for one after the other,
 * and come from the same periods. */
#include "timeint/steady/shoot.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include <kinsol/kinsol.h>

#include "numerics/base/trace.h"
#include "numerics/floquet.h"
#include "numerics/newton.h"
#include "numerics/sundials_compat.h"
#include "numerics/vectors.h"
#include "timeint/steady/period_map.h"

enum {
  NEWTON_ITERATIONS = 12, /* twice the 3 to 7 periods it takes from the HBM orbit (docs/measurements) */
  KEPT_ITERATIONS = 2 * NEWTON_ITERATIONS, /* with matrices that are kept, whose steps only contract */
  ANDERSON_ITERATIONS = 100, /* what a contraction of 0.8 a period needs to 1e-9 without acceleration: 0.8^93 = 1e-9 */
  ANDERSON_DEPTH = 4,        /* about the states of an oscillator: with as many as states it is the secant method */
  LAST_STEPS = 4,            /* digits double: from 1e-2 to rounding in three, and one that shows it */
  DIRECTION_STEPS = 64,      /* of the power iteration: a second multiplier of 0.8 of the first leaves 0.8^64 = 6e-7 */
  EDGE_SCATTERS = 100        /* sliders are moved off the edge of slip by so much more than rounding */
};
static const double matrix_keeps = 0.1; /* [residual] where it takes less to leave than to renew: 10^-10 in ten */
static const double both_scatter = 1e3; /* [tolerance] of F(z0) and F(z*) together: twice 250, and twice that */

struct shoot { /* from shoot_new, to shoot_free */
  timeint *ti;
  period_map *map;
  int n;
  double *best;                /* [n] the iterate nearest to the orbit */
  double *weight;              /* [n] 1/size of each state: of unknowns and residuals */
  double *vector, *other;      /* [n] scratch of one function */
  double complex *multipliers; /* [n] */
  int *active;                 /* [n] the states that are not free sliders */
  newton *newton;
  floquet *floquet;
  struct {             /* the last orbit found of a large structure in closed form */
    int k;             /* its periods; 0: none */
    double omega;      /* [rad/time] */
    double length;     /* [length] unit of length */
    double *from, *at; /* [n] ti->y when the search began, and a point on the orbit */
    shoot_report report;
  } found;
  workspace memory; /* of all the arrays above */
  SUNContext ctx;   /* of what follows, Anderson's */
  N_Vector u, weights;
  void *kin;
  hc_status refusal; /* why a point was refused */
};

/* ---- the equations ------------------------------------------------------------------------------------- */

static hc_status shoot_residual(void *self, const double *z, double *r)
{
  shoot *s = self;
  hc_status st = period_map_at(s->map, z, period_map_has_coarse(s->map) ? PERIODS_ALONE : PERIODS_MATRIX);
  for (int i = 0; i < s->n && st == HC_OK; ++i) r[i] = z[i] - s->map->f[i];
  return st;
}

/* s->map->phi at z. */
static hc_status find_matrix(shoot *s, const double *z)
{
  hc_status st = period_map_at(s->map, z, period_map_has_coarse(s->map) ? PERIODS_COARSE_MATRIX : PERIODS_MATRIX);
  return st == HC_OK ? period_map_find_matrix(s->map) : st;
}

static hc_status shoot_jacobian(void *self, const double *z, double *jac)
{
  shoot *s = self;
  hc_status st = find_matrix(s, z);
  if (st == HC_OK) period_map_jacobian(s->map, jac);
  return st;
}

/* Anderson's map u -> F^k(u). Out of memory is told as a fixed point, at which KINSOL ends: SUNDIALS 7 crashes where it
 * has no memory to tell of a failure (room.h). */
static int anderson_map(N_Vector u, N_Vector f, void *self)
{
  shoot *s = self;
  const size_t bytes = sizeof(double) * (size_t)s->n;
  if (s->refusal != HC_NO_MEMORY) s->refusal = period_map_at(s->map, NV_DATA_S(u), PERIODS_ALONE);
  memcpy(NV_DATA_S(f), s->refusal == HC_NO_MEMORY ? NV_DATA_S(u) : s->map->f, bytes);
  return s->refusal == HC_OK || s->refusal == HC_NO_MEMORY ? 0 : 1;
}

/* ---- made and freed ------------------------------------------------------------------------------------ */

static hc_status make_anderson(shoot *s)
{
  if (hc_sundials_context(&s->ctx)) return HC_NO_MEMORY;
  s->u = vectors_new(s->n, s->ctx);
  s->weights = vectors_new(s->n, s->ctx);
  s->kin = s->u && s->weights ? KINCreate(s->ctx) : NULL;
  if (!s->kin || !hc_room_for(0)) return HC_NO_MEMORY;
  int bad = HC_KINSOL_QUIET(s->kin);
  bad |= KINSetUserData(s->kin, s);
  bad |= KINSetNumMaxIters(s->kin, ANDERSON_ITERATIONS);
  bad |= KINSetMAA(s->kin, ANDERSON_DEPTH < s->n ? ANDERSON_DEPTH : s->n); /* before KINInit, which makes room for it */
  bad |= KINInit(s->kin, anderson_map, s->u);
  return bad ? HC_NO_MEMORY : HC_OK;
}

hc_status shoot_new(timeint *ti, shoot **out)
{
  *out = NULL;
  shoot *s = calloc(1, sizeof *s); /* zeroed, so free works half-built */
  if (!s) return HC_NO_MEMORY;
  s->ti = ti;
  s->map = ti->map;
  s->n = ti->n;
  double **const vectors[] = {&s->best, &s->weight, &s->vector, &s->other, &s->found.from, &s->found.at};
  const size_t n = (size_t)s->n;
  workspace *w = &s->memory;
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; ++i) *vectors[i] = workspace_doubles(w, n);
  s->multipliers = workspace_array(w, n, sizeof *s->multipliers);
  s->active = workspace_array(w, n, sizeof *s->active);
  const newton_problem problem = {.n = s->n, .self = s, .residual = shoot_residual, .jacobian = shoot_jacobian};
  hc_status st = w->failed ? HC_NO_MEMORY : newton_new(&problem, &s->newton);
  if (st == HC_OK) st = floquet_new(s->n, &s->floquet);
  if (st == HC_OK) st = make_anderson(s);
  if (st == HC_OK) *out = s;
  else shoot_free(s);
  return st;
}

void shoot_free(shoot *s)
{
  if (!s) return;
  newton_free(s->newton);
  floquet_free(s->floquet);
  if (s->kin) KINFree(&s->kin);
  if (s->u) N_VDestroy(s->u);
  if (s->weights) N_VDestroy(s->weights);
  if (s->ctx) SUNContext_Free(&s->ctx);
  workspace_free(&s->memory);
  free(s);
}

/* ---- what is known of an orbit -------------------------------------------------------------------------- */

/* |F^k(z0) - z* - Phi (z0 - z*)| / |z0 - z*|, z* = z. */
static double nonlinear_part(const shoot *s, const double *z)
{
  const period_map *map = s->map;
  const int n = s->n;
  double *e = s->vector, *rest = s->other;
  for (int i = 0; i < n; ++i) e[i] = map->before[i] - z[i];
  for (int i = 0; i < n; ++i) {
    rest[i] = map->first[i] - map->f[i]; /* F(z*) is z*, and nearer to F(z0)'s own errors */
    for (int j = 0; j < n; ++j) rest[i] -= map->phi[i + j * n] * e[j];
  }
  const double size = timeint_norm(s->ti, e), rounding = both_scatter * s->ti->tolerance;
  return size > rounding ? fmax(timeint_norm(s->ti, rest) - rounding, 0) / size : 0;
}

/* The states in s->active[m] without those whose column of Phi is rounding: their multiplier is 0. How many remain. */
static int drop_negligible_columns(shoot *s, int m)
{
  const double *phi = s->map->phi;
  int kept = 0;
  double largest = 0;
  for (int i = 0; i < s->n * s->n; ++i) largest = fmax(largest, fabs(phi[i]));
  for (int a = 0; a < m; ++a) {
    const double *column = phi + (size_t)s->active[a] * (size_t)s->n;
    double size = 0;
    for (int i = 0; i < s->n; ++i) size = fmax(size, fabs(column[i]));
    if (size > DBL_EPSILON * largest) s->active[kept++] = s->active[a];
  }
  return kept;
}

/* Sliders that the law ties to X leave columns of some 1e-20 with the regularised law. The QR iteration may fail to
 * converge on many of these; it is then repeated without them. */
static hc_status find_multiplier(shoot *s, shoot_report *r)
{
  const int moving = 2 * s->ti->n_dof;
  int m = 0;
  r->free_sliders = 0;
  for (int i = 0; i < s->n; ++i) {
    const scaled_contact *c = &s->ti->scaled.contact[i < moving ? 0 : i - moving];
    if (!period_map_is_free(s->map, i)) s->active[m++] = i;
    else r->free_sliders += c->law.has_friction && c->direction == 0;
  }
  hc_status st = floquet_multipliers(s->floquet, s->map->phi, 1, s->n, m, s->active, s->multipliers);
  if (st == HC_NOT_CONVERGED) {
    m = drop_negligible_columns(s, m);
    st = floquet_multipliers(s->floquet, s->map->phi, 1, s->n, m, s->active, s->multipliers);
  }
  r->multiplier = st == HC_OK ? floquet_largest(m, s->multipliers) : NAN;
  return st;
}

/* An orbit on the edge of slip, where F has one derivative on either side: Phi becomes that of the side that sticks,
 * whichever rounding chose. Sliders that slip by rounding are moved on by that and EDGE_SCATTERS times what periods
 * scatter, as are those that slip then; where one that was moved slips again, no side is known, and Phi stays. A
 * borrowed matrix is of that side already. */
static hc_status take_side_that_sticks(shoot *s)
{
  period_map *map = s->map;
  const double rests = MEASURE_RESTS * timeint_scaled_size(s->ti);
  double *z = s->vector, *travel = s->other; /* of s->best */
  bool slips = !period_map_borrows(map);
  memcpy(z, s->best, sizeof *z * (size_t)s->n);
  memcpy(travel, map->travel, sizeof *z * (size_t)s->n);
  while (slips) {
    slips = false;
    for (int i = 2 * s->ti->n_dof; i < s->n; ++i) {
      const double size = s->ti->sizes.of[i];
      if (!(travel[i] <= rests * size && map->travel[i] > 0)) continue;
      if (z[i] != s->best[i]) return period_map_at(map, s->best, PERIODS_MATRIX);
      z[i] += copysign(map->travel[i] + EDGE_SCATTERS * period_map_scatter(map) * size, map->f[i] - z[i]);
      slips = true;
    }
    const hc_status st = slips ? period_map_at(map, z, PERIODS_MATRIX) : HC_OK;
    if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) return st;
    if (st != HC_OK) return period_map_at(map, s->best, PERIODS_MATRIX);
  }
  return HC_OK;
}

/* From map->iterate, next to the orbit: further Newton steps until it is as near as the goal asks or the scatter of
 * periods allows; ti->y and *r are then those of the nearest point. */
static hc_status shoot_finish(shoot *s, double goal, shoot_report *r)
{
  const size_t bytes = sizeof *s->best * (size_t)s->n;
  period_map *map = s->map;
  double *z = map->iterate;
  hc_status st = period_map_at(map, z, PERIODS_MATRIX); /* as a rule the orbit, and its matrix the last */
  for (int tries = 0; tries < LAST_STEPS && st == HC_OK; ++tries) {
    st = find_matrix(s, z);
    if (st == HC_OK) st = period_map_factor(map);
    if (st != HC_OK) break;
    const double length = period_map_step(map, z, map->f);
    if (length < r->distance) memcpy(s->best, z, bytes), r->distance = length;
    if (r->distance <= goal) break;
    for (int i = 0; i < s->n; ++i) z[i] -= map->step[i];
  }
  if (st == HC_OK && !(r->distance < INFINITY)) st = HC_NOT_CONVERGED;
  if (st == HC_OK) st = period_map_at(map, s->best, PERIODS_MATRIX);
  if (st == HC_OK) st = period_map_find_matrix(map);
  if (st != HC_OK) return st;
  const bool asked = !(period_map_borrows(map) && s->ti->no_multipliers);
  r->moved = timeint_distance(s->ti, map->before, s->best);
  r->nonlinear = nonlinear_part(s, s->best);
  st = take_side_that_sticks(s);
  if (st == HC_OK && asked) st = find_multiplier(s, r);
  if (st != HC_OK) return st;
  memcpy(s->ti->y, s->best, bytes);
  st = period_map_attainable(map, &r->attainable);
  return r->distance <= fmax(goal, r->attainable) ? st : HC_NOT_CONVERGED;
}

/* ---- the search ------------------------------------------------------------------------------------------ */

static void shoot_begin(shoot *s, int k, const hc_monitor *monitor, shoot_report *report)
{
  period_map_begin(s->map, k, monitor);
  for (int i = 0; i < s->n; ++i) s->weight[i] = 1 / s->ti->sizes.of[i];
  s->found.k = 0;
  *report = (shoot_report){.distance = INFINITY, .moved = INFINITY, .nonlinear = INFINITY, .multiplier = NAN};
}

/* The residual at which Newton stops. A residual r is a distance of about r/(1 - rho) from the orbit: hence a share
 * of the goal times 1 - rho, but no less than the scatter of periods. shoot_finish() judges the point it comes to. */
static double small_residual(const shoot *s, double goal)
{
  return fmax(SHOOT_SHARE_OF_GOAL * goal * (1 - fmin(s->ti->contraction, 1)), period_map_scatter(s->map));
}

/* True if the search that begins at ti->y is the one that found s->found. */
static bool is_found(const shoot *s, int k)
{
  const timeint *ti = s->ti;
  return s->found.k == k && s->found.omega == ti->omega && s->found.length == ti->length &&
         !memcmp(s->found.from, ti->y, sizeof *ti->y * (size_t)s->n);
}

static void note_found(shoot *s, const shoot_report *report)
{
  const size_t bytes = sizeof *s->best * (size_t)s->n;
  s->found.report = *report;
  memcpy(s->found.from, s->map->before, bytes);
  memcpy(s->found.at, s->best, bytes);
  s->found.omega = s->ti->omega;
  s->found.length = s->ti->length;
  s->found.k = s->map->k;
}

/* What became of the search: *report, and ti->y where it is to be. */
static hc_status conclude(shoot *s, hc_status st, double goal, shoot_report *report)
{
  if (st == HC_OK) st = shoot_finish(s, goal, report);
  TRACE(steady, "omega %.9g: orbit of %d periods, %.3g from the start: multiplier %.6g, closure %.3g: %s", s->ti->omega,
        s->map->k, report->moved / s->ti->length, cabs(report->multiplier), report->distance / s->ti->length,
        hc_status_text(st));
  if (st != HC_OK) memcpy(s->ti->y, s->map->before, sizeof *s->best * (size_t)s->n);
  return st;
}

/* ---- chord steps -------------------------------------------------------------------------------------------
 *
 * To the orbit of a large structure in closed form, or with modes slowed: Newton's steps with a borrowed matrix
 * (period_map.h), kept as long as they contract. A plain period costs 1/25 to 1/150 of a matrix. The whole structure
 * begins with the orbit of the slowed one, whose periods cost a fifth. */

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

/* map->iterate, from ti->y, to where |z - F^k(z)| <= enough [L] or the orbit is no farther than goal [L], by steps no
 * longer than `reach` [L]. HC_NOT_CONVERGED if steps do not contract with new matrices either; HC_NOT_FINITE; errors of
 * period_map_at and period_map_borrow. */
static hc_status chords_to_orbit(period_map *map, double reach, double enough, double goal)
{
  const hc_status st = map->ti->slowed && !starts_next_to(map) ? begin_with_slowed(map, reach, enough) : HC_OK;
  return st == HC_OK ? by_chords(map, reach, enough, SHOOT_SHARE_OF_GOAL * goal) : st;
}

/* ---- Newton and Anderson ------------------------------------------------------------------------------- */

hc_status shoot_newton(shoot *s, int k, double reach, double goal, const hc_monitor *monitor, shoot_report *report)
{
  period_map *map = s->map;
  newton_report iterations;
  if (is_found(s, k) && s->found.report.distance <= goal && cabs(s->found.report.multiplier) < 1) {
    memcpy(s->ti->y, s->found.at, sizeof *s->found.at * (size_t)s->n);
    *report = s->found.report;
    return HC_OK;
  }
  shoot_begin(s, k, monitor, report);
  const bool coarse = period_map_has_coarse(map);
  const newton_options options = {.z_scale = s->weight,
                                  .r_scale = s->weight,
                                  .tolerance = small_residual(s, goal),
                                  .max_step = reach,
                                  .max_iterations = coarse ? KEPT_ITERATIONS : NEWTON_ITERATIONS,
                                  .keeps = coarse ? matrix_keeps : 0};
  hc_status st = period_map_borrows(map) ? chords_to_orbit(map, reach, options.tolerance, goal)
                                         : newton_solve(s->newton, map->iterate, &options, &iterations);
  st = conclude(s, st, goal, report);
  if (st == HC_OK && s->ti->slowed) note_found(s, report);
  return st;
}

hc_status shoot_anderson(shoot *s, int k, double goal, const hc_monitor *monitor, shoot_report *report)
{
  const size_t bytes = sizeof *s->best * (size_t)s->n;
  shoot_begin(s, k, monitor, report);
  s->refusal = HC_OK;
  if (KINSetFuncNormTol(s->kin, small_residual(s, goal)) != KIN_SUCCESS) return HC_NOT_FINITE;
  memcpy(NV_DATA_S(s->u), s->map->before, bytes);
  memcpy(NV_DATA_S(s->weights), s->weight, bytes);
  int flag = KINSol(s->kin, s->u, KIN_FP, s->weights, s->weights);
  memcpy(s->map->iterate, NV_DATA_S(s->u), bytes);
  if (s->refusal != HC_OK) return s->refusal;
  if (flag == KIN_MEM_FAIL) return HC_NO_MEMORY;
  return conclude(s, HC_OK, goal, report); /* whatever KINSOL says: shoot_finish() judges the iterate itself */
}

void shoot_direction(shoot *s, double *z)
{
  const period_map *map = s->map;
  double *next = s->vector;
  for (int i = 0; i < s->n; ++i) z[i] = s->ti->sizes.of[i] / sqrt(s->n);
  for (int step = 0; step < DIRECTION_STEPS; ++step) {
    for (int i = 0; i < s->n; ++i) {
      next[i] = 0;
      for (int j = 0; j < s->n; ++j) next[i] += (period_map_is_free(map, i) ? 0 : map->phi[i + j * s->n]) * z[j];
    }
    double size = timeint_norm(s->ti, next);
    if (!(size > 0)) return;
    for (int i = 0; i < s->n; ++i) z[i] = next[i] / size;
  }
}
