/* gate.h - checks an HBM result against the limits of its case file: pass or fail, for scripts.
 *
 * The reference of each HBM solution of a comparison:
 *     verdict match, differs                          the transient, which stays next to it
 *     unstable, other_branch, period_k, aperiodic     the exact law's orbit next to it (comparison.h's referee),
 *                                                     within the same limits; and the transient, wherever it went,
 *                                                     must match some HBM solution at its omega
 *     not_settled, solver_failed                      nothing: an error, and so is an orbit that was not found, and
 *                                                     a curve that stopped
 * The mean is not applicable where a slider never slips: it depends on the history there, not on the equations alone.
 * Each response of a structure is checked separately, relative to its own amplitude; for one that hardly moves
 * (comparison.h: still) checks are not applicable. If no contact changes its state in any row, the case is linear and
 * fails with gate.nonlinear: required. The limits: gate_limits_at.
 *
 * A number passes if found <= allowed (1 + GATE_SLACK); costs, being whole numbers, if found <= allowed. Rounding on
 * another machine changes numbers by far less than GATE_SLACK, so it changes a result only if limit and value agree
 * within that. Nothing is printed. Not here: the comparison of the two sides (compare/comparison.h). */
#pragma once

#include <stdbool.h>
#include <stdio.h>

#include "compare/compare_settings.h"
#include "compare/comparison.h"
#include "numerics/base/status.h"

#define GATE_SLACK 1e-6 /* [limit] tolerance of a check */

/* GATE_ERROR: there is no reference; GATE_NOT_APPLICABLE: the quantity has no defined value */
typedef enum gate_result { GATE_PASS, GATE_FAIL, GATE_ERROR, GATE_NOT_APPLICABLE } gate_result;
const char *gate_result_name(gate_result r); /* "pass", "fail", "error", "not_applicable" */

enum { GATE_REASON = 160 };

typedef struct gate_check {
  double omega;          /* [rad/time] NaN: a check of the whole response curve */
  int branch;            /* of the HBM solution; -1: none */
  int response;          /* of the model, counted from 0; -1: a check of the curve */
  char verdict[24];      /* of the comparison's row, empty for the curve */
  const char *quantity;  /* "amplitude", "harmonic_1", "mean", "waveform", "transient" (matched by some HBM solution?),
                            "proven", "orbit" and "solution" (errors only), of the curve: "curve" (an error),
                            "iterations", "evaluations", "nonlinear" */
  const char *against;   /* "transient", "orbit" or "limit"; NULL: nothing */
  double allowed, found; /* NaN: none */
  gate_result result;
  char reason[GATE_REASON]; /* text; empty if the two numbers tell the reason, and for GATE_PASS */
} gate_check;

typedef struct gate_case {
  const char *name;                       /* name of the case file; not owned */
  const char (*responses)[RESPONSE_NAME]; /* names of a structure's responses, set by the caller; not owned; NULL:
                                             none */
  int n;
  gate_check *checks; /* [n] in the order of the comparison's rows, the curve last */
  int failures, errors, not_applicable;
  int n_rows;        /* of the comparison */
  bool linear;       /* no contact changed its state in any of them */
  double seconds;    /* [s] processor time of gate_run */
  const char *wrong; /* reason if the case file is wrong; not owned; there are then no checks, and one error */
  bool in_cycles;    /* frequencies are shown in cycles per time, as the limits name them */
} gate_case;

/* Compares, then judges. HC_OK whatever the results, also if no solver could start: then the check "comparison" is an
 * error. HC_INTERRUPTED, HC_NO_MEMORY keep the checks made before. Call gate_clear in any case. */
hc_status gate_run(const char *name, const compare_setup *setup, const hc_monitor *monitor, gate_case *out);

/* The judging half of gate_run: the checks of a comparison of setup. HC_NO_MEMORY. */
hc_status gate_judge(const char *name, const compare_setup *setup, const comparison *c, gate_case *out);
void gate_clear(gate_case *g);

/* Adds a check for gate.proven, of a solution at omega (branch -1: another steady state). unproven: NULL if its orbit
 * is proven, with the relative `error` of the amplitude (NaN: another orbit of a family was proven); else the
 * reason. */
hc_status gate_add_proof(gate_case *g, const compare_setup *setup, double omega, int branch, const char *unproven,
                         double error);

/* The name of the check's response; NULL: none, or responses have no names. */
const char *gate_response(const gate_case *g, const gate_check *c);

/* The value found, rounded to 3 digits or as many as show on which side of the limit it is; 0 below GATE_SLACK of the
 * limit. */
double gate_shown(const gate_check *c);

/* True if check i is the worst of its quantity: farthest beyond the limit, or nearest to it. Not applicable ones rank
 * last. */
bool gate_is_worst(const gate_case *g, int i);

/* Exit code (docs/interface.md, 5): 1 if a check failed, else 3 if one is an error, else 0. */
int gate_exit_code(int n, const gate_case *cases);

/* The result for a wrong case file, with the caller's reason. */
gate_case gate_of_wrong_case(const char *name, const char *wrong);

/* The checks as JUnit XML: a testsuite for each case, with its processor time, a testcase for each check, <failure> and
 * <error>; for a wrong case file a testcase "case file". HC_IO, HC_NO_MEMORY. */
hc_status gate_write_junit(int n, const gate_case *cases, FILE *to);
