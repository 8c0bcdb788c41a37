/* scene.c - see scene.h. */
#include "model/casefile/scene.h"

#include <stdio.h>

#include "model/casefile/fields.h"
#include "model/casefile/structure.h"
#include "numerics/base/constants.h"

double scene_omega(const scene *sc, double given) { return sc->in_cycles ? TWO_PI * given : given; }

double scene_frequency(const scene *sc, double omega) { return sc->in_cycles ? omega / TWO_PI : omega; }

const char *scene_where(const scene *sc, double omega, char text[SCENE_WHERE])
{
  if (sc->in_cycles) snprintf(text, SCENE_WHERE, "frequency = %.10g (omega = %.10g)", omega / TWO_PI, omega);
  else snprintf(text, SCENE_WHERE, "omega = %.10g", omega);
  return text;
}

moving_contact scene_moving_contact(const scene_contact *c)
{
  moving_contact out = {.law = scene_contact_law(c), .cv = {1}};
  if (field_is_of_law(field_named("contacts", "angle_deg"), c)) model_direction(c->angle_deg, &out.cu[0], &out.cv[0]);
  return out;
}

double scene_max_stiffness(const scene *sc)
{
  double k = sc->stiffness;
  for (int j = 0; j < sc->n_contacts; ++j) {
    const moving_contact c = scene_moving_contact(&sc->contacts[j]);
    k += moving_contact_stuck_stiffness(&c) + scene_contact_stiffness(&sc->contacts[j], false);
  }
  return k;
}

int scene_contact_count(const scene *sc) { return sc->structure ? sc->structure->n_contacts : sc->n_contacts; }

const scene_contact *scene_contact_at(const scene *sc, int j)
{
  return sc->structure ? &sc->structure->contacts[j].given : &sc->contacts[j];
}

int scene_model_contact(const scene *sc, int j)
{
  int first = 0;
  if (sc->structure) return structure_model_contact(sc->structure, j);
  for (int k = 0; k < j; ++k) first += scene_contact_parts(&sc->contacts[k]);
  return first;
}

bool scene_adrift(const scene *sc)
{
  bool held = sc->structure || sc->stiffness > 0; /* of a structure the reader sees to it */
  for (int j = 0; j < sc->n_contacts; ++j) {
    const moving_contact c = scene_moving_contact(&sc->contacts[j]);
    held |= scene_contact_stiffness(&sc->contacts[j], true) > 0 || scene_contact_restores(&sc->contacts[j], true);
    held |= (c.law.gap > 0 || c.law.load > 0) && moving_contact_stuck_stiffness(&c) > 0;
  }
  return !held;
}

/* load: M r. In coordinates that move with the base, by A cos(omega t) or a cos(omega t) of acceleration, its motion is
 * the load omega^2 M r A cos(omega t), or -M r a cos(omega t). */
static void move_base(const scene_base *base, int n, model_load *load)
{
  load->inertial = base->acceleration == 0;
  for (int i = 0; i < n; ++i) load->cosine[i] *= load->inertial ? base->amplitude : -base->acceleration;
}

hc_status scene_model(const scene *sc, model **out)
{
  const bool moves = scene_base_moves(sc);
  if (sc->structure) {
    const hc_status made = structure_model(sc->structure, out);
    if (made == HC_OK && sc->structure->base)
      move_base(&sc->base, sc->structure->n, (*out)->loads + (*out)->n_loads - 1);
    return made;
  }
  const int n_contacts = scene_model_contact(sc, sc->n_contacts);
  hc_status st = model_oscillator(sc->mass, sc->damping, sc->stiffness, moves ? sc->mass : sc->force, n_contacts, out);
  if (st != HC_OK) return st;
  if (moves) move_base(&sc->base, 1, (*out)->loads);
  model_contact *to = (*out)->contacts;
  for (int j = 0; j < sc->n_contacts; to += scene_contact_parts(&sc->contacts[j++])) {
    const scene_contact *c = &sc->contacts[j];
    const moving_contact one = scene_moving_contact(c);
    *(*out)->stiffness += scene_contact_slope(c);
    to->law = one.law, *to->tangent = one.cu[0], *to->normal = one.cv[0];
    if (scene_contact_is_composed(c)) scene_contact_put(c, 1, (double[]){1}, to);
  }
  return HC_OK;
}

/* [gate.amplitude] the regularised law's own error; a coarser law than usual is what somebody wants to see. */
#define CHECKED_TO 0.1

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
                         .limits = &sc->gate,
                         .reduction = sc->structure ? sc->structure->reduction_error : 0};
  if (sc->transient.regularisation <= TRANSIENT_USUAL_REGULARISATION)
    out->transient.regularisation_error = CHECKED_TO * sc->gate.most.amplitude;
  return st;
}

void scene_setup_clear(compare_setup *setup)
{
  model_free((model *)setup->model); /* const in compare_setup, but made by scene_setup */
  setup->model = NULL;
}
