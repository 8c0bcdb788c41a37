/* tries.c - one set of equations tried: solved, read in every way, and kept among the hypotheses by its score. */
#include <math.h>
#include <string.h>

#include "compare/verify/search/search.h"
#include "numerics/base/constants.h"
#include "numerics/base/thread_clock.h"

static const double nearly_all = 0.02; /* [1] of the truth's distance may be left */

double search_omega_factor(int frequency)
{
  static const double omega_factors[SEARCH_FREQUENCIES] = {1, TWO_PI, 1 / TWO_PI};
  return omega_factors[frequency];
}

bool search_tick(search *s)
{
  double part = (double)++s->done / s->expected;
  if (!s->said && thread_seconds() - s->begun > VERIFY_FIRST_ANSWER) search_say(s);
  return hc_monitor_tick(s->monitor, 0.5 + 0.5 * (part < 1 ? part : 1));
}

void search_say(search *s)
{
  verify_report *out = s->out;
  s->said = true;
  if (!s->effort || !s->effort->say) return;
  search_judge(out);
  const verify_causes now = out->causes | out->nearest_guess;
  if (now != s->said_causes) s->effort->say(s->effort->self, out);
  s->said_causes = now;
  out->causes = out->nearest_guess = 0;
}

verify_equations search_equations(int harmonics, bool keep_mean)
{
  return (verify_equations){.keep_mean = keep_mean, .harmonics = harmonics, .factor = 1};
}

verify_equations search_own(const search *s) { return search_equations(s->own, true); }

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

/* Is the slider followed by mistake? */
static bool of_slider(const verify_equations *e) { return VERIFY_MODEL_CHANGES + e->restart >= CHANGE_SLIDER_ZEROED; }

static verify_causes causes_of(const search *s, const verify_equations *e, int frequency)
{
  verify_causes causes = frequency ? VERIFY_BIT(CAUSE_FREQUENCY) : 0;
  if (e->change != CHANGE_NONE) causes |= VERIFY_BIT(verify_changes[e->change].cause);
  if (verify_equations_linear(e)) return causes;
  if (e->odd_only) causes |= VERIFY_BIT(CAUSE_ODD_ONLY);
  else if (!e->keep_mean) causes |= VERIFY_BIT(CAUSE_NO_STATIC);
  /* A mistake in following the slider is one whatever the samples: they are a cause, too, of readings that fewer than
   * SEARCH_MOST_SAMPLES bring closer. */
  const int slider = verify_slider_kind(e)->cause;
  if (e->samples && slider != CAUSE_NONE) causes |= VERIFY_BIT(slider);
  if (e->samples && !of_slider(e)) causes |= VERIFY_BIT(CAUSE_SAMPLES);
  return causes | (too_few_harmonics(s, e, frequency) ? VERIFY_BIT(CAUSE_HARMONICS) : 0);
}

int search_order(const search *s, int i)
{
  const int orders[SEARCH_ORDERS] = {7, 10, 15, s->out->harmonics, 5, 3};
  return orders[i];
}

const double search_usual[SEARCH_USUAL_FACTORS] = {2, 0.5, 10, 0.1, 0};

/* Is the number of the change, if it has one, none that was fitted? */
static bool usual_number(const verify_equations *e)
{
  bool usual = verify_changes[e->change].scan == SCAN_NONE;
  for (int i = 0; i < SEARCH_USUAL_FACTORS; ++i) usual |= e->factor == search_usual[i];
  return usual;
}

void search_read(search *s, const verify_equations *e, int frequency, const verify_solutions *of)
{
  search_distances d, d_solved;
  verify_sample solved = s->points;
  int there = 0, without = 0; /* of the points that differ in the first response that is wrong; of all */
  for (int i = 0; i < solved.n; ++i) {
    bool *const looked = &solved.looked_at[solved.look][i];
    const bool is_there = of->first[i] < of->first[i + 1];
    without += *looked && !is_there;
    there += *looked && is_there && solved.differs[solved.first][i];
    *looked &= is_there;
  }
  search_largest_distances(&s->points, of, d);
  const bool enough = without > 0 && there >= VERIFY_LEAST_DIFFERING && there > without;
  if (enough) search_largest_distances(&solved, of, d_solved);
  search_read_distances(s, e, frequency, d, enough ? d_solved : NULL);
}

/* [SEARCH_DISTANCES] of the same equations with nothing wrong but their number of harmonics; NULL: these are they. */
static const double *plain_distances(const search *s, const verify_equations *e, int frequency)
{
  const bool plain = e->change == CHANGE_NONE && !e->odd_only && e->samples == 0;
  for (int i = 0; i < s->n_orders && !plain; ++i)
    if (s->orders[i].harmonics == e->harmonics && s->orders[i].keep_mean == e->keep_mean)
      return s->orders[i].distance[frequency];
  return NULL;
}

static bool says_more(const search *s, const double *plain, int k, double distance)
{
  return !plain || distance < plain[k] - s->floor;
}

hc_status search_passed(search *s, const verify_equations *e, int frequency, hc_status st)
{
  if (st == HC_INTERRUPTED || st == HC_NO_MEMORY) return st;
  if (st != HC_OK && st != HC_BAD_INPUT) s->out->unsolved |= causes_of(s, e, frequency);
  return HC_OK;
}

void search_read_distances(search *s, const verify_equations *e, int frequency, const search_distances d,
                           const double *d_solved)
{
  const double *plain = plain_distances(s, e, frequency);
  double *const most = of_slider(e) ? s->most_samples[e->restart] : NULL;
  const verify_sample *p = &s->points;
  const verify_quantity *asked = &p->quantity[p->first];
  const verify_causes otherwise = e->harmonics < s->out->harmonics ? VERIFY_BIT(CAUSE_HARMONICS) : 0;
  const verify_hypothesis given = {.equations = *e,
                                   .omega_factor = search_omega_factor(frequency),
                                   .fitted = !s->oscillator && !usual_number(e),
                                   .causes = causes_of(s, e, frequency)};
  for (int f = 0; f < SEARCH_FACTORS; ++f)
    for (int i = 0; i < VERIFY_READINGS; ++i) {
      verify_hypothesis h = given;
      verify_causes of_reading;
      const verify_causes of_factor = search_factors[f].cause;
      if (!verify_reading(i, asked, &h.quantity, &of_reading)) continue;
      if ((of_reading & of_factor) || (of_reading && of_factor == VERIFY_BIT(CAUSE_RMS))) continue;
      if (of_factor == VERIFY_BIT(CAUSE_LENGTH) &&
          verify_scale_near(s->scales, s->n_scales, search_factors[f].factor, 1e-3))
        continue;                                            /* the unit may be what the values were divided by */
      if (given.causes && of_factor && of_reading) continue; /* nothing is that wrong */
      h.causes |= of_factor | of_reading;
      if (!h.causes && !(h.causes = otherwise)) continue; /* the truth as it stands is no hypothesis */
      const int k = f * VERIFY_READINGS + i;
      h.decibel = search_factors[f].decibel;
      h.value_factor = search_factors[f].factor;
      h.distance = d[k];
      if (most && e->samples == SEARCH_MOST_SAMPLES) most[k] = d[k];
      else if (most && d[k] < most[k] - s->floor) h.causes |= VERIFY_BIT(CAUSE_SAMPLES);
      search_rank(&h, s->floor);
      if (says_more(s, plain, k, d[k])) search_keep(s, &h);
      if (d_solved && d_solved[k] <= s->out->gate && d[k] > s->out->gate && says_more(s, plain, k, d_solved[k]))
        s->out->unsolved |= h.causes;
    }
}

static verify_places places_of(const search *s, double omega_factor, double *omega)
{
  const verify_sample *p = &s->points;
  verify_places at = {.from = s->from,
                      .to = s->to,
                      .n = p->n,
                      .omega = omega,
                      .only = p->looked_at[p->look],
                      .n_responses = p->n_responses,
                      .asked = p->quantity,
                      .value = s->oscillator ? NULL : p->value[0],
                      .stride = SEARCH_MOST_POINTS,
                      .curves = s->curves,
                      .plainly = s->plainly};
  for (int i = 0; i < p->n; ++i) omega[i] = omega_factor * p->omega[i];
  if (omega_factor != 1) {
    number_list ends = {.n = 2, .v = {omega[0], omega[p->n - 1]}};
    comparison_sweep(s->setup->omega_from, s->setup->omega_to, &ends, &at.from, &at.to);
  }
  return at;
}

hc_status search_solve(search *s, const verify_equations *e, double omega_factor, const verify_solutions *near,
                       verify_solutions *out)
{
  double omega[SEARCH_MOST_POINTS];
  const verify_places at = places_of(s, omega_factor, omega);
  return near ? verify_solutions_near(s->setup, e, near, &at, out)
              : verify_solutions_of(s->setup, e, &at, s->monitor, out);
}

/* The least distance of a reading. */
static double least_distance(const search *s, const verify_solutions *of, double part)
{
  double least = 1;
  search_distances d;
  verify_sample p = s->points;
  p.part = part;
  p.left = INFINITY;
  search_largest_distances(&p, of, d);
  for (int k = 0; k < SEARCH_DISTANCES; ++k) least = fmin(least, d[k]);
  return least;
}

/* Do the points nearly fit, or those at which there are solutions? */
static bool promising(const search *s, double nine_of_ten, const verify_solutions *of)
{
  const double nearly = 0.03;
  return nine_of_ten <= nearly || least_distance(s, of, 0) <= 3 * s->out->gate;
}

/* Is no reading near as few points as a right one must fit, be the others on branches that were not found? Few samples
 * have many solutions, of which one guess leads to any. Equations with exact forces may be right but for their number
 * of harmonics. */
static bool search_hopeless(const search *s, const verify_equations *e, const verify_solutions *of)
{
  const double near = e->samples > 0 ? 0.03 : 0.1; /* [1] */
  const bool many = e->samples > 0 && e->samples <= VERIFY_FEW_SAMPLES * e->harmonics;
  return least_distance(s, of, many ? 0.2 : 0.3) > near;
}

/* Every reading of these equations' solutions; of a number of harmonics also, whether it matters. */
static void read_tried(search *s, const verify_equations *e, int frequency, const verify_solutions *of)
{
  order *o = s->current;
  const verify_solutions *many = &s->many[e->keep_mean][frequency];
  if (o) search_largest_distances(&s->points, of, o->distance[frequency]);
  if (o && e->harmonics < s->out->harmonics) o->matters[frequency] = verify_apart(&s->points, of, many) > s->out->gate;
  if (o) o->score = fmin(o->score, verify_closeness(&s->points, of));
  search_read(s, e, frequency, of);
}

hc_status search_try(search *s, const verify_equations *e, int frequency, const verify_solutions *near,
                     verify_solutions *out)
{
  const double omega_factor = search_omega_factor(frequency);
  const bool far = e->change == CHANGE_FRICTION_SIGN; /* the truth's solutions lead to few of theirs */
  *out = (verify_solutions){0};
  s->points.look = !near ? SEARCH_ALL : far ? SEARCH_FEW : SEARCH_GLANCE;
  s->plainly = near;
  hc_status st = search_solve(s, e, omega_factor, near, out);
  s->plainly = false;
  if (near && st == HC_OK && !search_hopeless(s, e, out)) {
    s->points.look = SEARCH_FEW;
    verify_solutions_clear(out);
    st = search_solve(s, e, omega_factor, near, out);
  }
  s->last = st == HC_OK ? least_distance(s, out, s->points.part) : 1;
  const bool more = near && st == HC_OK && promising(s, s->last, out);
  if (more) {
    s->points.look = SEARCH_ALL;
    verify_solutions_clear(out);
    st = search_solve(s, e, omega_factor, near, out);
    if (st == HC_OK) s->last = least_distance(s, out, s->points.part);
  }
  if (st == HC_OK) read_tried(s, e, frequency, out);
  if (more && st == HC_OK && e->samples == 0 && least_distance(s, out, s->points.part) > s->out->gate &&
      least_distance(s, out, 0) <= 3 * s->out->gate) {
    verify_solutions_clear(out);
    st = search_solve(s, e, omega_factor, NULL, out);
    if (st == HC_OK) read_tried(s, e, frequency, out);
  }
  return st;
}

hc_status search_fit(search *s, verify_hypothesis h, const verify_solutions *near)
{
  const bool stands = h.omega_factor == 1 && h.value_factor == 1;
  const double *plain = stands ? plain_distances(s, &h.equations, 0) : NULL;
  verify_solutions of = {0};
  s->points.look = SEARCH_ALL;
  hc_status st = HC_OK;
  for (int followed = !near; followed < 2 && st == HC_OK; ++followed) {
    st = search_solve(s, &h.equations, h.omega_factor, followed ? NULL : near, &of);
    if (st == HC_OK) verify_read_one(&s->points, &of, 0, h.value_factor, s->floor, &h);
    if (st == HC_OK && says_more(s, plain, 0, h.distance)) search_keep(s, &h);
    verify_solutions_clear(&of);
    if (h.distance <= s->out->gate) break;
  }
  return st;
}

bool search_explained(const search *s)
{
  const verify_hypothesis *best = &s->out->hypotheses[0];
  return verify_fits(s->out) && best->distance <= fmin(s->out->gate, nearly_all * s->out->truth_distance);
}
