/* phases.c - see phases.h. */
#include "command/plot/phases.h"

static const struct phase {
  const char *name, *title;
  int dash;
  double width;
} phases[PHASES] = {{"stick", "sticks", 1, 2.4}, {"slip", "slips", 2, 2}, {"apart", "separated", 3, 2}};

static int phase_of(contact_state st) { return st == CONTACT_STICK ? 0 : st == CONTACT_SEPARATED ? 2 : 1; }

int phases_write(figure *g, int j, int phase, int n, const contact_state *state, const double *x, const double *y)
{
  char name[24];
  int found = 0;
  snprintf(name, sizeof name, "%s%d", phases[phase].name, j);
  figure_block(g, name);
  for (int i = 0; i < n; ++i) {
    const bool mine = phase_of(state[i + 1]) == phase, next = i + 2 <= n && phase_of(state[i + 2]) == phase;
    if (!mine) continue;
    const bool begins = i == 0 || phase_of(state[i]) != phase;
    if (begins) figure_point(g, x[i], y[i]);
    if (!next || i % PHASES_EVERY == 0) figure_point(g, x[i + 1], y[i + 1]);
    if (!next) figure_gap(g);
    ++found;
  }
  figure_block_end(g);
  return found;
}

void phases_items(figure *g, int j, const int there[PHASES], bool only)
{
  static const char *const colours[PHASES_MOST_LOOPS] = {"#0072B2", "#D55E00", "#000000", "#009E73",
                                                         "#CC79A7", "#E69F00", "#56B4E9", "#777777"};
  for (int k = 0; k < PHASES; ++k) {
    char what[64], look[FIGURE_LOOK], of[32] = "";
    if (!there[k]) continue;
    if (!only) snprintf(of, sizeof of, "contact %d ", j);
    snprintf(what, sizeof what, "$%s%d using 1:2 with lines", phases[k].name, j);
    snprintf(look, sizeof look, "lw %g dt %d lc rgb '%s'", phases[k].width, phases[k].dash, colours[j]);
    if (g->letters) snprintf(look, sizeof look, "lt %d", PHASES * j + k + 1);
    figure_item(g, what, look, "%s%s", of, phases[k].title);
  }
}
