/* crew.h - several threads that take one piece of work after another until there is none left or they are told to
 * stop, and the calling thread, which watches meanwhile. What the pieces are, and where results go, is the owner's
 * business; his data goes under the crew's lock. */
#ifndef HC_CREW_H
#define HC_CREW_H

#include <pthread.h>
#include <stdatomic.h>

#include "base/status.h"

typedef struct crew {
  pthread_mutex_t lock;
  pthread_cond_t changed; /* a thread has ended */
  int running;            /* threads at work; under the lock */
  hc_status worst;        /* why it was stopped first, else HC_OK; under the lock */
  atomic_bool stop;
  pthread_t *threads; /* [n] started */
  int n;
} crew;

void crew_init(crew *c);

/* Start up to `jobs` threads of work(self), each of which calls crew_leave at its end. Where not one could be
 * started, the crew stops with HC_NO_MEMORY. */
void crew_start(crew *c, int jobs, void *(*work)(void *), void *self);
void crew_leave(crew *c);

/* From any thread. The first reason is kept. */
void crew_stop(crew *c, hc_status why);
static inline bool crew_stopped(crew *c) { return atomic_load(&c->stop); }

/* A tick that goes on until the crew is stopped; self is the crew. */
bool crew_tick(void *self, double done);

/* Waits `ms` at most, less if a thread ends; returns whether some are still at work. */
bool crew_wait(crew *c, int ms);

/* All have ended; returns `worst`. */
hc_status crew_join(crew *c);

#endif
