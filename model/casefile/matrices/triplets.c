/* triplets.c - entries of a matrix, one a line: rows by number, or by node and DOF; see matrix_text.h. A first pass
 * over the text finds out which rows there are, a second one reads the entries. */
#include <stdlib.h>

#include "model/casefile/matrices/matrix_text.h"
#include "numerics/base/growing.h"
#include "numerics/base/number.h"

static const int most_node = 2147483647;

/* ---- rows by number ---- */

static hc_status wrong_words(matrix_text *r, const char *expected)
{
  return matrix_text_refuse(r, r->words[0].text, "%d words, expected %s", r->n_words, expected);
}

static hc_status count_rows(matrix_text *r, int *n)
{
  *n = 0;
  while (matrix_text_next(r)) {
    int i, j;
    if (r->n_words != 3) return wrong_words(r, "row, column and value of an entry");
    if (!matrix_text_integer(r, 0, 1, MATRIX_MOST_ROWS, "a row", &i)) return HC_BAD_INPUT;
    if (!matrix_text_integer(r, 1, 1, MATRIX_MOST_ROWS, "a column", &j)) return HC_BAD_INPUT;
    if (i > *n) *n = i;
    if (j > *n) *n = j;
  }
  return HC_OK;
}

/* ---- rows by node and DOF ---- */

static int by_node(const void *a, const void *b)
{
  const matrix_label *x = a, *y = b;
  if (x->node != y->node) return x->node < y->node ? -1 : 1;
  return (x->dof > y->dof) - (x->dof < y->dof);
}

/* The label in words first and first + 1. */
static bool read_label(matrix_text *r, int first, matrix_label *label)
{
  return matrix_text_integer(r, first, 1, most_node, "a node", &label->node) &&
         matrix_text_integer(r, first + 1, 1, most_node, "a DOF", &label->dof);
}

/* Sorted, each once: read_entries refuses what is there twice. */
static int distinct(matrix_label *labels, int n)
{
  int kept = 0;
  qsort(labels, (size_t)n, sizeof *labels, by_node);
  for (int i = 0; i < n; ++i)
    if (i == 0 || by_node(&labels[i], &labels[kept - 1]) != 0) labels[kept++] = labels[i];
  return kept;
}

/* The labels of the diagonal's entries into r->labels, *n of them. */
static hc_status collect_labels(matrix_text *r, int *n)
{
  *n = 0;
  while (matrix_text_next(r)) {
    matrix_label row, column;
    if (r->n_words != 5) return wrong_words(r, "node, DOF, node, DOF and value of an entry");
    if (!read_label(r, 0, &row) || !read_label(r, 2, &column)) return HC_BAD_INPUT;
    if (by_node(&row, &column) != 0) continue;
    if (*n == MATRIX_MOST_ROWS)
      return matrix_text_refuse(r, r->words[0].text, "another row, expected at most %d", (int)MATRIX_MOST_ROWS);
    if (!GROW(r->labels, *n)) return HC_NO_MEMORY;
    r->labels[(*n)++] = row;
  }
  if (*n > 0) *n = distinct(r->labels, *n);
  return HC_OK;
}

/* The row of the label in words first and first + 1. */
static bool find_row(matrix_text *r, int first, int *row)
{
  matrix_label label;
  if (!read_label(r, first, &label)) return false;
  const matrix_label *found = bsearch(&label, r->labels, (size_t)r->n, sizeof *r->labels, by_node);
  if (found) *row = (int)(found - r->labels);
  else
    matrix_text_refuse(r, r->words[first].text,
                       "DOF %d of node %d has no entry on the diagonal, expected one of every DOF", label.dof,
                       label.node);
  return found != NULL;
}

/* ---- entries ---- */

static bool read_place(matrix_text *r, int *i, int *j)
{
  if (r->labels) return find_row(r, 0, i) && find_row(r, 2, j);
  if (!matrix_text_integer(r, 0, 1, r->n, "a row", i) || !matrix_text_integer(r, 1, 1, r->n, "a column", j))
    return false;
  --*i, --*j;
  return true;
}

static hc_status read_entries(matrix_text *r, bool *lower, bool *upper)
{
  *lower = *upper = false;
  while (matrix_text_next(r)) {
    int i, j;
    double value;
    if (!read_place(r, &i, &j)) return HC_BAD_INPUT;
    if (!matrix_text_number(r, r->n_words - 1, &value)) return HC_BAD_INPUT;
    if (matrix_text_put(r, i, j, value, r->words[0].text) != HC_OK) return HC_NO_MEMORY;
    *lower = *lower || i > j;
    *upper = *upper || i < j;
  }
  return HC_OK;
}

static bool is_there(const sparse *A, int i, int j)
{
  for (int k = A->start[j]; k < A->start[j + 1]; ++k)
    if (A->row[k] == i) return true;
  return false;
}

/* Entries on both sides: the first one without its mirror image is a triangle's that has lost its way. */
static hc_status check_mirrors(matrix_text *r)
{
  for (int k = 0; k < r->n_entries; ++k) {
    const matrix_entry *e = &r->entries[k];
    if (is_there(&r->matrix, e->column, e->row)) continue;
    return matrix_text_refuse_entry(
        r, e,
        "entry (%d, %d) without (%d, %d), where both sides of the diagonal have entries, expected one side "
        "alone, or every entry of both",
        e->row + 1, e->column + 1, e->column + 1, e->row + 1);
  }
  return HC_OK;
}

static hc_status parse(matrix_text *r, hc_status (*count)(matrix_text *, int *))
{
  bool lower, upper;
  matrix_text_rewind(r);
  hc_status st = count(r, &r->n);
  if (st == HC_OK && r->n == 0) st = matrix_text_refuse(r, NULL, "no entries on the diagonal, expected a matrix");
  if (st == HC_OK) st = matrix_text_check_rows(r, r->n);
  matrix_text_rewind(r);
  if (st == HC_OK) st = read_entries(r, &lower, &upper);
  if (st != HC_OK) return st;
  r->mirrored = !(lower && upper); /* a triangle stands for both */
  st = matrix_text_assemble(r);
  return st == HC_OK && !r->mirrored ? check_mirrors(r) : st;
}

hc_status triplets_parse(matrix_text *r) { return parse(r, count_rows); }

hc_status labelled_triplets_parse(matrix_text *r) { return parse(r, collect_labels); }
