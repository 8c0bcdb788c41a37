/* patience.h - a monitor that stops after a number of ticks; `stopped` tells a request to stop from that. */
#ifndef HC_PATIENCE_H
#define HC_PATIENCE_H

#include "base/status.h"

typedef struct patience {
  const hc_monitor *outer;
  int left;     /* ticks */
  bool stopped; /* on request */
} patience;

/* Newton on the period map takes 4 to 15 periods, a tick each, where it converges. */
enum { PATIENCE_PERIODS = 40 };

static inline bool patience_tick(void *self, double done)
{
  patience *p = self;
  if (!hc_monitor_tick(p->outer, done)) p->stopped = true;
  return !p->stopped && p->left-- > 0;
}

#endif
