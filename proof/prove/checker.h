/* checker.h - hbmcheck-proof (proof/), the program that decides about certificates, as a child process: one for all
 * questions, a line of JSON each way. HBMCHECK_PROOF names it; else it stands beside this program, or in PATH. */
#pragma once

#include <jansson.h>

#include "numerics/base/status.h"

typedef struct proof_checker proof_checker;

/* HC_IO: it cannot be started, errno says why; HC_NO_MEMORY. *out is NULL then. */
hc_status proof_checker_new(proof_checker **out);
void proof_checker_free(proof_checker *c); /* ends it; NULL is allowed */

/* What it answers to that line, to json_decref. HC_IO: it has ended, or answers what is no JSON; HC_NO_MEMORY. */
hc_status proof_checker_ask(proof_checker *c, const json_t *question, json_t **answer);
