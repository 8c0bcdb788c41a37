/* nodes_file.c - see structure.h. */
#include "model/casefile/structure.h"

#include <stdlib.h>
#include <string.h>

#include "model/casefile/matrices/matrix_text.h"
#include "model/casefile/matrices/text_file.h"
#include "numerics/base/number.h"

enum { COLUMNS = 3 };
static const size_t most_bytes = (size_t)1 << 31; /* it may be a matrix */

/* ---- dof,node,direction ---- */

static hc_status wrong_field(matrix_text *t, matrix_word w, const char *expected)
{
  return matrix_text_refuse(t, w.text, "%s is no %s", MATRIX_QUOTED(w), expected);
}

static bool is_end(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/* The current line into three fields without the blanks around them. */
static bool split(const matrix_text *t, matrix_word field[COLUMNS])
{
  const char *s = t->line_text, *stop = t->next;
  for (int i = 0; i < COLUMNS; ++i) {
    const char *comma = memchr(s, ',', (size_t)(stop - s)), *end = comma ? comma : stop;
    if ((comma == NULL) != (i == COLUMNS - 1)) return false;
    while (end > s && is_end(end[-1])) --end; /* first, so that an empty field begins after its comma */
    while (s < end && is_end(*s)) ++s;
    field[i] = (matrix_word){s, (size_t)(end - s)};
    s = comma ? comma + 1 : stop;
  }
  return true;
}

static bool is_header(const matrix_word field[COLUMNS])
{
  static const char *const words[COLUMNS] = {"dof", "node", "direction"};
  for (int i = 0; i < COLUMNS; ++i)
    if (field[i].length != strlen(words[i]) || memcmp(field[i].text, words[i], field[i].length)) return false;
  return true;
}

static hc_status read_row(matrix_text *t, const matrix_word field[COLUMNS], scene_structure *s)
{
  int node;
  const int dof = structure_dof(s, field[0].text, field[0].length);
  const char axis = field[2].length == 1 ? *field[2].text : '\0'; /* an empty one may be the text's end */
  char expected[64];
  snprintf(expected, sizeof expected, "DOF, expected a name or a number 1..%d", s->n);
  if (dof < 0) return wrong_field(t, field[0], expected);
  if (number_read_integer(field[1].text, field[1].length, &node) != NUMBER_FINE)
    return wrong_field(t, field[1], "node, expected its number");
  if (!structure_is_axis(axis)) return wrong_field(t, field[2], "direction, expected x, y or z");
  if (structure_node_dof(s, node, axis) >= 0)
    return matrix_text_refuse(t, t->line_text, "node %d in direction %c again, expected it once", node, axis);
  return nodes_add(s, dof, node, axis);
}

static hc_status read_lines(matrix_text *t, scene_structure *s)
{
  bool header = false;
  hc_status st = HC_OK;
  matrix_text_rewind(t);
  while (st == HC_OK && matrix_text_line(t)) {
    matrix_word field[COLUMNS];
    if (t->n_words == 0) continue;
    if (!split(t, field) || (!header && !is_header(field)))
      return matrix_text_refuse(t, t->line_text, "expected %s",
                                header ? "three values: dof, node and direction, with commas"
                                       : "the line `dof,node,direction` first");
    if (header) st = read_row(t, field, s);
    header = true;
  }
  if (st != HC_OK || header) return st;
  t->line_text = t->end;
  return matrix_text_refuse(t, NULL, "nothing here, expected the line `dof,node,direction` and one a DOF");
}

/* ---- nodes as CalculiX and Abaqus tell them */

static const char axes[] = "xyz"; /* DOFs 1, 2, 3 */

/* NODE.DIRECTION of the current line. */
static bool read_dof(matrix_text *t, int *node, int *direction)
{
  const matrix_word *w = &t->words[0];
  const char *point = memchr(w->text, '.', w->length);
  const size_t before = point ? (size_t)(point - w->text) : 0;
  if (t->n_words == 1 && point && number_read_integer(w->text, before, node) == NUMBER_FINE && *node > 0 &&
      number_read_integer(point + 1, w->length - before - 1, direction) == NUMBER_FINE && *direction >= 1 &&
      *direction <= 3)
    return true;
  matrix_text_refuse(t, w->text, "%s, expected NODE.DIRECTION such as 17.2, direction 1, 2 or 3", MATRIX_QUOTED(*w));
  return false;
}

static hc_status read_dofs(matrix_text *t, scene_structure *s)
{
  int n = 0;
  matrix_text_rewind(t);
  while (matrix_text_next(t)) {
    int node, direction;
    if (!read_dof(t, &node, &direction)) return HC_BAD_INPUT;
    if (n == s->n)
      return matrix_text_refuse(t, t->words[0].text, "%s, one line too many, expected %d, one a DOF",
                                MATRIX_QUOTED(t->words[0]), s->n);
    if (structure_node_dof(s, node, axes[direction - 1]) >= 0)
      return matrix_text_refuse(t, t->words[0].text, "%s again, expected it once", MATRIX_QUOTED(t->words[0]));
    if (nodes_add(s, n++, node, axes[direction - 1]) != HC_OK) return HC_NO_MEMORY;
  }
  if (n == s->n) return HC_OK;
  return matrix_text_refuse(t, NULL, "the file ends after %d lines, expected %d, one a DOF", n, s->n);
}

static hc_status read_labels(matrix_text *t, scene_structure *s)
{
  sparse matrix;
  matrix_label *labels;
  hc_status st = matrix_file_parse(t->name, t->text, (size_t)(t->end - t->text), NULL, s->n, &matrix, &labels, t->m);
  if (st == HC_OK && !labels) {
    matrix_text_rewind(t);
    st = matrix_text_refuse(
        t, t->text,
        "a matrix that does not say which nodes its rows are, expected one that does, or lines dof,node,direction");
  }
  for (int i = 0; i < matrix.n && labels && st == HC_OK; ++i) {
    if (labels[i].dof < 1 || labels[i].dof > 3 || structure_node_dof(s, labels[i].node, axes[labels[i].dof - 1]) >= 0)
      continue;
    st = nodes_add(s, i, labels[i].node, axes[labels[i].dof - 1]);
  }
  sparse_free(&matrix);
  free(labels);
  return st;
}

/* ---- any of them: csv; .dof: a line NODE.DIRECTION, 1..3, a DOF; a matrix, its DOFs 1..3 (none else has one) ---- */

hc_status nodes_file_parse(const char *name, const char *text, size_t length, scene_structure *s, message *m)
{
  matrix_text t = matrix_text_start(name, text, length, s->n, m);
  /* The first line that says something: a comment, a keyword or a number begins it. */
  const char *first = text, *end = text + length;
  while (first < end && strchr(" \t\r\n", *first) && *first) ++first;
  if (!(first < end && (*first == '*' || (*first >= '0' && *first <= '9')))) return read_lines(&t, s);
  const bool lines = matrix_text_next(&t) && t.n_words == 1 && memchr(t.words[0].text, '.', t.words[0].length);
  return lines ? read_dofs(&t, s) : read_labels(&t, s);
}

hc_status nodes_file_read(const char *path, scene_structure *s, message *m)
{
  char *text;
  size_t length;
  hc_status st = text_file_read(path, most_bytes, &text, &length, m);
  if (st == HC_OK) st = nodes_file_parse(path, text, length, s, m);
  free(text);
  return st;
}
