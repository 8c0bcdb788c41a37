/* complete.h - makes a certificate from a candidate in double precision. Not trusted: its result is checked. */
#pragma once

#include "proof/around/answer.h"

/* most work of all inverses that Newton makes, as sum of unknowns^3: some tens of seconds */
#define COMPLETE_MOST_WORK 3e10

/* The answer to a candidate in the format of README.md; precision: bits of the balls if the candidate has none, 0:
 * 128. */
json_t *complete(json_t *candidate, int precision, double most_work);
