/* events_newton.c - see events_newton.h. Proof: tests/timeint/test_circle.c. */
#include "timeint/cvode/events_newton.h"

#include <string.h>

hc_status events_newton_make(events_newton *s, const modal_base *base, const contact_track *track,
                             const contact_forces_linear *law, const int *own_of, workspace *w)
{
  s->track = track;
  s->law = law;
  s->own_of = own_of;
  s->slopes = workspace_array(w, (size_t)base->n_contacts, sizeof *s->slopes);
  s->curved = workspace_array(w, (size_t)base->n_contacts, sizeof *s->curved);
  return step_equations_make(&s->step, base, w);
}

void events_newton_linearise(events_newton *s, const scaled_model *m, const double *y)
{
  for (int j = 0; j < s->step.n_contacts; j += scaled_directions(m, j)) {
    const scaled_contact *c = &m->contact[j];
    s->step.contact[j].directions = scaled_directions(m, j);
    if (scaled_directions(m, j) == 2) s->step.contact[j + 1].directions = 0;
    s->curved[j] = s->track[j].turns || c->kind->smooth;
    if (!s->curved[j]) continue;
    const contact_motion at = scaled_motion_at(m, j, y);
    s->slopes[j] = c->kind->slopes(&s->track[j], c, &at, s->own_of[j] < 0 ? 0 : y[2 * s->step.n + s->own_of[j]]);
  }
}

/* dz/dd at constant x, p. */
static double share_of(const events_newton *s, int j) { return 1 / (1 - s->step.gamma * s->slopes[j].rate_own); }

bool events_newton_factor(events_newton *s, const scaled_model *m, double gamma)
{
  s->step.gamma = gamma;
  for (int j = 0; j < s->step.n_contacts; ++j) {
    const int directions = s->step.contact[j].directions;
    step_contact f = {.directions = directions};
    for (int k = 0; k < directions; ++k) {
      f.by_u[k][k] = s->law[j + k].t_u;
      f.by_v[k] = s->law[j + k].t_v;
      f.n_v = s->law[j + k].n_v;
    }
    if (directions > 0 && s->curved[j]) {
      const law_slopes *l = &s->slopes[j];
      for (int k = 0; k < directions; ++k) {
        const double by_z = l->t_own[k] * share_of(s, j);
        for (int i = 0; i < directions; ++i) f.by_u[k][i] += by_z * l->rate_du[i];
        f.by_v[k] += l->t_v[k] + by_z * s->step.gamma * l->rate_v;
      }
      f.by_u[0][0] += l->t_du / gamma;
      f.n_v += l->n_v;
    }
    s->step.contact[j] = f;
  }
  return step_equations_factor(&s->step, m);
}

void events_newton_solve(events_newton *s, double *r)
{
  step_equations *step = &s->step;
  const int n = step->n;
  double *d = r + 2 * n, u[2];
  contact_rows_motion(&step->rows, r, step->q);
  memset(step->force, 0, (size_t)step->n_rows * sizeof *step->force);
  for (int j = 0; j < step->n_contacts; ++j) {
    if (step->contact[j].directions == 0 || !s->curved[j]) continue;
    const law_slopes *l = &s->slopes[j];
    double *z = d + s->own_of[j];
    step_equations_motion(step, j, step->contact[j].directions, u);
    step_equations_add(step->force, step->rows.along[j], -l->t_du / step->gamma * u[0]); /* t_du t . p where x = 0 */
    if (s->own_of[j] < 0) continue;
    *z = share_of(s, j) * (*z - l->rate_du[0] * u[0] - l->rate_du[1] * u[1]); /* z where x = 0 */
    for (int k = 0; k < 2; ++k) step_equations_add(step->force, step->rows.along[j + k], l->t_own[k] * *z);
  }
  step_equations_solve(step, r, r + n);
  for (int j = 0; j < step->n_contacts; ++j) {
    if (step->contact[j].directions == 0 || !s->curved[j] || s->own_of[j] < 0) continue;
    const law_slopes *l = &s->slopes[j];
    const double v = step_equations_motion(step, j, 2, u);
    d[s->own_of[j]] += share_of(s, j) * (step->gamma * l->rate_v * v + l->rate_du[0] * u[0] + l->rate_du[1] * u[1]);
  }
}
