/* hbm.h - harmonic balance of a model, all of its public functions: include this one.
 *
 *     x(t) ~ X[0] + sum_{h=1..H} X[2h-1] cos(h omega t) + X[2h] sin(h omega t)         (numerics/series.h)
 *
 * hbm_solver.h       a solver of a model; one solution at a fixed omega, and its measures
 * rests.h            solutions by where sliders rest that never slip
 * continuation.h     the response curve over a range of omega
 * response_curve.h   its points
 * segment.h          every solution at an omega between the points, and the peak
 * contact_measures.h what each contact does: forces, slip path, dissipated work
 * predict.h          how far off a solution expects to be
 * stability.h        Floquet multipliers of a solution
 * special_points.h   turning points, period doublings, Neimark-Sacker points, broken symmetries, contact changes
 *
 * Not here: time integration (timeint/), verdicts (compare/). */
#pragma once

#include "hbm/contact/contact_measures.h"
#include "hbm/curve/continuation.h"
#include "hbm/curve/predict.h"
#include "hbm/curve/response_curve.h"
#include "hbm/curve/segment.h"
#include "hbm/curve/special_points.h"
#include "hbm/solver/hbm_solver.h"
#include "hbm/solver/rests.h"
#include "hbm/solver/stability.h"
