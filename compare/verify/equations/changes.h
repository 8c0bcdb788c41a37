/* changes.h - the table of the mistakes that verify makes: the cause that each is, its words, what of the case it is
 * made of, in which scenes it may be, and how it changes the equations. Nearly all are another model, which the exact
 * evaluator solves: two contacts make one that does not separate, and a preload that acts on the mass is a static
 * displacement and another gap. What no model has is plugged into the equations (mistakes.h). Private to
 * compare/verify/. */
#pragma once

#include "compare/verify/equations/causes.h"
#include "compare/verify/equations/mistakes.h"
#include "model/model.h"

/* What of a model a change is of: all of it, every contact or a single one of several, a single contact at a time (or
 * all), a power of a single one's polynomial, two contacts, a degree of freedom, two of them, or the loads of one
 * harmonic at one of them; or of the slider of sampled forces. */
typedef enum verify_part {
  PART_ALL,
  PART_CONTACT,
  PART_ONE_CONTACT,
  PART_POWER,
  PART_TWO_CONTACTS,
  PART_DOF,
  PART_PAIR,
  PART_LOAD,
  PART_SLIDER
} verify_part;

/* Has it a number, and which: a factor, or an angle [degree]? */
typedef enum verify_scan { SCAN_NONE, SCAN_FACTOR, SCAN_TURN } verify_scan;

/* What there must be in a scene, bits: several degrees of freedom; contacts, of an oscillator at an angle, of several
 * parts (two tangents), or with a preload; harmonic 0 in the equations. */
enum {
  IN_ANY = 0,
  IN_STRUCTURE = 1,
  IN_CONTACT = 2,
  IN_ANGLE = 4,
  IN_PARTS = 8,
  IN_PRELOAD = 16,
  IN_MEAN = 32,
  IN_CONTACT_MEAN = IN_CONTACT | IN_MEAN,
  IN_PRELOAD_MEAN = IN_PRELOAD | IN_MEAN,
  IN_STRUCTURE_MEAN = IN_STRUCTURE | IN_MEAN
};

/* code, CAUSE_, words, SCAN_, PART_, IN_, function of changes.c, or rule for the slider, of mistakes.c */
#define VERIFY_CHANGE_LIST(X)                                                                                          \
  X(CHANGE_NONE, NONE, "", NONE, ALL, ANY, .model = NULL)                                                              \
  X(CHANGE_NO_CONTACT, NO_CONTACT, "K alone", NONE, ALL, CONTACT, .model = no_contact)                                 \
  X(CHANGE_STUCK, STUCK, "K and the stuck contacts' stiffness", NONE, ALL, CONTACT, .model = stick_contacts)           \
  X(CHANGE_FORCE, FORCE, "F0", FACTOR, ALL, ANY, .load = scale_force)                                                  \
  X(CHANGE_MASS, MASS, "M", FACTOR, ALL, ANY, .model = scale_mass)                                                     \
  X(CHANGE_DAMPING, DAMPING, "C", FACTOR, ALL, ANY, .model = scale_damping)                                            \
  X(CHANGE_STIFFNESS, STIFFNESS, "K", FACTOR, ALL, ANY, .model = scale_stiffness)                                      \
  X(CHANGE_KT, KT, "kt", FACTOR, CONTACT, CONTACT, .contact = scale_kt)                                                \
  X(CHANGE_KN, KN, "kn", FACTOR, CONTACT, CONTACT, .contact = scale_kn)                                                \
  X(CHANGE_FRICTION, FRICTION, "mu", FACTOR, CONTACT, CONTACT, .contact = scale_mu)                                    \
  X(CHANGE_GAP, GAP, "gap", FACTOR, CONTACT, CONTACT, .contact = scale_gap)                                            \
  X(CHANGE_COEFFICIENT, COEFFICIENT, "coefficients", FACTOR, POWER, CONTACT, .contact = scale_power)                   \
  X(CHANGE_EPSILON, EPSILON, "epsilon", FACTOR, CONTACT, CONTACT, .contact = scale_epsilon)                            \
  X(CHANGE_TURNED, ANGLE, "tangent and normal turned", TURN, CONTACT, CONTACT, .contact = turn_both)                   \
  X(CHANGE_DAMPING_MODAL, DAMPING_KIND, "modal damping, mean of C's", FACTOR, ALL, STRUCTURE, .model = modal)          \
  X(CHANGE_DAMPING_OF_M, DAMPING_KIND, "C proportional to M, of C's trace", FACTOR, ALL, STRUCTURE,                    \
    .model = like_mass)                                                                                                \
  X(CHANGE_DAMPING_OF_K, DAMPING_KIND, "C proportional to K, of C's trace", FACTOR, ALL, STRUCTURE,                    \
    .model = like_stiffness)                                                                                           \
  X(CHANGE_HYSTERETIC, DAMPING_KIND, "hysteretic damping, of C's trace", FACTOR, ALL, ANY, .model = hysteretic)        \
  X(CHANGE_CONTACT_FORCE, CONTACT_FACTOR, "contact force", FACTOR, ALL, CONTACT, .contact = scale_law)                 \
  X(CHANGE_MEAN, MEAN_FACTOR, "harmonic 0 of the contact force", FACTOR, ALL, CONTACT_MEAN, .model = mean)             \
  X(CHANGE_MEAN_OF_N, MEAN_FACTOR, "harmonic 0 of T and N, but not N0,", FACTOR, ALL, PRELOAD_MEAN,                    \
    .model = mean_of_n)                                                                                                \
  X(CHANGE_GAP_SIGN, GAP_SIGN, "-gap", NONE, CONTACT, CONTACT, .contact = scale_gap, .times = -1)                      \
  X(CHANGE_ANGLE_COMPLEMENT, ANGLE_COMPLEMENT, "90 degrees - angle", NONE, ALL, ANGLE, .contact = complement)          \
  X(CHANGE_ANGLE_IN_RADIANS, ANGLE_UNIT, "the angle's degrees taken as radians", NONE, ALL, ANGLE,                     \
    .contact = as_radians)                                                                                             \
  X(CHANGE_ANGLE_IN_DEGREES, ANGLE_UNIT, "the angle in radians taken as degrees", NONE, ALL, ANGLE,                    \
    .contact = as_degrees)                                                                                             \
  X(CHANGE_EXCHANGED, EXCHANGED, "kt = kn of the case, kn = kt", NONE, CONTACT, CONTACT, .contact = swap_springs)      \
  X(CHANGE_NO_FRICTION, NO_FRICTION, "mu = 0", NONE, CONTACT, CONTACT, .contact = scale_mu)                            \
  X(CHANGE_NO_KT, NO_KT, "kt = 0", NONE, CONTACT, CONTACT, .contact = scale_kt)                                        \
  X(CHANGE_COEFFICIENT_SIGN, COEFFICIENT, "coefficients times -1", NONE, POWER, CONTACT, .contact = scale_power,       \
    .times = -1)                                                                                                       \
  X(CHANGE_POWER_UP, POWER, "powers one higher", NONE, CONTACT, CONTACT, .contact = raise_powers)                      \
  X(CHANGE_POWER_DOWN, POWER, "powers one lower", NONE, CONTACT, CONTACT, .contact = lower_powers)                     \
  X(CHANGE_FRICTION_SIGN, FRICTION_SIGN, "-T", NONE, ONE_CONTACT, CONTACT, .contact = turn_friction)                   \
  X(CHANGE_SLIDER_MEAN, SLIDER_MEAN, "harmonic 0 of T is kt times that of u", NONE, ALL, STRUCTURE_MEAN,               \
    .contact = mean_of_u)                                                                                              \
  X(CHANGE_FRICTION_MEAN, SLIDER_MEAN, "T without harmonic 0", NONE, ALL, STRUCTURE_MEAN, .contact = drop_mean)        \
  X(CHANGE_SQUARE_LIMIT, SQUARE_LIMIT, "limit: square", NONE, ALL, PARTS, .contact = limit_squarely)                   \
  X(CHANGE_CIRCLE_LIMIT, CIRCLE_LIMIT, "limit: circle", NONE, ALL, PARTS, .contact = limit_by_circle)                  \
  X(CHANGE_NO_TANGENT_2, TANGENT_MISSING, "no tangent_2", NONE, ALL, PARTS, .contact = no_tangent_2)                   \
  X(CHANGE_NO_TANGENT_1, TANGENT_MISSING, "tangent_2 alone", NONE, ALL, PARTS, .contact = no_tangent_1)                \
  X(CHANGE_NO_SEPARATION, NO_SEPARATION, "N = kn (v + gap), |T| <= mu max(N, 0)", NONE, ALL, CONTACT,                  \
    .model = doubled)                                                                                                  \
  X(CHANGE_NO_SEPARATION_PULLS, NO_SEPARATION, "N = kn (v + gap), |T| <= mu |N|", NONE, ALL, CONTACT,                  \
    .model = doubled)                                                                                                  \
  X(CHANGE_CONSTANT_N, CONSTANT_N, "N = N0", NONE, ALL, PRELOAD, .model = doubled)                                     \
  X(CHANGE_CONSTANT_LIMIT, CONSTANT_N, "|T| <= mu N0", NONE, ALL, PRELOAD, .model = doubled)                           \
  X(CHANGE_CONSTANT_LIMIT_LINEAR, CONSTANT_N, "|T| <= mu N0, N = kn (v + gap)", NONE, ALL, PRELOAD, .model = doubled)  \
  X(CHANGE_PRELOAD_ADDED, PRELOAD_ADDED, "N in the place of N - N0", NONE, ALL, PRELOAD_MEAN, .model = add_preload)    \
  X(CHANGE_RESPONSE, RESPONSE, "the motion of", NONE, DOF, STRUCTURE, .model = NULL)                                   \
  X(CHANGE_RELATIVE, RELATIVE, "the motion relative to", NONE, DOF, STRUCTURE, .model = NULL)                          \
  X(CHANGE_ONE_LOAD, ONE_LOAD, "the load", FACTOR, LOAD, ANY, .load = scale_one_load)                                  \
  X(CHANGE_LOAD_SIGN, ONE_LOAD, "the other sign of the load", NONE, LOAD, ANY, .load = scale_one_load, .times = -1)    \
  X(CHANGE_LOAD_DOF, LOAD_DOF, "the force at", NONE, DOF, STRUCTURE, .load = move_load)                                \
  X(CHANGE_STATIC_LOAD, NO_STATIC_LOAD, "static loads", FACTOR, ALL, ANY, .load = scale_static_load)                   \
  X(CHANGE_PHASE_SIGN, PHASE_SIGN, "phases of the loads times -1", NONE, ALL, ANY, .load = turn_phase)                 \
  X(CHANGE_DAMPING_TRANSPOSED, TRANSPOSED, "C transposed", NONE, ALL, STRUCTURE, .model = transpose_damping)           \
  X(CHANGE_STIFFNESS_TRANSPOSED, TRANSPOSED, "K transposed", NONE, ALL, STRUCTURE, .model = transpose_stiffness)       \
  X(CHANGE_LUMPED, LUMPED_MASS, "M as the sums of its rows", NONE, ALL, STRUCTURE, .model = lump_mass)                 \
  X(CHANGE_CONTACTS_EXCHANGED, CONTACTS_EXCHANGED, "kt and kn exchanged between", NONE, TWO_CONTACTS, CONTACT,         \
    .model = swap_contacts)                                                                                            \
  X(CHANGE_ONE_SIDE, ONE_SIDE, "one side turned", NONE, ONE_CONTACT, CONTACT, .contact = turn_one_side)                \
  X(CHANGE_MATRICES_EXCHANGED, DOFS_EXCHANGED, "M, C and K exchanged in", NONE, PAIR, STRUCTURE,                       \
    .model = swap_matrices)                                                                                            \
  X(CHANGE_CONTACT_DOFS_EXCHANGED, DOFS_EXCHANGED, "the contacts exchanged in", NONE, PAIR, STRUCTURE,                 \
    .model = swap_dofs)                                                                                                \
  X(CHANGE_SLIDER_INTERPOLATED, NONE, "", NONE, SLIDER, CONTACT, .slider = &verify_on_line)                            \
  X(CHANGE_SLIDER_ON_SAMPLE, SLIDER, ", hbm.slider_restart: sample", NONE, SLIDER, CONTACT,                            \
    .slider = &verify_on_sample)                                                                                       \
  X(CHANGE_SLIDER_RADIAL, NONE, "", NONE, SLIDER, PARTS, .slider = &verify_radial)                                     \
  X(CHANGE_SLIDER_ZEROED, SLIDER_ZEROED, ", w = 0 after a separation", NONE, SLIDER, CONTACT,                          \
    .slider = &verify_zeroed)                                                                                          \
  X(CHANGE_SLIDER_KEPT, SLIDER_KEPT, ", w kept over a separation", NONE, SLIDER, CONTACT, .slider = &verify_kept)      \
  X(CHANGE_SLIDER_ONE_PASS, SINGLE_PASS, ", one period from w = 0", NONE, SLIDER, CONTACT, .slider = &verify_once)     \
  X(CHANGE_SLIDER_ONE_PASS_SAMPLE, SINGLE_PASS, ", one period from w = 0", NONE, SLIDER, CONTACT,                      \
    .slider = &verify_once_sampled)
#define VERIFY_CHANGE_CODE(code, ...) code,
typedef enum verify_change { VERIFY_CHANGE_LIST(VERIFY_CHANGE_CODE) VERIFY_CHANGES } verify_change;
#undef VERIFY_CHANGE_CODE

/* Those before change the model; from there on how sampled forces are followed, in the order of hbm_restart. */
enum { VERIFY_MODEL_CHANGES = CHANGE_SLIDER_INTERPOLATED };

typedef struct changing changing;
typedef struct verify_change_kind {
  int cause; /* CAUSE_NONE: none */
  const char *words;
  verify_scan scan;
  verify_part part;
  unsigned in;
  /* What is changed: the model, each contact that is meant, each load; NULL: nothing of it. */
  hc_status (*model)(changing *c);
  void (*contact)(changing *c, model_contact *k);
  void (*load)(changing *c, model_load *load);
  double times; /* [1] the factor of a change without a number */
  const slider_rule *slider;
} verify_change_kind;
extern const verify_change_kind verify_changes[VERIFY_CHANGES];

/* Is the scene one that it can be made in? */
bool verify_change_applies(const model *m, verify_change c, bool keep_mean);

/* Is it damping of another kind, whose factor 1 is a mistake, too? */
static inline bool verify_change_of_kind(verify_change c)
{
  return c >= CHANGE_DAMPING_MODAL && c <= CHANGE_HYSTERETIC;
}

enum { VERIFY_MOST_DOFS = 200, VERIFY_MOST_CONTACTS = 12 }; /* that are tried one by one */

/* In how many ways it can be made of this model: values of verify_changed.which, from 0 on. */
int verify_change_variants(const model *m, verify_change c);

/* One of them. */
typedef struct verify_changed {
  verify_change change;
  double factor; /* the number of a change that has one */
  int which;     /* 0: all; else one more than the contact, a pair being one, CONTACT_POWERS times that and the
                    power's index, the degree of freedom i, i n + k of the two, i < k, of two contacts likewise with
                    n = VERIFY_MOST_CONTACTS, or k n + i of the loads of harmonic k at i */
} verify_changed;

/* The other program's model: *out, the caller's, whose response r plus offset[r] [length] is theirs, and mistakes in
 * the equations. Without harmonic 0 no constant force matters. HC_BAD_INPUT: it changes nothing of this model, or makes
 * no sense in it; HC_NO_MEMORY: *out is NULL. */
hc_status verify_changed_model(const model *m, const verify_changed *how, bool keep_mean, model **out, double *offset,
                               verify_mistakes *mistakes);
