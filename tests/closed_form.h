/* closed_form.h - how tests integrate a steady state where nothing else is said: the exact law in closed form, from
 * rest. */
#pragma once

#include "tests/check.h"
#include "timeint/timeint.h"

/* The initializer of transient_settings. */
#define CLOSED_FORM(closure, most_periods)                                                                             \
  {                                                                                                                    \
    .law = TRANSIENT_LAW_EXACT, .method = TRANSIENT_METHOD_CLOSED_FORM, .regularisation = 1e-4,                        \
    .steady = TRANSIENT_STEADY_AUTO, .start = TRANSIENT_START_REST, .tolerance = (closure),                            \
    .max_periods = (most_periods)                                                                                      \
  }

/* y[states]: at rest. */
static inline timeint *at_rest(const model *m, const transient_settings *how, double *y)
{
  CHECK_MADE(timeint, ti, timeint_new(m, how, &ti));
  timeint_rest(ti, y);
  return ti;
}
