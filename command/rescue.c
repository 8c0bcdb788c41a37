/* rescue.c - see rescue.h. Proof: tests/faults/test_rescue.c. */
#include "command/rescue.h"

#include <time.h>
#include <unistd.h>

#include "output/progress.h"

enum { LOOK_MS = 50, GRACE_MS = 500 };

/* Lets go of the lock for so long, or until the work has ended. */
static void wait_unlocked(rescue *r, int ms)
{
  struct timespec until;
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += 1000000L * ms;
  until.tv_sec += until.tv_nsec / 1000000000L, until.tv_nsec %= 1000000000L;
  pthread_cond_timedwait(&r->ended, &r->found, &until);
}

static void *watch(void *self)
{
  rescue *r = self;
  pthread_mutex_lock(&r->found);
  while (!r->over && !progress_interrupted()) wait_unlocked(r, LOOK_MS);
  for (int waited = 0; !r->over && waited < GRACE_MS; waited += LOOK_MS) wait_unlocked(r, LOOK_MS);
  if (!r->over) {
    progress_erase();
    progress_hold(false); /* a pipe that nobody reads is no reason to stay */
    const int code = r->write(r->self);
    if (code < 0) progress_stop();
    _exit(code); /* the work goes on meanwhile: nothing is freed under it */
  }
  pthread_mutex_unlock(&r->found);
  return NULL;
}

void rescue_begin(rescue *r, int (*write)(void *self), void *self)
{
  *r = (rescue){.write = write, .self = self};
  pthread_mutex_init(&r->found, NULL);
  pthread_cond_init(&r->ended, NULL);
  r->watched = pthread_create(&r->thread, NULL, watch, r) == 0;
  if (r->watched) progress_hold(true);
}

void rescue_end(rescue *r)
{
  pthread_mutex_lock(&r->found);
  r->over = true;
  pthread_cond_signal(&r->ended);
  pthread_mutex_unlock(&r->found);
  if (r->watched) pthread_join(r->thread, NULL);
  if (r->watched) progress_hold(false);
  pthread_cond_destroy(&r->ended);
  pthread_mutex_destroy(&r->found);
}
