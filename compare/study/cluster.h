/* cluster.h - a study shared between processes of one mpirun (CMake option HBMCHECK_MPI; else cluster_none.c). Rank 0
 * has the store and hands out scenes, which the others compute one by one. Call from the main thread. */
#pragma once

#include "compare/study/study.h"

/* Once, first: how many processes, and which one this is. false: mpirun started several, but this build has no MPI. */
bool cluster_start(int *rank, int *size);
void cluster_end(void);

/* The largest of what the processes say, to all. */
int cluster_agree(int code);

/* Rank 0's side: next_scenes() writes up to `most` scene numbers into ids; store() gets a packed result. */
typedef struct cluster_desk {
  int (*next_scenes)(void *self, int most, long *ids);
  void (*store)(void *self, const char *packed, size_t size);
  void *self;
} cluster_desk;

/* Answer the processes that are asking now; does not wait for others. true: some process is still at work. */
bool cluster_serve(const cluster_desk *desk);

/* The other ranks' side: compute what rank 0 hands out until there is no more. */
void cluster_work(const study *s, const hc_monitor *monitor);
