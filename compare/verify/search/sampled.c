/* sampled.c - equations whose contact force is sampled: too few samples, and mistakes in following the slider.
 * Solutions come by Newton from those with exact forces, at a small part of what the sampled curve would cost; the
 * likeliest are followed along their own curves, which have solutions that no exact one is near to. */
#include <math.h>
#include <string.h>

#include "compare/verify/search/search_impl.h"

/* The powers of two first: they are tried with every likely number of harmonics. Around the best, every number is. */
static const int samples_tried[] = {16, 32, 64, 128, 256, 512, 1024, 3,   4,   5,   6,   8,   10,  12,  20,
                                    24, 40, 48, 80,  96,  100, 160,  192, 200, 250, 320, 400, 500, 1000};
enum { SAMPLES_TRIED = sizeof samples_tried / sizeof *samples_tried, POWERS_OF_TWO = 7, MOST_BASES = 15, CLEARLY = 5 };

static bool possible(int harmonics, int samples) { return samples >= 2 * harmonics + 1; }

static void note_likely(search *s, const verify_equations *e, double score)
{
  int at = s->n_likely < SEARCH_MOST_LIKELY ? s->n_likely++ : SEARCH_MOST_LIKELY;
  for (; at > 0 && score < s->likely_score[at - 1]; --at) {
    if (at == SEARCH_MOST_LIKELY) continue;
    s->likely[at] = s->likely[at - 1];
    s->likely_score[at] = s->likely_score[at - 1];
  }
  if (at == SEARCH_MOST_LIKELY) return;
  s->likely[at] = *e;
  s->likely_score[at] = score;
}

/* Equations with exact forces and their solutions, which Newton starts from. */
typedef struct base {
  verify_equations equations;
  int frequency;
  double omega[SEARCH_MOST_POINTS];
  verify_solutions exact;
} base;

static hc_status base_solve(search *s, const verify_equations *e, int frequency, base *out)
{
  *out = (base){.equations = *e, .frequency = frequency};
  for (int i = 0; i < s->points.n; ++i) out->omega[i] = search_omega_factor(frequency) * s->points.omega[i];
  return search_solve(s, e, search_omega_factor(frequency), &out->exact);
}

static hc_status try_rate(search *s, const base *b, int samples, int restart)
{
  verify_equations e = b->equations;
  verify_solutions of = {0};
  e.samples = samples;
  e.restart = restart;
  if (!possible(e.harmonics, samples)) return HC_OK;
  hc_status st = verify_solutions_near(s->setup, &e, &b->exact, b->omega, &of);
  if (st == HC_OK) search_read(s, &e, b->frequency, &of);
  if (st == HC_OK) {
    s->points.part = 0; /* some points fit to rounding, and others' solutions were not found: a likely one, too */
    note_likely(s, &e, verify_read_plain(&s->points, &of));
    s->points.part = 0.9;
  }
  verify_solutions_clear(&of);
  if (st == HC_OK && !search_tick(s)) st = HC_INTERRUPTED;
  return st;
}

static hc_status try_rates(search *s, const base *b, int first, int last)
{
  hc_status st = HC_OK;
  for (int i = first; i < last && st == HC_OK; ++i)
    for (int restart = HBM_RESTART_INTERPOLATED; restart <= HBM_RESTART_SAMPLE && st == HC_OK; ++restart)
      st = try_rate(s, b, samples_tried[i], restart);
  return st;
}

/* The orders for which the powers of two are tried, as indices into s->orders. Where exact forces fit CLEARLY better
 * with harmonic 0 than without, or the other way, all orders of that kind; else of both kinds the case's own number of
 * harmonics, the largest, and the two that fit best. */
static int choose_bases(const search *s, int bases[MOST_BASES])
{
  int n = 0;
  double least[2] = {INFINITY, INFINITY};
  for (int i = 0; i < s->n_orders; ++i)
    least[s->orders[i].keep_mean] = fmin(least[s->orders[i].keep_mean], s->orders[i].score);
  for (int mean = 1; mean >= 0; --mean) {
    const bool alone = least[mean] * CLEARLY < least[!mean];
    if (least[!mean] * CLEARLY < least[mean]) continue;
    int best[2] = {-1, -1};
    for (int i = 0; i < s->n_orders; ++i) {
      const order *o = &s->orders[i];
      if (o->keep_mean != mean) continue;
      if (best[0] < 0 || o->score < s->orders[best[0]].score) best[1] = best[0], best[0] = i;
      else if (best[1] < 0 || o->score < s->orders[best[1]].score) best[1] = i;
    }
    for (int i = 0; i < s->n_orders; ++i) {
      const order *o = &s->orders[i];
      bool wanted =
          alone || o->harmonics == s->own || o->harmonics == s->out->harmonics || i == best[0] || i == best[1];
      if (o->keep_mean == mean && wanted && n < MOST_BASES) bases[n++] = i;
    }
  }
  return n;
}

static verify_equations of_order(const order *o)
{
  return (verify_equations){.keep_mean = o->keep_mean, .harmonics = o->harmonics, .factor = 1};
}

/* The powers of two with every base; all rates with the case's own harmonics. */
static hc_status try_bases(search *s, int frequency)
{
  int bases[MOST_BASES], n = choose_bases(s, bases);
  hc_status st = HC_OK;
  s->expected = s->done + 2 * n * POWERS_OF_TWO + 4 * SAMPLES_TRIED;
  for (int i = 0; i < n && st == HC_OK; ++i) {
    const verify_equations e = of_order(&s->orders[bases[i]]);
    base b;
    st = base_solve(s, &e, frequency, &b);
    if (st == HC_OK) st = try_rates(s, &b, 0, e.harmonics == s->own ? SAMPLES_TRIED : POWERS_OF_TWO);
    verify_solutions_clear(&b.exact);
  }
  return st;
}

/* All rates, and all numbers near the best, with the harmonics of the likeliest. */
static hc_status try_near_likeliest(search *s, int frequency)
{
  enum { AROUND = 8, FEWEST_SPACED = 256 };
  if (s->n_likely == 0) return HC_OK;
  verify_equations top = s->likely[0];
  base b;
  top.samples = 0;
  hc_status st = base_solve(s, &top, frequency, &b);
  if (st == HC_OK && top.harmonics != s->own) st = try_rates(s, &b, POWERS_OF_TWO, SAMPLES_TRIED);
  top = s->likely[0];
  const bool same = top.harmonics == b.equations.harmonics && top.keep_mean == b.equations.keep_mean;
  for (int d = -AROUND; d <= AROUND && same && st == HC_OK && !search_explained(s); ++d)
    if (d && top.samples + d > 2 && top.samples <= FEWEST_SPACED) st = try_rate(s, &b, top.samples + d, top.restart);
  verify_solutions_clear(&b.exact);
  return st;
}

/* The likeliest number of samples with every other number of harmonics. */
static hc_status try_other_orders(search *s, int frequency)
{
  hc_status st = HC_OK;
  if (s->n_likely == 0) return st;
  const verify_equations top = s->likely[0];
  for (int i = 0; i < s->n_orders && st == HC_OK && !search_explained(s); ++i) {
    const verify_equations e = of_order(&s->orders[i]);
    base b;
    if (e.keep_mean != top.keep_mean || e.harmonics == top.harmonics) continue;
    st = base_solve(s, &e, frequency, &b);
    for (int restart = 0; restart <= HBM_RESTART_SAMPLE && st == HC_OK; ++restart)
      st = try_rate(s, &b, top.samples, restart);
    verify_solutions_clear(&b.exact);
  }
  return st;
}

/* Few harmonics with as few samples as people take then: 2H + 1 to 8H. */
static hc_status try_small(search *s, int frequency)
{
  enum { SMALL = 8 };
  static const int rates[] = {3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 40, 48, 64};
  hc_status st = HC_OK;
  for (int i = 0; i < s->n_orders && st == HC_OK && !search_explained(s); ++i) {
    const verify_equations e = of_order(&s->orders[i]);
    base b;
    if (e.harmonics > SMALL || e.harmonics == s->own) continue;
    st = base_solve(s, &e, frequency, &b);
    for (size_t k = 0; k < sizeof rates / sizeof *rates && st == HC_OK; ++k)
      if (rates[k] <= SMALL * e.harmonics) st = try_rate(s, &b, rates[k], HBM_RESTART_INTERPOLATED);
    verify_solutions_clear(&b.exact);
  }
  return st;
}

static hc_status try_curves(search *s, int frequency)
{
  const int n = s->n_likely;
  verify_equations top[SEARCH_MOST_LIKELY];
  hc_status st = HC_OK;
  memcpy(top, s->likely, sizeof top);
  for (int i = 0; i < n && st == HC_OK && !search_explained(s); ++i) {
    verify_solutions of = {0};
    st = search_solve(s, &top[i], search_omega_factor(frequency), &of);
    if (st == HC_OK) search_read(s, &top[i], frequency, &of);
    verify_solutions_clear(&of);
  }
  return st;
}

/* The reading of the frequencies that the best hypothesis so far has. */
static int likeliest_frequency(const search *s)
{
  int f = SEARCH_FREQUENCIES - 1;
  if (!verify_fits(s->out)) return 0;
  while (f > 0 && s->out->hypotheses[0].omega_factor != search_omega_factor(f)) --f;
  return f;
}

hc_status search_sampled(search *s)
{
  const int frequency = likeliest_frequency(s);
  hc_status st = try_bases(s, frequency);
  if (st == HC_OK && !search_explained(s)) st = try_small(s, frequency);
  if (st == HC_OK && !search_explained(s)) st = try_near_likeliest(s, frequency);
  if (st == HC_OK && !search_explained(s)) st = try_other_orders(s, frequency);
  if (st == HC_OK && !search_explained(s)) st = try_curves(s, frequency);
  return st;
}

/* ---- the slider ---- */

hc_status search_sliders(search *s)
{
  static const int rates[] = {256, 1024, 512, 128, 64};
  const verify_equations own = search_own(s);
  base b;
  hc_status st = base_solve(s, &own, 0, &b);
  for (int restart = HBM_RESTART_ZEROED; restart <= HBM_RESTART_ONE_PASS_SAMPLE && st == HC_OK; ++restart)
    for (size_t i = 0; i < sizeof rates / sizeof *rates && st == HC_OK; ++i) st = try_rate(s, &b, rates[i], restart);
  verify_solutions_clear(&b.exact);
  return st;
}
