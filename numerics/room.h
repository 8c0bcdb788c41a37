/* room.h - is there memory? Asked before calls into libraries that crash or abort when an allocation of theirs fails:
 *   SUNDIALS 6.4  N_VClone writes through the NULL it gets; SUNContext_Create frees its logger's table twice;
 *   SUNDIALS 7.1  tells of a failure in a text that it allocates, and writes through NULL where that fails, too: every
 *                 constructor (N_VNew_Serial, SUNMatNewEmpty, SUNLinSol_Dense, CVodeCreate, ...), KINSol, CVode;
 *   FFTW's planner aborts.
 * They take far less than what is asked for here, so a process at its limit is told HC_NO_MEMORY instead.
 *
 * What that buys: in tests/faults/test_memory.c, with memory getting scarce once a solver is being made, all limits
 * end in words and exit 3; without the question, 7 of its 8 tests see commands end by a signal at some of the 60 limits
 * tried with each (Debian 12: SUNDIALS 6.4.1, FFTW 3.3.10). What another thread takes between question and call, and
 * the kernel's killing of a process that it had promised memory, cannot be helped. */
#pragma once

#include <stdbool.h>
#include <stdlib.h>

enum { HC_ROOM_LIBRARY = 256 * 1024 /* [bytes] what such a call may need, beside `bytes` that grow with its sizes */ };

static inline bool hc_room_for(size_t bytes)
{
  void *volatile probe = malloc(HC_ROOM_LIBRARY + bytes); /* volatile: a compiler may leave out a pair of malloc and
                                                             free */
  bool there = probe != NULL;
  free(probe);
  return there;
}
