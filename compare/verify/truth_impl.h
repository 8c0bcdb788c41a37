/* truth_impl.h - what the files of the truth share: truth.c (the curve, and each point against it), steep.c (points
 * where the curve turns), referee.c (the curve against time integration),
 * line.c (the curve as it is drawn). */
#ifndef HC_VERIFY_TRUTH_IMPL_H
#define HC_VERIFY_TRUTH_IMPL_H

#include "compare/verify/truth.h"

typedef struct truth {
  const compare_setup *setup;
  const verify_data *data;
  const hc_monitor *monitor;
  verify_report *out;
  hbm_solver *hbm;
  timeint *referee;
  double *state; /* [n_states] of the referee's */
  hbm_curve curve;
  double from, to;
  double *room;   /* acceleration_room */
  double *series; /* [2H+1] of a response */
} truth;

/* A solution as the file's quantity is taken of it. */
typedef struct measured {
  double value, scale;
  bool mean_free;
} measured;

/* HC_OK, or why it cannot be measured. */
hc_status truth_measure(truth *t, double omega, const double *X, measured *out);

/* Every solution of the curve at omega; where the curve ended before, one found without it. HC_NO_MEMORY. */
hc_status truth_at(truth *t, double omega, hbm_curve *at);

/* The nearest of the solutions *at to the row's value, or -1; its measures into *nearest. */
int truth_nearest(truth *t, const hbm_curve *at, const verify_row *row, measured *nearest);

/* +1, -1, or 0: unknown. *st becomes HC_NO_MEMORY if that is why. */
int truth_stable(truth *t, double omega, const double *X, hc_status *st);

/* A row that differs is held against the pieces of the curve around its omega. HC_NO_MEMORY. */
hc_status truth_look_around(truth *t, verify_row *row);

/* At most MOST_CHECKS points, spread over the file: out->checked, unchecked, checked_error. HC_INTERRUPTED,
 * HC_NO_MEMORY. */
hc_status truth_check(truth *t);

/* out->line. HC_NO_MEMORY, or why it cannot be measured. */
hc_status truth_line(truth *t);

#endif
