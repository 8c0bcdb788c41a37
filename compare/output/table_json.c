/* table_json.c - tables as json: values and texts through jansson, the frame around them here, so that a row is one
 * line and key order is column order. table.h says what the document looks like. Proof: tests/output/test_table.c. */
#include <jansson.h>
#include <math.h>

#include "compare/output/table_private.h"

static json_t *cell_value(const table *t, int row, int column)
{
  const table_cell *cell = table_at(t, row, column);
  if (!cell->there) return json_null();
  switch (t->columns[column].kind) {
  case TABLE_TEXT: return json_string(cell->as.text);
  case TABLE_INTEGER: return json_integer(cell->as.integer);
  case TABLE_REAL: return isfinite(cell->as.real) ? json_real(cell->as.real) : json_null();
  case TABLE_SERIES: break; /* for programs: rows.h */
  }
  return json_null();
}

/* Takes over `value`; NULL, out of memory, is handed on. */
static hc_status write_value(json_t *value, FILE *to)
{
  if (!value) return HC_NO_MEMORY;
  int failed = json_dumpf(value, to, JSON_REAL_PRECISION(17) | JSON_ENCODE_ANY);
  json_decref(value);
  return failed && !ferror(to) ? HC_NO_MEMORY : HC_OK;
}

static hc_status write_row(const table *t, int row, FILE *to)
{
  json_t *object = json_object();
  for (int j = 0; object && j < t->n_columns; ++j) {
    if (json_object_set_new(object, t->columns[j].name, cell_value(t, row, j)) == 0) continue;
    json_decref(object);
    return HC_NO_MEMORY;
  }
  return write_value(object, to);
}

/* The rows from `from` on, one a line. */
static hc_status write_rows_from(const table *t, int from, FILE *to)
{
  hc_status st = HC_OK;
  for (int i = from; i < table_row_count(t) && st == HC_OK; ++i) {
    fputs(i ? ",\n    " : "\n    ", to);
    st = write_row(t, i, to);
  }
  return st;
}

/* `[`, the rows one a line, `]`; `written` of them, if any, were written with the `[`. */
static hc_status write_rows(const table *t, int written, FILE *to)
{
  if (written == 0) fputs("[", to);
  hc_status st = write_rows_from(t, written, to);
  fputs(table_row_count(t) ? "\n  ]" : "]", to);
  return st;
}

static hc_status write_notes(const table *t, const char *indent, FILE *to)
{
  hc_status st = HC_OK;
  fputs("[", to);
  for (size_t i = 0; i < t->n_notes && st == HC_OK; ++i) {
    fprintf(to, "%s\n%s  ", i ? "," : "", indent);
    st = write_value(json_string(t->notes[i]), to);
  }
  if (t->n_notes) fprintf(to, "\n%s", indent);
  fputs("]", to);
  return st;
}

/* The title; with a number where an earlier table or "notes" has it. Goes into `taken`. */
static json_t *make_key(const table *t, json_t *taken)
{
  const char *title = *t->title ? t->title : "table";
  json_t *key = json_string(title);
  for (int k = 2; key && json_object_get(taken, json_string_value(key)); ++k) {
    json_decref(key);
    key = json_sprintf("%s (%d)", title, k);
  }
  if (key && json_object_set(taken, json_string_value(key), key) == 0) return key;
  json_decref(key);
  return NULL;
}

/* Keys of all tables: an array of strings, NULL when out of memory. */
static json_t *make_keys(int n, table *const *tables)
{
  json_t *keys = json_array(), *taken = json_object();
  bool good = keys && taken && json_object_set_new(taken, "notes", json_true()) == 0;
  for (int k = 0; k < n && good; ++k) good = json_array_append_new(keys, make_key(tables[k], taken)) == 0;
  json_decref(taken);
  if (good) return keys;
  json_decref(keys);
  return NULL;
}

static hc_status write_key(json_t *keys, int k, FILE *to)
{
  hc_status st = write_value(json_incref(json_array_get(keys, (size_t)k)), to);
  fputs(": ", to);
  return st;
}

/* Before the rows of the first table. keys: of all tables, or NULL where there is one. */
static hc_status write_beginning(json_t *keys, FILE *to)
{
  fputs(keys ? "{\n" : "{\n  \"rows\": ", to);
  if (!keys || json_array_size(keys) == 0) return HC_OK;
  fputs("  ", to);
  return write_key(keys, 0, to);
}

hc_status table_write_json_begun(const table *t, FILE *to, const table_begun *begun)
{
  table *const first = (table *)t;
  json_t *keys = begun->several ? make_keys(1, &first) : NULL;
  hc_status st = begun->several && !keys ? HC_NO_MEMORY : HC_OK;
  if (st == HC_OK && !begun->begun && (st = write_beginning(keys, to)) == HC_OK) fputs("[", to);
  if (st == HC_OK) st = write_rows_from(t, begun->rows, to);
  json_decref(keys);
  return st;
}

hc_status table_write_json(int n, table *const *tables, FILE *to, const table_begun *begun)
{
  if (!begun->several) {
    const table *t = tables[0];
    hc_status st = begun->begun ? HC_OK : write_beginning(NULL, to);
    if (st == HC_OK) st = write_rows(t, begun->rows, to);
    fputs(",\n  \"notes\": ", to);
    if (st == HC_OK) st = write_notes(t, "  ", to);
    fputs("\n}\n", to);
    return st;
  }
  json_t *keys = make_keys(n, tables);
  if (!keys) return HC_NO_MEMORY;
  hc_status st = begun->begun ? HC_OK : write_beginning(keys, to);
  for (int k = 0; k < n && st == HC_OK; ++k) {
    if (k) {
      fputs("  ", to);
      st = write_key(keys, k, to);
    }
    if (st == HC_OK) st = write_rows(tables[k], k ? 0 : begun->rows, to);
    fputs(",\n", to);
  }
  if (st == HC_OK) {
    bool any = false;
    fputs("  \"notes\": {", to);
    for (int k = 0; k < n && st == HC_OK; ++k) {
      if (!tables[k]->n_notes) continue;
      fputs(any ? ",\n    " : "\n    ", to);
      any = true;
      if ((st = write_key(keys, k, to)) == HC_OK) st = write_notes(tables[k], "    ", to);
    }
    fputs(any ? "\n  }" : "}", to);
  }
  fputs("\n}\n", to);
  json_decref(keys);
  return st;
}
