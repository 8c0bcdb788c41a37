/* survey.h - which steady states the exact law reaches at a frequency, from many starts, and how many starts each has.
 *
 * Starts are drawn (survey_starts.h), but the first one, at rest, and the next, on each HBM solution. Each is followed
 * to where its motion goes by time integration, in closed form, or by CVODE where a law is smooth. Equal motions are
 * one row. Motions of one period that no HBM solution has are handed to harmonic balance: solutions that the curve does
 * not come to, as on an isola. */
#pragma once

#include "compare/steady_states.h"
#include "hbm/hbm.h"

typedef struct survey_settings {
  int starts;       /* >= 1 */
  unsigned seed;    /* of the draw */
  int jobs;         /* threads; results do not depend on their number */
  int first_branch; /* of solutions that are found beside the curve: one more than the curve's last */
} survey_settings;
enum { SURVEY_STARTS = 200, SURVEY_SEED = 1, SURVEY_MOST_STARTS = 10000 };

/* One response of one motion; all of its starts differ by less than what the integration errs, or are members of a
 * family: a slider rests differently in each, and with it the mean, and the amplitude perhaps. Motions that do not
 * repeat are one for each verdict. */
typedef struct survey_row {
  steady_row steady;                    /* of the first start that came to it */
  int motion;                           /* from 0, by falling share */
  double amplitude_low, amplitude_high; /* [length] over its starts */
  int starts;                           /* that came to it */
  double share;                         /* [1] of all starts */
  int hbm_branch;   /* of the HBM solution that it runs on: within the gate, or Newton from the motion comes to it, and
                       it is within half the amplitude; from first_branch on beside the curve; -1: none */
  double hbm_error; /* [1] waveform of the first response against that one, as a comparison has it; else NaN */
} survey_row;

/* Where a start began, by the first response, of a model of one degree of freedom. */
typedef struct survey_start {
  double omega; /* [rad/time] */
  double x, v;  /* [length], [length/time] at t = 0; its sliders are not kept */
  int motion;   /* that it came to, as in the rows of omega */
} survey_start;

typedef struct survey { /* made empty with {0}; results of further frequencies are appended */
  int n_rows;
  survey_row *rows; /* of a frequency by motion, of a motion by response */
  int n_starts;
  survey_start *starts; /* of a frequency by motion, those that were made; NULL: of several degrees of freedom */
  hbm_curve beside;     /* solutions that the curves do not come to, for survey_append_beside */
} survey;

/* Steady states at omega, appended to *out. at: the curve's solutions there (hbm_curve_at), which may be none; hbm
 * NULL: no harmonic balance. After HC_INTERRUPTED what was found is kept, and shares are of the starts made.
 * HC_BAD_INPUT, HC_NO_MEMORY; errors of timeint_new and model_modes. */
hc_status survey_at(const compare_setup *setup, hbm_solver *hbm, const hbm_curve *at, double omega,
                    const survey_settings *how, const hc_monitor *monitor, survey *out);
void survey_clear(survey *s);

/* The same at all frequencies of compare.omega, with the response curve that leads there. Rows
 * are added under setup->found. Errors of survey_at and of response_trace. */
hc_status survey_run(const compare_setup *setup, const survey_settings *how, const hc_monitor *monitor, survey *out);

/* Appends to *found the solutions of s->beside from `from` on. HC_NO_MEMORY. */
hc_status survey_append_beside(const survey *s, int from, hbm_curve *found);

/* One more than the branches of the curve, for first_branch. */
int survey_first_branch(const hbm_curve *curve);

/* Motions among rows[from..n_rows-1] that repeat, or stay bounded, and have no HBM solution. */
int survey_others(const survey *s, int from);

/* [s] processor time of survey_run with so many starts, by the start at rest at up to five of the frequencies; 0: not
 * known. */
double survey_seconds(const compare_setup *setup, int starts);
