/* frequencies.h - at which frequencies a scene is compared, and the sweep that covers them. */
#ifndef HC_FREQUENCIES_H
#define HC_FREQUENCIES_H

#include "hbm/hbm.h"
#include "model/scene.h"

/* The scene's sweep, widened where an asked omega lies outside it. */
void comparison_sweep(const scene *sc, const scene_list *asked, double *from, double *to);

/* compare.omega, sorted and each once; or compare.points of them, equally far apart along the curve drawn as
 * amplitude over omega (both scaled to 1), which puts them where the response changes: dense at peaks. */
hc_status comparison_frequencies(const scene *sc, hbm_solver *hbm, const hbm_curve *curve, scene_list *out);

#endif
