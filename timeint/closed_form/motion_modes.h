/* motion_modes.h - the motion of a structure in an interval, from its complex modes (interval_modes.h): the same as
 * motion_series.h, but from one change of contact state to the next at once, however stiff the structure is.
 *
 *     eta_k(theta0 + tau) = c_k e^{mu_k tau} + fixed_k + sum_l (forward_kl e^{i h_l tau} + back_kl e^{-i h_l tau})
 * mu_k = lambda_k/omega; fixed_k is of constant contact forces, l are the loads. Whatever is linear in the motion is a
 * sum of exponentials (numerics/exponentials.h). Cancellation between the parts (a load at an undamped mode's
 * frequency, nearly dependent eigenvectors) is measured: if it is large, motion_modes_begin returns false. */
#pragma once

#include "numerics/exponentials.h"
#include "timeint/closed_form/interval_modes.h"

typedef struct motion_modes {
  const modal_base *base;
  const complex_modes *modes;
  double theta;                               /* [rad] start of the motion */
  exponentials e;                             /* [n_loads + 2 n] exponents i h_l, then mu_k */
  double complex *rate;                       /* [n_loads + 2 n] e.rate */
  double complex *c, *fixed, *forward, *back; /* [2 n], [2 n], [2 n][n_loads] twice */
  double complex *eta, *deta;                 /* [2 n] work: eta and its rate */
  exponential_sum *u, *v;                     /* [n_contacts] U and V as sums of exponentials */
  exponential_sum *response;                  /* [n_responses] */
  exponential_sum *guard;                     /* [TRACK_GUARDS n_contacts + 1]; [0] also: +-r' */
  int *of;                                    /* [TRACK_GUARDS n_contacts + 1] contact of each guard */
  track_event *event;
} motion_modes;

/* Arrays are memory's. HC_NO_MEMORY. */
hc_status motion_modes_make(motion_modes *mm, const modal_base *base, workspace *memory);

/* The motion from X = y[0..n-1], X' = y[n..2n-1] at theta; false: more than two digits would cancel. */
bool motion_modes_begin(motion_modes *mm, const complex_modes *modes, const scaled_model *m, const contact_track *track,
                        double theta, const double *y);

/* X and X' (order 0), or X' and X'' (order 1), at tau: out[2n]. */
void motion_modes_at(motion_modes *mm, double tau, int order, double *out);

/* The motion of contact j, in its `directions`, at tau. */
contact_motion motion_modes_contact(const motion_modes *mm, int j, int directions, double tau);

/* The first event up to *tau, which becomes its time; returns its contact, -1: none. */
int motion_modes_first_event(motion_modes *mm, const scaled_model *m, const contact_track *track, double *tau,
                             track_event *event);

/* Response i at tau; over tau0..tau1 its integrals times 1, cos(theta), sin(theta); its largest and least value. */
double motion_modes_response(const motion_modes *mm, int i, double tau);
void motion_modes_fourier(const motion_modes *mm, int i, double tau0, double tau1, double out[3]);
void motion_modes_extremes(motion_modes *mm, int i, double tau0, double tau1, double *max, double *min);
