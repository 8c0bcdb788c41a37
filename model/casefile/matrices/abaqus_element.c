/* abaqus_element.c - matrices as those of a user element, see matrix_text.h.
 *
 *     *USER ELEMENT, NODES=2, LINEAR          a comment of numbers lists the nodes:   ** 101, 102
 *     1, 2, 3                                 DOFs of every node from the first on
 *     2, 1, 2                                 of every node from the second on: 1 and 2
 *     *MATRIX,TYPE=STIFFNESS
 *     row after row of the lower triangle, each beginning a line, at most four numbers a line */
#include <stdlib.h>
#include <string.h>

#include "model/casefile/matrices/matrix_text.h"
#include "numerics/base/growing.h"
#include "numerics/base/number.h"

enum { KEYWORD = 64 };

typedef struct element {
  int n_nodes, *nodes;
  int n_labels;
  matrix_label *labels;
  int place, n_dofs, dofs[MATRIX_WORDS]; /* of every node from that place on, from 0 */
} element;

/* The current line in capitals and without blanks, cut to size. */
static const char *keyword(const matrix_text *r, char text[KEYWORD])
{
  size_t n = 0;
  for (const char *s = r->line_text; s < r->next && n + 1 < KEYWORD; ++s)
    if (*s > ' ') text[n++] = *s >= 'a' && *s <= 'z' ? (char)(*s & ~0x20) : *s;
  text[n] = '\0';
  return text;
}

/* ---- the header ---- */

/* `** 101, 102`, nodes; any other comment says nothing. */
static hc_status read_comment(const matrix_text *r, element *e)
{
  if (!matrix_word_is(&r->words[0], "**") || r->n_words > MATRIX_WORDS) return HC_OK;
  for (int i = 1, node; i < r->n_words; ++i)
    if (number_read_integer(r->words[i].text, r->words[i].length, &node) != NUMBER_FINE) return HC_OK;
  for (int i = 1; i < r->n_words && e->n_nodes < MATRIX_MOST_ROWS; ++i) {
    if (!GROW(e->nodes, e->n_nodes)) return HC_NO_MEMORY;
    number_read_integer(r->words[i].text, r->words[i].length, &e->nodes[e->n_nodes++]);
  }
  return HC_OK;
}

/* The nodes before `place` have the DOFs that hold now. */
static hc_status label_nodes(element *e, int place)
{
  for (; e->place < place && e->place < e->n_nodes; ++e->place)
    for (int k = 0; k < e->n_dofs && e->n_labels < MATRIX_MOST_ROWS; ++k) {
      if (!GROW(e->labels, e->n_labels)) return HC_NO_MEMORY;
      e->labels[e->n_labels++] = (matrix_label){.node = e->nodes[e->place], .dof = e->dofs[k]};
    }
  return HC_OK;
}

/* DOFs of the nodes: of all, or behind the first such line a place and its DOFs. */
static hc_status read_dofs(matrix_text *r, element *e, bool first)
{
  int place = 1;
  if (r->n_words > MATRIX_WORDS)
    return matrix_text_refuse(r, r->words[0].text, "more than %d words, expected DOFs", (int)MATRIX_WORDS);
  if (!first && !matrix_text_integer(r, 0, e->place + 1, MATRIX_MOST_ROWS, "the place of a node", &place))
    return HC_BAD_INPUT;
  const hc_status st = label_nodes(e, place - 1);
  if (st != HC_OK) return st;
  e->n_dofs = 0;
  for (int i = first ? 0 : 1; i < r->n_words; ++i)
    if (!matrix_text_integer(r, i, 1, 1000, "a DOF", &e->dofs[e->n_dofs++])) return HC_BAD_INPUT;
  return HC_OK;
}

/* From *USER ELEMENT, the line that has been read, to the next keyword, whose line has been read then. */
static hc_status read_header(matrix_text *r, element *e)
{
  char words[KEYWORD];
  bool first = true;
  hc_status st = HC_OK;
  if (strstr(keyword(r, words), ",UNSYMM"))
    return matrix_text_refuse(r, r->line_text, "an unsymmetric element, expected a symmetric one");
  while (st == HC_OK && matrix_text_line(r)) {
    if (r->n_words == 0) continue;
    const char *text = r->words[0].text;
    const bool star = *text == '*' && r->words[0].length > 0, comment = star && text + 1 < r->end && text[1] == '*';
    if (star && !comment) return label_nodes(e, e->n_nodes);
    st = comment ? read_comment(r, e) : read_dofs(r, e, first);
    first = first && comment;
  }
  if (st != HC_OK) return st;
  return matrix_text_refuse(r, NULL, "the file ends in a header, expected *MATRIX,TYPE=STIFFNESS or the like");
}

/* ---- matrices ---- */

/* The numbers of a line, of row *row, of which *column is next; kept if wanted. */
static hc_status read_row_line(matrix_text *r, bool wanted, int *row, int *column)
{
  for (int i = 0; i < r->n_words; ++i) {
    double value;
    if (i >= MATRIX_WORDS || (i > 0 && *column == 0))
      return matrix_text_refuse(
          r, i < MATRIX_WORDS ? r->words[i].text : r->words[0].text,
          "another number, expected row %d of the lower triangle to have %d, and the next one to begin a line", *row,
          *row);
    if (*row == MATRIX_MOST_DENSE)
      return matrix_text_refuse(r, r->words[i].text, "another row, expected at most %d", (int)MATRIX_MOST_DENSE);
    if (!matrix_text_number(r, i, &value)) return HC_BAD_INPUT;
    if (wanted && matrix_text_put(r, *row, *column, value, r->words[i].text) != HC_OK) return HC_NO_MEMORY;
    if (++*column > *row) ++*row, *column = 0;
  }
  return HC_OK;
}

/* From behind *MATRIX to the next keyword or the end; more tells which. */
static hc_status read_rows(matrix_text *r, bool wanted, int *rows, bool *more)
{
  int column = 0;
  hc_status st = HC_OK;
  *rows = 0;
  while ((*more = matrix_text_next(r)) && st == HC_OK && !(r->words[0].length > 0 && *r->words[0].text == '*'))
    st = read_row_line(r, wanted, rows, &column);
  if (st != HC_OK || (*rows > 0 && column == 0)) return st;
  return matrix_text_refuse(r, *more ? r->words[0].text : NULL,
                            "row %d of the lower triangle ends after %d numbers, expected %d", *rows + 1, column,
                            *rows + 1);
}

static hc_status assemble(matrix_text *r, element *e, int n)
{
  hc_status st = matrix_text_check_rows(r, n);
  r->n = n;
  if (st == HC_OK) st = matrix_text_assemble(r);
  if (st != HC_OK || e->n_labels != n) return st;
  r->labels = e->labels;
  e->labels = NULL;
  return HC_OK;
}

/* Matrices from the keyword of the current line on, down to the end. */
static hc_status read_matrices(matrix_text *r, element *e)
{
  static const char start[] = "*MATRIX,TYPE=";
  char words[KEYWORD];
  bool more = true;
  while (more) {
    int rows;
    const char *type = keyword(r, words);
    if (strncmp(type, start, strlen(start)) != 0)
      return matrix_text_refuse(r, r->words[0].text, "%s, expected *MATRIX,TYPE=STIFFNESS or the like",
                                MATRIX_QUOTED(r->words[0]));
    type += strlen(start);
    const bool wanted = r->n == 0 && (!r->part || !strcmp(type, r->part));
    hc_status st = read_rows(r, wanted, &rows, &more);
    if (st == HC_OK && wanted) st = assemble(r, e, rows);
    if (st != HC_OK) return st;
  }
  if (r->n > 0) return HC_OK;
  return matrix_text_refuse(r, NULL, "no *MATRIX,TYPE=%s in this file, expected one", r->part);
}

hc_status abaqus_element_parse(matrix_text *r)
{
  element e = {0};
  char words[KEYWORD];
  r->mirrored = 1;
  matrix_text_rewind(r);
  hc_status st = matrix_text_next(r) ? HC_OK : HC_BAD_INPUT;
  if (st == HC_OK && strstr(keyword(r, words), "*USERELEMENT") == words) st = read_header(r, &e);
  if (st == HC_OK) st = read_matrices(r, &e);
  free(e.nodes);
  free(e.labels);
  return st;
}
