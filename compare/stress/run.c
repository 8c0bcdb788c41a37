/* run.c - see stress.h. Threads take the next scene under a lock; the calling thread watches. */
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>

#include "compare/stress/journal.h"
#include "compare/stress/scenes.h"
#include "compare/stress/stress.h"

enum { WATCH_MS = 50 };

typedef struct pool {
  const stress_plan *plan;
  stress_result *results;
  stress_journal *journal;
  pthread_mutex_t lock; /* of what follows, and of the journal */
  pthread_cond_t changed;
  long next, done;
  int running;
  hc_status worst;
  atomic_bool stop;
} pool;

static void stop_with(pool *p, hc_status st)
{
  pthread_mutex_lock(&p->lock);
  if (p->worst == HC_OK) p->worst = st;
  pthread_mutex_unlock(&p->lock);
  atomic_store(&p->stop, true);
}

static stress_result *take(pool *p)
{
  stress_result *r = NULL;
  pthread_mutex_lock(&p->lock);
  while (p->next < p->plan->scenes && p->results[p->next].there) ++p->next;
  if (p->next < p->plan->scenes && !atomic_load(&p->stop)) r = &p->results[p->next++];
  pthread_mutex_unlock(&p->lock);
  return r;
}

static hc_status keep(pool *p, const stress_result *r)
{
  pthread_mutex_lock(&p->lock);
  hc_status st = stress_journal_add(p->journal, r);
  ++p->done;
  pthread_mutex_unlock(&p->lock);
  return st;
}

static bool go_on(void *self, double done)
{
  (void)done;
  return !atomic_load(&((pool *)self)->stop);
}

static void *work(void *self)
{
  pool *p = self;
  const hc_monitor monitor = {go_on, p};
  stress_scenes *scenes;
  hc_status st = stress_scenes_new(p->plan->seed, &scenes);
  for (stress_result *r; st == HC_OK && (r = take(p));) {
    scene sc;
    st = stress_scenes_at(scenes, r->index, &sc);
    if (st == HC_OK) st = stress_scene(&sc, p->plan->seconds, &monitor, r);
    if (st == HC_OK) st = keep(p, r);
  }
  stress_scenes_free(scenes);
  if (st != HC_OK) stop_with(p, st);
  pthread_mutex_lock(&p->lock);
  --p->running;
  pthread_cond_signal(&p->changed);
  pthread_mutex_unlock(&p->lock);
  return NULL;
}

static void watch_over(pool *p, const stress_watch *watch)
{
  for (bool running = true; running;) {
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += WATCH_MS * 1000000L;
    if (until.tv_nsec >= 1000000000L) until.tv_nsec -= 1000000000L, ++until.tv_sec;
    pthread_mutex_lock(&p->lock);
    if (p->running > 0) pthread_cond_timedwait(&p->changed, &p->lock, &until);
    long done = p->done;
    running = p->running > 0;
    pthread_mutex_unlock(&p->lock);
    if (watch->tick && !watch->tick(watch->self, done, p->plan->scenes) && running) stop_with(p, HC_INTERRUPTED);
  }
}

static void run_threads(pool *p, const stress_watch *watch)
{
  pthread_t *threads = calloc((size_t)p->plan->jobs, sizeof *threads);
  int n = 0;
  pthread_mutex_lock(&p->lock);
  while (threads && n < p->plan->jobs && pthread_create(&threads[n], NULL, work, p) == 0) ++n;
  p->running = n;
  pthread_mutex_unlock(&p->lock);
  if (n == 0) stop_with(p, HC_NO_MEMORY);
  watch_over(p, watch);
  for (int i = 0; i < n; ++i) pthread_join(threads[i], NULL);
  free(threads);
}

hc_status stress_run(const stress_plan *plan, const stress_watch *watch, stress_result *results, long *resumed)
{
  pool p = {.plan = plan, .results = results, .lock = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};
  for (long i = 0; i < plan->scenes; ++i) results[i] = (stress_result){.index = plan->first + i};
  hc_status st = stress_journal_open(plan, results, &p.done, &p.journal);
  *resumed = p.done;
  if (st != HC_OK) return st;
  run_threads(&p, watch);
  st = stress_journal_close(p.journal);
  return p.worst != HC_OK ? p.worst : st;
}
