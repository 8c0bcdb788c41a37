/* timeint.c - makes and frees the handle, and carries states in and out of the model's units (internal.h, scaled.h). */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "timeint/internal.h"

static const double pi = 3.14159265358979323846;

static bool positive(double a) { return a > 0 && a <= DBL_MAX; } /* not NaN, not infinite */
static bool not_negative(double a) { return a >= 0 && a <= DBL_MAX; }

static bool contact_ok(const model_contact *c)
{
  return not_negative(c->law.kt) && not_negative(c->law.kn) && not_negative(c->law.mu) && isfinite(c->law.gap) &&
         isfinite(c->tangent) && isfinite(c->normal);
}

static hc_status check_input(const model *m, const transient_settings *how)
{
  if (!positive(m->mass) || !not_negative(m->damping) || !not_negative(m->stiffness) || !isfinite(m->force))
    return HC_BAD_INPUT;
  if (m->n_contacts > TIMEINT_MAX_CONTACTS) return HC_BAD_INPUT;
  for (int j = 0; j < m->n_contacts; ++j)
    if (!contact_ok(&m->contacts[j])) return HC_BAD_INPUT;
  if (!positive(how->regularisation) || !positive(how->tolerance) || how->max_periods < 1) return HC_BAD_INPUT;
  return HC_OK;
}

static hc_status make_parts(timeint *ti)
{
  const int n = SCALED_W + ti->model->n_contacts;
  const bool exact = ti->how.law == TRANSIENT_LAW_EXACT;
  hc_status st = (exact ? integrate_new_exact : integrate_new_regularised)(n, ti->tolerance, &ti->in);
  if (st == HC_OK && !exact) st = integrate_new_exact(n, ti->tolerance, &ti->sweeper);
  if (st == HC_OK) st = settle_new(n, &ti->settle);
  return st == HC_OK ? shoot_new(ti, &ti->shoot) : st;
}

hc_status timeint_new(const model *m, const transient_settings *how, timeint **out)
{
  *out = NULL;
  hc_status st = check_input(m, how);
  if (st != HC_OK) return st;
  timeint *ti = calloc(1, sizeof *ti); /* zeroed, so free works half-built */
  if (!ti) return HC_NO_MEMORY;
  ti->how = *how;
  ti->tolerance = timeint_final_tolerance(ti);
  if ((st = model_copy(m, &ti->model)) == HC_OK && (st = make_parts(ti)) == HC_OK) {
    *out = ti;
    return HC_OK;
  }
  timeint_free(ti);
  return st;
}

void timeint_free(timeint *ti)
{
  if (!ti) return;
  shoot_free(ti->shoot);
  settle_free(ti->settle);
  integrate_free(ti->sweeper);
  integrate_free(ti->in);
  model_free(ti->model);
  free(ti);
}

timeint_state timeint_rest(const timeint *ti)
{
  (void)ti; /* static equilibrium is x = 0 in every model */
  return (timeint_state){0};
}

/* An unloaded, unmoved oscillator still needs a unit: a gap, or 1. */
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

static bool state_ok(const timeint *ti, const timeint_state *state)
{
  bool ok = isfinite(state->x) && isfinite(state->v);
  for (int j = 0; j < ti->model->n_contacts; ++j) ok = ok && isfinite(state->w[j]);
  return ok;
}

hc_status timeint_begin(timeint *ti, double omega, const timeint_state *state)
{
  const model *m = ti->model;
  if (!positive(omega) || !state_ok(ti, state)) return HC_BAD_INPUT;
  ti->omega = omega;
  ti->contraction = exp(-pi * m->damping / (m->mass * omega));
  ti->periods = 0;
  ti->steps0 = integrate_steps(ti->in);
  ti->rhs0 = integrate_rhs(ti->in);
  /* No response is smaller than the force over all that resists it, but at an antiresonance, which one mass has not. */
  ti->least_length = fabs(m->force) / (model_max_stiffness(m) + m->mass * omega * omega + m->damping * omega);
  double length = fmax(ti->least_length, hypot(state->x, state->v / omega));
  if (!(length > 0)) length = any_length(m);
  if (!(ti->least_length > 0)) ti->least_length = length;
  ti->length = length;
  ti->y[SCALED_X] = state->x / length;
  ti->y[SCALED_P] = state->v / (omega * length);
  for (int j = 0; j < m->n_contacts; ++j) ti->y[SCALED_W + j] = state->w[j] / length;
  scaled_make(&ti->scaled, m, &ti->how, omega, length);
  return HC_OK;
}

hc_status timeint_set_tolerance(timeint *ti, double tolerance)
{
  ti->tolerance = tolerance;
  return integrate_tolerance(ti->in, tolerance);
}

/* The size is known to a factor of 4: CVODE's absolute tolerance is in units of length, and needs no better. */
static void follow_length(timeint *ti)
{
  double size = fmax(timeint_size(ti), ti->least_length);
  if (size > 4 * ti->length || size < 0.25 * ti->length) set_length(ti, size);
}

hc_status timeint_period(timeint *ti, bool measured)
{
  if (measured) measure_period(&ti->measure, ti->y);
  hc_status st = integrate_period(ti->in, &ti->scaled, ti->y, measured ? measure_step : NULL, &ti->measure);
  if (st != HC_OK) return st;
  ++ti->periods;
  if (!measured) follow_length(ti); /* a measurement is in one unit */
  return HC_OK;
}

timeint_state timeint_now(const timeint *ti)
{
  timeint_state s = {.x = ti->y[SCALED_X] * ti->length, .v = ti->y[SCALED_P] * ti->length * ti->omega};
  for (int j = 0; j < ti->model->n_contacts; ++j) {
    const scaled_contact *c = &ti->scaled.contact[j];
    s.w[j] = c->law.slides ? ti->y[SCALED_W + j] * ti->length : c->cosine * s.x;
  }
  return s;
}

double timeint_size(const timeint *ti) { return hypot(ti->y[SCALED_X], ti->y[SCALED_P]) * ti->length; }

void timeint_point(const timeint *ti, double *z)
{
  const scaled_model *m = &ti->scaled;
  const double stiffest = model_max_stiffness(ti->model) / (ti->model->mass * ti->omega * ti->omega);
  z[SCALED_X] = ti->y[SCALED_X] * ti->length;
  z[SCALED_P] = ti->y[SCALED_P] * ti->length;
  for (int j = 0; j < m->n_contacts; ++j) {
    const scaled_contact *c = &m->contact[j];
    z[SCALED_W + j] = c->law.slides ? c->law.kt * c->cosine / stiffest * ti->y[SCALED_W + j] * ti->length : 0.0;
  }
}

/* Measured: restarting CVODE each period, the states of a settled orbit scatter by 20 to 250 times its tolerance
 * (corners make its error jump with the step sequence). A scatter of s a period adds up to s/sqrt(2 (1 - rho)) in a
 * slowly contracting orbit. Hence tolerance/1000, times sqrt(1 - rho), and not below 1e-14, where rounding takes
 * over; never above 1e-6, where steps leap over whole contacts. */
double timeint_final_tolerance(const timeint *ti)
{
  double wanted = 1e-3 * ti->how.tolerance * sqrt(1 - fmin(ti->contraction, 1));
  return fmin(fmax(wanted, 1e-14), 1e-6);
}
