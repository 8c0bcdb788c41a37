/* stress.h - random scenes, every method compared with every other. The header of this folder.
 *
 * A scene is a point of a Sobol sequence (scenes.h): seed and index make it again. On each, every check of
 * STRESS_CHECKS compares two ways to the same answer and has one of these outcomes:
 *     agreed      within a bound that is derived where the check is
 *     explained   beyond it, for a reason that was itself computed (STRESS_REASONS): the difference shrinks with the
 *                 harmonics as it must, the scene is so ill-conditioned that it must differ by that much, ...
 *     too_dear    given up after the processor time allowed for one check
 *     refused     a solver failed, with its status
 *     finding     two methods differ and no reason was found: an error of this program
 *     skipped     there was nothing to compare
 * Not here: how it is shown (interfaces/command/cmd_stress.c). */
#pragma once

#include "model/casefile/scene.h"
#include "numerics/base/status.h"

/* X(code, name, function, meaning) in the order of their run: later ones use what earlier ones found. */
#define STRESS_CHECKS(X)                                                                                               \
  X(STRESS_FORCE, "contact_force", stress_check_force,                                                                 \
    "each contact's force harmonics, located exactly and stepped through ever finer")                                  \
  X(STRESS_BALANCE, "balance", stress_check_balance,                                                                   \
    "all degrees of freedom are in balance, written down without any condensation")                                    \
  X(STRESS_WORK, "contact_work", stress_check_work, "no contact gives work back, and one that never slips takes none") \
  X(STRESS_FREE, "linear_never_touching", stress_check_free,                                                           \
    "gaps never reached: HBM and transient are the closed form of K")                                                  \
  X(STRESS_STUCK, "linear_always_stuck", stress_check_stuck,                                                           \
    "never slipping nor opening: the closed form of K + kt t t^T + kn n n^T")                                          \
  X(STRESS_DETERMINANT, "determinant", stress_check_determinant,                                                       \
    "where nothing slips, multipliers have the product that damping alone gives")                                      \
  X(STRESS_PERMUTED, "permuted", stress_check_permuted,                                                                \
    "degrees of freedom in another order: the same solution and multiplier")                                           \
  X(STRESS_ROTATED, "rotated", stress_check_rotated, "in coordinates y, x = Q y: the same solution and multiplier")    \
  X(STRESS_UNITS, "units", stress_check_units,                                                                         \
    "in other units, powers of two and not: the same solution and multiplier")                                         \
  X(STRESS_SPLIT, "split_contacts", stress_check_split,                                                                \
    "every contact as two that share its stiffness: the same solution and multiplier")                                 \
  X(STRESS_COPIES, "copies", stress_check_copies,                                                                      \
    "two copies that nothing couples: each is the one, with its multiplier")                                           \
  X(STRESS_BYSTANDER, "bystander", stress_check_bystander,                                                             \
    "one degree of freedom more that nothing couples, then turned: the same solution")                                 \
  X(STRESS_DELAYED, "delayed", stress_check_delayed,                                                                   \
    "all loads later, half a period or any other time: the same solution, later")                                      \
  X(STRESS_OTHER_TANGENTS, "turned_tangents", stress_check_other_tangents,                                             \
    "a circle's two tangents turned: the same solution and multiplier")                                                \
  X(STRESS_SAMPLED, "sampled", stress_check_sampled,                                                                   \
    "HBM with N samples balances at these N instants, and with ever more tends to HBM with exact forces")              \
  X(STRESS_CURVE, "curve", stress_check_curve, "the response curve through it has that solution, and no false one")    \
  X(STRESS_ORBIT, "orbit", stress_check_orbit, "HBM with more and more harmonics tends to the orbit of the exact law") \
  X(STRESS_MULTIPLIER, "orbit_multiplier", stress_check_multiplier,                                                    \
    "the orbit's Floquet multiplier by HBM's own orbit and by time integration")                                       \
  X(STRESS_ORBIT_REWRITTEN, "orbit_rewritten", stress_check_rewritten,                                                 \
    "that orbit in other coordinates, units and at another time")                                                      \
  X(STRESS_ORBIT_RETURNS, "orbit_returns", stress_check_returns,                                                       \
    "from beside a stable orbit the motion goes back to it")                                                           \
  X(STRESS_ORBIT_CVODE, "orbit_cvode", stress_check_cvode,                                                             \
    "the exact law in closed form and by CVODE: the same orbit")                                                       \
  X(STRESS_ORBIT_LAWS, "orbit_regularised", stress_check_regularised,                                                  \
    "the regularised law's orbit tends to the exact law's")                                                            \
  X(STRESS_PROOF, "proof", stress_check_proof, "what is proven of that orbit holds what time integration measured")    \
  X(STRESS_FROM_REST, "from_rest", stress_check_from_rest,                                                             \
    "where the motion goes from rest, in closed form and by CVODE")                                                    \
  X(STRESS_VERDICT, "verdict", stress_check_verdict, "what compare says, held against what it says it from")           \
  X(STRESS_PREDICTED, "prediction", stress_check_predicted,                                                            \
    "what compare found, against what both sides said beforehand they would be off")                                   \
  X(STRESS_SHIFTED, "shifted", stress_check_shifted,                                                                   \
    "under a static load with gaps moved along: the same answers about another position")                              \
  X(STRESS_BESIDE, "beside", stress_check_beside,                                                                      \
    "a contact elsewhere that nothing couples and that moves less or far more: the same answers")                      \
  X(STRESS_STRETCHED, "stretched", stress_check_stretched, "one coordinate in another unit: the same answers")         \
  X(STRESS_TURNED, "turned", stress_check_turned, "all loads at another time: the same answers")                       \
  X(STRESS_MIRRORED, "mirrored", stress_check_mirrored,                                                                \
    "all motions and loads in the other direction: the same answers")

#define STRESS_REASONS(X)                                                                                              \
  X(STRESS_NO_REASON, "", "")                                                                                          \
  X(STRESS_TRUNCATED, "truncated", "too few harmonics, and doubling them says by how much")                            \
  X(STRESS_UNRESOLVED, "unresolved", "the contact's own oscillation lies beyond the harmonics")                        \
  X(STRESS_ALIASED, "aliased", "too few samples, and more of them come nearer")                                        \
  X(STRESS_SMOOTHED, "smoothed", "the regularised law itself, and less regularisation comes nearer")                   \
  X(STRESS_ILL_CONDITIONED, "ill_conditioned", "rounding or tolerances alone, through the scene's own sensitivity")    \
  X(STRESS_OTHER_ORBIT, "other_orbit", "two orbits exist side by side, and each is confirmed by the other method")     \
  X(STRESS_OTHER_EVENTS, "other_events",                                                                               \
    "next to a grazing: the two orbits, as near as they are, differ by a transition")                                  \
  X(STRESS_NO_ORBIT, "no_orbit", "nothing to hold against: the other method found no solution")                        \
  X(STRESS_NOT_APPLICABLE, "not_applicable", "the law that is checked does not hold here")                             \
  X(STRESS_NO_CHECKER, "no_checker", "hbmcheck-proof, which decides about proofs, cannot be started")                  \
  X(STRESS_REFUSED_BY, "refused", "a solver gave up and said why")                                                     \
  X(STRESS_TOO_DEAR, "too_dear", "given up after the time allowed for one check")                                      \
  X(STRESS_SAID_SO, "said_so", "compare says that the two differ, or why they cannot be compared")                     \
  X(STRESS_UNEXPECTED, "unexpected", "compare itself says that neither side expected so much")                         \
  X(STRESS_FAMILY, "family", "steady states are a family, of which the two are members or next to some")               \
  X(STRESS_DISAGREES, "disagrees", "two methods differ, and nothing explains it")                                      \
  X(STRESS_SPECIALS, "special_points", "written another way the response curve has other special points")              \
  X(STRESS_PEAK, "peak", "written another way the response curve has another peak")                                    \
  X(STRESS_HIGHEST, "highest_row", "written another way the highest of the curve's points is another")                 \
  X(STRESS_SOLUTIONS, "solutions", "written another way there are other solutions")                                    \
  X(STRESS_TRANSIENT, "transient", "written another way the transient goes elsewhere")                                 \
  X(STRESS_REGULARISED, "regularised", "written another way the transient of the default law goes elsewhere")          \
  X(STRESS_VERDICTS, "verdicts", "written another way compare says otherwise")                                         \
  X(STRESS_ADVICE, "advice", "written another way advise says otherwise")                                              \
  X(STRESS_WRONG_VERDICT, "wrong_verdict", "compare says what is known not to be so")                                  \
  X(STRESS_INTERNAL, "internal", "an internal error, or a number that is none")

/* From the best to the worst: of several parts of a check the worst counts. */
#define STRESS_OUTCOMES(X)                                                                                             \
  X(STRESS_SKIPPED, "skipped")                                                                                         \
  X(STRESS_AGREED, "agreed")                                                                                           \
  X(STRESS_EXPLAINED, "explained")                                                                                     \
  X(STRESS_DEAR, "too_dear") X(STRESS_REFUSED, "refused") X(STRESS_FINDING, "finding")

#define STRESS_CODE(code, ...) code,
typedef enum stress_kind { STRESS_CHECKS(STRESS_CODE) STRESS_N_CHECKS } stress_kind;
typedef enum stress_reason { STRESS_REASONS(STRESS_CODE) STRESS_N_REASONS } stress_reason;
typedef enum stress_outcome { STRESS_OUTCOMES(STRESS_CODE) STRESS_N_OUTCOMES } stress_outcome;
#undef STRESS_CODE

/* What is drawn: an oscillator is a structure of one degree of freedom. */
typedef enum stress_family { STRESS_OSCILLATORS, STRESS_STRUCTURES, STRESS_SPACE } stress_family;
const char *stress_family_option(stress_family family); /* of the command, with a blank before it; "" for oscillators */

const char *stress_kind_name(stress_kind kind);
const char *stress_kind_meaning(stress_kind kind);
const char *stress_reason_name(stress_reason reason);
const char *stress_reason_meaning(stress_reason reason);
const char *stress_outcome_name(stress_outcome outcome);

typedef struct stress_check {
  stress_outcome outcome;
  stress_reason reason;
  hc_status status;    /* of the solver that refused */
  double error, bound; /* [1] what was found and what was allowed, relative; NaN: no number belongs to it */
  double seconds;      /* of processor time */
} stress_check;

typedef struct stress_result {
  long index;
  bool there;
  double seconds; /* of processor time */
  stress_check check[STRESS_N_CHECKS];
} stress_result;

/* What is stressed. */
typedef struct stress_plan {
  stress_family family;
  unsigned long seed;
  long first, scenes; /* indices first .. first + scenes - 1 */
  int jobs;
  double seconds;      /* [s] of processor time allowed for one check */
  const char *journal; /* file that keeps results as they come, and from which the same plan goes on; NULL: none */
} stress_plan;

/* The checks on one scene up to `last`, of whose results those before may be part; seconds [s] for each. HC_OK whatever
 * they say; HC_INTERRUPTED, HC_NO_MEMORY. */
hc_status stress_scene(const scene *sc, stress_kind last, double seconds, const hc_monitor *monitor,
                       stress_result *out);

/* The whole plan by several threads, into results[plan->scenes]. *resumed, from before the first tick: scenes that the
 * journal had; ticks tell the part of the others that is done. HC_INTERRUPTED keeps what is there; HC_BAD_INPUT: the
 * journal is of another plan, is none or is damaged; HC_UNSUPPORTED: of another version, with other checks; HC_IO: it
 * cannot be written (errno says why). */
hc_status stress_run(const stress_plan *plan, const hc_monitor *monitor, stress_result *results, long *resumed);

/* Simplify *sc while the check `kind` still ends in a finding: fewer contacts, loads, degrees of freedom and harmonics,
 * an oscillator's numbers of one to three digits. HC_NO_MEMORY, HC_INTERRUPTED. */
hc_status stress_shrink(scene *sc, stress_kind kind, double seconds, const hc_monitor *monitor);
