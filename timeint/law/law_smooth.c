/* law_smooth.c - see law_kind.h: laws without a state or an event of their own (model/contact_law.h), the same under the
 * exact law and the regularised one. Proof: tests/timeint/test_smooth.c. */
#include "timeint/law/law_kind.h"

static planar_value polynomial_value(const law_regularised *c, const double *u, double v, const double *w)
{
  double slope;
  (void)u, (void)w;
  const double f = contact_polynomial(&c->smooth, v, &slope);
  return (planar_value){.n = f, .change = f};
}

static planar_derivatives polynomial_derivatives(const law_regularised *c, const double *u, double v, const double *w)
{
  planar_derivatives d = {0};
  (void)u, (void)w;
  contact_polynomial(&c->smooth, v, &d.n_v);
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
