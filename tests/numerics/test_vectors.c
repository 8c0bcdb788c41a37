/* test_vectors.c - every operation against SUNDIALS' own, to the last bit where the sum is in the same order. */
#include <float.h>

#include "numerics/random.h"
#include "numerics/sundials_compat.h"
#include "numerics/vectors.h"
#include "tests/hbm/scenes.h"

enum { SHORT = 127, LONGER = 1003, VECTORS = 3 };

typedef struct both {
  SUNContext ctx;
  N_Vector ours[VECTORS], theirs[VECTORS]; /* of the same numbers */
} both;

static both made(int n)
{
  both b;
  uint64_t seed = 5;
  assert_int_equal(hc_sundials_context(&b.ctx), 0);
  for (int k = 0; k < VECTORS; ++k) {
    b.ours[k] = k ? N_VClone(b.ours[0]) : vectors_new(n, b.ctx); /* as the solvers make theirs */
    b.theirs[k] = N_VNew_Serial(n, b.ctx);
    for (int i = 0; i < n; ++i) NV_Ith_S(b.ours[k], i) = NV_Ith_S(b.theirs[k], i) = random_signed(&seed);
  }
  return b;
}

static void same(const both *b)
{
  const size_t bytes = (size_t)NV_LENGTH_S(b->ours[0]) * sizeof(double);
  for (int k = 0; k < VECTORS; ++k) assert_memory_equal(NV_DATA_S(b->ours[k]), NV_DATA_S(b->theirs[k]), bytes);
}

static void freed(both *b)
{
  for (int k = 0; k < VECTORS; ++k) N_VDestroy(b->ours[k]), N_VDestroy(b->theirs[k]);
  SUNContext_Free(&b->ctx);
}

static void entries_are_theirs_to_the_last_bit(CHECK_STATE)
{
  static const double factor[][2] = {{0.3, 0.7}, {0.3, 0.3}, {0.3, -0.3}, {1, 1}, {1, -1}, {-1, 1}, {1, 0.3}, {0.3, 1}};
  both b = made(LONGER);
  for (size_t i = 0; i < sizeof factor / sizeof *factor; ++i)
    for (int to = 0; to < VECTORS; ++to) { /* the result may be an operand */
      N_VLinearSum(factor[i][0], b.ours[0], factor[i][1], b.ours[1], b.ours[to]);
      N_VLinearSum(factor[i][0], b.theirs[0], factor[i][1], b.theirs[1], b.theirs[to]);
      same(&b);
    }
  for (int to = 0; to < VECTORS; ++to) {
    N_VProd(b.ours[1], b.ours[2], b.ours[to]), N_VProd(b.theirs[1], b.theirs[2], b.theirs[to]), same(&b);
    N_VDiv(b.ours[2], b.ours[1], b.ours[to]), N_VDiv(b.theirs[2], b.theirs[1], b.theirs[to]), same(&b);
    N_VInv(b.ours[1], b.ours[to]), N_VInv(b.theirs[1], b.theirs[to]), same(&b);
    N_VScale(-0.9, b.ours[1], b.ours[to]), N_VScale(-0.9, b.theirs[1], b.theirs[to]), same(&b);
    N_VAbs(b.ours[2], b.ours[to]), N_VAbs(b.theirs[2], b.theirs[to]), same(&b);
  }
  freed(&b);
}

/* Long sums are in parts: each within n eps/2 of the exact one (Higham, section 4.2), all terms being positive. */
static void norms_are_theirs(CHECK_STATE)
{
  static const int length[] = {1, 2, SHORT, SHORT + 1, LONGER};
  for (size_t i = 0; i < sizeof length / sizeof *length; ++i) {
    both b = made(length[i]);
    const double rms = N_VWrmsNorm(b.theirs[0], b.theirs[1]), l2 = N_VWL2Norm(b.theirs[0], b.theirs[1]);
    const double tol = length[i] > SHORT ? length[i] * DBL_EPSILON : 0;
    CHECK_NEAR(N_VWrmsNorm(b.ours[0], b.ours[1]) / rms, 1, tol, "root mean square of %d", length[i]);
    CHECK_NEAR(N_VWL2Norm(b.ours[0], b.ours[1]) / l2, 1, tol, "length of %d", length[i]);
    NV_Ith_S(b.ours[0], length[i] - 1) = NAN;
    assert_true(isnan(N_VWrmsNorm(b.ours[0], b.ours[1])) && isnan(N_VWL2Norm(b.ours[0], b.ours[1])));
    freed(&b);
  }
}

CHECK_TESTS("numerics.vectors", 60, entries_are_theirs_to_the_last_bit, norms_are_theirs)
