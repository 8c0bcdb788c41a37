/* planar_slip.h - a contact of two tangents while it slips: the direction phi of its traction by collocation,
 *
 *     R phi' = u'.e_perp(phi),     until s = u'.e(phi) - R' falls through 0, or contact ends
 *
 * on panels (numerics/collocation.h) so short that phi's slope is resolved: its last two Legendre coefficients, times
 * the width, are at most PLANAR_RESOLVED rad. What is integrated over a panel, and phi at its end, is then better by
 * about the square of that (superconvergence: the error is that of phi times that of the functions it is integrated
 * with): 1e-15. Between the points phi is good to PLANAR_RESOLVED. libm only, nothing is allocated. */
#pragma once

#include <stdbool.h>

#include "hbm/planar/planar_motion.h"
#include "numerics/base/status.h"
#include "numerics/collocation.h"

#define PLANAR_RESOLVED 3e-8
#define PLANAR_ROUGH    1e-4 /* [rad] for a pass of which nothing is kept but its end */

typedef struct planar_panel {
  double from, to;                                         /* [rad] */
  double phi0;                                             /* [rad] at `from`; at `to` it is phi[last] */
  double phi[COLLOCATION_POINTS];                          /* at from + (to - from) x[i] */
  double slope[COLLOCATION_POINTS];                        /* phi' there */
  double du[2][COLLOCATION_POINTS], R[COLLOCATION_POINTS]; /* [length] u' and R there */
  double slope_growth[COLLOCATION_POINTS];                 /* d slope/d phi0, the motion being given */
  double growth;                                           /* d phi[last]/d phi0 */
} planar_panel;

/* phi [rad] anywhere on the panel. */
double planar_panel_angle(const collocation *c, const planar_panel *p, double th);

/* cos phi and sin phi at its points. */
void planar_panel_directions(const planar_panel *p, double cosine[COLLOCATION_POINTS], double sine[COLLOCATION_POINTS]);

typedef struct planar_slip {
  const collocation *c;
  const planar_motion *m;
  double width;    /* [rad] of the next panel to try; 0: none yet */
  double part;     /* [1] of what is left until lift-off, the most to try */
  double resolved; /* [rad] PLANAR_RESOLVED, or more where less will do */
  planar_panel *panel;
  int n, cap; /* panels made, and room for them */
} planar_slip;

typedef struct slip_end {
  planar_point at;
  double phi;
  bool rests; /* s fell through 0 there: it sticks; else it slipped all the way */
} slip_end;

/* Slip from `from` in direction phi until it rests or until `to`, where R is 0 if lifts_off. Of touch-down (R = 0 at
 * `from`) phi is the direction of u'. Panels are appended. HC_CHATTER: no room for more of them. */
hc_status planar_slip_follow(planar_slip *s, const planar_point *from, double phi, double to, bool lifts_off,
                             slip_end *end);

/* phi' at a point of slip in direction phi; of touch-down on the branch that is regular there. */
double planar_slip_slope(const planar_motion *m, const planar_point *p, double phi);

/* s = u'.e - R' and its derivative. */
double planar_slip_speed(const planar_point *p, double phi);
double planar_slip_acceleration(const planar_motion *m, const planar_point *p, double phi);
