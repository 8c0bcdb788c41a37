/* store.h - the results of a study in an SQLite file: tables study, scene and row (study/README.md).
 *
 * One scene is one transaction (WAL, synchronous NORMAL): a process killed at any moment leaves whole scenes, each
 * once; a machine that loses power may lose the last of them, which are then computed again. One process at a time
 * writes: an flock on the file, gone with the process. A file that is not the results of this very study is refused
 * unchanged. One thread at a time. */
#ifndef HC_STUDY_STORE_H
#define HC_STUDY_STORE_H

#include <sqlite3.h>

#include "study/solve.h"

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

/* Give a query a name, for this connection only: nothing is written to the file. `select` is one SELECT. HC_IO:
 * study_store_error tells. */
hc_status study_store_view(study_store *st, const char *name, const char *select);

#endif
