/* scaled.c - see scaled.h; the equations stand there. */
#include "timeint/scaled.h"

#include <math.h>
#include <string.h>

/* Width of the corner in N for one contact: a fraction of the larger of its gap and the motion under a static force.
 * Where a contact opens or closes the motion is at least as large as the gap; a gap of 0 leaves the static motion. */
static double corner_width(const model *m, const transient_settings *how, const contact *law)
{
  if (how->law == TRANSIENT_LAW_EXACT) return 0;
  double length = fabs(model_force(m)) / model_max_stiffness(m);
  return how->regularisation * fmax(fabs(law->gap), length);
}

static void make_contact(scaled_contact *sc, const model *m, const transient_settings *how, const model_contact *from,
                         double omega, double length)
{
  const double unit = *m->mass * omega * omega; /* [force/length] */
  contact law = {
      .kt = from->law.kt / unit, .kn = from->law.kn / unit, .mu = from->law.mu, .gap = from->law.gap / length};
  sc->cosine = *from->tangent;
  sc->sine = *from->normal;
  if (sc->cosine == 0) law.kt = 0; /* u = 0 always: the tangential spring does no work */
  sc->law = law_regularised_make(&law, corner_width(m, how, &from->law) / length, how->regularisation);
  sc->preload = contact_preload(&law);
}

void scaled_make(scaled_model *m, const model *from, const transient_settings *how, double omega, double length)
{
  m->n_contacts = from->n_contacts;
  m->n_states = SCALED_W + from->n_contacts;
  m->k = *from->stiffness / (*from->mass * omega * omega);
  m->c = *from->damping / (*from->mass * omega);
  m->f = model_force(from) / (*from->mass * omega * omega * length);
  for (int j = 0; j < from->n_contacts; ++j) make_contact(&m->contact[j], from, how, &from->contacts[j], omega, length);
}

bool scaled_rhs(const scaled_model *m, double theta, const double *y, double *dy)
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

void scaled_jacobian(const scaled_model *m, const double *y, double *jac)
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

bool scaled_slips(const scaled_model *m, int j, const double *y)
{
  const scaled_contact *c = &m->contact[j];
  if (!(c->sine * y[SCALED_X] + c->law.gap > 0)) return false;
  return law_regularised_eval(&c->law, c->cosine * y[SCALED_X], c->sine * y[SCALED_X], y[SCALED_W + j]).rate != 0;
}
