/* nodes_file.c - see nodes_file.h. */
#include "casefile/nodes_file.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "casefile/matrices/matrix_text.h"
#include "casefile/matrices/text_file.h"

enum { COLUMNS = 3 };
static const size_t most_bytes = (size_t)1 << 29; /* it may be a matrix */

typedef struct reader {
  const char *name;
  size_t line;
  const char *line_text;
  const char *field[COLUMNS];
  size_t length[COLUMNS];
  message *m;
} reader;

static message *blame(reader *r, const char *at)
{
  message_start(r->m, r->m->text, r->m->size);
  message_add_input(r->m, r->name, strlen(r->name), 240);
  message_add(r->m, ":%zu:%zu: ", r->line, (size_t)(at - r->line_text) + 1);
  return r->m;
}

static message *blame_field(reader *r, int i)
{
  message *m = blame(r, r->field[i]);
  message_add_quoted(m, r->field[i], r->length[i]);
  return m;
}

hc_status nodes_add(scene_structure *s, int dof, int node, char direction)
{
  if ((s->n_nodes & (s->n_nodes - 1)) == 0) { /* full at powers of two */
    const size_t room = s->n_nodes > 0 ? 2 * (size_t)s->n_nodes : 1;
    structure_node *grown = realloc(s->nodes, room * sizeof *grown);
    if (!grown) return HC_NO_MEMORY;
    s->nodes = grown;
  }
  s->nodes[s->n_nodes++] = (structure_node){.dof = dof, .node = node, .direction = direction};
  return HC_OK;
}

/* The line up to `stop` into three fields without the blanks around them. */
static bool split(reader *r, const char *stop)
{
  const char *s = r->line_text;
  for (int i = 0; i < COLUMNS; ++i) {
    const char *comma = memchr(s, ',', (size_t)(stop - s)), *end = comma ? comma : stop;
    if ((comma == NULL) != (i == COLUMNS - 1)) return false;
    while (s < end && (*s == ' ' || *s == '\t')) ++s;
    while (end > s && (end[-1] == ' ' || end[-1] == '\t' || end[-1] == '\r')) --end;
    r->field[i] = s, r->length[i] = (size_t)(end - s);
    s = comma ? comma + 1 : stop;
  }
  return true;
}

static bool is_header(const reader *r)
{
  static const char *const words[COLUMNS] = {"dof", "node", "direction"};
  for (int i = 0; i < COLUMNS; ++i)
    if (r->length[i] != strlen(words[i]) || memcmp(r->field[i], words[i], r->length[i])) return false;
  return true;
}

static hc_status read_row(reader *r, scene_structure *s)
{
  int node;
  const int dof = structure_dof(s, r->field[0], r->length[0]);
  if (dof < 0) {
    message_add(blame_field(r, 0), " is no DOF, expected a name or a number 1..%d", s->n);
    return HC_BAD_INPUT;
  }
  if (number_read_integer(r->field[1], r->length[1], &node) != NUMBER_FINE) {
    message_add(blame_field(r, 1), " is no node, expected its number");
    return HC_BAD_INPUT;
  }
  if (r->length[2] != 1 || !structure_is_axis(*r->field[2])) {
    message_add(blame_field(r, 2), " is no direction, expected x, y or z");
    return HC_BAD_INPUT;
  }
  if (structure_node_dof(s, node, *r->field[2]) >= 0) {
    message_add(blame(r, r->line_text), "node %d in direction %c again, expected it once", node, *r->field[2]);
    return HC_BAD_INPUT;
  }
  return nodes_add(s, dof, node, *r->field[2]);
}

static bool is_blank(const char *s, const char *stop)
{
  while (s < stop && (*s == ' ' || *s == '\t' || *s == '\r')) ++s;
  return s == stop;
}

static hc_status read_lines(reader *r, scene_structure *s, const char *text, size_t length)
{
  const char *end = text + length;
  bool header = false;
  hc_status st = HC_OK;
  r->line = 1;
  r->line_text = text;
  for (const char *next; st == HC_OK && r->line_text < end; r->line_text = next, ++r->line) {
    const char *line_end = memchr(r->line_text, '\n', (size_t)(end - r->line_text)), *stop = line_end ? line_end : end;
    next = line_end ? line_end + 1 : end;
    if (is_blank(r->line_text, stop)) continue;
    if (!split(r, stop) || (!header && !is_header(r))) {
      message_add(blame(r, r->line_text), "expected %s",
                  header ? "three values: dof, node and direction, with commas"
                         : "the line `dof,node,direction` first");
      return HC_BAD_INPUT;
    }
    if (header) st = read_row(r, s);
    header = true;
  }
  if (st != HC_OK || header) return st;
  if (r->line > 1 && end[-1] != '\n') --r->line; /* the last line has no end; its beginning will do */
  message_add(blame(r, r->line_text), "nothing here, expected the line `dof,node,direction` and one a DOF");
  return HC_BAD_INPUT;
}

/* ---- nodes as CalculiX and Abaqus tell them */

static const char axes[] = "xyz"; /* DOFs 1, 2, 3 */

/* The first line that says something: a comment, a keyword or a number begins it. */
static bool is_mesh(const char *text, size_t length)
{
  const char *first = text, *end = text + length;
  while (first < end && strchr(" \t\r\n", *first) && *first) ++first;
  return first < end && (*first == '*' || (*first >= '0' && *first <= '9'));
}

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
  message_add(matrix_text_blame_word(t, 0), ", expected NODE.DIRECTION such as 17.2, direction 1, 2 or 3");
  return false;
}

static hc_status read_dofs(matrix_text *t, scene_structure *s)
{
  int n = 0;
  matrix_text_rewind(t);
  while (matrix_text_next(t)) {
    int node, direction;
    if (!read_dof(t, &node, &direction)) return HC_BAD_INPUT;
    if (n == s->n || structure_node_dof(s, node, axes[direction - 1]) >= 0) {
      message *m = matrix_text_blame_word(t, 0);
      if (n == s->n) message_add(m, ", one line too many, expected %d, one a DOF", s->n);
      else message_add(m, " again, expected it once");
      return HC_BAD_INPUT;
    }
    if (nodes_add(s, n++, node, axes[direction - 1]) != HC_OK) return HC_NO_MEMORY;
  }
  if (n == s->n) return HC_OK;
  message_add(matrix_text_blame_end(t), "the file ends after %d lines, expected %d, one a DOF", n, s->n);
  return HC_BAD_INPUT;
}

static hc_status read_labels(matrix_text *t, scene_structure *s)
{
  int n;
  double *values;
  matrix_label *labels;
  hc_status st =
      matrix_file_parse_part(t->name, t->text, (size_t)(t->end - t->text), NULL, s->n, &n, &values, &labels, t->m);
  if (st == HC_OK && !labels) {
    matrix_text_rewind(t);
    message_add(matrix_text_blame(t, t->text), "a matrix that does not say which nodes its rows are, expected one that "
                                               "does, or lines dof,node,direction");
    st = HC_BAD_INPUT;
  }
  for (int i = 0; i < n && st == HC_OK; ++i) {
    if (labels[i].dof < 1 || labels[i].dof > 3 || structure_node_dof(s, labels[i].node, axes[labels[i].dof - 1]) >= 0)
      continue;
    st = nodes_add(s, i, labels[i].node, axes[labels[i].dof - 1]);
  }
  free(values);
  free(labels);
  return st;
}

/* Of a .dof file: a line NODE.DIRECTION, direction 1..3, for each degree of freedom of s. Of a matrix: its DOFs 1..3;
 * rotations and all others are no node's direction. */
static hc_status parse_mesh(const char *name, const char *text, size_t length, scene_structure *s, message *m)
{
  matrix_text t = matrix_text_start(name, text, length, s->n, m);
  const bool lines = matrix_text_next(&t) && t.n_words == 1 && memchr(t.words[0].text, '.', t.words[0].length);
  return lines ? read_dofs(&t, s) : read_labels(&t, s);
}

/* ---- any of them */

hc_status nodes_file_parse(const char *name, const char *text, size_t length, scene_structure *s, message *m)
{
  reader r = {.name = name, .m = m};
  return is_mesh(text, length) ? parse_mesh(name, text, length, s, m) : read_lines(&r, s, text, length);
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
