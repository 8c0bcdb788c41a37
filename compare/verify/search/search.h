/* search.h - which of our own equations, and which reading of the columns, the points lie on; private to
 * compare/verify/. Below the first part what the files of the search have from each other: search.c (the stages),
 * tries.c (one set of equations tried), readings.c (distances, which cause is named), scales.c (free factors). */
#pragma once

#include "compare/verify/truth/report.h"
#include "compare/verify/truth/solutions.h"
#include "model/model.h"

enum { VERIFY_LEAST_DIFFERING = 3 }; /* fewer points are met by many hypotheses, and tell none from another */

/* A response of the model, and what of its rows was judged. */
typedef struct verify_judged {
  const verify_data *data;
  const verify_report *report;
  bool wrong; /* rows differ, and nothing else says why */
} verify_judged;

/* All n responses together, in setup->model as verify_model_seen has them; those that are right must stay it. Fills
 * out->hypotheses, best first, truth_distance, causes or nearest_guess, tried, not_tried. The curves are the
 * truth's. */
hc_status verify_search(const compare_setup *setup, int n, const verify_judged *responses, const verify_effort *effort,
                        const hc_monitor *monitor, const verify_curves *curves, verify_report *out);

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

enum { SEARCH_MOST_POINTS = 64, SEARCH_MOST_RESPONSES = 8 };

/* All points are looked at, or a few of them, or a few of those. */
typedef enum search_look { SEARCH_ALL, SEARCH_FEW, SEARCH_GLANCE, SEARCH_LOOKS } search_look;

/* The points that hypotheses are held against: some that differ from the truth and some that do not, omega
 * ascending. A reading of the columns is of the responses that are wrong: the others' columns are right. */
typedef struct verify_sample {
  int n, n_responses;
  double omega[SEARCH_MOST_POINTS];
  double value[SEARCH_MOST_RESPONSES][SEARCH_MOST_POINTS];   /* NaN: none */
  double decibel[SEARCH_MOST_RESPONSES][SEARCH_MOST_POINTS]; /* if they are in dB where the file says not, or not */
  bool differs[SEARCH_MOST_RESPONSES][SEARCH_MOST_POINTS];
  verify_quantity quantity[SEARCH_MOST_RESPONSES]; /* what the file says they are */
  bool wrong[SEARCH_MOST_RESPONSES];
  int first;        /* of these */
  search_look look; /* now */
  bool looked_at[SEARCH_LOOKS][SEARCH_MOST_POINTS];
  double part; /* [1] a distance is what this part of the points that differ is within, 0.9; 0: geometric mean */
  double left; /* [1] and the farthest that matches and is solved for, where it is more: no cause takes one away */
  double off[SEARCH_MOST_RESPONSES][SEARCH_MOST_POINTS]; /* [1] distance from the truth; NaN: not known */
} verify_sample;

/* [1] Of the points as they stand from the truth, as far as it is known. */
double verify_truth_distance(const verify_sample *p);

/* HC_NO_MEMORY. */
hc_status verify_sample_of(int n, const verify_judged *responses, verify_sample *out);

/* What values may be multiplied by. */
typedef struct search_factor {
  double factor;       /* [1] */
  verify_causes cause; /* bit */
  bool decibel;        /* in dB where the file says not, or not where it says so */
} search_factor;
enum { SEARCH_FACTORS = 9 };
extern const search_factor search_factors[SEARCH_FACTORS];

/* [1] Of each factor the readings together; the first: as it stands. Of one response; the largest of all. */
enum { SEARCH_DISTANCES = SEARCH_FACTORS * VERIFY_READINGS };
typedef double search_distances[SEARCH_DISTANCES];
void search_distances_of(const verify_sample *p, int response, const verify_solutions *of, search_distances out);
void search_largest_distances(const verify_sample *p, const verify_solutions *of, search_distances out);

/* h->score from its distance, of which those below `floor` are all the same, and its causes. */
void search_rank(verify_hypothesis *h, double floor);

/* One reading: number `reading` of verify_reading, times `factor`, into *h, ranked. */
void verify_read_one(const verify_sample *p, const verify_solutions *s, int reading, double factor, double floor,
                     verify_hypothesis *h);

/* [1] Mean distance of the points as they stand, each no more than a ceiling: what fits of a factor minimise, since it
 * changes with every point. */
double verify_closeness(const verify_sample *p, const verify_solutions *s);

/* [1] How far solutions a are from the nearest of b: the largest at an omega, nine of ten points that differ, and have
 * both, are within. */
double verify_apart(const verify_sample *p, const verify_solutions *a, const verify_solutions *b);

/* How far the points are as they stand. */
double verify_read_plain(const verify_sample *p, const verify_solutions *s);

/* ---- a search ---- */

enum {
  SEARCH_FREQUENCIES = 3, /* omega as it stands, in cycles, or the other way */
  SEARCH_MOST_ORDERS = 40,
  SEARCH_MOST_SAMPLES = 1024, /* with which a slider's mistake is tried first */
  SEARCH_MOST_LIKELY = 4
};

/* The equations with exact forces and one number of harmonics, with or without harmonic 0; by reading of omega. */
typedef struct order {
  int harmonics;
  bool keep_mean;
  bool matters[SEARCH_FREQUENCIES]; /* true if its solutions are farther than the gate from those of many harmonics */
  double score;                     /* [1] verify_closeness, the least of the readings of omega */
  search_distances distance[SEARCH_FREQUENCIES]; /* of every reading of the columns; INFINITY: not solved */
} order;

typedef struct search {
  /* What is asked. */
  const compare_setup *setup;
  const hc_monitor *monitor;   /* interrupts when the patience is over */
  const verify_effort *effort; /* may be NULL */
  const verify_curves *curves; /* the truth's */
  verify_report *out;
  verify_sample points;
  bool oscillator; /* curves are followed; else solutions come by Newton from the truth's */
  double from, to; /* [rad/time] sweep that covers the points, omega as it stands */
  double floor;    /* [1] distance below which none is better than another: a tenth of the gate */
  int own;         /* the case's number of harmonics */
  int n_scales;    /* numbers that the values may have been divided by */
  verify_scale scales[VERIFY_MOST_SCALES];
  bool scaled[SEARCH_FREQUENCIES]; /* true if the points are near the sweep by this reading of omega */
  /* What was found. */
  verify_solutions many[2][SEARCH_FREQUENCIES]; /* of the truth's number of harmonics, without harmonic 0 and with */
  int n_orders;
  order orders[SEARCH_MOST_ORDERS]; /* in the order in which they were tried */
  order *current;                   /* the order being tried; NULL: none */
  int n_likely;
  verify_equations likely[SEARCH_MOST_LIKELY]; /* sampled equations, likeliest first */
  double likely_score[SEARCH_MOST_LIKELY];     /* [1] geometric mean of the points' distances, as they stand */
  int frequency;                               /* reading of omega with which samples are tried */
  search_distances most_samples[VERIFY_CHANGES - VERIFY_MODEL_CHANGES]; /* of each slider with SEARCH_MOST_SAMPLES */
  double last;  /* [1] distance of the best reading of the equations tried last */
  bool plainly; /* of search_solve: no second guess at a point where the first converges */
  /* What was said. */
  bool said;                 /* true once the first answer was due */
  double begun;              /* [s] on the thread's clock */
  verify_causes said_causes; /* in the last answer */
  int done, expected;        /* equations tried, for the monitor */
} search;

/* Number i of the numbers of harmonics that programs usually keep, and the truth's: two that take little come first. */
enum { SEARCH_ORDERS = 6 };
int search_order(const search *s, int i);

/* Factors of the model's numbers that are no fits; the last of a gap alone. */
enum { SEARCH_USUAL_FACTORS = 5 };
extern const double search_usual[SEARCH_USUAL_FACTORS];

double search_omega_factor(int frequency); /* 0: as it stands */

/* False: interrupted, or out of patience. */
bool search_tick(search *s);

/* The best so far, to whoever wants to hear of it, if it is another than last time. */
void search_say(search *s);

/* Equations with exact forces and this number of harmonics; with the case's own. */
verify_equations search_equations(int harmonics, bool keep_mean);
verify_equations search_own(const search *s);

/* Their solutions at the points' omegas times the factor: by Newton from `near`; NULL: along their curve. HC_BAD_INPUT:
 * there are no such equations. */
hc_status search_solve(search *s, const verify_equations *e, double omega_factor, const verify_solutions *near,
                       verify_solutions *out);

/* By the one that pays, and every reading of them among the hypotheses. Of a structure at a glance, with one guess
 * a point, then at few of the points, at all if these are promising, and along the curve if most of those fit. *out is
 * the caller's to clear; `look` says which points it is of. */
hc_status search_try(search *s, const verify_equations *e, int frequency, const verify_solutions *near,
                     verify_solutions *out);

/* Every reading of the points among the hypotheses, by its distance, if that is better than that of the same equations
 * with nothing wrong but their number of harmonics. A unit of length is no cause where it is one of s->scales, which
 * may be meant. d_solved: distances of the points that there are solutions at, NULL: at all. */
void search_read(search *s, const verify_equations *e, int frequency, const verify_solutions *of);
void search_read_distances(search *s, const verify_equations *e, int frequency, const search_distances d,
                           const double *d_solved);

/* HC_OK where equations could not be solved for one reading of the frequency, which out->unsolved says then, or where
 * there are none (HC_BAD_INPUT); else st. */
hc_status search_passed(search *s, const verify_equations *e, int frequency, hc_status st);

/* The hypothesis with its equations and factors, as the file says the quantity: solved, and among the hypotheses. */
hc_status search_fit(search *s, verify_hypothesis h, const verify_solutions *near);

void search_keep(search *s, const verify_hypothesis *h);

/* Does the best hypothesis explain the points so well that no other stage is needed? */
bool search_explained(const search *s);

/* readings.c: out->causes or out->nearest_guess from the hypotheses. */
void search_judge(verify_report *out);

/* scales.c: one factor of all values, or of all frequencies, and what it may be. */
hc_status search_scales(search *s);

/* scales.c: factors of the model's numbers. */
hc_status search_fits(search *s);
