/* gate.h - is this HBM result within the limits of its case file? Pass or fail, for scripts. The header of this folder.
 *
 * What each HBM solution of a comparison is held against:
 *     verdict match, differs                          the transient, which runs next to it
 *     unstable, other_branch, period_k, aperiodic     the exact law's orbit next to it (comparison.h's referee),
 *                                                     within the same limits; and the transient, wherever it went,
 *                                                     must match some HBM solution at its omega
 *     not_settled, solver_failed                      nothing: an error, and so is an orbit that was not found, and
 *                                                     a curve that stopped
 * The mean is not applicable where a slider never slips: it depends on the history there, not on the equations alone.
 * Each response of a structure is held to the limits by itself, relative to its own amplitude; one that hardly moves
 * (comparison.h: still) is not applicable.
 * If no contact changes its state in any row, the case is linear, which gate.nonlinear: required does not let pass. The
 * limits: gate_limits_at.
 *
 * A number passes if found <= allowed (1 + GATE_SLACK); costs, being whole numbers, if found <= allowed. Rounding on
 * another machine changes numbers by far less than GATE_SLACK, so it changes a verdict only where a limit is equal to
 * what is found within that. Nothing is printed. Not here: how the two sides are compared (compare/comparison.h). */
#pragma once

#include <stdbool.h>
#include <stdio.h>

#include "compare/compare_settings.h"
#include "compare/comparison.h"
#include "numerics/base/status.h"

#define GATE_SLACK 1e-6 /* [1] of the limit */

/* GATE_ERROR: there was nothing to hold it against; GATE_NOT_APPLICABLE: the quantity has no value to be held to */
typedef enum gate_result { GATE_PASS, GATE_FAIL, GATE_ERROR, GATE_NOT_APPLICABLE } gate_result;
const char *gate_result_name(gate_result r); /* "pass", "fail", "error", "not_applicable" */

enum { GATE_REASON = 160 };

typedef struct gate_check {
  double omega;          /* [rad/time] NaN: about the response curve as a whole */
  int branch;            /* of the HBM solution; -1: about none */
  int response;          /* of the model, counted from 0; -1: about the curve */
  char verdict[24];      /* of the comparison's row, empty for the curve */
  const char *quantity;  /* "amplitude", "harmonic_1", "mean", "waveform", "transient" (matched by some HBM
                           solution?), "proven", "orbit" and "solution" (errors only), of the curve: "curve" (an error),
                           "iterations", "evaluations", "nonlinear" */
  const char *against;   /* "transient", "orbit" or "limit"; NULL: nothing */
  double allowed, found; /* NaN where there are none */
  gate_result result;
  char reason[GATE_REASON]; /* in words; empty where the two numbers say it, and for what passes */
} gate_check;

typedef struct gate_case {
  const char *name;                       /* the caller's: of the case file */
  const char (*responses)[RESPONSE_NAME]; /* the caller's, NULL until it sets them: names of a structure's responses */
  int n;
  gate_check *checks; /* [n] in the order of the comparison's rows, the curve last */
  int failures, errors, not_applicable;
  int n_rows;        /* of the comparison */
  bool linear;       /* no contact changed its state in any of them */
  double seconds;    /* of processor time that gate_run took */
  const char *wrong; /* the caller's, where the case file is wrong: what is; then there are no checks, and one error */
  bool in_cycles;    /* of the limits: frequencies are named in cycles per time */
} gate_case;

/* Compare, then judge. HC_OK whatever the checks say, also where no solver could begin: then "comparison" is an error.
 * HC_INTERRUPTED, HC_NO_MEMORY keep what was found. gate_clear in any case. */
hc_status gate_run(const char *name, const compare_setup *setup, const hc_monitor *monitor, gate_case *out);

/* The second half: the checks of a comparison of setup. HC_NO_MEMORY. */
hc_status gate_judge(const char *name, const compare_setup *setup, const comparison *c, gate_case *out);
void gate_clear(gate_case *g);

/* A check more, for gate.proven: of a solution at omega (branch -1: a steady state beside them) whose orbit is proven,
 * to a relative `error` of its amplitude (NaN: another orbit of a family); or is not, why in words. */
hc_status gate_add_proof(gate_case *g, const compare_setup *setup, double omega, int branch, const char *unproven,
                         double error);

/* The name of the response that the check is about; NULL: about none, or they have no names. */
const char *gate_response(const gate_case *g, const gate_check *c);

/* Found, to 3 digits or as many as show its side of the limit; 0 below GATE_SLACK of it. */
double gate_shown(const gate_check *c);

/* Is check i its quantity's nearest to the limit, or farthest beyond? Not applicable ones count last. */
bool gate_is_worst(const gate_case *g, int i);

/* Exit code (docs/interface.md, 5): 1 if a check failed, else 3 if one is an error, else 0. */
int gate_exit_code(int n, const gate_case *cases);

/* The case file is wrong, in the caller's words. */
gate_case gate_of_wrong_case(const char *name, const char *wrong);

/* The checks as JUnit XML: a testsuite a case, with its processor time, a testcase a check, <failure> and <error>; of a
 * wrong case file a testcase "case file". HC_IO, HC_NO_MEMORY. */
hc_status gate_write_junit(int n, const gate_case *cases, FILE *to);
