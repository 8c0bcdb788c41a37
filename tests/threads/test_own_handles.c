/* test_own_handles.c - threads that each have handles of their own do not know of each other: whatever runs beside
 * it, a run gives the very bits it gives alone. Under -DHBMCHECK_SANITIZE=thread the same runs show any race that
 * left the bits alone. */
#include "tests/check.h"

#include <pthread.h>

#include "interfaces/library/hbmcheck.h"

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

/* Case 2 of the paper, changed by up to two assignments; through the reader, which has a locale to hold on to. NULL:
 * not read. */
static hbmcheck_case *case2(const char *first, const char *second)
{
  static const char text[] =
      "oscillator: {mass: 1.0, damping: 0.4, stiffness: 40}\n"
      "forcing: {amplitude: 100}\n"
      "contacts:\n"
      "  - {tangential_stiffness: 100, normal_stiffness: 1000, friction: 0.3, angle_deg: 45, gap: -5}\n"
      "sweep: {omega: [3, 20]}\n"
      "compare: {omega: [5, 7]}\n";
  const char *set[] = {first, second};
  char message[512];
  hbmcheck_case *c;
  if (hbmcheck_case_parse("case 2", text, sizeof text - 1, (first != NULL) + (second != NULL), set, message,
                          sizeof message, &c) != HBMCHECK_OK)
    print_error("%s\n", message);
  return c;
}

static void put_solution(record *r, const hbmcheck_solutions *list, int k)
{
  hbmcheck_solution s;
  double X[64];
  int n = 0;
  hbmcheck_solutions_get(list, k, &s);
  hbmcheck_solutions_coefficients(list, k, 64, X, &n);
  put_all(r, 5, (double[]){s.omega, s.amplitude, s.rms, s.residual, s.multiplier});
  put_all(r, 3, (double[]){s.branch, s.iterations, s.stable});
  put_all(r, n < 64 ? n : 64, X);
}

/* c, and what is found, are freed. */
static void trace(record *r, hbmcheck_case *c)
{
  hbmcheck_curve *curve = NULL;
  hbmcheck_special specials[16];
  hbmcheck_summary whole = {0};
  int n = 0;
  hbmcheck_status st = hbmcheck_curve_trace(c, NULL, &curve); /* stability: eigenvalues by GSL */
  if (st == HBMCHECK_OK) st = hbmcheck_curve_specials(curve, 16, specials, &n);
  if (st == HBMCHECK_OK) st = hbmcheck_curve_summary(curve, &whole);
  put(r, st);
  put_all(r, 3, (double[]){whole.turning_points, (double)whole.evaluations, whole.peak_amplitude});
  const hbmcheck_solutions *points = hbmcheck_curve_points(curve);
  for (int k = 0; k < hbmcheck_solutions_count(points); ++k) put_solution(r, points, k);
  for (int i = 0; i < n && i < 16; ++i) put_all(r, 2, (double[]){specials[i].omega, specials[i].amplitude});
  hbmcheck_curve_free(curve);
  hbmcheck_case_free(c);
}

/* c is freed. */
static void settle(record *r, hbmcheck_case *c)
{
  const double omega = 7;
  hbmcheck_transient *t = NULL;
  hbmcheck_steady s;
  double wave[1024];
  int n = 0;
  hbmcheck_status st = hbmcheck_transient_run(c, 1, &omega, NULL, &t);
  if (st == HBMCHECK_OK) st = hbmcheck_transient_get(t, 0, &s);
  if (st == HBMCHECK_OK) st = hbmcheck_transient_wave(t, 0, 1024, wave, &n);
  put(r, st == HBMCHECK_OK ? s.status : st);
  if (st == HBMCHECK_OK) {
    put_all(r, 7, (double[]){s.amplitude, s.max, s.min, s.rms, s.mean, s.harmonic_1, s.closure});
    put_all(r, 4, (double[]){s.multiplier, s.periods, (double)s.steps, s.from_regularisation});
    put_all(r, n < 1024 ? n : 1024, wave);
  }
  hbmcheck_transient_free(t);
  hbmcheck_case_free(c);
}

static void trace_exact(record *r) { trace(r, case2(NULL, NULL)); }

static void trace_sampled(record *r) /* the one with FFTW's planner */
{
  trace(r, case2("hbm.force=sampled", "sweep.omega=4,7"));
}

static void settle_regularised(record *r) /* what is wanted is many steps, not good ones */
{
  settle(r, case2("transient.regularisation=1e-2", "transient.tolerance=1e-6"));
}

static void settle_exact(record *r) { settle(r, case2("transient.law=exact", "transient.steady_state=march")); }

static void compare(record *r)
{
  hbmcheck_case *c = case2(NULL, NULL);
  hbmcheck_comparison *both = NULL;
  put(r, hbmcheck_comparison_run(c, 0, NULL, NULL, &both));
  const int n = hbmcheck_comparison_count(both);
  put(r, n);
  for (int k = 0; k < n; ++k) {
    hbmcheck_row row;
    hbmcheck_comparison_get(both, k, &row);
    put_all(r, 4, (double[]){row.verdict, row.hbm_amplitude, row.orbit_error, row.multiplier});
    put_all(r, 4, (double[]){row.amplitude_error, row.harmonic_1_error, row.mean_error, row.waveform_error});
    put_all(r, 3, (double[]){row.transient_amplitude, row.orbit_amplitude, row.from_aliasing});
    put_all(r, 4, (double[]){row.from_truncation, row.from_regularisation, row.from_integration, row.from_settling});
  }
  hbmcheck_comparison_free(both);
  hbmcheck_case_free(c);
}

/* Points that lie on nothing, so that every mistake is tried. */
static void verify(record *r)
{
  const double omega[] = {4, 4.5, 5, 5.5, 6, 7}, value[] = {4, 5, 7, 8, 9, 12};
  const hbmcheck_foreign theirs = {.quantity = "amplitude", .n = 6, .omega = omega, .value = value};
  hbmcheck_case *c = case2(NULL, NULL);
  hbmcheck_verification *v = NULL;
  put(r, hbmcheck_verification_run(c, &theirs, NULL, NULL, 0, &v));
  put_all(r, 2, (double[]){hbmcheck_verification_count(v), hbmcheck_verification_hypotheses(v)});
  for (int k = 0; k < hbmcheck_verification_count(v); ++k) {
    hbmcheck_point p;
    hbmcheck_verification_get(v, k, &p);
    put_all(r, 4, (double[]){p.nearest, p.error, p.verdict, p.branch});
  }
  for (int k = 0; k < hbmcheck_verification_hypotheses(v); ++k) {
    hbmcheck_hypothesis h;
    hbmcheck_verification_hypothesis(v, k, &h);
    put_all(r, 4, (double[]){h.distance, h.omega_factor, h.value_factor, h.samples});
  }
  hbmcheck_verification_free(v);
  hbmcheck_case_free(c);
}

/* One contact, exact and by samples: the latter make and free plans of FFTW. */
static void force(record *r)
{
  enum { H = 9, LENGTH = 2 * H + 1 };
  const double u[LENGTH] = {0, 4, 1, 0.5}, v[LENGTH] = {0.2, 3, 0, 1};
  double T[LENGTH], N[LENGTH];
  hbmcheck_case *c = case2(NULL, NULL);
  for (int samples = 0; samples <= 128; samples += 64) {
    put(r, hbmcheck_contact_force(c, 0, H, u, NULL, v, samples, T, NULL, N));
    put_all(r, LENGTH, T);
    put_all(r, LENGTH, N);
  }
  hbmcheck_case_free(c);
}

static void (*const jobs[])(record *) = {trace_exact, trace_sampled, settle_regularised, settle_exact, compare,
                                         verify,      force};
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
 * faithfully. A comparison has 15 numbers a row. */
static int run_alone(CHECK_STATE)
{
  for (int j = 0; j < JOBS; ++j) {
    jobs[j](&alone[j]);
    if (alone[j].v[0] != HBMCHECK_OK || alone[j].n < 2 + 2 * 15 || alone[j].n > MOST_NUMBERS) {
      print_error("job %d alone: status %g, %d numbers\n", j, alone[j].v[0], alone[j].n);
      return -1;
    }
  }
  return 0;
}

static void together_as_alone(CHECK_STATE)
{
  worker *w = calloc(THREADS, sizeof *w);
  assert_non_null(w);
  CHECK_FILLED(pthread_barrier_t, start, pthread_barrier_init(&start, NULL, THREADS));
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

/* the thread sanitizer takes ten times as long */
CHECK_TESTS_WITH("threads.own_handles", 600, run_alone, NULL, together_as_alone)
