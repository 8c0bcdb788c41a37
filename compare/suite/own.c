/* own.c - hbmcheck's own results: a response curve with few harmonics finds the solutions, Newton makes them finer. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/response.h"
#include "compare/suite/suite.h"
#include "numerics/base/growing.h"

enum { CURVE_HARMONICS = 20 };
static const double same_solution = 1e-7; /* [1] of the amplitude: two guesses led to one */

/* The solution X of *fine as a row of *out, if it is not there already. */
static hc_status keep_solution(hbm_solver *fine, double omega, const double *X, double *x, suite_answer *out)
{
  hbm_measures m = {0};
  hc_status st = hbm_measure_response(fine, omega, X, 0, &m);
  if (st == HC_OK) st = hbm_response(fine, omega, X, 0, x);
  const suite_row row = {omega, {m.amplitude, m.mean, x[1], x[2]}, 0};
  for (int k = 0; k < out->n && st == HC_OK; ++k) {
    double apart = fabs(out->rows[k].omega - omega);
    for (int q = 0; q < SUITE_N; ++q) apart = fmax(apart, fabs(out->rows[k].value[q] - row.value[q]));
    if (apart <= same_solution * m.amplitude) return HC_OK;
  }
  if (st == HC_OK && !GROW(out->rows, out->n)) st = HC_NO_MEMORY;
  if (st == HC_OK) out->rows[out->n++] = row;
  return st;
}

static bool fatal(hc_status st) { return st == HC_NO_MEMORY || st == HC_INTERRUPTED; }

hc_status suite_solve(const compare_setup *setup, const suite_case *c, hbm_force force, const hc_monitor *monitor,
                      suite_answer *out)
{
  compare_setup coarse = *setup;
  hbm_settings how = setup->hbm;
  response_curve found = {0};
  hbm_solver *fine = NULL;
  hbm_point point;
  number_list asked = {0};
  how.harmonics = c->harmonics, how.force = force;
  coarse.hbm.harmonics = how.harmonics < CURVE_HARMONICS ? how.harmonics : CURVE_HARMONICS;
  coarse.hbm.force = HBM_FORCE_EXACT;
  for (int i = 0; i < c->n && asked.n < NUMBER_LIST_MAX; ++i)
    if (i == 0 || c->references[i].omega != c->references[i - 1].omega) asked.v[asked.n++] = c->references[i].omega;
  hc_status st = hbm_solver_new(setup->model, &how, &fine), failed = HC_OK;
  if (st == HC_OK) st = response_trace(&coarse, &asked, monitor, &found);
  if (st == HC_OK && !found.hbm) st = found.status;
  const int length = fine ? hbm_n_coefficients(fine) : 0;
  double *X = calloc((size_t)length + 1, sizeof *X), *x = calloc(2 * (size_t)how.harmonics + 2, sizeof *x);
  if (!X || !x) st = HC_NO_MEMORY;
  for (int i = 0; i < asked.n && st == HC_OK; ++i) {
    hbm_curve at = {0};
    st = hbm_curve_at(found.hbm, &found.curve, asked.v[i], &at);
    if (!fatal(st) && st != HC_OK) failed = st, st = HC_OK;
    for (int k = 0; k < at.n && st == HC_OK; ++k) {
      memset(X, 0, (size_t)length * sizeof *X);
      memcpy(X, hbm_curve_X(&at, k), (size_t)hbm_n_coefficients(found.hbm) * sizeof *X);
      st = hbm_solve(fine, asked.v[i], X, &point);
      if (st == HC_OK) st = keep_solution(fine, asked.v[i], X, x, out);
      if (!fatal(st) && st != HC_OK) failed = st, st = HC_OK;
    }
    hbm_curve_free(&at);
  }
  out->there = true;
  free(X);
  free(x);
  hbm_solver_free(fine);
  response_curve_free(&found);
  return st == HC_OK ? failed : st;
}
