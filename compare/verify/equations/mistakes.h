/* mistakes.h - mistakes in the equations that no other model has: contact evaluators with one in them, plugged into our
 * own harmonic balance (hbm_plug_in). Private to compare/verify/. */
#pragma once

#include "hbm/contact/contact_evaluator.h"

/* Rules for the slider of sampled forces: our own two, and habits and mistakes of other programs. */
extern const slider_rule verify_on_line, verify_on_sample, verify_radial, verify_zeroed, verify_kept, verify_once,
    verify_once_sampled;

/* Harmonic 0 of a friction force T = kt (u - w): as it is, of kt u alone, or dropped. */
typedef enum verify_friction_mean { FRICTION_MEAN, FRICTION_MEAN_OF_U, FRICTION_NO_MEAN } verify_friction_mean;

/* All zero: none. */
typedef struct verify_mistakes {
  hbm_plug_in plug_in;       /* made by verify_plug_in, which gets a pointer to it as one to the whole */
  const slider_rule *slider; /* NULL: as hbm.slider_restart says */
  bool odd_only;             /* even harmonics of the contact force are dropped, 0 included */
  double mean_error;         /* [1] harmonic 0 of the contact force is multiplied by 1 + mean_error */
  bool hysteretic;           /* the damping force is i C times the amplitude, whatever the frequency */
  unsigned turned;           /* bit j: the friction force of the model's contact j has the other sign */
  verify_friction_mean mean; /* of every contact */
} verify_mistakes;

/* Into *how, for solvers that *wrong must outlive. */
void verify_plug_in(verify_mistakes *wrong, hbm_settings *how);
