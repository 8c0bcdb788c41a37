/* solutions.c - see solutions.h. */
#include "compare/verify/truth/solutions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/growing.h"
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

hc_status verify_motion_of_solution(hbm_solver *hbm, double omega, const double *X, int response, double *series,
                                    hbm_measures *m, verify_motion *out)
{
  hc_status st = hbm_measure_response(hbm, omega, X, response, m);
  if (st == HC_OK) st = hbm_response(hbm, omega, X, response, series);
  *out = (verify_motion){.omega = omega, .max = m->max, .min = m->min, .n_harm = hbm_n_harmonics(hbm), .X = series};
  return st;
}

/* Equations ready to be solved. */
typedef struct problem {
  hbm_solver *hbm;
  double offset;                            /* [length] their response is the solver's plus this */
  double series[2 * HBM_MAX_HARMONICS + 1]; /* of a response */
} problem;

static hc_status problem_new(const compare_setup *setup, const verify_equations *e, problem *out)
{
  compare_setup own = verify_settings(setup, e);
  model *theirs;
  *out = (problem){0};
  const verify_changed how = {e->change, e->factor, e->which};
  hc_status st = verify_changed_model(setup->model, &how, e->keep_mean && !e->odd_only, &theirs, &out->offset,
                                      &own.hbm.mistakes.mean_error);
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

/* Every reading of the motion, whose series is the problem's, plus the problem's offset. */
static verify_solution read_all(const verify_quantity *asked, problem *p, verify_motion motion)
{
  verify_solution s;
  p->series[0] += p->offset;
  motion.max += p->offset;
  motion.min += p->offset;
  verify_motion_find_rates(&motion);
  for (int i = 0; i < VERIFY_READINGS; ++i) {
    verify_quantity q;
    verify_causes ignored;
    verify_reading(i, asked, &q, &ignored);
    s.q[i] = verify_quantity_of(&q, &motion);
    s.scale[i] = verify_quantity_scale(&q, &motion);
  }
  return s;
}

static bool same_solution(const verify_solutions *s, int k, const double *X, double amplitude)
{
  const double *other = s->X + (size_t)k * s->n_coef;
  double most = 0;
  for (int i = 0; i < s->n_coef; ++i) most = fmax(most, fabs(X[i] - other[i]));
  return most <= 1e-8 * amplitude;
}

/* X, measured, among the solutions at the omega that began with number `from`; not twice. */
static hc_status add(verify_solutions *s, problem *p, double omega, int from, const double *X)
{
  hbm_measures m;
  verify_motion motion;
  if (verify_motion_of_solution(p->hbm, omega, X, 0, p->series, &m, &motion) != HC_OK) return HC_OK;
  for (int k = from; k < s->count; ++k)
    if (same_solution(s, k, X, m.amplitude)) return HC_OK;
  verify_solution *of = growing(s->of, s->count, sizeof *of);
  if (of) s->of = of;
  double *all = growing(s->X, s->count, (size_t)s->n_coef * sizeof *all);
  if (all) s->X = all;
  if (!of || !all) return HC_NO_MEMORY;
  memcpy(all + (size_t)s->count * s->n_coef, X, (size_t)s->n_coef * sizeof *X);
  of[s->count++] = read_all(&s->asked, p, motion);
  return HC_OK;
}

static hc_status start(verify_solutions *s, const verify_quantity *asked, int n, int n_coef)
{
  *s = (verify_solutions){.asked = *asked, .n = n, .n_coef = n_coef, .first = calloc((size_t)n + 1, sizeof *s->first)};
  return s->first ? HC_OK : HC_NO_MEMORY;
}

/* The curve, and its solutions at every omega. The problem is the caller's to clear. */
static hc_status follow_curve(const compare_setup *setup, const verify_equations *e, const verify_quantity *asked,
                              const verify_places *places, const hc_monitor *monitor, problem *p, verify_solutions *out)
{
  hbm_curve curve = {0};
  hc_status st = problem_new(setup, e, p),
            started = start(out, asked, places->n, p->hbm ? hbm_n_coefficients(p->hbm) : 0);
  if (started != HC_OK) st = started;
  if (st == HC_OK) st = hbm_trace(p->hbm, places->from, places->to, monitor, &curve);
  if (st != HC_INTERRUPTED && st != HC_NO_MEMORY && p->hbm) st = HC_OK; /* as far as it came */
  for (int i = 0; i < places->n && st == HC_OK; ++i) {
    hbm_curve at = {0};
    if (hbm_curve_at(p->hbm, &curve, places->omega[i], &at) == HC_NO_MEMORY) st = HC_NO_MEMORY;
    for (int k = 0; k < at.n && st == HC_OK; ++k)
      st = add(out, p, places->omega[i], out->first[i], at.X + (size_t)k * at.n_coef);
    out->first[i + 1] = out->count;
    hbm_curve_free(&at);
    if (!hc_monitor_tick(monitor, -1)) st = HC_INTERRUPTED;
  }
  hbm_curve_free(&curve);
  return st;
}

hc_status verify_solutions_of(const compare_setup *setup, const verify_equations *e, const verify_quantity *asked,
                              const verify_places *at, const hc_monitor *monitor, verify_solutions *out)
{
  problem p = {0};
  hc_status st = follow_curve(setup, e, asked, at, monitor, &p, out);
  hbm_solver_free(p.hbm);
  return st;
}

hc_status verify_solutions_of_dofs(const compare_setup *setup, const verify_equations *e, const verify_quantity *asked,
                                   const verify_places *at, const hc_monitor *monitor, verify_keep_dof *keep,
                                   void *self)
{
  problem p = {0};
  verify_solutions of = {0};
  compare_setup own = *setup;
  model *all;
  hc_status st = model_copy_all_seen(setup->model, &all);
  own.model = all;
  if (st == HC_OK) st = follow_curve(&own, e, asked, at, monitor, &p, &of);
  for (int r = 0; r < setup->model->n && st == HC_OK; ++r) {
    /* What is read of the solutions becomes that of response r. */
    for (int i = 0; i < of.n; ++i)
      for (int k = of.first[i]; k < of.first[i + 1]; ++k) {
        hbm_measures m;
        verify_motion motion;
        const double *X = of.X + (size_t)k * of.n_coef;
        if (verify_motion_of_solution(p.hbm, at->omega[i], X, r, p.series, &m, &motion) == HC_OK)
          of.of[k] = read_all(&of.asked, &p, motion);
      }
    keep(self, r, &of);
    if (!hc_monitor_tick(monitor, -1)) st = HC_INTERRUPTED;
  }
  verify_solutions_clear(&of);
  hbm_solver_free(p.hbm);
  model_free(all);
  return st;
}

/* From guess number k of *from, X[n_coef] being room for it. */
static hc_status solve_from(verify_solutions *s, problem *p, int i, double omega, const verify_solutions *from, int k,
                            double *X)
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
  if (st == HC_OK && hbm_n_coefficients(p.hbm) != near->n_coef) st = HC_BAD_INPUT; /* guesses of something else */
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
