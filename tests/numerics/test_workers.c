/* test_workers.c - every piece of work is done once, the first reason to stop is kept, and what the system cannot give
 * (locks, threads) is a status. The linker wraps the calls that are made to fail. */
#include <errno.h>

#include "numerics/workers.h"
#include "tests/check.h"
#include "tests/wrap.h"

enum { TASKS = 500, THREADS = 4 };

static int lock_error, condition_error, thread_error; /* what the next calls answer; 0: what they do */

WRAP(int, pthread_mutex_init, (pthread_mutex_t * lock, const pthread_mutexattr_t *how))
{
  return lock_error ? lock_error : __real_pthread_mutex_init(lock, how);
}

WRAP(int, pthread_cond_init, (pthread_cond_t * changed, const pthread_condattr_t *how))
{
  return condition_error ? condition_error : __real_pthread_cond_init(changed, how);
}

WRAP(int, pthread_create, (pthread_t * thread, const pthread_attr_t *how, void *(*run)(void *), void *self))
{
  return thread_error ? thread_error : __real_pthread_create(thread, how, run, self);
}

typedef struct task {
  workers workers; /* its lock is of what follows */
  int next, done[TASKS], stop_at;
} task;

static void *work(void *self)
{
  task *t = self;
  for (;;) {
    pthread_mutex_lock(&t->workers.lock);
    int i = t->next < TASKS && workers_tick(&t->workers, 0) ? t->next++ : -1;
    if (i >= 0) ++t->done[i];
    pthread_mutex_unlock(&t->workers.lock);
    if (i < 0) break;
    if (i >= t->stop_at) workers_stop(&t->workers, i == t->stop_at ? HC_IO : HC_STALLED);
  }
  workers_leave(&t->workers);
  return NULL;
}

static hc_status run_workers(task *t, int stop_at)
{
  *t = (task){.stop_at = stop_at};
  assert_int_equal(workers_init(&t->workers), HC_OK);
  workers_start(&t->workers, THREADS, work, t);
  while (workers_wait(&t->workers, 1000)) continue;
  assert_int_equal(t->workers.running, 0);
  return workers_join(&t->workers);
}

static void each_piece_is_done_once(CHECK_STATE)
{
  static task t;
  assert_int_equal(run_workers(&t, TASKS), HC_OK);
  for (int i = 0; i < TASKS; ++i) assert_int_equal(t.done[i], 1);
}

/* Stopped at the first piece: each of the threads can have one more in hand by then, and gives another reason. */
static void the_first_reason_is_kept(CHECK_STATE)
{
  static task t;
  hc_status st = run_workers(&t, 0);
  assert_true(st == HC_IO || st == HC_STALLED);
  assert_true(t.next <= THREADS);
  assert_int_equal(workers_init(&t.workers), HC_OK);
  workers_stop(&t.workers, HC_NOT_FINITE);
  workers_stop(&t.workers, HC_IO);
  assert_true(workers_stopped(&t.workers) && !workers_tick(&t.workers, 0.5));
  assert_int_equal(workers_join(&t.workers), HC_NOT_FINITE);
}

static void what_the_system_lacks_is_a_status(CHECK_STATE)
{
  static task t;
  lock_error = ENOMEM;
  assert_int_equal(workers_init(&t.workers), HC_NO_MEMORY);
  lock_error = 0, condition_error = EAGAIN;
  assert_int_equal(workers_init(&t.workers), HC_NO_MEMORY);
  condition_error = 0, thread_error = EAGAIN;
  assert_int_equal(run_workers(&t, TASKS), HC_NO_MEMORY);
  assert_int_equal(t.next, 0);
  thread_error = 0;
}

/* ---- workers_run ----------------------------------------------------------------------------- */

typedef struct listed {
  atomic_int done[TASKS];
  int fails_at, waits_at;
} listed;

static hc_status do_listed(void *self, int i, const hc_monitor *monitor)
{
  listed *l = self;
  atomic_fetch_add(&l->done[i], 1);
  while (i == l->waits_at)
    if (!hc_monitor_tick(monitor, 0.5)) return HC_INTERRUPTED;
  return i == l->fails_at ? HC_STALLED : HC_OK;
}

static hc_status run_list(listed *l, int jobs, int fails_at, int waits_at, const hc_monitor *monitor)
{
  *l = (listed){.fails_at = fails_at, .waits_at = waits_at};
  return workers_run(jobs, TASKS, do_listed, l, monitor);
}

/* By the calling thread, by several, and by more than there are tasks. */
static void each_listed_task_is_done_once(CHECK_STATE)
{
  static listed l;
  static const int jobs[] = {0, 1, 2, THREADS, TASKS + 1};
  for (int k = 0; k < 5; ++k) {
    assert_int_equal(run_list(&l, jobs[k], -1, -1, NULL), HC_OK);
    for (int i = 0; i < TASKS; ++i) assert_int_equal(l.done[i], 1);
  }
  assert_int_equal(workers_run(THREADS, 0, do_listed, &l, NULL), HC_OK);
}

static void a_failed_task_ends_the_list(CHECK_STATE)
{
  static listed l;
  assert_int_equal(run_list(&l, 1, 7, -1, NULL), HC_STALLED);
  assert_int_equal(l.done[7], 1);
  assert_int_equal(l.done[8], 0);
  assert_int_equal(run_list(&l, THREADS, 7, 3, NULL), HC_STALLED); /* one under way is told to stop */
  thread_error = EAGAIN;
  assert_int_equal(run_list(&l, THREADS, -1, -1, NULL), HC_NO_MEMORY);
  thread_error = 0;
}

typedef struct asked {
  pthread_t caller;
  int times;
  double last;
} asked;

static bool stop_third_time(void *self, double done)
{
  asked *a = self;
  assert_true(pthread_equal(a->caller, pthread_self()));
  assert_true(done >= a->last && done <= 1);
  a->last = done;
  return ++a->times < 3;
}

/* A task that would wait for ever; the calling thread alone is asked, and told a part that never falls. */
static void the_caller_can_stop_the_list(CHECK_STATE)
{
  static listed l;
  for (int jobs = 1; jobs <= THREADS; ++jobs) {
    asked a = {.caller = pthread_self()};
    hc_monitor monitor = {stop_third_time, &a};
    assert_int_equal(run_list(&l, jobs, -1, 1, &monitor), HC_INTERRUPTED);
    assert_true(a.times >= 3);
    assert_int_equal(l.done[0], 1);
  }
}

CHECK_TESTS("numerics.workers", 60, each_piece_is_done_once, the_first_reason_is_kept,
            what_the_system_lacks_is_a_status, each_listed_task_is_done_once, a_failed_task_ends_the_list,
            the_caller_can_stop_the_list)
