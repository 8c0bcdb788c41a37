/* slider.h - one contact followed over the samples of a period until its slider repeats itself: the force at every
 * sample, and the intervals of samples in which nothing but the motion changes. */
#pragma once

#include "hbm/hbm_settings.h"
#include "model/contact_law.h"

/* What moves a contact, sample by sample, and what its force does in turn. With one coordinate both are x. */
typedef struct slider_motion {
  const double *along, *across; /* [n] [length] u = c along, v = s across */
  double c, s;                  /* [1] */
  double of_t, of_n;            /* [1] the force: of_t T + of_n (N - N0) */
} slider_motion;

/* What the slider's position depends on: dw = sum_k by_along[k] d along(th_i+k) + by_across[k] d across(th_i+k), all 0
 * where the motion does not move it. Sample n is sample 0. */
typedef struct slider_origin {
  int i;
  double by_along[2], by_across[2];
} slider_origin;

/* Samples of one state: from `first` to the next interval, or to the end of the period. */
typedef struct sampled_interval {
  int first;
  contact_state state;
  double w;             /* [length] slider at the first sample; while it sticks, at all of them */
  slider_origin origin; /* of w, while it sticks */
} sampled_interval;

typedef struct slider_report {
  int n_intervals;
  int transitions;   /* changes of state, that from the end of the period to its start included */
  double w, settled; /* [length] slider at the end of the period and of the one before: to compare */
} slider_report;

/* How a slider is followed from sample to sample. By `restart` alone, unless somebody plugs in another rule
 * (hbm_plug_in); then one that is always held has no place of its own in planar_aft.h, either, and is marched. */
typedef struct slider_rule {
  hbm_restart restart;
  /* As contact is made, of one tangent: *w is where the slider starts, *origin what that depends on. NULL: by
   * `restart`. */
  void (*touch)(double *w, slider_origin *origin);
  const struct planar_rule *in_plane; /* a step with two tangents (planar_slider.h); NULL: by `restart` */
  bool keeps;                         /* w stays as it is over a separation; else w = u while it lasts */
  bool once;                          /* the force is that of one period from `start`, whether it closes or not */
  double start;                       /* [length] where one of one tangent begins: 0 at first (contact_evaluator.h) */
} slider_rule;

/* f[n] [force] at each sample of the periodic motion m; intervals[n]: room, the first of them filled; again[n],
 * settling[n]: room, overwritten. Exactly the second of two periods that begin at the start, but the second is followed
 * only until it is where the first was; by a rule that follows it once, the first. Cannot fail, allocates nothing. */
slider_report slider_follow(const contact *law, const slider_rule *rule, int n, const slider_motion *m, double *f,
                            double *again, sampled_interval *intervals, sampled_interval *settling);
