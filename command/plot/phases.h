/* phases.h - private to command/plot/: a closed curve of a contact in parts, by what the contact does: sticks, slips or
 * is separated, each with its own dashes. */
#ifndef HC_PLOT_PHASES_H
#define HC_PLOT_PHASES_H

#include "command/plot/figure.h"
#include "model/contact_law.h"

enum {
  PHASES = 3,
  PHASES_EVERY = 8, /* of so many points one is drawn, beside the ends of a phase */
  PHASES_MOST_LOOPS = 8
};

/* Data block of loop j in that phase: (x, y) of points 0..n. How many of them are in it. */
int phases_write(figure *g, int j, int phase, int n, const contact_state *state, const double *x, const double *y);

/* Its items where there[phase] is not 0; only: the legend needs no number. */
void phases_items(figure *g, int j, const int there[PHASES], bool only);

#endif
