/* trace.h - a line per step on stderr, to watch the solvers: HBMCHECK_TRACE=curve,newton,... or `all`. Switched off, a
 * line costs the test of a bit. */
#pragma once

#include "numerics/base/message.h"
#include "numerics/base/status.h"

#define TRACE_PARTS(X) /* name, what a line of it tells */                                                             \
  X(curve, "a step of a response curve: where, how long, why refused")                                                 \
  X(newton, "Newton's method: the residual at each matrix, and how a solve ended")                                     \
  X(first, "each way to a first solution, and whether it led to one")                                                  \
  X(steady, "time integration: chord steps, tolerances while marching, how each search for an orbit ended")            \
  X(stability, "the largest multiplier of a solution by harmonic balance")

#define TRACE_ENUM(name, text) TRACE_##name,
typedef enum trace_part { TRACE_PARTS(TRACE_ENUM) TRACE_COUNT } trace_part;
#undef TRACE_ENUM

extern unsigned trace_wanted; /* bit TRACE_curve etc.: set by trace_start before threads are started */

/* Switches the trace on for the parts in a list such as "curve,newton"; NULL and "": none. HC_BAD_INPUT: an unknown
 * word, named in the message added to *msg, which must be started. */
hc_status trace_start(const char *list, message *msg);

static inline bool trace_on(trace_part part) { return trace_wanted >> part & 1; }

/* "curve   omega 5.2 ..." and a line's end, in one write. */
void trace_line(trace_part part, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The arguments are evaluated only if the part is traced. */
#define TRACE(part, ...) (trace_on(TRACE_##part) ? trace_line(TRACE_##part, __VA_ARGS__) : (void)0)
