/* scene.c - see scene.h. */
#include "cases/scene.h"

#include <stddef.h>
#include <stdio.h>

#include "base/constants.h"

double scene_omega(const scene *sc, double given) { return sc->in_cycles ? TWO_PI * given : given; }

double scene_frequency(const scene *sc, double omega) { return sc->in_cycles ? omega / TWO_PI : omega; }

const char *scene_where(const scene *sc, double omega, char text[SCENE_WHERE])
{
  if (sc->in_cycles) snprintf(text, SCENE_WHERE, "frequency = %.10g (omega = %.10g)", omega / TWO_PI, omega);
  else snprintf(text, SCENE_WHERE, "omega = %.10g", omega);
  return text;
}

model_contact scene_model_contact(const scene_contact *c)
{
  model_contact out = {.law = c->law};
  model_direction(c->angle_deg, &out.tangent, &out.normal);
  return out;
}

double scene_max_stiffness(const scene *sc)
{
  double k = sc->stiffness;
  for (int j = 0; j < sc->n_contacts; ++j) {
    const model_contact c = scene_model_contact(&sc->contacts[j]);
    k += model_stuck_stiffness(&c);
  }
  return k;
}

bool scene_adrift(const scene *sc)
{
  bool held = sc->stiffness > 0;
  for (int j = 0; j < sc->n_contacts; ++j) {
    const model_contact c = scene_model_contact(&sc->contacts[j]);
    held |= c.law.gap > 0 && model_stuck_stiffness(&c) > 0;
  }
  return !held;
}

hc_status scene_model(const scene *sc, model **out)
{
  hc_status st = model_new(sc->n_contacts, out);
  if (st != HC_OK) return st;
  model *m = *out;
  m->mass = sc->mass;
  m->damping = sc->damping;
  m->stiffness = sc->stiffness;
  m->force = sc->force;
  for (int j = 0; j < sc->n_contacts; ++j) m->contacts[j] = scene_model_contact(&sc->contacts[j]);
  return HC_OK;
}

hc_status scene_setup(const scene *sc, compare_setup *out)
{
  model *m;
  hc_status st = scene_model(sc, &m);
  *out = (compare_setup){.model = m,
                         .omega_from = sc->omega_from,
                         .omega_to = sc->omega_to,
                         .hbm = sc->hbm,
                         .transient = sc->transient,
                         .compare = sc->compare,
                         .limits = &sc->gate};
  return st;
}

void scene_setup_clear(compare_setup *setup)
{
  model_free((model *)setup->model); /* const in compare_setup, but made by scene_setup */
  setup->model = NULL;
}
