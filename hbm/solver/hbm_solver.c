/* hbm_solver.c - see hbm_solver.h: makes, resizes and frees a solver, and measures a solution. How it is found:
 * corrector.c from a guess, continuation.c without one. */
#include "hbm/solver/hbm_solver.h"

#include <stdlib.h>
#include <string.h>

#include "hbm/solver/corrector.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "hbm/solver/linear_solution.h"
#include "model/periodic_motion.h"
#include "numerics/norm.h"
#include "numerics/series.h"

enum { AUTO_FIRST_HARMONICS = 3, AUTO_FIRST_SAMPLES = 64 }; /* where auto starts */

/* The finer equations by which auto estimates the error: twice the harmonics, twice the samples. */
static hc_status make_refinements(hbm_solver *s, int n_time)
{
  const hbm_settings *how = &s->how;
  int n_harm = s->sys.n_harm, twice = n_harm > HBM_MAX_HARMONICS / 2 ? HBM_MAX_HARMONICS : 2 * n_harm;
  if (twice < REFINE_FEWEST_HARMONICS) twice = REFINE_FEWEST_HARMONICS;
  hc_status st = HC_OK;
  if (how->harmonics == HBM_AUTO)
    st = refinement_new(&s->sys, how, twice, n_time < 4 * twice ? 4 * twice : n_time, &s->finer_harmonics);
  if (st == HC_OK && how->samples == HBM_AUTO && how->force == HBM_FORCE_SAMPLED)
    st = refinement_new(&s->sys, how, n_harm, 2 * n_time, &s->finer_samples);
  return st;
}

/* shared: the metric of equations that these replace, or NULL. */
static hc_status make_equations(hbm_solver *s, int n_harm, int n_time, metric *shared)
{
  hc_status st = hbm_system_init(&s->sys, s->model, &s->how, n_harm, n_time, shared);
  double **const arrays[] = {&s->X, &s->z, &s->z_scale, &s->r_scale, &s->normal, &s->anchor, &s->truncated};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i)
    *arrays[i] = workspace_doubles(&s->memory, (size_t)s->sys.n_coef + 1);
  s->x = workspace_doubles(&s->memory, (size_t)series_length(HBM_MAX_HARMONICS));
  s->slider_starts = workspace_doubles(&s->memory, (size_t)s->model->n_contacts);
  const size_t unknowns = s->symmetric ? (size_t)s->sys.n : 0;
  s->whole_block = workspace_doubles(&s->memory, unknowns * unknowns);
  s->even_part = workspace_doubles(&s->memory, s->symmetric ? (size_t)s->sys.n_coef : 0);
  s->even_block = workspace_doubles(&s->memory, unknowns * unknowns);
  s->even_index = workspace_array(&s->memory, unknowns, sizeof *s->even_index);
  s->even_pivot = workspace_array(&s->memory, unknowns, sizeof *s->even_pivot);
  s->n_time = n_time;
  if (st == HC_OK) st = s->memory.failed ? HC_NO_MEMORY : hbm_corrector_new(s);
  for (int j = 0; j < s->model->n_contacts && st == HC_OK; ++j) {
    s->slider_starts[j] = s->model->contacts[j].rest;
    s->started |= s->slider_starts[j] != 0;
  }
  const evaluator_settings exact = {.n_harm = n_harm};
  if (st == HC_OK && s->how.force != HBM_FORCE_EXACT)
    st = contact_forces_new(s->model, s->sys.linear, HBM_FORCE_EXACT, &exact, &s->orbit);
  return st == HC_OK ? make_refinements(s, n_time) : st;
}

static void free_equations(hbm_solver *s)
{
  newton_free(s->fixed);
  newton_free(s->plane);
  contact_forces_free(s->orbit);
  refinement_free(s->finer_harmonics);
  refinement_free(s->finer_samples);
  refinement_free(s->exact_finer.by);
  free(s->exact_finer.improved);
  refinement_free(s->twice_finer.by);
  free(s->twice_finer.improved);
  hbm_system_clear(&s->sys);
  workspace_free(&s->memory);
  *s = (hbm_solver){.model = s->model,
                    .edges = s->edges,
                    .symmetric = s->symmetric,
                    .how = s->how,
                    .monodromy = s->monodromy,
                    .multipliers_unknown = s->multipliers_unknown,
                    .known_stability = s->known_stability,
                    .moduli = s->moduli,
                    .ramp = s->ramp,
                    .guess = s->guess,
                    .solves = s->solves,
                    .step_scale = s->step_scale,
                    .monitor = s->monitor,
                    .done = s->done,
                    .stopped = s->stopped};
}

hc_status hbm_solver_resize(hbm_solver *s, int n_harm, int n_time)
{
  long evaluations = s->sys.evaluations; /* counted over the solver's life */
  metric *const kept = metric_share(s->sys.metric);
  free_equations(s);
  hc_status st = make_equations(s, n_harm, n_time, kept);
  metric_free(kept);
  s->sys.evaluations = evaluations;
  return st;
}

hc_status hbm_solver_new(const model *m, const hbm_settings *how, hbm_solver **out)
{
  *out = NULL;
  hbm_solver *s = calloc(1, sizeof *s);
  if (!s) return HC_NO_MEMORY;
  int n_harm = how->harmonics, n_time = how->samples;
  if (n_harm == HBM_AUTO)
    n_harm = model_highest_load(m) > AUTO_FIRST_HARMONICS ? model_highest_load(m) : AUTO_FIRST_HARMONICS;
  if (n_time == HBM_AUTO)
    for (n_time = AUTO_FIRST_SAMPLES; n_time < 4 * n_harm; n_time *= 2) {}
  s->how = *how;
  s->step_scale = 1;
  hc_status st = model_copy(m, &s->model);
  if (st == HC_OK) s->symmetric = model_is_symmetric(s->model);
  if (st == HC_OK) s->edges = contact_edges_of(s->model);
  if (st == HC_OK) st = make_equations(s, n_harm, n_time, NULL);
  if (st == HC_OK) {
    *out = s;
    return HC_OK;
  }
  hbm_solver_free(s);
  return st;
}

void hbm_solver_free(hbm_solver *s)
{
  if (!s) return;
  free_equations(s);
  monodromy_free(s->monodromy);
  free(s->known_stability);
  free(s->moduli);
  model_free(s->model);
  if (s->guess.free) s->guess.free(s->guess.self);
  free(s);
}

void hbm_solver_take_guess(hbm_solver *s, const hbm_guess *g)
{
  if (s->guess.free) s->guess.free(s->guess.self);
  s->guess = *g;
}

void hbm_truncate(const hbm_solver *s, int n_coef, double *X)
{
  for (int i = s->sys.n_coef; i < n_coef; ++i) X[i] = 0;
}

int hbm_n_harmonics(const hbm_solver *s) { return s->sys.n_harm; }

int hbm_n_coefficients(const hbm_solver *s) { return s->sys.n_coef; }

void hbm_guess_of(const hbm_solver *s, const double *x, double *X)
{
  const hbm_system *sys = &s->sys;
  for (int c = 0; c < series_length(sys->n_harm); ++c)
    condensation_coordinates(sys->linear, x + (size_t)c * (size_t)s->model->n, X + (size_t)c * (size_t)sys->dim);
  memset(X, 0, (size_t)sys->first * sizeof *X); /* the means, where they are left out */
}

int hbm_n_samples(const hbm_solver *s) { return s->how.force == HBM_FORCE_SAMPLED ? s->n_time : 0; }

static void measure_series(int n_harm, const double *x, hbm_measures *out)
{
  series_extrema(n_harm, x, &out->max, &out->min);
  out->amplitude = motion_amplitude(out->max, out->min);
  out->rms = series_rms(n_harm, x);
  out->mean = x[0];
  out->harmonic_1 = series_harmonic_1(n_harm, x);
}

hc_status hbm_measure(hbm_solver *s, const double *X, hbm_measures *out)
{
  hc_status st = hbm_system_contact(&s->sys, X, false);
  if (st != HC_OK) return st;
  hbm_system_response(&s->sys, s->sys.n_harm, X, s->x);
  measure_series(s->sys.n_harm, s->x, out);
  out->contact = s->sys.report;
  return HC_OK;
}

/* x[c] = direction . coefficient c of the coordinates. */
static void along(const hbm_system *sys, const double *X, const double *direction, double *x)
{
  for (int c = 0; c < series_length(sys->n_harm); ++c) {
    x[c] = 0;
    for (int d = 0; d < sys->dim; ++d) x[c] += direction[d] * X[c * sys->dim + d];
  }
}

hc_status hbm_measure_contacts(hbm_solver *s, double omega, const double *X, contact_period *out)
{
  const hbm_system *sys = &s->sys;
  double u[2][2 * HBM_MAX_HARMONICS + 1], v[2 * HBM_MAX_HARMONICS + 1];
  hc_status st = HC_OK;
  for (int j = 0; j < s->model->n_contacts && st == HC_OK;) {
    placed_contact c = placed_contact_of(s->model, j);
    const contact_kind *kind = contact_kind_of(&c);
    for (int k = 0; k < kind->contacts; ++k) along(sys, X, condensation_tangent(sys->linear, j + k), u[k]);
    along(sys, X, condensation_normal(sys->linear, j), v);
    c.law = contact_in_units(&c.law, 1, 1, omega);
    st = kind->measures(&c.law, sys->n_harm, u[0], u[1], v, &out[j]);
    j += kind->contacts;
  }
  if (st == HC_OK) contact_periods_merge(s->model, out);
  return st;
}

int hbm_n_dof(const hbm_solver *s) { return s->model->n; }
int hbm_n_contacts(const hbm_solver *s) { return s->model->n_contacts; }

hc_status hbm_response(hbm_solver *s, double omega, const double *X, int r, double *x)
{
  if (r < 0 || r >= s->model->n_responses) return HC_BAD_INPUT;
  return hbm_system_any_response(&s->sys, omega, X, r, x);
}

hc_status hbm_measure_response(hbm_solver *s, double omega, const double *X, int r, hbm_measures *out)
{
  hc_status st = hbm_response(s, omega, X, r, s->x);
  if (st == HC_OK) st = hbm_system_contact(&s->sys, X, false);
  if (st != HC_OK) return st;
  measure_series(s->sys.n_harm, s->x, out);
  out->contact = s->sys.report;
  return HC_OK;
}

hc_status hbm_state(hbm_solver *s, double omega, const double *X, double *x, double *v)
{
  const int n = s->model->n, dim = s->sys.dim;
  double complex *motion = malloc((size_t)(n + dim) * sizeof *motion), *q = motion + n;
  hc_status st = motion ? condensation_at(s->sys.linear, omega, 0) : HC_NO_MEMORY;
  for (int i = 0; i < n; ++i) x[i] = v[i] = 0;
  for (int h = s->how.keep_mean ? 0 : 1; h <= s->sys.n_harm && st == HC_OK; ++h) {
    const double *a = X + (h ? (2 * h - 1) * dim : 0), *b = a + dim;
    for (int d = 0; d < dim; ++d) q[d] = h ? a[d] - I * b[d] : a[d];
    st = condensation_motion(s->sys.linear, h, q, 1, motion);
    for (int i = 0; i < n && st == HC_OK; ++i) {
      x[i] += creal(motion[i]);
      v[i] -= h * omega * cimag(motion[i]);
    }
  }
  free(motion);
  return st;
}

hc_status hbm_preloads(hbm_solver *s, double *N) { return hbm_linear_rest(&s->sys, N); }

hc_status hbm_sliders(hbm_solver *s, const double *X, double *w)
{
  hc_status st = hbm_system_contact(&s->sys, X, false);
  if (st != HC_OK) return st;
  contact_forces_sliders(s->sys.contacts, w);
  return HC_OK;
}

hc_status hbm_located_orbit(hbm_solver *s, const double *X, const contact_forces **orbit, contact_report *report)
{
  if (s->orbit) {
    *orbit = s->orbit;
    return contact_forces_eval(s->orbit, X, s->X, false, report); /* s->X gets the force, which is not needed */
  }
  *orbit = s->sys.contacts;
  hc_status st = hbm_system_contact(&s->sys, X, false);
  if (st == HC_OK) *report = s->sys.report;
  return st;
}

long hbm_solves(const hbm_solver *s) { return s->solves; }

hbm_newton_report hbm_newton_work(const hbm_solver *s)
{
  return (hbm_newton_report){s->sys.n, newton_factorings(s->plane) + newton_factorings(s->fixed)};
}
