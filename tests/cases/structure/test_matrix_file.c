/* test_matrix_file.c - Matrix Market files: what is read, and every mistake with its place. */
#include "numerics/base/message.h"
#include "tests/cases/structure/structure_text.h"

#define HEAD(format, kind, symmetry) "%%MatrixMarket matrix " format " " kind " " symmetry "\n"

static void reads(const char *text, int n, const double *rows)
{
  sparse A;
  char words[256];
  message m;
  message_start(&m, words, sizeof words);
  if (matrix_file_parse("m", text, strlen(text), NULL, 0, &A, NULL, &m) != HC_OK) fail_msg("%s", words);
  assert_int_equal(A.n, n);
  double *v = sparse_to_dense(&A);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      assert_true(v[i + n * j] == rows[n * i + j]);
      assert_true(v[i + n * j] != 0 || !signbit(v[i + n * j]));
    }
  free(v);
  sparse_free(&A);
}

static void every_format_is_read(CHECK_STATE)
{
  const double full[] = {1, 2, 3, 4}, sym[] = {1, -2.5, -2.5, 4}, skew[] = {0, 2, -2, 0}, one[] = {7};
  const double three[] = {1, 2, 3, 2, 4, 5, 3, 5, 6}, skew_3[] = {0, -1, -2, 1, 0, -3, 2, 3, 0}, zero[] = {0, 0, 0, 0};
  reads(HEAD("coordinate", "real", "general") "2 2 4\n1 1 1\n2 2 4.0\n1 2 2e0\n2 1 +3\n", 2, full);
  reads(HEAD("array", "real", "general") "2 2\n1\n3\n2\n4", 2, full);
  reads(HEAD("coordinate", "real", "symmetric") "2 2 3\n1 1 1\n2 1 -2.5\n2 2 4\n", 2, sym);
  reads(HEAD("array", "integer", "symmetric") "3 3\n1\n2\n3\n4\n5\n6\n", 3, three);
  reads(HEAD("coordinate", "integer", "skew-symmetric") "2 2 1\n2 1 -2\n", 2, skew);
  reads(HEAD("array", "real", "skew-symmetric") "3 3\n1\n2\n3\n", 3, skew_3);
  reads(HEAD("coordinate", "real", "general") "2 2 0\n", 2, zero);
  reads(HEAD("coordinate", "real", "general") "2 2 1\n1 2 -0\n", 2, zero);
  reads("%%matrixmarket MATRIX Coordinate REAL General\r\n% a comment, it says\r\n\r\n"
        "  1\t1 1 \r\n\r\n%\n1 1 7\r\n\r\n%",
        1, one);
}

static void refused_if_expected(const mistake *wrong, int expected)
{
  sparse A = {.n = 7};
  char said[256];
  message m;
  message_start(&m, said, sizeof said);
  const hc_status st = matrix_file_parse("m", wrong->text, strlen(wrong->text), NULL, expected, &A, NULL, &m);
  if (st != HC_BAD_INPUT || strncmp(said, wrong->message, strlen(wrong->message)))
    fail_msg("%s\ngave `%s`\nnot  `%s...`", wrong->text, said, wrong->message);
  assert_null(A.value);
  assert_int_equal(A.n, 0);
}

static void is_refused(const mistake *wrong) { refused_if_expected(wrong, 0); }

static void mistakes_are_named_where_they_stand(CHECK_STATE)
{
  static const mistake two_by_two = {.text = HEAD("array", "real", "general") "2 2\n",
                                     .message = "m:2:1: a matrix of 2 x 2, expected 3 x 3"};
  each_mistake("Matrix Market", 35, is_refused);
  refused_if_expected(&two_by_two, 3);
}

static void files_are_found_and_searched(CHECK_STATE)
{
  static const char text[] = HEAD("coordinate", "real", "symmetric") "3 3 3\n1 1 1\n3 1 5\n2 2 1\n";
  const own_file f = write_file("m.mtx", text, sizeof text - 1);
  size_t line, column;
  char words[256];
  message m;
  message_start(&m, words, sizeof words);
  CHECK_FILLED(sparse, A, matrix_file_read(f.path, NULL, 3, &A, NULL, &m));
  assert_true(A.n == 3 && sparse_at(&A, 2, 0) == 5 && sparse_at(&A, 0, 2) == 5 && sparse_at(&A, 1, 0) == 0);
  sparse_free(&A);
  matrix_file_place(f.path, NULL, 2, 0, &line, &column);
  assert_true(line == 4 && column == 1);
  matrix_file_place(f.path, NULL, 0, 2, &line, &column); /* by symmetry */
  assert_true(line == 4 && column == 1);
  matrix_file_place(f.path, NULL, 1, 0, &line, &column); /* not there */
  assert_true(line == 0 && column == 0);
  assert_int_equal(matrix_file_read(f.folder, NULL, 3, &A, NULL, &m), HC_IO);
  assert_string_equal(words, "is no file");
  message_start(&m, words, sizeof words);
  assert_int_equal(matrix_file_read("no/such/file", NULL, 3, &A, NULL, &m), HC_IO);
  assert_non_null(strstr(words, "cannot be opened: "));
  message_start(&m, words, sizeof words);
  assert_int_equal(matrix_file_read("/dev/zero", NULL, 3, &A, NULL, &m), HC_IO);
  remove_file(&f);
}

CHECK_TESTS("structure.matrix_file", 60, every_format_is_read, mistakes_are_named_where_they_stand,
            files_are_found_and_searched)
