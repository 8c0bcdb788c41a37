/* wide_vectors.h - inner loops compiled twice, for any x86-64 and for AVX2 (four numbers at a time instead of two); the
 * copy is chosen when the program starts. Products and sums stay two roundings in both, so that results are the same to
 * the last bit. Elsewhere, and under sanitizers (which start later than the choice), there is one copy. For loops over
 * a panel's ten points, too short for BLAS (without it the response curve of structures/plane takes 8 % longer, the
 * least of 15 runs), over samples (slider.c), over vectors (vectors.c, dense.c) and over columns of variations
 * (series_columns.c, modal_flow.c). */
#pragma once

#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && !defined(__AVX2__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/* Before a function's return type. Functions called inside are wide only if they are inlined. */
#define WIDE_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define WIDE_VECTORS
#endif
