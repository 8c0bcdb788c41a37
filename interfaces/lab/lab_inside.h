/* lab_inside.h - what the parts of the lab share: its case, the table of the last answer, the curves it keeps. */
#pragma once

#include "compare/output/rows.h"
#include "hbm/hbm.h"
#include "interfaces/lab/lab.h"
#include "model/casefile/case_file.h"

enum { LAB_FORCES = 2, LAB_MOST_COEF = 2 * HBM_MAX_HARMONICS + 1 };

typedef struct lab_kept {
  hbm_solver *solver; /* as the trace left it; NULL: nothing was traced */
  hbm_curve curve;
} lab_kept;

struct lab {
  bool has_case;
  scene sc; /* an oscillator */
  char message[CASE_MESSAGE];
  int rows, columns;
  double *values; /* [rows][columns] */
  int n_named;    /* columns of results; 0: the table has others */
  table_column named[ROWS_MOST];
  int n_words;
  char (*words)[ROWS_TEXT]; /* [n_words] texts of the table, each once */
  lab_kept kept[LAB_FORCES];
  int n_harm; /* of the motion; 0: there is none */
  double X[LAB_MOST_COEF];
};

/* An empty table of so many columns. */
void lab_begin(lab *l, int columns);

/* An empty table of results of that kind; series: the numbers of its longest series, 0 where the kind has none. */
void lab_begin_results(lab *l, rows_kind kind, int series);

/* One more row of them: *of as of rows_cells. HC_NO_MEMORY. */
hc_status lab_add_result(lab *l, rows_kind kind, const void *of);

/* One more row, of NaN; NULL: out of memory. It may move with the next one. */
double *lab_row(lab *l);

/* One more row that begins with numbers[n]. HC_NO_MEMORY. */
hc_status lab_add(lab *l, size_t n, const double *numbers);
#define LAB_ADD(l, ...) lab_add(l, sizeof((double[]){__VA_ARGS__}) / sizeof(double), (double[]){__VA_ARGS__})

/* What a question returns for st. */
int lab_answer(lab *l, hc_status st);

/* The case with its contact forces as asked. HC_BAD_INPUT: there is no case, or no such force. */
hc_status lab_scene(const lab *l, int force, scene *out);

/* The exact law for its transients: in closed form where it has one, else by CVODE. */
void lab_exact_law(scene *sc);

/* A solver of it. Errors of hbm_solver_new. */
hc_status lab_solver(const scene *sc, hbm_solver **out);
