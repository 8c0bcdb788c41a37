/* store.h - the results of a study in an SQLite file: tables study, scene and row (study/README.md); how they get
 * there, and what is read of them.
 *
 * One scene is one transaction (WAL, synchronous NORMAL): a process killed at any moment leaves whole scenes, each
 * once; a machine that loses power may lose the last of them, which are then computed again. One process at a time
 * writes: an flock on the file, gone with the process. A file that is not the results of this very study is refused
 * unchanged. One thread at a time. */
#pragma once

#include <sqlite3.h>

#include "compare/output/table.h"
#include "compare/study/study.h"

typedef struct study_store study_store;

/* Open or make `path`; ":memory:" keeps nothing. fresh: throw away results of another study or version that stand
 * there. HC_OK, or HC_BAD_INPUT, HC_IO with err saying "PATH: what is wrong, what to do" and *out NULL. */
hc_status study_store_open(const study *s, const char *path, const char *version, bool fresh, study_store **out,
                           case_error *err);
void study_store_close(study_store *st);

/* Which scenes are there: done[n_scenes]; *n is how many. */
hc_status study_store_done(study_store *st, unsigned char *done, long *n);

/* Keep one scene. HC_IO, HC_NO_MEMORY: it is not kept (disk full?), study_store_error tells. */
hc_status study_store_put(study_store *st, const study_result *r);
const char *study_store_error(const study_store *st);

/* HC_NO_MEMORY or HC_IO: which of them SQLite's last failure on this connection was. */
hc_status study_sql_status(sqlite3 *db);

/* For queries on the results; whatever is prepared from now on can only read. */
sqlite3 *study_store_readonly(study_store *st);

/* Names a SELECT, for this connection only. HC_IO: study_store_error tells. */
hc_status study_store_view(study_store *st, const char *name, const char *select);

/* ---- computed (run.c) ---- */

/* Called some ten times a second: of `scenes`, `done` are there, `now` since the start. false: stop. */
typedef struct study_watch {
  bool (*tick)(void *self, long done, long now, long scenes);
  void *self;
} study_watch;

/* Compute and keep. HC_OK: every scene is there; HC_INTERRUPTED: the watch stopped it, scenes in flight were given up;
 * HC_NO_MEMORY; HC_IO: one could not be kept. *now: scenes that it kept, in any case; *there: in all. */
hc_status study_run(const study *s, study_store *store, int jobs, const study_watch *watch, long *now, long *there);

/* ---- told (report.c) ---- */

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

/* ---- held against the claims of the study file (claims.c); its queries cannot write ---- */

/* Verdicts by kind of answer (STUDY_PLAIN, ...). */
typedef struct study_claims_tally {
  int agree[STUDY_ANSWERS], disagree[STUDY_ANSWERS], unsaid[STUDY_ANSWERS];
  int unexpected; /* not as `expect` says */
} study_claims_tally;

/* Claims answered once; with their source's settings and ours; in fixed steps too; with seconds. */
enum { STUDY_CLAIMS, STUDY_SIDES, STUDY_STEPS, STUDY_SECONDS, STUDY_CLAIM_TABLES };
const table_column *study_claims_columns(int which, int *n);

/* Can every query be run? On empty tables, before anything is computed. HC_BAD_INPUT, err filled. */
hc_status study_claims_check(const study *s, case_error *err);

/* Evaluate; one row a claim into each table it belongs to. `stop` ends a query that takes too long: HC_INTERRUPTED. */
hc_status study_claims_run(const study *s, study_store *store, const hc_monitor *stop,
                           table *const t[STUDY_CLAIM_TABLES], study_claims_tally *tally, case_error *err);
