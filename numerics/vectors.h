/* vectors.h - the vectors of KINSOL and CVODE. Debian builds SUNDIALS without optimisation (6.4.1, 7.1.1: each sum goes
 * through memory); its serial vectors take up to a quarter of a comparison. These are the same vectors with loops of
 * ours for the operations that the solvers spend time in. */
#pragma once

#include <nvector/nvector_serial.h>

/* A vector of n numbers, of which every other (N_VClone) has the same operations; NULL: no memory. N_VDestroy frees it.
 * Results are to the last bit those of N_VNew_Serial's, but norms of 128 numbers and more, whose sums are in parts. */
N_Vector vectors_new(int n, SUNContext ctx);
