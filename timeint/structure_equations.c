/* structure_equations.c - see structure_equations.h. Proof: tests/timeint/test_structure.c. */
#include "timeint/structure_equations.h"

#include <math.h>
#include <string.h>

void structure_linear_force(const scaled_model *m, double theta, const double *y, double *out)
{
  const modal_base *b = m->base;
  const int n = m->n;
  memset(out, 0, (size_t)n * sizeof *out);
  for (int l = 0; l < b->n_loads; ++l) {
    const double c = m->by_load * cos(b->harmonic[l] * theta), s = m->by_load * sin(b->harmonic[l] * theta);
    const double *cosine = b->cosine + (size_t)l * (size_t)n, *sine = b->sine + (size_t)l * (size_t)n;
    for (int i = 0; i < n; ++i) out[i] += c * cosine[i] + s * sine[i];
  }
  modal_base_subtract_K(b, m->by_K, y, out);
  modal_base_subtract_C(b, m->by_C, y + n, out);
}

/* Of direction j alone, or of the circle it is one of. */
static law_value value_of(const scaled_model *m, int j, const double *y)
{
  const scaled_contact *c = &m->contact[j];
  const int first = scaled_first(m, j);
  double u[2], v;
  if (!c->circle && !c->second) {
    scaled_contact_motion(m, j, y, u, &v);
    return law_regularised_eval(&c->law, u[0], v, y[2 * m->n + j]);
  }
  scaled_circle_motion(m, first, y, u, &v);
  const circle_value both = law_circle_eval(&c->law, u, v, y + 2 * m->n + first);
  return (law_value){.n = both.n, .change = both.change, .t = both.t[j - first], .rate = both.rate[j - first]};
}

bool structure_rhs(const scaled_model *m, double theta, const double *y, double *dy)
{
  const int n = m->n;
  double *force = dy + n, sum = 0;
  structure_linear_force(m, theta, y, force);
  for (int j = 0; j < m->n_contacts; ++j) {
    const law_value l = value_of(m, j, y);
    const double *t = m->base->tangent + (size_t)j * (size_t)n, *normal = m->base->normal + (size_t)j * (size_t)n;
    for (int i = 0; i < n; ++i) force[i] -= l.t * t[i] + l.change * normal[i];
    dy[2 * n + j] = l.rate;
    sum += l.rate;
  }
  for (int i = 0; i < n; ++i) {
    dy[i] = y[n + i];
    sum += y[n + i] + force[i];
  }
  return isfinite(sum);
}

static void fill_linear(const scaled_model *m, double *jac)
{
  const modal_base *b = m->base;
  const size_t n = (size_t)m->n, ld = (size_t)m->n_states;
  for (size_t col = 0; col < n; ++col) {
    double *by_x = jac + col * ld, *by_p = jac + (n + col) * ld;
    by_p[col] = 1;
    if (b->diagonal_K) by_x[n + col] = -m->by_K * b->K[col];
    if (b->diagonal_C) by_p[n + col] = -m->by_C * b->C[col];
    for (size_t row = 0; row < n && !b->diagonal_K; ++row) by_x[n + row] = -m->by_K * b->K[col * n + row];
    for (size_t row = 0; row < n && !b->diagonal_C; ++row) by_p[n + row] = -m->by_C * b->C[col * n + row];
  }
}

circle_derivatives structure_law(const scaled_contact *c, const double *u, double v, const double *w)
{
  if (c->circle) return law_circle_derivatives(&c->law, u, v, w);
  const law_derivatives s = law_regularised_derivatives(&c->law, *u, v, *w);
  return (circle_derivatives){
      .n_v = s.n_v, .t_u = {{s.t_u}}, .t_v = {s.t_v}, .rate_u = {{s.rate_u}}, .rate_v = {s.rate_v}};
}

/* What motion along direction b of a contact, tangents t[][n], does to direction a of it. */
static void add_direction(double *jac, size_t n, size_t ld, size_t w, const double *t, int a, int b,
                          const circle_derivatives *s)
{
  const double *pulls = t + (size_t)a * n, *moves = t + (size_t)b * n;
  double *slider = jac + (w + (size_t)b) * ld;
  for (size_t col = 0; col < n; ++col) {
    const double force = s->t_u[a][b] * moves[col];
    for (size_t row = 0; row < n; ++row) jac[col * ld + n + row] -= pulls[row] * force;
    jac[col * ld + w + (size_t)a] += s->rate_u[a][b] * moves[col];
  }
  for (size_t row = 0; row < n; ++row) slider[n + row] += s->t_u[a][b] * pulls[row];
  slider[w + (size_t)a] = -s->rate_u[a][b];
}

void structure_jacobian(const scaled_model *m, const double *y, double *jac)
{
  const size_t n = (size_t)m->n, ld = (size_t)m->n_states;
  memset(jac, 0, ld * ld * sizeof *jac);
  fill_linear(m, jac);
  for (int j = 0; j < m->n_contacts; j += scaled_directions(m, j)) {
    const size_t w = 2 * n + (size_t)j;
    const int directions = scaled_directions(m, j);
    const double *t = m->base->tangent + (size_t)j * n, *normal = m->base->normal + (size_t)j * n;
    double u[2], v;
    if (directions == 2) scaled_circle_motion(m, j, y, u, &v);
    else scaled_contact_motion(m, j, y, u, &v);
    const circle_derivatives s = structure_law(&m->contact[j], u, v, y + w);
    for (int a = 0; a < directions; ++a)
      for (int b = 0; b < directions; ++b) add_direction(jac, n, ld, w, t, a, b, &s);
    for (int a = 0; a < directions; ++a) {
      for (size_t col = 0; col < n; ++col) {
        const double force_t = s.t_v[a] * normal[col], force_n = s.n_v * normal[col], *along = t + (size_t)a * n;
        for (size_t row = 0; row < n; ++row) jac[col * ld + n + row] -= along[row] * force_t + normal[row] * force_n;
        jac[col * ld + w + (size_t)a] += s.rate_v[a] * normal[col];
      }
    }
  }
}
