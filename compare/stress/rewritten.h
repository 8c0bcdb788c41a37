/* rewritten.h - a structure written in another way: the same motions, other numbers. Its responses are those of the one
 * it was made of, first the case's, then the degrees of freedom: they must say the same of either solution. */
#pragma once

#include <stdint.h>

#include "model/model.h"

/* Its motion is length map x + offset at the time t time, later by the delay. */
typedef struct rewritten {
  model *model;   /* NULL: out of memory */
  double *map;    /* [n][model->n] of each x, what moves as it does, and maybe more columns; NULL: x itself */
  double *offset; /* [n] [length] static position beside x, which responses have, too; NULL: none */
  model *company; /* of one degree of freedom, which comes last in the model and nothing couples; NULL: none */
  double length, force, time; /* [1] numbers of lengths, forces, times are multiplied by these; responses by length */
  double delay;               /* [rad] */
  double ratio;               /* [1] >= 1, its position over the vibration: so much more rounding is in its numbers */
  bool history;               /* a slider that never slips rests elsewhere in it */
  contact_regime regime;      /* of the company, at all frequencies: contact changes below it are not seen */
} rewritten;

void rewritten_clear(rewritten *w);

/* map x[n] into out[model->n]. */
void rewritten_motion(const rewritten *w, int n, const double *x, double *out);

/* m with its first response, and then each degree of freedom as one. HC_NO_MEMORY: *out is NULL. */
hc_status rewritten_with_all_responses(const model *m, model **out);

/* HC_NO_MEMORY, here and below: out->model is NULL; rewritten_clear in any case.
 *
 * Degrees of freedom in another order, and in y, x = Q y for an orthogonal Q of no particular form, drawn at random. */
hc_status rewritten_permuted(const model *m, uint64_t *random, rewritten *out);
hc_status rewritten_rotated(const model *m, uint64_t *random, rewritten *out);

/* In units of which so many are one of m's. */
hc_status rewritten_in_units(const model *m, double length, double force, double time, rewritten *out);

/* Every contact as two, the first with `part` of its stiffness and load. */
hc_status rewritten_split(const model *m, double part, rewritten *out);

/* Two of m that nothing couples. */
hc_status rewritten_copies(const model *m, rewritten *out);

/* With one degree of freedom more that nothing couples to m's, and of m's largest stiffness and mass; then rotated. */
hc_status rewritten_bystander(const model *m, uint64_t *random, rewritten *out);

/* (a, b) of a cos + b sin, n of each, seen from `angle` later; of two tangents those turned by it. */
void rewritten_turn(int n, double angle, double *a, double *b);

/* Whose motion is x(t + delay/omega), delay [rad]. */
hc_status rewritten_delayed(const model *m, double delay, rewritten *out);

/* The two tangents of every contact with one limit for both turned by an angle of its own, drawn at random. */
hc_status rewritten_other_tangents(const model *m, uint64_t *random, rewritten *out);

/* With a static load that moves it by about `size` [length], and gaps moved along: the motion about the new position is
 * the same. That position is drawn so that no slider and no polynomial is moved; where these leave no such position,
 * sliders are (history), and where polynomials alone leave none, there is none (HC_BAD_INPUT). */
hc_status rewritten_shifted(const model *m, double size, uint64_t *random, rewritten *out);

/* With one degree of freedom more, and a contact of its own, that nothing couples to m's: under a load of its own it
 * moves by about `moves` [length] at omega, far below its resonance and well damped: sticking, slipping twice a
 * period, or against a stop that it reaches once a period. */
typedef enum rewritten_company { COMPANY_STUCK, COMPANY_SLIPS, COMPANY_STOPPED, COMPANY_KINDS } rewritten_company;
hc_status rewritten_beside(const model *m, double omega, double moves, rewritten_company kind, rewritten *out);

/* In y_i, x_i = by[i] y_i. */
hc_status rewritten_stretched(const model *m, const double *by, rewritten *out);

/* Every matrix and vector, each contact's numbers and every load changed by `part` of their largest entry, at random;
 * what is 0 altogether, and what is symmetric, stays so. Its motions are others. */
hc_status rewritten_nudged(const model *m, double part, uint64_t *random, rewritten *out);
