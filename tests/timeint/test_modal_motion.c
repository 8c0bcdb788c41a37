/* test_modal_motion.c - a linear motion in closed form, against its equation's Taylor series in long double; where
 * guards first fall through 0, against a dense scan; samples and integrals. */
#include "tests/check.h"

#include <float.h>

#include "numerics/random.h"
#include "timeint/closed_form/modal_motion.h"

enum { SCAN = 4000 };

/* (c, k): oscillating, critical and nearly so from both sides, overdamped, free, driven away, resonant and nearly so
 * from both sides of near_resonance (modal_motion.c), soft on both sides of near_free, stiff. */
static const double kinds[][2] = {{0.1, 3},
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
                                  {1, -30}};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* Everything random of order 1, the velocity and the force in proportion to a stiff mode's. */
static modal_motion make(int kind, uint64_t *seed)
{
  const double k = fmax(1, fabs(kinds[kind][1]));
  modal_motion m = {.mode = mode_make(kinds[kind][0], kinds[kind][1]), .theta = 2 * PI * random_unit(seed)};
  m.q = random_signed(seed);
  m.p = sqrt(k) * random_signed(seed);
  m.d = k * random_signed(seed);
  m.f = k * (random_signed(seed) + I * random_signed(seed));
  return m;
}

/* q, p after tau by the Taylor series of the equation, in steps that are short for the mode: 30 terms of
 * (1/2)^n/n! leave nothing. */
static void by_series(const modal_motion *m, double tau, long double *q, long double *p)
{
  const long double c = m->mode.c, k = m->mode.k, rate = 1 + c + sqrtl(fabsl(k));
  const int steps = 1 + (int)(2 * rate * tau);
  const long double h = (long double)tau / steps;
  *q = m->q, *p = m->p;
  for (int s = 0; s < steps; ++s) {
    const long double theta = (long double)m->theta + s * h;
    const long double complex f = (long double complex)m->f * (cosl(theta) + I * sinl(theta));
    long double d0 = *q, d1 = *p, power = 1, x = d0, v = d1;
    long double complex force = f;
    for (int n = 0; n < 30; ++n) { /* d0, d1: derivatives n, n + 1 */
      const long double d2 = (n == 0 ? m->d : 0) + creall(force) - c * d1 - k * d0;
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
static double rounding(const modal_motion *m, double tau)
{
  const double c = m->mode.c, k = m->mode.k, grow = exp(m->mode.grows * tau);
  const double rate = sqrt(fabs(k)) + (c * c < 4 * k ? 0 : fmin(c, 1)), t = fmin(tau, 1 / fmax(rate, 1e-3));
  const double by_d = m->mode.soft ? tau * tau : 1 / fabs(k), by_f = m->mode.resonant ? tau : cabs(m->mode.response);
  const double size = fabs(m->q) + fabs(m->p) * t + fabs(m->d) * by_d + cabs(m->f) * by_f;
  return DBL_EPSILON * (1 + rate * tau + m->theta + tau) * grow * size;
}

/* 4 roundings of that size (worst seen: 1.1); q' and so p carry the factor of the mode's rate. */
static void each_mode_obeys_its_equation(CHECK_STATE)
{
  uint64_t seed = 11;
  double worst[2] = {0};
  for (int kind = 0; kind < KINDS; ++kind)
    for (int trial = 0; trial < (kinds[kind][0] > 1e4 ? 2 : fabs(kinds[kind][1]) > 1e3 ? 5 : 60); ++trial) {
      const modal_motion m = make(kind, &seed);
      long double q, p;
      const double tau = trial == 0 ? 2 * PI : trial == 1 ? 1e-9 : 2 * PI * random_unit(&seed);
      const modal_point at = modal_at(&m, tau);
      by_series(&m, tau, &q, &p);
      const double rate = 1 + sqrt(fabs(m.mode.k)) + fmin(m.mode.c, 1), unit = rounding(&m, tau);
      const double eq = (double)fabsl(at.q - q) / unit, ep = (double)fabsl(at.p - p) / unit / rate;
      worst[0] = fmax(worst[0], eq), worst[1] = fmax(worst[1], ep);
      CHECK_LE(eq, 4, "q, c %.17g k %.17g tau %g: %.17g", m.mode.c, m.mode.k, tau, at.q);
      CHECK_LE(ep, 4, "p, c %.17g k %.17g tau %g: %.17g", m.mode.c, m.mode.k, tau, at.p);
    }
  print_message("worst: q %.2f, p %.2f of 4\n", worst[0], worst[1]);
}

static double guard_at(const modal_motion *m, const modal_guard *g, double tau, double *slope)
{
  const modal_point at = modal_at(m, tau);
  *slope = g->by_q * at.p + g->by_p * at.a;
  return g->constant + g->by_q * at.q + g->by_p * at.p;
}

/* What a guard's value may err by: that of the states it is made of. */
static double guard_noise(const modal_motion *m, const modal_guard *g, double span)
{
  const double rate = 1 + sqrt(fabs(m->mode.k)) + fmin(m->mode.c, 1), unit = rounding(m, span);
  return DBL_EPSILON * fabs(g->constant) + 4 * unit * (fabs(g->by_q) + fabs(g->by_p) * rate);
}

/* Where the guard is below -2 noise for the first time (it may pass -noise in a step), by SCAN points and
 * then bisection: INFINITY if at none. */
static double scanned_root(const modal_motion *m, const modal_guard *g, double span)
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

static crossing cross(const modal_motion *m, double span, int n, const modal_guard *guards)
{
  modal_point at;
  crossing c = {.evaluations = 0};
  c.first = modal_first_crossing(m, span, n, guards, &at, &c.evaluations);
  c.tau = at.tau;
  const modal_point want = modal_at(m, at.tau); /* *at is a point of the motion */
  assert_memory_equal(&at, &want, sizeof at);
  return c;
}

/* The answer is no later than the first excursion below -2 noise that the scan sees (its own bisection and the root's
 * rounding apart), is a root of the guard named, and before it no guard is below -noise. */
static long check_crossing(const modal_motion *m, double span, int n, const modal_guard *guards)
{
  const crossing c = cross(m, span, n, guards);
  double slope;
  assert_in_range(c.first + 1, 0, n);
  CHECK_LE(c.tau, span, "in the span");
  if (c.first < 0) CHECK_NEAR(c.tau, span, 0, "the end");
  for (int g = 0; g < n; ++g) {
    const double seen = scanned_root(m, &guards[g], span);
    if (seen < INFINITY) assert_true(c.first >= 0);
    if (c.first >= 0) CHECK_LE(c.tau, seen + 8 * DBL_EPSILON * (1 + seen + m->theta), "guard %d is missed", g);
  }
  if (c.first < 0) return c.evaluations;
  const modal_guard *hit = &guards[c.first];
  const double value = guard_at(m, hit, c.tau, &slope);
  if (c.tau > 0)
    CHECK_LE(fabs(value), 2 * hit->noise + 4 * DBL_EPSILON * (1 + c.tau + m->theta) * fabs(slope), "a root");
  else CHECK_LE(value, hit->noise, "below 0 at the beginning");
  return c.evaluations;
}

static modal_guard random_guard(const modal_motion *m, double span, uint64_t *seed)
{
  const int which = random_int(seed, 0, 2);
  const double by_q = random_signed(seed), by_p = random_signed(seed) / sqrt(fmax(1, fabs(m->mode.k)));
  modal_guard g = {.by_q = which == 1 ? 0 : by_q, .by_p = which == 0 ? 0 : by_p, .constant = 2 * random_signed(seed)};
  g.noise = guard_noise(m, &g, span);
  return g;
}

static void no_random_crossing_is_missed(CHECK_STATE)
{
  uint64_t seed = 5;
  long most = 0, sum = 0;
  enum { TRIALS = CHECK_TRIALS(1200) };
  for (int trial = 0; trial < TRIALS; ++trial) {
    const modal_motion m = make(random_int(&seed, 0, KINDS - 1), &seed);
    double span = random_int(&seed, 0, 9) == 0 ? 1e-9 * random_unit(&seed) : 2 * PI * random_unit(&seed);
    if (m.mode.grows > 1) span = fmin(span, 5 / m.mode.grows); /* what grows e^5-fold has its noise from the start on */
    modal_guard guards[3];
    for (int g = 0; g < 3; ++g) guards[g] = random_guard(&m, span, &seed);
    const long evaluations = check_crossing(&m, span, 3, guards);
    most = evaluations > most ? evaluations : most;
    sum += evaluations;
  }
  print_message("evaluations: %ld on the average, at most %ld\n", sum / TRIALS, most);
}

/* The least value of a guard and where it is taken: its slope's sign change next to the smallest of SCAN values. */
static double lowest(const modal_motion *m, const modal_guard *g, double span, double *where)
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
    int kind;
    do kind = random_int(&seed, 0, KINDS - 1);
    while (fabs(kinds[kind][1]) > 100 || kinds[kind][0] > 100); /* the scan resolves them */
    const modal_motion m = make(kind, &seed);
    const double span = 2 * PI * (0.1 + 0.9 * random_unit(&seed));
    modal_guard g = random_guard(&m, span, &seed);
    double where, slope;
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
    const modal_motion m = make(random_int(&seed, 0, KINDS - 1), &seed);
    const modal_guard one_guard = random_guard(&m, 2 * PI, &seed);
    modal_guard g[2] = {one_guard,
                        {2 * one_guard.by_q, 2 * one_guard.by_p, 2 * one_guard.constant, 2 * one_guard.noise}};
    double slope;
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
  const modal_motion m = {.mode = mode_make(0, -1), .q = 1};
  for (double constant = 1.01; constant < 1.6; constant += 0.02) {
    const modal_guard g = {.by_q = -1, .constant = constant, .noise = DBL_EPSILON};
    const crossing c = cross(&m, 2 * PI, 1, &g);
    assert_int_equal(c.first, 0);
    CHECK_NEAR(c.tau, acosh(constant), 8 * DBL_EPSILON / sinh(acosh(constant)), "constant %g", constant);
  }
}

/* A guard below 0 at the beginning; no guard; no span; no number. */
static void ends_of_the_range(CHECK_STATE)
{
  uint64_t seed = 3;
  const modal_motion m = make(1, &seed);
  modal_guard g = {.by_q = 1, .constant = -10, .noise = 1e-15};
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
    modal_point at;
    long evaluations = 0;
    modal_motion broken = m;
    broken.q = bad[i];
    g.constant = 1;
    modal_first_crossing(&broken, 1, 1, &g, &at, &evaluations);
    assert_false(isfinite(at.q + at.p + at.a));
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
      const modal_motion m = make(kind, &seed);
      enum { COUNT = 100 };
      double samples[COUNT];
      const double from = m.theta + (trial % 2) * random_unit(&seed), step = 2 * PI / 512;
      modal_samples(&m, from, step, COUNT, samples);
      for (int i = 0; i < COUNT; ++i) {
        const double tau = from + i * step - m.theta, unit = rounding(&m, tau + 32 * step), q = modal_at(&m, tau).q;
        worst = fmax(worst, fabs(samples[i] - q) / unit);
        CHECK_NEAR(samples[i], q, 12 * unit, "c %g k %g sample %d", m.mode.c, m.mode.k, i);
      }
    }
  print_message("worst: %.1f of 12\n", worst);
}

/* Gauss-Legendre with 5 points in panels of h: its error is h^11 d^10/1e12, d the tenth derivative. */
static void quadrature(const modal_motion *m, double from, double to, int panels, double out[3])
{
  static const double x[] = {0, 0.5384693101056830910, 0.9061798459386639928};
  static const double w[] = {0.5688888888888888889, 0.4786286704993664680, 0.2369268850561890875};
  out[0] = out[1] = out[2] = 0;
  for (int i = 0; i < panels; ++i)
    for (int j = -2; j <= 2; ++j) {
      const double h = (to - from) / panels, side = j < 0 ? -1 : 1;
      const double tau = from + (i + 0.5) * h + 0.5 * h * side * x[abs(j)], share = 0.5 * h * w[abs(j)];
      const double q = modal_at(m, tau).q;
      out[0] += share * q;
      out[1] += share * q * cos(m->theta + tau);
      out[2] += share * q * sin(m->theta + tau);
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
      const modal_motion m = make(kind, &seed);
      double got[3], want[3];
      const double c = m.mode.c, k = m.mode.k, begin = trial % 3 ? random_unit(&seed) : 0;
      const double part = fmin(1, (trial > 0 ? 300 : 3000) / (1 + c + sqrt(fabs(k)))); /* of 20 panels a turn */
      const double end = begin + (trial == 4 ? 1e-6 : 3 * part * random_unit(&seed));
      const modal_point from = modal_at(&m, begin), to = modal_at(&m, end);
      const bool known = modal_fourier(&m, &from, &to, got);
      assert_int_equal(known, !(fabs(k) < 0.01 || cabs(k - 1 + I * c) < 1e-3));
      if (!known) continue;
      ++told;
      const double rate = 1 + c + sqrt(fabs(k)), unit = rounding(&m, end);
      const double divisor = fmin(fabs(k), cabs(k - 1 + I * c));
      const double size = unit * (end - begin) +
                          ((rate + c) * unit + DBL_EPSILON * (fabs(m.d) + cabs(m.f)) * (1 + m.theta + end)) / divisor;
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
