/* hbm_settings.h - how harmonic balance solves a model. Plain data: copy it freely. Names, defaults, ranges and
 * meanings of the fields are those of `hbm` in a case file (model/casefile/fields.c). */
#pragma once

#include <stdbool.h>

#define HBM_LEAST_ACCURACY 1e-12
enum { HBM_MAX_HARMONICS = 200, HBM_AUTO = 0 /* in the place of a number of harmonics or samples */ };

typedef enum hbm_force { HBM_FORCE_EXACT, HBM_FORCE_SAMPLED } hbm_force;

/* The slider of a sampled force. From HBM_RESTART_RADIAL on they are habits and mistakes of other programs, which
 * compare/verify/ makes to know them; no case file has them. */
typedef enum hbm_restart {
  HBM_RESTART_INTERPOLATED,
  HBM_RESTART_SAMPLE,
  HBM_RESTART_RADIAL,         /* as interpolated, but of two tangents by radial return, as in other programs */
  HBM_RESTART_ZEROED,         /* after a separation it starts from w = 0 */
  HBM_RESTART_KEPT,           /* and from where it was before */
  HBM_RESTART_ONE_PASS,       /* as interpolated, but one period from w = 0, which does not settle */
  HBM_RESTART_ONE_PASS_SAMPLE /* as on a sample, likewise */
} hbm_restart;

typedef enum hbm_continuation {
  HBM_CONTINUATION_AUTO,
  HBM_CONTINUATION_NATURAL,
  HBM_CONTINUATION_ARCLENGTH,
  HBM_CONTINUATION_FIXED_STEP
} hbm_continuation;

/* Harmonic 0 of a friction force T = kt (u - w): as it is, of kt u alone, or dropped. */
typedef enum hbm_friction_mean { HBM_FRICTION_MEAN, HBM_FRICTION_MEAN_OF_U, HBM_FRICTION_NO_MEAN } hbm_friction_mean;

/* Other mistakes in the equations, for compare/verify/ alone; all zero otherwise. `mean` is none of an oscillator. */
typedef struct hbm_mistakes {
  bool odd_only;          /* even harmonics are dropped, 0 included */
  double mean_error;      /* [1] harmonic 0 of the contact force is multiplied by 1 + mean_error */
  bool hysteretic;        /* the damping force is i C times the amplitude, whatever the frequency */
  unsigned turned;        /* bit j: the friction force of the model's contact j has the other sign */
  hbm_friction_mean mean; /* of every contact */
} hbm_mistakes;

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
  hbm_mistakes mistakes;
} hbm_settings;
