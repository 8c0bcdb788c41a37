/* model.c - see model.h; the equations stand there. */
#include "timeint/model.h"

#include <math.h>
#include <string.h>

/* Width of the corner in N for one contact: a fraction of the larger of its gap and the motion under a static force.
 * Where a contact opens or closes the motion is at least as large as the gap; a gap of 0 leaves the static motion. */
static double corner_width(const scene *sc, const contact *law)
{
  if (sc->transient.law == TRANSIENT_LAW_EXACT) return 0;
  double length = fabs(sc->force) / scene_max_stiffness(sc);
  return sc->transient.regularisation * fmax(fabs(law->gap), length);
}

static void make_contact(model_contact *mc, const scene *sc, const scene_contact *from, double omega, double length)
{
  const double unit = sc->mass * omega * omega; /* [force/length] */
  contact law = {
      .kt = from->law.kt / unit, .kn = from->law.kn / unit, .mu = from->law.mu, .gap = from->law.gap / length};
  scene_projection(from, &mc->cosine, &mc->sine);
  if (mc->cosine == 0) law.kt = 0; /* u = 0 always: the tangential spring does no work */
  mc->law = law_regularised_make(&law, corner_width(sc, &from->law) / length, sc->transient.regularisation);
  mc->preload = contact_preload(&law);
}

void model_make(model *m, const scene *sc, double omega, double length)
{
  memset(m, 0, sizeof *m);
  m->n_contacts = sc->n_contacts;
  m->n_states = MODEL_W + sc->n_contacts;
  m->k = sc->stiffness / (sc->mass * omega * omega);
  m->c = sc->damping / (sc->mass * omega);
  m->f = sc->force / (sc->mass * omega * omega * length);
  for (int j = 0; j < sc->n_contacts; ++j) make_contact(&m->contact[j], sc, &sc->contacts[j], omega, length);
}

bool model_rhs(const model *m, double theta, const double *y, double *dy)
{
  double force = m->f * cos(theta) - m->c * y[MODEL_P] - m->k * y[MODEL_X];
  double rates = 0;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contact[j];
    law_value l = law_regularised_eval(&c->law, c->cosine * y[MODEL_X], c->sine * y[MODEL_X], y[MODEL_W + j]);
    force -= l.t * c->cosine + l.change * c->sine;
    dy[MODEL_W + j] = l.rate;
    rates += l.rate;
  }
  dy[MODEL_X] = y[MODEL_P];
  dy[MODEL_P] = force;
  return isfinite(y[MODEL_P] + force + rates);
}

void model_jacobian(const model *m, const double *y, double *jac)
{
  const int n = m->n_states;
  double *by_x = jac + MODEL_X * n, *by_p = jac + MODEL_P * n;
  memset(jac, 0, sizeof *jac * (size_t)(n * n));
  by_p[MODEL_X] = 1;
  by_p[MODEL_P] = -m->c;
  by_x[MODEL_P] = -m->k;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contact[j];
    const int w = MODEL_W + j;
    law_derivatives s = law_regularised_derivatives(&c->law, c->cosine * y[MODEL_X], c->sine * y[MODEL_X], y[w]);
    by_x[MODEL_P] -= (s.t_u * c->cosine + s.t_v * c->sine) * c->cosine + s.n_v * c->sine * c->sine;
    by_x[w] = s.rate_u * c->cosine + s.rate_v * c->sine;
    jac[MODEL_P + w * n] = s.t_u * c->cosine;
    jac[w + w * n] = -s.rate_u;
  }
}

bool model_slides(const model *m, int j, const double *y)
{
  const model_contact *c = &m->contact[j];
  if (!(c->sine * y[MODEL_X] + c->law.gap > 0)) return false;
  return law_regularised_eval(&c->law, c->cosine * y[MODEL_X], c->sine * y[MODEL_X], y[MODEL_W + j]).rate != 0;
}
