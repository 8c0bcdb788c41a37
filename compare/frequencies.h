/* frequencies.h - at which frequencies both sides are compared, and the sweep that covers them. */
#ifndef HC_FREQUENCIES_H
#define HC_FREQUENCIES_H

#include "compare/compare_settings.h"
#include "hbm/hbm.h"

/* The sweep, widened where an asked omega lies outside it. */
void comparison_sweep(double omega_from, double omega_to, const number_list *asked, double *from, double *to);

/* compare.omega, sorted and each once; or compare.points of them, equally spaced in the arc length of the curve plotted
 * as amplitude over omega, both scaled to 1: dense where the amplitude changes, as at peaks. */
hc_status comparison_frequencies(const compare_settings *where, double omega_from, hbm_solver *hbm,
                                 const hbm_curve *curve, number_list *out);

#endif
