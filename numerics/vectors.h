/* vectors.h - the vectors of KINSOL and CVODE. Debian builds SUNDIALS without optimisation (6.4.1, 7.1.1: each sum goes
 * through memory); its serial vectors take up to a quarter of a comparison. These are the same vectors with own loops
 * for the operations that take the solvers' time. */
#pragma once

#include <nvector/nvector_serial.h>

/* A vector of n numbers; clones (N_VClone) have the same operations. NULL: no memory. Free with N_VDestroy. Results
 * equal those of N_VNew_Serial's vectors to the last bit, except norms of 128 numbers and more, which add partial
 * sums. */
N_Vector vectors_new(int n, SUNContext ctx);
