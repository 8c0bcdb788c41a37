/* ball.c - arrays of FLINT's numbers that are cleared together. */
#include "proof/ball.h"
#include <stdlib.h>

struct pool_block {
  pool_block *before;
  pool_kind kind;
  size_t n;
  max_align_t first[];
};

void *pool_take(pool *p, pool_kind kind, size_t n)
{
  static const size_t sizes[] = {1, sizeof(arb_struct), sizeof(mag_struct), sizeof(fmpq), sizeof(arb_mat_struct)};
  pool_block *block = flint_calloc(1, sizeof *block + n * sizes[kind] + 1);
  block->before = p->last;
  block->kind = kind;
  block->n = n;
  p->last = block;
  fmpq *rational = (fmpq *)block->first;
  for (size_t i = 0; i < n && kind == POOL_RATIONALS; i++) fmpz_one(fmpq_denref(rational + i));
  return block->first;
}

void pool_clear(pool *p)
{
  while (p->last) {
    pool_block *block = p->last;
    void *first = block->first;
    p->last = block->before;
    for (size_t i = 0; i < block->n && block->kind != POOL_BYTES; i++) switch (block->kind) {
      case POOL_BALLS: arb_clear((arb_ptr)first + i); break;
      case POOL_MAGS: mag_clear((mag_ptr)first + i); break;
      case POOL_RATIONALS: fmpq_clear((fmpq *)first + i); break;
      default: arb_mat_clear((arb_mat_struct *)first + i);
      }
    flint_free(block);
  }
}
