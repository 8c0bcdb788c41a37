/* verdicts.c - see verdicts.h. */
#include "command/plot/verdicts.h"

#include <string.h>

/* Open shapes where both sides agree, filled ones and crosses where not; all can be told apart without colour. */
static const struct verdict_look {
  const char *name, *look;
} looks[] = {
    {"match", "pt 6 ps 1.2 lw 1.6 lc rgb '#D55E00'"},
    {"settled", "pt 6 ps 1.2 lw 1.6 lc rgb '#D55E00'"},
    {"differs", "pt 5 ps 1.0 lc rgb '#000000'"},
    {"other_branch", "pt 8 ps 1.2 lw 1.6 lc rgb '#009E73'"},
    {"unstable", "pt 2 ps 1.1 lw 1.8 lc rgb '#000000'"},
    {"aperiodic", "pt 3 ps 1.2 lw 1.4 lc rgb '#CC79A7'"},
    {"not_settled", "pt 1 ps 1.2 lw 1.8 lc rgb '#E69F00'"},
    {"solver_failed", "pt 10 ps 1.2 lw 1.6 lc rgb '#555555'"},
    {"skipped", "pt 7 ps 0.4 lc rgb '#999999'"},
    {"period_k", "pt 12 ps 1.3 lw 1.6 lc rgb '#CC79A7'"},
};
enum { N_LOOKS = sizeof looks / sizeof *looks };

static int verdict_look_of(const char *name)
{
  for (int i = 0; i < N_LOOKS; ++i)
    if (!strcmp(looks[i].name, name)) return i;
  return N_LOOKS - 1; /* period_2, period_3, ... */
}

int verdicts_place(verdicts *v, const char *name)
{
  int i = 0;
  while (i < v->n && strcmp(v->name[i], name)) ++i;
  if (i == v->n && v->n < VERDICTS_MOST) snprintf(v->name[v->n++], sizeof v->name[0], "%s", name);
  return i < VERDICTS_MOST ? i : VERDICTS_MOST - 1;
}

void verdicts_items(figure *g, const verdicts *v, const char *of)
{
  for (int i = 0; i < v->n; ++i) {
    char what[64], look[FIGURE_LOOK];
    int k = verdict_look_of(v->name[i]);
    snprintf(what, sizeof what, "$verdict%d using 1:2 with points", i);
    figure_item(g, what, g->letters ? figure_look(g, "", 10 + k, look) : looks[k].look, "%s: %s (%d)", of, v->name[i],
                v->count[i]);
  }
}
