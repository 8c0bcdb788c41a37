/* planar_scenes.h - contacts with two tangents, and motions in their plane, for tests. */
#pragma once

#include "compare/verify/equations/mistakes.h"
#include "hbm/contact/exact_force.h"
#include "hbm/planar/planar_aft.h"
#include "hbm/planar/planar_force.h"
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
  const evaluator_settings how = {.n_harm = H, .n_time = N, .slider = {.restart = restart}};
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

/* Largest force that a motion of that size can cause, for tolerances in roundings of it. */
static inline double circle_force_size(const contact *law, double size)
{
  return law->kt * size + law->kn * (size + fabs(law->gap)) + law->load;
}

/* ---- what located and sampled forces have in common ------------------------------------------------------ */

/* The evaluators of two tangents and of one; of sampled ones the restart and the samples vary. */
typedef struct planar_way {
  const contact_evaluator *by, *line;
  bool sampled;
  double rounding; /* [1] of a line's forces */
} planar_way;

static const slider_rule *const planar_rules[] = {&verify_on_line, &verify_on_sample, &verify_zeroed,
                                                  &verify_kept,    &verify_once,      &verify_once_sampled};
enum { PLANAR_RULES = sizeof planar_rules / sizeof *planar_rules };

static inline void *planar_way_make(const contact_evaluator *by, int H, int N, const slider_rule *slider, int n_dof,
                                    const moving_contact *moved)
{
  const contact_coordinates c = {.n_dof = n_dof, .moved = *moved};
  const evaluator_settings how = {.n_harm = H, .n_time = N, .slider = *slider};
  CHECK_MADE(void, self, by->make(&c, &how, &self));
  return self;
}

static inline void planar_way_derive(const contact_evaluator *by, void *self, const double *X, double *F, double *jac,
                                     contact_report *report)
{
  assert_int_equal(by->evaluate(self, X, F, by->jacobian ? NULL : jac, report), HC_OK);
  if (by->jacobian) by->jacobian(self, jac);
}

/* J d of the circle along the line, against the other's: T along the direction, nothing across. */
static inline void compare_on_line(int H, int n_dof, const double dir[2], const double *d, const double *jac,
                                   const double *line_jac, double tolerance, int trial)
{
  const int n = series_length(H), rows = n_dof * n, line_rows = (n_dof - 1) * n;
  for (int p = 0; p < n; ++p) {
    double along = 0, across = 0, wanted = 0;
    for (int q = 0; q < n; ++q) {
      for (int e = 0; e < 2; ++e) {
        const double *column = jac + (size_t)(e * n + q) * (size_t)rows;
        along += (dir[0] * column[p] + dir[1] * column[n + p]) * dir[e] * d[q];
        across += (dir[0] * column[n + p] - dir[1] * column[p]) * dir[e] * d[q];
      }
      wanted += line_jac[p + line_rows * q] * d[q];
      if (n_dof < 3) continue;
      const double *column = jac + (size_t)(2 * n + q) * (size_t)rows;
      along += (dir[0] * column[p] + dir[1] * column[n + p]) * d[n + q];
      wanted += line_jac[p + line_rows * (n + q)] * d[n + q];
    }
    CHECK_NEAR(along, wanted, tolerance, "trial %d row %d", trial, p);
    CHECK_NEAR(across, 0, tolerance, "trial %d row %d, across", trial, p);
  }
}

/* u = dir U: T = dir T of the law of one tangent; where samples are followed so is the Jacobian, in the directions that
 * stay on the line. */
static inline void check_on_line(const planar_way *way)
{
  static double jac[CIRCLE_MAX_X * CIRCLE_MAX_X], line_jac[4 * CIRCLE_MAX_LENGTH * CIRCLE_MAX_LENGTH];
  uint64_t seed = 21;
  int regimes[4] = {0}, told_apart = 0;
  double U[2 * CIRCLE_MAX_LENGTH], d[2 * CIRCLE_MAX_LENGTH], X[CIRCLE_MAX_X], F[CIRCLE_MAX_X], G[2 * CIRCLE_MAX_LENGTH];
  for (int trial = 0; trial < 600; ++trial) {
    const int H = 1 + trial % 9, N = 2 * H + 20 + 7 * (trial % 40), n = series_length(H);
    const slider_rule *const rule = planar_rules[trial % PLANAR_RULES];
    const double angle = PI * random_signed(&seed), dir[2] = {cos(angle), sin(angle)};
    const contact law = random_circle(&seed);
    const int n_dof = law.kn > 0 ? 3 : 2;
    const moving_contact half = {.law = circle_half(law)}, on_line = {.law = law, .cu = {1, 0}, .cv = {0, n_dof - 2}};
    void *a = planar_way_make(way->by, H, N, rule, n_dof, &half),
         *b = planar_way_make(way->line, H, N, rule, n_dof - 1, &on_line);
    contact_report in_plane, in_line;
    random_motion(&seed, H, 1, 1, U);
    random_motion(&seed, H, 1, 1, U + n);
    for (int i = 0; i < n; ++i) X[i] = dir[0] * U[i], X[n + i] = dir[1] * U[i], X[2 * n + i] = U[n + i];
    planar_way_derive(way->by, a, X, F, jac, &in_plane);
    planar_way_derive(way->line, b, U, G, line_jac, &in_line);
    /* A place of rest in a plane is that of the motion itself, of a line that of its samples: off by the second
     * derivative times step^2/8 at the most, slopes by that times a step. */
    const bool rests =
        way->sampled && in_plane.regime == CONTACT_STUCK && (rule == &verify_on_line || rule == &verify_on_sample);
    const double motion = sum_abs(2 * n, U), step = rests ? 2 * PI * H / N : 0,
                 part = fmax(way->rounding, step * step / 8), tolerance = part * circle_force_size(&law, motion);
    for (int i = 0; i < n; ++i) {
      CHECK_NEAR(dir[0] * F[i] + dir[1] * F[n + i], G[i], tolerance, "trial %d coefficient %d", trial, i);
      CHECK_NEAR(dir[0] * F[n + i] - dir[1] * F[i], 0, tolerance, "trial %d coefficient %d, across", trial, i);
      if (n_dof == 3) CHECK_NEAR(F[2 * n + i], G[n + i], tolerance, "trial %d coefficient %d, normal", trial, i);
    }
    double w[2], w_line;
    way->by->sliders(a, w);
    way->line->sliders(b, &w_line);
    if (!way->sampled || in_plane.regime != CONTACT_LINEAR)
      CHECK_NEAR(dir[0] * w[0] + dir[1] * w[1], w_line, part * (1 + law.kn / law.kt) * motion, "trial %d", trial);
    if (in_plane.regime != in_line.regime) { /* pushed until friction just holds it: a slip by rounding or none */
      ++told_apart;
      assert_true(fmin(in_plane.regime, in_line.regime) == CONTACT_STUCK);
      assert_true(fmax(in_plane.regime, in_line.regime) == CONTACT_SLIPS);
    } else {
      assert_int_equal(in_plane.free_sliders, in_line.free_sliders);
      if (!way->sampled) assert_int_equal(in_plane.transitions, in_line.transitions);
    }
    ++regimes[in_line.regime];
    random_motion(&seed, H, 1, 0, d);
    random_motion(&seed, H, 1, 0, d + n);
    const double change = circle_force_size(&law, 1) * sum_abs(2 * n, d);
    if (way->sampled) compare_on_line(H, n_dof, dir, d, jac, line_jac, fmax(1e-12, step) * change, trial);
    way->by->free(a);
    way->line->free(b);
  }
  assert_true(told_apart < 60);
  for (int r = CONTACT_STUCK; r <= CONTACT_SEPARATES; ++r) assert_true(regimes[r] > 20);
}

/* The plane turned, forces turn with it; the motion begun later (of sampled forces by whole samples), forces begin
 * later too, unless where the slider rests depends on where it began: to 1e-12, as each period of dragging adds its
 * roundings, and few are needed. */
static inline void check_turns_and_shifts(const planar_way *way)
{
  uint64_t seed = 22;
  double X[CIRCLE_MAX_X], Y[CIRCLE_MAX_X], F[CIRCLE_MAX_X], G[CIRCLE_MAX_X], wanted[CIRCLE_MAX_X];
  int shifted = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int H = 1 + trial % 6, N = 2 * H + 12 + 11 * (trial % 20), n = series_length(H), step = 1 + trial % (N - 1);
    const contact law = random_circle(&seed);
    const moving_contact half = {.law = circle_half(law)};
    const int n_dof = law.kn > 0 ? 3 : 2;
    const double angle = PI * random_signed(&seed),
                 shift = way->sampled ? 2 * PI * step / N : PI * random_signed(&seed);
    void *a = planar_way_make(way->by, H, N, planar_rules[trial % 2], n_dof, &half);
    random_plane_motion(&seed, H, 1, X);
    const double tolerance = 1e-12 * circle_force_size(&law, sum_abs(3 * n, X));
    CHECK_FILLED(contact_report, report, way->by->evaluate(a, X, F, NULL, &report));
    turn_plane(H, angle, X, Y);
    turn_plane(H, angle, F, wanted);
    assert_int_equal(way->by->evaluate(a, Y, G, NULL, NULL), HC_OK);
    for (int i = 0; i < n_dof * n; ++i) CHECK_NEAR(G[i], wanted[i], tolerance, "turned, trial %d row %d", trial, i);
    if (!report.free_sliders && ++shifted) {
      for (int d = 0; d < n_dof; ++d) {
        shift_motion(H, X + d * n, shift, Y + d * n);
        shift_motion(H, F + d * n, shift, wanted + d * n);
      }
      assert_int_equal(way->by->evaluate(a, Y, G, NULL, NULL), HC_OK);
      for (int i = 0; i < n_dof * n; ++i) CHECK_NEAR(G[i], wanted[i], tolerance, "shifted, trial %d row %d", trial, i);
    }
    way->by->free(a);
  }
  assert_true(shifted > 150);
}

typedef struct planar_evaluation {
  const contact_evaluator *by;
  void *self;
} planar_evaluation;

static inline hc_status planar_forces(void *of, const double *X, double *F)
{
  const planar_evaluation *e = of;
  return e->by->evaluate(e->self, X, F, NULL, NULL);
}

/* The Jacobian against differences, to 1e-8. A sample that changes its state, or an interval that appears, moves the
 * difference by its kink: those are the trials counted as skipped. */
static inline void check_planar_jacobian(const planar_way *way)
{
  static double jac[CIRCLE_MAX_X * CIRCLE_MAX_X];
  uint64_t seed = 23;
  double X[CIRCLE_MAX_X], d[CIRCLE_MAX_X], F[CIRCLE_MAX_X], slope[CIRCLE_MAX_X], product[CIRCLE_MAX_X];
  int skipped = 0, checked = 0, regimes[4] = {0};
  for (int trial = 0; trial < 480; ++trial) {
    const int H = 1 + trial % 7, N = 2 * H + 10 + 9 * (trial % 25), n = series_length(H);
    const contact law = random_circle(&seed);
    const moving_contact half = {.law = circle_half(law)};
    const int n_dof = law.kn > 0 ? 3 : 2, rows = n_dof * n;
    const bool corner = trial == 330; /* by radial return it comes to stick where two samples' circles meet */
    const slider_rule *const rule = corner            ? &verify_on_sample
                                    : trial % 12 == 7 ? &verify_radial
                                                      : planar_rules[trial % PLANAR_RULES];
    planar_evaluation a = {way->by, planar_way_make(way->by, H, N, rule, n_dof, &half)};
    contact_report report;
    random_plane_motion(&seed, H, 1, X);
    random_plane_motion(&seed, H, 1, d);
    const double size = circle_force_size(&law, 1) * sum_abs(rows, d);
    const double disagreement = circle_slope_along(rows, planar_forces, &a, X, d, slope);
    if (disagreement > 1e-6 * size) ++skipped;
    else {
      ++checked;
      planar_way_derive(way->by, a.self, X, F, jac, &report);
      circle_product(rows, jac, d, product);
      for (int p = 0; p < rows; ++p)
        CHECK_NEAR(product[p], slope[p], 1e-8 * size + disagreement, "trial %d regime %d row %d", trial, report.regime,
                   p);
      ++regimes[report.regime];
    }
    way->by->free(a.self);
  }
  print_message("%d directions checked, %d skipped for a changed state\n", checked, skipped);
  assert_true(skipped < checked / 4);
  for (int r = CONTACT_STUCK; r <= CONTACT_SEPARATES; ++r) assert_true(regimes[r] > 10);
}
