/* scene.h - what a case file says, as plain data: one scene a case file (docs/interface.md). Copy it freely: of its
 * parts only the structure has memory, which copies share, and which belongs to whoever read the case (case_clear,
 * case_file.h). Solvers get parts of it: the model and their settings (scene_setup).
 * Names, units, defaults, ranges and meanings of the fields are in fields.c and nowhere else. */
#pragma once

#include "compare/compare_settings.h"
#include "compare/gate_limits.h"
#include "hbm/hbm_settings.h"
#include "model/model.h"
#include "model/moving_contact.h"
#include "numerics/base/status.h"
#include "timeint/transient_settings.h"

enum {
  SCENE_MAX_CONTACTS = 16 /* of an oscillator in a case file; others have any number */,
  SCENE_MAX_TEXT = 128,
  SCENE_NAME = 32
};

typedef struct scene_structure scene_structure; /* structure.h */

/* How a contact with two tangents limits its traction (T_1, T_2): as a vector, or each direction alone. */
typedef enum contact_limit { CONTACT_LIMIT_CIRCLE, CONTACT_LIMIT_SQUARE } contact_limit;

/* A contact's law in the case: one of contact_smooth, or of these, which are several contacts in the model. A table is
 * as many unilateral springs as it has kinks. */
enum { SCENE_LAW_TABLE = CONTACT_LAWS };
enum { SCENE_MOST_POINTS = 32 };

typedef struct scene_contact {
  contact law;           /* as it was given: scene_contact_law */
  double angle_deg;      /* [deg] -90..90, of the contact's tangent to x */
  double preload;        /* [force] >= 0: kn gap, or without kn the constant normal force */
  char name[SCENE_NAME]; /* of a structure's contact, or "" */
  contact_limit limit;   /* of a structure's contact with two tangents */
  int kind;
  int n_points;
  double points[SCENE_MOST_POINTS][2]; /* [length] ascending, [force] of a table */
} scene_contact;

/* A base that moves harmonically; of both at most one is not 0. */
typedef struct scene_base {
  double amplitude;    /* [length] A of A cos(omega t) */
  double acceleration; /* [length/time^2] a of a cos(omega t) */
} scene_base;

typedef struct scene {
  char title[SCENE_MAX_TEXT], unit_length[16], unit_force[16], unit_time[16];
  scene_structure *structure; /* NULL: an oscillator, of which alone the numbers down to the contacts speak */
  double mass, damping, stiffness;
  double force;    /* forcing.amplitude F0 [force] */
  scene_base base; /* of a structure, too */
  int n_contacts;
  scene_contact contacts[SCENE_MAX_CONTACTS];
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

/* The law in the model, its gap or constant normal force from a preload given instead; of a composed one nothing. */
contact scene_contact_law(const scene_contact *c);
static inline bool scene_contact_is_composed(const scene_contact *c) { return c->kind >= CONTACT_LAWS; }

/* A table's contacts in the model: how many, 1 of any other law; the stiffness of the spring that is left beside them;
 * and these, along direction[n]. f(0) is taken as held by the rest position, as N0 is. */
int scene_contact_parts(const scene_contact *c);
double scene_contact_slope(const scene_contact *c);
double scene_contact_stiffness(const scene_contact *c, bool at_rest); /* with all of them; at_rest: closed at d = 0 */
void scene_contact_put(const scene_contact *c, int n, const double *direction, model_contact *to);
double scene_contact_table(const scene_contact *c, double d); /* f(d) [force] */

/* The contact with its direction to x; not of a table. */
moving_contact scene_moving_contact(const scene_contact *c);

/* Largest stiffness [force/length] that an oscillator's x can see: K and every contact stuck. */
double scene_max_stiffness(const scene *sc);

/* The contacts, of an oscillator or a structure. */
int scene_contact_count(const scene *sc);
const scene_contact *scene_contact_at(const scene *sc, int j);

/* Contact j in the model of the scene: the first of its one or two contacts there (contact_pair, model.h). */
int scene_model_contact(const scene *sc, int j);

/* Does a polynomial push back, somewhere; at_rest: from both sides, far out? False of other laws. */
bool scene_contact_restores(const scene_contact *c, bool at_rest);

static inline bool scene_base_moves(const scene *sc) { return sc->base.amplitude != 0 || sc->base.acceleration != 0; }

/* Is the mean undetermined: stiffness 0, no contact under a preload, and no polynomial that restores? */
bool scene_adrift(const scene *sc);
#define SCENE_ADRIFT                                                                                                   \
  "the mean is undetermined while nothing touches: oscillator.stiffness is 0 and no contact under a preload gives it " \
  "a stiffness"

/* The model of the scene, to free with model_free. HC_NO_MEMORY: *out is NULL. */
hc_status scene_model(const scene *sc, model **out);

/* The model, settings and limits of *sc, which must live as long; scene_setup_clear in any case. HC_NO_MEMORY. */
hc_status scene_setup(const scene *sc, compare_setup *out);
void scene_setup_clear(compare_setup *setup);
