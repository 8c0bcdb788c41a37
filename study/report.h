/* report.h - what one reads of a study's results: a summary, and all of it as csv or json. */
#ifndef HC_STUDY_REPORT_H
#define HC_STUDY_REPORT_H

#include "output/table.h"
#include "study/store.h"

typedef struct study_summary {
  long done, failed;
  double seconds;          /* of computing, all threads together */
  double exact_seconds;    /* of these, by scenes with exact forces */
  long first_failed;       /* scene, or -1 */
  char reason[STUDY_TEXT]; /* of that one */
} study_summary;

hc_status study_summarise(const study *s, study_store *store, study_summary *out);

/* The columns of the table of verdicts, and a row for each verdict of the study into it. */
const table_column *study_verdict_columns(int *n);
hc_status study_verdicts(const study *s, study_store *store, table *t);

/* Every scene with its rows (a scene without any is one line), by scene and then by the rows' order: the same bytes
 * whatever computed them, unless `timings` asks for the seconds of each scene. response: of a structure, the rows of
 * this one alone; NULL: all. csv or json; HC_IO once the stream has failed. */
hc_status study_export(const study *s, study_store *store, table_format format, bool timings, const char *response,
                       FILE *to);

#endif
