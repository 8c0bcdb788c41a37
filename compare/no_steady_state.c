/* no_steady_state.c - see no_steady_state.h. Proof: tests/command/escape.transcript. */
#include "compare/no_steady_state.h"

#include <math.h>
#include <stdlib.h>

#include "compare/work_limit.h"
#include "timeint/steady/escape.h"

hc_status steady_state_lacks(timeint *ti, double omega, double *state, const hc_monitor *monitor, timeint_result *r)
{
  const double patience = 3; /* [s] */
  work_limit limit = {.outer = monitor, .until = thread_seconds() + patience};
  timeint_rest(ti, state);
  const hc_status st = timeint_steady(ti, omega, state, &(hc_monitor){work_limit_tick, &limit}, r);
  if (limit.stopped) return HC_INTERRUPTED;
  return st == HC_CREEPS || st == HC_UNBOUNDED || st == HC_NO_MEMORY ? st : HC_OK;
}

hc_status steady_state_creeps(const compare_setup *setup, double omega, const hc_monitor *monitor, int *response,
                              double *drift)
{
  timeint *ti;
  timeint_result r;
  double *state = NULL;
  hc_status st = timeint_new(setup->model, &setup->transient, &ti);
  if (st != HC_OK) return st;
  if (timeint_may_creep(ti)) {
    state = malloc((size_t)timeint_n_states(ti) * sizeof *state);
    st = state ? steady_state_lacks(ti, omega, state, monitor, &r) : HC_NO_MEMORY;
  }
  *drift = 0;
  for (int i = 0; i < setup->model->n_responses && st == HC_CREEPS; ++i) {
    const hc_status told = timeint_response(ti, i, &r);
    if (told != HC_OK) st = told;
    else if (fabs(r.drift) >= fabs(*drift)) *response = i, *drift = r.drift;
  }
  free(state);
  timeint_free(ti);
  return st == HC_UNBOUNDED ? HC_OK : st;
}
