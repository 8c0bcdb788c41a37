/* scores.h - results of the suite, between cmd_suite.c and the page it draws (score_page.c). */
#pragma once

#include <stdio.h>

#include "compare/suite/suite.h"
#include "numerics/base/status.h"

/* What one program has of the suite. */
typedef struct scores {
  const char *program;
  suite_answer *answers;      /* [n of the suite] */
  suite_score *scores;        /* [n] */
  char (*causes)[SUITE_TEXT]; /* [n] why digits are missing; empty: not asked, or no cause */
  double digits;              /* a case passes with so many everywhere */
  int passed;                 /* cases */
  double total;               /* 0..100: the mean of all cases' points */
} scores;

/* A self-contained HTML page: what was scored, a picture, a table. HC_IO. */
hc_status scores_page(const suite *s, int n_programs, const scores *all, const char *why, FILE *to);

/* "hbmcheck suite 1.0 | 78 of 80, score 91.2" as SVG. HC_IO. */
hc_status scores_badge(const suite *s, const scores *one, FILE *to);
