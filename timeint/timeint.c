/* timeint.c - makes and frees the handle, and carries states in and out of the model's units (internal.h, model.h). */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "timeint/internal.h"

static const double pi = 3.14159265358979323846;

static bool positive(double a) { return a > 0 && a <= DBL_MAX; } /* not NaN, not infinite */
static bool not_negative(double a) { return a >= 0 && a <= DBL_MAX; }

static bool contact_ok(const scene_contact *c)
{
  return not_negative(c->law.kt) && not_negative(c->law.kn) && not_negative(c->law.mu) && isfinite(c->law.gap) &&
         isfinite(c->angle_deg);
}

static hc_status check_scene(const scene *sc)
{
  const scene_transient *t = &sc->transient;
  if (!positive(sc->mass) || !not_negative(sc->damping) || !not_negative(sc->stiffness) || !isfinite(sc->force))
    return HC_BAD_INPUT;
  if (sc->n_contacts < 0 || sc->n_contacts > SCENE_MAX_CONTACTS) return HC_BAD_INPUT;
  for (int j = 0; j < sc->n_contacts; ++j)
    if (!contact_ok(&sc->contacts[j])) return HC_BAD_INPUT;
  if (!positive(t->regularisation) || !positive(t->tolerance) || t->max_periods < 1) return HC_BAD_INPUT;
  return HC_OK;
}

hc_status timeint_new(const scene *sc, timeint **out)
{
  *out = NULL;
  hc_status st = check_scene(sc);
  if (st != HC_OK) return st;
  timeint *ti = calloc(1, sizeof *ti); /* zeroed, so free works half-built */
  if (!ti) return HC_NO_MEMORY;
  ti->sc = *sc;
  ti->tolerance = timeint_final_tolerance(ti);
  const int n = MODEL_W + sc->n_contacts;
  hc_status (*make)(int, double, integrator **) =
      sc->transient.law == TRANSIENT_LAW_EXACT ? integrate_new_exact : integrate_new_regularised;
  const bool other = sc->transient.law != TRANSIENT_LAW_EXACT;
  if ((st = make(n, ti->tolerance, &ti->in)) == HC_OK &&
      (st = other ? integrate_new_exact(n, ti->tolerance, &ti->sweeper) : HC_OK) == HC_OK &&
      (st = settle_new(n, &ti->settle)) == HC_OK && (st = shoot_new(ti, &ti->shoot)) == HC_OK) {
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
  free(ti);
}

timeint_state timeint_rest(const timeint *ti)
{
  (void)ti; /* static equilibrium is x = 0 in every scene */
  return (timeint_state){0};
}

/* An unloaded, unmoved oscillator still needs a unit: a gap, or 1. */
static double any_length(const scene *sc)
{
  double length = 0;
  for (int j = 0; j < sc->n_contacts; ++j) length = fmax(length, fabs(sc->contacts[j].law.gap));
  return length > 0 ? length : 1;
}

static void set_length(timeint *ti, double length)
{
  const double ratio = ti->length / length;
  for (int i = 0; i < ti->model.n_states; ++i) ti->y[i] *= ratio;
  ti->length = length;
  model_make(&ti->model, &ti->sc, ti->omega, length);
}

static bool state_ok(const timeint *ti, const timeint_state *state)
{
  bool ok = isfinite(state->x) && isfinite(state->v);
  for (int j = 0; j < ti->sc.n_contacts; ++j) ok = ok && isfinite(state->w[j]);
  return ok;
}

hc_status timeint_begin(timeint *ti, double omega, const timeint_state *state)
{
  const scene *sc = &ti->sc;
  if (!positive(omega) || !state_ok(ti, state)) return HC_BAD_INPUT;
  ti->omega = omega;
  ti->contraction = exp(-pi * sc->damping / (sc->mass * omega));
  ti->periods = 0;
  ti->steps0 = integrate_steps(ti->in);
  ti->rhs0 = integrate_rhs(ti->in);
  /* No response is smaller than the force over all that resists it, but at an antiresonance, which one mass has not. */
  ti->least_length = fabs(sc->force) / (scene_max_stiffness(sc) + sc->mass * omega * omega + sc->damping * omega);
  double length = fmax(ti->least_length, hypot(state->x, state->v / omega));
  if (!(length > 0)) length = any_length(sc);
  if (!(ti->least_length > 0)) ti->least_length = length;
  ti->length = length;
  ti->y[MODEL_X] = state->x / length;
  ti->y[MODEL_P] = state->v / (omega * length);
  for (int j = 0; j < sc->n_contacts; ++j) ti->y[MODEL_W + j] = state->w[j] / length;
  model_make(&ti->model, sc, omega, length);
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
  hc_status st = integrate_period(ti->in, &ti->model, ti->y, measured ? measure_step : NULL, &ti->measure);
  if (st != HC_OK) return st;
  ++ti->periods;
  if (!measured) follow_length(ti); /* a measurement is in one unit */
  return HC_OK;
}

timeint_state timeint_now(const timeint *ti)
{
  timeint_state s = {.x = ti->y[MODEL_X] * ti->length, .v = ti->y[MODEL_P] * ti->length * ti->omega};
  for (int j = 0; j < ti->sc.n_contacts; ++j) {
    const model_contact *c = &ti->model.contact[j];
    s.w[j] = c->law.slides ? ti->y[MODEL_W + j] * ti->length : c->cosine * s.x;
  }
  return s;
}

double timeint_size(const timeint *ti) { return hypot(ti->y[MODEL_X], ti->y[MODEL_P]) * ti->length; }

void timeint_point(const timeint *ti, double *z)
{
  const model *m = &ti->model;
  const double stiffest = scene_max_stiffness(&ti->sc) / (ti->sc.mass * ti->omega * ti->omega);
  z[MODEL_X] = ti->y[MODEL_X] * ti->length;
  z[MODEL_P] = ti->y[MODEL_P] * ti->length;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contact[j];
    z[MODEL_W + j] = c->law.slides ? c->law.kt * c->cosine / stiffest * ti->y[MODEL_W + j] * ti->length : 0.0;
  }
}

/* Measured: restarting CVODE each period, the states of a settled orbit scatter by 20 to 250 times its tolerance
 * (corners make its error jump with the step sequence). A scatter of s a period adds up to s/sqrt(2 (1 - rho)) in a
 * slowly contracting orbit. Hence tolerance/1000, times sqrt(1 - rho), and not below 1e-14, where rounding takes
 * over; never above 1e-6, where steps leap over whole contacts. */
double timeint_final_tolerance(const timeint *ti)
{
  double wanted = 1e-3 * ti->sc.transient.tolerance * sqrt(1 - fmin(ti->contraction, 1));
  return fmin(fmax(wanted, 1e-14), 1e-6);
}
