/* figure_accuracy.c - discrepancy over samples N and truncation order H; panels of compare. */
#include <math.h>
#include <string.h>

#include "interfaces/command/plot/figure.h"

enum { EXACT = 0 };                  /* samples of exact forces */
static const double no_less = 1e-17; /* [1] drawn for an error of 0, which has no logarithm */

/* The H and N of the rows, each once and in their order. */
typedef struct accuracy_grid {
  int n_harm, n_time;
  int harmonics[NUMBER_LIST_MAX], samples[NUMBER_LIST_MAX];
  bool exact; /* a column for exact forces, after those for samples */
} accuracy_grid;

static void add_once(int *list, int *n, int value)
{
  for (int i = 0; i < *n; ++i)
    if (list[i] == value) return;
  if (*n < NUMBER_LIST_MAX) list[(*n)++] = value;
}

static const accuracy_row *row_at(const accuracy *a, int harmonics, int samples)
{
  for (int i = 0; i < a->n_rows; ++i)
    if (a->rows[i].harmonics == harmonics && a->rows[i].samples == samples) return &a->rows[i];
  return NULL;
}

static const double *worst_of(const accuracy_row *r)
{
  return r && r->possible && r->status == HC_OK ? &r->worst : NULL;
}

/* The error at x, if it is a number; one of 0 has no place on a logarithmic scale. */
static void error_point(figure *g, double x, const double *e)
{
  if (e && *e > 0) figure_point(g, x, *e);
}

/* e0 (x/x0)^-order from x0 to x1. */
static void order_line(figure *g, int order, const char *of, double x0, double x1, double e0)
{
  static const char *const powers[] = {"", "²", "³", "⁴"};
  const bool first = order == (*of == 'N' ? 1 : 2);
  figure_series(g, "lines", figure_look(g, first ? 6 : 7, "lw 1.2 dt %d lc rgb '#888888'", first ? 3 : 5),
                figure_words(g, "slope of 1/%s%s", of, powers[order - 1]));
  if (e0 > 0 && x1 > x0) {
    figure_point(g, x0, e0);
    figure_point(g, x1, e0 * pow(x1 / x0, -order));
  }
  figure_series_end(g);
}

/* ---- the panels ---- */

static void panel_over_samples(figure *g, const accuracy *a, const accuracy_grid *q)
{
  const double from = q->samples[0], to = q->samples[q->n_time - 1];
  double top = 0;
  for (int h = 0; h < q->n_harm; ++h) {
    figure_series(g, "linespoints", figure_mark(g, h, 1.6), figure_words(g, "H = %d", q->harmonics[h]));
    for (int i = 0; i < q->n_time; ++i) {
      const accuracy_row *r = row_at(a, q->harmonics[h], q->samples[i]);
      if (!worst_of(r)) continue;
      error_point(g, q->samples[i], &r->aliasing);
      if (i == 0 && isfinite(r->aliasing)) top = fmax(top, r->aliasing);
    }
    figure_series_end(g);
  }
  order_line(g, 1, "N", from, to, 2 * top);
  order_line(g, 2, "N", from, to, 2 * top);
  figure_script(g,
                "set title 'Aliasing: sampled against exact forces'\nset ylabel 'largest relative amplitude error'\n");
  figure_below(g, "samples per period N");
  figure_log(g, "y");
  figure_script(g, "set logscale x 2\nset format x '%%.0f'\nset xrange [%g:%g]\nset yrange [*:*]\n", from / 1.3,
                to * 1.3);
  figure_draw(g);
}

static void errors_over_harmonics(figure *g, const accuracy *a, const accuracy_grid *q, int samples, const char *look,
                                  const char *title, double *top)
{
  figure_series(g, "linespoints", look, title);
  for (int h = 0; h < q->n_harm; ++h) {
    const double *e = worst_of(row_at(a, q->harmonics[h], samples));
    error_point(g, q->harmonics[h], e);
    if (h == 0 && e && isfinite(*e)) *top = fmax(*top, *e);
  }
  figure_series_end(g);
}

static void panel_over_harmonics(figure *g, const accuracy *a, const accuracy_grid *q)
{
  double top = 0, first = q->harmonics[0], last = q->harmonics[q->n_harm - 1];
  errors_over_harmonics(g, a, q, EXACT, g->letters ? "lt 1 pt 1" : "lw 2.4 dt 1 pt 7 ps 1 lc rgb '#000000'",
                        "exact forces", &top);
  for (int i = 0; i < q->n_time; ++i)
    errors_over_harmonics(g, a, q, q->samples[i], figure_mark(g, i + 1, 1.4), figure_words(g, "N = %d", q->samples[i]),
                          &top);
  order_line(g, 2, "H", first, last, 2 * top);
  order_line(g, 4, "H", first, last, 2 * top);
  figure_below(g, "harmonics H");
  figure_script(
      g, "set title 'Discrepancy from time integration, over H'\nset logscale x 10\nset format x '%%.0f'\nset xtics (");
  for (int h = 0; h < q->n_harm; ++h) figure_script(g, "%s%d", h ? ", " : "", q->harmonics[h]);
  figure_script(g, ")\nset xrange [%g:%g]\n", first / 1.15, last * 1.15);
  figure_draw(g);
  figure_script(g, "set xtics autofreq\n");
}

static void panel_heat(figure *g, const accuracy *a, const accuracy_grid *q)
{
  enum { ACROSS = 66, DOWN = 16 }; /* characters, and lines, of a panel in the largest font of figure.c's terminals */
  int columns = q->n_time + q->exact, longest = 0;
  double low = INFINITY, high = 0;
  figure_series(g, "points", "", NULL);
  for (int h = 0; h < q->n_harm; ++h)
    for (int i = 0; i < columns; ++i) {
      const double *e = worst_of(row_at(a, q->harmonics[h], i < q->n_time ? q->samples[i] : EXACT));
      if (!e || !isfinite(*e)) continue;
      const int n = figure_cell(g, i, h, fmax(*e, no_less));
      if (n > longest) longest = n;
      low = fmin(low, fmax(*e, no_less));
      high = fmax(high, *e);
    }
  figure_series_end(g);
  figure_script(
      g, "unset logscale x\nunset logscale y\nset format x '%%s'\nset format y '%%s'\nset title 'Discrepancy from time "
         "integration, over N and H'\n");
  figure_below(g, "samples per period N");
  figure_script(g, "set ylabel 'harmonics H'\nset xrange [-0.5:%g]\nset yrange [-0.5:%g]\nset xtics (", columns - 0.5,
                q->n_harm - 0.5);
  for (int i = 0; i < columns; ++i) {
    if (i < q->n_time) figure_script(g, "%s'%d' %d", i ? ", " : "", q->samples[i], i);
    else figure_script(g, "%s'exact' %d", i ? ", " : "", i);
  }
  figure_script(g, ")\nset ytics (");
  for (int h = 0; h < q->n_harm; ++h) figure_script(g, "%s'%d' %d", h ? ", " : "", q->harmonics[h], h);
  figure_script(g, ")\n");
  figure_heat(g, "largest relative amplitude error", true, low, high,
              columns * (longest + 1) <= ACROSS && q->n_harm <= DOWN);
}

void panels_accuracy(figure *g, const accuracy *a)
{
  accuracy_grid q = {0};
  for (int i = 0; i < a->n_rows; ++i) {
    add_once(q.harmonics, &q.n_harm, a->rows[i].harmonics);
    if (a->rows[i].samples == EXACT) q.exact = true;
    else add_once(q.samples, &q.n_time, a->rows[i].samples);
  }
  bool any = false;
  for (int i = 0; i < a->n_rows; ++i) any |= worst_of(&a->rows[i]) && isfinite(a->rows[i].worst);
  if (!any || q.n_time == 0 || q.n_harm == 0) return;
  panel_over_samples(g, a, &q);
  panel_over_harmonics(g, a, &q);
  if (!g->letters) panel_heat(g, a, &q); /* as letters it would repeat the table */
}

void panels_begin(figure *g, int rows, int columns, const char *title, const char *about)
{
  char command[64];
  snprintf(command, sizeof command, "set multiplot layout %d,%d title", rows, columns);
  figure_title(g, g->letters ? "set title" : command, title, about);
}

void panels_end(figure *g)
{
  if (!g->letters) figure_script(g, "unset multiplot\n");
}
