/* lab_errors.c - see lab.h: how far solutions with fewer harmonics and with samples are from the exact law's orbit. */
#include <math.h>
#include <string.h>

#include "compare/comparison.h"
#include "interfaces/lab/lab_inside.h"

typedef struct error_row {
  int harmonics, samples; /* samples 0: exact forces */
  hc_status status;
  double amplitude, error;
  long solves;
} error_row;

static hc_status add_row(lab *l, const error_row *e)
{
  return LAB_ADD(l, e->harmonics, e->samples, e->status, e->amplitude, e->error, (double)e->solves);
}

/* The solution next to X[2 e->harmonics + 1], which it becomes; e->status says whether there is one. */
static void solve(const lab *l, double omega, double orbit, double *X, error_row *e)
{
  scene sc = l->sc;
  hbm_solver *s = NULL;
  hbm_point point;
  hbm_measures m;
  sc.hbm.harmonics = e->harmonics;
  sc.hbm.samples = e->samples;
  sc.hbm.force = e->samples ? HBM_FORCE_SAMPLED : HBM_FORCE_EXACT;
  e->amplitude = e->error = NAN;
  e->status = e->samples && e->samples < 2 * e->harmonics + 2 ? HC_BAD_INPUT : lab_solver(&sc, &s);
  if (e->status == HC_OK) e->status = hbm_solve(s, omega, X, &point);
  if (e->status == HC_OK) e->status = hbm_measure(s, X, &m);
  if (s) e->solves = hbm_solves(s);
  hbm_solver_free(s);
  if (e->status != HC_OK) return;
  e->amplitude = m.amplitude;
  e->error = fabs(m.amplitude - orbit) / orbit;
}

int lab_errors(lab *l, double omega)
{
  enum { COLUMNS = 6 };
  double orbit = NAN;
  lab_begin(l, COLUMNS);
  if (!l->has_case || l->n_harm < 1 || !(isfinite(omega) && omega > 0)) return lab_answer(l, HC_BAD_INPUT);
  /* Amplitude of the exact law's orbit next to the lab's motion. */
  double state[TIMEINT_W + SCENE_MAX_CONTACTS * SCENE_MOST_POINTS]; /* tables are several contacts each */
  scene sc = l->sc;
  compare_setup setup;
  timeint *ti = NULL;
  timeint_result found;
  lab_exact_law(&sc);
  hc_status st = scene_setup(&sc, &setup);
  if (st == HC_OK) st = comparison_referee(&setup, NULL, &ti);
  /* Where the time integration starts: on the lab's motion, its sliders by exact forces. */
  if (st == HC_OK) {
    scene exact;
    hbm_solver *solver = NULL;
    st = lab_scene(l, LAB_EXACT, &exact);
    exact.hbm.harmonics = l->n_harm;
    if (st == HC_OK) st = lab_solver(&exact, &solver);
    if (st == HC_OK) st = comparison_orbit_start(solver, l->X, omega, state);
    hbm_solver_free(solver);
  }
  if (st == HC_OK) st = timeint_orbit(ti, omega, 1, state, NULL, &found);
  if (st == HC_OK) orbit = found.amplitude;
  timeint_free(ti);
  scene_setup_clear(&setup);
  /* Exact forces first: what they find is the guess for the samples. */
  for (int i = 0; i < l->sc.compare.harmonics.n && st == HC_OK; ++i) {
    int n_harm = (int)l->sc.compare.harmonics.v[i];
    double first[LAB_MOST_COEF] = {0};
    const int common = n_harm < l->n_harm ? n_harm : l->n_harm;
    error_row e = {.harmonics = n_harm};
    memcpy(first, l->X, (size_t)(2 * common + 1) * sizeof *first);
    solve(l, omega, orbit, first, &e);
    st = add_row(l, &e);
    for (int k = 0; k < l->sc.compare.samples.n && st == HC_OK; ++k) {
      double guess[LAB_MOST_COEF];
      memcpy(guess, first, sizeof guess);
      e = (error_row){.harmonics = n_harm, .samples = (int)l->sc.compare.samples.v[k]};
      solve(l, omega, orbit, guess, &e);
      st = add_row(l, &e);
    }
  }
  return lab_answer(l, st);
}
