#include "numerics/base/path.h"

#include <stdlib.h>

char *path_beside(const char *path, const char *name, size_t length)
{
  const char *slash = strrchr(path, '/');
  const size_t folder = slash && !(length > 0 && *name == '/') ? (size_t)(slash - path) + 1 : 0;
  char *joined = malloc(folder + length + 1);
  if (!joined) return NULL;
  memcpy(joined, path, folder);
  memcpy(joined + folder, name, length);
  joined[folder + length] = '\0';
  return joined;
}
