/* hbm.h - harmonic balance of a model, all of its public functions: include this one.
 *
 *     x(t) ~ X[0] + sum_{h=1..H} X[2h-1] cos(h omega t) + X[2h] sin(h omega t)         (numerics/series.h)
 *
 * hbm_solver.h       a solver of a model; one solution at a fixed omega, and its measures
 * continuation.h     the response curve over a range of omega
 * response_curve.h   its points
 * contact_measures.h what each contact does: forces, slip path, dissipated work
 * between.h          every solution at an omega between the points, and the peak
 * predict.h          how far off a solution expects to be
 * stability.h        Floquet multipliers of a solution
 * special_points.h   turning points, period doublings, Neimark-Sacker points and contact changes of a curve
 *
 * Not here: time integration (timeint/), verdicts (compare/). */
#ifndef HC_HBM_H
#define HC_HBM_H

#include "hbm/between.h"
#include "hbm/contact_measures.h"
#include "hbm/continuation.h"
#include "hbm/hbm_solver.h"
#include "hbm/predict.h"
#include "hbm/response_curve.h"
#include "hbm/special_points.h"
#include "hbm/stability.h"

#endif
