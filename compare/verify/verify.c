/* verify.c - see verify.h. Here: the order of the steps, and the causes that follow from the verdicts alone: points on
 * an unstable branch, and points that change the branch. A curve with unstable branches beside the stable ones is the
 * whole curve; one with unstable points where a stable branch exists, and none on that, followed the wrong branch. */
#include "compare/verify/verify.h"

#include <math.h>
#include <stdlib.h>

#include "compare/verify/search.h"
#include "compare/verify/truth.h"

/* Are there points on an unstable branch where a stable one exists, and none on a stable one between the first and the
 * last of them? */
static bool only_unstable(const verify_report *r)
{
  double low = INFINITY, high = -INFINITY;
  for (int i = 0; i < r->n_rows; ++i) {
    const verify_row *row = &r->rows[i];
    if (row->verdict != VERDICT_UNSTABLE || !row->stable_too) continue;
    low = fmin(low, row->omega);
    high = fmax(high, row->omega);
  }
  for (int i = 0; i < r->n_rows && low <= high; ++i) {
    const verify_row *row = &r->rows[i];
    if (row->verdict == VERDICT_MATCH && row->omega >= low && row->omega <= high) return false;
  }
  return low <= high;
}

/* Do the omegas ascend or descend strictly, one value each? */
static bool one_value_each(const verify_report *r)
{
  double way = r->n_rows > 1 ? r->rows[1].omega - r->rows[0].omega : 0;
  for (int i = 1; i < r->n_rows; ++i)
    if (!((r->rows[i].omega - r->rows[i - 1].omega) * way > 0)) return false;
  return true;
}

/* Stretches of points on one stable branch, between points on another that exists along all of the stretch, get the
 * verdict other_branch. True if there are any. */
static bool mark_hops(verify_report *r)
{
  bool any = false;
  if (!one_value_each(r)) return false;
  for (int from = 1, to; from < r->n_rows; from = to) {
    const verify_row *before = &r->rows[from - 1];
    bool odd = before->verdict == VERDICT_MATCH && r->rows[from].branch != before->branch;
    for (to = from; to < r->n_rows && r->rows[to].branch == r->rows[from].branch; ++to)
      odd &= r->rows[to].verdict == VERDICT_MATCH && r->rows[to].solutions > 1;
    if (!odd || to == r->n_rows || r->rows[to].verdict != VERDICT_MATCH || r->rows[to].branch != before->branch)
      continue;
    for (int i = from; i < to; ++i) r->rows[i].verdict = VERDICT_OTHER_BRANCH;
    any = true;
  }
  return any;
}

/* How often omega turns back along the file, as along a curve with folds. */
static int reversals(const verify_data *d)
{
  int n = 0;
  double way = 0;
  for (int i = 1; i < d->n; ++i) {
    const double step = d->points[i].omega - d->points[i - 1].omega;
    n += step * way < 0;
    if (step != 0) way = step;
  }
  return n;
}

static int differing(const verify_report *r)
{
  int n = 0;
  for (int i = 0; i < r->n_rows; ++i)
    n += !r->rows[i].skipped && (r->rows[i].verdict == VERDICT_DIFFERS || r->rows[i].verdict == VERDICT_SOLVER_FAILED);
  return n;
}

hc_status verify_run(const compare_setup *setup, const verify_data *data, const hc_monitor *monitor, verify_report *out)
{
  *out = (verify_report){.truth_distance = NAN, .noise = NAN, .left_out = data->left_out, .reversals = reversals(data)};
  hc_status st = verify_truth(setup, data, monitor, out);
  int off = differing(out);
  if (off == 0 && mark_hops(out)) out->causes = VERIFY_BIT(CAUSE_OTHER_BRANCH);
  else if (off == 0 && only_unstable(out)) out->causes = VERIFY_BIT(CAUSE_UNSTABLE);
  if (st == HC_OK && off >= VERIFY_LEAST_DIFFERING) st = verify_search(setup, data, monitor, out);
  if (verify_fits(out)) out->causes = out->hypotheses[0].causes;
  for (int i = 0; i < out->n_rows; ++i) ++*(out->rows[i].skipped ? &out->skipped : &out->count[out->rows[i].verdict]);
  return out->status = st;
}

void verify_clear(verify_report *r)
{
  free(r->rows);
  *r = (verify_report){0};
}

int verify_exit_code(const verify_report *r)
{
  if (r->causes || r->count[VERDICT_DIFFERS] > 0 || r->count[VERDICT_OTHER_BRANCH] > 0) return 1;
  if (r->count[VERDICT_SOLVER_FAILED] > 0 || r->n_rows == 0) return 3;
  return r->checked > 0 && r->checked_error <= r->gate ? 0 : 3;
}
