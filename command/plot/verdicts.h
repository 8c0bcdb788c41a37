/* verdicts.h - points drawn by their verdict: private to command/plot/. */
#ifndef HC_PLOT_VERDICTS_H
#define HC_PLOT_VERDICTS_H

#include "command/plot/figure.h"

enum { VERDICTS_MOST = 16 };

/* Points by verdict, in order of appearance. */
typedef struct verdicts {
  int n, count[VERDICTS_MOST];
  char name[VERDICTS_MOST][24];
} verdicts;

/* The place of a verdict, a new one if there is room. */
int verdicts_place(verdicts *v, const char *name);

/* An item for each, from the data blocks $verdict0, $verdict1, ..., in the legend as "OF: match (12)". */
void verdicts_items(figure *g, const verdicts *v, const char *of);

#endif
