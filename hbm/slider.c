/* slider.c - see slider.h. The first sample of a stretch is a contact_step; how far the stretch goes on is a plain scan
 * with the same arithmetic, in blocks without a branch, so that both give the same bits:
 *     separated   kn (v + gap) <= 0
 *     stick       |kt (u - w)| <= mu N, w constant
 *     slip(s)     s kt (u - w) > mu N, w = u - s mu N/kt of the sample before
 * All that the contact remembers is its state and, stuck, w. Where the second period has those that the first had at
 * the same sample the rest of it is the same, so it is not followed further: past the first separation or slip that
 * both have, as a rule. */
#include "hbm/slider.h"

#include <math.h>
#include <string.h>

enum { BLOCK = 16 }; /* samples looked at before asking whether one of them ends the stretch */

/* One contact: its law and direction in one place, what the loops need beside x. */
typedef struct followed {
  const contact *law;
  hbm_restart restart;
  double c, s; /* u = c x, v = s x */
  double kt, kn, mu, gap;
  double shift; /* N - N0 = kn (v + shift) while in contact */
  double apart; /* [force] of a separated contact */
} followed;

typedef struct slider {
  contact_state state; /* at the sample before */
  double w;
  slider_origin origin; /* of w */
} slider;

static followed followed_contact(const model_contact *m, hbm_restart restart)
{
  const contact *law = &m->law;
  followed k = {law, restart, m->tangent, m->normal, law->kt, law->kn, law->mu, law->gap, law->gap, 0};
  if (law->gap > 0) k.shift = 0;
  k.apart = 0 - contact_preload(law) * k.s;
  return k;
}

/* ---- does the stretch go on at x? ------------------------------------------------------------ */

static inline bool stays_apart(const followed *k, double x) { return !(k->kn * (k->s * x + k->gap) > 0); }

static inline bool goes_on_sticking(const followed *k, double w, double x, double *f)
{
  double v = k->s * x, n = k->kn * (v + k->gap), t = k->kt * (k->c * x - w);
  *f = t * k->c + k->kn * (v + k->shift) * k->s;
  return (n > 0) & (fabs(t) <= k->mu * n);
}

static inline double slipped_to(const followed *k, double sign, double x)
{
  return k->c * x - sign * (k->mu * (k->kn * (k->s * x + k->gap))) / k->kt;
}

static inline bool goes_on_slipping(const followed *k, double sign, double before, double x, double *f)
{
  double v = k->s * x, n = k->kn * (v + k->gap), limit = k->mu * n;
  double t = k->kt * (k->c * x - slipped_to(k, sign, before));
  *f = sign * limit * k->c + k->kn * (v + k->shift) * k->s;
  return (n > 0) & (sign * t > limit);
}

/* ---- to the end of the stretch that has begun before sample i: where the next one begins, or n ---------- */

static int follow_separated(const followed *of, int n, const double *restrict x, double *restrict f, int i)
{
  const followed k = *of;
  for (long ends = 0; i + BLOCK <= n; i += BLOCK) {
    for (int j = i; j < i + BLOCK; ++j) {
      f[j] = k.apart;
      ends |= stays_apart(&k, x[j]) ? 0L : 1L;
    }
    if (ends) break;
  }
  for (; i < n && stays_apart(&k, x[i]); ++i) f[i] = k.apart;
  return i;
}

static int follow_stick(const followed *of, double w, int n, const double *restrict x, double *restrict f, int i)
{
  const followed k = *of;
  for (long ends = 0; i + BLOCK <= n; i += BLOCK) {
    for (int j = i; j < i + BLOCK; ++j) ends |= goes_on_sticking(&k, w, x[j], &f[j]) ? 0L : 1L;
    if (ends) break;
  }
  while (i < n && goes_on_sticking(&k, w, x[i], &f[i])) ++i;
  return i;
}

static int follow_slip(const followed *of, double sign, int n, const double *restrict x, double *restrict f, int i)
{
  const followed k = *of;
  for (long ends = 0; i + BLOCK <= n; i += BLOCK) {
    for (int j = i; j < i + BLOCK; ++j) ends |= goes_on_slipping(&k, sign, x[j - 1], x[j], &f[j]) ? 0L : 1L;
    if (ends) break;
  }
  while (i < n && goes_on_slipping(&k, sign, x[i - 1], x[i], &f[i])) ++i;
  return i;
}

/* ---- stretch by stretch ---------------------------------------------------------------------- */

/* On entering contact at sample i after a separated one. Interpolated: w = u on the straight line between the
 * samples where v + gap = 0, which for u = c x and v = s x is -gap c/s, whatever the samples. Else w stays the last
 * separated sample's u, or, by mistake, is 0 or where it was before the separation. */
static void restart_slider(const followed *k, int n, const double *x, int i, slider *t)
{
  int before = i ? i - 1 : n - 1;
  bool interpolated = k->restart == HBM_RESTART_INTERPOLATED || k->restart == HBM_RESTART_ONE_PASS;
  if (k->restart == HBM_RESTART_KEPT) return;
  if (k->restart == HBM_RESTART_ZEROED) {
    t->w = 0;
    t->origin = (slider_origin){0};
    return;
  }
  t->w = interpolated ? -k->gap * k->c / k->s : k->c * x[before];
  t->origin = (slider_origin){before, interpolated ? 0 : k->c};
}

/* From sample i, the first of a stretch, to its end: where the next one begins. */
static int follow_stretch(const followed *k, int n, const double *x, double *f, int i, slider *t, stretch *out)
{
  double u = k->c * x[i], v = k->s * x[i], traction;
  const double kept = t->w;
  if (t->state == CONTACT_SEPARATED && contact_normal(k->law, v) > 0) restart_slider(k, n, x, i, t);
  t->state = contact_step(k->law, u, v, &t->w, &traction);
  f[i] = traction * k->c + contact_normal_change(k->law, v) * k->s;
  const bool keep = k->restart == HBM_RESTART_KEPT && t->state == CONTACT_SEPARATED;
  if (keep) t->w = kept;
  *out = (stretch){i, t->state, t->w, t->origin};
  if (t->state == CONTACT_STICK) return follow_stick(k, t->w, n, x, f, i + 1);
  const int slip = contact_slip_sign(t->state);
  const int next = slip ? follow_slip(k, slip, n, x, f, i + 1) : follow_separated(k, n, x, f, i + 1);
  if (slip) t->w = slipped_to(k, slip, x[next - 1]);
  else if (!keep) t->w = k->c * x[next - 1];
  if (slip) t->origin = (slider_origin){next - 1, k->c - slip * k->mu * k->kn * k->s / k->kt};
  return next;
}

/* Do two sliders in these stretches, at a sample of both, have the same to come? Their origins may differ, but each
 * stretch that sticks begins with a new one. */
static bool same_from_here(const followed *k, const stretch *a, const stretch *b)
{
  const bool remembers = a->state == CONTACT_STICK || (a->state == CONTACT_SEPARATED && k->restart == HBM_RESTART_KEPT);
  return a->state == b->state && (!remembers || a->w == b->w);
}

/* The first period; how many stretches. */
static int settle(const followed *k, int n, const double *x, double *f, slider *t, stretch *out)
{
  int count = 0;
  for (int i = 0; i < n;) i = follow_stretch(k, n, x, f, i, t, &out[count++]);
  return count;
}

/* The second, where it differs from the first, whose force is in f. `again` gets the second's force: blocks write past
 * the end of a stretch. */
static int settle_again(const followed *k, int n, const double *x, double *f, double *again, slider *t,
                        const stretch *first, int n_first, stretch *out)
{
  const slider end_of_first = *t;
  int count = 0, m = 0, i = 0; /* first[m] has the last sample followed */
  bool met = false;
  while (i < n && !met) {
    i = follow_stretch(k, n, x, again, i, t, &out[count++]);
    while (m + 1 < n_first && first[m + 1].first < i) ++m;
    met = same_from_here(k, &out[count - 1], &first[m]);
  }
  memcpy(f, again, (size_t)i * sizeof *f);
  if (!met) return count;
  const int rest = n_first - m - 1;
  memcpy(out + count, first + m + 1, (size_t)rest * sizeof *out);
  *t = end_of_first;
  return count + rest;
}

slider_report slider_follow(const model_contact *c, hbm_restart restart, int n, const double *x, double *f,
                            double *again, stretch *stretches, stretch *settling)
{
  const followed k = followed_contact(c, restart);
  slider_report found;
  slider t = {.state = CONTACT_STICK};
  if (!(contact_normal(&c->law, k.s * x[n - 1]) > 0)) t.state = CONTACT_SEPARATED;
  int n_first = settle(&k, n, x, f, &t, settling);
  contact_state before = t.state;
  found.settled = t.w;
  if (restart == HBM_RESTART_ONE_PASS || restart == HBM_RESTART_ONE_PASS_SAMPLE) {
    memcpy(stretches, settling, (size_t)n_first * sizeof *stretches);
    found.n_stretches = n_first;
    found.transitions = n_first - 1;
    found.w = t.w;
    return found;
  }
  found.n_stretches = settle_again(&k, n, x, f, again, &t, settling, n_first, stretches);
  found.transitions = found.n_stretches - 1 + (stretches[0].state != before);
  found.w = t.w;
  return found;
}
