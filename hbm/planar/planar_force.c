/* planar_force.c - see planar_force.h. Lengths until the end, where they are multiplied with kt: (u - w) and R e.
 *
 * What the slider's position depends on is kept as a row of derivatives: d w (two rows) while it sticks, d phi while
 * it slips, by the columns of X and two more, of w0 = w(0). On the closed orbit w0 repeats itself, d w0 = (1 - A)^-1 B
 * dX with A, B the derivatives of the pass; the last two columns are then eliminated. */
#include "hbm/planar/planar_force.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "hbm/contact/force_jacobian.h"
#include "hbm/contact/interval_series.h"
#include "hbm/hbm_settings.h"
#include "hbm/planar/planar_force_impl.h"
#include "numerics/series.h"

enum { N = COLLOCATION_POINTS };

/* ---- made and freed ---------------------------------------------------------------------------------- */

static double *room(size_t n) { return calloc(n, sizeof(double)); }

static hc_status make_normal(planar_force *f)
{
  const moving_contact across = {.law = {.kn = f->law.kn, .gap = f->law.gap}, .cv = {1}};
  f->F_normal = room((size_t)f->n_coef);
  f->jac_normal = room((size_t)f->n_coef * (size_t)f->n_coef);
  if (!f->F_normal || !f->jac_normal) return HC_NO_MEMORY;
  return exact_force_new(f->n_harm, 1, 1, &across, &f->normal);
}

static hc_status make_room(planar_force *f)
{
  const size_t L = (size_t)f->n_coef, col = (size_t)f->n_col, symbol = (size_t)force_jacobian_symbol_length(f->n_harm);
  planar_cycle *c = &f->cycle;
  c->cap = 16 * f->n_harm + 16;
  c->slip.cap = 64 * f->n_harm + 256;
  c->interval = calloc((size_t)c->cap, sizeof *c->interval);
  c->slip.panel = calloc((size_t)c->slip.cap, sizeof *c->slip.panel);
  f->contact = calloc((size_t)c->cap, sizeof *f->contact);
  f->intervals = calloc((size_t)c->cap, sizeof *f->intervals);
  f->indicator = room(symbol), f->symbol = room(symbol), f->weight = room(2 * (size_t)f->n_harm + 1);
  f->X = room((size_t)f->n_size), f->F = room(2 * L), f->by = room(2 * L * col);
  f->dw[0] = room(col), f->dw[1] = room(col), f->dphi = room(col);
  f->matrix = room(L * L), f->table = room((size_t)series_grid_table_length(f->n_harm));
  f->node = room(3 * N * col), f->base = room(N * L), f->rate = room(N * L), f->test = room(N * L);
  const bool found =
      c->interval && c->slip.panel && f->contact && f->intervals && f->indicator && f->symbol && f->weight;
  return found && f->X && f->F && f->matrix && f->table && f->by && f->dw[0] && f->dw[1] && f->dphi && f->node &&
                 f->base && f->rate && f->test
             ? HC_OK
             : HC_NO_MEMORY;
}

/* Without v, N is what v = 0 gives. */
static contact whole_law(const contact *half, int n_dof)
{
  contact law = {half->kt, 2 * half->kn, half->mu / 2, half->gap, 2 * half->load};
  if (n_dof == 2) law.load = contact_normal(&law, 0), law.kn = law.gap = 0;
  return law;
}

hc_status planar_force_new(int n_harm, int n_dof, const contact *law, planar_force **out)
{
  *out = NULL;
  if (n_harm < 1 || n_harm > HBM_MAX_HARMONICS || !contact_has_friction(law)) return HC_BAD_INPUT;
  if (n_dof != 2 && n_dof != 3) return HC_BAD_INPUT;
  planar_force *f = calloc(1, sizeof *f);
  if (!f) return HC_NO_MEMORY;
  f->n_harm = n_harm, f->n_dof = n_dof, f->law = whole_law(law, n_dof);
  f->n_coef = series_length(n_harm);
  f->n_size = n_dof * f->n_coef;
  f->n_col = f->n_size + 2;
  hc_status st = make_room(f);
  if (st == HC_OK && n_dof == 3) st = make_normal(f);
  if (st != HC_OK) {
    planar_force_free(f);
    return st;
  }
  interval_series_weights(2 * n_harm, f->weight);
  collocation_fill(&f->rule);
  series_grid_table_fill(n_harm, f->table);
  *out = f;
  return HC_OK;
}

void planar_force_free(planar_force *f)
{
  if (!f) return;
  exact_force_free(f->normal);
  double *const rooms[] = {f->X,    f->F_normal, f->jac_normal, f->indicator, f->symbol, f->weight,
                           f->F,    f->by,       f->dw[0],      f->dw[1],     f->dphi,   f->node,
                           f->base, f->rate,     f->test,       f->matrix,    f->table};
  for (size_t i = 0; i < sizeof rooms / sizeof *rooms; ++i) free(rooms[i]);
  free(f->contact);
  free(f->intervals);
  free(f->cycle.interval);
  free(f->cycle.slip.panel);
  free(f);
}

/* ---- the orbit --------------------------------------------------------------------------------------- */

/* The normal force, and between which angles there is contact. */
static hc_status find_contacts(planar_force *f, const double *X)
{
  planar_cycle *c = &f->cycle;
  f->contact[0] = (planar_contact){0, TWO_PI};
  c->n_contacts = 1;
  c->always = true;
  c->contact = f->contact;
  if (!f->normal) {
    c->n_contacts = f->law.load > 0;
    return HC_OK;
  }
  const hc_status st = exact_force_eval(f->normal, X + 2 * (size_t)f->n_coef, f->F_normal, f->jac_normal, NULL);
  const contact_interval *p = exact_force_intervals(f->normal, 0, &c->n_contacts);
  for (int i = 0; i < c->n_contacts && st == HC_OK; ++i) f->contact[i] = (planar_contact){p[i].from, p[i].to};
  c->always = c->n_contacts == 1 && p->from <= 0 && p->to >= TWO_PI;
  return st;
}

static hc_status find_orbit(planar_force *f, const double *X)
{
  planar_cycle *c = &f->cycle;
  const double *v = f->normal ? X + 2 * (size_t)f->n_coef : NULL;
  hc_status st = find_contacts(f, X);
  f->motion = planar_motion_make(&f->law, f->n_harm, X, X + f->n_coef, v);
  if (!isfinite(f->motion.of_u[3] * f->motion.of_u[3] + f->motion.of_R[3] * f->motion.of_R[3])) st = HC_NOT_FINITE;
  c->m = c->slip.m = &f->motion;
  c->slip.c = &f->rule;
  c->slip.width = 0;
  c->grid = f->grid;
  c->n = 0;
  if (st != HC_OK || c->n_contacts == 0) return st;
  planar_motion_grid(&f->motion, f->table, f->grid);
  return planar_cycle_find(c);
}

/* ---- stick ------------------------------------------------------------------------------------------- */

/* u - w on the interval: its share of the symbol, and of what is constant. */
static void add_stick(planar_force *f, const planar_interval *p, bool derive)
{
  const int L = f->n_coef;
  interval_series_fill(2 * f->n_harm, f->weight, p->from, p->to, f->indicator);
  for (int i = 0; i < force_jacobian_symbol_length(f->n_harm); ++i) f->symbol[i] += f->indicator[i];
  for (int d = 0; d < 2; ++d) {
    for (int i = 0; i < L; ++i) f->F[d * L + i] -= p->w[d] * f->indicator[i];
    for (int i = 0; derive && i < L; ++i) {
      double *row = f->by + (size_t)(d * L + i) * (size_t)f->n_col;
      for (int q = 0; q < f->n_col; ++q) row[q] -= f->indicator[i] * f->dw[d][q];
    }
  }
}

/* ---- a period ------------------------------------------------------------------------------------------ */

static void clear_sums(planar_force *f)
{
  memset(f->F, 0, 2 * (size_t)f->n_coef * sizeof *f->F);
  memset(f->by, 0, 2 * (size_t)f->n_coef * (size_t)f->n_col * sizeof *f->by);
  memset(f->symbol, 0, (size_t)force_jacobian_symbol_length(f->n_harm) * sizeof *f->symbol);
}

/* The integrals of all intervals. In dw the derivatives of w0; at the end those of w(2 pi). */
static void add_intervals(planar_force *f, bool derive)
{
  const planar_cycle *c = &f->cycle;
  double *base = f->base, *rate = f->rate;
  clear_sums(f);
  for (int i = 0; i < c->n; ++i) {
    const planar_interval *p = &c->interval[i];
    if (derive) planar_row_begin(f, i, base, rate);
    if (p->state == CONTACT_STICK) add_stick(f, p, derive);
    for (int k = p->panel; p->state != CONTACT_STICK && k < p->panel + p->n_panels; ++k)
      planar_panel_sums(f, &c->slip.panel[k], derive);
  }
  const planar_interval *last = &c->interval[c->n - 1];
  if (!derive || c->n == 0 || last->state == CONTACT_STICK) return;
  planar_row_base(f->n_harm, last->to, base, rate);
  const planar_point at = planar_motion_at(&f->motion, last->to);
  planar_row_rest(f, base, c->slip.panel[last->panel + last->n_panels - 1].phi[N - 1], at.R);
}

static void start_from_w0(planar_force *f)
{
  for (int d = 0; d < 2; ++d) {
    planar_row_clear(f, f->dw[d]);
    f->dw[d][f->n_size + d] = 1;
  }
}

/* by += (derivatives by w0) dw0, dw0 by the columns of X being in row[2]. */
static void eliminate_w0(planar_force *f, double *const row[2])
{
  const size_t L = (size_t)f->n_coef;
  for (size_t i = 0; i < 2 * L; ++i) {
    double *by = f->by + i * (size_t)f->n_col;
    const double *by_w0 = by + f->n_size;
    for (int q = 0; q < f->n_size; ++q) by[q] += by_w0[0] * row[0][q] + by_w0[1] * row[1][q];
  }
}

/* On the closed orbit d w0 = A d w0 + B: of what dw has after a pass from w0, into dw. */
static void close_derivatives(planar_force *f)
{
  const int n = f->n_size;
  const double a = 1 - f->dw[0][n], b = -f->dw[0][n + 1], c = -f->dw[1][n], d = 1 - f->dw[1][n + 1],
               det = a * d - b * c;
  for (int q = 0; q < n; ++q) {
    const double x = f->dw[0][q], y = f->dw[1][q];
    f->dw[0][q] = (d * x - b * y) / det;
    f->dw[1][q] = (a * y - c * x) / det;
  }
}

/* Free to rest anywhere: the passes from w = 0 that brought it where it is, once more. */
static hc_status march_again(planar_force *f)
{
  double w[2] = {0};
  hc_status st = HC_OK;
  planar_row_clear(f, f->dw[0]);
  planar_row_clear(f, f->dw[1]);
  for (int i = 0; i < f->cycle.marched && st == HC_OK; ++i) {
    st = planar_cycle_pass(&f->cycle, w, NULL);
    if (st == HC_OK) add_intervals(f, true);
  }
  return st == HC_OK ? planar_cycle_pass(&f->cycle, w, NULL) : st;
}

/* Derivatives of the corner it rests in. */
static void follow_corner(planar_force *f)
{
  const planar_corner *c = &f->cycle.corner;
  const double per_v = f->motion.per_v;
  double *grows[2] = {f->dw[0], f->dw[1]};
  for (int i = 0; i < 2; ++i) {
    planar_row_clear(f, grows[i]);
    planar_row_base(f->n_harm, c->at[i].th, f->base, f->rate);
    planar_row_add(f, f->base, c->e[i][0], c->e[i][1], -per_v, grows[i]);
  }
  for (int q = 0; q < f->n_size; ++q) {
    double dw[2];
    planar_corner_move(c, (double[2]){grows[0][q], grows[1][q]}, dw);
    f->dw[0][q] = dw[0], f->dw[1][q] = dw[1];
  }
}

static hc_status integrate(planar_force *f, bool derive)
{
  hc_status st = HC_OK;
  const bool closes = derive && f->cycle.always && f->cycle.marched < 0 && !f->cycle.cornered;
  if (f->cycle.n_contacts == 0) clear_sums(f);
  if (f->cycle.n_contacts == 0) return HC_OK;
  if (closes) start_from_w0(f);
  else if (derive && f->cycle.cornered) follow_corner(f);
  else if (derive && f->cycle.always) st = march_again(f);
  if (st != HC_OK) return st;
  add_intervals(f, derive);
  if (!closes) return HC_OK;
  close_derivatives(f);
  eliminate_w0(f, f->dw);
  return HC_OK;
}

/* ---- put together --------------------------------------------------------------------------------------- */

/* F_d = kt (K u_d + rest), K being Toeplitz + Hankel of stick; and its derivatives. */
static void put_tangential(planar_force *f, const double *X, double *F, double *jac)
{
  const size_t L = (size_t)f->n_coef, n = (size_t)f->n_size;
  const double kt = f->law.kt;
  memset(f->matrix, 0, L * L * sizeof *f->matrix);
  force_jacobian_add(f->n_harm, f->symbol, f->n_coef, f->matrix);
  for (size_t d = 0; d < 2; ++d) {
    for (size_t q = 0; q < L; ++q)
      for (size_t i = 0; i < L; ++i) f->F[d * L + i] += f->matrix[i + L * q] * X[d * L + q];
    for (size_t i = 0; i < L; ++i) F[d * L + i] = kt * f->F[d * L + i];
    for (size_t i = 0; jac && i < L; ++i) {
      const double *by = f->by + (d * L + i) * (size_t)f->n_col;
      for (size_t q = 0; q < n; ++q) jac[d * L + i + n * q] = kt * by[q];
    }
    for (size_t q = 0; jac && q < L; ++q)
      for (size_t i = 0; i < L; ++i) jac[d * L + i + n * (d * L + q)] += kt * f->matrix[i + L * q];
  }
}

static void put_normal(const planar_force *f, double *F, double *jac)
{
  const size_t L = (size_t)f->n_coef, n = (size_t)f->n_size;
  if (f->n_dof < 3) return;
  for (size_t i = 0; i < L; ++i) F[2 * L + i] = f->F_normal[i];
  for (size_t q = 0; jac && q < n; ++q)
    for (size_t i = 0; i < L; ++i) jac[2 * L + i + n * q] = q < 2 * L ? 0 : f->jac_normal[i + L * (q - 2 * L)];
}

static void fill_report(const planar_force *f, contact_report *report)
{
  const planar_cycle *c = &f->cycle;
  *report = (contact_report){.regime = planar_cycle_regime(c)};
  report->free_sliders = report->regime == CONTACT_STUCK;
  for (int i = 0; i < c->n; ++i) {
    const planar_interval *p = &c->interval[i], *next = &c->interval[(i + 1) % c->n];
    const bool meets = next->from == p->to || next->from == p->to - TWO_PI;
    report->transitions += meets ? next->state != p->state : 2;
  }
}

hc_status planar_force_eval(planar_force *f, const double *X, double *F, double *jac, contact_report *report)
{
  double size = 0;
  for (int i = 0; i < f->n_size; ++i) size += fabs(X[i]);
  if (!(size <= TRANSITIONS_LARGEST)) return HC_NOT_FINITE;
  memcpy(f->X, X, (size_t)f->n_size * sizeof *X);
  f->cycle.may_shift = jac != NULL;
  hc_status st = find_orbit(f, f->X);
  if (st == HC_OK) st = integrate(f, jac != NULL);
  if (st != HC_OK) return st;
  put_tangential(f, X, F, jac);
  put_normal(f, F, jac);
  if (report) fill_report(f, report);
  return HC_OK;
}

void planar_force_slider(const planar_force *f, double w[2]) { planar_cycle_slider(&f->cycle, w); }

const planar_cycle *planar_force_cycle(const planar_force *f) { return &f->cycle; }

/* ---- as one of contact_evaluator.h -------------------------------------------------------------------- */

static hc_status make(const contact_coordinates *c, const evaluator_settings *how, void **self)
{
  planar_force *f;
  const hc_status st = planar_force_new(how->n_harm, c->n_dof, &c->moved.law, &f);
  *self = f;
  return st;
}

/* An interval of stick whose slider comes to rest at no angle: monodromy.c moves it. */
static void fill_intervals(planar_force *f)
{
  for (int i = 0; i < f->cycle.n; ++i) {
    const planar_interval *p = &f->cycle.interval[i];
    f->intervals[i] = (contact_interval){.from = p->from, .to = p->to, .state = p->state, .origin = -1};
  }
}

static hc_status evaluate(void *self, const double *X, double *F, double *jac, contact_report *report)
{
  const hc_status st = planar_force_eval(self, X, F, jac, report);
  if (st == HC_OK) fill_intervals(self);
  return st;
}

static const contact_interval *intervals(const void *self, int *n)
{
  const planar_force *f = self;
  *n = f->cycle.n;
  return f->intervals;
}

static void let_go(void *self) { planar_force_free(self); }
static void sliders(const void *self, double *w) { planar_force_slider(self, w); }
static const planar_cycle *in_plane(const void *self) { return planar_force_cycle(self); }

const contact_evaluator planar_force_evaluator = {.make = make,
                                                  .free = let_go,
                                                  .evaluate = evaluate,
                                                  .sliders = sliders,
                                                  .intervals = intervals,
                                                  .in_plane = in_plane};
