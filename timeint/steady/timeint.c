/* timeint.c - see timeint.h and timeint_private.h: makes the handle; converts states between the model's units and
 * those of scaled.h; one period of the motion. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "timeint/closed_form/integrate_closed_form.h"
#include "timeint/cvode/integrate_events.h"
#include "timeint/cvode/integrate_regularised.h"
#include "timeint/steady/richardson.h"
#include "timeint/steady/scout.h"
#include "timeint/steady/shoot.h"
#include "timeint/steady/timeint_private.h"

enum { MOST_STATES = 40000 }; /* their square, the size of a monodromy matrix (13 GB), is an int */

static bool positive(double a) { return a > 0 && a <= DBL_MAX; } /* not NaN, not infinite */
static bool not_negative(double a) { return a >= 0 && a <= DBL_MAX; }

static bool contact_ok(const model_contact *c)
{
  return not_negative(c->law.kt) && not_negative(c->law.kn) && not_negative(c->law.mu) && isfinite(c->law.gap) &&
         not_negative(c->law.load) && isfinite(*c->tangent) && isfinite(*c->normal);
}

static bool all_finite(size_t count, const double *a)
{
  bool ok = true;
  for (size_t i = 0; i < count; ++i) ok = ok && isfinite(a[i]);
  return ok;
}

static bool structure_ok(const model *m)
{
  const size_t n = (size_t)m->n;
  if (m->n == 1 && !(positive(*m->mass) && not_negative(*m->damping) && not_negative(*m->stiffness))) return false;
  bool ok = all_finite(n * n, m->mass) && all_finite(n * n, m->damping) && all_finite(n * n, m->stiffness);
  for (int l = 0; l < m->n_loads; ++l) ok = ok && all_finite(n, m->loads[l].cosine) && all_finite(n, m->loads[l].sine);
  for (int j = 0; j < m->n_contacts; ++j)
    ok = ok && all_finite(n, m->contacts[j].tangent) && all_finite(n, m->contacts[j].normal);
  return ok && m->n_responses > 0;
}

static hc_status check_input(const model *m, const transient_settings *how)
{
  if (!structure_ok(m)) return HC_BAD_INPUT;
  for (int j = 0; j < m->n_contacts; ++j)
    if (!contact_ok(&m->contacts[j])) return HC_BAD_INPUT;
  if (how->method == TRANSIENT_METHOD_CLOSED_FORM && how->law != TRANSIENT_LAW_EXACT) return HC_BAD_INPUT;
  if (!positive(how->regularisation) || !positive(how->tolerance) || how->max_periods < 1) return HC_BAD_INPUT;
  return HC_OK;
}

static hc_status make_memory(timeint *ti)
{
  double **const vectors[] = {&ti->y,          &ti->saved,       &ti->direction, &ti->neighbour,
                              &ti->separation, &ti->scout_state, &ti->point[0],  &ti->point[1],
                              &ti->point[2],   &ti->began,       &ti->past};
  const size_t n = (size_t)ti->n, n_vectors = sizeof vectors / sizeof *vectors;
  ti->memory = calloc((n_vectors - 1 + SETTLE_MAX_MULTIPLE) * n, sizeof *ti->memory);
  ti->scaled.contact = calloc(n, sizeof *ti->scaled.contact); /* two more than needed, so never nothing */
  if (!ti->memory || !ti->scaled.contact) return HC_NO_MEMORY;
  for (size_t i = 0; i < n_vectors; ++i) *vectors[i] = ti->memory + i * n; /* the ring is the last */
  return measure_make(&ti->measure, ti->n, ti->base->n_responses, ti->model->n_contacts);
}

static hc_status make_integrator(const timeint *ti, transient_law law, integrator **out)
{
  const bool closed = ti->how.method == TRANSIENT_METHOD_CLOSED_FORM, exact = law == TRANSIENT_LAW_EXACT;
  if (closed) return integrate_new_series(ti->base, PHASE_MODES_STIFF, out);
  return (exact ? integrate_new_events : integrate_new_regularised)(ti->base, ti->tolerance, out);
}

static hc_status make_parts(timeint *ti)
{
  const bool exact = ti->how.law == TRANSIENT_LAW_EXACT;
  hc_status st = make_memory(ti);
  if (st == HC_OK) st = make_integrator(ti, ti->how.law, &ti->in);
  if (st == HC_OK && !exact && !ti->how.scout) st = make_integrator(ti, TRANSIENT_LAW_EXACT, &ti->exact);
  if (st == HC_OK) st = settle_new(ti->n, &ti->settle);
  if (st == HC_OK) st = shoot_new(ti, &ti->shoot);
  if (st == HC_OK) st = richardson_new(ti);
  return st == HC_OK ? scout_new(ti) : st;
}

hc_status timeint_new(const model *m, const transient_settings *how, timeint **out)
{
  *out = NULL;
  hc_status st = check_input(m, how);
  if (st != HC_OK) return st;
  if (m->n_contacts > MOST_STATES - 2 * m->n) return HC_NO_MEMORY;
  timeint *ti = calloc(1, sizeof *ti); /* zeroed, so free works half-built */
  if (!ti) return HC_NO_MEMORY;
  ti->how = *how;
  ti->n_dof = m->n;
  ti->n = 2 * m->n + m->n_contacts;
  ti->tolerance = timeint_final_tolerance(ti);
  st = model_copy(m, &ti->model);
  if (st == HC_OK) st = modal_base_new(m, &ti->base);
  ti->scaled.base = ti->base;
  if (st == HC_OK && (st = make_parts(ti)) == HC_OK) {
    *out = ti;
    return HC_OK;
  }
  timeint_free(ti);
  return st;
}

void timeint_free(timeint *ti)
{
  if (!ti) return;
  scout_free(ti);
  shoot_free(ti->shoot);
  settle_free(ti->settle);
  integrate_free(ti->exact);
  integrate_free(ti->in);
  measure_free(&ti->measure);
  free(ti->scaled.contact);
  free(ti->memory);
  free(ti->extrapolated);
  modal_base_free(ti->base);
  model_free(ti->model);
  free(ti);
}

void timeint_count(const timeint *ti, long *by_cvode, long *closed_form)
{
  const bool closed = ti->how.method == TRANSIENT_METHOD_CLOSED_FORM;
  const long own = integrate_periods(ti->in);
  *by_cvode = (closed ? 0 : own) + (ti->exact ? integrate_periods(ti->exact) : 0);
  *closed_form = (closed ? own : 0) + (ti->scout ? integrate_periods(ti->scout->in) : 0);
}

int timeint_n_states(const timeint *ti) { return ti->n; }

void timeint_rest(const timeint *ti, double *state) /* x = 0 is static equilibrium without the static loads */
{
  for (int i = 0; i < ti->n; ++i) state[i] = 0;
}

/* The unit of length for a model at rest without force: the largest gap, or 1. */
static double any_length(const model *m)
{
  double length = 0;
  for (int j = 0; j < m->n_contacts; ++j) length = fmax(length, fabs(m->contacts[j].law.gap));
  return length > 0 ? length : 1;
}

static void set_length(timeint *ti, double length)
{
  const double ratio = ti->length / length;
  for (int i = 0; i < ti->scaled.n_states; ++i) ti->y[i] *= ratio;
  ti->length = length;
  scaled_make(&ti->scaled, ti->model, &ti->how, ti->omega, length);
}

static bool state_ok(const timeint *ti, const double *state)
{
  bool ok = true;
  for (int i = 0; i < ti->n; ++i) ok = ok && isfinite(state[i]);
  return ok;
}

/* No response is smaller than the force over the sum of all that resists it, but at an antiresonance, and a single mass
 * has none; nor have all modes together. */
static double least_length(const timeint *ti)
{
  const modal_base *b = ti->base;
  const double omega = ti->omega;
  double force = 0;
  for (int i = 0; i < b->n_loads * b->n; ++i) force += hypot(b->cosine[i], b->sine[i]);
  return force / (b->highest * b->highest + omega * omega + 2 * b->slowest * omega);
}

/* X, P and W of the state, in units of `length`. */
static void take_state(const timeint *ti, const double *state, double length, double *y)
{
  const int n = ti->n_dof;
  modal_base_to_modes(ti->base, state, y);
  modal_base_to_modes(ti->base, state + n, y + n);
  for (int i = 0; i < n; ++i) {
    y[i] /= length;
    y[n + i] /= ti->omega * length;
  }
  for (int i = 2 * n; i < ti->n; ++i) y[i] = state[i] / length;
}

void timeint_take_state(const timeint *ti, const double *state, double *y) { take_state(ti, state, ti->length, y); }

static double size_of(const timeint *ti)
{
  double size = 0;
  for (int i = 0; i < 2 * ti->n_dof; ++i) size = hypot(size, ti->y[i]);
  return size;
}

hc_status timeint_begin(timeint *ti, double omega, const double *state)
{
  const model *m = ti->model;
  if (!positive(omega) || !state_ok(ti, state)) return HC_BAD_INPUT;
  ti->omega = omega;
  ti->measured = ti->is_extrapolated = false;
  ti->contraction = exp(-TWO_PI * ti->base->slowest / omega);
  ti->periods = 0;
  ti->steps0 = integrate_steps(ti->in);
  ti->rhs0 = integrate_rhs(ti->in);
  ti->least_length = least_length(ti);
  take_state(ti, state, 1, ti->y);
  double length = fmax(ti->least_length, size_of(ti));
  if (!(length > 0)) length = any_length(m);
  if (!(ti->least_length > 0)) ti->least_length = length;
  ti->length = length;
  take_state(ti, state, length, ti->y);
  scaled_make(&ti->scaled, m, &ti->how, omega, length);
  return HC_OK;
}

void timeint_regularise(timeint *ti, double regularisation)
{
  ti->how.regularisation = regularisation;
  scaled_make(&ti->scaled, ti->model, &ti->how, ti->omega, ti->length);
}

hc_status timeint_set_tolerance(timeint *ti, double tolerance)
{
  ti->tolerance = tolerance;
  return integrate_tolerance(ti->in, tolerance);
}

/* The unit stays within a factor of 4 of the motion's size. CVODE's absolute tolerance is in this unit, and needs to be
 * in proportion to the motion to no better than that. */
static void follow_length(timeint *ti)
{
  double size = timeint_motion_size(ti);
  if (size > 4 * ti->length || size < 0.25 * ti->length) set_length(ti, size);
}

const hc_monitor *timeint_hear(timeint *ti, const hc_monitor *monitor)
{
  if (ti->scout) timeint_hear(ti->scout, monitor);
  if (ti->exact) integrate_hear(ti->exact, monitor);
  return integrate_hear(ti->in, monitor);
}

hc_status timeint_period(timeint *ti, bool measured)
{
  if (measured) measure_period(&ti->measure, ti->y);
  hc_status st = integrate_period(ti->in, &ti->scaled, ti->y, measured ? measure_step : NULL, &ti->measure);
  ti->measured = false;
  if (st != HC_OK) return st;
  ++ti->periods;
  if (!measured) follow_length(ti); /* all periods of a measurement are in one unit */
  return HC_OK;
}

void timeint_get_state(const timeint *ti, double *state)
{
  const int n = ti->n_dof;
  const double length = ti->length;
  modal_base_to_model(ti->base, ti->y, state);
  modal_base_to_model(ti->base, ti->y + n, state + n);
  for (int i = 0; i < n; ++i) {
    state[i] *= length;
    state[n + i] = state[n + i] * length * ti->omega;
  }
  for (int j = 0; j < ti->model->n_contacts; ++j) {
    double u, v;
    scaled_contact_motion(&ti->scaled, j, ti->y, &u, &v);
    state[2 * n + j] = (ti->scaled.contact[j].law.has_friction ? ti->y[2 * n + j] : u) * length;
  }
}

void timeint_save(timeint *ti) { memcpy(ti->saved, ti->y, sizeof *ti->y * (size_t)ti->n); }
void timeint_restore(timeint *ti) { memcpy(ti->y, ti->saved, sizeof *ti->y * (size_t)ti->n); }

double timeint_size(const timeint *ti) { return size_of(ti) * ti->length; }
double timeint_motion_size(const timeint *ti) { return fmax(timeint_size(ti), ti->least_length); }

void timeint_point(const timeint *ti, double *z)
{
  const scaled_model *m = &ti->scaled;
  const int moving = 2 * ti->n_dof;
  const double stiffest = ti->base->highest * ti->base->highest / (ti->omega * ti->omega);
  for (int i = 0; i < moving; ++i) z[i] = ti->y[i] * ti->length;
  for (int j = 0; j < m->n_contacts; ++j) {
    const scaled_contact *c = &m->contact[j];
    const double pull = c->law.kt * scaled_pull(m, j);
    z[moving + j] = c->law.has_friction ? pull / stiffest * ti->y[moving + j] * ti->length : 0.0;
  }
}

/* Measured: with CVODE restarted each period, the states of a settled orbit scatter by 20 to 250 times its tolerance,
 * since each period is cut into other steps, and the error at a corner depends on where the step that contains it
 * begins. A scatter of s a period adds up to s/sqrt(2 (1 - rho)) where the contraction rho is close to 1. Hence
 * tolerance/1000, times sqrt(1 - rho), and not below 1e-14, where rounding is larger; never above 1e-6, where steps
 * pass over whole contacts. */
double timeint_final_tolerance(const timeint *ti)
{
  if (ti->how.method == TRANSIENT_METHOD_CLOSED_FORM) return 1e-14; /* of rounding alone */
  double wanted = 1e-3 * ti->how.tolerance * sqrt(1 - fmin(ti->contraction, 1));
  return fmin(fmax(wanted, 1e-14), 1e-6);
}
