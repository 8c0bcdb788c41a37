/* rewritten.h - a structure written in another way: the same motions, other numbers. Each has the responses of the
 * model it was made of, first the case's, then that model's degrees of freedom: what they say of a solution is what
 * they must say of the other. */
#ifndef HC_STRESS_REWRITTEN_H
#define HC_STRESS_REWRITTEN_H

#include <stdint.h>

#include "model/model.h"

/* m with its first response, and then each degree of freedom as one. HC_NO_MEMORY, here and below: *out is NULL. */
hc_status rewritten_with_all_responses(const model *m, model **out);

/* In y, x = Q y, for an orthogonal Q[n][n] by columns. */
hc_status rewritten_turned(const model *m, const double *Q, model **out);

/* The numbers of all lengths, forces and times multiplied by these; responses give lengths of theirs. */
hc_status rewritten_in_units(const model *m, double length, double force, double time, model **out);

/* Every contact as two, the first with `part` of its stiffness and load. */
hc_status rewritten_split(const model *m, double part, model **out);

/* With `more` degrees of freedom besides that nothing couples to m's, whose forces and contacts are those of m's first
 * ones where `twice` (more = n), else none, and then stiffness and mass are m's largest. */
hc_status rewritten_beside(const model *m, int more, bool twice, model **out);

/* Whose motion is x(t + delay/omega), delay [rad]. */
hc_status rewritten_delayed(const model *m, double delay, model **out);

/* The two tangents of every contact with one limit for both turned by an angle of its own, drawn at random. */
hc_status rewritten_other_tangents(const model *m, uint64_t *random, model **out);

/* Every matrix and vector, each contact's numbers and every load changed by `part` of their largest entry, at random;
 * what is 0 altogether, and what is symmetric, stays so. */
hc_status rewritten_nudged(const model *m, double part, uint64_t *random, model **out);

/* Q[n][n]: an orthogonal matrix of no particular form; a permutation. */
void random_rotation(uint64_t *random, int n, double *Q);
void random_permutation(uint64_t *random, int n, double *Q);

/* out = Q^T x. */
void turned_vector(int n, const double *Q, const double *x, double *out);

#endif
