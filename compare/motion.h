/* motion.h - the solutions of both sides as periodic motions, and the discrepancy of two. */
#pragma once

#include "compare/discrepancy.h"
#include "hbm/hbm.h"
#include "model/periodic_motion.h"
#include "timeint/steady/steady.h"

/* The motion of response r of the HBM solution X at omega; m may be NULL. Errors of hbm_measure_response. */
hc_status motion_of_response(hbm_solver *s, double omega, const double *X, int r, hbm_measures *m,
                             periodic_motion *out);

/* Has a transient that ended with st been measured? */
static inline bool motion_is_measured(hc_status st)
{
  return st == HC_OK || st == HC_NOT_SETTLED || st == HC_APERIODIC || st == HC_CREEPS;
}

/* The motion over a transient's reported period. */
periodic_motion motion_of_transient(const timeint_result *r);

/* Does a slider of this transient never slip, so that its mean depends on its history? Such means are not compared. */
bool motion_mean_is_free(const timeint_result *r);

/* motion_between(a, b) relative to b's amplitude; of the mean NaN where that of one of them is free. */
discrepancy motion_discrepancy(const periodic_motion *a, const periodic_motion *b);
