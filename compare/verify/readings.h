/* readings.h - how the columns may be meant, and how far the points are from solutions then; private to
 * compare/verify/. */
#ifndef HC_VERIFY_READINGS_H
#define HC_VERIFY_READINGS_H

#include "compare/verify/solutions.h"

enum { VERIFY_FREQUENCIES = 3 };
double verify_omega_factor(int frequency); /* 0: as it stands */

/* The points that hypotheses are held against: some that differ from the truth and some that do not, omega
 * ascending. */
typedef struct verify_sample {
  int n;
  double *omega, *value;    /* [n] */
  bool *differs;            /* [n] */
  double *scratch;          /* [2n] */
  verify_quantity quantity; /* what the file says it is */
  double part;              /* [1] a distance is what this part of the points is within, 0.9; 0: their geometric mean */
} verify_sample;

/* HC_NO_MEMORY. */
hc_status verify_sample_new(const verify_report *r, const verify_quantity *quantity, verify_sample *out);
void verify_sample_clear(verify_sample *s);

/* The best reading of the values for the solutions s, at the sample's omegas read as `frequency`: h with its
 * equations and their causes given gets the rest. `otherwise`: the cause where nothing else is one. Distances below
 * `floor` are all the same. */
void verify_read_best(const verify_sample *p, const verify_solutions *s, int frequency, verify_causes otherwise,
                      double floor, verify_hypothesis *h);

/* How far the points are as they stand. */
double verify_read_plain(const verify_sample *p, const verify_solutions *s);

/* [1] How far solutions a are from the nearest of b: the largest at an omega, nine of ten points that differ are
 * within. */
double verify_apart(const verify_sample *p, const verify_solutions *a, const verify_solutions *b);

#endif
