/* planar_cycle.h - one period of a contact of two tangents with one limit, from a motion: when it sticks and slips,
 * and the closed orbit of its slider.
 *
 * Where contact is lost, touch-down puts the slider at w = u and one pass is enough. Else it rests where it can
 * (planar_rest.h). Where it cannot, it slips in every period. A pass maps w(0) to w(2 pi) without expanding distances,
 * for w is dragged by a moving convex set (Moreau 1977, J. Differential Equations 26, 347-374); that is no clamp, and
 * repeats itself in the limit only. So the closed orbit is found by Newton on w(0), with the 2x2 derivative of the
 * pass; the first pass, of which the second forgets nearly all, is a rough one, and the last step is to first order
 * where that is wanted (planar_cycle.c). libm only, nothing is allocated. */
#pragma once

#include "hbm/planar/planar_motion.h"
#include "hbm/planar/planar_rest.h"
#include "hbm/planar/planar_slip.h"
#include "numerics/base/status.h"

/* What an interval begins with: the period (w = w0, put into the circle), touch-down (w = u), or the end of the
 * interval before it. */
typedef enum planar_begin { PLANAR_STARTS, PLANAR_TOUCHES, PLANAR_GOES_ON } planar_begin;

/* An interval of the period in one state; an angle that no interval covers is separated. */
typedef struct planar_interval {
  double from, to;     /* [rad] from < to <= from + 2 pi */
  contact_state state; /* CONTACT_STICK, or CONTACT_SLIP_PLUS whatever the direction of slip */
  planar_begin begin;
  double w[2];         /* [length] the slider while it sticks */
  int panel, n_panels; /* of the cycle's panels, while it slips */
} planar_interval;

/* An interval of contact, [rad]; of one that lasts for ever from 0 to 2 pi. */
typedef struct planar_contact {
  double from, to;
} planar_contact;

typedef struct planar_cycle {
  const planar_motion *m;
  const planar_point *grid; /* of planar_motion_grid */
  bool always;              /* never separated: then n_contacts is 1 */
  bool may_shift;           /* the last step to where it closes may be to first order */
  int n_contacts;
  const planar_contact *contact; /* [n_contacts] ascending */
  planar_interval *interval;     /* [cap] room */
  int n, cap;                    /* intervals found */
  planar_slip slip;              /* its panels */
  double start[2];               /* [length] w0: where the last pass began, not yet put into the circle; if `always` */
  planar_rest rest;              /* `exists`: it rests there for the whole period, which is its one interval */
  int changes;                   /* of state in this pass, to recognise chatter */
} planar_cycle;

/* The intervals of one period on the closed orbit. HC_CHATTER: more intervals or panels than there is room for, or
 * 64 (H + 1) changes of state. HC_NOT_CLOSED: the slider is not where it was a period before. HC_NOT_CONVERGED. */
hc_status planar_cycle_find(planar_cycle *c);

/* w [length] at th = 0. */
void planar_cycle_slider(const planar_cycle *c, double w[2]);
