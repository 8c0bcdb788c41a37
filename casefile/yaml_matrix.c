/* yaml_matrix.c - a matrix of a structure: rows, a diagonal, a number where there is one degree of freedom, or the name
 * of a file. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/number.h"
#include "casefile/matrices/matrix_file.h"
#include "casefile/matrices/text_file.h"
#include "casefile/yaml_structure.h"

static const char any_matrix[] = "rows, a diagonal, or a file of Matrix Market, CalculiX or Abaqus";

hc_status yaml_number(case_reader *r, const yaml_node_t *node, const char *what, double *x)
{
  number_fault fault = NUMBER_NONE;
  const bool scalar = node->type == YAML_SCALAR_NODE, quoted = scalar && yaml_node_item(node).quoted;
  if (scalar && !quoted) fault = number_read(yaml_node_text(node), node->data.scalar.length, x);
  *x = fault == NUMBER_FINE ? *x + 0.0 : 0; /* -0 is 0 */
  if (fault == NUMBER_FINE) return HC_OK;
  message *m = case_blame(r, case_place_of(r, node->start_mark));
  message_add(m, "%s is ", what);
  if (!scalar || node->data.scalar.length == 0) {
    message_add(m, "%s", yaml_node_what(node));
  } else {
    message_add_quoted(m, yaml_node_text(node), node->data.scalar.length);
  }
  message_add(m, ", expected a number");
  if (quoted) message_add(m, " (in quotes it is text)");
  else if (fault == NUMBER_NOT_FINITE) message_add(m, " (it must be finite)");
  return HC_BAD_INPUT;
}

static hc_status wrong_size(case_reader *r, const char *what, const yaml_node_t *node, int found, const char *noun,
                            int expected)
{
  message *m = case_blame(r, case_place_of(r, node->start_mark));
  message_add(m, "%s has %d %s, expected %d", what, found, noun, expected);
  return HC_BAD_INPUT;
}

/* Row i, or with i < 0 the diagonal. */
static hc_status read_row(case_reader *r, yaml_document_t *doc, const char *what, const yaml_node_t *row, int n, int i,
                          double *v)
{
  char path[FIELD_PATH + 32];
  const size_t stride = (size_t)n + (i < 0), first = i < 0 ? 0 : (size_t)i;
  snprintf(path, sizeof path, i < 0 ? "%s" : "%s[%d]", what, i);
  if (row->type != YAML_SEQUENCE_NODE)
    return yaml_refuse(r, row, "%s is %s, expected a row of %d numbers", path, yaml_node_what(row), n);
  if (yaml_length(row) != n) return wrong_size(r, path, row, yaml_length(row), "entries", n);
  for (int j = 0; j < n; ++j) {
    snprintf(path, sizeof path, i < 0 ? "%s[%d]" : "%s[%d][%d]", what, i < 0 ? j : i, j);
    const hc_status st = yaml_number(r, yaml_entry(doc, row, j), path, &v[first + stride * (size_t)j]);
    if (st != HC_OK) return st;
  }
  return HC_OK;
}

static hc_status read_list(case_reader *r, yaml_document_t *doc, const char *what, const yaml_node_t *node,
                           int expected, int *n, double **v)
{
  *n = yaml_length(node);
  const bool rows = *n > 0 && yaml_entry(doc, node, 0)->type == YAML_SEQUENCE_NODE;
  if (*n < 1 || *n > MATRIX_MOST_ROWS)
    return yaml_refuse(r, node,
                       "%s is a list of %d, expected 1 to %d rows, or a "
                       "diagonal",
                       what, *n, (int)MATRIX_MOST_ROWS);
  if (expected > 0 && *n != expected) return wrong_size(r, what, node, *n, rows ? "rows" : "entries", expected);
  if (!(*v = calloc((size_t)*n * (size_t)*n, sizeof **v))) return case_out_of_memory(r);
  hc_status st = HC_OK;
  if (!rows) return read_row(r, doc, what, node, *n, -1, *v);
  for (int i = 0; i < *n && st == HC_OK; ++i) st = read_row(r, doc, what, yaml_entry(doc, node, i), *n, i, *v);
  return st;
}

/* A matrix of one number, where one may stand. */
static bool is_number(const yaml_node_t *node, int expected)
{
  double x;
  return expected <= 1 && !yaml_node_item(node).quoted &&
         number_read(yaml_node_text(node), node->data.scalar.length, &x) == NUMBER_FINE;
}

static hc_status read_number(case_reader *r, const char *what, const yaml_node_t *node, int *n, double **v)
{
  *n = 1;
  if (!(*v = calloc(1, sizeof **v))) return case_out_of_memory(r);
  return yaml_number(r, node, what, *v);
}

/* What Abaqus calls the matrix of that path. */
static const char *part_of(const char *what)
{
  static const char *const parts[][2] = {
      {"structure.mass", "MASS"}, {"structure.stiffness", "STIFFNESS"}, {"structure.damping", "VISCOUSDAMPING"}};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; ++i)
    if (!strcmp(what, parts[i][0])) return parts[i][1];
  return NULL;
}

/* True for FILE.mat and FILE.mat#VARIABLE, whatever the case of the ending's letters. */
static bool is_matlab_name(const char *name)
{
  const char *mark = strrchr(name, '#');
  const size_t length = mark ? (size_t)(mark - name) : strlen(name);
  return length >= 4 && !strncasecmp(name + length - 4, ".mat", 4);
}

static const char how_matlab_writes[] =
    " is a MATLAB file, which is not read, expected Matrix Market, which MATLAB writes by: [i,j,v] = find(M); "
    "f = fopen('M.mtx','w'); fprintf(f,'%%%%MatrixMarket matrix coordinate real general\\n%d %d "
    "%d\\n',size(M),numel(v)); "
    "fprintf(f,'%d %d %.17g\\n',[i j v]'); fclose(f)";

static hc_status read_file(case_reader *r, const char *what, const yaml_node_t *node, int expected, int *n,
                           structure_matrix *out)
{
  const char *name = yaml_node_text(node);
  const size_t length = node->data.scalar.length;
  const case_place at = case_place_of(r, node->start_mark);
  char words[CASE_MESSAGE];
  if (length == 0 || memchr(name, '\0', length)) {
    message *m = case_blame(r, at);
    message_add(m, "%s is ", what);
    if (length == 0) message_add(m, "empty");
    else message_add_input(m, name, length, 120);
    message_add(m, ", expected %s", any_matrix);
    return HC_BAD_INPUT;
  }
  if (!(out->file = text_file_path(r->name, name, length))) return case_out_of_memory(r);
  const bool matlab = is_matlab_name(out->file);
  out->part = part_of(what);
  if (!matlab) {
    const hc_status st = matrix_file_read(out->file, out->part, expected, n, &out->v, &out->labels, &r->msg);
    if (st == HC_NO_MEMORY) return case_out_of_memory(r);
    if (st != HC_IO) return st;
    snprintf(words, sizeof words, "%s", r->msg.text);
  }
  message *m = case_blame(r, at);
  message_add(m, "%s: ", what);
  message_add_input(m, out->file, strlen(out->file), 160);
  if (matlab) message_add(m, "%s", how_matlab_writes);
  else message_add(m, " %s, expected a matrix as %s", words, any_matrix);
  return HC_BAD_INPUT;
}

hc_status yaml_matrix_read(case_reader *r, yaml_document_t *doc, const char *what, const yaml_node_t *node,
                           int expected, int *n, structure_matrix *out)
{
  structure_matrix given = {.place = case_place_of(r, node->start_mark)};
  hc_status st = HC_BAD_INPUT;
  if (node->type == YAML_SEQUENCE_NODE) st = read_list(r, doc, what, node, expected, n, &given.v);
  else if (node->type == YAML_SCALAR_NODE && is_number(node, expected)) st = read_number(r, what, node, n, &given.v);
  else if (node->type == YAML_SCALAR_NODE) st = read_file(r, what, node, expected, n, &given);
  else message_add(case_blame(r, given.place), "%s is %s, expected %s", what, yaml_node_what(node), any_matrix);
  structure_free_matrix(st == HC_OK ? out : &given);
  if (st == HC_OK) *out = given;
  return st;
}

message *yaml_matrix_blame(case_reader *r, const structure_matrix *m, int i, int j)
{
  size_t line, column;
  if (!m->file) return case_blame(r, m->place);
  matrix_file_place(m->file, m->part, i, j, &line, &column);
  message_start(&r->msg, r->msg.text, r->msg.size);
  message_add_input(&r->msg, m->file, strlen(m->file), 240);
  message_add(&r->msg, ":%zu:%zu: ", line > 0 ? line : 1, line > 0 ? column : 1);
  return &r->msg;
}
