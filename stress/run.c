/* run.c - see stress.h. Threads take the next scene under the workers' lock; the calling thread watches. */
#include "casefile/case_file.h"
#include "numerics/workers.h"
#include "stress/journal.h"
#include "stress/scenes.h"
#include "stress/stress.h"

enum { WATCH_MS = 50 };

typedef struct pool {
  const stress_plan *plan;
  stress_result *results;
  stress_journal *journal;
  workers workers; /* its lock is of what follows, and of the journal */
  long next, done;
} pool;

static stress_result *next_result(pool *p)
{
  stress_result *r = NULL;
  pthread_mutex_lock(&p->workers.lock);
  while (p->next < p->plan->scenes && p->results[p->next].there) ++p->next;
  if (p->next < p->plan->scenes && !workers_stopped(&p->workers)) r = &p->results[p->next++];
  pthread_mutex_unlock(&p->workers.lock);
  return r;
}

static hc_status store_result(pool *p, const stress_result *r)
{
  pthread_mutex_lock(&p->workers.lock);
  hc_status st = stress_journal_add(p->journal, r);
  ++p->done;
  pthread_mutex_unlock(&p->workers.lock);
  return st;
}

static void *work(void *self)
{
  pool *p = self;
  const hc_monitor monitor = {workers_tick, &p->workers};
  stress_scenes *scenes;
  hc_status st = stress_scenes_new(p->plan->seed, &scenes);
  for (stress_result *r; st == HC_OK && (r = next_result(p));) {
    scene sc;
    st = stress_scene_of(scenes, p->plan->family, r->index, &sc);
    if (st != HC_OK) break;
    st = stress_scene(&sc, p->plan->seconds, &monitor, r);
    case_clear(&sc);
    if (st == HC_OK) st = store_result(p, r);
  }
  stress_scenes_free(scenes);
  if (st != HC_OK) workers_stop(&p->workers, st);
  workers_leave(&p->workers);
  return NULL;
}

static void watch_over(pool *p, const stress_watch *watch)
{
  for (bool running = true; running;) {
    running = workers_wait(&p->workers, WATCH_MS);
    pthread_mutex_lock(&p->workers.lock);
    long done = p->done;
    pthread_mutex_unlock(&p->workers.lock);
    if (watch->tick && !watch->tick(watch->self, done, p->plan->scenes) && running)
      workers_stop(&p->workers, HC_INTERRUPTED);
  }
}

hc_status stress_run(const stress_plan *plan, const stress_watch *watch, stress_result *results, long *resumed)
{
  pool p = {.plan = plan, .results = results};
  for (long i = 0; i < plan->scenes; ++i) results[i] = (stress_result){.index = plan->first + i};
  hc_status st = stress_journal_open(plan, results, &p.done, &p.journal);
  *resumed = p.done;
  if (st == HC_OK && (st = workers_init(&p.workers)) != HC_OK) stress_journal_close(p.journal);
  if (st != HC_OK) return st;
  workers_start(&p.workers, plan->jobs, work, &p);
  watch_over(&p, watch);
  hc_status worst = workers_join(&p.workers);
  st = stress_journal_close(p.journal);
  return worst != HC_OK ? worst : st;
}
