/* panels.h - private to command/plot/: several panels in one drawing, and parts of one figure that another file
 * draws. */
#ifndef HC_PLOT_PANELS_H
#define HC_PLOT_PANELS_H

#include "command/plot/figure.h"

/* Several plots in one drawing, row by row; in a drawing of letters one below the other. */
void panels_begin(figure *g, int rows, int columns, const char *title, const char *about);
void panels_end(figure *g);

/* Heat map over N x H, error over N, error over H: three panels. */
void panels_accuracy(figure *g, const accuracy *a);

#endif
