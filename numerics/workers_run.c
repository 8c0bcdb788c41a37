/* workers_run.c - see workers.h: a list of tasks. Separate from workers.c, so that tests can replace that. */
#include "numerics/workers.h"

typedef struct task_list {
  workers workers; /* its lock protects next and done */
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

/* The monitor of a task on the calling thread: reports the unchanged progress of the whole list. */
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

hc_status workers_run(int jobs, int n, workers_task task, void *self, const hc_monitor *monitor)
{
  enum { WATCH_MS = 50 };
  task_list l = {.task = task, .self = self, .n = n};
  if (jobs <= 1 || n <= 1) {
    frozen_progress at = {monitor, 0};
    hc_monitor inner = {tick_frozen, &at};
    hc_status st = HC_OK;
    for (int i = 0; i < n && st == HC_OK; ++i) {
      at.done = (double)i / n;
      st = hc_monitor_tick(monitor, at.done) ? task(self, i, &inner) : HC_INTERRUPTED;
    }
    return st;
  }
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
