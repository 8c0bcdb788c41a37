/* hypotheses.c - equations solved, read in every way, and kept by their score; see search_impl.h. */
#include <math.h>
#include <string.h>

#include "base/constants.h"
#include "compare/frequencies.h"
#include "compare/verify/search/search_impl.h"

static const double nearly_all = 0.02; /* [1] of the truth's distance may be left */

double search_omega_factor(int frequency)
{
  static const double factors[SEARCH_FREQUENCIES] = {1, TWO_PI, 1 / TWO_PI};
  return factors[frequency];
}

bool search_tick(search *s)
{
  double part = (double)++s->done / s->expected;
  return hc_monitor_tick(s->monitor, 0.5 + 0.5 * (part < 1 ? part : 1));
}

verify_equations search_own(const search *s)
{
  return (verify_equations){.keep_mean = true, .harmonics = s->own, .factor = 1};
}

/* ---- hypotheses ---- */

/* The best of every set of causes is kept, in the order of their scores. */
void search_keep(search *s, const verify_hypothesis *h)
{
  verify_report *out = s->out;
  for (int i = 0; i < out->n_hypotheses; ++i) {
    const verify_hypothesis *o = &out->hypotheses[i];
    if (o->causes != h->causes) continue;
    if (o->score <= h->score) return;
    memmove(out->hypotheses + i, out->hypotheses + i + 1, (size_t)(--out->n_hypotheses - i) * sizeof *o);
    break;
  }
  int at = out->n_hypotheses;
  while (at > 0 && h->score < out->hypotheses[at - 1].score) --at;
  if (at == VERIFY_HYPOTHESES) return;
  if (out->n_hypotheses < VERIFY_HYPOTHESES) ++out->n_hypotheses;
  memmove(out->hypotheses + at + 1, out->hypotheses + at, (size_t)(out->n_hypotheses - 1 - at) * sizeof *h);
  out->hypotheses[at] = *h;
}

static void keep(void *self, const verify_hypothesis *h) { search_keep(self, h); }

/* True if this number of harmonics is a cause: it matters, and in a changed model it is smaller than the case's own. */
static bool too_few_harmonics(const search *s, const verify_equations *e, int frequency)
{
  for (int i = 0; i < s->n_orders; ++i) {
    const order *o = &s->orders[i];
    if (o->harmonics != e->harmonics || o->keep_mean != e->keep_mean || !o->matters[frequency]) continue;
    return e->change == CHANGE_NONE || e->harmonics < s->own;
  }
  return false;
}

static verify_causes causes_of_slider(const verify_equations *e)
{
  enum { ENOUGH_SAMPLES = 128 }; /* for a mistake about the slider to be the larger one */
  const verify_causes few = e->samples < ENOUGH_SAMPLES ? VERIFY_BIT(CAUSE_SAMPLES) : 0;
  switch (e->restart) {
  case HBM_RESTART_ZEROED: return few | VERIFY_BIT(CAUSE_SLIDER_ZEROED);
  case HBM_RESTART_KEPT: return few | VERIFY_BIT(CAUSE_SLIDER_KEPT);
  case HBM_RESTART_ONE_PASS:
  case HBM_RESTART_ONE_PASS_SAMPLE: return few | VERIFY_BIT(CAUSE_SINGLE_PASS);
  case HBM_RESTART_SAMPLE: return VERIFY_BIT(CAUSE_SAMPLES) | VERIFY_BIT(CAUSE_SLIDER);
  default: return VERIFY_BIT(CAUSE_SAMPLES);
  }
}

static verify_causes causes_of(const search *s, const verify_equations *e, int frequency)
{
  verify_causes causes = frequency ? VERIFY_BIT(CAUSE_FREQUENCY) : 0;
  if (e->change != CHANGE_NONE) causes |= VERIFY_BIT(verify_change_cause(e->change));
  if (e->change == CHANGE_NO_CONTACT || e->change == CHANGE_STUCK) return causes;
  if (e->odd_only) causes |= VERIFY_BIT(CAUSE_ODD_ONLY);
  else if (!e->keep_mean) causes |= VERIFY_BIT(CAUSE_NO_STATIC);
  if (e->samples) causes |= causes_of_slider(e);
  return causes | (too_few_harmonics(s, e, frequency) ? VERIFY_BIT(CAUSE_HARMONICS) : 0);
}

void search_read(search *s, const verify_equations *e, int frequency, const verify_solutions *of)
{
  const verify_causes otherwise = e->harmonics < s->out->harmonics ? VERIFY_BIT(CAUSE_HARMONICS) : 0;
  const verify_hypothesis given = {
      .equations = *e, .omega_factor = search_omega_factor(frequency), .causes = causes_of(s, e, frequency)};
  verify_read_all(&s->points, of, &given, otherwise, s->floor, s->n_scales, s->scales, keep, s);
}

hc_status search_solve(search *s, const verify_equations *e, double omega_factor, verify_solutions *out)
{
  double omega[SEARCH_MOST_POINTS], from = s->from, to = s->to;
  const int n = s->points.n;
  for (int i = 0; i < n; ++i) omega[i] = omega_factor * s->points.omega[i];
  if (omega_factor != 1) {
    number_list ends = {.n = 2, .v = {omega[0], omega[n - 1]}};
    comparison_sweep(s->setup->omega_from, s->setup->omega_to, &ends, &from, &to);
  }
  return verify_solutions_of(s->setup, e, &s->points.quantity, from, to, n, omega, s->monitor, out);
}

hc_status search_try(search *s, const verify_equations *e)
{
  hc_status st = HC_OK;
  for (int f = 0; f < SEARCH_FREQUENCIES && st == HC_OK; ++f) {
    verify_solutions of = {0};
    if (!s->scaled[f]) continue;
    st = search_solve(s, e, search_omega_factor(f), &of);
    if (st == HC_OK) search_read(s, e, f, &of);
    verify_solutions_clear(&of);
  }
  if (st == HC_INTERRUPTED || st == HC_NO_MEMORY) return st;
  return search_tick(s) ? HC_OK : HC_INTERRUPTED;
}

bool search_explained(const search *s)
{
  const verify_hypothesis *best = &s->out->hypotheses[0];
  return verify_fits(s->out) && best->distance <= fmin(s->out->gate, nearly_all * s->out->truth_distance);
}
