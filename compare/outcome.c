/* outcome.c - what a comparison came to, from its rows alone; see comparison.h. The verdict of a row: solution.c,
 * judge(). */
#include <math.h>
#include <stdio.h>

#include "compare/comparison.h"
#include "compare/motion.h"

static const struct {
  const char *name, *meaning;
} verdicts[] = {
#define VERDICT_WORDS(code, name, meaning) {name, meaning},
    VERDICT_LIST(VERDICT_WORDS)
#undef VERDICT_WORDS
};

const char *verdict_name(verdict v) { return verdicts[v].name; }

const char *verdict_meaning(verdict v) { return verdicts[v].meaning; }

const char *comparison_verdict_text(const comparison_row *row, char text[24])
{
  if (row->verdict == VERDICT_PERIOD_K) snprintf(text, 24, "period_%d", row->transient.period_multiple);
  else snprintf(text, 24, "%s", verdict_name(row->verdict));
  return text;
}

bool comparison_mean_free(const comparison_row *row)
{
  if (row->transient_status == HC_OK) return motion_mean_is_free(&row->transient);
  if (row->orbit_status == HC_OK) return motion_mean_is_free(&row->orbit);
  return row->hbm_status == HC_OK && row->hbm.contact.free_sliders > 0;
}

bool comparison_nonlinear(const comparison *c)
{
  for (int i = 0; i < c->n_rows; ++i) {
    const comparison_row *r = &c->rows[i];
    const bool moved =
        r->transient_status == HC_OK || r->transient_status == HC_NOT_SETTLED || r->transient_status == HC_APERIODIC;
    if (r->hbm_status == HC_OK && r->hbm.contact.regime > CONTACT_STUCK) return true;
    if (moved && r->transient.regime > CONTACT_STUCK) return true;
  }
  return false;
}

bool comparison_unaccounted(const comparison_row *row)
{
  bool known = row->transient_status == HC_OK || row->transient_status == HC_APERIODIC;
  return known && row->hbm_status == HC_OK && !row->accounted;
}

/* False where one of the three is NaN. */
static bool beyond(double observed, double hbm, double transient)
{
  return observed > COMPARISON_SLACK * (hbm + transient);
}

bool comparison_unexpected(const comparison_row *row)
{
  const discrepancy *h = &row->hbm_predicted, *t = &row->transient_predicted;
  const bool one_orbit = row->verdict == VERDICT_MATCH || row->verdict == VERDICT_DIFFERS;
  return one_orbit && !row->family && row->transient.period_multiple == 1 &&
         (beyond(row->errors.amplitude, h->amplitude, t->amplitude) ||
          beyond(row->errors.waveform, h->waveform, t->waveform));
}

const char *comparison_unexpected_text(const comparison_row *row, char text[COMPARISON_UNEXPECTED_TEXT])
{
  const discrepancy *h = &row->hbm_predicted, *t = &row->transient_predicted, *e = &row->errors;
  const bool amplitude = beyond(e->amplitude, h->amplitude, t->amplitude);
  snprintf(text, COMPARISON_UNEXPECTED_TEXT,
           "observed %s error %.2g is above what both predicted (HBM %.2g, transient %.2g): something is wrong that "
           "neither expected",
           amplitude ? "amplitude" : "waveform", amplitude ? e->amplitude : e->waveform,
           amplitude ? h->amplitude : h->waveform, amplitude ? t->amplitude : t->waveform);
  return text;
}

int comparison_exit_code(const comparison *c)
{
  for (int i = 0; i < c->n_rows; ++i)
    if (comparison_unaccounted(&c->rows[i])) return 1;
  if (c->curve.end != HC_OK) return 3; /* what lies beyond was not compared, and the curve might have come back */
  if (c->count[VERDICT_SOLVER_FAILED] > 0 || c->count[VERDICT_NOT_SETTLED] > 0 || c->count[VERDICT_MATCH] == 0)
    return 3;
  return 0;
}
