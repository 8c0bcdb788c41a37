/* answer.h - the decision as JSON, with decimals rounded outward. */
#pragma once

#include "proof/prove.h"

/* Decimals, to be freed with free(): x to an absolute 10^place, rounded down (-1), up (1) or to the nearest (0). */
char *decimal_write(const arf_t x, slong place, int round);
/* Exponent of ten of the leading digit; `otherwise` for 0. */
slong decimal_place(const arf_t x, slong otherwise);
/* [low, high] containing x, each end moved outward by at least `pad`. */
json_t *decimal_interval(const arb_t x, const mag_t pad, slong precision);

/* The answer in the format of README.md. c may be NULL; why: the reason if the file is wrong, else NULL. */
json_t *answer_json(const certificate *c, const decision *v, const char *why);
