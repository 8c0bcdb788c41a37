/* mistakes.h - mistakes in the equations that no other model has: contact evaluators with one in them, plugged into our
 * own harmonic balance (hbm_plug_in). Private to compare/verify/. */
#pragma once

#include "compare/verify/equations/causes.h"
#include "hbm/contact/contact_evaluator.h"

/* How the slider of sampled forces is followed: as hbm.slider_restart has it (hbm_restart, the same numbers), and by the
 * habits and mistakes of other programs. code, causes beside too few samples, words, rule */
#define VERIFY_SLIDER_LIST(X)                                                                                          \
  X(SLIDER_INTERPOLATED, 0, "", {.restart = HBM_RESTART_INTERPOLATED})                                                 \
  X(SLIDER_ON_SAMPLE, VERIFY_BIT(CAUSE_SLIDER), ", hbm.slider_restart: sample", {.restart = HBM_RESTART_SAMPLE})       \
  X(SLIDER_RADIAL, 0, "", {.in_plane = &radial_return})                                                                \
  X(SLIDER_ZEROED, VERIFY_BIT(CAUSE_SLIDER_ZEROED), ", w = 0 after a separation",                                      \
    {.touch = zero, .in_plane = &zeroed})                                                                              \
  X(SLIDER_KEPT, VERIFY_BIT(CAUSE_SLIDER_KEPT), ", w kept over a separation", {.in_plane = &kept, .keeps = true})      \
  X(SLIDER_ONE_PASS, VERIFY_BIT(CAUSE_SINGLE_PASS), ", one period from w = 0", {.once = true})                         \
  X(SLIDER_ONE_PASS_SAMPLE, VERIFY_BIT(CAUSE_SINGLE_PASS), ", one period from w = 0",                                  \
    {.restart = HBM_RESTART_SAMPLE, .once = true})
#define VERIFY_SLIDER_CODE(code, causes, words, ...) code,
typedef enum verify_slider { VERIFY_SLIDER_LIST(VERIFY_SLIDER_CODE) VERIFY_SLIDERS } verify_slider;
#undef VERIFY_SLIDER_CODE

typedef struct verify_slider_kind {
  verify_causes causes;
  const char *words;
  slider_rule rule;
} verify_slider_kind;
extern const verify_slider_kind verify_sliders[VERIFY_SLIDERS];

/* Harmonic 0 of a friction force T = kt (u - w): as it is, of kt u alone, or dropped. */
typedef enum verify_friction_mean { FRICTION_MEAN, FRICTION_MEAN_OF_U, FRICTION_NO_MEAN } verify_friction_mean;

/* All zero: none. */
typedef struct verify_mistakes {
  hbm_plug_in plug_in; /* made by verify_plug_in, which gets a pointer to it as one to the whole */
  verify_slider slider;
  bool odd_only;             /* even harmonics of the contact force are dropped, 0 included */
  double mean_error;         /* [1] harmonic 0 of the contact force is multiplied by 1 + mean_error */
  bool hysteretic;           /* the damping force is i C times the amplitude, whatever the frequency */
  unsigned turned;           /* bit j: the friction force of the model's contact j has the other sign */
  verify_friction_mean mean; /* of every contact */
} verify_mistakes;

/* Into *how, for solvers that *wrong must outlive. */
void verify_plug_in(verify_mistakes *wrong, hbm_settings *how);
