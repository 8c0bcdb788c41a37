/* fields.c - see fields.h. No field is copied. */
#include "compare/verify/curve_file/fields.h"

#include <string.h>

#include "base/utf8.h"

static bool blank(char c) { return c == ' ' || c == '\t'; }

char fields_separator(const char *text, size_t length)
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

bool field_is(const field *f, const char *word)
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

fields_fault fields_split(const char *text, size_t length, char separator, field *fields, int *n, int *column)
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
