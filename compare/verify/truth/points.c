/* points.c - see truth.h. First the verdicts along the branches: points on an unstable one, and points that change
 * it. A curve with unstable branches beside the stable ones is the whole curve; one with unstable points where a
 * stable branch exists, and none on that, or with nothing but unstable points, followed the wrong branch. */
#include <math.h>
#include <stdlib.h>

#include "compare/verify/truth/truth.h"
#include "numerics/base/workspace.h"

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

/* Is every judged point on an unstable branch, and none of the others next to a stable one? */
static bool all_unstable(const verify_report *r)
{
  int unstable = 0;
  for (int i = 0; i < r->n_rows; ++i) {
    if (r->rows[i].skipped && r->rows[i].stable <= 0) continue;
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
  const double way = r->n_rows > 1 ? r->rows[1].omega - r->rows[0].omega : 0;
  for (int i = 1; i < r->n_rows; ++i)
    if (!((r->rows[i].omega - r->rows[i - 1].omega) * way > 0)) return false;
  return true;
}

/* Stretches of points on one stable branch, between points on another that exists along all of the stretch, get the
 * verdict other_branch. True if there are any. Points without a branch are where the motion from rest goes, which may
 * be now here, now there. */
static bool mark_hops(verify_report *r)
{
  bool any = false;
  if (!one_value_each(r)) return false;
  for (int from = 1, to; from < r->n_rows; from = to) {
    const verify_row *before = &r->rows[from - 1];
    bool odd = before->verdict == VERDICT_MATCH && before->branch >= 0 && r->rows[from].branch >= 0;
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
  for (int i = 0; i < r->n_rows; ++i)
    if (verify_row_differs(&r->rows[i])) return 0;
  if (mark_hops(r)) return VERIFY_BIT(CAUSE_OTHER_BRANCH);
  return only_unstable(r) || all_unstable(r) ? VERIFY_BIT(CAUSE_UNSTABLE) : 0;
}

/* ---- points that lie around the truth, or beside it, as nothing in the equations makes them: noise of a
 * measured curve, and outliers. Neighbours are the points next in omega on the same branch of the truth, whatever the
 * file's order. */

enum { LEAST_POINTS = 10, LEAST_DIFFERENCES = 6, WINDOW = 12, MOST_LINES = 3 };
static const double deviations = 4;         /* of normal noise, one value in 16 000 is farther off */
static const double normal = 1.4826;        /* standard deviation over median of the moduli, of normal noise */
static const double loudest = 0.2;          /* [1] no measured curve scatters more */
static const double far = 2e-2, gates = 10; /* [1], gates: an outlier is farther off than both */

/* Rows that were held against a solution, by branch and omega. */
typedef struct neighbours {
  int n;
  const verify_row **row; /* [n] */
  double *offset;         /* [n] (value - nearest)/scale */
  double *scratch;        /* [n] */
  workspace memory;
} neighbours;

static int by_place(const void *a, const void *b)
{
  const verify_row *x = *(const verify_row *const *)a, *y = *(const verify_row *const *)b;
  if (x->branch != y->branch) return x->branch - y->branch;
  return (x->omega > y->omega) - (x->omega < y->omega);
}

static hc_status neighbours_of(const verify_report *r, neighbours *p)
{
  const size_t most = (size_t)r->n_rows;
  *p = (neighbours){.n = 0};
  p->row = workspace_array(&p->memory, most, sizeof *p->row);
  p->offset = workspace_doubles(&p->memory, most);
  p->scratch = workspace_doubles(&p->memory, most);
  if (p->memory.failed) {
    workspace_free(&p->memory);
    return HC_NO_MEMORY;
  }
  for (int i = 0; i < r->n_rows; ++i)
    if (!r->rows[i].skipped && r->rows[i].branch >= 0 && isfinite(r->rows[i].error)) p->row[p->n++] = &r->rows[i];
  qsort(p->row, (size_t)p->n, sizeof *p->row, by_place);
  for (int i = 0; i < p->n; ++i) p->offset[i] = (p->row[i]->value - p->row[i]->nearest) / p->row[i]->scale;
  return HC_OK;
}

/* The value that this part of list[n], n > 0, is below; sorts it. */
static double quantile(int n, double *list, double part)
{
  qsort(list, (size_t)n, sizeof *list, ascending);
  return list[(int)(part * (n - 1) + 0.5)];
}

/* The average offset of row i and its neighbours on its branch, *n of them. */
static double local_average(const neighbours *p, int i, int *n)
{
  double sum = 0;
  *n = 0;
  for (int k = i > WINDOW ? i - WINDOW : 0; k < p->n && k <= i + WINDOW; ++k) {
    if (p->row[k]->branch != p->row[i]->branch) continue;
    sum += p->offset[k];
    ++*n;
  }
  return sum / *n;
}

hc_status points_noise(verify_report *r)
{
  neighbours p;
  hc_status st = neighbours_of(r, &p);
  if (st != HC_OK) return st;
  int n = 0;
  for (int i = 1; i + 1 < p.n; ++i)
    if (p.row[i - 1]->branch == p.row[i]->branch && p.row[i]->branch == p.row[i + 1]->branch)
      p.scratch[n++] = fabs(p.offset[i - 1] - 2 * p.offset[i] + p.offset[i + 1]);
  if (p.n >= LEAST_POINTS && n >= LEAST_DIFFERENCES) r->noise = normal * quantile(n, p.scratch, 0.5) / sqrt(6);
  if (r->noise_said > 0) {
    for (int i = 0; i < p.n; ++i) {
      verify_row *row = &r->rows[p.row[i] - r->rows];
      int m;
      const double average = local_average(&p, i, &m);
      const bool alone = row->error <= r->gate + deviations * r->noise_said,
                 together = fabs(average) <= r->gate + deviations * r->noise_said / sqrt(m);
      if (row->verdict != VERDICT_DIFFERS || !alone || !together) continue;
      row->verdict = row->stable < 0 ? VERDICT_UNSTABLE : VERDICT_MATCH;
    }
  }
  workspace_free(&p.memory);
  return HC_OK;
}

static bool differs(const verify_report *r, int i)
{
  return i >= 0 && i < r->n_rows && !r->rows[i].skipped && r->rows[i].verdict == VERDICT_DIFFERS;
}

verify_causes points_outliers(const verify_report *r)
{
  const double limit = fmax(far, gates * r->gate) + 2 * deviations * r->noise_said;
  int outliers = 0, judged = 0;
  for (int i = 0; i < r->n_rows; ++i) {
    if (r->rows[i].skipped) continue;
    if (r->rows[i].verdict == VERDICT_SOLVER_FAILED) return 0;
    ++judged;
    if (!differs(r, i)) continue;
    if (!(r->rows[i].error > limit) || differs(r, i - 1) || differs(r, i + 1)) return 0;
    ++outliers;
  }
  return judged >= LEAST_POINTS && outliers > 0 && outliers <= judged / 10 ? VERIFY_BIT(CAUSE_OUTLIER) : 0;
}

/* Noise is as large as the offsets themselves, around zero, everywhere, and without outliers: of normal noise the
 * quarter, half and nine tenths of the moduli are below 0.32, 0.67 and 1.64 standard deviations. A mistake in the
 * equations leaves the points without contact where they belong. */
static bool is_noise(const verify_report *r, const neighbours *p)
{
  const double sigma = r->noise;
  if (!(sigma > 0 && sigma <= loudest)) return false;
  double sum = 0;
  for (int i = 0; i < p->n; ++i) sum += p->offset[i], p->scratch[i] = fabs(p->offset[i]);
  const double quarter = quantile(p->n, p->scratch, 0.25), half = quantile(p->n, p->scratch, 0.5),
               most = quantile(p->n, p->scratch, 0.9);
  return quarter >= 0.1 * sigma && half <= sigma && most <= 2.5 * sigma &&
         fabs(sum / p->n) <= deviations * sigma / sqrt(p->n);
}

hc_status points_scatter(const verify_report *r, verify_causes *out)
{
  neighbours p = {0};
  *out = 0;
  if (isnan(r->noise)) return HC_OK;
  hc_status st = neighbours_of(r, &p);
  if (st != HC_OK) return st;
  if (is_noise(r, &p)) *out = VERIFY_BIT(CAUSE_NOISE);
  workspace_free(&p.memory);
  return HC_OK;
}

/* ---- points that were not computed, or whose computation ended early ---- */

verify_causes points_interpolated(const verify_report *r)
{
  const double on_chord = 2e-6, least_bend = 0.1; /* [1] digits of a file; of the gate */
  int chords = 0, off = 0, beside = 0;
  bool last = false;
  for (int i = 0; i < r->n_rows; ++i) {
    const verify_row *row = &r->rows[i];
    if (!verify_row_differs(row)) {
      last = false;
      continue;
    }
    ++off;
    bool chord = false;
    for (int k = i > 0 ? i - 1 : 0; k <= i && i + 1 < r->n_rows; ++k) { /* between its neighbours, or behind a chord */
      const verify_row *a = &r->rows[k > 0 ? k - 1 : 0], *b = &r->rows[k], *c = &r->rows[k + 1];
      if (k != i || !((b->omega - a->omega) * (c->omega - b->omega) > 0) || a->branch < 0 || c->branch < 0) continue;
      const double part = (b->omega - a->omega) / (c->omega - a->omega);
      const double of_chord = a->value + part * (c->value - a->value),
                   of_truth = a->nearest + part * (c->nearest - a->nearest);
      chord = a->value != c->value && fabs(b->value - of_chord) <= on_chord * fabs(b->value) &&
              fabs(b->nearest - of_truth) > least_bend * r->gate * b->scale;
    }
    chords += chord;
    beside += !chord && last; /* a knot's neighbour */
    last = chord;
  }
  return chords >= 3 && 2 * chords >= off - beside ? VERIFY_BIT(CAUSE_INTERPOLATED) : 0;
}

/* Where a computation ended early, points are anywhere, one by one: alone or in twos and threes between right ones, by
 * more than an outlier's offset. */
verify_causes points_scattered(const verify_report *r)
{
  const double limit = fmax(far, gates * r->gate) + 2 * deviations * r->noise_said;
  int off = 0, large = 0, runs = 0, right = 0;
  for (int i = 0; i < r->n_rows; ++i) {
    if (r->rows[i].skipped) continue;
    right += r->rows[i].verdict == VERDICT_MATCH || r->rows[i].verdict == VERDICT_UNSTABLE;
    if (!differs(r, i)) continue;
    ++off;
    runs += !differs(r, i - 1);
    large += r->rows[i].error > limit;
  }
  const bool alone = 3 * runs >= 2 * off && runs >= 3;
  return off >= 3 && alone && one_value_each(r) && right >= off && 10 * large >= 8 * off
             ? VERIFY_BIT(CAUSE_NOT_CONVERGED)
             : 0;
}

/* Standard deviation of the logarithm from one point of the file to the next, of the values or of the truth. */
static double roughness(const verify_report *r, bool of_truth, double *room)
{
  int n = 0;
  double last[3] = {0};
  for (int i = 0; i < r->n_rows; ++i) {
    const verify_row *row = &r->rows[i];
    last[0] = last[1], last[1] = last[2], last[2] = log(fabs(of_truth ? row->nearest : row->value));
    const double bend = fabs(last[0] - 2 * last[1] + last[2]);
    if (i > 1 && isfinite(bend)) room[n++] = bend;
  }
  return n < LEAST_DIFFERENCES ? 0 : normal * quantile(n, room, 0.5) / sqrt(6);
}

hc_status points_anywhere(const verify_report *r, verify_causes *out)
{
  const double rough = 0.15, rougher = 5; /* no measured curve scatters so; times the truth's */
  neighbours p;
  *out = 0;
  if (!one_value_each(r)) return HC_OK;
  hc_status st = neighbours_of(r, &p);
  if (st != HC_OK) return st;
  const double theirs = roughness(r, false, p.scratch);
  if (r->n_rows >= LEAST_POINTS && theirs > rough && theirs > rougher * roughness(r, true, p.scratch))
    *out = VERIFY_BIT(CAUSE_NOT_CONVERGED);
  workspace_free(&p.memory);
  return HC_OK;
}

void points_say(message *m, const verify_report *r)
{
  int said = 0;
  if (verify_has(r->causes | r->nearest_guess, CAUSE_NOISE))
    message_add(m, " (by %.2g %% from one to the next)", 100 * r->noise);
  if (!verify_has(r->causes, CAUSE_OUTLIER) && !verify_has(r->causes, CAUSE_NOT_CONVERGED)) return;
  for (int i = 0; i < r->n_rows; ++i) {
    if (!differs(r, i)) continue;
    if (said++ < MOST_LINES)
      message_add(m, "%sline %ld: %.2g %% off", said == 1 ? " (" : ", ", r->rows[i].line, 100 * r->rows[i].error);
  }
  message_add(m, said > MOST_LINES ? ", ...)" : ")");
}
