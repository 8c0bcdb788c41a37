/* test_special.c - grazing onsets, folds and period doublings of the paper's case 2: against a closed form, against
 * what a fold is, and against the values of the true orbit (docs/measurements/case2.md, by AUTO-07p, too), to which
 * truncation must tend. */
#include "compare/study/scene_solvers.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "tests/hbm/scenes.h"

typedef struct found {
  hbm_solver *s;
  hbm_curve c;
  hbm_special *at;
  int n;
} found;

static found find_in(scene sc, double to)
{
  found f = {0};
  sc.hbm.force = HBM_FORCE_EXACT;
  assert_int_equal(scene_hbm_solver(&sc, &f.s), HC_OK);
  assert_int_equal(hbm_trace(f.s, 3, to, NULL, &f.c), HC_OK);
  assert_int_equal(hbm_specials(f.s, &f.c, &f.at, &f.n), HC_OK);
  return f;
}

static found find(const char *name, int n_harm) { return find_in(scene_named(name, n_harm, true, 1024), 20); }

static void free_found(found *f)
{
  free(f->at);
  hbm_curve_free(&f->c);
  hbm_solver_free(f->s);
}

/* omega of the i-th special of a kind; the order is the curve's. */
static double special(const found *f, hbm_special_kind kind, int i)
{
  for (int k = 0; k < f->n; ++k)
    if (f->at[k].kind == kind && i-- == 0) return f->at[k].omega;
  return NAN;
}

/* Before contact the response is linear whatever H is, |x| = F0/|Z|, and touches when |x| sin(alpha) = |gap|: a
 * quadratic in w^2, M^2 w^4 + (C^2 - 2 K M) w^2 + K^2 - (F0 sin/gap)^2 = 0. The pattern is bisected to 1e-11 of a
 * segment, shorter than 10 in omega. The orbit in Newton's tolerance 1e-10 of |x| would move it by 1e-10 |x|/(d|x|/d
 * omega), |x| = 7.07 and the derivatives 1.3 and 3.7: below 6e-10. special_points.h promises 1e-9 of omega, which is
 * less than 1e-8. */
static void contact_sets_in_where_the_linear_response_grazes(CHECK_STATE)
{
  double b = 0.4 * 0.4 - 2 * 40, q = 100 * sqrt(0.5) / 5, c = 40 * 40 - q * q;
  double low = sqrt(0.5 * (-b - sqrt(b * b - 4 * c))), high = sqrt(0.5 * (-b + sqrt(b * b - 4 * c)));
  CHECK_NEAR(low, 5.0995831509, 1e-10, "closed form against theory.md, 11");
  CHECK_NEAR(high, 7.3371828168, 1e-10, "closed form against theory.md, 11");
  static const int harmonics[] = {1, 5, 20};
  static const char *names[] = {"c2", "c2kn1e4"};
  for (int q2 = 0; q2 < 6; ++q2) {
    found f = find(names[q2 % 2], harmonics[q2 / 2]);
    CHECK_NEAR(special(&f, HBM_CONTACT_CHANGE, 0), low, 1e-8, "%s H=%d", names[q2 % 2], harmonics[q2 / 2]);
    CHECK_NEAR(special(&f, HBM_CONTACT_CHANGE, 1), high, 1e-8, "%s H=%d", names[q2 % 2], harmonics[q2 / 2]);
    assert_true(isnan(special(&f, HBM_CONTACT_CHANGE, 2)));
    assert_int_equal(f.at[0].before, CONTACT_LINEAR);
    assert_int_equal(f.at[0].after, CONTACT_SEPARATES);
    assert_int_equal(f.at[f.n - 1].after, CONTACT_LINEAR);
    CHECK_NEAR(f.at[0].amplitude, 5 / sqrt(0.5), 1e-7, "amplitude at grazing"); /* derivative 1.3 times 1e-8 */
    free_found(&f);
  }
}

/* Bisection to 1e-11 of a segment takes 37 solutions a change. The interpolant between the last two is off by a part of
 * the fourth power of their distance, less than any margin of root_change_guided, whose first four leave nothing: 8
 * solutions, and two rounds of 4 more where the pattern begins with a kink. Nothing else is searched for below 5.105,
 * where contact sets in and nothing turns back or doubles. */
static void a_contact_change_takes_few_solutions(CHECK_STATE)
{
  scene sc = scene_named("c2", 5, true, 1024);
  found f = find_in(sc, 5.105);
  hbm_special *at;
  int n, changes = 0;
  const long before = hbm_solves(f.s);
  for (int i = 0; i < f.n; ++i) changes += f.at[i].kind == HBM_CONTACT_CHANGE;
  assert_int_equal(changes, f.n);
  assert_true(changes >= 1);
  assert_int_equal(hbm_specials(f.s, &f.c, &at, &n), HC_OK);
  free(at);
  CHECK_LE(hbm_solves(f.s) - before, 16L * changes, "%d changes", changes);
  free_found(&f);
}

/* No two of a kind at one place (special_points.h): both omega to 1e-9 and the amplitude to 1e-8. */
static void check_no_twins(const found *f, const char *what)
{
  for (int i = 0; i < f->n; ++i)
    for (int k = 0; k < i; ++k) {
      const hbm_special *a = &f->at[i], *b = &f->at[k];
      if (a->kind == b->kind && fabs(a->omega - b->omega) <= 1e-9 * a->omega &&
          fabs(a->amplitude - b->amplitude) <= 1e-8 * a->amplitude)
        fail_msg("%s: two of kind %d at omega = %.12g, amplitude %.10g", what, (int)a->kind, a->omega, a->amplitude);
    }
}

/* Preloaded by 1, case 2 slips and separates from the same amplitude on: the jump from stick is one change, from stick
 * to separation. So it is with two like contacts, and where slip within the contact begins with it (kn = 200). */
static void what_begins_at_once_is_one_change(CHECK_STATE)
{
  scene sc = scene_named("c2", 5, true, 1024);
  sc.structure->contacts[0].given.law.gap = 1;
  sc.hbm.skip_linear = true;
  found f = find_in(sc, 30);
  check_no_twins(&f, "preloaded");
  int jumps = 0;
  for (int i = 0; i < f.n; ++i)
    jumps +=
        f.at[i].kind == HBM_CONTACT_CHANGE && f.at[i].before == CONTACT_STUCK && f.at[i].after == CONTACT_SEPARATES;
  assert_int_equal(jumps, 1);
  free_found(&f);
  sc = scene_named("c2", 5, true, 1024);
  sc.structure->contacts[0].given.law.kn = 200;
  sc.hbm.skip_linear = true;
  f = find_in(sc, 40);
  check_no_twins(&f, "kn = 200");
  free_found(&f);
  sc = scene_named("c2", 5, true, 1024);
  sc.structure->contacts[0].given.law.kn = 500, sc.structure->contacts[0].given.law.kt = 50;
  scene_add_contact(&sc, sc.structure->contacts[0].given);
  found one = find("c2", 5);
  f = find_in(sc, 20);
  check_no_twins(&f, "two like contacts");
  assert_int_equal(f.n, one.n);
  free_found(&one);
  free_found(&f);
}

static int solutions_at(found *f, double omega, hbm_curve *at)
{
  *at = (hbm_curve){0};
  assert_int_equal(hbm_curve_at(f->s, &f->c, omega, at), HC_OK);
  return at->n;
}

static hbm_stability stability_of_solution(found *f, const hbm_curve *at, int i)
{
  CHECK_FILLED(hbm_stability, st, hbm_stability_at(f->s, at->points[i].omega, at->X + (size_t)i * at->n_coef, &st));
  return st;
}

/* A fold has two more solutions on one side than on the other, at any distance. special_points.h promises 1e-9 of
 * omega, so a frequency 1e-8 of omega away is certainly on its side. Near it the two multipliers next to +1 are 1 -+ a
 * sqrt(d): from d = 1e-3 to 1e-5 they come 10 times nearer to each other, to the d/sqrt(d) = 3 % of the next order.
 * Their mean misses 1 because the multiplier belongs to the orbit of the untruncated equations, by O(H^-3) as the
 * transitions are: the fold of H is 4e-5 from that of 2H (9.20954, 9.209579, 9.209580 at H = 10, 20, 40), and a
 * sqrt(4e-5) is what that costs at most. */
static void a_fold_is_where_two_solutions_and_multiplier_one_meet(CHECK_STATE)
{
  found f = find("c2", 20);
  double fold = special(&f, HBM_TURNING_POINT, 0), split[2], turn = special(&f, HBM_TURNING_POINT, 1);
  CHECK_NEAR(fold, 9.20958, 1e-5, "fold at H = 20");
  CHECK_NEAR(turn, 7.3369, 1e-5, "turn at H = 20");
  assert_true(isnan(special(&f, HBM_TURNING_POINT, 2)));
  hbm_curve at;
  static const struct {
    double d;
    int below, above;
  } side[] = {{1e-8, 3, 1}, {1e-6, 3, 1}, {1e-3, 3, 1}};
  for (int i = 0; i < 3; ++i) {
    assert_int_equal(solutions_at(&f, fold - side[i].d, &at), side[i].below);
    hbm_curve_free(&at);
    assert_int_equal(solutions_at(&f, fold + side[i].d, &at), side[i].above);
    hbm_curve_free(&at);
  }
  for (int i = 0; i < 2; ++i) {
    assert_int_equal(solutions_at(&f, fold - (i ? 1e-5 : 1e-3), &at), 3);
    hbm_stability upper = stability_of_solution(&f, &at, 0), middle = stability_of_solution(&f, &at, 1);
    split[i] = middle.re - upper.re;
    CHECK_NEAR(0.5 * (middle.re + upper.re), 1, split[0] * sqrt(4e-5 / 1e-3) + 0.1 * split[i],
               "mean multiplier at %g from the fold", i ? 1e-5 : 1e-3);
    assert_true(upper.im == 0 && middle.im == 0 && upper.fold > middle.fold);
    hbm_curve_free(&at);
  }
  CHECK_NEAR(split[0] / split[1], 10, 0.5, "square root law");
  CHECK_LE(split[1], 0.1, "multipliers meet");
  free_found(&f);
}

/* The orbit's error falls like H^-4, so the doubling's does, on the whole: over the two doublings of H from 10 to
 * 40, by 16^2 / 10 at least where the contact lasts long (5.57), where asymptotics hold from H = 10 on. Just after
 * grazing (5.106) contact lasts a 50th of a period, and 40 harmonics hardly resolve it: there only 2e-5 at H = 40,
 * and falling by 10 to H = 80. The references are rounded to 1e-6: 5e-7. */
static void doublings_tend_to_those_of_the_true_orbit(CHECK_STATE)
{
  static const int harmonics[] = {10, 20, 40, 80};
  double low[4], high[4];
  for (int q = 0; q < 4; ++q) {
    found f = find("c2", harmonics[q]);
    low[q] = fabs(special(&f, HBM_PERIOD_DOUBLING, 0) - 5.106167);
    high[q] = fabs(special(&f, HBM_PERIOD_DOUBLING, 1) - 5.569782);
    assert_true(isnan(special(&f, HBM_PERIOD_DOUBLING, 2)));
    for (int i = 0; i < 2; ++i) { /* the multiplier itself is -1 there: flip = (1 + l)(1 + l') moves by 1e2 a unit of
                                     omega, located to 1e-9 */
      hbm_curve at;
      solutions_at(&f, special(&f, HBM_PERIOD_DOUBLING, i), &at);
      CHECK_NEAR(stability_of_solution(&f, &at, 0).re, -1, 1e-6, "H=%d", harmonics[q]);
      hbm_curve_free(&at);
    }
    free_found(&f);
  }
  CHECK_LE(low[2], 2e-5, "5.106167 at H = 40");
  CHECK_LE(high[2], 2e-5, "5.569782 at H = 40");
  CHECK_LE(low[3], low[2] / 10 + 5e-7, "5.106167 from H = 40 to 80");
  CHECK_LE(high[2], high[0] * 10 / 256 + 5e-7, "5.569782 from H = 10 to 40");
  CHECK_LE(high[1], high[0] / 4 + 5e-7, "5.569782 from H = 10 to 20");
  CHECK_LE(high[3], high[1] * 10 / 256 + 5e-7, "5.569782 from H = 20 to 80");
}

/* kn = 1e4: contact ten times stiffer and three times shorter, so H = 80 here is worth about H = 25 there: 1e-4, and
 * eight times nearer than H = 40. */
static void the_doubling_of_a_stiff_contact(CHECK_STATE)
{
  double miss[2];
  for (int q = 0; q < 2; ++q) {
    found f = find("c2kn1e4", q ? 80 : 40);
    miss[q] = fabs(special(&f, HBM_PERIOD_DOUBLING, 1) - 6.036792);
    assert_true(isnan(special(&f, HBM_PERIOD_DOUBLING, 2)));
    free_found(&f);
  }
  CHECK_LE(miss[1], 1e-4, "H = 80");
  CHECK_LE(miss[1], miss[0] / 8, "H = 40 to 80");
}

/* Between the doublings unstable, between fold and turn unstable, else stable: at the middles and next to the
 * limits, outside what truncation moves. */
static void every_interval_is_as_stable_as_it_should_be(CHECK_STATE)
{
  static const struct {
    int n;
    bool stable[3];
    double omega[10];
  } at[] = {{1, {true}, {3.5, 5.05, 5.105, 5.572, 6, 7, 7.33, 9.21, 12, 19}},
            {1, {false}, {5.1075, 5.2, 5.4, 5.568}},
            {3, {true, false, true}, {7.338, 8, 9.2}}};
  found f = find("c2", 20);
  for (size_t q = 0; q < sizeof at / sizeof *at; ++q)
    for (int k = 0; k < 10 && at[q].omega[k] > 0; ++k) {
      hbm_curve here;
      assert_int_equal(solutions_at(&f, at[q].omega[k], &here), at[q].n);
      for (int i = 0; i < here.n; ++i) {
        double m = stability_of_solution(&f, &here, i).multiplier;
        if (!(at[q].stable[i] ? m < 1 : m > 1))
          fail_msg("omega %g, solution %d: multiplier %.12g", at[q].omega[k], i, m);
      }
      hbm_curve_free(&here);
    }
  free_found(&f);
}

/* The list is as long as there are points; it is the caller's also where there are none, or not all were located. */
static void what_is_not_located_is_said(CHECK_STATE)
{
  found f = find("c2", 10);
  hbm_special *none;
  int n = -1;
  hbm_curve empty = {0};
  assert_int_equal(hbm_specials(f.s, &empty, &none, &n), HC_OK);
  assert_int_equal(n, 0);
  free(none);
  f.s->how.tolerance = 1e-300; /* below rounding: what Newton does not come to is no special point, and is said */
  assert_int_not_equal(hbm_specials(f.s, &f.c, &none, &n), HC_OK);
  assert_int_equal(n, 0);
  free(none);
  free_found(&f);
}

CHECK_TESTS("hbm.special", 300, contact_sets_in_where_the_linear_response_grazes, a_contact_change_takes_few_solutions,
            what_begins_at_once_is_one_change, a_fold_is_where_two_solutions_and_multiplier_one_meet,
            doublings_tend_to_those_of_the_true_orbit, the_doubling_of_a_stiff_contact,
            every_interval_is_as_stable_as_it_should_be, what_is_not_located_is_said)
