/* planar_slip.h - a contact of two tangents while it slips: the direction phi of its traction by collocation,
 *
 *     R phi' = u'.e_perp(phi),     until s = u'.e(phi) - R' falls through 0, or contact ends
 *
 * on panels (numerics/collocation.h) so short that phi's slope is resolved: its last two Legendre coefficients, times
 * the width, are at most PLANAR_RESOLVED rad. Integrals over a panel, and phi at its end, then have about the square of
 * that error (superconvergence: error of phi times that of the test functions): 1e-15. Between the points the error of
 * phi is PLANAR_RESOLVED. libm only, nothing is allocated. */
#pragma once

#include <stdbool.h>

#include "hbm/planar/planar_motion.h"
#include "numerics/base/status.h"
#include "numerics/collocation.h"

#define PLANAR_RESOLVED 3e-8
#define PLANAR_ROUGH    1e-4 /* [rad] the same for a first pass of which only the end is used */

typedef struct planar_panel {
  double from, to;                                         /* [rad] */
  double phi0;                                             /* [rad] at `from`; at `to` it is phi[last] */
  double phi[COLLOCATION_POINTS];                          /* [rad] at from + (to - from) x[i] */
  double slope[COLLOCATION_POINTS];                        /* phi' there */
  double du[2][COLLOCATION_POINTS], R[COLLOCATION_POINTS]; /* [length] u' and R there */
  double slope_growth[COLLOCATION_POINTS];                 /* d slope/d phi0 for a given motion */
  double growth;                                           /* d phi[last]/d phi0 */
} planar_panel;

/* phi [rad] anywhere on the panel. */
double planar_panel_angle(const collocation *c, const planar_panel *p, double th);

/* cos phi and sin phi at its points. */
void planar_panel_directions(const planar_panel *p, double cosine[COLLOCATION_POINTS], double sine[COLLOCATION_POINTS]);

typedef struct planar_slip {
  const collocation *c;
  const planar_motion *m;
  double width;    /* [rad] width to try for the next panel; 0: none yet */
  double part;     /* [1] largest width to try, as a fraction of the angle left until lift-off */
  double resolved; /* [rad] required resolution: PLANAR_RESOLVED or PLANAR_ROUGH */
  planar_panel *panel;
  int n, cap; /* number of panels; capacity */
} planar_slip;

typedef struct slip_end {
  planar_point at;
  double phi;
  bool rests; /* true: s fell to 0 there, stick follows; false: slip up to the end */
} slip_end;

/* Slip from `from` in direction phi until s falls to 0, or until `to`, where R = 0 if lifts_off. At touch-down (R = 0
 * at `from`) phi must be the direction of u'. Panels are appended. HC_CHATTER: more panels than the capacity.
 * HC_NOT_CONVERGED: the last panel could not be shortened. */
hc_status planar_slip_follow(planar_slip *s, const planar_point *from, double phi, double to, bool lifts_off,
                             slip_end *end);

/* phi' at a point of slip in direction phi; at touch-down (R = 0) that of the regular branch. */
double planar_slip_slope(const planar_motion *m, const planar_point *p, double phi);

/* s = u'.e - R' and its derivative. */
double planar_slip_speed(const planar_point *p, double phi);
double planar_slip_acceleration(const planar_motion *m, const planar_point *p, double phi);
