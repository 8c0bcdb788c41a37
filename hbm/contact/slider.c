/* slider.c - see slider.h. The first sample of an interval is a contact_step; how far the interval goes on is a
 * plain scan with the same arithmetic, in blocks without a branch, so that both give the same bits:
 *     separated   kn (v + gap) <= 0
 *     stick       |kt (u - w)| <= mu N, w constant
 *     slip(s)     s kt (u - w) > mu N, w = u - s mu N/kt of the sample before
 * All that the contact remembers is its state and, stuck, w. Where the second period has those that the first had at
 * the same sample the rest of it is the same, so it is not followed further: past the first separation or slip that
 * both have, as a rule. */
#include "hbm/contact/slider.h"

#include <string.h>

#include "numerics/wide_vectors.h"

enum { BLOCK = 16 }; /* samples looked at before asking whether one of them ends the interval */

/* One contact: its law and motion in one place, what the loops need. */
typedef struct followed {
  const contact *law;
  const slider_rule *rule;
  slider_motion m;
  double kt, kn, mu, gap; /* N = kn (v + gap) */
  double shift;           /* N - N0 = kn (v + shift) while in contact */
  double apart;           /* [force] of a separated contact */
} followed;

typedef struct slider {
  contact_state state; /* at the sample before */
  double w;
  slider_origin origin; /* of w */
} slider;

/* ---- does the interval go on, at one sample of along and across? ------------------------------- */

static inline bool touches(const followed *k, double across) { return k->kn * (k->m.s * across + k->gap) > 0; }

static inline bool goes_on_sticking(const followed *k, double w, double along, double across, double *f)
{
  double v = k->m.s * across, n = k->kn * (v + k->gap), t = k->kt * (k->m.c * along - w);
  *f = t * k->m.of_t + k->kn * (v + k->shift) * k->m.of_n;
  return (n > 0) & (fabs(t) <= k->mu * n);
}

static inline double slipped_to(const followed *k, double sign, double along, double across)
{
  return k->m.c * along - sign * (k->mu * (k->kn * (k->m.s * across + k->gap))) / k->kt;
}

static inline bool goes_on_slipping(const followed *k, double sign, double w, double along, double across, double *f)
{
  double v = k->m.s * across, n = k->kn * (v + k->gap), limit = k->mu * n;
  double t = k->kt * (k->m.c * along - w);
  *f = sign * limit * k->m.of_t + k->kn * (v + k->shift) * k->m.of_n;
  return (n > 0) & (sign * t > limit);
}

/* ---- to the end of the interval that has begun before sample i: where the next one begins, or n ---------- */

WIDE_VECTORS static int follow_separated(const followed *of, int n, double *restrict f, int i)
{
  const followed k = *of;
  const double *across = k.m.across;
  enum {
    LONG_BLOCK = 2 * BLOCK
  }; /* gcc unrolls a loop as short as this one up to 16 samples, and then uses no vectors */
  for (long ends = 0; i + LONG_BLOCK <= n; i += LONG_BLOCK) {
    for (int j = i; j < i + LONG_BLOCK; ++j) {
      f[j] = k.apart;
      ends |= touches(&k, across[j]) ? 1L : 0L;
    }
    if (ends) break;
  }
  for (; i < n && !touches(&k, across[i]); ++i) f[i] = k.apart;
  return i;
}

WIDE_VECTORS static int follow_stick(const followed *of, double w, int n, double *restrict f, int i)
{
  const followed k = *of;
  const double *along = k.m.along, *across = k.m.across;
  for (long ends = 0; i + BLOCK <= n; i += BLOCK) {
    for (int j = i; j < i + BLOCK; ++j) ends |= goes_on_sticking(&k, w, along[j], across[j], &f[j]) ? 0L : 1L;
    if (ends) break;
  }
  while (i < n && goes_on_sticking(&k, w, along[i], across[i], &f[i])) ++i;
  return i;
}

WIDE_VECTORS static int follow_slip(const followed *of, double sign, int n, double *restrict f, int i)
{
  const followed k = *of;
  const double *along = k.m.along, *across = k.m.across;
  for (long ends = 0; i + BLOCK <= n; i += BLOCK) {
    for (int j = i; j < i + BLOCK; ++j) {
      const double w = slipped_to(&k, sign, along[j - 1], across[j - 1]);
      ends |= goes_on_slipping(&k, sign, w, along[j], across[j], &f[j]) ? 0L : 1L;
    }
    if (ends) break;
  }
  while (i < n &&
         goes_on_slipping(&k, sign, slipped_to(&k, sign, along[i - 1], across[i - 1]), along[i], across[i], &f[i]))
    ++i;
  return i;
}

/* ---- interval by interval ---------------------------------------------------------------------- */

/* On entering contact at sample i after a separated one. Interpolated: w = u on the straight line between the samples
 * where v + gap = 0, else u of the last separated sample. Where u and v are one motion, that is -gap c/s, whatever the
 * samples. */
static void restart_slider(const followed *k, int n, int i, slider *t)
{
  const slider_motion *m = &k->m;
  const int before = i ? i - 1 : n - 1;
  const bool interpolated = k->rule->restart == HBM_RESTART_INTERPOLATED;
  if (k->rule->keeps) return;
  t->origin = (slider_origin){.i = before};
  if (k->rule->touch) {
    k->rule->touch(&t->w, &t->origin);
    return;
  }
  if (interpolated && m->along == m->across) {
    t->w = -k->gap * m->c / m->s;
    return;
  }
  const double g0 = m->s * m->across[before] + k->gap, g1 = m->s * m->across[i] + k->gap,
               part = interpolated ? -g0 / (g1 - g0) : 0, u0 = m->c * m->along[before], step = m->c * m->along[i] - u0;
  t->w = u0 + part * step;
  t->origin.by_along[0] = m->c * (1 - part);
  t->origin.by_along[1] = m->c * part;
  if (!interpolated) return;
  const double by_part = step / ((g1 - g0) * (g1 - g0)); /* d part = (g0 dg1 - g1 dg0)/(g1 - g0)^2 */
  t->origin.by_across[0] = -by_part * g1 * m->s;
  t->origin.by_across[1] = by_part * g0 * m->s;
}

/* From sample i, the first of an interval, to its end: where the next one begins. */
static int follow_interval(const followed *k, int n, double *f, int i, slider *t, sampled_interval *out)
{
  const slider_motion *m = &k->m;
  double u = m->c * m->along[i], v = m->s * m->across[i], traction;
  const double kept = t->w;
  if (t->state == CONTACT_SEPARATED && contact_normal(k->law, v) > 0) restart_slider(k, n, i, t);
  t->state = contact_step(k->law, u, v, &t->w, &traction);
  f[i] = traction * m->of_t + contact_normal_change(k->law, v) * m->of_n;
  const bool keep = k->rule->keeps && t->state == CONTACT_SEPARATED;
  if (keep) t->w = kept;
  *out = (sampled_interval){i, t->state, t->w, t->origin};
  if (t->state == CONTACT_STICK) return follow_stick(k, t->w, n, f, i + 1);
  const int slip = contact_slip_sign(t->state);
  const int next = slip ? follow_slip(k, slip, n, f, i + 1) : follow_separated(k, n, f, i + 1);
  const double along = m->along[next - 1], across = m->across[next - 1];
  if (slip) t->w = slipped_to(k, slip, along, across);
  else if (!keep) t->w = m->c * along;
  if (slip) t->origin = (slider_origin){next - 1, {m->c}, {-slip * k->mu * k->kn * m->s / k->kt}};
  return next;
}

/* The second, where it differs from the first, whose force is in f. `again` gets the second's force: blocks write past
 * the end of an interval. */
static int settle_again(const followed *k, int n, double *f, double *again, slider *t, const sampled_interval *first,
                        int n_first, sampled_interval *out)
{
  const slider end_of_first = *t;
  int count = 0, m = 0, i = 0; /* first[m] has the last sample followed */
  bool met = false;
  while (i < n && !met) {
    i = follow_interval(k, n, again, i, t, &out[count++]);
    while (m + 1 < n_first && first[m + 1].first < i) ++m;
    /* Do two sliders in these intervals, at a sample of both, have the same to come? Their origins may differ, but each
     * interval that sticks begins with a new one. */
    const sampled_interval *a = &out[count - 1];
    const bool remembers = a->state == CONTACT_STICK || (a->state == CONTACT_SEPARATED && k->rule->keeps);
    met = a->state == first[m].state && (!remembers || a->w == first[m].w);
  }
  memcpy(f, again, (size_t)i * sizeof *f);
  if (!met) return count;
  const int rest = n_first - m - 1;
  memcpy(out + count, first + m + 1, (size_t)rest * sizeof *out);
  *t = end_of_first;
  return count + rest;
}

slider_report slider_follow(const contact *law, const slider_rule *rule, int n, const slider_motion *m, double *f,
                            double *again, sampled_interval *intervals, sampled_interval *settling)
{
  followed k = {law, rule, *m, law->kt, law->kn, law->mu, law->gap, law->gap, 0};
  if (law->gap > 0) k.shift = 0;
  k.apart = 0 - contact_preload(law) * k.m.of_n;
  if (law->load > 0) k.kn = 1, k.gap = law->load, k.m.s = k.m.of_n = 0; /* N = load, whatever the motion */
  slider_report found;
  slider t = {.state = CONTACT_STICK, .w = rule->start};
  if (!(contact_normal(law, k.m.s * m->across[n - 1]) > 0)) t.state = CONTACT_SEPARATED;
  int n_first = 0;
  for (int i = 0; i < n;) i = follow_interval(&k, n, f, i, &t, &settling[n_first++]);
  contact_state before = t.state;
  found.settled = t.w;
  if (rule->once) {
    memcpy(intervals, settling, (size_t)n_first * sizeof *intervals);
    found.n_intervals = n_first;
    found.transitions = n_first - 1;
    found.w = t.w;
    return found;
  }
  found.n_intervals = settle_again(&k, n, f, again, &t, settling, n_first, intervals);
  found.transitions = found.n_intervals - 1 + (intervals[0].state != before);
  found.w = t.w;
  return found;
}
