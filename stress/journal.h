/* journal.h - results of a stress run, kept as they come: a text file, a line a scene, from which a run that was
 * killed goes on.
 *
 *     # hbmcheck stress 3, seed 1, 2 s          or: 3, structures of seed 1, 2 s, structures in space of ...
 *     # checks: force_exact_sampled ...       the names behind the columns and codes below, in their order
 *     # outcomes: skipped agreed ...
 *     # reasons: STRESS_NO_REASON STRESS_TRUNCATED ...
 *     # statuses: HC_OK HC_BAD_INPUT ...
 *     INDEX SECONDS  OUTCOME REASON STATUS ERROR BOUND SECONDS  (for each check)  .
 *
 * OUTCOME, REASON and STATUS are places in these lists, from 0. A line counts once its final dot and newline are there;
 * what a kill left of one is cut off. */
#ifndef HC_STRESS_JOURNAL_H
#define HC_STRESS_JOURNAL_H

#include "stress/stress.h"

typedef struct stress_journal stress_journal;

/* plan->journal, if any: its scenes that belong to the plan into results, *there of them. *out is NULL where there
 * is none to keep. HC_BAD_INPUT: it is no journal of this seed and these seconds, or is damaged; HC_UNSUPPORTED: its
 * version or its lists of names are not those of this program; HC_IO, HC_NO_MEMORY. What is refused is left
 * as it was. */
hc_status stress_journal_open(const stress_plan *plan, stress_result *results, long *there, stress_journal **out);

/* On disk when this returns HC_OK. */
hc_status stress_journal_add(stress_journal *j, const stress_result *r);
hc_status stress_journal_close(stress_journal *j);

#endif
