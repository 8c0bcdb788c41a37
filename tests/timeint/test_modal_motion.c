/* test_modal_motion.c - a linear motion in closed form, against its equation's Taylor series in long double; where
 * guards first fall through 0, against a dense scan; samples and integrals. */
#include "tests/check.h"

#include <float.h>

#include "tests/random.h"
#include "timeint/closed_form/modal_motion.h"

enum { MOST = 3, SCAN = 4000 };

/* (c, k): oscillating, critical and nearly so from both sides, overdamped, free, driven away, resonant and nearly so
 * from both sides of near_resonance (modal_motion.c), soft on both sides of near_free, stiff. */
static const double kinds[][2] = {
    {0.1, 3},
    {0.4, 40},
    {0, 2},
    {0.02, 1.9},
    {4, 4},
    {2, 1},
    {4 * (1 + 1e-6), 4},
    {4 * (1 - 1e-6), 4},
    {4 * (1 + 1e-9), 4},
    {4 * (1 - 1e-9), 4},
    {4 * (1 + 1e-12), 4},
    {4 * (1 - 1e-12), 4},
    {4.1, 4},
    {30, 3},
    {1000, 2},
    {1e5, 2},
    {0, 0},
    {0.3, 0},
    {40, 0},
    {0.1, -2},
    {0, -0.5},
    {0, -1e-3},
    {3, -1},
    {0, 1},
    {1e-9, 1},
    {1e-3, 1},
    {0, 1 + 1e-12},
    {1e-4, 1 - 1e-7},
    {0, 1.25 * (1 - 1e-9)},
    {0, 1.25 * (1 + 1e-9)},
    {0, 0.75 * (1 + 1e-9)},
    {0, 0.75 * (1 - 1e-9)},
    {0.25 * (1 - 1e-9), 1},
    {0.25 * (1 + 1e-9), 1},
    {0.1, 0.01 * (1 - 1e-9)},
    {0.1, 0.01 * (1 + 1e-9)},
    {0, -0.01 * (1 - 1e-9)},
    {0, -0.01 * (1 + 1e-9)},
    {0.2, 1e-12},
    {0.2, -1e-12},
    {0.2, 1e-17},
    {50, 1e-3},
    {0.5, 1e6},
    {2000, 1e6},
    {0, 1e6},
    {1, -30},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

typedef struct made { /* a motion with memory of its own */
  modal_motion motion;
  mode mode[MOST];
  double q[MOST], p[MOST], d[MOST];
  double complex f[MOST];
} made;

static modal_point point_in(double room[4][MOST])
{
  return (modal_point){.q = room[0], .p = room[1], .a = room[2], .j = room[3]};
}

/* Everything random of order 1, the velocity and the force in proportion to a stiff mode's, on modes of these kinds. */
static void make(made *m, int n, const int *kind, uint64_t *seed)
{
  m->motion =
      (modal_motion){.n = n, .theta = 2 * PI * random_unit(seed), .mode = m->mode, .q = m->q, .p = m->p, .d = m->d};
  m->motion.f = m->f;
  for (int i = 0; i < n; ++i) {
    const double k = fmax(1, fabs(kinds[kind[i]][1]));
    m->mode[i] = mode_make(kinds[kind[i]][0], kinds[kind[i]][1]);
    m->q[i] = random_signed(seed);
    m->p[i] = sqrt(k) * random_signed(seed);
    m->d[i] = k * random_signed(seed);
    m->f[i] = k * (random_signed(seed) + I * random_signed(seed));
  }
}

/* q, p after tau by the Taylor series of the equation, in steps that are short for the mode: 30 terms of
 * (1/2)^n/n! leave nothing. */
static void by_series(const made *m, int i, double tau, long double *q, long double *p)
{
  const long double c = m->mode[i].c, k = m->mode[i].k, rate = 1 + c + sqrtl(fabsl(k));
  const int steps = 1 + (int)(2 * rate * tau);
  const long double h = (long double)tau / steps;
  *q = m->q[i], *p = m->p[i];
  for (int s = 0; s < steps; ++s) {
    const long double theta = (long double)m->motion.theta + s * h;
    const long double complex f = (long double complex)m->f[i] * (cosl(theta) + I * sinl(theta));
    long double d0 = *q, d1 = *p, power = 1, x = d0, v = d1;
    long double complex force = f;
    for (int n = 0; n < 30; ++n) { /* d0, d1: derivatives n, n + 1 */
      const long double d2 = (n == 0 ? m->d[i] : 0) + creall(force) - c * d1 - k * d0;
      power *= h / (n + 1);
      x += d1 * power;
      v += d2 * power;
      d0 = d1, d1 = d2, force *= I;
    }
    *q = x, *p = v;
  }
}

/* How large rounding may make the error of q. The roots' moduli are at most `rate`, of the growing one `grows`; an
 * argument root * tau is rounded, as is the angle theta + tau; 1/k and 1/(k - 1 + i c) are at most 100 and 4 where they
 * are divided by, and where not the responses grow no faster than tau^2/2 and tau. */
static double rounding(const made *m, int i, double tau)
{
  const double c = m->mode[i].c, k = m->mode[i].k, grow = exp(m->mode[i].grows * tau);
  const double rate = sqrt(fabs(k)) + (c * c < 4 * k ? 0 : fmin(c, 1)), t = fmin(tau, 1 / fmax(rate, 1e-3));
  const double by_d = m->mode[i].soft ? tau * tau : 1 / fabs(k),
               by_f = m->mode[i].resonant ? tau : cabs(m->mode[i].response);
  const double size = fabs(m->q[i]) + fabs(m->p[i]) * t + fabs(m->d[i]) * by_d + cabs(m->f[i]) * by_f;
  return DBL_EPSILON * (1 + rate * tau + m->motion.theta + tau) * grow * size;
}

/* 4 roundings of that size (worst seen: 1.1); q' and so p carry the factor of the mode's rate. */
static void each_mode_obeys_its_equation(CHECK_STATE)
{
  uint64_t seed = 11;
  double worst[2] = {0};
  for (int kind = 0; kind < KINDS; ++kind)
    for (int trial = 0; trial < (kinds[kind][0] > 1e4 ? 2 : fabs(kinds[kind][1]) > 1e3 ? 5 : 60); ++trial) {
      made m;
      double room[4][MOST];
      modal_point at = point_in(room);
      long double q, p;
      make(&m, 1, &kind, &seed);
      const double tau = trial == 0 ? 2 * PI : trial == 1 ? 1e-9 : 2 * PI * random_unit(&seed);
      modal_at(&m.motion, tau, &at);
      by_series(&m, 0, tau, &q, &p);
      const double rate = 1 + sqrt(fabs(m.mode[0].k)) + fmin(m.mode[0].c, 1), unit = rounding(&m, 0, tau);
      const double eq = (double)fabsl(at.q[0] - q) / unit, ep = (double)fabsl(at.p[0] - p) / unit / rate;
      worst[0] = fmax(worst[0], eq), worst[1] = fmax(worst[1], ep);
      CHECK_LE(eq, 4, "q, c %.17g k %.17g tau %g: %.17g", m.mode[0].c, m.mode[0].k, tau, at.q[0]);
      CHECK_LE(ep, 4, "p, c %.17g k %.17g tau %g: %.17g", m.mode[0].c, m.mode[0].k, tau, at.p[0]);
    }
  print_message("worst: q %.2f, p %.2f of 4\n", worst[0], worst[1]);
}

static double guard_at(const made *m, const modal_guard *g, double tau, double *slope)
{
  double room[4][MOST], value = g->constant;
  modal_point at = point_in(room);
  modal_at(&m->motion, tau, &at);
  *slope = 0;
  for (int i = 0; i < m->motion.n; ++i) {
    if (g->by_q) value += g->by_q[i] * at.q[i], *slope += g->by_q[i] * at.p[i];
    if (g->by_p) value += g->by_p[i] * at.p[i], *slope += g->by_p[i] * at.a[i];
  }
  return value;
}

/* What a guard's value may err by: that of the states it is made of. */
static double guard_noise(const made *m, const modal_guard *g, double span)
{
  double noise = DBL_EPSILON * fabs(g->constant);
  for (int i = 0; i < m->motion.n; ++i) {
    const double rate = 1 + sqrt(fabs(m->mode[i].k)) + fmin(m->mode[i].c, 1), unit = rounding(m, i, span);
    if (g->by_q) noise += 4 * fabs(g->by_q[i]) * unit;
    if (g->by_p) noise += 4 * fabs(g->by_p[i]) * unit * rate;
  }
  return noise;
}

/* Where the guard is below -2 noise for the first time (it may pass -noise in a step), by SCAN points and
 * then bisection: INFINITY if at none. */
static double scanned_root(const made *m, const modal_guard *g, double span)
{
  double slope, low = 0, high = INFINITY;
  for (int i = 0; i <= SCAN && high == INFINITY; ++i) {
    const double tau = span * i / SCAN;
    if (guard_at(m, g, tau, &slope) < -2 * g->noise) high = tau;
    else low = tau;
  }
  for (int b = 0; b < 60 && high < INFINITY && high > low; ++b) {
    const double mid = 0.5 * (low + high);
    if (guard_at(m, g, mid, &slope) < -2 * g->noise) high = mid;
    else low = mid;
  }
  return high;
}

typedef struct crossing { /* what modal_first_crossing answers */
  int first;
  double tau;
  long evaluations;
} crossing;

static crossing cross(const made *m, double span, int n, const modal_guard *guards)
{
  double room[4][MOST], more[4][MOST], again[4][MOST];
  modal_point at = point_in(room), scratch = point_in(more), want = point_in(again);
  crossing c = {.evaluations = 0};
  c.first = modal_first_crossing(&m->motion, span, n, guards, &at, &scratch, &c.evaluations);
  c.tau = at.tau;
  modal_at(&m->motion, at.tau, &want); /* *at is a point of the motion */
  for (int i = 0; i < 4; ++i) assert_memory_equal(room[i], again[i], sizeof(double) * (size_t)m->motion.n);
  return c;
}

/* The answer is no later than the first excursion below -2 noise that the scan sees (its own bisection and the root's
 * rounding apart), is a root of the guard named, and before it no guard is below -noise. */
static long check_crossing(const made *m, double span, int n, const modal_guard *guards)
{
  const crossing c = cross(m, span, n, guards);
  double slope;
  assert_in_range(c.first + 1, 0, n);
  CHECK_LE(c.tau, span, "in the span");
  if (c.first < 0) CHECK_NEAR(c.tau, span, 0, "the end");
  for (int g = 0; g < n; ++g) {
    const double seen = scanned_root(m, &guards[g], span);
    if (seen < INFINITY) assert_true(c.first >= 0);
    if (c.first >= 0) CHECK_LE(c.tau, seen + 8 * DBL_EPSILON * (1 + seen + m->motion.theta), "guard %d is missed", g);
  }
  if (c.first < 0) return c.evaluations;
  const modal_guard *hit = &guards[c.first];
  const double value = guard_at(m, hit, c.tau, &slope);
  if (c.tau > 0)
    CHECK_LE(fabs(value), 2 * hit->noise + 4 * DBL_EPSILON * (1 + c.tau + m->motion.theta) * fabs(slope), "a root");
  else CHECK_LE(value, hit->noise, "below 0 at the beginning");
  return c.evaluations;
}

static void random_guard(const made *m, modal_guard *g, double by_q[MOST], double by_p[MOST], double span,
                         uint64_t *seed)
{
  const int which = random_int(seed, 0, 2);
  for (int i = 0; i < MOST; ++i) {
    const double k = i < m->motion.n ? fmax(1, fabs(m->mode[i].k)) : 1;
    by_q[i] = random_signed(seed), by_p[i] = random_signed(seed) / sqrt(k);
  }
  *g = (modal_guard){.by_q = which == 1 ? NULL : by_q, .by_p = which == 0 ? NULL : by_p};
  g->constant = 2 * random_signed(seed);
  g->noise = guard_noise(m, g, span);
}

/* Up to three modes of any kind, three guards. */
static void no_random_crossing_is_missed(CHECK_STATE)
{
  uint64_t seed = 5;
  long most = 0, sum = 0;
  enum { TRIALS = CHECK_TRIALS(1200) };
  for (int trial = 0; trial < TRIALS; ++trial) {
    int kind[MOST];
    made m;
    const int n = random_int(&seed, 1, MOST);
    for (int i = 0; i < n; ++i) kind[i] = random_int(&seed, 0, KINDS - 1);
    make(&m, n, kind, &seed);
    double span = random_int(&seed, 0, 9) == 0 ? 1e-9 * random_unit(&seed) : 2 * PI * random_unit(&seed);
    for (int i = 0; i < n; ++i) /* what grows e^5-fold has the noise of that from the beginning on */
      if (m.mode[i].grows > 1) span = fmin(span, 5 / m.mode[i].grows);
    modal_guard guards[3];
    double by[6][MOST];
    for (int g = 0; g < 3; ++g) random_guard(&m, &guards[g], by[2 * g], by[2 * g + 1], span, &seed);
    const long evaluations = check_crossing(&m, span, 3, guards);
    most = evaluations > most ? evaluations : most;
    sum += evaluations;
  }
  print_message("evaluations: %ld on the average, at most %ld\n", sum / TRIALS, most);
}

/* The least value of a guard and where it is taken: its slope's sign change next to the smallest of SCAN values. */
static double lowest(const made *m, const modal_guard *g, double span, double *where)
{
  double slope, best = INFINITY;
  int at = 0;
  for (int i = 0; i <= SCAN; ++i) {
    const double f = guard_at(m, g, span * i / SCAN, &slope);
    if (f < best) best = f, at = i;
  }
  double low = span * (at > 0 ? at - 1 : 0) / SCAN, high = span * (at < SCAN ? at + 1 : SCAN) / SCAN;
  for (int b = 0; b < 60; ++b) {
    const double mid = 0.5 * (low + high);
    guard_at(m, g, mid, &slope);
    if (slope < 0) low = mid;
    else high = mid;
  }
  *where = 0.5 * (low + high);
  return guard_at(m, g, *where, &slope);
}

/* The constant such that the least value inside the span is `depth` below 0, or above. What is deeper than the noise is
 * seen, at the first of the two roots next to it, or before if there are several minima; what stays above 0 by
 * more than that is not. */
static void grazes(CHECK_STATE)
{
  const double depths[] = {1e-6, 1e-9, 1e-12, 1e-13, 0, -1e-13, -1e-12, -1e-9};
  uint64_t seed = 23;
  int met = 0;
  long most = 0;
  for (int trial = 0; trial < CHECK_TRIALS(400); ++trial) {
    int kind[MOST];
    made m;
    const int n = random_int(&seed, 1, MOST);
    for (int i = 0; i < n; ++i) do
        kind[i] = random_int(&seed, 0, KINDS - 1);
      while (fabs(kinds[kind[i]][1]) > 100 || kinds[kind[i]][0] > 100); /* the scan resolves them */
    make(&m, n, kind, &seed);
    const double span = 2 * PI * (0.1 + 0.9 * random_unit(&seed));
    modal_guard g;
    double by_q[MOST], by_p[MOST], where, slope;
    random_guard(&m, &g, by_q, by_p, span, &seed);
    const double least = lowest(&m, &g, span, &where), was = g.constant;
    if (!(where > 0.01 * span && where < 0.99 * span)) continue;
    for (size_t i = 0; i < sizeof depths / sizeof *depths; ++i) {
      g.constant = was - least - depths[i];
      g.noise = guard_noise(&m, &g, span);
      const crossing c = cross(&m, span, 1, &g);
      most = c.evaluations > most ? c.evaluations : most;
      if (depths[i] > 3 * g.noise) {
        assert_int_equal(c.first, 0);
        CHECK_LE(c.tau, where, "before the least value, %g", depths[i]);
        CHECK_NEAR(guard_at(&m, &g, c.tau, &slope), 0, 2 * g.noise + 1e-14 * fabs(slope), "a root");
      } else if (depths[i] < -3 * g.noise) {
        assert_int_equal(c.first, -1);
      }
      if (depths[i] != 0) check_crossing(&m, span, 1, &g);
      ++met;
    }
  }
  assert_true(met > CHECK_TRIALS(1000));
  print_message("evaluations: at most %ld\n", most);
}

/* g and 2 g vanish at one instant; a guard that is 0 at the beginning ends the span there if it falls, and not if it
 * grows, by whatever rounding it is off. */
static void guards_that_vanish_together_or_at_once(CHECK_STATE)
{
  uint64_t seed = 37;
  int together = 0, at_once = 0, grown = 0;
  for (int trial = 0; trial < CHECK_TRIALS(2000); ++trial) {
    int kind[MOST];
    made m;
    const int n = random_int(&seed, 1, MOST);
    for (int i = 0; i < n; ++i) kind[i] = random_int(&seed, 0, KINDS - 1);
    make(&m, n, kind, &seed);
    modal_guard g[2];
    double by[4][MOST], slope;
    random_guard(&m, &g[0], by[0], by[1], 2 * PI, &seed);
    for (int i = 0; i < MOST; ++i) by[2][i] = 2 * by[0][i], by[3][i] = 2 * by[1][i];
    g[1] = (modal_guard){.by_q = g[0].by_q ? by[2] : NULL, .by_p = g[0].by_p ? by[3] : NULL};
    g[1].constant = 2 * g[0].constant, g[1].noise = 2 * g[0].noise;
    const crossing one = cross(&m, 2 * PI, 1, g), both = cross(&m, 2 * PI, 2, g);
    assert_int_equal(one.first < 0, both.first < 0);
    if (one.tau > 0) CHECK_NEAR(one.tau, both.tau, 1e-9, "the same instant"); /* in doubt by noise/slope */
    together += one.first >= 0;
    const int off = random_int(&seed, -1, 1); /* roundings */
    g[0].constant = 0;
    g[0].constant = -guard_at(&m, &g[0], 0, &slope);
    g[0].noise = guard_noise(&m, &g[0], 1e-3);
    g[0].constant += off * 0.25 * g[0].noise;
    if (fabs(slope) < 1e-3) continue;
    const crossing c = cross(&m, 1e-3, 1, g);
    if (slope < 0) {
      assert_int_equal(c.first, 0);
      CHECK_LE(c.tau, 2 * g[0].noise / -slope + 1e-15, "at once");
      ++at_once;
    } else {
      if (c.first == 0) CHECK_LE(1e-9, c.tau, "it grows first");
      ++grown;
    }
  }
  assert_true(together > CHECK_TRIALS(300) && at_once > CHECK_TRIALS(300) && grown > CHECK_TRIALS(300));
}

/* q = cosh(tau), g = C - q: g'' grows in the step, so that C - q'' tau^2/2 of the beginning passes 0 later than g. */
static void a_mode_that_is_driven_away(CHECK_STATE)
{
  const double by = -1;
  made m = {.q = {1}};
  m.mode[0] = mode_make(0, -1);
  m.motion = (modal_motion){.n = 1, .mode = m.mode, .q = m.q, .p = m.p, .d = m.d, .f = m.f};
  for (double constant = 1.01; constant < 1.6; constant += 0.02) {
    const modal_guard g = {.by_q = &by, .constant = constant, .noise = DBL_EPSILON};
    const crossing c = cross(&m, 2 * PI, 1, &g);
    assert_int_equal(c.first, 0);
    CHECK_NEAR(c.tau, acosh(constant), 8 * DBL_EPSILON / sinh(acosh(constant)), "constant %g", constant);
  }
}

/* A guard below 0 at the beginning; no guard; no span; no number. */
static void ends_of_the_range(CHECK_STATE)
{
  const int kind = 1;
  const double by = 1;
  uint64_t seed = 3;
  made m;
  make(&m, 1, &kind, &seed);
  modal_guard g = {.by_q = &by, .constant = -10, .noise = 1e-15};
  crossing c = cross(&m, 1, 1, &g);
  assert_true(c.first == 0 && c.tau == 0);
  c = cross(&m, 1, 0, NULL);
  assert_true(c.first == -1 && c.tau == 1);
  g.constant = 10;
  c = cross(&m, 0, 1, &g);
  assert_true(c.first == -1 && c.tau == 0);
  c = cross(&m, DBL_MIN, 1, &g);
  assert_true(c.first == -1 && c.tau == DBL_MIN);
  const double bad[] = {NAN, INFINITY};
  for (int i = 0; i < 2; ++i) {
    double room[4][MOST], more[4][MOST];
    modal_point at = point_in(room), scratch = point_in(more);
    long evaluations = 0;
    made broken = m;
    broken.motion.q = &broken.q[0], broken.q[0] = bad[i];
    g.constant = 1;
    modal_first_crossing(&broken.motion, 1, 1, &g, &at, &scratch, &evaluations);
    assert_false(isfinite(at.q[0] + at.p[0] + at.a[0]));
    CHECK_LE((double)evaluations, 1000, "it ends");
  }
}

/* Steps of a recurrence, started anew after 32: as many roundings more. */
static void samples_are_the_motion(CHECK_STATE)
{
  uint64_t seed = 41;
  double worst = 0;
  for (int kind = 0; kind < KINDS; ++kind)
    for (int trial = 0; trial < 10; ++trial) {
      made m;
      enum { COUNT = 100 };
      double samples[COUNT], room[4][MOST];
      modal_point at = point_in(room);
      make(&m, 1, &kind, &seed);
      const double from = m.motion.theta + (trial % 2) * random_unit(&seed), step = 2 * PI / 512;
      modal_samples(&m.motion, 0, from, step, COUNT, samples);
      for (int i = 0; i < COUNT; ++i) {
        const double tau = from + i * step - m.motion.theta, unit = rounding(&m, 0, tau + 32 * step);
        modal_at(&m.motion, tau, &at);
        worst = fmax(worst, fabs(samples[i] - at.q[0]) / unit);
        CHECK_NEAR(samples[i], at.q[0], 12 * unit, "c %g k %g sample %d", m.mode[0].c, m.mode[0].k, i);
      }
    }
  print_message("worst: %.1f of 12\n", worst);
}

/* Gauss-Legendre with 5 points in panels of h: its error is h^11 d^10/1e12, d the tenth derivative. */
static void quadrature(const made *m, double from, double to, int panels, double out[3])
{
  static const double x[] = {0, 0.5384693101056830910, 0.9061798459386639928};
  static const double w[] = {0.5688888888888888889, 0.4786286704993664680, 0.2369268850561890875};
  double room[4][MOST];
  modal_point at = point_in(room);
  out[0] = out[1] = out[2] = 0;
  for (int i = 0; i < panels; ++i)
    for (int j = -2; j <= 2; ++j) {
      const double h = (to - from) / panels, side = j < 0 ? -1 : 1;
      const double tau = from + (i + 0.5) * h + 0.5 * h * side * x[abs(j)], share = 0.5 * h * w[abs(j)];
      modal_at(&m->motion, tau, &at);
      out[0] += share * at.q[0];
      out[1] += share * at.q[0] * cos(m->motion.theta + tau);
      out[2] += share * at.q[0] * sin(m->motion.theta + tau);
    }
}

/* Differences of p, (1 + c) q and integrals of the force, divided by k and k - 1 + i c: that is where roundings grow,
 * next to those of the quadrature's own values. */
static void integrals_are_those_of_the_motion(CHECK_STATE)
{
  uint64_t seed = 43;
  double worst = 0;
  int told = 0;
  for (int kind = 0; kind < KINDS; ++kind)
    for (int trial = 0; trial < 10; ++trial) {
      made m;
      double room[2][4][MOST], got[3], want[3];
      modal_point from = point_in(room[0]), to = point_in(room[1]);
      make(&m, 1, &kind, &seed);
      const double c = m.mode[0].c, k = m.mode[0].k, begin = trial % 3 ? random_unit(&seed) : 0;
      const double part = fmin(1, (trial > 0 ? 300 : 3000) / (1 + c + sqrt(fabs(k)))); /* of 20 panels a turn */
      const double end = begin + (trial == 4 ? 1e-6 : 3 * part * random_unit(&seed));
      modal_at(&m.motion, begin, &from);
      modal_at(&m.motion, end, &to);
      const bool known = modal_fourier(&m.motion, 0, &from, &to, got);
      assert_int_equal(known, !(fabs(k) < 0.01 || cabs(k - 1 + I * c) < 1e-3));
      if (!known) continue;
      ++told;
      const double rate = 1 + c + sqrt(fabs(k)), unit = rounding(&m, 0, end);
      const double divisor = fmin(fabs(k), cabs(k - 1 + I * c));
      const double size =
          unit * (end - begin) +
          ((rate + c) * unit + DBL_EPSILON * (fabs(m.d[0]) + cabs(m.f[0])) * (1 + m.motion.theta + end)) / divisor;
      quadrature(&m, begin, end, (int)(20 + 20 * rate * (end - begin)), want);
      for (int i = 0; i < 3; ++i) {
        worst = fmax(worst, fabs(got[i] - want[i]) / size);
        CHECK_NEAR(got[i], want[i], 4 * size, "integral %d, c %g k %g", i, c, k);
      }
    }
  assert_true(told > 200);
  print_message("worst: %.2f of 4\n", worst);
}

CHECK_TESTS("timeint.modal_motion", 120, each_mode_obeys_its_equation, no_random_crossing_is_missed, grazes,
            guards_that_vanish_together_or_at_once, a_mode_that_is_driven_away, ends_of_the_range,
            samples_are_the_motion, integrals_are_those_of_the_motion)
