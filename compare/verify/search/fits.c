/* fits.c - one number of the model is another, by a factor that is fitted: the smallest mean distance of the points,
 * bracketed among a few factors, then by parabolas. Factors within SMALL of 1 are no mistakes that somebody makes, and
 * would imitate errors of other kinds. */
#include <math.h>

#include "compare/verify/search/search_impl.h"
#include "numerics/roots.h"

static const double factors[] = {0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1, 1.2, 1.45, 2, 3, 5, 10, 20};
enum { FACTORS = sizeof factors / sizeof *factors };
static const double small = 0.02, precise = 2e-4; /* [1] */

typedef struct fit {
  search *s;
  verify_equations equations;
} fit;

static hc_status closeness_at(void *self, double log_factor, double *out)
{
  fit *f = self;
  verify_solutions of = {0};
  f->equations.factor = exp(log_factor);
  hc_status st = search_solve(f->s, &f->equations, 1, &of);
  if (st == HC_OK) *out = verify_closeness(&f->s->points, &of);
  verify_solutions_clear(&of);
  if (st == HC_OK && !search_tick(f->s)) st = HC_INTERRUPTED;
  return st;
}

static hc_status keep_fitted(search *s, verify_equations *e, double factor)
{
  verify_hypothesis h = {.omega_factor = 1, .fitted = true};
  verify_solutions of = {0};
  e->factor = factor;
  h.equations = *e;
  h.causes = VERIFY_BIT(verify_change_cause(e->change)) | (e->keep_mean ? 0 : VERIFY_BIT(CAUSE_NO_STATIC));
  hc_status st = search_solve(s, e, 1, &of);
  if (st == HC_OK) verify_read_one(&s->points, &of, 0, 1, s->floor, &h);
  if (st == HC_OK) search_keep(s, &h);
  verify_solutions_clear(&of);
  return st;
}

static hc_status fit_factor(search *s, const verify_equations *like, verify_change change)
{
  fit f = {s, *like};
  double values[FACTORS];
  int best = 0;
  root_point least;
  f.equations.change = change;
  for (int i = 0; i < FACTORS; ++i) {
    hc_status st = closeness_at(&f, log(factors[i]), &values[i]);
    if (st != HC_OK) return st;
    if (values[i] < values[best]) best = i;
  }
  if (best == 0 || best == FACTORS - 1) return HC_OK;
  hc_status st = root_minimum(closeness_at, &f, log(factors[best - 1]), values[best - 1], log(factors[best]),
                              values[best], log(factors[best + 1]), values[best + 1], precise, &least);
  if (st == HC_INTERRUPTED || st == HC_NO_MEMORY) return st;
  return fabs(least.x) > small ? keep_fitted(s, &f.equations, exp(least.x)) : HC_OK;
}

hc_status search_fits(search *s)
{
  const verify_equations own = search_own(s);
  hc_status st = HC_OK;
  for (int c = CHANGE_FORCE; c <= CHANGE_MEAN_OF_N && st == HC_OK; ++c) {
    st = fit_factor(s, &own, c);
    if (st == HC_BAD_INPUT) st = HC_OK; /* there are no such equations */
  }
  return st;
}
