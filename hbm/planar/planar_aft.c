/* planar_aft.c - see planar_aft.h.
 *   X -> u_1, u_2, v at th_i = 2 pi i/N -> r -> the slider from sample to sample (planar_slider.h) until it closes
 *     -> T_1, T_2, N - N0 at th_i -> F
 * A period does not increase distances between sliders. If contact is lost, w is forgotten, and the second period is
 * the orbit. If not, periods contract only as far as it slips, perhaps little: after a few of them Newton's step w + (I
 * - A)^-1 (w' - w) aims at the closed orbit, A = dw'/dw being the product of the steps' derivatives; where that does
 * not help, further periods are followed. A slipping orbit is unique: Newton starts from the last motion's. An orbit
 * that slips by rounding only is one of many sticking ones, and depends on its start: w = 0, so that the same X always
 * gives the same forces. */
#include "hbm/planar/planar_aft.h"

#include <string.h>

#include "hbm/contact/fft_plan.h"
#include "hbm/contact/force_jacobian.h"
#include "hbm/planar/planar_rest.h"
#include "hbm/planar/planar_slider.h"
#include "numerics/base/workspace.h"
#include "numerics/dense.h"

enum {
  PLANAR_PLAIN_PASSES = 4, /* periods followed before the first step of Newton */
  PLANAR_AFT_PASSES = 400, /* most periods followed */
  PANEL = 16               /* products added up at once by BLAS */
};

/* How the orbit of the last evaluation was found; decides on what its slider depends. */
typedef enum planar_orbit {
  PLANAR_CLOSED,  /* slips or separates: the unique closed orbit */
  PLANAR_RESTS,   /* sticks, at the place in `rest` */
  PLANAR_DRAGGED, /* sticks, at the place after `passes` periods from w = 0 */
  PLANAR_GUESSED, /* sticks, after periods some of which began at steps of Newton; `last`: start of the last such
                     period */
  PLANAR_ONE_PASS /* one period from w = 0, whether it closes or not */
} planar_orbit;

typedef struct planar_aft {
  int n_dof, n_harm, n_time;
  slider_rule slider;
  contact law;         /* law of one half */
  double *motion[3];   /* [n_time] [length] u_1, u_2 and r (planar_slider.h), a constant if the normal force is */
  double *traction[2]; /* [n_time] [force] */
  period_samples of;
  unsigned char *move; /* [n_time] planar_move of the step to each sample, on the orbit */
  planar_orbit orbit;
  int passes;
  double start[2]; /* [length] slider before sample 0 on the orbit; 0 for PLANAR_ONE_PASS */
  double last[2];  /* [length] see PLANAR_GUESSED */
  double first[2]; /* [length] slider at sample 0 */
  planar_rest rest;
  double asked[2]; /* [length] where the slider was asked to begin: u is counted from there */
  double *X;       /* [n_dof (2H+1)] so counted */
  double *table;   /* of series_grid_table_fill */
  planar_point grid[PLANAR_GRID];
  /* For the Jacobian: n_col = n_dof (2H+1) derivatives by X and two by the slider before sample 0. */
  double *symbol;   /* [4H+1] */
  double *basis[2]; /* [2H+1] harmonics at the previous and at the current sample */
  double *held;     /* [2H+1] sum of the harmonics of samples in contact since w moved last */
  double *by[2];    /* [n_col] derivatives of w_1, w_2 */
  double *whole;    /* [n_col][2 (2H+1)] derivatives of the harmonics of T_1, T_2 */
  int n_panel;      /* number of products harmonic x dw not yet subtracted from `whole`, at most PANEL */
  double *harmonic; /* [PANEL][2H+1] first factors of these products */
  double *moved;    /* [n_col][2][PANEL] second factors */
  workspace memory; /* of all of these */
} planar_aft;

/* Sample i of the motion. The first period starts as in slider.c: out of contact, or with w = 0 moved into the circle
 * at sample 0. */
static inline planar_sample planar_aft_sample(const planar_aft *a, int i)
{
  return (planar_sample){{a->motion[0][i], a->motion[1][i]}, a->motion[2][i]};
}

/* ---- made and freed ------------------------------------------------------------------------------ */

static void planar_aft_let_go(void *self)
{
  planar_aft *a = self;
  if (!a) return;
  period_samples_clear(&a->of);
  workspace_free(&a->memory);
  free(a);
}

static hc_status planar_aft_make(const contact_coordinates *c, const evaluator_settings *how, void **self)
{
  const contact *law = &c->moved.law;
  *self = NULL;
  if (how->n_harm < 1 || how->n_harm > HBM_MAX_HARMONICS || how->n_time < 2 * how->n_harm + 1) return HC_BAD_INPUT;
  if (c->n_dof < 2 || c->n_dof > 3 || !contact_has_friction(law)) return HC_BAD_INPUT;
  planar_aft *a = calloc(1, sizeof *a);
  if (!a) return HC_NO_MEMORY;
  *a =
      (planar_aft){.n_dof = c->n_dof, .n_harm = how->n_harm, .n_time = how->n_time, .slider = how->slider, .law = *law};
  const size_t n = (size_t)a->n_time, length = (size_t)series_length(a->n_harm), n_col = (size_t)a->n_dof * length + 2;
  workspace *w = &a->memory;
  for (int d = 0; d < 3; ++d) a->motion[d] = workspace_doubles(w, n);
  a->move = workspace_array(w, n, sizeof *a->move);
  a->symbol = workspace_doubles(w, (size_t)force_jacobian_symbol_length(a->n_harm));
  for (int d = 0; d < 2; ++d) {
    a->traction[d] = workspace_doubles(w, n);
    a->basis[d] = workspace_doubles(w, length);
    a->by[d] = workspace_doubles(w, n_col);
  }
  a->held = workspace_doubles(w, length);
  a->X = workspace_doubles(w, (size_t)a->n_dof * length);
  a->table = workspace_doubles(w, (size_t)series_grid_table_length(a->n_harm));
  a->whole = workspace_doubles(w, 2 * length * n_col);
  a->harmonic = workspace_doubles(w, PANEL * length);
  a->moved = workspace_doubles(w, 2 * PANEL * n_col);
  const hc_status st = period_samples_make(a->n_harm, a->n_time, &a->memory, &a->of);
  if (st == HC_OK) series_grid_table_fill(a->n_harm, a->table);
  if (st == HC_OK) *self = a;
  else planar_aft_let_go(a);
  return st;
}

/* ---- samples and series ---------------------------------------------------------------------------- */

/* motion[2] from v to r. */
static void radius(planar_aft *a)
{
  const contact *law = &a->law;
  const double per_v = law->mu * law->kn / law->kt, constant = law->mu * law->load / law->kt;
  for (int i = 0; i < a->n_time; ++i) a->motion[2][i] = per_v * (a->motion[2][i] + law->gap) + constant;
}

/* ---- a period ------------------------------------------------------------------------------------- */

static planar_move planar_aft_step(const planar_aft *a, int i, bool entering, double w[2], planar_slope *slope)
{
  const planar_sample from = planar_aft_sample(a, i ? i - 1 : a->n_time - 1), to = planar_aft_sample(a, i);
  if (entering && i == 0 && from.r > 0 && to.r > 0) return planar_slider_enter(&to, w, slope);
  const planar_rule *other = a->slider.in_plane;
  return other ? other->step(&from, &to, w, slope) : planar_slider_step(a->slider.restart, &from, &to, w, slope);
}

typedef struct period {
  bool slips, separates;
  double A[2][2]; /* d(w at the end)/d(w at the start), if differentiated */
} period;

/* Tractions and moves of one period, from w before sample 0 to w at the last one. again: a->traction and a->move hold
 * the previous period, which ended at w; from the sample on at which the slider is where it was then, they are kept. */
static period drag(planar_aft *a, bool entering, bool again, bool differentiated, double w[2])
{
  period p = {.A = {{1, 0}, {0, 1}}};
  planar_slope slope;
  const double end[2] = {w[0], w[1]};
  bool same = false;
  for (int i = 0; i < a->n_time; ++i) {
    if (!same) {
      const planar_move move = planar_aft_step(a, i, entering, w, differentiated ? &slope : NULL);
      const double kt = move == PLANAR_APART ? 0 : a->law.kt;
      same = again && (move != PLANAR_APART || !a->slider.keeps);
      for (int d = 0; d < 2; ++d) {
        const double traction = kt * (a->motion[d][i] - w[d]);
        same &= traction == a->traction[d][i];
        a->traction[d][i] = traction;
      }
      same &= (move == PLANAR_APART) == (a->move[i] == PLANAR_APART);
      a->move[i] = (unsigned char)move;
      if (i == 0) memcpy(a->first, w, sizeof a->first);
      if (same) memcpy(w, end, sizeof end);
    }
    const planar_move move = a->move[i];
    p.slips |= move == PLANAR_SLIPPED;
    p.separates |= move == PLANAR_APART;
    /* A = slope.w A */
    if (differentiated && !same && (move == PLANAR_SLIPPED || move == PLANAR_PLACED)) {
      for (int c = 0; c < 2; ++c) {
        const double a0 = p.A[0][c], a1 = p.A[1][c];
        for (int d = 0; d < 2; ++d) p.A[d][c] = slope.w[d][0] * a0 + slope.w[d][1] * a1;
      }
    }
  }
  return p;
}

/* ---- until it closes -------------------------------------------------------------------------------- */

static bool planar_aft_fixed_point(double A[2][2], const double b[2], double x[2])
{
  const double p = 1 - A[0][0], q = -A[0][1], r = -A[1][0], s = 1 - A[1][1], det = p * s - q * r;
  if (!(fabs(det) > 1e-14)) return false;
  const double b0 = b[0], b1 = b[1];
  x[0] = (s * b0 - q * b1) / det;
  x[1] = (p * b1 - r * b0) / det;
  return true;
}

/* Bound of the slider's error [length], if a period with derivative A misses closing by `missed`. */
static double planar_aft_error(const period *p, double missed)
{
  const double det = (1 - p->A[0][0]) * (1 - p->A[1][1]) - p->A[0][1] * p->A[1][0];
  return missed * (2 + fabs(p->A[0][0]) + fabs(p->A[0][1]) + fabs(p->A[1][0]) + fabs(p->A[1][1])) / fabs(det);
}

/* True if the slider's path over the orbit, always in contact, is longer than `far` [length]. */
static bool slips_far(const planar_aft *a, double far)
{
  double way = 0, before[2] = {0};
  for (int i = -1; i < a->n_time && !(way > far); ++i) {
    const int k = i < 0 ? a->n_time - 1 : i;
    double w[2];
    for (int d = 0; d < 2; ++d) w[d] = a->motion[d][k] - a->traction[d][k] / a->law.kt;
    if (i >= 0) way += hypot(w[0] - before[0], w[1] - before[1]);
    memcpy(before, w, sizeof w);
  }
  return way > far;
}

/* Follows periods until one closes to `enough` [length], or, when no step improves it or after the last one, to `most`.
 * Where slip dies out, a full step of Newton may lead to a place where it sticks: then it returns to the start of that
 * step and takes 9/10 of each. near_orbit: w is the last motion's; HC_NOT_CLOSED unless any other start would lead to
 * the same orbit. */
static hc_status close_orbit(planar_aft *a, bool apart, bool near_orbit, double w[2], double size)
{
  const double enough = 1e-15 * size, most = 1e-12 * (hypot(w[0], w[1]) + size), near = 1e-9 * size,
               alike = 1e-12 * size, far = 1e-6 * size;
  double before = INFINITY, missed = INFINITY, share = 1, back[2] = {0};
  bool guessed = false, stepped = false;
  for (a->passes = 1; a->passes < PLANAR_AFT_PASSES; ++a->passes) {
    memcpy(a->start, w, sizeof a->start);
    const bool guesses = near_orbit || a->passes >= PLANAR_PLAIN_PASSES, again = a->passes > 1 || !near_orbit;
    const period p = drag(a, false, again && !stepped, guesses && !(apart && !a->slider.keeps), w);
    if (stepped && !p.slips && share == 1) {
      share = 0.9, stepped = false, before = missed = INFINITY;
      memcpy(w, back, sizeof back);
      continue;
    }
    const double step[2] = {w[0] - a->start[0], w[1] - a->start[1]};
    missed = hypot(step[0], step[1]);
    a->orbit = p.slips || p.separates ? PLANAR_CLOSED : guessed ? PLANAR_GUESSED : PLANAR_DRAGGED;
    if (missed <= enough || (missed <= most && !(missed < 0.5 * before) && stepped))
      return !near_orbit || (planar_aft_error(&p, missed) <= alike && slips_far(a, far)) ? HC_OK : HC_NOT_CLOSED;
    const bool guess = guesses && (!stepped || missed < 0.5 * before);
    before = missed;
    double change[2];
    stepped = guess && planar_aft_fixed_point((double(*)[2])p.A, step, change);
    if (!stepped) continue;
    if (!guessed || hypot(change[0], change[1]) > near) memcpy(a->last, a->start, sizeof a->last);
    if (!guessed) memcpy(back, w, sizeof back);
    guessed = true;
    for (int d = 0; d < 2; ++d) w[d] = a->start[d] + share * change[d];
  }
  return missed <= most ? HC_OK : HC_NOT_CLOSED;
}

/* ---- rest ----------------------------------------------------------------------------------------------- */

/* True if the restart uses planar_rest.h; plugged-in sliders follow periods, as other programs do. */
static bool rests_where_nearest(const planar_aft *a) { return !a->slider.in_plane && !a->slider.once; }

/* a->rest, from the motion itself: with samples only, the instants whose discs hold the slider would jump between
 * them. */
static hc_status planar_aft_find_rest(planar_aft *a, const double *X)
{
  const int length = series_length(a->n_harm);
  const planar_motion m = planar_motion_make(&a->law, a->n_harm, X, X + length, a->n_dof == 3 ? X + 2 * length : NULL);
  planar_motion_grid(&m, a->table, a->grid);
  return planar_rest_find(&m, a->grid, a->asked[0] != 0 || a->asked[1] != 0, &a->rest);
}

/* The orbit of a slider that stays at a->rest.w. */
static void take_rest(planar_aft *a)
{
  a->orbit = PLANAR_RESTS;
  for (int d = 0; d < 2; ++d) {
    for (int i = 0; i < a->n_time; ++i) a->traction[d][i] = a->law.kt * (a->motion[d][i] - a->rest.w[d]);
    a->start[d] = a->first[d] = a->rest.w[d];
  }
  memset(a->move, PLANAR_HELD, (size_t)a->n_time);
}

/* ---- the force ---------------------------------------------------------------------------------------- */

/* The state at a sample: separated, stuck or slipping. */
static int planar_aft_state(unsigned char move) { return move == PLANAR_PLACED ? PLANAR_HELD : move; }

static void fill_report(const planar_aft *a, contact_report *out)
{
  bool apart = false, touches = false, slips = false;
  *out = (contact_report){.regime = CONTACT_STUCK};
  for (int i = 0; i < a->n_time; ++i) {
    apart |= a->move[i] == PLANAR_APART;
    touches |= a->move[i] != PLANAR_APART;
    slips |= a->move[i] == PLANAR_SLIPPED;
    out->transitions += planar_aft_state(a->move[i]) != planar_aft_state(a->move[i ? i - 1 : a->n_time - 1]);
  }
  if (slips) out->regime = CONTACT_SLIPS;
  if (apart) out->regime = touches ? CONTACT_SEPARATES : CONTACT_LINEAR;
  out->free_sliders = out->regime == CONTACT_STUCK;
}

/* NOLINTNEXTLINE(readability-non-const-parameter): the signature is contact_evaluator.h's */
static hc_status planar_aft_evaluate(void *self, const double *X, double *F, double *jac, contact_report *report)
{
  planar_aft *a = self;
  (void)jac; /* by `jacobian` instead */
  const int length = series_length(a->n_harm);
  double size = 0; /* bounds |u| and |v| */
  for (int i = 0; i < a->n_dof * length; ++i) size += fabs(X[i]);
  if (!isfinite(size)) return HC_NOT_FINITE;
  memcpy(a->X, X, (size_t)(a->n_dof * length) * sizeof *X);
  for (int d = 0; d < 2; ++d) a->X[d * length] -= a->asked[d];
  for (int d = 0; d < a->n_dof; ++d) period_samples_of(&a->of, a->X + d * length, a->motion[d]);
  if (a->n_dof == 2) memset(a->motion[2], 0, (size_t)a->n_time * sizeof(double));
  if (a->n_dof == 3) { /* normal forces of both halves, less N0 */
    for (int i = 0; i < a->n_time; ++i) a->of.sample[i] = 2 * contact_normal_change(&a->law, a->motion[2][i]);
    period_samples_series(&a->of, a->of.sample, a->n_harm, F + 2 * length);
  }
  radius(a);
  double least = a->motion[2][0];
  for (int i = 1; i < a->n_time; ++i) least = fmin(least, a->motion[2][i]);
  const bool apart = !(least > 0);
  const bool once = a->slider.once;
  double w[2] = {a->start[0], a->start[1]};
  const bool near_orbit = a->orbit == PLANAR_CLOSED && !once && !apart;
  hc_status st = near_orbit ? close_orbit(a, apart, true, w, size) : HC_NOT_CLOSED;
  a->rest = (planar_rest){.exists = false};
  if (st != HC_OK || a->orbit != PLANAR_CLOSED) { /* not found from the last motion's orbit */
    st = HC_OK;
    if (!apart && rests_where_nearest(a)) st = planar_aft_find_rest(a, a->X);
    if (st != HC_OK) return st;
    memcpy(w, a->rest.w, sizeof w);
    memcpy(a->start, w, sizeof w);
    a->passes = 0;
    a->orbit = PLANAR_ONE_PASS;
    if (a->rest.exists) take_rest(a);
    else drag(a, true, false, false, w);
    if (!a->rest.exists && !once) st = close_orbit(a, apart, false, w, size);
  }
  if (st != HC_OK) return st;
  for (int d = 0; d < 2; ++d) period_samples_series(&a->of, a->traction[d], a->n_harm, F + d * length);
  if (report) fill_report(a, report);
  return HC_OK;
}

static void planar_aft_sliders(const void *self, double *w)
{
  const planar_aft *a = self;
  for (int d = 0; d < 2; ++d) w[d] = a->first[d] + a->asked[d];
}

static void planar_aft_start(void *self, const double *w)
{
  planar_aft *a = self;
  memcpy(a->asked, w, sizeof a->asked);
  a->orbit = PLANAR_ONE_PASS; /* the last one is counted from elsewhere */
}

static int columns(const planar_aft *a) { return a->n_dof * series_length(a->n_harm); }

/* basis[m] = harmonic m at sample i. */
static void harmonics_at(const planar_aft *a, int i, double *basis)
{
  memset(basis, 0, (size_t)series_length(a->n_harm) * sizeof *basis);
  period_samples_add(&a->of, 1, i, basis);
}

static void empty_panel(planar_aft *a)
{
  const int length = series_length(a->n_harm), n = columns(a) + 2;
  dense_add_product(length, 2 * n, a->n_panel, -1, a->harmonic, length, a->moved, PANEL, 1, a->whole, length);
  a->n_panel = 0;
}

/* whole -= kt dw at several samples, `sum` being the sum of their harmonics; queued until empty_panel. */
static void planar_aft_subtract(planar_aft *a, const double *restrict sum)
{
  const int length = series_length(a->n_harm), n = columns(a) + 2;
  const double scale = 2 * a->law.kt / a->n_time;
  double *harmonic = a->harmonic + (size_t)a->n_panel * (size_t)length, *moved = a->moved + a->n_panel;
  memcpy(harmonic, sum, (size_t)length * sizeof *sum);
  harmonic[0] *= 0.5;
  for (int q = 0; q < n; ++q)
    for (int d = 0; d < 2; ++d) moved[(2 * q + d) * PANEL] = scale * a->by[d][q];
  if (++a->n_panel == PANEL) empty_panel(a);
}

static void subtract_held(planar_aft *a)
{
  const size_t bytes = (size_t)series_length(a->n_harm) * sizeof(double);
  if (a->held[0] == 0) return; /* no sample */
  planar_aft_subtract(a, a->held);
  memset(a->held, 0, bytes);
}

static void clear_rows(planar_aft *a)
{
  for (int d = 0; d < 2; ++d) memset(a->by[d], 0, ((size_t)columns(a) + 2) * sizeof(double));
}

/* Derivatives over the step to sample i; forces: also those of T there. */
static void differentiate_step(planar_aft *a, int i, planar_move move, const planar_slope *slope, bool forces)
{
  if (move != PLANAR_HELD && forces) subtract_held(a);
  if (move == PLANAR_APART && !a->slider.keeps) clear_rows(a);
  if (move == PLANAR_SLIPPED || move == PLANAR_PLACED) {
    harmonics_at(a, i ? i - 1 : a->n_time - 1, a->basis[0]);
    harmonics_at(a, i, a->basis[1]);
    /* by = slope of the step applied to it, and to the motion at the samples before and after. */
    const int stride = series_length(a->n_harm), n = columns(a);
    const double radius = a->law.mu * a->law.kn / a->law.kt;
    double *by[2] = {a->by[0], a->by[1]};
    for (int q = 0; q < n + 2; ++q) {
      const double b0 = by[0][q], b1 = by[1][q];
      for (int d = 0; d < 2; ++d) by[d][q] = slope->w[d][0] * b0 + slope->w[d][1] * b1;
    }
    for (int d = 0; d < 2; ++d)
      for (int c = 0; c < a->n_dof; ++c) {
        const double weight = c < 2 ? 1 : radius, from = weight * slope->from[d][c], to = weight * slope->to[d][c];
        double *row = by[d] + c * stride;
        for (int m = 0; m < stride; ++m) row[m] += from * a->basis[0][m] + to * a->basis[1][m];
      }
  }
  if (!forces) return;
  if (move == PLANAR_SLIPPED) planar_aft_subtract(a, a->basis[1]);
  else if (move != PLANAR_APART) period_samples_add(&a->of, 1, i, a->held);
}

/* Derivatives over a period from the slider w; forces: the period is the orbit, whose moves are in a->move, and those
 * of T are added. */
static void differentiate_period(planar_aft *a, bool entering, double w[2], bool forces)
{
  planar_slope slope;
  for (int i = 0; i < a->n_time; ++i) {
    const bool held = forces && a->move[i] == PLANAR_HELD;
    const planar_move move = held ? PLANAR_HELD : planar_aft_step(a, i, entering, w, &slope);
    differentiate_step(a, i, move, &slope, forces);
  }
  if (forces) {
    subtract_held(a);
    empty_panel(a);
  }
}

static void start_rows(planar_aft *a)
{
  clear_rows(a);
  a->by[0][columns(a)] = a->by[1][columns(a) + 1] = 1;
}

/* by[d][q] = derivative by X of the fixed point of a period with these derivatives. False if I - A is singular: any
 * slider returns. */
static bool close_rows(planar_aft *a)
{
  const int n = columns(a);
  double A[2][2] = {{a->by[0][n], a->by[0][n + 1]}, {a->by[1][n], a->by[1][n + 1]}};
  bool closed = true;
  for (int q = 0; q < n && closed; ++q) {
    double b[2] = {a->by[0][q], a->by[1][q]};
    closed = planar_aft_fixed_point(A, b, b);
    a->by[0][q] = b[0];
    a->by[1][q] = b[1];
  }
  return closed;
}

/* by = dw/dX in a->rest. */
static void rows_of_rest(planar_aft *a)
{
  const planar_rest *r = &a->rest;
  const double per_v = a->law.mu * a->law.kn / a->law.kt;
  for (int d = 0; d < a->n_dof; ++d)
    for (int m = 0; m < series_length(a->n_harm); ++m) {
      const int h = (m + 1) / 2;
      planar_disc_change change[3] = {{0}};
      double dw[2];
      for (int i = 0; i < r->n; ++i) {
        const double *e = r->e[i], c = cos(h * r->at[i].th), s = sin(h * r->at[i].th);
        const double at = m % 2 == 1 || m == 0 ? c : s, rate = m % 2 == 1 || m == 0 ? -h * s : h * c;
        const double away = d == 0 ? e[0] : d == 1 ? e[1] : -per_v;
        change[i] = (planar_disc_change){.away = at * away,
                                         .across = at * (d == 0   ? -e[1]
                                                         : d == 1 ? e[0]
                                                                  : 0),
                                         .radius = d < 2 ? 0 : at * per_v,
                                         .rate = rate * away};
      }
      planar_rest_move(r, change, dw);
      for (int k = 0; k < 2; ++k) a->by[k][d * series_length(a->n_harm) + m] = dw[k];
    }
}

/* by = dw_0/dX of an orbit that sticks where earlier periods ended. */
static void rows_of_history(planar_aft *a)
{
  double w[2] = {0};
  if (a->orbit == PLANAR_GUESSED) {
    memcpy(w, a->last, sizeof w);
    start_rows(a);
    differentiate_period(a, false, w, false);
    if (close_rows(a)) return;
    w[0] = w[1] = 0;
  }
  clear_rows(a);
  for (int pass = 0; pass < a->passes; ++pass) differentiate_period(a, pass == 0, w, false);
}

/* whole by X += (whole by w_0) dw_0/dX. */
static void add_start(planar_aft *a)
{
  const int n = columns(a), rows = 2 * series_length(a->n_harm);
  const double *by_start[2] = {a->whole + (size_t)n * (size_t)rows, a->whole + ((size_t)n + 1) * (size_t)rows};
  for (int q = 0; q < n; ++q)
    for (int d = 0; d < 2; ++d) {
      const double weight = a->by[d][q];
      double *to = a->whole + (size_t)q * (size_t)rows;
      for (int p = 0; p < rows && weight != 0; ++p) to[p] += weight * by_start[d][p];
    }
}

/* jac += the matrix of a stiffness that acts at the samples in contact, from a coordinate to its own force. */
static void add_contact_stiffness(planar_aft *a, double stiffness, int d, double *jac)
{
  const size_t length = (size_t)series_length(a->n_harm), ld = (size_t)columns(a);
  for (int i = 0; i < a->n_time; ++i) a->of.sample[i] = a->move[i] == PLANAR_APART ? 0 : stiffness;
  period_samples_series(&a->of, a->of.sample, 2 * a->n_harm, a->symbol);
  force_jacobian_add(a->n_harm, a->symbol, (int)ld, jac + (ld + 1) * (size_t)d * length);
}

static void planar_aft_jacobian(void *self, double *jac)
{
  planar_aft *a = self;
  const size_t n = (size_t)columns(a), rows = 2 * (size_t)series_length(a->n_harm);
  double w[2] = {a->start[0], a->start[1]};
  memset(a->whole, 0, rows * (n + 2) * sizeof(double));
  start_rows(a);
  differentiate_period(a, a->orbit == PLANAR_ONE_PASS, w, true);
  const bool closed = a->orbit == PLANAR_CLOSED && close_rows(a);
  if (a->orbit == PLANAR_ONE_PASS) clear_rows(a);
  else if (a->orbit == PLANAR_RESTS) rows_of_rest(a);
  else if (!closed) rows_of_history(a);
  add_start(a);
  memset(jac, 0, n * n * sizeof(double));
  for (size_t q = 0; q < n; ++q) memcpy(jac + q * n, a->whole + q * rows, rows * sizeof(double));
  for (int d = 0; d < 2; ++d) add_contact_stiffness(a, a->law.kt, d, jac);
  if (a->n_dof == 3) add_contact_stiffness(a, 2 * a->law.kn, 2, jac);
}

const contact_evaluator planar_aft_evaluator = {.make = planar_aft_make,
                                                .free = planar_aft_let_go,
                                                .evaluate = planar_aft_evaluate,
                                                .jacobian = planar_aft_jacobian,
                                                .sliders = planar_aft_sliders,
                                                .start = planar_aft_start};
