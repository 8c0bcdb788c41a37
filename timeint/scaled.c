/* scaled.c - see scaled.h; the equations stand there. */
#include "timeint/scaled.h"

#include <math.h>
#include <string.h>

#include "numerics/norm.h"
#include "timeint/law_circle.h"
#include "timeint/structure_equations.h"

/* Width of the corner in N for one contact: a fraction of the larger of its gap and the motion under a static force.
 * Where a contact opens or closes the motion is at least as large as the gap; a gap of 0 leaves the static motion. */
static double corner_width(const scaled_model *to, const model *m, const transient_settings *how, const contact *law)
{
  if (how->law == TRANSIENT_LAW_EXACT) return 0;
  double length = to->base ? to->base->stuck_motion : fabs(model_force(m)) / model_max_stiffness(m);
  return how->regularisation * fmax(fabs(law->gap), length);
}

/* unit [force/length]: of forces, divided by length. */
static void make_contact(scaled_contact *sc, const model_contact *from, double unit, double length, double width,
                         const transient_settings *how, bool oscillator)
{
  contact law = {.kt = from->law.kt / unit,
                 .kn = from->law.kn / unit,
                 .mu = from->law.mu,
                 .gap = from->law.gap / length,
                 .load = from->law.load / (unit * length)};
  sc->cosine = oscillator ? *from->tangent : NAN;
  sc->sine = oscillator ? *from->normal : NAN;
  if (sc->cosine == 0) law.kt = 0; /* u = 0 always: the tangential spring does no work */
  sc->law = law_regularised_make(&law, width / length, how->regularisation);
  sc->preload = contact_preload(&law);
  sc->circle = from->circle && from->pair == CONTACT_FIRST && sc->law.has_friction;
  sc->second = from->circle && from->pair == CONTACT_SECOND && sc->law.has_friction;
}

double scaled_force_unit(const scaled_model *m, const model *from, double omega, double length)
{
  const double mass = m->base ? 1 / (m->base->s * m->base->s) : *from->mass;
  return mass * omega * omega * length;
}

void scaled_make(scaled_model *m, const model *from, const transient_settings *how, double omega, double length)
{
  const double unit = scaled_force_unit(m, from, omega, 1);
  m->n = from->n;
  m->n_contacts = from->n_contacts;
  m->n_states = 2 * from->n + from->n_contacts;
  if (m->base) {
    m->by_K = 1 / (omega * omega);
    m->by_C = 1 / omega;
    m->by_load = 1 / (omega * omega * length);
  } else {
    m->k = *from->stiffness / (*from->mass * omega * omega);
    m->c = *from->damping / (*from->mass * omega);
    m->f = model_force(from) / (*from->mass * omega * omega * length);
  }
  for (int j = 0; j < from->n_contacts; ++j) {
    const model_contact *c = &from->contacts[j];
    make_contact(&m->contact[j], c, unit, length, corner_width(m, from, how, &c->law), how, !m->base);
  }
}

static bool oscillator_rhs(const scaled_model *m, double theta, const double *y, double *dy)
{
  double force = m->f * cos(theta) - m->c * y[SCALED_P] - m->k * y[SCALED_X];
  double rates = 0;
  for (int j = 0; j < m->n_contacts; ++j) {
    const scaled_contact *c = &m->contact[j];
    law_value l = law_regularised_eval(&c->law, c->cosine * y[SCALED_X], c->sine * y[SCALED_X], y[SCALED_W + j]);
    force -= l.t * c->cosine + l.change * c->sine;
    dy[SCALED_W + j] = l.rate;
    rates += l.rate;
  }
  dy[SCALED_X] = y[SCALED_P];
  dy[SCALED_P] = force;
  return isfinite(y[SCALED_P] + force + rates);
}

bool scaled_rhs(const scaled_model *m, double theta, const double *y, double *dy)
{
  return m->base ? structure_rhs(m, theta, y, dy) : oscillator_rhs(m, theta, y, dy);
}

static void oscillator_jacobian(const scaled_model *m, const double *y, double *jac)
{
  const int n = m->n_states;
  double *by_x = jac + SCALED_X * n, *by_p = jac + SCALED_P * n;
  memset(jac, 0, sizeof *jac * (size_t)(n * n));
  by_p[SCALED_X] = 1;
  by_p[SCALED_P] = -m->c;
  by_x[SCALED_P] = -m->k;
  for (int j = 0; j < m->n_contacts; ++j) {
    const scaled_contact *c = &m->contact[j];
    const int w = SCALED_W + j;
    law_derivatives s = law_regularised_derivatives(&c->law, c->cosine * y[SCALED_X], c->sine * y[SCALED_X], y[w]);
    by_x[SCALED_P] -= (s.t_u * c->cosine + s.t_v * c->sine) * c->cosine + s.n_v * c->sine * c->sine;
    by_x[w] = s.rate_u * c->cosine + s.rate_v * c->sine;
    jac[SCALED_P + w * n] = s.t_u * c->cosine;
    jac[w + w * n] = -s.rate_u;
  }
}

void scaled_jacobian(const scaled_model *m, const double *y, double *jac)
{
  if (m->base) structure_jacobian(m, y, jac);
  else oscillator_jacobian(m, y, jac);
}

void scaled_contact_motion(const scaled_model *m, int j, const double *x, double *u, double *v)
{
  if (m->base) {
    *u = dot_product(m->n, m->base->tangent + (size_t)j * (size_t)m->n, x);
    *v = dot_product(m->n, m->base->normal + (size_t)j * (size_t)m->n, x);
  } else {
    *u = m->contact[j].cosine * *x;
    *v = m->contact[j].sine * *x;
  }
}

void scaled_circle_motion(const scaled_model *m, int j, const double *x, double u[2], double *v)
{
  scaled_contact_motion(m, j, x, &u[0], v);
  u[1] = dot_product(m->n, m->base->tangent + (size_t)(j + 1) * (size_t)m->n, x);
}

double scaled_response(const scaled_model *m, int r, const double *x)
{
  return m->base ? dot_product(m->n, m->base->response + (size_t)r * (size_t)m->n, x) : *x;
}

int scaled_n_responses(const scaled_model *m) { return m->base ? m->base->n_responses : 1; }

static contact_state circle_state(const scaled_model *m, int j, const double *y)
{
  double u[2], v;
  scaled_circle_motion(m, j, y, u, &v);
  const circle_value at = law_circle_eval(&m->contact[j].law, u, v, y + 2 * m->n + j);
  return at.rate[0] != 0 || at.rate[1] != 0 ? CONTACT_SLIP_PLUS : CONTACT_STICK;
}

contact_state scaled_contact_state(const scaled_model *m, int j, const double *y)
{
  const law_regularised *law = &m->contact[j].law;
  double u, v;
  scaled_contact_motion(m, j, y, &u, &v);
  if (!(law->kn > 0 ? v + law->gap > 0 : law->load > 0)) return CONTACT_SEPARATED;
  if (m->contact[j].circle || m->contact[j].second) return circle_state(m, scaled_first(m, j), y);
  const double rate = law_regularised_eval(law, u, v, y[2 * m->n + j]).rate;
  return rate > 0 ? CONTACT_SLIP_PLUS : rate < 0 ? CONTACT_SLIP_MINUS : CONTACT_STICK;
}

double scaled_pull(const scaled_model *m, int j)
{
  if (!m->base) return m->contact[j].cosine;
  const double *t = m->base->tangent + (size_t)j * (size_t)m->n;
  return sqrt(dot_product(m->n, t, t));
}
