/* timeint.c - see timeint.h: makes the handle and its parts, and frees them. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/rest.h"
#include "numerics/norm.h"
#include "timeint/steady/closed_form_start.h"
#include "timeint/steady/mass_scaling.h"
#include "timeint/steady/period_map.h"
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

static hc_status timeint_make_memory(timeint *ti)
{
  double **const vectors[] = {
      &ti->y,        &ti->saved,    &ti->direction, &ti->neighbour, &ti->separation, &ti->closed_form_state,
      &ti->point[0], &ti->point[1], &ti->point[2],  &ti->began,     &ti->last.end};
  const size_t n = (size_t)ti->n;
  workspace *w = &ti->memory;
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; ++i) *vectors[i] = workspace_doubles(w, n);
  ti->from_rest = workspace_doubles(w, (size_t)ti->n_dof);
  ti->amplitudes = workspace_doubles(w, 2 * (size_t)ti->base->n_responses);
  ti->drift = workspace_doubles(w, n);
  ti->window.low = workspace_doubles(w, (size_t)ti->base->n_responses);
  ti->window.high = workspace_doubles(w, (size_t)ti->base->n_responses);
  for (int k = 0; k < 3; ++k) ti->states[k] = workspace_doubles(w, n);
  ti->past = workspace_doubles(w, SETTLE_MAX_MULTIPLE * n);
  ti->scaled.contact = workspace_array(w, (size_t)ti->model->n_contacts, sizeof *ti->scaled.contact);
  hc_status st = state_sizes_make(&ti->sizes, ti->base, w);
  for (int i = 0; i < KNOWN_ORBITS && st == HC_OK; ++i) {
    ti->known[i].state = workspace_doubles(w, n);
    ti->known[i].vibration = workspace_doubles(w, (size_t)ti->sizes.n_rows);
  }
  ti->scaled.size = ti->sizes.of;
  ti->scaled.vibration = st == HC_OK ? ti->sizes.vibration + ti->model->n_contacts : NULL;
  return st != HC_OK ? st : measure_make(&ti->measure, ti->n, ti->base->n_responses, ti->model->n_contacts, w);
}

static hc_status timeint_make_parts(timeint *ti)
{
  hc_status st = timeint_make_memory(ti);
  if (st == HC_OK) st = timeint_make_integrators(ti);
  if (st == HC_OK) st = settle_new(ti->n, &ti->settle);
  if (st == HC_OK) st = period_map_new(ti, &ti->map);
  return st == HC_OK ? shoot_new(ti, &ti->shoot) : st;
}

/* ti->model, rest, rest_u: of m, or where `of` has them already. */
static hc_status settle_to_rest(timeint *ti, const model *m, const timeint *of)
{
  const size_t n = (size_t)m->n;
  ti->rest = workspace_doubles(&ti->memory, n);
  ti->rest_u = workspace_doubles(&ti->memory, (size_t)m->n_contacts);
  if (ti->memory.failed) return HC_NO_MEMORY;
  hc_status st = of ? model_copy(of->model, &ti->model) : model_about_rest(m, &ti->model, ti->rest);
  if (of) memcpy(ti->rest, of->rest, n * sizeof *ti->rest);
  for (int j = 0; j < m->n_contacts && st == HC_OK; ++j)
    ti->rest_u[j] = dot_product(m->n, m->contacts[j].tangent, ti->rest);
  return st;
}

/* The handle, alone: of m, or of the model about rest that `of` has. */
static hc_status timeint_make(const model *m, const timeint *of, const transient_settings *how, bool may_slow,
                              timeint **out)
{
  *out = NULL;
  const size_t n = (size_t)m->n;
  if (m->n == 1 && !(positive(*m->mass) && isfinite(*m->damping))) return HC_BAD_INPUT;
  bool ok = all_finite(n * n, m->mass) && all_finite(n * n, m->damping) && all_finite(n * n, m->stiffness);
  for (int l = 0; l < m->n_loads; ++l) ok = ok && all_finite(n, m->loads[l].cosine) && all_finite(n, m->loads[l].sine);
  for (int j = 0; j < m->n_contacts; ++j)
    ok = ok && all_finite(n, m->contacts[j].tangent) && all_finite(n, m->contacts[j].normal);
  if (!(ok && m->n_responses > 0)) return HC_BAD_INPUT;
  for (int j = 0; j < m->n_contacts; ++j)
    if (!contact_ok(&m->contacts[j])) return HC_BAD_INPUT;
  if (how->method == TRANSIENT_METHOD_CLOSED_FORM && (how->law != TRANSIENT_LAW_EXACT || model_is_smooth(m)))
    return HC_BAD_INPUT;
  if (!positive(how->regularisation) || !positive(how->tolerance) || how->max_periods < 1) return HC_BAD_INPUT;
  if (m->n_contacts > MOST_STATES - 2 * m->n) return HC_NO_MEMORY;
  timeint *ti = calloc(1, sizeof *ti); /* zeroed, so free works half-built */
  if (!ti) return HC_NO_MEMORY;
  ti->how = *how;
  ti->regularisation = how->regularisation;
  ti->how.scout = how->scout && !model_is_smooth(m); /* which has no closed form */
  ti->owners = 1;
  ti->may_slow = may_slow;
  ti->fastest = INFINITY;
  ti->n_dof = m->n;
  ti->n = 2 * m->n + m->n_contacts;
  ti->tolerance = timeint_final_tolerance(ti);
  hc_status st = settle_to_rest(ti, m, of);
  if (st == HC_OK) st = modal_base_new(ti->model, &ti->whole);
  ti->base = ti->whole;
  if (st == HC_OK && (st = timeint_make_parts(ti)) == HC_OK) {
    *out = ti;
    return HC_OK;
  }
  timeint_free(ti);
  return st;
}

static hc_status keep_or_free(timeint *ti, hc_status st, timeint **out)
{
  if (st == HC_OK) *out = ti;
  else timeint_free(ti);
  return st;
}

/* With what it needs beside it. */
static hc_status make_all(const model *m, const timeint *of, const transient_settings *how, timeint **out)
{
  const bool closed = how->method == TRANSIENT_METHOD_CLOSED_FORM;
  timeint *ti;
  *out = NULL;
  hc_status st = timeint_make(m, of, how, !closed, &ti);
  if (st == HC_OK && closed && mass_scaling_may_pay(ti->whole)) {
    st = timeint_make(ti->model, ti, how, true, &ti->slowed);
    if (st == HC_OK) period_map_borrow_from(ti->map, ti->slowed->map);
  }
  if (st == HC_OK && !closed && ti->how.scout) st = closed_start_new(ti);
  return keep_or_free(ti, st, out);
}

hc_status timeint_new(const model *m, const transient_settings *how, timeint **out)
{
  return make_all(m, NULL, how, out);
}

hc_status timeint_new_like(const timeint *of, const transient_settings *how, timeint **out)
{
  return make_all(of->model, of, how, out);
}

bool timeint_slows_modes(const timeint *ti, double omega)
{
  return ti->may_slow && isfinite(mass_scaling_fastest(ti->whole, omega));
}

void timeint_leave_multipliers(timeint *ti)
{
  ti->no_multipliers = true;
  if (ti->slowed) timeint_leave_multipliers(ti->slowed);
  if (ti->closed_form) timeint_leave_multipliers(ti->closed_form);
}

timeint *timeint_closed_form_of(timeint *ti)
{
  if (!ti->closed_form || !ti->closed_form->slowed) return NULL;
  ++ti->closed_form->owners;
  return ti->closed_form;
}

hc_status timeint_new_beside(timeint *of, const transient_settings *how, timeint **out)
{
  timeint *ti;
  *out = NULL;
  const bool same = of->closed_form && (of->closed_form->slowed || of->closed_form->how.tolerance <= how->tolerance);
  if (!same || !how->scout || how->method == TRANSIENT_METHOD_CLOSED_FORM) return timeint_new_like(of, how, out);
  if (how->law == TRANSIENT_LAW_EXACT && (*out = timeint_closed_form_of(of))) return HC_OK;
  hc_status st = timeint_make(of->model, of, how, true, &ti);
  if (st == HC_OK) st = closed_start_share(ti, of->closed_form);
  return keep_or_free(ti, st, out);
}

void timeint_free(timeint *ti)
{
  if (!ti || --ti->owners > 0) return;
  timeint_free(ti->slowed);
  timeint_free(ti->closed_form);
  shoot_free(ti->shoot);
  period_map_free(ti->map);
  settle_free(ti->settle);
  integrate_free(ti->exact);
  integrate_free(ti->in);
  workspace_free(&ti->memory);
  if (ti->base != ti->whole) modal_base_free(ti->base);
  modal_base_free(ti->whole);
  model_free(ti->model);
  free(ti);
}

static long periods_of(const timeint *ti)
{
  return ti->periods_before + integrate_periods(ti->in) + (ti->exact ? integrate_periods(ti->exact) : 0);
}

void timeint_count(const timeint *ti, long *by_cvode, long *closed_form)
{
  if (!ti) return;
  const bool closed = ti->how.method == TRANSIENT_METHOD_CLOSED_FORM;
  const timeint *own = closed && ti->owners == 1 ? ti : ti->shares_closed_form ? NULL : ti->closed_form;
  if (!closed) *by_cvode += periods_of(ti);
  if (own) *closed_form += periods_of(own) + (own->slowed ? periods_of(own->slowed) : 0);
}

int timeint_n_states(const timeint *ti) { return ti->n; }

/* Where slider j begins, put into its limit at rest. */
static double start_of(const timeint *ti, int j)
{
  const model_contact *c = &ti->model->contacts[j];
  double w = c->rest - ti->rest_u[j], T;
  if (c->rest == 0 || c->circle || !contact_has_friction(&c->law)) return c->rest;
  contact_step(&c->law, 0, 0, &w, &T);
  return w + ti->rest_u[j];
}

/* Both tangents of a circle, whose first is contact j. */
static void put_into_circle(const timeint *ti, int j, double *w)
{
  const model_contact *c = &ti->model->contacts[j];
  const double at_rest[2] = {0};
  double from[2] = {w[0] - ti->rest_u[j], w[1] - ti->rest_u[j + 1]}, T[2];
  if (!c->circle || c->pair != CONTACT_FIRST || (w[0] == 0 && w[1] == 0)) return;
  contact_step_planar(&c->law, at_rest, 0, from, T);
  for (int d = 0; d < 2; ++d) w[d] = from[d] + ti->rest_u[j + d];
}

void timeint_rest(const timeint *ti, double *state)
{
  for (int i = 0; i < 2 * ti->n_dof; ++i) state[i] = i < ti->n_dof ? ti->rest[i] : 0;
  double *w = state + 2 * ti->n_dof;
  for (int j = 0; j < ti->model->n_contacts; ++j) w[j] = start_of(ti, j);
  for (int j = 0; j + 1 < ti->model->n_contacts; ++j) put_into_circle(ti, j, w + j);
}
