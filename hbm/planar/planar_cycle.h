/* planar_cycle.h - one period of a contact of two tangents with one limit, from a motion: when it sticks and slips, and
 * the closed orbit of its slider.
 *
 * If contact is lost, touch-down puts the slider at w = u and one pass is enough. Else it rests if it can
 * (planar_rest.h). If not, it slips in every period. A pass maps w(0) to w(2 pi) without increasing distances, since w
 * is swept by a moving convex set (Moreau 1977, J. Differential Equations 26, 347-374); unlike with one tangent,
 * periods repeat only in the limit. So the closed orbit is found by Newton on w(0), with the 2x2 derivative of the
 * pass; the first pass, whose error the second one nearly forgets, is a rough one; the last step may be applied to
 * first order (planar_cycle.c). libm only, nothing is allocated. */
#pragma once

#include "hbm/planar/planar_motion.h"
#include "hbm/planar/planar_rest.h"
#include "hbm/planar/planar_slip.h"
#include "numerics/base/status.h"

/* Start of an interval: start of the period (w = w0, moved into the circle), touch-down (w = u), or end of the previous
 * interval. */
typedef enum planar_begin { PLANAR_STARTS, PLANAR_TOUCHES, PLANAR_GOES_ON } planar_begin;

/* An interval of the period in one state; an angle that no interval covers is separated. */
typedef struct planar_interval {
  double from, to;     /* [rad] from < to <= from + 2 pi */
  contact_state state; /* CONTACT_STICK, or CONTACT_SLIP_PLUS whatever the direction of slip */
  planar_begin begin;
  double w[2];         /* [length] slider position; valid for CONTACT_STICK */
  int panel, n_panels; /* index of its first panel in slip.panel, and their number; valid while it slips */
} planar_interval;

/* An interval of contact [rad]; 0 to 2 pi if it never ends. */
typedef struct planar_contact {
  double from, to;
} planar_contact;

typedef struct planar_cycle {
  const planar_motion *m;
  const planar_point *grid; /* of planar_motion_grid */
  bool always;              /* in contact all period: then n_contacts is 1 */
  bool asked;               /* rest at w = 0 was asked for (planar_rest.h) */
  bool may_shift;           /* the last step of Newton may be applied to first order (planar_cycle.c) */
  int n_contacts;
  const planar_contact *contact; /* [n_contacts] ascending */
  planar_interval *interval;     /* [cap] of which n are valid */
  int n, cap;                    /* intervals found; capacity */
  planar_slip slip;              /* holds the panels of all slip intervals */
  double start[2];               /* [length] w0, start of the last pass before it is moved into the circle; valid if
                                    `always` */
  planar_rest rest;              /* if rest.exists it rests there all period, and n is 1 */
  int changes;                   /* number of changes of state in this pass, to recognise chatter */
} planar_cycle;

/* The intervals of one period on the closed orbit. HC_CHATTER: more intervals or panels than the capacity, or more than
 * 64 (H + 1) changes of state. HC_NOT_CLOSED: the slider does not return to its place a period before.
 * HC_NOT_CONVERGED. */
hc_status planar_cycle_find(planar_cycle *c);

/* w [length] at th = 0. */
void planar_cycle_slider(const planar_cycle *c, double w[2]);
