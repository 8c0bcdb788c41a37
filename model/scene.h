/* scene.h - what is simulated and how, as plain data: one scene a case file (docs/interface.md, 1).
 *
 *     M x'' + C x' + K x + sum_j [ T_j cos(alpha_j) + (N_j - N0_j) sin(alpha_j) ] = F0 cos(omega t)
 *     u_j = x cos(alpha_j)   tangential motion        v_j = x sin(alpha_j)   normal motion
 *
 * x is measured from the static equilibrium. Any consistent set of units. A scene owns no memory: copy it freely.
 * Names, units, defaults, ranges and meanings of the fields are in fields.c and nowhere else. */
#ifndef HC_SCENE_H
#define HC_SCENE_H

#include <stdbool.h>

#include "model/contact_law.h"

enum { SCENE_MAX_CONTACTS = 16, SCENE_MAX_LIST = 256, SCENE_MAX_TEXT = 128, SCENE_MAX_HARMONICS = 200, SCENE_AUTO = 0 };

typedef struct scene_list {
  int n;
  double v[SCENE_MAX_LIST];
} scene_list;

typedef struct scene_contact {
  contact law;
  double angle_deg; /* [deg] 0..90, of the contact's tangent to x */
} scene_contact;

typedef enum { HBM_FORCE_EXACT, HBM_FORCE_SAMPLED } hbm_force_kind;
typedef enum { HBM_RESTART_INTERPOLATED, HBM_RESTART_SAMPLE } hbm_restart_kind;
typedef enum { HBM_CONTINUATION_AUTO, HBM_CONTINUATION_NATURAL, HBM_CONTINUATION_ARCLENGTH } hbm_continuation_kind;
typedef enum { TRANSIENT_LAW_REGULARISED, TRANSIENT_LAW_EXACT } transient_law_kind;
typedef enum { TRANSIENT_STEADY_AUTO, TRANSIENT_STEADY_MARCH, TRANSIENT_STEADY_SHOOTING } transient_steady_kind;
typedef enum {
  TRANSIENT_START_HBM,
  TRANSIENT_START_REST,
  TRANSIENT_START_UP,
  TRANSIENT_START_DOWN
} transient_start_kind;

typedef struct scene_hbm {
  int harmonics;    /* 1..SCENE_MAX_HARMONICS, or SCENE_AUTO */
  bool keep_mean;   /* `static`: keep harmonic 0 */
  int force;        /* hbm_force_kind */
  int samples;      /* per period, >= 2 harmonics + 1, or SCENE_AUTO */
  int restart;      /* hbm_restart_kind */
  int continuation; /* hbm_continuation_kind */
  double tolerance; /* [1] relative to the forces that make up the residual */
  double accuracy;  /* [1] what auto harmonics and samples aim at: error relative to the solution */
  bool skip_linear; /* points where nothing happens at the contacts come from the closed form */
} scene_hbm;

typedef struct scene_transient {
  int law;               /* transient_law_kind */
  double regularisation; /* [1] */
  bool richardson;       /* extrapolate to no regularisation */
  int steady;            /* transient_steady_kind */
  int start;             /* transient_start_kind */
  double tolerance;      /* [1] relative distance to the periodic orbit */
  int max_periods;
} scene_transient;

typedef struct scene_compare {
  scene_list omega;     /* [rad/time]; n = 0: use `points` */
  int points;           /* spread over the sweep, dense at peaks */
  scene_list harmonics; /* truncation orders to report */
  scene_list samples;   /* sampling rates to report */
} scene_compare;

/* [1] largest relative discrepancy */
typedef struct scene_gate {
  double amplitude, harmonic_1, mean, waveform;
} scene_gate;

typedef struct scene_gate_ranges {                  /* other limits in parts of the sweep; see scene_gate_at */
  scene_list omega;                                 /* [rad/time] from, to, from, to, ..., ends included */
  scene_list amplitude, harmonic_1, mean, waveform; /* [1] one a range; n = 0: as outside the ranges */
} scene_gate_ranges;

/* most for the response curve; 0: no limit */
typedef struct scene_gate_cost {
  int iterations, evaluations;
} scene_gate_cost;

typedef struct scene {
  char title[SCENE_MAX_TEXT], unit_length[16], unit_force[16], unit_time[16];
  double mass, damping, stiffness;
  double force; /* forcing.amplitude F0 [force] */
  int n_contacts;
  scene_contact contacts[SCENE_MAX_CONTACTS];
  double omega_from, omega_to; /* [rad/time] > 0, from != to; from > to sweeps downwards */
  scene_hbm hbm;
  scene_transient transient;
  scene_compare compare;
  scene_gate gate;
  scene_gate_ranges gate_ranges;
  scene_gate_cost gate_cost;
} scene;

/* cos and sin of the contact's angle, exact at 0 and 90 degrees. The one place where x becomes (u, v) = (c x, s x). */
void scene_projection(const scene_contact *c, double *cosine, double *sine);

/* Stiffness [force/length] the contact adds to x while stuck (kt c^2 + kn s^2). */
double scene_stuck_stiffness(const scene_contact *c);

/* Largest stiffness x can see: K plus every contact stuck. */
double scene_max_stiffness(const scene *sc);

/* The limits that hold at omega: the gate's, or those of the last range omega lies in. */
scene_gate scene_gate_at(const scene *sc, double omega);

#endif
