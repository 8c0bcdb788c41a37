/* exact_force.c - see exact_force.h.
 *   on an interval    T = kt u - held (stick) or s mu N (slip s),   N = kn (v + gap) + load
 *   so            F_d(th) = sum_e K_de(th) x_e(th) + C_d(th),    K, C piecewise constant
 *   and           F     = [Toeplitz + Hankel of K] X + C
 *                 dF/dX = [Toeplitz + Hankel of K] - sum over stick intervals (harmonics of the interval) (d held)^T
 * Moving a transition changes nothing to first order, since the force is continuous there. */
#include "hbm/contact/exact_force.h"

#include <string.h>

#include "hbm/contact/force_jacobian.h"
#include "hbm/contact/interval_series.h"
#include "numerics/base/constants.h"
#include "numerics/base/workspace.h"

struct exact_force {
  int n_harm, n_dof, n_coef, n_contacts, cap;
  moving_contact *contacts;    /* [n_contacts] */
  int *n_intervals;            /* [n_contacts] */
  contact_interval *intervals; /* [n_contacts][cap] */
  double *table;               /* of series_grid_table_fill */
  double *indicator;           /* [4H+1] series of one interval's indicator */
  double *weight;              /* [2H+1] 2/(pi h) */
  double *symbol;              /* [n_dof][n_dof][4H+1] series of K */
  double *left, *right;        /* [n_dof (2H+1)] one rank-1 term */
  double *matrix;              /* [n_dof (2H+1)]^2 in the place of the caller's Jacobian where that is NULL */
  series_grid grid;
  workspace memory; /* of all of these */
};

hc_status exact_force_new(int n_harm, int n_dof, int n_contacts, const moving_contact *contacts, exact_force **out)
{
  *out = NULL;
  if (n_harm < 1 || n_harm > HBM_MAX_HARMONICS || n_dof < 1 || n_dof > SERIES_MAX_DIM || n_contacts < 0)
    return HC_BAD_INPUT;
  exact_force *e = calloc(1, sizeof *e);
  if (!e) return HC_NO_MEMORY;
  e->n_harm = n_harm;
  e->n_dof = n_dof;
  e->n_coef = series_length(n_harm);
  e->n_contacts = n_contacts;
  e->cap = 16 * n_harm + 16;
  size_t m = (size_t)n_dof * e->n_coef, symbol = (size_t)force_jacobian_symbol_length(n_harm);
  const size_t n_room = n_contacts ? (size_t)n_contacts : 1;
  e->contacts = workspace_array(&e->memory, n_room, sizeof *e->contacts);
  e->n_intervals = workspace_array(&e->memory, n_room, sizeof *e->n_intervals);
  e->intervals = workspace_array(&e->memory, n_room * e->cap, sizeof *e->intervals);
  e->table = workspace_doubles(&e->memory, (size_t)series_grid_table_length(n_harm));
  e->indicator = workspace_doubles(&e->memory, symbol);
  e->weight = workspace_doubles(&e->memory, 2 * (size_t)n_harm + 1);
  e->symbol = workspace_doubles(&e->memory, (size_t)n_dof * n_dof * symbol);
  e->left = workspace_doubles(&e->memory, m);
  e->right = workspace_doubles(&e->memory, m);
  e->matrix = workspace_doubles(&e->memory, m * m);
  if (e->memory.failed) {
    exact_force_free(e);
    return HC_NO_MEMORY;
  }
  if (n_contacts) memcpy(e->contacts, contacts, (size_t)n_contacts * sizeof *contacts);
  series_grid_table_fill(n_harm, e->table);
  interval_series_weights(2 * n_harm, e->weight);
  *out = e;
  return HC_OK;
}

void exact_force_free(exact_force *e)
{
  if (!e) return;
  workspace_free(&e->memory);
  free(e);
}

/* Series of the function that is 1 on the interval and 0 elsewhere, 2H harmonics. */
static void fill_indicator(exact_force *e, const contact_interval *p)
{
  interval_series_fill(2 * e->n_harm, e->weight, p->from, p->to, e->indicator);
}

/* to += scale from. Four at a time: the speed of a loop of two depends by a tenth on its alignment by the linker. */
static void add_scaled(int n, double scale, const double *restrict from, double *restrict to)
{
  int i = 0;
  for (; i + 4 <= n; i += 4) {
    to[i] += scale * from[i];
    to[i + 1] += scale * from[i + 1];
    to[i + 2] += scale * from[i + 2];
    to[i + 3] += scale * from[i + 3];
  }
  for (; i < n; ++i) to[i] += scale * from[i];
}

/* One interval's share of K and C, its indicator being filled. */
static void add_interval(exact_force *e, const moving_contact *c, const contact_interval *p, double *C)
{
  const contact *law = &c->law;
  int s = contact_slip_sign(p->state), symbol = force_jacobian_symbol_length(e->n_harm);
  double traction_v = s * law->mu * law->kn, traction_u = s ? 0 : law->kt,
         traction_0 = s ? traction_v * law->gap + s * law->mu * law->load : -p->held;
  const double clearance = law->gap > 0 ? 0 : law->kn * law->gap;
  for (int d = 0; d < e->n_dof; ++d) {
    for (int f = 0; f < e->n_dof; ++f) {
      double k = c->cu[d] * (traction_u * c->cu[f] + traction_v * c->cv[f]) + c->cv[d] * law->kn * c->cv[f];
      if (k != 0) add_scaled(symbol, k, e->indicator, e->symbol + (size_t)(d * e->n_dof + f) * symbol);
    }
    add_scaled(e->n_coef, c->cu[d] * traction_0 + c->cv[d] * clearance, e->indicator, C + (size_t)d * e->n_coef);
  }
}

/* While contact j is open its preload N0 is missing: C gets -N0 there. While it is closed, N - N0 is computed without
 * N0 (contact_normal_change). */
static void add_openings(exact_force *e, int j, double *C)
{
  const moving_contact *c = &e->contacts[j];
  const contact_interval *p = e->intervals + (size_t)j * e->cap;
  const int n = e->n_intervals[j];
  const double preload = contact_preload(&c->law);
  if (preload == 0) return;
  for (int i = 0; i < n || i == 0; ++i) {
    contact_interval open = {.from = 0, .to = TWO_PI};
    if (n > 0) open.from = p[i].to, open.to = i + 1 < n ? p[i + 1].from : p[0].from + TWO_PI;
    if (!(open.to > open.from)) continue;
    fill_indicator(e, &open);
    for (int d = 0; d < e->n_dof; ++d)
      add_scaled(e->n_coef, -preload * c->cv[d], e->indicator, C + (size_t)d * e->n_coef);
  }
}

/* jac -= (harmonics of cu on the interval) (d held/dX)^T. */
static void subtract_stick_interval(exact_force *e, const moving_contact *c, const contact_interval *p, double *jac)
{
  int n = e->n_coef, any = 0;
  for (int d = 0; d < e->n_dof; ++d) any |= p->held_by_x[d] != 0;
  if (contact_slip_sign(p->state) || !any) return;
  fill_indicator(e, p);
  double cosine = cos(p->origin), sine = sin(p->origin), ch = 1, sh = 0;
  e->right[0] = 1;
  for (int h = 1; h <= e->n_harm; ++h) {
    series_turn(cosine, sine, &ch, &sh);
    e->right[2 * h - 1] = ch;
    e->right[2 * h] = sh;
  }
  size_t ld = (size_t)e->n_dof * n;
  for (int f = 0; f < e->n_dof; ++f)
    for (int d = 0; d < e->n_dof; ++d) {
      double scale = -c->cu[d] * p->held_by_x[f];
      if (scale == 0) continue;
      for (int q = 0; q < n; ++q)
        add_scaled(n, scale * e->right[q], e->indicator, jac + (size_t)d * n + ld * ((size_t)f * n + q));
    }
}

/* Slider at th = 0: from the interval that covers it; w = u while separated. */
static double slider_at_zero(const exact_force *e, int j)
{
  const moving_contact *c = &e->contacts[j];
  const contact_interval *p = e->intervals + (size_t)j * e->cap;
  const series_node *zero = &e->grid.node[0];
  double u = 0, v = 0;
  for (int d = 0; d < e->n_dof; ++d) {
    u += c->cu[d] * zero->d[0][d];
    v += c->cv[d] * zero->d[0][d];
  }
  for (int i = 0; i < e->n_intervals[j]; ++i) {
    bool covers = p[i].from <= 0 || p[i].to >= TWO_PI;
    if (!covers || !(c->law.kt > 0)) continue;
    int s = contact_slip_sign(p[i].state);
    return s ? u - s * c->law.mu * contact_normal(&c->law, v) / c->law.kt : p[i].held / c->law.kt;
  }
  return u;
}

hc_status exact_force_eval(exact_force *e, const double *X, double *F, double *jac, contact_report *report)
{
  int m = e->n_dof * e->n_coef, symbol = force_jacobian_symbol_length(e->n_harm);
  double size = 0, *matrix = jac ? jac : e->matrix;
  for (int i = 0; i < m; ++i) size += fabs(X[i]);
  if (!(size <= TRANSITIONS_LARGEST)) return HC_NOT_FINITE;
  series_vector x = {e->n_harm, e->n_dof, {X, X + e->n_coef}};
  series_grid_fill(&e->grid, &x, e->table);
  memset(F, 0, (size_t)m * sizeof(double));
  memset(matrix, 0, (size_t)m * m * sizeof(double));
  memset(e->symbol, 0, (size_t)e->n_dof * e->n_dof * symbol * sizeof(double));
  for (int j = 0; j < e->n_contacts; ++j) {
    const moving_contact *c = &e->contacts[j];
    contact_interval *p = e->intervals + (size_t)j * e->cap;
    hc_status st = transitions_find(&e->grid, c, e->cap, p, &e->n_intervals[j]);
    if (st != HC_OK) return st;
    add_openings(e, j, F);
    for (int i = 0; i < e->n_intervals[j]; ++i) {
      fill_indicator(e, &p[i]);
      add_interval(e, c, &p[i], F);
    }
  }
  for (int d = 0; d < e->n_dof; ++d) /* block (d, f) from the symbol K_df */
    for (int f = 0; f < e->n_dof; ++f)
      force_jacobian_add(e->n_harm, e->symbol + (size_t)(d * e->n_dof + f) * symbol, m,
                         matrix + (size_t)d * e->n_coef + (size_t)m * f * e->n_coef);
  for (int q = 0; q < m; ++q) add_scaled(m, X[q], matrix + (size_t)m * q, F); /* Toeplitz + Hankel only, so far */
  for (int j = 0; jac && j < e->n_contacts; ++j)
    for (int i = 0; i < e->n_intervals[j]; ++i)
      subtract_stick_interval(e, &e->contacts[j], e->intervals + (size_t)j * e->cap + i, jac);
  if (report) {
    *report = (contact_report){.regime = CONTACT_LINEAR};
    for (int j = 0; j < e->n_contacts; ++j) {
      const contact_report own = transitions_report(e->n_intervals[j], e->intervals + (size_t)j * e->cap);
      report->regime = contact_regime_larger(report->regime, own.regime);
      report->transitions += own.transitions;
      report->free_sliders += own.free_sliders && moving_contact_has_slider(&e->contacts[j], e->n_dof);
    }
  }
  return HC_OK;
}

void exact_force_sliders(const exact_force *e, double *w)
{
  for (int j = 0; j < e->n_contacts; ++j) w[j] = slider_at_zero(e, j);
}

const contact_interval *exact_force_intervals(const exact_force *e, int j, int *n)
{
  *n = e->n_intervals[j];
  return e->intervals + (size_t)j * e->cap;
}

/* ---- as one of contact_evaluator.h -------------------------------------------------------------------- */

static hc_status make(const contact_coordinates *c, const evaluator_settings *how, void **self)
{
  exact_force *e;
  const hc_status st = exact_force_new(how->n_harm, c->n_dof, 1, &c->moved, &e);
  *self = e;
  return st;
}

static hc_status evaluate(void *self, const double *X, double *F, double *jac, contact_report *report)
{
  return exact_force_eval(self, X, F, jac, report);
}

static void let_go(void *self) { exact_force_free(self); }
static void sliders(const void *self, double *w) { exact_force_sliders(self, w); }
static void start(void *self, const double *w) { ((exact_force *)self)->contacts->rest = *w; }
static const contact_interval *intervals(const void *self, int *n) { return exact_force_intervals(self, 0, n); }

const contact_evaluator exact_force_evaluator = {
    .make = make, .free = let_go, .evaluate = evaluate, .sliders = sliders, .start = start, .intervals = intervals};
