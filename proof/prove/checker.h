/* checker.h - hbmcheck-proof (proof/), the program that decides about certificates, as a child process: one process for
 * all questions, with a line of JSON for each question and answer. HBMCHECK_PROOF names it; else it stands beside this
 * program, or in PATH. */
#pragma once

#include <jansson.h>

#include "numerics/base/status.h"

typedef struct proof_checker proof_checker;

/* HC_IO: it cannot be started, errno tells why; HC_NO_MEMORY. *out is then NULL. */
hc_status proof_checker_new(proof_checker **out);
void proof_checker_free(proof_checker *c); /* ends it; NULL is allowed */

/* Its answer to a question, to be json_decref'd. HC_IO: it has ended, or its answer is not JSON; HC_NO_MEMORY. */
hc_status proof_checker_ask(proof_checker *c, const json_t *question, json_t **answer);
