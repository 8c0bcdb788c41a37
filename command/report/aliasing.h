/* aliasing.h - what the page's section on aliasing works with: the model, which the page solves itself wherever its
 * sliders stand (evaluator.js), and states solved here that the page's self test holds its own against.
 *
 *     each (H, omega):  the HBM solution X with exact forces and largest amplitude; its true harmonics F
 *     each N beside:    the harmonics that N samples of X's force give (aft.h); the true ones folding onto them,
 *                           F_h sampled = F_h + sum_m conj(F_{mN-h}) + F_{mN+h};      and the sampled equations'
 *                                                                                     own solution
 *     each parameter:   the amplitude with it changed */
#ifndef HC_REPORT_ALIASING_H
#define HC_REPORT_ALIASING_H

#include <jansson.h>

#include "base/status.h"
#include "casefile/scene.h"

enum { ALIASING_MOST_OMEGAS = 4 };

/* The model and the states at omega[n_omega], n_omega <= ALIASING_MOST_OMEGAS, of which omega[first] is shown first, as
 * JSON into *out, read by aliasing.js and selftest.js. A state without solution is null. By so many threads, with the
 * same states whatever their number; only the calling one ticks *monitor. HC_INTERRUPTED, HC_NO_MEMORY: *out is
 * NULL. */
hc_status aliasing_states(const scene *sc, int n_omega, const double *omega, int first, int jobs,
                          const hc_monitor *monitor, json_t **out);

#endif
