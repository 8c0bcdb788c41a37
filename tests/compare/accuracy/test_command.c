/* test_command.c - hbmcheck bench: columns, errors that fall along each family, wrong usage; no times. */
#include "tests/folder.h"
#include "tests/program.h"

#define CASE2 "cases/paper/case2.yaml "
/* The error of the row that starts like this, as csv. NaN: no such row, or not solved. */
static double error_of(const char *csv, const char *start)
{
  const char *row = strstr(csv, start);
  if (!row) fail_msg("no row %s", start);
  /* omega, method, harmonics, samples, regularisation, tolerance */
  for (int commas = 0; row && commas < 6; ++commas) row = strchr(row, ',') + 1;
  return row && *row != ',' ? strtod(row, NULL) : NAN;
}

/* Each step finer is nearer by at least this; the last may stand where the reference ends. */
static void check_falls(const char *csv, const char *family, int n, const char *const *starts, double factor)
{
  double before = INFINITY;
  for (int i = 0; i < n; ++i) {
    double e = error_of(csv, starts[i]);
    CHECK_LE(e, factor * before, "%s, %s", family, starts[i]);
    before = e;
  }
}

/* Case 2 at 6.5: stable, alone, far from folds. Exact forces are of order 3 to 4 in H: a factor 4 is 16 and more, 4
 * asked. Sampled: down to the same H's truncation. The regularised law is of first order: a tenth, 1/5 asked. */
static void errors_fall_along_each_family(CHECK_STATE)
{
  assert_int_equal(run("bench " CASE2 "--at 6.5 --repeats 1 --alone --format csv -q --set transient.max_periods=2000"),
                   0);
  static const char *const exact[] = {"6.5,hbm_exact,5,", "6.5,hbm_exact,20,", "6.5,hbm_exact,80,"};
  static const char *const regularised[] = {"6.5,regularised_shooting,,,0.01,1e-08",
                                            "6.5,regularised_shooting,,,0.001,1e-08",
                                            "6.5,regularised_shooting,,,0.0001,1e-08"};
  check_falls(out, "hbm_exact", 3, exact, 0.25);
  check_falls(out, "regularised_shooting", 3, regularised, 0.2);
  double coarse = error_of(out, "6.5,hbm_sampled,40,256,"), fine = error_of(out, "6.5,hbm_sampled,40,16384,"),
         limit = error_of(out, "6.5,hbm_exact,40,");
  CHECK_LE(fine, 0.1 * coarse + 2 * limit, "hbm_sampled");
  assert_non_null(strstr(out, "omega,accuracy,method,settings,"));
  assert_non_null(strstr(out, "# fastest at omega = 6.5: "));
  assert_non_null(strstr(out, "compiler"));
}

/* A mass on a rubbing foot: its normal motion, here the first response, is linear and free of error to rounding, so
 * that the error is that of the other: order 3 and more in H, a factor 4 in H is 64, 16 asked. */
static void errors_are_of_all_responses(CHECK_STATE)
{
  folder_put(
      "two.yaml",
      "title: two responses\n"
      "structure: {mass: [1, 1], damping: [0.34641016151377546, 2], stiffness: [12, 21], names: [along, across]}\n"
      "forcing: [{dof: across, amplitude: 100, harmonic: 0}, {direction: {along: 50, across: 5}, amplitude: 1}]\n"
      "contacts: [{tangential_stiffness: 5, normal_stiffness: 21, friction: 0.85, tangent: {along: 1}, "
      "normal: {across: 1}}]\n"
      "response: [across, along]\nsweep: {omega: [3, 5.5]}\n");
  assert_int_equal(run("bench $D/two.yaml --at 4 --repeats 1 --format csv -q --set transient.max_periods=300"), 0);
  static const char *const exact[] = {"4,hbm_exact,5,", "4,hbm_exact,20,", "4,hbm_exact,80,"};
  CHECK_LE(1e-6, error_of(out, exact[0]), "the second response's");
  check_falls(out, "hbm_exact", 3, exact, 1.0 / 16);
  CHECK_LE(error_of(out, "4,exact_shooting,,,,9.9999999999999994e-12"), 1e-10, "tolerance 1e-11");
  CHECK_LE(error_of(out, "4,closed_shooting,"), 1e-10, "tolerance 1e-11");
  assert_non_null(strstr(out, "scipy_lsoda: of one degree of freedom only"));
}

/* The smallest error of all rows of a method: what the family comes to. */
static double best_of(const char *csv, const char *method)
{
  char start[64];
  double best = INFINITY;
  snprintf(start, sizeof start, "\n6.5,%s,", method);
  for (const char *row = csv; (row = strstr(row, start)); ++row) {
    double e = error_of(row, start + 1);
    if (e < best) best = e;
  }
  return best;
}

/* Every family comes near the reference: each bound ten times what its finest setting claims. */
static void every_method_comes_near(CHECK_STATE)
{
  assert_int_equal(run("bench " CASE2 "--at 6.5 --repeats 1 --alone --format csv -q"), 0);
  CHECK_LE(best_of(out, "exact_shooting"), 1e-10, "tolerance 1e-11");
  CHECK_LE(best_of(out, "exact_marching"), 1e-10, "tolerance 1e-11");
  CHECK_LE(best_of(out, "regularised_shooting"), 1e-5, "first order, regularisation 1e-6");
  CHECK_LE(best_of(out, "regularised_marching"), 1e-4, "first order, regularisation 1e-5");
}

static void mistakes_are_named(CHECK_STATE)
{
  expect("bench 2>&1", 64, "CASE");
  expect("bench " CASE2 "--repeats 0 2>&1", 64, "--repeats");
  expect("bench " CASE2 "--repeats x 2>&1", 64, "--repeats");
  expect("bench " CASE2 "--at 5,,6 2>&1", 64, "--at");
  expect("bench /nonexistent.yaml 2>&1", 2, "/nonexistent.yaml: ");
  /* between the period doublings */
  expect("bench " CASE2 "--at 5.3 --repeats 1 --alone -q 2>&1", 3, "omega = 5.3: no stable orbit");
  expect("bench --help", 0, "example");
}

CHECK_TESTS_WITH("bench.command", 300, folder_make, folder_remove, errors_fall_along_each_family,
                 errors_are_of_all_responses, every_method_comes_near, mistakes_are_named)
