/* test_balls.c - the checker's balls against exact fractions: what it computes from rational numbers contains what
 * fractions give, and is not much wider. */
#include "proof/around/complete.h"
#include "tests/check.h"
#include <float.h>

enum { BITS = 128, ROUNDS = 200 };

static void holds(const arb_t ball, const fmpq_t exact, slong bits, const char *what)
{
  if (!arb_contains_fmpq(ball, exact)) fail_msg("%s: the fraction is outside", what);
  if (mag_cmp_2exp_si(arb_radref(ball), -bits) > 0) fail_msg("%s: the radius is above 2^-%ld", what, (long)bits);
}

static void small_fraction(fmpq_t x, flint_rand_t random)
{
  fmpq_set_si(x, (slong)n_randint(random, 2001) - 1000, 1 + n_randint(random, 300));
}

/* ---- decimals ---- */

static void decimals_are_exact(CHECK_STATE)
{
  static const struct {
    const char *text;
    slong numerator, denominator;
  } good[] = {{"0", 0, 1},  {"-0.0", 0, 1}, {"12.5", 25, 2},   {"+1.25e-3", 1, 800},
              {".5", 1, 2}, {"5.", 5, 1},   {"-3E2", -300, 1}, {"1e+0", 1, 1}};
  static const char *const bad[] = {"",       "-",    "e5",    "1e",  "1e401",
                                    "1e-401", "0x10", "1 ",    "nan", "1.2.3",
                                    "1,5",    "--1",  "1e5.5", "inf", "1e99999999999999999999",
                                    "1\t"};
  LOCAL(fmpq) value = {0}, exact = {0};
  for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
    fmpq_set_si(exact, good[i].numerator, (ulong)good[i].denominator);
    assert_true(decimal_read(good[i].text, strlen(good[i].text), value));
    if (!fmpq_equal(value, exact)) fail_msg("%s is read as another number", good[i].text);
  }
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    if (decimal_read(bad[i], strlen(bad[i]), value)) fail_msg("\"%s\" is read as a number", bad[i]);
  char long_one[LIMIT_DIGITS + 2];
  memset(long_one, '1', sizeof long_one);
  assert_true(decimal_read(long_one, LIMIT_DIGITS, value));
  assert_false(decimal_read(long_one, LIMIT_DIGITS + 1, value));
}

/* Written down and up they are the two neighbours of x among the multiples of 10^place. */
static void decimals_are_rounded_outward(CHECK_STATE)
{
  flint_rand_t random;
  flint_randinit(random);
  LOCAL(arf) x = {0};
  LOCAL(fmpq) exact = {0}, low = {0}, high = {0}, unit = {0}, ten = {0};
  fmpq_set_si(ten, 10, 1);
  for (int i = 0; i < 20 * ROUNDS; i++) {
    arf_randtest(x, random, 100, 6);
    const slong place = (slong)n_randint(random, 50) - 40;
    char *down = decimal_write(x, place, -1), *up = decimal_write(x, place, 1);
    arf_get_fmpq(exact, x);
    fmpq_pow_si(unit, ten, place);
    if (!decimal_read(down, strlen(down), low) || !decimal_read(up, strlen(up), high))
      fail_msg("%s, %s: not decimals", down, up);
    if (fmpq_cmp(low, exact) > 0 || fmpq_cmp(high, exact) < 0) fail_msg("%s to %s: the number is outside", down, up);
    fmpq_add(low, low, unit);
    if (fmpq_cmp(low, high) < 0) fail_msg("%s to %s: more than one unit of 10^%ld", down, up, (long)place);
    free(down);
    free(up);
  }
  flint_randclear(random);
}

/* ---- Bernstein ---- */

/* On both halves of [0, 1] the coefficients enclose the polynomial; the first and last are its values. */
static void bernstein_encloses_the_polynomial(CHECK_STATE)
{
  enum { DEGREE = 9 };
  flint_rand_t random;
  flint_randinit(random);
  LOCAL(pool) own = {0};
  arb_ptr c = pool_balls(own, DEGREE + 1), b = pool_balls(own, DEGREE + 1), left = pool_balls(own, DEGREE + 1);
  fmpq *exact = pool_rationals(own, DEGREE + 1);
  LOCAL(mag) none = {0};
  LOCAL(arb) hull = {0};
  LOCAL(fmpq) s = {0}, value = {0};
  for (int round = 0; round < ROUNDS; round++) {
    for (int k = 0; k <= DEGREE; k++) {
      small_fraction(exact + k, random);
      arb_set_fmpq(c + k, exact + k, BITS);
    }
    const int degree = round % 3 ? DEGREE : 5; /* what is above becomes radius */
    bernstein(b, c, DEGREE, degree, none, BITS);
    holds(b, exact, degree == DEGREE ? 100 : -20, "first coefficient");
    bernstein_halve(b, left, b, degree, BITS);
    for (int part = 0; part < 2; part++) {
      arb_srcptr half = part ? b : left;
      arb_set(hull, half);
      for (int i = 1; i <= degree; i++) arb_union(hull, hull, half + i, BITS);
      for (int i = 0; i <= 8; i++) {
        fmpq_set_si(s, 8 * part + i, 16);
        fmpq_zero(value);
        for (int k = DEGREE; k >= 0; k--) {
          fmpq_mul(value, value, s);
          fmpq_add(value, value, exact + k);
        }
        holds(hull, value, -30, "hull of a half");
        if ((i == 0 || i == 8) && degree == DEGREE) holds(i ? half + degree : half, value, 90, "coefficient at an end");
      }
    }
  }
  flint_randclear(random);
}

/* ---- the flow ---- */

/* A certificate of one mass with a constant load; `stiffness` and `mass` as decimals. */
static certificate *one_mass(const char *mass, const char *stiffness, const char *load, const char *x, const char *v)
{
  char why[256];
  json_t *json =
      json_pack("{s{s[[s]]s[[s]]s[[s]]s[{sis[s]s[s]}]s[]}sssisis[s]s{}s{ssssss}s[{sisss[s]s[s]ss}]}", "model", "mass",
                mass, "damping", "0", "stiffness", stiffness, "forcing", "harmonic", 0, "cos", load, "sin", "0",
                "contacts", "omega", "1", "multiple", 1, "precision_bits", BITS, "response", "1", "rest", "scales", "x",
                "1", "v", "1", "t", "1", "events", "section", 1, "t", "0", "x", x, "v", v, "state", "");
  assert_non_null(json);
  certificate *c = certificate_read(json, true, why, sizeof why);
  if (!c) fail_msg("%s", why);
  json_decref(json);
  return c;
}

/* z at its end after `time`, all of it and substep by substep. */
static void flow(const certificate *c, const fmpq_t time, arb_t end, arb_t along)
{
  failure f = {.segment = -1};
  LOCAL(pool) own = {0};
  LOCAL(mag) rest = {0};
  orbit *o = orbit_new(c, &f);
  assert_non_null(o);
  arb_set_fmpq(o->duration, time, BITS);
  assert_true(flow_prepare(o, &f));
  box_set(o, NULL);
  arb_ptr z = pool_balls(own, o->largest), row = pool_balls(own, o->largest), series = pool_balls(own, o->degree + 1);
  assert_true(flow_end(o, 0, z, NULL));
  arb_set(end, z);
  walk w;
  walk_start(&w, o, 0);
  arb_one(row);
  while (walk_next(&w)) {
    _arb_vec_zero(series, o->degree + 1);
    walk_polynomial(&w, row, series, rest);
    _arb_poly_evaluate(along, series, o->degree + 1, w.end, BITS);
    arb_add_error_mag(along, rest);
  }
  walk_end(&w);
  orbit_free(o);
}

/* Without a spring x = x0 + v0 t + f t^2/(2 m), a fraction. */
static void a_free_mass_moves_as_fractions_say(CHECK_STATE)
{
  LOCAL(fmpq) time = {0}, exact = {0}, term = {0};
  LOCAL(arb) end = {0}, along = {0};
  certificate *c = one_mass("3", "0", "7.5", "0.7", "-1.3");
  for (int i = 1; i < 40; i++) {
    fmpq_set_si(time, i, 7);
    fmpq_set_si(exact, 7, 10);
    fmpq_set_si(term, -13, 10);
    fmpq_mul(term, term, time);
    fmpq_add(exact, exact, term);
    fmpq_set_si(term, 5, 4);
    fmpq_mul(term, term, time);
    fmpq_mul(term, term, time);
    fmpq_add(exact, exact, term);
    flow(c, time, end, along);
    holds(end, exact, 85, "end");
    holds(along, exact, 80, "last substep");
  }
  certificate_free(c);
}

/* With k = m = 1, x0 = 1, v0 = 0: x = cos t, between two neighbouring partial sums of its alternating series. */
static void a_spring_swings_as_the_cosine(CHECK_STATE)
{
  LOCAL(fmpq) time = {0}, sum = {0}, term = {0}, before = {0};
  LOCAL(arb) end = {0}, along = {0};
  certificate *c = one_mass("1", "1", "0", "1", "0");
  for (int i = 1; i < 30; i++) {
    fmpq_set_si(time, i, 3);
    fmpq_one(sum);
    fmpq_one(term);
    for (int k = 1; k < 60; k++) {
      fmpq_set(before, sum);
      fmpq_mul(term, term, time);
      fmpq_mul(term, term, time);
      fmpq_div_fmpz(term, term, (fmpz[]){2 * k * (2 * k - 1)});
      fmpq_neg(term, term);
      fmpq_add(sum, sum, term);
    }
    flow(c, time, end, along); /* the sums differ by less than (29/3)^118/118! = 2^-258 */
    holds(end, sum, 90, "end");
    holds(end, before, 90, "end");
    holds(along, sum, 80, "last substep");
  }
  certificate_free(c);
}

/* The last substep lasts as long as the segment may, over all times of its events in a wide box. */
static void the_last_substep_reaches_the_latest_end(CHECK_STATE)
{
  char why[256];
  failure f = {.segment = -1};
  json_t *json = json_load_file("tests/proof/certificates/case2_9_stable.json", 0, NULL);
  certificate *c = certificate_read(json, false, why, sizeof why);
  orbit *o = c ? orbit_new(c, &f) : NULL;
  assert_non_null(o);
  if (!o) return;
  LOCAL(pool) own = {0};
  mag_ptr wide = pool_mags(own, o->unknowns);
  for (int i = 0; i < o->unknowns; i++) mag_set_ui_2exp_si(wide + i, 1, -20);
  LOCAL(arb) latest = {0}, reached = {0};
  assert_true(flow_prepare(o, &f));
  box_set(o, wide);
  for (int i = 0; i < o->m; i++) {
    walk w;
    walk_start(&w, o, i);
    arb_zero(reached);
    while (walk_next(&w)) arb_add(reached, reached, w.width, BITS);
    flow_duration(o, i, latest);
    arb_get_ubound_arf(arb_midref(latest), latest, BITS);
    mag_zero(arb_radref(latest));
    assert_true(arb_ge(reached, latest));
    assert_true(arb_is_exact(w.width) && !arb_is_exact(w.end));
    walk_end(&w);
  }
  orbit_free(o);
  certificate_free(c);
  json_decref(json);
}

/* ---- the float inverse ---- */

/* |I - B M| scale, row by row, is above the exact sum, and above it by no more than the roundings of long double allow:
 * 2 (n + 4) epsilons of |B| |M| scale. B is spoilt by ever less, so that the sum goes from 1 to roundings. */
static void the_defect_of_an_inverse_is_bounded(CHECK_STATE)
{
  enum { EXACT = 400 };
  char why[256];
  failure f = {.segment = -1};
  krawczyk k = {0};
  flint_rand_t random;
  json_t *json = json_load_file("tests/proof/certificates/case2_9_stable.json", 0, NULL);
  certificate *c = certificate_read(json, false, why, sizeof why);
  orbit *o = c ? orbit_new(c, &f) : NULL;
  assert_non_null(o);
  if (!o) return;
  assert_true(flow_prepare(o, &f) && existence_prepare(&k, o, NULL, &f));
  const int n = o->unknowns;
  flint_randinit(random);
  LOCAL(arb) sum = {0}, size = {0}, entry = {0}, b = {0}, m = {0}, all = {0}, most = {0}, defect = {0};
  for (int round = 0; round <= 18; round++) {
    for (int i = 0; i < n * n; i++) k.inverse[i] *= 1 + pow(10, -round) * ((double)n_randint(random, 2001) / 1000 - 1);
    existence_measure(&k);
    for (int r = 0; r < n; r++) {
      arb_zero(all);
      arb_zero(most);
      for (int column = 0; column < n; column++) {
        arb_set_si(sum, r == column);
        arb_set_si(size, r == column);
        for (int row = 0; row < n; row++)
          for (int e = k.derivative.row[row]; e < k.derivative.row[row + 1]; e++) {
            if (k.derivative.column[e] != column) continue;
            arb_set_d(b, k.inverse[r * n + row]);
            arb_set_d(m, k.middle[e]);
            arb_mul(entry, b, m, EXACT);
            arb_sub(sum, sum, entry, EXACT);
            arb_abs(entry, entry);
            arb_add(size, size, entry, EXACT);
          }
        arb_abs(sum, sum);
        arb_addmul(all, sum, o->scale + column % (2 * o->n + 1), EXACT);
        arb_addmul(most, size, o->scale + column % (2 * o->n + 1), EXACT);
      }
      arb_set_interval_mag(defect, k.defect + r, k.defect + r, 64);
      arb_set_d(b, 2 * (n + 4) * (double)LDBL_EPSILON);
      arb_mul(most, most, b, 64);
      arb_set_d(b, 1 + 1e-6); /* a mag has 30 bits */
      arb_addmul(most, all, b, 64);
      if (!arb_ge(defect, all)) fail_msg("row %d, spoilt by 1e-%d: the bound is below the sum", r, round);
      if (!arb_le(defect, most)) fail_msg("row %d, spoilt by 1e-%d: the bound is far above the sum", r, round);
    }
    assert_true(existence_prepare(&k, o, NULL, &f));
  }
  flint_randclear(random);
  existence_free(&k);
  orbit_free(o);
  certificate_free(c);
  json_decref(json);
}

/* ---- what may be spent on a candidate ---- */

static const char *reason_within(double most_work, json_t **answer)
{
  json_t *candidate = json_load_file(SOURCE_DIR "/tests/proof/certificates/case2_9_stable.json", 0, NULL);
  assert_non_null(candidate);
  json_t *event = json_array_get(json_object_get(candidate, "events"), 1);
  json_object_set_new(event, "x", json_pack("[s]", "7.1")); /* 0.03 off: more than one inverse */
  *answer = complete(candidate, 0, most_work);
  json_decref(candidate);
  return json_string_value(json_object_get(*answer, "reason"));
}

/* Two changes with three unknowns each: 216 an inverse beyond the first. */
static void work_on_a_candidate_is_bounded(CHECK_STATE)
{
  json_t *answer;
  assert_null(reason_within(COMPLETE_MOST_WORK, &answer));
  assert_true(json_is_object(json_object_get(answer, "certificate")));
  json_decref(answer);
  const char *reason = reason_within(215, &answer);
  assert_non_null(reason);
  assert_non_null(strstr(reason, "too much work"));
  assert_true(json_is_null(json_object_get(answer, "certificate")));
  json_decref(answer);
}

CHECK_ENTRY_FUNCTION
{
  check_watchdog(60);
  const struct CMUnitTest proof_balls[] = {
      cmocka_unit_test(decimals_are_exact),
      cmocka_unit_test(decimals_are_rounded_outward),
      cmocka_unit_test(bernstein_encloses_the_polynomial),
      cmocka_unit_test(a_free_mass_moves_as_fractions_say),
      cmocka_unit_test(a_spring_swings_as_the_cosine),
      cmocka_unit_test(the_last_substep_reaches_the_latest_end),
      cmocka_unit_test(the_defect_of_an_inverse_is_bounded),
      cmocka_unit_test(work_on_a_candidate_is_bounded),
  };
  return check_ended(cmocka_run_group_tests(proof_balls, NULL, NULL));
}
