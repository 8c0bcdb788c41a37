/* figure_contact.c - what the contacts do under a given motion: loops T over u, and the forces over the period. */
#include <math.h>
#include <stdlib.h>

#include "base/constants.h"
#include "command/plot/panels.h"
#include "hbm/exact_force.h"
#include "numerics/series.h"

enum { POINTS = 4096, EVERY = 8, MOST_DRAWN = 8 };

/* One contact along one period. */
typedef struct contact_history {
  double u[POINTS + 1], normal[POINTS + 1], t[POINTS + 1]; /* u [length], N and T [force] */
  contact_state state[POINTS + 1];
} contact_history;

/* The piece at th, or NULL: separated. A piece may begin before 0 or end after 2 pi. */
static const contact_piece *piece_at(const contact_piece *p, int n, double th)
{
  for (int i = 0; i < n; ++i)
    for (int turn = -1; turn <= 1; ++turn)
      if (th + turn * TWO_PI >= p[i].from && th + turn * TWO_PI <= p[i].to) return &p[i];
  return NULL;
}

/* The exact law, from the pieces that exact_force.h found: sticking, T = kt u - held; slipping, T = +-mu N. */
static void compute_history(const plot_motion *m, const moving_contact *c, const contact_piece *pieces, int n,
                            contact_history *out)
{
  for (int i = 0; i <= POINTS; ++i) {
    double th = TWO_PI * i / POINTS, v = 0;
    const contact_piece *p = piece_at(pieces, n, th);
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
    out->u[i] += m->slider;
  }
}

static const struct phase {
  const char *name, *title;
  int dash;
} phases[] = {{"stick", "sticks", 1}, {"slip", "slips", 2}, {"apart", "separated", 3}};
enum { N_PHASES = sizeof phases / sizeof *phases };

static int phase_of(contact_state st) { return st == CONTACT_STICK ? 0 : st == CONTACT_SEPARATED ? 2 : 1; }

/* Data block $stick3, ...: the loop of contact j in that phase. Returns the number of points; 0: never in it. */
static int write_phase(figure *g, const contact_history *w, int j, int phase)
{
  char name[24];
  int n = 0;
  snprintf(name, sizeof name, "%s%d", phases[phase].name, j);
  figure_block(g, name);
  for (int i = 0; i < POINTS; ++i) {
    bool mine = phase_of(w->state[i + 1]) == phase, next = i + 2 <= POINTS && phase_of(w->state[i + 2]) == phase;
    if (!mine) continue;
    bool begins = i == 0 || phase_of(w->state[i]) != phase;
    if (begins) figure_point(g, w->u[i], w->t[i]);
    if (!next || i % EVERY == 0) figure_point(g, w->u[i + 1], w->t[i + 1]);
    if (!next) figure_gap(g);
    ++n;
  }
  figure_block_end(g);
  return n;
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

static void loop_items(figure *g, int j, const int *there, bool only)
{
  static const char *const colours[] = {"#0072B2", "#D55E00", "#000000", "#009E73",
                                        "#CC79A7", "#E69F00", "#56B4E9", "#777777"};
  static const double widths[N_PHASES] = {2.4, 2.0, 2.0};
  for (int k = 0; k < N_PHASES; ++k) {
    char what[64], look[FIGURE_LOOK], of[32] = "";
    if (!there[k]) continue;
    if (!only) snprintf(of, sizeof of, "contact %d ", j);
    snprintf(what, sizeof what, "$%s%d using 1:2 with lines", phases[k].name, j);
    snprintf(look, sizeof look, "lw %g dt %d lc rgb '%s'", widths[k], phases[k].dash, colours[j]);
    if (g->letters) snprintf(look, sizeof look, "lt %d", N_PHASES * j + k + 1);
    figure_item(g, what, look, "%s%s", of, phases[k].title);
  }
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
static hc_status write_contacts(figure *g, const plot_motion *m, int n, int there[][N_PHASES], double closed[2])
{
  double F[SERIES_MAX_DIM * (2 * HBM_MAX_HARMONICS + 1)];
  exact_force *e = NULL;
  contact_history *w = malloc(sizeof *w);
  hc_status st = w ? exact_force_new(m->n_harm, m->n_dof, m->n_contacts, m->contacts, &e) : HC_NO_MEMORY;
  if (st == HC_OK) st = exact_force_eval(e, m->X, F, NULL, NULL);
  for (int j = 0, pieces; j < n && st == HC_OK; ++j) {
    const contact_piece *p = exact_force_pieces(e, j, &pieces);
    compute_history(m, &m->contacts[j], p, pieces, w);
    for (int k = 0; k < N_PHASES; ++k) there[j][k] = write_phase(g, w, j, k);
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

static void loops_and_forces(figure *g, const scene *sc, int n, int there[][N_PHASES], const double *closed)
{
  figure_script(
      g, "set title 'Hysteresis'\nset offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\nset zeroaxis lw 0.8 dt 1 "
         "lc rgb '#999999'\n");
  figure_below(g, "tangential motion u [%s]", sc->unit_length);
  figure_set(g, "ylabel", "tangential force T [%s]", sc->unit_force);
  set_window(g, closed);
  for (int j = 0; j < n; ++j) loop_items(g, j, there[j], n == 1);
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
  int n = m->n_contacts < MOST_DRAWN ? m->n_contacts : MOST_DRAWN, there[MOST_DRAWN][N_PHASES];
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
