/* advice.c - see advice.h. */
#include "compare/advice.h"

#include "numerics/base/message.h"

enum { MOST_REMEDIES = 4 };

/* What to try, in this order. */
typedef struct remedies {
  int n;
  const char *words[MOST_REMEDIES];
} remedies;

/* `words`, unless the setting is so already. */
static void add_unless(remedies *r, bool so_already, const char *words)
{
  if (!so_already && r->n < MOST_REMEDIES) r->words[r->n++] = words;
}

/* "try one, two or three". */
static const char *write_remedies(const remedies *r, char text[ADVICE_TEXT])
{
  message m;
  message_start(&m, text, ADVICE_TEXT);
  for (int i = 0; i < r->n; ++i) message_add(&m, "%s%s", i == 0 ? "try " : i < r->n - 1 ? ", " : " or ", r->words[i]);
  return text;
}

const char *advice_for_hbm(const hbm_settings *how, hc_status failure, char text[ADVICE_TEXT])
{
  static const double usual_tolerance = 1e-10;
  const bool exact = how->force == HBM_FORCE_EXACT, fixed = how->continuation == HBM_CONTINUATION_FIXED_STEP;
  remedies r = {0};
  switch (failure) {
  case HC_STALLED:
  case HC_NOT_CONVERGED:
  case HC_SINGULAR:
  case HC_STEP_TOO_SMALL:
  case HC_JUMPED:
    add_unless(&r, how->continuation == HBM_CONTINUATION_AUTO, "--set hbm.continuation=auto");
    add_unless(&r, exact, "--set hbm.force=exact");
    add_unless(&r, how->tolerance >= usual_tolerance, "--set hbm.tolerance=1e-10");
    add_unless(&r, r.n > 0, "another number of --set hbm.harmonics=...");
    break;
  case HC_TOO_MANY_POINTS:
    add_unless(&r, exact, "--set hbm.force=exact (too few samples make false turning points)");
    add_unless(&r, !fixed, "a longer --set hbm.step=...");
    add_unless(&r, false, "a narrower --set sweep.omega=...");
    break;
  case HC_UNBOUNDED:
    add_unless(&r, false, "damping");
    add_unless(&r, false, "a load that friction takes (4 mu N/pi a slider)");
    break;
  case HC_NOT_CLOSED: add_unless(&r, false, exact ? "--set hbm.force=sampled" : "--set hbm.force=exact"); break;
  case HC_CHATTER: add_unless(&r, !exact, "--set hbm.force=sampled, which counts no transitions"); break;
  default: break;
  }
  return write_remedies(&r, text);
}

const char *advice_for_transient(const transient_settings *how, hc_status failure, char text[ADVICE_TEXT])
{
  const bool exact = how->law == TRANSIENT_LAW_EXACT, closed_form = how->method == TRANSIENT_METHOD_CLOSED_FORM;
  remedies r = {0};
  switch (failure) {
  case HC_STALLED:
  case HC_NOT_CONVERGED:
  case HC_SINGULAR:
    add_unless(&r, how->steady == TRANSIENT_STEADY_MARCH,
               "--set transient.steady_state=march, which needs no Newton iteration");
    break;
  case HC_CHATTER:
    add_unless(&r, !exact,
               closed_form ? "--set transient.law=regularised --set transient.method=cvode, which count no transitions"
                           : "--set transient.law=regularised, which counts no transitions");
    break;
  case HC_INTEGRATOR:
    add_unless(&r, exact || how->regularisation >= TRANSIENT_MOST_REGULARISATION,
               "a larger --set transient.regularisation=...");
    add_unless(&r, how->tolerance <= TRANSIENT_LEAST_TOLERANCE, "a tighter --set transient.tolerance=...");
    add_unless(&r, false, exact ? "--set transient.law=regularised" : "--set transient.law=exact");
    break;
  case HC_UNBOUNDED:
    add_unless(&r, false, "more damping");
    add_unless(&r, false, "another frequency, where the load meets no resonance");
    break;
  case HC_NOT_SETTLED:
    add_unless(&r, how->max_periods >= TRANSIENT_MOST_PERIODS, "a larger --set transient.max_periods=...");
    add_unless(&r, how->start == TRANSIENT_START_HBM, "--set transient.start=hbm");
    break;
  default: break;
  }
  return write_remedies(&r, text);
}

const char *advice_on_size(double damping)
{
  return damping > 0 ? "numbers became too large or too small: are units, force and frequency right?"
                     : "the motion grew without bound: oscillator.damping is 0";
}
