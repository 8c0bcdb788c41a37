/* pair_rows.c - see pair_rows.h. */
#include "casefile/pair_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "casefile/matrices/text_file.h"

static const size_t most_bytes = (size_t)16 << 20;
static const char *const names[PAIR_COLUMNS] = {"node_a", "node_b", "gap", "preload", "area"};
static const char expected_columns[] = "node_a,node_b[,gap][,preload][,area]";

/* ---- words of a row ---- */

static yaml_node_t *entry(const pair_rows *p, const yaml_node_t *list, int i)
{
  return yaml_document_get_node(p->doc, list->data.sequence.items.start[i]);
}

static int length_of(const yaml_node_t *list)
{
  return (int)(list->data.sequence.items.top - list->data.sequence.items.start);
}

static int word_count(const pair_rows *p) { return p->list ? length_of(p->current) : p->text.n_words; }

static matrix_word word_at(const pair_rows *p, int i)
{
  if (!p->list) return p->text.words[i];
  const yaml_node_t *node = entry(p, p->current, i);
  return (matrix_word){yaml_node_text(node), node->data.scalar.length};
}

static message *blame_word(pair_rows *p, int i)
{
  if (p->list) return case_blame(p->r, case_place_of(p->r, entry(p, p->current, i)->start_mark));
  return matrix_text_blame(&p->text, p->text.words[i].text);
}

static message *blame_row(pair_rows *p)
{
  if (p->list) return case_blame(p->r, case_place_of(p->r, p->current->start_mark));
  return matrix_text_blame(&p->text, p->text.line_text);
}

message *pair_rows_blame(pair_rows *p, pair_column c) { return blame_word(p, p->column[c]); }

/* Word i and what was expected. */
static hc_status wrong_word(pair_rows *p, int i, const char *expected)
{
  const matrix_word w = word_at(p, i);
  message *m = blame_word(p, i);
  message_add(m, "`");
  message_add_input(m, w.text, w.length, 60);
  message_add(m, "`, expected %s", expected);
  return HC_BAD_INPUT;
}

/* Go to the next row; false at the end. A row of the case is a list of single values. */
static bool next_row(pair_rows *p, hc_status *st)
{
  *st = HC_OK;
  if (!p->list) return matrix_text_next(&p->text);
  if (p->next == length_of(p->list)) return false;
  p->current = entry(p, p->list, p->next++);
  bool whole = p->current->type == YAML_SEQUENCE_NODE && length_of(p->current) > 0;
  for (int i = 0; whole && i < length_of(p->current); ++i) whole = entry(p, p->current, i)->type == YAML_SCALAR_NODE;
  if (whole) return true;
  message_add(blame_row(p), "%s stands where a row of pairs should, expected a list of %s", yaml_node_what(p->current),
              expected_columns);
  *st = HC_BAD_INPUT;
  return false;
}

/* ---- the names of the columns ---- */

static hc_status read_names(pair_rows *p)
{
  p->columns = word_count(p);
  for (int i = 0; i < p->columns && i < MATRIX_WORDS; ++i) {
    const matrix_word w = word_at(p, i);
    int c = 0;
    while (c < PAIR_COLUMNS && (strlen(names[c]) != w.length || memcmp(names[c], w.text, w.length) != 0)) ++c;
    if (c == PAIR_COLUMNS) return wrong_word(p, i, expected_columns);
    if (p->column[c] >= 0) return wrong_word(p, i, "each column once");
    p->column[c] = i;
  }
  if (p->column[PAIR_NODE_A] >= 0 && p->column[PAIR_NODE_B] >= 0) return HC_OK;
  message_add(blame_row(p), "no column %s, expected %s", names[p->column[PAIR_NODE_A] >= 0 ? PAIR_NODE_B : PAIR_NODE_A],
              expected_columns);
  return HC_BAD_INPUT;
}

static hc_status open_file(pair_rows *p, const yaml_node_t *node)
{
  char words[160];
  size_t length = 0;
  message told;
  message_start(&told, words, sizeof words);
  if (!(p->path = text_file_path(p->r->name, yaml_node_text(node), node->data.scalar.length)))
    return case_out_of_memory(p->r);
  hc_status st = text_file_read(p->path, most_bytes, &p->bytes, &length, &told);
  if (st == HC_NO_MEMORY) return case_out_of_memory(p->r);
  if (st != HC_OK) {
    message *m = case_blame(p->r, case_place_of(p->r, node->start_mark));
    message_add(m, "pairs: ");
    message_add_input(m, p->path, strlen(p->path), 160);
    message_add(m, " %s, expected a csv file %s", words, expected_columns);
    return HC_BAD_INPUT;
  }
  p->text = matrix_text_start(p->path, p->bytes, length, 0, &p->r->msg);
  if (matrix_text_next(&p->text)) return read_names(p);
  message_add(matrix_text_blame_end(&p->text), "nothing here, expected the line %s and one a pair", expected_columns);
  return HC_BAD_INPUT;
}

/* Rows of two nodes need no names. */
static hc_status open_list(pair_rows *p, const yaml_node_t *node)
{
  hc_status st;
  int number;
  p->list = node;
  if (!next_row(p, &st)) {
    if (st == HC_OK)
      message_add(case_blame(p->r, case_place_of(p->r, node->start_mark)),
                  "pairs is an empty list, expected rows of %s", expected_columns);
    return HC_BAD_INPUT;
  }
  const matrix_word first = word_at(p, 0);
  if (number_read_integer(first.text, first.length, &number) != NUMBER_FINE) return read_names(p);
  p->columns = 2;
  p->column[PAIR_NODE_A] = 0, p->column[PAIR_NODE_B] = 1;
  p->next = 0;
  return HC_OK;
}

hc_status pair_rows_open(pair_rows *p, case_reader *r, yaml_document_t *doc, const yaml_node_t *node)
{
  *p = (pair_rows){.r = r, .doc = doc};
  for (int c = 0; c < PAIR_COLUMNS; ++c) p->column[c] = -1;
  if (node->type == YAML_SEQUENCE_NODE) return open_list(p, node);
  if (node->type == YAML_SCALAR_NODE && node->data.scalar.length > 0) return open_file(p, node);
  message_add(case_blame(r, case_place_of(r, node->start_mark)), "pairs is %s, expected a csv file %s, or such rows",
              yaml_node_what(node), expected_columns);
  return HC_BAD_INPUT;
}

void pair_rows_close(pair_rows *p)
{
  free(p->path);
  free(p->bytes);
}

/* ---- rows ---- */

static hc_status read_node(pair_rows *p, pair_column c, int *node)
{
  const matrix_word w = word_at(p, p->column[c]);
  if (c == PAIR_NODE_B && w.length == 6 && !memcmp(w.text, "ground", 6)) {
    *node = PAIR_GROUND;
    return HC_OK;
  }
  if (number_read_integer(w.text, w.length, node) == NUMBER_FINE && *node >= 0) return HC_OK;
  return wrong_word(p, p->column[c], c == PAIR_NODE_B ? "the number of a node, or ground" : "the number of a node");
}

static hc_status read_real(pair_rows *p, pair_column c, double low, const char *expected, double *value)
{
  if (p->column[c] < 0) return HC_OK;
  const matrix_word w = word_at(p, p->column[c]);
  double x;
  if (number_read(w.text, w.length, &x) != NUMBER_FINE || !(x >= low) || (c == PAIR_AREA && !(x > 0)))
    return wrong_word(p, p->column[c], expected);
  *value = x + 0.0; /* -0 is 0 */
  return HC_OK;
}

hc_status pair_rows_next(pair_rows *p, pair_row *row, bool *more)
{
  hc_status st;
  *row = (pair_row){.area = 1};
  *more = next_row(p, &st);
  if (!*more) return st;
  if (word_count(p) != p->columns) {
    message_add(blame_row(p), "%d values in a row of pairs, expected %d", word_count(p), p->columns);
    return HC_BAD_INPUT;
  }
  st = read_node(p, PAIR_NODE_A, &row->a);
  if (st == HC_OK) st = read_node(p, PAIR_NODE_B, &row->b);
  if (st == HC_OK) st = read_real(p, PAIR_GAP, -INFINITY, "a number, the gap", &row->gap);
  if (st == HC_OK) st = read_real(p, PAIR_PRELOAD, 0, "a number >= 0, the preload", &row->preload);
  if (st == HC_OK) st = read_real(p, PAIR_AREA, 0, "a number > 0, the area", &row->area);
  if (st != HC_OK || row->a != row->b) return st;
  message_add(blame_row(p), "node %d against itself, expected two nodes", row->a);
  return HC_BAD_INPUT;
}
