/* budget.h - what the discrepancy of one HBM solution is made of. Each part is the distance between two solutions that
 * differ in one cause only:
 *
 *     h     the HBM solution                    from_aliasing        |h - hx|
 *     hx    the same H, exact forces            from_truncation      |hx - O|
 *     O     the exact law's periodic orbit      from_regularisation  |O - T'|
 *     T'    the transient's law, finer steps    from_integration     |T' - T| - from_settling, at least 0
 *     T     the transient                       from_settling        its estimated distance to its own orbit
 *
 * The parts are sizes without signs: where two of opposite sign cancel, their sum is larger than |h - T|. Where the
 * transient is not on the orbit next to h, the budget is that of |h - O|, and only the first two parts exist. Of a
 * family of steady states (comparison_row.family) |O - T'| is the distance between two of its members, whatever the
 * law. All are relative to the transient's amplitude (to O's without it). NaN: not there, or could not be computed. */
#pragma once

#include "compare/compare_settings.h"
#include "compare/discrepancy.h"
#include "hbm/hbm.h"
#include "timeint/steady/steady.h"

#define BUDGET_PARTS(X) X(aliasing) X(truncation) X(regularisation) X(integration) X(settling)
enum { BUDGET_N_PARTS = 5 };

/* The parts of one measure's error. */
typedef struct budget_parts {
#define BUDGET_MEMBER(name) double name;
  BUDGET_PARTS(BUDGET_MEMBER) /* [1] */
#undef BUDGET_MEMBER
  double sum, observed; /* [1] of those that are there; what they are to account for */
} budget_parts;

typedef struct error_budget {
  budget_parts amplitude, harmonic_1, mean,
      waveform;     /* |difference| of (max - min)/2, of |a1 + i b1|, of the means (NaN
                                                         observed: free), largest of x over the period */
  double reduction; /* [1] how far the stated error of a reduced model moves the amplitude (hbm_predict_reduction): both
                       sides share it, so that it is no part of what lies between them */
  bool known;       /* there is an observed discrepancy */
  bool against_transient; /* it is |h - T|; else |h - O| */
  bool family;            /* `regularisation` is the distance between members */
} error_budget;

/* Nothing known. */
error_budget budget_nothing(void);

/* What a budget is made from. */
typedef struct budget_case {
  double omega;
  int n_harm;                    /* of the solution */
  const double *X;               /* of the solver's coefficients */
  const periodic_motion *motion; /* [responses] of X: of an oscillator x */
  hc_status transient_status, orbit_status;
  const timeint_result *transient, *orbit; /* [responses] valid where the status is HC_OK */
  const double *state;                     /* [timeint_n_states] on the transient's orbit */
  bool family;                             /* of steady states */
  timeint *by;                             /* which found it: what it knows in closed form is used again; may be NULL */
} budget_case;

/* Workspace for the solutions between h and T; one a thread. What it needs is made when it is needed. */
typedef struct budgeter budgeter;
hc_status budgeter_new(const compare_setup *setup, budgeter **out);
void budgeter_free(budgeter *b);

/* Adds what it has solved and integrated so far. */
void budgeter_count(const budgeter *b, long *hbm_solves, long *periods, long *closed_form);

/* out[responses]. Which solutions lie between is decided by the response that moves most. HC_OK, also where parts could
 * not be had; HC_INTERRUPTED, HC_NO_MEMORY. */
hc_status budgeter_run(budgeter *b, const budget_case *from, const hc_monitor *monitor, error_budget *out);

/* Are the two the same orbit: as many periods, nowhere farther apart than a twentieth of the amplitude, and not one
 * stable, the other not? Laws and integrations differ by far less, branches by more. */
#define BUDGET_SAME_ORBIT 0.05 /* [amplitude] */
bool budget_same_orbit(const timeint_result *a, const timeint_result *b);

/* |difference of amplitudes|, relative, of a transient and the exact law's orbit; NaN: not the same orbit. */
double budget_regularisation(const timeint_result *tr, const timeint_result *orbit);

/* The part that is largest in amplitude, "aliasing", ..., "family", and its share of the sum; NULL: there is none. */
const char *budget_largest(const error_budget *b, double *share);

/* What is farthest beyond its limit, or nearest to it. */
typedef struct budget_worst {
  const char *quantity;      /* "amplitude", "harmonic_1", "mean", "waveform"; NULL: nothing is known */
  const budget_parts *parts; /* of b */
  double ratio;              /* [1] observed/limit; > 1: beyond it */
} budget_worst;
budget_worst budget_find_worst(const error_budget *b, const discrepancy *limits);

/* "amplitude 4.1 %: truncation (97 %)", "...; within the gate", in text[BUDGET_TEXT], which is returned. */
enum { BUDGET_TEXT = 160 };
const char *budget_text(const error_budget *b, const discrepancy *limits, char text[BUDGET_TEXT]);
