/* test_own_handles.c - threads that each have handles of their own do not know of each other: whatever runs beside
 * it, a run gives the very bits it gives alone. Under -DHBMCHECK_SANITIZE=thread the same runs show any race that
 * left the bits alone. */
#include "tests/check.h"

#include <pthread.h>
#include <string.h>

#include "hbmcheck.h"

enum { THREADS = 4, ROUNDS = 2, MOST_NUMBERS = 1 << 16 };

/* Every number of a result, in order; NaN is a number like any other here: only bits count. */
typedef struct record {
  int n;
  double v[MOST_NUMBERS];
} record;

static void put(record *r, double v)
{
  if (r->n < MOST_NUMBERS) r->v[r->n] = v;
  ++r->n; /* too many: seen by the caller */
}

static void put_all(record *r, int n, const double *v)
{
  for (int i = 0; i < n; ++i) put(r, v[i]);
}

/* Case 2 of the paper, changed by up to two assignments; through the reader, which has a locale to hold on to. */
static scene case2(const char *first, const char *second)
{
  static const char text[] =
      "oscillator: {mass: 1.0, damping: 0.4, stiffness: 40}\n"
      "forcing: {amplitude: 100}\n"
      "contacts:\n"
      "  - {tangential_stiffness: 100, normal_stiffness: 1000, friction: 0.3, angle_deg: 45, gap: -5}\n"
      "sweep: {omega: [3, 20]}\n"
      "compare: {omega: [5, 7]}\n";
  const char *set[] = {first, second};
  case_error err;
  scene sc;
  memset(&sc, 0, sizeof sc);
  if (case_parse("case 2", text, sizeof text - 1, (first != NULL) + (second != NULL), set, &sc, &err) != HC_OK)
    print_error("%s\n", err.message);
  return sc;
}

static void put_curve(record *r, const hbm_curve *c)
{
  put(r, c->n);
  put(r, c->turning_points);
  put(r, (double)c->evaluations);
  for (int i = 0; i < c->n; ++i) {
    const hbm_point *p = &c->points[i];
    put_all(r, 4, (double[]){p->omega, p->residual, p->branch, p->iterations});
  }
  put_all(r, c->n * c->n_coef, c->X);
}

static void put_transient(record *r, const timeint_result *t)
{
  put_all(r, 8, (double[]){t->amplitude, t->max, t->min, t->rms, t->mean, t->a1, t->b1, t->closure});
  put_all(r, 4, (double[]){t->multiplier, t->periods, (double)t->steps, (double)t->rhs});
  put_all(r, TIMEINT_WAVE, t->wave);
}

static void trace(record *r, const scene *sc)
{
  hbm_solver *s;
  hbm_curve curve = {0};
  hbm_special specials[16];
  int n = 0;
  compare_setup setup;
  assert_int_equal(scene_setup(sc, &setup), HC_OK);
  hc_status st = hbm_solver_new(setup.model, &setup.hbm, &s);
  scene_setup_clear(&setup);
  if (st == HC_OK) st = hbm_trace(s, sc->omega_from, sc->omega_to, NULL, &curve);
  if (st == HC_OK) st = hbm_specials(s, &curve, 16, specials, &n); /* stability: eigenvalues by GSL */
  put(r, st);
  put_curve(r, &curve);
  for (int i = 0; i < n && i < 16; ++i) put_all(r, 2, (double[]){specials[i].omega, specials[i].amplitude});
  hbm_curve_free(&curve);
  hbm_solver_free(s);
}

static void settle(record *r, const scene *sc)
{
  timeint *ti;
  timeint_result result;
  double y[TIMEINT_W + 1] = {0}; /* at rest; scenes of one contact */
  memset(&result, 0, sizeof result);
  compare_setup setup;
  assert_int_equal(scene_setup(sc, &setup), HC_OK);
  hc_status st = timeint_new(setup.model, &setup.transient, &ti);
  scene_setup_clear(&setup);
  if (st == HC_OK) st = timeint_steady(ti, 7, y, NULL, &result);
  put(r, st);
  put_all(r, 3, y);
  put_transient(r, &result);
  timeint_free(ti);
}

static void trace_exact(record *r)
{
  scene sc = case2(NULL, NULL);
  trace(r, &sc);
}

static void trace_sampled(record *r) /* the one with FFTW's planner */
{
  scene sc = case2("hbm.force=sampled", "sweep.omega=4,7");
  trace(r, &sc);
}

static void settle_regularised(record *r) /* what is wanted is many steps, not good ones */
{
  scene sc = case2("transient.regularisation=1e-2", "transient.tolerance=1e-6");
  settle(r, &sc);
}

static void settle_exact(record *r)
{
  scene sc = case2("transient.law=exact", "transient.steady_state=march");
  settle(r, &sc);
}

static void compare(record *r)
{
  scene sc = case2(NULL, NULL);
  comparison c;
  compare_setup setup;
  assert_int_equal(scene_setup(&sc, &setup), HC_OK);
  put(r, comparison_run(&setup, NULL, &c));
  scene_setup_clear(&setup);
  put(r, c.n_rows);
  put_curve(r, &c.curve);
  for (int i = 0; i < c.n_rows; ++i) {
    const comparison_row *row = &c.rows[i];
    put_all(r, 4, (double[]){row->verdict, row->hbm.amplitude, row->orbit_error, row->stability.multiplier});
    put_all(r, 4, (double[]){row->errors.amplitude, row->errors.harmonic_1, row->errors.mean, row->errors.waveform});
    put_transient(r, &row->transient);
  }
  comparison_clear(&c);
}

static void (*const jobs[])(record *) = {trace_exact, trace_sampled, settle_regularised, settle_exact, compare};
enum { JOBS = sizeof jobs / sizeof *jobs };

static record alone[JOBS]; /* written before the threads start, read by them */

typedef struct worker {
  pthread_t thread;
  pthread_barrier_t *start;
  int first; /* each begins with another job, so that unlike ones meet too */
  int wrong[JOBS];
  record found;
} worker;

static void *work(void *self)
{
  worker *w = self;
  pthread_barrier_wait(w->start);
  for (int k = 0; k < ROUNDS * JOBS; ++k) {
    int j = (w->first + k) % JOBS;
    w->found.n = 0;
    jobs[j](&w->found);
    w->wrong[j] += w->found.n != alone[j].n || memcmp(w->found.v, alone[j].v, (size_t)alone[j].n * sizeof(double)) != 0;
  }
  return NULL;
}

/* What is compared must be results: each job's first number is its status, and a failure would repeat itself
 * faithfully. */
static int run_alone(void **state)
{
  (void)state;
  for (int j = 0; j < JOBS; ++j) {
    jobs[j](&alone[j]);
    if (alone[j].v[0] != HC_OK || alone[j].n < 100 || alone[j].n > MOST_NUMBERS) {
      print_error("job %d alone: status %g, %d numbers\n", j, alone[j].v[0], alone[j].n);
      return -1;
    }
  }
  return 0;
}

static void together_as_alone(void **state)
{
  (void)state;
  worker *w = calloc(THREADS, sizeof *w);
  pthread_barrier_t start;
  assert_non_null(w);
  assert_int_equal(pthread_barrier_init(&start, NULL, THREADS), 0);
  for (int i = 0; i < THREADS; ++i) {
    w[i].start = &start, w[i].first = i;
    assert_int_equal(pthread_create(&w[i].thread, NULL, work, &w[i]), 0);
  }
  for (int i = 0; i < THREADS; ++i) assert_int_equal(pthread_join(w[i].thread, NULL), 0);
  for (int i = 0; i < THREADS; ++i)
    for (int j = 0; j < JOBS; ++j)
      if (w[i].wrong[j]) fail_msg("thread %d: job %d gave other bits %d times of %d", i, j, w[i].wrong[j], ROUNDS);
  pthread_barrier_destroy(&start);
  free(w);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(together_as_alone)};
  check_watchdog(300); /* the thread sanitizer takes ten times as long */
  return cmocka_run_group_tests_name("threads.own_handles", tests, run_alone, NULL);
}
