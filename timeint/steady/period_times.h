/* period_times.h - how much processor time a period takes, for who wants to know beforehand what steady states will. */
#pragma once

#include "timeint/timeint.h"

/* [s] of processor time, each; 0: the handle has no such periods. Plain ones are measured, matrices are not made:
 * they are plain periods times what was measured once (period_times.c). */
typedef struct period_times {
  double by_cvode;
  double closed_form;   /* of the whole model */
  double matrix;        /* a monodromy matrix, by whoever gives it to Newton */
  double cvodes_matrix; /* the same of the regularised law, by CVODES */
  bool chords;          /* orbits are found by chord steps: many periods, few matrices (mass_scaling.h) */
} period_times;

/* One period of each kind from `state` at omega, and no more once the monitor stops them: what it took until then is
 * told. From the state of an orbit contacts change as often as they do there; from rest friction in a plane may take
 * thousands of steps. HC_BAD_INPUT, errors of integration, HC_NO_MEMORY; of a stopped period HC_OK. */
hc_status timeint_time_periods(timeint *ti, double omega, const double *state, const hc_monitor *monitor,
                               period_times *out);
