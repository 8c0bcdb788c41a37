/* scene.h - what a case file says, as plain data: one scene a case file (docs/interface.md). Copy it freely: of its
 * parts only the structure has memory, which copies share, and which belongs to whoever read the case (case_clear,
 * case_file.h). Solvers get parts of it: the model and their settings (scene_setup).
 * Names, units, defaults, ranges and meanings of the fields are in fields.c and nowhere else. */
#pragma once

#include "compare/compare_settings.h"
#include "compare/gate_limits.h"
#include "hbm/hbm_settings.h"
#include "model/casefile/structure.h"
#include "numerics/base/status.h"
#include "timeint/transient_settings.h"

enum { SCENE_MAX_TEXT = 128 };

/* A base that moves harmonically; of both at most one is not 0. */
typedef struct scene_base {
  double amplitude;    /* [length] A of A cos(omega t) */
  double acceleration; /* [length/time^2] a of a cos(omega t) */
} scene_base;

typedef struct scene {
  char title[SCENE_MAX_TEXT], unit_length[16], unit_force[16], unit_time[16];
  scene_structure *structure; /* NULL: nothing has been read */
  scene_base base;
  double omega_from, omega_to; /* [rad/time] > 0, from != to; from > to sweeps downwards */
  bool in_cycles; /* the sweep was given as sweep.frequency: --at, gate.ranges and results are in cycles/time, too */
  hbm_settings hbm;
  transient_settings transient;
  compare_settings compare;
  gate_limits gate;
} scene;

/* [rad/time] of a frequency as the scene's user gives it, and back. */
double scene_omega(const scene *sc, double given);
double scene_frequency(const scene *sc, double omega);

/* "omega = 7", in cycles "frequency = 345 (omega = 2167.698935)"; in text[SCENE_WHERE], which is returned. */
enum { SCENE_WHERE = 64 };
const char *scene_where(const scene *sc, double omega, char text[SCENE_WHERE]);

/* Largest stiffness [force/length] that an oscillator's x can see: K and every contact stuck. */
double scene_max_stiffness(const scene *sc);

/* Was it written with `oscillator`? Then it has the words, columns and limits of one. */
static inline bool scene_is_oscillator(const scene *sc) { return sc->structure->is_oscillator; }

static inline int scene_contact_count(const scene *sc) { return sc->structure->n_contacts; }
static inline const scene_contact *scene_contact_at(const scene *sc, int j)
{
  return &sc->structure->contacts[j].given;
}

/* Contact j in the model of the scene: the first of its one or two contacts there (contact_pair, model.h). */
static inline int scene_model_contact(const scene *sc, int j) { return structure_model_contact(sc->structure, j); }

static inline bool scene_base_moves(const scene *sc) { return sc->base.amplitude != 0 || sc->base.acceleration != 0; }

/* Is an oscillator's mean undetermined: does nothing hold it at rest (structure_free_motion)? Of other structures the
 * reader sees to it. */
bool scene_adrift(const scene *sc);
#define SCENE_ADRIFT                                                                                                   \
  "the mean is undetermined while nothing touches: oscillator.stiffness is 0 and no contact under a preload gives it " \
  "a stiffness"

/* The model of the scene, to free with model_free. HC_NO_MEMORY: *out is NULL. */
hc_status scene_model(const scene *sc, model **out);

/* The model, settings and limits of *sc, which must live as long; scene_setup_clear in any case. HC_NO_MEMORY. */
hc_status scene_setup(const scene *sc, compare_setup *out);
void scene_setup_clear(compare_setup *setup);
