/* advice.c - see advice.h; and a budget in words: its sum, its largest part, and the setting that makes that part
 * smaller. */
#include "compare/advice.h"

#include <math.h>
#include <stdio.h>

#include "base/message.h"
#include "compare/budget.h"

static const char *const names[BUDGET_N_PARTS] = {
#define NAME(part) #part,
    BUDGET_PARTS(NAME)
#undef NAME
};
enum { ALIASING, TRUNCATION, REGULARISATION, INTEGRATION, SETTLING };

static int largest(const error_budget *b, double *size)
{
  const double parts[BUDGET_N_PARTS] = {
#define VALUE(part) b->amplitude.part,
      BUDGET_PARTS(VALUE)
#undef VALUE
  };
  int top = -1;
  *size = 0;
  for (int i = 0; i < BUDGET_N_PARTS; ++i)
    if (parts[i] > *size) *size = parts[i], top = i;
  return top;
}

const char *budget_largest(const error_budget *b, double *share)
{
  double size = 0;
  int top = b->known ? largest(b, &size) : -1;
  *share = top < 0 ? NAN : isinf(size) ? 1 : size / b->amplitude.sum;
  return top < 0 ? NULL : names[top];
}

/* ---- settings that make a part of the budget smaller ---- */

/* Harmonics that would bring a truncation error e, falling like H^-3, to the goal: more than there are. */
static int enough_harmonics(int n_harm, double e, double goal)
{
  double wanted = fmax(ceil(n_harm * cbrt(e / goal) - 1e-9), n_harm + 1);
  return wanted < HBM_MAX_HARMONICS ? (int)wanted : HBM_MAX_HARMONICS;
}

static void against_truncation(double size, const hbm_settings *how, double goal, int n_harm, char text[64])
{
  if (!how->keep_mean) snprintf(text, 64, "use hbm.static: true");
  else if (n_harm >= HBM_MAX_HARMONICS) snprintf(text, 64, "%d harmonics are the most", HBM_MAX_HARMONICS);
  else if (how->harmonics != HBM_AUTO)
    snprintf(text, 64, "use hbm.harmonics >= %d", enough_harmonics(n_harm, size, goal));
  else if (how->accuracy > HBM_LEAST_ACCURACY)
    snprintf(text, 64, "use hbm.accuracy <= %.0e", fmax(0.1 * how->accuracy, HBM_LEAST_ACCURACY));
}

/* "" where nothing is left to change. */
static void put_remedy(int part, double size, const compare_setup *setup, double goal, int n_harm, char text[64])
{
  const transient_settings *tr = &setup->transient;
  text[0] = 0;
  switch (part) {
  case ALIASING:
    if (setup->hbm.force != HBM_FORCE_EXACT) snprintf(text, 64, "use hbm.force: exact");
    return;
  case TRUNCATION: against_truncation(size, &setup->hbm, goal, n_harm, text); return;
  case REGULARISATION:
    if (tr->law != TRANSIENT_LAW_EXACT) snprintf(text, 64, "use transient.law: exact");
    return;
  default:
    if (tr->tolerance > TRANSIENT_LEAST_TOLERANCE)
      snprintf(text, 64, "use transient.tolerance <= %.0e", fmax(0.1 * tr->tolerance, TRANSIENT_LEAST_TOLERANCE));
  }
}

const char *budget_advice(const error_budget *b, const compare_setup *setup, double goal, int n_harm,
                          char text[BUDGET_TEXT])
{
  double size = 0, share;
  char remedy[64];
  const char *name = budget_largest(b, &share);
  if (!b->known) snprintf(text, BUDGET_TEXT, "no orbit to account for");
  else if (!name) snprintf(text, BUDGET_TEXT, "0 %%");
  else if (b->amplitude.sum <= goal)
    snprintf(text, BUDGET_TEXT, "%.2g %%: %s (%.0f %%); within the gate", 100 * b->amplitude.sum, name, 100 * share);
  else {
    int part = largest(b, &size);
    put_remedy(part, size, setup, goal, n_harm, remedy);
    snprintf(text, BUDGET_TEXT, "%.2g %%: %s (%.0f %%)%s%s", 100 * b->amplitude.sum, name, 100 * share,
             *remedy ? "; " : "", remedy);
  }
  return text;
}

/* ---- settings that may mend a failure ---- */

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
    add_unless(&r, how->continuation == HBM_CONTINUATION_AUTO, "--set hbm.continuation=auto");
    add_unless(&r, exact, "--set hbm.force=exact");
    add_unless(&r, how->tolerance >= usual_tolerance, "--set hbm.tolerance=1e-10");
    add_unless(&r, false, "a sweep from the other end");
    break;
  case HC_TOO_MANY_POINTS:
    add_unless(&r, exact, "--set hbm.force=exact (too few samples make false turning points)");
    add_unless(&r, !fixed, "a longer --set hbm.step=...");
    add_unless(&r, false, "a narrower --set sweep.omega=...");
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
