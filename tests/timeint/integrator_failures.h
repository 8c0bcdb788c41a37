/* integrator_failures.h - what the two integrators by CVODE answer where something fails. */
#pragma once

#include <cvodes/cvodes.h>

#include "tests/scene_parts.h"

/* An integrator by CVODE tells what fails, leaves the state as it was, and works again. */
static inline void
check_integrator_failures(hc_status (*make)(const modal_base *base, double tolerance, integrator **out), scaled_model m)
{
  double y[SCENE_MAX_STATES] = {0.5, 0, 0};
  const double bad[] = {NAN, INFINITY};
  CHECK_MADE(integrator, in, make(m.base, 1e-30, &in)); /* no double is that good */
  assert_int_equal(integrate_period(in, &m, y, NULL, NULL), HC_INTEGRATOR);
  assert_int_equal(integrate_flag(in), CV_TOO_MUCH_ACC);
  CHECK_LE(fabs(y[0] - 0.5) + fabs(y[1]) + fabs(y[2]), 0, "the state stays");
  assert_int_equal(integrate_tolerance(in, 1e-8), HC_OK);
  assert_int_equal(integrate_period(in, &m, y, NULL, NULL), HC_OK); /* and works again */
  for (int i = 0; i < 2; ++i) {
    scaled_model broken = m;
    broken.by_load = bad[i];
    assert_int_equal(integrate_period(in, &broken, y, NULL, NULL), HC_NOT_FINITE);
    double z[SCENE_MAX_STATES] = {0, bad[i], 0};
    assert_int_equal(integrate_period(in, &m, z, NULL, NULL), HC_NOT_FINITE);
  }
  integrate_free(in);
  assert_int_not_equal(make(m.base, -1, &in), HC_OK);
  assert_null(in);
}
