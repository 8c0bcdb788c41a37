/* solutions.c - see solutions.h. */
#include "compare/verify/truth/solutions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/first_guess.h"
#include "numerics/base/growing.h"
#include "numerics/norm.h"

static const double close_omegas = 0.1; /* [1] a step that Newton may take in one go */

compare_setup verify_settings(const compare_setup *setup, const verify_equations *e)
{
  compare_setup own = *setup;
  own.hbm.harmonics = e->harmonics;
  own.hbm.keep_mean = e->keep_mean;
  own.hbm.force = e->samples ? HBM_FORCE_SAMPLED : HBM_FORCE_EXACT;
  own.hbm.samples = e->samples ? e->samples : 1024;
  own.hbm.continuation = HBM_CONTINUATION_AUTO;
  return own;
}

/* The one that was traced, as far as it goes; NULL: none, or a stop cut it short. */
static const response_curve *traced(const verify_curves *curves, int harmonics, double from, double to)
{
  for (int i = 0; i < curves->n; ++i) {
    const verify_curve *c = &curves->of[i];
    const bool usable = c->response.hbm && c->response.status != HC_INTERRUPTED;
    if (usable && c->harmonics == harmonics && c->from == from && c->to == to) return &c->response;
  }
  return NULL;
}

hc_status verify_curve_of(verify_curves *curves, const compare_setup *setup, int harmonics, double from, double to,
                          const hc_monitor *monitor, const response_curve **out)
{
  const verify_equations e = {.keep_mean = true, .harmonics = harmonics};
  compare_setup own = verify_settings(setup, &e);
  if ((*out = traced(curves, harmonics, from, to))) return HC_OK;
  if (!GROW(curves->of, curves->n)) return HC_NO_MEMORY;
  verify_curve *c = &curves->of[curves->n++];
  *c = (verify_curve){harmonics, from, to, {.hbm = NULL}};
  own.omega_from = from;
  own.omega_to = to;
  const hc_status st = response_trace(&own, NULL, monitor, &c->response);
  if (!c->response.hbm) return c->response.status;
  c->response.curve.n_coef = hbm_n_coefficients(c->response.hbm);
  *out = &c->response;
  return st;
}

void verify_curves_clear(verify_curves *curves)
{
  for (int i = 0; i < curves->n; ++i) response_curve_free(&curves->of[i].response);
  free(curves->of);
  *curves = (verify_curves){0};
}

/* The truth's curve, if that is what *e are the equations of, and its unknowns, of which the first response is one, are
 * those of *m. */
static const hbm_curve *known_curve(const verify_places *at, const model *m, const verify_equations *e)
{
  const verify_curves *c = at->curves;
  const bool plain = e->change == CHANGE_NONE && e->keep_mean && !e->odd_only && e->samples == 0;
  if (!c || !plain || memcmp(c->model->responses, m->responses, (size_t)m->n * sizeof *m->responses) != 0) return NULL;
  const response_curve *known = traced(c, e->harmonics, at->from, at->to);
  return known ? &known->curve : NULL;
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
  verify_mistakes wrong;
  hbm_solver *hbm;
  int dofs, first_dof;                      /* of the responses that is the motion of the first */
  double *offset, *X;                       /* [responses] [length] theirs are the solver's plus these; [n_coef] */
  double series[2 * HBM_MAX_HARMONICS + 1]; /* of a response */
} problem;

static void problem_clear(problem *p)
{
  hbm_solver_free(p->hbm);
  free(p->offset);
  free(p->X);
}

static hc_status problem_new(const compare_setup *setup, const verify_equations *e, problem *out)
{
  compare_setup own = verify_settings(setup, e);
  model *theirs;
  *out = (problem){.wrong = {.slider = verify_slider_kind(e)->slider, .odd_only = e->odd_only},
                   .dofs = setup->model->n,
                   .first_dof = setup->model->n_responses - setup->model->n};
  if (!(out->offset = calloc((size_t)setup->model->n_responses, sizeof *out->offset))) return HC_NO_MEMORY;
  const verify_changed how = {e->change, e->factor, e->which};
  hc_status st = verify_changed_model(setup->model, &how, e->keep_mean, &theirs, out->offset, &out->wrong);
  if (st != HC_OK) return st;
  verify_plug_in(&out->wrong, &own.hbm);
  st = guided_hbm_solver_new(theirs, &own.hbm, &out->hbm);
  model_free(theirs);
  if (st == HC_OK && !(out->X = calloc((size_t)hbm_n_coefficients(out->hbm), sizeof *out->X))) st = HC_NO_MEMORY;
  return st;
}

hc_status verify_model_seen(const model *m, int n, const int *response, model **out)
{
  const size_t dofs = (size_t)m->n;
  if (model_is_oscillator(m)) return model_copy(m, out); /* and stays one: its response is its motion */
  hc_status st = model_copy_sized(m, m->n_contacts, n + m->n, out);
  for (size_t r = 0; st == HC_OK && r < (size_t)n + dofs; ++r) {
    double *row = (*out)->responses + r * dofs;
    const double *from = r < (size_t)n ? m->responses + (size_t)response[r] * dofs : NULL;
    for (size_t i = 0; i < dofs; ++i) row[i] = from ? from[i] : i == r - (size_t)n;
  }
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

/* Every reading of the motion. */
static verify_solution read_motion(const verify_quantity *asked, verify_motion motion)
{
  verify_solution s;
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

static bool same_motion(const verify_solutions *s, int k, const double *x)
{
  const double close = 1e-6; /* [1] far above what a rough solution leaves, and below what a gate tells apart */
  const double *other = s->x + (size_t)k * (size_t)s->length;
  double apart = 0, most = 0;
  for (int i = 0; i < s->length; ++i) apart = fmax(apart, fabs(x[i] - other[i])), most = fmax(most, fabs(x[i]));
  return apart <= close * most;
}

/* The solution p->X, measured, among those at the omega that began with number `from`; not twice. */
static hc_status solutions_add(verify_solutions *s, problem *p, const verify_places *at, double omega, int from)
{
  verify_solution *of = growing(s->of, s->count, (size_t)s->n_responses * sizeof *of);
  if (of) s->of = of;
  double *all = growing(s->x, s->count, (size_t)s->length * sizeof *all);
  if (all) s->x = all;
  if (!of || !all) return HC_NO_MEMORY;
  double *x = all + (size_t)s->count * (size_t)s->length;
  const int coefficients = s->length / p->dofs;
  for (int d = 0; d < p->dofs; ++d) {
    if (hbm_response(p->hbm, omega, p->X, p->first_dof + d, p->series) != HC_OK) return HC_OK;
    for (int c = 0; c < coefficients; ++c) x[c * p->dofs + d] = p->series[c];
  }
  for (int k = from; k < s->count; ++k)
    if (same_motion(s, k, x)) return HC_OK;
  for (int r = 0; r < s->n_responses; ++r) {
    if (hbm_response(p->hbm, omega, p->X, r, p->series) != HC_OK) return HC_OK;
    p->series[0] += p->offset[r];
    of[s->count * s->n_responses + r] =
        read_motion(&at->asked[r], verify_motion_of(omega, hbm_n_harmonics(p->hbm), p->series));
  }
  ++s->count;
  return HC_OK;
}

void verify_solutions_move(verify_solutions *s, const verify_places *at, const model *m, int dof, bool relative,
                           const bool *wrong)
{
  double series[2 * HBM_MAX_HARMONICS + 1];
  const int dofs = m->n, coefficients = s->length / dofs;
  for (int i = 0; i < s->n; ++i)
    for (int k = s->first[i]; k < s->first[i + 1]; ++k) {
      const double *x = s->x + (size_t)k * (size_t)s->length;
      for (int r = 0; r < s->n_responses; ++r) {
        const double *row = m->responses + (size_t)r * (size_t)dofs;
        if (!wrong[r]) continue;
        for (int c = 0; c < coefficients; ++c)
          series[c] = relative ? dot_product(dofs, row, x + c * dofs) - x[c * dofs + dof] : x[c * dofs + dof];
        const verify_motion motion = verify_motion_of(at->omega[i], coefficients / 2, series);
        s->of[k * s->n_responses + r] = read_motion(&at->asked[r], motion);
      }
    }
}

/* The equations, and no solutions of them yet. The problem is the caller's to clear. */
static hc_status solutions_start(const compare_setup *setup, const verify_equations *e, const verify_places *at,
                                 problem *p, verify_solutions *s)
{
  hc_status st = problem_new(setup, e, p);
  *s = (verify_solutions){.n = at->n,
                          .n_responses = at->n_responses,
                          .length = p->hbm ? setup->model->n * (2 * hbm_n_harmonics(p->hbm) + 1) : 0,
                          .first = calloc((size_t)at->n + 1, sizeof *s->first)};
  return s->first ? st : HC_NO_MEMORY;
}

static bool asked_at(const verify_places *at, int i) { return !at->only || at->only[i]; }

hc_status verify_solutions_of(const compare_setup *setup, const verify_equations *e, const verify_places *at,
                              const hc_monitor *monitor, verify_solutions *out)
{
  problem p;
  hbm_curve own = {0};
  const hbm_curve *known = known_curve(at, setup->model, e), *curve = known ? known : &own;
  hc_status st = solutions_start(setup, e, at, &p, out);
  if (st == HC_OK && !known) st = hbm_trace_all(p.hbm, at->from, at->to, monitor, &own);
  if (st != HC_INTERRUPTED && st != HC_NO_MEMORY && p.hbm) st = HC_OK; /* as far as it came */
  for (int i = 0; i < at->n && st == HC_OK; ++i) {
    hbm_curve there = {0};
    if (asked_at(at, i) && hbm_curve_at(p.hbm, curve, at->omega[i], &there) == HC_NO_MEMORY) st = HC_NO_MEMORY;
    for (int k = 0; k < there.n && st == HC_OK; ++k) {
      memcpy(p.X, there.X + (size_t)k * there.n_coef, (size_t)there.n_coef * sizeof *p.X);
      st = solutions_add(out, &p, at, at->omega[i], out->first[i]);
    }
    out->first[i + 1] = out->count;
    hbm_curve_free(&there);
    if (!hc_monitor_tick(monitor, -1)) st = HC_INTERRUPTED;
  }
  hbm_curve_free(&own);
  problem_clear(&p);
  return st;
}

/* From guess number k of *from, each degree of freedom times its factor; guess[length] is room. */
static hc_status solve_from(verify_solutions *s, problem *p, const verify_places *at, int i,
                            const verify_solutions *from, int k, const double *factor, double *guess)
{
  hbm_point point;
  if (s->count - s->first[i] >= VERIFY_MOST_SOLUTIONS) return HC_OK;
  const int both = from->length < s->length ? from->length : s->length;
  memset(guess, 0, (size_t)s->length * sizeof *guess);
  memcpy(guess, from->x + (size_t)k * (size_t)from->length, (size_t)both * sizeof *guess);
  for (int c = 0; c < both && factor; ++c) guess[c] *= factor[c % p->dofs];
  hbm_guess_of(p->hbm, guess, p->X);
  hc_status st = hbm_solve_roughly(p->hbm, at->omega[i], p->X, &point);
  if (st == HC_OK) return solutions_add(s, p, at, at->omega[i], s->first[i]);
  return st == HC_NO_MEMORY ? st : HC_OK;
}

/* Is a solution at omega number i, of those from number `from` on, near the file's values in all responses? */
static bool near_file(const verify_solutions *s, const verify_places *at, int i, int from, int to)
{
  const double near = 0.05;
  bool any = false;
  for (int k = from; k < to && !any; ++k) {
    any = true;
    for (int r = 0; r < s->n_responses; ++r) {
      const double q = s->of[k * s->n_responses + r].q[0], value = at->value[r * at->stride + i];
      any &= isnan(value) || fabs(value - q) <= near * fmax(fabs(value), fabs(q));
    }
  }
  return any;
}

/* [dofs] The file's values over those of solution k: of a degree of freedom that a response contains that one's, of
 * others their geometric mean. False: there are none. */
static bool factors_of(const model *m, const verify_solutions *s, const verify_places *at, int i, int k, double *factor)
{
  double sum = 0;
  int n = 0;
  for (int d = 0; d < m->n; ++d) factor[d] = NAN;
  for (int r = 0; r < s->n_responses; ++r) {
    const double one = at->value[r * at->stride + i] / s->of[k * s->n_responses + r].q[0];
    if (!(one > 0) || !isfinite(one)) continue;
    sum += log(one), ++n;
    for (int d = 0; d < m->n; ++d)
      if (m->responses[r * m->n + d] != 0) factor[d] = one;
  }
  for (int d = 0; d < m->n; ++d)
    if (isnan(factor[d])) factor[d] = exp(sum / n);
  return n > 0;
}

hc_status verify_solutions_near(const compare_setup *setup, const verify_equations *e, const verify_solutions *near,
                                const verify_places *at, verify_solutions *out)
{
  problem p;
  hc_status st = solutions_start(setup, e, at, &p, out);
  const size_t dofs = (size_t)setup->model->n;
  double *guess = malloc(((size_t)out->length + dofs) * sizeof *guess), *factor = guess ? guess + out->length : NULL;
  if (!guess) st = HC_NO_MEMORY;
  for (int i = 0, last = -1; i < near->n && st == HC_OK; ++i) {
    /* Few samples have many solutions: from the neighbours' guesses, too. */
    const int more = e->samples > 0 && e->samples <= VERIFY_FEW_SAMPLES * e->harmonics;
    const int from = near->first[i > more ? i - more : 0],
              to = near->first[i + more < near->n ? i + more + 1 : near->n];
    for (int k = from; k < to && asked_at(at, i) && st == HC_OK; ++k)
      st = solve_from(out, &p, at, i, near, k, NULL, guess);
    const bool ends = at->plainly && out->count > out->first[i];
    for (int k = near->first[i]; k < near->first[i + 1] && !ends && at->value && asked_at(at, i) && st == HC_OK; ++k)
      if (!near_file(near, at, i, k, k + 1) && !near_file(out, at, i, out->first[i], out->count) &&
          factors_of(setup->model, near, at, i, k, factor))
        st = solve_from(out, &p, at, i, near, k, factor, guess);
    const bool close =
        !ends && asked_at(at, i) && last >= 0 && at->omega[i] - at->omega[last] <= close_omegas * at->omega[i];
    for (int k = close ? out->first[last] : 0; close && k < out->first[last + 1] && st == HC_OK; ++k)
      st = solve_from(out, &p, at, i, out, k, NULL, guess);
    out->first[i + 1] = out->count;
    if (asked_at(at, i)) last = i;
  }
  free(guess);
  problem_clear(&p);
  return st;
}

void verify_solutions_clear(verify_solutions *s)
{
  free(s->first);
  free(s->of);
  free(s->x);
  *s = (verify_solutions){0};
}
