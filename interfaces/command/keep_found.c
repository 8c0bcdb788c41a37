/* keep_found.c - see keep_found.h. Proof: tests/faults/test_rescue.c. */
#include "interfaces/command/keep_found.h"

#include <time.h>
#include <unistd.h>

#include "compare/output/progress.h"

enum { LOOK_MS = 50, GRACE_MS = 500 };

/* Lets go of the lock for so long, or until the work has ended. */
static void wait_unlocked(keep_found *k, int ms)
{
  struct timespec until;
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += 1000000L * ms;
  until.tv_sec += until.tv_nsec / 1000000000L, until.tv_nsec %= 1000000000L;
  pthread_cond_timedwait(&k->ended, &k->found, &until);
}

static void *wait_for_signal(void *self)
{
  keep_found *k = self;
  pthread_mutex_lock(&k->found);
  while (!k->over && !progress_interrupted()) wait_unlocked(k, LOOK_MS);
  for (int waited = 0; !k->over && waited < GRACE_MS; waited += LOOK_MS) wait_unlocked(k, LOOK_MS);
  if (!k->over) {
    progress_erase();
    progress_hold(false); /* a pipe that nobody reads is no reason to stay */
    const int code = k->write(k->self);
    if (code < 0) progress_stop();
    _exit(code); /* the work goes on meanwhile: nothing is freed under it */
  }
  pthread_mutex_unlock(&k->found);
  return NULL;
}

void keep_found_begin(keep_found *k, const cli_common *common, int (*write)(void *self), void *self)
{
  *k = (keep_found){.write = write, .self = self};
  pthread_mutex_init(&k->found, NULL);
  pthread_cond_init(&k->ended, NULL);
  k->watched = !common->call && pthread_create(&k->thread, NULL, wait_for_signal, k) == 0;
  if (k->watched) progress_hold(true);
}

void keep_found_end(keep_found *k)
{
  pthread_mutex_lock(&k->found);
  k->over = true;
  pthread_cond_signal(&k->ended);
  pthread_mutex_unlock(&k->found);
  if (k->watched) pthread_join(k->thread, NULL);
  if (k->watched) progress_hold(false);
  pthread_cond_destroy(&k->ended);
  pthread_mutex_destroy(&k->found);
}

void shown_rows_begin(shown_rows *s, bool several)
{
  *s = (shown_rows){.begun.several = several};
  pthread_mutex_init(&s->writing, NULL);
}

void shown_rows_write(shown_rows *s, const cli_common *common)
{
  pthread_mutex_lock(&s->writing);
  cli_show_rows(common, s->rows, &s->begun);
  pthread_mutex_unlock(&s->writing);
}

void shown_rows_end(shown_rows *s)
{
  table_free(s->rows);
  pthread_mutex_destroy(&s->writing);
}
