/* adapt.h - hbm.harmonics: auto and hbm.samples: auto along a curve. */
#ifndef HC_HBM_ADAPT_H
#define HC_HBM_ADAPT_H

#include "hbm/curve/path.h"

/* As many harmonics as the last point needs. HC_OK once the estimated error (refine.h) meets hbm.accuracy, or where no
 * finer equations are to be had (curve->inaccurate), or with p->more_samples set when the curve must start again.
 * Fewer harmonics again after several points in a row whose highest ones would not show. Does nothing where the
 * settings give both numbers. HC_NO_MEMORY, or why no point could be solved for with the finer equations. */
hc_status adapt_to_accuracy(path *p);

/* The curve's rows cut to the harmonics it needed, and the solver set to them: what is solved on the curve later (an
 * omega between its points, the peak) must not have fewer. HC_NO_MEMORY. */
hc_status adapt_finish(hbm_solver *s, hbm_curve *c);

#endif
