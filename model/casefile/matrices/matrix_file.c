/* matrix_file.c - see matrix_file.h. */
#include "model/casefile/matrices/matrix_file.h"

#include <stdlib.h>
#include <string.h>

#include "model/casefile/matrices/matrix_text.h"
#include "model/casefile/matrices/text_file.h"

static const size_t most_bytes = (size_t)1 << 31;

static bool begins(const matrix_text *r, const char *words)
{
  const size_t length = strlen(words);
  return (size_t)(r->end - r->text) >= length && !memcmp(r->text, words, length);
}

/* What a file may be that is none of those which are read. */
static const char *other_format(const matrix_text *r)
{
  const bool words = r->n_words > 0 && r->words[0].length > 0;
  if (begins(r, "MATLAB ") || begins(r, "\x89HDF"))
    return "this is a MATLAB file; docs/models.md: how MATLAB writes Matrix Market";
  if (words && *r->words[0].text == '*')
    return "this looks like an Abaqus input file, of which *MATRIX and *USER "
           "ELEMENT can be read";
  if (words &&
      (*r->words[0].text == '$' || matrix_word_is(&r->words[0], "dmig") || matrix_word_is(&r->words[0], "dmig*")))
    return "this looks like Nastran's DMIG, which MATLAB or a script turns into one of them";
  if (r->n_words == 2) return "this looks like a CalculiX file of DOFs, which is for structure.nodes";
  return NULL;
}

/* By the first line that says something. */
static hc_status parse(matrix_text *r)
{
  static const char abaqus[] = "*matrix", element[] = "*user";
  const bool any = matrix_text_next(r);
  const matrix_word first = any ? r->words[0] : (matrix_word){r->text, 0};
  const bool digit = first.length > 0 && (*first.text >= '0' && *first.text <= '9');
  if (first.length > 0 && *first.text == '%') return matrix_market_parse(r);
  if (matrix_word_is(&first, abaqus) || matrix_word_is(&first, element)) return abaqus_element_parse(r);
  if (digit && r->n_words == 3) return triplets_parse(r);
  if (digit && r->n_words == 5) return labelled_triplets_parse(r);
  const char *other = other_format(r);
  message *m = matrix_text_blame(r, r->line_text);
  message_add(m, "no matrix's first line, expected `%%%%MatrixMarket matrix coordinate real general` or the like, "
                 "lines `row column value` (CalculiX) or `node,dof,node,dof,value` (Abaqus), or *MATRIX,TYPE=...");
  if (other) message_add(m, " (%s)", other);
  return HC_BAD_INPUT;
}

hc_status matrix_file_parse(const char *name, const char *text, size_t length, const char *part, int expected,
                            sparse *out, matrix_label **labels, message *m)
{
  matrix_text r = matrix_text_start(name, text, length, expected, m);
  r.part = part;
  const hc_status st = parse(&r);
  *out = (sparse){0};
  if (labels) *labels = NULL;
  if (st == HC_OK) *out = r.matrix, r.matrix = (sparse){0};
  if (st == HC_OK && labels) *labels = r.labels, r.labels = NULL;
  matrix_text_free(&r);
  return st;
}

hc_status matrix_file_read(const char *path, const char *part, int expected, sparse *out, matrix_label **labels,
                           message *m)
{
  char *text;
  size_t length;
  *out = (sparse){0};
  if (labels) *labels = NULL;
  hc_status st = text_file_read(path, most_bytes, &text, &length, m);
  if (st == HC_OK) st = matrix_file_parse(path, text, length, part, expected, out, labels, m);
  free(text);
  return st;
}

void matrix_file_place(const char *path, const char *part, int row, int column, size_t *line, size_t *place)
{
  char *text, words[512];
  size_t length;
  message m;
  message_start(&m, words, sizeof words);
  *line = *place = 0;
  if (text_file_read(path, most_bytes, &text, &length, &m) == HC_OK) {
    matrix_text r = matrix_text_start(path, text, length, 0, &m);
    r.part = part;
    for (int k = parse(&r) == HC_OK ? r.n_entries : 0; k-- > 0;) {
      const matrix_entry *e = &r.entries[k];
      const bool itself = e->row == row && e->column == column, mirror = e->row == column && e->column == row;
      if (itself || (mirror && r.mirrored && *line == 0)) *line = e->line, *place = e->place;
    }
    matrix_text_free(&r);
  }
  free(text);
}
