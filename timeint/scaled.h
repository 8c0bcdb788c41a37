/* scaled.h - the equations of a model in the phase theta = omega t, without dimensions; no solver is known here.
 *
 *     X = x/L,  P = dX/dtheta,  W_j = w_j/L          L [length]: about the size of the motion, so states are about 1
 *     X' = P
 *     P' = f cos(theta) - c P - k X - sum_j [ T_j cos(alpha_j) + (N_j - N0_j) sin(alpha_j) ]
 *     W_j' = the slider of law_regularised.h, eta = regularisation kt/omega
 *     k = K/(M omega^2), c = C/(M omega), f = F0/(M omega^2 L); kt, kn divided by M omega^2, gap by L
 *
 * Forces are in units of M omega^2 L. N0 = max(kn gap, 0) is the exact preload, not softplus' of it: at gap = 0 the
 * two differ to first order in the width, and a constant force would show in the answer to first order too.
 *
 * For the exact law the corner's width is 0, and X', P' of scaled_rhs are then exact for any state whose slider obeys
 * |T| <= mu N; the sliders' own motion is integrate_exact.c's. */
#ifndef HC_TIMEINT_SCALED_H
#define HC_TIMEINT_SCALED_H

#include "model/model.h"
#include "timeint/law_regularised.h"
#include "timeint/transient_settings.h"

enum { SCALED_X, SCALED_P, SCALED_W }; /* order of the states: X, P, then W_j of contact j at SCALED_W + j */

typedef struct scaled_contact {
  law_regularised law; /* without dimensions */
  double cosine, sine; /* of the contact's angle */
  double preload;      /* N0 */
} scaled_contact;

typedef struct scaled_model {
  int n_contacts, n_states; /* n_states = 2 + n_contacts */
  double k, c, f;
  scaled_contact *contact; /* [n_contacts], memory of whoever owns the scaled_model */
} scaled_model;

/* The equations of *from at omega [rad/time] > 0, in lengths L = length > 0. m->contact points at memory for
 * from->n_contacts contacts; it is filled, and everything else in *m is set. */
void scaled_make(scaled_model *m, const model *from, const transient_settings *how, double omega, double length);

/* dy[n_states] at phase theta and state y[n_states]. Answers whether all of it is finite. */
bool scaled_rhs(const scaled_model *m, double theta, const double *y, double *dy);

/* jac[n_states * n_states], column by column: d dy[i] / d y[j] at jac[i + j n_states]. */
void scaled_jacobian(const scaled_model *m, const double *y, double *jac);

/* Does contact j slip at y: in contact and |T| > mu N? */
bool scaled_slips(const scaled_model *m, int j, const double *y);

#endif
