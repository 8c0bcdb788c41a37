/* test_circle.c - time integration of contacts with two tangents under the law of the circle: against an independent
 * program, against the law of one tangent where the motion is on one line, and against differences. */

#include "numerics/floquet.h"
#include "tests/hbm/multipliers.h"
#include "tests/timeint/drawn.h"
#include "tests/timeint/structure_rows.h"
#include "timeint/cvode/events_newton.h"
#include "timeint/steady/contact_watch.h"
#include "timeint/steady/timeint_private.h"

/* ---- scenes ---------------------------------------------------------------------------------------------- */

/* The case of that name, driven by that force. */
static model *driven(const char *name, double force)
{
  const structure_case c = structure_case_named(name, 7);
  scale_dynamic_loads(c.model, force / 3);
  return c.model;
}

/* Some masses, with circles, and contacts of other kinds beside them. */
static void draw(uint64_t *seed, transient_law law, drawn *d)
{
  const int n = random_int(seed, 3, 6), circles = random_int(seed, 1, 3);
  d->m = random_structure(seed, n, 2 * circles + random_int(seed, 0, 2));
  for (int j = 0; j < 2 * circles; j += 2) {
    contact whole = {.kt = 10 + 50 * random_unit(seed), .mu = 0.1 + 0.5 * random_unit(seed)};
    random_direction(seed, n, d->m->contacts[j].tangent);
    random_direction(seed, n, d->m->contacts[j + 1].tangent);
    random_direction(seed, n, d->m->contacts[j].normal);
    whole.kn = 10 + 50 * random_unit(seed);
    whole.gap = 0.3 * random_signed(seed);
    if (random_unit(seed) < 0.3) {
      whole.load = 5 * random_unit(seed);
      whole.kn = whole.gap = 0;
      memset(d->m->contacts[j].normal, 0, (size_t)n * sizeof(double));
    }
    make_circle(d->m, j, whole);
  }
  scale_drawn(d, law, 3 + 10 * random_unit(seed));
}

static const transient_settings closed_form = CLOSED_FORM(1e-10, 20000);

/* ---- an independent program ------------------------------------------------------------------------------ */

/* By a program of its own: Taylor series of order 22 while a circle slips, events bisected to rounding, in NumPy. */
static void periods_meet_the_reference(CHECK_STATE)
{
  static const struct {
    const char *of, *name;
    double force;
    int rows;
  } cases[] = {{"space", "space_F0.1", 0.1, 3},
               {"space", "space_F1", 1, 12},
               {"space", "space_F3", 3, 12},
               {"plane", "plane_F1", 1, 6},
               {"plane", "plane_F3", 3, 8}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    model *m = driven(cases[k].of, cases[k].force);
    check_structure_rows_all_ways(m, cases[k].name, cases[k].rows);
    model_free(m);
  }
}

/* A contact that sticks all the time is one slider that rests anywhere, not two: by shooting, and marched. */
static void a_circle_that_sticks_is_free_once(CHECK_STATE)
{
  static timeint_result r;
  for (int march = 0; march < 2; ++march) {
    model *m = driven("plane", 0.08);
    transient_settings how = closed_form;
    double y[6] = {0};
    if (march) how.steady = TRANSIENT_STEADY_MARCH;
    CHECK_MADE(timeint, ti, timeint_new(m, &how, &ti));
    assert_int_equal(timeint_steady(ti, 12.5, y, NULL, &r), HC_OK);
    assert_int_equal(r.free_sliders, 1);
    timeint_free(ti);
    model_free(m);
  }
}

/* ---- the regularised law --------------------------------------------------------------------------------- */

static void newton_solves_the_equations(CHECK_STATE) { check_newton(draw); }

/* ---- the exact law --------------------------------------------------------------------------------------- */

/* A state of the exact law's equations by CVODE, y = (x, p, z). */
typedef struct between_events {
  drawn d;
  contact_track track[MOST_CONTACTS];
  contact_forces_linear law[MOST_CONTACTS];
  int own_of[MOST_CONTACTS], n, turning;
  double y[MOST];
} between_events;

/* dy at y: forces and rates contact by contact. */
static void rate_between_events(const between_events *b, const double *y, double *dy)
{
  const scaled_model *m = &b->d.scaled;
  const int n = m->n;
  memcpy(dy, y + n, (size_t)n * sizeof *dy);
  scaled_linear_force(m, 1, y, dy + n);
  for (int j = 0; j < m->n_contacts; ++j) {
    const double *t = m->base->tangent + j * n, *normal = m->base->normal + j * n;
    const contact_forces_linear *f = &b->law[j];
    const double u = dot_product(n, t, y), v = dot_product(n, normal, y);
    for (int i = 0; i < n; ++i)
      dy[n + i] -= t[i] * (f->t_u * u + f->t_v * v + f->t_0) + normal[i] * (f->n_v * v + f->n_0);
    if (m->contact[j].direction > 0 || b->own_of[j] < 0) continue;
    const int own = 2 * n + b->own_of[j];
    const contact_motion at = scaled_motion_at(m, j, y);
    const law_pull pull =
        b->track[j].turns ? m->contact[j].kind->pull(&b->track[j], &m->contact[j], &at, y[own]) : (law_pull){{0}, 0};
    dy[own] = pull.rate;
    for (int i = 0; i < n; ++i) dy[n + i] -= pull.t[0] * t[i] + pull.t[1] * t[n + i];
  }
}

/* (I - gamma J) z = r by elimination, J z by differences along z: h^2 of third derivatives, those of 1/|U'|. */
static void newton_of_the_exact_law_solves_its_equations(CHECK_STATE)
{
  uint64_t seed = 27;
  int turning = 0;
  for (int trial = 0; trial < 200; ++trial) {
    between_events b;
    workspace memory = {0};
    double z[MOST], r[MOST], f[2][MOST], size = 1;
    draw(&seed, TRANSIENT_LAW_EXACT, &b.d);
    const scaled_model *m = &b.d.scaled;
    b.n = 2 * m->n, b.turning = 0;
    for (int i = 0; i < b.n; ++i) b.y[i] = random_signed(&seed);
    for (int j = 0; j < m->n_contacts; j += scaled_directions(m, j)) {
      const law_kind *kind = m->contact[j].kind;
      const contact_motion at = scaled_motion_at(m, j, b.y);
      const double w[2] = {random_signed(&seed), random_signed(&seed)};
      contact_track_begin(&b.track[j], &m->contact[j], &at, w);
      b.own_of[j] = -1;
      if (!kind->own_begin) continue;
      b.own_of[j] = b.n - 2 * m->n;
      b.y[b.n++] = b.track[j].turns ? kind->own_begin(&b.track[j]) : 0;
      b.turning += b.track[j].turns;
    }
    for (int j = 0; j < m->n_contacts; ++j) b.law[j] = contact_track_forces(&b.track[j], &m->contact[j]);
    const double gamma = pow(10, -4 + 4 * random_unit(&seed)), h = 1e-5;
    turning += b.turning;
    for (int i = 0; i < b.n; ++i) z[i] = r[i] = random_signed(&seed);
    CHECK_FILLED(events_newton, s, events_newton_make(&s, b.d.base, b.track, b.law, b.own_of, &memory));
    events_newton_linearise(&s, &b.d.scaled, b.y);
    assert_true(events_newton_factor(&s, &b.d.scaled, gamma));
    events_newton_solve(&s, z);
    for (int i = 0; i < b.n; ++i) size = fmax(size, fabs(z[i]));
    for (int side = 0; side < 2; ++side) {
      double y[MOST];
      for (int i = 0; i < b.n; ++i) y[i] = b.y[i] + (side ? h : -h) * z[i] / size;
      rate_between_events(&b, y, f[side]);
    }
    for (int i = 0; i < b.n; ++i) {
      const double Jz = (f[1][i] - f[0][i]) * size / (2 * h);
      CHECK_NEAR(z[i] - gamma * Jz, r[i], 1e-5 * (1 + size + gamma * fabs(Jz)), "trial %d, row %d, gamma %g", trial, i,
                 gamma);
    }
    workspace_free(&memory);
    undraw(&b.d);
  }
  CHECK_LE(50, turning, "slips that turn");
}

/* A motion on one line through the plane, along e, is that of the contact whose tangent is e: the same masses with
 * loads along that line, K and C the same in both directions. Rounding of some hundred steps. */
static void a_motion_on_a_line_is_that_of_one_tangent(CHECK_STATE)
{
  const double e[2] = {0.6, 0.8};
  const contact law = {.kt = 60, .kn = 80, .mu = 0.5, .gap = 0.02};
  drawn two = {.m = driven("space", 3)}, one = {.m = driven("space", 3)};
  double y[2][MOST] = {{0}};
  for (int k = 0; k < 2; ++k) {
    model *m = k ? one.m : two.m;
    memset(m->stiffness, 0, 9 * sizeof(double));
    memset(m->damping, 0, 9 * sizeof(double));
    for (int i = 0; i < 3; ++i) m->stiffness[4 * i] = i < 2 ? 100 : 180, m->damping[4 * i] = 0.3;
    for (int a = 0; a < 2; ++a) {
      m->stiffness[6 + a] = m->stiffness[3 * a + 2] = 15 * e[a];
      m->loads->cosine[a] = 3 * e[a], m->loads->sine[a] = 0;
    }
  }
  memcpy(one.m->contacts[0].tangent, e, sizeof e);
  memset(one.m->contacts[1].tangent, 0, 3 * sizeof(double));
  for (int j = 0; j < 2; ++j) one.m->contacts[j].pair = CONTACT_ALONE, one.m->contacts[j].circle = false;
  one.m->contacts[0].law = law;
  one.m->contacts[1].law = (contact){0};
  scale_drawn(&one, TRANSIENT_LAW_EXACT, 10.5);
  scale_drawn(&two, TRANSIENT_LAW_EXACT, 10.5);
  CHECK_MADE(integrator, of_one, integrate_new_closed_form(one.base, INTERVAL_MODES_STIFF, &of_one));
  CHECK_MADE(integrator, of_two, integrate_new_closed_form(two.base, INTERVAL_MODES_STIFF, &of_two));
  for (int period = 0; period < 5; ++period) {
    double x[2][6];
    assert_int_equal(integrate_period(of_one, &one.scaled, y[0], NULL, NULL), HC_OK);
    assert_int_equal(integrate_period(of_two, &two.scaled, y[1], NULL, NULL), HC_OK);
    modal_base_to_model(one.base, y[0], x[0]);
    modal_base_to_model(two.base, y[1], x[1]);
    modal_base_to_model(one.base, y[0] + 3, x[0] + 3);
    modal_base_to_model(two.base, y[1] + 3, x[1] + 3);
    for (int i = 0; i < 6; ++i) CHECK_NEAR(x[1][i], x[0][i], 1e-13, "period %d, %d", period, i);
    for (int a = 0; a < 2; ++a) CHECK_NEAR(y[1][6 + a], e[a] * y[0][6], 1e-13, "period %d, slider", period);
  }
  assert_true(integrate_transitions(of_one) >= 20);
  assert_int_equal(integrate_transitions(of_one), integrate_transitions(of_two));
  integrate_free(of_one);
  integrate_free(of_two);
  undraw(&one);
  undraw(&two);
}

/* The tangents turned in their plane by an angle, and mirrored: the same motion, to rounding. */
static void turned_tangents_change_nothing(CHECK_STATE)
{
  uint64_t seed = 5;
  for (int trial = 0; trial < 20; ++trial) {
    drawn d, turned;
    double y[MOST] = {0}, z[MOST] = {0};
    const double angle = 6 * random_unit(&seed), c = cos(angle), s = sin(angle), mirror = trial % 2 ? -1 : 1;
    draw(&seed, TRANSIENT_LAW_EXACT, &d);
    assert_int_equal(model_copy(d.m, &turned.m), HC_OK);
    for (int j = 0; j < d.m->n_contacts; ++j)
      for (int i = 0; i < d.m->n && d.m->contacts[j].pair == CONTACT_FIRST; ++i) {
        const double one = d.m->contacts[j].tangent[i], two = d.m->contacts[j + 1].tangent[i];
        turned.m->contacts[j].tangent[i] = c * one + s * two;
        turned.m->contacts[j + 1].tangent[i] = mirror * (c * two - s * one);
      }
    scale_drawn(&turned, TRANSIENT_LAW_EXACT, 1 / d.scaled.by_C);
    CHECK_MADE(integrator, in, integrate_new_closed_form(d.base, INTERVAL_MODES_STIFF, &in));
    CHECK_MADE(integrator, other, integrate_new_closed_form(turned.base, INTERVAL_MODES_STIFF, &other));
    for (int period = 0; period < 3; ++period) {
      double x[MOST], x2[MOST];
      assert_int_equal(integrate_period(in, &d.scaled, y, NULL, NULL), HC_OK);
      assert_int_equal(integrate_period(other, &turned.scaled, z, NULL, NULL), HC_OK);
      modal_base_to_model(d.base, y, x);
      modal_base_to_model(turned.base, z, x2);
      for (int i = 0; i < d.m->n; ++i) CHECK_NEAR(x2[i], x[i], 1e-10, "trial %d, period %d, %d", trial, period, i);
    }
    integrate_free(in);
    integrate_free(other);
    undraw(&d);
    undraw(&turned);
  }
}

/* Column q of phi against differences of the period map, of e and 2 e, extrapolated. Where the order of transitions
 * changes in between the map has one derivative less there, and nothing would be compared: those are few. Sliders that
 * are tied to the motion take the place that the law gives them, in both: what is compared are x, x' and what w does.
 * How many entries are off by more than 1e-7 of the column. */
static int differences_off(const drawn *d, integrator *in, const double *y, const double *phi, int q)
{
  double end[4][MOST], size = 1;
  const int n = d->scaled.n_states;
  int off = 0;
  for (int k = 0; k < 4; ++k) {
    double *z = end[k];
    memcpy(z, y, sizeof end[k]);
    z[q] += (k % 2 ? 1 : -1) * (k < 2 ? 1e-5 : 2e-5);
    assert_int_equal(integrate_period(in, &d->scaled, z, NULL, NULL), HC_OK);
  }
  for (int i = 0; i < n; ++i) size = fmax(size, fabs(phi[i + q * n]));
  for (int i = 0; i < n; ++i) {
    const double one = (end[1][i] - end[0][i]) / 2e-5, two = (end[3][i] - end[2][i]) / 4e-5;
    off += !(fabs(phi[i + q * n] - (4 * one - two) / 3) <= 1e-7 * size);
  }
  return off;
}

/* Only columns of states that no tied slider has to follow: those of x, x' move it off its circle, and the map then
 * has a corner there. So all sliders stick or are apart at theta = 0: the start is taken where that holds. */
static bool is_smooth(const drawn *d, const double *y)
{
  for (int j = 0; j < d->scaled.n_contacts; ++j) {
    const scaled_contact *c = &d->scaled.contact[j];
    double u[2] = {0}, v;
    if (!c->law.has_friction || c->direction > 0) continue;
    scaled_contact_motion(&d->scaled, j, y, u, &v);
    const double n = c->law.kn > 0 ? c->law.kn * (v + c->law.gap) : c->law.load;
    const double *w = y + 2 * d->scaled.n + j,
                 t = c->law.kt * hypot(u[0] - w[0], c->kind->directions > 1 ? u[1] - w[1] : 0);
    if (fabs(n) < 1e-3 || (n > 0 && fabs(t - c->law.mu * n) < 1e-3)) return false;
  }
  return true;
}

static void monodromy_is_the_derivative(CHECK_STATE)
{
  uint64_t seed = 7;
  int compared = 0, off = 0;
  for (int trial = 0; trial < 60; ++trial) {
    drawn d;
    double y[MOST] = {0}, z[MOST];
    static double phi[MOST * MOST];
    draw(&seed, TRANSIENT_LAW_EXACT, &d);
    const int n = d.scaled.n_states;
    for (int i = 0; i < n; ++i) y[i] = 0.3 * random_signed(&seed);
    CHECK_MADE(integrator, in, integrate_new_closed_form(d.base, INTERVAL_MODES_STIFF, &in));
    memcpy(z, y, sizeof y);
    assert_int_equal(integrate_monodromy(in, &d.scaled, z, phi), HC_OK);
    for (int q = 0; q < n && is_smooth(&d, y); ++q) {
      compared += n;
      off += differences_off(&d, in, y, phi, q);
    }
    integrate_free(in);
    undraw(&d);
  }
  CHECK_LE(2000, compared, "too few");
  CHECK_LE(off, 0.002 * compared, "of %d derivatives", compared);
}

/* Newton's matrices: 1e-6 of a column is left out in each step, and grows as neighbours part in the period: 4e-4 at
 * most of these, below 1e-4 in all others. Where slip turns in a period the two are not the same. */
static void coarse_matrices_are_good_to_their_digits(CHECK_STATE)
{
  uint64_t seed = 11;
  int coarser = 0;
  for (int trial = 0; trial < 60; ++trial) {
    drawn d;
    double y[2][MOST] = {{0}}, largest = 0, apart = 0;
    static double phi[2][MOST * MOST];
    draw(&seed, TRANSIENT_LAW_EXACT, &d);
    const int n = d.scaled.n_states;
    for (int i = 0; i < n; ++i) y[0][i] = y[1][i] = 0.3 * random_signed(&seed);
    CHECK_MADE(integrator, in, integrate_new_closed_form(d.base, INTERVAL_MODES_STIFF, &in));
    assert_int_equal(integrate_has_coarse(in), d.base->n_planar > 0);
    assert_int_equal(integrate_monodromy(in, &d.scaled, y[0], phi[0]), HC_OK);
    assert_int_equal(integrate_coarse_monodromy(in, &d.scaled, y[1], phi[1]), HC_OK);
    assert_memory_equal(y[0], y[1], sizeof y[0]);
    for (int i = 0; i < n * n; ++i) largest = larger(largest, fabs(phi[0][i]));
    for (int i = 0; i < n * n; ++i) apart = larger(apart, fabs(phi[0][i] - phi[1][i]));
    CHECK_LE(apart, 1e-3 * largest, "trial %d", trial);
    coarser += apart > 1e-12 * largest;
    integrate_free(in);
    undraw(&d);
  }
  CHECK_LE(20, coarser, "so many are coarser");
}

/* Newton ends with a coarse matrix, and the multiplier reported is that of a fine one: where slip goes all round, a
 * coarse one's is 6e-9 off. */
static void multipliers_are_of_fine_matrices(CHECK_STATE)
{
  static timeint_result r;
  static double phi[MOST * MOST];
  double complex multipliers[MOST];
  double y[6] = {0};
  model *m = driven("plane", 40);
  CHECK_MADE(timeint, ti, timeint_new(m, &closed_form, &ti));
  assert_int_equal(timeint_steady(ti, 10.5, y, NULL, &r), HC_OK);
  assert_int_equal(integrate_monodromy(ti->in, &ti->scaled, ti->y, phi), HC_OK);
  eigenvalues_of(ti->n, phi, multipliers);
  CHECK_NEAR(r.multiplier, cabs(floquet_largest(ti->n, multipliers)), 1e-10, "a period later");
  timeint_free(ti);
  model_free(m);
}

static void series_and_events_agree(CHECK_STATE)
{
  int changing;
  CHECK_LE(40 * 4 * 4, check_series_and_events(draw, 40, 1e-9, &changing), "they change their states");
}

/* A slider that goes round a closed curve in each period has left its place, though it comes back to it and the circle
 * never changes its state; one that sticks has not. */
static void a_slider_that_comes_back_has_travelled(CHECK_STATE)
{
  for (int slips = 0; slips < 2; ++slips) {
    drawn d = {.m = driven("plane", slips ? 40 : 0.1)};
    integrator *by[2];
    double y[2][MOST] = {{0}};
    scale_drawn(&d, TRANSIENT_LAW_EXACT, 10.5);
    assert_int_equal(integrate_new_closed_form(d.base, INTERVAL_MODES_STIFF, &by[0]), HC_OK);
    assert_int_equal(integrate_new_events(d.base, 1e-10, &by[1]), HC_OK);
    for (int k = 0; k < 2; ++k) {
      for (int period = 0; period < 40; ++period)
        assert_int_equal(integrate_period(by[k], &d.scaled, y[k], NULL, NULL), HC_OK);
      const long transitions = integrate_transitions(by[k]);
      assert_int_equal(integrate_period(by[k], &d.scaled, y[k], NULL, NULL), HC_OK);
      assert_int_equal(integrate_transitions(by[k]), transitions);
      for (int a = 0; a < 2; ++a) {
        if (slips) CHECK_LE(0.1, integrate_travel(by[k], a), "integrator %d, direction %d", k, a);
        else CHECK_LE(integrate_travel(by[k], a), 0, "integrator %d, direction %d", k, a);
      }
      integrate_free(by[k]);
    }
    undraw(&d);
  }
}

/* ---- what contacts do ------------------------------------------------------------------------------------- */

/* Over a period of a steady state the loads' work is what damping and friction take: that of the load from the first
 * harmonics, p . x' = omega (sin part), damping's from the waves of three masses, exact but for their aliasing: a sum
 * over TIMEINT_WAVE instants of harmonics that fall off like the sixth power at touch-down. */
static void friction_takes_what_the_loads_give(CHECK_STATE)
{
  static timeint_result r[3];
  const double omegas[] = {10.5, 11.5, 12.5};
  for (int law = 0; law < 2; ++law)
    for (size_t k = 0; k < sizeof omegas / sizeof *omegas; ++k) {
      model *m = driven("space", 3);
      transient_settings how = closed_form;
      contact_period p[2];
      double y[8] = {0}, given = 0, damped = 0, largest = 0;
      if (law == 1) {
        how.law = TRANSIENT_LAW_REGULARISED, how.method = TRANSIENT_METHOD_CVODE;
        how.scout = true, how.regularisation = 1e-5, how.tolerance = 1e-8;
      }
      CHECK_MADE(timeint, ti, timeint_new(m, &how, &ti));
      assert_int_equal(timeint_steady(ti, omegas[k], y, NULL, &r[0]), HC_OK);
      r[1] = r[2] = r[0];
      for (int i = 0; i < 3; ++i) assert_int_equal(timeint_response(ti, i, &r[i]), HC_OK);
      assert_int_equal(timeint_contacts(ti, &r[0], p), HC_OK);
      for (int i = 0; i < 3; ++i) given += PI * (m->loads->cosine[i] * r[i].b1 - m->loads->sine[i] * r[i].a1);
      for (int h = 1; h < 60; ++h) { /* pi omega sum h^2 C_ij (a_i a_j + b_i b_j) */
        double a[3] = {0}, b[3] = {0};
        for (int i = 0; i < 3; ++i)
          for (int t = 0; t < TIMEINT_WAVE; ++t) {
            const double angle = 2 * PI * ((t * h) % TIMEINT_WAVE) / TIMEINT_WAVE;
            a[i] += 2 * r[i].wave[t] * cos(angle) / TIMEINT_WAVE;
            b[i] += 2 * r[i].wave[t] * sin(angle) / TIMEINT_WAVE;
          }
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            damped += PI * omegas[k] * h * h * m->damping[3 * i + j] * (a[i] * a[j] + b[i] * b[j]);
      }
      CHECK_NEAR(p[0].work + p[1].work, given - damped, (law ? 1e-4 : 1e-8) * given, "at %g", omegas[k]);
      CHECK_LE(p[1].work + p[1].slip_distance + p[1].traction_max, 0, "the first direction has it all");
      largest = 0.5 * (p[0].normal_max + p[1].normal_max);
      assert_true(p[0].regime == p[1].regime && p[0].regime == CONTACT_SEPARATES);
      CHECK_LE(p[0].traction_max, largest * (1 + (law ? 1e-3 : 1e-12)), "T of mu 0.5 times N");
      timeint_free(ti);
      model_free(m);
    }
}

/* With mu N/kt = 8e-7 against a motion of some 0.05 the direction of slip follows in steps of some 1e-5 of the period.
 * The monitor is asked at the start of a period, then once in 4096 steps, and no longer period comes to its end. */
static void a_long_period_hears_the_monitor(CHECK_STATE)
{
  static timeint_result r;
  for (int cvode = 0; cvode < 2; ++cvode) {
    model *m = driven("plane", 3);
    transient_settings how = closed_form;
    int left = 3;
    const hc_monitor stop = {.tick = check_stop, .self = &left};
    double y[6] = {0.1, 0.1};
    for (int a = 0; a < 2; ++a) m->contacts[a].law.load = 0.5e-4;
    if (cvode) how.method = TRANSIENT_METHOD_CVODE;
    CHECK_MADE(timeint, ti, timeint_new(m, &how, &ti));
    assert_int_equal(timeint_orbit(ti, 12.5, 1, y, &stop, &r), HC_INTERRUPTED);
    CHECK_LE(cvode ? r.rhs : r.steps, 2 * 4096 + 1, "by CVODE: %d", cvode);
    CHECK_LE(r.periods, 0, "none has ended, by CVODE: %d", cvode);
    timeint_free(ti);
    model_free(m);
  }
}

CHECK_TESTS_WITH("timeint.circle", 600, read_structure_rows, NULL, periods_meet_the_reference,
                 a_circle_that_sticks_is_free_once, newton_solves_the_equations,
                 newton_of_the_exact_law_solves_its_equations, a_motion_on_a_line_is_that_of_one_tangent,
                 turned_tangents_change_nothing, monodromy_is_the_derivative, coarse_matrices_are_good_to_their_digits,
                 multipliers_are_of_fine_matrices, series_and_events_agree, a_slider_that_comes_back_has_travelled,
                 friction_takes_what_the_loads_give, a_long_period_hears_the_monitor)
