/* sufficient.h - the fewest harmonics and samples with which harmonic balance keeps an allowed error of amplitude,
 * harmonic 1, mean (unless a slider leaves it open) and waveform of every response, relative to its amplitude, along
 * the whole curve.
 *
 * The reference is harmonic balance itself, with exact forces, harmonic 0 and so many harmonics that its own error
 * estimate (hbm_predict; reliability: docs/time-integration.md) is at most a twentieth of the allowed error: the same
 * solutions, without time integration, and with the same mean and orbit of a family.
 *
 * "Fewest" means that all larger settings tried keep the error, too. A smaller one may keep it by chance, where an
 * error changes sign: `by_chance`. Proof: tests/command/advice.py. */
#pragma once

#include "compare/compare_settings.h"
#include "compare/response.h"
#include "numerics/base/status.h"

typedef struct sufficient_row {
  bool sampled, keep_mean;
  int harmonics, samples; /* harmonics 0: none up to most_harmonics keeps the error; samples 0: exact forces */
  double error;           /* [1] largest error over frequencies, solutions, responses and quantities */
  const char *quantity;   /* quantity of the largest error; its frequency in omega */
  double omega;
  int next_harmonics, next_samples; /* the next smaller setting; harmonics 0: none */
  double next_error;                /* error of that setting; INFINITY: a solution is missing */
  int by_chance;                    /* smaller number of harmonics (of samples, if sampled) that keeps the error by
                                       chance; 0: none */
  int most_harmonics;
} sufficient_row;

enum { SUFFICIENT_ROWS = 4, SUFFICIENT_FOLDS = 16 };

typedef struct sufficient {
  int n;
  sufficient_row rows[SUFFICIENT_ROWS];
  int frequencies, solutions; /* number examined */
  int linear;                 /* of these: no contact changes its state, so that any number of harmonics is exact */
  int lost;                   /* without a reference solution next to them, or with one whose error estimate exceeds the
                                 allowed error */
  int harmonics;              /* harmonics of the reference */
  double predicted;           /* [1] its largest error estimate */
  /* Frequencies closer than `strip` to a turning point are omitted: few harmonics may have no solution there. */
  double strip; /* [1] of omega */
  int n_folds;
  double folds[SUFFICIENT_FOLDS];
  hc_status end; /* status of the curve */
} sufficient;

/* Examines setup->compare.omega, or, if empty, the whole curve. error: [1] allowed. HC_NO_MEMORY, HC_INTERRUPTED;
 * errors of hbm_solver_new. */
hc_status sufficient_run(const compare_setup *setup, double error, bool without_mean, const hc_monitor *monitor,
                         sufficient *out);
