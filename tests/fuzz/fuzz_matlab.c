/* fuzz_matlab.c - bytes as a MATLAB file: what of it is ours runs in this process. The layout of version 5 is found to
 * be whole or refused with words; and the same bytes as a variable that libmatio might hand over become a finite matrix
 * or words, without a look beyond the blocks of memory that the variable has. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "casefile/matlab_layout.h"
#include "casefile/matlab_variable.h"
#include "casefile/matrix_file.h"
#include "tests/fuzz/fuzz.h"

enum { WORDS = 512, ENTRIES = 64 };

static void refused_in_words(hc_status st, const char *words)
{
  must(st == HC_OK || st == HC_BAD_INPUT, "status %d: %s", (int)st, words);
  must(st != HC_OK || !*words, "taken, with a message: %s", words);
  if (st == HC_OK) return;
  message_is_clean(words, WORDS);
  must(strstr(words, ", expected ") != NULL, "nothing expected: %s", words);
}

static hc_status layout(const char *path, const char *name)
{
  char words[WORDS];
  message m;
  message_start(&m, words, sizeof words);
  const hc_status st = matlab_layout_check(path, name, &m);
  refused_in_words(st, words);
  return st;
}

/* The next bytes of the input; zeros behind its end. */
typedef struct input {
  const uint8_t *data;
  size_t left;
} input;

static unsigned byte_of(input *in) { return in->left > 0 ? (--in->left, *in->data++) : 0; }

/* A block of its own, for the sanitizer to see its end. */
static void *block(input *in, size_t size)
{
  uint8_t *b = malloc(size ? size : 1);
  must(b != NULL, "out of memory");
  for (size_t i = 0; i < size; ++i) b[i] = (uint8_t)byte_of(in);
  return b;
}

/* Small numbers for the most part: indices that are nearly right. */
static mat_uint32_t *indices(input *in, size_t count)
{
  mat_uint32_t *at = malloc((count + 1) * sizeof *at);
  must(at != NULL, "out of memory");
  at[0] = 0;
  for (size_t i = 0; i < count; ++i) {
    const unsigned b = byte_of(in);
    at[i] = b == 255 ? UINT32_MAX : b % 16;
  }
  return at;
}

static void taken_or_refused(const matvar_t *v, int expected)
{
  char words[WORDS];
  int n;
  message m;
  message_start(&m, words, sizeof words);
  hc_status st = matlab_matrix_check(v, expected, &n, &m);
  must((st == HC_OK) == (n > 0) && n <= MATRIX_MOST_ROWS, "%d rows", n);
  double *out = st == HC_OK ? calloc((size_t)n * (size_t)n, sizeof *out) : NULL;
  if (st == HC_OK) st = matlab_matrix_fill(v, n, out, &m);
  refused_in_words(st, words);
  for (int i = 0; st == HC_OK && i < n * n && n < ENTRIES; ++i) must(isfinite(out[i]), "entry %d is %g", i, out[i]);
  free(out);
}

static void as_variable(input in)
{
  size_t dims[2] = {byte_of(&in) % 8, byte_of(&in) % 8};
  matvar_t v = {.class_type = (enum matio_classes)(byte_of(&in) % 18),
                .data_type = (enum matio_types)(byte_of(&in) % 26),
                .isComplex = byte_of(&in) == 1,
                .isLogical = byte_of(&in) == 1,
                .rank = byte_of(&in) == 1 ? 3 : 2,
                .dims = dims};
  const size_t count = byte_of(&in) % 2 ? dims[0] * dims[1] : byte_of(&in) % ENTRIES, size = Mat_SizeOf(v.data_type);
  const int expected = byte_of(&in) % 8;
  mat_sparse_t s = {.nir = byte_of(&in) % ENTRIES, .njc = (mat_uint32_t)dims[1] + 1, .ndata = byte_of(&in) % ENTRIES};
  s.ir = indices(&in, s.nir);
  s.jc = indices(&in, s.njc);
  s.data = block(&in, s.ndata * size);
  v.nbytes = count * size;
  void *full = block(&in, v.nbytes);
  v.data = v.class_type == MAT_C_SPARSE ? (void *)&s : full;
  taken_or_refused(&v, expected);
  free(full);
  free(s.ir);
  free(s.jc);
  free(s.data);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  char path[FUZZ_PATH];
  fuzz_write("rom.mat", size ? (const char *)data : "", size, path);
  const hc_status first = layout(path, NULL), M = layout(path, "M");
  if (first == HC_OK && M == HC_OK) ++fuzz_accepted;
  else ++fuzz_refused;
  as_variable((input){data, size});
  return 0;
}
