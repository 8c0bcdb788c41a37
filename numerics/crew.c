/* crew.c - see crew.h. */
#include "numerics/crew.h"

#include <stdlib.h>
#include <time.h>

void crew_init(crew *c)
{
  *c = (crew){.lock = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER, .worst = HC_OK};
  atomic_init(&c->stop, false);
}

void crew_start(crew *c, int jobs, void *(*work)(void *), void *self)
{
  c->threads = calloc((size_t)jobs, sizeof *c->threads);
  pthread_mutex_lock(&c->lock);
  while (c->threads && c->n < jobs && pthread_create(&c->threads[c->n], NULL, work, self) == 0) ++c->n;
  c->running = c->n;
  pthread_mutex_unlock(&c->lock);
  if (c->n == 0) crew_stop(c, HC_NO_MEMORY);
}

void crew_leave(crew *c)
{
  pthread_mutex_lock(&c->lock);
  --c->running;
  pthread_cond_signal(&c->changed);
  pthread_mutex_unlock(&c->lock);
}

void crew_stop(crew *c, hc_status why)
{
  pthread_mutex_lock(&c->lock);
  if (c->worst == HC_OK) c->worst = why;
  pthread_mutex_unlock(&c->lock);
  atomic_store(&c->stop, true);
}

bool crew_tick(void *self, double done)
{
  (void)done;
  return !crew_stopped(self);
}

bool crew_wait(crew *c, int ms)
{
  struct timespec until;
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += ms * 1000000L;
  if (until.tv_nsec >= 1000000000L) until.tv_nsec -= 1000000000L, ++until.tv_sec;
  pthread_mutex_lock(&c->lock);
  if (c->running > 0) pthread_cond_timedwait(&c->changed, &c->lock, &until);
  bool some = c->running > 0;
  pthread_mutex_unlock(&c->lock);
  return some;
}

hc_status crew_join(crew *c)
{
  for (int i = 0; i < c->n; ++i) pthread_join(c->threads[i], NULL);
  free(c->threads);
  return c->worst;
}
