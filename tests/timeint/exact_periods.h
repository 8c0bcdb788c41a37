/* exact_periods.h - periods of the exact law of oscillators, whoever integrates them: scenes, and the monodromy matrix
 * against differences. */
#pragma once

#include <float.h>

#include "tests/scene_parts.h"
#include "tests/timeint/oracle.h"
#include "tests/timeint/scenes.h"

typedef struct exact_way {
  integrator *(*make)(const scaled_model *m);
  double noise;          /* [1] of what a period's end is by differences */
  double off, off_grows; /* [length] from the oracle in the first period; more with each */
} exact_way;

static scaled_model exact_model(scene sc, double omega, double length)
{
  sc.transient.law = TRANSIENT_LAW_EXACT;
  scaled_model m;
  scene_scaled(&m, &sc, omega, length);
  return m;
}

static void run(integrator *in, const scaled_model *m, double *y, int periods)
{
  for (int i = 0; i < periods; ++i) assert_int_equal(integrate_period(in, m, y, NULL, NULL), HC_OK);
}

static scene one(double force, double kt, double kn, double mu, double gap, double angle)
{
  scene sc = scene_linear(1, 0.4, 40, force);
  scene_add(&sc, kt, kn, mu, gap, angle);
  return sc;
}

static scene three_contacts(void)
{
  scene sc = scene_linear(1, 0.4, 40, 60);
  scene_add(&sc, 100, 200, 0.3, -0.5, 45);
  scene_add(&sc, 80, 50, 0.5, 1.2, 20);
  scene_add(&sc, 300, 400, 0.1, -2, 70);
  return sc;
}

/* The monodromy matrix against central differences of the period map with Richardson's h^4. `noise` of a period, over
 * h = 1e-4; truncation (piecewise smooth, fifth derivative up to 1e3 times 12)
 * h^4 * 1e3. A slider that stuck where it touched has T and N vanish together; moved by h it slips over a stretch of
 * about h before it separates: an error h |h|, so Richardson's h there, h^2 * 1e2 being left. A slider slaved at the
 * start moves with x; its own column is zero. */
static void check_monodromy(const exact_way *way, const char *what, scene sc, double omega, double length,
                            const double *start, int periods, bool no_slip)
{
  scaled_model m = exact_model(sc, omega, length);
  const int n = m.n_states;
  const double h = 1e-4;
  double y[SCENE_MAX_STATES] = {0}, end[SCENE_MAX_STATES], monodromy[SCENE_MAX_STATES * SCENE_MAX_STATES];
  if (start) memcpy(y, start, sizeof *y * (size_t)n);
  integrator *in = way->make(&m);
  run(in, &m, y, periods);
  memcpy(end, y, sizeof end);
  assert_int_equal(integrate_monodromy(in, &m, end, monodromy), HC_OK);
  double plain[SCENE_MAX_STATES], size = 1;
  memcpy(plain, y, sizeof plain);
  run(in, &m, plain, 1);
  for (int i = 0; i < n; ++i) CHECK_NEAR(end[i], plain[i], 0, "the same period");
  for (int i = 0; i < n * n; ++i) size = fmax(size, fabs(monodromy[i]));
  for (int q = 0; q < n; ++q) {
    double column = 0, diff[SCENE_MAX_STATES] = {0};
    for (int i = 0; i < n; ++i) column += fabs(monodromy[i + q * n]);
    if (q >= SCALED_W && column == 0) continue;
    const double smooth[] = {-1 / 12.0, 8 / 12.0, -8 / 12.0, 1 / 12.0}, kinked[] = {-1 / 4.0, 1, -1, 1 / 4.0};
    const double *weight = q < SCALED_W ? smooth : kinked, truncation = q < SCALED_W ? 1e3 * pow(h, 4) : 1e2 * h * h;
    for (int k = 0; k < 4; ++k) {
      const double by = (k < 2 ? 2 - k : 1 - k) * h; /* 2, 1, -1, -2 */
      double z[SCENE_MAX_STATES];
      memcpy(z, y, sizeof z);
      z[q] += by;
      for (int j = 0; j < m.n_contacts; ++j) { /* sliders without a column of their own stay where the law has them */
        double own = 0;
        for (int i = 0; i < n; ++i) own += fabs(monodromy[i + (SCALED_W + j) * n]);
        const scaled_contact *c = &m.contact[j];
        const double g = scene_sine(&m, c) * y[0] + c->law.gap,
                     t = c->law.kt * (scene_cosine(&m, c) * y[0] - y[SCALED_W + j]);
        const double s = g > 0 && c->law.has_friction ? (t > 0 ? 1 : -1) : 0;
        if (own == 0 && q == SCALED_X)
          z[SCALED_W + j] +=
              (scene_cosine(&m, c) - (s != 0 ? s * c->law.mu * c->law.kn * scene_sine(&m, c) / c->law.kt : 0)) * by;
      }
      run(in, &m, z, 1);
      for (int i = 0; i < n; ++i) diff[i] += weight[k] * z[i] / h;
    }
    for (int i = 0; i < n; ++i)
      CHECK_NEAR(monodromy[i + q * n], diff[i], size * (way->noise / h + truncation), "%s: d y%d / d y%d", what, i, q);
  }
  if (no_slip) { /* volume shrinks by the damping alone, in every phase without slip */
    double det = monodromy[0] * monodromy[1 + n] - monodromy[1] * monodromy[n],
           damping = exp(-*sc.structure->damping.v / *sc.structure->mass.v * 2 * PI / omega);
    CHECK_NEAR(det, damping, 64 * DBL_EPSILON * size * size, "%s: determinant", what);
  }
  integrate_free(in);
}

static void check_monodromies(const exact_way *way)
{
  const double high[] = {23 / 24.0, 0, 0.6};
  check_monodromy(way, "c2", scene_c2(), 9, 24, high, 100, true);
  check_monodromy(way, "c2", scene_c2(), 7, 10, NULL, 100, true);
  check_monodromy(way, "b10", scene_b10(), 7, 1, NULL, 100, false);
  check_monodromy(way, "a10", scene_a10(), 13, 0.7, NULL, 100, false);
  const double r2[] = {0.0724587530 / 0.299294926, 205.420778 / 708.5 / 0.299294926, 0.05123607 / 0.299294926};
  check_monodromy(way, "r2", scene_r2(), 708.5, 0.299294926, r2, 2, false);
  check_monodromy(way, "gap1, stuck", scene_gap1(), 7, 1, NULL, 50, true);
  for (int i = 1; i < 6; ++i) check_monodromy(way, "three", three_contacts(), 6 + 0.3 * i, 2, NULL, 10 * i, false);
}

/* The contact's edge where the separated motion ends its period, to a few roundings: the transition falls on 2 pi,
 * before, after, or just does not happen. By how much more than roundings X, and P, may be off by that: a contact of
 * 1e-10/|P|, a few steps more, or a root in the last one. */
static void check_transition_at_the_end(const exact_way *way, double of_x, double of_p)
{
  scaled_model m = exact_model(one(100, 300, 200, 0.3, -0.5, 45), 7.3, 10);
  const double start[SCENE_MAX_STATES] = {0.02, -0.578, 0}; /* ends at its largest X, rising */
  m.contact[0].law.gap = -100;
  integrator *in = way->make(&m);
  double end[SCENE_MAX_STATES];
  memcpy(end, start, sizeof end);
  run(in, &m, end, 1);
  int touched = 0, n = 0;
  for (double off = 0; off<1e-10; off = off> 0 ? 1.3 * off : 1e-17)
    for (int sign = -1; sign <= 1; sign += 2, ++n) {
      double y[SCENE_MAX_STATES], monodromy[9];
      memcpy(y, start, sizeof y);
      m.contact[0].law.gap = -scene_sine(&m, &m.contact[0]) * (end[0] + sign * off);
      long before = integrate_transitions(in);
      assert_int_equal(integrate_monodromy(in, &m, y, monodromy), HC_OK);
      touched += integrate_transitions(in) > before;
      CHECK_NEAR(y[0], end[0], of_x, "x, off %g", off);
      CHECK_NEAR(y[1], end[1], of_p, "p, off %g", off);
      run(in, &m, y, 1); /* and from there */
    }
  assert_true(touched > n / 3 && touched < n);
  integrate_free(in);
}

/* From rest (w = 0: stuck if touching). */
static double follow_oracle(const exact_way *way, const char *what, scene sc, double omega, double length, int periods)
{
  scaled_model m = exact_model(sc, omega, length);
  oracle o = {.m = &m};
  for (int j = 0; j < m.n_contacts; ++j)
    o.state[j] = m.contact[j].law.kn > 0 && m.contact[j].law.gap > 0 ? STUCK : APART;
  integrator *in = way->make(&m);
  double y[SCENE_MAX_STATES] = {0}, worst = 0;
  for (int i = 0; i < periods; ++i) {
    run(in, &m, y, 1);
    oracle_period(&o);
    const double bound = way->off + i * way->off_grows;
    worst = fmax(worst, fmax(fabs(y[SCALED_X] - o.x), fabs(y[SCALED_P] - o.p)));
    CHECK_NEAR(y[SCALED_X], o.x, bound, "%s x in period %d", what, i);
    CHECK_NEAR(y[SCALED_P], o.p, bound, "%s p in period %d", what, i);
    for (int j = 0; j < m.n_contacts; ++j)
      CHECK_NEAR(y[SCALED_W + j], oracle_slider(&o, j), bound, "%s w%d in period %d", what, j, i);
    /* by CVODE, at rest on the edge of contact, a stick of no length comes before the slip */
    const bool at_edge = way->off_grows > 0 && m.n_contacts == 1 && m.contact[0].law.gap == 0;
    CHECK_NEAR((double)integrate_transitions(in), (double)o.events, at_edge ? 1 : 0, "%s transitions", what);
  }
  integrate_free(in);
  return worst;
}

static void scenes_follow_the_oracle(const exact_way *way)
{
  const struct {
    const char *what;
    scene of;
    double omega, length;
    int periods;
  } all[] = {{"linear", scene_linear(1, 0.4, 40, 100), 7, 10, 20},
             {"c2", scene_c2(), 7, 10, 20}, /* bilinear */
             {"c2kn1e4", scene_c2kn1e4(), 7, 10, 20},
             {"b10", scene_b10(), 7, 1, 20},
             {"a10", scene_a10(), 13, 0.7, 20},
             {"c2kt1e4", scene_c2kt1e4(), 7, 10, 20},
             {"gap1", scene_gap1(), 9, 10, 20},
             {"r1", scene_r1(), 930, 0.3, 200},
             {"r2", scene_r2(), 708.5, 0.3, 200}, /* first touch after 150 periods */
             {"three", three_contacts(), 7, 2, 20},
             {"alpha 0", one(100, 100, 200, 0.3, 0.5, 0), 9, 2, 20}, /* Jenkins: constant limit */
             {"alpha 0, apart", one(100, 100, 200, 0.3, -0.5, 0), 9, 2, 5},
             {"alpha 90", one(100, 100, 200, 0.3, -0.5, 90), 9, 2, 20},
             {"mu 0", one(100, 100, 200, 0, -0.5, 45), 9, 2, 20},
             {"kt 0", one(100, 0, 200, 0.3, 0.5, 45), 9, 2, 20},
             {"kn 0", one(100, 100, 0, 0.3, 0.5, 45), 9, 2, 5},
             {"gap 0, sticks", one(100, 50, 200, 0.3, 0, 45), 9, 2, 20},
             {"gap 0, slips", one(100, 300, 200, 0.3, 0, 45), 9, 2, 20}};
  double worst = 0;
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
    worst = fmax(worst, follow_oracle(way, all[i].what, all[i].of, all[i].omega, all[i].length, all[i].periods));
  print_message("worst: %.2g\n", worst);
}

/* No force, at rest, also at the edge of contacts: the root function of P is not exactly 0 all the time, which would be
 * an error to CVODE. */
static void check_rest(const exact_way *way)
{
  const double gap[] = {0.5, 0, -0.5};
  for (int i = 0; i < 3; ++i)
    for (int angle = 0; angle <= 90; angle += 45) {
      scaled_model m = exact_model(one(0, 100, 200, 0.3, gap[i], angle), 7, 1);
      integrator *in = way->make(&m);
      double y[SCENE_MAX_STATES] = {0};
      run(in, &m, y, 5);
      CHECK_NEAR(fabs(y[0]) + fabs(y[1]) + fabs(y[2]), 0, 0, "gap %g", gap[i]);
      integrate_free(in);
    }
}
