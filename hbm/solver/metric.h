/* metric.h - how far two solutions are apart: the one place where lengths of harmonic balance's motions are measured.
 *
 * One size for a whole structure hides a contact that moves a thousandth of another, or that vibrates a thousandth of
 * the static position. So every contact is measured by itself: a change dX moves contact j by r_j dX, r_j its rows (the
 * directions that its law looks at), all harmonics and the mean included, and
 *
 *     relative change of j = |r_j dX|/size_j        size_j = max(sqrt(vibration_j most), own length_j)
 *
 * vibration: |r_j X| without the mean, |.| over its rows and harmonics; most: the largest vibration of a contact of the
 * same part of the structure, parts being what no matrix and no contact joins. So a contact that moves a hundredth of
 * another of its part is followed to ten times the error, relative to itself, that the other is: by vibrations alone
 * curves of many contacts took two to ten times the points, and showed nothing more. Own length: contact_length, of the
 * law about rest, which keeps a resting contact from having none. The first response counts as a contact whose own
 * length is 0. What moves along one line (several contacts of one mass, and its response) is one, with the least of its
 * own lengths; what comes after 4096 is measured with the last. No size is less than a millionth of the largest
 * vibration, where it would be rounding.
 *     length   the largest relative change: decides about errors, steps, and what is the same
 *     inner    sum over contacts of products of relative changes: angles and planes, which need a scalar product
 * Unknowns are coordinates in a basis of the contacts' rows, no motions of contacts: no norm of theirs is used. */
#pragma once

#include "hbm/structure/condensation.h"

typedef struct metric metric; /* never changed once it is made: threads may share it */

/* The metric of m, whose condensation is c. HC_NO_MEMORY: *out is NULL. */
hc_status metric_new(const model *m, const condensation *c, metric **out);
metric *metric_share(metric *m); /* m, one more owner; NULL is allowed */
void metric_free(metric *m);     /* one owner less; NULL is allowed */

/* [dim] Where q rests under the static loads (model/rest.h). */
const double *metric_rest(const metric *m);

/* The metric at a solution X[n_coef], or between X and Y, then with the larger of the two's sizes. */
typedef struct metric_at {
  const metric *m;
  int n_coef;
  const double *X, *Y; /* Y: NULL if there is none */
} metric_at;

/* [1] a, b[n_coef] are changes of X. NaN where any of them is. */
double metric_length(const metric_at *at, const double *a);
double metric_inner(const metric_at *at, const double *a, const double *b);

/* [1] length of a - b. */
double metric_distance(const metric_at *at, const double *a, const double *b);

/* [1] length of what X has from coefficient `from` on: a multiple of dim. */
double metric_tail(const metric_at *at, int from);

/* out[n_coef]: inner(a, b) = out . b. */
void metric_apply(const metric_at *at, const double *a, double *out);

/* weight[dim] [1/length] of steps of Newton's from X: 1 over how far a coordinate may be expected to go. A contact that
 * hardly moves may come to move as much as any other that the structure couples it with, but no more: the largest size
 * of these, here with the mean less the rest. > 0. */
void metric_reach(const metric_at *at, double *weight);
