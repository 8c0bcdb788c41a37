/* orders.c - see accuracy.h: observed orders of convergence. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>

#include "compare/accuracy/accuracy.h"
#include "compare/work_limit.h"

enum { LEAST_POINTS = 3, LEVELS = 4 };

static const double asymptotic = 0.1; /* [1] larger errors are not yet in the asymptotic range */

static const order_fit no_fit = {.order = NAN, .spread = NAN, .from = NAN, .to = NAN};

/* The usable points, from the finest on, and their logarithms; returns their number. */
static int usable_points(int n, const double *x, const double *e, double floor, double *used, double *log_x,
                         double *log_e)
{
  double envelope = 0;
  int m = 0;
  for (int i = n - 1; i >= 0; --i) { /* from the finest */
    if (e[i] > envelope) envelope = e[i];
    if (!(e[i] >= 0) || !(envelope > floor) || !(envelope < asymptotic)) continue;
    used[m] = x[i];
    log_x[m] = log(x[i]);
    log_e[m++] = log(envelope);
  }
  return m;
}

static order_fit fit_line(int m, const double *used, const double *log_x, const double *log_e)
{
  double c0, c1, cov00, cov01, cov11, sum;
  gsl_fit_linear(log_x, 1, log_e, 1, (size_t)m, &c0, &c1, &cov00, &cov01, &cov11, &sum);
  return (order_fit){
      .order = -c1, .spread = m > 2 ? sqrt(cov11) : NAN, .from = used[m - 1], .to = used[0], .points = m};
}

order_fit order_fit_to(int n, const double *x, const double *e, double floor)
{
  double used[ORDER_MOST_POINTS], log_x[ORDER_MOST_POINTS], log_e[ORDER_MOST_POINTS];
  int m = n <= ORDER_MOST_POINTS ? usable_points(n, x, e, floor, used, log_x, log_e) : 0;
  if (m < 2) return no_fit;
  order_fit best = fit_line(m, used, log_x, log_e);
  if (m < LEAST_POINTS) return best;
  double narrowest = INFINITY;
  for (int k = LEAST_POINTS; k <= m; ++k) { /* the k finest */
    order_fit fit = fit_line(k, used, log_x, log_e);
    double width = fit.spread * gsl_cdf_tdist_Pinv(0.975, k - 2);
    if (width <= narrowest) {
      narrowest = width;
      best = fit;
    }
  }
  return best;
}

static const comparison_row *most_regularised(const comparison *c)
{
  const comparison_row *top = NULL;
  for (int i = 0; i < c->n_rows; ++i) {
    double part = c->rows[i].response == 0 ? c->rows[i].budget.amplitude.regularisation : NAN;
    if (part > (top ? top->budget.amplitude.regularisation : 0)) top = &c->rows[i];
  }
  return top && top->orbit_status == HC_OK ? top : NULL;
}

/* *e: amplitude error of the regularised orbit next to `row`'s; `state` becomes one on it. NaN: none found. */
static hc_status error_at(const compare_setup *setup, double regularisation, const comparison_row *row, double *state,
                          const hc_monitor *monitor, double *e)
{
  compare_setup other = *setup;
  timeint *ti = NULL;
  timeint_result r;
  work_limit p = {.outer = monitor, .most = PERIOD_LIMIT};
  hc_monitor bounded = {work_limit_tick, &p};
  *e = NAN;
  other.transient.regularisation = regularisation;
  other.transient.regularisation_error = 0; /* this error is to be measured */
  hc_status st = timeint_new(other.model, &other.transient, &ti);
  if (st == HC_OK) {
    st = timeint_orbit(ti, row->omega, 1, state, &bounded, &r);
    if (st == HC_OK) *e = budget_regularisation(&r, &row->orbit);
  }
  timeint_free(ti);
  return st == HC_NO_MEMORY ? st : p.stopped ? HC_INTERRUPTED : HC_OK;
}

/* True if modes are slowed at omega: the error of that does not fall with the regularisation, and exceeds its error. */
static bool slows_modes(const compare_setup *setup, double omega)
{
  timeint *ti = NULL;
  const bool slows = timeint_new(setup->model, &setup->transient, &ti) == HC_OK && timeint_slows_modes(ti, omega);
  timeint_free(ti);
  return slows;
}

hc_status order_of_regularisation(const compare_setup *setup, const comparison *c, const hc_monitor *monitor,
                                  order_row *out)
{
  const comparison_row *row = setup->transient.law == TRANSIENT_LAW_EXACT ? NULL : most_regularised(c);
  if (row && slows_modes(setup, row->omega)) row = NULL;
  *out = (order_row){.quantity = "regularisation", .omega = row ? row->omega : NAN, .fit = no_fit};
  if (!row) return HC_OK;
  double x[LEVELS], e[LEVELS], rho = setup->transient.regularisation;
  const size_t bytes = (size_t)c->n_states * sizeof(double);
  double *state = malloc(bytes);
  hc_status st = state ? HC_OK : HC_NO_MEMORY;
  for (int i = 0; i < LEVELS && st == HC_OK; ++i, rho /= 4) {
    x[i] = 1 / rho;
    memcpy(state, comparison_state(c, (int)(row - c->rows)), bytes);
    st = error_at(setup, rho, row, state, monitor, &e[i]);
  }
  free(state);
  if (st == HC_OK) out->fit = order_fit_to(LEVELS, x, e, 100 * setup->transient.tolerance);
  if (out->fit.points) { /* from 1/rho to rho, coarse to fine */
    out->fit.from = 1 / out->fit.from;
    out->fit.to = 1 / out->fit.to;
  }
  return st;
}
