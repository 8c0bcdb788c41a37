/* judge.c - which cause is named. The rule, of hypotheses ranked by distance times 3 per cause:
 *   fits     what the best leaves is within the gate or 1 %, whichever is larger, and within a fifth of how far the
 *            truth is off; if it has a factor that was fitted, within the gate, and a tenth: a free factor imitates
 *            much
 *   alone    no other set of causes, not larger, comes within a factor `rival` of that distance, or of a tenth of the
 *            gate if that is larger
 * One that fits alone is named; else it, and its rivals, are the nearest guess. Causes that are among the best's, and
 * those with more to them, are no rivals: they say nothing else. Nor are changes of the model that leave its contacts
 * apart, or stuck, where that is the best: they may be why. */
#include <math.h>

#include "compare/verify/search/search_impl.h"

static const double good = 0.01, much_better = 0.2, much_better_fitted = 0.1, rival = 3, guess_worth = 0.2;

bool verify_fits(const verify_report *r)
{
  const verify_hypothesis *h = &r->hypotheses[0];
  const double part = h->fitted ? much_better_fitted : much_better, left = h->fitted ? r->gate : fmax(r->gate, good);
  return r->n_hypotheses > 0 && h->distance <= left && h->distance < part * r->truth_distance;
}

/* Does it say what the contacts do, and the other what may be the reason? */
static bool explains(const verify_hypothesis *reason, const verify_hypothesis *what)
{
  const verify_change does = what->equations.change, because = reason->equations.change;
  return (does == CHANGE_NO_CONTACT || does == CHANGE_STUCK) && because > CHANGE_STUCK;
}

/* Distances up to this are as good as the best's. */
static double close_to(const verify_report *r, const verify_hypothesis *best)
{
  return rival * fmax(best->distance, r->gate / 10);
}

static bool is_rival(const verify_report *r, const verify_hypothesis *best, const verify_hypothesis *other)
{
  const verify_causes both = best->causes & other->causes;
  if (both == best->causes || both == other->causes || explains(other, best)) return false;
  if (verify_cause_count(other->causes) > verify_cause_count(best->causes)) return false;
  return other->distance <= close_to(r, best);
}

bool verify_rival(const verify_report *r, int i)
{
  if (i <= 0 || i >= r->n_hypotheses || i >= VERIFY_HYPOTHESES) return false;
  return is_rival(r, &r->hypotheses[0], &r->hypotheses[i]);
}

bool verify_reason(const verify_report *r, int i)
{
  const verify_hypothesis *best = &r->hypotheses[0], *h = &r->hypotheses[i];
  const bool likewise = verify_cause_count(h->causes) <= verify_cause_count(best->causes);
  return i > 0 && i < r->n_hypotheses && likewise && explains(h, best) && h->distance <= close_to(r, best);
}

void search_judge(verify_report *out)
{
  /* mu = 0 and kt = 0 are the same equations */
  const verify_causes no_traction = VERIFY_BIT(CAUSE_NO_FRICTION) | VERIFY_BIT(CAUSE_NO_KT);
  const verify_hypothesis *best = &out->hypotheses[0];
  verify_causes all = best->causes;
  bool alone = true;
  out->nearest_guess = 0;
  if (out->n_hypotheses == 0) return;
  for (int i = 1; i < out->n_hypotheses; ++i) {
    if (!verify_rival(out, i)) continue;
    const verify_causes other = out->hypotheses[i].causes;
    alone &= (best->causes ^ other) == no_traction;
    all |= other;
  }
  if (verify_fits(out) && alone) out->causes = all;
  else if (best->distance < guess_worth * out->truth_distance) out->nearest_guess = all;
}
