/* duration.c - see duration.h. Proof: tests/compare/test_duration.c. */
#include "compare/duration.h"

#include <stdlib.h>
#include <string.h>

#include "compare/comparison.h"
#include "compare/work_limit.h"

/* Measured on plates, bladed_disk, blade_damper, blade_damper_reduced, beam16 and beam_pairs of cases/structures/. */
enum {
  CURVE_ITERATIONS = 250, /* 50 to 60 points of four iterations each */
  CVODE_PERIODS = 5,      /* of a solution: 1 to 3 for the steady state, as many for half the regularisation */
  CHORD_PERIODS = 10,     /* of the whole model; with slowed modes 10 more, of which each takes a fifth */
  CHORD_MATRICES = 2,     /* of the orbit, and of the exact law's */
  MATRICES = 20,          /* Newton: 2 to 9 for the steady state, as many for each of the other orbits */
  REPORT_CURVES = 7,      /* two by steps of 0.35, one to look at */
  TABLE_ORBITS = 24,      /* by the exact law: at the frequencies, and up the peak; */
  CHORD_ORBITS = 8,       /* of large structures the curve shows where it is (accuracy.c) */
  TABLE_MATRICES = 30,    /* by CVODES: orbits of ever smaller regularisations, beam16; without chord steps */
  VERIFY_ITERATIONS = 5,  /* at a point of the file */
  VERIFY_CHECKS = 20,     /* points held against time integration */
  TRUTH_HARMONICS = 20,   /* of what is compared with in verify */
  AUTO_HARMONICS = 14
};
static const double alone = 0.7;  /* a steady state, of a solution: without the budget of its error */
static const double check = 0.3;  /* an orbit of the exact law, of a solution */
static const double patience = 5; /* [s] for periods, all together */

int duration_frequencies(const compare_setup *setup)
{
  return setup->compare.omega.n ? setup->compare.omega.n : setup->compare.points;
}

static double middle(const compare_setup *setup)
{
  const number_list *omega = &setup->compare.omega;
  return omega->n ? omega->v[omega->n / 2] : 0.5 * (setup->omega_from + setup->omega_to);
}

/* [s] of a Newton step on the way to the solution X at omega from nothing. */
static hc_status time_newton(hbm_solver *hbm, double omega, double *X, double *seconds)
{
  hbm_point point = {0};
  memset(X, 0, (size_t)hbm_n_coefficients(hbm) * sizeof *X);
  const double began = thread_seconds();
  const hc_status st = hbm_solve(hbm, omega, X, &point);
  *seconds = (thread_seconds() - began) / fmax(point.iterations, 1);
  return st;
}

/* X and state: memory for a solution and a state on it. Along a curve contacts are mostly at rest, as at the sweep's
 * start, else change states as in its middle, where a step takes up to six times as long: the geometric mean. */
static hc_status measure_at(const compare_setup *setup, hbm_solver *hbm, timeint *ti, double *X, double *state,
                            duration_units *out)
{
  const double omega = middle(setup);
  double first = 0;
  const bool known = time_newton(hbm, setup->omega_from, X, &first) == HC_OK;
  hc_status st = time_newton(hbm, omega, X, &out->newton);
  if (known) out->newton = sqrt(first * out->newton);
  out->reference = compare_reference_harmonics(setup->model);
  out->harmonics = setup->hbm.harmonics == HBM_AUTO ? AUTO_HARMONICS : setup->hbm.harmonics;
  if (st == HC_OK) st = comparison_orbit_start(hbm, X, omega, state);
  if (st != HC_OK) return st;
  work_limit limit = {.until = thread_seconds() + patience};
  return timeint_time_periods(ti, omega, state, &(hc_monitor){work_limit_tick, &limit}, &out->period);
}

void duration_measure(const compare_setup *setup, duration_units *out)
{
  hbm_solver *hbm = NULL;
  timeint *ti = NULL;
  double *X = NULL, *state = NULL;
  *out = (duration_units){0};
  if (setup->model->n < DURATION_FEWEST) return;
  hc_status st = hbm_solver_new(setup->model, &setup->hbm, &hbm);
  if (st == HC_OK) st = timeint_new(setup->model, &setup->transient, &ti);
  if (st == HC_OK) {
    X = calloc((size_t)hbm_n_coefficients(hbm), sizeof *X);
    state = calloc((size_t)timeint_n_states(ti), sizeof *state);
    st = X && state ? measure_at(setup, hbm, ti, X, state, out) : HC_NO_MEMORY;
  }
  if (st != HC_OK) *out = (duration_units){0};
  free(state);
  free(X);
  timeint_free(ti);
  hbm_solver_free(hbm);
}

/* [s] a Newton step with so many harmonics. */
static double newton_step(const duration_units *u, int harmonics)
{
  const double more = (2.0 * harmonics + 1) / (2.0 * u->harmonics + 1);
  return u->newton * more * more * more;
}

static double solution(const duration_units *u)
{
  const period_times *t = &u->period;
  const double orbits = t->chords ? CHORD_PERIODS * t->closed_form + CHORD_MATRICES * t->matrix : MATRICES * t->matrix;
  return CVODE_PERIODS * t->by_cvode + orbits;
}

double duration_of_curve(const duration_units *u, int harmonics)
{
  return CURVE_ITERATIONS * newton_step(u, harmonics);
}

double duration_of_comparison(const duration_units *u, int n)
{
  return duration_of_curve(u, u->harmonics) + n * solution(u);
}

double duration_of_steady_states(const duration_units *u, int n)
{
  return duration_of_curve(u, u->harmonics) + alone * n * solution(u);
}

double duration_of_tables(const duration_units *u, const compare_settings *how)
{
  double most = u->reference, sum = 0;
  for (int i = 0; i < how->harmonics.n; ++i) {
    most = fmax(most, how->harmonics.v[i]);
    sum += (how->samples.n + 1) * duration_of_curve(u, (int)how->harmonics.v[i]);
  }
  const int orbits = u->period.chords ? CHORD_ORBITS : TABLE_ORBITS;
  return duration_of_curve(u, (int)most) + sum + orbits * check * solution(u) +
         (u->period.chords ? 0 : TABLE_MATRICES * u->period.cvodes_matrix);
}

double duration_of_report(const duration_units *u, int n, const compare_settings *how)
{
  return duration_of_comparison(u, n) + REPORT_CURVES * duration_of_curve(u, u->harmonics) + duration_of_tables(u, how);
}

double duration_of_verification(const duration_units *u, int n)
{
  const int harmonics = u->harmonics > TRUTH_HARMONICS / 2 ? 2 * u->harmonics : TRUTH_HARMONICS;
  return duration_of_curve(u, harmonics) + VERIFY_ITERATIONS * n * newton_step(u, harmonics) +
         check * (n < VERIFY_CHECKS ? n : VERIFY_CHECKS) * solution(u);
}
