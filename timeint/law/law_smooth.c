/* law_smooth.c - see law_kind.h: laws without a state or an event of their own (model/contact_law.h), the same under
 * the exact law and the regularised one. Proof: tests/timeint/test_model.c, tests/command/laws.py. */
#include "timeint/law/law_kind.h"

static planar_value polynomial_value(const law_regularised *c, const contact_motion *at, const double *w)
{
  double slope;
  (void)w;
  const double f = contact_polynomial(&c->smooth, at->v, &slope);
  return (planar_value){.n = f + c->smooth.across[0] + c->smooth.across[1] * at->v, .change = f};
}

static planar_derivatives polynomial_derivatives(const law_regularised *c, const contact_motion *at, const double *w)
{
  planar_derivatives d = {0};
  (void)w;
  contact_polynomial(&c->smooth, at->v, &d.n_v);
  return d;
}

static law_pull polynomial_pull(const contact_track *t, const scaled_contact *c, const contact_motion *at, double own)
{
  double slope;
  (void)t, (void)own;
  return (law_pull){.n = contact_polynomial(&c->law.smooth, at->v, &slope)};
}

static law_slopes polynomial_slopes(const contact_track *t, const scaled_contact *c, const contact_motion *at,
                                    double own)
{
  law_slopes s = {0};
  (void)t, (void)own;
  contact_polynomial(&c->law.smooth, at->v, &s.n_v);
  return s;
}

const law_kind law_polynomial = {.directions = 1,
                                 .smooth = true,
                                 .evaluate = polynomial_value,
                                 .derivatives = polynomial_derivatives,
                                 .pull = polynomial_pull,
                                 .slopes = polynomial_slopes};

/* T for the normal force N, with its derivatives by N and U'. */
static double rubbing(const law_regularised *c, double N, double du, double *by_N, double *by_du)
{
  const double z = du / c->smooth.epsilon, cosh_1 = 1 / cosh(fmin(fabs(z), 700));
  *by_N = c->mu * tanh(z);
  *by_du = c->mu * N / c->smooth.epsilon * cosh_1 * cosh_1;
  return *by_N * N;
}

static planar_value tanh_value(const law_regularised *c, const contact_motion *at, const double *w)
{
  double by_N, by_du;
  const law_value l = law_regularised_eval(c, *at->u, at->v, *w);
  return (planar_value){.n = l.n, .change = l.change, .t = {rubbing(c, l.n, *at->du, &by_N, &by_du)}};
}

static planar_derivatives tanh_derivatives(const law_regularised *c, const contact_motion *at, const double *w)
{
  double by_N;
  const law_value l = law_regularised_eval(c, *at->u, at->v, *w);
  planar_derivatives d = {.n_v = law_regularised_derivatives(c, *at->u, at->v, *w).n_v};
  rubbing(c, l.n, *at->du, &by_N, &d.t_du);
  d.t_v[0] = by_N * d.n_v;
  return d;
}

static law_pull tanh_pull(const contact_track *t, const scaled_contact *c, const contact_motion *at, double own)
{
  double by_N, by_du;
  const double N = t->state == CONTACT_SEPARATED ? 0 : c->law.kn * (at->v + c->law.gap) + c->law.load;
  (void)own;
  return (law_pull){.t = {rubbing(&c->law, N, *at->du, &by_N, &by_du)}};
}

static law_slopes tanh_slopes(const contact_track *t, const scaled_contact *c, const contact_motion *at, double own)
{
  double by_N;
  law_slopes s = {0};
  (void)own;
  if (t->state == CONTACT_SEPARATED) return s;
  rubbing(&c->law, c->law.kn * (at->v + c->law.gap) + c->law.load, *at->du, &by_N, &s.t_du);
  s.t_v[0] = by_N * c->law.kn;
  return s;
}

static double tanh_bend(const law_regularised *c) { return c->smooth.epsilon; }

static int counts(contact_track *t, track_event event, double theta)
{
  (void)t, (void)event, (void)theta;
  return 1;
}

const law_kind law_tanh = {.directions = 1,
                           .smooth = true,
                           .by_rates = true,
                           .bend = tanh_bend,
                           .evaluate = tanh_value,
                           .derivatives = tanh_derivatives,
                           .counts = counts,
                           .pull = tanh_pull,
                           .slopes = tanh_slopes};
