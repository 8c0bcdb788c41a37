/* stability.c - see stability.h. */
#include "hbm/solver/stability.h"

#include <stdlib.h>
#include <string.h>

#include "hbm/solver/corrector.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "numerics/base/number.h"
#include "numerics/collocation.h"
#include "numerics/series.h"

/* A structure of more degrees of freedom is large. Large ones with planar friction are followed in their modes: up to
 * 24 planar contacts (two each in the list) a solution of the plates of cases/structures takes as long as 10 to 20
 * points of a curve, and the cube of that many times more beyond. */
enum { LARGE = 50, MOST_IN_MODES = 48 };

static bool in_modes(const model *m) { return m->n > LARGE && model_has_circle(m) && !model_is_smooth(m); }

/* Operations of one solution where planar friction or smooth laws are followed step by step (planar_flow.h): of each
 * step the factors and the right sides of all states, and a step a harmonic, more or less, since both go with what
 * moves fastest. 3e8 take some 40 ms (8 degrees of freedom with as many smooth contacts come to 7e6 with 5 harmonics
 * and take 2 ms, 24 to 2e8 and 24 ms), a curve of 100 points with its special points some seconds. */
static const double MOST_OPERATIONS_OF_STEPS = 3e8;

/* Friction by tanh turns over within epsilon/u' of a period, which may be a millionth of it: its steps are counted by
 * no harmonics, and of larger structures a solution takes seconds. */
enum { LARGE_WITH_TANH = 12 };

static bool turns_sharply(const model *m)
{
  bool any = false;
  for (int j = 0; j < m->n_contacts; ++j) any |= m->contacts[j].law.smooth == CONTACT_TANH;
  return any && m->n + m->n_contacts > LARGE_WITH_TANH;
}

static double operations_of_steps(const hbm_solver *s)
{
  const double states = 2 * s->model->n + s->model->n_contacts,
               unknowns = COLLOCATION_POINTS * (s->model->n + 0.5 * s->model->n_contacts * !model_is_smooth(s->model));
  return series_length(s->sys.n_harm) * (2.0 / 3 * unknowns + 2 * states) * unknowns * unknowns;
}

bool hbm_stability_is_costly(const hbm_solver *s)
{
  const model *m = s->model;
  if (in_modes(m)) return m->n_contacts > MOST_IN_MODES;
  const bool by_steps = model_has_circle(m) || model_is_smooth(m);
  return m->n > LARGE || turns_sharply(m) || (by_steps && operations_of_steps(s) > MOST_OPERATIONS_OF_STEPS);
}

const char *hbm_stability_limit(const hbm_solver *s)
{
  if (!hbm_stability_is_costly(s)) return NULL;
  if (turns_sharply(s->model)) return "friction by tanh and more than 12 degrees of freedom";
  return s->model->n > LARGE
             ? "more than 50 degrees of freedom"
             : "with so many states and harmonics, smooth laws or contacts with two tangents take 40 ms "
               "and more for each solution";
}

void hbm_leave_stability(hbm_solver *s)
{
  if (in_modes(s->model)) s->multipliers_unknown = true;
}

bool hbm_stability_is_unknown(const hbm_solver *s) { return s->multipliers_unknown; }

/* A hash of omega and X, so that what is asked for twice, by a curve's rows and for its special points, is found once:
 * Fowler, Noll and Vo's hash of 64 bits. */
static uint64_t fingerprint(const hbm_solver *s, double omega, const double *X)
{
  uint64_t hash = 14695981039346656037u;
  for (int i = -1; i < s->sys.n_coef; ++i) {
    unsigned char byte[sizeof(double)];
    memcpy(byte, i < 0 ? &omega : &X[i], sizeof byte);
    for (size_t k = 0; k < sizeof byte; ++k) hash = (hash ^ byte[k]) * 1099511628211u;
  }
  return hash | 1; /* 0: an empty place */
}

hc_status hbm_multipliers(hbm_solver *s, const contact_forces *orbit, double omega, const double *X, hbm_stability *out)
{
  *out = (hbm_stability){.multiplier = NAN,
                         .re = NAN,
                         .im = NAN,
                         .flip = NAN,
                         .fold = NAN,
                         .determinant = NAN,
                         .pair = NAN,
                         .low = NAN,
                         .high = NAN};
  const bool modal = in_modes(s->model);
  const uint64_t key = fingerprint(s, omega, X);
  if (!s->known_stability) s->known_stability = calloc(KNOWN_STABILITIES, sizeof *s->known_stability);
  if (!s->known_stability) return HC_NO_MEMORY;
  known_stability *known = &s->known_stability[key / 2 % KNOWN_STABILITIES];
  if (known->key == key) return *out = known->stability, HC_OK;
  hc_status st = HC_OK;
  if (!s->monodromy && !s->multipliers_unknown)
    st = monodromy_new(s->model, modal ? &multipliers_in_modes : &multipliers_by_intervals, &s->monodromy);
  if (modal && st == HC_BAD_INPUT) s->multipliers_unknown = true;
  if (!s->monodromy && s->multipliers_unknown) return HC_OK;
  if (st == HC_OK) st = monodromy_stability(s->monodromy, orbit, omega, out);
  s->multipliers_of = st == HC_OK ? key : 0;
  if (st == HC_OK) *known = (known_stability){key, *out};
  if (!modal || st != HC_NOT_CONVERGED) return st;
  s->multipliers_unknown = true;
  return HC_OK;
}

void hbm_keep_stability(hbm_solver *s, double omega, const double *X, const hbm_stability *st)
{
  const uint64_t key = fingerprint(s, omega, X);
  s->known_stability[key / 2 % KNOWN_STABILITIES] = (known_stability){key, *st};
}

static void take_moduli(const hbm_solver *s, double *moduli)
{
  const double complex *lambda;
  const int states = 2 * s->model->n + s->model->n_contacts, n = monodromy_multipliers(s->monodromy, &lambda);
  for (int i = 0; i < states; ++i) moduli[i] = i < n ? -cabs(lambda[i]) : 0;
  qsort(moduli, (size_t)states, sizeof *moduli, ascending);
  for (int i = 0; i < states; ++i) moduli[i] = -moduli[i];
}

hc_status hbm_moduli(hbm_solver *s, const contact_forces *orbit, double omega, hbm_stability *out, double *moduli)
{
  s->multipliers_of = 0;
  const hc_status st = monodromy_stability(s->monodromy, orbit, omega, out);
  if (st == HC_OK) take_moduli(s, moduli);
  return st;
}

hc_status hbm_moduli_of(hbm_solver *s, double omega, const double *X, double *moduli)
{
  const contact_forces *orbit;
  contact_report report;
  hbm_stability again;
  if (s->multipliers_of == fingerprint(s, omega, X)) return take_moduli(s, moduli), HC_OK;
  const hc_status st = hbm_located_orbit(s, X, &orbit, &report);
  return st == HC_OK ? hbm_moduli(s, orbit, omega, &again, moduli) : st;
}

hc_status hbm_stability_at(hbm_solver *s, double omega, const double *X, hbm_stability *out)
{
  const contact_forces *orbit;
  contact_report report;
  int det_sign;
  const bool regular = hbm_det_sign_at(s, omega, X, &det_sign) == HC_OK; /* first: it evaluates what the orbit is of */
  hc_status st = hbm_located_orbit(s, X, &orbit, &report);
  if (st == HC_OK) st = hbm_multipliers(s, orbit, omega, X, out);
  if (st != HC_OK) return st;
  out->agrees = regular && (det_sign > 0) == (out->fold > 0);
  return HC_OK;
}

int hbm_stability_verdict(const hbm_stability *st)
{
  const double rounding = 1e-9;
  if (!st->agrees) return 0;
  return st->high < 1 - rounding ? 1 : st->low > 1 + rounding ? -1 : 0; /* 0 of NaN */
}
