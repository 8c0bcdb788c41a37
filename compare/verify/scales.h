/* scales.h - what numbers a dimensionless column may have been divided by; private to compare/verify/. */
#ifndef HC_VERIFY_SCALES_H
#define HC_VERIFY_SCALES_H

#include "model/model.h"

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

#endif
