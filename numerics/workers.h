/* workers.h - several threads that take one piece of work after another until there is none left or they are told to
 * stop, and the calling thread, which waits for them and may stop them. Which pieces there are, and where results go,
 * is the caller's: its own data that the threads share goes under the lock as well. */
#ifndef HC_WORKERS_H
#define HC_WORKERS_H

#include <pthread.h>
#include <stdatomic.h>

#include "base/status.h"

typedef struct workers {
  pthread_mutex_t lock;
  pthread_cond_t changed; /* a thread has ended */
  int running;            /* threads at work; under the lock */
  hc_status worst;        /* why they were stopped first, else HC_OK; under the lock */
  atomic_bool stop;
  pthread_t *threads; /* [n] started */
  int n;
} workers;

/* Locks made, no thread started. HC_NO_MEMORY: the system has no more locks, nothing is to be freed. */
hc_status workers_init(workers *w);

/* Start up to `jobs` threads of work(self), each of which calls workers_leave at its end. Where not one could be
 * started, they are stopped with HC_NO_MEMORY. */
void workers_start(workers *w, int jobs, void *(*work)(void *), void *self);
void workers_leave(workers *w);

/* From any thread. The first reason is kept. */
void workers_stop(workers *w, hc_status why);
static inline bool workers_stopped(workers *w) { return atomic_load(&w->stop); }

/* A tick that goes on until they are stopped; self is the workers. */
bool workers_tick(void *self, double done);

/* Waits `ms` at most, less if a thread ends; returns whether some are still at work. */
bool workers_wait(workers *w, int ms);

/* Waits until all threads, if any, have ended, and frees what workers_init made; returns `worst`. */
hc_status workers_join(workers *w);

#endif
