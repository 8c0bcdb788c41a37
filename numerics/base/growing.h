/* growing.h - lists whose capacity is a power of two. */
#pragma once

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Returns the list, perhaps moved, with capacity for `more` entries of `size` bytes beside its `count` entries; NULL:
 * out of memory, the list is unchanged. */
static inline void *growing_by(void *list, int count, int more, size_t size)
{
  size_t room = 1;
  while (room < (size_t)count) room *= 2;
  if (count > 0 && (size_t)count + (size_t)more <= room) return list;
  while (room < (size_t)count + (size_t)more) room *= 2;
  return realloc(list, size * room);
}

static inline void *growing(void *list, int count, size_t size) { return growing_by(list, count, 1, size); }

/* The same for one more entry of a list in a variable, which is updated; false: out of memory. */
#define GROW(list, count) grow_in_place(&(list), count, sizeof *(list))
static inline bool grow_in_place(void *variable, int count, size_t size)
{
  void *list;
  memcpy(&list, variable, sizeof list);
  list = growing(list, count, size);
  if (list) memcpy(variable, &list, sizeof list);
  return list != NULL;
}
