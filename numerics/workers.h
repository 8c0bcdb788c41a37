/* workers.h - threads that work on a common list of tasks until none is left or they are stopped, and the calling
 * thread, which waits for them and may stop them. Tasks and results belong to the caller; data shared by the threads
 * are protected by the lock. */
#pragma once

#include <pthread.h>
#include <stdatomic.h>

#include "numerics/base/status.h"

typedef struct workers {
  pthread_mutex_t lock;
  pthread_cond_t changed; /* signalled when a thread ends */
  int running;            /* number of threads that have not ended; under the lock */
  hc_status worst;        /* status of the first workers_stop, else HC_OK; under the lock */
  atomic_bool stop;
  pthread_t *threads; /* [n] started */
  int n;
} workers;

/* Makes the locks, starts no thread. HC_NO_MEMORY: no more locks; nothing is to be freed. */
hc_status workers_init(workers *w);

/* Start up to `threads` threads of work(self), each of which calls workers_leave at its end; fewer if the system has no
 * more. If not one could be started, the workers are stopped with HC_NO_MEMORY. */
void workers_start(workers *w, int threads, void *(*work)(void *), void *self);
void workers_leave(workers *w);

/* Stops all threads; may be called from any thread. The status of the first call is stored in `worst`. */
void workers_stop(workers *w, hc_status why);
static inline bool workers_stopped(workers *w) { return atomic_load(&w->stop); }

/* The tick of an hc_monitor whose self is the workers: false once they are stopped. */
bool workers_tick(void *self, double done);

/* Waits at most `ms` milliseconds, less if a thread ends; true if some have not ended. */
bool workers_wait(workers *w, int ms);

/* Waits until all threads, if any, have ended, and frees what workers_init made; returns `worst`. */
hc_status workers_join(workers *w);

/* Runs tasks 0 .. n-1, started in this order, on up to `jobs` threads; on the calling thread if jobs <= 1. A task gets
 * a monitor that tells it to stop; `monitor` is ticked by the calling thread only, with the fraction of tasks done.
 * HC_OK: all are done; HC_INTERRUPTED, or the status of a task that failed: no more tasks are started, and running ones
 * are told to stop. */
typedef hc_status (*workers_task)(void *self, int task, const hc_monitor *monitor);
hc_status workers_run(int jobs, int n, workers_task task, void *self, const hc_monitor *monitor);
