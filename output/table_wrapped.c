/* table_wrapped.c - a table of texts for people, too long for one line each: columns of a width that fits the
 * terminal, words carried over to the next line, an empty line after a row that takes more than one. A number is a
 * text like any other. */
#include <stdlib.h>
#include <string.h>

#include "base/utf8.h"
#include "output/table_private.h"

enum { NARROWEST = 8, BETWEEN = 2 };

typedef struct wrapped {
  char **texts; /* [rows + 1][columns], the header first */
  int *widths;  /* [columns] */
  int *words;   /* [columns] the longest word of each, header included */
  bool *shown;  /* [columns] */
  const char **rest;
} wrapped;

static int width_of(const char *text, size_t bytes)
{
  int width = 0;
  for (const char *end = text + bytes; text < end;) width += utf8_columns(utf8_next(&text));
  return width;
}

static int widest(const table *t, const wrapped *w, int column)
{
  int width = 0;
  for (int i = 0; i <= table_row_count(t); ++i) {
    int own = utf8_width(w->texts[i * t->n_columns + column]);
    if (own > width) width = own;
  }
  return width;
}

static int longest_word(const table *t, const wrapped *w, int column)
{
  int longest = 0;
  for (int i = 0; i <= table_row_count(t); ++i)
    for (const char *at = w->texts[i * t->n_columns + column]; at && *at; at += strspn(at, " ")) {
      const size_t bytes = strcspn(at, " ");
      const int own = width_of(at, bytes);
      if (own > longest) longest = own;
      at += bytes;
    }
  return longest;
}

/* The widest column that is wider than it has to be: than its longest word, or else, once no such one is left, than
 * NARROWEST. -1: none is. */
static int column_to_narrow(const table *t, const wrapped *w)
{
  int whole = -1, any = -1;
  for (int j = 0; j < t->n_columns; ++j) {
    if (!w->shown[j] || w->widths[j] <= NARROWEST) continue;
    if (any < 0 || w->widths[j] > w->widths[any]) any = j;
    if (w->widths[j] > w->words[j] && (whole < 0 || w->widths[j] > w->widths[whole])) whole = j;
  }
  return whole >= 0 ? whole : any;
}

static int total_of(const table *t, const wrapped *w, const int *widths)
{
  int total = -BETWEEN;
  for (int j = 0; j < t->n_columns; ++j)
    if (w->shown[j]) total += BETWEEN + widths[j];
  return total;
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

/* Returns how many lines it takes. */
static int write_row(const table *t, const wrapped *w, int row, FILE *to)
{
  for (int j = 0; j < t->n_columns; ++j) w->rest[j] = !w->shown[j] ? "" : w->texts[row * t->n_columns + j];
  int lines = 0;
  do {
    int spaces = 0;
    for (int j = 0; j < t->n_columns; ++j) {
      const char *from;
      if (!w->shown[j]) continue;
      size_t n = next_part(&w->rest[j], w->widths[j], &from);
      int own = width_of(from, n);
      if (n) fprintf(to, "%*s%.*s", spaces, "", (int)n, from);
      spaces = (n ? 0 : spaces) + w->widths[j] - own + BETWEEN;
    }
    putc('\n', to);
    ++lines;
  } while (anything_left(t, w));
  return lines;
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
  if (!w->texts || !w->widths || !w->words || !w->shown || !w->rest) return false;
  for (int j = 0; j < t->n_columns; ++j)
    if (!(w->texts[j] = strdup(t->columns[j].name))) return false;
  for (int i = 0; i < table_row_count(t); ++i)
    for (int j = 0; j < t->n_columns; ++j)
      if (!(w->texts[(i + 1) * t->n_columns + j] = cell_text(t, i, j))) return false;
  return true;
}

hc_status table_write_wrapped(const table *t, FILE *to)
{
  const size_t columns = (size_t)t->n_columns + 1,
               cells = columns * ((size_t)table_row_count(t) + 1); /* none of 0 bytes */
  wrapped w = {calloc(cells, sizeof *w.texts), calloc(columns, sizeof *w.widths), calloc(columns, sizeof *w.words),
               calloc(columns, sizeof *w.shown), calloc(columns, sizeof *w.rest)};
  bool good = copy_texts(t, &w);
  if (good) {
    for (int j = 0; j < t->n_columns; ++j) {
      w.shown[j] = !t->hidden[j];
      w.widths[j] = widest(t, &w, j);
      w.words[j] = longest_word(t, &w, j);
    }
    const int wanted = table_shown(t, w.shown);
    /* Columns to spare go, one after the other, while the words of the others do not fit side by side. */
    for (const char *const *name = t->spare; name && *name && total_of(t, &w, w.words) > t->wrap; ++name)
      for (int j = 0; j < t->n_columns; ++j)
        if (!strcmp(t->columns[j].name, *name)) w.shown[j] = false;
    const int shown = table_shown(t, w.shown);
    /* From each as wide as its widest text, one after the other is narrowed until the line fits. */
    int total = total_of(t, &w, w.widths);
    for (int j; total > t->wrap && (j = column_to_narrow(t, &w)) >= 0; --total) --w.widths[j];
    if (*t->title) fprintf(to, "%s\n", t->title);
    for (int i = 0, lines = 1; i <= table_row_count(t); ++i) {
      if (i > 1 && lines > 1) putc('\n', to);
      lines = write_row(t, &w, i, to);
    }
    if (t->n_notes || shown < wanted) putc('\n', to);
    for (size_t i = 0; i < t->n_notes; ++i) fprintf(to, "%s\n", t->notes[i]);
    if (shown < wanted) fprintf(to, TABLE_SHOWN "\n", shown, t->n_columns);
  }
  for (size_t i = 0; w.texts && i < cells; ++i) free(w.texts[i]);
  free(w.texts);
  free(w.widths);
  free(w.words);
  free(w.shown);
  free(w.rest);
  return good ? HC_OK : HC_NO_MEMORY;
}
