/* suite.h - the published cases with references that are proven, and how many digits of them a program's results have.
 *
 *     suite.json, cases/NAME.json       cases: references, each an interval [low, high] of what the orbit has (read.c)
 *     a folder of csv files, or a json  results of a program: rows of omega and quantities (read.c)
 *     results against references        digits, points, what is missing (score.c)
 *     hbmcheck's own results            harmonic balance, exact or sampled forces (own.c)
 *
 * Formats and definitions: README.md. Nothing is printed. Not here: why digits are missing (compare/verify/). */
#pragma once

#include <stdio.h>

#include "compare/compare_settings.h"
#include "numerics/base/message.h"

/* What is held of the response x(t) = mean + a1 cos(omega t) + b1 sin(omega t) + ..., loads being cos(omega t);
 * amplitude = (max - min)/2. X(code, name) */
#define SUITE_QUANTITIES(X)    X(SUITE_AMPLITUDE, "amplitude") X(SUITE_MEAN, "mean") X(SUITE_A1, "a1") X(SUITE_B1, "b1")
#define SUITE_CODE(code, name) code,
enum { SUITE_QUANTITIES(SUITE_CODE) SUITE_N };
#undef SUITE_CODE
extern const char *const suite_quantity[SUITE_N];

enum { SUITE_TEXT = 256, SUITE_FULL = 9 /* digits for all points */, SUITE_MOST_ROWS = 10000 };

/* A solution at omega, as a reference knows it; low is NaN where the quantity is not asked (a slider's history). */
typedef struct suite_reference {
  double omega;
  bool proven;   /* inside a certificate; else of stated error */
  int stability; /* +1 stable, -1 unstable, 0 not known */
  double low[SUITE_N], high[SUITE_N];
} suite_reference;

/* A solution as a program has it; NaN: not given. */
typedef struct suite_row {
  double omega, value[SUITE_N];
  long line; /* of its file; 0: none */
} suite_row;

/* What a program says of a case. */
typedef struct suite_answer {
  bool there;
  int n;
  suite_row *rows;        /* [n] */
  char path[SUITE_TEXT];  /* of the file they are from, of json with the case in it */
  char wrong[SUITE_TEXT]; /* why it is refused, "FILE:LINE:COLUMN: ..."; empty: it is not */
  char note[SUITE_TEXT];  /* what was overlooked in it */
} suite_answer;

/* Digits of a solution; where row is NULL, it is missing. */
typedef struct suite_match {
  const suite_row *row;
  double digits[SUITE_N]; /* NaN: not asked */
} suite_match;

typedef struct suite_score {
  suite_match *matches; /* [n of the case] */
  double points;        /* [1] 0..1: of SUITE_FULL digits everywhere, or of as many as a reference has */
  double digits, mean;  /* the fewest of all solutions and quantities, and on average */
  int worst, quantity;  /* whose they are */
  int missing;          /* solutions without a row */
  int extra;            /* rows at its frequencies that are next to no solution */
} suite_score;

typedef struct suite_case {
  char *name, *group, *title, *tests, *goes_wrong;
  int harmonics; /* for harmonic balance with exact forces to have SUITE_FULL digits */
  int n;
  suite_reference *references; /* [n] by omega */
} suite_case;

typedef struct suite {
  char *version;
  int n;
  suite_case *cases; /* [n] */
} suite;

/* The suite in `folder`. HC_BAD_INPUT, HC_IO, HC_NO_MEMORY with why[SUITE_TEXT]; suite_clear in any case. */
hc_status suite_read(const char *folder, suite *out, char *why);
void suite_clear(suite *s);

/* A program's results of all cases into answers[s->n]: `path` is a folder with NAME.csv, or a json file. A case's file
 * that is refused says so in its answer. *strange: files or cases that the suite does not have, the first one's name in
 * why. HC_BAD_INPUT, HC_IO, HC_NO_MEMORY with why[SUITE_TEXT]. The rows are the caller's, to free in any case. */
hc_status suite_results_read(const char *path, const suite *s, suite_answer *answers, int *strange, char *why);

/* Our own solutions of the case of *setup, appended to *out: the response curve with few harmonics, then Newton with
 * the case's. HC_NO_MEMORY, HC_INTERRUPTED, or what failed first; what was found is kept. */
hc_status suite_solve(const compare_setup *setup, const suite_case *c, hbm_force force, const hc_monitor *monitor,
                      suite_answer *out);

/* Each solution with the nearest row at its omega, a row with one solution. HC_NO_MEMORY; free(out->matches). An answer
 * whose omegas are those asked for in cycles or revolutions per minute is refused: a->wrong. */
hc_status suite_judge(const suite_case *c, suite_answer *a, suite_score *out);

/* What the digits tell, into cause[SUITE_TEXT], which stays empty else: the sign of b1, some quantities alone
 * are off by far, or solutions are missing and the others have so many digits. */
void suite_tell(const suite_case *c, const suite_score *s, double digits, char *cause);

/* A message into why[SUITE_TEXT]. HC_BAD_INPUT. */
hc_status suite_say(char *why, const char *format, ...) __attribute__((format(printf, 2, 3)));
