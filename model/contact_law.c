/* contact_law.c - see contact_law.h; the law itself stands there. */
#include "model/contact_law.h"

contact contact_in_units(const contact *c, double stiffness, double length, double rate)
{
  contact in = *c;
  in.kt /= stiffness, in.kn /= stiffness, in.gap /= length, in.load /= stiffness * length, in.epsilon /= rate;
  in.across[0] /= stiffness * length, in.across[1] /= stiffness;
  double unit = stiffness; /* [force/length^p] */
  for (int i = 0; i < CONTACT_POWERS; ++i) {
    unit /= length;
    if (in.power[i] != 0) in.power[i] /= unit;
  }
  return in;
}

contact_state contact_step(const contact *c, double u, double v, double *w, double *t)
{
  double n = contact_normal(c, v);
  if (!(n > 0)) {
    *w = u;
    *t = 0;
    return CONTACT_SEPARATED;
  }
  double limit = c->mu * n;
  *t = c->kt * (u - *w);
  if (fabs(*t) <= limit) return CONTACT_STICK;
  double s = *t > 0 ? 1 : -1;
  *t = s * limit;
  *w = u - *t / c->kt; /* kt > 0: with kt = 0 the predictor is 0, which sticks */
  return s > 0 ? CONTACT_SLIP_PLUS : CONTACT_SLIP_MINUS;
}

contact_state contact_step_planar(const contact *c, const double u[2], double v, double w[2], double T[2])
{
  const double N = contact_normal(c, v), limit = c->mu * N;
  if (!(N > 0)) {
    for (int d = 0; d < 2; ++d) w[d] = u[d], T[d] = 0;
    return CONTACT_SEPARATED;
  }
  for (int d = 0; d < 2; ++d) T[d] = c->kt * (u[d] - w[d]);
  const double size = hypot(T[0], T[1]);
  if (size <= limit) return CONTACT_STICK;
  for (int d = 0; d < 2; ++d) {
    T[d] *= limit / size;
    w[d] = u[d] - T[d] / c->kt; /* kt > 0: with kt = 0 the predictor is 0, which sticks */
  }
  return CONTACT_SLIP_PLUS;
}

contact_state contact_on_touch(const contact *c, double du, double dv)
{
  double friction = c->mu * c->kn * dv;
  if (c->kt * du > friction) return CONTACT_SLIP_PLUS;
  if (-c->kt * du > friction) return CONTACT_SLIP_MINUS;
  return CONTACT_STICK;
}

const char *contact_regime_name(contact_regime regime)
{
  switch (regime) {
  case CONTACT_LINEAR: return "linear";
  case CONTACT_STUCK: return "stick";
  case CONTACT_BENDS: return "smooth";
  case CONTACT_SLIPS: return "slip";
  case CONTACT_SEPARATES: return "separation";
  }
  return "unknown";
}
