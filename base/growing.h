/* growing.h - lists that double in size whenever their number of entries is a power of two. */
#ifndef HC_GROWING_H
#define HC_GROWING_H

#include <stdlib.h>

/* The list with room for one more entry of `size` bytes than the `count` there are; NULL: out of memory, and the list
 * is as it was. */
static inline void *growing(void *list, int count, size_t size)
{
  if (count & (count - 1)) return list; /* not at a power of two, so there is room */
  return realloc(list, size * (count > 0 ? 2 * (size_t)count : 1));
}

#endif
