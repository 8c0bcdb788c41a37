/* hbm_settings.h - how harmonic balance solves a model. Plain data: copy it freely. Names, defaults, ranges and
 * meanings of the fields are those of `hbm` in a case file (model/casefile/fields.c). */
#pragma once

#include <stdbool.h>

#define HBM_LEAST_ACCURACY 1e-12
enum { HBM_MAX_HARMONICS = 200, HBM_AUTO = 0 /* in the place of a number of harmonics or samples */ };

typedef enum hbm_force { HBM_FORCE_EXACT, HBM_FORCE_SAMPLED } hbm_force;

/* Where the slider of a sampled force starts as contact is made: at the interpolated instant, or the sample before. */
typedef enum hbm_restart { HBM_RESTART_INTERPOLATED, HBM_RESTART_SAMPLE } hbm_restart;

typedef enum hbm_continuation {
  HBM_CONTINUATION_AUTO,
  HBM_CONTINUATION_NATURAL,
  HBM_CONTINUATION_ARCLENGTH,
  HBM_CONTINUATION_FIXED_STEP
} hbm_continuation;

typedef struct hbm_settings {
  int harmonics;  /* 1..HBM_MAX_HARMONICS, or HBM_AUTO */
  bool keep_mean; /* `static`: keep harmonic 0 */
  hbm_force force;
  int samples;         /* per period, >= 2 harmonics + 1, or HBM_AUTO */
  hbm_restart restart; /* where the slider of a sampled force starts after a separation */
  hbm_continuation continuation;
  double step;      /* [1] arc length from point to point, for fixed_step (path.c) */
  int iterations;   /* the most that Newton may take at a point, for fixed_step */
  double tolerance; /* [1] of the residual, relative to the forces that make it up */
  double accuracy;  /* [1] largest error that auto harmonics and samples allow, relative to the solution */
  bool skip_linear; /* points where nothing happens at the contacts come from the closed form */
  const struct hbm_plug_in *plug_in; /* parts of somebody else in the equations (contact_evaluator.h); NULL: none */
} hbm_settings;
