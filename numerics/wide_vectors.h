/* wide_vectors.h - inner loops compiled twice, the copy being chosen when the program starts: for any x86-64, and for
 * those with AVX2, which take four numbers at a time instead of two. Products and sums stay two roundings in both, so
 * that results are the same to the last bit. Elsewhere, and under sanitizers (which start later than the choice), there
 * is one copy. For loops over a panel's ten points, which a call of BLAS would not pay for (without it the response
 * curve of structures/plane takes 8 % longer, the least of 15 runs), over samples (slider.c),
 * over vectors (vectors.c, dense.c) and over columns of variations (series_columns.c, modal_flow.c). */
#pragma once

#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) && !defined(__AVX2__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/* Before a function's return type. What it calls shares its width only where that is inlined. */
#define WIDE_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define WIDE_VECTORS
#endif
