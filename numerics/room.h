/* room.h - is there memory? Asked before calls into libraries that crash or abort when an allocation of theirs
 * fails: SUNDIALS up to 6.4 at least (N_VClone writes through the NULL it gets; SUNContext_Create frees its logger's
 * table twice) and FFTW's planner (abort). They take far less than what is asked for here, so a process at its limit
 * is told HC_NO_MEMORY instead; what another thread takes in between, and the kernel's killing of a process that it
 * had promised memory, cannot be helped. */
#ifndef HC_ROOM_H
#define HC_ROOM_H

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

#endif
