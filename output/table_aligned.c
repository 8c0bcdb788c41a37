/* table_aligned.c - a table for people: columns two spaces apart, text to the left, numbers to the right under their
 * header. A column of reals is written in one notation, so that its decimal points stand under each other: fixed
 * with as many decimals as its values need for 7 significant digits each, or scientific when that would take more
 * than 11 digits. An exact zero is "0". Spaces are written only once something follows them, so no line ends in one.
 * Proof: tests/output/test_table.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "base/utf8.h"
#include "output/table_private.h"

enum { SIGNIFICANT = 7, MAX_DIGITS = 11, MAX_EXPONENT = SIGNIFICANT - 1, MAX_TEXT_WIDTH = 60, NUMBER_ROOM = 40 };

typedef struct column_style {
  bool scientific;
  int decimals;
  int width; /* in terminal columns */
} column_style;

/* The line being written. */
typedef struct line_writer {
  FILE *to;
  int spaces; /* owed before the next visible character */
  bool begun; /* has a cell */
} line_writer;

static void owe_spaces(line_writer *l, int n) { l->spaces += n; }

/* The first `bytes` of a text; control characters become spaces. */
static void write_bytes(line_writer *l, const char *s, size_t bytes)
{
  for (const char *end = s + bytes; s < end;) {
    const char *from = s;
    unsigned long code = utf8_next(&s);
    if (code == ' ' || utf8_is_control(code)) {
      ++l->spaces;
      continue;
    }
    for (; l->spaces > 0; --l->spaces) putc(' ', l->to);
    fwrite(from, 1, (size_t)(s - from), l->to);
  }
}

static void end_line(line_writer *l)
{
  l->spaces = 0;
  l->begun = false;
  putc('\n', l->to);
}

/* Exponent of v, finite and not 0, rounded to 7 significant digits, and how many of the 6 mantissa decimals are
 * needed. */
static void measure(double v, int *exponent, int *mantissa)
{
  char text[NUMBER_ROOM];
  snprintf(text, sizeof text, "%.*e", SIGNIFICANT - 1, v);
  char *e = strchr(text, 'e');
  *exponent = (int)strtol(e + 1, NULL, 10);
  *mantissa = SIGNIFICANT - 1;
  while (*mantissa > 0 && *--e == '0') --*mantissa;
}

static void choose_notation(const table *t, int column, column_style *style)
{
  int largest = 0, decimals = 0, mantissa = 0;
  for (int i = 0; i < table_rows(t); ++i) {
    const table_cell *cell = table_at(t, i, column);
    if (!cell->there || !isfinite(cell->as.real) || cell->as.real == 0) continue;
    int e, m;
    measure(cell->as.real, &e, &m);
    if (e > largest) largest = e;
    if (m > mantissa) mantissa = m;
    if (m - e > decimals) decimals = m - e;
  }
  style->scientific = largest > MAX_EXPONENT || largest + 1 + decimals > MAX_DIGITS;
  style->decimals = style->scientific ? mantissa : decimals;
}

/* The cell's text, in `room` unless it is a text already. */
static const char *cell_text(const table *t, int row, int column, const column_style *style, char room[NUMBER_ROOM])
{
  const table_cell *cell = table_at(t, row, column);
  if (!cell->there) return "";
  switch (t->columns[column].kind) {
  case TABLE_TEXT: return cell->as.text;
  case TABLE_INTEGER: snprintf(room, NUMBER_ROOM, "%ld", cell->as.integer); return room;
  case TABLE_REAL:
    if (cell->as.real == 0) return "0";
    snprintf(room, NUMBER_ROOM, style->scientific ? "%.*e" : "%.*f", style->decimals, cell->as.real);
    return room;
  }
  return "";
}

static void choose_style(const table *t, int column, column_style *style)
{
  *style = (column_style){.width = 0};
  if (t->columns[column].kind == TABLE_REAL) choose_notation(t, column, style);
  for (int i = 0; i < table_rows(t); ++i) {
    char room[NUMBER_ROOM];
    int width = utf8_width(cell_text(t, i, column, style, room));
    if (width > style->width) style->width = width;
  }
  if (style->width > MAX_TEXT_WIDTH) style->width = MAX_TEXT_WIDTH;
  int header = utf8_width(t->columns[column].name);
  if (header > style->width) style->width = header;
}

/* A text in a column of that many; too long, it ends in an ellipsis. */
static void write_fitted(line_writer *l, const char *text, int columns)
{
  int width = utf8_width(text);
  if (width <= columns) {
    write_bytes(l, text, strlen(text));
  } else {
    write_bytes(l, text, utf8_fit(text, columns - 1, &width));
    write_bytes(l, "\xe2\x80\xa6", 3);
    width += 1;
  }
  owe_spaces(l, columns - width);
}

static int last_shown(const table *t)
{
  int last = t->n_columns - 1;
  while (last > 0 && t->hidden[last]) --last;
  return last;
}

static void write_cell(line_writer *l, const table *t, int column, const column_style *style, const char *text)
{
  bool number = t->columns[column].kind != TABLE_TEXT;
  if (t->hidden[column]) return;
  if (l->begun) owe_spaces(l, 2);
  l->begun = true;
  if (number) owe_spaces(l, style->width - utf8_width(text));
  if (number || column == last_shown(t)) write_bytes(l, text, strlen(text));
  else write_fitted(l, text, style->width);
}

static void write_line(line_writer *l, const char *text)
{
  write_bytes(l, text, strlen(text));
  end_line(l);
}

hc_status table_write_aligned(const table *t, FILE *to)
{
  line_writer l = {.to = to};
  column_style *styles = calloc((size_t)t->n_columns, sizeof *styles);
  if (!styles) return HC_NO_MEMORY;
  if (*t->title) write_line(&l, t->title);
  for (int j = 0; j < t->n_columns; ++j) {
    choose_style(t, j, &styles[j]);
    write_cell(&l, t, j, &styles[j], t->columns[j].name);
  }
  end_line(&l);
  for (int i = 0; i < table_rows(t); ++i) {
    for (int j = 0; j < t->n_columns; ++j) {
      char room[NUMBER_ROOM];
      write_cell(&l, t, j, &styles[j], cell_text(t, i, j, &styles[j], room));
    }
    end_line(&l);
  }
  if (t->n_notes) end_line(&l);
  for (size_t i = 0; i < t->n_notes; ++i) write_line(&l, t->notes[i]);
  free(styles);
  return HC_OK;
}
