/* branches.c - the verdicts along the branches: points on an unstable one, and points that change it. A curve with
 * unstable branches beside the stable ones is the whole curve; one with unstable points where a stable branch exists,
 * and none on that, or with nothing but unstable points, followed the wrong branch. */
#include <math.h>

#include "compare/verify/points.h"

int points_reversals(const verify_data *d)
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

/* Is every judged point on an unstable branch? */
static bool all_unstable(const verify_report *r)
{
  int unstable = 0;
  for (int i = 0; i < r->n_rows; ++i) {
    if (r->rows[i].skipped) continue;
    if (r->rows[i].verdict != VERDICT_UNSTABLE) return false;
    ++unstable;
  }
  return unstable > 0;
}

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

verify_causes points_branches(verify_report *r)
{
  for (int i = 0; i < r->n_rows; ++i) {
    const verify_row *row = &r->rows[i];
    if (!row->skipped && (row->verdict == VERDICT_DIFFERS || row->verdict == VERDICT_SOLVER_FAILED)) return 0;
  }
  if (mark_hops(r)) return VERIFY_BIT(CAUSE_OTHER_BRANCH);
  return only_unstable(r) || all_unstable(r) ? VERIFY_BIT(CAUSE_UNSTABLE) : 0;
}
