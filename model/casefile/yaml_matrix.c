/* yaml_matrix.c - a matrix of a structure: rows, a diagonal, a number (n = 1), or the name of a file. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "model/casefile/case_reader.h"
#include "model/casefile/matrices/matrix_file.h"
#include "numerics/base/number.h"

#define ANY_MATRIX "rows, a diagonal, or a file of Matrix Market, CalculiX or Abaqus"

hc_status yaml_number(case_reader *r, const yaml_node_t *node, const char *what, double *x)
{
  number_fault fault = NUMBER_NONE;
  const bool scalar = node->type == YAML_SCALAR_NODE, quoted = scalar && yaml_node_item(node).quoted;
  if (scalar && !quoted) fault = number_read(yaml_node_text(node), node->data.scalar.length, x);
  *x = fault == NUMBER_FINE ? *x + 0.0 : 0; /* -0 is 0 */
  if (fault == NUMBER_FINE) return HC_OK;
  const bool text = scalar && node->data.scalar.length > 0;
  return yaml_refuse(r, node, "%s is %s, expected a number%s", what, text ? YAML_QUOTED(node) : yaml_node_what(node),
                     quoted                       ? " (in quotes it is text)"
                     : fault == NUMBER_NOT_FINITE ? " (it must be finite)"
                                                  : "");
}

/* Row i, or with i < 0 the diagonal. */
static hc_status read_row(case_reader *r, const char *what, const yaml_node_t *row, int n, int i, double *v)
{
  char path[FIELD_PATH + 32];
  const size_t stride = (size_t)n + (i < 0), first = i < 0 ? 0 : (size_t)i;
  snprintf(path, sizeof path, i < 0 ? "%s" : "%s[%d]", what, i);
  if (row->type != YAML_SEQUENCE_NODE)
    return yaml_refuse(r, row, "%s is %s, expected a row of %d numbers", path, yaml_node_what(row), n);
  if (yaml_length(row) != n) return yaml_refuse(r, row, "%s has %d entries, expected %d", path, yaml_length(row), n);
  for (int j = 0; j < n; ++j) {
    snprintf(path, sizeof path, i < 0 ? "%s[%d]" : "%s[%d][%d]", what, i < 0 ? j : i, j);
    const hc_status st = yaml_number(r, yaml_entry(r, row, j), path, &v[first + stride * (size_t)j]);
    if (st != HC_OK) return st;
  }
  return HC_OK;
}

static hc_status read_list(case_reader *r, const char *what, const yaml_node_t *node, int expected, int *n, double **v)
{
  *n = yaml_length(node);
  const bool rows = *n > 0 && yaml_entry(r, node, 0)->type == YAML_SEQUENCE_NODE;
  if (*n < 1 || *n > MATRIX_MOST_DENSE)
    return yaml_refuse(r, node, "%s is a list of %d, expected 1 to %d rows, or a diagonal", what, *n,
                       (int)MATRIX_MOST_DENSE);
  if (expected > 0 && *n != expected)
    return yaml_refuse(r, node, "%s has %d %s, expected %d", what, *n, rows ? "rows" : "entries", expected);
  if (!(*v = calloc((size_t)*n * (size_t)*n, sizeof **v))) return case_out_of_memory(r);
  hc_status st = HC_OK;
  if (!rows) return read_row(r, what, node, *n, -1, *v);
  for (int i = 0; i < *n && st == HC_OK; ++i) st = read_row(r, what, yaml_entry(r, node, i), *n, i, *v);
  return st;
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
    "Matrix Market, which MATLAB writes by: [i,j,v] = find(M); f = fopen('M.mtx','w'); "
    "fprintf(f,'%%%%MatrixMarket matrix coordinate real general\\n%d %d %d\\n',size(M),numel(v)); "
    "fprintf(f,'%d %d %.17g\\n',[i j v]'); fclose(f)";

static hc_status read_file(case_reader *r, const char *what, const yaml_node_t *node, int expected, int *n,
                           structure_matrix *out)
{
  const char *name = yaml_node_text(node);
  const size_t length = node->data.scalar.length;
  if (length == 0 || memchr(name, '\0', length)) {
    message *m = yaml_blame(r, node);
    message_add(m, "%s is ", what);
    message_add_input(m, length > 0 ? name : "empty", length > 0 ? length : 5, 120);
    message_add(m, ", expected %s", ANY_MATRIX);
    return HC_BAD_INPUT;
  }
  if (!(out->file = yaml_file_beside(r, node))) return case_out_of_memory(r);
  out->part = part_of(what);
  if (is_matlab_name(out->file)) {
    message_add(&r->msg, "is a MATLAB file, which is not read");
    return yaml_file_failed(r, node, what, out->file, how_matlab_writes);
  }
  const hc_status st = matrix_file_read(out->file, out->part, expected, &out->kept, &out->labels, &r->msg);
  *n = out->kept.n;
  if (st == HC_NO_MEMORY) return case_out_of_memory(r);
  const bool dense = *n <= r->most_dense;
  if (st == HC_OK && !dense && !r->takes_large) {
    /* Measured: 80 matrices at a frequency of `frf`, docs/models.md. */
    return yaml_refuse(
        r, node,
        "%s has %d rows, with which a frequency takes about %.0f GB, expected at most %d: `hbmcheck reduce "
        "CASE -o FOLDER` makes a smaller model of it",
        what, *n, 80 * 8e-9 * *n * *n, r->most_dense);
  }
  if (st == HC_OK && dense) {
    out->v = sparse_to_dense(&out->kept);
    sparse_free(&out->kept);
    if (!out->v) return case_out_of_memory(r);
  }
  return st != HC_IO ? st : yaml_file_failed(r, node, what, out->file, "a matrix as " ANY_MATRIX);
}

hc_status yaml_matrix_read(case_reader *r, const char *what, const yaml_node_t *node, int expected, int *n,
                           structure_matrix *out)
{
  structure_matrix given = {.place = yaml_place(r, node)};
  hc_status st;
  double x;
  if (node->type == YAML_SEQUENCE_NODE) {
    st = read_list(r, what, node, expected, n, &given.v);
  } else if (node->type != YAML_SCALAR_NODE) {
    st = yaml_refuse(r, node, "%s is %s, expected %s", what, yaml_node_what(node), ANY_MATRIX);
  } else if (expected > 1 || yaml_node_item(node).quoted ||
             number_read(yaml_node_text(node), node->data.scalar.length, &x) != NUMBER_FINE) {
    st = read_file(r, what, node, expected, n, &given);
  } else { /* one number */
    *n = 1;
    if (!(given.v = malloc(sizeof x))) return case_out_of_memory(r);
    *given.v = x + 0.0; /* -0 is 0 */
    st = HC_OK;
  }
  structure_free_matrix(st == HC_OK ? out : &given);
  if (st != HC_OK) return st;
  *out = given;
  if (!out->v || *n <= r->most_dense) return HC_OK;
  st = sparse_from_dense(*n, out->v, &out->kept);
  free(out->v);
  out->v = NULL;
  return st == HC_OK ? st : case_out_of_memory(r);
}

hc_status yaml_matrix_symmetric(case_reader *r, const char *what, const structure_matrix *m, int n)
{
  char a[NUMBER_TEXT], b[NUMBER_TEXT];
  int i, j;
  if (!(m->v ? structure_unsymmetric(n, m->v, &i, &j) : sparse_unsymmetric(&m->kept, STRUCTURE_SYMMETRY, &i, &j)))
    return HC_OK;
  const double ij = m->v ? m->v[i + j * (size_t)n] : sparse_at(&m->kept, i, j);
  const double ji = m->v ? m->v[j + i * (size_t)n] : sparse_at(&m->kept, j, i);
  message_add(yaml_matrix_blame(r, m, i, j),
              "%s is not symmetric: entry (%d, %d) is %s, but (%d, %d) is %s, expected a symmetric matrix", what, i + 1,
              j + 1, number_write(ij, a), j + 1, i + 1, number_write(ji, b));
  return HC_BAD_INPUT;
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
