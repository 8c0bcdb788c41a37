/* proofs.h - what prove_run found, as a table and as messages, for every command that proves (cmd_prove.c). */
#pragma once

#include "interfaces/command/cli.h"
#include "proof/prove/prove.h"

/* Also where it ended with another st than HC_OK: it says so then. On stderr, why rows are unproven, unless quiet. */
table *proofs_table(const cli_common *common, const proofs *p, hc_status st);

/* The messages after prove_run ended with st, errno `error` and the curve `curve_end`. 0 or the exit code. */
int proofs_ended(const cli_common *common, hc_status curve_end, hc_status st, int error);
