/* readings.c - see readings.h. Distances are relative to the larger of the two, so that no factor makes everything
 * small. */
#include "compare/verify/search/readings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/number.h"

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
enum { FACTORS = sizeof factors / sizeof *factors, MOST_DIFFERING = 48, MOST_MATCHING = 16 };

/* ---- the sample ---- */

static int by_omega(const void *a, const void *b)
{
  const verify_row *p = *(const verify_row *const *)a, *q = *(const verify_row *const *)b;
  if (p->omega != q->omega) return p->omega < q->omega ? -1 : 1;
  return (p->line > q->line) - (p->line < q->line);
}

static bool differs(const verify_row *r)
{
  return !r->skipped && (r->verdict == VERDICT_DIFFERS || r->verdict == VERDICT_SOLVER_FAILED);
}

/* At most `most` of the n rows that differ or not, evenly spread, appended. */
static void choose_rows(const verify_row **rows, int n, bool off, int most, verify_sample *out)
{
  int there = 0, seen = 0, taken = 0;
  for (int i = 0; i < n; ++i) there += differs(rows[i]) == off;
  int wanted = there < most ? there : most;
  for (int i = 0; i < n && taken < wanted; ++i) {
    if (differs(rows[i]) != off) continue;
    if ((long)seen++ * wanted < (long)taken * there) continue;
    out->omega[out->n] = rows[i]->omega;
    out->value[out->n] = rows[i]->value;
    out->differs[out->n++] = off;
    ++taken;
  }
}

/* Insertion sort by omega: there are at most MOST_DIFFERING + MOST_MATCHING. */
static void sort(verify_sample *s)
{
  for (int i = 1; i < s->n; ++i)
    for (int k = i; k > 0 && s->omega[k] < s->omega[k - 1]; --k) {
      double omega = s->omega[k], value = s->value[k];
      bool off = s->differs[k];
      s->omega[k] = s->omega[k - 1], s->value[k] = s->value[k - 1], s->differs[k] = s->differs[k - 1];
      s->omega[k - 1] = omega, s->value[k - 1] = value, s->differs[k - 1] = off;
    }
}

hc_status verify_sample_new(const verify_report *r, const verify_quantity *quantity, verify_sample *out)
{
  enum { MOST = MOST_DIFFERING + MOST_MATCHING };
  const verify_row **rows = malloc((size_t)r->n_rows * sizeof *rows + 1);
  double *numbers = calloc(5 * MOST, sizeof *numbers);
  *out = (verify_sample){.omega = numbers, .quantity = *quantity, .part = 0.9};
  if (numbers) out->value = numbers + MOST, out->decibel = numbers + 2 * MOST, out->scratch = numbers + 3 * MOST;
  out->differs = calloc(MOST, sizeof *out->differs);
  if (rows && numbers && out->differs) {
    for (int i = 0; i < r->n_rows; ++i) rows[i] = &r->rows[i];
    qsort(rows, (size_t)r->n_rows, sizeof *rows, by_omega);
    choose_rows(rows, r->n_rows, true, MOST_DIFFERING, out);
    choose_rows(rows, r->n_rows, false, MOST_MATCHING, out);
    sort(out);
    verify_quantity other = *quantity;
    other.decibel = true;
    for (int i = 0; i < out->n; ++i)
      out->decibel[i] = quantity->decibel ? verify_quantity_to_column(&other, out->value[i])
                                          : verify_quantity_from_column(&other, out->value[i]);
    free(rows);
    return HC_OK;
  }
  free(rows);
  free(numbers);
  free(out->differs);
  *out = (verify_sample){0};
  return HC_NO_MEMORY;
}

void verify_sample_clear(verify_sample *s)
{
  free(s->omega);
  free(s->differs);
  *s = (verify_sample){0};
}

/* ---- distances ---- */

static double geometric_mean(int n, const double *d)
{
  const double least = 1e-6; /* as good as nothing */
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += log(fmax(d[i], least));
  return exp(sum / n);
}

/* The distance that a part of them, nine of ten, is within. The median would not do: where the contacts do nothing,
 * points fit any hypothesis about them. */
static double within(int n, double *d, double part)
{
  if (n == 0) return 0;
  if (part == 0) return geometric_mean(n, d);
  qsort(d, (size_t)n, sizeof *d, ascending);
  return d[(int)ceil(part * n - 1e-9) - 1];
}

static double relative(double a, double b, double least)
{
  double d = fabs(a - b), scale = fmax(fmax(fabs(a), fabs(b)), least);
  return d == 0 ? 0 : d <= scale ? d / scale : 1; /* NaN is as far as can be */
}

/* How far value i is from the nearest solution at its omega, read as quantity q times the factor. */
static double nearest(const double *value, const verify_solutions *s, int i, int q, double factor)
{
  double least = 1;
  for (int k = s->first[i]; k < s->first[i + 1]; ++k)
    least = fmin(least, relative(value[i], factor * s->of[k].q[q], factor * s->of[k].scale[q]));
  return least;
}

static double distance(const verify_sample *p, const double *value, const verify_solutions *s, int q, double factor)
{
  int off = 0, on = 0;
  double *far = p->scratch, *near = p->scratch + p->n;
  for (int i = 0; i < p->n; ++i) {
    const double least = nearest(value, s, i, q, factor);
    if (p->differs[i]) far[off++] = least;
    else near[on++] = least;
  }
  double of_far = within(off, far, p->part), of_near = within(on, near, p->part);
  return fmax(of_far, of_near);
}

static void rank(verify_hypothesis *h, double floor)
{
  h->score = fmax(h->distance, floor) * pow(3, verify_cause_count(h->causes));
}

void verify_read_one(const verify_sample *p, const verify_solutions *s, int reading, double factor, double floor,
                     verify_hypothesis *h)
{
  verify_causes ignored;
  verify_reading(reading, &p->quantity, &h->quantity, &ignored);
  h->value_factor = factor;
  h->distance = distance(p, p->value, s, reading, factor);
  rank(h, floor);
}

void verify_read_all(const verify_sample *p, const verify_solutions *s, const verify_hypothesis *given,
                     verify_causes otherwise, double floor, int n, const verify_scale *scales, verify_keep *keep,
                     void *self)
{
  for (int f = 0; f <= FACTORS; ++f) /* the last is dB */
    for (int i = 0; i < VERIFY_READINGS; ++i) {
      verify_hypothesis h = *given;
      verify_causes of_reading;
      const bool decibel = f == FACTORS;
      const verify_causes of_factor = decibel ? VERIFY_BIT(CAUSE_DECIBEL) : factors[f].cause;
      if (!verify_reading(i, &p->quantity, &h.quantity, &of_reading)) continue;
      if ((of_reading & of_factor) || (of_reading && of_factor == VERIFY_BIT(CAUSE_RMS))) continue;
      if (of_factor == VERIFY_BIT(CAUSE_LENGTH) && verify_scale_near(scales, n, factors[f].factor, 1e-3)) continue;
      if (given->causes && of_factor && of_reading) continue; /* nothing is that wrong */
      h.causes |= of_factor | of_reading;
      if (!h.causes && !(h.causes = otherwise)) continue; /* the truth as it stands is no hypothesis */
      h.decibel = decibel;
      h.value_factor = decibel ? 1 : factors[f].factor;
      h.distance = distance(p, decibel ? p->decibel : p->value, s, i, h.value_factor);
      rank(&h, floor);
      keep(self, &h);
    }
}

double verify_read_plain(const verify_sample *p, const verify_solutions *s) { return distance(p, p->value, s, 0, 1); }

double verify_closeness(const verify_sample *p, const verify_solutions *s)
{
  const double most = 0.3; /* farther is as bad: points on a branch that is not there must not lead a fit */
  double sum = 0;
  for (int i = 0; i < p->n; ++i) sum += fmin(most, nearest(p->value, s, i, 0, 1));
  return sum / p->n;
}

double verify_apart(const verify_sample *p, const verify_solutions *a, const verify_solutions *b)
{
  int n = 0;
  for (int i = 0; i < p->n; ++i) {
    if (!p->differs[i]) continue;
    double worst = a->first[i] < a->first[i + 1] ? 0 : 1;
    for (int k = a->first[i]; k < a->first[i + 1]; ++k) {
      double least = 1;
      for (int j = b->first[i]; j < b->first[i + 1]; ++j)
        least = fmin(least, relative(a->of[k].q[0], b->of[j].q[0], b->of[j].scale[0]));
      worst = fmax(worst, least);
    }
    p->scratch[n++] = worst;
  }
  return within(n, p->scratch, p->part);
}

/* ---- what a column may have been divided by ---- */

static void add_scale(verify_scale *out, int *n, double factor, const char *name)
{
  if (isfinite(factor) && factor > 0 && factor != 1) out[(*n)++] = (verify_scale){factor, name};
}

/* The largest amplitude of a load at one degree of freedom that is not static. */
static double largest_load(const model *m)
{
  double most = 0;
  for (int l = 0; l < m->n_loads; ++l)
    for (int i = 0; i < m->n && m->loads[l].harmonic > 0; ++i)
      most = fmax(most, hypot(m->loads[l].cosine[i], m->loads[l].sine[i]));
  return most;
}

int verify_value_scales(const model *m, verify_scale out[VERIFY_MOST_SCALES])
{
  int n = 0;
  if (!model_is_oscillator(m)) {
    const double largest = largest_load(m);
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

/* ---- the values ---- */
