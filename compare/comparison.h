/* comparison.h - the main job: the same frequencies solved by harmonic balance and by time integration, and how far
 * apart they are.
 *
 * Per frequency and per HBM solution (branch) the transient starts, unless transient.start says otherwise, on that
 * solution's own orbit. Beside it stands the referee: the periodic orbit of the exact contact law next to the HBM
 * solution, stable or not, found by shooting. What the HBM solution should be is that orbit; what a machine does is
 * the transient. An error is |hbm - transient| / the transient's amplitude. Phases are never aligned: the forcing
 * fixes them. Each side estimates its own error before the two are compared (as in ASME V&V 20); a difference of
 * amplitude or waveform above three times the sum of both estimates is `unexpected`: one of them is mistaken. */
#pragma once

#include "compare/band.h"
#include "compare/budget.h"
#include "compare/compare_settings.h"
#include "compare/discrepancy.h"
#include "compare/referee.h"
#include "compare/response.h"
#include "compare/survey.h"
#include "hbm/hbm.h"
#include "model/contact_period.h"
#include "model/model.h"
#include "numerics/base/status.h"
#include "timeint/steady/steady.h"

/* ---- one contact in one HBM solution, and in the transient that the solution is held against: a friction damper is
 * bought for its work, and a motion that agrees does not say that this does ---- */

typedef struct contact_comparison {
  double omega;
  int branch, contact;      /* counted from 0, as in the case: a pair is one */
  char name[RESPONSE_NAME]; /* of the contact, or empty */
  char verdict[24];         /* of the solution, in words */
  bool one_orbit;           /* the transient runs on the solution's orbit: else the two are not held together */
  hc_status hbm_status, transient_status;
  contact_period hbm, transient; /* by the exact law along the solution; by the transient's own. Valid where HC_OK */
  /* [1] |difference| of the work, relative to the largest of any contact on either side; of the least normal force,
   * to this contact's largest, NaN where a slider is free: N may be a matter of history then. NaN: not known. */
  double work_error, normal_error;
  bool differs; /* one orbit, and an error beyond the gate's waveform, or one side never touches */
} contact_comparison;

/* In c[n], all contacts of one solution, filled so far but for the last three; `contacts` are the model's, where a pair
 * is two. allowed: [1] what an error may be.
 * Where no contact dissipates more than 1e-6 of what its spring holds, work is measured by that: nobody measures a loss
 * factor below. Stick and slip are told apart by the work alone: a graze is no disagreement. */
void contact_comparison_judge(int n, const model_contact *contacts, double allowed, bool mean_free,
                              contact_comparison *c);

/* Are the two sides held together: does `differs` say something? */
bool contact_comparison_made(const contact_comparison *c);

/* One line of a contact that differs into text, returned: "contact slider: stick by HBM, slip by the transient; work 0
 * and 0.3", "contact slider: work 1.2 by HBM, 1.4 by the transient, 14 % of the largest apart: so is the damping". */
enum { CONTACT_COMPARISON_TEXT = 192 };
const char *contact_comparison_text(const contact_comparison *c, char text[CONTACT_COMPARISON_TEXT]);

/* ---- one comparison ---- */

/* Never a bare number: what a comparison can come to. Names: docs/interface.md, 4. */
#define VERDICT_LIST(X)                                                                                                \
  X(VERDICT_MATCH, "match", "every error is within the gate")                                                          \
  X(VERDICT_DIFFERS, "differs", "same orbit, but an error is beyond the gate")                                         \
  X(VERDICT_OTHER_BRANCH, "other_branch",                                                                              \
    "the transient runs on another orbit than the one next to this HBM solution")                                      \
  X(VERDICT_UNSTABLE, "unstable", "this HBM solution is unstable: no motion stays there")                              \
  X(VERDICT_PERIOD_K, "period_k", "the transient repeats only after k forcing periods")                                \
  X(VERDICT_APERIODIC, "aperiodic", "the transient never repeats: it is chaotic, or runs on a torus")                  \
  X(VERDICT_NOT_SETTLED, "not_settled", "the transient found no steady state in max_periods")                          \
  X(VERDICT_SOLVER_FAILED, "solver_failed", "one of the solvers gave up")                                              \
  X(VERDICT_UNBOUNDED, "unbounded", "the motion grows without bound")                                                  \
  X(VERDICT_CREEPS, "creeps", "the body slides on by `drift` each period")                                             \
  X(VERDICT_UNDECIDED, "undecided",                                                                                    \
    "not known whether HBM is wrong: no orbit was found next to its solution; try more harmonics")                     \
  X(VERDICT_FAMILY, "family",                                                                                          \
    "within the gate, but one of many steady states: where sliders rest moves the amplitude by more than the gate")
#define VERDICT_ENUM(code, name, meaning) code,
typedef enum verdict { VERDICT_LIST(VERDICT_ENUM) VERDICT_COUNT } verdict;
#undef VERDICT_ENUM
const char *verdict_name(verdict v); /* "period_k" for all k; a row's own is comparison_verdict_text */
const char *verdict_meaning(verdict v);

typedef struct comparison_row {
  int response; /* of the model, counted from 0: a row for each; what is said of the first is said of the solution */
  char response_name[RESPONSE_NAME]; /* in words, where it has been given one; else empty */
  bool still;                        /* it moves less than 1e-9 of the largest, and is not compared */
  /* A slider never slips while another contact changes its state: where it rests then decides on all of the motion, and
   * the steady states are a family. HBM is held against a member that begins with its own sliders, which is near its
   * own, and no farther than a gate can say; predictions know nothing of that. */
  bool family;
  double omega;
  int branch;           /* of the HBM solution; -1: HBM has none here */
  enum verdict verdict; /* `enum`, because C++ wants to know */
  hc_status hbm_status, transient_status;
  hbm_stability stability;  /* of the HBM solution; multiplier NaN: unknown, not needed (setup.multipliers) */
  bool accounted;           /* the transient is within the gate of this or another HBM solution */
  bool beside;              /* of one that the curve has not come to: Newton found it from the transient */
  hbm_measures hbm;         /* valid when hbm_status is HC_OK */
  timeint_result transient; /* valid when motion_is_measured(transient_status) */
  hc_status orbit_status;
  timeint_result orbit;     /* the referee's, valid when orbit_status is HC_OK */
  discrepancy orbit_errors; /* of the HBM solution against that orbit, NaN without it */
  error_budget budget;      /* what the discrepancy is made of */
  discrepancy errors;       /* of the HBM solution against the transient, NaN where there is nothing to compare */
  /* What each side expects of itself, relative to its own amplitude; `mean` is not predicted. NaN: not known. */
  discrepancy hbm_predicted, transient_predicted;
  bool unexpected; /* comparison_unexpected() */
  int others;      /* other motions at this omega that drawn starts come to (setup.survey); -1: not asked */
  band band;       /* of the steady states that differ by where sliders rest that never slip */
} comparison_row;

enum { COMPARISON_ADVICE_TEXT = 192 };

/* What a comparison took: nothing is solved twice. */
typedef struct comparison_cost {
  long hbm_solves;  /* systems that Newton was put to, the curve's included */
  long periods;     /* forcing periods integrated by CVODE */
  long closed_form; /* and in closed form */
} comparison_cost;

typedef struct comparison {
  int n_rows, n_contacts;
  comparison_row *rows;
  contact_comparison *contacts; /* with setup.contacts: every contact of every solution that has rows, in that order */
  hbm_curve curve;              /* the response curve behind the rows; its `end` says how far it came */
  int count[VERDICT_COUNT];
  response_summary summary; /* of that curve */
  int n_states;             /* in a state of time integration */
  double *states;           /* [n_rows][n_states] of each row: where the transient ended */
  comparison_cost cost;
  survey survey; /* with setup.survey: all motions at these frequencies; solutions that it led to have rows, too */
  int harmonics, samples;              /* in use: for auto, the most the curve needed; samples 0 for exact forces */
  char advice[COMPARISON_ADVICE_TEXT]; /* with setup.advise: what brings comparison_worst within the gate, as tried */
} comparison;

/* Compare at the frequencies of *setup (compare.omega, or compare.points chosen along the curve). Rows found before an
 * interrupt or failure stay. HC_OK though rows failed: verdicts say so. comparison_clear in any case. */
hc_status comparison_run(const compare_setup *setup, const hc_monitor *monitor, comparison *out);
void comparison_clear(comparison *c);

/* Is a quantity of the row beyond its limit: against what its budget is, of one that differs against the transient? */
bool comparison_row_is_beyond(const comparison_row *row, const gate_limits *limits);

/* The row whose budget is farthest beyond, or nearest to, the gate; of those that differ, if any. NULL: none. */
const comparison_row *comparison_worst(const comparison *c, const gate_limits *limits);

/* "amplitude 4.1 %: truncation (97 %); use hbm.harmonics >= 14", in text[COMPARISON_WORST_TEXT], returned. */
enum { COMPARISON_WORST_TEXT = BUDGET_TEXT + COMPARISON_ADVICE_TEXT + 2 };
const char *comparison_worst_text(const comparison *c, const comparison_row *worst, const gate_limits *limits,
                                  char text[COMPARISON_WORST_TEXT]);

/* "match", "period_2", ...: the row's verdict in text[24], which is returned. */
const char *comparison_verdict_text(const comparison_row *row, char text[24]);

/* Is every error within the gate: `match` or `family`? */
bool comparison_agrees(const comparison_row *row);

/* Does the row compare two descriptions of one orbit: these, or `differs`? */
bool comparison_one_orbit(const comparison_row *row);

/* Is it known where the transient went, and no HBM solution is there? */
bool comparison_unaccounted(const comparison_row *row);

/* Is the mean of what the row's HBM solution was held against, or, where that is not known, of the solution itself,
 * open: a slider never slips, and where it rests is a matter of history? Such means are not compared. */
bool comparison_mean_free(const comparison_row *row);

/* Does a contact change its state, in any row, on either side? If not, two linear responses were compared; true
 * where nothing was. */
bool comparison_nonlinear(const comparison *c);
#define COMPARISON_LINEAR /* the remark, with the number of rows */                                                    \
  "nothing nonlinear was compared: no contact changes its state in any of the %d rows; are the gap's sign, the angle " \
  "in degrees and the force right?"

/* Both ran on one orbit (match or differs, period 1) and differ in amplitude or waveform by more than COMPARISON_SLACK
 * times what both predicted: neither expected that. False without a prediction, and of a family. */
enum { COMPARISON_SLACK = 3 };
bool comparison_unexpected(const comparison_row *row);

/* "observed amplitude error 0.02 is above what both predicted (HBM 1e-05, transient 2e-06): something is wrong that
 * neither expected". One line in text[COMPARISON_UNEXPECTED_TEXT], which is returned; of a row that is unexpected. */
enum { COMPARISON_UNEXPECTED_TEXT = 192 };
const char *comparison_unexpected_text(const comparison_row *row, char text[COMPARISON_UNEXPECTED_TEXT]);

/* 0 agreed; 1 a transient differs from every HBM solution, or in period; 3 something could not be compared. */
int comparison_exit_code(const comparison *c);

/* A state on the transient's orbit of row i; meaningful where transient_status is HC_OK. */
const double *comparison_state(const comparison *c, int i);
