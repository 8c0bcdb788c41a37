/* figure_basins.c - a survey in the plane of one degree of freedom: which start goes where, and the motions there. */
#include <math.h>
#include <stdlib.h>

#include "compare/motion.h"
#include "interfaces/command/plot/figure.h"
#include "numerics/base/constants.h"

enum { MOST_PANELS = 4, MOST_MOTIONS = 8 };

/* Told apart by shape and dashes, too. */
static const struct motion_look {
  const char *colour, *dash;
  int shape;
  double size;
} looks[MOST_MOTIONS] = {
    {"0072B2", "1", 7, 0.35},          {"D55E00", "(12,5)", 8, 0.55}, {"009E73", "(5,4)", 2, 0.5},
    {"CC79A7", "(14,4,3,4)", 4, 0.45}, {"E69F00", "(2,3)", 1, 0.55},  {"56B4E9", "(20,6)", 6, 0.45},
    {"000000", "(8,3,2,3)", 3, 0.5},   {"8B5A2B", "(4,8)", 12, 0.55},
};

/* One frequency: its motions, and the frame, which holds their orbits and most of the starts. */
typedef struct basins {
  double omega;
  const survey_row *rows; /* of motion m and the first response: rows[m * n_responses] */
  int n_responses, n, shown;
  const survey_start *starts;
  int n_starts, outside;
  double low[2], high[2]; /* x, v/omega [length] */
} basins;

static const steady_row *motion_of(const basins *b, int m) { return &b->rows[m * b->n_responses].steady; }

/* Does the wave close: is it all of the motion? Else it is one of the periods. */
static bool is_closed(const steady_row *r) { return r->status == HC_OK && r->result.period_multiple == 1; }

enum { N_WAVE = TIMEINT_WAVE };

/* (x, v/omega) at instant k of the reported period, v by central differences; false: it has none. */
static bool orbit_point(const steady_row *r, int k, double at[2])
{
  const double *x = r->result.wave;
  if (!motion_is_measured(r->status) || (!is_closed(r) && (k < 1 || k > N_WAVE - 2))) return false;
  at[0] = x[k % N_WAVE];
  at[1] = (x[(k + 1) % N_WAVE] - x[(k + N_WAVE - 1) % N_WAVE]) * N_WAVE / (2 * TWO_PI);
  return isfinite(at[0]) && isfinite(at[1]);
}

static void start_point(const survey_start *s, double at[2])
{
  at[0] = s->x;
  at[1] = s->v / s->omega;
}

/* ---- the frame ---- */

static int by_size(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Without the outermost starts on each side: few are far out, and all else would be small. */
static hc_status frame_starts(basins *b)
{
  const int beyond = b->n_starts / 20;
  double at[2], *sorted = malloc((size_t)b->n_starts * sizeof *sorted);
  if (!sorted) return HC_NO_MEMORY;
  for (int c = 0; c < 2; ++c) {
    for (int i = 0; i < b->n_starts; ++i) start_point(&b->starts[i], at), sorted[i] = at[c];
    qsort(sorted, (size_t)b->n_starts, sizeof *sorted, by_size);
    b->low[c] = sorted[beyond];
    b->high[c] = sorted[b->n_starts - 1 - beyond];
  }
  free(sorted);
  return HC_OK;
}

static void frame_orbits(basins *b)
{
  double at[2];
  for (int m = 0; m < b->shown; ++m)
    for (int k = 0; k < N_WAVE; ++k)
      for (int c = 0; c < 2 && orbit_point(motion_of(b, m), k, at); ++c) {
        b->low[c] = fmin(b->low[c], at[c]);
        b->high[c] = fmax(b->high[c], at[c]);
      }
}

static bool is_inside(const basins *b, const double at[2])
{
  return at[0] >= b->low[0] && at[0] <= b->high[0] && at[1] >= b->low[1] && at[1] <= b->high[1];
}

static hc_status make_frame(basins *b)
{
  const double margin = 0.05;
  double at[2];
  const hc_status st = frame_starts(b);
  if (st != HC_OK) return st;
  frame_orbits(b);
  for (int c = 0; c < 2; ++c) {
    const double wide = b->high[c] - b->low[c], beside = wide > 0 ? margin * wide : 1;
    b->low[c] -= beside;
    b->high[c] += beside;
  }
  for (int i = 0; i < b->n_starts; ++i) start_point(&b->starts[i], at), b->outside += !is_inside(b, at);
  return HC_OK;
}

/* The frequencies of s, at most n, into b, their number into *n_found. True: there are more. */
static bool find_basins(const survey *s, int n, basins *b, int *n_found)
{
  int row = 0, start = 0;
  for (*n_found = 0; row < s->n_rows; ++*n_found) {
    if (*n_found == n) return true;
    basins *here = &b[*n_found];
    *here = (basins){.omega = s->rows[row].steady.result.omega, .rows = &s->rows[row], .starts = &s->starts[start]};
    /* The responses of motion 0, then those of the next ones. */
    while (row < s->n_rows && s->rows[row].motion == 0 && s->rows[row].steady.response == here->n_responses)
      ++row, ++here->n_responses;
    for (here->n = 1; row < s->n_rows && s->rows[row].motion == here->n; ++here->n) row += here->n_responses;
    for (int m = 0; m < here->n; ++m) here->n_starts += here->rows[m * here->n_responses].starts;
    start += here->n_starts;
    here->shown = here->n < MOST_MOTIONS ? here->n : MOST_MOTIONS;
  }
  return false;
}

/* ---- what is drawn ---- */

/* Those that came to motion `from` up to `to`. */
static void put_starts(figure *g, const basins *b, int from, int to)
{
  double at[2];
  for (int i = 0; i < b->n_starts; ++i) {
    start_point(&b->starts[i], at);
    if (b->starts[i].motion >= from && b->starts[i].motion < to && is_inside(b, at)) figure_point(g, at[0], at[1]);
  }
  figure_series_end(g);
}

/* "motion 0: settled, amplitude 2.43 m, 54.5 % of starts" */
static const char *motion_words(figure *g, const scene *sc, const basins *b, int m)
{
  char word[24], amplitude[64] = "";
  const steady_row *r = motion_of(b, m);
  if (motion_is_measured(r->status) && isfinite(r->result.amplitude))
    snprintf(amplitude, sizeof amplitude, ", amplitude %.4g %s", r->result.amplitude, sc->unit_length);
  return figure_words(g, "motion %d: %s%s, %.3g %% of starts", m, steady_verdict_text(r, word), amplitude,
                      100 * b->rows[m * b->n_responses].share);
}

static void put_orbit(figure *g, const steady_row *r, const char *look)
{
  double at[2];
  figure_series(g, "lines", look, NULL);
  for (int k = 0; k <= N_WAVE; ++k)
    if (orbit_point(r, k, at)) figure_point(g, at[0], at[1]);
  figure_series_end(g);
}

/* Where they are when starts begin; of several periods one of the points. */
static void put_beginnings(figure *g, const basins *b)
{
  double at[2];
  figure_series(g, "points", figure_look(g, MOST_MOTIONS + 1, "pt 7 ps 0.8 lc rgb '#000000'"), "motion at t = 0");
  for (int m = 0; m < b->shown; ++m)
    if (is_closed(motion_of(b, m)) && orbit_point(motion_of(b, m), 0, at)) figure_point(g, at[0], at[1]);
  figure_series_end(g);
}

static void put_panel(figure *g, const scene *sc, const basins *b)
{
  double others = 0;
  for (int m = b->shown; m < b->n; ++m) others += b->rows[m * b->n_responses].share;
  figure_series(g, "points", figure_look(g, MOST_MOTIONS, "pt 7 ps 0.2 lc rgb '#999999'"),
                figure_words(g, "%d other motions, %.3g %% of starts", b->n - b->shown, 100 * others));
  put_starts(g, b, b->shown, b->n);
  for (int m = 0; m < b->shown; ++m) {
    figure_series(g, "points",
                  figure_look(g, m, "pt %d ps %g lc rgb '#40%s'", looks[m].shape, looks[m].size, looks[m].colour),
                  g->letters ? motion_words(g, sc, b, m) : NULL);
    put_starts(g, b, m, m + 1);
  }
  for (int m = 0; m < b->shown && !g->letters; ++m) { /* on a white line the starts do not hide it */
    put_orbit(g, motion_of(b, m), figure_look(g, m, "lw 5 dt 1 lc rgb 'white'"));
    put_orbit(g, motion_of(b, m), figure_look(g, m, "lw 2.4 dt %s lc rgb '#%s'", looks[m].dash, looks[m].colour));
  }
  for (int m = 0; m < b->shown && !g->letters; ++m)
    figure_item(
        g, figure_look(g, m, "lw 2 dt %s pt %d ps 0.6 lc rgb '#%s'", looks[m].dash, looks[m].shape, looks[m].colour),
        motion_words(g, sc, b, m), "NaN with linespoints");
  put_beginnings(g, b);
  figure_script(g, "set xrange [%.10g:%.10g]\nset yrange [%.10g:%.10g]\n", b->low[0], b->high[0], b->low[1],
                b->high[1]);
  figure_draw(g);
}

/* "ω = 9 rad/s; 20 of 400 starts lie outside" */
static void panel_words(const figure *g, const scene *sc, const basins *b, char text[160])
{
  char outside[64] = "";
  if (b->outside) snprintf(outside, sizeof outside, "; %d of %d starts lie outside", b->outside, b->n_starts);
  if (sc->in_cycles) snprintf(text, 160, "%.8g cycles/%s%s", scene_frequency(sc, b->omega), sc->unit_time, outside);
  else snprintf(text, 160, "%s = %.8g rad/%s%s", g->letters ? "omega" : "ω", b->omega, sc->unit_time, outside);
}

static void put_axes(figure *g, const scene *sc)
{
  char of[RESPONSE_NAME];
  figure_response_name(sc, 0, of);
  figure_below(g, "%s [%s]", of, sc->unit_length);
  figure_set(g, "ylabel", "v / %s [%s]", g->letters ? "omega" : "ω", sc->unit_length);
  figure_script(g, g->letters ? "set key outside below\n" : "set key maxcols 1\n");
}

hc_status plot_survey(plot_order *p, const scene *sc, const survey *s)
{
  static const char what[] = "where starts go, and the motions there over a period";
  figure g = {0};
  basins found[MOST_PANELS] = {0};
  char words[160], about[256];
  int n;
  if (s->n_starts == 0) return figure_refuse(p, "basins are drawn for one degree of freedom");
  const bool more = find_basins(s, MOST_PANELS, found, &n);
  const int columns = n > 1 ? 2 : 1, rows = (n + columns - 1) / columns;
  hc_status st = figure_open(&g, p, n > 1 ? columns * 640 : 800, n > 1 ? rows * 560 : 640);
  for (int k = 0; k < n && st == HC_OK; ++k) st = make_frame(&found[k]);
  if (st != HC_OK) return figure_close(&g, st);
  panel_words(&g, sc, found, words);
  snprintf(about, sizeof about, n > 1 ? "%s%s" : "%s; %s", what,
           n > 1 ? more ? ", at the first frequencies" : "" : words);
  if (n > 1) panels_begin(&g, rows, columns, sc->title, about);
  else figure_title(&g, "set title", sc->title, about);
  put_axes(&g, sc);
  for (int k = 0; k < n; ++k) {
    panel_words(&g, sc, &found[k], words);
    if (n > 1) figure_set(&g, "title", "%s", words);
    put_panel(&g, sc, &found[k]);
  }
  if (n > 1) panels_end(&g);
  return figure_close(&g, HC_OK);
}
