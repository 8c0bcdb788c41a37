/* memory.h - allocations that fail on demand, in our code and in every library: SUNDIALS, FFTW, GSL, SQLite,
 * jansson, libyaml, the C library. The program's own malloc and friends come before everybody else's; they count,
 * refuse, or pass on to the C library or the sanitizer. A few calls of SUNDIALS and FFTW that crash without memory
 * are sheltered from the first two modes: nothing fails inside them. What the library does about those is in
 * numerics/room.h. */
#pragma once

#include <stdbool.h>

typedef enum memory_mode { MEMORY_ONE, MEMORY_ALL_FROM, MEMORY_LIMIT } memory_mode;

/* From here on the n-th allocation fails; or all from the n-th on; or, MEMORY_LIMIT, each by which there would be
 * more than n bytes more in use than when the first sheltered call came back: somebody else has taken the memory
 * meanwhile. n = 0: none, but they are counted. Under the address sanitizer there is no limit. */
void memory_fail(long n, memory_mode mode);

long memory_asked(void); /* allocations since memory_fail */
long memory_refused(void);
long memory_peak(void); /* most bytes in use beyond those that the limit counts from */
