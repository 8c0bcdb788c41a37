/* slider.h - one contact followed over the samples of a period until its slider repeats itself: the force at every
 * sample, and the stretches of samples in which nothing but the motion changes. */
#ifndef HC_HBM_SLIDER_H
#define HC_HBM_SLIDER_H

#include <stdbool.h>

#include "hbm/hbm_settings.h"
#include "model/model.h"

/* What the slider's position depends on: dw = by_x dx(th_i), with by_x = 0 where the motion does not move it. */
typedef struct slider_origin {
  int i;
  double by_x;
} slider_origin;

/* Samples of one state: from `first` to the next stretch, or to the end of the period. */
typedef struct stretch {
  int first;
  contact_state state;
  double w;             /* [length] slider at the first sample; while it sticks, at all of them */
  slider_origin origin; /* of w, while it sticks */
} stretch;

typedef struct slider_report {
  int n_stretches;
  int transitions;   /* changes of state, that from the end of the period to its start included */
  double w, settled; /* [length] slider at the end of the period and of the one before: to compare */
} slider_report;

/* x[n] [length]: samples of the periodic motion. f[n] [force]: t T + n (N - N0) at each; stretches[n]: room, the first
 * of them filled; again[n], settling[n]: room, overwritten. Exactly the second of two periods that begin with w = 0,
 * but the second is followed only until it is where the first was. With one of the ONE_PASS restarts, the first.
 * Cannot fail, allocates nothing. */
slider_report slider_follow(const model_contact *c, hbm_restart restart, int n, const double *x, double *f,
                            double *again, stretch *stretches, stretch *settling);

#endif
