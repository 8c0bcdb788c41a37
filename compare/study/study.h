/* study.h - a sweep of any fields of a case: a file that says what varies, the grid of scenes it makes, and the way
 * from a scene's number to the scene. Format, schema and guarantees: study/README.md. Nothing is printed.
 *
 *     study_read -> study -> study_scene(id), 0 <= id < n_scenes, the last axis fastest */
#pragma once

#include <stdint.h>

#include "compare/output/rows.h"
#include "model/casefile/case_file.h"
#include "model/casefile/fields.h"

enum { STUDY_MOST_SCENES = 1000000, STUDY_TEXT = 256, STUDY_MOST_FIELDS = 512 /* set or varied */ };

typedef enum { STUDY_FRF, STUDY_TRANSIENT, STUDY_COMPARE } study_kind;
typedef enum { STUDY_EXPECT_NOTHING, STUDY_EXPECT_AGREE, STUDY_EXPECT_DISAGREE, STUDY_EXPECT_UNSAID } study_expectation;

/* One value as --set would be given it, numbers in their shortest form; where it stands in the study file. */
typedef struct study_value {
  char *text;
  size_t line, column;
} study_value;

typedef struct study_field {
  const field *f;
  int contact; /* its number, or that of the load; -1 outside such lists */
  bool whole;  /* all contacts of its entry of pairs */
  char path[FIELD_PATH];
  size_t line, column;
  study_value *values; /* [axis.n] */
} study_field;

typedef struct study_axis {
  int n, n_fields;     /* values; fields that go together */
  study_field *fields; /* [n_fields] */
} study_axis;

/* Queries on the results, as the file has them; text is NULL if not given. */
typedef struct study_answer {
  study_value found, holds, seconds;
  study_expectation expect;
} study_answer;

/* A claim is answered once (STUDY_PLAIN), or with the settings of its source and with ours side by side; and, where the
 * continuation decides, with the source's settings followed in fixed steps (hbm.continuation: fixed_step). */
enum { STUDY_PLAIN, STUDY_PAPER, STUDY_OURS, STUDY_FIXED_STEP, STUDY_ANSWERS };
typedef struct study_claim {
  study_value source, says, reported; /* reported: seconds that the source gives */
  double seconds;                     /* the same as a number, NaN if not given */
  study_answer answers[STUDY_ANSWERS];
} study_claim;

/* A name for a query that the claims share. */
typedef struct study_view {
  study_value name, query;
} study_view;

typedef struct study {
  char *name;      /* of the file, for messages */
  char *base_name; /* of the base case's file; NULL: the case stands in the study */
  char title[STUDY_TEXT];
  study_kind kind;
  scene base; /* with `set` and --set applied */
  int n_axes, n_claims, n_views;
  study_axis *axes;
  study_claim *claims;
  study_view *views;
  bool may_fail; /* scenes that fail are part of what the study shows */
  long n_scenes;
  uint64_t fingerprint; /* of all that decides the results: not the title, not the claims */
} study;

/* Read `path` ("-" is standard input), its base case, and apply the n_set assignments of the command line to it.
 * HC_OK and *out, or HC_BAD_INPUT / HC_IO / HC_NO_MEMORY with err filled and *out NULL. */
hc_status study_read(const char *path, int n_set, const char *const *set, study **out, case_error *err);
void study_free(study *s);

/* Scene number id, to clear with case_clear. HC_BAD_INPUT, err filled: its fields do not go together. */
hc_status study_scene(const study *s, long id, scene *out, case_error *err);

/* Which value of axis `axis` scene id has, 0..n-1. */
int study_index(const study *s, long id, int axis);

/* Do results have columns of frequencies in cycles per time? If the base's sweep, or any that varies, is in cycles. */
bool study_in_cycles(const study *s);

/* "frf", "transient", "compare" */
const char *study_kind_name(study_kind kind);

/* ---- one scene computed (solve.c): how it ended, the response curve in a few numbers, the rows of its kind ---- */

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

/* By any thread. HC_OK (failures are in the result); HC_INTERRUPTED, HC_NO_MEMORY: none. study_result_clear always. */
hc_status study_solve(const study *s, long id, const hc_monitor *monitor, study_result *out);
void study_result_clear(study_result *r);

/* As bytes, to send to a process of the same program: packed is to be freed. */
hc_status study_result_pack(const study_result *r, char **packed, size_t *size);
hc_status study_result_unpack(const char *packed, size_t size, study_result *out);
