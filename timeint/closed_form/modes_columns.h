/* modes_columns.h - many variations of a structure's motion at once, in a phase in which no contact changes its state:
 * what series_columns.h does, from the complex modes of the phase (interval_modes.h), over any span at once.
 *
 *     eta_k = by_x . D + by_v . D' - eta_k of where sliders that stick hold the variation
 *     D += sum_k Re V_k (e^{mu_k span} - 1) eta_k,   D' = sum_k Re V_k mu_k e^{mu_k span} eta_k */
#ifndef HC_TIMEINT_MODES_COLUMNS_H
#define HC_TIMEINT_MODES_COLUMNS_H

#include "timeint/closed_form/interval_modes.h"

typedef struct modes_columns { /* from modes_columns_make, to modes_columns_free */
  int n, n_columns;            /* modes of the structure; the most columns */
  double *change, *rate;       /* [2 n][2][n_columns] real and imaginary parts */
} modes_columns;

hc_status modes_columns_make(modes_columns *s, const modal_base *base); /* HC_NO_MEMORY; free it in any case */
void modes_columns_free(modes_columns *s);

/* count columns over `span`, contacts in the states of track[] and of the modes. The matrix as series_columns_advance
 * has it. */
void modes_columns_advance(modes_columns *s, const scaled_model *m, const complex_modes *modes,
                           const contact_track *track, double span, int count, int ld, double *matrix);

#endif
