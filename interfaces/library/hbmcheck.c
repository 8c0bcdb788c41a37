/* hbmcheck.c - see hbmcheck.h: the C API over the case reader, harmonic balance, time integration and the comparison.
 * It checks what a caller hands in, calls those, and copies what they found into the public structs: curve.c,
 * transient.c, comparison.c. Here: names, statuses, cases. No numerics. */
#include "interfaces/library/hbmcheck.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare/comparison.h"
#include "interfaces/library/inside.h"
#include "model/casefile/case_file.h"
#include "model/casefile/structure.h"
#include "numerics/base/number.h"

/* ---- enumerations: the public ones have the values of the inner ones, all of them ---- */

/* clang-format off */
#define STATUSES(X)                                                                                              \
  X(OK) X(BAD_INPUT) X(NO_MEMORY) X(IO) X(STALLED) X(NOT_CONVERGED) X(SINGULAR) X(NOT_FINITE) X(STEP_TOO_SMALL)  \
  X(TOO_MANY_POINTS) X(NOT_CLOSED) X(INTEGRATOR) X(CHATTER) X(NOT_SETTLED) X(APERIODIC) X(INTERRUPTED)           \
  X(UNSUPPORTED) X(BUG) X(JUMPED) X(UNBOUNDED) X(CREEPS)
#define VERDICTS(X)                                                                                              \
  X(MATCH) X(DIFFERS) X(OTHER_BRANCH) X(UNSTABLE) X(PERIOD_K) X(APERIODIC) X(NOT_SETTLED) X(SOLVER_FAILED)       \
  X(UNBOUNDED) X(CREEPS) X(UNDECIDED)
/* clang-format on */

#define ONE(...)           "." /* as many as the list is long: sizeof counts them */
#define SAME(ours, inner)  _Static_assert((int)(ours) == (int)(inner), "hbmcheck.h and " #inner " differ");
#define SAME_STATUS(name)  SAME(HBMCHECK_##name, HC_##name)
#define SAME_VERDICT(name) SAME(HBMCHECK_VERDICT_##name, VERDICT_##name)
STATUSES(SAME_STATUS)
VERDICTS(SAME_VERDICT)
SAME(sizeof(STATUSES(ONE)), sizeof(HC_STATUS_LIST(ONE)))
SAME(sizeof(VERDICTS(ONE)), sizeof(VERDICT_LIST(ONE)))
SAME(HBMCHECK_CONTACT_LINEAR, CONTACT_LINEAR)
SAME(HBMCHECK_CONTACT_STICK, CONTACT_STUCK)
SAME(HBMCHECK_CONTACT_SLIP, CONTACT_SLIPS)
SAME(HBMCHECK_CONTACT_SEPARATION, CONTACT_SEPARATES)
SAME(HBMCHECK_CONTACT_SMOOTH, CONTACT_BENDS)
SAME(HBMCHECK_SPECIAL_TURNING_POINT, HBM_TURNING_POINT)
SAME(HBMCHECK_SPECIAL_PERIOD_DOUBLING, HBM_PERIOD_DOUBLING)
SAME(HBMCHECK_SPECIAL_CONTACT_CHANGE, HBM_CONTACT_CHANGE)
SAME(HBMCHECK_SPECIAL_NEIMARK_SACKER, HBM_NEIMARK_SACKER)
SAME(HBMCHECK_SPECIAL_SYMMETRY_BREAKING, HBM_SYMMETRY_BREAKING)
SAME(HBMCHECK_MAX_OMEGAS, NUMBER_LIST_MAX)
SAME(HBMCHECK_MAX_HARMONICS, HBM_MAX_HARMONICS)

const char *hbmcheck_version(void) { return HBMCHECK_VERSION; }

const char *hbmcheck_status_text(hbmcheck_status status) { return hc_status_text((hc_status)status); }

const char *hbmcheck_contact_name(hbmcheck_contact what) { return contact_regime_name((contact_regime)what); }

const char *hbmcheck_verdict_name(hbmcheck_verdict v)
{
  return (int)v >= 0 && (int)v < VERDICT_COUNT ? verdict_name((verdict)v) : "unknown";
}

/* ---- what callers hand in ---- */

static bool tick(void *self, double done)
{
  const hbmcheck_monitor *m = self;
  return m->tick(m->self, done) != 0;
}

hc_monitor library_monitor(const hbmcheck_monitor *m) { return (hc_monitor){m && m->tick ? tick : NULL, (void *)m}; }

bool library_scene(const hbmcheck_case *c, int n, const double *omega, scene *out)
{
  if (n < 0 || n > HBMCHECK_MAX_OMEGAS || (n > 0 && !omega)) return false;
  *out = c->sc;
  if (n > 0) out->compare.omega.n = n;
  for (int i = 0; i < n; ++i) {
    if (!is_omega(omega[i])) return false;
    out->compare.omega.v[i] = omega[i];
  }
  return true;
}

hc_status library_setup(const hbmcheck_case *c, const scene *sc, compare_setup *out)
{
  hc_status st = scene_setup(sc, out);
  out->contacts = c->watch_contacts;
  out->multipliers = true;
  return st;
}

hbmcheck_contact_period library_period(const contact_period *p)
{
  return (hbmcheck_contact_period){.normal_min = p->normal_min,
                                   .normal_max = p->normal_max,
                                   .traction_max = p->traction_max,
                                   .slip_distance = p->slip_distance,
                                   .work = p->work,
                                   .regime = (hbmcheck_contact)p->regime};
}

void library_copy(int n, const double *from, int cap, double *to)
{
  if (cap > n) cap = n;
  if (cap > 0) memcpy(to, from, (size_t)cap * sizeof *to);
}

void library_say(char *words, size_t size, const char *text)
{
  if (words && size > 0) snprintf(words, size, "%s", text);
}

/* ---- a case ---- */

static bool are_strings(int n, const char *const *texts)
{
  if (n < 0 || (n > 0 && !texts)) return false;
  for (int i = 0; i < n; ++i)
    if (!texts[i]) return false;
  return true;
}

/* From text[length], or from the file `name` without text. */
static hbmcheck_status new_case(const char *name, const char *text, size_t length, int n_set, const char *const *set,
                                char *words, size_t size, hbmcheck_case **out)
{
  case_error err;
  hbmcheck_case *c = calloc(1, sizeof *c);
  library_say(words, size, hc_status_text(HC_NO_MEMORY));
  if (!c) return HBMCHECK_NO_MEMORY;
  hc_status st =
      text ? case_parse(name, text, length, n_set, set, &c->sc, &err) : case_read(name, n_set, set, &c->sc, &err);
  library_say(words, size, err.message);
  if (st == HC_OK) *out = c;
  else hbmcheck_case_free(c);
  return public_status(st);
}

hbmcheck_status hbmcheck_case_read(const char *path, int n_set, const char *const *set, char *words, size_t size,
                                   hbmcheck_case **out)
{
  if (out) *out = NULL;
  library_say(words, size, hc_status_text(HC_BAD_INPUT));
  if (!out || !path || !are_strings(n_set, set)) return HBMCHECK_BAD_INPUT;
  return new_case(path, NULL, 0, n_set, set, words, size, out);
}

hbmcheck_status hbmcheck_case_parse(const char *name, const char *text, size_t length, int n_set,
                                    const char *const *set, char *words, size_t size, hbmcheck_case **out)
{
  if (out) *out = NULL;
  library_say(words, size, hc_status_text(HC_BAD_INPUT));
  if (!out || !name || !text || !are_strings(n_set, set)) return HBMCHECK_BAD_INPUT;
  return new_case(name, text, length, n_set, set, words, size, out);
}

int hbmcheck_case_responses(const hbmcheck_case *c)
{
  if (!c) return 0;
  return structure_response_count(c->sc.structure);
}

hbmcheck_status hbmcheck_case_response_name(const hbmcheck_case *c, int r, char *text, size_t size)
{
  if (!text || size == 0 || r < 0 || r >= hbmcheck_case_responses(c)) return HBMCHECK_BAD_INPUT;
  structure_response_name(c->sc.structure, r, text, size);
  return HBMCHECK_OK;
}

int hbmcheck_case_contacts(const hbmcheck_case *c) { return c ? scene_contact_count(&c->sc) : 0; }

hbmcheck_status hbmcheck_case_contact_name(const hbmcheck_case *c, int j, char *text, size_t size)
{
  if (!text || size == 0 || j < 0 || j >= hbmcheck_case_contacts(c)) return HBMCHECK_BAD_INPUT;
  const char *name = scene_contact_at(&c->sc, j)->name;
  if (*name) library_say(text, size, name);
  else snprintf(text, size, "%d", j);
  return HBMCHECK_OK;
}

void hbmcheck_case_watch_contacts(hbmcheck_case *c, int on)
{
  if (c) c->watch_contacts = on != 0;
}

void hbmcheck_case_free(hbmcheck_case *c)
{
  if (c) case_clear(&c->sc);
  free(c);
}
