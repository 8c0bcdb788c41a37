/* field_value.c - a field's value: from what was written to what is stored; back: case_echo.c. The table: fields.c. */
#include "model/casefile/fields.h"

#include <stdlib.h>
#include <string.h>

#include "numerics/base/nearest.h"
#include "numerics/base/number.h"
#include "numerics/base/utf8.h"

static bool is_integer(const field *f) { return f->kind == FIELD_INTEGER || f->kind == FIELD_INTEGERS; }

static bool is_list(const field *f)
{
  return f->kind == FIELD_PAIR || f->kind == FIELD_REALS || f->kind == FIELD_INTEGERS;
}

static void add_range(const field *f, message *m)
{
  char low[NUMBER_TEXT], high[NUMBER_TEXT];
  if (isinf(f->low)) return;
  number_write(f->low, low);
  if (isinf(f->high)) message_add(m, " %s %s", f->flags & FIELD_OPEN ? ">" : ">=", low);
  else message_add(m, " %s..%s", low, number_write(f->high, high));
}

void field_expected(const field *f, message *m)
{
  static const char *const nouns[] = {[FIELD_REAL] = "a number",
                                      [FIELD_INTEGER] = "an integer",
                                      [FIELD_PAIR] = "two numbers",
                                      [FIELD_REALS] = "a list of numbers",
                                      [FIELD_INTEGERS] = "a list of integers"};
  if (f->expects) {
    message_add(m, "%s", f->expects);
    return;
  }
  switch (f->kind) {
  case FIELD_FLAG: message_add(m, "true or false"); return;
  case FIELD_CHOICE:
    for (int i = 0; f->choices[i]; ++i)
      message_add(m, "%s%s", i == 0 ? "" : f->choices[i + 1] ? ", " : " or ", f->choices[i]);
    return;
  case FIELD_TEXT: message_add(m, "text of at most %zu bytes", f->size - 1); return;
  default: break;
  }
  message_add(m, "%s", nouns[f->kind]);
  add_range(f, m);
  if (f->flags & FIELD_AUTO) message_add(m, " or auto");
  if (f->kind == FIELD_PAIR) message_add(m, ", [FROM, TO]");
}

/* What is wrong with v, or with its entry `bad`; always false, for the caller to pass on. */
static bool refuse(const field *f, const field_value *v, int bad, const char *hint, message *m)
{
  const field_item *it = &v->item[bad < 0 ? 0 : bad];
  if (bad < 0 && v->list && is_list(f)) {
    message_add(m, " is a list of %d", v->n);
  } else if (bad < 0 && v->list) {
    message_add(m, " is a list");
  } else if (it->length == 0 && !it->quoted) {
    message_add(m, v->list ? " has an empty entry" : " is empty");
  } else {
    message_add(m, v->list ? " has the entry " : " is ");
    message_add_quoted(m, it->text, it->length);
  }
  message_add(m, ", expected ");
  field_expected(f, m);
  if (hint) message_add(m, " (%s)", hint);
  return false;
}

static bool is_word(const field_item *it, const char *word)
{
  return strlen(word) == it->length && !memcmp(word, it->text, it->length);
}

static const char *number_hint(const field_item *it, number_fault fault)
{
  switch (fault) {
  case NUMBER_NOT_FINITE: return "it must be finite";
  case NUMBER_TOO_LARGE: return "too large to be held";
  case NUMBER_TOO_SMALL: return "too small to be distinguished from 0";
  case NUMBER_NOT_INTEGER: return "write it in digits only";
  default: return memchr(it->text, ',', it->length) ? "the decimal sign is a point" : NULL;
  }
}

/* One number in the field's range, scaled; false with *hint set or NULL. */
static bool read_number(const field *f, const field_item *it, double *out, const char **hint)
{
  double x = 0;
  int i = 0;
  *hint = it->quoted ? "in quotes it is text" : NULL;
  if (it->quoted) return false;
  if (f->flags & FIELD_AUTO && is_word(it, "auto")) {
    *out = HBM_AUTO;
    return true;
  }
  number_fault fault =
      is_integer(f) ? number_read_integer(it->text, it->length, &i) : number_read(it->text, it->length, &x);
  if (fault != NUMBER_FINE) {
    *hint = number_hint(it, fault);
    return false;
  }
  if (is_integer(f)) x = i;
  if (!(x >= f->low && x <= f->high) || (f->flags & FIELD_OPEN && x == f->low)) return false;
  *out = f->scale != 0 ? f->scale * x : x;
  if (!isfinite(*out)) *hint = number_hint(it, NUMBER_TOO_LARGE);
  return isfinite(*out);
}

static bool store_list(const field *f, void *to, const field_value *v, message *m, int *bad)
{
  number_list list = {0};
  const char *hint;
  bool pair = f->kind == FIELD_PAIR, fits = pair ? v->n == 2 : v->n >= 1 && v->n <= NUMBER_LIST_MAX;
  if (!fits) return refuse(f, v, -1, pair ? NULL : "1 to 1024 of them", m);
  for (; list.n < v->n; ++list.n)
    if (!read_number(f, &v->item[list.n], &list.v[list.n], &hint)) return refuse(f, v, *bad = list.n, hint, m);
  if (pair) memcpy(to, list.v, 2 * sizeof *list.v);
  else *(number_list *)to = list;
  return true;
}
_Static_assert(NUMBER_LIST_MAX == 1024, "store_list says so in words");

/* An enum is stored by its bytes, as large as an int: the table does not know which one it is. */
_Static_assert(sizeof(hbm_force) == sizeof(int) && sizeof(hbm_restart) == sizeof(int) &&
                   sizeof(hbm_continuation) == sizeof(int) && sizeof(transient_law) == sizeof(int) &&
                   sizeof(transient_steady) == sizeof(int) && sizeof(transient_start) == sizeof(int),
               "enums of the settings are as large as an int");
bool field_store(const field *f, void *base, const field_value *v, message *m, int *bad)
{
  void *to = field_place(f, base);
  *bad = -1;
  if (v->list != is_list(f)) return refuse(f, v, -1, NULL, m);
  switch (f->kind) {
  case FIELD_REAL:
  case FIELD_INTEGER: {
    double x;
    const char *hint;
    if (!read_number(f, &v->item[0], &x, &hint)) return refuse(f, v, -1, hint, m);
    if (f->kind == FIELD_INTEGER) *(int *)to = (int)x;
    else *(double *)to = x;
    return true;
  }
  case FIELD_FLAG: {
    const field_item *it = &v->item[0];
    bool yes = is_word(it, "true");
    if (it->quoted || !(yes || is_word(it, "false")))
      return refuse(f, v, -1, it->quoted ? "in quotes it is text" : NULL, m);
    *(bool *)to = yes;
    return true;
  }
  case FIELD_CHOICE: {
    for (int i = 0; f->choices[i]; ++i)
      if (is_word(&v->item[0], f->choices[i])) {
        memcpy(to, &i, sizeof i);
        return true;
      }
    const field_item *it = &v->item[0];
    const char *near = nearest_word(f->choices, it->text, it->length);
    refuse(f, v, -1, NULL, m);
    if (near) message_add(m, ", did you mean `%s`?", near);
    return false;
  }
  case FIELD_TEXT: {
    const field_item *it = &v->item[0];
    if (it->length >= f->size) return refuse(f, v, -1, "too long", m);
    if (it->length == 0 && !it->quoted) return refuse(f, v, -1, "write \"\" for no text", m);
    for (size_t i = 0, n; i < it->length; i += n) {
      unsigned long code;
      n = utf8_character(it->text + i, it->length - i, &code);
      if (n == 0 || utf8_is_control(code)) return refuse(f, v, -1, "on one line, without control characters", m);
    }
    memset(to, 0, f->size);
    memcpy(to, it->text, it->length);
    return true;
  }
  default: break;
  }
  if (!store_list(f, to, v, m, bad)) return false;
  if (f->in_cycles) *(bool *)((char *)base + f->in_cycles) = f->scale != 0;
  return true;
}

static void trim(const char **text, size_t *length)
{
  while (*length > 0 && **text == ' ') ++*text, --*length;
  while (*length > 0 && (*text)[*length - 1] == ' ') --*length;
}

void field_split(const field *f, const char *text, size_t length, field_value *v)
{
  v->list = is_list(f), v->n = 1;
  if (f->kind != FIELD_TEXT) trim(&text, &length);
  v->item[0] = (field_item){.text = text, .length = length, .quoted = f->kind == FIELD_TEXT};
  if (!v->list) return;
  if (length >= 2 && text[0] == '[' && text[length - 1] == ']') ++text, length -= 2;
  trim(&text, &length);
  v->n = 0;
  for (const char *end = text + length; length > 0; ++v->n) {
    const char *comma = memchr(text, ',', (size_t)(end - text));
    field_item it = {.text = text, .length = (size_t)((comma ? comma : end) - text)};
    trim(&it.text, &it.length);
    if (v->n < NUMBER_LIST_MAX) v->item[v->n] = it;
    if (!comma) {
      ++v->n;
      break;
    }
    text = comma + 1;
  }
}

void field_reset(const field *f, void *base)
{
  char words[64];
  message m;
  field_value v;
  int bad;
  if (f->kind == FIELD_PART) return;
  if (f->kind == FIELD_REALS || f->kind == FIELD_INTEGERS) memset(field_place(f, base), 0, sizeof(number_list));
  if (f->kind == FIELD_TEXT) memset(field_place(f, base), 0, f->size);
  if (!f->fallback || !*f->fallback) return;
  message_start(&m, words, sizeof words);
  field_split(f, f->fallback, strlen(f->fallback), &v);
  field_store(f, base, &v, &m, &bad); /* never false: tests/cases/test_fields.c checks every default's range */
}

static void reset_all(void *base, unsigned where)
{
  for (int i = 0; i < field_count(); ++i)
    if ((field_at(i)->flags & FIELD_ELSEWHERE) == where) field_reset(field_at(i), base);
}

void field_defaults(scene *sc)
{
  memset(sc, 0, sizeof *sc); /* padding too, so that equal scenes are equal bytes */
  reset_all(sc, 0);
}

void field_contact_defaults(scene_contact *c)
{
  memset(c, 0, sizeof *c);
  reset_all(c, FIELD_IN_CONTACT);
}

void field_load_defaults(structure_load *load) { reset_all(load, FIELD_IN_LOAD); }
