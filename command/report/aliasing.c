/* aliasing.c - see aliasing.h. Numbers go out as integers: forces in 1e-4, harmonics in 1e-6, differences and folds
 * in 1e-9 of the state's `scale`, the largest |force|; a page of hundreds of states stays small. */
#include "command/report/aliasing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "campaigns/scene_solvers.h"
#include "compare/frequencies.h"
#include "hbm/aft.h"
#include "hbm/exact_force.h"
#include "hbm/fft_plan.h"
#include "numerics/series.h"
#include "numerics/workers.h"

enum {
  N_HARM = 5,
  N_STIFF = 5,
  N_SAMPLES = 9,
  SHOWN_TIMES = 256,
  SHOWN_HARMONICS = 80,
  FINE = 1 << 15,
  MOST_COEF = 2 * HBM_MAX_HARMONICS + 1
};

static const int harmonics[N_HARM] = {1, 3, 5, 10, 20};
static const int samples[N_SAMPLES] = {16, 32, 64, 128, 256, 512, 1024, 2048, 4096};
static const double factors[N_STIFF] = {0.1, 0.3, 1, 3, 10};
static const double force_step = 1e-4, harmonic_step = 1e-6, fold_step = 1e-9;

/* What all states share; read by every thread. */
typedef struct fine_grid {
  fftw_plan plan;     /* of arrays by fftw_malloc, run on each thread's own */
  double (*angle)[2]; /* [FINE] cosine and sine of the times */
} fine_grid;

/* One stiffness and H, and memory for the force of one solution. */
typedef struct force_workspace {
  scene sc; /* with the stiffness factor and H */
  const fine_grid *grid;
  exact_force *fine;          /* with HBM_MAX_HARMONICS harmonics */
  double *force;              /* [FINE] */
  fftw_complex *spectrum;     /* [FINE/2+1] true harmonics of the force, F_h = (a_h - i b_h) for h > 0 */
  hbm_solver *hbm[N_SAMPLES]; /* of the sampled equations; made when needed */
  aft *sampled[N_SAMPLES];
  int n_harm;
  double omega, X[MOST_COEF], scale; /* of the solution; scale: largest |force| */
} force_workspace;

static hc_status workspace_arrays(force_workspace *w)
{
  w->force = fftw_malloc(FINE * sizeof *w->force);
  w->spectrum = fftw_malloc((FINE / 2 + 1) * sizeof *w->spectrum);
  return w->force && w->spectrum ? HC_OK : HC_NO_MEMORY;
}

static void workspace_close(force_workspace *w)
{
  for (int i = 0; i < N_SAMPLES; ++i) {
    hbm_solver_free(w->hbm[i]);
    aft_free(w->sampled[i]);
  }
  exact_force_free(w->fine);
  fftw_free(w->force);
  fftw_free(w->spectrum);
}

static hc_status grid_open(fine_grid *g)
{
  force_workspace to_plan = {0};
  hc_status st = workspace_arrays(&to_plan);
  if (st == HC_OK) st = fft_plan_to_spectrum(FINE, to_plan.force, to_plan.spectrum, &g->plan);
  workspace_close(&to_plan);
  g->angle = malloc(FINE * sizeof *g->angle);
  for (int i = 0; i < FINE && g->angle; ++i) {
    double th = TWO_PI * i / FINE;
    g->angle[i][0] = cos(th);
    g->angle[i][1] = sin(th);
  }
  return g->angle ? st : HC_NO_MEMORY;
}

static void grid_close(fine_grid *g)
{
  fft_plan_free(g->plan);
  free(g->angle);
}

/* ---- the true harmonics ---------------------------------------------------------------------- */

/* Force of one contact at the angle th, from its pieces. */
static double contact_at(const moving_contact *c, int n, const contact_piece *p, double th, double x)
{
  const double u = c->cu[0] * x, v = c->cv[0] * x, normal = contact_normal(&c->law, v);
  double tangential = 0;
  for (int i = 0; i < n; ++i) {
    double at = th < p[i].from ? th + TWO_PI : th;
    if (at < p[i].from || at > p[i].to) continue;
    int s = contact_slip_sign(p[i].state);
    tangential = s ? s * c->law.mu * normal : c->law.kt * u - p[i].held;
  }
  return c->cu[0] * tangential + c->cv[0] * (normal - contact_preload(&c->law));
}

/* The force at FINE times, from the pieces of the exact evaluation, and its harmonics: by closed forms up to
 * HBM_MAX_HARMONICS, beyond from the FINE samples. */
static hc_status find_true_harmonics(force_workspace *w)
{
  double X[MOST_COEF] = {0}, F[MOST_COEF];
  moving_contact contacts[SCENE_MAX_CONTACTS];
  for (int j = 0; j < w->sc.n_contacts; ++j) contacts[j] = scene_moving_contact(&w->sc.contacts[j]);
  memcpy(X, w->X, (size_t)(2 * w->n_harm + 1) * sizeof *X);
  hc_status st = exact_force_eval(w->fine, X, F, NULL, NULL);
  if (st != HC_OK) return st;
  w->scale = 0;
  for (int i = 0; i < FINE; ++i) {
    double th = TWO_PI * i / FINE, x = series_at(w->n_harm, w->X, w->grid->angle[i][0], w->grid->angle[i][1]).x, f = 0;
    for (int j = 0, n; j < w->sc.n_contacts; ++j) {
      const contact_piece *p = exact_force_pieces(w->fine, j, &n);
      f += contact_at(&contacts[j], n, p, th, x);
    }
    w->force[i] = f;
    w->scale = fmax(w->scale, fabs(f));
  }
  fftw_execute_dft_r2c(w->grid->plan, w->force, w->spectrum);
  for (int h = 0; h <= FINE / 2; ++h) w->spectrum[h] *= 2.0 / FINE;
  w->spectrum[0] = F[0];
  for (int h = 1; h <= HBM_MAX_HARMONICS; ++h) w->spectrum[h] = F[2 * h - 1] - I * F[2 * h];
  return HC_OK;
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

/* The amplitude of the solution next to X of the equations with samples[k]; NaN: none was found there. */
static double sampled_amplitude(force_workspace *w, int k)
{
  scene sc = w->sc;
  hbm_measures m;
  hbm_point point;
  double X[MOST_COEF];
  memcpy(X, w->X, sizeof X);
  sc.hbm.force = HBM_FORCE_SAMPLED;
  sc.hbm.samples = samples[k];
  if (!w->hbm[k] && scene_hbm_solver(&sc, &w->hbm[k]) != HC_OK) return NAN;
  bool found = hbm_solve(w->hbm[k], w->omega, X, &point) == HC_OK && hbm_measure(w->hbm[k], X, &m) == HC_OK;
  return found ? m.amplitude : NAN;
}

/* samples[k]: amplitude; sampled minus true, cosine and sine parts [2 H + 1]; |F_{N-h}| and |F_{N+h}|, h = 0..H. */
static json_t *sampled_state(force_workspace *w, int k)
{
  double F[MOST_COEF];
  const int n = samples[k];
  hc_status st = n >= 2 * w->n_harm + 2 ? HC_OK : HC_BAD_INPUT;
  if (st == HC_OK && !w->sampled[k]) st = scene_aft(&w->sc, w->n_harm, n, &w->sampled[k]);
  if (st == HC_OK) st = aft_eval(w->sampled[k], w->X, F, NULL, NULL);
  if (st != HC_OK) return json_null();
  json_t *difference = json_array(), *folds = json_array();
  for (int h = 0; h <= w->n_harm; ++h) {
    double complex f = w->spectrum[h];
    json_array_append_new(difference, in_steps((h ? F[2 * h - 1] : F[0]) - creal(f), fold_step * w->scale));
    if (h) json_array_append_new(difference, in_steps(F[2 * h] + cimag(f), fold_step * w->scale));
    json_array_append_new(folds, in_steps(cabs(w->spectrum[n - h]), fold_step * w->scale));
    json_array_append_new(folds, in_steps(cabs(w->spectrum[n + h]), fold_step * w->scale));
  }
  return json_pack("{s:o, s:o, s:o}", "amplitude", number(sampled_amplitude(w, k)), "difference", difference, "folds",
                   folds);
}

static json_t *state_of(force_workspace *w, double amplitude)
{
  if (find_true_harmonics(w) != HC_OK) return json_null();
  /* no contact, or one that does nothing */
  if (!(w->scale > 0)) return json_pack("{s:o, s:i}", "amplitude", number(amplitude), "scale", 0);
  json_t *force = json_array(), *truth = json_array(), *sampled = json_array();
  for (int i = 0; i < SHOWN_TIMES; ++i)
    json_array_append_new(force, in_steps(w->force[i * (FINE / SHOWN_TIMES)], force_step * w->scale));
  for (int h = 0; h <= SHOWN_HARMONICS; ++h) {
    json_array_append_new(truth, in_steps(creal(w->spectrum[h]), harmonic_step * w->scale));
    if (h) json_array_append_new(truth, in_steps(-cimag(w->spectrum[h]), harmonic_step * w->scale));
  }
  for (int i = 0; i < N_SAMPLES; ++i) json_array_append_new(sampled, sampled_state(w, i));
  return json_pack("{s:o, s:o, s:o, s:o, s:o}", "amplitude", number(amplitude), "scale", number(w->scale), "force",
                   force, "true", truth, "sampled", sampled);
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

/* The states of all kn, H and omegas. */
typedef struct all_states {
  const scene *sc;
  fine_grid grid;
  int n_omega;
  const double *omega;
  json_t *state[N_STIFF][N_HARM][ALIASING_MOST_OMEGAS];
} all_states;

static void set_scene(force_workspace *w, const scene *sc, double factor, int n_harm)
{
  w->sc = *sc;
  w->n_harm = n_harm;
  w->sc.hbm.harmonics = n_harm;
  w->sc.hbm.force = HBM_FORCE_EXACT;
  for (int j = 0; j < sc->n_contacts; ++j) w->sc.contacts[j].law.kn *= factor;
}

/* All omegas of one stiffness and H. */
static hc_status find_states(force_workspace *w, int n_omega, const double *omega, const hc_monitor *monitor,
                             json_t **state)
{
  hbm_solver *s = NULL;
  hbm_curve curve = {0};
  number_list asked = {.n = n_omega};
  double from, to;
  memcpy(asked.v, omega, (size_t)n_omega * sizeof *omega);
  comparison_sweep(w->sc.omega_from, w->sc.omega_to, &asked, &from, &to);
  hc_status st = scene_hbm_solver(&w->sc, &s);
  if (st == HC_OK) st = hbm_trace(s, from, to, monitor, &curve); /* as far as it goes */
  for (int i = 0; i < n_omega && st != HC_INTERRUPTED && st != HC_NO_MEMORY; ++i) {
    double amplitude = s ? largest_solution(w, s, &curve, omega[i]) : NAN;
    state[i] = isnan(amplitude) ? json_null() : state_of(w, amplitude);
  }
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  return st == HC_INTERRUPTED || st == HC_NO_MEMORY ? st : HC_OK;
}

static hc_status do_task(void *self, int task, const hc_monitor *monitor)
{
  all_states *all = self;
  const int k = task / N_HARM, h = task % N_HARM;
  force_workspace *w = calloc(1, sizeof *w);
  if (!w) return HC_NO_MEMORY;
  w->grid = &all->grid;
  set_scene(w, all->sc, factors[k], harmonics[h]);
  hc_status st = workspace_arrays(w);
  if (st == HC_OK) st = scene_exact(&w->sc, HBM_MAX_HARMONICS, &w->fine);
  if (st == HC_OK) st = find_states(w, all->n_omega, all->omega, monitor, all->state[k][h]);
  workspace_close(w);
  free(w);
  return st;
}

/* states[omega][kn][H]; takes the states. */
static json_t *in_order(all_states *all)
{
  json_t *states = json_array();
  for (int i = 0; i < all->n_omega; ++i) {
    json_t *of_omega = json_array();
    for (int k = 0; k < N_STIFF; ++k) {
      json_t *row = json_array();
      for (int h = 0; h < N_HARM; ++h) {
        json_array_append_new(row, all->state[k][h][i]);
        all->state[k][h][i] = NULL;
      }
      json_array_append_new(of_omega, row);
    }
    json_array_append_new(states, of_omega);
  }
  return states;
}

static void drop_states(all_states *all)
{
  for (int k = 0; k < N_STIFF; ++k)
    for (int h = 0; h < N_HARM; ++h)
      for (int i = 0; i < all->n_omega; ++i) json_decref(all->state[k][h][i]);
  grid_close(&all->grid);
}

hc_status aliasing_states(const scene *sc, int n_omega, const double *omega, int first, int jobs,
                          const hc_monitor *monitor, json_t **out)
{
  all_states all = {.sc = sc, .n_omega = n_omega, .omega = omega};
  *out = NULL;
  hc_status st = grid_open(&all.grid);
  if (st == HC_OK) st = workers_run(jobs, N_STIFF * N_HARM, do_task, &all, monitor);
  if (st == HC_OK) {
    *out = json_pack("{s:o, s:i, s:o, s:o, s:o, s:o, s:[f, f, f], s:o}", "omega", list_of_numbers(n_omega, omega),
                     "first", first, "harmonics", list_of_integers(N_HARM, harmonics), "samples",
                     list_of_integers(N_SAMPLES, samples), "factors", list_of_numbers(N_STIFF, factors), "kn",
                     number(sc->n_contacts ? sc->contacts[0].law.kn : NAN), "steps", force_step, harmonic_step,
                     fold_step, "states", in_order(&all));
    if (!*out) st = HC_NO_MEMORY;
  }
  drop_states(&all);
  return st;
}
