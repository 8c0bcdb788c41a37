/* aliasing.h - the answers that the page's section on aliasing chooses among: for each normal stiffness, H and omega
 *
 *     the HBM solution X with exact forces and largest amplitude, its force over the period, the true harmonics F;
 *     for each N the harmonics that N samples of X's force give (aft.h), sampled minus true; the first true ones that
 *     fold onto them, F_h sampled = F_h + sum_m conj(F_{mN-h}) + F_{mN+h}; the sampled equations' own solution */
#ifndef HC_REPORT_ALIASING_H
#define HC_REPORT_ALIASING_H

#include <jansson.h>

#include "base/status.h"
#include "casefile/scene.h"

enum { ALIASING_MOST_OMEGAS = 4 };

/* The answers at omega[n_omega], n_omega <= ALIASING_MOST_OMEGAS, as JSON into *out, read by aliasing.js; with another
 * stiffness than the case's at omega[first] alone, which is shown first. By so many threads, with the same answers
 * whatever their number; only the calling one ticks *monitor. HC_INTERRUPTED, HC_NO_MEMORY: *out is NULL. */
hc_status aliasing_answers(const scene *sc, int n_omega, const double *omega, int first, int jobs,
                           const hc_monitor *monitor, json_t **out);

#endif
