/* structure_newton.c - see structure_newton.h. Proof: tests/timeint/test_large.c. */
#include "timeint/cvode/structure_newton.h"

#include <string.h>

/* Contact j's motion from s->step.q, and its rate from s->dq if a law depends on it. */
static contact_motion moves_of(const structure_newton *s, const scaled_model *m, int j, int directions)
{
  contact_motion at = {0};
  at.v = step_equations_motion(&s->step, j, directions, at.u);
  if (m->by_rates) at.du[0] = contact_rows_at(s->dq, s->step.rows.along[j]); /* such laws have one tangent */
  return at;
}

static void find_motion(const structure_newton *s, const scaled_model *m, const double *y)
{
  contact_rows_motion(&s->step.rows, y, s->step.q);
  if (m->by_rates) contact_rows_motion(&s->step.rows, y + s->step.n, s->dq);
}

hc_status structure_newton_make(structure_newton *s, const modal_base *base, workspace *w)
{
  const size_t contacts = (size_t)base->n_contacts;
  s->law = workspace_array(w, contacts, sizeof *s->law);
  s->share = workspace_array(w, contacts, sizeof *s->share);
  if (step_equations_make(&s->step, base, w) != HC_OK) return HC_NO_MEMORY;
  s->dq = workspace_doubles(w, (size_t)s->step.n_rows);
  return s->dq ? HC_OK : HC_NO_MEMORY;
}

bool structure_newton_rate(const structure_newton *s, const scaled_model *m, double theta, const double *y, double *dy,
                           contact_state *state)
{
  const step_equations *step = &s->step;
  const int n = step->n;
  double sum = 0;
  scaled_linear_force(m, theta, y, dy + n);
  find_motion(s, m, y);
  memset(step->force, 0, (size_t)step->n_rows * sizeof *step->force);
  for (int j = 0, directions; j < step->n_contacts; j += directions) {
    const scaled_contact *c = &m->contact[j];
    directions = scaled_directions(m, j);
    const contact_motion moves = moves_of(s, m, j, directions);
    const planar_value l = c->kind->evaluate(&c->law, &moves, y + 2 * n + j);
    for (int a = 0; a < directions; ++a) {
      step_equations_add(step->force, step->rows.along[j + a], l.t[a]);
      step_equations_add(step->force, step->rows.across[j + a], l.change);
      dy[2 * n + j + a] = l.rate[a];
      sum += l.rate[a];
      if (state) state[j + a] = scaled_state_of(m, j, moves.v, &l);
    }
  }
  contact_rows_pull(&step->rows, 1, step->force, dy + n);
  memcpy(dy, y + n, (size_t)n * sizeof *dy);
  for (int i = 0; i < 2 * n; ++i) sum += dy[i];
  return isfinite(sum);
}

void structure_newton_linearise(structure_newton *s, const scaled_model *m, const double *y)
{
  step_equations *step = &s->step;
  find_motion(s, m, y);
  for (int j = 0; j < step->n_contacts; ++j) {
    const int directions = m->contact[j].direction > 0 ? 0 : scaled_directions(m, j);
    const scaled_contact *c = &m->contact[j];
    const contact_motion moves = moves_of(s, m, j, directions);
    step->contact[j].directions = directions;
    if (directions > 0) s->law[j] = c->kind->derivatives(&c->law, &moves, y + 2 * step->n + j);
  }
}

/* (1 + gamma r_u)^-1 */
static void invert_rates(const planar_derivatives *l, double gamma, int directions, double share[2][2])
{
  const double a = 1 + gamma * l->rate_u[0][0], b = gamma * l->rate_u[0][1];
  const double c = gamma * l->rate_u[1][0], d = 1 + gamma * l->rate_u[1][1];
  share[0][1] = share[1][0] = share[1][1] = 0;
  if (directions == 1) {
    share[0][0] = 1 / a;
    return;
  }
  const double det = a * d - b * c;
  share[0][0] = d / det, share[0][1] = -b / det;
  share[1][0] = -c / det, share[1][1] = a / det;
}

bool structure_newton_factor(structure_newton *s, const scaled_model *m, double gamma)
{
  s->step.gamma = gamma;
  /* f = by_u (u - d) + by_v v where the slider is w = share (d + gamma (r_u u + r_v v)). */
  for (int j = 0; j < s->step.n_contacts; ++j) {
    const planar_derivatives *l = &s->law[j];
    const int directions = s->step.contact[j].directions;
    step_contact f = {.directions = directions, .by_v = {l->t_v[0], l->t_v[1]}, .n_v = l->n_v};
    if (directions > 0) invert_rates(l, gamma, directions, s->share[j]);
    for (int a = 0; a < directions; ++a)
      for (int b = 0; b < directions; ++b) {
        for (int k = 0; k < directions; ++k) f.by_u[a][b] += l->t_u[a][k] * s->share[j][k][b];
        f.by_v[a] -= f.by_u[a][b] * gamma * l->rate_v[b];
      }
    if (directions > 0) f.by_u[0][0] += l->t_du / gamma; /* t . p = (u - t . a)/gamma */
    s->step.contact[j] = f;
  }
  return step_equations_factor(&s->step, m);
}

/* d[] of contact j becomes its slider w. */
static void find_slider(const structure_newton *s, int j, double *d)
{
  const planar_derivatives *l = &s->law[j];
  const int directions = s->step.contact[j].directions;
  double u[2], sum[2] = {0};
  const double v = step_equations_motion(&s->step, j, directions, u);
  for (int a = 0; a < directions; ++a) {
    double rate = l->rate_v[a] * v;
    for (int b = 0; b < directions; ++b) rate += l->rate_u[a][b] * u[b];
    sum[a] = d[a] + s->step.gamma * rate;
  }
  for (int a = 0; a < directions; ++a) d[a] = s->share[j][a][0] * sum[0] + s->share[j][a][1] * sum[1];
}

void structure_newton_solve(structure_newton *s, double *r)
{
  const int n = s->step.n;
  double *d = r + 2 * n;
  /* s->step.force := contacts' forces at x = 0: -by_u d; with tanh, which has no slider, -by_u t . a. */
  step_equations *step = &s->step;
  bool rates = false;
  for (int j = 0; j < step->n_contacts && !rates; ++j) rates = s->law[j].t_du != 0;
  if (rates) contact_rows_motion(&step->rows, r, s->dq);
  memset(step->force, 0, (size_t)step->n_rows * sizeof *step->force);
  for (int j = 0; j < step->n_contacts; ++j) {
    const step_contact *f = &step->contact[j];
    for (int a = 0; a < f->directions; ++a) {
      double t = 0;
      const double along = s->law[j].t_du != 0 ? contact_rows_at(s->dq, step->rows.along[j]) : d[j];
      for (int b = 0; b < f->directions; ++b) t -= f->by_u[a][b] * (b == 0 ? along : d[j + b]);
      step_equations_add(step->force, step->rows.along[j + a], t);
    }
  }
  step_equations_solve(&s->step, r, r + n);
  for (int j = 0; j < s->step.n_contacts; ++j) find_slider(s, j, d + j);
}

void structure_newton_multiply(structure_newton *s, const scaled_model *m, const double *z, double *out)
{
  const step_equations *step = &s->step;
  const int n = step->n;
  double *force = out + n;
  find_motion(s, m, z);
  memset(step->force, 0, (size_t)step->n_rows * sizeof *step->force);
  /* Linearised forces of contact j for the variation s->step.q, z into s->step.force; its sliders' rates into
   * rate[]. */
  for (int j = 0; j < step->n_contacts; ++j) {
    const double *slider = z + 2 * n + j;
    double *rate = out + 2 * n + j;
    const planar_derivatives *l = &s->law[j];
    const int directions = step->contact[j].directions;
    double u[2];
    const double v = step_equations_motion(step, j, directions, u);
    for (int a = 0; a < directions; ++a) {
      double t = l->t_v[a] * v;
      if (m->by_rates) t += l->t_du * contact_rows_at(s->dq, step->rows.along[j]);
      rate[a] = l->rate_v[a] * v;
      for (int b = 0; b < directions; ++b) {
        t += l->t_u[a][b] * (u[b] - slider[b]);
        rate[a] += l->rate_u[a][b] * (u[b] - slider[b]);
      }
      step_equations_add(step->force, step->rows.along[j + a], t);
      step_equations_add(step->force, step->rows.across[j + a], l->n_v * v);
    }
  }
  memcpy(out, z + n, (size_t)n * sizeof *out);
  memset(force, 0, (size_t)n * sizeof *force);
  modal_base_subtract_K(step->base, m->by_K, z, force);
  modal_base_subtract_C(step->base, m->by_C, z + n, force);
  contact_rows_pull(&step->rows, 1, step->force, force);
}
