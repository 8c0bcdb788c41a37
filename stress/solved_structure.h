/* solved_structure.h - a structure under stress: its harmonic-balance solution as the checks need it, in all degrees of
 * freedom, and the checks. Nothing here knows the condensed coordinates: motions are x[2H+1][n], every coefficient's n
 * together. */
#ifndef HC_STRESS_SOLVED_STRUCTURE_H
#define HC_STRESS_SOLVED_STRUCTURE_H

#include <stdint.h>

#include "hbm/hbm.h"
#include "stress/rewritten.h"
#include "stress/stress.h"

/* One solution. */
typedef struct stress_motion {
  hc_status status, stability_status;
  double *x; /* [2H+1][n] [length], of the base model's degrees of freedom, in its units */
  hbm_measures m;
  hbm_stability stability;
  hc_status start_status;
  double *start; /* [2 n + contacts] where its transient starts, in the units of the model it is of */
} stress_motion;

typedef struct solved_structure {
  model *model;     /* with all responses */
  hbm_settings how; /* the scene's, exact forces, a tighter tolerance */
  double omega, from, to;
  int n, n_coef;   /* of a motion: n n_coef numbers */
  uint64_t random; /* for what a check draws */
  double seconds, deadline;
  const hc_monitor *outer;
  hc_monitor monitor;
  hc_status fatal; /* HC_OK; HC_INTERRUPTED by outer, HC_NO_MEMORY */
  stress_motion base;
  bool conditioned;       /* the next two are known */
  double solution_errs;   /* [1] as much as errors of rounding in the data and Newton's tolerance make of it, relative;
                             INFINITY where the solution gets lost */
  double multiplier_errs; /* [1] what that makes of the largest multiplier */
  const scene *asked;
  stress_motion fine; /* with the most harmonics that were needed, from STRESS_ORBIT on */
  int fine_harmonics;
  struct stress_path *path; /* the exact law's orbit next to it (structure_path.h) */
  stress_check predicted;   /* of the comparison that STRESS_STRUCTURE_VERDICT made */
} solved_structure;

/* The base solution, from nothing. HC_NO_MEMORY; solved_structure_clear in any case. */
hc_status solved_structure_start(solved_structure *s, const scene *sc, double seconds, const hc_monitor *outer);
void solved_structure_clear(solved_structure *s);
void solved_structure_clock(solved_structure *s); /* of a check starts now */

/* HBM of m at omega, from the guess x[2H+1][m->n], or from nothing where it is NULL. m's responses 1 .. n are the base
 * model's degrees of freedom, in a unit of length of which `length` are one of the base model's. To be freed. */
void stress_motion_solve(solved_structure *s, const model *m, const hbm_settings *how, double omega,
                         const double *guess, double length, stress_motion *out);
void stress_motion_free(stress_motion *m);

/* The motion X of h, a solver of the base model, in all its degrees of freedom. */
hc_status stress_motion_read(const solved_structure *s, hbm_solver *h, double omega, const double *X, double *x);

/* Largest |x - y| over the largest |y|, without the means where they are left `out`; NaN if one is. */
double stress_motion_distance(const solved_structure *s, const double *x, const double *y, bool means_out);

/* s->solution_errs and multiplier_errs: by data changed at random, and by the same data from other guesses. Noise in
 * the multiplier of one and the same motion is no excuse, it must follow from the motion's. */
void solved_structure_condition(solved_structure *s);

/* |difference| of the largest multipliers, relative where they are above 1; INFINITY: one is not known. */
double stress_multipliers_apart(const stress_motion *a, const stress_motion *b);

/* What is left of M x'' + C x' + K x + contact forces - loads for the motion x, over the largest sum of the sizes of
 * what it is made of; written down from the model, each contact's force by itself. NaN: a force failed. */
double stress_imbalance(solved_structure *s, const double *x);

/* What is let pass of it, 100 times Newton's tolerance: that is relative to the forces in the condensed coordinates,
 * which may be larger by what the rest of the structure, held, makes of them. */
static inline double stress_balanced(const solved_structure *s) { return 100 * s->how.tolerance; }

/* How a check of a structure ends that a solver refused. */
stress_check stress_motion_refuse(solved_structure *s, hc_status st);

stress_check stress_structure_force(solved_structure *s);
stress_check stress_structure_balance(solved_structure *s);
stress_check stress_structure_work(solved_structure *s);
stress_check stress_structure_determinant(solved_structure *s);
stress_check stress_structure_permuted(solved_structure *s);
stress_check stress_structure_rotated(solved_structure *s);
stress_check stress_structure_units(solved_structure *s);
stress_check stress_structure_split(solved_structure *s);
stress_check stress_structure_copies(solved_structure *s);
stress_check stress_structure_bystander(solved_structure *s);
stress_check stress_structure_delayed(solved_structure *s);
stress_check stress_structure_sampled(solved_structure *s);
stress_check stress_structure_curve(solved_structure *s);
stress_check stress_structure_orbit(solved_structure *s);
stress_check stress_structure_floquet(solved_structure *s);
stress_check stress_structure_rewritten(solved_structure *s);
stress_check stress_structure_returns(solved_structure *s);
stress_check stress_structure_cvode(solved_structure *s);
stress_check stress_structure_regularised(solved_structure *s);
stress_check stress_structure_verdict(solved_structure *s);
stress_check stress_structure_predicted(solved_structure *s);
stress_check stress_structure_other_tangents(solved_structure *s);

/* All of them, as stress_scene. */
hc_status stress_structure(const scene *sc, double seconds, const hc_monitor *monitor, stress_result *out);

#endif
