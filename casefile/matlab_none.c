/* matlab_none.c - matlab_child.h where libmatio is not built in: every MATLAB file is refused. */
#include <stddef.h>

#include "casefile/matlab_child.h"

hc_status matlab_child_read(const char *path, const char *variable, int expected, int *rows, double **values,
                            message *m)
{
  (void)path, (void)variable, (void)expected;
  *rows = 0;
  *values = NULL;
  message_add(m, "is in a MATLAB file, which this build does not read, expected a Matrix Market file, or a build with "
                 "-DHBMCHECK_MATIO=ON (Debian: libmatio-dev)");
  return HC_BAD_INPUT;
}
