/* curve.c - see curve.h. */
#include "interfaces/command/plot/curve.h"

#include "compare/study/scene_solvers.h"
#include "numerics/base/constants.h"

/* ---- where the curve goes ---- */

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

/* ---- made and freed ---- */

void curve_response_name(const scene *sc, int r, char text[RESPONSE_NAME])
{
  char name[RESPONSE_NAME];
  structure_response_name(sc->structure, r, name, sizeof name);
  const bool number = strspn(name, "0123456789") == strlen(name);
  if (number) snprintf(text, RESPONSE_NAME, "DOF %.*s", RESPONSE_NAME - 5, name);
  else snprintf(text, RESPONSE_NAME, "%s", name);
}

hc_status curve_shape_of(const scene *sc, hbm_solver *s, const hbm_curve *curve, curve_shape *out)
{
  *out = (curve_shape){.harmonics = hbm_n_harmonics(s), .samples = hbm_n_samples(s)};
  curve_response_name(sc, 0, out->of);
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

hc_status curve_shape_response(const curve_shape *first, const scene *sc, hbm_solver *s, const hbm_curve *curve, int r,
                               curve_shape *out)
{
  *out = *first;
  out->points = NULL;
  out->special = malloc(((size_t)first->n_special + 1) * sizeof *out->special);
  curve_response_name(sc, r, out->of);
  hc_status st = out->special ? sample_curve(s, curve, (drawn_as){r, false}, &out->points, &out->n) : HC_NO_MEMORY;
  if (st != HC_OK) return st;
  for (int k = 0; k < out->n; ++k) out->points[k].stable = first->points[k].stable;
  for (int i = 0; i < out->n_special; ++i) {
    out->special[i] = first->special[i];
    out->special[i].amplitude = amplitude_there(first, out->points, &first->special[i]);
  }
  return HC_OK;
}

hc_status curve_shape_trace(const scene *sc, const number_list *asked, curve_shape *out)
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

void curve_shape_clear(curve_shape *c)
{
  free(c->points);
  free(c->special);
  c->points = NULL;
  c->special = NULL;
}

/* ---- drawn ---- */

static const struct stability_look {
  const char *name, *title, *dash, *quiet;
  int stable;
} stabilities[] = {
    {"stable", "harmonic balance: stable", "lw 2.2 dt 1", "lw 1.4 dt 1", 1},
    {"unstable", "unstable", "lw 1.8 dt (10,6)", "lw 1.4 dt (5,4)", -1},
    {"unknown", "stability unknown", "lw 1.6 dt 3", "lw 1.2 dt 3", 0},
};
enum { N_STABILITIES = sizeof stabilities / sizeof *stabilities };

static const struct special_look {
  const char *name, *title, *look;
  hbm_special_kind kind;
} special_looks[] = {
    {"turning", "turning point", "pt 11 ps 0.9 lc rgb '#000000'", HBM_TURNING_POINT},
    {"doubling", "period doubling", "pt 13 ps 0.9 lc rgb '#000000'", HBM_PERIOD_DOUBLING},
    {"change", "contact changes", "pt 4 ps 0.7 lw 1 lc rgb '#000000'", HBM_CONTACT_CHANGE},
    {"torus", "Neimark-Sacker point", "pt 15 ps 0.8 lc rgb '#000000'", HBM_NEIMARK_SACKER},
    {"breaking", "symmetry breaking", "pt 9 ps 0.9 lc rgb '#000000'", HBM_SYMMETRY_BREAKING},
};
enum { N_SPECIAL_LOOKS = sizeof special_looks / sizeof *special_looks };

static int count_points_of(const curve_shape *c, int stable)
{
  int n = 0;
  for (int k = 0; k < c->n; ++k) n += c->points[k].stable == stable;
  return n;
}

static bool is_drawn_as(const hbm_special *p, hbm_special_kind kind)
{
  return p->kind == kind && (kind != HBM_CONTACT_CHANGE || p->before != p->after);
}

static int count_specials(const curve_shape *c, hbm_special_kind kind)
{
  int n = 0;
  for (int i = 0; i < c->n_special; ++i) n += is_drawn_as(&c->special[i], kind);
  return n;
}

void curve_shape_data(figure *g, const curve_shape *c)
{
  for (int r = 0; r < N_STABILITIES; ++r) {
    figure_block(g, "%s%d", stabilities[r].name, c->among); /* one curve's names differ from another's */
    /* The points of one stability, as data for lines. A segment between two stabilities is drawn as its first
     * point's, so the point after the last of a stability is written too. */
    int stable = stabilities[r].stable;
    for (int k = 0; k < c->n; ++k) {
      const bool joined = k > 0 && c->points[k - 1].part == c->points[k].part;
      const bool mine = c->points[k].stable == stable, ends = joined && c->points[k - 1].stable == stable;
      if (!joined) figure_gap(g);
      if (mine || ends) figure_point(g, c->points[k].omega, c->points[k].amplitude);
      if (!mine && ends) figure_gap(g);
    }
    figure_block_end(g);
  }
  for (int m = 0; m < N_SPECIAL_LOOKS; ++m) {
    figure_block(g, "%s%d", special_looks[m].name, c->among);
    for (int i = 0; i < c->n_special; ++i)
      if (is_drawn_as(&c->special[i], special_looks[m].kind))
        figure_point(g, c->special[i].omega, c->special[i].amplitude);
    figure_block_end(g);
  }
}

static void special_items(figure *g, const curve_shape *c)
{
  for (int m = 0; m < N_SPECIAL_LOOKS; ++m)
    if (count_specials(c, special_looks[m].kind) > 0)
      figure_item(g, figure_look(g, 20 + m, "%s", special_looks[m].look), c->among > 1 ? NULL : special_looks[m].title,
                  "$%s%d using 1:2 with points", special_looks[m].name, c->among);
}

void curve_shape_items(figure *g, const curve_shape *c, bool quiet)
{
  if (c->among) {
    /* One of several: its colour, solid, dashed or dotted; its name at the first of these that there is. */
    static const char *const colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                          "#E69F00", "#56B4E9", "#000000", "#777777"};
    const int n_colours = sizeof colours / sizeof *colours;
    bool named = false;
    for (int r = 0; r < N_STABILITIES; ++r) {
      if (count_points_of(c, stabilities[r].stable) == 0) continue;
      figure_item(
          g, figure_look(g, c->among - 1, "%s lc rgb '%s'", stabilities[r].dash, colours[(c->among - 1) % n_colours]),
          named ? NULL : c->of, "$%s%d using 1:2 with lines", stabilities[r].name, c->among);
      named = true;
    }
    return;
  }
  for (int r = 0; r < N_STABILITIES; ++r)
    if (count_points_of(c, stabilities[r].stable) > 0)
      figure_item(g,
                  figure_look(g, r, "%s lc rgb '%s'", quiet ? stabilities[r].quiet : stabilities[r].dash,
                              quiet ? "#999999" : "#0072B2"),
                  r == 0 && c->stable_title ? c->stable_title : stabilities[r].title, "$%s0 using 1:2 with lines",
                  stabilities[r].name);
  if (!quiet) special_items(g, c);
}

void curve_shapes_rest(figure *g, int n, const curve_shape *c)
{
  for (int r = 1; r < N_STABILITIES && !g->letters; ++r)
    if (count_points_of(c, stabilities[r].stable) > 0)
      figure_item(g, figure_look(g, r, "%s lc rgb '#555555'", stabilities[r].dash), stabilities[r].title,
                  "NaN with lines");
  for (int i = 0; i < n && (i == 0 || !g->letters); ++i) special_items(g, &c[i]);
}

hc_status curve_figure_open(figure *g, plot_order *p, const scene *sc, int width, int height)
{
  hc_status st = figure_open(g, p, width, height);
  if (sc->in_cycles) g->x_unit = TWO_PI;
  return st;
}

void curve_x_label(figure *g, const scene *sc)
{
  if (sc->in_cycles) figure_below(g, "frequency [cycles/%s]", sc->unit_time);
  else figure_below(g, "%s [rad/%s]", g->letters ? "omega" : "ω", sc->unit_time);
}

void curve_shape_axes(figure *g, const scene *sc, const curve_shape *c)
{
  curve_x_label(g, sc);
  if (c->among) figure_set(g, "ylabel", "amplitude [%s]", sc->unit_length);
  else figure_set(g, "ylabel", "amplitude of %s [%s]", c->of, sc->unit_length);
  figure_script(g, "set xrange [%.10g:%.10g]\nset yrange [0:*]\n", c->low / g->x_unit, c->high / g->x_unit);
}

bool curve_shape_window(const curve_shape *c, curve_window *out)
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

const char *curve_shape_settings(const scene *sc, const curve_shape *c, char text[96])
{
  char samples[32] = "exact forces";
  if (sc->hbm.force == HBM_FORCE_SAMPLED) snprintf(samples, sizeof samples, "%d samples", c->samples);
  snprintf(text, 96, "H = %s%d%s, %s", sc->hbm.harmonics == HBM_AUTO ? "auto, at most " : "", c->harmonics,
           sc->hbm.keep_mean ? "" : " without harmonic 0", samples);
  return text;
}
