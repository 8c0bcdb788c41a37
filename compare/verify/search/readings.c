/* readings.c - see search.h. Distances are relative to the larger of the two, so that no factor makes everything
 * small. */
#include "compare/verify/search/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/response.h"
#include "numerics/base/constants.h"
#include "numerics/base/number.h"
#include "numerics/base/thread_clock.h"

static const struct {
  double factor;
  verify_causes cause;
} factors[] = {
    {1, 0},
    {2, VERIFY_BIT(CAUSE_TWICE)},
    {0.5, VERIFY_BIT(CAUSE_HALF)},
    {0.70710678118654752440, VERIFY_BIT(CAUSE_RMS)},
    {1e3, VERIFY_BIT(CAUSE_LENGTH)},
    {1e-3, VERIFY_BIT(CAUSE_LENGTH)},
    {1e2, VERIFY_BIT(CAUSE_LENGTH)},
    {1e-2, VERIFY_BIT(CAUSE_LENGTH)},
};
enum { FACTORS = sizeof factors / sizeof *factors };
static const double good = 0.01; /* [1] what a cause may leave */
/* At most so many points that match and that differ, for each look. */
static const int most_looked_at[SEARCH_LOOKS][2] = {{16, SEARCH_MOST_POINTS - 16}, {3, 10}, {2, 5}};
_Static_assert(FACTORS + 1 == SEARCH_FACTORS, "and dB");

/* ---- the sample ---- */

/* A point of the file: the rows at one omega, of every response the one that is the same in number there. */
typedef struct place {
  double omega;
  const verify_row *row[SEARCH_MOST_RESPONSES];
  bool differs; /* any of them */
} place;

static int by_omega(const void *a, const void *b)
{
  const verify_row *p = *(const verify_row *const *)a, *q = *(const verify_row *const *)b;
  if (p->omega != q->omega) return p->omega < q->omega ? -1 : 1;
  return (p->line > q->line) - (p->line < q->line);
}

/* Is number i of n one of `wanted` that are evenly spread, `taken` of them being before it? */
static bool is_taken(int i, int n, int wanted, int taken)
{
  return taken < wanted && (long)i * wanted >= (long)taken * n;
}

static double relative(double a, double b, double least)
{
  double d = fabs(a - b), scale = fmax(fmax(fabs(a), fabs(b)), least);
  return d == 0 ? 0 : d <= scale ? d / scale : 1; /* NaN is as far as can be */
}

static void put_place(const place *from, int n, const verify_judged *responses, verify_sample *out)
{
  const int i = out->n++;
  out->omega[i] = from->omega;
  for (int r = 0; r < n; ++r) {
    const verify_row *row = from->row[r];
    verify_quantity other = responses[r].data->quantity;
    const bool decibel = other.decibel;
    other.decibel = true;
    out->value[r][i] = row ? row->value : NAN;
    out->decibel[r][i] = !row      ? NAN
                         : decibel ? verify_quantity_to_column(&other, row->value)
                                   : verify_quantity_from_column(&other, row->value);
    out->differs[r][i] = row && verify_row_differs(row);
    out->off[r][i] = row && !isnan(row->nearest) ? relative(row->value, row->nearest, row->scale) : NAN;
  }
}

/* Chooses points for the search, evenly spread: as many that differ as there is room for, and a few that match. */
hc_status verify_sample_of(int n, const verify_judged *responses, verify_sample *out)
{
  size_t rows = 1;
  *out = (verify_sample){.n_responses = n, .part = 0.9, .left = good};
  for (int r = n - 1; r >= 0; --r) {
    rows += (size_t)responses[r].report->n_rows;
    out->quantity[r] = responses[r].data->quantity;
    out->wrong[r] = responses[r].wrong;
    if (responses[r].wrong) out->first = r;
  }
  place *places = calloc(rows, sizeof *places);
  const verify_row **sorted = malloc(rows * sizeof *sorted);
  int count = 0;
  for (int r = 0; r < n && places && sorted; ++r) {
    const verify_report *of = responses[r].report;
    for (int i = 0; i < of->n_rows; ++i) sorted[i] = &of->rows[i];
    qsort(sorted, (size_t)of->n_rows, sizeof *sorted, by_omega);
    /* Both ascend: each row goes to the next place of its omega that has none of its response, or to a new one. */
    for (int i = 0, at = 0; i < of->n_rows; ++i) {
      if (sorted[i]->skipped) continue;
      while (at < count &&
             (places[at].omega < sorted[i]->omega || (places[at].omega == sorted[i]->omega && places[at].row[r])))
        ++at;
      if (at == count || places[at].omega != sorted[i]->omega) {
        memmove(places + at + 1, places + at, (size_t)(count++ - at) * sizeof *places);
        places[at] = (place){.omega = sorted[i]->omega};
      }
      places[at].row[r] = sorted[i];
      places[at].differs |= verify_row_differs(sorted[i]);
    }
  }
  /* Each look is at some of what the one before is at: so many there are, so many were seen so far. */
  int there[SEARCH_LOOKS + 1][2] = {{0}}, seen[SEARCH_LOOKS + 1][2] = {{0}};
  for (int i = 0; i < count; ++i) ++there[0][places[i].differs];
  for (int l = 0; l < SEARCH_LOOKS; ++l)
    for (int off = 0; off < 2; ++off)
      there[l + 1][off] = there[l][off] < most_looked_at[l][off] ? there[l][off] : most_looked_at[l][off];
  for (int i = 0; i < count; ++i) {
    const bool off = places[i].differs;
    int l = 0;
    for (; l < SEARCH_LOOKS; ++l) {
      if (!is_taken(seen[l][off]++, there[l][off], there[l + 1][off], seen[l + 1][off])) break;
      out->looked_at[l][out->n] = true;
    }
    if (l == SEARCH_LOOKS) ++seen[l][off];
    if (l > 0) put_place(&places[i], n, responses, out);
  }
  const hc_status st = places && sorted ? HC_OK : HC_NO_MEMORY;
  free(places);
  free(sorted);
  return st;
}

/* ---- distances ---- */

/* The distance that a part of them, nine of ten, is within. The median would not do: where the contacts do nothing,
 * points fit any hypothesis about them. */
static double within(int n, double *d, double part)
{
  if (n == 0) return 0;
  if (part == 0) {
    const double least = 1e-6; /* as good as nothing */
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += log(fmax(d[i], least));
    return exp(sum / n);
  }
  qsort(d, (size_t)n, sizeof *d, ascending);
  return d[(int)ceil(part * n - 1e-9) - 1];
}

/* How far the value is from the nearest solution at omega number i, read as quantity q of response r times the
 * factor. */
static double nearest(double value, const verify_solutions *s, int i, int r, int q, double factor)
{
  double least = 1;
  for (int k = s->first[i]; k < s->first[i + 1]; ++k) {
    const verify_solution *of = &s->of[k * s->n_responses + r];
    least = fmin(least, relative(value, factor * of->q[q], factor * of->scale[q]));
  }
  return least;
}

static bool looked_at(const verify_sample *p, int r, int i)
{
  return p->looked_at[p->look][i] && !isnan(p->value[r][i]);
}

/* The distance between the sample's response r and quantity q of the solutions. */
static double distance_of(const verify_sample *p, int r, bool decibel, const verify_solutions *s, int q, double factor)
{
  int off = 0, on = 0;
  double far[SEARCH_MOST_POINTS], near[SEARCH_MOST_POINTS],
      taken = 0; /* the farthest that matches, and is solved for */
  const bool read = p->wrong[r];
  const double *value = read && decibel ? p->decibel[r] : p->value[r];
  for (int i = 0; i < p->n; ++i) {
    if (!looked_at(p, r, i)) continue;
    const double least = nearest(value[i], s, i, r, read ? q : 0, read ? factor : 1);
    if (p->differs[r][i]) far[off++] = least;
    else near[on++] = least;
    if (!p->differs[r][i] && s->first[i] < s->first[i + 1]) taken = fmax(taken, least);
  }
  return fmax(fmax(within(off, far, p->part), within(on, near, p->part)), taken > p->left ? taken : 0);
}

static double distance(const verify_sample *p, bool decibel, const verify_solutions *s, int q, double factor)
{
  double most = 0;
  for (int r = 0; r < p->n_responses; ++r) most = fmax(most, distance_of(p, r, decibel, s, q, factor));
  return most;
}

double verify_truth_distance(const verify_sample *p)
{
  double most = 0;
  for (int r = 0; r < p->n_responses; ++r) {
    int n = 0;
    double far[SEARCH_MOST_POINTS];
    for (int i = 0; i < p->n; ++i)
      if (p->differs[r][i] && !isnan(p->off[r][i])) far[n++] = p->off[r][i];
    most = fmax(most, within(n, far, p->part));
  }
  return most;
}

void search_distances_of(const verify_sample *p, int response, const verify_solutions *of, search_distances out)
{
  for (int f = 0; f < SEARCH_FACTORS; ++f)
    for (int i = 0; i < VERIFY_READINGS; ++i)
      out[f * VERIFY_READINGS + i] =
          distance_of(p, response, f == FACTORS, of, i, f == FACTORS ? 1 : factors[f].factor);
}

static void rank(verify_hypothesis *h, double floor)
{
  const double of_fit = h->fitted ? 1.01 : 1; /* of equals the one that nothing was fitted of */
  h->score = of_fit * fmax(h->distance, floor) * pow(3, verify_cause_count(h->causes));
}

void verify_read_one(const verify_sample *p, const verify_solutions *s, int reading, double factor, double floor,
                     verify_hypothesis *h)
{
  verify_causes ignored;
  verify_reading(reading, &p->quantity[p->first], &h->quantity, &ignored);
  h->value_factor = factor;
  h->distance = distance(p, false, s, reading, factor);
  rank(h, floor);
}

double verify_read_plain(const verify_sample *p, const verify_solutions *s) { return distance(p, false, s, 0, 1); }

double verify_closeness(const verify_sample *p, const verify_solutions *s)
{
  const double most = 0.3; /* farther is as bad: points on a branch that is not there must not lead a fit */
  double sum = 0;
  int n = 0;
  for (int r = 0; r < p->n_responses; ++r)
    for (int i = 0; i < p->n; ++i)
      if (looked_at(p, r, i)) sum += fmin(most, nearest(p->value[r][i], s, i, r, 0, 1)), ++n;
  return sum / n;
}

/* How far apart two sets of solutions are in response r. */
static double apart_of(const verify_sample *p, int r, const verify_solutions *a, const verify_solutions *b)
{
  int n = 0;
  double far[SEARCH_MOST_POINTS];
  for (int i = 0; i < p->n; ++i) {
    if (!p->differs[r][i] || !looked_at(p, r, i)) continue;
    if (a->first[i] == a->first[i + 1] || b->first[i] == b->first[i + 1]) continue; /* not known */
    double worst = 0;
    for (int k = a->first[i]; k < a->first[i + 1]; ++k)
      worst = fmax(worst, nearest(a->of[k * a->n_responses + r].q[0], b, i, r, 0, 1));
    far[n++] = worst;
  }
  return within(n, far, p->part);
}

double verify_apart(const verify_sample *p, const verify_solutions *a, const verify_solutions *b)
{
  double most = 0;
  for (int r = 0; r < p->n_responses; ++r) most = fmax(most, apart_of(p, r, a, b));
  return most;
}

/* ---- what a column may have been divided by ---- */

static void add_scale(verify_scale *out, int *n, double factor, const char *name)
{
  if (isfinite(factor) && factor > 0 && factor != 1) out[(*n)++] = (verify_scale){factor, name};
}

int verify_value_scales(const model *m, verify_scale out[VERIFY_MOST_SCALES])
{
  int n = 0;
  if (!model_is_oscillator(m)) {
    /* The largest amplitude of a load at one degree of freedom that is not static. */
    double largest = 0;
    for (int l = 0; l < m->n_loads; ++l)
      for (int i = 0; i < m->n && m->loads[l].harmonic > 0; ++i)
        largest = fmax(largest, hypot(m->loads[l].cosine[i], m->loads[l].sine[i]));
    add_scale(out, &n, 1 / largest, "1/F, the largest load");
    add_scale(out, &n, largest, "F, the largest load");
    return n;
  }
  const double stuck = model_max_stiffness(m), force = fabs(model_force(m));
  add_scale(out, &n, 1 / force, "1/F0");
  add_scale(out, &n, *m->stiffness / force, "K/F0, 1/static deflection");
  add_scale(out, &n, stuck / force, "(K + stuck contacts)/F0, 1/static deflection");
  add_scale(out, &n, force, "F0");
  if (m->n_contacts) add_scale(out, &n, 1 / fabs(m->contacts[0].law.gap), "1/gap");
  return n;
}

int verify_omega_scales(const model *m, verify_scale out[VERIFY_MOST_SCALES])
{
  int n = 0;
  if (model_is_oscillator(m)) {
    const double open = sqrt(*m->stiffness / *m->mass), stuck = sqrt(model_max_stiffness(m) / *m->mass);
    add_scale(out, &n, 1 / open, "1/w0, w0^2 = K/M");
    add_scale(out, &n, TWO_PI / open, "2 pi/w0, w0^2 = K/M");
    add_scale(out, &n, 1 / stuck, "1/w0, w0^2 = (K + stuck contacts)/M");
    add_scale(out, &n, TWO_PI / stuck, "2 pi/w0, w0^2 = (K + stuck contacts)/M");
  }
  add_scale(out, &n, 60 / TWO_PI, "revolutions per minute");
  add_scale(out, &n, 60, "cycles per minute, from cycles per second");
  add_scale(out, &n, 1e-3, "thousands");
  return n;
}

const verify_scale *verify_scale_near(const verify_scale *s, int n, double factor, double tolerance)
{
  for (int i = 0; i < n; ++i)
    if (fabs(factor / s[i].factor - 1) <= tolerance) return &s[i];
  return NULL;
}

/* ---- judge ---- */

/* Which cause is named. The rule, of hypotheses ranked by distance times 3 per cause:
 *   fits     what the best leaves is within the gate or 1 %, whichever is larger, and within a fifth of how far the
 *            truth is off; if it has a factor that was fitted, within the gate, and a tenth: a free factor imitates
 *            much
 *   alone    no other set of causes, not larger, comes within a factor `rival` of that distance, or of a tenth of the
 *            gate if that is larger
 * One that fits alone is named; else it, and its rivals, are the nearest guess. A fit is no rival of what nothing was
 * fitted of and is within the gate. Causes that are among the best's, and those with more to them, are no rivals: they
 * say nothing else. Nor are changes of the model that leave its contacts apart, or stuck, where that is the best: they
 * may be why. */
static const double much_better = 0.2, much_better_fitted = 0.1, rival = 3, guess_worth = 0.2;

bool verify_fits(const verify_report *r)
{
  const verify_hypothesis *h = &r->hypotheses[0];
  const double part = h->fitted ? much_better_fitted : much_better, left = h->fitted ? r->gate : fmax(r->gate, good);
  return r->n_hypotheses > 0 && h->distance <= left && h->distance < part * r->truth_distance;
}

/* Does it say what the contacts do, and the other what may be the reason? */
static bool explains(const verify_hypothesis *reason, const verify_hypothesis *what)
{
  const verify_change does = what->equations.change, because = reason->equations.change;
  return (does == CHANGE_NO_CONTACT || does == CHANGE_STUCK) && because > CHANGE_STUCK;
}

/* Distances up to this are as good as the best's. */
static double close_to(const verify_report *r, const verify_hypothesis *best)
{
  return rival * fmax(best->distance, r->gate / 10);
}

bool verify_rival(const verify_report *r, int i)
{
  if (i <= 0 || i >= r->n_hypotheses || i >= VERIFY_HYPOTHESES) return false;
  const verify_hypothesis *best = &r->hypotheses[0];
  const verify_hypothesis *other = &r->hypotheses[i];
  const verify_causes both = best->causes & other->causes;
  if (both == best->causes || both == other->causes || explains(other, best)) return false;
  if (verify_cause_count(other->causes) > verify_cause_count(best->causes)) return false;
  if (other->fitted && !best->fitted && best->distance <= r->gate) return false;
  return other->distance <= close_to(r, best);
}

bool verify_reason(const verify_report *r, int i)
{
  const verify_hypothesis *best = &r->hypotheses[0], *h = &r->hypotheses[i];
  const bool likewise = verify_cause_count(h->causes) <= verify_cause_count(best->causes);
  return i > 0 && i < r->n_hypotheses && likewise && explains(h, best) && h->distance <= close_to(r, best);
}

void search_judge(verify_report *out)
{
  /* mu = 0 and kt = 0 are the same equations */
  const verify_causes no_traction = VERIFY_BIT(CAUSE_NO_FRICTION) | VERIFY_BIT(CAUSE_NO_KT);
  const verify_hypothesis *best = &out->hypotheses[0];
  verify_causes all = best->causes;
  bool alone = true;
  out->nearest_guess = 0;
  if (out->n_hypotheses == 0) return;
  for (int i = 1; i < out->n_hypotheses; ++i) {
    if (!verify_rival(out, i)) continue;
    const verify_causes other = out->hypotheses[i].causes;
    alone &= (best->causes ^ other) == no_traction;
    all |= other;
  }
  if (verify_fits(out) && alone) out->causes = all;
  else if (best->distance < guess_worth * out->truth_distance) out->nearest_guess = all;
}

/* ---- equations solved, read in every way, and kept by their score ---- */

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

const double search_factors[SEARCH_USUAL_FACTORS] = {2, 0.5, 10, 0.1, 0};

/* Is the number of the change, if it has one, none that was fitted? */
static bool usual_number(const verify_equations *e)
{
  bool usual = verify_changes[e->change].scan == SCAN_NONE;
  for (int i = 0; i < SEARCH_USUAL_FACTORS; ++i) usual |= e->factor == search_factors[i];
  return usual;
}

static void largest_distances(const verify_sample *p, const verify_solutions *of, search_distances out)
{
  search_distances one;
  for (int k = 0; k < SEARCH_DISTANCES; ++k) out[k] = 0;
  for (int r = 0; r < p->n_responses; ++r) {
    search_distances_of(p, r, of, one);
    for (int k = 0; k < SEARCH_DISTANCES; ++k) out[k] = fmax(out[k], one[k]);
  }
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
  largest_distances(&s->points, of, d);
  const bool enough = without > 0 && there >= VERIFY_LEAST_DIFFERING && there > without;
  if (enough) largest_distances(&solved, of, d_solved);
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
  for (int f = 0; f <= FACTORS; ++f) /* the last is dB */
    for (int i = 0; i < VERIFY_READINGS; ++i) {
      verify_hypothesis h = given;
      verify_causes of_reading;
      const bool decibel = f == FACTORS;
      const verify_causes of_factor = decibel ? VERIFY_BIT(CAUSE_DECIBEL) : factors[f].cause;
      if (!verify_reading(i, asked, &h.quantity, &of_reading)) continue;
      if ((of_reading & of_factor) || (of_reading && of_factor == VERIFY_BIT(CAUSE_RMS))) continue;
      if (of_factor == VERIFY_BIT(CAUSE_LENGTH) && verify_scale_near(s->scales, s->n_scales, factors[f].factor, 1e-3))
        continue;                                            /* the unit may be what the values were divided by */
      if (given.causes && of_factor && of_reading) continue; /* nothing is that wrong */
      h.causes |= of_factor | of_reading;
      if (!h.causes && !(h.causes = otherwise)) continue; /* the truth as it stands is no hypothesis */
      const int k = f * VERIFY_READINGS + i;
      h.decibel = decibel;
      h.value_factor = decibel ? 1 : factors[f].factor;
      h.distance = d[k];
      if (most && e->samples == SEARCH_MOST_SAMPLES) most[k] = d[k];
      else if (most && d[k] < most[k] - s->floor) h.causes |= VERIFY_BIT(CAUSE_SAMPLES);
      rank(&h, s->floor);
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

hc_status search_follow(search *s, const verify_equations *e, double omega_factor, verify_solutions *out)
{
  double omega[SEARCH_MOST_POINTS];
  const verify_places at = places_of(s, omega_factor, omega);
  return verify_solutions_of(s->setup, e, &at, s->monitor, out);
}

hc_status search_near(search *s, const verify_equations *e, double omega_factor, const verify_solutions *near,
                      verify_solutions *out)
{
  double omega[SEARCH_MOST_POINTS];
  const verify_places at = places_of(s, omega_factor, omega);
  return verify_solutions_near(s->setup, e, near, &at, out);
}

/* The least distance of a reading. */
static double least_distance(const search *s, const verify_solutions *of, double part)
{
  double least = 1;
  verify_sample p = s->points;
  p.part = part;
  p.left = INFINITY;
  for (int f = 0; f <= FACTORS; ++f)
    for (int i = 0; i < VERIFY_READINGS; ++i)
      least = fmin(least, distance(&p, f == FACTORS, of, i, f == FACTORS ? 1 : factors[f].factor));
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
static bool hopeless(const search *s, const verify_equations *e, const verify_solutions *of)
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
  if (o) largest_distances(&s->points, of, o->distance[frequency]);
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
  hc_status st = near ? search_near(s, e, omega_factor, near, out) : search_follow(s, e, omega_factor, out);
  s->plainly = false;
  if (near && st == HC_OK && !hopeless(s, e, out)) {
    s->points.look = SEARCH_FEW;
    verify_solutions_clear(out);
    st = search_near(s, e, omega_factor, near, out);
  }
  s->last = st == HC_OK ? least_distance(s, out, s->points.part) : 1;
  const bool more = near && st == HC_OK && promising(s, s->last, out);
  if (more) {
    s->points.look = SEARCH_ALL;
    verify_solutions_clear(out);
    st = search_near(s, e, omega_factor, near, out);
    if (st == HC_OK) s->last = least_distance(s, out, s->points.part);
  }
  if (st == HC_OK) read_tried(s, e, frequency, out);
  if (more && st == HC_OK && e->samples == 0 && least_distance(s, out, s->points.part) > s->out->gate &&
      least_distance(s, out, 0) <= 3 * s->out->gate) {
    verify_solutions_clear(out);
    st = search_follow(s, e, omega_factor, out);
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
    st = followed ? search_follow(s, &h.equations, h.omega_factor, &of)
                  : search_near(s, &h.equations, h.omega_factor, near, &of);
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
