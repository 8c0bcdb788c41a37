/* test_tables.c - the table over samples and truncation order: its reference, counts, and case 2. */
#include <limits.h>

#include "tests/hbm/scenes.h"
#include "tests/scene_runs.h"

static scene case2(void)
{
  scene sc = exact_reference_scene("c2", 10);
  sc.transient.steady = TRANSIENT_STEADY_SHOOTING;
  sc.gate.most = (discrepancy){1e-3, 1e-3, 1e-3, 5e-3};
  sc.compare.omega = (number_list){2, {6, 8}};
  return sc;
}

static const accuracy_row *find(const accuracy *a, int harmonics, int samples)
{
  for (int i = 0; i < a->n_rows; ++i)
    if (a->rows[i].harmonics == harmonics && a->rows[i].samples == samples) return &a->rows[i];
  fail_msg("no row %d, %d", harmonics, samples);
  abort();
}

/* The largest difference of amplitude between the solutions of c, with exact forces, and those of a curve with so many
 * samples, branch by branch and relative to the orbit's. Newton leaves both within 1e-10 of the forces. */
static double largest_aliasing(const scene *exact, const comparison *c, int samples)
{
  scene sc = *exact;
  double worst = 0;
  sc.hbm.force = HBM_FORCE_SAMPLED, sc.hbm.samples = samples;
  CHECK_FILLED(comparison, sampled, scene_comparison_run(&sc, NULL, &sampled));
  assert_int_equal(sampled.n_rows, c->n_rows);
  for (int i = 0; i < c->n_rows; ++i)
    worst = larger(worst, fabs(sampled.rows[i].hbm.amplitude - c->rows[i].hbm.amplitude) / c->rows[i].orbit.amplitude);
  comparison_clear(&sampled);
  assert_true(worst > 0);
  return worst;
}

/* Lists unsorted and with a repetition; 8 samples are too few for 10 harmonics. One orbit at 6, three at 8. */
static void rows_are_the_grid(CHECK_STATE)
{
  scene sc = case2();
  sc.compare.harmonics = (number_list){3, {10, 3, 10}};
  sc.compare.samples = (number_list){2, {2048, 8}};
  CHECK_FILLED(comparison, c, scene_comparison_run(&sc, NULL, &c));
  CHECK_FILLED(accuracy, a, scene_accuracy_run(&sc, &c, NULL, &a));
  assert_int_equal(a.n_rows, 6);
  assert_int_equal(a.orbits, 4);
  assert_int_equal(a.frequencies, 2);
  assert_false(find(&a, 10, 8)->possible);
  assert_true(isnan(find(&a, 10, 8)->worst));
  assert_true(find(&a, 3, 8)->possible); /* 2 H + 2 just */
  const accuracy_row *fine = find(&a, 10, 0), *coarse = find(&a, 3, 0), *sampled = find(&a, 10, 2048);
  assert_int_equal(fine->missing, 0);
  assert_int_equal(fine->turning_points, 2);
  assert_int_equal(fine->false_turning_points, 0);
  CHECK_LE(fine->worst, coarse->worst, "more harmonics");
  CHECK_NEAR(sampled->aliasing, largest_aliasing(&sc, &c, 2048), 1e-8, "the same solutions by a sweep with samples");
  CHECK_NEAR(fine->aliasing, 0, 0, "exact forces");
  accuracy_clear(&a);
  comparison_clear(&c);
}

/* The worst error of H = 10 with exact forces is what the rows of the comparison say themselves. */
static void the_table_agrees_with_the_rows(CHECK_STATE)
{
  scene sc = case2();
  double worst = 0;
  sc.compare.harmonics = (number_list){1, {10}};
  CHECK_FILLED(comparison, c, scene_comparison_run(&sc, NULL, &c));
  CHECK_FILLED(accuracy, a, scene_accuracy_run(&sc, &c, NULL, &a));
  assert_int_equal(c.n_rows, 4); /* one solution at 6, three at 8 */
  for (int i = 0; i < c.n_rows; ++i)
    worst = larger(worst, fabs(c.rows[i].hbm.amplitude - c.rows[i].orbit.amplitude) / c.rows[i].orbit.amplitude);
  CHECK_NEAR(a.rows[0].worst, worst, 1e-8, "twice the residual tolerance, over 1 - multiplier");
  accuracy_clear(&a);
  comparison_clear(&c);
}

/* The peak of the exact transient against that of H = 40 and 80 with exact forces, whose error falls like H^-3 or
 * faster: the last is within 1/(2^3 - 1) of the difference of the two, and the frequency's likewise. */
static void the_peak_is_the_limit_of_many_harmonics(CHECK_STATE)
{
  scene sc = case2();
  sc.compare.harmonics = (number_list){2, {40, 80}};
  CHECK_FILLED(comparison, c, scene_comparison_run(&sc, NULL, &c));
  CHECK_FILLED(accuracy, a, scene_accuracy_run(&sc, &c, NULL, &a));
  const accuracy_row *h40 = find(&a, 40, 0), *h80 = find(&a, 80, 0);
  assert_true(a.peak_by_orbit);
  CHECK_NEAR(a.peak_amplitude, h80->peak_amplitude, fabs(h80->peak_amplitude - h40->peak_amplitude) / 7 + 1e-8,
             "amplitude");
  CHECK_NEAR(a.peak_omega, h80->peak_omega, fabs(h80->peak_omega - h40->peak_omega) / 7 + 1e-6 * a.peak_omega, "omega");
  accuracy_clear(&a);
  comparison_clear(&c);
}

/* Beside a smooth peak orbits have one height; a cubic through points half-width/50 apart is within (1/50)^3 of it. */
static void a_smooth_peak_lies_between_orbits_of_one_height(CHECK_STATE)
{
  const double half_width = 0.34641016151377546 / 2, d = half_width / 1000;
  const char *set[] = {"response=[along]", "compare.omega=[3.6]", "compare.harmonics=[10]"};
  scene sc = case_scene("structures/tangent_normal_F50", 3, set);
  CHECK_FILLED(comparison, c, scene_comparison_run(&sc, NULL, &c));
  CHECK_FILLED(accuracy, a, scene_accuracy_run(&sc, &c, NULL, &a));
  comparison_clear(&c);
  assert_true(a.peak_by_orbit);
  sc.compare.omega = (number_list){3, {a.peak_omega - d, a.peak_omega, a.peak_omega + d}};
  assert_int_equal(scene_comparison_run(&sc, NULL, &c), HC_OK);
  assert_int_equal(c.n_rows, 3);
  const double left = c.rows[0].orbit.amplitude, top = c.rows[1].orbit.amplitude, right = c.rows[2].orbit.amplitude;
  const double middle = 0.5 * d * (left - right) / (left - 2 * top + right);
  CHECK_NEAR(middle, 0, half_width / 125000, "distance of the peak");
  CHECK_NEAR(a.peak_amplitude, top, 1e-9 * top, "its amplitude");
  accuracy_clear(&a);
  comparison_clear(&c);
  case_clear(&sc);
}

/* Three orbits and the curve with ten harmonics show the peak of a large structure. An orbit there has the amplitude
 * that was found, and those beside it are of one height. */
static void the_peak_of_a_large_structure_is_that_of_its_orbits(CHECK_STATE)
{
  const char *set[] = {"compare.harmonics=[1]", "compare.samples=[32]"};
  scene sc = case_scene("structures/plates", 2, set);
  const comparison none = {0};
  const double d = 0.05;
  hbm_point point = {0};
  CHECK_FILLED(accuracy, a, scene_accuracy_run(&sc, &none, NULL, &a));
  assert_true(a.peak_by_orbit);
  CHECK_FILLED(compare_setup, setup, scene_setup(&sc, &setup));
  CHECK_MADE(timeint, ti, comparison_referee(&setup, NULL, &ti));
  CHECK_MADE(hbm_solver, s, hbm_solver_new(setup.model, &setup.hbm, &s));
  double *X = calloc((size_t)hbm_n_coefficients(s), sizeof *X), amplitude[3];
  double *start = calloc((size_t)timeint_n_states(ti), sizeof *start);
  assert_true(X && start);
  assert_int_equal(hbm_solve(s, a.peak_omega, X, &point), HC_OK);
  assert_int_equal(comparison_orbit_start(s, X, a.peak_omega, start), HC_OK);
  for (int i = 0; i < 3; ++i) {
    CHECK_FILLED(timeint_result, r, timeint_orbit(ti, a.peak_omega + (i - 1) * d, 1, start, NULL, &r));
    amplitude[i] = r.amplitude;
  }
  const double off = 0.5 * (amplitude[2] - amplitude[0]) / (amplitude[2] - 2 * amplitude[1] + amplitude[0]);
  CHECK_NEAR(a.peak_amplitude, amplitude[1], 1e-9 * amplitude[1], "amplitude");
  CHECK_NEAR(off, 0, 0.01, "distance of the peak, of 0.02 half-widths");
  free(start);
  free(X);
  hbm_solver_free(s);
  timeint_free(ti);
  scene_setup_clear(&setup);
  accuracy_clear(&a);
  case_clear(&sc);
}

static hc_status run_with_jobs(const scene *sc, const comparison *c, int jobs, const hc_monitor *monitor, accuracy *a)
{
  CHECK_FILLED(compare_setup, setup, scene_setup(sc, &setup));
  setup.jobs = jobs;
  hc_status st = accuracy_run(&setup, c, monitor, a);
  scene_setup_clear(&setup);
  return st;
}

static void check_same_row(const accuracy_row *a, const accuracy_row *b)
{
  assert_true(a->harmonics == b->harmonics && a->samples == b->samples && a->status == b->status);
  assert_true(a->solutions == b->solutions && a->missing == b->missing && a->turning_points == b->turning_points);
  assert_true(a->worst == b->worst || (isnan(a->worst) && isnan(b->worst)));
  assert_true(a->median == b->median || (isnan(a->median) && isnan(b->median)));
  assert_true(a->peak_amplitude == b->peak_amplitude || (isnan(a->peak_amplitude) && isnan(b->peak_amplitude)));
  assert_true(a->iterations == b->iterations && a->evaluations == b->evaluations && a->rejected == b->rejected);
  assert_true(a->false_turning_points == b->false_turning_points && a->possible == b->possible);
  assert_true(a->aliasing == b->aliasing || (isnan(a->aliasing) && isnan(b->aliasing)));
}

/* Interrupted anywhere: HC_INTERRUPTED, its rows those of a whole run, bit for bit; once between the two rows. */
static void an_interrupt_keeps_whole_rows(CHECK_STATE)
{
  scene sc = case2();
  sc.compare.harmonics = (number_list){2, {1, 3}};
  CHECK_FILLED(comparison, c, scene_comparison_run(&sc, NULL, &c));
  int between = 0;
  CHECK_FILLED(accuracy, whole, scene_accuracy_run(&sc, &c, NULL, &whole));
  assert_int_equal(whole.n_rows, 2);
  for (int ticks = 1; ticks < 400; ticks += 1 + ticks / 8) {
    accuracy a;
    int left = ticks;
    hc_monitor monitor = {check_stop, &left};
    hc_status st = scene_accuracy_run(&sc, &c, &monitor, &a);
    assert_int_equal(st, left > 0 ? HC_OK : HC_INTERRUPTED);
    assert_true(a.n_rows <= 2 && (st == HC_INTERRUPTED || a.n_rows == 2));
    between += a.n_rows == 1;
    for (int i = 0; i < a.n_rows; ++i) check_same_row(&a.rows[i], &whole.rows[i]);
    accuracy_clear(&a);
  }
  assert_true(between > 0);
  accuracy_clear(&whole);
  comparison_clear(&c);
}

/* The same rows and orders, in the same order, by one thread, two, and more than there are rows. */
static void threads_change_nothing(CHECK_STATE)
{
  static const int jobs[] = {2, 16};
  scene sc = case2();
  sc.transient.law = TRANSIENT_LAW_REGULARISED; /* so that there is an order of the regularisation, too */
  sc.compare.harmonics = (number_list){3, {3, 1, 5}};
  sc.compare.samples = (number_list){4, {256, 64, 8, 1024}};
  CHECK_FILLED(comparison, c, scene_comparison_run(&sc, NULL, &c));
  CHECK_FILLED(accuracy, one, run_with_jobs(&sc, &c, 1, NULL, &one));
  assert_int_equal(one.n_rows, 15);
  for (int i = 0; i < 3; ++i) assert_int_equal(one.orders[i].harmonics, 1 + 2 * i);
  for (int k = 0; k < 2; ++k) {
    CHECK_FILLED(accuracy, some, run_with_jobs(&sc, &c, jobs[k], NULL, &some));
    assert_int_equal(some.n_rows, one.n_rows);
    assert_int_equal(some.n_orders, one.n_orders);
    for (int i = 0; i < one.n_rows; ++i) check_same_row(&some.rows[i], &one.rows[i]);
    for (int i = 0; i < one.n_orders; ++i) {
      assert_string_equal(some.orders[i].quantity, one.orders[i].quantity);
      assert_true(some.orders[i].harmonics == one.orders[i].harmonics);
      assert_true(some.orders[i].fit.order == one.orders[i].fit.order);
    }
    accuracy_clear(&some);
  }
  assert_string_equal(one.orders[one.n_orders - 1].quantity, "regularisation");
  accuracy_clear(&one);
  comparison_clear(&c);
}

/* Asked on the calling thread only; stops when the first of the tasks is done, or after so many times. */
typedef struct interrupter {
  pthread_t caller;
  int left;
  bool when_some_are_done;
} interrupter;

static bool stop_later(void *self, double done)
{
  interrupter *s = self;
  assert_true(pthread_equal(s->caller, pthread_self()));
  assert_true(done <= 1);
  if (s->when_some_are_done && done > 0 && done < 1) s->left = 1;
  return --s->left > 0;
}

/* What is there of `part` are rows of `whole`, in its order; how many. */
static int check_part(const accuracy *part, const accuracy *whole)
{
  int k = 0;
  for (int i = 0; i < part->n_rows; ++i, ++k) {
    const accuracy_row *row = &part->rows[i];
    while (k < whole->n_rows && (whole->rows[k].harmonics != row->harmonics || whole->rows[k].samples != row->samples))
      ++k;
    assert_true(k < whole->n_rows);
    check_same_row(row, &whole->rows[k]);
  }
  return part->n_rows;
}

static void an_interrupt_stops_all_threads(CHECK_STATE)
{
  scene sc = case2();
  accuracy whole, a;
  sc.compare.harmonics = (number_list){2, {1, 3}};
  sc.compare.samples = (number_list){3, {64, 128, 1 << 17}}; /* the last takes longer than the calling thread waits */
  CHECK_FILLED(comparison, c, scene_comparison_run(&sc, NULL, &c));
  assert_int_equal(run_with_jobs(&sc, &c, 1, NULL, &whole), HC_OK);
  assert_int_equal(whole.n_rows, 8);
  interrupter stop = {pthread_self(), INT_MAX, true};
  hc_monitor monitor = {stop_later, &stop};
  assert_int_equal(run_with_jobs(&sc, &c, 2, &monitor, &a), HC_INTERRUPTED);
  CHECK_LE(check_part(&a, &whole), 7, "the long one is given up");
  assert_true(a.n_rows > 2);
  accuracy_clear(&a);
  for (int ticks = 1; ticks < 400; ticks += 1 + ticks / 2) {
    stop = (interrupter){pthread_self(), ticks, true};
    assert_int_equal(run_with_jobs(&sc, &c, 2, &monitor, &a), HC_INTERRUPTED);
    assert_true(check_part(&a, &whole) < 8);
    accuracy_clear(&a);
  }
  accuracy_clear(&whole);
  comparison_clear(&c);
}

CHECK_TESTS("compare.budget_tables", 240, rows_are_the_grid, the_table_agrees_with_the_rows,
            the_peak_is_the_limit_of_many_harmonics, a_smooth_peak_lies_between_orbits_of_one_height,
            the_peak_of_a_large_structure_is_that_of_its_orbits, an_interrupt_keeps_whole_rows, threads_change_nothing,
            an_interrupt_stops_all_threads)
