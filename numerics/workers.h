/* workers.h - several threads at work on the same list of tasks until none is left or they are told to stop, and the
 * calling thread, which waits for them and may stop them. The tasks and their results are the caller's: its data that
 * the threads share are read and written under the lock as well. */
#pragma once

#include <pthread.h>
#include <stdatomic.h>

#include "numerics/base/status.h"

typedef struct workers {
  pthread_mutex_t lock;
  pthread_cond_t changed; /* a thread has ended */
  int running;            /* threads that have not left; under the lock */
  hc_status worst;        /* why they were stopped, by the first call that did; else HC_OK; under the lock */
  atomic_bool stop;
  pthread_t *threads; /* [n] started */
  int n;
} workers;

/* Locks made, no thread started. HC_NO_MEMORY: the system has no more locks, nothing is to be freed. */
hc_status workers_init(workers *w);

/* Start up to `threads` threads of work(self), each of which calls workers_leave at its end; fewer if the system has no
 * more. If not one could be started, the workers are stopped with HC_NO_MEMORY. */
void workers_start(workers *w, int threads, void *(*work)(void *), void *self);
void workers_leave(workers *w);

/* From any thread. The status of the first call is kept in `worst`. */
void workers_stop(workers *w, hc_status why);
static inline bool workers_stopped(workers *w) { return atomic_load(&w->stop); }

/* The tick of an hc_monitor whose self is the workers: false once they are stopped. */
bool workers_tick(void *self, double done);

/* Waits `ms` milliseconds at most, less if a thread leaves; returns whether some have not left. */
bool workers_wait(workers *w, int ms);

/* Waits until all threads, if any, have ended, and frees what workers_init made; returns `worst`. */
hc_status workers_join(workers *w);

/* The tasks 0 .. n-1, begun in this order, by up to `jobs` threads while the calling one watches; by the calling thread
 * itself if jobs <= 1. A task gets a monitor to ask whether to go on; `monitor` is ticked by the calling thread only,
 * with the part of the tasks that is done. HC_OK: all are done; HC_INTERRUPTED, or what a task returned: those not
 * begun are not done, and those under way were told to stop. */
typedef hc_status (*workers_task)(void *self, int task, const hc_monitor *monitor);
hc_status workers_run(int jobs, int n, workers_task task, void *self, const hc_monitor *monitor);
