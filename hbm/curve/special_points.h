/* special_points.h - where a response curve changes its nature. */
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
  /* [rad/time] How far away it may be by the error of its multipliers (predict.h), to first order; INFINITY: nobody
   * knows. 0 of turning points, which are the equations' own, and of contact changes. */
  double omega_error;
} hbm_special;

/* All of them in the curve's order, located to 1e-9 of omega or better (to 1e-6 at a join of rest and slip): *out [*n],
 * to be freed by the caller, whatever the status. Those of a kind that this cannot tell apart are one, or none if they
 * undo each other. Two between neighbouring points are found where multipliers go down towards them on either side, and
 * hbm_stability_error_is_costly says no. One that
 * could not be located makes the status, and leaves the others in place. */
hc_status hbm_specials(hbm_solver *s, const hbm_curve *curve, hbm_special **out, int *n);

/* Where there are more than 24 contacts (directions, where two belong to one) some pattern changes on every bit of a
 * curve: a contact change is then one of the strongest state of all of them. */
bool hbm_specials_follow_each(const hbm_solver *s);
