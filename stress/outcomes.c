/* outcomes.c - see outcomes.h; and the names in stress.h. */
#include "stress/outcomes.h"

#include <math.h>

stress_check stress_skip(stress_reason why) { return (stress_check){STRESS_SKIPPED, why, HC_OK, NAN, NAN, 0}; }

stress_check stress_explain(stress_reason why, double error, double bound)
{
  return (stress_check){STRESS_EXPLAINED, why, HC_OK, error, bound, 0};
}

stress_check stress_find(stress_reason why, double error, double bound)
{
  return (stress_check){STRESS_FINDING, why, HC_OK, error, bound, 0};
}

stress_check stress_agree(double error, double bound)
{
  if (error <= bound) return (stress_check){STRESS_AGREED, STRESS_NO_REASON, HC_OK, error, bound, 0};
  return stress_find(isnan(error) ? STRESS_INTERNAL : STRESS_DISAGREES, error, bound);
}

stress_check stress_agree_within(double error, double least, double sensitive)
{
  if (error > least && error <= sensitive) return stress_explain(STRESS_ILL_CONDITIONED, error, sensitive);
  return stress_agree(error, fmax(least, sensitive));
}

stress_check stress_refusal(hc_status st)
{
  stress_check c = {STRESS_REFUSED, STRESS_REFUSED_BY, st, NAN, NAN, 0};
  if (st == HC_INTERRUPTED) c.outcome = STRESS_EXPLAINED, c.reason = STRESS_TOO_DEAR;
  /* none of these is an answer to a scene whose every field is within its range */
  if (st == HC_OK || st == HC_BUG || st == HC_BAD_INPUT || st == HC_UNSUPPORTED || st == HC_IO)
    c.outcome = STRESS_FINDING, c.reason = STRESS_INTERNAL;
  return c;
}

/* ---- names ---- */

#define NAME(code, name, meaning) name,
static const char *const kinds[] = {STRESS_CHECKS(NAME) STRESS_STRUCTURE_CHECKS(NAME) STRESS_SPACE_CHECKS(NAME)},
                         *const reasons[] = {STRESS_REASONS(NAME)};
#undef NAME
#define NAME(code, name) name,
static const char *const outcomes[] = {STRESS_OUTCOMES(NAME)};
#undef NAME
#define MEANING(code, name, meaning) meaning,
static const char *const kind_meanings[] = {STRESS_CHECKS(MEANING) STRESS_STRUCTURE_CHECKS(MEANING)
                                                STRESS_SPACE_CHECKS(MEANING)},
                         *const reason_meanings[] = {STRESS_REASONS(MEANING)};
#undef MEANING

const char *stress_kind_name(stress_kind kind) { return kinds[kind]; }
const char *stress_kind_meaning(stress_kind kind) { return kind_meanings[kind]; }
const char *stress_reason_name(stress_reason reason) { return reasons[reason]; }
const char *stress_reason_meaning(stress_reason reason) { return reason_meanings[reason]; }
const char *stress_outcome_name(stress_outcome outcome) { return outcomes[outcome]; }

const char *stress_family_option(stress_family family)
{
  static const char *const option[] = {"", " --structures", " --space"};
  return option[family];
}

int stress_first_check(stress_family family) { return family == STRESS_OSCILLATORS ? 0 : STRESS_N_OSCILLATOR_CHECKS; }

int stress_end_of_checks(stress_family family)
{
  static const int end[] = {STRESS_N_OSCILLATOR_CHECKS, STRESS_END_OF_STRUCTURE_CHECKS, STRESS_N_CHECKS};
  return end[family];
}
