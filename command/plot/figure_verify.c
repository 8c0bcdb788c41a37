/* figure_verify.c - another program's curve over ours, its points by verdict; the figure of verify. */
#include <math.h>
#include <stdio.h>

#include "command/plot/curve.h"
#include "command/plot/verdicts.h"

enum { WIDTH = 900, HEIGHT = 560 };

static const struct line_look {
  const char *name, *title, *look;
  int stable;
} lines[] = {
    {"stable", "ours: stable", "lw 2.2 dt 1 lc rgb '#0072B2'", 1},
    {"unstable", "unstable", "lw 1.8 dt (10,6) lc rgb '#0072B2'", -1},
    {"unknown", "stability unknown", "lw 1.6 dt 3 lc rgb '#0072B2'", 0},
};
enum { N_LINES = sizeof lines / sizeof *lines };

/* The parts of our curve with one stability; a part ends in the first point of the next. Returns how many points. */
static int write_line(figure *g, const verify_quantity *q, const verify_report *r, const struct line_look *l)
{
  int n = 0;
  figure_block(g, l->name);
  for (int k = 0; k < r->n_line; ++k) {
    const bool mine = r->line[k].stable == l->stable, ends = k > 0 && r->line[k - 1].stable == l->stable;
    if (mine || ends) figure_point(g, r->line[k].omega, verify_quantity_to_column(q, r->line[k].value));
    if (!mine && ends) figure_gap(g);
    n += mine;
  }
  figure_block_end(g);
  return n;
}

static const char *word_of(const verify_row *row) { return row->skipped ? "skipped" : verdict_name(row->verdict); }

static void write_points(figure *g, const verify_quantity *q, const verify_report *r, verdicts *v)
{
  *v = (verdicts){0};
  for (int i = 0; i < r->n_rows; ++i) ++v->count[verdicts_place(v, word_of(&r->rows[i]))];
  for (int k = 0; k < v->n; ++k) {
    char block[24];
    snprintf(block, sizeof block, "verdict%d", k);
    figure_block(g, block);
    for (int i = 0; i < r->n_rows; ++i)
      if (verdicts_place(v, word_of(&r->rows[i])) == k)
        figure_point(g, r->rows[i].omega, verify_quantity_to_column(q, r->rows[i].value));
    figure_block_end(g);
  }
}

static const char *unit_of(const verify_quantity *q)
{
  switch (q->kind) {
  case KIND_VELOCITY:
  case KIND_VELOCITY_HARMONIC: return "length/time";
  case KIND_ACCELERATION:
  case KIND_ACCELERATION_HARMONIC: return "length/time^2";
  default: return "length";
  }
}

/* The sweep, widened to the points. */
static void set_axes(figure *g, const scene *sc, const verify_quantity *q, const verify_report *r)
{
  char name[VERIFY_QUANTITY_TEXT], unit[FIGURE_UNIT];
  double low = fmin(sc->omega_from, sc->omega_to), high = fmax(sc->omega_from, sc->omega_to);
  for (int i = 0; i < r->n_rows; ++i) {
    low = fmin(low, r->rows[i].omega);
    high = fmax(high, r->rows[i].omega);
  }
  if (sc->in_cycles) figure_below(g, "frequency [cycles/%s]", sc->unit_time);
  else figure_below(g, "%s [rad/%s]", g->letters ? "omega" : "ω", sc->unit_time);
  verify_quantity_name(q, name);
  figure_set(g, "ylabel", "%s [%s]", name, q->decibel ? "dB" : figure_unit(sc, unit_of(q), unit));
  figure_script(g, "set xrange [%.10g:%.10g]\n", low / g->x_unit, high / g->x_unit);
  if (!verify_quantity_signed(q)) figure_script(g, "set yrange [0:*]\n");
}

hc_status plot_verify(plot_order *p, const scene *sc, const verify_data *data, const verify_report *r)
{
  const verify_quantity *q = &data->quantity;
  figure g = {0};
  verdicts v;
  int n[N_LINES];
  char about[VERIFY_TEXT + 64], words[VERIFY_TEXT], look[FIGURE_LOOK], what[48];
  if (r->n_rows == 0) {
    snprintf(p->why, sizeof p->why, "no point was judged, so there is nothing to draw");
    return HC_BAD_INPUT;
  }
  hc_status st = curve_figure_open(&g, p, sc, WIDTH, HEIGHT);
  if (st != HC_OK) return figure_close(&g, st);
  for (int l = 0; l < N_LINES; ++l) n[l] = write_line(&g, q, r, &lines[l]);
  write_points(&g, q, r, &v);
  snprintf(about, sizeof about, "ours: H = %d, exact forces; cause: %s", r->harmonics, verify_word(r, words));
  figure_title(&g, "set title", sc->title, about);
  set_axes(&g, sc, q, r);
  for (int l = 0; l < N_LINES; ++l) {
    if (n[l] == 0) continue;
    snprintf(what, sizeof what, "$%s using 1:2 with lines", lines[l].name);
    figure_item(&g, what, figure_look(&g, lines[l].look, l, look), "%s", lines[l].title);
  }
  verdicts_items(&g, &v, "theirs");
  figure_draw(&g);
  return figure_close(&g, HC_OK);
}
