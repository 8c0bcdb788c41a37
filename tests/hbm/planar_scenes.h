/* planar_scenes.h - contacts with two tangents, and motions in their plane, for tests. */
#pragma once

#include "hbm/planar/planar_aft.h"
#include "tests/hbm/scenes.h"

enum { CIRCLE_MAX_H = 25, CIRCLE_MAX_LENGTH = 2 * CIRCLE_MAX_H + 1, CIRCLE_MAX_X = 3 * CIRCLE_MAX_LENGTH };

/* The law of a pair's halves, from the contact's own (model.h). */
static inline contact circle_half(contact whole)
{
  return (contact){whole.kt, whole.kn / 2, 2 * whole.mu, whole.gap, whole.load / 2};
}

/* planar_aft.h's evaluator of a contact whose half is this. */
static inline hc_status make_sampled(int H, int N, hbm_restart restart, int n_dof, const contact *half, void **out)
{
  const contact_coordinates c = {.n_dof = n_dof, .moved = {.law = *half}};
  const evaluator_settings how = {.n_harm = H, .n_time = N, .restart = restart};
  return planar_aft_evaluator.make(&c, &how, out);
}

/* A contact for motions of size about 1, with friction: mostly always in contact, or coming and going; one in four
 * under a constant normal force. */
static inline contact random_circle(uint64_t *seed)
{
  contact law = {.kt = pow(10, random_signed(seed)), .mu = 0.2 + 0.3 * (1 + random_signed(seed))};
  if (random_signed(seed) < -0.5) {
    law.load = law.kt / law.mu * pow(10, random_signed(seed) - 0.3);
    return law;
  }
  law.kn = law.kt * pow(10, 0.7 * random_signed(seed));
  law.gap = 0.7 + random_signed(seed);
  return law;
}

/* X[3 (2H+1)] of u_1, u_2, v. */
static inline void random_plane_motion(uint64_t *seed, int H, double decay, double *X)
{
  for (int d = 0; d < 3; ++d) random_motion(seed, H, 1, decay, X + d * series_length(H));
}

/* The motion's plane turned by an angle, of motions as well as of forces. */
static inline void turn_plane(int H, double angle, const double *X, double *Y)
{
  const int n = series_length(H);
  const double c = cos(angle), s = sin(angle);
  for (int i = 0; i < n; ++i) {
    const double x = X[i], y = X[n + i];
    Y[i] = c * x - s * y;
    Y[n + i] = s * x + c * y;
    Y[2 * n + i] = X[2 * n + i];
  }
}

/* dF/dX d at X, row by row, of the forces that `eval` finds: central differences of steps h and 2 h, extrapolated,
 * whose error is h^4 and rounding/h where no state changes between them. Where one does the two disagree; by how much
 * at most is returned. */
static inline double circle_slope_along(int rows, hc_status (*eval)(void *of, const double *X, double *F), void *of,
                                        const double *X, const double *d, double *slope)
{
  static const double steps[4] = {1, -1, 2, -2};
  const double h = 1e-5;
  double Y[CIRCLE_MAX_X], F[4][CIRCLE_MAX_X], disagreement = 0;
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < rows; ++i) Y[i] = X[i] + steps[k] * h * d[i];
    assert_int_equal(eval(of, Y, F[k]), HC_OK);
  }
  for (int i = 0; i < rows; ++i) {
    const double one = (F[0][i] - F[1][i]) / (2 * h), two = (F[2][i] - F[3][i]) / (4 * h);
    disagreement = fmax(disagreement, fabs(one - two));
    slope[i] = (4 * one - two) / 3;
  }
  return disagreement;
}

/* jac[row + rows col] times d. */
static inline void circle_product(int rows, const double *jac, const double *d, double *product)
{
  for (int p = 0; p < rows; ++p) {
    product[p] = 0;
    for (int q = 0; q < rows; ++q) product[p] += jac[p + rows * q] * d[q];
  }
}
