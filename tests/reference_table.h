/* reference_table.h - reads the tables of tests/reference/. */
#pragma once

#include <stdbool.h>

#include "tests/check.h"

/* rows[most], of `size` bytes each, of the lines below the header, each by `parse`, which is false for a line that does
 * not read whole; how many. That, another header and too many lines are failures. */
static inline int read_reference(const char *name, const char *header, bool (*parse)(const char *line, void *row),
                                 int most, size_t size, void *rows)
{
  char path[256], line[512];
  int n = 0;
  snprintf(path, sizeof path, SOURCE_DIR "/tests/reference/%s", name);
  FILE *f = fopen(path, "r");
  if (!f || !fgets(line, sizeof line, f)) fail_msg("cannot read %s", path);
  line[strcspn(line, "\r\n")] = 0;
  assert_string_equal(line, header);
  for (; fgets(line, sizeof line, f); ++n) {
    assert_true(n < most);
    if (!parse(line, (char *)rows + (size_t)n * size)) fail_msg("%s, row %d: %s", name, n + 1, line);
  }
  fclose(f);
  return n;
}
