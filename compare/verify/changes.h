/* changes.h - the case's model with one mistake in it. Every one of them is a model again, which the exact evaluator
 * solves: two contacts make one that does not separate, and a preload that acts on the mass is a static displacement
 * and another gap. Private to compare/verify/. */
#ifndef HC_VERIFY_CHANGES_H
#define HC_VERIFY_CHANGES_H

#include "compare/verify/causes.h"
#include "model/model.h"

/* code, cause, words, has it a factor? */
#define VERIFY_CHANGE_LIST(X)                                                                                          \
  X(CHANGE_NONE, VERIFY_CAUSES, "", false)                                                                             \
  X(CHANGE_NO_CONTACT, CAUSE_NO_CONTACT, "K alone", false)                                                             \
  X(CHANGE_STUCK, CAUSE_STUCK, "K and the stuck contacts' stiffness", false)                                           \
  X(CHANGE_FORCE, CAUSE_FORCE, "F0", true)                                                                             \
  X(CHANGE_MASS, CAUSE_MASS, "M", true)                                                                                \
  X(CHANGE_DAMPING, CAUSE_DAMPING, "C", true)                                                                          \
  X(CHANGE_STIFFNESS, CAUSE_STIFFNESS, "K", true)                                                                      \
  X(CHANGE_KT, CAUSE_KT, "kt", true)                                                                                   \
  X(CHANGE_KN, CAUSE_KN, "kn", true)                                                                                   \
  X(CHANGE_FRICTION, CAUSE_FRICTION, "mu", true)                                                                       \
  X(CHANGE_GAP, CAUSE_GAP, "gap", true)                                                                                \
  X(CHANGE_CONTACT_FORCE, CAUSE_CONTACT_FACTOR, "contact force", true)                                                 \
  X(CHANGE_MEAN, CAUSE_MEAN_FACTOR, "harmonic 0 of the contact force", true)                                           \
  X(CHANGE_MEAN_OF_N, CAUSE_MEAN_FACTOR, "harmonic 0 of T and N, but not N0,", true)                                   \
  X(CHANGE_GAP_SIGN, CAUSE_GAP_SIGN, "-gap", false)                                                                    \
  X(CHANGE_ANGLE_COMPLEMENT, CAUSE_ANGLE_COMPLEMENT, "90 degrees - angle", false)                                      \
  X(CHANGE_ANGLE_IN_RADIANS, CAUSE_ANGLE_UNIT, "the angle's degrees taken as radians", false)                          \
  X(CHANGE_ANGLE_IN_DEGREES, CAUSE_ANGLE_UNIT, "the angle in radians taken as degrees", false)                         \
  X(CHANGE_EXCHANGED, CAUSE_EXCHANGED, "kt = kn of the case, kn = kt", false)                                          \
  X(CHANGE_NO_FRICTION, CAUSE_NO_FRICTION, "mu = 0", false)                                                            \
  X(CHANGE_NO_KT, CAUSE_NO_KT, "kt = 0", false)                                                                        \
  X(CHANGE_NO_SEPARATION, CAUSE_NO_SEPARATION, "N = kn (v + gap), |T| <= mu max(N, 0)", false)                         \
  X(CHANGE_NO_SEPARATION_PULLS, CAUSE_NO_SEPARATION, "N = kn (v + gap), |T| <= mu |N|", false)                         \
  X(CHANGE_CONSTANT_N, CAUSE_CONSTANT_N, "N = N0", false)                                                              \
  X(CHANGE_CONSTANT_LIMIT, CAUSE_CONSTANT_N, "|T| <= mu N0", false)                                                    \
  X(CHANGE_CONSTANT_LIMIT_LINEAR, CAUSE_CONSTANT_N, "|T| <= mu N0, N = kn (v + gap)", false)                           \
  X(CHANGE_PRELOAD_ADDED, CAUSE_PRELOAD_ADDED, "N in the place of N - N0", false)
#define VERIFY_CHANGE_CODE(code, cause, words, factor) code,
typedef enum verify_change { VERIFY_CHANGE_LIST(VERIFY_CHANGE_CODE) VERIFY_CHANGES } verify_change;
#undef VERIFY_CHANGE_CODE

int verify_change_cause(verify_change c); /* VERIFY_CAUSES: none */
const char *verify_change_words(verify_change c);
bool verify_change_has_factor(verify_change c);

/* The other program's model: *out, the caller's, whose displacement plus *offset [length] is theirs, and whose harmonic
 * 0 of the contact force is to be multiplied by 1 + *mean_error. factor: that of a change that has one. Without
 * harmonic 0 no constant force matters. HC_BAD_INPUT: it changes nothing of this model, or makes no sense in it;
 * HC_NO_MEMORY: *out is NULL. */
hc_status verify_changed_model(const model *m, verify_change c, double factor, bool keep_mean, model **out,
                               double *offset, double *mean_error);

#endif
