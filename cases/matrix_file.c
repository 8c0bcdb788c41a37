/* matrix_file.c - see matrix_file.h. Banner, size and entries are lines of words; comments and blank lines between
 * them are skipped. */
#include "cases/matrix_file.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "cases/text_file.h"

enum { MOST_WORDS = 6 /* a banner has 5 */ };
static const size_t most_bytes = (size_t)1 << 29; /* 33 an entry of the largest matrix */

typedef enum symmetry { GENERAL, SYMMETRIC, SKEW } symmetry;

typedef struct word {
  const char *text;
  size_t length;
} word;

typedef struct reader {
  const char *name, *text, *end;
  const char *line_text; /* of the line being read */
  const char *next;      /* the line after it      */
  size_t line;           /* its number, from 1     */
  int n_words;           /* at most MOST_WORDS are kept, and one more counted */
  word words[MOST_WORDS];
  bool coordinate, integer;
  symmetry sym;
  int expected, n;
  double *values;      /* [n][n] by columns */
  unsigned char *seen; /* a bit an entry    */
  int watch_row, watch_column;
  size_t watched_line, watched_place; /* where that entry stands; 0: nowhere yet */
  message *m;
} reader;

/* Start the message with the place of `at` in the current line. */
static message *blame(reader *r, const char *at)
{
  message_start(r->m, r->m->text, r->m->size);
  message_add_input(r->m, r->name, strlen(r->name), 240);
  message_add(r->m, ":%zu:%zu: ", r->line, (size_t)(at - r->line_text) + 1);
  return r->m;
}

/* Start the message with the end of the text, where next_content has come to. */
static message *blame_end(reader *r)
{
  if (r->end > r->text && r->end[-1] == '\n') ++r->line, r->line_text = r->end;
  return blame(r, r->end);
}

static message *blame_word(reader *r, int i)
{
  message *m = blame(r, r->words[i].text);
  message_add(m, "`");
  message_add_input(m, r->words[i].text, r->words[i].length, 60);
  message_add(m, "`");
  return m;
}

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/* The next line into words. false at the end of the text. */
static bool next_line(reader *r)
{
  if (r->next == r->end) return false;
  const char *stop = memchr(r->next, '\n', (size_t)(r->end - r->next));
  r->line_text = r->next;
  ++r->line;
  if (!stop) stop = r->end;
  r->next = stop < r->end ? stop + 1 : stop;
  r->n_words = 0;
  for (const char *s = r->line_text; s < stop && r->n_words <= MOST_WORDS;) {
    const char *begin = s;
    while (s < stop && !is_blank(*s)) ++s;
    if (s > begin && r->n_words++ < MOST_WORDS) r->words[r->n_words - 1] = (word){begin, (size_t)(s - begin)};
    while (s < stop && is_blank(*s)) ++s;
  }
  return true;
}

/* The next line that is neither blank nor a comment. */
static bool next_content(reader *r)
{
  while (next_line(r))
    if (r->n_words > 0 && *r->words[0].text != '%') return true;
  return false;
}

static bool is_word(const word *w, const char *name) /* in any case of letters */
{
  for (size_t i = 0; i < w->length; ++i) {
    const char c = w->text[i] >= 'A' && w->text[i] <= 'Z' ? (char)(w->text[i] | 0x20) : w->text[i];
    if (!name[i] || c != name[i]) return false;
  }
  return name[w->length] == '\0';
}

/* Which of names[], ending in NULL, word i is; -1 with the message made. */
static int choose(reader *r, int i, const char *const *names, const char *expected)
{
  for (int k = 0; names[k]; ++k)
    if (is_word(&r->words[i], names[k])) return k;
  message_add(blame_word(r, i), " in the banner, expected %s", expected);
  return -1;
}

static bool begins(const reader *r, const char *words)
{
  const size_t length = strlen(words);
  return (size_t)(r->end - r->text) >= length && !memcmp(r->text, words, length);
}

/* What a file without the banner may be. */
static const char *other_format(const reader *r)
{
  const char *stop = memchr(r->text, '\n', (size_t)(r->end - r->text));
  if (begins(r, "MATLAB ") || begins(r, "\x89HDF")) return "this is a MATLAB file, which is named FILE.mat#VARIABLE";
  if (begins(r, "*")) return "this looks like an Abaqus input file";
  if (begins(r, "DMIG") || begins(r, "$")) return "this looks like a Nastran file";
  if (memchr(r->text, ',', (size_t)((stop ? stop : r->end) - r->text)))
    return "this looks like comma-separated entries, which Abaqus writes as .mtx, too";
  return NULL;
}

/* %%MatrixMarket matrix coordinate|array real|integer general|symmetric|skew-symmetric */
static hc_status read_banner(reader *r)
{
  static const char *const formats[] = {"coordinate", "array", NULL}, *const objects[] = {"matrix", NULL};
  static const char *const fields[] = {"real", "integer", NULL};
  static const char *const symmetries[] = {
      [GENERAL] = "general", [SYMMETRIC] = "symmetric", [SKEW] = "skew-symmetric", NULL};
  const bool any = next_line(r);
  if (!any || r->n_words == 0 || !is_word(&r->words[0], "%%matrixmarket")) {
    const char *other = other_format(r);
    r->line = 1, r->line_text = r->text;
    message *m = blame(r, r->text);
    message_add(m, "no Matrix Market banner, expected `%%%%MatrixMarket matrix coordinate real general` or the like");
    if (other) message_add(m, " (%s)", other);
    return HC_BAD_INPUT;
  }
  if (r->n_words != 5) {
    message_add(
        blame(r, r->words[0].text),
        "a banner of %s than five words, expected `%%%%MatrixMarket matrix coordinate real general` or the like",
        r->n_words < 5 ? "less" : "more");
    return HC_BAD_INPUT;
  }
  const int object = choose(r, 1, objects, "matrix");
  const int format = object < 0 ? -1 : choose(r, 2, formats, "coordinate or array");
  const int kind = format < 0 ? -1 : choose(r, 3, fields, "real or integer: numbers are needed");
  const int sym = kind < 0 ? -1 : choose(r, 4, symmetries, "general, symmetric or skew-symmetric");
  r->coordinate = format == 0;
  r->integer = kind == 1;
  r->sym = sym < 0 ? GENERAL : (symmetry)sym;
  return sym < 0 ? HC_BAD_INPUT : HC_OK;
}

/* Word i as an integer from..to, of which `what` tells. */
static bool read_count(reader *r, int i, int from, long to, const char *what, int *value)
{
  const number_fault fault = number_read_integer(r->words[i].text, r->words[i].length, value);
  if (fault == NUMBER_FINE && *value >= from && *value <= to) return true;
  message_add(blame_word(r, i), ", expected %s, an integer %d..%ld", what, from, to);
  return false;
}

static long most_entries(const reader *r)
{
  const long n = r->n, below = n * (n - 1) / 2;
  return r->sym == GENERAL ? n * n : r->sym == SYMMETRIC ? below + n : below;
}

static hc_status read_size(reader *r, int *entries)
{
  int columns;
  if (!next_content(r)) {
    message_add(blame_end(r), "the file ends before the line of sizes, expected rows and columns");
    return HC_BAD_INPUT;
  }
  if (r->n_words != 2 + r->coordinate) {
    message_add(blame(r, r->words[0].text), "%d words where the sizes should stand, expected %s", r->n_words,
                r->coordinate ? "rows, columns and number of entries" : "rows and columns");
    return HC_BAD_INPUT;
  }
  if (!read_count(r, 0, 1, MATRIX_MOST_ROWS, "the number of rows", &r->n)) return HC_BAD_INPUT;
  if (!read_count(r, 1, 1, MATRIX_MOST_ROWS, "the number of columns", &columns)) return HC_BAD_INPUT;
  if (columns != r->n || (r->expected > 0 && r->n != r->expected)) {
    message *m = blame(r, r->words[0].text);
    message_add(m, "a matrix of %d x %d, expected ", r->n, columns);
    if (r->expected > 0) message_add(m, "%d x %d", r->expected, r->expected);
    else message_add(m, "as many columns as rows");
    return HC_BAD_INPUT;
  }
  *entries = (int)most_entries(r);
  return r->coordinate && !read_count(r, 2, 0, *entries, "the number of entries", entries) ? HC_BAD_INPUT : HC_OK;
}

static hc_status read_value(reader *r, int i, double *value)
{
  const word *w = &r->words[i];
  int whole;
  number_fault fault = number_read(w->text, w->length, value);
  if (fault == NUMBER_FINE && r->integer) fault = number_read_integer(w->text, w->length, &whole);
  if (fault == NUMBER_FINE) return HC_OK;
  message *m = blame_word(r, i);
  message_add(m, ", expected a finite %s", r->integer ? "integer, as the banner says" : "number");
  if (memchr(w->text, ',', w->length)) message_add(m, " (the decimal sign is a point)");
  if (memchr(w->text, 'D', w->length) || memchr(w->text, 'd', w->length))
    message_add(m, " (an exponent is written with E)");
  return HC_BAD_INPUT;
}

/* Entry (i, j), and by symmetry (j, i). */
static void store(reader *r, int i, int j, double value, const word *w)
{
  const size_t n = (size_t)r->n;
  r->values[(size_t)i + n * (size_t)j] = value + 0.0; /* -0 is 0 */
  if (r->sym != GENERAL) r->values[(size_t)j + n * (size_t)i] = (r->sym == SKEW ? -value : value) + 0.0;
  if (i != r->watch_row || j != r->watch_column)
    if (r->sym == GENERAL || j != r->watch_row || i != r->watch_column) return;
  r->watched_line = r->line;
  r->watched_place = (size_t)(w->text - r->line_text) + 1;
}

static hc_status read_coordinate(reader *r)
{
  int i, j;
  double value;
  if (r->n_words != 3) {
    message_add(blame(r, r->words[0].text), "%s than three words, expected row, column and value of an entry",
                r->n_words < 3 ? "less" : "more");
    return HC_BAD_INPUT;
  }
  if (!read_count(r, 0, 1, r->n, "a row", &i) || !read_count(r, 1, 1, r->n, "a column", &j)) return HC_BAD_INPUT;
  if (r->sym != GENERAL && i < j + (r->sym == SKEW)) {
    message_add(blame(r, r->words[0].text),
                "entry (%d, %d) of a %s matrix, expected its lower triangle alone, row %s column", i, j,
                r->sym == SKEW ? "skew-symmetric" : "symmetric", r->sym == SKEW ? ">" : ">=");
    return HC_BAD_INPUT;
  }
  const size_t bit = (size_t)(i - 1) + (size_t)r->n * (size_t)(j - 1);
  if (r->seen[bit / 8] >> bit % 8 & 1) {
    message_add(blame(r, r->words[0].text), "a second entry (%d, %d), expected each once", i, j);
    return HC_BAD_INPUT;
  }
  r->seen[bit / 8] = (unsigned char)(r->seen[bit / 8] | 1u << bit % 8);
  const hc_status st = read_value(r, 2, &value);
  if (st == HC_OK) store(r, i - 1, j - 1, value, &r->words[0]);
  return st;
}

/* A value a line, down the columns; (*i, *j) moves on to the next one. */
static hc_status read_array(reader *r, int *i, int *j)
{
  double value;
  if (r->n_words != 1) {
    message_add(blame(r, r->words[1].text), "a second word, expected one value a line");
    return HC_BAD_INPUT;
  }
  const hc_status st = read_value(r, 0, &value);
  if (st != HC_OK) return st;
  store(r, *i, *j, value, &r->words[0]);
  if (++*i == r->n) ++*j, *i = r->sym == GENERAL ? 0 : *j + (r->sym == SKEW);
  return HC_OK;
}

static hc_status read_entries(reader *r, int entries)
{
  int i = r->sym == SKEW, j = 0;
  for (int k = 0; k < entries; ++k) {
    if (!next_content(r)) {
      message_add(blame_end(r), "the file ends after %d entries, expected %d", k, entries);
      return HC_BAD_INPUT;
    }
    const hc_status st = r->coordinate ? read_coordinate(r) : read_array(r, &i, &j);
    if (st != HC_OK) return st;
  }
  if (!next_content(r)) return HC_OK;
  message_add(blame(r, r->words[0].text), "something after the last of %d entries, expected the end", entries);
  return HC_BAD_INPUT;
}

static hc_status parse(reader *r)
{
  int entries;
  hc_status st = read_banner(r);
  if (st == HC_OK) st = read_size(r, &entries);
  if (st != HC_OK) return st;
  const size_t square = (size_t)r->n * (size_t)r->n;
  r->values = calloc(square, sizeof *r->values);
  r->seen = calloc(square / 8 + 1, 1);
  st = r->values && r->seen ? read_entries(r, entries) : HC_NO_MEMORY;
  free(r->seen);
  r->seen = NULL;
  return st;
}

static reader start(const char *name, const char *text, size_t length, int expected, message *m)
{
  return (reader){.name = name,
                  .text = text,
                  .end = text + length,
                  .line_text = text,
                  .next = text,
                  .expected = expected,
                  .watch_row = -1,
                  .m = m};
}

hc_status matrix_file_parse(const char *name, const char *text, size_t length, int expected, int *rows, double **values,
                            message *m)
{
  reader r = start(name, text, length, expected, m);
  const hc_status st = parse(&r);
  *rows = st == HC_OK ? r.n : 0;
  *values = r.values;
  if (st != HC_OK) free(r.values), *values = NULL;
  return st;
}

hc_status matrix_file_read(const char *path, int expected, int *rows, double **values, message *m)
{
  char *text;
  size_t length;
  *rows = 0;
  *values = NULL;
  hc_status st = text_file_read(path, most_bytes, &text, &length, m);
  if (st == HC_OK) st = matrix_file_parse(path, text, length, expected, rows, values, m);
  free(text);
  return st;
}

void matrix_file_place(const char *path, int row, int column, size_t *line, size_t *place)
{
  char *text, words[512];
  size_t length;
  message m;
  message_start(&m, words, sizeof words);
  *line = *place = 0;
  if (text_file_read(path, most_bytes, &text, &length, &m) == HC_OK) {
    reader r = start(path, text, length, 0, &m);
    r.watch_row = row, r.watch_column = column;
    if (parse(&r) == HC_OK) *line = r.watched_line, *place = r.watched_place;
    free(r.values);
  }
  free(text);
}
