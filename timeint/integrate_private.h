/* integrate_private.h - what the two integrators share; for integrate*.c alone. */
#ifndef HC_TIMEINT_INTEGRATE_PRIVATE_H
#define HC_TIMEINT_INTEGRATE_PRIVATE_H

#include <stddef.h>

#include "timeint/integrate.h"

typedef struct integrator_class {
  hc_status (*tolerance)(integrator *, double);
  hc_status (*period)(integrator *, const model *, double *y, double *slope, integrate_watch *, void *self); /* slope, watch: or NULL */
  hc_status (*dense)(const integrator *, double theta, int order, double *y);
  bool (*slides)(const integrator *, int j, const double *y);
  void (*free)(integrator *);
} integrator_class;

struct integrator { /* the first member of each kind */
  const integrator_class *does;
  long steps, rhs, switches; /* of all finished periods            */
  int flag;                  /* CVODE's last flag other than success */
};

/* The first of n flags that is not CV_SUCCESS, else CV_SUCCESS. */
int integrate_first_flag(const int *flags, size_t n);

#endif
