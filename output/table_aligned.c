/* table_aligned.c - a table for people: columns two spaces apart, text to the left, numbers to the right under their
 * header. A column of reals is written in one notation, so that its decimal points stand under each other: fixed
 * with as many decimals as its values need for 7 significant digits each, or scientific when that would take more
 * than 11 digits. An exact zero is "0". Spaces are written only once something follows them, so no line ends in one.
 * Lines that are too long lose columns to spare, then are broken into blocks. Proof: tests/output/test_table.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/message.h"
#include "base/utf8.h"
#include "output/table_private.h"

enum {
  SIGNIFICANT = 7,
  MAX_DIGITS = 11,
  MAX_EXPONENT = SIGNIFICANT - 1,
  MAX_TEXT_WIDTH = 60,
  NUMBER_ROOM = 40,
  BETWEEN = 2 /* columns */
};

typedef struct column_style {
  bool scientific;
  int decimals;
  int width; /* in terminal columns */
} column_style;

/* A table as it will look. */
typedef struct layout {
  const table *t;
  column_style *style; /* [n_columns] */
  bool *shown;         /* [n_columns] */
  int first, last;     /* columns shown: the first one begins every block, the last one's texts are never cut */
} layout;

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
static void significant_digits(double v, int *exponent, int *mantissa)
{
  char text[NUMBER_ROOM];
  snprintf(text, sizeof text, "%.*e", SIGNIFICANT - 1, v);
  char *e = strchr(text, 'e');
  *exponent = (int)strtol(e + 1, NULL, 10);
  *mantissa = SIGNIFICANT - 1;
  while (*mantissa > 0 && *--e == '0') --*mantissa;
}

/* The cell's text, in `digits` unless it is a text already. */
static const char *cell_text(const table *t, int row, int column, const column_style *style, char digits[NUMBER_ROOM])
{
  const table_cell *cell = table_at(t, row, column);
  if (!cell->there) return "";
  switch (t->columns[column].kind) {
  case TABLE_TEXT: return cell->as.text;
  case TABLE_INTEGER: snprintf(digits, NUMBER_ROOM, "%ld", cell->as.integer); return digits;
  case TABLE_REAL:
    if (cell->as.real == 0) return "0";
    snprintf(digits, NUMBER_ROOM, style->scientific ? "%.*e" : "%.*f", style->decimals, cell->as.real);
    return digits;
  }
  return "";
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

static int shown_width(const layout *l)
{
  int width = -BETWEEN;
  for (int j = 0; j < l->t->n_columns; ++j)
    if (l->shown[j]) width += l->style[j].width + BETWEEN;
  return width;
}

static bool is_empty(const table *t, int column)
{
  for (int i = 0; i < table_row_count(t); ++i)
    if (table_at(t, i, column)->there) return false;
  return true;
}

static bool too_long(const layout *l) { return l->t->fit > 0 && shown_width(l) > l->t->fit; }

static void write_cell(line_writer *w, const layout *l, int column, const char *text)
{
  const column_style *style = &l->style[column];
  bool number = l->t->columns[column].kind != TABLE_TEXT;
  if (!l->shown[column]) return;
  if (w->begun) owe_spaces(w, BETWEEN);
  w->begun = true;
  if (number) owe_spaces(w, style->width - utf8_width(text));
  if (number || column == l->last) write_bytes(w, text, strlen(text));
  else write_fitted(w, text, style->width);
}

static void write_line(line_writer *l, const char *text)
{
  write_bytes(l, text, strlen(text));
  end_line(l);
}

/* Where the block ends that begins at `from`: it has one column at least, beside the first one of all. */
static int end_of_block(const layout *l, int from)
{
  int width = l->style[l->first].width, to = from > l->first ? from : l->first + 1;
  for (int n = 0; to <= l->last; ++to) {
    if (!l->shown[to]) continue;
    width += BETWEEN + l->style[to].width;
    if (n++ > 0 && l->t->fit > 0 && width > l->t->fit) break;
  }
  return to;
}

hc_status table_write_aligned(const table *t, FILE *to)
{
  const size_t n = (size_t)t->n_columns;
  line_writer w = {.to = to};
  layout l = {.t = t, .style = calloc(n, sizeof *l.style), .shown = calloc(n, sizeof *l.shown)};
  const bool good = l.style && l.shown;
  if (good) {
    if (*t->title) write_line(&w, t->title);
    for (int j = 0; j < t->n_columns; ++j) {
      column_style *style = &l.style[j];
      *style = (column_style){.width = 0};
      if (t->columns[j].kind == TABLE_REAL) {
        int largest = 0, decimals = 0, mantissa = 0;
        for (int i = 0; i < table_row_count(t); ++i) {
          const table_cell *cell = table_at(t, i, j);
          if (!cell->there || !isfinite(cell->as.real) || cell->as.real == 0) continue;
          int e, m;
          significant_digits(cell->as.real, &e, &m);
          if (e > largest) largest = e;
          if (m > mantissa) mantissa = m;
          if (m - e > decimals) decimals = m - e;
        }
        style->scientific = largest > MAX_EXPONENT || largest + 1 + decimals > MAX_DIGITS;
        style->decimals = style->scientific ? mantissa : decimals;
      }
      for (int i = 0; i < table_row_count(t); ++i) {
        char digits[NUMBER_ROOM];
        int width = utf8_width(cell_text(t, i, j, style, digits));
        if (width > style->width) style->width = width;
      }
      if (style->width > MAX_TEXT_WIDTH) style->width = MAX_TEXT_WIDTH;
      int header = utf8_width(t->columns[j].name);
      if (header > style->width) style->width = header;
      l.shown[j] = !t->hidden[j];
    }
    const int wanted = table_shown(t, l.shown);
    /* Empty columns go first. */
    for (int only_empty = 1; only_empty >= 0; --only_empty)
      for (const char *const *name = l.t->spare; name && *name && too_long(&l); ++name)
        for (int j = 0; j < l.t->n_columns; ++j)
          if (!strcmp(l.t->columns[j].name, *name) && (!only_empty || is_empty(l.t, j))) l.shown[j] = false;
    l.last = t->n_columns - 1;
    while (l.first < l.last && !l.shown[l.first]) ++l.first;
    while (l.last > l.first && !l.shown[l.last]) --l.last;
    for (int from = l.first, end; from <= l.last; from = end) {
      end = end_of_block(&l, from);
      if (from > l.first) end_line(&w);
      /* The columns from..to-1, and before them the first one of all. Row -1: the header. */
      for (int row = -1; row < table_row_count(l.t); ++row) {
        for (int j = l.first; j < end; ++j) {
          char digits[NUMBER_ROOM];
          if (j > l.first && j < from) continue;
          write_cell(&w, &l, j, row < 0 ? l.t->columns[j].name : cell_text(l.t, row, j, &l.style[j], digits));
        }
        end_line(&w);
      }
    }
    int lost = wanted - table_shown(t, l.shown);
    char text[64];
    if (l.t->n_notes || lost) end_line(&w);
    for (size_t i = 0; i < l.t->n_notes; ++i) write_line(&w, l.t->notes[i]);
    snprintf(text, sizeof text, TABLE_SHOWN, table_shown(l.t, l.shown), l.t->n_columns);
    if (lost) write_line(&w, text);
  }
  free(l.style);
  free(l.shown);
  return good ? HC_OK : HC_NO_MEMORY;
}
