/* integrate.c - see integrate.h: hands each call to the law's integrator. */
#include "timeint/integrate_private.h"

#include <cvodes/cvodes.h>

void integrate_free(integrator *in)
{
  if (in) in->does->free(in);
}

hc_status integrate_tolerance(integrator *in, double tolerance) { return in->does->tolerance(in, tolerance); }

hc_status integrate_period(integrator *in, const model *m, double *y, integrate_watch *watch, void *self)
{
  return in->does->period(in, m, y, NULL, watch, self);
}

hc_status integrate_slope(integrator *in, const model *m, double *y, double *slope)
{
  return in->does->period(in, m, y, slope, NULL, NULL);
}

hc_status integrate_dense(const integrator *in, double theta, int order, double *y) { return in->does->dense(in, theta, order, y); }
bool integrate_slides(const integrator *in, int j, const double *y) { return in->does->slides(in, j, y); }

long integrate_steps(const integrator *in) { return in->steps; }
long integrate_rhs(const integrator *in) { return in->rhs; }
long integrate_switches(const integrator *in) { return in->switches; }
int integrate_flag(const integrator *in) { return in->flag; }

int integrate_first_flag(const int *flags, size_t n)
{
  for (size_t i = 0; i < n; ++i)
    if (flags[i] != CV_SUCCESS) return flags[i];
  return CV_SUCCESS;
}
