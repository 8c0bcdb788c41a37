/* figure_response.c - amplitude over omega: frf, compare, transient, and verify with another program's points. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/motion.h"
#include "compare/study/scene_solvers.h"
#include "interfaces/command/plot/figure.h"
#include "model/casefile/scene.h"
#include "numerics/base/constants.h"

enum { WIDTH = 800, HEIGHT = 540, MOST_RESPONSES = 8 };

/* ---- a response curve as it is drawn ---- */

typedef struct curve_point {
  double omega, amplitude; /* [rad/time], [length] */
  int stable;              /* +1, -1, 0 unknown */
  int part;                /* of the curve: points of two parts are not joined */
} curve_point;

typedef struct curve_shape {
  char of[RESPONSE_NAME];   /* the response in words; "x" of an oscillator */
  int among;                /* of several on the same axes which one, from 1; 0: it is the only one */
  const char *stable_title; /* its stable parts in the legend; NULL: harmonic balance's */
  int n;
  curve_point *points; /* [n] along the curve */
  int n_special;
  hbm_special *special;   /* [n_special] */
  int harmonics, samples; /* in use */
  double low, high;       /* [rad/time] the sweep */
} curve_shape;

/* Straight lines need more points: BETWEEN steps between two, on the cubic of hbm/curve/segment.h. */
enum { BETWEEN = 4 };

/* A curve is drawn by one response of the model; `judge`: with stability. */
typedef struct drawn_as {
  int response;
  bool judge;
} drawn_as;

static hc_status measure_point(hbm_solver *s, double omega, const double *X, drawn_as as, curve_point *p)
{
  hbm_measures m;
  hbm_stability floquet;
  hc_status st = as.response ? hbm_measure_response(s, omega, X, as.response, &m) : hbm_measure(s, X, &m);
  if (st != HC_OK) return st;
  p->omega = omega, p->amplitude = m.amplitude, p->stable = 0;
  const bool judge = as.judge && !hbm_stability_is_costly(s);
  if (judge && hbm_stability_with_error(s, omega, X, true, &floquet) == HC_OK)
    p->stable = hbm_stability_verdict(&floquet);
  return HC_OK;
}

/* points[BETWEEN (n - 1) + 1]. Stability is computed between points that differ in it, else theirs. */
static hc_status sample_curve(hbm_solver *s, const hbm_curve *c, drawn_as as, curve_point **points, int *n)
{
  hc_status st = HC_OK;
  *n = 0;
  *points = calloc((size_t)BETWEEN * (size_t)(c->n > 0 ? c->n : 1), sizeof **points);
  double *X = malloc((size_t)(c->n_coef > 0 ? c->n_coef : 1) * sizeof *X);
  if (!*points || !X) st = HC_NO_MEMORY;
  for (int k = 0; k < c->n && st == HC_OK; ++k) {
    (*points)[BETWEEN * k].part = c->points[k].part;
    st = measure_point(s, c->points[k].omega, c->X + (size_t)k * (size_t)c->n_coef, as, &(*points)[BETWEEN * k]);
  }
  for (int k = 0; k + 1 < c->n && st == HC_OK; ++k) {
    int here = (*points)[BETWEEN * k].stable, next = (*points)[BETWEEN * (k + 1)].stable;
    for (int i = 1; i < BETWEEN; ++i) (*points)[BETWEEN * k + i] = (*points)[BETWEEN * k];
    if (!hbm_curve_has_segment(c, k)) continue;
    const hbm_segment segment = hbm_segment_between(c, k);
    for (int i = 1; i < BETWEEN && st == HC_OK; ++i) {
      curve_point *p = &(*points)[BETWEEN * k + i];
      double omega;
      hbm_segment_at(&segment, (double)i / BETWEEN, X, &omega, NULL, NULL);
      st = measure_point(s, omega, X, (drawn_as){as.response, as.judge && here != next}, p);
      /* equal at both ends, or unknown because an added point is not quite a solution: that of the nearer end */
      if (here == next || !p->stable) p->stable = 2 * i <= BETWEEN ? here : next;
    }
  }
  if (st == HC_OK && c->n > 0) *n = BETWEEN * (c->n - 1) + 1;
  free(X);
  return st;
}

static double sq(double x) { return x * x; }

/* Distance of p from the segment a b, in fractions of the drawing's width and height. */
static double distance(const curve_point *p, const curve_point *a, const curve_point *b, double wide, double high)
{
  double bx = (b->omega - a->omega) / wide, by = (b->amplitude - a->amplitude) / high,
         px = (p->omega - a->omega) / wide, py = (p->amplitude - a->amplitude) / high;
  double along = bx * bx + by * by > 0 ? (px * bx + py * by) / (bx * bx + by * by) : 0;
  along = along < 0 ? 0 : along > 1 ? 1 : along;
  return sqrt(sq(px - along * bx) + sq(py - along * by));
}

/* The shape of a curve that was computed, by the model's first response. */
static hc_status curve_shape_of(const scene *sc, hbm_solver *s, const hbm_curve *curve, curve_shape *out)
{
  *out = (curve_shape){.harmonics = hbm_n_harmonics(s), .samples = hbm_n_samples(s)};
  figure_response_name(sc, 0, out->of);
  out->low = fmin(sc->omega_from, sc->omega_to);
  out->high = fmax(sc->omega_from, sc->omega_to);
  hc_status st = sample_curve(s, curve, (drawn_as){0, true}, &out->points, &out->n);
  if (st == HC_OK && curve->n > 0) hbm_specials(s, curve, &out->special, &out->n_special);
  return st;
}

/* The response's amplitude where the first one's point lies on its curve. */
static double amplitude_there(const curve_shape *first, const curve_point *points, const hbm_special *p)
{
  const curve_point at = {p->omega, p->amplitude, 0, 0};
  double nearest = INFINITY, amplitude = NAN, high = 0;
  for (int k = 0; k < first->n; ++k) high = fmax(high, first->points[k].amplitude);
  for (int k = 0; k + 1 < first->n; ++k) {
    const curve_point *a = &first->points[k], *b = a + 1;
    if (a->part != b->part) continue;
    const double d = distance(&at, a, b, first->high - first->low, high > 0 ? high : 1);
    if (!(d < nearest)) continue;
    const double part = b->omega != a->omega ? fmin(fmax((p->omega - a->omega) / (b->omega - a->omega), 0), 1) : 0;
    nearest = d;
    amplitude = points[k].amplitude + part * (points[k + 1].amplitude - points[k].amplitude);
  }
  return amplitude;
}

/* The same curve, of which `first` is the shape, by response r. */
static hc_status curve_shape_response(const curve_shape *first, const scene *sc, hbm_solver *s, const hbm_curve *curve,
                                      int r, curve_shape *out)
{
  *out = *first;
  out->points = NULL;
  out->special = malloc(((size_t)first->n_special + 1) * sizeof *out->special);
  figure_response_name(sc, r, out->of);
  hc_status st = out->special ? sample_curve(s, curve, (drawn_as){r, false}, &out->points, &out->n) : HC_NO_MEMORY;
  if (st != HC_OK) return st;
  for (int k = 0; k < out->n; ++k) out->points[k].stable = first->points[k].stable;
  for (int i = 0; i < out->n_special; ++i) {
    out->special[i] = first->special[i];
    out->special[i].amplitude = amplitude_there(first, out->points, &first->special[i]);
  }
  return HC_OK;
}

/* Computes the curve over the sweep, widened to `asked`, as far as it goes. HC_OK, HC_NO_MEMORY. */
static hc_status curve_shape_trace(const scene *sc, const number_list *asked, curve_shape *out)
{
  hbm_solver *s = NULL;
  hbm_curve curve = {0};
  double from, to;
  *out = (curve_shape){.low = fmin(sc->omega_from, sc->omega_to), .high = fmax(sc->omega_from, sc->omega_to)};
  comparison_sweep(sc->omega_from, sc->omega_to, asked, &from, &to);
  hc_status st = scene_hbm_solver(sc, &s);
  if (st == HC_OK) {
    hbm_trace_all(s, from, to, NULL, &curve);
    st = curve_shape_of(sc, s, &curve, out);
  }
  out->low = fmin(out->low, fmin(from, to));
  out->high = fmax(out->high, fmax(from, to));
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  return st == HC_NO_MEMORY ? st : HC_OK;
}

static void curve_shape_clear(curve_shape *c)
{
  free(c->points);
  free(c->special);
  c->points = NULL;
  c->special = NULL;
}

/* ---- what is drawn of it ---- */

static const struct stability_look {
  const char *title, *dash, *quiet;
  int stable;
} stabilities[] = {
    {"harmonic balance: stable", "lw 2.2 dt 1", "lw 1.4 dt 1", 1},
    {"unstable", "lw 1.8 dt (10,6)", "lw 1.4 dt (5,4)", -1},
    {"stability unknown", "lw 1.6 dt 3", "lw 1.2 dt 3", 0},
};
enum { N_STABILITIES = sizeof stabilities / sizeof *stabilities };

static const struct special_look {
  const char *title, *look;
  hbm_special_kind kind;
} special_looks[] = {
    {"turning point", "pt 11 ps 0.9 lc rgb '#000000'", HBM_TURNING_POINT},
    {"period doubling", "pt 13 ps 0.9 lc rgb '#000000'", HBM_PERIOD_DOUBLING},
    {"contact changes", "pt 4 ps 0.7 lw 1 lc rgb '#000000'", HBM_CONTACT_CHANGE},
    {"Neimark-Sacker point", "pt 15 ps 0.8 lc rgb '#000000'", HBM_NEIMARK_SACKER},
    {"symmetry breaking", "pt 9 ps 0.9 lc rgb '#000000'", HBM_SYMMETRY_BREAKING},
};
enum { N_SPECIAL_LOOKS = sizeof special_looks / sizeof *special_looks };

static bool has_points(const curve_shape *c, int stable)
{
  for (int k = 0; k < c->n; ++k)
    if (c->points[k].stable == stable) return true;
  return false;
}

/* The points of one stability, as a line. A segment between two stabilities is drawn as its first point's, so the point
 * after the last of a stability is drawn too. False: there are none. */
static bool put_stability(figure *g, const curve_shape *c, int stable, const char *look, const char *title)
{
  figure_series(g, "lines", look, title);
  for (int k = 0; k < c->n; ++k) {
    const bool joined = k > 0 && c->points[k - 1].part == c->points[k].part;
    const bool mine = c->points[k].stable == stable, ends = joined && c->points[k - 1].stable == stable;
    if (!joined) figure_gap(g);
    if (mine || ends) figure_point(g, c->points[k].omega, c->points[k].amplitude);
    if (!mine && ends) figure_gap(g);
  }
  return figure_series_end(g);
}

static void put_specials(figure *g, const curve_shape *c)
{
  for (int m = 0; m < N_SPECIAL_LOOKS; ++m) {
    figure_series(g, "points", figure_look(g, 20 + m, "%s", special_looks[m].look),
                  c->among > 1 ? NULL : special_looks[m].title);
    for (int i = 0; i < c->n_special; ++i) {
      const hbm_special *p = &c->special[i];
      if (p->kind == special_looks[m].kind && (p->kind != HBM_CONTACT_CHANGE || p->before != p->after))
        figure_point(g, p->omega, p->amplitude);
    }
    figure_series_end(g);
  }
}

/* quiet: thin, grey, without special points: the background of something else. */
static void put_curve(figure *g, const curve_shape *c, bool quiet)
{
  for (int r = 0; r < N_STABILITIES; ++r)
    put_stability(g, c, stabilities[r].stable,
                  figure_look(g, r, "%s lc rgb '%s'", quiet ? stabilities[r].quiet : stabilities[r].dash,
                              quiet ? "#999999" : "#0072B2"),
                  r == 0 && c->stable_title ? c->stable_title : stabilities[r].title);
  if (!quiet) put_specials(g, c);
}

/* Several: each in its colour, solid, dashed or dotted, its name at the first of these that there is; then what the
 * dashes mean, in the key, and all special points. */
static void put_curves(figure *g, int n, const curve_shape *c)
{
  static const char *const colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                        "#E69F00", "#56B4E9", "#000000", "#777777"};
  const int n_colours = sizeof colours / sizeof *colours;
  for (int i = 0; i < n; ++i) {
    bool named = false;
    for (int r = 0; r < N_STABILITIES; ++r)
      named |= put_stability(g, &c[i], stabilities[r].stable,
                             figure_look(g, i, "%s lc rgb '%s'", stabilities[r].dash, colours[i % n_colours]),
                             named ? NULL : c[i].of);
  }
  for (int r = 1; r < N_STABILITIES && !g->letters; ++r)
    if (has_points(c, stabilities[r].stable))
      figure_item(g, figure_look(g, r, "%s lc rgb '#555555'", stabilities[r].dash), stabilities[r].title,
                  "NaN with lines");
  for (int i = 0; i < n && (i == 0 || !g->letters); ++i) put_specials(g, &c[i]);
}

/* figure_open for a drawing over frequency: in cycles per time where the scene's sweep is. */
static hc_status curve_figure_open(figure *g, plot_order *p, const scene *sc, int width, int height)
{
  hc_status st = figure_open(g, p, width, height);
  if (sc->in_cycles) g->x_unit = TWO_PI;
  return st;
}

static void curve_x_label(figure *g, const scene *sc)
{
  if (sc->in_cycles) figure_below(g, "frequency [cycles/%s]", sc->unit_time);
  else figure_below(g, "%s [rad/%s]", g->letters ? "omega" : "ω", sc->unit_time);
}

/* Axes and ranges of amplitude over omega; the label names the response where it is the only one. */
static void curve_shape_axes(figure *g, const scene *sc, const curve_shape *c)
{
  curve_x_label(g, sc);
  if (c->among) figure_set(g, "ylabel", "amplitude [%s]", sc->unit_length);
  else figure_set(g, "ylabel", "amplitude of %s [%s]", c->of, sc->unit_length);
  figure_script(g, "set xrange [%.10g:%.10g]\nset yrange [0:*]\n", c->low / g->x_unit, c->high / g->x_unit);
}

/* The part of the sweep and of the amplitudes that holds all special points, to be drawn beside the whole. */
typedef struct curve_window {
  double low, high;   /* [rad/time] */
  double least, most; /* [length] amplitudes */
} curve_window;

/* False: there are no special points, or their part is not small against the sweep. */
static bool curve_shape_window(const curve_shape *c, curve_window *out)
{
  static const double small = 0.12, margin = 0.4; /* fractions: of the sweep; of the part */
  curve_window w = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  double top = 0;
  for (int i = 0; i < c->n_special; ++i) {
    w.low = fmin(w.low, c->special[i].omega);
    w.high = fmax(w.high, c->special[i].omega);
    w.least = fmin(w.least, c->special[i].amplitude);
    w.most = fmax(w.most, c->special[i].amplitude);
  }
  if (!(w.high > w.low) || w.high - w.low > small * (c->high - c->low)) return false;
  double beside = margin * (w.high - w.low);
  for (int k = 0; k < c->n; ++k) {
    top = fmax(top, c->points[k].amplitude);
    if (c->points[k].omega >= w.low && c->points[k].omega <= w.high) w.most = fmax(w.most, c->points[k].amplitude);
  }
  double above = fmax(margin * (w.most - w.least), 0.02 * top);
  *out = (curve_window){w.low - beside, w.high + beside, fmax(w.least - above, 0), w.most + above};
  return true;
}

/* "H = 10, exact forces" */
static const char *curve_shape_settings(const scene *sc, const curve_shape *c, char text[96])
{
  char samples[32] = "exact forces";
  if (sc->hbm.force == HBM_FORCE_SAMPLED) snprintf(samples, sizeof samples, "%d samples", c->samples);
  snprintf(text, 96, "H = %s%d%s, %s", sc->hbm.harmonics == HBM_AUTO ? "auto, at most " : "", c->harmonics,
           sc->hbm.keep_mean ? "" : " without harmonic 0", samples);
  return text;
}

/* All that was put into the plot, over the whole sweep; beside it the part with all special points, if it is small and
 * the curve is of one response, and with a its three panels. */
static void response_panels(figure *g, const scene *sc, const curve_shape *shape, const char *about, const accuracy *a)
{
  curve_window w;
  const bool detail = !shape->among && curve_shape_window(shape, &w), several = a || detail;
  if (several) panels_begin(g, a ? 2 : 1, a && detail ? 3 : 2, sc->title, about);
  else figure_title(g, "set title", sc->title, about);
  if (several && !g->letters) figure_script(g, "set title '%s'\n", a ? "Response" : "Whole sweep");
  curve_shape_axes(g, sc, shape);
  figure_draw(g);
  if (detail) {
    figure_script(g, "set title 'Where the contact changes'\nset xrange [%.10g:%.10g]\nset yrange [%.10g:%.10g]\n",
                  w.low / g->x_unit, w.high / g->x_unit, w.least, w.most);
    figure_draw(g);
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
    if (n > 1) put_curves(&g, n, shape);
    else put_curve(&g, shape, false);
    figure_series(&g, "points", figure_look(&g, 8, "pt 6 ps 1.2 lw 1.6 lc rgb '#D55E00'"), "solutions asked for");
    for (int k = 0; asked && k < asked->n && st == HC_OK; ++k)
      for (int r = of.first; r <= of.last && st == HC_OK; ++r) {
        hbm_measures m;
        const double omega = asked->points[k].omega, *X = asked->X + (size_t)k * (size_t)asked->n_coef;
        st = hbm_measure_response(s, omega, X, r, &m);
        if (st == HC_OK) figure_point(&g, omega, m.amplitude);
      }
    figure_series_end(&g);
  }
  if (st == HC_OK) {
    curve_shape_settings(sc, shape, settings);
    if (n < all) snprintf(about, sizeof about, "%s; the first %d of %d responses", settings, n, all);
    else snprintf(about, sizeof about, "%s", settings);
    response_panels(&g, sc, shape, about, NULL);
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

/* Arrows from an HBM solution to the transient that started on it and left. */
static void put_departures(figure *g, const comparison *c)
{
  figure_series(g, "1:2:(0):3 with vectors filled head size character 0.9,20", "lw 0.8 dt 1 lc rgb '#999999'",
                "where the transient went");
  for (int i = 0; i < c->n_rows && !g->letters; ++i) {
    const comparison_row *r = &c->rows[i];
    if (r->response != 0 || !stands_at_hbm(r) || !has_transient(r)) continue;
    figure_arrow(g, r->omega, r->hbm.amplitude, r->transient.amplitude - r->hbm.amplitude);
  }
  figure_series_end(g);
}

/* A line at each omega from the least to the largest amplitude, as sliders rest elsewhere that never slip. */
static void put_bands(figure *g, const comparison *c)
{
  figure_series(g, "lines", "lw 5 lc rgb '#80E69F00'", "where sliders rest elsewhere");
  for (int i = 0; i < c->n_rows; ++i) {
    const comparison_row *r = &c->rows[i];
    if (r->response != 0 || !(band_width(&r->band) > 0)) continue;
    figure_point(g, r->omega, r->band.low);
    figure_point(g, r->omega, r->band.high);
    figure_gap(g);
  }
  figure_series_end(g);
}

hc_status plot_compare(plot_order *p, const scene *sc, const comparison *c, const accuracy *a)
{
  figure g = {0};
  curve_shape shape = {0};
  curve_window w;
  char settings[96];
  bool all = a && a->n_rows > 0;
  if (c->n_rows == 0) return figure_refuse(p, "there is nothing compared to draw");
  hc_status st = curve_shape_trace(sc, &sc->compare.omega, &shape);
  int width = !all ? response_width(&shape) : curve_shape_window(&shape, &w) ? 1900 : 1300;
  if (st == HC_OK) st = curve_figure_open(&g, p, sc, width, all ? 1040 : HEIGHT);
  if (st == HC_OK) {
    put_curve(&g, &shape, false);
    put_bands(&g, c);
    put_departures(&g, c);
    figure_verdicts(&g, "transient", c->n_rows, c->rows, compared_point);
    response_panels(&g, sc, &shape, curve_shape_settings(sc, &shape, settings), all ? a : NULL);
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
  int n = 0;
  hc_status st = figure_open(&g, p, 800, 500);
  if (st != HC_OK) return figure_close(&g, st);
  for (int i = 0; i < found->n && n < MOST_WAVES; ++i) {
    const steady_row *r = &found->rows[i];
    if (!measured(r)) continue;
    figure_series(&g, "lines", figure_line(&g, n++, 2),
                  figure_words(&g, "start: %s; %s", r->start, steady_verdict_text(r, word)));
    for (int k = 0; k <= TIMEINT_WAVE; ++k)
      figure_point(&g, (double)k / TIMEINT_WAVE, r->result.wave[k % TIMEINT_WAVE]);
    figure_series_end(&g);
    low = fmin(low, r->result.min);
    high = fmax(high, r->result.max);
  }
  snprintf(about, sizeof about, "steady state at %s%.8g %s/%s, period T = %.6g %s",
           sc->in_cycles ? "" : "ω = ", scene_frequency(sc, omega), sc->in_cycles ? "cycles" : "rad", sc->unit_time,
           TWO_PI / omega, sc->unit_time);
  figure_title(&g, "set title", sc->title, about);
  figure_response_name(sc, 0, of);
  figure_set(&g, "ylabel", "%s [%s]", of, sc->unit_length);
  figure_below(&g, "t / T");
  figure_script(&g, "set xrange [0:1]\n");
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
  char settings[96], about[160];
  hc_status st = curve_shape_trace(sc, &sc->compare.omega, &shape);
  if (st == HC_OK) st = curve_figure_open(&g, p, sc, response_width(&shape), HEIGHT);
  if (st == HC_OK) {
    put_curve(&g, &shape, true);
    figure_verdicts(&g, "time integration", found->n, found->rows, steady_point);
    snprintf(about, sizeof about, "time integration; harmonic balance, %s", curve_shape_settings(sc, &shape, settings));
    response_panels(&g, sc, &shape, about, NULL);
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
  char about[VERIFY_TEXT + 64], words[VERIFY_TEXT];
  if (r->n_rows == 0) return figure_refuse(p, "no point was judged, so there is nothing to draw");
  hc_status st = make_line(q, r, &line);
  if (st == HC_OK) st = curve_figure_open(&g, p, sc, 900, 560);
  if (st == HC_OK) {
    put_curve(&g, &line, false);
    figure_verdicts(&g, "theirs", r->n_rows, &(theirs){q, r}, theirs_point);
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
    figure_draw(&g);
  }
  curve_shape_clear(&line);
  return figure_close(&g, st);
}
