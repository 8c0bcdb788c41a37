/* columns.c - what --columns and --quantity say; see csv.h. */
#include <stdio.h>
#include <string.h>

#include "compare/verify/curve_file/csv.h"
#include "numerics/base/message.h"
#include "numerics/base/nearest.h"
#include "numerics/base/number.h"

static const char *const names[] = {
    "omega", "frequency", "amplitude", "double_amplitude", "harmonic_1",   "peak", "max",   "min",
    "mean",  "rms",       "norm",      "velocity",         "acceleration", "dB",   "value", NULL};

static bool is(const char *word, const char *text, size_t length)
{
  return strlen(word) == length && !memcmp(word, text, length);
}

/* "--columns: 'text' " and what is wrong with it. */
__attribute__((format(printf, 4, 5))) static hc_status blame(message *m, const char *text, size_t length,
                                                             const char *format, ...)
{
  va_list args;
  va_start(args, format);
  message_add(m, "--columns: '");
  message_add_input(m, text, length, 60);
  message_add(m, "' ");
  message_add_list(m, format, args);
  va_end(args);
  return HC_BAD_INPUT;
}

static hc_status read_place(const char *text, size_t length, verify_column *out, message *m)
{
  double number; /* what reads as a number is meant as one */
  if (length > 0 && length < VERIFY_NAME && number_read(text, length, &number) == NUMBER_NONE) {
    memcpy(out->header, text, length);
    out->header[length] = 0;
    return HC_OK;
  }
  if (number_read_integer(text, length, &out->number) == NUMBER_FINE && out->number >= 1 &&
      out->number <= VERIFY_MOST_FIELDS)
    return HC_OK;
  return blame(m, text, length, "is no column, expected its number from 1 to %d or its name in the header",
               VERIFY_MOST_FIELDS);
}

static hc_status unknown(const char *text, size_t length, message *m)
{
  const char *near = nearest_word(names, text, length);
  blame(m, text, length, "is unknown, expected omega or frequency, and value or one of %s", verify_quantity_names);
  if (near) message_add(m, "; did you mean %s?", near);
  return HC_BAD_INPUT;
}

typedef struct seen {
  bool omega, value, needs_quantity;
} seen;

/* NAME=COLUMN. */
static hc_status read_one(const char *text, size_t length, verify_columns *out, seen *s, message *m)
{
  const char *equals = memchr(text, '=', length);
  if (!equals) return blame(m, text, length, "is not NAME=COLUMN, expected a list like omega=1,amplitude=2");
  size_t n = (size_t)(equals - text);
  bool cycles = is("frequency", text, n), first = cycles || is("omega", text, n), value = is("value", text, n);
  verify_quantity q;
  const bool named = !first && !value && verify_quantity_read(text, n, &q);
  if (!first && !value && !named) return unknown(text, n, m);
  if (first ? s->omega : s->value) {
    message_add(m, "--columns: a second column of %s, expected one", first ? "frequencies" : "values");
    return HC_BAD_INPUT;
  }
  if (first) s->omega = true, out->cycles = cycles;
  else s->value = true, s->needs_quantity = value;
  if (named) out->quantity = q;
  return read_place(equals + 1, length - n - 1, first ? &out->omega : &out->value, m);
}

static hc_status read_list(const char *text, verify_columns *out, seen *s, message *m)
{
  for (const char *at = text;; ++at) {
    size_t length = strcspn(at, ",");
    hc_status st = read_one(at, length, out, s, m);
    if (st != HC_OK || !*(at += length)) return st;
  }
}

hc_status verify_columns_read(const char *text, const char *quantity, verify_columns *out, char *words)
{
  message m;
  seen s = {0};
  verify_quantity asked = {0};
  char name[VERIFY_QUANTITY_TEXT];
  message_start(&m, words, VERIFY_TEXT);
  *out = (verify_columns){.by_header = !text, .quantity_given = quantity};
  if (text && read_list(text, out, &s, &m) != HC_OK) return HC_BAD_INPUT;
  if (text && (!s.omega || !s.value))
    message_add(&m, "--columns: no column of %s, expected a list like omega=1,amplitude=2",
                s.omega ? "values" : "frequencies");
  else if (quantity && !verify_quantity_read(quantity, strlen(quantity), &asked)) {
    message_add(&m, "--quantity: '");
    message_add_input(&m, quantity, strlen(quantity), 60);
    const char *near = nearest_word(names + 2, quantity, strlen(quantity));
    message_add(&m, "' is unknown, expected one of %s", verify_quantity_names);
    if (near) message_add(&m, "; did you mean %s?", near);
  } else if (!quantity && s.needs_quantity)
    message_add(&m, "--columns: value is what? Add --quantity with one of %s", verify_quantity_names);
  else if (quantity && text && !s.needs_quantity && !verify_quantity_same(&asked, &out->quantity))
    message_add(&m, "--quantity %s contradicts --columns %s; name that column value, or leave --quantity out", quantity,
                verify_quantity_name(&out->quantity, name));
  if (m.used) return HC_BAD_INPUT;
  if (quantity) out->quantity = asked;
  return HC_OK;
}
