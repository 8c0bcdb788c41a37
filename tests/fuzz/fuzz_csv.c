/* fuzz_csv.c - bytes as what `hbmcheck verify` is given: the first line is --columns, the rest is the file. */
#include <string.h>

#include "compare/verify/curve_file/csv.h"
#include "tests/fuzz/fuzz.h"

static void read_file(const char *text, size_t length, const verify_columns *columns)
{
  char path[FUZZ_PATH], words[VERIFY_TEXT];
  verify_data d;
  fuzz_write("curve.csv", text, length, path);
  hc_status st = verify_data_read(path, columns, &d, words);
  if (st == HC_OK) {
    ++fuzz_accepted;
    must(!*words, "read, with a message: %s", words);
    must(columns->by_header || verify_quantity_same(&d.quantity, &columns->quantity), "quantity %d, not %d",
         (int)d.quantity.kind, (int)columns->quantity.kind);
    long lines = 1;
    for (size_t i = 0; i < length; ++i) lines += text[i] == '\n';
    must(d.n >= VERIFY_LEAST_POINTS && d.n <= VERIFY_MOST_POINTS, "%d points", d.n);
    for (int i = 0; i < d.n; ++i) {
      const verify_point *p = &d.points[i];
      must(isfinite(p->omega) && p->omega > 0 && isfinite(p->value) &&
               (p->value >= 0 || verify_quantity_signed(&d.quantity)),
           "point %d is (%g, %g)", i, p->omega, p->value);
      must(p->line > (i ? d.points[i - 1].line : 0) && p->line <= lines, "point %d stands on line %ld of %ld", i,
           p->line, lines);
    }
  } else {
    ++fuzz_refused;
    must(st == HC_BAD_INPUT, "status %d: %s", (int)st, words);
    message_is_clean(words, sizeof words);
    place_is_inside(words, path, text, length, false);
  }
  verify_data_clear(&d);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  char words[VERIFY_TEXT];
  verify_columns columns;
  const uint8_t *line_end = size ? memchr(data, '\n', size) : NULL;
  size_t first = line_end ? (size_t)(line_end - data) : size, skip = line_end ? first + 1 : size;
  char *text = fuzz_string(data, first);
  hc_status st = verify_columns_read(*text ? text : NULL, strstr(text, "value=") ? "peak" : NULL, &columns, words);
  if (st == HC_OK) {
    must(!*words, "columns read, with a message: %s", words);
    must(columns.omega.number >= 0 && columns.omega.number <= VERIFY_MOST_FIELDS, "column %d", columns.omega.number);
    must(columns.value.number >= 0 && columns.value.number <= VERIFY_MOST_FIELDS, "column %d", columns.value.number);
    read_file(skip < size ? (const char *)data + skip : "", size - skip, &columns);
  } else {
    ++fuzz_refused;
    must(st == HC_BAD_INPUT, "status %d: %s", (int)st, words);
    message_is_clean(words, sizeof words);
  }
  free(text);
  return 0;
}
