/* search.c - see search.h. In stages, the later ones only if none before explains the points:
 *   exact    every number of harmonics with and without harmonic 0, odd ones only, and every change of the model, with
 *            every reading of the columns; one factor of all values or frequencies
 *   sampled  for the likeliest of these, every number of samples, from their solutions by Newton
 *   fits     a free factor of one number of the model
 *   pairs    changes of the model without harmonic 0, with few harmonics, or few samples
 * A number of harmonics counts as a cause where its solutions are farther than the gate from those of many. */
#include "compare/verify/search/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/response.h"
#include "compare/verify/search/search_impl.h"
#include "compare/verify/truth/truth.h"

static const int harmonics_tried[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 15, 20};
static const double factors_tried[] = {2, 0.5, 10, 0.1};
enum {
  HARMONICS_TRIED = sizeof harmonics_tried / sizeof *harmonics_tried,
  FACTORS_TRIED = sizeof factors_tried / sizeof *factors_tried,
  USUAL_HARMONICS = 10
};

/* ---- numbers of harmonics ---- */

static hc_status try_order(search *s, int harmonics, bool keep_mean)
{
  const verify_equations e = {.keep_mean = keep_mean, .harmonics = harmonics, .factor = 1};
  const bool many = harmonics == s->out->harmonics;
  order *o = &s->orders[s->n_orders++];
  hc_status st = HC_OK;
  *o = (order){.harmonics = harmonics, .keep_mean = keep_mean, .score = INFINITY};
  for (int f = 0; f < SEARCH_FREQUENCIES && st == HC_OK; ++f) {
    if (!s->scaled[f]) continue;
    verify_solutions own = {0}, *of = many ? &s->many[keep_mean][f] : &own;
    st = search_solve(s, &e, search_omega_factor(f), of);
    if (st == HC_OK && !many) o->matters[f] = verify_apart(&s->points, of, &s->many[keep_mean][f]) > s->out->gate;
    if (st == HC_OK && many && keep_mean && f == 0) s->out->truth_distance = verify_read_plain(&s->points, of);
    if (st == HC_OK) o->score = fmin(o->score, verify_closeness(&s->points, of));
    if (st == HC_OK) search_read(s, &e, f, of);
    verify_solutions_clear(&own);
  }
  return st == HC_OK && !search_tick(s) ? HC_INTERRUPTED : st;
}

/* All but the truth's own. */
static hc_status try_other_orders(search *s)
{
  hc_status st = try_order(s, s->out->harmonics, false);
  bool own_too = s->own < s->out->harmonics;
  for (int i = HARMONICS_TRIED - 1; i >= 0 && st == HC_OK; --i) {
    int harmonics = harmonics_tried[i];
    if (harmonics >= s->out->harmonics) continue;
    own_too &= harmonics != s->own;
    for (int mean = 1; mean >= 0 && st == HC_OK; --mean) st = try_order(s, harmonics, mean);
  }
  for (int mean = 1; own_too && mean >= 0 && st == HC_OK; --mean) st = try_order(s, s->own, mean);
  return st;
}

static hc_status try_orders(search *s)
{
  hc_status st = try_order(s, s->out->harmonics, true);
  return st == HC_OK ? try_other_orders(s) : st;
}

static hc_status try_odd_only(search *s)
{
  const int orders[] = {s->own, s->out->harmonics, 3, 5, 7, 9};
  hc_status st = HC_OK;
  for (size_t i = 0; i < sizeof orders / sizeof *orders && st == HC_OK; ++i) {
    const verify_equations e = {.odd_only = true, .harmonics = orders[i], .factor = 1};
    st = search_try(s, &e);
  }
  return st;
}

/* ---- changes of the model ---- */

static int variants(const search *s, verify_change c) { return verify_change_variants(s->setup->model, c); }

/* Every change, in equations that are otherwise *like; those with a factor at the usual ones. */
static hc_status try_changes(search *s, const verify_equations *like)
{
  hc_status st = HC_OK;
  for (int c = CHANGE_NONE + 1; c < VERIFY_CHANGES && st == HC_OK; ++c)
    for (int i = 0; i < (verify_change_has_factor(c) ? FACTORS_TRIED : 1) * variants(s, c) && st == HC_OK; ++i) {
      verify_equations e = *like;
      e.change = c;
      if (c == CHANGE_RESPONSE) continue; /* try_responses */
      e.which = i % variants(s, c);
      e.n = s->setup->model->n;
      e.factor = verify_change_has_factor(c) ? factors_tried[i / variants(s, c)] : 1;
      if (c == CHANGE_NO_CONTACT || c == CHANGE_STUCK) e.harmonics = 1;
      st = search_try(s, &e);
    }
  return st;
}

/* The other law of two tangents, or one tangent alone: what programs differ in, and before what is dear. All of them,
 * since a response across which nothing slips has one curve for several. */
static hc_status try_limits(search *s)
{
  const int orders[] = {s->out->harmonics, s->own};
  const model *m = s->setup->model;
  hc_status st = HC_OK;
  if (model_whole_contacts(m) == m->n_contacts) return HC_OK;
  for (int i = 0; i < 2 && st == HC_OK && !search_explained(s); ++i)
    for (int c = CHANGE_SQUARE_LIMIT; c <= CHANGE_NO_TANGENT_1 && st == HC_OK; ++c) {
      const verify_equations e = {.change = c, .keep_mean = true, .harmonics = orders[i], .factor = 1, .n = m->n};
      st = search_try(s, &e);
    }
  return st;
}

/* The likeliest changed models again with other numbers of harmonics: theirs may not be the case's. */
static hc_status try_orders_of_changed(search *s)
{
  enum { TOP = 3 };
  verify_equations top[TOP];
  int n = 0;
  hc_status st = HC_OK;
  for (int i = 0; i < s->out->n_hypotheses && n < TOP; ++i)
    if (s->out->hypotheses[i].equations.change > CHANGE_STUCK) top[n++] = s->out->hypotheses[i].equations;
  for (int k = 0; k < n && st == HC_OK && !search_explained(s); ++k)
    for (int i = 2; i <= HARMONICS_TRIED && st == HC_OK; ++i) {
      top[k].harmonics = i < HARMONICS_TRIED ? harmonics_tried[i] : s->out->harmonics;
      st = search_try(s, &top[k]);
    }
  return st;
}

/* ---- another response ---- */

typedef struct response_reader {
  search *s;
  verify_equations equations;
} response_reader;

static void read_dof(void *self, int dof, const verify_solutions *of)
{
  const response_reader *r = self;
  const model *m = r->s->setup->model;
  bool asked = true; /* is it the response itself? */
  for (int i = 0; i < m->n; ++i) asked &= m->responses[i] == (i == dof);
  verify_equations e = r->equations;
  e.change = CHANGE_RESPONSE;
  e.which = dof + 1;
  e.n = m->n;
  if (!asked) search_read(r->s, &e, 0, of);
}

/* Every degree of freedom in the place of the response, by the truth and with the case's own harmonics. */
static hc_status try_responses(search *s)
{
  const int orders[] = {s->out->harmonics, s->own};
  hc_status st = HC_OK;
  for (int i = 0; i < 2 && st == HC_OK && !search_explained(s); ++i) {
    response_reader r = {s, {.keep_mean = true, .harmonics = orders[i], .factor = 1}};
    st = verify_solutions_of_dofs(s->setup, &r.equations, &s->points.quantity, s->from, s->to, s->points.n,
                                  s->points.omega, s->monitor, read_dof, &r);
    if (st == HC_OK && !search_tick(s)) st = HC_INTERRUPTED;
  }
  return st;
}

/* ---- in stages ---- */

/* Is the best hypothesis a factor without a name? Factors of the model's numbers may do what it does. */
static bool free_factor(const search *s) { return s->out->n_hypotheses > 0 && s->out->hypotheses[0].fitted; }

/* Curves of a structure are dearer, and more may be wrong: the plainest first, until one explains the points. */
static hc_status try_structure(search *s)
{
  const verify_equations own = search_own(s);
  hc_status st = try_order(s, s->out->harmonics, true);
  if (st == HC_OK && !search_explained(s)) st = try_limits(s);
  if (st == HC_OK && !search_explained(s) && s->setup->model->n > 1) st = try_responses(s);
  if (st == HC_OK && !search_explained(s)) st = try_other_orders(s);
  if (st == HC_OK && !search_explained(s)) st = try_changes(s, &own);
  if (st == HC_OK && !search_explained(s)) st = search_scales(s);
  if (st == HC_OK && !search_explained(s) && s->setup->model->n_contacts) st = try_odd_only(s);
  if (st == HC_OK && !search_explained(s) && s->setup->model->n_contacts) st = search_sliders(s);
  if (st == HC_OK && !search_explained(s)) st = try_orders_of_changed(s);
  return st;
}

static hc_status try_exact(search *s)
{
  if (!model_is_oscillator(s->setup->model)) return try_structure(s);
  const verify_equations own = search_own(s);
  hc_status st = try_orders(s);
  if (st == HC_OK) st = search_scales(s);
  if (st == HC_OK && s->setup->model->n_contacts) st = try_odd_only(s);
  if (st == HC_OK) st = try_changes(s, &own);
  if (st == HC_OK && s->setup->model->n_contacts && !search_explained(s)) st = search_sliders(s);
  if (st == HC_OK && !search_explained(s)) st = try_orders_of_changed(s);
  if (st == HC_OK && free_factor(s)) st = search_fits(s);
  return st;
}

static hc_status try_pairs(search *s)
{
  verify_equations without = search_own(s);
  without.keep_mean = false;
  return try_changes(s, &without);
}

static hc_status try_everything(search *s)
{
  hc_status st = try_exact(s);
  const bool fits_done = free_factor(s);
  const bool contacts = s->setup->model->n_contacts > 0;
  if (st == HC_OK && contacts && !search_explained(s)) st = search_sampled(s);
  if (st == HC_OK && !search_explained(s) && !fits_done) st = search_fits(s);
  if (st == HC_OK && contacts && !search_explained(s) && !verify_fits(s->out)) st = try_pairs(s);
  return st;
}

/* Another reading of the frequencies is tried if all points that differ are then within a factor 2 of the sweep. */
static void choose_frequencies(search *s)
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

hc_status verify_search(const compare_setup *setup, const verify_data *data, const hc_monitor *monitor,
                        verify_report *out)
{
  search *s = calloc(1, sizeof *s);
  if (!s) return HC_NO_MEMORY;
  *s = (search){.setup = setup, .monitor = monitor, .out = out, .floor = out->gate / 10, .expected = 200};
  s->own = setup->hbm.harmonics == HBM_AUTO ? USUAL_HARMONICS : setup->hbm.harmonics;
  s->n_scales = verify_value_scales(setup->model, s->scales);
  verify_window(setup, data, &s->from, &s->to);
  hc_status st = verify_sample_new(out, &data->quantity, &s->points);
  out->n_hypotheses = 0;
  out->truth_distance = NAN;
  if (st == HC_OK) {
    choose_frequencies(s);
    st = try_everything(s);
  }
  if (st == HC_OK) search_judge(out);
  for (int i = 0; i < 2 * SEARCH_FREQUENCIES; ++i) verify_solutions_clear(&s->many[i % 2][i / 2]);
  verify_sample_clear(&s->points);
  free(s);
  return st;
}
