/* law_regularised.c - see law_regularised.h; the law itself stands there. */
#include "timeint/law/law_regularised.h"

law_regularised law_regularised_make(const contact *c, double width, double relaxation)
{
  law_regularised r = {
      .kt = c->kt, .kn = c->kn, .mu = c->mu, .gap = c->gap, .load = c->load, .width = width, .eta = relaxation * c->kt};
  r.has_friction = contact_has_friction(c);
  if (c->smooth != CONTACT_KINKED) r.smooth = *c;
  return r;
}

/* N without the load. */
static double spring_force(const law_regularised *c, double v)
{
  double g = v + c->gap;
  if (g > LAW_SOFT_END * c->width) return c->kn * g;
  if (g < -LAW_SOFT_END * c->width) return 0.0;
  return c->width > 0 ? c->kn * c->width * log1p(exp(g / c->width)) : 0.0 * g; /* NaN in, NaN out */
}

static double normal_force(const law_regularised *c, double v) { return spring_force(c, v) + c->load; }

/* N - N0, computed without cancellation (contact_normal_change). */
static double normal_change(const law_regularised *c, double v)
{
  double g = v + c->gap;
  if (!(c->gap > 0) || isnan(g)) return spring_force(c, v);
  if (g > LAW_SOFT_END * c->width) return c->kn * v;
  if (g < -LAW_SOFT_END * c->width) return -c->kn * c->gap;
  return c->kn * (c->width > 0 ? v + c->width * log1p(exp(-g / c->width)) : v);
}

static double normal_stiffness(const law_regularised *c, double v)
{
  double g = v + c->gap;
  if (g > LAW_SOFT_END * c->width) return c->kn;
  if (g < -LAW_SOFT_END * c->width) return 0.0;
  return c->width > 0 ? c->kn / (1.0 + exp(-g / c->width)) : 0.0;
}

/* The part of the spring's force beyond the friction limit, with the force's sign; 0 in stick. */
static double excess_force(double t, double limit) { return t > limit ? t - limit : t < -limit ? t + limit : 0.0; }

law_value law_regularised_eval(const law_regularised *c, double u, double v, double w)
{
  law_value r = {.n = normal_force(c, v), .change = normal_change(c, v)};
  if (!c->has_friction) return r;
  r.t = c->kt * (u - w);
  double excess = excess_force(r.t, c->mu * r.n);
  r.rate = excess / c->eta;
  if (!c->overstress) r.t -= excess;
  return r;
}

law_derivatives law_regularised_derivatives(const law_regularised *c, double u, double v, double w)
{
  law_derivatives r = {.n_v = normal_stiffness(c, v)};
  if (!c->has_friction) return r;
  r.t_u = c->kt;
  double excess = excess_force(c->kt * (u - w), c->mu * normal_force(c, v));
  if (excess == 0) return r;
  double limit_v = (excess > 0 ? 1.0 : -1.0) * c->mu * r.n_v;
  r.rate_u = c->kt / c->eta;
  r.rate_v = -limit_v / c->eta;
  if (!c->overstress) r.t_u = 0, r.t_v = limit_v;
  return r;
}
