/* run.c - see store.h. Threads take a scene's number under one lock and store its result under another; the calling
 * thread watches and answers other processes (cluster.h). Scenes are stored in any order, with the same results. */
#include "compare/study/store.h"

#include <stdlib.h>
#include <time.h>

#include "compare/study/cluster.h"
#include "numerics/workers.h"

enum { WATCH_MS = 50, SERVE_MS = 1 };

typedef struct pool {
  const study *s;
  study_store *store;
  workers workers;         /* its lock is of `taken` and the counts */
  pthread_mutex_t writing; /* of the store */
  bool lost;               /* under `writing`: a scene could not be kept, and no other is tried */
  unsigned char *taken;    /* [n_scenes] there already, or being computed */
  long next, there, now;
} pool;

static long next_scene(pool *p)
{
  long id = -1;
  pthread_mutex_lock(&p->workers.lock);
  while (p->next < p->s->n_scenes && p->taken[p->next]) ++p->next;
  if (p->next < p->s->n_scenes && !workers_stopped(&p->workers)) p->taken[id = p->next++] = 1;
  pthread_mutex_unlock(&p->workers.lock);
  return id;
}

static hc_status store_result(pool *p, const study_result *r)
{
  pthread_mutex_lock(&p->writing);
  hc_status st = p->lost ? HC_IO : study_store_put(p->store, r);
  p->lost = st != HC_OK;
  pthread_mutex_unlock(&p->writing);
  if (st != HC_OK) return st;
  pthread_mutex_lock(&p->workers.lock);
  ++p->there, ++p->now;
  pthread_mutex_unlock(&p->workers.lock);
  return HC_OK;
}

static void *work(void *self)
{
  pool *p = self;
  hc_monitor monitor = {workers_tick, &p->workers};
  for (long id; (id = next_scene(p)) >= 0;) {
    study_result r;
    hc_status st = study_solve(p->s, id, &monitor, &r);
    if (st == HC_OK) st = store_result(p, &r);
    study_result_clear(&r);
    if (st != HC_OK) {
      workers_stop(&p->workers, st);
      break;
    }
  }
  workers_leave(&p->workers);
  return NULL;
}

/* ---- other processes ---- */

static int next_scenes(void *self, int most, long *ids)
{
  int n = 0;
  while (n < most && (ids[n] = next_scene(self)) >= 0) ++n;
  return n;
}

static void store_packed(void *self, const char *packed, size_t size)
{
  study_result r;
  hc_status st = study_result_unpack(packed, size, &r);
  if (st == HC_OK) st = store_result(self, &r);
  study_result_clear(&r);
  if (st != HC_OK) workers_stop(&((pool *)self)->workers, st);
}

/* ---- the calling thread ---- */

static void watch_over(pool *p, const study_watch *watch)
{
  const cluster_desk desk = {next_scenes, store_packed, p};
  for (int beat = 0;; ++beat) {
    bool others = cluster_serve(&desk);
    pthread_mutex_lock(&p->workers.lock);
    long there = p->there, now = p->now;
    bool own = p->workers.running > 0;
    pthread_mutex_unlock(&p->workers.lock);
    if (!own && !others) return;
    if (beat % (others ? WATCH_MS / SERVE_MS : 1) == 0 && watch->tick &&
        !watch->tick(watch->self, there, now, p->s->n_scenes))
      workers_stop(&p->workers, HC_INTERRUPTED);
    if (own) workers_wait(&p->workers, others ? SERVE_MS : WATCH_MS);
    else nanosleep(&(struct timespec){.tv_nsec = SERVE_MS * 1000000L}, NULL);
  }
}

/* The locks and room for p->taken; what was made is freed again if it fails. */
static hc_status pool_open(pool *p)
{
  hc_status st = workers_init(&p->workers);
  if (st != HC_OK) return st;
  if (pthread_mutex_init(&p->writing, NULL) == 0) {
    if ((p->taken = malloc((size_t)p->s->n_scenes))) return HC_OK;
    pthread_mutex_destroy(&p->writing);
  }
  workers_join(&p->workers);
  return HC_NO_MEMORY;
}

hc_status study_run(const study *s, study_store *store, int jobs, const study_watch *watch, long *now, long *there)
{
  pool p = {.s = s, .store = store};
  *now = *there = 0;
  hc_status st = pool_open(&p);
  if (st != HC_OK) return st;
  if ((st = study_store_done(store, p.taken, &p.there)) != HC_OK) workers_stop(&p.workers, st);
  long left = s->n_scenes - p.there;
  if (left < jobs) jobs = left > 0 ? (int)left : 1;
  workers_start(&p.workers, jobs, work, &p); /* also with nothing left: other processes wait to be told so */
  watch_over(&p, watch);
  const hc_status worst = workers_join(&p.workers);
  pthread_mutex_destroy(&p.writing);
  *now = p.now;
  *there = p.there;
  free(p.taken);
  return worst != HC_OK ? worst : p.there == s->n_scenes ? HC_OK : HC_INTERRUPTED;
}
