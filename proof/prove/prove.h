/* prove.h - from compared to proven: next to each harmonic-balance solution, and where time integration goes from those
 * that are unstable, the orbit of the exact law as a certificate, about which hbmcheck-proof decides (proof/). What
 * is found here needs no trust: a wrong candidate is not proven. What proven means: docs/proof.md. */
#pragma once

#include <jansson.h>

#include "compare/compare_settings.h"
#include "model/casefile/scene.h"

/* Why a row is unproven, X(code, words, meaning). */
#define PROOF_REASONS(X)                                                                                               \
  X(PROOF_NO_REASON, "", "")                                                                                           \
  X(PROOF_GRAZE, "graze", "a contact's condition is met with nothing to spare: it just touches, or just slips")        \
  X(PROOF_TWO_AT_ONCE, "two transitions at once",                                                                      \
    "two contacts that have nothing to do with each other change together")                                            \
  X(PROOF_CONE_EDGE, "edge of the cone", "a contact that touches neither sticks nor slips for certain")                \
  X(PROOF_SLIDER_AT_LIMIT, "slider at its limit", "a slider that never slips is on the verge of it")                   \
  X(PROOF_FOLD, "fold", "two orbits next to each other, or one that is about to vanish: the equations are singular")   \
  X(PROOF_CIRCLE, "circle", "friction in a plane, whose slip is not linear")                                           \
  X(PROOF_SMOOTH, "smooth law", "a contact's law is not made of straight pieces")                                      \
  X(PROOF_NO_ORBIT, "no orbit found", "no periodic orbit of the exact law was found there")                            \
  X(PROOF_TOO_FEW, "too few harmonics",                                                                                \
    "with more of them, and the mean, harmonic balance has no solution there, and no orbit was found")                 \
  X(PROOF_TOO_LARGE, "too large", "so many coordinates, transitions or steps that the checker does not begin")         \
  X(PROOF_NO_DIGITS, "out of digits", "the bounds are too wide in the numbers that were used")

#define PROOF_ENUM(code, words, meaning) code,
typedef enum proof_reason { PROOF_REASONS(PROOF_ENUM) PROOF_N_REASONS } proof_reason;
#undef PROOF_ENUM
const char *proof_reason_text(proof_reason r);
const char *proof_reason_meaning(proof_reason r);

/* low <= what it is <= high; NaN: not known. */
typedef struct proof_bounds {
  double low, high;
} proof_bounds;

enum { PROOF_NAME = 64, PROOF_STATES = 32, PROOF_DETAIL = 160 };

typedef struct proof_row {
  double omega;
  int branch; /* of the HBM solution; -1: a steady state beside them */
  bool proven;
  proof_reason reason;       /* where it is not */
  char detail[PROOF_DETAIL]; /* what the checker said, for a message */
  char states[PROOF_STATES]; /* letters of the contacts, interval by interval */
  int transitions, multiple; /* of the orbit's period; of how many forcing periods */
  double radius;             /* [1] of the certificate's scales: the orbit is no farther from its numbers */
  int harmonics;             /* of the HBM solution that led to the orbit, where the case's own did not; else 0, */
  bool too_few;              /* or with the most that were tried there is no solution */
  bool by_events;            /* the orbit was found from the events of the motion from the solution */
  bool moved;                /* sliders that never slip had to be moved for it, */
  bool other_member;         /* which changed its amplitude: the error of HBM's is not known */
  int free_sliders;          /* that never slip: where they rest is in the certificate, and for each place there is an
                                orbit; unique is that of these places */
  int stability;             /* +1 proven stable, -1 proven unstable, 0 unproven */
  proof_bounds amplitude, mean, harmonic_1; /* [length] of the orbit */
  proof_bounds multiplier;         /* [1] of the largest Floquet multiplier's modulus, over the orbit's period */
  proof_bounds error;              /* [length] of HBM's amplitude: its value minus the bounds above */
  double hbm_amplitude, predicted; /* [length] its value, and how far off it expected to be; NaN: not known */
  double seconds;                  /* of wall time: the checker's, refining and deciding */
  char certificate[PROOF_NAME];    /* name of the file, where there is one */
} proof_row;

typedef struct proofs {
  int n;
  proof_row *rows;
  hc_status curve_end; /* of the response curve: what lies beyond was not looked at */
} proofs;

/* Called with each row before it is kept, and its certificate (NULL: unproven, nothing to write); it fills in
 * row->certificate. */
typedef hc_status proof_keep(void *self, proof_row *row, const json_t *certificate);

/* At the frequencies of *setup, which is the scene's; the first response. HC_IO: the checker cannot be started, or
 * ended (errno); HC_NO_MEMORY, HC_INTERRUPTED. What was found is kept; free with proofs_clear in any case. */
hc_status prove_run(const scene *sc, const compare_setup *setup, const hc_monitor *monitor, proof_keep *keep,
                    void *keeper, proofs *out);
void proofs_clear(proofs *p);
