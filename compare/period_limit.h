/* period_limit.h - a monitor that stops after a number of ticks; `stopped` tells a request to stop from that. */
#ifndef HC_PERIOD_LIMIT_H
#define HC_PERIOD_LIMIT_H

#include "base/status.h"

typedef struct period_limit {
  const hc_monitor *outer;
  int left;     /* ticks */
  bool stopped; /* on request */
} period_limit;

/* Newton on the period map takes 4 to 15 periods, a tick each, where it converges. */
enum { PERIOD_LIMIT = 40 };

static inline bool period_limit_tick(void *self, double done)
{
  period_limit *p = self;
  if (!hc_monitor_tick(p->outer, done)) p->stopped = true;
  return !p->stopped && p->left-- > 0;
}

#endif
