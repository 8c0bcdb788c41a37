/* solutions.c - see solutions.h. */
#include "compare/verify/solutions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/first_guess.h"

static const double close_omegas = 0.1; /* [1] a step that Newton may take in one go */

compare_setup verify_settings(const compare_setup *setup, const verify_equations *e)
{
  compare_setup own = *setup;
  own.hbm.harmonics = e->harmonics;
  own.hbm.keep_mean = e->keep_mean;
  own.hbm.force = e->samples ? HBM_FORCE_SAMPLED : HBM_FORCE_EXACT;
  own.hbm.samples = e->samples ? e->samples : 1024;
  own.hbm.restart = e->restart;
  own.hbm.continuation = HBM_CONTINUATION_AUTO;
  own.hbm.mistakes = (hbm_mistakes){.odd_only = e->odd_only};
  return own;
}

/* Equations ready to be solved. */
typedef struct problem {
  hbm_solver *hbm;
  double offset; /* [length] their displacement is the solver's plus this */
} problem;

static hc_status problem_new(const compare_setup *setup, const verify_equations *e, problem *out)
{
  compare_setup own = verify_settings(setup, e);
  model *theirs;
  *out = (problem){0};
  hc_status st = verify_changed_model(setup->model, e->change, e->factor, e->keep_mean && !e->odd_only, &theirs,
                                      &out->offset, &own.hbm.mistakes.mean_error);
  if (st != HC_OK) return st;
  if (own.hbm.mistakes.mean_error != 0) own.hbm.skip_linear = false;
  st = guided_hbm_solver_new(theirs, &own.hbm, &out->hbm);
  model_free(theirs);
  return st;
}

static const struct {
  verify_quantity quantity;
  int cause;
} readings[VERIFY_READINGS] = {
    {{.kind = KIND_AMPLITUDE}, 0}, /* in the place of what the file says */
    {{.kind = KIND_AMPLITUDE}, CAUSE_QUANTITY},
    {{.kind = KIND_HARMONIC, .harmonic = 1}, CAUSE_QUANTITY},
    {{.kind = KIND_PEAK}, CAUSE_QUANTITY},
    {{.kind = KIND_MAX}, CAUSE_QUANTITY},
    {{.kind = KIND_RMS}, CAUSE_RMS},
    {{.kind = KIND_RMS_ALTERNATING}, CAUSE_RMS_ALTERNATING},
    {{.kind = KIND_RMS_NLVIB}, CAUSE_RMS_NLVIB},
    {{.kind = KIND_NORM}, CAUSE_NORM},
    {{.kind = KIND_NORM_ALTERNATING}, CAUSE_NORM},
    {{.kind = KIND_SUM_OF_MODULI}, CAUSE_SUM},
    {{.kind = KIND_SUM_WITH_MEAN}, CAUSE_SUM},
    {{.kind = KIND_PEAK_OF_HARMONIC}, CAUSE_QUANTITY},
    {{.kind = KIND_COSINE}, CAUSE_COSINE},
    {{.kind = KIND_SINE}, CAUSE_SINE},
    {{.kind = KIND_VELOCITY}, CAUSE_VELOCITY},
    {{.kind = KIND_ACCELERATION}, CAUSE_ACCELERATION},
    {{.kind = KIND_VELOCITY_HARMONIC, .harmonic = 1}, CAUSE_VELOCITY}, /* or of the harmonic that the file says */
    {{.kind = KIND_ACCELERATION_HARMONIC, .harmonic = 1}, CAUSE_ACCELERATION},
};

bool verify_reading(int i, const verify_quantity *asked, verify_quantity *out, verify_causes *causes)
{
  *out = i == 0 ? *asked : readings[i].quantity;
  if (i > 0 && asked->harmonic > 1 && out->kind > KIND_HARMONIC) out->harmonic = out->harmonic ? asked->harmonic : 0;
  *causes = i == 0 ? 0 : VERIFY_BIT(readings[i].cause);
  return i == 0 || out->kind != asked->kind || out->harmonic != asked->harmonic;
}

/* Of x' and x'': costly, and most readings are one of them or measured by one. */
typedef struct amplitudes {
  double velocity, acceleration;
} amplitudes;

static verify_solution read_all_of(const verify_quantity *asked, const verify_motion *motion, const amplitudes *a)
{
  verify_solution s;
  for (int i = 0; i < VERIFY_READINGS; ++i) {
    verify_quantity q;
    verify_causes ignored;
    verify_reading(i, asked, &q, &ignored);
    const bool of_velocity = q.kind == KIND_VELOCITY, of_acceleration = q.kind == KIND_ACCELERATION;
    s.q[i] = of_velocity ? a->velocity : of_acceleration ? a->acceleration : verify_quantity_of(&q, motion);
    s.scale[i] = of_velocity || q.kind == KIND_VELOCITY_HARMONIC           ? a->velocity
                 : of_acceleration || q.kind == KIND_ACCELERATION_HARMONIC ? a->acceleration
                                                                           : verify_quantity_scale(&q, motion);
  }
  return s;
}

/* Every reading of the motion X + offset of those measures. X is as it was when it returns. */
static verify_solution read_all(const verify_quantity *asked, double omega, const hbm_measures *m, double offset,
                                int n_harm, double *X)
{
  const verify_quantity velocity = {.kind = KIND_VELOCITY}, acceleration = {.kind = KIND_ACCELERATION};
  const double mean = X[0];
  const verify_motion motion = {
      .omega = omega, .max = m->max + offset, .min = m->min + offset, .n_harm = n_harm, .X = X};
  X[0] = mean + offset;
  const amplitudes a = {verify_quantity_of(&velocity, &motion), verify_quantity_of(&acceleration, &motion)};
  const verify_solution s = read_all_of(asked, &motion, &a);
  X[0] = mean;
  return s;
}

static hc_status reserve(verify_solutions *s)
{
  if (s->count < s->cap) return HC_OK;
  int cap = s->cap ? 2 * s->cap : 64;
  verify_solution *of = realloc(s->of, (size_t)cap * sizeof *of);
  if (of) s->of = of;
  double *X = realloc(s->X, (size_t)cap * (size_t)s->n_coef * sizeof *X);
  if (X) s->X = X;
  if (!of || !X) return HC_NO_MEMORY;
  s->cap = cap;
  return HC_OK;
}

static bool same_solution(const verify_solutions *s, int k, const double *X, double amplitude)
{
  const double *other = s->X + (size_t)k * s->n_coef;
  double most = 0;
  for (int i = 0; i < s->n_coef; ++i) most = fmax(most, fabs(X[i] - other[i]));
  return most <= 1e-8 * amplitude;
}

/* X, measured, among the solutions at the omega that began with number `from`; not twice. */
static hc_status add(verify_solutions *s, const problem *p, double omega, int from, const double *X)
{
  hbm_measures m;
  if (hbm_measure(p->hbm, X, &m) != HC_OK) return HC_OK;
  for (int k = from; k < s->count; ++k)
    if (same_solution(s, k, X, m.amplitude)) return HC_OK;
  hc_status st = reserve(s);
  if (st != HC_OK) return st;
  double *kept = s->X + (size_t)s->count * s->n_coef;
  memcpy(kept, X, (size_t)s->n_coef * sizeof *X);
  s->of[s->count] = read_all(&s->asked, omega, &m, p->offset, s->n_coef / 2, kept);
  ++s->count;
  return HC_OK;
}

static hc_status start(verify_solutions *s, const verify_quantity *asked, int n, int n_coef)
{
  *s = (verify_solutions){.asked = *asked, .n = n, .n_coef = n_coef, .first = calloc((size_t)n + 1, sizeof *s->first)};
  return s->first ? HC_OK : HC_NO_MEMORY;
}

hc_status verify_solutions_of(const compare_setup *setup, const verify_equations *e, const verify_quantity *asked,
                              double from, double to, int n, const double *omega, const hc_monitor *monitor,
                              verify_solutions *out)
{
  problem p = {0};
  hbm_curve curve = {0};
  hc_status st = start(out, asked, n, 2 * e->harmonics + 1);
  if (st == HC_OK) st = problem_new(setup, e, &p);
  if (st == HC_OK) st = hbm_trace(p.hbm, from, to, monitor, &curve);
  if (st != HC_INTERRUPTED && st != HC_NO_MEMORY && p.hbm) st = HC_OK; /* as far as it came */
  for (int i = 0; i < n && st == HC_OK; ++i) {
    hbm_curve at = {0};
    if (hbm_curve_at(p.hbm, &curve, omega[i], &at) == HC_NO_MEMORY) st = HC_NO_MEMORY;
    for (int k = 0; k < at.n && st == HC_OK; ++k)
      st = add(out, &p, omega[i], out->first[i], at.X + (size_t)k * at.n_coef);
    out->first[i + 1] = out->count;
    hbm_curve_free(&at);
    if (!hc_monitor_tick(monitor, -1)) st = HC_INTERRUPTED;
  }
  hbm_curve_free(&curve);
  hbm_solver_free(p.hbm);
  return st;
}

/* From guess number k of *from, X[n_coef] being room for it. */
static hc_status solve_from(verify_solutions *s, const problem *p, int i, double omega, const verify_solutions *from,
                            int k, double *X)
{
  hbm_point point;
  if (s->count - s->first[i] >= VERIFY_MOST_SOLUTIONS) return HC_OK;
  memcpy(X, from->X + (size_t)k * from->n_coef, (size_t)s->n_coef * sizeof *X);
  hc_status st = hbm_solve(p->hbm, omega, X, &point);
  if (st == HC_OK) return add(s, p, omega, s->first[i], X);
  return st == HC_NO_MEMORY ? st : HC_OK;
}

hc_status verify_solutions_near(const compare_setup *setup, const verify_equations *e, const verify_solutions *near,
                                const double *omega, verify_solutions *out)
{
  problem p = {0};
  double *X = malloc((size_t)near->n_coef * sizeof *X);
  hc_status st = start(out, &near->asked, near->n, near->n_coef);
  if (!X) st = HC_NO_MEMORY;
  if (st == HC_OK) st = problem_new(setup, e, &p);
  for (int i = 0; i < near->n && st == HC_OK; ++i) {
    bool close = i > 0 && omega[i] - omega[i - 1] <= close_omegas * omega[i];
    for (int k = near->first[i]; k < near->first[i + 1] && st == HC_OK; ++k)
      st = solve_from(out, &p, i, omega[i], near, k, X);
    for (int k = close ? out->first[i - 1] : 0; close && k < out->first[i] && st == HC_OK; ++k)
      st = solve_from(out, &p, i, omega[i], out, k, X);
    out->first[i + 1] = out->count;
  }
  free(X);
  hbm_solver_free(p.hbm);
  return st;
}

void verify_solutions_clear(verify_solutions *s)
{
  free(s->first);
  free(s->of);
  free(s->X);
  *s = (verify_solutions){0};
}
