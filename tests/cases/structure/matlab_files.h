/* matlab_files.h - MATLAB files written by libmatio, for the tests of reading them, and what a reading must give. */
#ifndef HC_TESTS_MATLAB_FILES_H
#define HC_TESTS_MATLAB_FILES_H

#include <matio.h>

#include "casefile/matlab_file.h"
#include "tests/cases/structure/structure_text.h"

/* A new file in a new folder, of version MAT_FT_MAT4, MAT_FT_MAT5 or MAT_FT_MAT73. */
static inline mat_t *new_matlab_file(own_file *f, enum mat_ft version)
{
  *f = write_file("rom.mat", "", 0);
  mat_t *mat = Mat_CreateVer(f->path, "written by a test", version);
  assert_non_null(mat);
  return mat;
}

static inline void add_variable(mat_t *mat, matvar_t *v, enum matio_compression how)
{
  assert_non_null(v);
  assert_int_equal(Mat_VarWrite(mat, v, how), 0);
  Mat_VarFree(v);
}

/* data[rows][columns] by columns, of that class and of the type that goes with it; flags: MAT_F_... */
static inline void add_matrix(mat_t *mat, const char *name, enum matio_classes class, enum matio_types type,
                              size_t rows, size_t columns, void *data, int flags, enum matio_compression how)
{
  size_t dims[2] = {rows, columns};
  add_variable(mat, Mat_VarCreate(name, class, type, 2, dims, data, flags), how);
}

/* A sparse matrix of doubles by compressed columns; jc[columns + 1]. */
static inline void add_sparse(mat_t *mat, const char *name, size_t rows, size_t columns, mat_uint32_t *ir,
                              mat_uint32_t *jc, double *data, enum matio_compression how)
{
  const mat_uint32_t entries = jc[columns];
  size_t dims[2] = {rows, columns};
  mat_sparse_t s = {.nzmax = entries,
                    .ir = ir,
                    .nir = entries,
                    .jc = jc,
                    .njc = (mat_uint32_t)columns + 1,
                    .ndata = entries,
                    .data = data};
  add_variable(mat, Mat_VarCreate(name, MAT_C_SPARSE, MAT_T_DOUBLE, 2, dims, &s, MAT_F_DONT_COPY_DATA), how);
}

/* FILE#name in text[192], which is returned. */
static inline const char *variable_of(const own_file *f, const char *name, char text[192])
{
  snprintf(text, 192, "%s#%s", f->path, name);
  return text;
}

/* The variable is the matrix rows[n][n], by rows. */
static inline void variable_reads(const own_file *f, const char *variable, int n, const double *rows)
{
  char name[192], words[512];
  double *v;
  int found;
  message m;
  message_start(&m, words, sizeof words);
  if (matlab_file_read(variable_of(f, variable, name), 0, &found, &v, &m) != HC_OK) fail_msg("%s %s", name, words);
  assert_string_equal(words, "");
  assert_int_equal(found, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (v[i + n * j] != rows[n * i + j]) fail_msg("%s(%d, %d) is %g", variable, i + 1, j + 1, v[i + n * j]);
      assert_true(v[i + n * j] != 0 || !signbit(v[i + n * j]));
    }
  free(v);
}

/* `name` is refused with words that begin like this. */
static inline void name_is_refused(const char *name, int expected, const char *start)
{
  double other = 0, *v = &other;
  int n = 7;
  char words[512];
  message m;
  message_start(&m, words, sizeof words);
  const hc_status st = matlab_file_read(name, expected, &n, &v, &m);
  if (st != HC_BAD_INPUT || strncmp(words, start, strlen(start)))
    fail_msg("%s: status %d\ngave `%s`\nnot  `%s...`", name, (int)st, words, start);
  assert_null(v);
  assert_int_equal(n, 0);
}

static inline void variable_is_refused(const own_file *f, const char *variable, int expected, const char *start)
{
  char name[192];
  name_is_refused(variable_of(f, variable, name), expected, start);
}

#endif
