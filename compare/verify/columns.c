/* columns.c - what --columns and --quantity say; see csv.h. */
#include <stdio.h>
#include <string.h>

#include "base/message.h"
#include "base/nearest.h"
#include "base/number.h"
#include "compare/verify/csv.h"

static const char *const quantities[] = {"amplitude", "harmonic_1", "peak", "max", "rms"};
static const char *const names[] = {"omega", "frequency", "amplitude", "harmonic_1", "peak", "value", NULL};

const char *verify_quantity_name(verify_quantity q) { return quantities[q]; }

/* One of the three that can be asked for, or -1. */
static int quantity_of(const char *text, size_t length)
{
  for (int q = VERIFY_AMPLITUDE; q <= VERIFY_PEAK; ++q)
    if (strlen(quantities[q]) == length && !memcmp(quantities[q], text, length)) return q;
  return -1;
}

static bool is(const char *word, const char *text, size_t length)
{
  return strlen(word) == length && !memcmp(word, text, length);
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
  message_add(m, "--columns: '");
  message_add_input(m, text, length, 60);
  message_add(m, "' is no column, expected its number from 1 to %d or its name in the header", VERIFY_MOST_FIELDS);
  return HC_BAD_INPUT;
}

static hc_status unknown(const char *text, size_t length, message *m)
{
  const char *near = nearest_word(names, text, length);
  message_add(m, "--columns: '");
  message_add_input(m, text, length, 60);
  message_add(m, "' is unknown, expected omega or frequency, and amplitude, harmonic_1, peak or value");
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
  if (!equals) {
    message_add(m, "--columns: '");
    message_add_input(m, text, length, 60);
    message_add(m, "' is not NAME=COLUMN, expected a list like omega=1,amplitude=2");
    return HC_BAD_INPUT;
  }
  size_t n = (size_t)(equals - text);
  bool cycles = is("frequency", text, n), first = cycles || is("omega", text, n), value = is("value", text, n);
  int q = quantity_of(text, n);
  if (!first && !value && q < 0) return unknown(text, n, m);
  if (first ? s->omega : s->value) {
    message_add(m, "--columns: a second column of %s, expected one", first ? "frequencies" : "values");
    return HC_BAD_INPUT;
  }
  if (first) s->omega = true, out->cycles = cycles;
  else s->value = true, s->needs_quantity = value;
  if (q >= 0) out->quantity = (verify_quantity)q;
  return read_place(equals + 1, length - n - 1, first ? &out->omega : &out->value, m);
}

hc_status verify_columns_read(const char *text, const char *quantity, verify_columns *out, char *words)
{
  message m;
  seen s = {0};
  message_start(&m, words, VERIFY_TEXT);
  *out = (verify_columns){0};
  for (const char *at = text;; ++at) {
    size_t length = strcspn(at, ",");
    hc_status st = read_one(at, length, out, &s, &m);
    if (st != HC_OK) return st;
    at += length;
    if (!*at) break;
  }
  int q = quantity ? quantity_of(quantity, strlen(quantity)) : -1;
  if (!s.omega || !s.value)
    message_add(&m, "--columns: no column of %s, expected a list like omega=1,amplitude=2",
                s.omega ? "values" : "frequencies");
  else if (quantity && q < 0) message_add(&m, "--quantity: expected amplitude, harmonic_1 or peak");
  else if (!quantity && s.needs_quantity)
    message_add(&m, "--columns: value is what? Add --quantity amplitude, harmonic_1 or peak");
  else if (quantity && !s.needs_quantity && (verify_quantity)q != out->quantity)
    message_add(&m, "--quantity %s contradicts --columns %s; name that column value, or leave --quantity out", quantity,
                quantities[out->quantity]);
  if (m.used) return HC_BAD_INPUT;
  if (quantity) out->quantity = (verify_quantity)q;
  return HC_OK;
}
