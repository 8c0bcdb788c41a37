/* prove.h - certificates for the exact law's orbits next to harmonic-balance solutions, and for the motions to which
 * time integration goes from unstable ones; hbmcheck-proof (proof/) decides about them. This code need not be trusted:
 * a wrong candidate is not proven. Meaning of proven: docs/proof.md. */
#pragma once

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

#define PROOF_CODE(code, words, meaning)  code,
#define PROOF_WORDS(code, words, meaning) {words, meaning},
typedef enum proof_reason { PROOF_REASONS(PROOF_CODE) PROOF_N_REASONS } proof_reason;
/* By proof_reason; in the header, so that rows are shown without the library that proves. */
static const struct {
  const char *words, *meaning;
} proof_reasons[] = {PROOF_REASONS(PROOF_WORDS)};
#undef PROOF_CODE
#undef PROOF_WORDS

/* Bounds low <= value <= high; NaN: unknown. */
typedef struct proof_bounds {
  double low, high;
} proof_bounds;

enum { PROOF_NAME = 64, PROOF_STATES = 32, PROOF_DETAIL = 160 };

typedef struct proof_row {
  double omega;
  int branch; /* of the HBM solution; -1: a steady state beside them */
  bool proven;
  proof_reason reason;       /* valid if not proven */
  char detail[PROOF_DETAIL]; /* the checker's reason, for a message */
  char states[PROOF_STATES]; /* letters of the contacts, interval by interval */
  int transitions, multiple; /* number of transitions in the orbit's period; period in forcing periods */
  double radius;             /* [certificate's scales] bound of the distance of the orbit from the certificate's
                                numbers */
  int harmonics;             /* of a finer HBM solution that led to the orbit instead of the case's own; else 0 */
  bool too_few;              /* no HBM solution with the most harmonics tried, and no orbit */
  bool by_events;            /* the orbit was found from the events of a motion that starts at the solution */
  bool moved;                /* sliders that never slip were moved away from their limits */
  bool other_member;         /* this changed the amplitude, so that HBM's error is unknown */
  int free_sliders;          /* number of sliders that never slip: the certificate has their places; the orbit is unique
                                for these places only */
  int stability;             /* +1 proven stable, -1 proven unstable, 0 unproven */
  proof_bounds amplitude, mean, harmonic_1; /* [length] of the orbit */
  proof_bounds multiplier;                  /* [1] largest modulus of a Floquet multiplier, over the orbit's period */
  proof_bounds error;                       /* [length] HBM's amplitude minus the orbit's */
  double hbm_amplitude, predicted;          /* [length] HBM's amplitude, and its own error estimate; NaN: unknown */
  double seconds;                           /* [s] of wall time of the checker, for refining and deciding */
  char certificate[PROOF_NAME];             /* file name; empty: none */
} proof_row;

typedef struct proofs {
  int n;
  proof_row *rows;
  hc_status curve_end; /* status of the response curve, beyond whose end nothing was examined */
} proofs;

/* Callback with each row before it is stored, and its certificate (json_t of <jansson.h>; NULL: unproven); sets
 * row->certificate. */
struct json_t;
typedef hc_status proof_keep(void *self, proof_row *row, const struct json_t *certificate);

/* Proves the first response's motions at the frequencies of *setup, the scene's. HC_IO: the checker cannot be started,
 * or ended (errno); HC_NO_MEMORY, HC_INTERRUPTED. Rows found before an error are kept; call proofs_clear in any
 * case. */
hc_status prove_run(const scene *sc, const compare_setup *setup, const hc_monitor *monitor, proof_keep *keep,
                    void *keeper, proofs *out);
void proofs_clear(proofs *p);
