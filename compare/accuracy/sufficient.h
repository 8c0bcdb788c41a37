/* sufficient.h - how many harmonics and samples keep harmonic balance within an error: amplitude, harmonic 1, mean (but
 * where a slider leaves it open) and waveform of every response, relative to its amplitude, along the whole curve.
 *
 * The reference is harmonic balance itself, with exact forces, harmonic 0 and so many harmonics that its own prediction
 * (hbm_predict; docs/time-integration.md says how often it holds) is a twentieth of the error or
 * less: the same solutions, without a second's integration, and neither mean nor family open between the two.
 *
 * "Least" is from here on: all greater settings that were tried keep the error, too. A smaller one may keep it by
 * chance, as errors pass through 0: `by_chance`. Proof: tests/command/advice.py. */
#pragma once

#include "compare/compare_settings.h"
#include "compare/response.h"
#include "numerics/base/status.h"

typedef struct sufficient_row {
  bool sampled, keep_mean;
  int harmonics, samples; /* harmonics 0: nothing up to most_harmonics keeps it; samples 0: exact forces */
  double error;           /* [1] largest over frequencies, solutions, responses and quantities */
  const char *quantity;   /* which, and where */
  double omega;
  int next_harmonics, next_samples; /* the next smaller setting; harmonics 0: there is none */
  double next_error;                /* INFINITY: a solution is missing */
  int by_chance;                    /* fewer harmonics (samples, where sampled) that keep it, too; 0: none */
  int most_harmonics;
} sufficient_row;

enum { SUFFICIENT_ROWS = 4, SUFFICIENT_FOLDS = 16 };

typedef struct sufficient {
  int n;
  sufficient_row rows[SUFFICIENT_ROWS];
  int frequencies, solutions; /* looked at */
  int linear;                 /* of them: no contact changes its state, and any number of harmonics is right */
  int lost;                   /* without a solution of many harmonics next to them, or with an error beyond reach */
  int harmonics;              /* of the reference               */
  double predicted;           /* [1] its error as predicted, the largest */
  /* Frequencies so near to a turning point have no solution of few harmonics, or one far away: left out. */
  double strip; /* [1] of omega */
  int n_folds;
  double folds[SUFFICIENT_FOLDS];
  hc_status end; /* of the curve */
} sufficient;

/* At setup->compare.omega, or along the curve. HC_NO_MEMORY, HC_INTERRUPTED; errors of hbm_solver_new. */
hc_status sufficient_run(const compare_setup *setup, double error, bool without_mean, const hc_monitor *monitor,
                         sufficient *out);
