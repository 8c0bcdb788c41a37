/* score.c - results against references: digits, points. */
#include <math.h>
#include <stdlib.h>

#include "base/constants.h"
#include "suite/suite.h"

static const double same_omega = 1e-9, near_omega = 1e-3; /* [1] */
enum { MOST_DIGITS = 15 };

/* What differences are measured by: the solution's amplitude [length]. */
static double scale_of(const suite_reference *r) { return 0.5 * (r->low[SUITE_AMPLITUDE] + r->high[SUITE_AMPLITUDE]); }

double suite_digits_known(const suite_reference *r, int q)
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
  const double off = distance(r, row, q), known = suite_digits_known(r, q);
  if (isnan(off)) return isnan(known) ? NAN : 0;
  return off > 0 ? fmin(fmax(-log10(off), 0), known) : known;
}

/* The largest distance of all quantities that both have; infinite if there are none, or another omega. */
static double apart(const suite_reference *r, const suite_row *row)
{
  double most = -1;
  if (!(fabs(row->omega - r->omega) <= same_omega * r->omega)) return INFINITY;
  for (int q = 0; q < SUITE_N; ++q) most = fmax(most, distance(r, row, q)); /* fmax leaves NaN out */
  return most < 0 ? INFINITY : most;
}

static bool asked(const suite_case *c, double omega, double within)
{
  for (int i = 0; i < c->n; ++i)
    if (fabs(omega - c->references[i].omega) <= within * c->references[i].omega) return true;
  return false;
}

/* Rows that belong to no frequency of the case, and what may be meant by them. */
static void look_elsewhere(const suite_case *c, suite_answer *a)
{
  const suite_row *cycles = NULL, *near = NULL;
  int elsewhere = 0;
  for (int k = 0; k < a->n; ++k) {
    if (asked(c, a->rows[k].omega, same_omega)) continue;
    ++elsewhere;
    if (!near && asked(c, a->rows[k].omega, near_omega)) near = &a->rows[k];
    if (!cycles && asked(c, TWO_PI * a->rows[k].omega, near_omega)) cycles = &a->rows[k];
  }
  if (elsewhere == a->n && cycles)
    suite_say(a->wrong, "%s:%ld:1: omega %.10g is in cycles, expected %.10g rad per time", a->path, cycles->line,
              cycles->omega, TWO_PI * cycles->omega);
  else if (near && !*a->note)
    suite_say(a->note, "%s:%ld:1: omega %.10g is next to one that is asked, expected it to 10 digits", a->path,
              near->line, near->omega);
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
      const double known = suite_digits_known(r, q);
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
  double least[SUITE_N] = {INFINITY, INFINITY, INFINITY, INFINITY}, conjugate = 0;
  for (int k = 0; k < c->n; ++k) {
    const suite_reference *r = &c->references[k];
    const suite_match *m = &s->matches[k];
    if (!m->row) continue;
    for (int q = 0; q < SUITE_N; ++q) least[q] = fmin(least[q], m->digits[q]); /* fmin leaves NaN out */
    conjugate = fmax(conjugate, fabs(m->row->value[SUITE_B1] + r->low[SUITE_B1]) / scale_of(r));
  }
  const double harmonic = fmin(least[SUITE_A1], least[SUITE_B1]), others = fmin(harmonic, least[SUITE_AMPLITUDE]);
  if (conjugate <= pow(10, -digits) && least[SUITE_B1] + FAR < least[SUITE_A1]) suite_say(cause, "sign_of_b1");
  else if (least[SUITE_MEAN] + FAR < others) suite_say(cause, "mean_alone");
  else if (harmonic + FAR < least[SUITE_AMPLITUDE]) suite_say(cause, "harmonic_1_alone");
  else if (s->missing && fmin(others, least[SUITE_MEAN]) >= digits) suite_say(cause, "missing_solutions");
}
