/* test_circle_stability.c - Floquet multipliers of structures with circles against differences of a period map that the
 * test marches itself, by the law as model/circle_law.h states it and the method of Runge and Kutta between located
 * changes; nothing of hbm/'s evaluators is used.
 *
 *     M x'' + C x' + K x + t_1 T_1 + t_2 T_2 + n (N - N0) = f(t)
 *
 * f makes the given motion, which harmonic balance has truncated, an exact solution, as in period_map.h. M = 1. */

#include "base/constants.h"
#include "tests/hbm/multipliers.h"
#include "tests/hbm/structure_cases.h"

enum { H = 7, DOFS = 3, MOST_STATES = 2 * DOFS + 2, STEPS = 4000 };

typedef enum mode { APART, STICKS, SLIPS } mode;

/* A contact with its structure: y = (x, x', phi). */
typedef struct side {
  mode mode;
  double w[2], y[2 * DOFS + 1];
} side;

typedef struct map {
  const model *m;
  double omega, x[DOFS][2 * H + 1]; /* the orbit */
  side orbit;                       /* at t = 0 */
  int n_states;                     /* x, x', then w or y = R d phi of the slider */
} map;

static double dot(int n, const double *a, const double *b)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

/* u, u', N, N' of a motion. */
typedef struct contact_motion {
  double u[2], du[2], R, dR, v;
} contact_motion;

static contact_motion motion_of(const model *m, const double *y)
{
  const model_contact *c = m->contacts;
  const int n = m->n;
  contact_motion o = {.v = dot(n, c->normal, y)};
  const double dv = dot(n, c->normal, y + n);
  for (int d = 0; d < 2; ++d) o.u[d] = dot(n, c[d].tangent, y), o.du[d] = dot(n, c[d].tangent, y + n);
  o.R = c->law.mu * (c->law.kn * (o.v + c->law.gap) + c->law.load) / c->law.kt;
  o.dR = c->law.mu * c->law.kn * dv / c->law.kt;
  return o;
}

/* Contact forces on x. */
static void contact_force(const model *m, const side *s, const double *y, double *force)
{
  const model_contact *c = m->contacts;
  const contact_motion o = motion_of(m, y);
  const double phi = y[2 * m->n], kt = c->law.kt;
  double T[2] = {0}, N = 0;
  if (s->mode == STICKS) T[0] = kt * (o.u[0] - s->w[0]), T[1] = kt * (o.u[1] - s->w[1]);
  if (s->mode == SLIPS) T[0] = kt * o.R * cos(phi), T[1] = kt * o.R * sin(phi);
  if (s->mode != APART) N = 2 * (c->law.kn * (o.v + c->law.gap) + c->law.load);
  for (int i = 0; i < m->n; ++i) force[i] = c[0].tangent[i] * T[0] + c[1].tangent[i] * T[1] + c->normal[i] * N;
}

/* The orbit at t: x, x', x''. */
static void orbit_at(const map *p, double t, double *y, double *acceleration)
{
  for (int i = 0; i < p->m->n; ++i) {
    y[i] = p->x[i][0], y[p->m->n + i] = acceleration[i] = 0;
    for (int h = 1; h <= H; ++h) {
      const double a = p->x[i][2 * h - 1], b = p->x[i][2 * h], w = h * p->omega, c = cos(w * t), s = sin(w * t);
      y[i] += a * c + b * s;
      y[p->m->n + i] += w * (b * c - a * s);
      acceleration[i] -= w * w * (a * c + b * s);
    }
  }
}

/* phi' = u'.e_perp/R; where slip begins at touch-down, that of the branch which is regular there. */
static double turning(const model *m, const side *s, const double *y, const double *acceleration)
{
  const contact_motion o = motion_of(m, y);
  const double phi = y[2 * m->n], c = cos(phi), sn = sin(phi);
  if (s->mode != SLIPS) return 0;
  if (o.R > 1e-12) return (o.du[1] * c - o.du[0] * sn) / o.R;
  double ddu[2];
  for (int d = 0; d < 2; ++d) ddu[d] = dot(m->n, m->contacts[d].tangent, acceleration);
  return (ddu[1] * c - ddu[0] * sn) / (hypot(o.du[0], o.du[1]) + o.dR);
}

/* Both sides' derivatives: the orbit's phi, and all of the other. */
static void slopes(const map *p, double t, const side *orbit, const side *other, double phi, const double *y,
                   double *d_phi, double *dy)
{
  const model *m = p->m;
  const int n = m->n;
  double given[2 * DOFS + 1], acceleration[DOFS], of_orbit[DOFS], of_other[DOFS];
  orbit_at(p, t, given, acceleration);
  given[2 * n] = phi;
  contact_force(m, orbit, given, of_orbit);
  contact_force(m, other, y, of_other);
  *d_phi = turning(m, orbit, given, acceleration);
  for (int i = 0; i < n; ++i) {
    dy[i] = y[n + i];
    dy[n + i] = acceleration[i] + of_orbit[i] - of_other[i];
    for (int q = 0; q < n; ++q)
      dy[n + i] += m->stiffness[q * n + i] * (given[q] - y[q]) + m->damping[q * n + i] * (given[n + q] - y[n + q]);
  }
  dy[2 * n] = turning(m, other, y, dy + n);
}

/* Both sides after a step h. */
static void runge_kutta(const map *p, double t, double h, const side *orbit, const side *other, side *orbit_after,
                        side *other_after)
{
  static const double at[4] = {0, 0.5, 0.5, 1}, weight[4] = {1 / 6.0, 1 / 3.0, 1 / 3.0, 1 / 6.0};
  const int n = 2 * p->m->n;
  double k[2 * DOFS + 1] = {0}, k_phi = 0, unused[DOFS];
  side o = *orbit, s = *other;
  for (int stage = 0; stage < 4; ++stage) {
    double y[2 * DOFS + 1];
    for (int i = 0; i <= n; ++i) y[i] = other->y[i] + at[stage] * h * k[i];
    slopes(p, t + at[stage] * h, orbit, other, orbit->y[n] + at[stage] * h * k_phi, y, &k_phi, k);
    for (int i = 0; i <= n; ++i) s.y[i] += weight[stage] * h * k[i];
    o.y[n] += weight[stage] * h * k_phi;
  }
  orbit_at(p, t + h, o.y, unused);
  *orbit_after = o, *other_after = s;
}

/* What falls below 0 where the state changes. */
static double guard(const model *m, const side *s)
{
  const contact_motion o = motion_of(m, s->y);
  const double lift = m->contacts->law.kn > 0 ? o.R : INFINITY, phi = s->y[2 * m->n];
  if (s->mode == APART) return -o.R;
  if (s->mode == STICKS) return fmin(lift, o.R - hypot(o.u[0] - s->w[0], o.u[1] - s->w[1]));
  return fmin(lift, (o.du[0] * cos(phi) + o.du[1] * sin(phi) - o.dR) * 1e-3);
}

static void change(const model *m, side *s)
{
  const contact_motion o = motion_of(m, s->y);
  const int phi = 2 * m->n;
  if (s->mode == APART) {
    s->mode = hypot(o.du[0], o.du[1]) > o.dR ? SLIPS : STICKS;
    s->w[0] = o.u[0], s->w[1] = o.u[1];
    s->y[phi] = atan2(o.du[1], o.du[0]);
  } else if (m->contacts->law.kn > 0 && o.R <= 1e-11) s->mode = APART;
  else if (s->mode == STICKS) {
    s->mode = SLIPS;
    s->y[phi] = atan2(o.u[1] - s->w[1], o.u[0] - s->w[0]);
  } else {
    s->mode = STICKS;
    s->w[0] = o.u[0] - o.R * cos(s->y[phi]), s->w[1] = o.u[1] - o.R * sin(s->y[phi]);
  }
}

/* Slip's equation is stiff where R is small: steps by which R changes by a fifth at most, but for the last 1e-7 of the
 * period. */
static double allowed(const map *p, const side *s, double h)
{
  const contact_motion o = motion_of(p->m, s->y);
  const double least = 1e-7 * TWO_PI / p->omega, rate = hypot(o.du[0], o.du[1]) + fabs(o.dR);
  return s->mode == SLIPS ? fmin(h, fmax(least, 0.2 * o.R / rate)) : h;
}

/* One step, or up to the first change of either side, bisected to rounding; how far. */
static double step(const map *p, double t, double h, side *orbit, side *other)
{
  side a, b;
  h = allowed(p, orbit, allowed(p, other, h));
  runge_kutta(p, t, h, orbit, other, &a, &b);
  if (guard(p->m, &a) >= 0 && guard(p->m, &b) >= 0) {
    *orbit = a, *other = b;
    return h;
  }
  double low = 0, high = h;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    runge_kutta(p, t, middle, orbit, other, &a, &b);
    if (guard(p->m, &a) >= 0 && guard(p->m, &b) >= 0) low = middle;
    else high = middle;
  }
  runge_kutta(p, t, high, orbit, other, &a, &b);
  *orbit = a, *other = b;
  if (!(guard(p->m, orbit) >= 0)) change(p->m, orbit);
  if (!(guard(p->m, other) >= 0)) change(p->m, other);
  return high;
}

/* `other` a period later; *orbit too. */
static void follow(const map *p, side *orbit, side *other)
{
  const double period = TWO_PI / p->omega;
  for (int k = 0; k < STEPS; ++k)
    for (double t = period * k / STEPS; t < period * (k + 1) / STEPS;)
      t += fmax(1e-15 * period, step(p, t, period * (k + 1) / STEPS - t, orbit, other));
}

/* The states of a side: x, x', and the slider by w; and back. */
static void states_of(const map *p, const side *s, double *q)
{
  const contact_motion o = motion_of(p->m, s->y);
  const double phi = s->y[2 * p->m->n];
  memcpy(q, s->y, 2 * (size_t)p->m->n * sizeof *q);
  for (int d = 0; d < 2; ++d)
    q[2 * p->m->n + d] = s->mode == STICKS ? s->w[d] : s->mode == SLIPS ? o.u[d] - o.R * (d ? sin(phi) : cos(phi)) : 0;
}

static side side_of(const map *p, const double *q)
{
  side s = p->orbit;
  memcpy(s.y, q, 2 * (size_t)p->m->n * sizeof *q);
  const contact_motion o = motion_of(p->m, s.y);
  if (s.mode == STICKS) s.w[0] = q[2 * p->m->n], s.w[1] = q[2 * p->m->n + 1];
  if (s.mode == SLIPS) s.y[2 * p->m->n] = atan2(o.u[1] - q[2 * p->m->n + 1], o.u[0] - q[2 * p->m->n]);
  return s;
}

/* The orbit's contact at t = 0, from apart or from rest at w = 0 and put into the circle, after some periods. */
static void settle(map *p)
{
  double unused[DOFS];
  side s = {.mode = APART};
  orbit_at(p, 0, s.y, unused);
  contact_motion o = motion_of(p->m, s.y);
  if (o.R > 0) {
    s.mode = STICKS;
    const double length = hypot(o.u[0], o.u[1]);
    for (int d = 0; d < 2 && length > o.R; ++d) s.w[d] = o.u[d] * (1 - o.R / length);
  }
  side copy = s;
  for (int k = 0; k < 12; ++k) copy = s, follow(p, &s, &copy);
  p->orbit = s;
  p->n_states = 2 * p->m->n + (s.mode == APART ? 0 : 2);
}

/* lambda[n_states] by central differences of e and 2 e of the states' size, extrapolated. */
static void map_multipliers(const map *p, double complex *lambda)
{
  const int n = p->n_states;
  double A[MOST_STATES * MOST_STATES], start[MOST_STATES], most = 0;
  const double e = 1e-4;
  states_of(p, &p->orbit, start);
  for (int i = 0; i < p->m->n; ++i) most = fmax(most, hypot(p->x[i][1], p->x[i][2]));
  for (int q = 0; q < n; ++q) {
    double d[2][MOST_STATES];
    const double size = most * (q >= p->m->n && q < 2 * p->m->n ? p->omega : 1);
    for (int k = 0; k < 2; ++k) {
      double y[MOST_STATES], end[2][MOST_STATES];
      for (int sign = 0; sign < 2; ++sign) {
        memcpy(y, start, sizeof y);
        y[q] += (sign ? -1 : 1) * ldexp(e, k) * size;
        side orbit = p->orbit, other = side_of(p, y);
        follow(p, &orbit, &other);
        states_of(p, &other, end[sign]);
      }
      for (int i = 0; i < n; ++i) d[k][i] = (end[0][i] - end[1][i]) / (2 * ldexp(e, k) * size);
    }
    for (int i = 0; i < n; ++i) A[i * n + q] = (4 * d[0][i] - d[1][i]) / 3;
  }
  eigenvalues_of(n, A, lambda);
}

static void check(const char *what, const structure_case *c, double omega)
{
  map p = {.m = c->model, .omega = omega};
  double complex lambda[MOST_STATES];
  static double X[CASE_MAX_COEF];
  hbm_solver *s = structure_solver(c);
  hbm_point point;
  assert_int_equal(hbm_solve_first(s, omega, X, &point), HC_OK);
  for (int i = 0; i < c->model->n; ++i) assert_int_equal(hbm_response(s, omega, X, i, p.x[i]), HC_OK);
  settle(&p);
  map_multipliers(&p, lambda);
  check_multipliers(what, s, omega, X, p.n_states, lambda);
  hbm_solver_free(s);
}

/* The mass on a rough plane: with slip all round, touch-down, lift-off; and pressed on so that N does not vary. */
static void multipliers_are_those_of_the_period_map(void **state)
{
  (void)state;
  static const double factor[] = {1, 1.0 / 3};
  for (int k = 0; k < 2; ++k) {
    structure_case c = structure_case_named("space", H);
    scale_dynamic_loads(c.model, factor[k]);
    for (double omega = 10.5; omega < 14.1; omega += 0.5) check(k ? "weakly driven" : "driven", &c, omega);
    model_free(c.model);
  }
  structure_case c = structure_case_named("space", H);
  for (int j = 0; j < 2; ++j) {
    c.model->contacts[j].law.kn = 0;
    c.model->contacts[j].law.load = 2;
    for (int i = 0; i < 3; ++i) c.model->contacts[j].normal[i] = 0;
  }
  for (double omega = 10.5; omega < 14.1; omega += 0.5) check("pressed on", &c, omega);
  model_free(c.model);
}

static double multiplier_of(const structure_case *c, double omega)
{
  static double X[CASE_MAX_COEF];
  hbm_solver *s = structure_solver(c);
  hbm_point point;
  hbm_stability st;
  assert_int_equal(hbm_solve_first(s, omega, X, &point), HC_OK);
  assert_int_equal(hbm_stability_at(s, omega, X, &st), HC_OK);
  hbm_solver_free(s);
  return st.multiplier;
}

/* A spring behind it in the list, too soft to matter: the circle's motion is still its own. */
static void another_contact_changes_nothing(void **state)
{
  (void)state;
  structure_case alone = structure_case_named("space", H), beside = alone;
  assert_int_equal(model_copy_sized(alone.model, 3, alone.model->n_responses, &beside.model), HC_OK);
  beside.model->contacts[2].law = (contact){.kn = 1e-12, .gap = 100};
  for (int i = 0; i < beside.model->n; ++i) beside.model->contacts[2].normal[i] = 1 + i;
  for (double omega = 10.5; omega < 14.1; omega += 1)
    CHECK_NEAR(multiplier_of(&beside, omega), multiplier_of(&alone, omega), 1e-7, "at %g", omega);
  model_free(alone.model);
  model_free(beside.model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(another_contact_changes_nothing),
    cmocka_unit_test(multipliers_are_those_of_the_period_map),
};

CHECK_MAIN("hbm.circle_stability", tests, 120)
