/* run.c - see run.h. Threads take the next scene's number under one lock and hand the result to the store under another; the calling thread
 * watches, and answers other processes (cluster.h). The order in which scenes are kept differs from run to run, what is kept does not. */
#include "compare/study/run.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>

#include "compare/study/cluster.h"

enum { WATCH_MS = 50, SERVE_MS = 1 };

typedef struct pool {
  const study *s;
  study_store *store;
  pthread_mutex_t lock, writing; /* of what follows; of the store */
  pthread_cond_t changed;
  bool lost;                     /* under `writing`: a scene could not be kept, and no other is tried */
  unsigned char *taken;          /* [n_scenes] there already, or being computed */
  long next, there, now;
  int running;                   /* threads */
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

static long take(pool *p)
{
  long id = -1;
  pthread_mutex_lock(&p->lock);
  while (p->next < p->s->n_scenes && p->taken[p->next]) ++p->next;
  if (p->next < p->s->n_scenes && !atomic_load(&p->stop)) p->taken[id = p->next++] = 1;
  pthread_mutex_unlock(&p->lock);
  return id;
}

static hc_status keep(pool *p, const study_result *r)
{
  pthread_mutex_lock(&p->writing);
  hc_status st = p->lost ? HC_IO : study_store_put(p->store, r);
  p->lost = st != HC_OK;
  pthread_mutex_unlock(&p->writing);
  if (st != HC_OK) return st;
  pthread_mutex_lock(&p->lock);
  ++p->there, ++p->now;
  pthread_mutex_unlock(&p->lock);
  return HC_OK;
}

static bool go_on(void *self, double done)
{
  (void)done;
  return !atomic_load(&((pool *)self)->stop);
}

static void *work(void *self)
{
  pool *p = self;
  hc_monitor monitor = {go_on, p};
  for (long id; (id = take(p)) >= 0;) {
    study_result r;
    hc_status st = study_solve(p->s, id, &monitor, &r);
    if (st == HC_OK) st = keep(p, &r);
    study_result_clear(&r);
    if (st != HC_OK) { stop_with(p, st); break; }
  }
  pthread_mutex_lock(&p->lock);
  --p->running;
  pthread_cond_signal(&p->changed);
  pthread_mutex_unlock(&p->lock);
  return NULL;
}

/* ---- other processes ---- */

static int take_some(void *self, int most, long *ids)
{
  int n = 0;
  while (n < most && (ids[n] = take(self)) >= 0) ++n;
  return n;
}

static void keep_packed(void *self, const char *packed, size_t size)
{
  study_result r;
  hc_status st = study_result_unpack(packed, size, &r);
  if (st == HC_OK) st = keep(self, &r);
  study_result_clear(&r);
  if (st != HC_OK) stop_with(self, st);
}

/* ---- the calling thread ---- */

static void wait_a_little(pool *p, int ms)
{
  struct timespec until;
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += ms * 1000000L;
  if (until.tv_nsec >= 1000000000L) until.tv_nsec -= 1000000000L, ++until.tv_sec;
  pthread_mutex_lock(&p->lock);
  if (p->running > 0) pthread_cond_timedwait(&p->changed, &p->lock, &until);
  pthread_mutex_unlock(&p->lock);
}

static void watch_over(pool *p, const study_watch *watch)
{
  const cluster_desk desk = {take_some, keep_packed, p};
  for (int beat = 0;; ++beat) {
    bool others = cluster_serve(&desk);
    pthread_mutex_lock(&p->lock);
    long there = p->there, now = p->now;
    bool own = p->running > 0;
    pthread_mutex_unlock(&p->lock);
    if (!own && !others) return;
    if (beat % (others ? WATCH_MS / SERVE_MS : 1) == 0 && watch->tick && !watch->tick(watch->self, there, now, p->s->n_scenes))
      stop_with(p, HC_INTERRUPTED);
    if (own) wait_a_little(p, others ? SERVE_MS : WATCH_MS);
    else nanosleep(&(struct timespec){.tv_nsec = SERVE_MS * 1000000L}, NULL);
  }
}

static void run_threads(pool *p, int jobs, const study_watch *watch)
{
  pthread_t *threads = calloc((size_t)jobs, sizeof *threads);
  int n = 0;
  pthread_mutex_lock(&p->lock);
  while (threads && n < jobs && pthread_create(&threads[n], NULL, work, p) == 0) ++n;
  p->running = n;
  pthread_mutex_unlock(&p->lock);
  if (n == 0) stop_with(p, HC_NO_MEMORY);
  watch_over(p, watch);
  for (int i = 0; i < n; ++i) pthread_join(threads[i], NULL);
  free(threads);
}

hc_status study_run(const study *s, study_store *store, int jobs, const study_watch *watch, long *now, long *there)
{
  pool p = {.s = s, .store = store, .lock = PTHREAD_MUTEX_INITIALIZER, .writing = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};
  *now = *there = 0;
  if (!(p.taken = malloc((size_t)s->n_scenes))) return HC_NO_MEMORY;
  hc_status st = study_store_done(store, p.taken, &p.there);
  if (st != HC_OK) p.worst = st, atomic_store(&p.stop, true);
  long left = s->n_scenes - p.there;
  if (left < jobs) jobs = left > 0 ? (int)left : 1;
  run_threads(&p, jobs, watch); /* also with nothing left: other processes want to hear it */
  *now = p.now;
  *there = p.there;
  free(p.taken);
  return p.worst != HC_OK ? p.worst : p.there == s->n_scenes ? HC_OK : HC_INTERRUPTED;
}
