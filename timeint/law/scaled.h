/* scaled.h - the dimensionless equations of a model in the phase theta = omega t, independent of solvers.
 *
 *     X = q/L,  P = dX/dtheta,  W_j = w_j/L     q: the modes of modal_base.h; L [length]: about the size of the motion
 *     X' = P
 *     P' = by_load p(theta) - by_C C P - by_K K X - sum_j [ t_j T_j + n_j (N_j - N0_j) ]
 *     W_j' = the slider of law_regularised.h, eta = regularisation kt/omega
 *     by_K = 1/omega^2, by_C = 1/omega, by_load = 1/(omega^2 L); kt, kn times s^2/omega^2: the mass is 1/s^2; gap by L
 *
 * Forces are in units of omega^2 L/s^2. N0 = max(kn gap, 0) + load is the exact preload, not softplus' value: at gap =
 * 0 the two differ to first order in the width, and so would the answer. Two directions of one contact under the law of
 * the circle are neighbours (model.h); T and W of both: law_kind.h.
 *
 * For the exact law the corner's width is 0, and X', P' of scaled_rhs are then exact for any state whose slider obeys
 * |T| <= mu N; the sliders' own motion is contact_track.h's. */
#pragma once

#include "model/model.h"
#include "timeint/law/law_kind.h"
#include "timeint/law/modal_base.h"
#include "timeint/transient_settings.h"

typedef struct scaled_model {
  int n, n_contacts, n_states; /* n_states = 2 n + n_contacts: n of X, n of P, W */
  const modal_base *base;      /* not owned */
  double by_K, by_C, by_load;
  bool by_rates;           /* a law depends on U' */
  scaled_contact *contact; /* [n_contacts] not owned, as are the next two */
  const double *vibration; /* [n_contacts] [length] vibration of v_j (state_sizes.h), to which the width of the corner
                              in N is proportional; NULL: L */
  const double *size;      /* [n_states] [L] sizes of states (state_sizes.h); NULL: 1 */
} scaled_model;

/* by_load of load l, times omega^2 for an inertial one. */
static inline double scaled_by_load(const scaled_model *m, int l)
{
  return m->by_load * model_load_factor(m->base->inertial[l], 1 / m->by_C);
}

/* The equations of *from at omega [rad/time] > 0, in lengths L = length > 0. The caller sets m->contact, with memory
 * for from->n_contacts contacts, m->base, that of *from, m->vibration and m->size; all else in *m is filled. */
void scaled_make(scaled_model *m, const model *from, const transient_settings *how, double omega, double length);

/* Unit of force of those equations [force]. */
double scaled_force_unit(const scaled_model *m, double omega, double length);

/* dy[n_states] at phase theta and state y[n_states]. True if all of it is finite. */
bool scaled_rhs(const scaled_model *m, double theta, const double *y, double *dy);

/* out[n] := by_load p(theta) - by_C C P - by_K K X: all forces but the contacts'. */
void scaled_linear_force(const scaled_model *m, double theta, const double *y, double *out);

/* The state of contact j at y: it slips if it is in contact and its slider moves. Two directions of a circle share a
 * state, CONTACT_SLIP_PLUS for any direction of slip. */
contact_state scaled_contact_state(const scaled_model *m, int j, const double *y);

/* The same for the contact with first direction j, from its law's value *at and its normal motion v. */
contact_state scaled_state_of(const scaled_model *m, int j, double v, const planar_value *at);

/* U and V of contact j at X = y[0..n-1]: u[] from direction j on to the contact's last one. */
void scaled_contact_motion(const scaled_model *m, int j, const double *x, double u[2], double *v);

/* The same, with the rates from X' = y[n..2n-1]. */
contact_motion scaled_motion_at(const scaled_model *m, int j, const double *y);

/* The first direction of the contact to which direction j belongs; its number of directions: 2 for a circle, else 1. */
static inline int scaled_first(const scaled_model *m, int j) { return j - m->contact[j].direction; }
static inline int scaled_directions(const scaled_model *m, int j) { return m->contact[j].kind->directions; }

double scaled_response(const scaled_model *m, int r, const double *x);
int scaled_n_responses(const scaled_model *m);

/* The length of contact j's tangent row: the acceleration by T = 1. */
double scaled_pull(const scaled_model *m, int j);
