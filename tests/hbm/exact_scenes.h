/* exact_scenes.h - for the tests of exact_force.c: one evaluation, random contacts and motions of one or two
 * coordinates, those that graze, and how far the sampled contact force may be from the exact one. */
#pragma once

#include "hbm/contact/exact_force.h"
#include "tests/hbm/scenes.h"

enum { EXACT_MAX_HARM = 60, EXACT_MAX_COEF = 2 * (2 * EXACT_MAX_HARM + 1), EXACT_MAX_PIECES = 2000 };

typedef struct evaluation {
  double F[EXACT_MAX_COEF];
  contact_report report;
  double w[SCENE_MAX_CONTACTS]; /* sliders at th = 0 */
  int n_intervals[SCENE_MAX_CONTACTS];
  contact_interval interval[EXACT_MAX_PIECES]; /* of contact 0 */
} evaluation;

/* One evaluation in a workspace of its own; jac may be NULL. */
static inline void evaluate(int n_harm, int n_dof, int n_contacts, const moving_contact *c, const double *X,
                            evaluation *out, double *jac)
{
  CHECK_MADE(exact_force, e, exact_force_new(n_harm, n_dof, n_contacts, c, &e));
  hc_status st = exact_force_eval(e, X, out->F, jac, &out->report);
  if (st != HC_OK) fail_msg("exact_force_eval, H=%d: %s", n_harm, hc_status_text(st));
  for (int j = n_contacts - 1; j >= 0; --j) {
    const contact_interval *p = exact_force_intervals(e, j, &out->n_intervals[j]);
    assert_true(out->n_intervals[j] <= EXACT_MAX_PIECES);
    if (j == 0) memcpy(out->interval, p, (size_t)out->n_intervals[0] * sizeof *p);
  }
  exact_force_sliders(e, out->w);
  exact_force_free(e);
}

static inline moving_contact contact_at(contact law, double angle_deg)
{
  moving_contact c = {.law = law};
  model_direction(angle_deg, &c.cu[0], &c.cv[0]);
  return c;
}

/* Bounds of |u^(k)| and |v^(k)|, k = 0, 1, 2, and what u and v are (series). */
typedef struct contact_motion {
  double u[2 * EXACT_MAX_HARM + 1], v[2 * EXACT_MAX_HARM + 1], U[3], V[3];
} contact_motion;

static inline void contact_motion_of(int n_harm, int n_dof, const moving_contact *c, const double *X, contact_motion *m)
{
  int n = series_length(n_harm);
  *m = (contact_motion){{0}, {0}, {0}, {0}};
  for (int i = 0; i < n; ++i) {
    for (int d = 0; d < n_dof; ++d) {
      m->u[i] += c->cu[d] * X[d * n + i];
      m->v[i] += c->cv[d] * X[d * n + i];
    }
    double h = (i + 1) / 2, factor = 1;
    for (int k = 0; k < 3; ++k, factor *= h) {
      m->U[k] += factor * fabs(m->u[i]);
      m->V[k] += factor * fabs(m->v[i]);
    }
  }
}

/* The size of the forces a contact can make of a motion, and of their rates. */
static inline double force_size(const moving_contact *c, const contact_motion *m, int k)
{
  const contact *law = &c->law;
  double gap = k ? 0 : fabs(law->gap);
  return 2 * law->kt * m->U[k] + (1 + law->mu) * law->kn * (m->V[k] + gap);
}

static inline moving_contact random_contact(uint64_t *seed, int n_dof)
{
  if (n_dof == 1) {
    const double angle = random_angle(seed);
    return contact_at(random_law(seed), angle);
  }
  return (moving_contact){random_law(seed), {1, 0}, {0, 1}};
}

/* Make the contact graze: depth > 0 of v + gap at the motion's highest point (kind 0: touches by so much) or at its
 * lowest (kind 1: 0 < depth stays in contact by so much, depth < 0 leaves it by so much). kind 2: mu is so small
 * that slip just happens, by a part `depth` of the friction limit, for a constant normal force (v = 0). */
static inline void make_graze(moving_contact *c, const contact_motion *m, int n_harm, int kind, double depth)
{
  double high, low;
  series_extrema(n_harm, kind == 2 ? m->u : m->v, &high, &low);
  if (kind == 0) c->law.gap = -high + depth;
  if (kind == 1) c->law.gap = -low + depth;
  if (kind != 2) return;
  c->law.gap = 1;
  c->law.mu = c->law.kt * (high - low) / 2 / c->law.kn * (1 - depth);
}

/* The sampled force, w = u where the straight line between samples touches. */
static inline void sampled(int n_harm, int n_dof, const moving_contact *c, const double *X, int n_time, double *F,
                           double *w_at_zero)
{
  const contact_coordinates at = {.n_dof = n_dof, .moved = *c};
  const evaluator_settings how = {.n_harm = n_harm, .n_time = n_time, .slider = {.restart = HBM_RESTART_INTERPOLATED}};
  CHECK_MADE(void, self, aft_evaluator.make(&at, &how, &self));
  CHECK_FILLED(contact_report, report, aft_evaluator.evaluate(self, X, F, NULL, &report));
  aft_evaluator.sliders(self, w_at_zero);
  aft_evaluator.free(self);
}

/* How far the sampled coefficients may be from the exact ones, s = 2 pi/N:
 *   sum      each kink, a jump of the force's derivative <= force_size(1), costs s^2/12 of it (Euler-Maclaurin), with
 *            1/pi in the coefficient
 *   slider   after slip the extremum of u -+ mu N/kt is missed by s^2/8 of its second derivative; after a touch w =
 *            u at a chord's root, off by s^2/8 (U'' + U' V''/v'), and by U' s at most: kt of that for as long as the
 *            slider is stuck, 1/pi of it in the coefficient
 *   rounding of 2^18 sums of the force's size
 * twice, for terms of higher order (s H < 0.02). An interval too short to be sampled fits in: its force is below s^2/8
 * of a second derivative. */
static inline double sampled_error(int n_harm, int n_dof, const moving_contact *c, const double *X, int n_time,
                                   const evaluation *e)
{
  static contact_motion m;
  contact_motion_of(n_harm, n_dof, c, X, &m);
  double s = 2 * PI / n_time, error = 0, projection = 0;
  for (int d = 0; d < n_dof; ++d) projection = fmax(projection, fabs(c->cu[d]) + fabs(c->cv[d]));
  series_vector x = {n_harm, n_dof, {X, X + series_length(n_harm)}};
  for (int i = 0; i < e->n_intervals[0]; ++i) {
    const contact_interval *p = &e->interval[i];
    error += 2 * s * s / 12 / PI * force_size(c, &m, 1);
    double slider = s * s / 8 * force_size(c, &m, 2);
    bool touch = i ? e->interval[i - 1].to < p->from : e->report.regime == CONTACT_SEPARATES;
    if (touch) {
      series_node at = series_vector_at(&x, p->from);
      double dv = 0;
      for (int d = 0; d < n_dof; ++d) dv += c->cv[d] * at.d[1][d];
      dv -= s * m.V[2];
      double chord = s * s / 8 * (m.U[2] + m.U[1] * m.V[2] / dv);
      slider += c->law.kt * (dv > 0 ? fmin(chord, m.U[1] * s) : m.U[1] * s);
    }
    error += slider * (p->to - p->from + 2 * s) / PI;
  }
  return projection *
         (2 * error + 64 * (n_harm + 8) * DBL_EPSILON * force_size(c, &m, 0) + s * s / 8 * force_size(c, &m, 2) * s);
}

/* What rounding may do to exact coefficients: H + 8 terms each of some eps; transitions, off by eps/derivative, move
 * forces that are continuous. */
static inline double exact_rounding(int n_harm, int n_dof, const moving_contact *c, const double *X)
{
  static contact_motion m;
  contact_motion_of(n_harm, n_dof, c, X, &m);
  double projection = 0;
  for (int d = 0; d < n_dof; ++d) projection = fmax(projection, fabs(c->cu[d]) + fabs(c->cv[d]));
  return projection * DBL_EPSILON * (16 * (n_harm + 8) * force_size(c, &m, 0) + 64 * force_size(c, &m, 1));
}
