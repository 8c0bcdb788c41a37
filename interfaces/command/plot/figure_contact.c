/* figure_contact.c - what contacts do under a given motion: loops T over u, forces over the period; of one contact with
 * two tangents its traction within the limit of friction, and the ways of motion and slider. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/contact/exact_force.h"
#include "hbm/planar/planar_force.h"
#include "interfaces/command/plot/figure.h"
#include "numerics/base/constants.h"
#include "numerics/series.h"

enum {
  POINTS = 4096, /* of a period */
  EVERY = 8,     /* of so many points one is drawn, beside the ends of a phase */
  MOST_LOOPS = 8,
  CORNERS = 128 /* of a circle */
};

/* ---- a closed curve in parts, by what the contact does: each phase has dashes of its own ---- */

enum { PHASES = 3 };
static const struct phase {
  const char *title;
  int dash;
  double width;
} phases[PHASES] = {{"sticks", 1, 2.4}, {"slips", 2, 2}, {"separated", 3, 2}};

static int phase_of(contact_state st) { return st == CONTACT_STICK ? 0 : st == CONTACT_SEPARATED ? 2 : 1; }

/* Loop j (x, y) of points 0..n, a series for each phase; only: the legend needs no number. */
static void put_loop(figure *g, int j, bool only, int n, const contact_state *state, const double *x, const double *y)
{
  char of[32] = "";
  if (!only) snprintf(of, sizeof of, "contact %d ", j);
  for (int phase = 0; phase < PHASES; ++phase) {
    const struct phase *p = &phases[phase];
    figure_series(g, "lines",
                  figure_look(g, PHASES * j + phase, "lw %g dt %d lc rgb '%s'", p->width, p->dash, figure_colour(j)),
                  figure_words(g, "%s%s", of, p->title));
    for (int i = 0; i < n; ++i) {
      const bool mine = phase_of(state[i + 1]) == phase, next = i + 2 <= n && phase_of(state[i + 2]) == phase;
      if (!mine) continue;
      const bool begins = i == 0 || phase_of(state[i]) != phase;
      if (begins) figure_point(g, x[i], y[i]);
      if (!next || i % EVERY == 0) figure_point(g, x[i + 1], y[i + 1]);
      if (!next) figure_gap(g);
    }
    figure_series_end(g);
  }
}

static double angle_of(int i) { return TWO_PI * i / POINTS; }

/* Pieces may begin before 0 or end after 2 pi. */
static double angle_inside(double th, double from, double to)
{
  for (int turn = -1; turn <= 1; ++turn)
    if (th + turn * TWO_PI >= from && th + turn * TWO_PI <= to) return th + turn * TWO_PI;
  return NAN;
}

/* ---- loops and forces ---- */

/* One contact along one period. */
typedef struct contact_history {
  double u[POINTS + 1], normal[POINTS + 1], t[POINTS + 1]; /* u [length], N and T [force] */
  contact_state state[POINTS + 1];
} contact_history;

/* The first n contacts along the period, into w[n]; closed: the range of u while some contact is closed. */
static hc_status follow_contacts(const plot_motion *m, int n, contact_history *w, double closed[2])
{
  double F[SERIES_MAX_DIM * (2 * HBM_MAX_HARMONICS + 1)];
  exact_force *e = NULL;
  hc_status st = exact_force_new(m->of->n_harm, m->of->n_dof, m->of->n_contacts, m->of->contacts, &e);
  if (st == HC_OK) st = exact_force_eval(e, m->of->X, F, NULL, NULL);
  for (int j = 0, pieces; j < n && st == HC_OK; ++j, ++w) {
    const contact_interval *p = exact_force_intervals(e, j, &pieces);
    /* The exact law, from the intervals that exact_force.h found. */
    const moving_contact *c = &m->of->contacts[j];
    for (int i = 0; i <= POINTS; ++i) {
      const double th = angle_of(i);
      double v = 0;
      const contact_interval *now = contact_interval_at(pieces, p, th);
      for (int d = 0; d < m->of->n_dof; ++d) {
        const double x = series_at(m->of->n_harm, m->of->X + d * series_length(m->of->n_harm), cos(th), sin(th)).x;
        w->u[i] += c->cu[d] * x;
        v += c->cv[d] * x;
      }
      w->normal[i] = contact_normal(&c->law, v);
      w->state[i] = now ? now->state : CONTACT_SEPARATED;
      w->t[i] = contact_interval_traction(&c->law, now, w->u[i], w->normal[i]);
      w->u[i] += m->slider[0];
      if (w->state[i] == CONTACT_SEPARATED) continue;
      closed[0] = fmin(closed[0], w->u[i]);
      closed[1] = fmax(closed[1], w->u[i]);
    }
  }
  exact_force_free(e);
  return st;
}

/* by y over the period. */
static void put_force(figure *g, const char *look, const char *title, double by, const double y[POINTS + 1])
{
  figure_series(g, "lines", look, title);
  for (int i = 0; i <= POINTS; i += EVERY) figure_point(g, (double)i / POINTS, by * y[i]);
  figure_series_end(g);
}

/* The law, and which contacts of the case are drawn where it has more. */
static const char *say_which(const scene *sc, const plot_motion *m, int n, char *text, size_t size)
{
  const int all = scene_contact_count(sc);
  const char *name = n > 0 ? scene_contact_at(sc, m->first)->name : "", *law = "exact law along the given motion";
  if (*name && n == 1) snprintf(text, size, "contact %s; %s", name, law);
  else if (n == 1 && all > 1) snprintf(text, size, "contact %d; %s", m->first, law);
  else if (n < all) snprintf(text, size, "%s; contacts 0 to %d of %d", law, n - 1, all);
  else snprintf(text, size, "%s", law);
  return text;
}

static hc_status plot_loops(plot_order *p, const scene *sc, const plot_motion *m)
{
  figure g = {0};
  const int n = m->of->n_contacts < MOST_LOOPS ? m->of->n_contacts : MOST_LOOPS;
  double closed[2] = {INFINITY, -INFINITY}; /* u while some contact is closed */
  char about[128];
  if (n == 0) return figure_refuse(p, "there is no contact to draw");
  contact_history *w = calloc((size_t)n, sizeof *w);
  hc_status st = figure_open(&g, p, 1100, 500);
  if (st == HC_OK) st = w ? follow_contacts(m, n, w, closed) : HC_NO_MEMORY;
  if (st == HC_OK) {
    panels_begin(&g, 1, 2, sc->title, say_which(sc, m, n, about, sizeof about));
    figure_script(
        &g,
        "set title 'Hysteresis'\nset offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\nset zeroaxis lw 0.8 dt 1 "
        "lc rgb '#999999'\n");
    figure_below(&g, "tangential motion u [%s]", sc->unit_length);
    figure_set(&g, "ylabel", "tangential force T [%s]", sc->unit_force);
    /* The range of u while the contact is closed, with a margin: while it is open T = 0. */
    double wide = closed[1] - closed[0];
    if (wide > 0) figure_script(&g, "set xrange [%.10g:%.10g]\n", closed[0] - 0.5 * wide, closed[1] + 0.25 * wide);
    for (int j = 0; j < n; ++j) put_loop(&g, j, n == 1, POINTS, w[j].state, w[j].u, w[j].t);
    figure_draw(&g);
    figure_below(&g, "t / T");
    figure_script(&g,
                  "set title 'Forces over the period'\nset xrange [0:1]\nset offsets 0, 0, graph 0.03, graph 0.03\n");
    figure_set(&g, "ylabel", "force [%s]", sc->unit_force);
    for (int j = 0; j < n; ++j) {
      char of[32] = "";
      if (n > 1) snprintf(of, sizeof of, " of contact %d", j);
      put_force(&g, figure_line(&g, 3 * j + 2, 1.8), figure_words(&g, "normal force N%s", of), 1, w[j].normal);
      put_force(&g, figure_line(&g, 3 * j, 2), figure_words(&g, "tangential force T%s", of), 1, w[j].t);
    }
    for (int sign = 1; sign >= -1 && n == 1 && !g.letters; sign -= 2)
      put_force(&g, "lw 1 dt 3 lc rgb '#555555'", sign > 0 ? "± μ N" : NULL, sign * m->of->contacts[0].law.mu,
                w->normal);
    figure_draw(&g);
    panels_end(&g);
  }
  free(w);
  return figure_close(&g, st);
}

/* ---- one contact in the plane ---- */

/* The contact along one period: motion and slider [length], traction [force]. */
typedef struct plane_history {
  double u[2][POINTS + 1], w[2][POINTS + 1], t[2][POINTS + 1];
  double limit[POINTS + 1]; /* mu N [force] */
  contact_state state[POINTS + 1];
} plane_history;

static hc_status evaluate_circle(const plot_motion *m, plane_history *out)
{
  const contact *law = &m->of->contacts->law;
  double F[SERIES_MAX_DIM * (2 * HBM_MAX_HARMONICS + 1)];
  planar_force *f = NULL;
  hc_status st = planar_force_new(m->of->n_harm, law->kn > 0 ? 3 : 2, law, &f);
  if (st == HC_OK) st = planar_force_eval(f, m->of->X, F, NULL, NULL);
  if (st == HC_OK) {
    const planar_cycle *c = planar_force_cycle(f);
    for (int k = 0; k < c->n; ++k)
      for (int i = 0; i <= POINTS; ++i) {
        const planar_interval *p = &c->interval[k];
        const double th = angle_inside(angle_of(i), p->from, p->to);
        if (isnan(th)) continue;
        out->state[i] = p->state;
        /* Slip: T = mu N e(phi). */
        if (p->state != CONTACT_STICK) {
          const planar_panel *q = &c->slip.panel[p->panel];
          while (q < &c->slip.panel[p->panel + p->n_panels - 1] && th > q->to) ++q;
          const double phi = planar_panel_angle(c->slip.c, q, th);
          out->t[0][i] = out->limit[i] * cos(phi), out->t[1][i] = out->limit[i] * sin(phi);
        }
        for (int d = 0; d < 2 && p->state == CONTACT_STICK; ++d) out->t[d][i] = law->kt * (out->u[d][i] - p->w[d]);
      }
  }
  planar_force_free(f);
  return st;
}

static hc_status evaluate_square(const plot_motion *m, plane_history *out)
{
  const size_t n = (size_t)series_length(m->of->n_harm);
  double F[2 * (2 * HBM_MAX_HARMONICS + 1)], X[2 * (2 * HBM_MAX_HARMONICS + 1)];
  exact_force *e = NULL;
  hc_status st = exact_force_new(m->of->n_harm, 2, 1, m->of->contacts, &e);
  memcpy(X + n, m->of->X + 2 * n, n * sizeof *X);
  for (int d = 0, pieces; d < 2 && st == HC_OK; ++d) {
    memcpy(X, m->of->X + (size_t)d * n, n * sizeof *X);
    st = exact_force_eval(e, X, F, NULL, NULL);
    const contact_interval *p = exact_force_intervals(e, 0, &pieces);
    /* Under the square law either tangent is a contact of its own; the two slip where one does. */
    if (st == HC_OK) {
      for (int k = 0; k < pieces; ++k)
        for (int i = 0; i <= POINTS; ++i) {
          if (isnan(angle_inside(angle_of(i), p[k].from, p[k].to))) continue;
          const bool sticks = p[k].state == CONTACT_STICK;
          out->t[d][i] = sticks ? m->of->contacts->law.kt * out->u[d][i] - p[k].held
                                : contact_slip_sign(p[k].state) * out->limit[i];
          if (d == 0 || !sticks) out->state[i] = p[k].state;
        }
    }
  }
  exact_force_free(e);
  return st;
}

/* The limit where it is mu N = r: a circle, or a square of side 2 r. */
static void put_limit(figure *g, const char *look, const char *title, bool circle, double r)
{
  const int n = circle ? CORNERS : 4;
  const double first = circle ? 0 : TWO_PI / 8, to_corner = circle ? r : sqrt(2) * r;
  figure_series(g, "lines", look, title);
  for (int i = 0; i <= n; ++i)
    figure_point(g, to_corner * cos(first + TWO_PI * i / n), to_corner * sin(first + TWO_PI * i / n));
  figure_series_end(g);
}

static void axes(figure *g, const char *title, const char *quantity, const char *name, const char *unit)
{
  figure_set(g, "title", "%s", title);
  figure_script(g, "set size ratio -1\nset offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\nset zeroaxis lw 0.8 "
                   "dt 1 lc rgb '#999999'\n");
  figure_below(g, "%s %s_1 [%s]", quantity, name, unit);
  figure_set(g, "ylabel", "%s %s_2 [%s]", quantity, name, unit);
}

static hc_status plot_plane(plot_order *p, const scene *sc, const plot_motion *m)
{
  const char *const name = scene_contact_at(sc, m->first)->name;
  figure g = {0};
  char about[128];
  if (!contact_has_friction(&m->of->contacts->law))
    return figure_refuse(p, "the contact has no friction: there is no traction to draw");
  plane_history *w = calloc(1, sizeof *w);
  hc_status st = figure_open(&g, p, 1100, 580);
  if (st == HC_OK && !w) st = HC_NO_MEMORY;
  if (st == HC_OK) {
    /* The motion and the limit; no traction yet. */
    const contact *law = &m->of->contacts->law;
    const int n = series_length(m->of->n_harm);
    for (int i = 0; i <= POINTS; ++i) {
      const double c = cos(angle_of(i)), s = sin(angle_of(i)), v = series_at(m->of->n_harm, m->of->X + 2 * n, c, s).x;
      for (int d = 0; d < 2; ++d) w->u[d][i] = series_at(m->of->n_harm, m->of->X + d * n, c, s).x;
      w->limit[i] = law->mu * contact_normal(law, v);
      w->state[i] = CONTACT_SEPARATED;
    }
    st = m->of->circle ? evaluate_circle(m, w) : evaluate_square(m, w);
  }
  if (st == HC_OK) {
    /* w = u - T/kt, and where the slider started added to both. */
    for (int d = 0; d < 2; ++d)
      for (int i = 0; i <= POINTS; ++i) {
        w->u[d][i] += m->slider[d];
        w->w[d][i] = w->u[d][i] - w->t[d][i] / m->of->contacts->law.kt;
      }
    if (*name) snprintf(about, sizeof about, "contact %s", name);
    else snprintf(about, sizeof about, "contact %d", m->first);
    snprintf(about + strlen(about), sizeof about - strlen(about), "; exact law, limit: %s, along the given motion",
             m->of->circle ? "circle" : "square");
    panels_begin(&g, 1, 2, sc->title, about);
    double most, least;
    /* The largest and the smallest mu N; the smallest is 0 where it separates. */
    most = least = w->limit[0];
    for (int i = 0; i <= POINTS; ++i) most = fmax(most, w->limit[i]), least = fmin(least, w->limit[i]);
    axes(&g, "Traction in the plane", "traction", "T", sc->unit_force);
    put_loop(&g, 0, true, POINTS, w->state, w->t[0], w->t[1]);
    put_limit(&g, figure_look(&g, 4, "lw 1 dt 3 lc rgb '#555555'"), least < most ? "limit μ N at most" : "limit μ N",
              m->of->circle, most);
    if (least > 0 && least < most)
      put_limit(&g, figure_look(&g, 5, "lw 1 dt 4 lc rgb '#555555'"), "limit μ N at least", m->of->circle, least);
    figure_draw(&g);
    /* The ways of the motion and, while there is contact, of the slider; where it rests. */
    axes(&g, "Motion and slider", "motion", "u", sc->unit_length);
    figure_series(&g, "lines", figure_look(&g, 1, "lw 1.2 dt 3 lc rgb '#555555'"), "motion u");
    for (int i = 0; i <= POINTS; i += EVERY) figure_point(&g, w->u[0][i], w->u[1][i]);
    figure_series_end(&g);
    figure_series(&g, "lines", figure_look(&g, 2, "lw 2 dt 1 lc rgb '#D55E00'"), "slider w");
    for (int i = 0; i <= POINTS; ++i) {
      if (w->state[i] != CONTACT_SEPARATED) figure_point(&g, w->w[0][i], w->w[1][i]);
      else if (i > 0 && w->state[i - 1] != CONTACT_SEPARATED) figure_gap(&g);
    }
    figure_series_end(&g);
    figure_series(&g, "points", figure_look(&g, 3, "pt 7 ps 0.8 lc rgb '#0072B2'"), "slider at rest");
    for (int i = 0; i <= POINTS; ++i)
      if (w->state[i] == CONTACT_STICK && (i == 0 || w->state[i - 1] != CONTACT_STICK))
        figure_point(&g, w->w[0][i], w->w[1][i]);
    figure_series_end(&g);
    figure_draw(&g);
    panels_end(&g);
  }
  free(w);
  return figure_close(&g, st);
}

hc_status plot_contact(plot_order *p, const scene *sc, const plot_motion *m)
{
  return m->of->pair ? plot_plane(p, sc, m) : plot_loops(p, sc, m);
}
