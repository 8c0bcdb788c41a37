/* fuzz_matrix.c - bytes as a matrix file: read, and the same written as Matrix Market; or refused. */
#include <string.h>

#include "model/casefile/matrices/matrix_file.h"
#include "numerics/base/message.h"
#include "tests/fuzz/fuzz.h"

enum { WORDS = 512, LARGE = 50 /* rows: what is larger is zeros for the most part, and takes long to write */ };

/* What is larger is zeros for the most part: a number stands for it. */
static double *sparse_to_dense_if_small(const sparse *A)
{
  return A->n <= LARGE ? sparse_to_dense(A) : calloc(1, sizeof(double));
}

static hc_status parse(const char *text, size_t size, int expected, int *n, double **v, char words[WORDS])
{
  message m;
  sparse A;
  message_start(&m, words, WORDS);
  const hc_status st = matrix_file_parse("f", text, size, NULL, expected, &A, NULL, &m);
  *n = A.n;
  *v = st == HC_OK ? sparse_to_dense_if_small(&A) : NULL;
  sparse_free(&A);
  return st;
}

static void array_reads_back(int n, const double *v)
{
  char *text = NULL, number[NUMBER_TEXT], words[WORDS];
  size_t length = 0;
  double *back;
  int rows;
  FILE *to = open_memstream(&text, &length);
  must(to != NULL, "out of memory");
  fprintf(to, "%%%%MatrixMarket matrix array real general\n%d %d\n", n, n);
  for (int i = 0; i < n * n; ++i) fprintf(to, "%s\n", number_write(v[i], number));
  must(fclose(to) == 0, "out of memory");
  must(parse(text, length, n, &rows, &back, words) == HC_OK, "written as an array it is refused: %s", words);
  must(rows == n && !memcmp(v, back, (size_t)(n * n) * sizeof *v), "written as an array it is another matrix:\n%s",
       text);
  free(back);
  free(text);
}

/* A part that is asked for by its name is read, or missed with a place. */
static void part_is_one_of_them(const char *text, size_t size, const char *part)
{
  char words[WORDS];
  sparse A;
  matrix_label *labels;
  message m;
  message_start(&m, words, WORDS);
  const hc_status st = matrix_file_parse("f", text, size, part, 0, &A, &labels, &m);
  must(st == HC_OK || st == HC_BAD_INPUT, "status %d: %s", (int)st, words);
  if (st != HC_OK) place_is_inside(words, "f", text, size, false);
  must((st == HC_OK) == (A.start != NULL) && (st == HC_OK || !labels), "%d, but %p and %p", (int)st, (void *)A.start,
       (void *)labels);
  for (int i = 0; labels && i < A.n; ++i) must(labels[i].dof > 0, "row %d is DOF %d", i, labels[i].dof);
  sparse_free(&A);
  free(labels);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  char words[WORDS];
  double *v;
  int n;
  const char *text = size ? (const char *)data : "";
  const hc_status st = parse(text, size, 0, &n, &v, words);
  must(st == HC_OK || (!v && n == 0), "refused, but there is a matrix");
  if (!fuzz_was_read(st, words, sizeof words, text, size)) return 0;
  must(v && n >= 1 && n <= MATRIX_MOST_ROWS, "%d rows", n);
  for (int i = 0; n <= LARGE && i < n * n; ++i) must(isfinite(v[i]), "entry %d is %g", i, v[i]);
  if (n <= LARGE) array_reads_back(n, v);
  free(v);
  part_is_one_of_them(text, size, "MASS");
  must(parse(text, size, n + 1, &n, &v, words) == HC_BAD_INPUT, "read as a larger one, too");
  return 0;
}
