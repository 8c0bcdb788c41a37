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
