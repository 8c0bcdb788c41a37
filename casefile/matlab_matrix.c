/* matlab_matrix.c - libmatio's variable as a square matrix; see matlab_variable.h. */
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "casefile/matlab_variable.h"
#include "casefile/matrix_file.h"

static hc_status refuse(message *m, const char *words)
{
  message_add(m, "%s", words);
  return HC_BAD_INPUT;
}

/* What a variable is that holds no numbers, or NULL. */
static const char *not_numbers(const matvar_t *v)
{
  if (v->isLogical) return "is logical, expected a matrix of numbers";
  switch ((int)v->class_type) {
  case MAT_C_CHAR: return "is text, expected a matrix of numbers";
  case MAT_C_CELL: return "is a cell array, expected a matrix of numbers";
  case MAT_C_STRUCT: return "is a structure, expected a matrix of numbers (give each a name of its own: M = s.M)";
  case MAT_C_FUNCTION: return "is a function, expected a matrix of numbers";
  case MAT_C_OBJECT:
  case MAT_C_OPAQUE: return "is an object, expected a matrix of numbers";
  case MAT_C_SPARSE:
  case MAT_C_DOUBLE:
  case MAT_C_SINGLE:
  case MAT_C_INT8:
  case MAT_C_UINT8:
  case MAT_C_INT16:
  case MAT_C_UINT16:
  case MAT_C_INT32:
  case MAT_C_UINT32:
  case MAT_C_INT64:
  case MAT_C_UINT64: return v->isComplex ? "is complex, expected real numbers" : NULL;
  default: return "is of an unknown class, expected a matrix of numbers";
  }
}

/* Rows of the square matrix; of a row or a column, its length. 0: neither. */
static size_t order_of(const matvar_t *v)
{
  const size_t rows = v->dims[0], columns = v->dims[1];
  return rows == columns || columns == 1 ? rows : rows == 1 ? columns : 0;
}

hc_status matlab_matrix_check(const matvar_t *v, int expected, int *n, message *m)
{
  const char *what = not_numbers(v);
  *n = 0;
  if (what) return refuse(m, what);
  if (v->rank != 2 || !v->dims) {
    message_add(m, "has %d dimensions, expected 2", v->rank);
    return HC_BAD_INPUT;
  }
  const size_t order = order_of(v);
  if (order >= 1 && order <= MATRIX_MOST_ROWS && (expected == 0 || order == (size_t)expected)) {
    *n = (int)order;
    return HC_OK;
  }
  message_add(m, "is %zu x %zu, expected ", v->dims[0], v->dims[1]);
  if (expected > 0) message_add(m, "%d x %d, or the %d numbers of a diagonal", expected, expected, expected);
  else if (order > 0 || v->dims[0] == v->dims[1]) message_add(m, "1 to %d rows", (int)MATRIX_MOST_ROWS);
  else message_add(m, "as many columns as rows, or one row or column with the diagonal");
  return HC_BAD_INPUT;
}

/* Number k of data. false: no type that numbers have. */
static bool number_at(const void *data, enum matio_types type, size_t k, double *x)
{
#define AS(name, type)                                                                                                 \
  case name: *x = (double)((const type *)data)[k]; return true
  switch ((int)type) {
    AS(MAT_T_DOUBLE, double);
    AS(MAT_T_SINGLE, float);
    AS(MAT_T_INT8, mat_int8_t);
    AS(MAT_T_UINT8, mat_uint8_t);
    AS(MAT_T_INT16, mat_int16_t);
    AS(MAT_T_UINT16, mat_uint16_t);
    AS(MAT_T_INT32, mat_int32_t);
    AS(MAT_T_UINT32, mat_uint32_t);
    AS(MAT_T_INT64, mat_int64_t);
    AS(MAT_T_UINT64, mat_uint64_t);
  default: return false;
  }
#undef AS
}

/* Entry (i, j) of v as numbered there; a row's or column's goes onto the diagonal. */
static hc_status store(const matvar_t *v, int n, size_t i, size_t j, double x, double *out, message *m)
{
  const bool square = v->dims[0] == v->dims[1];
  const size_t row = square ? i : i + j, column = square ? j : i + j;
  if (!isfinite(x)) {
    message_add(m, "is %s at (%zu, %zu), expected finite numbers", isnan(x) ? "NaN" : "infinite", i + 1, j + 1);
    return HC_BAD_INPUT;
  }
  out[row + (size_t)n * column] = x + 0.0; /* -0 is 0 */
  return HC_OK;
}

static hc_status fill_full(const matvar_t *v, int n, double *out, message *m)
{
  const size_t rows = v->dims[0], count = rows * v->dims[1]; /* at most n^2 */
  const size_t size = Mat_SizeOf(v->data_type);
  hc_status st = HC_OK;
  if (size == 0 || v->nbytes / size != count) return refuse(m, "is damaged, expected a number for each entry");
  for (size_t k = 0; k < count && st == HC_OK; ++k) {
    double x;
    if (!number_at(v->data, v->data_type, k, &x)) return refuse(m, "is of an unknown type, expected numbers");
    st = store(v, n, k % rows, k / rows, x, out, m);
  }
  return st;
}

/* Column j is entries jc[j]..jc[j+1]-1 of ir, the rows, ascending, and data. */
static hc_status fill_sparse(const matvar_t *v, int n, double *out, message *m)
{
  const mat_sparse_t *s = v->data;
  const size_t rows = v->dims[0], columns = v->dims[1];
  const char *damaged = "is damaged, expected a sparse matrix with its entries inside";
  double x;
  if (s->njc != columns + 1 || !s->jc || s->jc[0] != 0) return refuse(m, damaged);
  const size_t entries = s->jc[columns];
  if (entries > s->nir || entries > s->ndata || (entries > 0 && (!s->ir || !s->data))) return refuse(m, damaged);
  for (size_t j = 0; j < columns; ++j) {
    if (s->jc[j] > s->jc[j + 1] || s->jc[j + 1] > entries) return refuse(m, damaged);
    for (size_t k = s->jc[j]; k < s->jc[j + 1]; ++k) {
      const bool ascends = k == s->jc[j] || s->ir[k - 1] < s->ir[k];
      if (s->ir[k] >= rows || !ascends || !number_at(s->data, v->data_type, k, &x)) return refuse(m, damaged);
      const hc_status st = store(v, n, s->ir[k], j, x, out, m);
      if (st != HC_OK) return st;
    }
  }
  return HC_OK;
}

hc_status matlab_matrix_fill(const matvar_t *v, int n, double *out, message *m)
{
  if (!v->data) return refuse(m, "has no data, expected a matrix of numbers");
  return v->class_type == MAT_C_SPARSE ? fill_sparse(v, n, out, m) : fill_full(v, n, out, m);
}
