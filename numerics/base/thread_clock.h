/* thread_clock.h - how long the calling thread has computed, and how long it took. */
#pragma once

#include <time.h>

/* [s] of that clock; only differences mean something. */
static inline double clock_seconds(clockid_t clock)
{
  struct timespec t;
  clock_gettime(clock, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Processor time of this thread, in which waiting does not count; time on the wall. */
static inline double thread_seconds(void) { return clock_seconds(CLOCK_THREAD_CPUTIME_ID); }
static inline double wall_seconds(void) { return clock_seconds(CLOCK_MONOTONIC); }
