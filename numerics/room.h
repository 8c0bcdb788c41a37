/* room.h - is there memory? Asked before calls into libraries that crash or abort when an allocation of theirs fails:
 * SUNDIALS up to 6.4 at least (N_VClone writes through the NULL it gets; SUNContext_Create frees its logger's table
 * twice) and FFTW's planner (abort). They take far less than what is asked for here, so a process at its limit gets
 * HC_NO_MEMORY instead of the crash. Not covered: another thread takes the memory between the question and the call;
 * the kernel kills a process whose allocations it had granted. */
#ifndef HC_ROOM_H
#define HC_ROOM_H

#include <stdbool.h>
#include <stdlib.h>

/* [bytes] that such a call may need, beside those that grow with its sizes. */
enum { HC_ROOM_LIBRARY = 256 * 1024 };

/* bytes: that grow with the sizes of the call. */
static inline bool hc_room_for(size_t bytes)
{
  /* volatile: else a compiler may leave out malloc and free together */
  void *volatile probe = malloc(HC_ROOM_LIBRARY + bytes);
  bool there = probe != NULL;
  free(probe);
  return there;
}

#endif
