/* matrix_text.c - see matrix_text.h. */
#include "casefile/matrices/matrix_text.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"

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
                       .watch_row = -1,
                       .m = m};
}

void matrix_text_free(matrix_text *r)
{
  free(r->values);
  free(r->seen);
  free(r->labels);
  r->values = NULL, r->seen = NULL, r->labels = NULL;
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

static size_t bit_of(const matrix_text *r, int i, int j) { return (size_t)i + (size_t)r->n * (size_t)j; }

hc_status matrix_text_square(matrix_text *r, int n)
{
  const size_t square = (size_t)n * (size_t)n;
  r->n = n;
  r->values = calloc(square, sizeof *r->values);
  r->seen = calloc(square / 8 + 1, 1);
  return r->values && r->seen ? HC_OK : HC_NO_MEMORY;
}

bool matrix_text_seen(const matrix_text *r, int i, int j)
{
  const size_t bit = bit_of(r, i, j);
  return r->seen[bit / 8] >> bit % 8 & 1;
}

void matrix_text_put(matrix_text *r, int i, int j, double value, const char *at)
{
  const size_t bit = bit_of(r, i, j);
  r->seen[bit / 8] = (unsigned char)(r->seen[bit / 8] | 1u << bit % 8);
  r->values[bit] = value + 0.0; /* -0 is 0 */
  matrix_text_watch(r, i, j, at);
}

void matrix_text_watch(matrix_text *r, int i, int j, const char *at)
{
  if (i != r->watch_row || j != r->watch_column) return;
  r->watched_line = r->line;
  r->watched_place = (size_t)(at - r->line_text) + 1;
}

hc_status matrix_text_check_rows(matrix_text *r, int n)
{
  if (r->expected == 0 || n == r->expected) return HC_OK;
  return matrix_text_refuse(r, r->line_text, "a matrix of %d x %d ends here, expected %d x %d", n, n, r->expected,
                            r->expected);
}
