/* table_aligned.c - a table for people: columns two spaces apart, text to the left, numbers to the right under their
 * header. A column of reals is written in one notation, so that its decimal points stand under each other: fixed
 * with as many decimals as its values need for 7 significant digits each, or scientific when that would take more
 * than 11 digits. An exact zero is "0". Spaces are written only once something follows them, so no line ends in one.
 * Lines that are too long lose columns to spare, then are broken into blocks. Proof: tests/output/test_table.c. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numerics/base/utf8.h"
#include "output/table_private.h"

enum {
  SIGNIFICANT = 7,
  MAX_DIGITS = 11,
  MAX_EXPONENT = SIGNIFICANT - 1,
  MAX_TEXT_WIDTH = 60,
  NUMBER_ROOM = 40,
  BETWEEN = 2,  /* columns */
  NARROWEST = 8 /* a column that is wrapped */
};

typedef struct column_style {
  bool shown;
  int width; /* in terminal columns */
  /* of numbers in lines that are not wrapped */
  bool scientific;
  int decimals;
  /* of texts that are wrapped */
  int word;         /* width of the longest one, header included */
  const char *rest; /* of the text being written */
} column_style;

/* A table as it will look. */
typedef struct layout {
  const table *t;
  column_style *style; /* [n_columns] */
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

static int count_shown(const table *t, const column_style *style)
{
  int n = 0;
  for (int j = 0; j < t->n_columns; ++j) n += style[j].shown;
  return n;
}

/* The width of a line in which each column has its own, or that of its longest word. */
static int line_width(const table *t, const column_style *style, bool words)
{
  int width = -BETWEEN;
  for (int j = 0; j < t->n_columns; ++j)
    if (style[j].shown) width += BETWEEN + (words ? style[j].word : style[j].width);
  return width;
}

static bool is_empty(const table *t, int column)
{
  for (int i = 0; i < table_row_count(t); ++i)
    if (table_at(t, i, column)->there) return false;
  return true;
}

/* Columns to spare go, one after the other, while a line is too long; only_empty: of these the empty ones. */
static void drop_columns(const table *t, column_style *style, int longest, bool words, bool only_empty)
{
  const char *const *name = t->spare;
  for (; name && *name && longest > 0 && line_width(t, style, words) > longest; ++name)
    for (int j = 0; j < t->n_columns; ++j)
      if (!strcmp(t->columns[j].name, *name) && (!only_empty || is_empty(t, j))) style[j].shown = false;
}

static void write_cell(line_writer *w, const layout *l, int column, const char *text)
{
  const column_style *style = &l->style[column];
  bool number = l->t->columns[column].kind != TABLE_TEXT;
  if (!style->shown) return;
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

/* The remarks, and how many columns are shown if there were to be more. */
static void write_notes(line_writer *w, const table *t, int wanted, int shown)
{
  char text[64];
  if (t->n_notes || shown < wanted) end_line(w);
  for (size_t i = 0; i < t->n_notes; ++i) write_line(w, t->notes[i]);
  snprintf(text, sizeof text, "%d of %d columns shown; --wide shows all", shown, t->n_columns);
  if (shown < wanted) write_line(w, text);
}

/* Where the block ends that begins at `from`: it has one column at least, beside the first one of all. */
static int end_of_block(const layout *l, int from)
{
  int width = l->style[l->first].width, to = from > l->first ? from : l->first + 1;
  for (int n = 0; to <= l->last; ++to) {
    if (!l->style[to].shown) continue;
    width += BETWEEN + l->style[to].width;
    if (n++ > 0 && l->t->fit > 0 && width > l->t->fit) break;
  }
  return to;
}

hc_status table_write_aligned(const table *t, FILE *to)
{
  const size_t n = (size_t)t->n_columns;
  line_writer w = {.to = to};
  layout l = {.t = t, .style = calloc(n, sizeof *l.style)};
  if (l.style) {
    if (*t->title) write_line(&w, t->title);
    for (int j = 0; j < t->n_columns; ++j) {
      column_style *style = &l.style[j];
      style->shown = !t->hidden[j];
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
    }
    const int wanted = count_shown(t, l.style);
    drop_columns(t, l.style, t->fit, false, true);
    drop_columns(t, l.style, t->fit, false, false);
    l.last = t->n_columns - 1;
    while (l.first < l.last && !l.style[l.first].shown) ++l.first;
    while (l.last > l.first && !l.style[l.last].shown) --l.last;
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
    write_notes(&w, t, wanted, count_shown(t, l.style));
  }
  const bool good = l.style;
  free(l.style);
  return good ? HC_OK : HC_NO_MEMORY;
}

/* ---- wrapped: a table of texts too long for one line each: columns that fit the terminal, words carried over, an
 * empty line after a row of more than one line; a number is a text like any other ---- */

typedef struct wrapped {
  char **texts;        /* [rows + 1][columns], the header first */
  column_style *style; /* [columns] */
} wrapped;

static int width_of(const char *text, size_t bytes)
{
  int width = 0;
  for (const char *end = text + bytes; text < end;) width += utf8_columns(utf8_next(&text));
  return width;
}

/* The widest column wider than its longest word, or if none is, than NARROWEST; -1: none. */
static int column_to_narrow(const table *t, const column_style *style)
{
  int whole = -1, any = -1;
  for (int j = 0; j < t->n_columns; ++j) {
    const column_style *c = &style[j];
    if (!c->shown || c->width <= NARROWEST) continue;
    if (any < 0 || c->width > style[any].width) any = j;
    if (c->width > c->word && (whole < 0 || c->width > style[whole].width)) whole = j;
  }
  return whole >= 0 ? whole : any;
}

/* Bytes of the next line of *rest, which moves past them and the spaces before; it starts at *from. */
static size_t next_part(const char **rest, int width, const char **from)
{
  int own;
  *from = *rest + strspn(*rest, " ");
  size_t fits = utf8_fit(*from, width, &own), cut = fits;
  if ((*from)[fits] && (*from)[fits] != ' ') {
    while (cut > 0 && (*from)[cut - 1] != ' ') --cut;
    if (cut == 0) cut = fits;
  }
  if (cut == 0 && **from) { /* not even one character fits */
    const char *past = *from;
    utf8_next(&past);
    cut = (size_t)(past - *from);
  }
  *rest = *from + cut;
  *rest += strspn(*rest, " ");
  while (cut > 0 && (*from)[cut - 1] == ' ') --cut;
  return cut;
}

static bool anything_left(const table *t, const wrapped *w)
{
  for (int j = 0; j < t->n_columns; ++j)
    if (*w->style[j].rest) return true;
  return false;
}

static char *wrapped_text(const table *t, int row, int column)
{
  const table_cell *cell = table_at(t, row, column);
  char number[40] = "";
  table_kind kind = t->columns[column].kind;
  if (cell->there && kind == TABLE_INTEGER) snprintf(number, sizeof number, "%ld", cell->as.integer);
  if (cell->there && kind == TABLE_REAL) snprintf(number, sizeof number, "%.7g", cell->as.real);
  return utf8_clean(cell->there && kind == TABLE_TEXT ? cell->as.text : number, true);
}

static bool copy_texts(const table *t, const wrapped *w)
{
  if (!w->texts || !w->style) return false;
  for (int j = 0; j < t->n_columns; ++j)
    if (!(w->texts[j] = strdup(t->columns[j].name))) return false;
  for (int i = 0; i < table_row_count(t); ++i)
    for (int j = 0; j < t->n_columns; ++j)
      if (!(w->texts[(i + 1) * t->n_columns + j] = wrapped_text(t, i, j))) return false;
  return true;
}

hc_status table_write_wrapped(const table *t, FILE *to)
{
  const size_t columns = (size_t)t->n_columns + 1,
               cells = columns * ((size_t)table_row_count(t) + 1); /* none of 0 bytes */
  wrapped w = {calloc(cells, sizeof *w.texts), calloc(columns, sizeof *w.style)};
  line_writer line = {.to = to};
  bool good = copy_texts(t, &w);
  if (good) {
    for (int j = 0; j < t->n_columns; ++j) {
      w.style[j].shown = !t->hidden[j];
      /* The widest text of a column and its longest word, header included. */
      column_style *style = &w.style[j];
      for (int i = 0; i <= table_row_count(t); ++i) {
        const char *text = w.texts[i * t->n_columns + j];
        const int width = utf8_width(text);
        if (width > style->width) style->width = width;
        for (const char *at = text; *at; at += strspn(at, " ")) {
          const size_t bytes = strcspn(at, " ");
          const int word = width_of(at, bytes);
          if (word > style->word) style->word = word;
          at += bytes;
        }
      }
    }
    const int wanted = count_shown(t, w.style);
    drop_columns(t, w.style, t->wrap, true, false); /* while the words of the others do not fit side by side */
    /* From each as wide as its widest text, one after the other is narrowed until the line fits. */
    int total = line_width(t, w.style, false);
    for (int j; total > t->wrap && (j = column_to_narrow(t, w.style)) >= 0; --total) --w.style[j].width;
    if (*t->title) write_line(&line, t->title);
    for (int i = 0, lines = 1; i <= table_row_count(t); ++i) {
      if (i > 1 && lines > 1) putc('\n', to);
      /* the row, in as many lines as it takes */
      for (int j = 0; j < t->n_columns; ++j) w.style[j].rest = w.style[j].shown ? w.texts[i * t->n_columns + j] : "";
      lines = 0;
      do {
        int spaces = 0;
        for (int j = 0; j < t->n_columns; ++j) {
          column_style *c = &w.style[j];
          const char *from;
          if (!c->shown) continue;
          size_t n = next_part(&c->rest, c->width, &from);
          int own = width_of(from, n);
          if (n) fprintf(to, "%*s%.*s", spaces, "", (int)n, from);
          spaces = (n ? 0 : spaces) + c->width - own + BETWEEN;
        }
        putc('\n', to);
        ++lines;
      } while (anything_left(t, &w));
    }
    write_notes(&line, t, wanted, count_shown(t, w.style));
  }
  for (size_t i = 0; w.texts && i < cells; ++i) free(w.texts[i]);
  free(w.texts);
  free(w.style);
  return good ? HC_OK : HC_NO_MEMORY;
}
