/* outcomes.c - the words a check ends with (solved_scene.h), and the names in stress.h. */
#include <math.h>

#include "stress/solved_scene.h"

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
  if (error > least && error <= sensitive)
    return sensitive <= STRESS_SAYS_SOMETHING ? stress_explain(STRESS_ILL_CONDITIONED, error, sensitive)
                                              : stress_skip(STRESS_ILL_CONDITIONED);
  return stress_agree(error, fmax(least, sensitive));
}

stress_check stress_refuse(solved_scene *s, hc_status st)
{
  stress_check c = {STRESS_REFUSED, STRESS_REFUSED_BY, st, NAN, NAN, 0};
  if (st == HC_NO_MEMORY) s->fatal = st;
  if (st == HC_INTERRUPTED) c.outcome = STRESS_DEAR, c.reason = STRESS_TOO_DEAR;
  /* none of these is an answer to a scene whose every field is within its range */
  if (st == HC_OK || st == HC_BUG || st == HC_BAD_INPUT || st == HC_UNSUPPORTED || st == HC_IO)
    c.outcome = STRESS_FINDING, c.reason = STRESS_INTERNAL;
  return c;
}

stress_check stress_worse(stress_check a, stress_check b)
{
  return b.outcome > a.outcome || (b.outcome == a.outcome && b.error > a.error) ? b : a;
}

/* ---- names ---- */

#define NAME(code, name, ...)                name,
#define MEANING(code, name, meaning)         meaning,
#define NAME_OF(code, name)                  name,
#define MEANING_OF(code, name, fun, meaning) meaning,
static const char *const kinds[] = {STRESS_CHECKS(NAME)}, *const reasons[] = {STRESS_REASONS(NAME)};
static const char *const outcomes[] = {STRESS_OUTCOMES(NAME_OF)};
static const char *const kind_meanings[] = {STRESS_CHECKS(MEANING_OF)}, *const reason_meanings[] = {
                                                                            STRESS_REASONS(MEANING)};

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
