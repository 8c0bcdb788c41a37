/* test_linear_regime.c - the closed form against integration (against the table: test_closed.c). Where
 * linear_regime_is_final says yes no contact changes its state; and it says yes up to where one does. */

#include <float.h>

#include "model/linear.h"
#include "numerics/random.h"
#include "tests/scene_parts.h"
#include "tests/timeint/scenes.h"
#include "timeint/steady/linear_regime.h"
#include "timeint/steady/timeint_private.h"

/* A scene whose contacts are all as they are in static equilibrium (closed with a preload, open with a clearance),
 * sliders at rest at w:
 *     M x'' + C x' + k x = F0 cos(omega t) + d,   k = K + sum (kt c^2 + kn s^2),   d = sum kt c w
 * with sums over the closed contacts, and kt = 0 in those without friction. */
typedef struct linear_case {
  double k, center;
  double complex z;
} linear_case;

static bool frictional(const contact *c) { return c->kt > 0 && c->kn > 0 && c->mu > 0; }

static linear_case orbit_of(const scene *sc, double omega, const double *w)
{
  linear_case l = {.k = *sc->structure->stiffness.v};
  double d = 0, c, s;
  for (int j = 0; j < sc->structure->n_contacts; ++j) {
    const contact *law = &sc->structure->contacts[j].given.law;
    scene_direction(&sc->structure->contacts[j].given, &c, &s);
    if (!(law->gap > 0)) continue;
    l.k += law->kn * s * s + (frictional(law) ? law->kt * c * c : 0);
    d += frictional(law) ? law->kt * c * w[j] : 0;
  }
  l.center = d / l.k;
  l.z = linear_response(*sc->structure->mass.v, *sc->structure->damping.v, l.k, sc->structure->loads->amplitude, omega);
  return l;
}

/* On the orbit, and off it by (dx, dv). */
static scene_state state_of(const scene *sc, double omega, const double *w, double dx, double dv)
{
  const linear_case l = orbit_of(sc, omega, w);
  scene_state st = {.x = l.center + creal(l.z) + dx, .v = creal(I * omega * l.z) + dv};
  for (int j = 0; j < sc->structure->n_contacts; ++j) {
    double c, s;
    scene_direction(&sc->structure->contacts[j].given, &c, &s);
    st.w[j] = sc->structure->contacts[j].given.law.gap > 0 ? w[j] : c * st.x;
  }
  return st;
}

static timeint *make(const scene *sc)
{
  CHECK_MADE(timeint, ti, scene_timeint(sc, &ti));
  return ti;
}

static bool is_final_from(timeint *ti, double omega, const scene_state *st)
{
  assert_int_equal(timeint_begin(ti, omega, st->all), HC_OK);
  return linear_regime_is_final(ti);
}

static bool is_final(const scene *sc, double omega, const scene_state *st)
{
  timeint *ti = make(sc);
  bool yes = is_final_from(ti, omega, st);
  timeint_free(ti);
  return yes;
}

/* From a state off the orbit the closed form is where marching settles, which is within transient.tolerance, 1e-9 of
 * the amplitude. The sums over 512 instants of a harmonic motion are exact. */
static void same_as_marching(const scene *from, const char *name, double omega, const double *w, double off,
                             int free_sliders)
{
  scene sc = *from;
  timeint_result r, m;
  memset(&r, 0, sizeof r);
  const linear_case l = orbit_of(&sc, omega, w);
  const double size = cabs(l.z), tol = 2e-9 * size;
  scene_state st = state_of(&sc, omega, w, off * size, -off * size * omega), sm = st;
  sc.transient.steady = TRANSIENT_STEADY_MARCH;
  timeint *ti = make(&sc), *march = make(&sc);
  CHECK_LE(1, is_final_from(ti, omega, &st), "%s", name);
  linear_regime_steady(ti, &r);
  timeint_get_state(ti, st.all);
  assert_int_equal(timeint_steady(march, omega, sm.all, NULL, &m), HC_OK);
  CHECK_NEAR(r.mean, l.center, 1e-13 * size, "%s: mean = sum kt c w/k", name);
  CHECK_NEAR(r.amplitude, m.amplitude, tol, "%s", name);
  CHECK_NEAR(r.max, m.max, tol, "%s", name);
  CHECK_NEAR(r.min, m.min, tol, "%s", name);
  CHECK_NEAR(r.mean, m.mean, tol, "%s", name);
  CHECK_NEAR(r.rms, m.rms, tol, "%s", name);
  CHECK_NEAR(r.a1, m.a1, 2 * tol, "%s", name);
  CHECK_NEAR(r.b1, m.b1, 2 * tol, "%s", name);
  CHECK_NEAR(r.harmonic_1, m.harmonic_1, 2 * tol, "%s", name);
  for (int i = 0; i < TIMEINT_WAVE; ++i) CHECK_NEAR(r.wave[i], m.wave[i], tol, "%s: wave[%d]", name, i);
  CHECK_NEAR(st.x, sm.x, tol, "%s", name);
  CHECK_NEAR(st.v, sm.v, tol * omega, "%s", name);
  for (int j = 0; j < sc.structure->n_contacts; ++j) CHECK_NEAR(st.w[j], sm.w[j], 2 * tol, "%s: w[%d]", name, j);
  assert_int_equal(r.regime, m.regime);
  assert_int_equal(r.period_multiple, 1);
  assert_int_equal(r.method, TIMEINT_BY_CLOSED_FORM);
  assert_int_equal(r.free_sliders, free_sliders);
  CHECK_NEAR(r.multiplier, exp(-PI * *sc.structure->damping.v / (*sc.structure->mass.v * omega)), 1e-15, "%s", name);
  CHECK_NEAR(r.contraction, r.multiplier, 0, "%s", name);
  CHECK_LE(fabs(r.closure), 0, "%s", name);
  timeint_free(ti);
  timeint_free(march);
}

static scene
scene_many(void) /* sliders at rest and following x, contacts without friction, along and across the motion */
{
  scene sc = scene_linear(1, 0.4, 40, 10);
  scene_add(&sc, 100, 200, 0.3, 0.5, 45);
  scene_add(&sc, 50, 100, 0.4, -0.5, 30);
  scene_add(&sc, 50, 100, 0.4, 0.4, 0);
  scene_add(&sc, 0, 30, 0.4, 0.6, 60);
  scene_add(&sc, 70, 30, 0, 0.7, 90);
  scene_add(&sc, 50, 0, 0.4, 0.7, 20);
  return sc;
}

static void measures(CHECK_STATE)
{
  const double none[SCENE_MAX_CONTACTS] = {0}, held[SCENE_MAX_CONTACTS] = {-0.1, 0, 0.05};
  scene a10 = scene_a10(), b10 = scene_b10(), many = scene_many(), alone = scene_linear(2, 0.5, 50, 7);
  for (int law = 0; law < 2; ++law) {
    a10.transient.law = b10.transient.law = many.transient.law = alone.transient.law = law;
    same_as_marching(&a10, "a10", 12, held, 0.1, 1); /* mean = 100 cos 45 (-0.1)/190 */
    same_as_marching(&b10, "b10", 9, none, 0.5, 0);
    same_as_marching(&many, "many", 7, held, 0.2, 2);
    same_as_marching(&alone, "alone", 4, none, 30, 0);
  }
  b10.transient.regularisation = 0.02; /* a slider that lags visibly; 40 widths of the corner leave it a fifth of the
                                          gap */
  b10.structure->contacts[0].given.law.gap = -20;
  b10.transient.law = TRANSIENT_LAW_REGULARISED;
  same_as_marching(&b10, "b10, lagging", 9, none, 0.5, 0);
}

/* The force of a slider at rest far off keeps the other contact open although it has a preload (N0 stays in the
 * equation), or closed although it has a clearance: kn (x + gap). A period of some 500 steps of 1e-12, relative to
 * |x| < 4, ends where it began. */
static void a_slider_keeps_another_contact_open_or_closed(CHECK_STATE)
{
  for (int side = -1; side <= 1; side += 2) {
    scene sc = scene_linear(1, 0.4, 40, 10);
    scene_add(&sc, 100, 1000, 1, 1, 0);
    scene_add(&sc, 0, 10, 0, -0.5 * side, 90);
    const double k = 40 + 100 + (side > 0 ? 10 : 0), center = (100 * 5 * side + 10 * 0.5) / k;
    const double complex z = linear_response(1, 0.4, k, 10, 6);
    for (int law = 0; law < 2; ++law) {
      sc.transient.law = law;
      timeint *ti = make(&sc);
      scene_state st = {.x = center + creal(z), .v = -6 * cimag(z), .w = {5 * side}};
      timeint_result r;
      CHECK_LE(1, is_final_from(ti, 6, &st), "leaning %d", side);
      linear_regime_steady(ti, &r);
      CHECK_NEAR(r.mean, center, 1e-14 * fabs(center), "leaning %d", side);
      double y[SCENE_MAX_STATES];
      memcpy(y, ti->y, (size_t)ti->n * sizeof *ti->y);
      assert_int_equal(timeint_set_tolerance(ti, 1e-12), HC_OK);
      assert_int_equal(integrate_period(ti->in, &ti->scaled, y, NULL, NULL), HC_OK);
      for (int i = 0; i < 3; ++i) CHECK_NEAR(y[i], ti->y[i], 2e-9, "leaning %d: y[%d]", side, i);
      timeint_free(ti);
    }
  }
}

/* -- a yes is right -- */

typedef struct watched {
  const timeint *ti;
  bool closed[SCENE_MAX_CONTACTS], changed;
} watched;

static bool is_closed(const scaled_model *m, int j, const double *y)
{
  return scene_sine(m, &m->contact[j]) * y[SCALED_X] + m->contact[j].law.gap > 0;
}

static hc_status watch_contacts(void *self, const integrator *in, double theta0, double theta1)
{
  (void)theta0;
  watched *w = self;
  const scaled_model *m = &w->ti->scaled;
  double y[SCENE_MAX_STATES];
  hc_status st = integrate_dense(in, theta1, 0, y);
  for (int j = 0; j < m->n_contacts && st == HC_OK; ++j) {
    bool closed = is_closed(m, j, y);
    if (m->contact[j].law.kn > 0 && closed != w->closed[j]) w->changed = true;
    if (closed && contact_slip_sign(integrate_contact(in, j, y))) w->changed = true;
  }
  return st;
}

enum { PERIODS = 20 };

/* Does a contact change its state within PERIODS from ti->y? */
static bool state_changes(timeint *ti)
{
  watched w = {.ti = ti};
  const long transitions = integrate_transitions(ti->in);
  for (int j = 0; j < ti->scaled.n_contacts; ++j) w.closed[j] = is_closed(&ti->scaled, j, ti->y);
  for (int i = 0; i < PERIODS; ++i)
    assert_int_equal(integrate_period(ti->in, &ti->scaled, ti->y, watch_contacts, &w), HC_OK);
  return w.changed || integrate_transitions(ti->in) > transitions;
}

static double uniform(uint64_t *seed, double a, double b) { return a + (b - a) * random_unit(seed); }

/* x, v and w between *a (t = 0) and *b (t = 1). */
static scene_state between(const scene_state *a, const scene_state *b, double t)
{
  scene_state st = {.x = a->x + t * (b->x - a->x), .v = a->v + t * (b->v - a->v)};
  for (int j = 0; j < SCENE_MAX_CONTACTS; ++j) st.w[j] = a->w[j] + t * (b->w[j] - a->w[j]);
  return st;
}

/* The farthest state in a random direction from the orbit with a yes: no contact changes its state from there, and the
 * free motion decays towards the closed form, by exp(-c/2 theta) of its bound times sqrt((1 + zeta)/(1 - zeta)), < 1.1
 * here. False: not even the orbit has a yes. */
static bool check_farthest(uint64_t *seed, const scene *sc, double omega, double reach)
{
  const double none[SCENE_MAX_CONTACTS] = {0};
  timeint *ti = make(sc);
  assert_int_equal(timeint_set_tolerance(ti, 1e-10), HC_OK);
  const double size = cabs(orbit_of(sc, omega, none).z);
  scene_state a = state_of(sc, omega, none, 0, 0), b = a;
  b.x += uniform(seed, -reach, reach) * size, b.v += uniform(seed, -reach, reach) * size * omega;
  for (int j = 0; j < sc->structure->n_contacts; ++j) b.w[j] += uniform(seed, -reach, reach) * size;
  double low = 0, high = 1;
  bool yes = is_final_from(ti, omega, &a);
  for (int i = 0; i < 40 && yes; ++i) {
    double t = i == 0 ? 1 : 0.5 * (low + high);
    scene_state st = between(&a, &b, t);
    *(is_final_from(ti, omega, &st) ? &low : &high) = t;
    if (low == 1) break;
  }
  if (yes) {
    scene_state st = between(&a, &b, low);
    timeint_result r;
    double end[SCENE_MAX_STATES], began[SCENE_MAX_STATES];
    assert_true(is_final_from(ti, omega, &st));
    memcpy(began, ti->y, (size_t)ti->n * sizeof *ti->y);
    linear_regime_steady(ti, &r);
    memcpy(end, ti->y, (size_t)ti->n * sizeof *ti->y);
    memcpy(ti->y, began, (size_t)ti->n * sizeof *ti->y);
    assert_false(state_changes(ti));
    double k = scene_k(&ti->scaled);
    for (int j = 0; j < sc->structure->n_contacts; ++j)
      if (is_closed(&ti->scaled, j, end))
        k += scene_stuck_stiffness(&sc->structure->contacts[j].given) / (*sc->structure->mass.v * omega * omega);
    double left = 1.1 * hypot(began[0] - end[0], (began[1] - end[1]) / sqrt(k)) * pow(r.multiplier, PERIODS) + 1e-6;
    CHECK_NEAR(ti->y[0], end[0], left, "X");
    CHECK_NEAR(ti->y[1], end[1], left * sqrt(k), "P");
    for (int j = 0; j < sc->structure->n_contacts; ++j)
      if (frictional(&sc->structure->contacts[j].given.law))
        CHECK_NEAR(ti->y[SCALED_W + j], end[SCALED_W + j], left, "W");
  }
  timeint_free(ti);
  return yes;
}

static void a_yes_is_right(CHECK_STATE)
{
  uint64_t seed = 12345;
  int yes = 0, all = 0;
  for (int law = 0; law < 2; ++law)
    for (int i = 0; i < 60; ++i) {
      scene scenes[] = {scene_a10(), scene_b10(), scene_c2(), scene_gap1(), scene_many(), scene_c2kt1e4()};
      scene *sc = &scenes[i % 6];
      sc->transient.law = law;
      if (i % 2) sc->transient.regularisation = 1e-2;
      yes += check_farthest(&seed, sc, uniform(&seed, 3, 20), i % 4 < 2 ? 3 : 30);
      ++all;
    }
  CHECK_LE(0.75 * all, yes, "orbits with a yes"); /* 109 of 120; on the others a state changes, or nearly so */
}

/* -- a no is needed -- */

/* On the orbit itself there is no free motion, and the range is exact. So for the exact law the largest force with a
 * yes is that from which on a contact changes its state: up to the margin of 1e-9 below it none does, 1e-5 above it
 * one does. For the regularised law the condition is stricter by 40 widths: no contact changes its state up to
 * there, and the motion is the closed form to the integrator's errors. */
static void check_up_to_the_edge(const scene *from, const char *name, double omega, const double *w, int law)
{
  scene sc = scene_own(from);
  sc.transient.law = law;
  double low = 1e-3 * from->structure->loads->amplitude, high = 1e3 * from->structure->loads->amplitude;
  for (int i = 0; i < 100; ++i) {
    sc.structure->loads->amplitude = sqrt(low * high);
    scene_state st = state_of(&sc, omega, w, 0, 0);
    *(is_final(&sc, omega, &st) ? &low : &high) = sc.structure->loads->amplitude;
  }
  for (int above = 0; above < (law == TRANSIENT_LAW_EXACT ? 2 : 1); ++above) {
    sc.structure->loads->amplitude = low * (1 + 1e-5 * above);
    timeint *ti = make(&sc);
    scene_state st = state_of(&sc, omega, w, 0, 0);
    CHECK_LE(is_final_from(ti, omega, &st), !above, "%s at %g: the edge is at %g", name, omega, low);
    assert_int_equal(timeint_set_tolerance(ti, 1e-12), HC_OK);
    double began[SCENE_MAX_STATES];
    memcpy(began, ti->y, (size_t)ti->n * sizeof *ti->y);
    const bool changes = state_changes(ti);
    if (changes != above) print_error("%s at %g, law %d, %s %g\n", name, omega, law, above ? "above" : "below", low);
    assert_true(changes == above);
    if (!above)
      CHECK_NEAR(ti->y[SCALED_X], began[SCALED_X], 2e-8, "%s at %g, law %d: stays on the orbit", name, omega, law);
    timeint_free(ti);
  }
}

static void edges(CHECK_STATE)
{
  const double none[SCENE_MAX_CONTACTS] = {0}, held[SCENE_MAX_CONTACTS] = {-0.1, 0, 0.05},
               other[SCENE_MAX_CONTACTS] = {0.1, 0, -0.05};
  scene a10 = scene_a10(), b10 = scene_b10(), c2 = scene_c2(), gap1 = scene_gap1(), many = scene_many();
  scene smooth = scene_a10(); /* mu kn sin > kt cos: separation ends it, not slip */
  smooth.structure->contacts[0].given.law.mu = 0;
  for (int law = 0; law < 2; ++law)
    for (int coarse = 0; coarse < 2; ++coarse) {
      a10.transient.regularisation = b10.transient.regularisation = c2.transient.regularisation = coarse ? 1e-2 : 1e-4;
      gap1.transient.regularisation = many.transient.regularisation = smooth.transient.regularisation =
          coarse ? 1e-2 : 1e-4;
      check_up_to_the_edge(&a10, "a10", 12, none, law);
      check_up_to_the_edge(&a10, "a10, held", 12, held, law);
      check_up_to_the_edge(&a10, "a10, held otherwise", 17, other, law);
      check_up_to_the_edge(&b10, "b10", 5, none, law);
      check_up_to_the_edge(&c2, "c2", 9, none, law);
      check_up_to_the_edge(&gap1, "gap1", 15, none, law);
      check_up_to_the_edge(&many, "many", 7, held, law);
      check_up_to_the_edge(&smooth, "no friction", 10, none, law);
    }
}

/* From rest the free motion is as large as the steady one. */
static void from_rest(CHECK_STATE)
{
  const scene_state rest = {0};
  scene r2 = scene_r2(), a10 = scene_a10(), c2 = scene_c2(), alone = scene_linear(1, 0.4, 40, 10);
  assert_true(is_final(&r2, 700, &rest));
  assert_true(is_final(&a10, 5, &rest));
  assert_true(is_final(&c2, 12, &rest));
  assert_true(is_final(&alone, 6.3, &rest));
  assert_false(is_final(&c2, 7, &rest));
  timeint *ti = make(&r2);
  scene_state st = rest;
  CHECK_FILLED(timeint_result, r, timeint_steady(ti, 700, st.all, NULL, &r));
  CHECK_NEAR(r.amplitude, cabs(linear_response(1.6, 0.4, 8e5, 100, 700)), 1e-14 * r.amplitude, "r2 from rest");
  assert_int_equal(r.periods, 0);
  assert_int_equal(r.steps, 0);
  timeint_free(ti);
  ti = make(&c2); /* the free motion is too large at first; there is a yes once it has decayed to 2.9, from 4.2
                     by 0.73 a period */
  assert_false(is_final_from(ti, 4, &rest));
  while (!linear_regime_is_final(ti) && ti->periods < 30) assert_int_equal(timeint_period(ti, false), HC_OK);
  CHECK_LE(ti->periods, 10, "c2 at 4 from rest");
  timeint_free(ti);
}

static void undamped(CHECK_STATE)
{
  const double none[SCENE_MAX_CONTACTS] = {0};
  const scene_state rest = {0};
  scene sc = scene_b10();
  *sc.structure->damping.v = 0;
  scene_state on = state_of(&sc, 9, none, 0, 0), off = state_of(&sc, 9, none, 1e-6, 0);
  assert_true(is_final(&sc, 9, &on));
  assert_false(is_final(&sc, 9, &off)); /* the free motion does not decay */
  assert_false(is_final(&sc, 9, &rest));
  sc.structure->loads->amplitude = 0;
  timeint_result r;
  timeint *ti = make(&sc);
  assert_true(is_final_from(ti, 9, &rest));
  linear_regime_steady(ti, &r);
  CHECK_LE(fabs(r.amplitude) + fabs(r.mean) + fabs(r.rms), 0, "unloaded, at rest");
  CHECK_NEAR(r.multiplier, 1, 1e-15, "undamped");
  timeint_free(ti);
  scene resonance = scene_linear(1, 0, 81, 10);
  assert_false(is_final(&resonance, 9, &rest));
  *resonance.structure->damping.v = 1e-6; /* it settles, after some million periods */
  assert_true(is_final(&resonance, 9, &rest));
}

static void no_stiffness_and_no_number(CHECK_STATE)
{
  const scene_state rest = {0};
  scene mass = scene_linear(1, 0.4, 0, 10);
  assert_false(is_final(&mass, 9, &rest));
  scene all[] = {scene_a10(), scene_b10()};
  for (int i = 0; i < 2; ++i) {
    timeint *ti = make(&all[i]);
    const double bad[] = {NAN, INFINITY, -INFINITY, DBL_MAX, -DBL_MAX};
    for (size_t b = 0; b < sizeof bad / sizeof *bad; ++b)
      for (int at = 0; at < 2 + (i == 0); ++at) { /* i = 1: the slider of a separated contact does not matter */
        assert_true(is_final_from(ti, 10, &rest));
        ti->y[at] = bad[b];
        assert_false(linear_regime_is_final(ti));
      }
    timeint_free(ti);
  }
}

/* lambda^2 - trace lambda + det = 0 of the free motion's matrix over a period; the larger of the two. A few roundings,
 * whatever the damping. */
static void multipliers(CHECK_STATE)
{
  for (double damping = 0.01; damping < 1000; damping *= 2) {
    scene sc = scene_linear(1, damping, 2, 1);
    const scene_state rest = {0};
    double e[2][2];
    timeint_result r;
    timeint *ti = make(&sc);
    assert_true(is_final_from(ti, 1, &rest));
    linear_regime_steady(ti, &r);
    linear_free_motion(1, damping, 2, 2 * PI, e);
    const double det = exp(-2 * PI * damping);
    const double complex lambda = r.multiplier_re + I * r.multiplier_im;
    CHECK_LE(cabs(lambda * lambda - (e[0][0] + e[1][1]) * lambda + det), 4e-15, "C = %g", damping);
    CHECK_NEAR(r.multiplier, cabs(lambda), 1e-15, "C = %g", damping);
    CHECK_LE(sqrt(det), r.multiplier * (1 + 1e-12), "C = %g: the larger one", damping);
    timeint_free(ti);
  }
}

CHECK_TESTS("timeint.linear_regime", 300, measures, a_slider_keeps_another_contact_open_or_closed, a_yes_is_right,
            edges, from_rest, undamped, no_stiffness_and_no_number, multipliers)
