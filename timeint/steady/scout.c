/* scout.c - see scout.h. */
#include "timeint/steady/scout.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "timeint/steady/confirm.h"
#include "timeint/steady/linear_regime.h"
#include "timeint/steady/orbit.h"
#include "timeint/steady/timeint_private.h"

static const double scout_tolerance = 1e-12;
static const double near = 0.02;       /* [size] of the scout's orbit from the one CVODE finds by itself */
static const double same_orbit = 1e-9; /* [length] of two scouted states, relative to their size */

/* Orbits confirmed lately: another start at the same frequency often leads to one of them, and nothing is integrated
 * twice. Those of a handle have the same settings. */
enum { REMEMBERED = 2 };
struct memory {
  int next; /* to be overwritten */
  struct confirmed {
    int k; /* 0: empty */
    double omega;
    double *scouted, *state; /* [n] where the scout was, where CVODE ended; in the model's units */
    timeint_result result;
    motion_error *predicted; /* [responses] */
  } orbit[REMEMBERED];
  double *states;           /* of the orbits */
  motion_error *predicted;  /* of the orbits */
  timeint_result untouched; /* a result before the scout's orbit was tried */
};

static hc_status make_memory(timeint *ti)
{
  const size_t n = (size_t)ti->n;
  struct memory *m = ti->confirmed = calloc(1, sizeof *m);
  const size_t responses = (size_t)ti->measure.n_responses;
  if (!m || !(m->states = calloc(2 * REMEMBERED * n, sizeof *m->states))) return HC_NO_MEMORY;
  if (!(m->predicted = calloc(REMEMBERED * responses, sizeof *m->predicted))) return HC_NO_MEMORY;
  for (size_t i = 0; i < REMEMBERED; ++i) {
    m->orbit[i].scouted = m->states + 2 * i * n;
    m->orbit[i].state = m->states + (2 * i + 1) * n;
    m->orbit[i].predicted = m->predicted + i * responses;
  }
  return HC_OK;
}

hc_status scout_new(timeint *ti)
{
  if (!ti->how.scout || ti->how.method == TRANSIENT_METHOD_CLOSED_FORM) return HC_OK;
  transient_settings how = ti->how;
  how.law = TRANSIENT_LAW_EXACT;
  how.method = TRANSIENT_METHOD_CLOSED_FORM;
  how.scout = false; /* so a scout has no scout */
  how.tolerance = fmin(how.tolerance, scout_tolerance);
  hc_status st = timeint_new(ti->model, &how, &ti->scout);
  if (st == HC_OK) st = confirm_new(ti, &ti->confirm);
  return st == HC_OK ? make_memory(ti) : st;
}

void scout_free(timeint *ti)
{
  if (ti->confirmed) {
    free(ti->confirmed->predicted);
    free(ti->confirmed->states);
  }
  free(ti->confirmed);
  confirm_free(ti->confirm);
  timeint_free(ti->scout);
}

static bool same_state(int n, const double *a, const double *b, double within)
{
  double apart = 0, size = 0;
  for (int i = 0; i < n; ++i) apart = fmax(apart, fabs(a[i] - b[i])), size = fmax(size, fabs(a[i]));
  return apart <= within * size;
}

void timeint_forget(timeint *ti)
{
  for (int i = 0; ti->confirmed && i < REMEMBERED; ++i) ti->confirmed->orbit[i].k = 0;
}

/* The orbit through the scouted state, if it is remembered; else NULL. */
static const struct confirmed *recall(const timeint *ti, int k, const double *scouted)
{
  const int moving = 2 * ti->n_dof;
  for (int i = 0; i < REMEMBERED; ++i) {
    const struct confirmed *c = &ti->confirmed->orbit[i];
    if (c->k == k && c->omega == ti->omega && same_state(moving, c->scouted, scouted, same_orbit) &&
        same_state(ti->n - moving, c->scouted + moving, scouted + moving, same_orbit))
      return c;
  }
  return NULL;
}

motion_error *scout_predictions(timeint *ti, const double *state)
{
  for (int i = 0; i < REMEMBERED; ++i) {
    struct confirmed *c = &ti->confirmed->orbit[i];
    if (c->k > 0 && c->omega == ti->omega && same_state(ti->n, c->state, state, 1e-14)) return c->predicted;
  }
  return NULL;
}

static void remember(timeint *ti, int k, const double *scouted, const timeint_result *r)
{
  struct memory *m = ti->confirmed;
  struct confirmed *c = &m->orbit[m->next];
  m->next = (m->next + 1) % REMEMBERED;
  c->k = k;
  c->omega = ti->omega;
  c->result = *r;
  for (int i = 0; i < ti->measure.n_responses; ++i) c->predicted[i] = (motion_error){NAN, NAN, NAN};
  memcpy(c->scouted, scouted, sizeof *scouted * (size_t)ti->n);
  timeint_get_state(ti, c->state);
}

/* What a result says of its orbit. */
static shoot_report report_of(const timeint_result *r)
{
  return (shoot_report){
      .distance = INFINITY, .multiplier = r->multiplier_re + I * r->multiplier_im, .free_sliders = r->free_sliders};
}

/* By CVODE alone, next to the scout's orbit at ti->y; stable, unless an orbit was asked for whatever its stability. */
static hc_status shoot_beside(timeint *ti, int k, bool stable, const hc_monitor *monitor, timeint_result *r)
{
  shoot_report found;
  const double size = timeint_motion_size(ti) / ti->length;
  hc_status st = shoot_newton(ti->shoot, k, near * size, orbit_goal(ti), monitor, &found);
  if (st == HC_OK && (!(found.moved <= near * size) || (stable && !(cabs(found.multiplier) < 1))))
    st = HC_NOT_CONVERGED;
  return st == HC_OK ? orbit_report(ti, k, TIMEINT_BY_SHOOTING, &found, r) : st;
}

static hc_status confirm_scouted(timeint *ti, const double *seen, const timeint_result *scouted, bool stable,
                                 const hc_monitor *monitor, timeint_result *r)
{
  const int k = scouted->period_multiple;
  const bool left_orbit = r->left_orbit;
  const int periods = r->scouted;
  shoot_report found = report_of(scouted);
  if (linear_regime_is_final(ti)) {
    linear_regime_steady(ti, r);
    return HC_OK;
  }
  const struct confirmed *known = recall(ti, k, seen);
  if (known) {
    *r = known->result;
    r->left_orbit = left_orbit; /* of this start; the switches are the orbit's */
    r->scouted = periods;
    return timeint_begin(ti, ti->omega, known->state);
  }
  hc_status st = confirm_orbit(ti->confirm, k, orbit_goal(ti), monitor, &found, r);
  r->contraction = scouted->contraction; /* its multiplier may be that of several times k periods */
  if (shoot_found_no_orbit(st)) st = shoot_beside(ti, k, stable, monitor, r);
  if (st == HC_OK) remember(ti, k, seen, r);
  return st;
}

/* One period of CVODE's where the scout found none that repeats. */
static hc_status report_unsettled(timeint *ti, const timeint_result *scouted, hc_status why, timeint_result *r)
{
  const shoot_report none = {.distance = INFINITY, .attainable = INFINITY, .multiplier = NAN};
  hc_status st = orbit_report(ti, 1, TIMEINT_BY_MARCHING, &none, r);
  r->period_multiple = 0;
  r->lyapunov = scouted->lyapunov;
  r->second_frequency = scouted->second_frequency;
  r->closure = scouted->closure;
  return st == HC_OK ? why : st;
}

/* Back to where the motion was before the scout's orbit was tried; what that took stays counted. */
static hc_status begin_again(timeint *ti, const double *state, const timeint_result *untouched, timeint_result *r)
{
  const int periods = ti->periods, scouted = r->scouted;
  const long steps = ti->steps0, rhs = ti->rhs0;
  *r = *untouched;
  r->scouted = scouted;
  hc_status st = timeint_begin(ti, ti->omega, state);
  ti->periods = periods;
  ti->steps0 = steps;
  ti->rhs0 = rhs;
  return st;
}

hc_status scout_steady(timeint *ti, int orbit_of, const double *state, const hc_monitor *monitor, timeint_result *r,
                       bool *done)
{
  timeint_result scouted, *untouched = &ti->confirmed->untouched;
  double *seen = ti->scout_state;
  *done = true;
  *untouched = *r;
  memcpy(seen, state, sizeof *seen * (size_t)ti->n);
  hc_status st = orbit_of > 0 ? timeint_orbit(ti->scout, ti->omega, orbit_of, seen, monitor, &scouted)
                              : timeint_steady(ti->scout, ti->omega, seen, monitor, &scouted);
  r->scouted = scouted.periods;
  r->scout_switches = st == HC_OK ? scouted.switches : -1;
  if (st == HC_INTERRUPTED || st == HC_NO_MEMORY) return st;
  const bool orbit_wanted = orbit_of > 0 || ti->how.steady == TRANSIENT_STEADY_SHOOTING;
  if (orbit_wanted && shoot_found_no_orbit(st) && st != HC_CHATTER)
    return st; /* where there is none, CVODE finds none */
  if (st == HC_OK || st == HC_NOT_SETTLED || st == HC_APERIODIC) {
    const hc_status why = st;
    st = timeint_begin(ti, ti->omega, seen);
    if (st == HC_OK) st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
    r->left_orbit = scouted.left_orbit;
    if (st == HC_OK && why == HC_OK) st = confirm_scouted(ti, seen, &scouted, orbit_of == 0, monitor, r);
    else if (st == HC_OK) st = report_unsettled(ti, &scouted, why, r);
    if (!shoot_found_no_orbit(st) || why != HC_OK) return st;
  }
  *done = false;
  return begin_again(ti, state, untouched, r);
}

hc_status scout_confirm(timeint *ti, int k, const hc_monitor *monitor, timeint_result *r, bool *done)
{
  shoot_report found = {.distance = INFINITY, .multiplier = NAN};
  *done = true;
  if (linear_regime_is_final(ti)) {
    linear_regime_steady(ti, r);
    return HC_OK;
  }
  hc_status st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  if (st == HC_OK) st = confirm_orbit(ti->confirm, k, orbit_goal(ti), monitor, &found, r);
  *done = !shoot_found_no_orbit(st);
  return *done ? st : HC_OK;
}
