/* complete.h - from a candidate in double precision to a certificate. Not trusted: what it writes is checked. */
#pragma once

#include "proof/around/answer.h"

/* unknowns^3 of all inverses that Newton makes: some tens of seconds */
#define COMPLETE_MOST_WORK 3e10

/* The answer to a candidate, as README.md has it; precision: of the balls if it says nothing, 0: 128 bits. */
json_t *complete(json_t *candidate, int precision, double most_work);
