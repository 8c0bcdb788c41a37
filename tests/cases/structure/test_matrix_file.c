/* test_matrix_file.c - Matrix Market files: what is read, and every mistake with its place. */
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

static void is_refused(const char *text, int expected, const char *words)
{
  sparse A = {.n = 7};
  char said[256];
  message m;
  message_start(&m, said, sizeof said);
  const hc_status st = matrix_file_parse("m", text, strlen(text), NULL, expected, &A, NULL, &m);
  if (st != HC_BAD_INPUT || strncmp(said, words, strlen(words)))
    fail_msg("%s\ngave `%s`\nnot  `%s...`", text, said, words);
  assert_null(A.value);
  assert_int_equal(A.n, 0);
}

static void mistakes_are_named_where_they_stand(CHECK_STATE)
{
  is_refused("% a comment\n", 0, "m:1:1: no Matrix Market banner, expected `%%MatrixMarket matrix coordinate real");
  is_refused("%%MatrixMarket matrix coordinate real\n", 0, "m:1:1: a banner of less than five words");
  is_refused("%%MatrixMarket vector coordinate real general\n", 0, "m:1:16: `vector` in the banner, expected matrix");
  is_refused(HEAD("sparse", "real", "general"), 0, "m:1:23: `sparse` in the banner, expected coordinate or array");
  is_refused(HEAD("coordinate", "pattern", "general"), 0, "m:1:34: `pattern` in the banner, expected real or integer");
  is_refused(HEAD("array", "complex", "general"), 0, "m:1:29: `complex` in the banner, expected real or integer");
  is_refused(HEAD("array", "real", "hermitian"), 0,
             "m:1:34: `hermitian` in the banner, expected general, symmetric or");
  is_refused(HEAD("array", "real", "general"), 0, "m:2:1: the file ends before the line of sizes");
  is_refused(HEAD("array", "real", "general") "% 2 2", 0, "m:2:6: the file ends before the line of sizes");
  is_refused(HEAD("array", "real", "general") "2 2 4\n", 0,
             "m:2:1: 3 words where the sizes should stand, expected rows and");
  is_refused(HEAD("coordinate", "real", "general") "2 2\n", 0, "m:2:1: 2 words where the sizes should stand");
  is_refused(HEAD("array", "real", "general") "2 3\n", 0, "m:2:1: a matrix of 2 x 3, expected as many columns as rows");
  is_refused(HEAD("array", "real", "general") "2 2\n", 3, "m:2:1: a matrix of 2 x 2, expected 3 x 3");
  is_refused(HEAD("array", "real", "general") "0 0\n", 0,
             "m:2:1: `0`, expected the number of rows, an integer 1..10000000");
  is_refused(HEAD("array", "real", "general") "2 10000001\n", 0, "m:2:3: `10000001`, expected the number of columns");
  is_refused(HEAD("array", "real", "general") "2.0 2\n", 0, "m:2:1: `2.0`, expected the number of rows");
  is_refused(HEAD("coordinate", "real", "general") "2 2 5\n", 0,
             "m:2:5: `5`, expected the number of entries, an integer 0..4");
  is_refused(HEAD("coordinate", "real", "symmetric") "2 2 4\n", 0,
             "m:2:5: `4`, expected the number of entries, an integer 0..3");
#define LIST(entries) HEAD("coordinate", "real", "general") "2 2 2\n" entries
  is_refused(LIST("1 1 1\n0 1 1\n"), 0, "m:4:1: `0`, expected a row, an integer 1..2");
  is_refused(LIST("1 1 1\n1 3 1\n"), 0, "m:4:3: `3`, expected a column, an integer 1..2");
  is_refused(LIST("1 1 1\n1 1 1\n"), 0, "m:4:1: a second entry (1, 1), expected each once");
  is_refused(LIST("1 1 1\n"), 0, "m:4:1: the file ends after 1 entries, expected 2");
  is_refused(LIST("1 1 1\n% end"), 0, "m:4:6: the file ends after 1 entries, expected 2");
  is_refused(LIST("1 1 1\n2 2 1\n\n1 2 1\n"), 0, "m:6:1: something after the last of 2 entries");
  is_refused(LIST("1 1\n"), 0, "m:3:1: less than three words");
  is_refused(LIST("1 1 1 0\n"), 0, "m:3:1: more than three words");
  is_refused(LIST("1 1 x\n"), 0, "m:3:5: `x`, expected a finite number");
  is_refused(LIST("1 1 nan\n"), 0, "m:3:5: `nan`, expected a finite number");
  is_refused(LIST("1 1 -inf\n"), 0, "m:3:5: `-inf`, expected a finite number");
  is_refused(LIST("1 1 1e999\n"), 0, "m:3:5: `1e999`, expected a finite number");
  is_refused(LIST("1 1 1,5\n"), 0, "m:3:5: `1,5`, expected a finite number (the decimal sign is a point)");
  is_refused(LIST("1 1 1D+3\n"), 0, "m:3:5: `1D+3`, expected a finite number (an exponent is written with E)");
  is_refused(HEAD("array", "integer", "general") "1 1\n1.5\n", 0, "m:3:1: `1.5`, expected a finite integer");
  is_refused(HEAD("array", "real", "general") "1 1\n1 2\n", 0, "m:3:3: a second word, expected one value a line");
  is_refused(HEAD("coordinate", "real", "symmetric") "2 2 1\n1 2 1\n", 0, "m:3:1: entry (1, 2) of a symmetric matrix");
  is_refused(HEAD("coordinate", "real", "skew-symmetric") "2 2 1\n1 1 1\n", 0,
             "m:3:1: entry (1, 1) of a skew-symmetric");
}

static void files_are_found_and_searched(CHECK_STATE)
{
  static const char text[] = HEAD("coordinate", "real", "symmetric") "3 3 3\n1 1 1\n3 1 5\n2 2 1\n";
  const own_file f = write_file("m.mtx", text, sizeof text - 1);
  sparse A;
  size_t line, column;
  char words[256];
  message m;
  message_start(&m, words, sizeof words);
  assert_int_equal(matrix_file_read(f.path, NULL, 3, &A, NULL, &m), HC_OK);
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
