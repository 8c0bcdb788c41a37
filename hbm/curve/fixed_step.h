/* fixed_step.h - one step of the plainest arc-length continuation. Method: fixed_step.c. */
#ifndef HC_HBM_FIXED_STEP_H
#define HC_HBM_FIXED_STEP_H

#include "hbm/curve/path.h"

/* Predict and correct the next point of the curve into p's trial. HC_OK, and accepted; HC_NOT_CONVERGED where
 * hbm.iterations of Newton's were not enough, or another error of hbm_solve_plane and hbm_tangent_plane. */
hc_status fixed_step(path *p, bool *accepted);

#endif
