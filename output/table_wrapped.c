/* table_wrapped.c - a table of texts for people, too long for one line each: columns of a width that fits the
 * terminal, words carried over to the next line, an empty line between rows where any takes more than one. A number
 * is a text like any other. */
#include <stdlib.h>
#include <string.h>

#include "base/utf8.h"
#include "output/table_private.h"

enum { NARROWEST = 8, BETWEEN = 2 };

/* [rows + 1][columns], the header first; [columns] */
typedef struct wrapped {
  char **texts;
  int *widths;
  const char **rest;
} wrapped;

static int widest(const table *t, const wrapped *w, int column)
{
  int width = 0;
  for (int i = 0; i <= table_rows(t); ++i) {
    int own = utf8_width(w->texts[i * t->n_columns + column]);
    if (own > width) width = own;
  }
  return width;
}

/* Each column as wide as its widest text; then the widest ones are narrowed until the line fits, none below
 * NARROWEST. */
static void narrow_columns(const table *t, const wrapped *w)
{
  int total = BETWEEN * (t->n_columns - 1);
  for (int j = 0; j < t->n_columns; ++j) total += w->widths[j] = widest(t, w, j);
  for (; total > t->wrap; --total) {
    int most = 0;
    for (int j = 1; j < t->n_columns; ++j)
      if (w->widths[j] > w->widths[most]) most = j;
    if (w->widths[most] <= NARROWEST) return;
    --w->widths[most];
  }
}

/* Bytes of the next line of *rest, which is moved past them and past the spaces before them; where it starts goes
 * into *from. */
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
    if (*w->rest[j]) return true;
  return false;
}

static int width_of(const char *text, size_t bytes)
{
  int width = 0;
  for (const char *end = text + bytes; text < end;) width += utf8_columns(utf8_next(&text));
  return width;
}

static void write_row(const table *t, const wrapped *w, int row, FILE *to)
{
  for (int j = 0; j < t->n_columns; ++j) w->rest[j] = w->texts[row * t->n_columns + j];
  do {
    int spaces = 0;
    for (int j = 0; j < t->n_columns; ++j) {
      const char *from;
      size_t n = next_part(&w->rest[j], w->widths[j], &from);
      int own = width_of(from, n);
      if (n) fprintf(to, "%*s%.*s", spaces, "", (int)n, from);
      spaces = (n ? 0 : spaces) + w->widths[j] - own + BETWEEN;
    }
    putc('\n', to);
  } while (anything_left(t, w));
}

static bool fits_on_lines(const table *t, const wrapped *w)
{
  for (int j = 0; j < t->n_columns; ++j)
    if (widest(t, w, j) > w->widths[j]) return false;
  return true;
}

static char *cell_text(const table *t, int row, int column)
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
  if (!w->texts || !w->widths || !w->rest) return false;
  for (int j = 0; j < t->n_columns; ++j)
    if (!(w->texts[j] = strdup(t->columns[j].name))) return false;
  for (int i = 0; i < table_rows(t); ++i)
    for (int j = 0; j < t->n_columns; ++j)
      if (!(w->texts[(i + 1) * t->n_columns + j] = cell_text(t, i, j))) return false;
  return true;
}

hc_status table_write_wrapped(const table *t, FILE *to)
{
  size_t columns = (size_t)t->n_columns, cells = columns * ((size_t)table_rows(t) + 1);
  wrapped w = {calloc(cells, sizeof *w.texts), calloc(columns, sizeof *w.widths), calloc(columns, sizeof *w.rest)};
  bool good = copy_texts(t, &w);
  if (good) {
    narrow_columns(t, &w);
    bool spaced = !fits_on_lines(t, &w);
    if (*t->title) fprintf(to, "%s\n", t->title);
    for (int i = 0; i <= table_rows(t); ++i) {
      if (spaced && i > 1) putc('\n', to);
      write_row(t, &w, i, to);
    }
    if (t->n_notes) putc('\n', to);
    for (size_t i = 0; i < t->n_notes; ++i) fprintf(to, "%s\n", t->notes[i]);
  }
  for (size_t i = 0; w.texts && i < cells; ++i) free(w.texts[i]);
  free(w.texts);
  free(w.widths);
  free(w.rest);
  return good ? HC_OK : HC_NO_MEMORY;
}
