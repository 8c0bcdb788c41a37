/* thread_clock.h - processor time of the calling thread, and wall time. */
#pragma once

#include <stdlib.h>
#include <time.h>

/* [s] Reading of a clock; only differences are meaningful. */
static inline double clock_seconds(clockid_t clock)
{
  struct timespec t;
  clock_gettime(clock, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* [s] Processor time of this thread, without waiting, multiplied by HBMCHECK_CLOCK if that is set: with it tests make
 * results under a time limit the same on a slow machine. */
static inline double thread_seconds(void)
{
  const char *set = getenv("HBMCHECK_CLOCK");
  const double rate = set ? strtod(set, NULL) : 1;
  return (rate > 0 ? rate : 1) * clock_seconds(CLOCK_THREAD_CPUTIME_ID);
}

/* [s] Wall time. */
static inline double wall_seconds(void) { return clock_seconds(CLOCK_MONOTONIC); }
