/* model.h - what is simulated: a structure of n degrees of freedom, and contacts between them.
 *
 *     M x'' + C x' + K x + sum_j [ t_j T_j + n_j (N_j - N0_j) ] = sum_k p_k cos(k omega t) + q_k sin(k omega t)
 *     u_j = t_j . x   tangential motion        v_j = n_j . x   normal motion        (t_j, n_j: directions in x)
 *     response r = r . x                                                            (what is reported of the motion)
 *
 * x [length] is measured from where the structure rests without its static loads (k = 0); the contact law (T, N) is
 * contact_law.h's. Any consistent set of units. M is symmetric and positive definite; C and K are any real matrices,
 * and K may be singular. A model owns its memory. Solvers read it and never change it. How it is solved stands in
 * hbm/hbm_settings.h and timeint/transient_settings.h. Source: Colonna et al. 2025, eq. 1-12 ([1] in README.md), for
 * n = 1; Krack and Gross, Harmonic Balance for Nonlinear Vibration Problems, Springer 2019, chapter 3, for more. */
#pragma once

#include <stdbool.h>

#include "model/contact_law.h"
#include "numerics/base/status.h"

/* A contact with two tangents is two neighbours in the list, one for each tangent: of the same law and normal, each
 * with half of kn and load and twice mu. So mu N of either is the contact's, their normal forces add up to the
 * contact's, and all that is linear needs to know nothing of it. Under the square law |T_1|, |T_2| <= mu N they are two
 * contacts and nothing else; under that of the circle |(T_1, T_2)| <= mu N the limit is theirs together. */
/* A contact that is several springs across it (a table of forces) is one ALONE, and behind it its others: MORE. */
typedef enum contact_pair { CONTACT_ALONE, CONTACT_FIRST, CONTACT_SECOND, CONTACT_MORE } contact_pair;

/* Does it belong to the contact of the case that the one before it does? */
static inline bool contact_goes_on(contact_pair pair) { return pair >= CONTACT_SECOND; }

typedef struct model_contact {
  contact law;
  double *tangent, *normal; /* [n] [1] u = tangent . x, v = normal . x; all 0 where the contact has no such direction */
  contact_pair pair;
  bool circle; /* of a pair, on both: the law of the circle */
} model_contact;

/* cosine cos(k omega t) + sine sin(k omega t), k = harmonic >= 0: one load for each k. That of a base that moves by
 * A cos(omega t) is omega^2 times M r A, x being the motion relative to it: inertial. */
typedef struct model_load {
  int harmonic;
  bool inertial;         /* omega^2 times what follows */
  double *cosine, *sine; /* [n] [force]; [force time^2] of an inertial one */
} model_load;

static inline double model_load_factor(bool inertial, double omega) { return inertial ? omega * omega : 1; }

typedef struct model {
  int n;                              /* degrees of freedom >= 1 */
  double *mass, *damping, *stiffness; /* [n][n] by columns: M [force time^2/length], C [force time/length], K */
  int n_loads;
  model_load *loads; /* [n_loads], no two of one harmonic */
  int n_contacts;
  model_contact *contacts; /* [n_contacts] */
  int n_responses;
  double *responses; /* [n_responses][n] [1] */
  double *numbers;   /* of model_new, the block that all vectors and matrices are in */
} model;

/* A model of that size with everything 0, to fill in and to free with model_free. HC_BAD_INPUT for n < 1 or any other
 * number < 0, HC_NO_MEMORY: *out is NULL. */
hc_status model_new(int n, int n_loads, int n_contacts, int n_responses, model **out);

/* One degree of freedom: M x'' + C x' + K x under F0 cos(omega t), its response x; the contacts are to be filled in. */
hc_status model_oscillator(double mass, double damping, double stiffness, double force, int n_contacts, model **out);

/* A copy in memory of its own. HC_NO_MEMORY: *out is NULL. */
hc_status model_copy(const model *m, model **out);

/* The same with other numbers of contacts and responses: those of *m as far as they go, the rest 0, to fill in. */
hc_status model_copy_sized(const model *m, int n_contacts, int n_responses, model **out);

/* The same with its degrees of freedom, in their order, for responses. */
hc_status model_copy_all_seen(const model *m, model **out);

void model_free(model *m); /* NULL is allowed */

/* How many contacts it has where a pair counts as one: those of the case. */
int model_whole_contacts(const model *m);

/* Does any contact follow the law of the circle? */
bool model_has_circle(const model *m);

/* Does any contact follow a smooth law? */
bool model_is_smooth(const model *m);

/* Does any contact follow a law with kinks? */
bool model_has_kinks(const model *m);

/* Is -x(t + T/2) a solution with each x(t)? Loads of odd harmonics alone, and each contact's forces are odd in x, or
 * another contact of the same law faces it: normals opposite, tangents along one line. */
bool model_is_symmetric(const model *m);

/* The law of either of a pair's two, from the whole contact's. */
contact model_half_law(const contact *whole);

/* (tangent, normal) = (cos, sin) of the angle [deg] between x and the contact's tangent, exact at 0 and +-90. */
void model_direction(double angle_deg, double *tangent, double *normal);

/* Is it one mass under F0 cos(omega t), with x as its only response? And F0 [force], of such a model alone. */
bool model_is_oscillator(const model *m);
double model_force(const model *m);

/* The highest harmonic of the loads; 0 without any. */
int model_highest_load(const model *m);

/* Largest stiffness [force/length] that an oscillator's x can see: K and every contact stuck. */
double model_max_stiffness(const model *m);
