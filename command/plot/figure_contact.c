/* figure_contact.c - what the contacts do under a given motion: loops T over u, and the forces over the period. */
#include <math.h>
#include <stdlib.h>

#include "base/constants.h"
#include "command/plot/panels.h"
#include "command/plot/phases.h"
#include "hbm/contact/exact_force.h"
#include "numerics/series.h"

enum { POINTS = 4096, EVERY = PHASES_EVERY, MOST_DRAWN = PHASES_MOST_LOOPS };

/* One contact along one period. */
typedef struct contact_history {
  double u[POINTS + 1], normal[POINTS + 1], t[POINTS + 1]; /* u [length], N and T [force] */
  contact_state state[POINTS + 1];
} contact_history;

/* The piece at th, or NULL: separated. A piece may begin before 0 or end after 2 pi. */
static const contact_interval *piece_at(const contact_interval *p, int n, double th)
{
  for (int i = 0; i < n; ++i)
    for (int turn = -1; turn <= 1; ++turn)
      if (th + turn * TWO_PI >= p[i].from && th + turn * TWO_PI <= p[i].to) return &p[i];
  return NULL;
}

/* The exact law, from the pieces that exact_force.h found: sticking, T = kt u - held; slipping, T = +-mu N. */
static void compute_history(const plot_motion *m, const moving_contact *c, const contact_interval *pieces, int n,
                            contact_history *out)
{
  for (int i = 0; i <= POINTS; ++i) {
    double th = TWO_PI * i / POINTS, v = 0;
    const contact_interval *p = piece_at(pieces, n, th);
    out->u[i] = 0;
    for (int d = 0; d < m->n_dof; ++d) {
      const double x = series_at(m->n_harm, m->X + d * series_length(m->n_harm), cos(th), sin(th)).x;
      out->u[i] += c->cu[d] * x;
      v += c->cv[d] * x;
    }
    out->normal[i] = contact_normal(&c->law, v);
    out->state[i] = p ? p->state : CONTACT_SEPARATED;
    out->t[i] = contact_slip_sign(out->state[i]) * c->law.mu * out->normal[i];
    if (out->state[i] == CONTACT_STICK) out->t[i] = c->law.kt * out->u[i] - p->held;
    out->u[i] += m->slider[0];
  }
}

static void write_forces(figure *g, const contact_history *w, const contact *c, int j)
{
  char name[24];
  snprintf(name, sizeof name, "forces%d", j);
  figure_block(g, name);
  for (int i = 0; i <= POINTS; i += EVERY)
    figure_script(g, "%.10g %.10g %.10g %.10g\n", (double)i / POINTS, w->t[i], w->normal[i], c->mu * w->normal[i]);
  figure_block_end(g);
}

static void force_items(figure *g, int n)
{
  for (int j = 0; j < n; ++j) {
    char what[64], look[FIGURE_LOOK], of[32] = "";
    if (n > 1) snprintf(of, sizeof of, " of contact %d", j);
    snprintf(what, sizeof what, "$forces%d using 1:3 with lines", j);
    figure_item(g, what, figure_line(g, 3 * j + 2, 1.8, look), "normal force N%s", of);
    snprintf(what, sizeof what, "$forces%d using 1:2 with lines", j);
    figure_item(g, what, figure_line(g, 3 * j, 2, look), "tangential force T%s", of);
    if (n > 1 || g->letters) continue;
    figure_item(g, "$forces0 using 1:4 with lines", "lw 1 dt 3 lc rgb '#555555'", "± μ N");
    figure_item(g, "$forces0 using 1:(-$4) with lines", "lw 1 dt 3 lc rgb '#555555'", NULL);
  }
}

static void widen_to_closed(double *closed, const contact_history *w)
{
  for (int i = 0; i <= POINTS; ++i) {
    if (w->state[i] == CONTACT_SEPARATED) continue;
    closed[0] = fmin(closed[0], w->u[i]);
    closed[1] = fmax(closed[1], w->u[i]);
  }
}

/* The data blocks of the first n contacts; there[j][phase]: points of the loop in that phase. */
static hc_status write_contacts(figure *g, const plot_motion *m, int n, int there[][PHASES], double closed[2])
{
  double F[SERIES_MAX_DIM * (2 * HBM_MAX_HARMONICS + 1)];
  exact_force *e = NULL;
  contact_history *w = malloc(sizeof *w);
  hc_status st = w ? exact_force_new(m->n_harm, m->n_dof, m->n_contacts, m->contacts, &e) : HC_NO_MEMORY;
  if (st == HC_OK) st = exact_force_eval(e, m->X, F, NULL, NULL);
  for (int j = 0, pieces; j < n && st == HC_OK; ++j) {
    const contact_interval *p = exact_force_intervals(e, j, &pieces);
    compute_history(m, &m->contacts[j], p, pieces, w);
    for (int k = 0; k < PHASES; ++k) there[j][k] = phases_write(g, j, k, POINTS, w->state, w->u, w->t);
    widen_to_closed(closed, w);
    write_forces(g, w, &m->contacts[j].law, j);
  }
  exact_force_free(e);
  free(w);
  return st;
}

/* The range of u while the contact is closed, with a margin: while it is open T = 0. */
static void set_window(figure *g, const double *closed)
{
  double wide = closed[1] - closed[0];
  if (wide > 0) figure_script(g, "set xrange [%.10g:%.10g]\n", closed[0] - 0.5 * wide, closed[1] + 0.25 * wide);
}

static void loops_and_forces(figure *g, const scene *sc, int n, int there[][PHASES], const double *closed)
{
  figure_script(
      g, "set title 'Hysteresis'\nset offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\nset zeroaxis lw 0.8 dt 1 "
         "lc rgb '#999999'\n");
  figure_below(g, "tangential motion u [%s]", sc->unit_length);
  figure_set(g, "ylabel", "tangential force T [%s]", sc->unit_force);
  set_window(g, closed);
  for (int j = 0; j < n; ++j) phases_items(g, j, there[j], n == 1);
  figure_draw(g);
  figure_below(g, "t / T");
  figure_script(g, "set title 'Forces over the period'\nset xrange [0:1]\nset offsets 0, 0, graph 0.03, graph 0.03\n");
  figure_set(g, "ylabel", "force [%s]", sc->unit_force);
  force_items(g, n);
  figure_draw(g);
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

hc_status plot_contact(plot_order *p, const scene *sc, const plot_motion *m)
{
  figure g = {0};
  int n = m->n_contacts < MOST_DRAWN ? m->n_contacts : MOST_DRAWN, there[MOST_DRAWN][PHASES];
  double closed[2] = {INFINITY, -INFINITY}; /* u while some contact is closed */
  char about[128];
  if (n == 0) {
    snprintf(p->why, sizeof p->why, "there is no contact to draw");
    return HC_BAD_INPUT;
  }
  hc_status st = figure_open(&g, p, 1100, 500);
  if (st == HC_OK) st = write_contacts(&g, m, n, there, closed);
  if (st == HC_OK) {
    panels_begin(&g, 1, 2, sc->title, say_which(sc, m, n, about, sizeof about));
    loops_and_forces(&g, sc, n, there, closed);
    panels_end(&g);
  }
  return figure_close(&g, st);
}
