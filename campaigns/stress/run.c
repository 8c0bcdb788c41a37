/* run.c - see stress.h. Threads take the next scene under the crew's lock; the calling thread watches. */
#include "campaigns/stress/journal.h"
#include "campaigns/stress/scenes.h"
#include "campaigns/stress/stress.h"
#include "numerics/crew.h"

enum { WATCH_MS = 50 };

typedef struct pool {
  const stress_plan *plan;
  stress_result *results;
  stress_journal *journal;
  crew crew; /* its lock is of what follows, and of the journal */
  long next, done;
} pool;

static stress_result *take(pool *p)
{
  stress_result *r = NULL;
  pthread_mutex_lock(&p->crew.lock);
  while (p->next < p->plan->scenes && p->results[p->next].there) ++p->next;
  if (p->next < p->plan->scenes && !crew_stopped(&p->crew)) r = &p->results[p->next++];
  pthread_mutex_unlock(&p->crew.lock);
  return r;
}

static hc_status keep(pool *p, const stress_result *r)
{
  pthread_mutex_lock(&p->crew.lock);
  hc_status st = stress_journal_add(p->journal, r);
  ++p->done;
  pthread_mutex_unlock(&p->crew.lock);
  return st;
}

static void *work(void *self)
{
  pool *p = self;
  const hc_monitor monitor = {crew_tick, &p->crew};
  stress_scenes *scenes;
  hc_status st = stress_scenes_new(p->plan->seed, &scenes);
  for (stress_result *r; st == HC_OK && (r = take(p));) {
    scene sc;
    st = stress_scenes_at(scenes, r->index, &sc);
    if (st == HC_OK) st = stress_scene(&sc, p->plan->seconds, &monitor, r);
    if (st == HC_OK) st = keep(p, r);
  }
  stress_scenes_free(scenes);
  if (st != HC_OK) crew_stop(&p->crew, st);
  crew_leave(&p->crew);
  return NULL;
}

static void watch_over(pool *p, const stress_watch *watch)
{
  for (bool running = true; running;) {
    running = crew_wait(&p->crew, WATCH_MS);
    pthread_mutex_lock(&p->crew.lock);
    long done = p->done;
    pthread_mutex_unlock(&p->crew.lock);
    if (watch->tick && !watch->tick(watch->self, done, p->plan->scenes) && running) crew_stop(&p->crew, HC_INTERRUPTED);
  }
}

hc_status stress_run(const stress_plan *plan, const stress_watch *watch, stress_result *results, long *resumed)
{
  pool p = {.plan = plan, .results = results};
  crew_init(&p.crew);
  for (long i = 0; i < plan->scenes; ++i) results[i] = (stress_result){.index = plan->first + i};
  hc_status st = stress_journal_open(plan, results, &p.done, &p.journal);
  *resumed = p.done;
  if (st != HC_OK) return st;
  crew_start(&p.crew, plan->jobs, work, &p);
  watch_over(&p, watch);
  hc_status worst = crew_join(&p.crew);
  st = stress_journal_close(p.journal);
  return worst != HC_OK ? worst : st;
}
