/* cluster.h - a study shared between processes started together by mpirun (CMake option HBMCHECK_MPI; cluster_none.c
 * without it). Rank 0 has the store and hands out scenes, the others compute them, each one at a time. Call from the
 * main thread. */
#pragma once

#include "study/study.h"

/* Once, first: how many processes there are, and which this one is. false: several copies were started by mpirun, but
 * this build has no MPI, and each would compute the whole study. */
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
