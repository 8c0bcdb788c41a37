/* law_planar.c - see law_planar.h; the law itself stands there. Proof: tests/timeint/test_law.c. */
#include "timeint/law/law_planar.h"

/* The spring's force, and by how much it is longer than the limit. */
typedef struct overload {
  double s[2], size, limit, excess;
} overload;

static overload load_of(const law_regularised *c, const double u[2], double n, const double w[2])
{
  overload o = {.s = {c->kt * (u[0] - w[0]), c->kt * (u[1] - w[1])}, .limit = c->mu * n};
  o.size = hypot(o.s[0], o.s[1]);
  o.excess = o.size > o.limit ? o.size - o.limit : 0;
  return o;
}

planar_value law_planar_eval(const law_regularised *c, const double *u, double v, const double *w)
{
  const law_value normal = law_regularised_eval(c, 0, v, 0); /* T = 0: of N alone */
  planar_value r = {.n = normal.n, .change = normal.change};
  if (!c->has_friction) return r;
  const overload o = load_of(c, u, normal.n, w);
  for (int a = 0; a < 2; ++a) {
    const double e = o.excess > 0 ? o.s[a] / o.size : 0;
    r.t[a] = o.excess > 0 && !c->overstress ? o.limit * e : o.s[a];
    r.rate[a] = o.excess * e / c->eta;
  }
  return r;
}

planar_derivatives law_planar_derivatives(const law_regularised *c, const double *u, double v, const double *w)
{
  const double n = law_regularised_eval(c, 0, v, 0).n;
  planar_derivatives r = {.n_v = law_regularised_derivatives(c, 0, v, 0).n_v};
  if (!c->has_friction) return r;
  const overload o = load_of(c, u, n, w);
  const double kept = o.excess > 0 ? o.limit / o.size : 1; /* of what turns the force */
  for (int a = 0; a < 2; ++a) {
    const double e = o.excess > 0 ? o.s[a] / o.size : 0;
    for (int b = 0; b < 2; ++b) {
      const double along = e * (o.excess > 0 ? o.s[b] / o.size : 0), unit = a == b;
      r.t_u[a][b] = c->kt * (c->overstress ? unit : kept * (unit - along));
      r.rate_u[a][b] = c->kt / c->eta * ((1 - kept) * unit + kept * along);
    }
    r.t_v[a] = c->overstress ? 0 : c->mu * r.n_v * e;
    r.rate_v[a] = -c->mu * r.n_v * e / c->eta;
  }
  return r;
}

static planar_value eval_line(const law_regularised *c, const double *u, double v, const double *w)
{
  const law_value l = law_regularised_eval(c, *u, v, *w);
  return (planar_value){.n = l.n, .change = l.change, .t = {l.t}, .rate = {l.rate}};
}

static planar_derivatives line_derivatives(const law_regularised *c, const double *u, double v, const double *w)
{
  const law_derivatives s = law_regularised_derivatives(c, *u, v, *w);
  return (planar_derivatives){
      .n_v = s.n_v, .t_u = {{s.t_u}}, .t_v = {s.t_v}, .rate_u = {{s.rate_u}}, .rate_v = {s.rate_v}};
}

const law_kind law_kinds[] = {
    [LAW_ONE_TANGENT] = {1, eval_line, line_derivatives},
    [LAW_TWO_TANGENTS] = {2, law_planar_eval, law_planar_derivatives},
};
