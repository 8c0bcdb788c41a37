/* thread_clock.h - how long the calling thread has computed. */
#ifndef HC_THREAD_CLOCK_H
#define HC_THREAD_CLOCK_H

#include <time.h>

/* [s] processor time of this thread; only differences mean something. Waiting does not count. */
static inline double thread_seconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
