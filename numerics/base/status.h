/* status.h - the statuses of calls that may fail: code and text, in one list. Every fallible function of the library
 * returns an hc_status; none prints, exits or sets errno for the caller. */
#pragma once

#include <stdbool.h>

#define HC_STATUS_LIST(X) /* expanded to the enum and to hc_status_text() */                                           \
  X(HC_OK, "ok")                                                                                                       \
  X(HC_BAD_INPUT, "an argument is outside its documented range")                                                       \
  X(HC_NO_MEMORY, "out of memory")                                                                                     \
  X(HC_IO, "a file could not be read or written")                                                                      \
  X(HC_STALLED, "Newton steps became tiny while the residual stayed large")                                            \
  X(HC_NOT_CONVERGED, "the Newton residual stayed above tolerance")                                                    \
  X(HC_SINGULAR, "the Jacobian is singular")                                                                           \
  X(HC_NOT_FINITE, "a force, residual or solution was not finite")                                                     \
  X(HC_STEP_TOO_SMALL, "the continuation step shrank to its minimum")                                                  \
  X(HC_TOO_MANY_POINTS, "the response curve needs more points than allowed")                                           \
  X(HC_NOT_CLOSED, "the slider did not close over a period")                                                           \
  X(HC_INTEGRATOR, "the time integrator gave up: its steps became too short, or a step's equations had no solution")   \
  X(HC_CHATTER, "more contact transitions in a period than allowed")                                                   \
  X(HC_NOT_SETTLED, "the transient did not reach a steady state within the allowed periods")                           \
  X(HC_APERIODIC, "the motion never repeats: neighbouring motions drift apart, or it runs on a torus")                 \
  X(HC_INTERRUPTED, "stopped on request")                                                                              \
  X(HC_UNSUPPORTED, "a file was written by another version of hbmcheck")                                               \
  X(HC_BUG, "internal error: please report it")                                                                        \
  X(HC_JUMPED, "the next solution is further from where it was predicted than the step explains")                      \
  X(HC_UNBOUNDED, "the motion grows without bound")                                                                    \
  X(HC_CREEPS, "the body slides on by as much in each period: there is no periodic motion")

#define HC_STATUS_ENUM(code, text) code,
typedef enum hc_status { HC_STATUS_LIST(HC_STATUS_ENUM) } hc_status;
#undef HC_STATUS_ENUM

/* The text of a status; a constant string, never NULL. */
const char *hc_status_text(hc_status status);

/* Callback of long work: done is the fraction finished, 0..1, or negative if unknown. Return false to stop the work,
 * which then returns HC_INTERRUPTED with its results so far. `tick` may be NULL. */
typedef struct hc_monitor {
  bool (*tick)(void *self, double done);
  void *self;
} hc_monitor;

static inline bool hc_monitor_tick(const hc_monitor *m, double done)
{
  return !m || !m->tick || m->tick(m->self, done);
}

/* A part of the whole work, the self of hc_monitor_tick_part: its fraction becomes that of the whole. */
typedef struct hc_monitor_part {
  const hc_monitor *outer;
  double from, width;
} hc_monitor_part;
static inline bool hc_monitor_tick_part(void *self, double done)
{
  const hc_monitor_part *p = (const hc_monitor_part *)self;
  return hc_monitor_tick(p->outer, p->from + p->width * (done > 0 ? done : 0));
}

/* The tick of a monitor whose self is another monitor or NULL: passes each tick on to it with an unknown fraction. For
 * a part of the work whose fraction is not that of the whole. */
static inline bool hc_monitor_tick_aside(void *self, double done)
{
  (void)done;
  return hc_monitor_tick((const hc_monitor *)self, -1);
}
