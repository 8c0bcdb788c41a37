/* timeint.c - see timeint.h: makes the handle and its parts, and frees them. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "timeint/closed_form/integrate_closed_form.h"
#include "timeint/cvode/integrate_events.h"
#include "timeint/cvode/integrate_regularised.h"
#include "timeint/steady/closed_form_start.h"
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
  double **const vectors[] = {
      &ti->y,        &ti->saved,    &ti->direction, &ti->neighbour, &ti->separation, &ti->closed_form_state,
      &ti->point[0], &ti->point[1], &ti->point[2],  &ti->began,     &ti->past};
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
  if (closed) return integrate_new_closed_form(ti->base, INTERVAL_MODES_STIFF, out);
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
  return st == HC_OK ? closed_start_new(ti) : st;
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
  closed_start_free(ti);
  shoot_free(ti->shoot);
  settle_free(ti->settle);
  integrate_free(ti->exact);
  integrate_free(ti->in);
  measure_free(&ti->measure);
  free(ti->scaled.contact);
  free(ti->memory);
  modal_base_free(ti->base);
  model_free(ti->model);
  free(ti);
}

void timeint_count(const timeint *ti, long *by_cvode, long *closed_form)
{
  if (!ti) return;
  const bool closed = ti->how.method == TRANSIENT_METHOD_CLOSED_FORM;
  const long own = integrate_periods(ti->in);
  *by_cvode += (closed ? 0 : own) + (ti->exact ? integrate_periods(ti->exact) : 0);
  *closed_form += (closed ? own : 0) + (ti->closed_form ? integrate_periods(ti->closed_form->in) : 0);
}

int timeint_n_states(const timeint *ti) { return ti->n; }

void timeint_rest(const timeint *ti, double *state) /* x = 0 is static equilibrium without the static loads */
{
  for (int i = 0; i < ti->n; ++i) state[i] = 0;
}
