/* table_aligned.c - a table for people: columns two spaces apart, text to the left, numbers to the right under their
 * header. A column of reals is written in one notation, so that its decimal points stand under each other: fixed
 * with as many decimals as its values need for 7 significant digits each, or scientific when that would take more
 * than 11 digits. An exact zero is "0". A text wider than its column goes on in the next line, from a blank on, and an
 * empty line follows the row. Lines that are too long lose columns to spare; a table to be wrapped then narrows its
 * texts; what is still too long stands in blocks, each of which begins with the columns that tell the rows apart.
 * Proof: tests/output/test_table.c. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compare/output/table_private.h"
#include "numerics/base/utf8.h"

enum {
  SIGNIFICANT = 7,
  MAX_DIGITS = 11,
  MAX_EXPONENT = SIGNIFICANT - 1,
  MAX_TEXT_WIDTH = 60,
  NUMBER_ROOM = 40,
  BETWEEN = 2,  /* columns */
  NARROWEST = 8 /* a text that is wrapped */
};

typedef struct column_style {
  bool shown, number;
  int width; /* in terminal columns */
  int word;  /* width of the longest one, header included; of numbers the same as width */
  /* of reals */
  bool scientific;
  int decimals;
  const char *rest; /* of the text being written */
} column_style;

/* A table as it will look. */
typedef struct layout {
  const table *t;
  char **texts;        /* [rows + 1][columns], the header first */
  column_style *style; /* [columns] */
  int longest;         /* line [terminal columns]; INT_MAX: any */
  int keys;            /* the columns before it begin every block; 0: one block holds all */
} layout;

/* ---- cells as texts ---- */

/* Exponent of v, finite and not 0, to 7 significant digits, and how many of 6 mantissa decimals it needs. */
static void significant_digits(double v, int *exponent, int *mantissa)
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
  for (int i = 0; i < table_row_count(t); ++i) {
    const table_cell *cell = table_at(t, i, column);
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

/* The text of a cell, of row -1 the header; free() it. NULL: out of memory. */
static char *cell_text(const table *t, int row, int column, const column_style *style)
{
  if (row < 0) return strdup(t->columns[column].name);
  const table_cell *cell = table_at(t, row, column);
  char number[NUMBER_ROOM] = "";
  if (!cell->there) return strdup("");
  switch (t->columns[column].kind) {
  case TABLE_TEXT: return utf8_clean(cell->as.text, true);
  case TABLE_INTEGER: snprintf(number, sizeof number, "%ld", cell->as.integer); break;
  case TABLE_SERIES: break;
  case TABLE_REAL:
    if (cell->as.real == 0) return strdup("0");
    snprintf(number, sizeof number, style->scientific ? "%.*e" : "%.*f", style->decimals, cell->as.real);
  }
  return strdup(number);
}

static const char *text_at(const layout *l, int row, int column)
{
  return l->texts[(size_t)(row + 1) * (size_t)l->t->n_columns + (size_t)column];
}

static int width_of(const char *text, size_t bytes)
{
  int width = 0;
  for (const char *end = text + bytes; text < end;) width += utf8_columns(utf8_next(&text));
  return width;
}

/* The texts of a column, how wide the widest is, and their longest word. */
static bool make_texts(layout *l, int column)
{
  const table *t = l->t;
  column_style *style = &l->style[column];
  style->shown = !t->hidden[column];
  style->number = t->columns[column].kind != TABLE_TEXT;
  if (t->columns[column].kind == TABLE_REAL) choose_notation(t, column, style);
  for (int i = -1; i < table_row_count(t); ++i) {
    char *text = cell_text(t, i, column, style);
    if (!text) return false;
    l->texts[(size_t)(i + 1) * (size_t)t->n_columns + (size_t)column] = text;
    const int width = utf8_width(text);
    if (width > style->width) style->width = width;
    for (const char *at = text; *at; at += strspn(at, " ")) {
      const size_t bytes = strcspn(at, " ");
      const int word = width_of(at, bytes);
      if (word > style->word) style->word = word;
      at += bytes;
    }
  }
  return true;
}

/* ---- what fits ---- */

static int count_shown(const layout *l)
{
  int n = 0;
  for (int j = 0; j < l->t->n_columns; ++j) n += l->style[j].shown;
  return n;
}

/* The width of a line of the columns before `end`, each with its own or that of its longest word. */
static int line_width(const layout *l, int end, bool words)
{
  int width = -BETWEEN;
  for (int j = 0; j < end; ++j)
    if (l->style[j].shown) width += BETWEEN + (words ? l->style[j].word : l->style[j].width);
  return width;
}

static bool is_empty(const table *t, int column)
{
  for (int i = 0; i < table_row_count(t); ++i)
    if (table_at(t, i, column)->there) return false;
  return true;
}

/* Columns to spare go, one after the other, while a line is too long, or its words are where texts can be narrowed;
 * only_empty: of these the empty ones. */
static void drop_columns(layout *l, bool only_empty)
{
  const table *t = l->t;
  const char *const *name = t->spare;
  for (; name && *name && line_width(l, t->n_columns, t->wrap > 0) > l->longest; ++name)
    for (int j = 0; j < t->n_columns; ++j)
      if (!strcmp(t->columns[j].name, *name) && (!only_empty || is_empty(t, j))) l->style[j].shown = false;
}

/* The widest text wider than its longest word, or if none is, than NARROWEST; -1: none. */
static int column_to_narrow(const layout *l)
{
  int whole = -1, any = -1;
  for (int j = 0; j < l->t->n_columns; ++j) {
    const column_style *c = &l->style[j];
    if (!c->shown || c->number || c->width <= NARROWEST) continue;
    if (any < 0 || c->width > l->style[any].width) any = j;
    if (c->width > c->word && (whole < 0 || c->width > l->style[whole].width)) whole = j;
  }
  return whole >= 0 ? whole : any;
}

typedef struct sorted_row {
  const layout *l;
  int row;
} sorted_row;

/* The first column shown in which two rows differ; the number of columns: none. */
static int first_difference(const sorted_row *a, const sorted_row *b)
{
  int j = 0;
  for (; j < a->l->t->n_columns; ++j)
    if (a->l->style[j].shown && strcmp(text_at(a->l, a->row, j), text_at(a->l, b->row, j)) != 0) break;
  return j;
}

static int in_order(const void *a, const void *b)
{
  const sorted_row *x = a, *y = b;
  const int j = first_difference(x, y);
  return j < x->l->t->n_columns ? strcmp(text_at(x->l, x->row, j), text_at(x->l, y->row, j)) : 0;
}

/* The terminal columns that the blocks' keys leave, and those that the columns beside them need at least. */
static int room_beside(const layout *l) { return l->longest - line_width(l, l->keys, false) - BETWEEN; }
static int needed_beside(const layout *l)
{
  int most = 0;
  for (int j = l->keys; j < l->t->n_columns; ++j)
    if (l->style[j].shown && l->style[j].word > most) most = l->style[j].word;
  return most;
}

/* The fewest first columns in which no two rows are alike begin every block: of sorted rows, neighbours agree
 * longest. Of these only as many as leave room for the others, but one. Texts become as narrow as what is left. */
static bool choose_keys(layout *l)
{
  const int n = table_row_count(l->t);
  sorted_row *rows = malloc(((size_t)n + 1) * sizeof *rows);
  if (!rows) return false;
  for (int i = 0; i < n; ++i) rows[i] = (sorted_row){l, i};
  qsort(rows, (size_t)n, sizeof *rows, in_order);
  int first = 0;
  while (first < l->t->n_columns - 1 && !l->style[first].shown) ++first;
  l->keys = first + 1;
  for (int i = 1; i < n; ++i) {
    const int j = first_difference(&rows[i - 1], &rows[i]);
    if (j < l->t->n_columns && j >= l->keys) l->keys = j + 1;
  }
  free(rows);
  while (l->keys > first + 1 && needed_beside(l) > room_beside(l)) --l->keys;
  const int room = room_beside(l) > NARROWEST ? room_beside(l) : NARROWEST;
  for (int j = l->keys; j < l->t->n_columns; ++j)
    if (!l->style[j].number && l->style[j].width > room) l->style[j].width = room;
  return true;
}

/* Columns and their widths; the last text is as wide as the line lets it be. */
static bool fit(layout *l)
{
  const table *t = l->t;
  const int n = t->n_columns;
  int last = n - 1;
  while (last > 0 && t->hidden[last]) --last;
  column_style *end = &l->style[last];
  const int widest = end->width;
  for (int j = 0; j < n && !t->wrap; ++j)
    if (!l->style[j].number && l->style[j].width > MAX_TEXT_WIDTH) l->style[j].width = MAX_TEXT_WIDTH;
  drop_columns(l, true);
  drop_columns(l, false);
  for (int j; t->wrap && line_width(l, n, false) > l->longest && (j = column_to_narrow(l)) >= 0;) --l->style[j].width;
  const int left = l->longest - line_width(l, n, false);
  if (left < 0) return choose_keys(l);
  end->width = widest - end->width < left ? widest : end->width + left;
  return true;
}

/* ---- lines ---- */

/* Bytes of the next line of *rest, which moves past them and the spaces behind. */
static size_t next_part(const char **rest, int width)
{
  int own;
  const char *from = *rest;
  size_t fits = utf8_fit(from, width, &own), cut = fits;
  if (from[fits] && from[fits] != ' ') {
    while (cut > 0 && from[cut - 1] != ' ') --cut;
    if (cut == 0) cut = fits;
  }
  if (cut == 0 && *from) { /* not even one character fits */
    const char *past = from;
    utf8_next(&past);
    cut = (size_t)(past - from);
  }
  *rest = from + cut;
  *rest += strspn(*rest, " ");
  while (cut > 0 && from[cut - 1] == ' ') --cut;
  return cut;
}

/* A text of its own, in lines. */
static void write_text(const char *text, int width, FILE *to)
{
  do {
    const char *from = text;
    fprintf(to, "%.*s\n", (int)next_part(&text, width), from);
  } while (*text);
}

/* A row of the block of columns from..end-1, in as many lines as it takes; how many. */
static int write_row(const layout *l, int row, int from, int end, FILE *to)
{
  int lines = 0;
  bool left = true;
  for (int j = 0; j < end; ++j) l->style[j].rest = text_at(l, row, j);
  for (; left; ++lines) {
    int spaces = 0;
    left = false;
    for (int j = 0; j < end; ++j) {
      column_style *c = &l->style[j];
      if (!c->shown || (j >= l->keys && j < from)) continue;
      const char *part = c->rest;
      const size_t bytes = next_part(&c->rest, c->width);
      const int pad = c->width - width_of(part, bytes);
      if (c->number) spaces += pad;
      if (bytes) fprintf(to, "%*s%.*s", spaces, "", (int)bytes, part);
      spaces = (bytes ? 0 : spaces) + (c->number ? 0 : pad) + BETWEEN;
      left |= *c->rest;
    }
    putc('\n', to);
  }
  return lines;
}

/* Where the block ends that begins at `from`: it has one column at least, beside the keys. */
static int end_of_block(const layout *l, int from)
{
  int width = line_width(l, l->keys, false), to = from;
  for (int n = 0; to < l->t->n_columns; ++to) {
    if (!l->style[to].shown) continue;
    width += BETWEEN + l->style[to].width;
    if (n++ > 0 && width > l->longest) break;
  }
  return to;
}

static void write_blocks(const layout *l, FILE *to)
{
  for (int from = l->keys, end; end = end_of_block(l, from), true; from = end) {
    if (from > l->keys) putc('\n', to);
    for (int row = -1, lines = 1; row < table_row_count(l->t); ++row) {
      if (row > 0 && lines > 1) putc('\n', to);
      lines = write_row(l, row, from, end, to);
    }
    if (end >= l->t->n_columns) return;
  }
}

/* The remarks, and how many columns are shown if there were to be more. */
static void write_notes(const layout *l, int wanted, FILE *to)
{
  const table *t = l->t;
  const int shown = count_shown(l), width = isatty(fileno(to)) ? l->longest : INT_MAX;
  if (t->n_notes || shown < wanted) putc('\n', to);
  for (size_t i = 0; i < t->n_notes; ++i) write_text(t->notes[i], width, to);
  if (shown < wanted) fprintf(to, "%d of %d columns shown; --wide shows all\n", shown, t->n_columns);
}

hc_status table_write_aligned(const table *t, FILE *to)
{
  const size_t n = (size_t)t->n_columns, cells = n * ((size_t)table_row_count(t) + 1) + 1;
  layout l = {.t = t, .texts = calloc(cells, sizeof *l.texts), .style = calloc(n + 1, sizeof *l.style)};
  l.longest = t->wrap ? t->wrap : t->fit ? t->fit : INT_MAX;
  bool good = l.texts && l.style;
  for (int j = 0; j < t->n_columns && good; ++j) good = make_texts(&l, j);
  const int wanted = good ? count_shown(&l) : 0;
  if (good && (good = fit(&l))) {
    if (*t->title) write_text(t->title, INT_MAX, to);
    write_blocks(&l, to);
    write_notes(&l, wanted, to);
  }
  for (size_t i = 0; l.texts && i < cells; ++i) free(l.texts[i]);
  free(l.texts);
  free(l.style);
  return good ? HC_OK : HC_NO_MEMORY;
}
