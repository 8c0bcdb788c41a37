/* orbit_events.h - the changes of contact state along the periods that a steady state of the exact law repeats, and
 * where the sliders that never slip may rest. What a certificate is made of: found to rounding, not proven. */
#pragma once

#include "timeint/steady/steady.h"

/* Event i: from t[i] on the contacts are in the states of row i, until t[i + 1]; after the last as before the first.
 * Where nothing ever changes there is one, at t = 0. Events closer than 1e-11 of a period are one. Models without the
 * law of the circle. */
typedef struct orbit_events {
  int n, n_dof, n_contacts;
  double *t;             /* [n] [time] ascending, 0 <= t < k periods */
  double *x, *v;         /* [n][n_dof] [length], [length/time] there */
  contact_state *states; /* [n][n_contacts] */
  /* [n_contacts] [length] of contacts with friction that stick all the time: where the slider is, and between what
   * places it could be without ever slipping along this motion; others NaN */
  double *rest, *lowest, *highest;
} orbit_events;

/* The events of the k periods of this handle's last result. Free with orbit_events_free in any case. HC_NO_MEMORY,
 * errors of integration; HC_UNSUPPORTED: the law is not the exact one of lines. */
hc_status timeint_events(timeint *ti, int k, orbit_events *out);
/* The events of one period of the motion from `state`, which need be no orbit, after that many others; one at t = 0
 * wherever the period ends in other states than it began. */
hc_status timeint_motion_events(timeint *ti, double omega, const double *state, int after, orbit_events *out);
void orbit_events_free(orbit_events *e);
