/* workers.c - see workers.h. */
#include "numerics/workers.h"

#include <stdlib.h>
#include <time.h>

hc_status workers_init(workers *w)
{
  *w = (workers){.worst = HC_OK};
  atomic_init(&w->stop, false);
  if (pthread_mutex_init(&w->lock, NULL) != 0) return HC_NO_MEMORY;
  if (pthread_cond_init(&w->changed, NULL) == 0) return HC_OK;
  pthread_mutex_destroy(&w->lock);
  return HC_NO_MEMORY;
}

void workers_start(workers *w, int threads, void *(*work)(void *), void *self)
{
  w->threads = calloc((size_t)threads, sizeof *w->threads);
  pthread_mutex_lock(&w->lock);
  while (w->threads && w->n < threads && pthread_create(&w->threads[w->n], NULL, work, self) == 0) ++w->n;
  w->running = w->n;
  pthread_mutex_unlock(&w->lock);
  if (w->n == 0) workers_stop(w, HC_NO_MEMORY);
}

void workers_leave(workers *w)
{
  pthread_mutex_lock(&w->lock);
  --w->running;
  pthread_cond_signal(&w->changed);
  pthread_mutex_unlock(&w->lock);
}

void workers_stop(workers *w, hc_status why)
{
  pthread_mutex_lock(&w->lock);
  if (w->worst == HC_OK) w->worst = why;
  pthread_mutex_unlock(&w->lock);
  atomic_store(&w->stop, true);
}

bool workers_tick(void *self, double done)
{
  (void)done;
  return !workers_stopped(self);
}

bool workers_wait(workers *w, int ms)
{
  struct timespec until;
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += ms * 1000000L;
  if (until.tv_nsec >= 1000000000L) until.tv_nsec -= 1000000000L, ++until.tv_sec;
  pthread_mutex_lock(&w->lock);
  if (w->running > 0) pthread_cond_timedwait(&w->changed, &w->lock, &until);
  bool at_work = w->running > 0;
  pthread_mutex_unlock(&w->lock);
  return at_work;
}

hc_status workers_join(workers *w)
{
  for (int i = 0; i < w->n; ++i) pthread_join(w->threads[i], NULL);
  free(w->threads);
  pthread_cond_destroy(&w->changed);
  pthread_mutex_destroy(&w->lock);
  return w->worst;
}

/* ---- a list of tasks ------------------------------------------------------------------------- */

typedef struct task_list {
  workers workers; /* its lock is of next and done */
  workers_task task;
  void *self;
  int n, next, done;
} task_list;

static int next_task(task_list *l)
{
  pthread_mutex_lock(&l->workers.lock);
  int task = l->next < l->n && !workers_stopped(&l->workers) ? l->next++ : -1;
  pthread_mutex_unlock(&l->workers.lock);
  return task;
}

static void *work_on_list(void *self)
{
  task_list *l = self;
  hc_monitor monitor = {workers_tick, &l->workers};
  for (int task; (task = next_task(l)) >= 0;) {
    hc_status st = l->task(l->self, task, &monitor);
    if (st != HC_OK) workers_stop(&l->workers, st);
    pthread_mutex_lock(&l->workers.lock);
    ++l->done;
    pthread_mutex_unlock(&l->workers.lock);
  }
  workers_leave(&l->workers);
  return NULL;
}

/* The monitor of a task on the calling thread: the progress of the whole list stays where it is. */
typedef struct frozen_progress {
  const hc_monitor *whole;
  double done;
} frozen_progress;

static bool tick_frozen(void *self, double done)
{
  const frozen_progress *s = self;
  (void)done;
  return hc_monitor_tick(s->whole, s->done);
}

static hc_status run_here(int n, workers_task task, void *self, const hc_monitor *monitor)
{
  frozen_progress at = {monitor, 0};
  hc_monitor inner = {tick_frozen, &at};
  hc_status st = HC_OK;
  for (int i = 0; i < n && st == HC_OK; ++i) {
    at.done = (double)i / n;
    st = hc_monitor_tick(monitor, at.done) ? task(self, i, &inner) : HC_INTERRUPTED;
  }
  return st;
}

hc_status workers_run(int jobs, int n, workers_task task, void *self, const hc_monitor *monitor)
{
  enum { WATCH_MS = 50 };
  task_list l = {.task = task, .self = self, .n = n};
  if (jobs <= 1 || n <= 1) return run_here(n, task, self, monitor);
  hc_status st = workers_init(&l.workers);
  if (st != HC_OK) return st;
  workers_start(&l.workers, jobs < n ? jobs : n, work_on_list, &l);
  do {
    pthread_mutex_lock(&l.workers.lock);
    double done = (double)l.done / n;
    pthread_mutex_unlock(&l.workers.lock);
    if (!hc_monitor_tick(monitor, done)) workers_stop(&l.workers, HC_INTERRUPTED);
  } while (workers_wait(&l.workers, WATCH_MS));
  return workers_join(&l.workers);
}
