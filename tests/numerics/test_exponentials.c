/* test_exponentials.c - where sums of exponentials fall through 0: against dense sampling, and grazes made by hand. */
#include "numerics/exponentials.h"

#include "numerics/random.h"
#include "tests/check.h"

enum { MOST = 12, SAMPLES = 40000 };

typedef struct made {
  exponentials e;
  exponential_sum s;
  double complex rate[MOST], now[MOST], by[MOST];
  double size[MOST], by_size[MOST];
} made;

static void make(made *m, int n, double constant)
{
  m->e = (exponentials){.n = n, .rate = m->rate, .now = m->now, .size = m->size};
  m->s = (exponential_sum){.constant = constant, .noise = 1e-14, .by = m->by, .size = m->by_size};
  exponential_sum_measure(&m->e, &m->s);
}

/* Rates from 1 to 1e4 with amplitudes that fall like 1/rate^2, some that grow slowly: nothing is below -noise before
 * the root, and there the sum is 0 to rounding, h slope of 1e-15 6. */
static void nothing_falls_before(CHECK_STATE)
{
  uint64_t seed = 11;
  int found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    made m;
    const int n = random_int(&seed, 1, MOST);
    for (int k = 0; k < n; ++k) {
      const double rate = pow(10, 4.0 * k / MOST) * (1 + random_unit(&seed));
      m.rate[k] = rate * (-0.3 * random_unit(&seed) + I * (k % 3 ? random_unit(&seed) : 0));
      if (k == 1 && trial % 5 == 0) m.rate[k] = 0.2 + I;
      m.by[k] = (random_signed(&seed) + I * random_signed(&seed)) / (rate * rate);
    }
    make(&m, n, 0);
    double at, slope, least = INFINITY, slopes = 0;
    for (int i = 0; i <= SAMPLES; ++i) least = fmin(least, exponential_sum_at(&m.e, &m.s, 2 * PI * i / SAMPLES, NULL));
    const double offset = -least * (0.5 + random_unit(&seed)); /* about half of them fall somewhere */
    make(&m, n, offset);
    const int first = exponentials_first_fall(&m.e, 1, &m.s, 0, 2 * PI, &at);
    const double end = first < 0 ? 2 * PI : at;
    for (int k = 0; k < n; ++k) slopes += cabs(m.rate[k] * m.by[k]);
    for (int i = 0; 2 * PI * i / SAMPLES < end; ++i)
      CHECK_LE(-m.s.noise, exponential_sum_at(&m.e, &m.s, 2 * PI * i / SAMPLES, NULL), "trial %d: %d", trial, i);
    if (end == 0) CHECK_LE(exponential_sum_at(&m.e, &m.s, 0, NULL), -m.s.noise, "trial %d: the start", trial);
    if (first < 0 || at == 0) continue;
    ++found;
    CHECK_LE(fabs(exponential_sum_at(&m.e, &m.s, at, &slope)), 2 * m.s.noise + 1e-14 * slopes, "trial %d", trial);
    CHECK_LE(slope, 1e-6, "trial %d: it falls", trial);
  }
  assert_true(found > 50);
}

/* 1 - cos(tau - 2) - depth: its dip is wide sqrt(8 depth), whatever fast mode is there that hardly moves. */
static void grazes(CHECK_STATE)
{
  const double depths[] = {1e-4, 1e-8, 1e-12}, fast[] = {0, 1e-13, 1e-6};
  for (size_t i = 0; i < 3; ++i)
    for (size_t k = 0; k < 3; ++k)
      for (int sign = -1; sign <= 1; sign += 2) {
        const double depth = sign * (depths[i] + 2 * fast[k]);
        made m;
        double at;
        m.rate[0] = I;
        m.by[0] = -(cos(2) - I * sin(2));
        m.rate[1] = -3 + 5e3 * I;
        m.by[1] = fast[k];
        make(&m, 2, 1 - depth);
        const int first = exponentials_first_fall(&m.e, 1, &m.s, 0, 2 * PI, &at);
        assert_int_equal(first, sign > 0 ? 0 : -1);
        if (first == 0)
          CHECK_NEAR(at, 2 - sqrt(2 * depth), 0.01 * sqrt(2 * depth) + 4 * fast[k] / sqrt(depth), "%g", depth);
      }
}

/* The first of several, and one that has fallen before. */
static void the_first_of_several(CHECK_STATE)
{
  made m, late;
  double at;
  m.rate[0] = late.rate[0] = -1;
  m.by[0] = late.by[0] = 1;
  make(&m, 1, -exp(-2));
  make(&late, 1, -exp(-3));
  const exponential_sum both[] = {late.s, m.s};
  assert_int_equal(exponentials_first_fall(&m.e, 2, both, 0, 2 * PI, &at), 1);
  CHECK_NEAR(at, 2, 1e-14, "%s", "ln");
  assert_int_equal(exponentials_first_fall(&m.e, 2, both, 2.5, 2 * PI, &at), 1);
  assert_true(at == 2.5);
  assert_int_equal(exponentials_first_fall(&m.e, 1, &late.s, 0, 2, &at), -1);
  late.s.constant = NAN;
  assert_int_equal(exponentials_first_fall(&m.e, 1, &late.s, 0, 2, &at), 0);
}

CHECK_TESTS("numerics.exponentials", 600, nothing_falls_before, grazes, the_first_of_several)
