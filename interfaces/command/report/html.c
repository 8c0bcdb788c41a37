/* html.c - see html.h. */
#include "interfaces/command/report/html.h"

#include <stdarg.h>
#include <string.h>

#include "interfaces/command/report/parts.h"
#include "model/casefile/case_file.h"

enum { DECADES = 12, JSON_DIGITS = 12 };

void html_text(FILE *to, const char *text)
{
  for (const unsigned char *c = (const unsigned char *)text; *c; ++c) switch (*c) {
    case '<': fputs("&lt;", to); break;
    case '>': fputs("&gt;", to); break;
    case '&': fputs("&amp;", to); break;
    case '"': fputs("&quot;", to); break;
    case '\'': fputs("&#39;", to); break;
    default: putc(*c < 0x20 && *c != '\n' ? ' ' : *c, to);
    }
}

void html_percent(FILE *to, const char *text)
{
  static const char unreserved[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~";
  for (const unsigned char *c = (const unsigned char *)text; *c; ++c)
    if (strchr(unreserved, *c)) putc(*c, to);
    else fprintf(to, "%%%02X", (unsigned)*c);
}

void html_printf(FILE *to, const char *format, ...)
{
  char text[512];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  html_text(to, text);
}

hc_status html_case(FILE *to, const scene *sc, void (*write)(FILE *to, const char *text))
{
  char *text = NULL;
  size_t size = 0;
  FILE *memory = open_memstream(&text, &size);
  hc_status st = memory ? case_echo(sc, memory) : HC_NO_MEMORY;
  if (memory && (fclose(memory) != 0 || !text)) st = HC_NO_MEMORY;
  if (st == HC_OK) write(to, text);
  free(text);
  return st;
}

void html_table(FILE *to, const char *caption, int n, const char *const *heads)
{
  fputs("<div class=\"wide\" tabindex=\"0\"><table><caption>", to);
  html_text(to, caption);
  fputs("</caption>\n<thead><tr>", to);
  for (int i = 0; i < n; ++i) {
    if (!heads[i]) continue;
    fputs("<th scope=\"col\">", to);
    for (const char *c = heads[i]; *c; ++c) { /* a long name may break at its underscores */
      html_text(to, (char[]){*c, 0});
      if (*c == '_') fputs("<wbr>", to);
    }
    fputs("</th>", to);
  }
  fputs("</tr></thead><tbody>", to);
}

void html_row(FILE *to) { fputs("\n<tr>", to); }

void html_row_end(FILE *to) { fputs("</tr>", to); }

void html_cell_text(FILE *to, const char *text)
{
  fputs("<td class=\"text\">", to);
  html_text(to, text);
  fputs("</td>", to);
}

void html_cell_number(FILE *to, double value)
{
  if (isnan(value)) fputs("<td></td>", to);
  else fprintf(to, "<td>%.6g</td>", value);
}

void html_cell_bar(FILE *to, double value, double limit)
{
  if (isnan(value)) {
    fputs("<td></td>", to);
    return;
  }
  double length = value > 0 ? 100 * (1 + log10(value) / DECADES) : 0;
  fprintf(to, "<td class=\"bar%s\"><span style=\"width:%.0f%%\"></span>%.2g</td>", value > limit ? " beyond" : "",
          fmin(fmax(length, 0), 100), value);
}

void html_table_end(FILE *to) { fputs("\n</tbody></table></div>\n", to); }

static bool is_among(const char *name, const char *const *list)
{
  for (; list && *list; ++list)
    if (!strcmp(name, *list)) return true;
  return false;
}

void html_rows(FILE *to, const char *caption, rows_kind kind, unsigned extra, int n, const void *rows,
               const char *const *without)
{
  const char *heads[ROWS_MOST];
  table_column columns[ROWS_MOST];
  const int n_columns = rows_columns(kind, extra, columns);
  for (int j = 0; j < n_columns; ++j) heads[j] = is_among(columns[j].name, without) ? NULL : columns[j].name;
  html_table(to, caption, n_columns, heads);
  for (int i = 0; i < n; ++i) {
    row_cell cells[ROWS_MOST];
    rows_cells(kind, rows_at(kind, rows, i), extra, cells);
    html_row(to);
    for (int j = 0; j < n_columns; ++j) {
      const row_cell *cell = &cells[j];
      if (!heads[j]) continue;
      if (!cell->there) fputs("<td></td>", to);
      else if (cell->kind == TABLE_TEXT) html_cell_text(to, cell->as.text);
      else if (cell->kind == TABLE_INTEGER) fprintf(to, "<td>%ld</td>", cell->as.integer);
      else html_cell_number(to, cell->as.real);
    }
    html_row_end(to);
  }
  html_table_end(to);
}

static json_t *json_of(const row_cell *c)
{
  if (!c->there) return json_null();
  if (c->kind == TABLE_TEXT) return json_string(c->as.text);
  return c->kind == TABLE_INTEGER ? json_integer(c->as.integer) : json_finite(c->as.real);
}

void html_append_row(json_t *to, rows_kind kind, const void *row, const char *const *names)
{
  table_column columns[ROWS_MOST];
  row_cell cells[ROWS_MOST];
  const int n = rows_columns(kind, 0, columns);
  rows_cells(kind, row, 0, cells);
  for (int j = 0; j < n; ++j) {
    if (!is_among(columns[j].name, names)) continue;
    json_t *list = json_object_get(to, columns[j].name);
    if (!list) json_object_set_new(to, columns[j].name, list = json_array());
    json_array_append_new(list, json_of(&cells[j]));
  }
}

hc_status html_json(FILE *to, const json_t *value)
{
  char *text = json_dumps(value, JSON_COMPACT | JSON_SORT_KEYS | JSON_REAL_PRECISION(JSON_DIGITS));
  if (!text) return HC_NO_MEMORY;
  for (const char *c = text; *c; ++c) { /* "<" occurs in strings only */
    if (*c == '<') fputs("\\u003c", to);
    else putc(*c, to);
  }
  free(text);
  return HC_OK;
}
