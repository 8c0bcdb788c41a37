/* aliasing.c - see aliasing.h. Numbers of a state go out as integers: harmonics in 1e-6, differences and folds in 1e-9
 * of its `scale`, the 2-norm of the force's harmonics; that keeps the page small. */
#include "command/report/aliasing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/frequencies.h"
#include "hbm/aft.h"
#include "hbm/exact_force.h"
#include "numerics/workers.h"
#include "study/scene_solvers.h"

enum {
  N_HARM = 5,
  N_SAMPLES = 9,
  CHECKED_SAMPLES = 2,
  CHECKED_HARMONICS = 80,
  SPOT_HARMONICS = 3,
  MOST_COEF = 2 * HBM_MAX_HARMONICS + 1
};

/* On the sliders. */
static const int harmonics[N_HARM] = {1, 3, 5, 10, 20};
static const int samples[N_SAMPLES] = {16, 32, 64, 128, 256, 512, 1024, 2048, 4096};
/* In the states; with the largest H no more than HBM_MAX_HARMONICS. */
static const int checked_samples[CHECKED_SAMPLES] = {32, 128};
static const double harmonic_step = 1e-6, fold_step = 1e-9;

/* Parameters with a slider in the page, by their names in aliasing.js, and a factor on the case's value that the slider
 * has. */
enum { SPOT_KN, SPOT_GAP, SPOT_MU, SPOT_DAMPING, SPOT_FORCE, N_SPOTS };
static const struct spot {
  const char *parameter;
  double factor;
} spots[N_SPOTS] = {[SPOT_KN] = {"kn", 0.3},
                    [SPOT_GAP] = {"gap", 0.75},
                    [SPOT_MU] = {"mu", 2},
                    [SPOT_DAMPING] = {"damping", 1.5},
                    [SPOT_FORCE] = {"force", 1.5}};

/* One H, and memory for the force of one solution. */
typedef struct force_workspace {
  scene sc;                         /* with exact forces and H */
  exact_force *fine;                /* with HBM_MAX_HARMONICS harmonics */
  hbm_solver *hbm[CHECKED_SAMPLES]; /* of the sampled equations; made when needed */
  aft *sampled[CHECKED_SAMPLES];
  int n_harm;
  double omega, X[MOST_COEF]; /* of the solution */
  double F[MOST_COEF], scale; /* its true harmonics; their 2-norm */
} force_workspace;

static void workspace_close(force_workspace *w)
{
  for (int i = 0; i < CHECKED_SAMPLES; ++i) {
    hbm_solver_free(w->hbm[i]);
    aft_free(w->sampled[i]);
  }
  exact_force_free(w->fine);
}

static hc_status find_true_harmonics(force_workspace *w)
{
  double X[MOST_COEF] = {0}, sum = 0;
  memcpy(X, w->X, (size_t)(2 * w->n_harm + 1) * sizeof *X);
  hc_status st = exact_force_eval(w->fine, X, w->F, NULL, NULL);
  for (int i = 0; i < MOST_COEF; ++i) sum += w->F[i] * w->F[i];
  w->scale = sqrt(sum);
  return st;
}

/* ---- as JSON --------------------------------------------------------------------------------- */

static json_t *in_steps(double value, double step)
{
  return isfinite(value / step) ? json_integer((json_int_t)llround(value / step)) : json_null();
}

static json_t *number(double value) { return isfinite(value) ? json_real(value) : json_null(); }

static json_t *list_of_integers(int n, const int *v)
{
  json_t *list = json_array();
  for (int i = 0; i < n; ++i) json_array_append_new(list, json_integer(v[i]));
  return list;
}

static json_t *list_of_numbers(int n, const double *v)
{
  json_t *list = json_array();
  for (int i = 0; i < n; ++i) json_array_append_new(list, number(v[i]));
  return list;
}

/* The amplitude of the solution next to X of the equations with checked_samples[k]; NaN: none was found there. */
static double sampled_amplitude(force_workspace *w, int k)
{
  scene sc = w->sc;
  hbm_measures m;
  hbm_point point;
  double X[MOST_COEF];
  memcpy(X, w->X, sizeof X);
  sc.hbm.force = HBM_FORCE_SAMPLED;
  sc.hbm.samples = checked_samples[k];
  if (!w->hbm[k] && scene_hbm_solver(&sc, &w->hbm[k]) != HC_OK) return NAN;
  bool found = hbm_solve(w->hbm[k], w->omega, X, &point) == HC_OK && hbm_measure(w->hbm[k], X, &m) == HC_OK;
  return found ? m.amplitude : NAN;
}

/* |F_h|, h > 0. */
static double size_of(const double *F, int h) { return hypot(F[2 * h - 1], F[2 * h]); }

/* checked_samples[k]: amplitude; sampled minus true, cosine and sine parts [2 H + 1]; |F_{N-h}| and |F_{N+h}|,
 * h = 0..H. */
static json_t *sampled_state(force_workspace *w, int k)
{
  double F[MOST_COEF];
  const int n = checked_samples[k];
  hc_status st = n >= 2 * w->n_harm + 2 ? HC_OK : HC_BAD_INPUT;
  if (st == HC_OK && !w->sampled[k]) st = scene_aft(&w->sc, w->n_harm, n, &w->sampled[k]);
  if (st == HC_OK) st = aft_eval(w->sampled[k], w->X, F, NULL, NULL);
  if (st != HC_OK) return json_null();
  json_t *difference = json_array(), *folds = json_array();
  for (int h = 0; h <= w->n_harm; ++h) {
    for (int i = h ? 2 * h - 1 : 0; i <= 2 * h; ++i)
      json_array_append_new(difference, in_steps(F[i] - w->F[i], fold_step * w->scale));
    json_array_append_new(folds, in_steps(size_of(w->F, n - h), fold_step * w->scale));
    json_array_append_new(folds, in_steps(size_of(w->F, n + h), fold_step * w->scale));
  }
  return json_pack("{s:o, s:o, s:o}", "amplitude", number(sampled_amplitude(w, k)), "difference", difference, "folds",
                   folds);
}

static json_t *state_of(force_workspace *w, double amplitude)
{
  if (find_true_harmonics(w) != HC_OK) return json_null();
  /* no contact, or one that does nothing */
  if (!(w->scale > 0)) return json_pack("{s:o, s:i}", "amplitude", number(amplitude), "scale", 0);
  json_t *truth = json_array(), *sampled = json_array();
  for (int i = 0; i <= 2 * CHECKED_HARMONICS; ++i)
    json_array_append_new(truth, in_steps(w->F[i], harmonic_step * w->scale));
  for (int i = 0; i < CHECKED_SAMPLES; ++i) json_array_append_new(sampled, sampled_state(w, i));
  return json_pack("{s:o, s:o, s:o, s:o}", "amplitude", number(amplitude), "scale", number(w->scale), "true", truth,
                   "sampled", sampled);
}

/* ---- the states ------------------------------------------------------------------------------ */

/* Of the curve's solutions at omega the one with the largest amplitude, into w->X; NaN: there is none. */
static double largest_solution(force_workspace *w, hbm_solver *s, const hbm_curve *curve, double omega)
{
  hbm_curve at = {0};
  double largest = NAN;
  hbm_curve_at(s, curve, omega, &at);
  for (int k = 0; k < at.n; ++k) {
    hbm_measures m;
    if (hbm_measure(s, at.X + (size_t)k * at.n_coef, &m) != HC_OK || m.amplitude <= largest) continue;
    largest = m.amplitude;
    memcpy(w->X, at.X + (size_t)k * at.n_coef, (size_t)at.n_coef * sizeof *w->X);
  }
  hbm_curve_free(&at);
  w->omega = omega;
  return largest;
}

/* All states. */
typedef struct all_states {
  const scene *sc;
  int n_omega, first;
  const double *omega;
  json_t *state[N_HARM][ALIASING_MOST_OMEGAS];
  double spot[N_SPOTS]; /* amplitudes at omega[first]; NaN: no solution */
} all_states;

static void set_scene(force_workspace *w, const scene *sc, int n_harm)
{
  w->sc = *sc;
  w->n_harm = n_harm;
  w->sc.hbm.harmonics = n_harm;
  w->sc.hbm.force = HBM_FORCE_EXACT;
}

static void change_parameter(scene *sc, int spot)
{
  const double factor = spots[spot].factor;
  if (spot == SPOT_DAMPING) sc->damping *= factor;
  if (spot == SPOT_FORCE) sc->force *= factor;
  for (int j = 0; j < sc->n_contacts; ++j) {
    contact *law = &sc->contacts[j].law;
    if (spot == SPOT_KN) law->kn *= factor;
    if (spot == SPOT_GAP) law->gap *= factor;
    if (spot == SPOT_MU) law->mu *= factor;
  }
}

/* The curve of w->sc over the sweep and omega[n_omega], as far as it goes. Free *s and *curve in any case. */
static hc_status trace(const force_workspace *w, int n_omega, const double *omega, const hc_monitor *monitor,
                       hbm_solver **s, hbm_curve *curve)
{
  number_list asked = {.n = n_omega};
  double from, to;
  memcpy(asked.v, omega, (size_t)n_omega * sizeof *omega);
  comparison_sweep(w->sc.omega_from, w->sc.omega_to, &asked, &from, &to);
  hc_status st = scene_hbm_solver(&w->sc, s);
  if (st == HC_OK) st = hbm_trace(*s, from, to, monitor, curve);
  return st == HC_INTERRUPTED || st == HC_NO_MEMORY ? st : HC_OK;
}

/* All omegas of one H. */
static hc_status find_states(force_workspace *w, all_states *all, json_t **state, const hc_monitor *monitor)
{
  hbm_solver *s = NULL;
  hbm_curve curve = {0};
  hc_status st = trace(w, all->n_omega, all->omega, monitor, &s, &curve);
  for (int i = 0; i < all->n_omega && st == HC_OK; ++i) {
    double amplitude = s ? largest_solution(w, s, &curve, all->omega[i]) : NAN;
    state[i] = isnan(amplitude) ? json_null() : state_of(w, amplitude);
  }
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  return st;
}

static hc_status find_spot(force_workspace *w, all_states *all, int k, const hc_monitor *monitor)
{
  hbm_solver *s = NULL;
  hbm_curve curve = {0};
  change_parameter(&w->sc, k);
  hc_status st = trace(w, all->n_omega, all->omega, monitor, &s, &curve);
  all->spot[k] = st == HC_OK && s ? largest_solution(w, s, &curve, all->omega[all->first]) : NAN;
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  return st;
}

/* Tasks: the H from the one that takes longest, then the spots. */
static hc_status do_task(void *self, int task, const hc_monitor *monitor)
{
  all_states *all = self;
  const int h = N_HARM - 1 - task, spot = task - N_HARM;
  force_workspace *w = calloc(1, sizeof *w);
  if (!w) return HC_NO_MEMORY;
  set_scene(w, all->sc, spot >= 0 ? SPOT_HARMONICS : harmonics[h]);
  hc_status st = scene_exact(&w->sc, HBM_MAX_HARMONICS, &w->fine);
  if (st == HC_OK) st = spot >= 0 ? find_spot(w, all, spot, monitor) : find_states(w, all, all->state[h], monitor);
  workspace_close(w);
  free(w);
  return st;
}

/* states[omega][H]; takes the states. */
static json_t *in_order(all_states *all)
{
  json_t *states = json_array();
  for (int i = 0; i < all->n_omega; ++i) {
    json_t *row = json_array();
    for (int h = 0; h < N_HARM; ++h) {
      json_array_append_new(row, all->state[h][i]);
      all->state[h][i] = NULL;
    }
    json_array_append_new(states, row);
  }
  return states;
}

static json_t *spots_json(const all_states *all)
{
  json_t *list = json_array();
  for (int k = 0; k < N_SPOTS; ++k)
    json_array_append_new(list, json_pack("{s:s, s:f, s:i, s:f, s:o}", "parameter", spots[k].parameter, "factor",
                                          spots[k].factor, "harmonics", SPOT_HARMONICS, "omega", all->omega[all->first],
                                          "amplitude", number(all->spot[k])));
  return list;
}

static json_t *model_json(const scene *sc, double from, double to)
{
  json_t *contacts = json_array();
  for (int j = 0; j < sc->n_contacts; ++j) {
    const contact *law = &sc->contacts[j].law;
    json_array_append_new(contacts, json_pack("{s:f, s:f, s:f, s:f, s:f}", "kt", law->kt, "kn", law->kn, "mu", law->mu,
                                              "gap", law->gap, "angle_deg", sc->contacts[j].angle_deg));
  }
  return json_pack("{s:f, s:f, s:f, s:f, s:f, s:f, s:b, s:s, s:o}", "mass", sc->mass, "damping", sc->damping,
                   "stiffness", sc->stiffness, "force", sc->force, "from", from, "to", to, "keep_mean",
                   (int)sc->hbm.keep_mean, "restart", sc->hbm.restart == HBM_RESTART_SAMPLE ? "sample" : "interpolated",
                   "contacts", contacts);
}

static json_t *all_json(all_states *all)
{
  number_list asked = {.n = all->n_omega};
  double from, to;
  memcpy(asked.v, all->omega, (size_t)all->n_omega * sizeof *all->omega);
  comparison_sweep(all->sc->omega_from, all->sc->omega_to, &asked, &from, &to);
  json_t *checks = json_pack("{s:o, s:[f, f], s:o, s:o}", "samples", list_of_integers(CHECKED_SAMPLES, checked_samples),
                             "steps", harmonic_step, fold_step, "states", in_order(all), "spots", spots_json(all));
  return json_pack("{s:o, s:i, s:o, s:o, s:o, s:o}", "omega", list_of_numbers(all->n_omega, all->omega), "first",
                   all->first, "harmonics", list_of_integers(N_HARM, harmonics), "samples",
                   list_of_integers(N_SAMPLES, samples), "model", model_json(all->sc, from, to), "checks", checks);
}

static void drop_states(all_states *all)
{
  for (int h = 0; h < N_HARM; ++h)
    for (int i = 0; i < all->n_omega; ++i) json_decref(all->state[h][i]);
}

hc_status aliasing_states(const scene *sc, int n_omega, const double *omega, int first, int jobs,
                          const hc_monitor *monitor, json_t **out)
{
  all_states all = {.sc = sc, .n_omega = n_omega, .first = first, .omega = omega};
  *out = NULL;
  hc_status st = workers_run(jobs, N_HARM + N_SPOTS, do_task, &all, monitor);
  if (st == HC_OK && !(*out = all_json(&all))) st = HC_NO_MEMORY;
  drop_states(&all);
  return st;
}
