/* search.c - see search.h. The search is the list of stages at the end of this file, run from the first to the last as
 * long as the patience lasts. Every stage tries equations (tries.c): it solves them, reads the solutions in every way
 * that the columns may be meant, and keeps the best of every set of causes as a hypothesis. Its score is the distance
 * from the points, times 3 a cause (search_rank). A stage is passed over once the best hypothesis leaves next to
 * nothing (search_explained); which cause is then named, readings.c says. Stages learn from those before by three
 * scores more:
 *   order.score       of a number of harmonics, with harmonic 0 or without: how close its exact forces come
 *   likely_score      of a number of samples and a rule for the slider: how close those come, with these harmonics
 *   last              of the equations tried last: their best reading
 *
 * Exact forces come first. Sampled ones start Newton from the exact ones' solutions, at a small part of what the
 * sampled curve would cost; the likeliest are followed along their own curves, which have solutions that no exact one
 * is near to. A number of harmonics counts as a cause where its solutions are farther than the gate from those of many.
 * The curves of a structure take longer and more can be wrong with it. Therefore only the truth is computed along a
 * curve; solutions with a mistake come by Newton from those of the truth, first at few of the points, the most frequent
 * mistakes first. */
#include "compare/verify/search/search.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/verify/truth/truth.h"
#include "numerics/base/thread_clock.h"

static const int harmonics_tried[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 15, 20};
/* The powers of two first: they are tried with every likely number of harmonics. Around the best, every number is. */
static const int samples_tried[] = {16, 32, 64, 128, 256, 512, 1024, 3,   4,   5,   6,   8,   10,  12,  20,
                                    24, 40, 48, 80,  96,  100, 160,  192, 200, 250, 320, 400, 500, 1000};
enum {
  HARMONICS_TRIED = sizeof harmonics_tried / sizeof *harmonics_tried,
  SAMPLES_TRIED = sizeof samples_tried / sizeof *samples_tried,
  POWERS_OF_TWO = 7,
  MOST_BASES = 15,
  USUAL_HARMONICS = 10
};

static void fill_distances(int n, double value, double *out)
{
  for (int i = 0; i < n; ++i) out[i] = value;
}

/* Where Newton starts for one reading of the frequency; NULL: the curve is followed. */
static const verify_solutions *start_of(const search *s, int frequency)
{
  const verify_solutions *truth = &s->many[true][frequency];
  return s->oscillator || !truth->n ? NULL : truth;
}

/* Every possible reading of the frequency. HC_OK where there are no such equations. */
static hc_status try_equations(search *s, const verify_equations *e)
{
  const bool many = s->current && e->harmonics == s->out->harmonics; /* what others start from is of all points */
  hc_status st = HC_OK;
  for (int f = 0; f < SEARCH_FREQUENCIES && st == HC_OK; ++f) {
    verify_solutions of = {0};
    if (!s->scaled[f]) continue;
    st = search_try(s, e, f, many ? NULL : start_of(s, f), &of);
    s->points.look = SEARCH_ALL;
    if (many) s->many[e->keep_mean][f] = of;
    else verify_solutions_clear(&of);
    if (!s->current) st = search_passed(s, e, f, st);
  }
  return st == HC_OK && !search_tick(s) ? HC_INTERRUPTED : st;
}

/* Equations that are otherwise *like, with each of n numbers of harmonics. */
static hc_status try_numbers_of_harmonics(search *s, const verify_equations *like, int n, const int *harmonics)
{
  verify_equations e = *like;
  hc_status st = HC_OK;
  for (int i = 0; i < n && st == HC_OK; ++i) {
    e.harmonics = harmonics[i];
    st = try_equations(s, &e);
  }
  return st;
}

/* ---- numbers of harmonics ---- */

static hc_status try_order(search *s, int harmonics, bool keep_mean)
{
  const verify_equations e = search_equations(harmonics, keep_mean);
  order *o = s->current = &s->orders[s->n_orders++];
  *o = (order){.harmonics = harmonics, .keep_mean = keep_mean, .score = INFINITY};
  for (int f = 0; f < SEARCH_FREQUENCIES; ++f) fill_distances(SEARCH_DISTANCES, INFINITY, o->distance[f]);
  const hc_status st = try_equations(s, &e);
  s->current = NULL;
  return st;
}

/* With the truth's harmonics, and with the case's: what hypotheses must be better than. */
static hc_status try_truth(search *s)
{
  const hc_status st = try_order(s, s->out->harmonics, true);
  return st == HC_OK && s->own < s->out->harmonics ? try_order(s, s->own, true) : st;
}

/* All but these. */
static hc_status try_other_orders(search *s)
{
  hc_status st = try_order(s, s->out->harmonics, false);
  if (st == HC_OK && s->own < s->out->harmonics) st = try_order(s, s->own, false);
  for (int i = HARMONICS_TRIED - 1; i >= 0 && st == HC_OK; --i) {
    int harmonics = harmonics_tried[i];
    if (harmonics >= s->out->harmonics || harmonics < model_highest_load(s->setup->model)) continue;
    for (int mean = 1; harmonics != s->own && mean >= 0 && st == HC_OK; --mean) st = try_order(s, harmonics, mean);
  }
  return st;
}

static hc_status try_odd_only(search *s)
{
  const int orders[] = {s->own, s->out->harmonics, 3, 5, 7, 9};
  const verify_equations odd = {.odd_only = true, .factor = 1};
  if (s->setup->model->n_contacts == 0) return HC_OK;
  return try_numbers_of_harmonics(s, &odd, sizeof orders / sizeof *orders, orders);
}

/* ---- changes of the model ---- */

/* With other usual numbers of harmonics, where that may be what is left. Large ones take long: not where those before
 * change nothing. */
static hc_status try_orders_of(search *s, const verify_equations *e)
{
  const double nearly = 0.08, as_good = 0.1, before = s->last;
  verify_equations other = *e;
  bool matter = false;
  hc_status st = HC_OK;
  for (int i = 0; i < SEARCH_ORDERS && before <= nearly && s->last > s->out->gate / 2 && st == HC_OK; ++i) {
    other.harmonics = search_order(s, i);
    if (other.harmonics == e->harmonics || (other.harmonics > USUAL_HARMONICS && !matter)) continue;
    st = try_equations(s, &other);
    matter |= fabs(s->last - before) > as_good * before;
  }
  return st;
}

/* The changes first..last in each way they can be made, in equations that are otherwise *like; those with a factor at
 * the usual ones. Of another response: try_responses. */
static hc_status try_changes(search *s, const verify_equations *like, verify_change first, verify_change last)
{
  const model *m = s->setup->model;
  hc_status st = HC_OK;
  for (int c = first; c <= (int)last && st == HC_OK; ++c) {
    const int variants = verify_change_variants(m, c);
    const bool factor = verify_changes[c].scan == SCAN_FACTOR;
    const bool may_be_zero = verify_changes[c].cause == CAUSE_GAP || c == CHANGE_STATIC_LOAD || c == CHANGE_ONE_LOAD,
               of_response = c == CHANGE_RESPONSE || c == CHANGE_RELATIVE;
    const int numbers = factor ? SEARCH_USUAL_FACTORS - !may_be_zero : 1;
    for (int i = 0; i < numbers * variants && !of_response && st == HC_OK; ++i) {
      /* For a single contact search_fits knows all but the factor 0. */
      const bool fitted = factor && !s->oscillator && c != CHANGE_ONE_LOAD && i % variants > 0;
      if (fitted && search_usual[i / variants] != 0) continue;
      verify_equations e = *like;
      e.change = c;
      e.which = i % variants;
      e.n = m->n;
      if (verify_changes[c].scan == SCAN_TURN || verify_change_of_kind(c)) break; /* no number is usual */
      e.factor = factor ? search_usual[i / variants] : 1;
      if (verify_equations_linear(&e)) e.harmonics = model_highest_load(m) > 1 ? model_highest_load(m) : 1;
      st = try_equations(s, &e);
      if (st == HC_OK && !s->oscillator && !verify_equations_linear(&e)) st = try_orders_of(s, &e);
    }
  }
  return st;
}

static hc_status try_every_change(search *s)
{
  const verify_equations own = search_own(s);
  return try_changes(s, &own, CHANGE_NONE + 1, VERIFY_MODEL_CHANGES - 1);
}

/* The other law of two tangents, or one tangent alone: what programs differ in, and before what is dear. All of them,
 * since a response across which nothing slips has one curve for several. */
static hc_status try_limits(search *s)
{
  const int orders[] = {s->out->harmonics, s->own};
  const model *m = s->setup->model;
  hc_status st = HC_OK;
  for (int i = 0; i < 2 && model_whole_contacts(m) < m->n_contacts && st == HC_OK && !search_explained(s); ++i) {
    const verify_equations like = search_equations(orders[i], true);
    st = try_changes(s, &like, CHANGE_SQUARE_LIMIT, CHANGE_NO_TANGENT_1);
  }
  return st;
}

/* The likeliest changed models again with other numbers of harmonics: theirs may not be the case's. */
static hc_status try_orders_of_changed(search *s)
{
  enum { TOP = 3, FIRST = 2 };
  int orders[HARMONICS_TRIED - FIRST + 1], n = 0;
  verify_equations top[TOP];
  hc_status st = HC_OK;
  memcpy(orders, harmonics_tried + FIRST, sizeof orders - sizeof *orders);
  orders[HARMONICS_TRIED - FIRST] = s->out->harmonics;
  for (int i = 0; i < s->out->n_hypotheses && n < TOP; ++i)
    if (s->out->hypotheses[i].equations.change > CHANGE_STUCK) top[n++] = s->out->hypotheses[i].equations;
  for (int k = 0; k < n && st == HC_OK && !search_explained(s); ++k)
    st = try_numbers_of_harmonics(s, &top[k], sizeof orders / sizeof *orders, orders);
  return st;
}

/* ---- another response ---- */

/* For every response that is wrong the degree of freedom whose motion fits best, or the one that it is relative to, by
 * the truth and with the case's own harmonics; the hypothesis names the first's, others may be as they stand. */
static hc_status try_responses(search *s)
{
  const int orders[] = {s->out->harmonics, s->own}, n = s->setup->model->n;
  const verify_sample *p = &s->points;
  const verify_places at = {.n = p->n, .omega = p->omega, .n_responses = p->n_responses, .asked = p->quantity};
  hc_status st = HC_OK;
  for (int i = 0; i < 4 && n > 1 && n <= VERIFY_MOST_DOFS && st == HC_OK && !search_explained(s); ++i) {
    verify_equations e = search_equations(orders[i / 2], true);
    verify_solutions of;
    e.change = i % 2 ? CHANGE_RELATIVE : CHANGE_RESPONSE;
    search_distances best[SEARCH_MOST_RESPONSES] = {{0}}, one;
    int dof[SEARCH_DISTANCES] = {0}, least = 0;
    for (int r = 0; r < p->n_responses; ++r)
      for (int k = 0; k < SEARCH_DISTANCES; ++k) best[r][k] = 1;
    const verify_equations plain = search_equations(e.harmonics, true);
    s->plainly = true;
    st = search_solve(s, &plain, 1, &s->many[true][0], &of);
    s->plainly = false;
    for (int r = 0; r < p->n_responses && st == HC_OK; ++r)
      if (r != p->first) search_distances_of(p, r, &of, best[r]); /* it may be the one that is meant */
    for (int d = 0; d < n && st == HC_OK; ++d) {
      verify_solutions_move(&of, &at, s->setup->model, d, e.change == CHANGE_RELATIVE, p->wrong);
      for (int r = 0; r < p->n_responses; ++r) {
        const double *row = s->setup->model->responses + (size_t)r * (size_t)n;
        bool asked = p->wrong[r]; /* is it the response itself, or nothing? */
        for (int k = 0; k < n; ++k) asked &= row[k] == (k == d);
        search_distances_of(p, r, &of, one);
        for (int k = 0; k < SEARCH_DISTANCES && !asked; ++k) {
          if (!(one[k] < best[r][k])) continue;
          best[r][k] = one[k];
          if (r == p->first) dof[k] = d;
        }
      }
      if (!search_tick(s)) st = HC_INTERRUPTED;
    }
    /* One dof a reading is named: that of the reading that fits best. */
    for (int k = 0; k < SEARCH_DISTANCES; ++k) {
      for (int r = 1; r < p->n_responses; ++r) best[0][k] = fmax(best[0][k], best[r][k]);
      if (best[0][k] < best[0][least]) least = k;
    }
    e.which = dof[least] + 1;
    e.n = n;
    if (st == HC_OK) search_read_distances(s, &e, 0, best[0], NULL);
    verify_solutions_clear(&of);
  }
  return st;
}

/* ---- few samples, and the slider ---- */

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
  verify_solutions exact;
} base;

static hc_status base_solve(search *s, const verify_equations *e, int frequency, base *out)
{
  *out = (base){.equations = *e, .frequency = frequency};
  const verify_solutions *near = start_of(s, frequency);
  s->plainly = near;
  const hc_status st = search_solve(s, e, search_omega_factor(frequency), near, &out->exact);
  s->plainly = false;
  return st;
}

static hc_status try_rate(search *s, const base *b, int samples, verify_change slider)
{
  verify_equations e = b->equations;
  verify_solutions of = {0};
  e.samples = samples;
  e.restart = (int)slider - VERIFY_MODEL_CHANGES;
  if (samples < 2 * e.harmonics + 1) return HC_OK;
  hc_status st = HC_OK;
  if (s->oscillator) {
    st = search_solve(s, &e, search_omega_factor(b->frequency), &b->exact, &of);
    if (st == HC_OK) search_read(s, &e, b->frequency, &of);
  } else st = search_try(s, &e, b->frequency, &b->exact, &of);
  if (st == HC_OK) {
    s->points.part = 0; /* some points fit to rounding, and others' solutions were not found: a likely one, too */
    note_likely(s, &e, verify_read_plain(&s->points, &of));
    s->points.part = 0.9;
  }
  s->points.look = SEARCH_ALL;
  verify_solutions_clear(&of);
  if (st == HC_OK && !search_tick(s)) st = HC_INTERRUPTED;
  return st;
}

/* Each of n numbers of samples with the rules first..last for the slider. */
static hc_status try_rates(search *s, const base *b, int n, const int *samples, verify_change first, verify_change last)
{
  hc_status st = HC_OK;
  for (int i = 0; i < n && st == HC_OK; ++i)
    for (int k = last; k >= (int)first && st == HC_OK; --k) st = try_rate(s, b, samples[i], k);
  return st;
}

/* Our own rules up to `last`; with two tangents that of other programs, too. */
static hc_status try_own_rates(search *s, const base *b, int n, const int *samples, verify_change last)
{
  const bool radial = verify_change_applies(s->setup->model, CHANGE_SLIDER_RADIAL, true);
  return try_rates(s, b, n, samples, CHANGE_SLIDER_INTERPOLATED, radial ? CHANGE_SLIDER_RADIAL : last);
}

/* Order number i with each of n numbers of samples. */
static hc_status try_order_sampled(search *s, int i, int n, const int *samples, verify_change last)
{
  const verify_equations e = search_equations(s->orders[i].harmonics, s->orders[i].keep_mean);
  base b;
  if (s->setup->model->n_contacts == 0) return HC_OK;
  hc_status st = base_solve(s, &e, s->frequency, &b);
  if (st == HC_OK) st = try_own_rates(s, &b, n, samples, last);
  verify_solutions_clear(&b.exact);
  return st;
}

/* The orders for which the powers of two are tried, as indices into s->orders. Where exact forces fit CLEARLY better
 * with harmonic 0 than without, or the other way, all orders of that kind; else of both kinds the case's own number of
 * harmonics, the largest, and the two that fit best. */
static int choose_bases(const search *s, int bases[MOST_BASES])
{
  enum { CLEARLY = 5 };
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

/* The reading of the frequencies that the best hypothesis so far has. */
static int likeliest_frequency(const search *s)
{
  int f = SEARCH_FREQUENCIES - 1;
  if (!verify_fits(s->out)) return 0;
  while (f > 0 && s->out->hypotheses[0].omega_factor != search_omega_factor(f)) --f;
  return f;
}

/* The powers of two with every base; all rates with the case's own harmonics. */
static hc_status try_bases(search *s)
{
  int bases[MOST_BASES], n = choose_bases(s, bases);
  hc_status st = HC_OK;
  s->frequency = likeliest_frequency(s);
  s->expected = s->done + 2 * n * POWERS_OF_TWO + 4 * SAMPLES_TRIED;
  for (int i = 0; i < n && st == HC_OK; ++i) {
    const bool own = s->orders[bases[i]].harmonics == s->own;
    st = try_order_sampled(s, bases[i], own ? SAMPLES_TRIED : POWERS_OF_TWO, samples_tried, CHANGE_SLIDER_ON_SAMPLE);
  }
  return st;
}

/* All rates, and all numbers near the best, with the harmonics of the likeliest. */
static hc_status try_near_likeliest(search *s)
{
  enum { AROUND = 8, FEWEST_SPACED = 256 };
  if (s->n_likely == 0) return HC_OK;
  verify_equations top = s->likely[0];
  base b;
  top.samples = 0;
  hc_status st = base_solve(s, &top, s->frequency, &b);
  if (st == HC_OK && top.harmonics != s->own)
    st = try_own_rates(s, &b, SAMPLES_TRIED - POWERS_OF_TWO, samples_tried + POWERS_OF_TWO, CHANGE_SLIDER_ON_SAMPLE);
  top = s->likely[0];
  const bool same = top.harmonics == b.equations.harmonics && top.keep_mean == b.equations.keep_mean;
  for (int d = -AROUND; d <= AROUND && same && st == HC_OK && !search_explained(s); ++d)
    if (d && top.samples + d > 2 && top.samples <= FEWEST_SPACED)
      st = try_rate(s, &b, top.samples + d, VERIFY_MODEL_CHANGES + top.restart);
  verify_solutions_clear(&b.exact);
  return st;
}

/* The likeliest number of samples with every other number of harmonics. */
static hc_status try_likeliest_with_orders(search *s)
{
  hc_status st = HC_OK;
  if (s->n_likely == 0) return st;
  const verify_equations top = s->likely[0];
  for (int i = 0; i < s->n_orders && st == HC_OK && !search_explained(s); ++i)
    if (s->orders[i].keep_mean == top.keep_mean && s->orders[i].harmonics != top.harmonics)
      st = try_order_sampled(s, i, 1, &top.samples, CHANGE_SLIDER_ON_SAMPLE);
  return st;
}

/* Few harmonics with as few samples as people take then: 2H + 1 to 8H. */
static hc_status try_small(search *s)
{
  enum { SMALL = 8 };
  static const int rates[] = {3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 40, 48, 64};
  hc_status st = HC_OK;
  for (int i = 0; i < s->n_orders && st == HC_OK && !search_explained(s); ++i) {
    const int harmonics = s->orders[i].harmonics, least[] = {2 * harmonics + 1, 2 * harmonics + 2, 4 * harmonics + 1};
    int n = 0;
    while (n < (int)(sizeof rates / sizeof *rates) && rates[n] <= SMALL * harmonics) ++n;
    if (harmonics > SMALL || harmonics == s->own) continue;
    st = try_order_sampled(s, i, n, rates, CHANGE_SLIDER_INTERPOLATED);
    if (st == HC_OK) st = try_order_sampled(s, i, 3, least, CHANGE_SLIDER_INTERPOLATED);
  }
  return st;
}

static hc_status try_curves(search *s)
{
  const int n = s->n_likely;
  hc_status st = HC_OK;
  for (int i = 0; i < n && st == HC_OK && !search_explained(s); ++i) {
    verify_solutions of;
    st = search_try(s, &s->likely[i], s->frequency, NULL, &of);
    verify_solutions_clear(&of);
  }
  return st;
}

static hc_status try_sliders(search *s)
{
  static const int rates[] = {SEARCH_MOST_SAMPLES, 256, 512, 128, 64};
  const int orders[] = {s->own, USUAL_HARMONICS};
  const int n = !s->oscillator && s->own < USUAL_HARMONICS ? 2 : 1; /* their number may not be the case's */
  hc_status st = HC_OK;
  for (int k = 0; k < n && s->setup->model->n_contacts > 0 && st == HC_OK && !search_explained(s); ++k) {
    const verify_equations e = search_equations(orders[k], true);
    base b;
    st = base_solve(s, &e, 0, &b);
    for (int i = 0; i < VERIFY_CHANGES - VERIFY_MODEL_CHANGES; ++i)
      fill_distances(SEARCH_DISTANCES, INFINITY, s->most_samples[i]);
    if (st == HC_OK)
      st = try_rates(s, &b, sizeof rates / sizeof *rates, rates, CHANGE_SLIDER_ZEROED, VERIFY_CHANGES - 1);
    verify_solutions_clear(&b.exact);
  }
  return st;
}

/* ---- the stages ---- */

/* Is the best hypothesis a factor without a name? Factors of the model's numbers may do what it does. */
static bool free_factor(const search *s) { return s->out->hypotheses[0].fitted; } /* false where there is none yet */

static hc_status try_fits_of_factor(search *s) { return free_factor(s) ? search_fits(s) : HC_OK; }

static hc_status try_fits_of_rest(search *s) { return free_factor(s) ? HC_OK : search_fits(s); }

static hc_status try_pairs(search *s)
{
  const verify_equations without = search_equations(s->own, false);
  if (verify_fits(s->out)) return HC_OK;
  return try_changes(s, &without, CHANGE_NONE + 1, VERIFY_MODEL_CHANGES - 1);
}

#define OTHER_HARMONICS "equations with other harmonics"
typedef enum stage_in { OSCILLATORS = 1, STRUCTURES = 2, BOTH = 3 } stage_in;

/* One stage. */
typedef struct stage {
  hc_status (*run)(search *s);
  stage_in in;       /* scenes that it is for */
  stage_in always;   /* in these also where a hypothesis explains the points already */
  const char *words; /* what it tries, as it is said; NULL: other stages say it */
} stage;

/* What they try, and the score that a later one goes by where it is not the hypotheses' own. */
static const stage stages[] = {
    {try_truth, BOTH, BOTH, "columns"},                         /* many harmonics, and the case's: every reading */
    {try_limits, STRUCTURES, 0, "limits of friction"},          /* the other law of two tangents, or one alone */
    {try_responses, STRUCTURES, 0, "responses"},                /* every degree of freedom */
    {try_other_orders, BOTH, OSCILLATORS, "harmonics"},         /* numbers of harmonics: order.score */
    {search_scales, OSCILLATORS, OSCILLATORS, "scales"},        /* a factor of all values, or frequencies */
    {try_odd_only, OSCILLATORS, OSCILLATORS, NULL},             /* odd harmonics */
    {try_every_change, BOTH, OSCILLATORS, "equations"},         /* the table of changes.h */
    {try_odd_only, STRUCTURES, 0, NULL},                        /* odd harmonics */
    {try_sliders, OSCILLATORS, 0, "sliders"},                   /* mistakes in following the slider */
    {try_orders_of_changed, OSCILLATORS, 0, OTHER_HARMONICS},   /* the best changes with other harmonics */
    {try_fits_of_factor, OSCILLATORS, OSCILLATORS, NULL},       /* what else a fitted factor may be */
    {try_small, STRUCTURES, 0, "samples"},                      /* few harmonics, few samples: likely_score */
    {search_fits, STRUCTURES, 0, "numbers of the model"},       /* a free factor of one number, or an angle */
    {try_bases, BOTH, 0, "samples"},                            /* samples with the best orders: likely_score */
    {try_small, OSCILLATORS, 0, "samples"},                     /* few harmonics, few samples: likely_score */
    {search_scales, STRUCTURES, 0, "scales"},                   /* a factor of all values, or frequencies */
    {try_near_likeliest, BOTH, 0, "samples"},                   /* samples around the likeliest: likely_score */
    {try_likeliest_with_orders, BOTH, 0, NULL},                 /* the likeliest samples with other harmonics */
    {try_orders_of_changed, STRUCTURES, 0, OTHER_HARMONICS},    /* the best changes with other harmonics */
    {try_sliders, STRUCTURES, 0, "sliders"},                    /* mistakes in following the slider */
    {try_curves, BOTH, 0, "samples' own curves"},               /* the likeliest samples, along their curves */
    {try_fits_of_rest, OSCILLATORS, 0, "numbers of the model"}, /* a free factor of one number, or an angle */
    {try_pairs, BOTH, 0, "equations without harmonic 0"},       /* the table of changes.h, without harmonic 0 */
};
enum { STAGES = sizeof stages / sizeof *stages };

static void add_words(char *text, size_t size, const char *words)
{
  const size_t used = strlen(text);
  if (words && !strstr(text, words)) snprintf(text + used, size - used, "%s%s", used ? ", " : "", words);
}

/* HC_INTERRUPTED: out of patience, or stopped. */
static hc_status run_stages(search *s)
{
  const stage_in here = s->oscillator ? OSCILLATORS : STRUCTURES;
  verify_report *out = s->out;
  hc_status st = HC_OK;
  for (int i = 0; i < STAGES; ++i) {
    const stage *one = &stages[i];
    if (!(one->in & here)) continue;
    const bool passed_over = st == HC_OK && !(one->always & here) && search_explained(s);
    if (st == HC_OK && !passed_over) {
      st = one->run(s);
      if (st == HC_OK) add_words(out->tried, sizeof out->tried, one->words);
      if (st == HC_OK && s->said) search_say(s);
    }
    if (st == HC_INTERRUPTED && (!one->words || !strstr(out->tried, one->words)))
      add_words(out->not_tried, sizeof out->not_tried, one->words);
  }
  return st;
}

/* A monitor that loses its patience. */
typedef struct patience {
  const hc_monitor *whole;
  double end; /* [s] on the thread's clock */
  bool over;
} patience;

static bool patient(void *self, double done)
{
  patience *p = self;
  p->over = thread_seconds() > p->end;
  return !p->over && hc_monitor_tick(p->whole, done);
}

/* Another reading of the frequencies is tried if all points that differ are then within a factor 2 of the sweep. */
static void search_frequencies(search *s)
{
  double low = fmin(s->setup->omega_from, s->setup->omega_to) / 2,
         high = fmax(s->setup->omega_from, s->setup->omega_to) * 2;
  for (int f = 0; f < SEARCH_FREQUENCIES; ++f) {
    int inside = 0;
    for (int i = 0; i < s->points.n; ++i) {
      double omega = search_omega_factor(f) * s->points.omega[i];
      inside += omega >= low && omega <= high;
    }
    s->scaled[f] = f == 0 || inside == s->points.n;
  }
}

hc_status verify_search(const compare_setup *setup, int n, const verify_judged *responses, const verify_effort *effort,
                        const hc_monitor *monitor, const verify_curves *curves, verify_report *out)
{
  search *s = calloc(1, sizeof *s);
  if (!s) return HC_NO_MEMORY;
  const double now = thread_seconds(), asked = effort && effort->patience > 0 ? effort->patience : VERIFY_PATIENCE;
  patience left = {monitor, now + asked, false};
  const hc_monitor impatient = {patient, &left};
  *s = (search){.setup = setup,
                .monitor = &impatient,
                .effort = effort,
                .curves = curves,
                .out = out,
                .oscillator = model_is_oscillator(setup->model),
                .begun = now,
                .floor = out->gate / 10,
                .expected = 200};
  s->own = setup->hbm.harmonics == HBM_AUTO ? USUAL_HARMONICS : setup->hbm.harmonics;
  s->n_scales = verify_value_scales(setup->model, s->scales);
  hc_status st = verify_sample_of(n, responses, &s->points);
  verify_window(setup, responses[s->points.first].data, &s->from, &s->to);
  out->n_hypotheses = 0;
  out->truth_distance = verify_truth_distance(&s->points);
  if (st == HC_OK) {
    search_frequencies(s);
    st = run_stages(s);
  }
  if (st == HC_INTERRUPTED && left.over) st = HC_OK;
  if (st == HC_OK) search_judge(out);
  for (int i = 0; i < 2 * SEARCH_FREQUENCIES; ++i) verify_solutions_clear(&s->many[i % 2][i / 2]);
  free(s);
  return st;
}
