/* test_matlab_file.c - matrices from MATLAB files: every version, class and storage, and every mistake in words. The
 * matrices are written down here, and numbers that every class can hold are compared exactly. The files are libmatio's,
 * and three of Octave 7.3, which are kept here: octave_v4.mat, octave_v6.mat and octave_v7.mat by
 *     M=[2 -1;-1 2]; K=sparse([680 -40;-40 40]); C=single([0.5 -0.25;-0.25 0.5]); d=[1 0.25];
 *     save -v7 octave_v7.mat M K C d      and -v6; -v4 without C, which version 4 has no class for */
#include <pthread.h>

#include "casefile/matrix_file.h"
#include "tests/cases/structure/matlab_files.h"

static const double M[] = {2, -1, -1, 2}, K[] = {680, -40, -40, 40}, C[] = {0.5, -0.25, -0.25, 0.5},
                    d[] = {1, 0, 0, 0.25};

static void those_of_octave(void **state)
{
  (void)state;
  const char *const versions[] = {"v4", "v6", "v7"};
  for (int i = 0; i < 3; ++i) {
    own_file f;
    snprintf(f.path, sizeof f.path, "tests/cases/structure/octave_%s.mat", versions[i]);
    variable_reads(&f, "M", 2, M);
    variable_reads(&f, "K", 2, K);
    variable_reads(&f, "d", 2, d);
    if (i > 0) variable_reads(&f, "C", 2, C);
  }
}

static const struct storage {
  enum mat_ft version;
  enum matio_compression how;
} storages[] = {{MAT_FT_MAT4, MAT_COMPRESSION_NONE},
                {MAT_FT_MAT5, MAT_COMPRESSION_NONE},
                {MAT_FT_MAT5, MAT_COMPRESSION_ZLIB},
                {MAT_FT_MAT73, MAT_COMPRESSION_NONE},
                {MAT_FT_MAT73, MAT_COMPRESSION_ZLIB}};
enum { STORAGES = sizeof storages / sizeof *storages };

/* 3 x 3, by columns, with the same numbers in every type. */
#define NUMBERS                                                                                                        \
  {                                                                                                                    \
    1, 4, 7, 2, 5, 8, 3, 6, 9                                                                                          \
  }
static void every_class_in_every_version(void **state)
{
  (void)state;
  static const double rows[] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  double f64[] = NUMBERS;
  float f32[] = NUMBERS;
  int8_t i8[] = NUMBERS;
  int16_t i16[] = NUMBERS;
  int32_t i32[] = NUMBERS;
  int64_t i64[] = NUMBERS;
  uint8_t u8[] = NUMBERS;
  uint16_t u16[] = NUMBERS;
  uint32_t u32[] = NUMBERS;
  uint64_t u64[] = NUMBERS;
  const struct {
    const char *name;
    enum matio_classes class;
    enum matio_types type;
    void *data;
  } all[] = {{"f64", MAT_C_DOUBLE, MAT_T_DOUBLE, f64}, {"f32", MAT_C_SINGLE, MAT_T_SINGLE, f32},
             {"i8", MAT_C_INT8, MAT_T_INT8, i8},       {"i16", MAT_C_INT16, MAT_T_INT16, i16},
             {"i32", MAT_C_INT32, MAT_T_INT32, i32},   {"i64", MAT_C_INT64, MAT_T_INT64, i64},
             {"u8", MAT_C_UINT8, MAT_T_UINT8, u8},     {"u16", MAT_C_UINT16, MAT_T_UINT16, u16},
             {"u32", MAT_C_UINT32, MAT_T_UINT32, u32}, {"u64", MAT_C_UINT64, MAT_T_UINT64, u64}};
  for (int s = 0; s < STORAGES; ++s) {
    const int n = storages[s].version == MAT_FT_MAT4 ? 1 : sizeof all / sizeof *all; /* version 4 has doubles */
    own_file f;
    mat_t *mat = new_matlab_file(&f, storages[s].version);
    for (int i = 0; i < n; ++i)
      add_matrix(mat, all[i].name, all[i].class, all[i].type, 3, 3, all[i].data, 0, storages[s].how);
    Mat_Close(mat);
    for (int i = 0; i < n; ++i) variable_reads(&f, all[i].name, 3, rows);
    remove_file(&f);
  }
}

/* Columns without entries at the beginning, in the middle and at the end; nothing at all; a row; -0. */
static void sparse_and_diagonal(void **state)
{
  (void)state;
  static const double K4[] = {0, 0, 0, 0, 0, 0, 0, 7, 0, 2, 0, 0, 0, -3, 0, 0}, line[] = {1, 0, 0, 0, 0, 0, 0, 0, 3};
  static const double zero[4], one[] = {5};
  mat_uint32_t ir[] = {2, 3, 1}, jc[] = {0, 0, 2, 2, 3}, flat_ir[] = {0, 0}, flat_jc[] = {0, 1, 1, 2},
               none[] = {0, 0, 0};
  double data[] = {2, -3, 7}, two[] = {1, 3}, diagonal[] = {1, -0.0, 3}, five[] = {5};
  for (int s = 0; s < STORAGES; ++s) {
    own_file f;
    const bool v4 = storages[s].version == MAT_FT_MAT4; /* libmatio writes no sparse matrix there; Octave's are above */
    mat_t *mat = new_matlab_file(&f, storages[s].version);
    if (!v4) {
      add_sparse(mat, "K", 4, 4, ir, jc, data, storages[s].how);
      add_sparse(mat, "flat", 1, 3, flat_ir, flat_jc, two, storages[s].how);
      if (storages[s].version == MAT_FT_MAT5) add_sparse(mat, "zero", 2, 2, ir, none, data, storages[s].how);
    }
    add_matrix(mat, "row", MAT_C_DOUBLE, MAT_T_DOUBLE, 1, 3, diagonal, 0, storages[s].how);
    add_matrix(mat, "column", MAT_C_DOUBLE, MAT_T_DOUBLE, 3, 1, diagonal, 0, storages[s].how);
    add_matrix(mat, "one", MAT_C_DOUBLE, MAT_T_DOUBLE, 1, 1, five, 0, storages[s].how);
    Mat_Close(mat);
    if (!v4) {
      variable_reads(&f, "K", 4, K4);
      variable_reads(&f, "flat", 3, line);
      if (storages[s].version == MAT_FT_MAT5) variable_reads(&f, "zero", 2, zero);
    }
    variable_reads(&f, "row", 3, line);
    variable_reads(&f, "column", 3, line);
    variable_reads(&f, "one", 1, one);
    remove_file(&f);
  }
}

static void what_is_no_matrix(void **state)
{
  (void)state;
  for (int s = 0; s < STORAGES; ++s) {
    const enum matio_compression how = storages[s].how;
    const bool v4 = storages[s].version == MAT_FT_MAT4;
    double re[] = {1, 0, 0, 1}, im[] = {0, 1, 2, 0}, gap[] = {1, NAN, 0, 1}, large[] = {1, 0, -INFINITY, 1};
    double cube[8] = {0}, six[6] = {0};
    uint8_t yes[] = {1, 0, 0, 1};
    char text[] = "text";
    mat_complex_split_t z = {re, im};
    size_t dims[] = {2, 2, 2}, one[] = {1, 1};
    const char *field[] = {"M"};
    own_file f;
    mat_t *mat = new_matlab_file(&f, storages[s].version);
    add_matrix(mat, "z", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, 2, &z, MAT_F_COMPLEX, how);
    add_matrix(mat, "gap", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, 2, gap, 0, how);
    add_matrix(mat, "large", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, 2, large, 0, how);
    add_matrix(mat, "flat", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, 3, six, 0, how);
    add_matrix(mat, "text", MAT_C_CHAR, v4 ? MAT_T_UINT8 : MAT_T_UTF8, 1, 4, text, 0, how);
    if (!v4) {
      add_matrix(mat, "yes", MAT_C_UINT8, MAT_T_UINT8, 2, 2, yes, MAT_F_LOGICAL, how);
      add_matrix(mat, "none", MAT_C_DOUBLE, MAT_T_DOUBLE, 0, 0, six, 0, how);
      add_variable(mat, Mat_VarCreate("cube", MAT_C_DOUBLE, MAT_T_DOUBLE, 3, dims, cube, 0), how);
      add_variable(mat, Mat_VarCreateStruct("s", 2, one, field, 1), how);
      matvar_t *inside[] = {Mat_VarCreate(NULL, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, six, 0)}; /* the cell's own */
      add_variable(mat, Mat_VarCreate("cell", MAT_C_CELL, MAT_T_CELL, 2, one, inside, 0), how);
    }
    Mat_Close(mat);
    variable_is_refused(&f, "z", 2, "is complex, expected real numbers");
    variable_is_refused(&f, "gap", 2, "is NaN at (2, 1), expected finite numbers");
    variable_is_refused(&f, "large", 2, "is infinite at (1, 2), expected finite numbers");
    variable_is_refused(&f, "flat", 0,
                        "is 2 x 3, expected as many columns as rows, or one row or column with the diag");
    variable_is_refused(&f, "flat", 2, "is 2 x 3, expected 2 x 2, or the 2 numbers of a diagonal");
    variable_is_refused(&f, "gap", 3, "is 2 x 2, expected 3 x 3, or the 3 numbers of a diagonal");
    variable_is_refused(&f, "text", 0, "is text, expected a matrix of numbers");
    if (!v4) {
      variable_is_refused(&f, "yes", 2, "is logical, expected a matrix of numbers");
      variable_is_refused(&f, "none", 0, "is 0 x 0, expected 1 to 4000 rows");
      variable_is_refused(&f, "cube", 2, "has 3 dimensions, expected 2");
      variable_is_refused(&f, "s", 2, "is a structure, expected a matrix of numbers (give each a name");
      variable_is_refused(&f, "cell", 1, "is a cell array, expected a matrix of numbers");
    }
    remove_file(&f);
  }
}

static void names_that_are_not_there(void **state)
{
  (void)state;
  double one[] = {1};
  own_file f;
  mat_t *mat = new_matlab_file(&f, MAT_FT_MAT5);
  add_matrix(mat, "M", MAT_C_DOUBLE, MAT_T_DOUBLE, 1, 1, one, 0, MAT_COMPRESSION_NONE);
  Mat_Close(mat);
  char words[512];
  double *v;
  int n;
  message m;
  message_start(&m, words, sizeof words);
  assert_int_equal(matlab_file_read(f.path, 0, &n, &v, &m), HC_OK); /* one variable needs no name */
  assert_true(n == 1 && v[0] == 1);
  free(v);
  remove_file(&f);

  mat = new_matlab_file(&f, MAT_FT_MAT5);
  const char *const names[] = {"C", "M", "stiffness"};
  for (int i = 0; i < 3; ++i) add_matrix(mat, names[i], MAT_C_DOUBLE, MAT_T_DOUBLE, 1, 1, one, 0, MAT_COMPRESSION_NONE);
  Mat_Close(mat);
  name_is_refused(f.path, 0, "names no variable: the file has `C`, `M` and `stiffness`, expected FILE.mat#VARIABLE");
  variable_is_refused(&f, "m", 0,
                      "is not there: the file has `C`, `M` and `stiffness`, expected FILE.mat#VARIABLE of these, "
                      "did you mean `M`?");
  variable_is_refused(&f, "stifness", 0,
                      "is not there: the file has `C`, `M` and `stiffness`, expected FILE.mat#VARIABLE of these, "
                      "did you mean `stiffness`?");
  variable_is_refused(&f, "", 0, "is not there: the file has `C`, `M` and `stiffness`, expected FILE");
  variable_is_refused(&f, "\t", 0, "is not there: the file has `C`, `M` and `stiffness`, expected FILE");
  remove_file(&f);

  mat = new_matlab_file(&f, MAT_FT_MAT5);
  for (int i = 0; i < 20; ++i) {
    char name[16];
    snprintf(name, sizeof name, "x%d", i);
    add_matrix(mat, name, MAT_C_DOUBLE, MAT_T_DOUBLE, 1, 1, one, 0, MAT_COMPRESSION_NONE);
  }
  Mat_Close(mat);
  variable_is_refused(&f, "M", 0,
                      "is not there: the file has `x0`, `x1`, `x2`, `x3`, `x4`, `x5`, `x6`, `x7`, `x8`, `x9`, `x10`, "
                      "`x11` and 8 more, expected");
  remove_file(&f);
}

static void files_that_are_none(void **state)
{
  (void)state;
  static const struct {
    const char *text, *words;
  } all[] = {{"nonsense, and more of it than a header has", "is in no MATLAB file or a damaged one, expected version"},
             {"# Created by Octave 7.3.0, Sun Nov 22 10:45:00 2026 UTC\n# name: M\n# type: matrix\n",
              "is in no MATLAB file or a damaged one, expected version 4, 5 (-v6, -v7) or 7.3 (Octave writes one with"},
             {"%%MatrixMarket matrix array real general\n1 1\n1\n",
              "is in no MATLAB file or a damaged one, expected version 4, 5 (-v6, -v7) or 7.3 (a Matrix Market file"},
             {"", "is not there: the file has no variable"}};
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    const own_file f = write_file("x.mat", all[i].text, strlen(all[i].text));
    variable_is_refused(&f, "M", 0, all[i].words);
    remove_file(&f);
  }
  const char *const gone[] = {"no/such/rom.mat#M", "no/such/rom.MAT"};
  for (int i = 0; i < 2; ++i) {
    double *v;
    int n;
    char words[512];
    message m;
    message_start(&m, words, sizeof words);
    assert_int_equal(matlab_file_read(gone[i], 0, &n, &v, &m), HC_IO);
    assert_string_equal(words, "cannot be opened: No such file or directory");
  }
  assert_true(matlab_file_meant("a.mat") && matlab_file_meant("a.Mat#b") && matlab_file_meant("a#b.mat#c"));
  assert_false(matlab_file_meant("a.mtx") || matlab_file_meant("a.mtx#M") || matlab_file_meant("mat#M") ||
               matlab_file_meant("#") || matlab_file_meant("a.matrix"));
}

/* The same bits as from Matrix Market: a case read twice. */
static void beam_as_by_matrix_market(void **state)
{
  (void)state;
  static const char *const parts[] = {"mass", "damping", "stiffness"}, letters[] = "MDK";
  const char *path = "cases/structures/beam16.yaml";
  own_file f;
  mat_t *mat = new_matlab_file(&f, MAT_FT_MAT5);
  char set[3][256];
  for (int i = 0; i < 3; ++i) {
    char mtx[64], words[256], name[2] = {letters[i], '\0'};
    double *v;
    int n;
    message m;
    message_start(&m, words, sizeof words);
    snprintf(mtx, sizeof mtx, "cases/structures/beam16_%c.mtx", letters[i]);
    assert_int_equal(matrix_file_read(mtx, 0, &n, &v, &m), HC_OK);
    add_matrix(mat, name, MAT_C_DOUBLE, MAT_T_DOUBLE, (size_t)n, (size_t)n, v, 0, MAT_COMPRESSION_ZLIB);
    free(v);
    snprintf(set[i], sizeof set[i], "structure.%s=%s#%s", parts[i], f.path, name);
  }
  Mat_Close(mat);
  const char *const sets[] = {set[0], set[1], set[2]};
  scene by_mtx, by_mat;
  case_error err;
  model *a, *b;
  assert_int_equal(case_read(path, 0, NULL, &by_mtx, &err), HC_OK);
  if (case_read(path, 3, sets, &by_mat, &err) != HC_OK) fail_msg("%s", err.message);
  assert_int_equal(scene_model(&by_mtx, &a), HC_OK);
  assert_int_equal(scene_model(&by_mat, &b), HC_OK);
  same_models(a, b);
  model_free(a);
  model_free(b);
  case_clear(&by_mtx);
  case_clear(&by_mat);
  remove_file(&f);
}

/* A case's message has its own place, the file and the variable. */
static void places_in_the_case(void **state)
{
  (void)state;
  double unequal[] = {1, 0.5, 0, 1}, negative[] = {1, 0, 0, -1};
  char text[512], words[512];
  own_file f;
  mat_t *mat = new_matlab_file(&f, MAT_FT_MAT5);
  add_matrix(mat, "U", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, 2, unequal, 0, MAT_COMPRESSION_NONE);
  add_matrix(mat, "N", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, 2, negative, 0, MAT_COMPRESSION_NONE);
  Mat_Close(mat);
  static const struct {
    const char *name, *words;
  } all[] = {{"U", "#U: structure.mass is not symmetric: entry (2, 1) is 0.5, but (1, 2) is 0"},
             {"N", "#N: structure.mass is not positive definite: its leading minor of order 2"}};
  for (int i = 0; i < 2; ++i) {
    snprintf(text, sizeof text, "structure: {mass: %s#%s, stiffness: [1, 1], damping: [0, 0]}\n" SWEEP, f.path,
             all[i].name);
    snprintf(words, sizeof words, "%s%s", f.path, all[i].words);
    refused(text, NULL, "f:1:19: ", words);
  }
  snprintf(text, sizeof text, "structure: {mass: [1, 1, 1], stiffness: %s#N, damping: [0, 0, 0]}\n" SWEEP, f.path);
  snprintf(words, sizeof words, "structure.stiffness: %s#N is 2 x 2, expected 3 x 3, or the 3 numbers", f.path);
  refused(text, NULL, "f:1:41: ", words);
  snprintf(text, sizeof text, "structure: {mass: %s.gone.mat#N, stiffness: [1], damping: [1]}\n" SWEEP, f.path);
  refused(text, NULL, "f:1:19: ", "#N cannot be opened: No such file or directory, expected a matrix as rows, a diag");
  remove_file(&f);
}

/* HDF5 is not for threads; each reading has a process of its own. */
static void *read_often(void *file)
{
  bool *right = malloc(sizeof *right);
  char name[192], words[512];
  *right = true;
  for (int i = 0; i < 25; ++i) {
    double *v;
    int n;
    message m;
    message_start(&m, words, sizeof words);
    const hc_status st = matlab_file_read(variable_of(file, "K", name), 2, &n, &v, &m);
    *right = *right && st == HC_OK && n == 2 && v[0] == K[0] && v[1] == K[1] && v[2] == K[2] && v[3] == K[3];
    free(v);
  }
  return right;
}

static void threads_at_once(void **state)
{
  (void)state;
  double k[] = {680, -40, -40, 40};
  pthread_t threads[4];
  own_file f;
  mat_t *mat = new_matlab_file(&f, MAT_FT_MAT73);
  add_matrix(mat, "K", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, 2, k, 0, MAT_COMPRESSION_NONE);
  Mat_Close(mat);
  for (int i = 0; i < 4; ++i) assert_int_equal(pthread_create(&threads[i], NULL, read_often, &f), 0);
  for (int i = 0; i < 4; ++i) {
    void *right;
    assert_int_equal(pthread_join(threads[i], &right), 0);
    assert_true(*(bool *)right);
    free(right);
  }
  remove_file(&f);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(those_of_octave),          cmocka_unit_test(every_class_in_every_version),
    cmocka_unit_test(sparse_and_diagonal),      cmocka_unit_test(what_is_no_matrix),
    cmocka_unit_test(names_that_are_not_there), cmocka_unit_test(files_that_are_none),
    cmocka_unit_test(beam_as_by_matrix_market), cmocka_unit_test(places_in_the_case),
    cmocka_unit_test(threads_at_once),
};

CHECK_MAIN("structure.matlab_file", tests, 120)
