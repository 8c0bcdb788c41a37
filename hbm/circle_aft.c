/* circle_aft.c - see circle_aft.h; its Jacobian is in circle_aft_jacobian.c.
 *   X -> u_1, u_2, v at th_i = 2 pi i/N -> r -> the slider from sample to sample (circle_slider.h) until it closes
 *     -> T_1, T_2, N - N0 at th_i -> F
 * A period maps w to w no farther apart. Once out of contact all is forgotten, and the second period is the orbit.
 * Where contact is kept the periods contract as far as it slips, perhaps little: after a few of them Newton's step goes
 * to where the period would close, w + (I - A)^-1 (w' - w), A = dw'/dw the product of the steps'. Where that does not
 * bring it nearer, it is dragged on. FFTW does not normalise and uses exp(-i): see aft.c. */
#include "hbm/circle_aft.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "hbm/circle_aft_impl.h"
#include "hbm/force_jacobian.h"
#include "numerics/series.h"

/* ---- made and freed ------------------------------------------------------------------------------ */

static hc_status make_plans(circle_aft *a)
{
  hc_status st = fft_plan_to_samples(a->n_time, a->spec, a->motion[0], &a->to_time);
  return st == HC_OK ? fft_plan_to_spectrum(a->n_time, a->sample, a->spec, &a->to_freq) : st;
}

static hc_status make_samples(circle_aft *a)
{
  const size_t n = (size_t)a->n_time;
  bool room = true;
  for (int d = 0; d < 3; ++d) room &= (a->motion[d] = fftw_alloc_real(n)) != NULL;
  for (int d = 0; d < 2; ++d) room &= (a->traction[d] = calloc(n, sizeof(double))) != NULL;
  room &= (a->sample = fftw_alloc_real(n)) != NULL;
  room &= (a->spec = fftw_alloc_complex(n / 2 + 1)) != NULL;
  room &= (a->root = malloc(n * sizeof *a->root)) != NULL;
  room &= (a->move = calloc(n, sizeof *a->move)) != NULL;
  if (!room) return HC_NO_MEMORY;
  for (int i = 0; i < a->n_time; ++i) a->root[i] = cos(i * (TWO_PI / a->n_time)) + I * sin(i * (TWO_PI / a->n_time));
  return HC_OK;
}

static hc_status make_tables(circle_aft *a)
{
  const size_t length = (size_t)series_length(a->n_harm), n_col = (size_t)a->n_dof * length + 2;
  bool room = (a->symbol = calloc((size_t)force_jacobian_symbol_length(a->n_harm), sizeof(double))) != NULL;
  for (int d = 0; d < 2; ++d) {
    room &= (a->basis[d] = calloc(length, sizeof(double))) != NULL;
    room &= (a->by[d] = calloc(n_col, sizeof(double))) != NULL;
  }
  room &= (a->held = calloc(length, sizeof(double))) != NULL;
  room &= (a->whole = calloc(2 * length * n_col, sizeof(double))) != NULL;
  return room ? HC_OK : HC_NO_MEMORY;
}

hc_status circle_aft_new(int n_harm, int n_time, hbm_restart restart, int n_dof, const contact *law, circle_aft **out)
{
  *out = NULL;
  if (n_harm < 1 || n_harm > HBM_MAX_HARMONICS || n_time < 2 * n_harm + 1) return HC_BAD_INPUT;
  if (n_dof < 2 || n_dof > 3 || !contact_has_friction(law)) return HC_BAD_INPUT;
  circle_aft *a = calloc(1, sizeof *a);
  if (!a) return HC_NO_MEMORY;
  a->n_dof = n_dof;
  a->n_harm = n_harm;
  a->n_time = n_time;
  a->restart = restart;
  a->law = *law;
  hc_status st = make_samples(a);
  if (st == HC_OK) st = make_tables(a);
  if (st == HC_OK) st = make_plans(a);
  if (st == HC_OK) *out = a;
  else circle_aft_free(a);
  return st;
}

void circle_aft_free(circle_aft *a)
{
  if (!a) return;
  fft_plan_free(a->to_time);
  fft_plan_free(a->to_freq);
  for (int d = 0; d < 3; ++d) fftw_free(a->motion[d]);
  for (int d = 0; d < 2; ++d) {
    free(a->traction[d]);
    free(a->basis[d]);
    free(a->by[d]);
  }
  fftw_free(a->sample);
  fftw_free(a->spec);
  free(a->root);
  free(a->move);
  free(a->symbol);
  free(a->held);
  free(a->whole);
  free(a);
}

/* ---- samples and series ---------------------------------------------------------------------------- */

static void to_samples(circle_aft *a, const double *X, double *samples)
{
  memset(a->spec, 0, ((size_t)a->n_time / 2 + 1) * sizeof *a->spec);
  a->spec[0] = X[0];
  for (int h = 1; h <= a->n_harm; ++h) a->spec[h] = 0.5 * (X[2 * h - 1] - I * X[2 * h]);
  fftw_execute_dft_c2r(a->to_time, a->spec, samples);
}

/* Above N/2 a harmonic reads its alias, as the sampled sums themselves do. */
void circle_aft_to_series(circle_aft *a, int n_harm, double *out)
{
  const int n = a->n_time;
  fftw_execute(a->to_freq);
  out[0] = creal(a->spec[0]) / n;
  for (int h = 1; h <= n_harm; ++h) {
    const double complex z = h <= n / 2 ? a->spec[h] : conj(a->spec[n - h]);
    out[2 * h - 1] = 2 * creal(z) / n;
    out[2 * h] = -2 * cimag(z) / n;
  }
}

/* F_v: the normal forces of both halves, less what they are at rest; a->sample gets them from v. */
static void normal_to_series(circle_aft *a, double *F)
{
  for (int i = 0; i < a->n_time; ++i) a->sample[i] = 2 * contact_normal_change(&a->law, a->motion[2][i]);
  circle_aft_to_series(a, a->n_harm, F);
}

/* motion[2] from v to r. */
static void radius(circle_aft *a)
{
  const contact *law = &a->law;
  const double per_v = law->mu * law->kn / law->kt, constant = law->mu * law->load / law->kt;
  for (int i = 0; i < a->n_time; ++i) a->motion[2][i] = per_v * (a->motion[2][i] + law->gap) + constant;
}

/* ---- a period ------------------------------------------------------------------------------------- */

circle_move circle_aft_step(const circle_aft *a, int i, bool entering, double w[2], circle_slope *slope)
{
  const circle_sample from = circle_aft_sample(a, i ? i - 1 : a->n_time - 1), to = circle_aft_sample(a, i);
  if (entering && i == 0 && from.r > 0 && to.r > 0) return circle_slider_enter(&to, w, slope);
  return circle_slider_step(a->restart, &from, &to, w, slope);
}

/* A = slope.w A */
static void chain(const circle_slope *slope, double A[2][2])
{
  for (int c = 0; c < 2; ++c) {
    const double a0 = A[0][c], a1 = A[1][c];
    for (int d = 0; d < 2; ++d) A[d][c] = slope->w[d][0] * a0 + slope->w[d][1] * a1;
  }
}

typedef struct period {
  bool slips, separates;
  double A[2][2]; /* dw at the end/dw at the start; not where it separates and forgets */
} period;

/* Tractions and moves of one period, from w before sample 0 to w at the last one. */
static period drag(circle_aft *a, bool entering, bool apart_somewhere, double w[2])
{
  period p = {.A = {{1, 0}, {0, 1}}};
  circle_slope slope;
  const bool differentiated = !(apart_somewhere && circle_slider_forgets(a->restart));
  for (int i = 0; i < a->n_time; ++i) {
    const circle_move move = circle_aft_step(a, i, entering, w, differentiated ? &slope : NULL);
    const double kt = move == CIRCLE_APART ? 0 : a->law.kt;
    a->move[i] = (unsigned char)move;
    for (int d = 0; d < 2; ++d) a->traction[d][i] = kt * (a->motion[d][i] - w[d]);
    if (i == 0) memcpy(a->first, w, sizeof a->first);
    p.slips |= move == CIRCLE_SLIPPED;
    p.separates |= move == CIRCLE_APART;
    if (differentiated && (move == CIRCLE_SLIPPED || move == CIRCLE_PLACED)) chain(&slope, p.A);
  }
  return p;
}

/* ---- until it closes -------------------------------------------------------------------------------- */

bool circle_aft_fixed_point(double A[2][2], const double b[2], double x[2])
{
  const double p = 1 - A[0][0], q = -A[0][1], r = -A[1][0], s = 1 - A[1][1], det = p * s - q * r;
  if (!(fabs(det) > 1e-14)) return false;
  const double b0 = b[0], b1 = b[1];
  x[0] = (s * b0 - q * b1) / det;
  x[1] = (p * b1 - r * b0) / det;
  return true;
}

static bool separates_somewhere(const circle_aft *a)
{
  double least = a->motion[2][0];
  for (int i = 1; i < a->n_time; ++i) least = fmin(least, a->motion[2][i]);
  return !(least > 0);
}

/* What the orbit is, of which `p` was the last period and began at a->start. */
static circle_orbit orbit_of(const period *p, bool guessed)
{
  if (p->slips || p->separates) return CIRCLE_CLOSED;
  return guessed ? CIRCLE_GUESSED : CIRCLE_DRAGGED;
}

/* Periods until one ends where it began, to `enough` [length]; at the end of the last one, to `most`. */
static hc_status close_orbit(circle_aft *a, bool apart, double w[2], double enough, double most)
{
  double before = INFINITY, missed = INFINITY;
  bool guessed = false, stepped = false;
  for (a->passes = 1; a->passes < CIRCLE_AFT_PASSES; ++a->passes) {
    memcpy(a->start, w, sizeof a->start);
    const period p = drag(a, false, apart, w);
    const double step[2] = {w[0] - a->start[0], w[1] - a->start[1]};
    missed = hypot(step[0], step[1]);
    a->orbit = orbit_of(&p, guessed);
    if (missed <= enough || (missed <= most && !(missed < 0.5 * before) && stepped)) return HC_OK;
    if (p.slips) memcpy(a->last, a->start, sizeof a->last);
    const bool guess = a->passes >= CIRCLE_PLAIN_PASSES && (!stepped || missed < 0.5 * before);
    before = missed;
    double change[2];
    stepped = guess && circle_aft_fixed_point((double(*)[2])p.A, step, change);
    if (stepped)
      for (int d = 0; d < 2; ++d) w[d] = a->start[d] + change[d];
    guessed |= stepped;
  }
  return missed <= most ? HC_OK : HC_NOT_CLOSED;
}

static hc_status follow(circle_aft *a, double size)
{
  const bool apart = separates_somewhere(a);
  const bool once = a->restart == HBM_RESTART_ONE_PASS || a->restart == HBM_RESTART_ONE_PASS_SAMPLE;
  double w[2] = {0};
  a->passes = 0;
  a->orbit = CIRCLE_ONE_PASS;
  memset(a->start, 0, sizeof a->start);
  drag(a, true, apart, w);
  return once ? HC_OK : close_orbit(a, apart, w, 1e-15 * size, 1e-12 * (hypot(w[0], w[1]) + size));
}

/* ---- the force ---------------------------------------------------------------------------------------- */

/* Of the state at each sample: not of contact, stuck, slipping. */
static int state_of(unsigned char move) { return move == CIRCLE_PLACED ? CIRCLE_HELD : move; }

static void fill_report(const circle_aft *a, contact_report *out)
{
  bool apart = false, touches = false, slips = false;
  *out = (contact_report){.regime = CONTACT_STUCK};
  for (int i = 0; i < a->n_time; ++i) {
    apart |= a->move[i] == CIRCLE_APART;
    touches |= a->move[i] != CIRCLE_APART;
    slips |= a->move[i] == CIRCLE_SLIPPED;
    out->transitions += state_of(a->move[i]) != state_of(a->move[i ? i - 1 : a->n_time - 1]);
  }
  if (slips) out->regime = CONTACT_SLIPS;
  if (apart) out->regime = touches ? CONTACT_SEPARATES : CONTACT_LINEAR;
  out->free_sliders = out->regime == CONTACT_STUCK;
}

hc_status circle_aft_eval(circle_aft *a, const double *X, double *F, contact_report *report)
{
  const int length = series_length(a->n_harm);
  double size = 0; /* bounds |u| and |v| */
  for (int i = 0; i < a->n_dof * length; ++i) size += fabs(X[i]);
  if (!isfinite(size)) return HC_NOT_FINITE;
  for (int d = 0; d < a->n_dof; ++d) to_samples(a, X + d * length, a->motion[d]);
  if (a->n_dof == 2) memset(a->motion[2], 0, (size_t)a->n_time * sizeof(double));
  if (a->n_dof == 3) normal_to_series(a, F + 2 * length);
  radius(a);
  const hc_status st = follow(a, size);
  if (st != HC_OK) return st;
  for (int d = 0; d < 2; ++d) {
    memcpy(a->sample, a->traction[d], (size_t)a->n_time * sizeof(double));
    circle_aft_to_series(a, a->n_harm, F + d * length);
  }
  if (report) fill_report(a, report);
  return HC_OK;
}

void circle_aft_slider(const circle_aft *a, double w[2]) { memcpy(w, a->first, sizeof a->first); }

/* ---- as one of contact_kind.h -------------------------------------------------------------------- */

static hc_status make(const contact_coordinates *c, const evaluator_settings *how, void **self)
{
  circle_aft *a;
  const hc_status st = circle_aft_new(how->n_harm, how->n_time, how->restart, c->n_dof, &c->moved.law, &a);
  *self = a;
  return st;
}

static hc_status evaluate(void *self, const double *X, double *F, double *jac, contact_report *report)
{
  (void)jac; /* `jacobian` makes it */
  return circle_aft_eval(self, X, F, report);
}

static void let_go(void *self) { circle_aft_free(self); }
static void jacobian(void *self, double *jac) { circle_aft_jacobian(self, jac); }
static void sliders(const void *self, double *w) { circle_aft_slider(self, w); }

const contact_evaluator circle_aft_evaluator = {
    .make = make, .free = let_go, .evaluate = evaluate, .jacobian = jacobian, .sliders = sliders};
