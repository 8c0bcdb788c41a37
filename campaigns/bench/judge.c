/* judge.c - the Pareto front of error and time, the cheapest row within an accuracy; names and settings in words. No
 * solver here. */
#include <math.h>
#include <stdio.h>

#include "campaigns/bench/bench.h"

static const struct {
  const char *name, *meaning;
} methods[] = {
#define BENCH_WORDS(code, name, meaning) {name, meaning},
    BENCH_METHOD_LIST(BENCH_WORDS)
#undef BENCH_WORDS
};

const char *bench_method_name(bench_method m) { return methods[m].name; }

const char *bench_method_meaning(bench_method m) { return methods[m].meaning; }

const char *bench_outcome_name(bench_outcome o)
{
  static const char *const names[] = {[BENCH_WAITING] = "not_run",
                                      [BENCH_SOLVED] = "solved",
                                      [BENCH_FAILED] = "failed",
                                      [BENCH_OTHER_ORBIT] = "other_orbit",
                                      [BENCH_TOO_LONG] = "too_long"};
  return names[o];
}

const char *bench_settings(const bench_row *r, char text[BENCH_TEXT])
{
  if (r->samples > 0) snprintf(text, BENCH_TEXT, "H = %d, N = %d", r->harmonics, r->samples);
  else if (r->harmonics > 0) snprintf(text, BENCH_TEXT, "H = %d", r->harmonics);
  else if (r->regularisation > 0)
    snprintf(text, BENCH_TEXT, "regularisation %.0e, tolerance %.0e", r->regularisation, r->tolerance);
  else snprintf(text, BENCH_TEXT, "tolerance %.0e", r->tolerance);
  return text;
}

/* At settings no coarser than a's in any respect? NaN is no setting. */
static bool no_coarser(const bench_row *b, const bench_row *a)
{
  return b->method == a->method && b->harmonics >= a->harmonics && b->samples >= a->samples &&
         !(b->regularisation > a->regularisation) && !(b->tolerance > a->tolerance);
}

static bool beats(const bench_row *b, const bench_row *a)
{
  bool as_good = b->error_finer <= a->error_finer && b->seconds <= a->seconds;
  return as_good && (b->error_finer < a->error_finer || b->seconds < a->seconds);
}

void bench_judge(int n, bench_row *rows, double floor)
{
  for (int i = 0; i < n; ++i) {
    bench_row *r = &rows[i];
    r->error_finer = NAN;
    if (r->outcome != BENCH_SOLVED) continue;
    r->error_finer = fmax(r->error, floor);
    for (int k = 0; k < n; ++k)
      if (rows[k].outcome == BENCH_SOLVED && no_coarser(&rows[k], r))
        r->error_finer = fmax(r->error_finer, rows[k].error);
  }
  for (int i = 0; i < n; ++i) {
    rows[i].front = rows[i].outcome == BENCH_SOLVED && rows[i].repeats > 0;
    for (int k = 0; k < n && rows[i].front; ++k)
      if (rows[k].outcome == BENCH_SOLVED && rows[k].repeats > 0 && beats(&rows[k], &rows[i])) rows[i].front = false;
  }
}

static bool meets(const bench_row *r, double accuracy)
{
  return r->outcome == BENCH_SOLVED && r->repeats > 0 && r->error_finer <= accuracy;
}

const bench_row *bench_cheapest(int n, const bench_row *rows, double accuracy, const bench_row **second)
{
  const bench_row *best = NULL;
  *second = NULL;
  for (int i = 0; i < n; ++i)
    if (meets(&rows[i], accuracy) && (!best || rows[i].seconds < best->seconds)) best = &rows[i];
  for (int i = 0; i < n && best; ++i)
    if (meets(&rows[i], accuracy) && rows[i].method != best->method &&
        (!*second || rows[i].seconds < (*second)->seconds))
      *second = &rows[i];
  return best;
}
