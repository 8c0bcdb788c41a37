/* circle_law.c - see circle_law.h; the law itself stands there. */
#include "model/circle_law.h"

contact_state circle_step(const contact *law, const double u[2], double v, double w[2], double T[2])
{
  const double N = contact_normal(law, v), limit = law->mu * N;
  if (!(N > 0)) {
    for (int d = 0; d < 2; ++d) w[d] = u[d], T[d] = 0;
    return CONTACT_SEPARATED;
  }
  for (int d = 0; d < 2; ++d) T[d] = law->kt * (u[d] - w[d]);
  const double size = hypot(T[0], T[1]);
  if (size <= limit) return CONTACT_STICK;
  for (int d = 0; d < 2; ++d) {
    T[d] *= limit / size;
    w[d] = u[d] - T[d] / law->kt; /* kt > 0: with kt = 0 the predictor is 0, which sticks */
  }
  return CONTACT_SLIP_PLUS;
}

contact_state circle_on_touch(const contact *law, const double du[2], double dv)
{
  return law->kt * hypot(du[0], du[1]) > law->mu * law->kn * dv ? CONTACT_SLIP_PLUS : CONTACT_STICK;
}

double circle_guard_stick(const contact *law, const double u[2], double v, const double w[2])
{
  const double limit = circle_limit(law, v), size = law->kt * hypot(u[0] - w[0], u[1] - w[1]);
  return (limit - size) * (limit + size); /* the squares of large numbers would not be told apart */
}

double circle_guard_slip(const contact *law, const double e[2], const double du[2], double dv)
{
  return law->kt * (du[0] * e[0] + du[1] * e[1]) - law->mu * law->kn * dv;
}
