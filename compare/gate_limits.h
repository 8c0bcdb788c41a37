/* gate_limits.h - the largest discrepancies that count as agreement, and the most a response curve may cost; only the
 * gate and the rule of a match look inside. Names, defaults, ranges, meanings: `gate` in model/casefile/fields.c. */
#pragma once

#include <stdbool.h>

#include "compare/discrepancy.h"
#include "numerics/base/number.h"

/* Other limits in parts of the sweep. Where ranges overlap the last one holds. */
typedef struct gate_ranges {
  number_list ends; /* from, to, from, to, ..., ends included, in [rad/time], or cycles per time where in_cycles */
  bool in_cycles;
  number_list amplitude, harmonic_1, mean, waveform; /* [1] one a range; n = 0: as outside the ranges */
} gate_ranges;

/* Must a contact change its state at some frequency? Else a linear response passes, with a remark. */
typedef enum gate_nonlinear { GATE_NONLINEAR_ANY, GATE_NONLINEAR_REQUIRED } gate_nonlinear;

typedef struct gate_limits {
  discrepancy most; /* [1] largest relative discrepancy */
  gate_ranges ranges;
  double band; /* [1] the widest band (compare/band.h) that passes; 0: any */
  gate_nonlinear nonlinear;
  bool proven; /* is the orbit next to each solution to be proven, and its error in amplitude below the limit? */
  int iterations, evaluations; /* most for the response curve; 0: no limit */
} gate_limits;

/* The limits that hold at omega [rad/time]: `most`, or those of the last range that omega lies in. */
discrepancy gate_limits_at(const gate_limits *l, double omega);

/* Within all limits that hold at omega? The mean does not count where history leaves it free; NaN is never within. */
bool gate_limits_hold(const gate_limits *l, double omega, const discrepancy *d, bool mean_free);
