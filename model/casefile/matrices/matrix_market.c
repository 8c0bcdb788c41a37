/* matrix_market.c - Matrix Market files, see matrix_text.h. Between banner, size and entries comments may stand. */
#include <limits.h>

#include "model/casefile/matrices/matrix_text.h"

/* Which of names[], ending in NULL, word i is; -1 with the message made. */
static int choose(matrix_text *t, int i, const char *const *names, const char *expected)
{
  for (int k = 0; names[k]; ++k)
    if (matrix_word_is(&t->words[i], names[k])) return k;
  matrix_text_refuse(t, t->words[i].text, "%s in the banner, expected %s", MATRIX_QUOTED(t->words[i]), expected);
  return -1;
}

/* %%MatrixMarket matrix coordinate|array real|integer general|symmetric|skew-symmetric */
static hc_status read_banner(matrix_text *t)
{
  static const char *const formats[] = {"coordinate", "array", NULL}, *const objects[] = {"matrix", NULL};
  static const char *const fields[] = {"real", "integer", NULL};
  static const char *const symmetries[] = {
      [MATRIX_GENERAL] = "general", [MATRIX_SYMMETRIC] = "symmetric", [MATRIX_SKEW] = "skew-symmetric", NULL};
  if (!matrix_text_line(t) || t->n_words == 0 || !matrix_word_is(&t->words[0], "%%matrixmarket"))
    return matrix_text_refuse(
        t, t->line_text,
        "no Matrix Market banner, expected `%%%%MatrixMarket matrix coordinate real general` or the like");
  if (t->n_words != 5)
    return matrix_text_refuse(
        t, t->words[0].text,
        "a banner of %s than five words, expected `%%%%MatrixMarket matrix coordinate real general` or the like",
        t->n_words < 5 ? "less" : "more");
  const int object = choose(t, 1, objects, "matrix");
  const int format = object < 0 ? -1 : choose(t, 2, formats, "coordinate or array");
  const int kind = format < 0 ? -1 : choose(t, 3, fields, "real or integer: numbers are needed");
  const int sym = kind < 0 ? -1 : choose(t, 4, symmetries, "general, symmetric or skew-symmetric");
  t->coordinate = format == 0;
  t->integers = kind == 1;
  t->symmetry = sym < 0 ? MATRIX_GENERAL : (matrix_symmetry)sym;
  return sym < 0 ? HC_BAD_INPUT : HC_OK;
}

static hc_status read_size(matrix_text *t, int *entries)
{
  int columns;
  if (!matrix_text_next(t))
    return matrix_text_refuse(t, NULL, "the file ends before the line of sizes, expected rows and columns");
  if (t->n_words != 2 + t->coordinate)
    return matrix_text_refuse(t, t->words[0].text, "%d words where the sizes should stand, expected %s", t->n_words,
                              t->coordinate ? "rows, columns and number of entries" : "rows and columns");
  if (!matrix_text_integer(t, 0, 1, MATRIX_MOST_ROWS, "the number of rows", &t->n)) return HC_BAD_INPUT;
  if (!matrix_text_integer(t, 1, 1, MATRIX_MOST_ROWS, "the number of columns", &columns)) return HC_BAD_INPUT;
  if (t->expected > 0 && (columns != t->n || t->n != t->expected))
    return matrix_text_refuse(t, t->words[0].text, "a matrix of %d x %d, expected %d x %d", t->n, columns, t->expected,
                              t->expected);
  if (columns != t->n)
    return matrix_text_refuse(t, t->words[0].text, "a matrix of %d x %d, expected as many columns as rows", t->n,
                              columns);
  if (!t->coordinate && t->n > MATRIX_MOST_DENSE)
    return matrix_text_refuse(t, t->words[0].text, "an array of %d rows, expected at most %d, or coordinate", t->n,
                              (int)MATRIX_MOST_DENSE);
  const long n = t->n, below = n * (n - 1) / 2;
  const long most = t->symmetry == MATRIX_GENERAL ? n * n : t->symmetry == MATRIX_SYMMETRIC ? below + n : below;
  *entries = (int)(most < INT_MAX / 2 ? most : INT_MAX / 2);
  return t->coordinate && !matrix_text_integer(t, 2, 0, *entries, "the number of entries", entries) ? HC_BAD_INPUT
                                                                                                    : HC_OK;
}

static hc_status read_coordinate(matrix_text *t)
{
  int i, j;
  double value;
  if (t->n_words != 3)
    return matrix_text_refuse(t, t->words[0].text, "%s than three words, expected row, column and value of an entry",
                              t->n_words < 3 ? "less" : "more");
  if (!matrix_text_integer(t, 0, 1, t->n, "a row", &i) || !matrix_text_integer(t, 1, 1, t->n, "a column", &j))
    return HC_BAD_INPUT;
  if (t->symmetry != MATRIX_GENERAL && i < j + (t->symmetry == MATRIX_SKEW))
    return matrix_text_refuse(
        t, t->words[0].text, "entry (%d, %d) of a %s matrix, expected its lower triangle alone, row %s column", i, j,
        t->symmetry == MATRIX_SKEW ? "skew-symmetric" : "symmetric", t->symmetry == MATRIX_SKEW ? ">" : ">=");
  if (!matrix_text_number(t, 2, &value)) return HC_BAD_INPUT;
  return matrix_text_put(t, i - 1, j - 1, value, t->words[0].text);
}

/* A value a line, down the columns; (*i, *j) moves on to the next one. */
static hc_status read_array(matrix_text *t, int *i, int *j)
{
  double value;
  if (t->n_words != 1) return matrix_text_refuse(t, t->words[1].text, "a second word, expected one value a line");
  if (!matrix_text_number(t, 0, &value)) return HC_BAD_INPUT;
  if (matrix_text_put(t, *i, *j, value, t->words[0].text) != HC_OK) return HC_NO_MEMORY;
  if (++*i == t->n) ++*j, *i = t->symmetry == MATRIX_GENERAL ? 0 : *j + (t->symmetry == MATRIX_SKEW);
  return HC_OK;
}

static hc_status read_entries(matrix_text *t, int entries)
{
  int i = t->symmetry == MATRIX_SKEW, j = 0;
  for (int k = 0; k < entries; ++k) {
    if (!matrix_text_next(t))
      return matrix_text_refuse(t, NULL, "the file ends after %d entries, expected %d", k, entries);
    const hc_status st = t->coordinate ? read_coordinate(t) : read_array(t, &i, &j);
    if (st != HC_OK) return st;
  }
  if (!matrix_text_next(t)) return HC_OK;
  return matrix_text_refuse(t, t->words[0].text, "something after the last of %d entries, expected the end", entries);
}

hc_status matrix_market_parse(matrix_text *t)
{
  int entries = 0;
  t->comment = "%";
  t->commas = false;
  matrix_text_rewind(t);
  hc_status st = read_banner(t);
  if (st == HC_OK) st = read_size(t, &entries);
  t->mirrored = t->symmetry == MATRIX_GENERAL ? 0 : t->symmetry == MATRIX_SKEW ? -1 : 1;
  if (st == HC_OK) st = read_entries(t, entries);
  return st == HC_OK ? matrix_text_assemble(t) : st;
}
