/* scene_parts.h - the parts of a scene that tests look at from inside: a contact's direction, the equations of time
 * integration. */
#pragma once

#include "compare/study/scene_solvers.h"
#include "tests/check.h"
#include "timeint/closed_form/interval_modes.h"
#include "timeint/period/measure.h"

static inline void scene_direction(const scene_contact *c, double *tangent, double *normal)
{
  model_direction(c->angle_deg, tangent, normal);
}

static inline double scene_stuck_stiffness(const scene_contact *c)
{
  const moving_contact with = scene_moving_contact(c);
  return moving_contact_stuck_stiffness(&with);
}

/* The model of a scene with one contact, of stiffness k, as n equal contacts of stiffness k/n. To free with
 * model_free. */
static inline model *scene_split_model(const scene *sc, int n)
{
  assert_int_equal(sc->structure->n_contacts, 1);
  CHECK_MADE(model, m,
             model_oscillator(*sc->structure->mass.v, *sc->structure->damping.v, *sc->structure->stiffness.v,
                              sc->structure->loads->amplitude, n, &m));
  for (int j = 0; j < n; ++j) {
    m->contacts[j].law = sc->structure->contacts[0].given.law;
    scene_direction(&sc->structure->contacts[0].given, m->contacts[j].tangent, m->contacts[j].normal);
    m->contacts[j].law.kt /= n;
    m->contacts[j].law.kn /= n;
  }
  return m;
}

/* Where in a state of one degree of freedom x and v are, and the slider of contact 0. */
enum { SCALED_X, SCALED_P, SCALED_W };

/* The equations of a scene, whose modes and contacts are in memory of this file: those of the last 16 made are
 * valid. */
static inline void scene_scaled(scaled_model *m, const scene *sc, double omega, double length)
{
  static scaled_contact contacts[16][SCENE_MAX_CONTACTS];
  static modal_base *bases[16];
  static int made;
  const int i = made++ % 16;
  CHECK_MADE(model, from, scene_model(sc, &from));
  modal_base_free(bases[i]);
  assert_int_equal(modal_base_new(from, &bases[i]), HC_OK);
  *m = (scaled_model){.base = bases[i], .contact = contacts[i]};
  scaled_make(m, from, &sc->transient, omega, length);
  model_free(from);
}

/* X'' + c X' + k X = f cos(theta) without contacts, and how X moves a contact: u = cosine X, v = sine X. */
static inline double scene_k(const scaled_model *m) { return m->by_K * *m->base->K; }
static inline double scene_c(const scaled_model *m) { return m->by_C * *m->base->C; }
static inline double scene_f(const scaled_model *m) { return m->by_load * *m->base->cosine; }
static inline double scene_cosine(const scaled_model *m, const scaled_contact *c)
{
  return m->base->tangent[c - m->contact];
}
static inline double scene_sine(const scaled_model *m, const scaled_contact *c)
{
  return m->base->normal[c - m->contact];
}

/* A period from y on, in lengths of `length`, and its measures in *r. */
static inline void scene_measured_period(const scene *sc, const scaled_model *m, double length, integrator *in,
                                         double *y, timeint_result *r)
{
  workspace memory = {0};
  CHECK_MADE(model, from, scene_model(sc, &from));
  CHECK_FILLED(measure, me, measure_make(&me, m->n_states, 1, m->n_contacts, &memory));
  measure_begin(&me, m);
  measure_period(&me, y);
  assert_int_equal(integrate_period(in, m, y, measure_step, &me), HC_OK);
  measure_report(&me, from, 0, length, r);
  model_free(from);
  workspace_free(&memory);
}
