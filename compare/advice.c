/* advice.c - a budget in words: its sum, its largest part, and the setting that makes that part smaller. */
#include <math.h>
#include <stdio.h>

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

/* Harmonics that would bring a truncation error e, falling like H^-3, to the gate. */
static int enough_harmonics(int n_harm, double e, double gate)
{
  double wanted = ceil(n_harm * cbrt(e / gate) - 1e-9);
  return wanted < HBM_MAX_HARMONICS ? (int)wanted : HBM_MAX_HARMONICS;
}

static void put_remedy(int part, double size, const compare_setup *setup, double goal, int n_harm, char text[64])
{
  switch (part) {
  case ALIASING: snprintf(text, 64, "use hbm.force: exact"); return;
  case TRUNCATION:
    if (!setup->hbm.keep_mean) snprintf(text, 64, "use hbm.static: true");
    else snprintf(text, 64, "use hbm.harmonics >= %d", enough_harmonics(n_harm, size, goal));
    return;
  case REGULARISATION: snprintf(text, 64, "use transient.law: exact"); return;
  default: snprintf(text, 64, "use transient.tolerance <= %.0e", 0.1 * setup->transient.tolerance);
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
    snprintf(text, BUDGET_TEXT, "%.2g %%: %s (%.0f %%); %s", 100 * b->amplitude.sum, name, 100 * share, remedy);
  }
  return text;
}
