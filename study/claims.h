/* claims.h - the claims of a study file, checked against its results by SQL. The queries cannot write. */
#ifndef HC_STUDY_CLAIMS_H
#define HC_STUDY_CLAIMS_H

#include "output/table.h"
#include "study/store.h"

/* Verdicts by kind of answer (STUDY_PLAIN, ...). */
typedef struct study_claims_tally {
  int agree[STUDY_ANSWERS], disagree[STUDY_ANSWERS], unsaid[STUDY_ANSWERS];
  int unexpected; /* not as `expect` says */
} study_claims_tally;

/* Claims answered once; those answered with the settings of their source and with ours; those of them that are answered
 * in fixed steps too; seconds, where a claim has some. */
enum { STUDY_CLAIMS, STUDY_SIDES, STUDY_STEPS, STUDY_SECONDS, STUDY_CLAIM_TABLES };
const table_column *study_claims_columns(int which, int *n);

/* Can every query be run? Held against empty tables, before anything is computed. HC_BAD_INPUT with
 * "FILE:LINE:COLUMN: ..." in err. */
hc_status study_claims_check(const study *s, case_error *err);

/* Evaluate; one row a claim into each table it belongs to. `stop` ends a query that takes too long: HC_INTERRUPTED. */
hc_status study_claims_run(const study *s, study_store *store, const hc_monitor *stop,
                           table *const t[STUDY_CLAIM_TABLES], study_claims_tally *tally, case_error *err);

#endif
