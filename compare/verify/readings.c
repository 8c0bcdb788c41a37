/* readings.c - see readings.h. Distances are relative to the larger of the two, so that no factor makes everything
 * small. */
#include "compare/verify/readings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/ascending.h"
#include "base/constants.h"

static const double frequencies[VERIFY_FREQUENCIES] = {1, TWO_PI, 1 / TWO_PI};

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

double verify_omega_factor(int frequency) { return frequencies[frequency]; }

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
  double *numbers = calloc(4 * MOST, sizeof *numbers);
  *out = (verify_sample){.omega = numbers, .quantity = *quantity, .part = 0.9};
  if (numbers) out->value = numbers + MOST, out->scratch = numbers + 2 * MOST;
  out->differs = calloc(MOST, sizeof *out->differs);
  if (rows && numbers && out->differs) {
    for (int i = 0; i < r->n_rows; ++i) rows[i] = &r->rows[i];
    qsort(rows, (size_t)r->n_rows, sizeof *rows, by_omega);
    choose_rows(rows, r->n_rows, true, MOST_DIFFERING, out);
    choose_rows(rows, r->n_rows, false, MOST_MATCHING, out);
    sort(out);
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

static double distance(const verify_sample *p, const verify_solutions *s, int q, double factor)
{
  int off = 0, on = 0;
  double *far = p->scratch, *near = p->scratch + p->n;
  for (int i = 0; i < p->n; ++i) {
    double least = 1;
    for (int k = s->first[i]; k < s->first[i + 1]; ++k)
      least = fmin(least, relative(p->value[i], factor * s->of[k].q[q], factor * s->of[k].scale[q]));
    if (p->differs[i]) far[off++] = least;
    else near[on++] = least;
  }
  double of_far = within(off, far, p->part), of_near = within(on, near, p->part);
  return fmax(of_far, of_near);
}

void verify_read_best(const verify_sample *p, const verify_solutions *s, int frequency, verify_causes otherwise,
                      double floor, verify_hypothesis *h)
{
  const verify_causes given = h->causes | (frequency ? VERIFY_BIT(CAUSE_FREQUENCY) : 0);
  h->omega_factor = frequencies[frequency];
  h->score = INFINITY;
  for (int f = 0; f < FACTORS; ++f)
    for (int i = 0; i < VERIFY_READINGS; ++i) {
      verify_quantity q;
      verify_causes of_reading;
      if (!verify_reading(i, &p->quantity, &q, &of_reading)) continue;
      if ((of_reading & factors[f].cause) || (of_reading && factors[f].cause == VERIFY_BIT(CAUSE_RMS))) continue;
      verify_causes causes = given | factors[f].cause | of_reading;
      if (!causes && !(causes = otherwise)) continue; /* the truth as it stands is no hypothesis */
      double d = distance(p, s, i, factors[f].factor), score = fmax(d, floor) * pow(3, verify_cause_count(causes));
      if (!(score < h->score)) continue;
      h->score = score;
      h->distance = d;
      h->causes = causes;
      h->value_factor = factors[f].factor;
      h->quantity = q;
    }
}

double verify_read_plain(const verify_sample *p, const verify_solutions *s) { return distance(p, s, 0, 1); }

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
