/* matlab_file.c - see matlab_file.h. */
#include "casefile/matlab_file.h"

#include <stdlib.h>
#include <string.h>

#include "casefile/matlab_child.h"

static bool ends_in_mat(const char *name, size_t length)
{
  static const char ending[] = ".mat";
  if (length < 4) return false;
  for (size_t i = 0; i < 4; ++i) {
    const char c = name[length - 4 + i];
    if ((c >= 'A' && c <= 'Z' ? (char)(c | 0x20) : c) != ending[i]) return false;
  }
  return true;
}

/* How long the file's part of `name` is; 0 if it means no MATLAB file. */
static size_t file_length(const char *name)
{
  const char *mark = strrchr(name, '#');
  const size_t length = strlen(name);
  if (mark && ends_in_mat(name, (size_t)(mark - name))) return (size_t)(mark - name);
  return ends_in_mat(name, length) ? length : 0;
}

bool matlab_file_meant(const char *name) { return file_length(name) > 0; }

hc_status matlab_file_read(const char *name, int expected, int *rows, double **values, message *m)
{
  const size_t length = file_length(name);
  char *path = malloc(length + 1);
  *rows = 0;
  *values = NULL;
  if (!path) return HC_NO_MEMORY;
  memcpy(path, name, length);
  path[length] = '\0';
  const hc_status st = matlab_child_read(path, name[length] ? name + length + 1 : NULL, expected, rows, values, m);
  free(path);
  return st;
}
