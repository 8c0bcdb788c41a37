/* figure_response.c - amplitude over omega: frf, compare, transient, and verify with another program's points. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/motion.h"
#include "interfaces/command/plot/curve.h"
#include "model/casefile/scene.h"
#include "numerics/base/constants.h"

enum { WIDTH = 800, HEIGHT = 540, MOST_RESPONSES = 8 };

/* What is drawn on the axes, from back to front. */
typedef struct layers {
  const curve_shape *shape; /* [n_shapes] */
  int n_shapes;             /* several: responses of a structure; 0 counts as 1 */
  bool quiet;               /* the curve is background */
  bool asked, departures;
  const verdicts *v;
  const char *of; /* whose verdicts */
} layers;

static void draw_layers(figure *g, const layers *l)
{
  curve_shape_items(g, l->shape, l->quiet);
  for (int i = 1; i < l->n_shapes; ++i) curve_shape_items(g, &l->shape[i], l->quiet);
  if (l->n_shapes > 1) curve_shapes_rest(g, l->n_shapes, l->shape);
  if (l->asked)
    figure_item(g, figure_look(g, 8, "pt 6 ps 1.2 lw 1.6 lc rgb '#D55E00'"), "solutions asked for",
                "$asked using 1:2 with points");
  if (l->departures && !g->letters)
    figure_item(g, "lw 0.8 dt 1 lc rgb '#999999'", "where the transient went",
                "$departures using 1:2:(0):3 with vectors filled head size character 0.9,20");
  if (l->v) verdicts_items(g, l->v, l->of);
  figure_draw(g);
}

/* The whole curve; beside it the part with all special points, if it is small, and with a its three panels. */
static void response_panels(figure *g, const scene *sc, const layers *l, const char *about, const accuracy *a)
{
  curve_window w;
  const bool detail = l->n_shapes <= 1 && curve_shape_window(l->shape, &w), several = a || detail;
  if (several) panels_begin(g, a ? 2 : 1, a && detail ? 3 : 2, sc->title, about);
  else figure_title(g, "set title", sc->title, about);
  if (several && !g->letters) figure_script(g, "set title '%s'\n", a ? "Response" : "Whole sweep");
  curve_shape_axes(g, sc, l->shape);
  draw_layers(g, l);
  if (detail) {
    figure_script(g, "set title 'Where the contact changes'\nset xrange [%.10g:%.10g]\nset yrange [%.10g:%.10g]\n",
                  w.low / g->x_unit, w.high / g->x_unit, w.least, w.most);
    draw_layers(g, l);
  }
  if (a) panels_accuracy(g, a);
  if (several) panels_end(g);
}

static int response_width(const curve_shape *shape)
{
  curve_window w;
  return curve_shape_window(shape, &w) ? 1300 : WIDTH;
}

/* ---- frf ---- */

/* The responses' shapes into shape[n + 1]; the last, the first response's, has their stability. To clear, all. */
static hc_status make_shapes(const scene *sc, hbm_solver *s, const hbm_curve *curve, plot_responses of, int n,
                             curve_shape *shape)
{
  hc_status st = curve_shape_of(sc, s, curve, &shape[n]);
  if (of.first == 0 && n == 1 && st == HC_OK) {
    shape[0] = shape[1];
    shape[1] = (curve_shape){.n = 0};
    return HC_OK;
  }
  for (int i = 0; i < n && st == HC_OK; ++i) {
    st = curve_shape_response(&shape[n], sc, s, curve, of.first + i, &shape[i]);
    shape[i].among = n > 1 ? i + 1 : 0;
  }
  return st;
}

hc_status plot_frf(plot_order *p, const scene *sc, hbm_solver *s, const hbm_curve *curve, const hbm_curve *asked,
                   plot_responses of)
{
  figure g = {0};
  char about[160], settings[96];
  if (curve->n == 0) return figure_refuse(p, "there is no point of the response curve to draw");
  const int all = of.last - of.first + 1, n = all < MOST_RESPONSES ? all : MOST_RESPONSES;
  of.last = of.first + n - 1;
  curve_shape *shape = calloc((size_t)n + 1, sizeof *shape);
  hc_status st = shape ? make_shapes(sc, s, curve, of, n, shape) : HC_NO_MEMORY;
  if (st == HC_OK) st = curve_figure_open(&g, p, sc, n > 1 ? WIDTH : response_width(shape), HEIGHT);
  if (st == HC_OK) {
    figure_block(&g, "asked");
    for (int k = 0; asked && k < asked->n && st == HC_OK; ++k)
      for (int r = of.first; r <= of.last && st == HC_OK; ++r) {
        hbm_measures m;
        const double omega = asked->points[k].omega, *X = asked->X + (size_t)k * (size_t)asked->n_coef;
        st = hbm_measure_response(s, omega, X, r, &m);
        if (st == HC_OK) figure_point(&g, omega, m.amplitude);
      }
    figure_block_end(&g);
  }
  if (st == HC_OK) {
    layers l = {.shape = shape, .n_shapes = n, .asked = asked && asked->n > 0};
    for (int i = 0; i < n; ++i) curve_shape_data(&g, &shape[i]);
    curve_shape_settings(sc, shape, settings);
    if (n < all) snprintf(about, sizeof about, "%s; the first %d of %d responses", settings, n, all);
    else snprintf(about, sizeof about, "%s", settings);
    response_panels(&g, sc, &l, about, NULL);
  }
  for (int i = 0; i <= n && shape; ++i) curve_shape_clear(&shape[i]);
  free(shape);
  return figure_close(&g, st);
}

/* ---- compare ---- */

static bool has_transient(const comparison_row *r) { return motion_is_measured(r->transient_status); }

/* Verdicts stand at the transient; at the HBM solution where it left that or has no result. */
static bool stands_at_hbm(const comparison_row *r)
{
  return (r->branch >= 0 && r->hbm_status == HC_OK) &&
         (r->verdict == VERDICT_UNSTABLE || r->verdict == VERDICT_OTHER_BRANCH || !has_transient(r));
}

static const char *compared_point(const void *rows, int i, double *x, double *y, char text[24])
{
  const comparison_row *r = (const comparison_row *)rows + i;
  *x = r->omega;
  *y = stands_at_hbm(r) ? r->hbm.amplitude : has_transient(r) ? r->transient.amplitude : NAN;
  return r->response == 0 ? comparison_verdict_text(r, text) : NULL;
}

/* Arrows from an HBM solution to the transient that started on it and left. Returns how many. */
static int write_departures(figure *g, const comparison *c)
{
  int n = 0;
  figure_block(g, "departures");
  for (int i = 0; i < c->n_rows; ++i) {
    const comparison_row *r = &c->rows[i];
    if (r->response != 0 || !stands_at_hbm(r) || !has_transient(r)) continue;
    figure_script(g, "%.10g %.10g %.10g\n", r->omega / g->x_unit, r->hbm.amplitude,
                  r->transient.amplitude - r->hbm.amplitude);
    ++n;
  }
  figure_block_end(g);
  return n;
}

hc_status plot_compare(plot_order *p, const scene *sc, const comparison *c, const accuracy *a)
{
  figure g = {0};
  curve_shape shape = {0};
  curve_window w;
  verdicts v;
  char settings[96];
  bool all = a && a->n_rows > 0;
  if (c->n_rows == 0) return figure_refuse(p, "there is nothing compared to draw");
  hc_status st = curve_shape_trace(sc, &sc->compare.omega, &shape);
  int width = !all ? response_width(&shape) : curve_shape_window(&shape, &w) ? 1900 : 1300;
  if (st == HC_OK) st = curve_figure_open(&g, p, sc, width, all ? 1040 : HEIGHT);
  if (st == HC_OK) {
    layers l = {.shape = &shape, .departures = write_departures(&g, c) > 0, .v = &v, .of = "transient"};
    verdicts_data(&g, &v, c->n_rows, c->rows, compared_point);
    curve_shape_data(&g, &shape);
    curve_shape_settings(sc, &shape, settings);
    response_panels(&g, sc, &l, settings, all ? a : NULL);
  }
  curve_shape_clear(&shape);
  return figure_close(&g, st);
}

/* ---- transient ---- */

/* And of the response that is drawn. */
static bool measured(const steady_row *r)
{
  return r->response == 0 && r->stage == STEADY_TRANSIENT && motion_is_measured(r->status);
}

static const char *steady_point(const void *rows, int i, double *x, double *y, char text[24])
{
  const steady_row *r = (const steady_row *)rows + i;
  *x = r->result.omega;
  *y = r->result.amplitude;
  return measured(r) ? steady_verdict_text(r, text) : NULL;
}

/* ---- the motion over a period at one frequency ---- */

enum { MOST_WAVES = 12 };

static hc_status plot_waves(plot_order *p, const scene *sc, const steady_states *found)
{
  figure g = {0};
  char of[RESPONSE_NAME], about[160], word[24];
  double omega = found->rows[0].result.omega, low = INFINITY, high = -INFINITY;
  const steady_row *wave[MOST_WAVES];
  int n = 0;
  hc_status st = figure_open(&g, p, 800, 500);
  if (st != HC_OK) return figure_close(&g, st);
  for (int i = 0; i < found->n && n < MOST_WAVES; ++i) {
    const steady_row *r = wave[n] = &found->rows[i];
    if (!measured(r)) continue;
    figure_block(&g, "wave%d", n++);
    for (int k = 0; k <= TIMEINT_WAVE; ++k)
      figure_point(&g, (double)k / TIMEINT_WAVE, r->result.wave[k % TIMEINT_WAVE]);
    figure_block_end(&g);
    low = fmin(low, r->result.min);
    high = fmax(high, r->result.max);
  }
  snprintf(about, sizeof about, "steady state at %s%.8g %s/%s, period T = %.6g %s",
           sc->in_cycles ? "" : "ω = ", scene_frequency(sc, omega), sc->in_cycles ? "cycles" : "rad", sc->unit_time,
           TWO_PI / omega, sc->unit_time);
  figure_title(&g, "set title", sc->title, about);
  curve_response_name(sc, 0, of);
  figure_set(&g, "ylabel", "%s [%s]", of, sc->unit_length);
  figure_below(&g, "t / T");
  figure_script(&g, "set xrange [0:1]\n");
  for (int i = 0; i < n; ++i)
    figure_item(&g, figure_line(&g, i, 2),
                figure_words(&g, "start: %s; %s", wave[i]->start, steady_verdict_text(wave[i], word)),
                "$wave%d using 1:2 with lines", i);
  /* Where contacts close, if the motions pass there: x sin(alpha) + gap = 0. */
  for (int j = 0; j < scene_contact_count(sc) && scene_is_oscillator(sc); ++j) {
    const moving_contact c = scene_moving_contact(scene_contact_at(sc, j));
    const double x = c.cv[0] != 0 ? -c.law.gap / c.cv[0] : NAN;
    if (x >= low && x <= high)
      figure_item(&g, figure_look(&g, 7, "lw 1 dt 3 lc rgb '#777777'"),
                  figure_words(&g, "contact %d closes %s", j, c.cv[0] > 0 ? "above" : "below"), "%.10g with lines", x);
  }
  figure_draw(&g);
  return figure_close(&g, HC_OK);
}

hc_status plot_transient(plot_order *p, const scene *sc, const steady_states *found)
{
  int n = 0;
  bool several = false;
  for (int i = 0; i < found->n; ++i) {
    n += measured(&found->rows[i]);
    several |= found->rows[i].result.omega != found->rows[0].result.omega;
  }
  if (n == 0) return figure_refuse(p, "there is no steady state to draw");
  if (!several) return plot_waves(p, sc, found);
  figure g = {0};
  curve_shape shape = {0};
  verdicts v;
  char settings[96], about[160];
  hc_status st = curve_shape_trace(sc, &sc->compare.omega, &shape);
  if (st == HC_OK) st = curve_figure_open(&g, p, sc, response_width(&shape), HEIGHT);
  if (st == HC_OK) {
    layers l = {.shape = &shape, .quiet = true, .v = &v, .of = "time integration"};
    curve_shape_data(&g, &shape);
    verdicts_data(&g, &v, found->n, found->rows, steady_point);
    snprintf(about, sizeof about, "time integration; harmonic balance, %s", curve_shape_settings(sc, &shape, settings));
    response_panels(&g, sc, &l, about, NULL);
  }
  curve_shape_clear(&shape);
  return figure_close(&g, st);
}

/* ---- another program's curve over ours, its points by verdict ---- */

/* Our curve's values as the file has them. */
static hc_status make_line(const verify_quantity *q, const verify_report *r, curve_shape *out)
{
  *out = (curve_shape){.n = r->n_line, .stable_title = "ours: stable"};
  if (!(out->points = calloc((size_t)r->n_line + 1, sizeof *out->points))) return HC_NO_MEMORY;
  for (int k = 0; k < r->n_line; ++k)
    out->points[k] =
        (curve_point){r->line[k].omega, verify_quantity_to_column(q, r->line[k].value), r->line[k].stable, 0};
  return HC_OK;
}

typedef struct theirs {
  const verify_quantity *q;
  const verify_report *r;
} theirs;

/* NOLINTNEXTLINE(readability-non-const-parameter): the signature is figure.h's */
static const char *theirs_point(const void *report, int i, double *x, double *y, char text[24])
{
  const theirs *t = report;
  const verify_row *r = &t->r->rows[i];
  (void)text;
  *x = r->omega;
  *y = verify_quantity_to_column(t->q, r->value);
  return r->skipped ? "skipped" : verdict_name(r->verdict);
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

hc_status plot_verify(plot_order *p, const scene *sc, const verify_data *data, const verify_report *r)
{
  const verify_quantity *q = &data->quantity;
  figure g = {0};
  curve_shape line;
  verdicts v;
  char about[VERIFY_TEXT + 64], words[VERIFY_TEXT];
  if (r->n_rows == 0) return figure_refuse(p, "no point was judged, so there is nothing to draw");
  hc_status st = make_line(q, r, &line);
  if (st == HC_OK) st = curve_figure_open(&g, p, sc, 900, 560);
  if (st == HC_OK) {
    const layers l = {.shape = &line, .v = &v, .of = "theirs"};
    curve_shape_data(&g, &line);
    verdicts_data(&g, &v, r->n_rows, &(theirs){q, r}, theirs_point);
    snprintf(about, sizeof about, "ours: H = %d, exact forces; cause: %s", r->harmonics, verify_word(r, words));
    figure_title(&g, "set title", sc->title, about);
    /* The sweep, widened to the points. */
    char name[VERIFY_QUANTITY_TEXT], unit[FIGURE_UNIT];
    double low = fmin(sc->omega_from, sc->omega_to), high = fmax(sc->omega_from, sc->omega_to);
    for (int i = 0; i < r->n_rows; ++i) {
      low = fmin(low, r->rows[i].omega);
      high = fmax(high, r->rows[i].omega);
    }
    curve_x_label(&g, sc);
    verify_quantity_name(q, name);
    figure_set(&g, "ylabel", "%s [%s]", name, q->decibel ? "dB" : figure_unit(sc, unit_of(q), unit));
    figure_script(&g, "set xrange [%.10g:%.10g]\n", low / g.x_unit, high / g.x_unit);
    if (!verify_quantity_signed(q)) figure_script(&g, "set yrange [0:*]\n");
    draw_layers(&g, &l);
  }
  curve_shape_clear(&line);
  return figure_close(&g, st);
}
