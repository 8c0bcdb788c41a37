/* scene.c - see scene.h. */
#include "model/casefile/scene.h"

#include <stdio.h>

#include "numerics/base/constants.h"

double scene_omega(const scene *sc, double given) { return sc->in_cycles ? TWO_PI * given : given; }

double scene_frequency(const scene *sc, double omega) { return sc->in_cycles ? omega / TWO_PI : omega; }

const char *scene_where(const scene *sc, double omega, char text[SCENE_WHERE])
{
  if (sc->in_cycles) snprintf(text, SCENE_WHERE, "frequency = %.10g (omega = %.10g)", omega / TWO_PI, omega);
  else snprintf(text, SCENE_WHERE, "omega = %.10g", omega);
  return text;
}

double scene_max_stiffness(const scene *sc)
{
  double k = *sc->structure->stiffness.v;
  for (int j = 0; j < scene_contact_count(sc); ++j) {
    const scene_contact *given = scene_contact_at(sc, j);
    const moving_contact c = scene_moving_contact(given);
    k += moving_contact_stuck_stiffness(&c) + scene_contact_stiffness(given, false);
  }
  return k;
}

bool scene_adrift(const scene *sc)
{
  double x;
  bool is_free = false;
  return scene_is_oscillator(sc) && structure_free_motion(sc->structure, true, &x, &is_free) == HC_OK && is_free;
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
  const hc_status made = structure_model(sc->structure, out);
  if (made == HC_OK && sc->structure->base) move_base(&sc->base, sc->structure->n, (*out)->loads + (*out)->n_loads - 1);
  return made;
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
                         .reduction = sc->structure->reduction_error};
  if (sc->transient.regularisation <= TRANSIENT_USUAL_REGULARISATION)
    out->transient.regularisation_error = CHECKED_TO * sc->gate.most.amplitude;
  return st;
}

void scene_setup_clear(compare_setup *setup)
{
  model_free((model *)setup->model); /* const in compare_setup, but made by scene_setup */
  setup->model = NULL;
}
