/* figure_bench.c - work against precision: error over time, and the front of results that no other beats in both. */
#include <math.h>
#include <stdlib.h>

#include "interfaces/command/plot/figure.h"

enum { MOST_FREQUENCIES = 4 };

/* Filled: harmonic balance; open: our time integration; crosses: other programs. */
static const char *const looks[BENCH_METHODS] = {
    [BENCH_HBM_EXACT] = "pt 7 ps 1.1 lc rgb '#0072B2'",
    [BENCH_HBM_SAMPLED] = "pt 5 ps 0.7 lc rgb '#56B4E9'",
    [BENCH_CLOSED_SHOOTING] = "pt 3 ps 1.4 lw 1.8 lc rgb '#000000'",
    [BENCH_EXACT_SCOUTED] = "pt 14 ps 1.2 lw 1.5 lc rgb '#D55E00'",
    [BENCH_REGULARISED_SCOUTED] = "pt 1 ps 1.1 lw 1.5 lc rgb '#009E73'",
    [BENCH_EXACT_SHOOTING] = "pt 8 ps 1.2 lw 1.5 lc rgb '#D55E00'",
    [BENCH_EXACT_MARCHING] = "pt 10 ps 1.2 lw 1.5 lc rgb '#D55E00'",
    [BENCH_REGULARISED_SHOOTING] = "pt 6 ps 1.1 lw 1.5 lc rgb '#009E73'",
    [BENCH_REGULARISED_MARCHING] = "pt 4 ps 1.1 lw 1.5 lc rgb '#009E73'",
    [BENCH_SCIPY_LSODA] = "pt 2 ps 1.1 lw 1.6 lc rgb '#000000'",
};

static bool is_drawn(const bench_row *r)
{
  return r->outcome == BENCH_SOLVED && r->repeats > 0 && r->seconds > 0 && isfinite(r->error_finer);
}

/* Not below the accuracy of the reference, which limits what can be measured. */
static double drawn_error(const bench_row *r, const bench_frequency *p)
{
  return fmax(r->error_finer, fmax(p->floor, 1e-16));
}

static int by_time(const void *a, const void *b)
{
  const double *x = a, *y = b;
  return x[0] != y[0] ? (x[0] > y[0]) - (x[0] < y[0]) : (x[1] < y[1]) - (x[1] > y[1]);
}

static hc_status put_panel(figure *g, const scene *sc, const bench *b, int k_omega)
{
  const bench_frequency *p = &b->frequencies[k_omega];
  int n_front = 0;
  double(*at)[2] = malloc((size_t)(p->n > 0 ? p->n : 1) * sizeof *at);
  if (!at) return HC_NO_MEMORY;
  for (int i = p->first; i < p->first + p->n; ++i) {
    if (!b->rows[i].front || !is_drawn(&b->rows[i])) continue;
    at[n_front][0] = b->rows[i].seconds;
    at[n_front++][1] = drawn_error(&b->rows[i], p);
  }
  qsort(at, (size_t)n_front, sizeof *at, by_time);
  figure_series(g, "steps", figure_look(g, 0, "lw 3 dt 1 lc rgb '#bbbbbb'"), "nothing is nearer and faster");
  for (int i = 0; i < n_front; ++i) figure_point(g, at[i][0], at[i][1]);
  figure_series_end(g);
  free(at);
  for (int m = 0; m < BENCH_METHODS; ++m) {
    figure_series(g, "points", figure_look(g, m + 1, "%s", looks[m]), bench_method_name((bench_method)m));
    for (int i = p->first; i < p->first + p->n; ++i) {
      const bench_row *r = &b->rows[i];
      if (r->method == (bench_method)m && is_drawn(r)) figure_point(g, r->seconds, drawn_error(r, p));
    }
    figure_series_end(g);
  }
  if (sc->in_cycles) figure_set(g, "title", "%.8g cycles/%s", scene_frequency(sc, p->omega), sc->unit_time);
  else figure_set(g, "title", "ω = %.8g rad/%s", p->omega, sc->unit_time);
  figure_draw(g);
  return HC_OK;
}

hc_status plot_bench(plot_order *p, const scene *sc, const bench *b)
{
  figure g = {0};
  int n = 0, at[MOST_FREQUENCIES];
  for (int k = 0; k < b->n_frequencies && n < MOST_FREQUENCIES; ++k) {
    bool any = false;
    for (int i = b->frequencies[k].first; i < b->frequencies[k].first + b->frequencies[k].n; ++i)
      any |= is_drawn(&b->rows[i]);
    if (any) at[n++] = k;
  }
  if (n == 0) return figure_refuse(p, "nothing was measured that could be drawn");
  int columns = n > 1 ? 2 : 1, rows = (n + columns - 1) / columns;
  hc_status st = figure_open(&g, p, columns * 700, rows * 520);
  if (st == HC_OK) {
    panels_begin(&g, rows, columns, sc->title,
                 n < b->n_frequencies ? "work and precision at the first frequencies" : "work and precision");
    figure_below(&g, "processor time of one solution [s]");
    figure_set(&g, "ylabel", "relative error of the amplitude, at these or finer settings");
    figure_log(&g, "x");
    figure_log(&g, "y");
    for (int k = 0; k < n && st == HC_OK; ++k) st = put_panel(&g, sc, b, at[k]);
    panels_end(&g);
  }
  return figure_close(&g, st);
}
