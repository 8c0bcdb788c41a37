/* path.h - names of files, taken apart and put together. */
#pragma once

#include <string.h>

/* The path's last component. *stem, if not NULL: its length without the file name extension. */
static inline const char *path_name(const char *path, int *stem)
{
  const char *slash = strrchr(path, '/'), *name = slash && slash[1] ? slash + 1 : path, *dot = strrchr(name, '.');
  if (stem) *stem = (int)(dot && dot > name ? (size_t)(dot - name) : strlen(name));
  return name;
}

/* name[length] in the folder of `path`, or unchanged if absolute; to be freed. NULL: out of memory. */
char *path_beside(const char *path, const char *name, size_t length);
