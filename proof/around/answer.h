/* answer.h - what was decided, as JSON and decimals that are rounded outward. */
#pragma once

#include "proof/prove.h"

/* Decimals, to be freed with free(): x to an absolute 10^place, rounded down (-1), up (1) or to the nearest (0). */
char *decimal_write(const arf_t x, slong place, int round);
/* The place of the leading digit; of 0: `otherwise`. */
slong decimal_place(const arf_t x, slong otherwise);
/* [low, high] around x, each end moved out by `pad` at least. */
json_t *decimal_interval(const arb_t x, const mag_t pad, slong precision);

/* The answer as README.md has it. certificate: a certificate, or NULL; why: of a file that is wrong, else NULL. */
json_t *answer_json(const certificate *c, const decision *v, const char *why);
