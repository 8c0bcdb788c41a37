/* solved_scene.h - a scene under stress: its HBM solution as the checks need it, in all degrees of freedom, and the
 * checks. No condensed coordinates here: motions are x[2H+1][n], every coefficient's n together. */
#pragma once

#include <stdint.h>

#include "compare/comparison.h"
#include "compare/stress/rewritten.h"
#include "compare/stress/stress.h"
#include "hbm/hbm.h"
#include "timeint/steady/steady.h"

typedef struct solved_scene solved_scene;
typedef struct stress_answers stress_answers; /* answers.c */

/* One solution. */
typedef struct stress_motion {
  hc_status status, stability_status;
  int harmonics;
  double *x; /* [2H+1][n] [length], of the base model's degrees of freedom, in its units */
  hbm_measures m;
  hbm_stability stability;
  hc_status start_status;
  double *start; /* [2 n + contacts] where its transient starts, in the units of the model it is of */
} stress_motion;

/* One orbit by time integration, in all degrees of freedom (orbits.c). */
typedef struct stress_path {
  hc_status status;
  double *state;    /* [2 n + contacts] the start, then a point of it; in the units of the model it is of */
  double *wave;     /* [n][TIMEINT_WAVE] of the base model's degrees of freedom, in its units */
  double amplitude; /* [length] the largest of these */
  double size;      /* [length] how far they go, their mean included */
  double errors;    /* [1] of that: distance from the orbit, and the scatter of periods through (I - Phi)^-1 */
  timeint_result r; /* of the first response */
} stress_path;
struct solved_scene {
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
  bool conditioned;       /* the next three are known */
  double solution_errs;   /* [1] as much as errors of rounding in the data and Newton's tolerance make of it, relative;
                             INFINITY where the solution gets lost */
  double multiplier_rate; /* [1] how much the largest multiplier changes for each unit that a solution does */
  double multiplier_errs; /* [1] what solution_errs makes of it */
  const scene *asked;
  stress_motion fine;     /* with the most harmonics that were needed, from STRESS_ORBIT on */
  stress_path path;       /* the exact law's orbit next to it */
  int enough;             /* harmonics, the fewest tried that are within a hundredth of the gate of it; 0: none are */
  stress_check predicted; /* the worst row of the comparison that STRESS_VERDICT made */
  stress_answers *plain;  /* to what is asked of the scene and of it written another way; NULL: not asked yet */
};

/* The base solution, from nothing. HC_NO_MEMORY; solved_scene_clear in any case. */
hc_status solved_scene_start(solved_scene *s, const scene *sc, double seconds, const hc_monitor *outer);
void solved_scene_clear(solved_scene *s);
void solved_scene_clock(solved_scene *s, int checks); /* the deadline: now and the time of so many checks */

/* HBM of m at omega with how->harmonics, from the guess x[2H+1][m->n], or from nothing where it is NULL. m's responses
 * 1 .. n are the base model's degrees of freedom, in a unit of length of which `length` are one of the base model's. To
 * be freed. */
void stress_motion_solve(solved_scene *s, const model *m, const hbm_settings *how, double omega, const double *guess,
                         double length, stress_motion *out);
void stress_motion_free(stress_motion *m);

/* The motion X[n_coef] of h, a solver of the base model, in all its degrees of freedom. */
hc_status stress_motion_read(const solved_scene *s, hbm_solver *h, double omega, const double *X, int n_coef,
                             double *x);

/* Largest |x - y| over the largest |y|, without the means where they are left `out`; NaN if one is not finite. */
double stress_motion_distance(const solved_scene *s, const double *x, const double *y, bool means_out);

/* s->solution_errs, multiplier_rate and multiplier_errs: by data changed at random, and by the same data from other
 * guesses. Noise in the multiplier of one and the same motion is no excuse, it must follow from the motion's. */
void stress_condition(solved_scene *s);

/* |difference| of the largest multipliers, relative where they are above 1; NaN: one is not known. */
double stress_multipliers_apart(const stress_motion *a, const stress_motion *b);

/* What is left of M x'' + C x' + K x + contact forces - loads for the motion x, over the largest sum of the sizes of
 * what it is made of; written down from the model, each contact's force by itself: the exact one, or where N > 0 its
 * law stepped through N instants a period, and *bound is the most that this may change. NaN: a force failed, or a
 * slider in the plane has not settled. */
double stress_imbalance_sampled(solved_scene *s, const double *x, int N, double *bound);

static inline double stress_imbalance(solved_scene *s, const double *x)
{
  double unused;
  return stress_imbalance_sampled(s, x, 0, &unused);
}

/* What is let pass of it, 100 times Newton's tolerance: that is relative to the forces in the condensed coordinates,
 * which may be larger by what the rest of the structure, held, makes of them. */
static inline double stress_balanced(const solved_scene *s) { return 100 * s->how.tolerance; }

void stress_path_free(stress_path *p);

/* An orbit of m next to the start from[2 n + contacts], by shooting in closed form. stress_path_free in any case. */
void stress_path_of(solved_scene *s, const model *m, const double *from, stress_path *out);

/* Largest difference of the series x[n_coef][n] and an orbit, over the orbit's largest amplitude. */
double stress_path_off(const solved_scene *s, int n_coef, const double *x, const stress_path *p);

/* `compare` at the scene's omega, of m or, NULL, of the scene's model: with as many harmonics as have turned out to be
 * enough for the gate, but for a limit of unknowns, where forces are exact (samples are too few for more than they were
 * drawn with): with too few, all that is said is that the two differ. Along a curve just long enough for what lies
 * beside (`curve` has the long one). What takes more periods is not_settled: chaos takes seconds. Its status, of which
 * HC_NO_MEMORY goes to s->fatal; comparison_clear in any case. */
hc_status stress_compare(solved_scene *s, const model *m, comparison *out);

/* Largest ratio of a row's errors to the gate; above 1: beyond; NaN: one is not known, but for a mean that is free. */
double stress_gate_ratio(const comparison_row *r, const discrepancy *gate);

/* What the program says of the scene, and of it written another way, whose transients begin at start[]: the worst of
 * all that is asked (answers.c). */
stress_check stress_hold_answers(solved_scene *s, const rewritten *w, const double *start);

/* ---- the words a check ends with ---- */

/* A NaN error agrees with nothing. */
stress_check stress_skip(stress_reason why);
stress_check stress_agree(double error, double bound);
stress_check stress_explain(stress_reason why, double error, double bound);
stress_check stress_find(stress_reason why, double error, double bound);

/* [1] A sensitivity above it explains nothing: nothing can be held against anything there. */
#define STRESS_SAYS_SOMETHING 1e-3

/* Agreed up to `least`; explained as ill-conditioned up to `sensitive`, or skipped where that says nothing. */
stress_check stress_agree_within(double error, double least, double sensitive);

/* The words for a solver's status; a bug is a finding. HC_NO_MEMORY goes to s->fatal. */
stress_check stress_refuse(solved_scene *s, hc_status st);

stress_check stress_worse(stress_check a, stress_check b);

/* What `compare` found in a row beside what both sides said it would be. */
stress_check stress_hold_prediction(const comparison_row *r);

/* The checks. */
#define STRESS_FUNCTION(code, name, function, meaning) stress_check function(solved_scene *);
STRESS_CHECKS(STRESS_FUNCTION)
#undef STRESS_FUNCTION
