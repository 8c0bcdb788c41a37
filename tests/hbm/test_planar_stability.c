/* test_planar_stability.c - Floquet multipliers of structures with circles against differences of a period map that the
 * test marches itself, by the law as model/contact_law.h states it and the method of Runge and Kutta between located
 * changes; nothing of hbm/'s evaluators is used.
 *
 *     M x'' + C x' + K x + sum over circles t_1 T_1 + t_2 T_2 + n (N - N0) = f(t)
 *
 * f makes the given motion, which harmonic balance has truncated, an exact solution, as in period_map.h. M = 1. */
#include "numerics/norm.h"
#include "tests/hbm/multipliers.h"
#include "tests/hbm/structure_cases.h"

enum { H = 7, DOFS = 3, CIRCLES = 3, MOST_STATES = 2 * DOFS + 2 * CIRCLES, STEPS = 4000 };

typedef enum mode { APART, STICKS, SLIPS } mode;

/* A structure, y = (x, x'), with its contacts. */
typedef struct side {
  mode mode[CIRCLES];
  bool changed[CIRCLES];
  double w[CIRCLES][2], phi[CIRCLES], y[2 * DOFS];
} side;

typedef struct map {
  const model *m;
  int n_circles;                    /* all of its contacts, two by two */
  double omega, x[DOFS][2 * H + 1]; /* the orbit */
  side orbit;                       /* at t = 0 */
  bool state[CIRCLES];              /* the slider is one: in contact at t = 0, and not stuck for ever */
  int n_states;                     /* x, x', then w of those */
} map;

/* u, u', N, N' of a motion. */
typedef struct contact_motion {
  double u[2], du[2], R, dR, v;
} contact_motion;

static contact_motion motion_of(const model *m, int j, const double *y)
{
  const model_contact *c = m->contacts + 2 * (size_t)j;
  const int n = m->n;
  contact_motion o = {.v = dot_product(n, c->normal, y)};
  const double dv = dot_product(n, c->normal, y + n);
  for (int d = 0; d < 2; ++d) o.u[d] = dot_product(n, c[d].tangent, y), o.du[d] = dot_product(n, c[d].tangent, y + n);
  o.R = c->law.mu * (c->law.kn * (o.v + c->law.gap) + c->law.load) / c->law.kt;
  o.dR = c->law.mu * c->law.kn * dv / c->law.kt;
  return o;
}

/* Contact forces on x. */
static void contact_force(const map *p, const side *s, const double *y, const double *phi, double *force)
{
  const int n = p->m->n;
  memset(force, 0, (size_t)n * sizeof *force);
  for (int j = 0; j < p->n_circles; ++j) {
    const model_contact *c = p->m->contacts + 2 * (size_t)j;
    const contact_motion o = motion_of(p->m, j, y);
    const double kt = c->law.kt;
    double T[2] = {0}, N = 0;
    if (s->mode[j] == STICKS) T[0] = kt * (o.u[0] - s->w[j][0]), T[1] = kt * (o.u[1] - s->w[j][1]);
    if (s->mode[j] == SLIPS) T[0] = kt * o.R * cos(phi[j]), T[1] = kt * o.R * sin(phi[j]);
    if (s->mode[j] != APART) N = 2 * (c->law.kn * (o.v + c->law.gap) + c->law.load);
    for (int i = 0; i < n; ++i) force[i] += c[0].tangent[i] * T[0] + c[1].tangent[i] * T[1] + c->normal[i] * N;
  }
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
static double turning(const model *m, const side *s, int j, const double *y, double phi, const double *acceleration)
{
  const contact_motion o = motion_of(m, j, y);
  const double c = cos(phi), sn = sin(phi);
  if (s->mode[j] != SLIPS) return 0;
  if (o.R > 1e-12) return (o.du[1] * c - o.du[0] * sn) / o.R;
  double ddu[2];
  for (int d = 0; d < 2; ++d) ddu[d] = dot_product(m->n, m->contacts[2 * j + d].tangent, acceleration);
  return (ddu[1] * c - ddu[0] * sn) / (hypot(o.du[0], o.du[1]) + o.dR);
}

/* Both sides' derivatives: of the orbit its phi, of the other dy = (x', x'', phi'). */
static void slopes(const map *p, double t, const side *orbit, const side *other, const double *phi, const double *y,
                   double *d_phi, double *dy)
{
  const model *m = p->m;
  const int n = m->n;
  double given[2 * DOFS], acceleration[DOFS], of_orbit[DOFS], of_other[DOFS];
  orbit_at(p, t, given, acceleration);
  contact_force(p, orbit, given, phi, of_orbit);
  contact_force(p, other, y, y + 2 * n, of_other);
  for (int i = 0; i < n; ++i) {
    dy[i] = y[n + i];
    dy[n + i] = acceleration[i] + of_orbit[i] - of_other[i];
    for (int q = 0; q < n; ++q)
      dy[n + i] += m->stiffness[q * n + i] * (given[q] - y[q]) + m->damping[q * n + i] * (given[n + q] - y[n + q]);
  }
  for (int j = 0; j < p->n_circles; ++j) {
    d_phi[j] = turning(m, orbit, j, given, phi[j], acceleration);
    dy[2 * n + j] = turning(m, other, j, y, y[2 * n + j], dy + n);
  }
}

/* Both sides after a step h. */
static void runge_kutta(const map *p, double t, double h, const side *orbit, const side *other, side *orbit_after,
                        side *other_after)
{
  static const double at[4] = {0, 0.5, 0.5, 1}, weight[4] = {1 / 6.0, 1 / 3.0, 1 / 3.0, 1 / 6.0};
  const int n = 2 * p->m->n, circles = p->n_circles;
  double k[2 * DOFS + CIRCLES] = {0}, k_phi[CIRCLES] = {0}, unused[DOFS];
  side o = *orbit, s = *other;
  for (int stage = 0; stage < 4; ++stage) {
    double y[2 * DOFS + CIRCLES], phi[CIRCLES];
    for (int i = 0; i < n; ++i) y[i] = other->y[i] + at[stage] * h * k[i];
    for (int j = 0; j < circles; ++j) y[n + j] = other->phi[j] + at[stage] * h * k[n + j];
    for (int j = 0; j < circles; ++j) phi[j] = orbit->phi[j] + at[stage] * h * k_phi[j];
    slopes(p, t + at[stage] * h, orbit, other, phi, y, k_phi, k);
    for (int i = 0; i < n; ++i) s.y[i] += weight[stage] * h * k[i];
    for (int j = 0; j < circles; ++j) s.phi[j] += weight[stage] * h * k[n + j];
    for (int j = 0; j < circles; ++j) o.phi[j] += weight[stage] * h * k_phi[j];
  }
  orbit_at(p, t + h, o.y, unused);
  *orbit_after = o, *other_after = s;
}

/* What falls below 0 where the state of circle j changes. */
static double guard(const model *m, const side *s, int j)
{
  const contact_motion o = motion_of(m, j, s->y);
  const double lift = m->contacts[2 * j].law.kn > 0 ? o.R : INFINITY;
  if (s->mode[j] == APART) return -o.R;
  if (s->mode[j] == STICKS) return fmin(lift, o.R - hypot(o.u[0] - s->w[j][0], o.u[1] - s->w[j][1]));
  return fmin(lift, (o.du[0] * cos(s->phi[j]) + o.du[1] * sin(s->phi[j]) - o.dR) * 1e-3);
}

static bool unchanged(const map *p, const side *s)
{
  for (int j = 0; j < p->n_circles; ++j)
    if (!(guard(p->m, s, j) >= 0)) return false;
  return true;
}

static void change(const model *m, side *s, int j)
{
  const contact_motion o = motion_of(m, j, s->y);
  double *w = s->w[j], *phi = &s->phi[j];
  s->changed[j] = true;
  if (s->mode[j] == APART) {
    s->mode[j] = hypot(o.du[0], o.du[1]) > o.dR ? SLIPS : STICKS;
    w[0] = o.u[0], w[1] = o.u[1];
    *phi = atan2(o.du[1], o.du[0]);
  } else if (m->contacts[2 * j].law.kn > 0 && o.R <= 1e-11) s->mode[j] = APART;
  else if (s->mode[j] == STICKS) {
    s->mode[j] = SLIPS;
    *phi = atan2(o.u[1] - w[1], o.u[0] - w[0]);
  } else {
    s->mode[j] = STICKS;
    w[0] = o.u[0] - o.R * cos(*phi), w[1] = o.u[1] - o.R * sin(*phi);
  }
}

static void make_changes(const map *p, side *s)
{
  for (int j = 0; j < p->n_circles; ++j)
    if (!(guard(p->m, s, j) >= 0)) change(p->m, s, j);
}

/* Slip's equation is stiff where R is small: steps by which R changes by a fifth at most, but for the last 1e-7 of the
 * period. */
static double allowed(const map *p, const side *s, double h)
{
  const double least = 1e-7 * TWO_PI / p->omega;
  for (int j = 0; j < p->n_circles; ++j) {
    const contact_motion o = motion_of(p->m, j, s->y);
    const double rate = hypot(o.du[0], o.du[1]) + fabs(o.dR);
    if (s->mode[j] == SLIPS) h = fmin(h, fmax(least, 0.2 * o.R / rate));
  }
  return h;
}

/* One step, or up to the first change of either side, bisected to rounding; how far. */
static double step(const map *p, double t, double h, side *orbit, side *other)
{
  side a, b;
  h = allowed(p, orbit, allowed(p, other, h));
  runge_kutta(p, t, h, orbit, other, &a, &b);
  if (unchanged(p, &a) && unchanged(p, &b)) {
    *orbit = a, *other = b;
    return h;
  }
  double low = 0, high = h;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    runge_kutta(p, t, middle, orbit, other, &a, &b);
    if (unchanged(p, &a) && unchanged(p, &b)) low = middle;
    else high = middle;
  }
  runge_kutta(p, t, high, orbit, other, &a, &b);
  *orbit = a, *other = b;
  make_changes(p, orbit);
  make_changes(p, other);
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

/* The states of a side: x, x', and the sliders by w; and back. */
static void states_of(const map *p, const side *s, double *q)
{
  memcpy(q, s->y, 2 * (size_t)p->m->n * sizeof *q);
  q += 2 * p->m->n;
  for (int j = 0; j < p->n_circles; ++j) {
    const contact_motion o = motion_of(p->m, j, s->y);
    const double e[2] = {cos(s->phi[j]), sin(s->phi[j])};
    if (!p->state[j]) continue;
    for (int d = 0; d < 2; ++d) *q++ = s->mode[j] == STICKS ? s->w[j][d] : o.u[d] - o.R * e[d];
  }
}

static side side_of(const map *p, const double *q)
{
  side s = p->orbit;
  memcpy(s.y, q, 2 * (size_t)p->m->n * sizeof *q);
  q += 2 * p->m->n;
  for (int j = 0; j < p->n_circles; ++j) {
    const contact_motion o = motion_of(p->m, j, s.y);
    if (!p->state[j]) continue;
    if (s.mode[j] == STICKS) s.w[j][0] = q[0], s.w[j][1] = q[1];
    else s.phi[j] = atan2(o.u[1] - q[1], o.u[0] - q[0]);
    q += 2;
  }
  return s;
}

/* The orbit's contacts at t = 0, from apart or from rest at w = 0 and put into the circle, after some periods. */
static void settle(map *p)
{
  double unused[DOFS];
  side s = {.mode = {APART}};
  p->n_circles = p->m->n_contacts / 2;
  orbit_at(p, 0, s.y, unused);
  for (int j = 0; j < p->n_circles; ++j) {
    const contact_motion o = motion_of(p->m, j, s.y);
    const double length = hypot(o.u[0], o.u[1]);
    s.mode[j] = o.R > 0 ? STICKS : APART;
    for (int d = 0; d < 2 && o.R > 0 && length > o.R; ++d) s.w[j][d] = o.u[d] * (1 - o.R / length);
  }
  side copy = s;
  for (int k = 0; k < 12; ++k) {
    memset(s.changed, 0, sizeof s.changed);
    copy = s, follow(p, &s, &copy);
  }
  p->orbit = s;
  p->n_states = 2 * p->m->n;
  for (int j = 0; j < p->n_circles; ++j) {
    p->state[j] = s.mode[j] == SLIPS || (s.mode[j] == STICKS && s.changed[j]);
    p->n_states += p->state[j] ? 2 : 0;
  }
}

/* The solution's at omega; the map's product of 1 + multiplier, as a part of its factors. */
static double check(const char *what, const structure_case *c, double omega)
{
  map p = {.m = c->model, .omega = omega};
  double complex lambda[MOST_STATES], flip = 1;
  double factors = 1;
  static double X[CASE_MAX_COEF];
  hbm_solver *s = structure_solver(c);
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, omega, NULL, X, &point));
  for (int i = 0; i < c->model->n; ++i) assert_int_equal(hbm_response(s, omega, X, i, p.x[i]), HC_OK);
  settle(&p);
  /* lambda[n_states] by central differences of e and 2 e of the states' size, extrapolated. */
  const int n = p.n_states;
  double A[MOST_STATES * MOST_STATES], start[MOST_STATES], most = 0;
  const double e = 1e-4;
  states_of(&p, &p.orbit, start);
  for (int i = 0; i < p.m->n; ++i) most = fmax(most, hypot(p.x[i][1], p.x[i][2]));
  for (int q = 0; q < n; ++q) {
    double d[2][MOST_STATES];
    const double size = most * (q >= p.m->n && q < 2 * p.m->n ? p.omega : 1);
    for (int k = 0; k < 2; ++k) {
      double y[MOST_STATES], end[2][MOST_STATES];
      for (int sign = 0; sign < 2; ++sign) {
        memcpy(y, start, sizeof y);
        y[q] += (sign ? -1 : 1) * ldexp(e, k) * size;
        side orbit = p.orbit, other = side_of(&p, y);
        follow(&p, &orbit, &other);
        states_of(&p, &other, end[sign]);
      }
      for (int i = 0; i < n; ++i) d[k][i] = (end[0][i] - end[1][i]) / (2 * ldexp(e, k) * size);
    }
    for (int i = 0; i < n; ++i) A[i * n + q] = (4 * d[0][i] - d[1][i]) / 3;
  }
  eigenvalues_of(n, A, lambda);
  check_multipliers(what, s, omega, X, p.n_states, lambda);
  for (int i = 0; i < p.n_states; ++i) flip *= 1 + lambda[i], factors *= 1 + cabs(lambda[i]);
  hbm_solver_free(s);
  return creal(flip) / factors;
}

/* The mass on a rough plane: with slip all round, touch-down, lift-off; and pressed on so that N does not vary. */
static void multipliers_are_those_of_the_period_map(CHECK_STATE)
{
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

/* One more circle on a structure, its tangents along two coordinates, pressed on by a load that does not vary. */
static void add_circle(structure_case *c, int along_1, int along_2, double kt, double limit)
{
  const int first = c->model->n_contacts;
  CHECK_MADE(model, bigger, model_copy_sized(c->model, first + 2, c->model->n_responses, &bigger));
  model_free(c->model);
  c->model = bigger;
  for (int d = 0; d < 2; ++d) {
    model_contact *k = &bigger->contacts[first + d];
    k->law = (contact){.kt = kt, .mu = 2, .load = limit / 2};
    k->pair = d ? CONTACT_SECOND : CONTACT_FIRST;
    k->circle = true;
    memset(k->tangent, 0, (size_t)bigger->n * sizeof *k->tangent);
    memset(k->normal, 0, (size_t)bigger->n * sizeof *k->normal);
    k->tangent[d ? along_2 : along_1] = 1;
  }
}

/* Two on one mass: the plane it rubs on and lifts off from, and another one across it that only sticks; and a third one
 * that slips, too. */
static void multipliers_of_several_circles(CHECK_STATE)
{
  structure_case c = structure_case_named("space", H);
  add_circle(&c, 1, 2, 30, 1e3);
  check("one slips, one sticks", &c, 11);
  check("one slips, one sticks", &c, 12.5);
  add_circle(&c, 0, 2, 20, 0.05);
  check("of three one sticks", &c, 11);
  check("of three one sticks", &c, 12.5);
  model_free(c.model);
}

static double multiplier_of(const structure_case *c, double omega)
{
  static double X[CASE_MAX_COEF];
  hbm_solver *s = structure_solver(c);
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, omega, NULL, X, &point));
  CHECK_FILLED(hbm_stability, st, hbm_stability_at(s, omega, X, &st));
  hbm_solver_free(s);
  return st.multiplier;
}

/* A spring behind it in the list, too soft to matter: the circle's motion is still its own. */
static void another_contact_changes_nothing(CHECK_STATE)
{
  structure_case alone = structure_case_named("space", H), beside = alone;
  assert_int_equal(model_copy_sized(alone.model, 3, alone.model->n_responses, &beside.model), HC_OK);
  beside.model->contacts[2].law = (contact){.kn = 1e-12, .gap = 100};
  for (int i = 0; i < beside.model->n; ++i) beside.model->contacts[2].normal[i] = 1 + i;
  for (double omega = 10.5; omega < 14.1; omega += 1)
    CHECK_NEAR(multiplier_of(&beside, omega), multiplier_of(&alone, omega), 1e-7, "at %g", omega);
  model_free(alone.model);
  model_free(beside.model);
}

/* A period doubling of two circles that harmonic balance locates is one of the map. There is no such test of a
 * Neimark-Sacker point: neither plane nor space has one. */
static void a_doubling_is_one_of_the_period_map(CHECK_STATE)
{
  structure_case c = structure_case_named("space", H);
  add_circle(&c, 1, 2, 30, 1e3);
  hbm_solver *s = structure_solver(&c);
  hbm_curve curve = {0};
  hbm_special *special;
  int n, doublings = 0;
  assert_int_equal(hbm_trace(s, 10.8, 11.2, NULL, &curve), HC_OK);
  hbm_specials(s, &curve, &special, &n);
  for (int i = 0; i < n; ++i) {
    if (special[i].kind != HBM_PERIOD_DOUBLING) continue;
    CHECK_NEAR(check("doubling", &c, special[i].omega), 0, 1e-6, "at %g", special[i].omega);
    ++doublings;
  }
  assert_true(doublings >= 1);
  free(special);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  model_free(c.model);
}

CHECK_TESTS("hbm.planar_stability", 240, another_contact_changes_nothing, multipliers_of_several_circles,
            a_doubling_is_one_of_the_period_map, multipliers_are_those_of_the_period_map)
