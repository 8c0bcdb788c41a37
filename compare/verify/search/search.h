/* search.h - which of our own equations, and which reading of the columns, the points lie on; private to
 * compare/verify/. Below the first part what the files of the search have from each other: search.c (the stages),
 * readings.c (hypotheses, which cause is named), scales.c (free factors). */
#pragma once

#include "compare/verify/truth/report.h"
#include "compare/verify/truth/solutions.h"
#include "model/model.h"

enum { VERIFY_LEAST_DIFFERING = 3 }; /* fewer points are met by many hypotheses, and tell none from another */

/* out->rows are judged already; fills out->hypotheses, best first, and truth_distance. */
hc_status verify_search(const compare_setup *setup, const verify_data *data, const hc_monitor *monitor,
                        verify_report *out);

/* Does the best hypothesis explain the points? */
bool verify_fits(const verify_report *r);

/* Does hypothesis i fit as well as the best, and say something else? */
bool verify_rival(const verify_report *r, int i);

/* The best says what the contacts do, as nothing at all: does hypothesis i say why? */
bool verify_reason(const verify_report *r, int i);

/* ---- what numbers a dimensionless column may have been divided by ---- */

enum { VERIFY_MOST_SCALES = 16 };

typedef struct verify_scale {
  double factor;    /* theirs = factor times ours */
  const char *name; /* "1/F0" */
} verify_scale;

/* The factors that the model suggests, those that make sense: how many. */
int verify_value_scales(const model *m, verify_scale out[VERIFY_MOST_SCALES]);
int verify_omega_scales(const model *m, verify_scale out[VERIFY_MOST_SCALES]);

/* The name of one of n that the factor is within the part `tolerance` of, NULL: none. */
const verify_scale *verify_scale_near(const verify_scale *s, int n, double factor, double tolerance);

/* ---- how the columns may be meant ---- */

enum { SEARCH_MOST_POINTS = 64 };

/* The points that hypotheses are held against: some that differ from the truth and some that do not, omega
 * ascending. */
typedef struct verify_sample {
  int n;
  double omega[SEARCH_MOST_POINTS], value[SEARCH_MOST_POINTS];
  double decibel[SEARCH_MOST_POINTS]; /* the values if they are in dB where the file says not, or the other way */
  bool differs[SEARCH_MOST_POINTS];
  verify_quantity quantity; /* what the file says it is */
  double part;              /* [1] a distance is what this part of the points is within, 0.9; 0: their geometric mean */
} verify_sample;

/* HC_NO_MEMORY. */
hc_status verify_sample_new(const verify_report *r, const verify_quantity *quantity, verify_sample *out);

/* One reading: number `reading` of verify_reading, times `factor`, into *h. Distances below `floor` are
 * all the same. */
void verify_read_one(const verify_sample *p, const verify_solutions *s, int reading, double factor, double floor,
                     verify_hypothesis *h);

/* [1] The mean distance of the points as they stand, with a ceiling: what fits of a factor are led by, as
 * it changes with every point. */
double verify_closeness(const verify_sample *p, const verify_solutions *s);

/* How far the points are as they stand. */
double verify_read_plain(const verify_sample *p, const verify_solutions *s);

/* [1] How far solutions a are from the nearest of b: the largest at an omega, nine of ten points that differ are
 * within. */
double verify_apart(const verify_sample *p, const verify_solutions *a, const verify_solutions *b);

/* ---- a search ---- */

enum {
  SEARCH_FREQUENCIES = 3, /* omega as it stands, in cycles, or the other way */
  SEARCH_MOST_ORDERS = 40,
  SEARCH_MOST_LIKELY = 4
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
  int n_likely;  /* sampled equations that may be it, likeliest first */
  int frequency; /* the reading of it that these have */
  verify_equations likely[SEARCH_MOST_LIKELY];
  double likely_score[SEARCH_MOST_LIKELY];
  int done, expected; /* equations, for the monitor */
} search;

double search_omega_factor(int frequency); /* 0: as it stands */

/* False: interrupted. */
bool search_tick(search *s);

/* Equations with exact forces and so many harmonics; with the case's own. */
verify_equations search_equations(int harmonics, bool keep_mean);
verify_equations search_own(const search *s);

/* Their solutions at the points' omegas times the factor, along their curve. HC_BAD_INPUT: there are no such
 * equations. */
hc_status search_solve(search *s, const verify_equations *e, double omega_factor, verify_solutions *out);

/* Every reading of the points for these solutions, among the hypotheses. A unit of length is no cause where it is one
 * of s->scales, which may be meant. */
void search_read(search *s, const verify_equations *e, int frequency, const verify_solutions *of);

/* The hypothesis with its equations and factors, as the file says the quantity: solved, and among the hypotheses. */
hc_status search_fit(search *s, verify_hypothesis h);

void search_keep(search *s, const verify_hypothesis *h);

/* Does the best hypothesis explain the points so well that no other stage is needed? */
bool search_explained(const search *s);

/* readings.c: out->causes or out->nearest_guess from the hypotheses. */
void search_judge(verify_report *out);

/* scales.c: one factor of all values, or of all frequencies, and what it may be. */
hc_status search_scales(search *s);

/* scales.c: factors of the model's numbers. */
hc_status search_fits(search *s);
