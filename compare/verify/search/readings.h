/* readings.h - how the columns may be meant, and how far the points are from solutions then; private to
 * compare/verify/. */
#ifndef HC_VERIFY_READINGS_H
#define HC_VERIFY_READINGS_H

#include "compare/verify/truth/solutions.h"
#include "model/model.h"

/* ---- what numbers a dimensionless column may have been divided by ---- */

enum { VERIFY_MOST_SCALES = 16 };

typedef struct verify_scale {
  double factor;    /* theirs = factor times ours */
  const char *name; /* "1/F0" */
} verify_scale;

/* The factors that the model suggests, those that make sense: how many. */
int verify_value_scales(const model *m, verify_scale out[VERIFY_MOST_SCALES]);
int verify_omega_scales(const model *m, verify_scale out[VERIFY_MOST_SCALES]);

/* The name of one of n that the factor is within the part `tolerance` of, NULL: none. */
const verify_scale *verify_scale_near(const verify_scale *s, int n, double factor, double tolerance);

/* ---- how the columns may be meant ---- */

/* The points that hypotheses are held against: some that differ from the truth and some that do not, omega
 * ascending. */
typedef struct verify_sample {
  int n;
  double *omega, *value;    /* [n] */
  double *decibel;          /* [n] the values if they are in dB where the file says not, or the other way */
  bool *differs;            /* [n] */
  double *scratch;          /* [2n] */
  verify_quantity quantity; /* what the file says it is */
  double part;              /* [1] a distance is what this part of the points is within, 0.9; 0: their geometric mean */
} verify_sample;

/* HC_NO_MEMORY. */
hc_status verify_sample_new(const verify_report *r, const verify_quantity *quantity, verify_sample *out);
void verify_sample_clear(verify_sample *s);

typedef void verify_keep(void *self, const verify_hypothesis *h);

/* Every reading of the values for the solutions s. *given: the equations, what the omegas are multiplied by, and the
 * causes in that; keep() gets it with each reading. `otherwise`: the cause where nothing else is one. Distances below
 * `floor` are all the same. A unit of length is no cause where it is one of the n `scales`, which may be meant. */
void verify_read_all(const verify_sample *p, const verify_solutions *s, const verify_hypothesis *given,
                     verify_causes otherwise, double floor, int n, const verify_scale *scales, verify_keep *keep,
                     void *self);

/* One reading: number `reading` of verify_reading, times `factor`. *h likewise gets the rest. */
void verify_read_one(const verify_sample *p, const verify_solutions *s, int reading, double factor, double floor,
                     verify_hypothesis *h);

/* [1] The mean distance of the points as they stand, with a ceiling: what fits of a factor are led by, as
 * it changes with every point. */
double verify_closeness(const verify_sample *p, const verify_solutions *s);

/* How far the points are as they stand. */
double verify_read_plain(const verify_sample *p, const verify_solutions *s);

/* [1] How far solutions a are from the nearest of b: the largest at an omega, nine of ten points that differ are
 * within. */
double verify_apart(const verify_sample *p, const verify_solutions *a, const verify_solutions *b);

#endif
