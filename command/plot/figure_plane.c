/* figure_plane.c - what a contact with two tangents does under a given motion: its traction in the plane, within the
 * limit of friction, and the ways of the motion and of the slider. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "command/plot/panels.h"
#include "command/plot/phases.h"
#include "hbm/contact/exact_force.h"
#include "hbm/planar/planar_force.h"
#include "numerics/series.h"

enum { POINTS = 4096, CORNERS = 128 };

/* The contact along one period: motion and slider [length], traction [force]. */
typedef struct plane_history {
  double u[2][POINTS + 1], w[2][POINTS + 1], t[2][POINTS + 1];
  double limit[POINTS + 1]; /* mu N [force] */
  contact_state state[POINTS + 1];
} plane_history;

static double angle_of(int i) { return TWO_PI * i / POINTS; }

/* The motion and the limit; no traction yet. */
static void follow_motion(const plot_motion *m, plane_history *out)
{
  const contact *law = &m->contacts->law;
  const int n = series_length(m->n_harm);
  for (int i = 0; i <= POINTS; ++i) {
    const double c = cos(angle_of(i)), s = sin(angle_of(i)), v = series_at(m->n_harm, m->X + 2 * n, c, s).x;
    for (int d = 0; d < 2; ++d) out->u[d][i] = series_at(m->n_harm, m->X + d * n, c, s).x;
    out->limit[i] = law->mu * contact_normal(law, v);
    out->state[i] = CONTACT_SEPARATED;
  }
}

/* Pieces may begin before 0 or end after 2 pi. */
static double angle_inside(double th, double from, double to)
{
  for (int turn = -1; turn <= 1; ++turn)
    if (th + turn * TWO_PI >= from && th + turn * TWO_PI <= to) return th + turn * TWO_PI;
  return NAN;
}

/* Slip: T = mu N e(phi). */
static void slip_at(const planar_cycle *c, const planar_interval *p, double th, int i, plane_history *out)
{
  const planar_panel *q = &c->slip.panel[p->panel];
  while (q < &c->slip.panel[p->panel + p->n_panels - 1] && th > q->to) ++q;
  const double phi = planar_panel_angle(c->slip.c, q, th);
  out->t[0][i] = out->limit[i] * cos(phi), out->t[1][i] = out->limit[i] * sin(phi);
}

static void follow_circle(const planar_cycle *c, const contact *law, plane_history *out)
{
  for (int k = 0; k < c->n; ++k)
    for (int i = 0; i <= POINTS; ++i) {
      const planar_interval *p = &c->interval[k];
      const double th = angle_inside(angle_of(i), p->from, p->to);
      if (isnan(th)) continue;
      out->state[i] = p->state;
      if (p->state != CONTACT_STICK) slip_at(c, p, th, i, out);
      for (int d = 0; d < 2 && p->state == CONTACT_STICK; ++d) out->t[d][i] = law->kt * (out->u[d][i] - p->w[d]);
    }
}

static hc_status evaluate_circle(const plot_motion *m, plane_history *out)
{
  const contact *law = &m->contacts->law;
  double F[SERIES_MAX_DIM * (2 * HBM_MAX_HARMONICS + 1)];
  planar_force *f = NULL;
  hc_status st = planar_force_new(m->n_harm, law->kn > 0 ? 3 : 2, law, &f);
  if (st == HC_OK) st = planar_force_eval(f, m->X, F, NULL, NULL);
  if (st == HC_OK) follow_circle(planar_force_cycle(f), law, out);
  planar_force_free(f);
  return st;
}

/* Under the square law either tangent is a contact of its own; the two slip where one does. */
static void follow_tangent(int d, const contact_interval *p, int n, const contact *law, plane_history *out)
{
  for (int k = 0; k < n; ++k)
    for (int i = 0; i <= POINTS; ++i) {
      if (isnan(angle_inside(angle_of(i), p[k].from, p[k].to))) continue;
      const bool sticks = p[k].state == CONTACT_STICK;
      out->t[d][i] = sticks ? law->kt * out->u[d][i] - p[k].held : contact_slip_sign(p[k].state) * out->limit[i];
      if (d == 0 || !sticks) out->state[i] = p[k].state;
    }
}

static hc_status evaluate_square(const plot_motion *m, plane_history *out)
{
  const size_t n = (size_t)series_length(m->n_harm);
  double F[2 * (2 * HBM_MAX_HARMONICS + 1)], X[2 * (2 * HBM_MAX_HARMONICS + 1)];
  exact_force *e = NULL;
  hc_status st = exact_force_new(m->n_harm, 2, 1, m->contacts, &e);
  memcpy(X + n, m->X + 2 * n, n * sizeof *X);
  for (int d = 0, pieces; d < 2 && st == HC_OK; ++d) {
    memcpy(X, m->X + (size_t)d * n, n * sizeof *X);
    st = exact_force_eval(e, X, F, NULL, NULL);
    const contact_interval *p = exact_force_intervals(e, 0, &pieces);
    if (st == HC_OK) follow_tangent(d, p, pieces, &m->contacts->law, out);
  }
  exact_force_free(e);
  return st;
}

/* w = u - T/kt, and where the slider started added to both. */
static void place_slider(const plot_motion *m, plane_history *out)
{
  for (int d = 0; d < 2; ++d)
    for (int i = 0; i <= POINTS; ++i) {
      out->u[d][i] += m->slider[d];
      out->w[d][i] = out->u[d][i] - out->t[d][i] / m->contacts->law.kt;
    }
}

/* The ways of the motion and, while there is contact, of the slider; where it rests. */
static void write_ways(figure *g, const plane_history *w)
{
  figure_block(g, "motion");
  for (int i = 0; i <= POINTS; i += PHASES_EVERY) figure_point(g, w->u[0][i], w->u[1][i]);
  figure_block_end(g);
  figure_block(g, "slider");
  for (int i = 0; i <= POINTS; ++i) {
    if (w->state[i] != CONTACT_SEPARATED) figure_point(g, w->w[0][i], w->w[1][i]);
    else if (i > 0 && w->state[i - 1] != CONTACT_SEPARATED) figure_gap(g);
  }
  figure_block_end(g);
  figure_block(g, "rests");
  for (int i = 0; i <= POINTS; ++i)
    if (w->state[i] == CONTACT_STICK && (i == 0 || w->state[i - 1] != CONTACT_STICK))
      figure_point(g, w->w[0][i], w->w[1][i]);
  figure_block_end(g);
}

/* The limit where it is mu N = r: a circle, or a square of side 2 r. */
static void write_limit(figure *g, const char *name, bool circle, double r)
{
  const int n = circle ? CORNERS : 4;
  const double first = circle ? 0 : TWO_PI / 8, to_corner = circle ? r : sqrt(2) * r;
  figure_block(g, name);
  for (int i = 0; i <= n; ++i)
    figure_point(g, to_corner * cos(first + TWO_PI * i / n), to_corner * sin(first + TWO_PI * i / n));
  figure_block_end(g);
}

/* The largest and the smallest mu N; at least[1] is 0 where it separates. */
static void find_limits(const plane_history *w, double *most, double *least)
{
  *most = *least = w->limit[0];
  for (int i = 0; i <= POINTS; ++i) *most = fmax(*most, w->limit[i]), *least = fmin(*least, w->limit[i]);
}

static void axes(figure *g, const char *title, const char *quantity, const char *name, const char *unit)
{
  figure_set(g, "title", "%s", title);
  figure_script(g, "set size ratio -1\nset offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\nset zeroaxis lw 0.8 "
                   "dt 1 lc rgb '#999999'\n");
  figure_below(g, "%s %s_1 [%s]", quantity, name, unit);
  figure_set(g, "ylabel", "%s %s_2 [%s]", quantity, name, unit);
}

static void draw_both(figure *g, const scene *sc, const plane_history *w, const int *there, bool circle)
{
  double most, least;
  char look[FIGURE_LOOK];
  find_limits(w, &most, &least);
  write_limit(g, "most", circle, most);
  write_limit(g, "least", circle, least);
  axes(g, "Traction in the plane", "traction", "T", sc->unit_force);
  phases_items(g, 0, there, true);
  figure_item(g, "$most using 1:2 with lines", figure_look(g, "lw 1 dt 3 lc rgb '#555555'", 4, look),
              least < most ? "limit μ N at most" : "limit μ N");
  if (least > 0 && least < most)
    figure_item(g, "$least using 1:2 with lines", figure_look(g, "lw 1 dt 4 lc rgb '#555555'", 5, look),
                "limit μ N at least");
  figure_draw(g);
  axes(g, "Motion and slider", "motion", "u", sc->unit_length);
  figure_item(g, "$motion using 1:2 with lines", figure_look(g, "lw 1.2 dt 3 lc rgb '#555555'", 1, look), "motion u");
  figure_item(g, "$slider using 1:2 with lines", figure_look(g, "lw 2 dt 1 lc rgb '#D55E00'", 2, look), "slider w");
  if (there[0])
    figure_item(g, "$rests using 1:2 with points", figure_look(g, "pt 7 ps 0.8 lc rgb '#0072B2'", 3, look),
                "slider at rest");
  figure_draw(g);
}

hc_status plot_contact_plane(plot_order *p, const scene *sc, const plot_motion *m)
{
  const char *const name = scene_contact_at(sc, m->first)->name;
  figure g = {0};
  char about[128];
  int there[PHASES];
  if (!contact_has_friction(&m->contacts->law)) {
    snprintf(p->why, sizeof p->why, "the contact has no friction: there is no traction to draw");
    return HC_BAD_INPUT;
  }
  plane_history *w = calloc(1, sizeof *w);
  hc_status st = figure_open(&g, p, 1100, 580);
  if (st == HC_OK && !w) st = HC_NO_MEMORY;
  if (st == HC_OK) {
    follow_motion(m, w);
    st = m->circle ? evaluate_circle(m, w) : evaluate_square(m, w);
  }
  if (st == HC_OK) {
    place_slider(m, w);
    for (int k = 0; k < PHASES; ++k) there[k] = phases_write(&g, 0, k, POINTS, w->state, w->t[0], w->t[1]);
    write_ways(&g, w);
    if (*name) snprintf(about, sizeof about, "contact %s", name);
    else snprintf(about, sizeof about, "contact %d", m->first);
    snprintf(about + strlen(about), sizeof about - strlen(about), "; exact law, limit: %s, along the given motion",
             m->circle ? "circle" : "square");
    panels_begin(&g, 1, 2, sc->title, about);
    draw_both(&g, sc, w, there, m->circle);
    panels_end(&g);
  }
  free(w);
  return figure_close(&g, st);
}
