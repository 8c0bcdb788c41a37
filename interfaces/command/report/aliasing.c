/* aliasing.c - see parts.h. Every response curve first, then each solution beside one of the sampled equations, which
 * may have to start from another H's curve. Harmonics and forces are integers, in steps of the largest force: small. */
#include "interfaces/command/report/parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/response.h"
#include "compare/study/scene_solvers.h"
#include "numerics/base/constants.h"
#include "numerics/series.h"
#include "numerics/workers.h"

enum {
  N_STIFFNESS = 2,
  THE_CASE = 0, /* among them */
  N_HARM = 4,
  N_SAMPLES = 9,
  MOST_HARMONICS = 10,
  MOST_COEF = 2 * MOST_HARMONICS + 1,
  FINE_HARMONICS = HBM_MAX_HARMONICS, /* known of the true force */
  FINE_COEF = 2 * FINE_HARMONICS + 1,
  SHOWN_HARMONICS = 80,
  SHOWN_TIMES = 128, /* of the force over a period */
  STEPS = 16         /* of the contact law between two of these times */
};
static const double stiffness[N_STIFFNESS] = {1, 3}; /* factors on the case's */
static const int harmonics[N_HARM] = {1, 3, 5, MOST_HARMONICS};
static const int samples[N_SAMPLES] = {16, 32, 64, 128, 256, 512, 1024, 2048, 4096};
static const double force_step = 1e-4, harmonic_step = 1e-6, difference_step = 1e-9;

/* The solution of largest amplitude at one omega. */
typedef struct solution {
  double amplitude; /* NaN: there is none */
  bool touches;     /* a contact, at some time */
  double X[MOST_COEF];
} solution;

typedef struct followed {
  scene sc; /* with the stiffness, H and exact forces */
  solution at[ALIASING_MOST_OMEGAS];
  double working[2]; /* least and largest omega of the curve where a contact changes its state; NaN: nowhere */
  json_t *states;    /* [omega], null where there is no solution */
} followed;

typedef struct all_answers {
  int n_omega, first;
  const double *omega;
  double from, to; /* the sweep */
  followed curve[N_STIFFNESS][N_HARM];
} all_answers;

/* ---- as JSON --------------------------------------------------------------------------------- */

static json_t *list_in_steps(int n, const double *v, double step)
{
  json_t *list = json_array();
  for (int i = 0; i < n; ++i) {
    const double steps = v[i] / step;
    json_array_append_new(list, isfinite(steps) ? json_integer((json_int_t)llround(steps)) : json_null());
  }
  return list;
}

static json_t *list_of_integers(int n, const int *v)
{
  json_t *list = json_array();
  for (int i = 0; i < n; ++i) json_array_append_new(list, json_integer(v[i]));
  return list;
}

static json_t *list_of_numbers(int n, const double *v)
{
  json_t *list = json_array();
  for (int i = 0; i < n; ++i) json_array_append_new(list, json_finite(v[i]));
  return list;
}

/* ---- response curves ------------------------------------------------------------------------- */

/* Tasks of both stages: the curves from the H that takes longest. */
static followed *curve_of_task(all_answers *all, int task)
{
  return &all->curve[task % N_STIFFNESS][N_HARM - 1 - task / N_STIFFNESS];
}

/* As far as the curve goes: what cannot be followed has no solutions. */
static hc_status follow_curve(void *self, int task, const hc_monitor *monitor)
{
  all_answers *all = self;
  followed *f = curve_of_task(all, task);
  hbm_solver *s = NULL;
  hbm_curve curve = {0};
  hc_status st = scene_hbm_solver(&f->sc, &s);
  if (st == HC_OK) st = hbm_trace(s, all->from, all->to, monitor, &curve);
  if (s && st != HC_INTERRUPTED && st != HC_NO_MEMORY) {
    bool touches_nothing = false; /* is there a solution that needs the working range to be explained? */
    for (int i = 0; i < all->n_omega; ++i) {
      /* with the case's stiffness every omega is answered, with another the first alone */
      if (task % N_STIFFNESS == THE_CASE || i == all->first) {
        solution *out = &f->at[i];
        hbm_curve at = {0};
        hbm_curve_at(s, &curve, all->omega[i], &at);
        for (int k = 0; k < at.n; ++k) {
          hbm_measures m;
          if (hbm_measure(s, hbm_curve_X(&at, k), &m) != HC_OK || m.amplitude <= out->amplitude) continue;
          out->amplitude = m.amplitude;
          out->touches = m.contact.regime > CONTACT_LINEAR;
          memcpy(out->X, hbm_curve_X(&at, k), (size_t)at.n_coef * sizeof *out->X);
        }
        hbm_curve_free(&at);
      }
      touches_nothing |= isfinite(f->at[i].amplitude) && !f->at[i].touches;
    }
    if (touches_nothing) {
      for (int k = 0; k < curve.n; ++k) {
        hbm_measures m;
        const double omega = curve.points[k].omega;
        if (hbm_measure(s, hbm_curve_X(&curve, k), &m) != HC_OK || m.contact.regime <= CONTACT_STUCK) continue;
        f->working[0] = fmin(f->working[0], omega); /* fmin and fmax take the number, not the NaN */
        f->working[1] = fmax(f->working[1], omega);
      }
    }
  }
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  return st == HC_INTERRUPTED || st == HC_NO_MEMORY ? st : HC_OK;
}

/* ---- the force of a solution ------------------------------------------------------------------ */

typedef struct force_workspace {
  const scene *sc;
  model *m;
  moving_contact *contacts;
  contact_forces *fine;
  hbm_solver *hbm[N_SAMPLES]; /* of the sampled equations; NULL: N is too small for H */
  contact_forces *sampled[N_SAMPLES];
} force_workspace;

/* force[SHOWN_TIMES + 1] over a period, after one in which the sliders settle; returns its largest size. */
static double force_over_period(const force_workspace *w, const double *X, double *force)
{
  enum { N = SHOWN_TIMES * STEPS };
  double largest = 0, sum[N + 1] = {0};
  for (int j = 0; j < w->m->n_contacts; ++j) {
    const moving_contact *c = &w->contacts[j];
    double slider = 0, T = 0;
    for (int i = -N; i <= N; ++i) {
      const double th = TWO_PI * i / N, x = series_at(w->sc->hbm.harmonics, X, cos(th), sin(th)).x;
      if (contact_has_friction(&c->law)) contact_step(&c->law, c->cu[0] * x, c->cv[0] * x, &slider, &T);
      if (i >= 0) sum[i] += c->cu[0] * T + c->cv[0] * contact_normal_change(&c->law, c->cv[0] * x);
    }
  }
  for (int i = 0; i <= N; ++i) {
    largest = fmax(largest, fabs(sum[i]));
    if (i % STEPS == 0) force[i / STEPS] = sum[i];
  }
  return largest;
}

/* |F_h| of F[FINE_COEF]; NaN beyond it. */
static double size_of(const double *F, int h)
{
  if (h > FINE_HARMONICS) return NAN;
  return h ? hypot(F[2 * h - 1], F[2 * h]) : fabs(F[0]);
}

/* With samples[k]: Newton's solution from `start`; what the samples of `at` miss of F (NULL: touches nothing). */
static json_t *sampled_answer(const force_workspace *w, int k, double omega, const solution *at, const double *start,
                              const double *F, double largest)
{
  if (!w->hbm[k]) return json_null();
  const int H = w->sc->hbm.harmonics, n = 2 * H + 1;
  hbm_point point;
  hbm_measures m = {.amplitude = NAN};
  double X[MOST_COEF], missed[MOST_COEF], folds[2 * MOST_HARMONICS + 2] = {0};
  memcpy(X, start, sizeof X);
  if (hbm_solve(w->hbm[k], omega, X, &point) != HC_OK || hbm_measure(w->hbm[k], X, &m) != HC_OK) m.amplitude = NAN;
  json_t *answer = json_pack("{s:o, s:b}", "amplitude", json_finite(m.amplitude), "touches",
                             (int)(isfinite(m.amplitude) && m.contact.regime > CONTACT_LINEAR));
  if (!F || contact_forces_eval(w->sampled[k], at->X, missed, false, &(contact_report){0}) != HC_OK) return answer;
  for (int i = 0; i < n; ++i) missed[i] -= F[i];
  for (int h = 0; h <= H; ++h) {
    folds[2 * h] = size_of(F, samples[k] - h);
    folds[2 * h + 1] = size_of(F, samples[k] + h);
  }
  json_object_set_new(answer, "difference", list_in_steps(n, missed, difference_step * largest));
  json_object_set_new(answer, "folds", list_in_steps(n + 1, folds, difference_step * largest));
  return answer;
}

/* `more`: the solution of the least H above at whose contacts touch, or NULL. Where the truncation has lost the branch
 * on which contacts work, sampling may gain one, which Newton finds from there. */
static json_t *state_of(const force_workspace *w, double omega, const solution *at, const solution *more)
{
  double X[FINE_COEF] = {0}, F[FINE_COEF], force[SHOWN_TIMES + 1], largest = 0;
  memcpy(X, at->X, (size_t)(2 * w->sc->hbm.harmonics + 1) * sizeof *X);
  const bool known = at->touches && contact_forces_eval(w->fine, X, F, false, &(contact_report){0}) == HC_OK &&
                     (largest = force_over_period(w, X, force)) > 0;
  const double *start = !at->touches && more ? more->X : at->X;
  json_t *sampled = json_array();
  for (int k = 0; k < N_SAMPLES; ++k)
    json_array_append_new(sampled, sampled_answer(w, k, omega, at, start, known ? F : NULL, largest));
  json_t *state = json_pack("{s:f, s:b, s:o}", "amplitude", at->amplitude, "touches", (int)known, "sampled", sampled);
  if (!known) return state;
  json_object_set_new(state, "largest", json_finite(largest));
  json_object_set_new(state, "force", list_in_steps(SHOWN_TIMES + 1, force, force_step * largest));
  json_object_set_new(state, "harmonics", list_in_steps(2 * SHOWN_HARMONICS + 1, F, harmonic_step * largest));
  return state;
}

static hc_status answer_curve(void *self, int task, const hc_monitor *monitor)
{
  all_answers *all = self;
  followed *f = curve_of_task(all, task);
  followed *const end = all->curve[task % N_STIFFNESS] + N_HARM;
  force_workspace w;
  const scene *sc = &f->sc;
  const int H = sc->hbm.harmonics;
  scene with_samples = *sc;
  with_samples.hbm.force = HBM_FORCE_SAMPLED;
  w = (force_workspace){.sc = sc};
  hc_status st = scene_model(sc, &w.m);
  if (st == HC_OK) st = moving_contacts_of_model(w.m, &w.contacts);
  if (st == HC_OK) st = scene_forces(sc, HBM_FORCE_EXACT, FINE_HARMONICS, 0, &w.fine);
  for (int i = 0; i < N_SAMPLES && st == HC_OK; ++i) {
    if (samples[i] < 2 * H + 2) continue;
    with_samples.hbm.samples = samples[i];
    st = scene_hbm_solver(&with_samples, &w.hbm[i]);
    if (st == HC_OK) st = scene_forces(sc, HBM_FORCE_SAMPLED, H, samples[i], &w.sampled[i]);
  }
  f->states = json_array();
  for (int i = 0; i < all->n_omega && st == HC_OK; ++i) {
    const solution *at = &f->at[i], *more = NULL;
    for (const followed *g = f + 1; g < end && !more; ++g)
      if (g->at[i].touches) more = &g->at[i];
    json_array_append_new(f->states, isnan(at->amplitude) ? json_null() : state_of(&w, all->omega[i], at, more));
    if (!hc_monitor_tick(monitor, -1)) st = HC_INTERRUPTED;
  }
  for (int i = 0; i < N_SAMPLES; ++i) {
    hbm_solver_free(w.hbm[i]);
    contact_forces_free(w.sampled[i]);
  }
  contact_forces_free(w.fine);
  free(w.contacts);
  model_free(w.m);
  return st;
}

/* ---- all of them ------------------------------------------------------------------------------ */

static json_t *all_json(const all_answers *all)
{
  double kn[N_STIFFNESS];
  json_t *curves = json_array();
  for (int k = 0; k < N_STIFFNESS; ++k) {
    json_t *row = json_array();
    kn[k] = all->curve[k][0].sc.structure->contacts[0].given.law.kn;
    for (int h = 0; h < N_HARM; ++h) {
      const followed *f = &all->curve[k][h];
      json_array_append_new(row, json_pack("{s:o, s:O}", "working",
                                           isnan(f->working[0]) ? json_null() : list_of_numbers(2, f->working),
                                           "states", f->states));
    }
    json_array_append_new(curves, row);
  }
  return json_pack("{s:o, s:i, s:o, s:o, s:o, s:i, s:{s:f, s:f, s:f}, s:o}", "omega",
                   list_of_numbers(all->n_omega, all->omega), "first", all->first, "harmonics",
                   list_of_integers(N_HARM, harmonics), "samples", list_of_integers(N_SAMPLES, samples), "stiffness",
                   list_of_numbers(N_STIFFNESS, kn), "the_case", THE_CASE, "steps", "force", force_step, "harmonics",
                   harmonic_step, "difference", difference_step, "curves", curves);
}

hc_status aliasing_answers(const scene *sc, int n_omega, const double *omega, int first, int jobs,
                           const hc_monitor *monitor, json_t **out)
{
  *out = NULL;
  bool failed = false;
  all_answers *all = calloc(1, sizeof *all);
  if (!all) return HC_NO_MEMORY;
  *all = (all_answers){.n_omega = n_omega, .first = first, .omega = omega};
  number_list asked = {.n = all->n_omega};
  memcpy(asked.v, all->omega, (size_t)all->n_omega * sizeof *all->omega);
  comparison_sweep(sc->omega_from, sc->omega_to, &asked, &all->from, &all->to);
  for (int k = 0; k < N_STIFFNESS; ++k)
    for (int h = 0; h < N_HARM; ++h) {
      followed *f = &all->curve[k][h];
      *f = (followed){.sc = *sc, .working = {NAN, NAN}};
      failed |= !(f->sc.structure = structure_copy(sc->structure));
      f->sc.hbm.harmonics = harmonics[h];
      f->sc.hbm.force = HBM_FORCE_EXACT;
      for (int j = 0; j < scene_contact_count(sc) && !failed; ++j)
        f->sc.structure->contacts[j].given.law.kn *= stiffness[k];
      for (int i = 0; i < ALIASING_MOST_OMEGAS; ++i) f->at[i].amplitude = NAN;
    }
  hc_status st = failed ? HC_NO_MEMORY : workers_run(jobs, N_STIFFNESS * N_HARM, follow_curve, all, monitor);
  if (st == HC_OK) st = workers_run(jobs, N_STIFFNESS * N_HARM, answer_curve, all, monitor);
  if (st == HC_OK && !(*out = all_json(all))) st = HC_NO_MEMORY;
  for (int k = 0; k < N_STIFFNESS; ++k)
    for (int h = 0; h < N_HARM; ++h) {
      json_decref(all->curve[k][h].states);
      structure_free(all->curve[k][h].sc.structure);
    }
  free(all);
  return st;
}
