/* test_workers.c - every piece of work is done once, the first reason to stop is kept, and what the system cannot give
 * (locks, threads) is a status. The linker wraps the calls that are made to fail. */
#include <errno.h>
#include <pthread.h>

#include "numerics/workers.h"
#include "tests/check.h"

enum { TASKS = 500, THREADS = 4 };

static int lock_error, condition_error, thread_error; /* what the next calls answer; 0: what they do */

int __real_pthread_mutex_init(pthread_mutex_t *lock, const pthread_mutexattr_t *how);
int __wrap_pthread_mutex_init(pthread_mutex_t *lock, const pthread_mutexattr_t *how);
int __wrap_pthread_mutex_init(pthread_mutex_t *lock, const pthread_mutexattr_t *how)
{
  return lock_error ? lock_error : __real_pthread_mutex_init(lock, how);
}

int __real_pthread_cond_init(pthread_cond_t *changed, const pthread_condattr_t *how);
int __wrap_pthread_cond_init(pthread_cond_t *changed, const pthread_condattr_t *how);
int __wrap_pthread_cond_init(pthread_cond_t *changed, const pthread_condattr_t *how)
{
  return condition_error ? condition_error : __real_pthread_cond_init(changed, how);
}

int __real_pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*run)(void *), void *self);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*run)(void *), void *self);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*run)(void *), void *self)
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

static void each_piece_is_done_once(void **state)
{
  (void)state;
  static task t;
  assert_int_equal(run_workers(&t, TASKS), HC_OK);
  for (int i = 0; i < TASKS; ++i) assert_int_equal(t.done[i], 1);
}

/* Stopped at the first piece: each of the threads can have one more in hand by then, and gives another reason. */
static void the_first_reason_is_kept(void **state)
{
  (void)state;
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

static void what_the_system_lacks_is_a_status(void **state)
{
  (void)state;
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

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(each_piece_is_done_once),
    cmocka_unit_test(the_first_reason_is_kept),
    cmocka_unit_test(what_the_system_lacks_is_a_status),
};

CHECK_MAIN("numerics.workers", tests, 60)
