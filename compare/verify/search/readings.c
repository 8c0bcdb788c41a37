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

const search_factor search_factors[SEARCH_FACTORS] = {
    {1, 0, false},
    {2, VERIFY_BIT(CAUSE_TWICE), false},
    {0.5, VERIFY_BIT(CAUSE_HALF), false},
    {0.70710678118654752440, VERIFY_BIT(CAUSE_RMS), false},
    {1e3, VERIFY_BIT(CAUSE_LENGTH), false},
    {1e-3, VERIFY_BIT(CAUSE_LENGTH), false},
    {1e2, VERIFY_BIT(CAUSE_LENGTH), false},
    {1e-2, VERIFY_BIT(CAUSE_LENGTH), false},
    {1, VERIFY_BIT(CAUSE_DECIBEL), true},
};
static const double good = 0.01; /* [1] what a cause may leave */
/* At most so many points that match and that differ, for each look. */
static const int most_looked_at[SEARCH_LOOKS][2] = {{16, SEARCH_MOST_POINTS - 16}, {3, 10}, {2, 5}};

/* ---- the sample ---- */

/* A point of the file: the rows at one omega, of every response the one that is the same in number there. */
typedef struct place {
  double omega;
  const verify_row *row[SEARCH_MOST_RESPONSES];
  bool differs; /* any of them */
} place;

static int rows_by_omega(const void *a, const void *b)
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

static double relative_difference(double a, double b, double least)
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
    out->off[r][i] = row && !isnan(row->nearest) ? relative_difference(row->value, row->nearest, row->scale) : NAN;
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
    qsort(sorted, (size_t)of->n_rows, sizeof *sorted, rows_by_omega);
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
static double within_part(int n, double *d, double part)
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
static double nearest_solution(double value, const verify_solutions *s, int i, int r, int q, double factor)
{
  double least = 1;
  for (int k = s->first[i]; k < s->first[i + 1]; ++k) {
    const verify_solution *of = &s->of[k * s->n_responses + r];
    least = fmin(least, relative_difference(value, factor * of->q[q], factor * of->scale[q]));
  }
  return least;
}

static bool looked_at(const verify_sample *p, int r, int i)
{
  return p->looked_at[p->look][i] && !isnan(p->value[r][i]);
}

/* The distance between the sample's response r and quantity q of the solutions. */
static double response_distance(const verify_sample *p, int r, bool decibel, const verify_solutions *s, int q,
                                double factor)
{
  int off = 0, on = 0;
  double far[SEARCH_MOST_POINTS], near[SEARCH_MOST_POINTS],
      taken = 0; /* the farthest that matches, and is solved for */
  const bool read = p->wrong[r];
  const double *value = read && decibel ? p->decibel[r] : p->value[r];
  for (int i = 0; i < p->n; ++i) {
    if (!looked_at(p, r, i)) continue;
    const double least = nearest_solution(value[i], s, i, r, read ? q : 0, read ? factor : 1);
    if (p->differs[r][i]) far[off++] = least;
    else near[on++] = least;
    if (!p->differs[r][i] && s->first[i] < s->first[i + 1]) taken = fmax(taken, least);
  }
  return fmax(fmax(within_part(off, far, p->part), within_part(on, near, p->part)), taken > p->left ? taken : 0);
}

static double largest_distance(const verify_sample *p, const verify_solutions *s, int q, double factor)
{
  double most = 0;
  for (int r = 0; r < p->n_responses; ++r) most = fmax(most, response_distance(p, r, false, s, q, factor));
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
    most = fmax(most, within_part(n, far, p->part));
  }
  return most;
}

void search_distances_of(const verify_sample *p, int response, const verify_solutions *of, search_distances out)
{
  for (int f = 0; f < SEARCH_FACTORS; ++f)
    for (int i = 0; i < VERIFY_READINGS; ++i)
      out[f * VERIFY_READINGS + i] =
          response_distance(p, response, search_factors[f].decibel, of, i, search_factors[f].factor);
}

void search_largest_distances(const verify_sample *p, const verify_solutions *of, search_distances out)
{
  search_distances one;
  for (int k = 0; k < SEARCH_DISTANCES; ++k) out[k] = 0;
  for (int r = 0; r < p->n_responses; ++r) {
    search_distances_of(p, r, of, one);
    for (int k = 0; k < SEARCH_DISTANCES; ++k) out[k] = fmax(out[k], one[k]);
  }
}

void search_rank(verify_hypothesis *h, double floor)
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
  h->distance = largest_distance(p, s, reading, factor);
  search_rank(h, floor);
}

double verify_read_plain(const verify_sample *p, const verify_solutions *s) { return largest_distance(p, s, 0, 1); }

double verify_closeness(const verify_sample *p, const verify_solutions *s)
{
  const double most = 0.3; /* farther is as bad: points on a branch that is not there must not lead a fit */
  double sum = 0;
  int n = 0;
  for (int r = 0; r < p->n_responses; ++r)
    for (int i = 0; i < p->n; ++i)
      if (looked_at(p, r, i)) sum += fmin(most, nearest_solution(p->value[r][i], s, i, r, 0, 1)), ++n;
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
      worst = fmax(worst, nearest_solution(a->of[k * a->n_responses + r].q[0], b, i, r, 0, 1));
    far[n++] = worst;
  }
  return within_part(n, far, p->part);
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
