/* reference.h - what a table's rows are compared with: the exact law's orbits at the compared frequencies, and the
 * peak of its response. */
#ifndef HC_REFERENCE_H
#define HC_REFERENCE_H

#include "compare/accuracy/accuracy.h"
#include "compare/motion.h"

typedef struct target {
  double omega;
  periodic_motion orbit;
} target;

typedef struct reference {
  int n, cap;
  target *targets; /* [n] by frequency */
  int harmonics;   /* of the curve they were looked for from */
  bool peak_by_orbit;
  double peak_amplitude, peak_omega;
} reference;

/* From the curve of `hbm`, whose forces are exact. Free with reference_clear in any case. */
hc_status reference_make(const compare_setup *setup, const comparison *c, hbm_solver *hbm, const hbm_curve *curve,
                         const hc_monitor *monitor, reference *out);
void reference_clear(reference *r);

#endif
