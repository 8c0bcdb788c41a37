/* answer.h - a table of the lab, for tests: rows, and of results their values by name. */
#pragma once

#include "interfaces/lab/lab.h"
#include "tests/check.h"

static inline const double *row(const lab *l, int i) { return lab_values(l) + i * lab_columns(l); }

/* Where row i has that column. */
static inline const double *cell(const lab *l, int i, const char *name)
{
  const int column = lab_column(l, name);
  if (column < 0) fail_msg("no column %s", name);
  return row(l, i) + column;
}
static inline double number(const lab *l, int i, const char *name) { return *cell(l, i, name); }

static inline bool says(const lab *l, int i, const char *name, const char *word)
{
  return strcmp(lab_word(l, (int)number(l, i, name)), word) == 0;
}
