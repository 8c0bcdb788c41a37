/* structure_path.h - a structure's orbit by time integration, in all degrees of freedom, beside its HBM solution. */
#ifndef HC_STRESS_STRUCTURE_PATH_H
#define HC_STRESS_STRUCTURE_PATH_H

#include "stress/solved_structure.h"
#include "timeint/steady.h"

typedef enum path_way {
  PATH_ORBIT, /* timeint_orbit: next to the start, stable or not */
  PATH_AGAIN, /* timeint_again: the start is on it but for errors of integration */
  PATH_STEADY /* timeint_steady: where the motion goes from the start */
} path_way;

typedef struct stress_path {
  hc_status status;
  double *state;    /* [2 n + contacts] the start, then a point of it; in the units of the model it is of */
  double *wave;     /* [n][TIMEINT_WAVE] of the base model's degrees of freedom, in its units */
  double amplitude; /* [length] the largest of these */
  double errors;    /* [1] of that: distance from the orbit, and the scatter of periods through (I - Phi)^-1 */
  timeint_result r; /* of the first response */
} stress_path;

/* The exact law in closed form, from where the start says. */
transient_settings stress_path_settings(void);

/* Room for an orbit of m, its start from[2 n + contacts]. HC_NO_MEMORY goes to s->fatal; stress_path_free in any
 * case. */
void stress_path_make(solved_structure *s, const model *m, const double *from, stress_path *out);
void stress_path_free(stress_path *p);

/* From p->state to the orbit. m's responses 1 .. n are the base model's degrees of freedom, `length` of its units of
 * length are one of the base model's. p->status is that of the way; also HC_NOT_SETTLED where it is of several
 * periods. */
void stress_path_follow(solved_structure *s, const model *m, const transient_settings *how, double omega, path_way way,
                        double length, stress_path *p);

/* HBM of m, a rewritten base model with its coordinates, with n_harm harmonics from those of p, `shift` samples later;
 * *out has so many. stress_motion_free in any case. */
void stress_motion_beside(solved_structure *s, const model *m, const stress_path *p, int shift, int n_harm,
                          stress_motion *out);

/* Largest |a(t) - b(t)| of any degree of freedom, b later by `shift` samples, over a's largest amplitude. */
double stress_paths_apart(const solved_structure *s, const stress_path *a, const stress_path *b, int shift);

/* The same of the series x[n_coef][n] and an orbit. */
double stress_path_off(const solved_structure *s, int n_coef, const double *x, const stress_path *p);

#endif
