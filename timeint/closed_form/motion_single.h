/* motion_single.h - the motion of a single mass between two changes of contact state, in closed form (modal_motion.h):
 * exact to rounding however long the interval is, where a power series takes steps. */
#pragma once

#include "numerics/base/workspace.h"
#include "timeint/closed_form/modal_motion.h"
#include "timeint/law/contact_track.h"

typedef struct motion_single {
  modal_motion motion;
  modal_point end;    /* end of the interval */
  int way;            /* sign of X' in the interval */
  modal_guard *guard; /* [TRACK_GUARDS n_contacts + 1] */
  int *of;            /* [TRACK_GUARDS n_contacts + 1] contact of each guard; -1: turn of X */
  track_event *event;
} motion_single;

/* True for one degree of freedom with loads of harmonics 0 and 1 only. */
bool motion_single_fits(const modal_base *base);

/* Arrays are memory's. HC_NO_MEMORY. */
hc_status motion_single_make(motion_single *s, const modal_base *base, workspace *memory);

/* The motion from X = y[0], X' = y[1] at theta to the first event or, if to_turn, the first turn of X, at most *span,
 * which becomes the time to it. *whose: the event's contact, -1: none. At a turn X' is set to exactly 0.
 * HC_NOT_FINITE. */
hc_status motion_single_go(motion_single *s, const scaled_model *m, const contact_track *track, double theta,
                           const double *y, bool to_turn, double *span, int *whose, track_event *event,
                           long *evaluations);

/* X and X' (order 0), or X' and X'' (order 1), at tau: out[2]. */
void motion_single_at(const motion_single *s, double tau, int order, double out[2]);

/* The integrals from y0 at theta0 to y1 at theta1, two points of one such motion; as motion_single_fourier. */
bool motion_single_integrals(const scaled_model *m, const contact_track *track, double theta0, const double *y0,
                             double theta1, const double *y1, double out[3]);

/* Integrals over the interval; false where the formulas would lose digits (modal_fourier). */
bool motion_single_fourier(const motion_single *s, double out[3]);
