/* rescue.h - work that looks for a signal only now and then, a whole period of time integration apart, loses nothing
 * of what it has found: beside it a thread waits for the signal, then for the work to end by itself, and if that does
 * not, writes what there is and ends the program.
 *
 *     rescue_begin -> the work, which holds `found` whenever it changes what it has found -> rescue_end */
#ifndef HC_RESCUE_H
#define HC_RESCUE_H

#include <pthread.h>
#include <stdbool.h>

typedef struct rescue {
  pthread_mutex_t found;
  pthread_cond_t ended;
  bool over;    /* the work has ended; under the lock */
  bool watched; /* there is a thread */
  int (*write)(
      void *self); /* while the lock is held: writes what was found, its answer is the exit code; < 0: nothing */
  void *self;
  pthread_t thread;
} rescue;

/* Where the system has no more locks or threads, the program ends at once after a signal, as without a rescue. */
void rescue_begin(rescue *r, int (*write)(void *self), void *self);

/* Does not return while the thread is writing: the program ends there. */
void rescue_end(rescue *r);

#endif
