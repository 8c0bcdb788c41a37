/* test_judge.c - the Pareto front and the cheapest way, on rows made up so that the answer is plain. */
#include "compare/accuracy/method.h"
#include "tests/check.h"

static const double floor_of_tests = 1e-12;

static bench_row row(bench_method m, int harmonics, double tolerance, double error, double seconds)
{
  return (bench_row){.method = m,
                     .harmonics = harmonics,
                     .regularisation = NAN,
                     .tolerance = tolerance,
                     .error = error,
                     .seconds = seconds,
                     .repeats = 1,
                     .outcome = BENCH_SOLVED};
}

static void dominated_rows_are_not_on_the_front(CHECK_STATE)
{
  bench_row rows[] = {
      row(BENCH_HBM_EXACT, 1, NAN, 1e-2, 1),         /* fastest: on it */
      row(BENCH_HBM_EXACT, 5, NAN, 1e-3, 3),         /* beaten in both by the next */
      row(BENCH_EXACT_SHOOTING, 0, 1e-4, 1e-4, 2),   /* on it */
      row(BENCH_EXACT_SHOOTING, 0, 1e-6, 1e-4, 4),   /* as good, slower: not */
      row(BENCH_EXACT_MARCHING, 0, 1e-4, 1e-4, 2),   /* the same as one that is: on it, too */
      row(BENCH_EXACT_MARCHING, 0, 1e-8, 1e-9, 100), /* nearest: on it, at whatever price */
  };
  const bool expected[] = {true, false, true, false, true, true};
  bench_judge(6, rows, floor_of_tests);
  for (int i = 0; i < 6; ++i)
    if (rows[i].front != expected[i]) fail_msg("row %d: front is %d", i, rows[i].front);
}

/* H = 3 is near by luck: H = 10 is farther off, so it may not be counted on. Not so the other way round. */
static void luck_does_not_count(CHECK_STATE)
{
  bench_row rows[] = {row(BENCH_HBM_EXACT, 3, NAN, 1e-7, 1), row(BENCH_HBM_EXACT, 10, NAN, 1e-3, 2),
                      row(BENCH_HBM_EXACT, 40, NAN, 1e-5, 3)};
  bench_judge(3, rows, floor_of_tests);
  CHECK_NEAR(rows[0].error_finer, 1e-3, 0, "H = 3");
  CHECK_NEAR(rows[1].error_finer, 1e-3, 0, "H = 10");
  CHECK_NEAR(rows[2].error_finer, 1e-5, 0, "H = 40");
  assert_true(rows[0].front && !rows[1].front && rows[2].front);
}

/* Finer is finer in every setting: a smaller regularisation with a larger tolerance is not. Nor is another method. */
static void finer_is_in_every_setting(CHECK_STATE)
{
  bench_row rows[] = {row(BENCH_REGULARISED_SHOOTING, 0, 1e-6, 1e-4, 1),
                      row(BENCH_REGULARISED_SHOOTING, 0, 1e-4, 1e-2, 1),
                      row(BENCH_REGULARISED_MARCHING, 0, 1e-8, 1e-1, 1)};
  rows[0].regularisation = 1e-3, rows[1].regularisation = 1e-5, rows[2].regularisation = 1e-5;
  bench_judge(3, rows, floor_of_tests);
  CHECK_NEAR(rows[0].error_finer, 1e-4, 0, "its own");
}

/* Below the reference's own error there is nothing to tell rows apart by: the faster one wins. */
static void errors_end_at_the_floor(CHECK_STATE)
{
  bench_row rows[] = {row(BENCH_HBM_EXACT, 3, NAN, 1e-11, 1), row(BENCH_EXACT_SHOOTING, 0, 1e-9, 1e-14, 2)};
  bench_judge(2, rows, 1e-10);
  assert_true(rows[0].front && !rows[1].front);
}

static void unsolved_rows_do_not_take_part(CHECK_STATE)
{
  bench_row rows[] = {row(BENCH_HBM_EXACT, 3, NAN, NAN, NAN), row(BENCH_HBM_EXACT, 1, NAN, 1e-2, 1),
                      row(BENCH_HBM_EXACT, 5, NAN, 1e-9, 1e-9)};
  const bench_row *second;
  rows[0].outcome = BENCH_FAILED;
  rows[2].outcome = BENCH_OTHER_ORBIT;
  bench_judge(3, rows, floor_of_tests);
  assert_true(!rows[0].front && rows[1].front && !rows[2].front);
  assert_ptr_equal(bench_cheapest(3, rows, 1e-1, &second), &rows[1]);
  assert_null(second);
  assert_null(bench_cheapest(3, rows, 1e-3, &second));
}

static void the_cheapest_way_is_the_fastest_that_is_near_enough(CHECK_STATE)
{
  bench_row rows[] = {row(BENCH_HBM_EXACT, 5, NAN, 1e-3, 1), row(BENCH_HBM_EXACT, 10, NAN, 1e-4, 2),
                      row(BENCH_EXACT_SHOOTING, 0, 1e-4, 1e-5, 3), row(BENCH_EXACT_MARCHING, 0, 1e-4, 1e-5, 30)};
  static const struct {
    double accuracy;
    int best, second;
  } expected[] = {{1e-2, 0, 2}, {1e-3, 0, 2}, {1e-4, 1, 2}, {1e-5, 2, 3}, {1e-6, -1, -1}};
  bench_judge(4, rows, floor_of_tests);
  for (int i = 0; i < 5; ++i) {
    const bench_row *second, *best = bench_cheapest(4, rows, expected[i].accuracy, &second);
    assert_ptr_equal(best, expected[i].best < 0 ? NULL : &rows[expected[i].best]);
    assert_ptr_equal(second, expected[i].second < 0 ? NULL : &rows[expected[i].second]);
  }
}

/* Linear between the order statistics, 0.25 (n - 1) apart. */
static void quartiles_are_interpolated(CHECK_STATE)
{
  double v[] = {4, 1, 3, 2}, one[] = {7}, low, median, high;
  method_quartiles(4, v, &low, &median, &high);
  CHECK_NEAR(low, 1.75, 1e-15, "low");
  CHECK_NEAR(median, 2.5, 1e-15, "median");
  CHECK_NEAR(high, 3.25, 1e-15, "high");
  method_quartiles(1, one, &low, &median, &high);
  assert_true(low == 7 && median == 7 && high == 7);
}

CHECK_TESTS("bench.judge", 60, dominated_rows_are_not_on_the_front, luck_does_not_count, finer_is_in_every_setting,
            errors_end_at_the_floor, unsolved_rows_do_not_take_part,
            the_cheapest_way_is_the_fastest_that_is_near_enough, quartiles_are_interpolated)
