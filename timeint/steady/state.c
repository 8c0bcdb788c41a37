/* state.c - see timeint_private.h: the state of a handle, between the model's units and those of scaled.h; one period
 * of the motion. */
#include <math.h>
#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/norm.h"
#include "timeint/closed_form/interval_modes.h"
#include "timeint/steady/mass_scaling.h"
#include "timeint/steady/timeint_private.h"

static const double finest = 1e-14; /* [1] of its own motion to which a state can be resolved */

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
  for (int i = 0; i < b->n_loads * b->n; ++i)
    force += model_load_factor(b->inertial[i / b->n], omega) * hypot(b->cosine[i], b->sine[i]);
  return force / (b->highest * b->highest + omega * omega + 2 * b->slowest * omega);
}

/* X, P and W of the state, in units of `length`. A contact without friction has its slider at u whatever the state
 * says: its way there would count as the motion's, and an orbit next to the state as far from it. */
static void take_state(const timeint *ti, const double *state, double length, double *y)
{
  const int n = ti->n_dof;
  for (int i = 0; i < n; ++i) ti->from_rest[i] = state[i] - ti->rest[i];
  modal_base_to_modes(ti->base, ti->from_rest, y);
  modal_base_to_modes(ti->base, state + n, y + n);
  for (int i = 0; i < n; ++i) {
    y[i] /= length;
    y[n + i] /= ti->omega * length;
  }
  for (int j = 0; j < ti->model->n_contacts; ++j) {
    const double *tangent = ti->base->tangent + (size_t)j * (size_t)n;
    const bool friction = contact_has_friction(&ti->model->contacts[j].law);
    y[2 * n + j] = friction ? (state[2 * n + j] - ti->rest_u[j]) / length : dot_product(n, tangent, y);
  }
}

void timeint_take_state(const timeint *ti, const double *state, double *y) { take_state(ti, state, ti->length, y); }

static double state_size(const timeint *ti)
{
  double size = 0;
  for (int i = 0; i < 2 * ti->n_dof; ++i) size = hypot(size, ti->y[i]);
  return size;
}

static hc_status make_integrator(const timeint *ti, transient_law law, integrator **out)
{
  const bool closed = ti->how.method == TRANSIENT_METHOD_CLOSED_FORM, exact = law == TRANSIENT_LAW_EXACT;
  if (closed) return integrate_new_closed_form(ti->base, INTERVAL_MODES_STIFF, out);
  return (exact ? integrate_new_events : integrate_new_regularised)(ti->base, ti->tolerance, out);
}

hc_status timeint_make_integrators(timeint *ti)
{
  const bool exact = ti->how.law == TRANSIENT_LAW_EXACT;
  if (ti->in) ti->periods_before += integrate_periods(ti->in);
  if (ti->exact) ti->periods_before += integrate_periods(ti->exact);
  integrate_free(ti->in);
  integrate_free(ti->exact);
  ti->in = ti->exact = NULL;
  ti->scaled.base = ti->base;
  hc_status st = make_integrator(ti, ti->how.law, &ti->in);
  if (st == HC_OK && !exact && !ti->how.scout) st = make_integrator(ti, TRANSIENT_LAW_EXACT, &ti->exact);
  return st;
}

hc_status timeint_slow_modes(timeint *ti, double omega)
{
  const double fastest = ti->may_slow ? mass_scaling_fastest(ti->whole, omega) : INFINITY;
  modal_base *slowed = NULL;
  if (fastest == ti->fastest) return HC_OK;
  hc_status st = isfinite(fastest) ? modal_base_slowed(ti->whole, ti->model, fastest, &slowed) : HC_OK;
  if (st != HC_OK) return st;
  modal_base *before = ti->base;
  ti->base = slowed ? slowed : ti->whole;
  ti->fastest = fastest;
  st = timeint_make_integrators(ti);
  if (before != ti->whole) modal_base_free(before);
  return st;
}

/* Sizes of states at ti->y from what is known of vibrations, and the equations with them. */
static void use_sizes(timeint *ti)
{
  const bool closed = ti->how.method == TRANSIENT_METHOD_CLOSED_FORM;
  const double within = closed ? ti->how.tolerance : timeint_final_tolerance(ti);
  state_sizes_find(&ti->sizes, ti->base, finest / within, ti->y);
  scaled_make(&ti->scaled, ti->model, &ti->how, ti->omega, ti->length);
}

void timeint_use_length(timeint *ti, double length)
{
  for (int i = 0; i < ti->n; ++i) ti->y[i] *= ti->length / length;
  ti->length = length;
  use_sizes(ti);
}

void timeint_use_measured(timeint *ti, const timeint *of)
{
  if (!of->measured) return;
  measure_vibration(&of->measure, of->length, ti->sizes.vibration);
  use_sizes(ti);
}

/* The orbit at ti->omega that was given out as `state`; NULL: none was lately. */
static const known_orbit *recall_known(const timeint *ti, const double *state)
{
  for (const known_orbit *k = ti->known; k < ti->known + KNOWN_ORBITS; ++k)
    if (k->omega == ti->omega && !memcmp(k->state, state, (size_t)ti->n * sizeof *state)) return k;
  return NULL;
}

void timeint_remember(timeint *ti, const double *state)
{
  if (recall_known(ti, state)) return;
  known_orbit *k = &ti->known[ti->next_known];
  ti->next_known = (ti->next_known + 1) % KNOWN_ORBITS;
  k->omega = ti->omega;
  k->regularisation = ti->how.regularisation;
  memcpy(k->state, state, (size_t)ti->n * sizeof *state);
  memcpy(k->vibration, ti->sizes.vibration, (size_t)ti->sizes.n_rows * sizeof *k->vibration);
}

hc_status timeint_begin(timeint *ti, double omega, const double *state)
{
  const model *m = ti->model;
  if (!(omega > 0 && isfinite(omega)) || !state_ok(ti, state)) return HC_BAD_INPUT;
  hc_status st = timeint_slow_modes(ti, omega);
  if (st != HC_OK) return st;
  ti->omega = omega;
  ti->measured = false;
  ti->contraction = exp(-TWO_PI * ti->base->slowest / omega);
  ti->periods = ti->window.periods = 0;
  memset(ti->noted, 0, sizeof ti->noted);
  ti->creeps = false;
  ti->steps0 = integrate_steps(ti->in);
  ti->rhs0 = integrate_rhs(ti->in);
  ti->least_length = least_length(ti);
  take_state(ti, state, 1, ti->y);
  double length = fmax(ti->least_length, state_size(ti));
  /* The unit of length for a model at rest without force: the largest gap, or 1. */
  if (!(length > 0)) {
    double l = 0;
    for (int j = 0; j < m->n_contacts; ++j) l = fmax(l, fabs(m->contacts[j].law.gap));
    length = l > 0 ? l : 1;
  }
  if (!(ti->least_length > 0)) ti->least_length = length;
  take_state(ti, state, length, ti->y);
  ti->length = length;
  state_sizes_begin(&ti->sizes, ti->base, m, omega);
  const known_orbit *known = recall_known(ti, state);
  ti->how.regularisation = known ? known->regularisation : ti->regularisation;
  if (known) memcpy(ti->sizes.vibration, known->vibration, (size_t)ti->sizes.n_rows * sizeof(double));
  else state_sizes_see(&ti->sizes, ti->base, length, ti->y);
  use_sizes(ti);
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

/* The unit stays within this factor of the motion's size. CVODE's absolute tolerance is in this unit, and needs to be
 * in proportion to the motion to no better than that. */
static const double unit_factor = 4;
static void follow_length(timeint *ti)
{
  const double size = timeint_motion_size(ti);
  const bool larger = state_sizes_see(&ti->sizes, ti->base, ti->length, ti->y);
  if (size > unit_factor * ti->length || size * unit_factor < ti->length) timeint_use_length(ti, size);
  else if (larger) use_sizes(ti);
}

const hc_monitor *timeint_hear(timeint *ti, const hc_monitor *monitor)
{
  if (ti->closed_form) timeint_hear(ti->closed_form, monitor);
  if (ti->slowed) timeint_hear(ti->slowed, monitor);
  if (ti->exact) integrate_hear(ti->exact, monitor);
  return integrate_hear(ti->in, monitor);
}

hc_status timeint_period(timeint *ti, bool measured)
{
  if (measured) measure_period(&ti->measure, ti->y), ti->last.k = 0;
  hc_status st = integrate_period(ti->in, &ti->scaled, ti->y, measured ? measure_step : NULL, &ti->measure);
  ti->measured = false;
  if (st != HC_OK) return st;
  ++ti->periods;
  if (!measured) follow_length(ti); /* all periods of a measurement are in one unit */
  return HC_OK;
}

void timeint_note_measured(timeint *ti, int k, const double *end, int switches, int returns)
{
  ti->last.k = k;
  ti->last.omega = ti->omega;
  ti->last.length = ti->length;
  ti->last.switches = switches;
  ti->last.returns = returns;
  memcpy(ti->last.end, end, sizeof *end * (size_t)ti->n);
}

void timeint_get_state(const timeint *ti, double *state)
{
  const int n = ti->n_dof;
  const double length = ti->length;
  modal_base_to_model(ti->base, ti->y, state);
  modal_base_to_model(ti->base, ti->y + n, state + n);
  for (int i = 0; i < n; ++i) {
    state[i] = state[i] * length + ti->rest[i];
    state[n + i] = state[n + i] * length * ti->omega;
  }
  for (int j = 0; j < ti->model->n_contacts; ++j) {
    double u[2], v;
    scaled_contact_motion(&ti->scaled, j, ti->y, u, &v);
    state[2 * n + j] = (ti->scaled.contact[j].law.has_friction ? ti->y[2 * n + j] : u[0]) * length + ti->rest_u[j];
  }
}

void timeint_shift_result(const timeint *ti, int i, timeint_result *r)
{
  const double by = dot_product(ti->n_dof, ti->model->responses + (size_t)i * (size_t)ti->n_dof, ti->rest);
  r->rms = sqrt(r->rms * r->rms + (2 * r->mean + by) * by);
  r->mean += by;
  r->max += by;
  r->min += by;
  for (int k = 0; k < TIMEINT_WAVE; ++k) r->wave[k] += by;
}

void timeint_report(const timeint *ti, int i, timeint_result *r)
{
  measure_report(&ti->measure, ti->model, i, ti->length, r);
  timeint_shift_result(ti, i, r);
  r->window = ti->window.periods;
  r->window_low = r->window > 0 ? fmin(ti->window.low[i], r->amplitude) : NAN;
  r->window_high = r->window > 0 ? fmax(ti->window.high[i], r->amplitude) : NAN;
  r->drift = ti->creeps ? dot_product(ti->n_dof, ti->model->responses + (size_t)i * (size_t)ti->n_dof, ti->drift) : NAN;
}

void timeint_save(timeint *ti) { memcpy(ti->saved, ti->y, sizeof *ti->y * (size_t)ti->n); }
void timeint_restore(timeint *ti) { memcpy(ti->y, ti->saved, sizeof *ti->y * (size_t)ti->n); }

double timeint_norm(const timeint *ti, const double *z) { return state_sizes_norm(ti->n, ti->sizes.of, z); }

double timeint_distance(const timeint *ti, const double *a, const double *b)
{
  return state_sizes_distance(ti->n, ti->sizes.of, a, b);
}

double timeint_farthest(const timeint *ti, const double *a, const double *b)
{
  double most = 0;
  for (int i = 0; i < ti->n; ++i) most = larger(most, fabs(a[i] - b[i]) / ti->sizes.of[i]);
  return most;
}

double timeint_response_unit(const timeint *ti, int i)
{
  return state_sizes_unit(&ti->sizes, 2 * ti->model->n_contacts + i) * ti->length;
}

double timeint_size(const timeint *ti) { return state_size(ti) * ti->length; }
double timeint_motion_size(const timeint *ti) { return fmax(timeint_size(ti), ti->least_length); }
double timeint_scaled_size(const timeint *ti) { return timeint_motion_size(ti) / ti->length; }

void timeint_point(const timeint *ti, double *z)
{
  const scaled_model *m = &ti->scaled;
  const int moving = 2 * ti->n_dof;
  const double stiffest = ti->base->highest * ti->base->highest / (ti->omega * ti->omega);
  for (int i = 0; i < moving; ++i) z[i] = ti->y[i] / ti->sizes.of[i] * ti->length;
  for (int j = 0; j < m->n_contacts; ++j) {
    const scaled_contact *c = &m->contact[j];
    const double pull = c->law.kt * scaled_pull(m, j);
    z[moving + j] =
        c->law.has_friction ? pull / stiffest * ti->y[moving + j] / ti->sizes.of[moving + j] * ti->length : 0.0;
  }
}

/* Measured: with CVODE restarted each period, the states of a settled orbit scatter by 20 to 250 times its tolerance,
 * since each period is cut into other steps, and the error at a corner depends on where the step that contains it
 * begins. A scatter of s a period adds up to s/sqrt(2 (1 - rho)) where the contraction rho is close to 1. Hence
 * tolerance/1000, times sqrt(1 - rho), and not below 1e-14, where rounding is larger; never above 1e-6, where steps
 * pass over whole contacts. */
double timeint_final_tolerance(const timeint *ti)
{
  const double coarsest = 1e-6, share = 1e-3;
  if (ti->how.method == TRANSIENT_METHOD_CLOSED_FORM) return finest; /* of rounding alone */
  return fmin(fmax(share * ti->how.tolerance * sqrt(1 - fmin(ti->contraction, 1)), finest), coarsest);
}
