/* special_points.h - turning points, bifurcations and contact changes of a response curve. */
#pragma once

#include "hbm/curve/response_curve.h"

typedef enum hbm_special_kind {
  HBM_TURNING_POINT,
  HBM_PERIOD_DOUBLING,
  HBM_CONTACT_CHANGE,
  HBM_NEIMARK_SACKER,   /* a complex pair of multipliers passes the unit circle: a motion of two frequencies begins */
  HBM_SYMMETRY_BREAKING /* a multiplier passes +1 without a turn, of smooth laws: two motions begin, each the other's
                           mirror image half a period later */
} hbm_special_kind;
typedef struct hbm_special {
  hbm_special_kind kind;
  double omega, amplitude;      /* [rad/time], [length] */
  int branch;                   /* as in hbm_point; a turning point belongs to the branch that it ends */
  contact_regime before, after; /* along the curve; the same where only the number of transitions changes */
  /* [rad/time] Error of omega due to the error of the multipliers (predict.h), to first order; INFINITY: unknown. 0 for
   * turning points and symmetry breaking, which follow from the equations themselves, and for contact changes. */
  double omega_error;
} hbm_special;

/* All of them in the curve's order, located to 1e-9 of omega or better (to 1e-6 at a join of rest and slip): *out [*n],
 * to be freed by the caller, whatever the status. Points of one kind closer than that are merged into one, or dropped
 * if they cancel. Two of one kind between neighbouring points are found where the test function approaches 0 from both
 * sides, and only if hbm_stability_error_is_costly is false. The status is that of the last point that could not be
 * located; the others are in *out. */
hc_status hbm_specials(hbm_solver *s, const hbm_curve *curve, hbm_special **out, int *n);

/* False for more than 24 contacts (directions, where two belong to one): their patterns change almost everywhere along
 * the curve, so only a change of the strongest regime of all contacts is reported. */
bool hbm_specials_follow_each(const hbm_solver *s);
