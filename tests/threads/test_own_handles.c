/* test_own_handles.c - threads that each have handles of their own do not know of each other: whatever runs beside
 * it, a run gives the very bits it gives alone. Under -DHBMCHECK_SANITIZE=thread the same runs show any race that
 * left the bits alone. */
#include "tests/check.h"

#include <pthread.h>

#include "interfaces/library/hbmcheck.h"

enum { THREADS = 4, ROUNDS = 2, MOST_NUMBERS = 1 << 16, FEWEST = 12 /* of modes */ };

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

/* Every number of every table of that run, texts by their letters. */
static void run(record *r, hbmcheck_case *c, const char *command, int n, const char *const *options)
{
  hbmcheck_result *found = NULL;
  const hbmcheck_table *t;
  double series[4096];
  put(r, hbmcheck_run(c, command, n, options, NULL, &found));
  put(r, hbmcheck_result_exit_code(found));
  for (int i = 0; (t = hbmcheck_result_table(found, i)); ++i)
    for (int row = 0; row < hbmcheck_table_rows(t); ++row) {
      hbmcheck_column column = {.size = sizeof column};
      for (int j = 0; hbmcheck_table_column(t, j, &column) == HBMCHECK_OK; ++j) {
        const char *text = hbmcheck_table_text(t, row, column.name);
        for (const char *at = text ? text : ""; *at; ++at) put(r, *at);
        if (column.kind != HBMCHECK_SERIES) put(r, hbmcheck_table_number(t, row, column.name));
        else put_all(r, hbmcheck_table_numbers(t, row, column.name, 4096, series), series);
      }
    }
  hbmcheck_result_free(found);
  hbmcheck_case_free(c);
}

#define RUN(r, c, command, ...)                                                                                        \
  run(r, c, command, sizeof((const char *[]){__VA_ARGS__}) / sizeof(char *), (const char *const[]){__VA_ARGS__})

static void trace_exact(record *r) { RUN(r, case2("sweep.omega=3,7", NULL), "frf", "--contacts"); }

static void trace_sampled(record *r) /* the one with FFTW's planner */
{
  RUN(r, case2("hbm.force=sampled", "sweep.omega=4,7"), "frf", "--contacts");
}

static void settle_regularised(record *r) /* what is wanted is many steps, not good ones */
{
  RUN(r, case2("transient.regularisation=1e-2", "transient.tolerance=1e-6"), "transient", "--at=5,7");
}

static void settle_exact(record *r)
{
  RUN(r, case2("transient.law=exact", "transient.steady_state=march"), "transient", "--at=5,7");
}

static void compare(record *r) { RUN(r, case2(NULL, NULL), "compare", "--contacts"); }

/* Points that lie on nothing, so that every mistake is tried. */
static void verify(record *r)
{
  const double points[] = {4, 4.5, 5, 5.5, 6, 7, 4, 5, 7, 8, 9, 12};
  hbmcheck_case *c = case2(NULL, NULL);
  hbmcheck_case_give(c, "against", 2, 6, points, NULL, 0);
  RUN(r, c, "verify", "--quantity=amplitude");
}

static void modes(record *r) { RUN(r, case2(NULL, NULL), "modes", "--set=title=threads"); }

/* One contact, exact and by samples: the latter make and free plans of FFTW. */
static void force(record *r)
{
  RUN(r, case2(NULL, NULL), "contact", "--contact=0", "--motion-u=0,4,1,0.5,0", "--motion-v=0.2,3,0,1,0",
      "--samples=64,128");
}

static void (*const jobs[])(record *) = {trace_exact, trace_sampled, settle_regularised, settle_exact, compare, verify,
                                         force,       modes};
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
static int run_alone(CHECK_STATE)
{
  for (int j = 0; j < JOBS; ++j) {
    jobs[j](&alone[j]);
    if (alone[j].v[0] != HBMCHECK_OK || alone[j].n < FEWEST || alone[j].n > MOST_NUMBERS) {
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
