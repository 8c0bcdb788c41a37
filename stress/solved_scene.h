/* solved_scene.h - a scene under stress: its solutions by every method as the checks need them, and the words a check
 * ends with. */
#ifndef HC_STRESS_SOLVED_SCENE_H
#define HC_STRESS_SOLVED_SCENE_H

#include "hbm/hbm.h"
#include "stress/outcomes.h"
#include "study/scene_solvers.h"
#include "timeint/steady.h"

enum { STRESS_MOST_HARMONICS = 100, STRESS_COEFFICIENTS = 2 * HBM_MAX_HARMONICS + 1 };

/* One HBM solution. */
typedef struct stress_solution {
  hc_status status, stability_status;
  int n_harm;
  double X[STRESS_COEFFICIENTS]; /* [2 n_harm + 1] [length] */
  hbm_measures m;
  scene_state start; /* on it, at t = 0 */
  hbm_stability stability;
} stress_solution;

/* One orbit by time integration. */
typedef struct stress_orbit {
  hc_status status;
  scene_state state;
  timeint_result r;
} stress_orbit;

typedef struct solved_scene {
  const scene *asked; /* as it is                                   */
  scene exact;        /* with exact forces and the exact contact law */
  const scene *sc;    /* = &exact: what the checks work on           */
  double omega;
  double seconds, deadline; /* allowed for one check; when this one ends, by the thread's processor time */
  const hc_monitor *outer;
  hc_monitor monitor;     /* outer's, and the deadline */
  hc_status fatal;        /* HC_OK; HC_INTERRUPTED by outer, HC_NO_MEMORY: nothing further is worth anything */
  stress_solution base;   /* at the scene's own H, exact forces */
  stress_solution fine;   /* with the most harmonics that were needed; base before STRESS_SHOOTING */
  stress_orbit orbit;     /* the exact law's, next to fine */
  stress_check predicted; /* of the comparison that STRESS_VERDICT made */
} solved_scene;

void solved_scene_start(solved_scene *s, const scene *sc, double seconds, const hc_monitor *outer);

/* The clock of a check starts now. */
void stress_clock(solved_scene *s);

/* HBM for sc (any variant of s->asked) at omega from guess[2 n_guess + 1], or from nothing where guess is NULL. */
void stress_solve(solved_scene *s, const scene *sc, double omega, int n_guess, const double *guess,
                  stress_solution *out);

/* The period-1 orbit next to out->state for sc, by shooting, with sc's law. */
void stress_shoot(solved_scene *s, const scene *sc, double omega, stress_orbit *out);

stress_check stress_refuse(solved_scene *s, hc_status st); /* the words for a solver's status; a bug is a finding */

/* |X - Y| / |Y|, of the vectors. */
double stress_distance(int n_coef, const double *X, const double *Y);

/* Each check once; later ones use what earlier ones found, in the order of STRESS_CHECKS. */
stress_check stress_check_force(solved_scene *s);
stress_check stress_check_shift(solved_scene *s);
stress_check stress_check_reflection(solved_scene *s);
stress_check stress_check_free(solved_scene *s);
stress_check stress_check_stuck(solved_scene *s);
stress_check stress_check_units(solved_scene *s);
stress_check stress_check_energy(solved_scene *s);
stress_check stress_check_sampled(solved_scene *s);
stress_check stress_check_shooting(solved_scene *s);
stress_check stress_check_stability(solved_scene *s);
stress_check stress_check_regularised(solved_scene *s);
stress_check stress_check_closed(solved_scene *s);
stress_check stress_check_verdict(solved_scene *s);
stress_check stress_check_predicted(solved_scene *s);

#endif
