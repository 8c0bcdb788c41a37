/* test_neighbours.c - sampled solutions next to the exact curve's, at its omegas; where there is none that is said. */
#include "numerics/base/status.h"
#include "tests/lab/answer.h"

enum { MOST_ROWS = 400, HARMONICS = 5, COEF = 2 * HARMONICS + 1 };

static lab *lab_of(double kn, int samples)
{
  char text[600];
  lab *l = lab_new();
  assert_non_null(l);
  snprintf(text, sizeof text,
           "oscillator: {mass: 1.0, damping: 0.4, stiffness: 40}\n"
           "forcing: {amplitude: 100}\n"
           "contacts:\n"
           "  - {tangential_stiffness: 100, normal_stiffness: %g, friction: 0.08, angle_deg: 45, gap: -5}\n"
           "sweep: {omega: [3, 20]}\n"
           "hbm: {harmonics: %d, samples: %d, tolerance: 1e-13}\n",
           kn, HARMONICS, samples);
  if (lab_read(l, text) != HC_OK) fail_msg("%s", lab_message(l));
  return l;
}

typedef struct solution {
  double omega, branch, amplitude, max, X[COEF];
} solution;

static solution solution_at(const lab *l, int i)
{
  solution s = {number(l, i, "omega"), number(l, i, "branch"), number(l, i, "amplitude"), number(l, i, "max")};
  memcpy(s.X, cell(l, i, "coefficients"), sizeof s.X);
  return s;
}

/* |a - b| over |b|. */
static double difference(solution a, solution b)
{
  double off = 0, size = 0;
  for (int i = 0; i < COEF; ++i) {
    off += pow(a.X[i] - b.X[i], 2);
    size += pow(b.X[i], 2);
  }
  return sqrt(off / size);
}

/* Rows of the last answer, copied. */
static int rows_of(const lab *l, solution rows[MOST_ROWS])
{
  assert_true(lab_rows(l) <= MOST_ROWS);
  assert_int_equal(lab_columns(l), lab_column(l, "coefficients") + COEF);
  for (int i = 0; i < lab_rows(l); ++i) rows[i] = solution_at(l, i);
  return lab_rows(l);
}

/* Two ways to the same equations' solution at omega 8, where there are three: along the sampled curve, and from the
 * exact solutions. Both leave a residual of 1e-13 of the forces; at the nearest of these solutions to a fold the
 * equations make 1e3 of it at most. Sampling moves the two that touch by 1e-4 and more: exact ones would be seen. */
static void neighbours_solve_the_sampled_equations(CHECK_STATE)
{
  static solution exact[MOST_ROWS], near[MOST_ROWS];
  const double touches = 5 * sqrt(2); /* the clearance over sin 45 */
  lab *l = lab_of(1000, 64);
  int touching = 0;
  assert_int_equal(lab_curve(l, LAB_EXACT), HC_OK);
  assert_int_equal(lab_curve_at(l, LAB_EXACT, 8), HC_OK);
  assert_int_equal(rows_of(l, exact), 3);
  assert_int_equal(lab_neighbours_at(l, 8), HC_OK);
  assert_int_equal(rows_of(l, near), 3);
  assert_int_equal(lab_curve(l, LAB_SAMPLED), HC_OK);
  assert_int_equal(lab_curve_at(l, LAB_SAMPLED, 8), HC_OK);
  for (int i = 0; i < 3; ++i) {
    double least = INFINITY;
    for (int j = 0; j < lab_rows(l); ++j) least = fmin(least, difference(near[i], solution_at(l, j)));
    assert_true(near[i].omega == 8);
    CHECK_LE(least, 1e-10, "solution %d", i);
    if (exact[i].max < touches) continue;
    ++touching;
    CHECK_LE(1e-4, difference(near[i], exact[i]), "sampling moves solution %d", i);
  }
  assert_int_equal(touching, 2);
  lab_free(l);
}

/* A row for each point, in order; what is measured is of samples. */
static void every_point_has_its_row(CHECK_STATE)
{
  static solution exact[MOST_ROWS];
  lab *l = lab_of(1000, 64);
  assert_int_equal(lab_curve(l, LAB_EXACT), HC_OK);
  const int n = rows_of(l, exact);
  int found = 0;
  assert_int_equal(lab_neighbours(l), HC_OK);
  assert_int_equal(lab_rows(l), n);
  for (int i = 0; i < n; ++i) {
    const solution s = solution_at(l, i);
    assert_true(s.omega == exact[i].omega && s.branch == exact[i].branch);
    found += isfinite(s.amplitude);
  }
  assert_true(n > 40);
  CHECK_LE(0.9 * n, found, "of %d points", n);
  lab_free(l);
}

/* Newton circles from the exact solution (samples touch and leave by turns); the answer is on the sampled curve. */
static void jumping_jacobians_are_got_round(CHECK_STATE)
{
  static solution sampled[MOST_ROWS];
  lab *l = lab_of(5500, 64);
  assert_int_equal(lab_curve(l, LAB_SAMPLED), HC_OK);
  assert_int_equal(lab_curve_at(l, LAB_SAMPLED, 7), HC_OK);
  assert_int_equal(rows_of(l, sampled), 1);
  assert_int_equal(lab_curve(l, LAB_EXACT), HC_OK);
  assert_int_equal(lab_neighbours_at(l, 7), HC_OK);
  assert_int_equal(lab_rows(l), 1);
  CHECK_LE(difference(solution_at(l, 0), sampled[0]), 1e-10, "residuals of 1e-13, as above");
  lab_free(l);
}

/* Nearly rigid, and 16 samples: of some points Newton ends at another solution, and of some nowhere. */
static void another_solution_is_no_neighbour(CHECK_STATE)
{
  static solution exact[MOST_ROWS];
  lab *l = lab_of(1e5, 16);
  int missing = 0;
  assert_int_equal(lab_curve(l, LAB_EXACT), HC_OK);
  const int n = rows_of(l, exact);
  assert_int_equal(lab_neighbours(l), HC_OK);
  for (int i = 0; i < n; ++i) {
    const solution s = solution_at(l, i);
    int known = 0;
    for (int c = 0; c < lab_columns(l); ++c) known += !isnan(row(l, i)[c]);
    missing += isnan(s.amplitude);
    if (!isnan(s.amplitude)) CHECK_LE(difference(s, exact[i]), 0.5, "point %d", i);
    else assert_int_equal(known, 2);
    assert_true(s.omega == exact[i].omega && s.branch == exact[i].branch);
  }
  assert_in_range(missing, 2, n / 2);
  lab_free(l);
}

static void without_a_curve_there_are_none(CHECK_STATE)
{
  lab *l = lab_of(1000, 64);
  assert_int_equal(lab_neighbours(l), HC_BAD_INPUT);
  assert_int_equal(lab_curve(l, LAB_SAMPLED), HC_OK);
  assert_int_equal(lab_neighbours(l), HC_BAD_INPUT);
  assert_int_equal(lab_neighbours_at(l, 8), HC_BAD_INPUT);
  assert_int_equal(lab_curve(l, LAB_EXACT), HC_OK);
  assert_int_equal(lab_neighbours_at(l, NAN), HC_BAD_INPUT);
  assert_int_equal(lab_neighbours_at(l, -8), HC_BAD_INPUT);
  assert_int_equal(lab_neighbours_at(l, 30), HC_OK); /* not where the curve goes: none */
  assert_int_equal(lab_rows(l), 0);
  lab_free(l);
}

CHECK_TESTS("lab.neighbours", 60, neighbours_solve_the_sampled_equations, every_point_has_its_row,
            jumping_jacobians_are_got_round, another_solution_is_no_neighbour, without_a_curve_there_are_none)
