/* rest.c - see rest.h. Newton on the static equations, whose forces are piecewise linear but for polynomials. If its
 * step does not reduce the residual (a contact opens, or all contacts that resist a motion slip), a step with all
 * contacts stuck is tried. */
#include "model/rest.h"

#include <float.h>
#include <string.h>

#include "numerics/base/workspace.h"
#include "numerics/dense.h"
#include "numerics/norm.h"

enum { ITERATIONS = 100, HALVINGS = 12 };
static const double converged = 1e-12;           /* [statics.size] largest residual that counts as converged where
                                                    Newton stalls */
static const double rounding = 64 * DBL_EPSILON; /* [statics.size] residual that is rounding */

typedef struct statics {
  const model *m;
  const double *load; /* [n] p_0 */
  double *x, *trial;  /* [n] */
  double *R, *step;   /* [n] */
  double *tractions;  /* [n] sum t_j T_j at rest */
  double *J;          /* [n][n] dR/dx */
  int *pivot;         /* [n] */
  double size;        /* [force] sum of |terms| of the last residual */
  double pull;        /* [force] sum of |tractions| in it */
} statics;

/* f[n] += force a; s->size += its terms' sizes. */
static void add_force(statics *s, double force, const double *a, double *f)
{
  for (int i = 0; i < s->m->n; ++i) f[i] += force * a[i], s->size += fabs(force * a[i]);
}

/* Adds T of contact j (with two tangents and one limit: of j and j + 1) to R, its derivatives to J unless NULL. */
static void add_traction(statics *s, int j, const double *x, double *R, double *J)
{
  const model_contact *c = &s->m->contacts[j];
  const int n = s->m->n, directions = c->circle ? 2 : 1;
  const double v = dot_product(n, c->normal, x), spring = v + c->law.gap > 0 ? c->law.kn : 0;
  double u[2] = {0}, w[2] = {0}, T[2] = {0};
  for (int d = 0; d < directions; ++d) u[d] = dot_product(n, c[d].tangent, x);
  const contact_state state =
      directions > 1 ? contact_step_planar(&c->law, u, v, w, T) : contact_step(&c->law, u[0], v, w, T);
  for (int d = 0; d < directions; ++d) add_force(s, T[d], c[d].tangent, R), s->pull += fabs(T[d]);
  if (!J || state == CONTACT_SEPARATED) return;
  /* Slip: T = mu N e, e = u/|u|, so dT = mu kn e dv + (mu N/|u|) (1 - e e^T) du. */
  const double pulled = hypot(u[0], u[1]), limit = c->law.mu * contact_normal(&c->law, v);
  for (int d = 0; d < directions; ++d)
    for (int k = 0; k < directions; ++k) {
      const double e_e = state == CONTACT_STICK ? 0 : u[d] * u[k] / (pulled * pulled);
      const double slope = state == CONTACT_STICK ? c->law.kt * (d == k) : limit / pulled * ((d == k) - e_e);
      add_outer(n, slope, c[d].tangent, c[k].tangent, J);
    }
  for (int d = 0; d < directions && state != CONTACT_STICK; ++d)
    add_outer(n, c->law.mu * spring * u[d] / pulled, c[d].tangent, c->normal, J);
}

/* R = K x + contacts - p_0 at x; J = dR/dx unless NULL. */
static void residual(statics *s, const double *x, double *R, double *J)
{
  const model *m = s->m;
  const int n = m->n;
  s->size = s->pull = 0;
  memset(R, 0, (size_t)n * sizeof *R);
  if (J) memcpy(J, m->stiffness, (size_t)n * (size_t)n * sizeof *J);
  for (int i = 0; i < n; ++i) add_force(s, x[i], m->stiffness + (size_t)i * (size_t)n, R);
  add_force(s, -1, s->load, R);
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    const double v = dot_product(n, c->normal, x);
    double slope = v + c->law.gap > 0 ? c->law.kn : 0;
    const double f =
        contact_never_opens(&c->law) ? contact_polynomial(&c->law, v, &slope) : contact_normal_change(&c->law, v);
    add_force(s, f, c->normal, R);
    if (v + c->law.gap > 0) s->size += c->law.kn * (fabs(v) + fabs(c->law.gap)) * norm_2(n, c->normal);
    if (J) add_outer(n, slope, c->normal, c->normal, J);
    const bool second_of_two = c->circle && c->pair == CONTACT_SECOND;
    if (contact_has_friction(&c->law) && !second_of_two) add_traction(s, j, x, R, J);
  }
}

/* J = K and all contacts stuck. */
static void stuck_stiffness(const model *m, double *J)
{
  memcpy(J, m->stiffness, (size_t)m->n * (size_t)m->n * sizeof *J);
  for (const model_contact *c = m->contacts; c < m->contacts + m->n_contacts; ++c) {
    if (contact_has_friction(&c->law)) add_outer(m->n, c->law.kt, c->tangent, c->tangent, J);
    add_outer(m->n, c->law.kn, c->normal, c->normal, J);
  }
}

/* Line search along -J^-1 R with s->J: moves s->x, or false if no trial reduces |R|. */
static bool step_down(statics *s)
{
  const int n = s->m->n;
  const double before = norm_2(n, s->R);
  if (dense_factor(n, s->J, s->pivot) != HC_OK) return false;
  memcpy(s->step, s->R, (size_t)n * sizeof *s->step);
  dense_solve(n, s->J, s->pivot, 1, s->step);
  double part = 1;
  for (int k = 0; k <= HALVINGS; ++k, part *= 0.5) {
    for (int i = 0; i < n; ++i) s->trial[i] = s->x[i] - part * s->step[i];
    residual(s, s->trial, s->R, NULL);
    if (!(norm_2(n, s->R) < before)) continue;
    memcpy(s->x, s->trial, (size_t)n * sizeof *s->x);
    return true;
  }
  return false;
}

/* Solves for s->x from 0; true if it is a rest position. */
static bool comes_to_rest(statics *s)
{
  for (int k = 0; k < ITERATIONS; ++k) {
    residual(s, s->x, s->R, s->J);
    if (norm_2(s->m->n, s->R) <= rounding * s->size) return true;
    if (step_down(s)) continue;
    residual(s, s->x, s->R, NULL);
    if (norm_2(s->m->n, s->R) <= converged * s->size) return true;
    stuck_stiffness(s->m, s->J);
    if (!step_down(s)) return false;
  }
  return false;
}

/* The polynomial of v about v0: power[p] of (v - v0)^p by Horner's scheme; returns the slope at v0. */
static double expand_about(contact *c, double v0)
{
  enum { N = CONTACT_MOST_POWER + 1 };
  double a[N] = {0};
  memcpy(a + CONTACT_LEAST_POWER, c->power, sizeof c->power);
  for (int k = 0; k < N - 1; ++k)
    for (int p = N - 2; p >= k; --p) a[p] += v0 * a[p + 1];
  memcpy(c->power, a + CONTACT_LEAST_POWER, sizeof c->power);
  c->across[0] = a[0], c->across[1] = a[1];
  return a[1];
}

/* Transforms *m, a copy of s->m, to y. */
static void move_to_rest(statics *s, model *m, int load)
{
  const int n = m->n;
  residual(s, s->x, s->R, NULL);
  const bool is_rounding = s->pull == 0 && norm_2(n, s->R) <= rounding * s->size;
  double *left = m->loads[load].cosine;
  for (int j = 0; j < m->n_contacts; ++j) {
    model_contact *c = &m->contacts[j];
    const double v0 = dot_product(n, c->normal, s->x);
    const bool second_of_two = c->circle && c->pair == CONTACT_SECOND;
    if (contact_has_friction(&s->m->contacts[j].law) && !second_of_two) add_traction(s, j, s->x, s->tractions, NULL);
    if (contact_never_opens(&c->law)) add_outer(n, expand_about(&c->law, v0), c->normal, c->normal, m->stiffness);
    else c->law.gap += v0;
  }
  /* T stays on the left side of the equations; its value at rest is added to the right side. */
  for (int i = 0; i < n; ++i) left[i] = is_rounding ? 0 : s->tractions[i] - s->R[i];
  if (!is_zero(n, left)) return;
  --m->n_loads; /* the block of numbers keeps its vectors */
  for (int l = load; l < m->n_loads; ++l) m->loads[l] = m->loads[l + 1];
}

hc_status model_about_rest(const model *m, model **out, double *rest)
{
  const size_t n = (size_t)m->n;
  int load = 0;
  memset(rest, 0, n * sizeof *rest);
  hc_status st = model_copy(m, out);
  while (load < m->n_loads && m->loads[load].harmonic > 0) ++load;
  if (st != HC_OK || load == m->n_loads || is_zero(m->n, m->loads[load].cosine)) return st;
  workspace w = {0};
  statics s = {.m = m, .load = m->loads[load].cosine, .x = rest};
  s.trial = workspace_doubles(&w, n), s.R = workspace_doubles(&w, n), s.step = workspace_doubles(&w, n);
  s.tractions = workspace_doubles(&w, n);
  s.J = workspace_doubles(&w, n * n);
  s.pivot = workspace_array(&w, n, sizeof *s.pivot);
  if (w.failed) {
    model_free(*out);
    *out = NULL;
    st = HC_NO_MEMORY;
  } else if (comes_to_rest(&s)) {
    move_to_rest(&s, *out, load);
  } else {
    memset(rest, 0, n * sizeof *rest);
  }
  workspace_free(&w);
  return st;
}
