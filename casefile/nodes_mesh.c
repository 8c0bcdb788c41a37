/* nodes_mesh.c - nodes as CalculiX and Abaqus tell them, see nodes_file.h. */
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "casefile/matrix_text.h"
#include "casefile/nodes_file.h"

static const char axes[] = "xyz"; /* DOFs 1, 2, 3 */

/* The first line that says something: a comment, a keyword or a number begins it. */
bool nodes_mesh_meant(const char *text, size_t length)
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

hc_status nodes_mesh_parse(const char *name, const char *text, size_t length, scene_structure *s, message *m)
{
  matrix_text t = matrix_text_start(name, text, length, s->n, m);
  const bool lines = matrix_text_next(&t) && t.n_words == 1 && memchr(t.words[0].text, '.', t.words[0].length);
  return lines ? read_dofs(&t, s) : read_labels(&t, s);
}
