/* search_impl.h - what a search consists of; for the files of the search only: search.c (order of the stages, exact
 * forces), hypotheses.c, sampled.c, fits.c (free factors), judge.c. */
#ifndef HC_VERIFY_SEARCH_IMPL_H
#define HC_VERIFY_SEARCH_IMPL_H

#include "compare/verify/search/readings.h"
#include "compare/verify/search/search.h"

enum {
  SEARCH_FREQUENCIES = 3, /* omega as it stands, in cycles, or the other way */
  SEARCH_MOST_ORDERS = 40,
  SEARCH_MOST_LIKELY = 4,
  SEARCH_MOST_POINTS = 64
};

/* The equations with exact forces and one number of harmonics, with or without harmonic 0. */
typedef struct order {
  int harmonics;
  bool keep_mean;
  bool matters[SEARCH_FREQUENCIES]; /* is it far from many harmonics, by the gate? */
  double score;
} order;

typedef struct search {
  const compare_setup *setup;
  const hc_monitor *monitor;
  verify_report *out;
  verify_sample points;
  double from, to; /* the sweep that covers the points as they stand */
  double floor;    /* distances below are all the same */
  int own;         /* the case's harmonics */
  int n_scales;    /* what the values may have been divided by */
  verify_scale scales[VERIFY_MOST_SCALES];
  bool scaled[SEARCH_FREQUENCIES];              /* is this reading of the frequency possible? */
  verify_solutions many[2][SEARCH_FREQUENCIES]; /* with the truth's harmonics: without harmonic 0, with */
  int n_orders;
  order orders[SEARCH_MOST_ORDERS];
  int n_likely; /* sampled equations that may be it, likeliest first */
  verify_equations likely[SEARCH_MOST_LIKELY];
  double likely_score[SEARCH_MOST_LIKELY];
  int done, expected; /* equations, for the monitor */
} search;

double search_omega_factor(int frequency); /* 0: as it stands */

/* False: interrupted. */
bool search_tick(search *s);

/* The case's own equations, with exact forces. */
verify_equations search_own(const search *s);

/* Their solutions at the points' omegas times the factor, along their curve. HC_BAD_INPUT: there are no such
 * equations. */
hc_status search_solve(search *s, const verify_equations *e, double omega_factor, verify_solutions *out);

/* Every reading of the points for these solutions, among the hypotheses. */
void search_read(search *s, const verify_equations *e, int frequency, const verify_solutions *of);

/* Both for each possible reading of the frequency. HC_OK where there are no such equations. */
hc_status search_try(search *s, const verify_equations *e);

void search_keep(search *s, const verify_hypothesis *h);

/* Does the best hypothesis explain the points so well that no other stage is needed? */
bool search_explained(const search *s);

/* sampled.c: every number of samples, and the mistakes in following a slider. */
hc_status search_sampled(search *s);
hc_status search_sliders(search *s);

/* scales.c: one factor of all values, or of all frequencies, and what it may be. */
hc_status search_scales(search *s);

/* fits.c: factors of the model's numbers. */
hc_status search_fits(search *s);

/* judge.c: out->causes or out->nearest_guess from the hypotheses. */
void search_judge(verify_report *out);

#endif
