/* thread_clock.h - how long the calling thread has computed, and how long it took. */
#pragma once

#include <stdlib.h>
#include <time.h>

/* [s] of that clock; only differences mean something. */
static inline double clock_seconds(clockid_t clock)
{
  struct timespec t;
  clock_gettime(clock, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Processor time of this thread, in which waiting does not count; times HBMCHECK_CLOCK where that is set: what is found
 * before a limit of time is then the same on a slow machine, which is how tests ask. */
static inline double thread_seconds(void)
{
  const char *set = getenv("HBMCHECK_CLOCK");
  const double rate = set ? strtod(set, NULL) : 1;
  return (rate > 0 ? rate : 1) * clock_seconds(CLOCK_THREAD_CPUTIME_ID);
}

/* Time on the wall. */
static inline double wall_seconds(void) { return clock_seconds(CLOCK_MONOTONIC); }
