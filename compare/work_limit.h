/* work_limit.h - a monitor that stops after some ticks, or at a processor time; `stopped`: it was told to. */
#pragma once

#include "numerics/base/status.h"
#include "numerics/base/thread_clock.h"

typedef struct work_limit {
  const hc_monitor *outer;
  int most;     /* ticks; 0: any number */
  int ticks;    /* so far */
  double until; /* [s] of thread_seconds; 0: for ever */
  bool stopped; /* on request */
} work_limit;

/* Newton on the period map takes 4 to 15 periods, a tick each, where it converges. */
enum { PERIOD_LIMIT = 40 };

static inline bool work_limit_tick(void *self, double done)
{
  work_limit *l = self;
  l->stopped = l->stopped || !hc_monitor_tick(l->outer, done);
  return !l->stopped && (l->most == 0 || ++l->ticks <= l->most) && (l->until == 0 || thread_seconds() < l->until);
}
