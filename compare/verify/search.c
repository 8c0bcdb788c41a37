/* search.c - see search.h. In three stages, each only if no hypothesis of the one before is within the gate:
 *   exact    every number of harmonics with and without harmonic 0, and the linear limits, with every reading of the
 *            columns
 *   sampled  for the likeliest of these, every number of samples, from their solutions by Newton
 *   curves   the likeliest of the sampled along their own curves, which have solutions that no exact one is near to
 * A number of harmonics counts as a cause where its solutions are farther than the gate from those of many. */
#include "compare/verify/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/frequencies.h"
#include "compare/verify/readings.h"
#include "compare/verify/truth.h"

static const int harmonics_tried[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 15, 20};
static const int samples_tried[] = {16, 32, 64, 128, 256, 512, 1024};
enum {
  HARMONICS_TRIED = sizeof harmonics_tried / sizeof *harmonics_tried,
  SAMPLES_TRIED = sizeof samples_tried / sizeof *samples_tried,
  MOST_ORDERS = HARMONICS_TRIED + 2,
  MOST_BASES = MOST_ORDERS,
  CLEARLY = 5,
  MOST_LIKELY = 4,
  USUAL_HARMONICS = 10
};

/* The equations with exact forces and one number of harmonics, with or without harmonic 0. */
typedef struct order {
  int harmonics;
  bool keep_mean;
  bool matters[VERIFY_FREQUENCIES]; /* is it far from many harmonics, by the gate? */
  double score;
} order;

typedef struct search {
  const compare_setup *setup;
  const hc_monitor *monitor;
  verify_report *out;
  verify_sample points;
  double from, to; /* the sweep that covers the points as they stand */
  double floor;
  int own;                                      /* the case's harmonics */
  bool scaled[VERIFY_FREQUENCIES];              /* is this reading of the frequency possible? */
  verify_solutions many[2][VERIFY_FREQUENCIES]; /* with the truth's harmonics: without harmonic 0, with */
  int n_orders;
  order orders[2 * MOST_ORDERS];
  int n_likely; /* sampled equations that may be it, likeliest first */
  verify_equations likely[MOST_LIKELY];
  double likely_score[MOST_LIKELY];
  int done, expected; /* equations, for the monitor */
} search;

/* ---- one set of equations ---- */

static bool tick(search *s)
{
  double part = (double)++s->done / s->expected;
  return hc_monitor_tick(s->monitor, 0.5 + 0.5 * (part < 1 ? part : 1));
}

static bool same_equations(const verify_equations *a, const verify_equations *b)
{
  return a->contact == b->contact && a->keep_mean == b->keep_mean && a->harmonics == b->harmonics &&
         a->samples == b->samples && a->restart == b->restart;
}

static void keep_hypothesis(search *s, const verify_hypothesis *h)
{
  verify_report *out = s->out;
  for (int i = 0; i < out->n_hypotheses; ++i) {
    const verify_hypothesis *o = &out->hypotheses[i];
    if (!same_equations(&o->equations, &h->equations) || o->omega_factor != h->omega_factor) continue;
    if (o->score <= h->score) return;
    memmove(out->hypotheses + i, out->hypotheses + i + 1, (size_t)(--out->n_hypotheses - i) * sizeof *o);
    break;
  }
  int at = out->n_hypotheses < VERIFY_HYPOTHESES ? out->n_hypotheses++ : VERIFY_HYPOTHESES - 1;
  for (; at > 0 && h->score < out->hypotheses[at - 1].score; --at) out->hypotheses[at] = out->hypotheses[at - 1];
  if (at < VERIFY_HYPOTHESES - 1 || h->score < out->hypotheses[at].score) out->hypotheses[at] = *h;
}

static verify_causes causes_of(const search *s, const verify_equations *e, int frequency)
{
  verify_causes causes =
      (e->keep_mean ? 0 : VERIFY_BIT(CAUSE_NO_STATIC)) | (e->samples ? VERIFY_BIT(CAUSE_SAMPLES) : 0);
  if (e->contact != VERIFY_CONTACT_AS_IT_IS)
    return VERIFY_BIT(e->contact == VERIFY_CONTACT_NONE ? CAUSE_NO_CONTACT : CAUSE_STUCK);
  if (e->samples && e->restart == HBM_RESTART_SAMPLE) causes |= VERIFY_BIT(CAUSE_SLIDER);
  for (int i = 0; i < s->n_orders; ++i)
    if (s->orders[i].harmonics == e->harmonics && s->orders[i].keep_mean == e->keep_mean &&
        s->orders[i].matters[frequency])
      causes |= VERIFY_BIT(CAUSE_HARMONICS);
  return causes;
}

static void note_likely(search *s, const verify_equations *e, double score)
{
  int at = s->n_likely < MOST_LIKELY ? s->n_likely++ : MOST_LIKELY;
  for (; at > 0 && score < s->likely_score[at - 1]; --at) {
    if (at == MOST_LIKELY) continue;
    s->likely[at] = s->likely[at - 1];
    s->likely_score[at] = s->likely_score[at - 1];
  }
  if (at == MOST_LIKELY) return;
  s->likely[at] = *e;
  s->likely_score[at] = score;
}

/* The best reading of the points for these solutions. */
static double compare_readings(search *s, const verify_equations *e, int frequency, const verify_solutions *of)
{
  const verify_causes otherwise = e->harmonics < s->out->harmonics ? VERIFY_BIT(CAUSE_HARMONICS) : 0;
  const verify_hypothesis given = {.equations = *e, .causes = causes_of(s, e, frequency)};
  verify_hypothesis h = given, rough = given;
  verify_read_best(&s->points, of, frequency, otherwise, s->floor, &h);
  keep_hypothesis(s, &h);
  if (!e->samples) return h.score;
  s->points.part = 0; /* some points fit to rounding, and others' solutions were not found: that is a likely one, too */
  verify_read_best(&s->points, of, frequency, otherwise, 0, &rough);
  s->points.part = 0.9;
  note_likely(s, e, rough.score);
  return h.score;
}

static hc_status solutions_at(search *s, const verify_equations *e, int frequency, verify_solutions *out)
{
  double omega[128], from = s->from, to = s->to, factor = verify_omega_factor(frequency);
  for (int i = 0; i < s->points.n; ++i) omega[i] = factor * s->points.omega[i];
  if (frequency) {
    number_list ends = {.n = 2, .v = {omega[0], omega[s->points.n - 1]}};
    comparison_sweep(s->setup->omega_from, s->setup->omega_to, &ends, &from, &to);
  }
  return verify_solutions_of(s->setup, e, &s->points.quantity, from, to, s->points.n, omega, s->monitor, out);
}

/* ---- stage 1 ---- */

static hc_status try_exact(search *s, int harmonics, bool keep_mean)
{
  const verify_equations e = {.keep_mean = keep_mean, .harmonics = harmonics};
  const bool many = harmonics == s->out->harmonics;
  order *o = &s->orders[s->n_orders++];
  hc_status st = HC_OK;
  *o = (order){.harmonics = harmonics, .keep_mean = keep_mean, .score = INFINITY};
  for (int f = 0; f < VERIFY_FREQUENCIES && st == HC_OK; ++f) {
    if (!s->scaled[f]) continue;
    verify_solutions own = {0}, *of = many ? &s->many[keep_mean][f] : &own;
    st = solutions_at(s, &e, f, of);
    if (st == HC_OK && !many) o->matters[f] = verify_apart(&s->points, of, &s->many[keep_mean][f]) > s->out->gate;
    if (st == HC_OK && many && keep_mean && f == 0) s->out->truth_distance = verify_read_plain(&s->points, of);
    if (st == HC_OK) o->score = fmin(o->score, compare_readings(s, &e, f, of));
    verify_solutions_clear(&own);
  }
  return st == HC_OK && !tick(s) ? HC_INTERRUPTED : st;
}

static hc_status try_linear(search *s, verify_contact kind)
{
  const verify_equations e = {.contact = kind, .keep_mean = true, .harmonics = 1};
  hc_status st = HC_OK;
  for (int f = 0; f < VERIFY_FREQUENCIES && st == HC_OK; ++f) {
    verify_solutions of = {0};
    if (!s->scaled[f]) continue;
    st = solutions_at(s, &e, f, &of);
    if (st == HC_OK) compare_readings(s, &e, f, &of);
    verify_solutions_clear(&of);
  }
  return st;
}

static hc_status try_all_exact(search *s)
{
  hc_status st = try_exact(s, s->out->harmonics, true);
  if (st == HC_OK) st = try_exact(s, s->out->harmonics, false);
  if (st == HC_OK && s->setup->model->n_contacts) st = try_linear(s, VERIFY_CONTACT_NONE);
  if (st == HC_OK && s->setup->model->n_contacts) st = try_linear(s, VERIFY_CONTACT_STUCK);
  bool own_too = s->own < s->out->harmonics;
  for (int i = HARMONICS_TRIED - 1; i >= 0 && st == HC_OK; --i) {
    int harmonics = harmonics_tried[i];
    if (harmonics >= s->out->harmonics) continue;
    own_too &= harmonics != s->own;
    for (int mean = 1; mean >= 0 && st == HC_OK; --mean) st = try_exact(s, harmonics, mean);
  }
  for (int mean = 1; own_too && mean >= 0 && st == HC_OK; --mean) st = try_exact(s, s->own, mean);
  return st;
}

static bool explained(const search *s) { return verify_fits(s->out) && s->out->hypotheses[0].distance <= s->out->gate; }

/* ---- stages 2 and 3 ---- */

static bool possible(int harmonics, int samples) { return samples >= 2 * harmonics + 2; }

/* All rates in [low, high] for one of the orders, at the omegas read as `frequency`. */
static hc_status try_sampled(search *s, const order *o, int frequency, int low, int high)
{
  verify_solutions near = {0};
  double omega[128];
  verify_equations e = {.keep_mean = o->keep_mean, .harmonics = o->harmonics};
  hc_status st = solutions_at(s, &e, frequency, &near);
  for (int i = 0; i < s->points.n; ++i) omega[i] = verify_omega_factor(frequency) * s->points.omega[i];
  for (int i = 0; i < SAMPLES_TRIED && st == HC_OK; ++i)
    for (int restart = 0; restart < 2 && st == HC_OK; ++restart) {
      e.samples = samples_tried[i];
      e.restart = restart ? HBM_RESTART_SAMPLE : HBM_RESTART_INTERPOLATED;
      if (e.samples < low || e.samples > high || !possible(e.harmonics, e.samples)) continue;
      verify_solutions of = {0};
      st = verify_solutions_near(s->setup, &e, &near, omega, &of);
      if (st == HC_OK) compare_readings(s, &e, frequency, &of);
      verify_solutions_clear(&of);
      if (st == HC_OK && !tick(s)) st = HC_INTERRUPTED;
    }
  verify_solutions_clear(&near);
  return st;
}

/* The orders for which all numbers of samples are tried, as indices into s->orders. Where exact forces fit CLEARLY
 * better with harmonic 0 than without, or the other way, all orders of that kind; else of both kinds the case's own
 * number of harmonics, the largest, and the two that fit best. */
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

static hc_status try_bases(search *s, int frequency)
{
  int bases[MOST_BASES], n = choose_bases(s, bases);
  hc_status st = HC_OK;
  s->expected = s->done + n * 2 * SAMPLES_TRIED + s->n_orders;
  for (int i = 0; i < n && st == HC_OK; ++i)
    st = try_sampled(s, &s->orders[bases[i]], frequency, 0, samples_tried[SAMPLES_TRIED - 1]);
  const verify_equations top = s->likely[0];
  for (int i = 0; i < s->n_orders && s->n_likely && st == HC_OK && !explained(s); ++i) {
    bool done = s->orders[i].keep_mean != top.keep_mean;
    for (int k = 0; k < n; ++k) done |= bases[k] == i;
    if (!done) st = try_sampled(s, &s->orders[i], frequency, top.samples, top.samples);
  }
  return st;
}

/* The likeliest sampled equations along their own curves: Newton from exact solutions misses what is near none. */
static hc_status try_curves(search *s, int frequency)
{
  const int n = s->n_likely;
  verify_equations top[MOST_LIKELY];
  hc_status st = HC_OK;
  memcpy(top, s->likely, sizeof top);
  for (int i = 0; i < n && st == HC_OK && !explained(s); ++i) {
    verify_solutions of = {0};
    st = solutions_at(s, &top[i], frequency, &of);
    if (st == HC_OK) compare_readings(s, &top[i], frequency, &of);
    verify_solutions_clear(&of);
  }
  return st;
}

static int frequency_of(const verify_hypothesis *h)
{
  int f = 0;
  while (f < VERIFY_FREQUENCIES - 1 && h->omega_factor != verify_omega_factor(f)) ++f;
  return f;
}

static hc_status try_everything(search *s)
{
  hc_status st = try_all_exact(s);
  if (st != HC_OK || explained(s) || !s->setup->model->n_contacts) return st;
  int frequency = verify_fits(s->out) ? frequency_of(&s->out->hypotheses[0]) : 0;
  st = try_bases(s, frequency);
  if (st == HC_OK) st = try_curves(s, frequency);
  return st;
}

/* Another reading of the frequencies is tried if all points that differ are then within a factor 2 of the sweep. */
static void choose_frequencies(search *s)
{
  double low = fmin(s->setup->omega_from, s->setup->omega_to) / 2,
         high = fmax(s->setup->omega_from, s->setup->omega_to) * 2;
  for (int f = 0; f < VERIFY_FREQUENCIES; ++f) {
    int inside = 0;
    for (int i = 0; i < s->points.n; ++i) {
      double omega = verify_omega_factor(f) * s->points.omega[i];
      inside += omega >= low && omega <= high;
    }
    s->scaled[f] = f == 0 || inside == s->points.n;
  }
}

hc_status verify_search(const compare_setup *setup, const verify_data *data, const hc_monitor *monitor,
                        verify_report *out)
{
  search *s = calloc(1, sizeof *s);
  if (!s) return HC_NO_MEMORY;
  *s = (search){
      .setup = setup, .monitor = monitor, .out = out, .floor = out->gate / 10, .expected = 2 * HARMONICS_TRIED};
  s->own = setup->hbm.harmonics == HBM_AUTO ? USUAL_HARMONICS : setup->hbm.harmonics;
  verify_window(setup, data, &s->from, &s->to);
  hc_status st = verify_sample_new(out, &data->quantity, &s->points);
  out->n_hypotheses = 0;
  out->truth_distance = NAN;
  if (st == HC_OK) {
    choose_frequencies(s);
    st = try_everything(s);
  }
  for (int i = 0; i < 2 * VERIFY_FREQUENCIES; ++i) verify_solutions_clear(&s->many[i % 2][i / 2]);
  verify_sample_clear(&s->points);
  free(s);
  return st;
}

bool verify_fits(const verify_report *r)
{
  return r->n_hypotheses > 0 && r->hypotheses[0].distance < 0.1 * r->truth_distance;
}
