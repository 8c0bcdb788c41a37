/* period_map.h - the states of a structure a forcing period later, by Taylor polynomials between located changes of its
 * contacts, and the multipliers of an orbit by differences of that map: for tests that hold Floquet multipliers of
 * harmonic balance against it.
 *
 *     M x'' + C x' + K x + sum_j t_j T_j + n_j (N_j - N0_j) = f(t)
 *
 * f is what makes the given motion, which harmonic balance has truncated, an exact solution: the left-hand side at it.
 * Its multipliers are then those along the given motion, whatever the number of harmonics. */
#pragma once

#include "tests/hbm/full_equations.h"
#include "tests/hbm/multipliers.h"

enum { MAP_MAX_DOFS = 4, MAP_MAX_CONTACTS = 4, MAP_MAX_STATES = 2 * MAP_MAX_DOFS + MAP_MAX_CONTACTS };

typedef struct period_map {
  full_motion f;                              /* the orbit */
  marched orbit[MAP_MAX_CONTACTS];            /* its contacts at t = 0, settled */
  double inverse[MAP_MAX_DOFS][MAP_MAX_DOFS]; /* of M */
  int n_states, slider[MAP_MAX_CONTACTS]; /* states: x, x', w of the contacts that are stuck at t = 0; -1: not one */
  double size[MAP_MAX_STATES];            /* what each state is measured by */
} period_map;

/* x and x' of the motion, and its contacts: one side of the two that are marched together. */
typedef struct map_side {
  double x[MAP_MAX_DOFS][TAYLOR + 1], u[MAP_MAX_CONTACTS][TAYLOR + 1], v[MAP_MAX_CONTACTS][TAYLOR + 1];
  marched contact[MAP_MAX_CONTACTS];
} map_side;

static inline void map_invert_mass(period_map *p)
{
  const model *m = p->f.m;
  const int n = m->n;
  double A[MAP_MAX_DOFS][2 * MAP_MAX_DOFS] = {{0}};
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) A[i][k] = m->mass[k * n + i], A[i][n + k] = i == k;
  for (int k = 0; k < n; ++k) /* Gauss and Jordan without pivots: M is positive definite */
    for (int i = 0; i < n; ++i) {
      const double factor = i == k ? 1 - 1 / A[k][k] : A[i][k] / A[k][k];
      for (int j = 2 * n - 1; j >= k; --j) A[i][j] -= factor * A[k][j];
    }
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) p->inverse[i][k] = A[i][n + k];
}

/* Coefficients of u and v up to order k, of force number i of order k: C x' + K x + contacts. */
static inline void map_forces(const model *m, map_side *side, int k, double *force)
{
  const int n = m->n;
  for (int i = 0; i < n; ++i) {
    force[i] = 0;
    for (int q = 0; q < n; ++q)
      force[i] += m->damping[q * n + i] * (k + 1) * side->x[q][k + 1] + m->stiffness[q * n + i] * side->x[q][k];
  }
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    double u = 0, v = 0, T, N;
    for (int q = 0; q < n; ++q) u += c->tangent[q] * side->x[q][k], v += c->normal[q] * side->x[q][k];
    side->u[j][k] = u, side->v[j][k] = v;
    marched_force(&side->contact[j], k, u, v, &N, &T);
    for (int i = 0; i < n; ++i) force[i] += c->tangent[i] * T + c->normal[i] * N;
  }
}

/* The polynomials of both sides from t on; those of the second follow from its x[.][0] and x[.][1]. The last two
 * coefficients of x stay 0, and those of u and v too. */
static inline void map_polynomials(const period_map *p, double t, map_side *orbit, map_side *side)
{
  const model *m = p->f.m;
  const int n = m->n;
  for (int i = 0; i < n; ++i) {
    taylor_of_series(p->f.n_harm, p->f.x[i], p->f.omega, t, orbit->x[i]);
    memset(&side->x[i][2], 0, (TAYLOR - 1) * sizeof side->x[i][2]);
  }
  for (int k = 0; k + 2 <= TAYLOR; ++k) {
    double given[MAP_MAX_DOFS], force[MAP_MAX_DOFS];
    map_forces(m, orbit, k, given);
    map_forces(m, side, k, force);
    for (int i = 0; i < n; ++i) {
      double pull = 0;
      for (int q = 0; q < n; ++q) pull += p->inverse[i][q] * (given[q] - force[q]);
      side->x[i][k + 2] = orbit->x[i][k + 2] + pull / ((k + 1) * (k + 2));
    }
  }
  for (int k = TAYLOR - 1; k <= TAYLOR; ++k) {
    double unused[MAP_MAX_DOFS];
    if (k < TAYLOR) map_forces(m, orbit, k, unused), map_forces(m, side, k, unused);
    else
      for (int j = 0; j < m->n_contacts; ++j) orbit->u[j][k] = orbit->v[j][k] = side->u[j][k] = side->v[j][k] = 0;
  }
}

/* The first change of any contact of a side within h: when, of which contact (-1: none) and which of its guards. */
typedef struct map_change {
  double at;
  int contact, which;
} map_change;

static inline map_change map_first_change(const model *m, const map_side *side, double h)
{
  map_change first = {.at = h, .contact = -1};
  for (int j = 0; j < m->n_contacts; ++j) {
    int which;
    const double at = marched_first_change(&side->contact[j], side->u[j], side->v[j], h, &which);
    if (which >= 0 && at <= first.at) first = (map_change){at, j, which};
  }
  return first;
}

static inline void map_apply(const map_change *change, map_side *side, double s)
{
  const int j = change->contact;
  if (j >= 0) marched_change(&side->contact[j], side->u[j], side->v[j], s, change->which);
}

/* Advance to the first change, or by h; how far. Changes of the two sides nearer to each other than rounding tells are
 * made together. */
static inline double map_step(const period_map *p, double t, double h, map_side *orbit, map_side *side)
{
  const model *m = p->f.m;
  const double together = 1e-13 / p->f.omega, some = 1e-9 / p->f.omega;
  map_polynomials(p, t, orbit, side);
  const map_change of_orbit = map_first_change(m, orbit, h), of_side = map_first_change(m, side, h);
  const double s = fmin(of_orbit.at, of_side.at);
  for (int j = 0; j < m->n_contacts && s > some; ++j) orbit->contact[j].changed = side->contact[j].changed = false;
  if (of_orbit.at <= s + together) map_apply(&of_orbit, orbit, s);
  if (of_side.at <= s + together) map_apply(&of_side, side, s);
  for (int i = 0; i < m->n; ++i) {
    const double x = taylor_at(side->x[i], s), dx = taylor_slope(side->x[i], s);
    side->x[i][0] = x, side->x[i][1] = dx;
  }
  return of_orbit.contact >= 0 || of_side.contact >= 0 ? s : INFINITY;
}

/* end[n_states] of the states y[n_states] a period later. */
static inline void map_period(const period_map *p, const double *y, double *end)
{
  const model *m = p->f.m;
  const int n = m->n, steps = FULL_STEPS + 8 * p->f.n_harm;
  const double period = TWO_PI / p->f.omega;
  static map_side orbit, side;
  memset(&orbit, 0, sizeof orbit);
  memset(&side, 0, sizeof side);
  for (int i = 0; i < n; ++i) side.x[i][0] = y[i], side.x[i][1] = y[n + i];
  for (int j = 0; j < m->n_contacts; ++j) {
    orbit.contact[j] = side.contact[j] = p->orbit[j];
    if (p->slider[j] >= 0) side.contact[j].w = y[p->slider[j]];
  }
  for (int k = 0, taken = 0; k < steps; ++k) {
    double t = period * k / steps;
    const double until = period * (k + 1) / steps;
    while (t < until) {
      t = fmin(until, t + map_step(p, t, until - t, &orbit, &side));
      assert_true(++taken < 20 * steps);
    }
  }
  for (int i = 0; i < n; ++i) end[i] = side.x[i][0], end[n + i] = side.x[i][1];
  for (int j = 0; j < m->n_contacts; ++j) {
    if (p->slider[j] < 0) continue;
    double u = 0, v = 0;
    for (int i = 0; i < n; ++i) {
      u += m->contacts[j].tangent[i] * side.x[i][0];
      v += m->contacts[j].normal[i] * side.x[i][0];
    }
    end[p->slider[j]] = marched_slider(&side.contact[j], u, v);
  }
}

/* The states of the orbit at t = 0 into start; *p made ready for p->f. A slider that is stuck all period but for
 * 1e-6 rad, as after a shakedown, where the orbit is the last of a family, is taken to be stuck for good: there the
 * map has but one-sided derivatives. Its own multiplier 1 is left out (hbm/stability/monodromy.h). */
static inline void map_settle(period_map *p, double *start)
{
  const model *m = p->f.m;
  const int n = m->n;
  double T[FULL_MAX_LENGTH], N[FULL_MAX_LENGTH], most = 0;
  assert_true(n <= MAP_MAX_DOFS && m->n_contacts <= MAP_MAX_CONTACTS);
  map_invert_mass(p);
  for (int i = 0; i < n; ++i) {
    double x[TAYLOR + 1];
    taylor_of_series(p->f.n_harm, p->f.x[i], p->f.omega, 0, x);
    start[i] = x[0], start[n + i] = x[1];
    for (int k = 0; k <= 2 * p->f.n_harm; ++k) most = fmax(most, fabs(p->f.x[i][k]));
  }
  p->n_states = 2 * n;
  for (int j = 0; j < m->n_contacts; ++j) {
    march_contact(&p->f, j, &p->orbit[j], T, N);
    p->slider[j] = -1;
    if (!marched_has_tangent(&p->orbit[j].law)) continue;
    p->orbit[j].never = p->orbit[j].loose * p->f.omega < 1e-6;
    if (p->orbit[j].never) p->orbit[j].state = STUCK;
    if (p->orbit[j].state != STUCK || p->orbit[j].never) continue;
    start[p->n_states] = p->orbit[j].w;
    p->slider[j] = p->n_states++;
  }
  for (int q = 0; q < p->n_states; ++q) p->size[q] = most * (q >= n && q < 2 * n ? p->f.omega : 1);
}

/* lambda[n_states] of the map at start: central differences of e and 2 e of each state's size, extrapolated, are good
 * to e^4 times third to fifth derivatives of a map that is smooth while the order of changes stays. */
static inline void map_multipliers(const period_map *p, const double *start, double e, double complex *lambda)
{
  const int n = p->n_states;
  double A[MAP_MAX_STATES * MAP_MAX_STATES];
  for (int q = 0; q < n; ++q) {
    double d[2][MAP_MAX_STATES];
    for (int k = 0; k < 2; ++k) {
      double y[MAP_MAX_STATES], plus[MAP_MAX_STATES], minus[MAP_MAX_STATES];
      const double step = ldexp(e, k) * p->size[q];
      memcpy(y, start, sizeof y);
      y[q] = start[q] + step;
      map_period(p, y, plus);
      y[q] = start[q] - step;
      map_period(p, y, minus);
      for (int i = 0; i < n; ++i) d[k][i] = (plus[i] - minus[i]) / (2 * step);
    }
    for (int i = 0; i < n; ++i) A[i * n + q] = (4 * d[0][i] - d[1][i]) / 3;
  }
  eigenvalues_of(n, A, lambda);
}

/* lambda[] of the map along the solution X, which it has to bring back; how many. Differences by 1e-5 of the state's
 * size are good to rounding over 1e-5, 1e-10 or so, and multipliers to what the monodromy's condition makes of that:
 * 3e-9 is seen. */
static inline int multipliers_of_map(const char *name, hbm_solver *s, const model *m, double omega, const double *X,
                                     double complex *lambda)
{
  static period_map p;
  double start[MAP_MAX_STATES] = {0}, end[MAP_MAX_STATES];
  p.f = (full_motion){.m = m, .n_harm = hbm_n_harmonics(s), .omega = omega};
  for (int i = 0; i < m->n; ++i) assert_int_equal(hbm_response(s, omega, X, i, p.f.x[i]), HC_OK);
  map_settle(&p, start);
  map_period(&p, start, end);
  for (int q = 0; q < p.n_states; ++q)
    CHECK_NEAR(end[q], start[q], 1e-12 * p.size[q], "%s at %g: state %d comes back", name, omega, q);
  map_multipliers(&p, start, 1e-5, lambda);
  return p.n_states;
}

static inline void check_against_map(const char *name, hbm_solver *s, const model *m, double omega, const double *X)
{
  double complex lambda[MAP_MAX_STATES];
  const int n = multipliers_of_map(name, s, m, omega, X, lambda);
  check_multipliers(name, s, omega, X, n, lambda);
}
