/* score.c - results against references: digits, points. */
#include <math.h>
#include <stdlib.h>

#include "compare/suite/suite.h"
#include "numerics/base/constants.h"

static const double same_omega = 1e-9, near_omega = 1e-3; /* [1] */
enum { MOST_DIGITS = 15 };

/* What differences are measured by: the solution's amplitude [length]. */
static double scale_of(const suite_reference *r) { return 0.5 * (r->low[SUITE_AMPLITUDE] + r->high[SUITE_AMPLITUDE]); }

/* How many digits a reference has of the quantity, at most 15; NaN: it is not asked. */
static double digits_known(const suite_reference *r, int q)
{
  const double half = 0.5 * (r->high[q] - r->low[q]) / scale_of(r);
  return isnan(half) ? NAN : half > 0 ? fmin(MOST_DIGITS, -log10(half)) : MOST_DIGITS;
}

/* [1] How far the row's quantity is outside the reference; NaN: one of them has none. */
static double distance(const suite_reference *r, const suite_row *row, int q)
{
  const double x = row->value[q];
  if (isnan(x) || isnan(r->low[q])) return NAN;
  return fmax(fmax(r->low[q] - x, x - r->high[q]), 0) / scale_of(r);
}

static double digits_of(const suite_reference *r, const suite_row *row, int q)
{
  const double off = distance(r, row, q), known = digits_known(r, q);
  if (isnan(off)) return isnan(known) ? NAN : 0;
  return off > 0 ? fmin(fmax(-log10(off), 0), known) : known;
}

/* The sum of the logarithms of all quantities' distances, so that one wrong column does not decide; infinite if row and
 * reference share none, or not omega. */
static double apart(const suite_reference *r, const suite_row *row)
{
  double sum = 0;
  int n = 0;
  for (int q = 0; q < SUITE_N; ++q) {
    const double off = distance(r, row, q);
    if (!isnan(off)) ++n, sum += fmax(log10(off), -MOST_DIGITS);
  }
  return n && fabs(row->omega - r->omega) <= same_omega * r->omega ? sum : INFINITY;
}

static bool asked(const suite_case *c, double omega, double within)
{
  for (int i = 0; i < c->n; ++i)
    if (fabs(omega - c->references[i].omega) <= within * c->references[i].omega) return true;
  return false;
}

/* Is each frequency of the case one of the rows', in another unit? */
static bool in_unit(const suite_case *c, const suite_answer *a, double rad)
{
  for (int i = 0, k = 0; i < c->n; ++i) {
    for (k = 0; k < a->n && !(fabs(rad * a->rows[k].omega / c->references[i].omega - 1) <= near_omega); ++k) continue;
    if (k == a->n) return false;
  }
  return true;
}

/* Rows that belong to no frequency of the case, and what may be meant by them. */
static void look_elsewhere(const suite_case *c, suite_answer *a)
{
  static const struct {
    double rad;
    const char *words;
  } units[] = {{TWO_PI, "cycles"}, {TWO_PI / 60, "revolutions per minute"}};
  const suite_row *near = NULL;
  bool none = a->n > 0;
  for (int k = 0; k < a->n; ++k) {
    if (!near && asked(c, a->rows[k].omega, near_omega) && !asked(c, a->rows[k].omega, same_omega)) near = &a->rows[k];
    none &= !asked(c, a->rows[k].omega, near_omega);
  }
  for (int u = 0; u < 2 && none; ++u)
    if (in_unit(c, a, units[u].rad))
      suite_say(a->wrong, "%s: omega %.10g is in %s, expected %.10g rad per time", a->path, a->rows->omega,
                units[u].words, units[u].rad * a->rows->omega);
  if (*a->note || *a->wrong) return;
  if (near)
    suite_say(a->note, "%s: omega %.10g is next to one that is asked, expected it to 10 digits", a->path, near->omega);
  else if (none)
    suite_say(a->note, "%s: no row is at an omega of the case, such as %.10g", a->path, c->references->omega);
}

/* The nearest pair of what is left, until none is. */
static void match_rows(const suite_case *c, const suite_answer *a, bool *taken, suite_score *s)
{
  for (;;) {
    double least = INFINITY;
    int solution = -1, row = -1;
    for (int i = 0; i < c->n; ++i)
      for (int k = 0; k < a->n && !s->matches[i].row; ++k) {
        const double d = taken[k] ? INFINITY : apart(&c->references[i], &a->rows[k]);
        if (d < least) least = d, solution = i, row = k;
      }
    if (row < 0) return;
    taken[row] = true;
    s->matches[solution].row = &a->rows[row];
  }
}

hc_status suite_judge(const suite_case *c, suite_answer *a, suite_score *s)
{
  bool *taken = calloc((size_t)a->n + 1, sizeof *taken);
  int n = 0;
  *s = (suite_score){.digits = INFINITY, .matches = calloc((size_t)c->n + 1, sizeof *s->matches)};
  if (!taken || !s->matches) return free(taken), HC_NO_MEMORY;
  look_elsewhere(c, a);
  if (!*a->wrong) match_rows(c, a, taken, s);
  for (int i = 0; i < c->n; ++i) {
    const suite_reference *r = &c->references[i];
    suite_match *m = &s->matches[i];
    s->missing += !m->row;
    for (int q = 0; q < SUITE_N; ++q) {
      const double known = digits_known(r, q);
      m->digits[q] = m->row ? digits_of(r, m->row, q) : isnan(known) ? NAN : 0;
      if (isnan(m->digits[q])) continue;
      ++n;
      s->mean += m->digits[q];
      s->points += fmin(1, m->digits[q] / fmin(SUITE_FULL, known));
      if (m->digits[q] < s->digits) s->digits = m->digits[q], s->worst = i, s->quantity = q;
    }
  }
  s->mean /= n, s->points /= n;
  for (int k = 0; k < a->n; ++k) s->extra += !taken[k] && asked(c, a->rows[k].omega, same_omega);
  free(taken);
  return HC_OK;
}

void suite_tell(const suite_case *c, const suite_score *s, double digits, char *cause)
{
  enum { FAR = 2 };
  double least[SUITE_N] = {INFINITY, INFINITY, INFINITY, INFINITY};
  const double allowed = pow(10, -digits);
  bool conjugate = true, twice = true;
  for (int k = 0; k < c->n; ++k) {
    const suite_reference *r = &c->references[k];
    const suite_match *m = &s->matches[k];
    if (!m->row) continue;
    for (int q = 0; q < SUITE_N; ++q) least[q] = fmin(least[q], m->digits[q]); /* fmin leaves NaN out */
    conjugate &= fabs(m->row->value[SUITE_B1] + r->low[SUITE_B1]) / scale_of(r) <= allowed;
    twice &= fabs(m->row->value[SUITE_AMPLITUDE] / scale_of(r) - 2) <= allowed;
  }
  const double harmonic = fmin(least[SUITE_A1], least[SUITE_B1]), others = fmin(harmonic, least[SUITE_AMPLITUDE]);
  if (s->missing == c->n) return;
  if (conjugate && least[SUITE_B1] + FAR < least[SUITE_A1]) suite_say(cause, "sign_of_b1");
  else if (least[SUITE_MEAN] + FAR < others) suite_say(cause, "mean_alone");
  else if (harmonic + FAR < least[SUITE_AMPLITUDE]) suite_say(cause, "harmonic_1_alone");
  else if (least[SUITE_AMPLITUDE] + FAR < harmonic) suite_say(cause, twice ? "peak_to_peak" : "amplitude_alone");
  else if (s->missing && fmin(others, least[SUITE_MEAN]) >= digits) suite_say(cause, "missing_solutions");
}
