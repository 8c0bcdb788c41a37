/* solve.h - one scene of a study computed: how it ended, the response curve in a few numbers, the rows of its kind. */
#ifndef HC_STUDY_SOLVE_H
#define HC_STUDY_SOLVE_H

#include "output/rows.h"
#include "study/study.h"

typedef struct study_result {
  long id;
  bool failed; /* something could not be solved: reason says what; what was found all the same is there */
  char reason[STUDY_TEXT];
  double seconds; /* of this thread's processor time */
  unsigned extra; /* study_extra_columns */
  bool has_curve;
  row_cell curve[ROWS_MOST];
  int n_rows, n_columns; /* columns of the study's kind */
  row_cell *rows;        /* [n_rows][n_columns] */
} study_result;

/* The kind of the rows of a study, and which columns of rows.h that only some cases have its results have. */
rows_kind study_rows(const study *s);
unsigned study_extra_columns(const study *s);

/* Compute scene id. HC_OK (single failures are in the result), HC_INTERRUPTED or HC_NO_MEMORY: no result then. Free
 * with study_result_clear in any case. Safe from several threads. */
hc_status study_solve(const study *s, long id, const hc_monitor *monitor, study_result *out);
void study_result_clear(study_result *r);

/* As bytes, to send to a process of the same program: packed is to be freed. */
hc_status study_result_pack(const study_result *r, char **packed, size_t *size);
hc_status study_result_unpack(const char *packed, size_t size, study_result *out);

#endif
