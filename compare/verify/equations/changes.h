/* changes.h - the case's model with one mistake in it. Every one of them is a model again, which the exact evaluator
 * solves: two contacts make one that does not separate, and a preload that acts on the mass is a static displacement
 * and another gap. Private to compare/verify/. */
#pragma once

#include "compare/verify/equations/causes.h"
#include "compare/verify/equations/mistakes.h"
#include "model/model.h"

/* What of a model a change is of: all of it, every contact or a single one of several, a single contact at a time (or
 * all), a power of a single one's polynomial, two contacts, a degree of freedom, two of them, or the loads of one
 * harmonic at one of them. */
typedef enum verify_part {
  PART_ALL,
  PART_CONTACT,
  PART_ONE_CONTACT,
  PART_POWER,
  PART_TWO_CONTACTS,
  PART_DOF,
  PART_PAIR,
  PART_LOAD
} verify_part;

/* Has it a number, and which: a factor, or an angle [degree]? */
typedef enum verify_scan { SCAN_NONE, SCAN_FACTOR, SCAN_TURN } verify_scan;

/* code, cause, words, its number, what it is of */
#define VERIFY_CHANGE_LIST(X)                                                                                          \
  X(CHANGE_NONE, VERIFY_CAUSES, "", SCAN_NONE, PART_ALL)                                                               \
  X(CHANGE_NO_CONTACT, CAUSE_NO_CONTACT, "K alone", SCAN_NONE, PART_ALL)                                               \
  X(CHANGE_STUCK, CAUSE_STUCK, "K and the stuck contacts' stiffness", SCAN_NONE, PART_ALL)                             \
  X(CHANGE_FORCE, CAUSE_FORCE, "F0", SCAN_FACTOR, PART_ALL)                                                            \
  X(CHANGE_MASS, CAUSE_MASS, "M", SCAN_FACTOR, PART_ALL)                                                               \
  X(CHANGE_DAMPING, CAUSE_DAMPING, "C", SCAN_FACTOR, PART_ALL)                                                         \
  X(CHANGE_STIFFNESS, CAUSE_STIFFNESS, "K", SCAN_FACTOR, PART_ALL)                                                     \
  X(CHANGE_KT, CAUSE_KT, "kt", SCAN_FACTOR, PART_CONTACT)                                                              \
  X(CHANGE_KN, CAUSE_KN, "kn", SCAN_FACTOR, PART_CONTACT)                                                              \
  X(CHANGE_FRICTION, CAUSE_FRICTION, "mu", SCAN_FACTOR, PART_CONTACT)                                                  \
  X(CHANGE_GAP, CAUSE_GAP, "gap", SCAN_FACTOR, PART_CONTACT)                                                           \
  X(CHANGE_COEFFICIENT, CAUSE_COEFFICIENT, "coefficients", SCAN_FACTOR, PART_POWER)                                    \
  X(CHANGE_EPSILON, CAUSE_EPSILON, "epsilon", SCAN_FACTOR, PART_CONTACT)                                               \
  X(CHANGE_TURNED, CAUSE_ANGLE, "tangent and normal turned", SCAN_TURN, PART_CONTACT)                                  \
  X(CHANGE_DAMPING_MODAL, CAUSE_DAMPING_KIND, "modal damping, mean of C's", SCAN_FACTOR, PART_ALL)                     \
  X(CHANGE_DAMPING_OF_M, CAUSE_DAMPING_KIND, "C proportional to M, of C's trace", SCAN_FACTOR, PART_ALL)               \
  X(CHANGE_DAMPING_OF_K, CAUSE_DAMPING_KIND, "C proportional to K, of C's trace", SCAN_FACTOR, PART_ALL)               \
  X(CHANGE_HYSTERETIC, CAUSE_DAMPING_KIND, "hysteretic damping, of C's trace", SCAN_FACTOR, PART_ALL)                  \
  X(CHANGE_CONTACT_FORCE, CAUSE_CONTACT_FACTOR, "contact force", SCAN_FACTOR, PART_ALL)                                \
  X(CHANGE_MEAN, CAUSE_MEAN_FACTOR, "harmonic 0 of the contact force", SCAN_FACTOR, PART_ALL)                          \
  X(CHANGE_MEAN_OF_N, CAUSE_MEAN_FACTOR, "harmonic 0 of T and N, but not N0,", SCAN_FACTOR, PART_ALL)                  \
  X(CHANGE_GAP_SIGN, CAUSE_GAP_SIGN, "-gap", SCAN_NONE, PART_CONTACT)                                                  \
  X(CHANGE_ANGLE_COMPLEMENT, CAUSE_ANGLE_COMPLEMENT, "90 degrees - angle", SCAN_NONE, PART_ALL)                        \
  X(CHANGE_ANGLE_IN_RADIANS, CAUSE_ANGLE_UNIT, "the angle's degrees taken as radians", SCAN_NONE, PART_ALL)            \
  X(CHANGE_ANGLE_IN_DEGREES, CAUSE_ANGLE_UNIT, "the angle in radians taken as degrees", SCAN_NONE, PART_ALL)           \
  X(CHANGE_EXCHANGED, CAUSE_EXCHANGED, "kt = kn of the case, kn = kt", SCAN_NONE, PART_CONTACT)                        \
  X(CHANGE_NO_FRICTION, CAUSE_NO_FRICTION, "mu = 0", SCAN_NONE, PART_CONTACT)                                          \
  X(CHANGE_NO_KT, CAUSE_NO_KT, "kt = 0", SCAN_NONE, PART_CONTACT)                                                      \
  X(CHANGE_COEFFICIENT_SIGN, CAUSE_COEFFICIENT, "coefficients times -1", SCAN_NONE, PART_POWER)                        \
  X(CHANGE_POWER_UP, CAUSE_POWER, "powers one higher", SCAN_NONE, PART_CONTACT)                                        \
  X(CHANGE_POWER_DOWN, CAUSE_POWER, "powers one lower", SCAN_NONE, PART_CONTACT)                                       \
  X(CHANGE_FRICTION_SIGN, CAUSE_FRICTION_SIGN, "-T", SCAN_NONE, PART_ONE_CONTACT)                                      \
  X(CHANGE_SLIDER_MEAN, CAUSE_SLIDER_MEAN, "harmonic 0 of T is kt times that of u", SCAN_NONE, PART_ALL)               \
  X(CHANGE_FRICTION_MEAN, CAUSE_SLIDER_MEAN, "T without harmonic 0", SCAN_NONE, PART_ALL)                              \
  X(CHANGE_SQUARE_LIMIT, CAUSE_SQUARE_LIMIT, "limit: square", SCAN_NONE, PART_ALL)                                     \
  X(CHANGE_CIRCLE_LIMIT, CAUSE_CIRCLE_LIMIT, "limit: circle", SCAN_NONE, PART_ALL)                                     \
  X(CHANGE_NO_TANGENT_2, CAUSE_TANGENT_MISSING, "no tangent_2", SCAN_NONE, PART_ALL)                                   \
  X(CHANGE_NO_TANGENT_1, CAUSE_TANGENT_MISSING, "tangent_2 alone", SCAN_NONE, PART_ALL)                                \
  X(CHANGE_NO_SEPARATION, CAUSE_NO_SEPARATION, "N = kn (v + gap), |T| <= mu max(N, 0)", SCAN_NONE, PART_ALL)           \
  X(CHANGE_NO_SEPARATION_PULLS, CAUSE_NO_SEPARATION, "N = kn (v + gap), |T| <= mu |N|", SCAN_NONE, PART_ALL)           \
  X(CHANGE_CONSTANT_N, CAUSE_CONSTANT_N, "N = N0", SCAN_NONE, PART_ALL)                                                \
  X(CHANGE_CONSTANT_LIMIT, CAUSE_CONSTANT_N, "|T| <= mu N0", SCAN_NONE, PART_ALL)                                      \
  X(CHANGE_CONSTANT_LIMIT_LINEAR, CAUSE_CONSTANT_N, "|T| <= mu N0, N = kn (v + gap)", SCAN_NONE, PART_ALL)             \
  X(CHANGE_PRELOAD_ADDED, CAUSE_PRELOAD_ADDED, "N in the place of N - N0", SCAN_NONE, PART_ALL)                        \
  X(CHANGE_RESPONSE, CAUSE_RESPONSE, "the motion of", SCAN_NONE, PART_DOF)                                             \
  X(CHANGE_RELATIVE, CAUSE_RELATIVE, "the motion relative to", SCAN_NONE, PART_DOF)                                    \
  X(CHANGE_ONE_LOAD, CAUSE_ONE_LOAD, "the load", SCAN_FACTOR, PART_LOAD)                                               \
  X(CHANGE_LOAD_SIGN, CAUSE_ONE_LOAD, "the other sign of the load", SCAN_NONE, PART_LOAD)                              \
  X(CHANGE_LOAD_DOF, CAUSE_LOAD_DOF, "the force at", SCAN_NONE, PART_DOF)                                              \
  X(CHANGE_STATIC_LOAD, CAUSE_NO_STATIC_LOAD, "static loads", SCAN_FACTOR, PART_ALL)                                   \
  X(CHANGE_PHASE_SIGN, CAUSE_PHASE_SIGN, "phases of the loads times -1", SCAN_NONE, PART_ALL)                          \
  X(CHANGE_DAMPING_TRANSPOSED, CAUSE_TRANSPOSED, "C transposed", SCAN_NONE, PART_ALL)                                  \
  X(CHANGE_STIFFNESS_TRANSPOSED, CAUSE_TRANSPOSED, "K transposed", SCAN_NONE, PART_ALL)                                \
  X(CHANGE_LUMPED, CAUSE_LUMPED_MASS, "M as the sums of its rows", SCAN_NONE, PART_ALL)                                \
  X(CHANGE_CONTACTS_EXCHANGED, CAUSE_CONTACTS_EXCHANGED, "kt and kn exchanged between", SCAN_NONE, PART_TWO_CONTACTS)  \
  X(CHANGE_ONE_SIDE, CAUSE_ONE_SIDE, "one side turned", SCAN_NONE, PART_ONE_CONTACT)                                   \
  X(CHANGE_MATRICES_EXCHANGED, CAUSE_DOFS_EXCHANGED, "M, C and K exchanged in", SCAN_NONE, PART_PAIR)                  \
  X(CHANGE_CONTACT_DOFS_EXCHANGED, CAUSE_DOFS_EXCHANGED, "the contacts exchanged in", SCAN_NONE, PART_PAIR)
#define VERIFY_CHANGE_CODE(code, cause, words, scan, part) code,
typedef enum verify_change { VERIFY_CHANGE_LIST(VERIFY_CHANGE_CODE) VERIFY_CHANGES } verify_change;
#undef VERIFY_CHANGE_CODE

typedef struct verify_change_kind {
  int cause; /* VERIFY_CAUSES: none */
  const char *words;
  verify_scan scan;
  verify_part part;
} verify_change_kind;
extern const verify_change_kind verify_changes[VERIFY_CHANGES];

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
