/* patience.h - a monitor that gives up after so many ticks, and knows whether it was that or a request to stop. */
#ifndef HC_PATIENCE_H
#define HC_PATIENCE_H

#include "base/status.h"

typedef struct patience {
  const hc_monitor *outer;
  int left;     /* ticks */
  bool stopped; /* on request */
} patience;

/* Newton on the period map takes 4 to 15 periods, a tick each; what takes longer does not arrive. */
enum { PATIENCE_PERIODS = 40 };

static inline bool patience_tick(void *self, double done)
{
  patience *p = self;
  if (!hc_monitor_tick(p->outer, done)) p->stopped = true;
  return !p->stopped && p->left-- > 0;
}

#endif
