/* compare_settings.h - the frequencies, harmonics and samples of a comparison; with the model, both sides' settings and
 * the limits, all that it works from. Names, defaults, ranges, meanings: `compare` in model/casefile/fields.c. */
#pragma once

#include "hbm/hbm_settings.h"
#include "model/model.h"
#include "numerics/base/number.h"
#include "timeint/transient_settings.h"
#include <pthread.h>

/* Are the bands of solutions with free sliders found (compare/band.h)? */
typedef enum compare_band { COMPARE_BAND_AUTO, COMPARE_BAND_OFF } compare_band;

typedef struct compare_settings {
  number_list omega;     /* [rad/time]; n = 0: use `points` */
  int points;            /* spread over the sweep, dense at peaks */
  number_list harmonics; /* truncation orders to report */
  number_list samples;   /* sampling rates to report */
  compare_band band;
} compare_settings;

typedef struct gate_limits gate_limits; /* compare/gate_limits.h: nobody else looks inside */

/* The model and how each side solves it. Copies share the model and the limits: whoever made them frees them. */
typedef struct compare_setup {
  const model *model;
  double omega_from, omega_to; /* [rad/time] the sweep, > 0, from != to; from > to: downwards */
  hbm_settings hbm;
  transient_settings transient;
  compare_settings compare;
  const gate_limits *limits; /* what is within them is a match */
  double reduction;          /* [1] stated error of the receptance of a model that was reduced; 0: none */
  bool spare;                /* leave out parts of the budget that nobody asks for and no verdict depends on */
  bool contacts;             /* what each contact does, too */
  bool multipliers;          /* of every HBM solution; otherwise only where a verdict depends on them */
  int survey;                /* drawn starts at each frequency (compare/survey.h); 0: none */
  bool advise;               /* try what brings the worst row within the limits */
  pthread_mutex_t *found;    /* held while rows are added to the results; NULL: nobody else looks */
  void (*added)(void *self); /* called when rows were added, without that lock, with added_to; NULL: nobody asks */
  void *added_to;
  int jobs; /* threads for the tables of accuracy.h; 0 and 1: the calling one alone */
} compare_setup;

/* While what was found changes, for who looks at it meanwhile. */
static inline void compare_lock(const compare_setup *setup)
{
  if (setup->found) pthread_mutex_lock(setup->found);
}
static inline void compare_unlock(const compare_setup *setup)
{
  if (setup->found) pthread_mutex_unlock(setup->found);
}

/* Harmonics of the curve that rows of the tables are compared with, at least. Of more than COMPARE_LARGE degrees of
 * freedom such a curve costs minutes, and orbits are known from the comparison's rows or next to coarser solutions. */
enum { COMPARE_LARGE = 64 };
static inline int compare_reference_harmonics(const model *m) { return m->n > COMPARE_LARGE ? 10 : 20; }
