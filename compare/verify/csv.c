/* csv.c - see csv.h. The file is read whole, then line by line; no line is longer than the file, no field is copied. */
#include "compare/verify/csv.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/message.h"
#include "base/number.h"
#include "base/utf8.h"

static const size_t most_bytes = (size_t)64 << 20; /* 640 a point */

/* column: in characters from 1, as editors count */
typedef struct field {
  const char *text;
  size_t length;
  int column;
} field;

typedef struct reader {
  const char *name;
  message *m;
  const verify_columns *columns;
  verify_data *out;
  int cap;
  char separator; /* 0: not known yet; ' ' is any blanks */
  long line, first_line;
  int n_fields, first_fields;
  int omega, value; /* from 0 */
  field fields[VERIFY_MOST_FIELDS];
} reader;

static hc_status blame(reader *r, int column)
{
  message_add_input(r->m, r->name, strlen(r->name), 240);
  message_add(r->m, ":%ld:%d: ", r->line, column);
  return HC_BAD_INPUT;
}

/* ---- a line into fields ---- */

static bool blank(char c) { return c == ' ' || c == '\t'; }

static char separator_of(const char *text, size_t length)
{
  for (const char *s = ";\t,"; *s; ++s)
    if (memchr(text, *s, length)) return *s;
  return ' ';
}

static int column_of(const char *text, const char *at)
{
  int column = 1;
  unsigned long code;
  for (size_t n; text < at; text += n, ++column)
    if ((n = utf8_character(text, (size_t)(at - text), &code)) == 0) n = 1;
  return column;
}

static void trim(field *f)
{
  while (f->length && blank(f->text[0])) ++f->text, --f->length;
  while (f->length && blank(f->text[f->length - 1])) --f->length;
}

static hc_status split(reader *r, const char *text, size_t length)
{
  const char *at = text, *end = text + length;
  r->n_fields = 0;
  for (;;) {
    const char *stop = at;
    if (r->separator == ' ')
      while (at < end && blank(*at)) stop = ++at;
    if (r->separator == ' ' && at == end) return HC_OK;
    while (stop < end && (r->separator == ' ' ? !blank(*stop) : *stop != r->separator)) ++stop;
    if (r->n_fields == VERIFY_MOST_FIELDS) {
      blame(r, column_of(text, at));
      message_add(r->m, "one field too many, expected at most %d", VERIFY_MOST_FIELDS);
      return HC_BAD_INPUT;
    }
    field *f = &r->fields[r->n_fields++];
    *f = (field){at, (size_t)(stop - at), 0};
    trim(f);
    f->column = column_of(text, f->text);
    if (stop == end) return HC_OK;
    at = stop + (r->separator != ' ');
  }
}

/* ---- the header ---- */

static bool is_header(const reader *r)
{
  double ignored;
  for (int i = 0; i < r->n_fields; ++i)
    if (number_read(r->fields[i].text, r->fields[i].length, &ignored) != NUMBER_NONE) return false;
  return true;
}

static void list_header(reader *r)
{
  for (int i = 0; i < r->n_fields && i < 8; ++i) {
    message_add(r->m, i ? ", " : "");
    message_add_input(r->m, r->fields[i].text, r->fields[i].length, 24);
  }
  if (r->n_fields > 8) message_add(r->m, ", ...");
}

/* Where the column is, from 0, into *at. */
static hc_status find_column(reader *r, const verify_column *c, bool header, int *at)
{
  int found = c->number && c->number <= r->n_fields ? 1 : 0;
  *at = c->number - 1;
  for (int i = 0; i < r->n_fields && !c->number && header; ++i) {
    if (r->fields[i].length != strlen(c->header) || memcmp(r->fields[i].text, c->header, r->fields[i].length)) continue;
    ++found;
    *at = i;
  }
  if (found == 1) return HC_OK;
  blame(r, 1);
  if (c->number) message_add(r->m, "no column %d, expected one of the %d there are", c->number, r->n_fields);
  else {
    message_add(r->m, "%s column '", found ? "more than one" : "no");
    message_add_input(r->m, c->header, strlen(c->header), 40);
    if (!header) message_add(r->m, "', expected a header before the first number, or --columns with numbers");
    else message_add(r->m, found ? "', expected --columns with numbers from 1" : "', expected one of ");
    if (header && !found) list_header(r);
  }
  return HC_BAD_INPUT;
}

static hc_status begin(reader *r, bool header)
{
  hc_status st = find_column(r, &r->columns->omega, header, &r->omega);
  if (st == HC_OK) st = find_column(r, &r->columns->value, header, &r->value);
  r->first_line = r->line;
  r->first_fields = r->n_fields;
  return st;
}

/* ---- points ---- */

/* scale times the number, which must be finite too. */
static hc_status read_number(reader *r, int index, const char *what, bool zero, double scale, double *value)
{
  static const char *const faults[] = {[NUMBER_NONE] = "is not a number",
                                       [NUMBER_NOT_FINITE] = "is not finite",
                                       [NUMBER_TOO_LARGE] = "is too large",
                                       [NUMBER_TOO_SMALL] = "is too small",
                                       [NUMBER_NOT_INTEGER] = "is not an integer"};
  const field *f = &r->fields[index];
  number_fault fault = number_read(f->text, f->length, value);
  if (fault == NUMBER_FINE) *value *= scale;
  if (fault == NUMBER_FINE && !isfinite(*value)) fault = NUMBER_TOO_LARGE;
  if (fault == NUMBER_FINE && (*value > 0 || (zero && *value == 0))) return HC_OK;
  blame(r, f->column);
  message_add(r->m, "'");
  message_add_input(r->m, f->text, f->length, 40);
  message_add(r->m, "' %s, expected %s, a number %s 0 like 12.5 or 1.25e1",
              fault == NUMBER_FINE ? "is too small" : faults[fault], what, zero ? ">=" : ">");
  return HC_BAD_INPUT;
}

static hc_status add_point(reader *r, verify_point p)
{
  if (r->out->n == VERIFY_MOST_POINTS) {
    blame(r, 1);
    message_add(r->m, "one point too many, expected at most %d", VERIFY_MOST_POINTS);
    return HC_BAD_INPUT;
  }
  if (r->out->n == r->cap) {
    int cap = r->cap ? 2 * r->cap : 256;
    verify_point *points = realloc(r->out->points, (size_t)cap * sizeof *points);
    if (!points) return HC_NO_MEMORY;
    r->out->points = points;
    r->cap = cap;
  }
  r->out->points[r->out->n++] = p;
  return HC_OK;
}

static hc_status read_point(reader *r)
{
  verify_point p = {.line = r->line};
  if (r->n_fields != r->first_fields) {
    blame(r, 1);
    message_add(r->m, "%d field%s, expected %d as in line %ld", r->n_fields, r->n_fields == 1 ? "" : "s",
                r->first_fields, r->first_line);
    return HC_BAD_INPUT;
  }
  hc_status st = read_number(r, r->omega, r->columns->cycles ? "a frequency" : "an omega", false,
                             r->columns->cycles ? TWO_PI : 1, &p.omega);
  if (st == HC_OK) st = read_number(r, r->value, verify_quantity_name(r->columns->quantity), true, 1, &p.value);
  return st == HC_OK ? add_point(r, p) : st;
}

static hc_status read_line(reader *r, const char *text, size_t length)
{
  size_t first = 0;
  while (first < length && blank(text[first])) ++first;
  if (first == length || text[first] == '#') return HC_OK;
  bool fresh = !r->separator;
  if (fresh) r->separator = separator_of(text, length);
  hc_status st = split(r, text, length);
  bool header = st == HC_OK && fresh && is_header(r);
  if (st == HC_OK && fresh) st = begin(r, header);
  return st != HC_OK || header ? st : read_point(r);
}

static hc_status read_lines(reader *r, const char *text, size_t length)
{
  if (length >= 3 && !memcmp(text, "\xEF\xBB\xBF", 3)) text += 3, length -= 3;
  const char *end = text + length;
  hc_status st = HC_OK;
  while (text < end && st == HC_OK) {
    const char *stop = memchr(text, '\n', (size_t)(end - text)), *next = stop ? stop + 1 : end;
    if (!stop) stop = end;
    if (stop > text && stop[-1] == '\r') --stop;
    ++r->line;
    st = read_line(r, text, (size_t)(stop - text));
    text = next;
  }
  if (st != HC_OK || r->out->n >= VERIFY_LEAST_POINTS) return st;
  r->line += r->line == 0;
  blame(r, 1);
  message_add(r->m, "%d point%s in the file, expected at least %d", r->out->n, r->out->n == 1 ? "" : "s",
              VERIFY_LEAST_POINTS);
  return HC_BAD_INPUT;
}

/* ---- the file ---- */

/* All of it into *text, to free. */
static hc_status read_all(FILE *from, char **text, size_t *length)
{
  size_t cap = 0;
  *text = NULL;
  *length = 0;
  for (;;) {
    if (*length == cap) {
      cap = cap ? 2 * cap : 65536;
      char *more = realloc(*text, cap);
      if (!more) return HC_NO_MEMORY;
      *text = more;
    }
    size_t n = fread(*text + *length, 1, cap - *length, from);
    *length += n;
    if (*length > most_bytes) return HC_BAD_INPUT;
    if (n == 0) return ferror(from) ? HC_IO : HC_OK;
  }
}

hc_status verify_data_read(const char *path, const verify_columns *columns, verify_data *out, char *words)
{
  message m;
  char *text = NULL;
  size_t length;
  *out = (verify_data){.quantity = columns->quantity};
  message_start(&m, words, VERIFY_TEXT);
  reader *r = malloc(sizeof *r);
  if (!r) {
    message_add(&m, "%s", hc_status_text(HC_NO_MEMORY));
    return HC_NO_MEMORY;
  }
  *r = (reader){.name = path, .m = &m, .columns = columns, .out = out};
  errno = 0;
  FILE *from = fopen(path, "r");
  hc_status st = from ? read_all(from, &text, &length) : errno == ENOMEM ? HC_NO_MEMORY : HC_IO;
  if (st == HC_IO)
    message_add(&m, "%s: %s, expected a file of columns", path, errno ? strerror(errno) : hc_status_text(st));
  else if (st == HC_BAD_INPUT)
    message_add(&m, "%s: larger than %zu MiB, expected a response curve", path, most_bytes >> 20);
  else if (st == HC_OK) st = read_lines(r, text, length);
  if (st == HC_NO_MEMORY) message_add(&m, "%s: %s", path, hc_status_text(st));
  if (from) fclose(from);
  free(text);
  free(r);
  return st;
}

void verify_data_clear(verify_data *d)
{
  free(d->points);
  *d = (verify_data){0};
}
