/* prove.h - the whole decision about one certificate, and its words. */
#pragma once

#include "proof/orbit.h"

typedef struct decision {
  failure failure;       /* no reason: accepted */
  bool exists;           /* at both radii       */
  quantities quantities; /* what is proven      */
} decision;
void decision_init(decision *v);
void decision_clear(decision *v);

/* Does the theorem hold as claimed? In this order: existence, sequence, stability, quantities, claims. inverse: of
 * dF/dy, of any quality, [unknowns][unknowns]; NULL: made here. */
bool prove(const certificate *c, const double *inverse, decision *v);

/* Decimals, to be freed with free(): x to an absolute 10^place, rounded down (-1), up (1) or to the nearest (0). */
char *decimal_write(const arf_t x, slong place, int round);
/* The place of the leading digit; of 0: `otherwise`. */
slong decimal_place(const arf_t x, slong otherwise);
/* [low, high] around x, each end moved out by `pad` at least. */
json_t *decimal_interval(const arb_t x, const mag_t pad, slong precision);

/* The answer as README.md has it. certificate: a certificate, or NULL; why: of a file that is wrong, else NULL. */
json_t *answer_json(const certificate *c, const decision *v, const char *why);
