/* ball.h - FLINT's balls: an arb_t is a midpoint and a radius, and the result of an operation contains the results for
 * all numbers in its operands. The headers moved when Arb (Debian 12) became a part of FLINT 3 (Debian 13). */
#pragma once

#if __has_include(<flint/arb.h>)
#include <flint/acb_mat.h>
#include <flint/arb_mat.h>
#include <flint/arb_poly.h>
#include <flint/fmpq.h>
#include <flint/fmpq_vec.h>
#else
#include <acb_mat.h>
#include <arb_mat.h>
#include <arb_poly.h>
#include <flint/fmpq.h>
#include <flint/fmpq_vec.h>
#endif
#include <stddef.h>

/* A local number that is cleared at the end of its block: LOCAL(arb) x = {0}, y = {0}. All bits 0 are an initialised 0,
 * except for an fmpq, which must be set before it is read. */
#define LOCAL(type) __attribute__((cleanup(clear_##type))) type##_t
static inline void clear_arb(arb_t *x) { arb_clear(*x); }
static inline void clear_acb(acb_t *x) { acb_clear(*x); }
static inline void clear_arf(arf_t *x) { arf_clear(*x); }
static inline void clear_mag(mag_t *x) { mag_clear(*x); }
static inline void clear_fmpz(fmpz_t *x) { fmpz_clear(*x); }
static inline void clear_fmpq(fmpq_t *x) { fmpq_clear(*x); }
static inline void clear_arb_mat(arb_mat_t *x) { arb_mat_clear(*x); }
static inline void clear_acb_mat(acb_mat_t *x) { acb_mat_clear(*x); }

/* Arrays that are cleared together: a pool of {0}, in an object or LOCAL(pool). All entries are 0 at first. Out of
 * memory ends the program, as inside FLINT; the size of certificates is bounded. */
typedef enum pool_kind { POOL_BYTES, POOL_BALLS, POOL_MAGS, POOL_RATIONALS, POOL_MATRICES } pool_kind;
typedef struct pool_block pool_block;
typedef struct pool {
  pool_block *last;
} pool, pool_t[1];
void *pool_take(pool *p, pool_kind kind, size_t n);
void pool_clear(pool *p);
static inline void clear_pool(pool_t *p) { pool_clear(*p); }
static inline arb_ptr pool_balls(pool *p, slong n) { return pool_take(p, POOL_BALLS, (size_t)n); }
static inline mag_ptr pool_mags(pool *p, slong n) { return pool_take(p, POOL_MAGS, (size_t)n); }
static inline fmpq *pool_rationals(pool *p, slong n) { return pool_take(p, POOL_RATIONALS, (size_t)n); }
