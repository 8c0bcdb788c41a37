/* matrix_text.c - see matrix_text.h. */
#include "model/casefile/matrices/matrix_text.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/base/growing.h"
#include "numerics/base/number.h"

matrix_text matrix_text_start(const char *name, const char *text, size_t length, int expected, message *m)
{
  return (matrix_text){.name = name,
                       .text = text,
                       .end = text + length,
                       .comment = "**",
                       .commas = true,
                       .line_text = text,
                       .next = text,
                       .expected = expected,
                       .m = m};
}

void matrix_text_free(matrix_text *r)
{
  free(r->entries);
  sparse_free(&r->matrix);
  free(r->labels);
  r->entries = NULL, r->labels = NULL;
}

void matrix_text_rewind(matrix_text *r)
{
  r->line_text = r->next = r->text;
  r->line = 0;
  r->n_words = 0;
}

/* ---- messages ---- */

message *matrix_text_blame(matrix_text *r, const char *at)
{
  if (!at && r->end > r->text && r->end[-1] == '\n') ++r->line, r->line_text = r->end;
  if (!at) at = r->end;
  message_start(r->m, r->m->text, r->m->size);
  message_add_input(r->m, r->name, strlen(r->name), 240);
  message_add(r->m, ":%zu:%zu: ", r->line > 0 ? r->line : 1, (size_t)(at - r->line_text) + 1);
  return r->m;
}

hc_status matrix_text_refuse(matrix_text *r, const char *at, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  message_add_list(matrix_text_blame(r, at), format, args);
  va_end(args);
  return HC_BAD_INPUT;
}

hc_status matrix_text_refuse_entry(matrix_text *r, const matrix_entry *e, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  r->line = e->line, r->line_text = r->text;
  message_add_list(matrix_text_blame(r, r->text + e->place - 1), format, args);
  va_end(args);
  return HC_BAD_INPUT;
}

/* ---- words ---- */

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/* The word at *s, which is behind it and the comma that ends it afterwards. */
static matrix_word take_word(const char **s, const char *stop, bool commas)
{
  const char *begin = *s;
  while (*s < stop && !is_blank(**s) && !(commas && **s == ',')) ++*s;
  const matrix_word word = {begin, (size_t)(*s - begin)};
  while (*s < stop && is_blank(**s)) ++*s;
  if (commas && *s < stop && **s == ',') ++*s;
  return word;
}

bool matrix_text_line(matrix_text *r)
{
  if (r->next == r->end) return false;
  const char *stop = memchr(r->next, '\n', (size_t)(r->end - r->next));
  r->line_text = r->next;
  ++r->line;
  if (!stop) stop = r->end;
  r->next = stop < r->end ? stop + 1 : stop;
  r->n_words = 0;
  for (const char *s = r->line_text; r->n_words <= MATRIX_WORDS;) {
    while (s < stop && is_blank(*s)) ++s;
    if (s == stop) break;
    const matrix_word word = take_word(&s, stop, r->commas);
    if (r->n_words++ < MATRIX_WORDS) r->words[r->n_words - 1] = word;
  }
  return true;
}

bool matrix_text_next(matrix_text *r)
{
  const size_t mark = strlen(r->comment);
  while (matrix_text_line(r))
    if (r->n_words > 0 && (r->words[0].length < mark || memcmp(r->words[0].text, r->comment, mark) != 0)) return true;
  return false;
}

bool matrix_word_is(const matrix_word *w, const char *name)
{
  for (size_t i = 0; i < w->length; ++i) {
    const char c = w->text[i] >= 'A' && w->text[i] <= 'Z' ? (char)(w->text[i] | 0x20) : w->text[i];
    if (!name[i] || c != name[i]) return false;
  }
  return name[w->length] == '\0';
}

bool matrix_text_integer(matrix_text *r, int i, int from, long to, const char *what, int *value)
{
  const matrix_word w = r->words[i];
  const number_fault fault = number_read_integer(w.text, w.length, value);
  if (fault == NUMBER_FINE && *value >= from && *value <= to) return true;
  matrix_text_refuse(r, w.text, "%s, expected %s, an integer %d..%ld", MATRIX_QUOTED(w), what, from, to);
  return false;
}

bool matrix_text_number(matrix_text *r, int i, double *value)
{
  const matrix_word *w = &r->words[i];
  int whole;
  number_fault fault = number_read(w->text, w->length, value);
  if (fault == NUMBER_FINE && r->integers) fault = number_read_integer(w->text, w->length, &whole);
  if (fault == NUMBER_FINE) return true;
  const bool exponent = memchr(w->text, 'D', w->length) || memchr(w->text, 'd', w->length);
  matrix_text_refuse(r, w->text, "%s, expected a finite %s%s%s", MATRIX_QUOTED(*w),
                     r->integers ? "integer, as the banner says" : "number",
                     memchr(w->text, ',', w->length) ? " (the decimal sign is a point)" : "",
                     exponent ? " (an exponent is written with E)" : "");
  return false;
}

/* ---- the matrix ---- */

hc_status matrix_text_put(matrix_text *r, int i, int j, double value, const char *at)
{
  if (r->n_entries == INT_MAX / 2 || !GROW(r->entries, r->n_entries)) return HC_NO_MEMORY;
  r->entries[r->n_entries++] = (matrix_entry){.row = i,
                                              .column = j,
                                              .value = value + 0.0, /* -0 is 0 */
                                              .line = (unsigned)r->line,
                                              .place = (unsigned)(at - r->line_text) + 1};
  return HC_OK;
}

/* What k of 0 .. 2 n_entries - 1 stands for: an entry, or from n_entries on its image. */
static matrix_entry image(const matrix_text *r, int k)
{
  matrix_entry e = r->entries[k % r->n_entries];
  if (k < r->n_entries) return e;
  const int row = e.row;
  e.row = e.column, e.column = row;
  e.value = r->mirrored * e.value + 0.0;
  return e;
}

static bool has_image(const matrix_text *r, int k)
{
  return k < r->n_entries || (r->mirrored && image(r, k).row != image(r, k).column);
}

/* Sorted by rows, order[], then row by row into columns, whose rows ascend so. source[]: where each is from. */
static void sort_entries(const matrix_text *r, int *first, int *order, int *source)
{
  sparse *A = (sparse *)&r->matrix;
  const int n = r->n, both = 2 * r->n_entries;
  for (int k = 0; k < both; ++k)
    if (has_image(r, k)) ++first[image(r, k).row + 1], ++A->start[image(r, k).column + 1];
  for (int i = 0; i < n; ++i) first[i + 1] += first[i], A->start[i + 1] += A->start[i];
  for (int k = 0; k < both; ++k)
    if (has_image(r, k)) order[first[image(r, k).row]++] = k;
  for (int at = 0; at < A->start[n]; ++at) {
    const matrix_entry e = image(r, order[at]);
    const int to = A->start[e.column]++;
    A->row[to] = e.row, A->value[to] = e.value, source[to] = order[at];
  }
  memmove(A->start + 1, A->start, (size_t)n * sizeof *A->start);
  A->start[0] = 0;
}

/* The first entry in the file that is there for the second time, or NULL. */
static const matrix_entry *repeated(const matrix_text *r, const int *source)
{
  const matrix_entry *found = NULL;
  for (int j = 0; j < r->n; ++j)
    for (int k = r->matrix.start[j] + 1; k < r->matrix.start[j + 1]; ++k) {
      if (r->matrix.row[k] != r->matrix.row[k - 1]) continue;
      const int a = source[k] % r->n_entries, b = source[k - 1] % r->n_entries, later = a > b ? a : b;
      if (!found || &r->entries[later] < found) found = &r->entries[later];
    }
  return found;
}

hc_status matrix_text_assemble(matrix_text *r)
{
  const size_t both = 2 * (size_t)r->n_entries;
  hc_status st = sparse_new(r->n, r->n_entries << (r->mirrored != 0), &r->matrix);
  int *first = calloc((size_t)r->n + 2, sizeof *first), *order = calloc(2 * both + 1, sizeof *order);
  if (!first || !order) st = HC_NO_MEMORY;
  if (st == HC_OK && both > 0) {
    sort_entries(r, first, order, order + both);
    const matrix_entry *again = repeated(r, order + both);
    if (again)
      st = matrix_text_refuse_entry(r, again, "a second entry (%d, %d), expected each once", again->row + 1,
                                    again->column + 1);
  }
  free(first);
  free(order);
  return st;
}

hc_status matrix_text_check_rows(matrix_text *r, int n)
{
  if (r->expected == 0 || n == r->expected) return HC_OK;
  return matrix_text_refuse(r, r->line_text, "a matrix of %d x %d ends here, expected %d x %d", n, n, r->expected,
                            r->expected);
}
