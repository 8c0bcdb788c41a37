/* room.h - a test for free memory before calls into libraries that crash or abort when an allocation fails:
 *   SUNDIALS 6.4  N_VClone writes through the NULL it gets; SUNContext_Create frees its logger's table twice;
 *   SUNDIALS 7.1  tells of a failure in a text that it allocates, and writes through NULL where that fails, too: every
 *                 constructor (N_VNew_Serial, SUNMatNewEmpty, SUNLinSol_Dense, CVodeCreate, ...), KINSol, CVode;
 *   FFTW's planner aborts.
 * They take far less than is tested for, so a process at its limit gets HC_NO_MEMORY instead.
 *
 * Effect: in tests/faults/test_memory.c, where memory runs out while a solver is made, commands end with a message and
 * exit 3 at all limits; without the test commands end by a signal in 7 of its 8 tests, at some of the 60 limits of each
 * (Debian 12: SUNDIALS 6.4.1, FFTW 3.3.10). Not covered: memory taken by another thread between test and call, and the
 * kernel's out-of-memory killer. */
#pragma once

#include <stdbool.h>
#include <stdlib.h>

enum { HC_ROOM_LIBRARY = 256 * 1024 }; /* [bytes] bound of such a call's need, without the caller's `bytes` */

static inline bool hc_room_for(size_t bytes)
{
  void *volatile probe = malloc(HC_ROOM_LIBRARY + bytes); /* volatile: a compiler may leave out a pair of malloc and
                                                             free */
  bool there = probe != NULL;
  free(probe);
  return there;
}
