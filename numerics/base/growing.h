/* growing.h - lists with room for a power of two of entries. */
#pragma once

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* The list with room for `more` entries of `size` bytes beside the `count` there are; NULL: out of memory, and the list
 * is as it was. */
static inline void *growing_by(void *list, int count, int more, size_t size)
{
  size_t room = 1;
  while (room < (size_t)count) room *= 2;
  if (count > 0 && (size_t)count + (size_t)more <= room) return list;
  while (room < (size_t)count + (size_t)more) room *= 2;
  return realloc(list, size * room);
}

static inline void *growing(void *list, int count, size_t size) { return growing_by(list, count, 1, size); }

/* The same for a list that a variable holds, which gets the larger one; false: out of memory. */
#define GROW(list, count) grow_in_place(&(list), count, sizeof *(list))
static inline bool grow_in_place(void *variable, int count, size_t size)
{
  void *list;
  memcpy(&list, variable, sizeof list);
  list = growing(list, count, size);
  if (list) memcpy(variable, &list, sizeof list);
  return list != NULL;
}
