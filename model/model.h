/* model.h - the simulated model: a structure of n degrees of freedom, and contacts between them.
 *
 *     M x'' + C x' + K x + sum_j [ t_j T_j + n_j (N_j - N0_j) ] = sum_k p_k cos(k omega t) + q_k sin(k omega t)
 *     u_j = t_j . x   tangential motion        v_j = n_j . x   normal motion        (t_j, n_j: directions in x)
 *     response r = r . x                                                            (reported motions)
 *
 * x [length] is measured from the rest position without static loads (k = 0); the contact law (T, N) is
 * contact_law.h's. Any consistent set of units. M is symmetric and positive definite; C and K are any real matrices,
 * and K may be singular. A model owns its memory; solvers never change it. Settings of the solution are in
 * hbm/hbm_settings.h and timeint/transient_settings.h. Source: Colonna et al. 2025, eq. 1-12 ([1] in README.md), for n
 * = 1; Krack and Gross, Harmonic Balance for Nonlinear Vibration Problems, Springer 2019, chapter 3, for more. */
#pragma once

#include <stdbool.h>

#include "model/contact_law.h"
#include "numerics/base/status.h"

/* A contact with two tangents is two neighbours in the list, one for each tangent: of the same law and normal, each
 * with half of kn and load and twice mu. So mu N of either is the contact's, their normal forces add up to the
 * contact's, and linear computations need no special case. Under the square law |T_1|, |T_2| <= mu N they are two
 * independent contacts; under that of the circle |(T_1, T_2)| <= mu N they share the limit. */
/* A contact with several normal springs (a table of forces) is one CONTACT_ALONE followed by the others,
 * CONTACT_MORE. */
typedef enum contact_pair { CONTACT_ALONE, CONTACT_FIRST, CONTACT_SECOND, CONTACT_MORE } contact_pair;

/* True if it belongs to the same contact of the case as its predecessor in the list. */
static inline bool contact_goes_on(contact_pair pair) { return pair >= CONTACT_SECOND; }

typedef struct model_contact {
  contact law;
  double *tangent, *normal; /* [n] [1] u = tangent . x, v = normal . x; all 0 if the contact has no such direction */
  contact_pair pair;
  bool circle; /* the law of the circle; set in both halves of a pair */
  double rest; /* [length] where the slider begins */
} model_contact;

/* cosine cos(k omega t) + sine sin(k omega t), k = harmonic >= 0: one load for each k. An inertial load is that of a
 * base moving by A cos(omega t), omega^2 M r A, x being relative to the base. */
typedef struct model_load {
  int harmonic;
  bool inertial;         /* true: cosine and sine are multiplied by omega^2 */
  double *cosine, *sine; /* [n] [force]; if inertial [force time^2] */
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
  double *numbers;   /* memory of all vectors and matrices */
} model;

/* A model of that size with all numbers 0, to be filled in by the caller and freed with model_free. HC_BAD_INPUT for n
 * < 1 or any other number < 0, HC_NO_MEMORY: *out is NULL. */
hc_status model_new(int n, int n_loads, int n_contacts, int n_responses, model **out);

/* One degree of freedom: M x'' + C x' + K x under F0 cos(omega t), with the response x; the caller fills in the
 * contacts. */
hc_status model_oscillator(double mass, double damping, double stiffness, double force, int n_contacts, model **out);

/* A deep copy. HC_NO_MEMORY: *out is NULL. */
hc_status model_copy(const model *m, model **out);

/* A copy with other numbers of contacts and responses: those of *m first, the rest 0, to be filled in. */
hc_status model_copy_sized(const model *m, int n_contacts, int n_responses, model **out);

/* A copy whose responses are its degrees of freedom, in their order. */
hc_status model_copy_all_seen(const model *m, model **out);

void model_free(model *m); /* NULL is allowed */

/* Number of contacts of the case: pairs and CONTACT_MORE count as one. */
int model_whole_contacts(const model *m);

/* True if any contact follows the law of the circle. */
bool model_has_circle(const model *m);

/* True if any contact follows a smooth law. */
bool model_is_smooth(const model *m);

/* True if any contact follows a law with kinks. */
bool model_has_kinks(const model *m);

/* True if -x(t + T/2) is a solution for each solution x(t): sliders that begin at 0, loads of odd harmonics only, and
 * each contact has a law that is odd in x, or an opposite contact of the same law: normals opposite, tangents along one
 * line. */
bool model_is_symmetric(const model *m);

/* The law of each half of a pair, from the whole contact's. */
contact model_half_law(const contact *whole);

/* (tangent, normal) = (cos, sin) of the angle [deg] between x and the contact's tangent, exact at 0 and +-90. */
void model_direction(double angle_deg, double *tangent, double *normal);

/* True for one mass under F0 cos(omega t) with x as its only response; model_force: F0 [force] of such a model. */
bool model_is_oscillator(const model *m);
double model_force(const model *m);

/* The highest harmonic of the loads; 0 without loads. */
int model_highest_load(const model *m);

/* Largest stiffness [force/length] of an oscillator: K and every contact stuck. */
double model_max_stiffness(const model *m);
