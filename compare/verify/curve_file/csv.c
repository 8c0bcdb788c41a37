/* csv.c - see csv.h. The file is read whole, then line by line; no line is longer than the file, no field is copied.
 * Fields are separated by semicolons, tabs, commas or blanks, whichever of these the first line has outside quotes, in
 * that order. A field may stand in double quotes, with separators inside, and "" for one quote (RFC 4180). */
#include "compare/verify/curve_file/csv.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/base/growing.h"
#include "numerics/base/message.h"
#include "numerics/base/number.h"
#include "numerics/base/utf8.h"

/* ---- a line into fields ---- */

typedef struct field {
  const char *text; /* in the line; trimmed, without its quotes */
  size_t length;
  int column; /* in characters from 1, as editors count */
} field;

typedef enum fields_fault { FIELDS_FINE, FIELDS_TOO_MANY, FIELDS_OPEN_QUOTE, FIELDS_AFTER_QUOTE } fields_fault;

static bool blank(char c) { return c == ' ' || c == '\t'; }

/* Which one the line has; ' ' is any blanks. */
static char fields_separator(const char *text, size_t length)
{
  for (const char *s = ";\t,"; *s; ++s) {
    bool quoted = false;
    for (size_t i = 0; i < length; ++i) {
      if (text[i] == '"') quoted = !quoted;
      else if (text[i] == *s && !quoted) return *s;
    }
  }
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

static bool field_is(const field *f, const char *word)
{
  return f->length == strlen(word) && !memcmp(f->text, word, f->length);
}

/* What is between at and stop, without blanks around it. */
static field trimmed(const char *at, const char *stop)
{
  field f = {at, (size_t)(stop - at), 0};
  while (f.length && blank(f.text[0])) ++f.text, --f.length;
  while (f.length && blank(f.text[f.length - 1])) --f.length;
  return f;
}

/* The end of a field that begins with a quote at `at`: behind the closing one; NULL if there is none. */
static const char *behind_quotes(const char *at, const char *end)
{
  for (const char *c = at + 1; c < end; ++c) {
    if (*c != '"') continue;
    if (c + 1 == end || c[1] != '"') return c + 1;
    ++c;
  }
  return NULL;
}

static bool ends_field(char c, char separator) { return separator == ' ' ? blank(c) : c == separator; }

/* The field that begins at *at, which moves to its end. */
static fields_fault next_field(const char **at, const char *end, char separator, field *f)
{
  const char *first = *at, *stop;
  while (first < end && blank(*first) && !ends_field(*first, separator)) ++first;
  if (first < end && *first == '"') {
    if (!(stop = behind_quotes(first, end))) return *at = first, FIELDS_OPEN_QUOTE;
    *f = (field){first + 1, (size_t)(stop - first) - 2, 0};
    while (stop < end && blank(*stop) && !ends_field(*stop, separator)) ++stop;
    *at = stop;
    return stop < end && !ends_field(*stop, separator) ? FIELDS_AFTER_QUOTE : FIELDS_FINE;
  }
  for (stop = *at; stop < end && !ends_field(*stop, separator);) ++stop;
  *f = trimmed(*at, stop);
  *at = stop;
  return FIELDS_FINE;
}

/* fields[VERIFY_MOST_FIELDS], *n of them; *column is where the fault is. */
static fields_fault fields_split(const char *text, size_t length, char separator, field *fields, int *n, int *column)
{
  const char *at = text, *end = text + length;
  *n = 0;
  for (;;) {
    while (separator == ' ' && at < end && blank(*at)) ++at;
    if (separator == ' ' && at == end) return FIELDS_FINE;
    if (*n == VERIFY_MOST_FIELDS) return *column = column_of(text, at), FIELDS_TOO_MANY;
    field *f = &fields[(*n)++];
    fields_fault fault = next_field(&at, end, separator, f);
    if (fault != FIELDS_FINE) return *column = column_of(text, at), fault;
    f->column = column_of(text, f->text);
    if (at == end) return FIELDS_FINE;
    at += separator != ' ';
  }
}

/* ---- what a column may be called ---- */

enum { PLAIN = 48 };

/* A name without what does not count, and its unit. */
typedef struct plain_name {
  char name[PLAIN], unit[PLAIN];
} plain_name;

typedef enum meaning { MEANS_NOTHING, MEANS_OMEGA, MEANS_CYCLES, MEANS_QUANTITY, MEANS_VALUE } meaning;

static const char *const omega_names[] = {"omega", "w",      "om",        "\xCF\x89", "\xCE\xA9", "angularfrequency",
                                          "rad/s", "omegaw", "pulsation", NULL};
static const char *const cycle_names[] = {"frequency",        "freq", "f", "hz", "excitationfrequency",
                                          "forcingfrequency", NULL};
static const char *const value_names[] = {"value", "y", "response", NULL};
static const struct {
  const char *quantity, *names[7];
} quantity_names[] = {
    {"amplitude", {"amplitude", "amp", "a", "x", "xamplitude", "xamp"}},
    {"double_amplitude", {"peaktopeak", "p2p", "pp"}},
    {"harmonic_1", {"x1", "firstharmonic", "fundamental"}},
    {"dB", {"db"}},
    {"max", {"xmax"}},
    {"min", {"xmin"}},
    {"rms", {"xrms"}},
    {"norm", {"2norm", "l2norm"}},
    {"velocity", {"vel", "v"}},
    {"acceleration", {"acc"}},
};

static bool among(const char *const *words, const char *name)
{
  for (; *words; ++words)
    if (!strcmp(*words, name)) return true;
  return false;
}

/* "h3" or "harmonic3", or one of the names that --quantity takes, written as one may. */
static bool quantity_of(const char *name, verify_quantity *out)
{
  char text[PLAIN + 16];
  const size_t digits = strspn(name, "harmonic"), length = strlen(name);
  int k;
  for (size_t i = 0; i < sizeof quantity_names / sizeof *quantity_names; ++i)
    if (among(quantity_names[i].names, name))
      return verify_quantity_read(quantity_names[i].quantity, strlen(quantity_names[i].quantity), out);
  if ((digits == 1 || !strncmp(name, "harmonic", 8)) && name[0] == 'h' && digits < length &&
      number_read_integer(name + digits, length - digits, &k) == NUMBER_FINE) {
    snprintf(text, sizeof text, "harmonic_%s", name + digits);
    return verify_quantity_read(text, strlen(text), out);
  }
  return verify_quantity_read(name, length, out);
}

static meaning meaning_of(const field *f, verify_quantity *q)
{
  plain_name p = {{0}, {0}};
  char *to = p.name, *end = p.name + PLAIN - 1;
  for (size_t i = 0; i < f->length; ++i) {
    const char c = (char)(f->text[i] >= 'A' && f->text[i] <= 'Z' ? f->text[i] - 'A' + 'a' : f->text[i]);
    if (c == '[' || c == '(') to = p.unit, end = p.unit + PLAIN - 1;
    else if (to < end && !strchr(" _-|\"])", c) && c) *to++ = c;
  }
  const bool radians = strstr(p.unit, "rad"), hertz = !strcmp(p.unit, "hz") || !strcmp(p.unit, "khz");
  if (among(omega_names, p.name)) return hertz ? MEANS_NOTHING : MEANS_OMEGA; /* omega in Hz: which of the two? */
  if (among(cycle_names, p.name)) return radians ? MEANS_OMEGA : !strcmp(p.unit, "khz") ? MEANS_NOTHING : MEANS_CYCLES;
  if (among(value_names, p.name)) return MEANS_VALUE;
  if (!(f->length && (verify_quantity_read(f->text, f->length, q) || quantity_of(p.name, q)))) return MEANS_NOTHING;
  q->decibel |= !strcmp(p.unit, "db");
  return MEANS_QUANTITY;
}

/* "a, b, ..." */
static void list_names(int n, const field *fields, int most, const char *quote, message *m)
{
  for (int i = 0; i < n && i < most; ++i) {
    message_add(m, "%s%s", i ? ", " : "", quote);
    message_add_input(m, fields[i].text, fields[i].length, 24);
    message_add(m, "%s", quote);
  }
  if (n > most) message_add(m, ", ...");
}

/* What is expected has the columns that were recognised, the first of several. */
static void say_ambiguous(int n, const field *fields, const char *what, int found, const verify_columns *seen,
                          message *m)
{
  char quantity[VERIFY_QUANTITY_TEXT] = "amplitude";
  const int value = seen->value.number ? seen->value.number : 2;
  const int omega = seen->omega.number ? seen->omega.number : value == 1 ? 2 : 1;
  if (seen->value.number) verify_quantity_name(&seen->quantity, quantity);
  message_add(m, found ? "more than one column of %s among " : "no column named like %s among ", what);
  list_names(n, fields, 10, "'", m);
  message_add(m, ", expected --columns %s=%d,%s=%d (or frequency=, and any of --quantity)",
              seen->omega.number && seen->cycles ? "frequency" : "omega", omega, quantity, value);
}

/* "omega", "w", "Frequency [Hz]", "|X1|", "Amplitude (mm)", ...: case, blanks, _ - | and a unit behind it do not count.
 * From the header's fields: columns->omega, ->value by number, ->cycles and ->quantity. quantity_given: which quantity
 * is wanted. False with what was seen, and what to do, added to *m. */
static bool recognise_columns(int n, const field *fields, bool quantity_given, verify_columns *columns, message *m)
{
  const verify_quantity wanted = columns->quantity;
  int of_omega = 0, of_cycles = 0, of_value = 0, of_unnamed = 0, omega = 0, cycle = 0, value = 0, unnamed = 0;
  for (int i = 0; i < n; ++i) {
    verify_quantity q = {0};
    switch (meaning_of(&fields[i], &q)) {
    case MEANS_OMEGA: omega = of_omega++ ? omega : i + 1; break;
    case MEANS_CYCLES: cycle = of_cycles++ ? cycle : i + 1; break;
    case MEANS_VALUE: unnamed = of_unnamed++ ? unnamed : i + 1; break;
    case MEANS_QUANTITY:
      if (quantity_given && !verify_quantity_same(&q, &wanted)) break;
      if (of_value++ == 0) value = i + 1, columns->quantity = q;
      break;
    case MEANS_NOTHING: break;
    }
  }
  if (quantity_given && of_value == 0) of_value = of_unnamed, value = unnamed;
  columns->cycles = of_omega == 0;
  columns->omega = (verify_column){.number = of_omega ? omega : cycle};
  columns->value = (verify_column){.number = value};
  const int frequencies = of_omega ? of_omega : of_cycles; /* omega and frequency side by side say the same */
  if (frequencies != 1) say_ambiguous(n, fields, "frequencies", frequencies, columns, m);
  else if (of_value != 1) say_ambiguous(n, fields, "values", of_value, columns, m);
  return frequencies == 1 && of_value == 1;
}

static const size_t most_bytes = (size_t)64 << 20; /* 640 a point */

typedef struct reader {
  const char *name;
  message *m;
  verify_columns columns;
  verify_data *out;
  char separator; /* 0: not known yet; ' ' is any blanks */
  long line, first_line;
  int n_fields, first_fields;
  int omega, value; /* from 0 */
  int response;     /* likewise; -1: no such column, or all of its lines are wanted */
  field fields[VERIFY_MOST_FIELDS];
} reader;

/* "FILE:LINE:COLUMN: " and what is wrong there. */
__attribute__((format(printf, 3, 4))) static hc_status blame(reader *r, int column, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  message_add_input(r->m, r->name, strlen(r->name), 240);
  message_add(r->m, ":%ld:%d: ", r->line, column);
  message_add_list(r->m, format, args);
  va_end(args);
  return HC_BAD_INPUT;
}

static hc_status split(reader *r, const char *text, size_t length)
{
  int column = 1;
  switch (fields_split(text, length, r->separator, r->fields, &r->n_fields, &column)) {
  case FIELDS_TOO_MANY: return blame(r, column, "one field too many, expected at most %d", VERIFY_MOST_FIELDS);
  case FIELDS_OPEN_QUOTE: return blame(r, column, "a quote that is not closed, expected \" at the end of the field");
  case FIELDS_AFTER_QUOTE: return blame(r, column, "text behind the closing quote, expected the next field");
  default: return HC_OK;
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

/* Where the column is, from 0, into *at. */
static hc_status find_column(reader *r, const verify_column *c, bool header, int *at)
{
  int found = c->number && c->number <= r->n_fields ? 1 : 0;
  *at = c->number - 1;
  for (int i = 0; i < r->n_fields && !c->number && header; ++i) {
    if (!field_is(&r->fields[i], c->header)) continue;
    ++found;
    *at = i;
  }
  if (found == 1) return HC_OK;
  if (c->number) return blame(r, 1, "no column %d, expected one of the %d there are", c->number, r->n_fields);
  blame(r, 1, "%s column '", found ? "more than one" : "no");
  message_add_input(r->m, c->header, strlen(c->header), 40);
  if (!header) message_add(r->m, "', expected a header before the first number, or --columns with numbers");
  else message_add(r->m, found ? "', expected --columns with numbers from 1" : "', expected one of ");
  if (header && !found) list_names(r->n_fields, r->fields, 8, "", r->m);
  return HC_BAD_INPUT;
}

static hc_status begin(reader *r, bool header)
{
  message words;
  char text[VERIFY_TEXT];
  message_start(&words, text, sizeof text);
  if (r->columns.by_header && !header)
    return blame(r, 1, "no header, expected one that names omega and amplitude, or --columns omega=1,amplitude=2");
  if (r->columns.by_header &&
      !recognise_columns(r->n_fields, r->fields, r->columns.quantity_given, &r->columns, &words))
    return blame(r, 1, "%s", text);
  r->out->quantity = r->columns.quantity;
  r->response = -1;
  for (int i = 0; i < r->n_fields && header && r->columns.response; ++i)
    if (field_is(&r->fields[i], "response")) r->response = i, r->out->by_response = true;
  hc_status st = find_column(r, &r->columns.omega, header, &r->omega);
  if (st == HC_OK) st = find_column(r, &r->columns.value, header, &r->value);
  r->first_line = r->line;
  r->first_fields = r->n_fields;
  return st;
}

/* ---- points ---- */

/* "12,5": digits, one comma, digits. */
static bool decimal_comma(const field *f)
{
  size_t comma = 0, commas = 0;
  for (size_t i = 0; i < f->length; ++i)
    if (f->text[i] == ',') comma = i, ++commas;
  double ignored;
  return commas == 1 && comma > 0 && number_read(f->text, comma, &ignored) == NUMBER_FINE &&
         number_read(f->text + comma + 1, f->length - comma - 1, &ignored) == NUMBER_FINE;
}

static hc_status blame_number(reader *r, const field *f, const char *fault, const char *expected)
{
  blame(r, f->column, "'");
  message_add_input(r->m, f->text, f->length, 40);
  message_add(r->m, "' %s, expected %s like 12.5 or 1.25e1%s", fault, expected,
              decimal_comma(f) ? "; a decimal comma? Write points" : "");
  return HC_BAD_INPUT;
}

static hc_status read_number(reader *r, int index, const char *what, double *value)
{
  static const char *const faults[] = {[NUMBER_NONE] = "is not a number",
                                       [NUMBER_NOT_FINITE] = "is not finite",
                                       [NUMBER_TOO_LARGE] = "is too large",
                                       [NUMBER_TOO_SMALL] = "is too small",
                                       [NUMBER_NOT_INTEGER] = "is not an integer"};
  const field *f = &r->fields[index];
  number_fault fault = number_read(f->text, f->length, value);
  return fault == NUMBER_FINE ? HC_OK : blame_number(r, f, faults[fault], what);
}

/* What is wrong with the numbers of a point, if anything. */
typedef enum verify_fault {
  VERIFY_FINE,
  VERIFY_NEGATIVE,        /* the value, of a quantity that cannot be */
  VERIFY_OMEGA_TOO_LARGE, /* to be finite in rad per time */
  VERIFY_VALUE_TOO_LARGE  /* to be finite, out of dB */
} verify_fault;

/* From the columns' numbers *p becomes omega [rad/time] and the quantity, not in dB. */
static verify_fault verify_point_convert(const verify_quantity *q, bool cycles, verify_point *p)
{
  if (!verify_quantity_signed(q) && !(p->value >= 0)) return VERIFY_NEGATIVE;
  if (cycles) p->omega *= TWO_PI;
  p->value = verify_quantity_from_column(q, p->value);
  if (!isfinite(p->omega)) return VERIFY_OMEGA_TOO_LARGE;
  return isfinite(p->value) ? VERIFY_FINE : VERIFY_VALUE_TOO_LARGE;
}

static const char in_decibel[] = "; is it in dB? Name it dB, or dB_ and the quantity";

/* The columns' numbers become omega in rad per time and the quantity, which must be in range. */
static hc_status convert(reader *r, verify_point *p)
{
  const verify_quantity *q = &r->columns.quantity;
  const field *value = &r->fields[r->value];
  switch (verify_point_convert(q, r->columns.cycles, p)) {
  case VERIFY_NEGATIVE:
    blame_number(r, value, "is too small", "a number >= 0");
    message_add(r->m, "%s", q->decibel ? "" : in_decibel);
    return HC_BAD_INPUT;
  case VERIFY_OMEGA_TOO_LARGE: return blame_number(r, &r->fields[r->omega], "is too large", "a number");
  case VERIFY_VALUE_TOO_LARGE: return blame_number(r, value, "is too large", "a number");
  default: return HC_OK;
  }
}

static hc_status read_point(reader *r)
{
  verify_point p = {.line = r->line};
  char name[VERIFY_QUANTITY_TEXT];
  if (r->n_fields != r->first_fields)
    return blame(r, 1, "%d field%s, expected %d as in line %ld%s", r->n_fields, r->n_fields == 1 ? "" : "s",
                 r->first_fields, r->first_line,
                 r->separator == ',' && r->n_fields == 2 * r->first_fields ? "; decimal commas? Write points" : "");
  if (r->response >= 0 && !field_is(&r->fields[r->response], r->columns.response)) return HC_OK;
  hc_status st = read_number(r, r->omega, r->columns.cycles ? "a frequency" : "an omega", &p.omega);
  if (st == HC_OK) st = read_number(r, r->value, verify_quantity_name(&r->columns.quantity, name), &p.value);
  if (st == HC_OK) st = convert(r, &p);
  if (st == HC_OK && !(p.omega > 0)) return ++r->out->left_out, HC_OK;
  if (st != HC_OK) return st;
  if (r->out->n == VERIFY_MOST_POINTS)
    return blame(r, 1, "one point too many, expected at most %d", VERIFY_MOST_POINTS);
  if (!GROW(r->out->points, r->out->n)) return HC_NO_MEMORY;
  r->out->points[r->out->n++] = p;
  return HC_OK;
}

static hc_status read_line(reader *r, const char *text, size_t length)
{
  size_t first = 0;
  while (first < length && blank(text[first])) ++first;
  if (first == length || text[first] == '#') return HC_OK;
  bool fresh = !r->separator;
  if (fresh) r->separator = fields_separator(text, length);
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
  blame(r, 1, "%d point%s in the file%s", r->out->n, r->out->n == 1 ? "" : "s",
        r->out->left_out ? " at omega > 0" : "");
  if (r->out->by_response) message_add(r->m, " of response %s", r->columns.response);
  message_add(r->m, ", expected at least %d", VERIFY_LEAST_POINTS);
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
  *r = (reader){.name = path, .m = &m, .columns = *columns, .out = out};
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

/* ---- points from arrays ---- */

/* Point i into *p, which the message is about if it is none. */
static hc_status convert_given(const verify_quantity *q, int i, verify_point *p, message *m)
{
  const double omega = p->omega, value = p->value;
  char name[VERIFY_QUANTITY_TEXT];
  if (!isfinite(omega)) message_add(m, "omega[%d] = %g is not finite, expected a number", i, omega);
  else if (!isfinite(value))
    message_add(m, "value[%d] = %g is not finite, expected %s", i, value, verify_quantity_name(q, name));
  else switch (verify_point_convert(q, false, p)) {
    case VERIFY_FINE: return HC_OK;
    case VERIFY_NEGATIVE:
      message_add(m, "value[%d] = %g is too small, expected a number >= 0%s", i, value, q->decibel ? "" : in_decibel);
      break;
    case VERIFY_OMEGA_TOO_LARGE: message_add(m, "omega[%d] = %g is too large, expected a number", i, omega); break;
    case VERIFY_VALUE_TOO_LARGE: message_add(m, "value[%d] = %g is too large, expected a number", i, value); break;
    }
  return HC_BAD_INPUT;
}

static hc_status read_points(int n, const double *omega, const double *value, verify_data *out, message *m)
{
  if (n > VERIFY_MOST_POINTS) {
    message_add(m, "%d points, expected at most %d", n, VERIFY_MOST_POINTS);
    return HC_BAD_INPUT;
  }
  out->points = malloc((n > 0 ? (size_t)n : 1) * sizeof *out->points);
  if (!out->points) {
    message_add(m, "%s", hc_status_text(HC_NO_MEMORY));
    return HC_NO_MEMORY;
  }
  for (int i = 0; i < n; ++i) {
    verify_point p = {.omega = omega[i], .value = value[i], .line = i + 1};
    hc_status st = convert_given(&out->quantity, i, &p, m);
    if (st != HC_OK) return st;
    if (p.omega > 0) out->points[out->n++] = p;
    else ++out->left_out;
  }
  if (out->n >= VERIFY_LEAST_POINTS) return HC_OK;
  message_add(m, "%d point%s%s, expected at least %d", out->n, out->n == 1 ? "" : "s",
              out->left_out ? " at omega > 0" : "", VERIFY_LEAST_POINTS);
  return HC_BAD_INPUT;
}

hc_status verify_data_of(const char *quantity, double noise, int n, const double *omega, const double *value,
                         verify_data *out, char *words)
{
  message m;
  message_start(&m, words, VERIFY_TEXT);
  *out = (verify_data){.noise = noise};
  if (!(noise >= 0 && noise <= 1))
    message_add(&m, "noise = %g is no scatter, expected a number from 0 to 1 such as 1e-2", noise);
  else if (!verify_quantity_read(quantity, strlen(quantity), &out->quantity)) {
    message_add(&m, "quantity '");
    message_add_input(&m, quantity, strlen(quantity), 60);
    message_add(&m, "' is unknown, expected one of %s", verify_quantity_names);
  }
  return m.used ? HC_BAD_INPUT : read_points(n, omega, value, out, &m);
}

void verify_data_clear(verify_data *d)
{
  free(d->points);
  *d = (verify_data){0};
}
