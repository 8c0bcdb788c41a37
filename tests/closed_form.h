/* closed_form.h - how tests integrate a steady state where nothing else is said: the exact law in closed form, from
 * rest. */
#pragma once

#include "timeint/transient_settings.h"

/* The initializer of transient_settings. */
#define CLOSED_FORM(closure, most_periods)                                                                             \
  {                                                                                                                    \
    .law = TRANSIENT_LAW_EXACT, .method = TRANSIENT_METHOD_CLOSED_FORM, .regularisation = 1e-4,                        \
    .steady = TRANSIENT_STEADY_AUTO, .start = TRANSIENT_START_REST, .tolerance = (closure),                            \
    .max_periods = (most_periods)                                                                                      \
  }
