/* run.h - the scenes of a study that are not there yet, computed by several threads (and, under MPI, by several
 * processes) and kept. */
#ifndef HC_STUDY_RUN_H
#define HC_STUDY_RUN_H

#include "study/store.h"

/* Called by the calling thread some ten times a second: of `scenes`, `done` are there, `now` of them since the
 * start. false: stop. */
typedef struct study_watch {
  bool (*tick)(void *self, long done, long now, long scenes);
  void *self;
} study_watch;

/* Compute and keep. HC_OK: every scene is there; HC_INTERRUPTED: stopped by the watch, scenes in flight were given
 * up; HC_NO_MEMORY; HC_IO: a scene could not be kept. What was kept stays in any case; *now is how many scenes that
 * is, *there how many in all. */
hc_status study_run(const study *s, study_store *store, int jobs, const study_watch *watch, long *now, long *there);

#endif
