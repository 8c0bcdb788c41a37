/* test_matlab_damage.c - MATLAB files that are cut short, damaged or made to hurt: each reading ends, with the matrix
 * that was written or with one line of words; where the format can tell, never with another matrix. */
#include <zlib.h>

#include "casefile/matlab_layout.h"
#include "casefile/matlab_variable.h"
#include "tests/cases/structure/matlab_files.h"

typedef struct bytes {
  size_t length;
  unsigned char b[1 << 16];
} bytes;

static bytes load(const char *path)
{
  bytes all;
  FILE *from = fopen(path, "rb");
  assert_non_null(from);
  all.length = fread(all.b, 1, sizeof all.b, from);
  assert_true(all.length > 0 && all.length < sizeof all.b);
  fclose(from);
  return all;
}

static void save(const char *path, const void *b, size_t length)
{
  FILE *to = fopen(path, "wb");
  assert_non_null(to);
  assert_int_equal(fwrite(b, 1, length, to), length);
  assert_int_equal(fclose(to), 0);
}

/* 3 x 3 and nothing in common with memory's usual bytes */
static double M[] = {2.5, -1.25, 0.5, -1.25, 3.5, -0.75, 0.5, -0.75, 4.5};

typedef struct tally {
  int read, refused, crashed;
} tally;

/* Reads M: OK with M itself (or with `any` other matrix), or one clean line. */
static hc_status reading(const own_file *f, const char *variable, bool any, tally *t, const char *what, size_t which)
{
  char name[192], words[512];
  double *v;
  int n;
  message m;
  message_start(&m, words, sizeof words);
  const hc_status st = matlab_file_read(variable_of(f, variable, name), 0, &n, &v, &m);
  if (st == HC_OK) {
    ++t->read;
    if (*words || (!any && (n != 3 || memcmp(v, M, sizeof M))))
      fail_msg("%s %zu: another matrix %s", what, which, words);
  } else {
    ++t->refused;
    t->crashed += strstr(words, "crashed") != NULL;
    if (v || n || (st != HC_BAD_INPUT && st != HC_NO_MEMORY)) fail_msg("%s %zu: status %d", what, which, (int)st);
    if (st == HC_BAD_INPUT && !strstr(words, ", expected ")) fail_msg("%s %zu: %s", what, which, words);
    for (const char *c = words; *c; ++c)
      if ((unsigned char)*c < ' ') fail_msg("%s %zu: a control character in %s", what, which, words);
  }
  free(v);
  return st;
}

static const struct storage {
  const char *name;
  enum mat_ft version;
  enum matio_compression how;
  bool checksum; /* over each number */
} storages[] = {{"v4", MAT_FT_MAT4, MAT_COMPRESSION_NONE, false},
                {"v5", MAT_FT_MAT5, MAT_COMPRESSION_NONE, false},
                {"v5 zlib", MAT_FT_MAT5, MAT_COMPRESSION_ZLIB, true},
                {"v7.3", MAT_FT_MAT73, MAT_COMPRESSION_NONE, false},
                {"v7.3 zlib", MAT_FT_MAT73, MAT_COMPRESSION_ZLIB, false}};
enum { STORAGES = sizeof storages / sizeof *storages };

/* A file with M, the sparse matrix S of the same numbers (where the version has one), and M again as Z. */
static own_file whole_file(const struct storage *s, bytes *all)
{
  mat_uint32_t ir[] = {0, 1, 2, 0, 1, 2, 0, 1, 2}, jc[] = {0, 3, 6, 9};
  own_file f;
  mat_t *mat = new_matlab_file(&f, s->version);
  add_matrix(mat, "M", MAT_C_DOUBLE, MAT_T_DOUBLE, 3, 3, M, 0, s->how);
  if (s->version != MAT_FT_MAT4) add_sparse(mat, "S", 3, 3, ir, jc, M, s->how);
  add_matrix(mat, "Z", MAT_C_DOUBLE, MAT_T_DOUBLE, 3, 3, M, 0, s->how);
  Mat_Close(mat);
  *all = load(f.path);
  tally t = {0};
  assert_int_equal(reading(&f, "M", false, &t, s->name, 0), HC_OK);
  assert_int_equal(reading(&f, "Z", false, &t, s->name, 0), HC_OK);
  if (s->version != MAT_FT_MAT4) assert_int_equal(reading(&f, "S", false, &t, s->name, 0), HC_OK);
  return f;
}

/* The last variable is gone or cut, the first is whole or cut. */
static void cut_short(void **state)
{
  (void)state;
  static bytes all;
  for (int s = 0; s < STORAGES; ++s) {
    tally t = {0};
    const own_file f = whole_file(&storages[s], &all);
    const size_t step = all.length / 60 + 1;
    for (size_t length = all.length - 1; length<all.length; length -= length> step ? step : 1) {
      save(f.path, all.b, length);
      if (storages[s].version != MAT_FT_MAT4) reading(&f, "S", false, &t, storages[s].name, length);
      reading(&f, "M", false, &t, storages[s].name, length);
      assert_int_not_equal(reading(&f, "Z", false, &t, storages[s].name, length), HC_OK);
    }
    print_message("%s cut: %d read, %d refused, of these %d crashes\n", storages[s].name, t.read, t.refused, t.crashed);
    remove_file(&f);
  }
}

/* One bit, or a run of bytes, is another one. */
static void damaged(void **state)
{
  (void)state;
  static bytes all;
  uint64_t r = 7;
  for (int s = 0; s < STORAGES; ++s) {
    const char *const names[] = {"M", storages[s].version != MAT_FT_MAT4 ? "S" : "Z"};
    tally t = {0};
    const own_file f = whole_file(&storages[s], &all);
    for (size_t i = 0; i < 200; ++i) {
      bytes other = all;
      const size_t at = random_bits(&r) % other.length;
      if (i % 3 > 0) other.b[at] ^= (unsigned char)(1u << random_bits(&r) % 8);
      for (size_t k = at; i % 3 == 0 && k < at + 1 + i % 8 && k < other.length; ++k)
        other.b[k] = (unsigned char)random_bits(&r);
      save(f.path, other.b, other.length);
      reading(&f, names[i % 2], !storages[s].checksum, &t, storages[s].name, i);
    }
    print_message("%s damaged: %d read, %d refused, of these %d crashes\n", storages[s].name, t.read, t.refused,
                  t.crashed);
    assert_true(t.read > 0 && t.refused > 0);
    remove_file(&f);
  }
}

/* ---- files of version 5 made by hand ---- */

static void add_bytes(bytes *to, const void *b, size_t length)
{
  assert_true(to->length + length < sizeof to->b);
  memcpy(to->b + to->length, b, length);
  to->length += length;
}

static void add_tag(bytes *to, uint32_t type, uint32_t length)
{
  const uint32_t tag[] = {type, length};
  add_bytes(to, tag, 8);
}

/* A part whose tag says `claimed` bytes, with `length` of data. */
static void add_part(bytes *to, uint32_t type, const void *data, size_t length, size_t claimed)
{
  static const char zeros[8];
  add_tag(to, type, (uint32_t)claimed);
  add_bytes(to, data, length);
  add_bytes(to, zeros, (8 - length % 8) % 8);
}

enum { DOUBLES = 6, SPARSE = 5 }; /* classes */
enum { INT8 = 1, INT32 = 5, UINT32 = 6, DOUBLE = 9, MATRIX = 14, COMPRESSED = 15 };

typedef struct forged {
  uint32_t class, rows, columns;
  const int32_t *ir, *jc; /* of a sparse one: jc[columns + 1] and as many ir as given */
  size_t n_ir;
  size_t numbers, claimed; /* doubles that there are, and that are said to be */
} forged;

/* The file with one variable M, and another one behind it from whose bytes numbers might be taken. */
static own_file forge(const forged *o, bool packed)
{
  static const double numbers[16] = {2, 0, 0, 2, 0, 0, 0, 0, 0};
  static bytes file, body;
  const uint32_t flags[] = {o->class, 0}, dims[] = {o->rows, o->columns};
  char header[128] = "MATLAB 5.0 MAT-file";
  body.length = file.length = 0;
  add_part(&body, UINT32, flags, 8, 8);
  add_part(&body, INT32, dims, 8, 8);
  add_part(&body, INT8, "M", 1, 1);
  if (o->class == SPARSE) {
    add_part(&body, INT32, o->ir, 4 * o->n_ir, 4 * o->n_ir);
    add_part(&body, INT32, o->jc, 4 * (size_t)(o->columns + 1), 4 * (size_t)(o->columns + 1));
  }
  add_part(&body, DOUBLE, numbers, 8 * o->numbers, 8 * o->claimed);
  memset(header + 19, ' ', 97);
  memcpy(header + 124, "\0\1IM", 4);
  add_bytes(&file, header, 128);
  for (int twice = 0; twice < 2; ++twice) {
    if (packed) {
      static bytes inner, outer;
      inner.length = 0;
      add_tag(&inner, MATRIX, (uint32_t)body.length);
      add_bytes(&inner, body.b, body.length);
      uLongf length = sizeof outer.b;
      assert_int_equal(compress(outer.b, &length, inner.b, inner.length), Z_OK);
      add_tag(&file, COMPRESSED, (uint32_t)length);
      add_bytes(&file, outer.b, length);
    } else {
      add_tag(&file, MATRIX, (uint32_t)body.length);
      add_bytes(&file, body.b, body.length);
    }
  }
  return write_file("rom.mat", (const char *)file.b, file.length);
}

static void made_by_hand(void **state)
{
  (void)state;
  static const int32_t three[] = {0, 1, 2}, back[] = {0, 2, 1, 3};
  static const int32_t rows[] = {0, 1}, below[] = {0, 2}, negative[] = {0, -1}, both[] = {0, 0}, twice[] = {1, 1};
  static const int32_t jc[] = {0, 1, 2}, falling[] = {0, 2, 1}, beyond[] = {0, 1, 3}, late[] = {1, 1, 2},
                       less[] = {0, -1, 2}, all_in_one[] = {0, 2, 2};
  static const char *const short_of = "cannot be read: the file is damaged or cut short (the variable at byte 128 of",
                           *const inside = "is damaged, expected a sparse matrix with its entries inside";
  const struct {
    forged is;
    const char *words; /* NULL: it is read as diag(2, 2), or if sparse as diag(2, 0) */
  } all[] = {
      {{DOUBLES, 2, 2, NULL, NULL, 0, 4, 4}, NULL},
      {{DOUBLES, 2, 2, NULL, NULL, 0, 2, 2}, short_of},   /* fewer numbers than entries: libmatio reads on */
      {{DOUBLES, 2, 2, NULL, NULL, 0, 5, 5}, short_of},   /* more */
      {{DOUBLES, 2, 2, NULL, NULL, 0, 4, 0}, short_of},   /* none, says the tag */
      {{DOUBLES, 2, 2, NULL, NULL, 0, 4, 500}, short_of}, /* beyond the file */
      {{DOUBLES, 0x7fffffff, 0x7fffffff, NULL, NULL, 0, 4, 4}, short_of},
      {{DOUBLES, 0x10000, 0x10000, NULL, NULL, 0, 4, 4}, short_of}, /* 2^32 entries: 0 in 32 bits */
      {{DOUBLES, 0x80000000u, 2, NULL, NULL, 0, 4, 4}, short_of},
      {{SPARSE, 2, 2, rows, jc, 2, 2, 2}, NULL},
      {{SPARSE, 2, 2, below, jc, 2, 2, 2}, inside},
      {{SPARSE, 2, 2, negative, jc, 2, 2, 2}, inside},
      {{SPARSE, 2, 2, rows, falling, 2, 2, 2}, inside},
      {{SPARSE, 3, 3, three, back, 3, 3, 3}, inside}, /* an entry in two columns */
      {{SPARSE, 2, 2, rows, beyond, 2, 2, 2}, short_of},
      {{SPARSE, 2, 2, rows, late, 2, 2, 2}, inside},
      {{SPARSE, 2, 2, rows, less, 2, 2, 2}, inside},
      {{SPARSE, 2, 2, both, all_in_one, 2, 2, 2}, inside}, /* an entry twice */
      {{SPARSE, 2, 2, twice, all_in_one, 2, 2, 2}, inside},
      {{SPARSE, 2, 2, rows, jc, 1, 2, 2}, short_of},
      {{SPARSE, 2, 2, rows, jc, 2, 1, 1}, short_of},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
    for (int packed = 0; packed < 2; ++packed) {
      const char *words = all[i].words;
      const own_file f = forge(&all[i].is, packed);
      const double full[] = {2, 0, 0, 2}, sparse[] = {2, 0, 0, 0};
      if (words) variable_is_refused(&f, "M", 0, words);
      else variable_reads(&f, "M", 2, all[i].is.class == SPARSE ? sparse : full);
      remove_file(&f);
    }
}

/* ---- libmatio's variables as they should not be, in this process: for the sanitizers to see what is read ---- */

static void fills(const matvar_t *v, int expected, const char *words)
{
  char said[256];
  int n;
  message m;
  message_start(&m, said, sizeof said);
  double *out = calloc(16, sizeof *out);
  hc_status st = matlab_matrix_check(v, expected, &n, &m);
  assert_true(st != HC_OK || n <= 4);
  if (st == HC_OK) st = matlab_matrix_fill(v, n, out, &m);
  free(out);
  if (st != HC_BAD_INPUT || strncmp(said, words, strlen(words))) fail_msg("gave `%s`\nnot  `%s...`", said, words);
}

static void variables_of_libmatio(void **state)
{
  (void)state;
  size_t dims[] = {2, 2}, huge[] = {(size_t)1 << 63, 2}, most[] = {SIZE_MAX, SIZE_MAX};
  double *two = calloc(2, sizeof *two);
  matvar_t v = {
      .rank = 2, .class_type = MAT_C_DOUBLE, .data_type = MAT_T_DOUBLE, .data = two, .dims = dims, .nbytes = 16};
  fills(&v, 0, "is damaged, expected a number for each entry");
  v.data_type = MAT_T_STRUCT;
  fills(&v, 0, "is damaged, expected a number for each entry");
  v.data = NULL;
  fills(&v, 0, "has no data");
  v.dims = huge;
  fills(&v, 0, "is 9223372036854775808 x 2, expected as many columns as rows");
  v.dims = most;
  fills(&v, 0, "is 18446744073709551615 x 18446744073709551615, expected 1 to 4000 rows");
  v.dims = NULL;
  fills(&v, 0, "has 2 dimensions, expected 2");
  v.rank = 0;
  fills(&v, 0, "has 0 dimensions, expected 2");
  v.class_type = (enum matio_classes)99;
  fills(&v, 0, "is of an unknown class");
  free(two);

  mat_uint32_t *ir = calloc(2, sizeof *ir), *jc = calloc(3, sizeof *jc);
  double *data = calloc(2, sizeof *data);
  mat_sparse_t s = {.nzmax = 2, .ir = ir, .nir = 2, .jc = jc, .njc = 3, .ndata = 2, .data = data};
  matvar_t k = {
      .rank = 2, .class_type = MAT_C_SPARSE, .data_type = MAT_T_DOUBLE, .data = &s, .dims = dims, .nbytes = sizeof s};
  const char *const inside = "is damaged, expected a sparse matrix with its entries inside";
  jc[1] = 1, jc[2] = 2, s.njc = 2;
  fills(&k, 0, inside);
  s.njc = 3, s.nir = 1;
  fills(&k, 0, inside);
  s.nir = 2, s.ndata = 1;
  fills(&k, 0, inside);
  s.ndata = 2, jc[1] = 7;
  fills(&k, 0, inside);
  jc[1] = 1, jc[2] = UINT32_MAX;
  fills(&k, 0, inside);
  jc[2] = 2, ir[1] = 2;
  fills(&k, 0, inside);
  ir[1] = 1, s.ir = NULL;
  fills(&k, 0, inside);
  s.ir = ir, s.jc = NULL;
  fills(&k, 0, inside);
  s.jc = jc, s.data = NULL;
  fills(&k, 0, inside);
  s.data = data, k.data_type = MAT_T_CELL;
  fills(&k, 0, inside);
  free(ir);
  free(jc);
  free(data);
}

/* What a child leaves behind goes unseen: here nothing may leak, whether there is such a variable or not. */
static void without_a_child(void **state)
{
  (void)state;
  static const char *const paths[] = {"tests/cases/structure/octave_v4.mat", "tests/cases/structure/octave_v6.mat",
                                      "tests/cases/structure/octave_v7.mat"};
  static const char *const names[] = {"M", "K", "d", "none", NULL};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 5; ++k)
      for (int expected = 2; expected <= 3; ++expected) {
        char words[512];
        double *v;
        int n;
        message m;
        message_start(&m, words, sizeof words);
        const hc_status st = matlab_variable_read(paths[i], names[k], expected, &n, &v, &m);
        assert_int_equal(st, k < 3 && expected == 2 ? HC_OK : HC_BAD_INPUT);
        assert_int_equal(n, st == HC_OK ? 2 : 0);
        assert_true((v != NULL) == (st == HC_OK));
        free(v);
      }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(without_a_child),
    cmocka_unit_test(cut_short),
    cmocka_unit_test(damaged),
    cmocka_unit_test(made_by_hand),
    cmocka_unit_test(variables_of_libmatio),
};

CHECK_MAIN("structure.matlab_damage", tests, 140)
