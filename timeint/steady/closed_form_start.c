/* closed_form_start.c - see closed_form_start.h. */
#include "timeint/steady/closed_form_start.h"

#include <complex.h>
#include <string.h>

#include "timeint/steady/confirm.h"
#include "timeint/steady/escape.h"
#include "timeint/steady/linear_regime.h"
#include "timeint/steady/orbit.h"
#include "timeint/steady/period_map.h"
#include "timeint/steady/regularised.h"
#include "timeint/steady/timeint_private.h"

static const double closed_start_tolerance = 1e-12; /* rounding of a period is some 1e-14; CVODE confirms to 1e-9 */
static const double large_tolerance = 1e-8; /* of a large structure: the distance that periods by CVODE resolve */
static const double same_point = 1e-14; /* [1] a state that went to the model's units and back differs by rounding */
static const double same_orbit = 1e-9;  /* [sizes] between two such states: a hundred times what the orbits found are
                                          off; of large structures as much */

/* Orbits confirmed lately: another start at the same frequency often leads to one of them, and nothing is integrated
 * twice. Those of a handle have the same settings. */
enum { REMEMBERED = 2 };
struct memory {
  int next; /* to be overwritten */
  struct confirmed {
    int k; /* 0: empty */
    double omega;
    double *start, *state; /* [n] where the closed form was, where CVODE ended; in the model's units */
    timeint_result result;
    motion_error *predicted; /* [responses] */
  } orbit[REMEMBERED];
  timeint_result untouched; /* a result before the closed form's orbit was tried */
};

/* What ti needs beside its closed form, which is there. */
static hc_status use_closed_form(timeint *ti)
{
  if (ti->closed_form->slowed) period_map_borrow_from(ti->map, ti->closed_form->slowed->map);
  const size_t n = (size_t)ti->n;
  struct memory *m = ti->confirmed = workspace_array(&ti->memory, 1, sizeof *m);
  for (size_t i = 0; i < REMEMBERED && m; ++i) {
    m->orbit[i].start = workspace_doubles(&ti->memory, n);
    m->orbit[i].state = workspace_doubles(&ti->memory, n);
    m->orbit[i].predicted =
        workspace_array(&ti->memory, (size_t)ti->measure.n_responses, sizeof *m->orbit[i].predicted);
  }
  return ti->memory.failed ? HC_NO_MEMORY : HC_OK;
}

hc_status closed_start_new(timeint *ti)
{
  transient_settings how = ti->how;
  how.law = TRANSIENT_LAW_EXACT;
  how.method = TRANSIENT_METHOD_CLOSED_FORM;
  how.scout = false; /* it has none of its own */
  how.tolerance = fmin(how.tolerance, closed_start_tolerance);
  hc_status st = timeint_new_like(ti, &how, &ti->closed_form);
  if (st != HC_OK) return st;
  if (ti->closed_form->slowed) /* SHOOT_SHARE_OF_GOAL of it is reached */
    ti->closed_form->how.tolerance = fmin(ti->how.tolerance / SHOOT_SHARE_OF_GOAL, large_tolerance);
  return use_closed_form(ti);
}

hc_status closed_start_share(timeint *ti, timeint *closed_form)
{
  ti->closed_form = closed_form;
  ti->shares_closed_form = true;
  ++closed_form->owners;
  return use_closed_form(ti);
}

/* True if the two differ by rounding only. */
static bool same_state(int n, const double *a, const double *b)
{
  double apart = 0, size = 0;
  for (int i = 0; i < n; ++i) apart = fmax(apart, fabs(a[i] - b[i])), size = fmax(size, fabs(a[i]));
  return apart <= same_point * size;
}

void timeint_forget(timeint *ti)
{
  for (int i = 0; ti->confirmed && i < REMEMBERED; ++i) ti->confirmed->orbit[i].k = 0;
}

/* The orbit that was reached from this one in closed form, if it is remembered; else NULL. */
static const struct confirmed *recall_confirmed(const timeint *ti, int k, const double *start)
{
  double *here = ti->point[0], *there = ti->point[1];
  timeint_take_state(ti, start, here);
  for (int i = 0; i < REMEMBERED; ++i) {
    const struct confirmed *c = &ti->confirmed->orbit[i];
    if (c->k != k || c->omega != ti->omega) continue;
    timeint_take_state(ti, c->start, there);
    if (timeint_farthest(ti, here, there) <= same_orbit) return c;
  }
  return NULL;
}

motion_error *closed_start_predictions(timeint *ti, const double *state, const double **start)
{
  for (int i = 0; i < REMEMBERED; ++i) {
    struct confirmed *c = &ti->confirmed->orbit[i];
    if (c->k > 0 && c->omega == ti->omega && same_state(ti->n, c->state, state)) {
      *start = c->start;
      return c->predicted;
    }
  }
  return NULL;
}

/* From the closed form's orbit, at `start`, to CVODE's. */
static hc_status confirm_or_shoot(timeint *ti, const double *start, const timeint_result *first, bool stable,
                                  const hc_monitor *monitor, timeint_result *r)
{
  const int k = first->period_multiple;
  const bool left_orbit = r->left_orbit;
  const int periods = r->closed_form_periods;
  /* What a result says of its orbit. */
  shoot_report found = {.distance = INFINITY,
                        .multiplier = first->multiplier_re + I * first->multiplier_im,
                        .free_sliders = first->free_sliders};
  if (linear_regime_steady(ti, r)) return HC_OK;
  const struct confirmed *known = recall_confirmed(ti, k, start);
  if (known) {
    *r = known->result;
    r->left_orbit = left_orbit; /* of this start; the switches are the orbit's */
    r->closed_form_periods = periods;
    return timeint_begin(ti, ti->omega, known->state);
  }
  const double off = ti->how.law == TRANSIENT_LAW_EXACT ? 0 : ti->how.regularisation * timeint_scaled_size(ti);
  hc_status st = confirm_orbit(ti, k, orbit_goal(ti), off, monitor, &found, r);
  r->contraction = first->contraction; /* its multiplier may be that of several times k periods */
  /* By CVODE alone, next to the closed form's orbit at ti->y; stable, unless an orbit was asked for whatever its
   * stability. */
  if (shoot_found_no_orbit(st)) {
    shoot_report beside;
    const double size = timeint_scaled_size(ti);
    hc_status tried = shoot_newton(ti->shoot, k, ORBIT_NEXT_TO * size, orbit_goal(ti), monitor, &beside);
    if (tried == HC_OK && (!(beside.moved <= ORBIT_NEXT_TO * size) || (stable && !(cabs(beside.multiplier) < 1))))
      tried = HC_NOT_CONVERGED;
    st = tried == HC_OK ? orbit_report(ti, k, TIMEINT_BY_SHOOTING, &beside, r) : tried;
  }
  return st;
}

void closed_start_remember(timeint *ti, const double *state, const timeint_result *r)
{
  struct memory *m = ti->confirmed;
  if (!m || !ti->measured) return;
  struct confirmed *c = &m->orbit[m->next];
  m->next = (m->next + 1) % REMEMBERED;
  c->k = r->period_multiple;
  c->omega = ti->omega;
  c->result = *r;
  for (int i = 0; i < ti->measure.n_responses; ++i) c->predicted[i] = (motion_error){NAN, NAN, NAN};
  memcpy(c->start, ti->closed_form_state, sizeof *c->start * (size_t)ti->n);
  memcpy(c->state, state, sizeof *c->state * (size_t)ti->n);
}

/* Back to where the motion was before the closed form's orbit was tried; what that took stays counted. */
static hc_status begin_again(timeint *ti, const double *state, const timeint_result *untouched, timeint_result *r)
{
  const int periods = ti->periods, closed_form_periods = r->closed_form_periods;
  const long steps = ti->steps0, rhs = ti->rhs0;
  *r = *untouched;
  r->closed_form_periods = closed_form_periods;
  hc_status st = timeint_begin(ti, ti->omega, state);
  ti->periods = periods;
  ti->steps0 = steps;
  ti->rhs0 = rhs;
  return st;
}

hc_status closed_start_steady(timeint *ti, int orbit_of, const double *state, const hc_monitor *monitor,
                              timeint_result *r, bool *done)
{
  timeint_result first, *untouched = &ti->confirmed->untouched;
  double *start = ti->closed_form_state;
  *done = true;
  *untouched = *r;
  memcpy(start, state, sizeof *start * (size_t)ti->n);
  hc_status st = orbit_of > 0 ? timeint_orbit(ti->closed_form, ti->omega, orbit_of, start, monitor, &first)
                              : timeint_steady(ti->closed_form, ti->omega, start, monitor, &first);
  r->closed_form_periods = first.periods;
  /* Steady growth is believed; a size beyond all bounds may be numbers too large for closed form. */
  const bool grew = st == HC_UNBOUNDED && escape_size(ti->closed_form) == HC_OK;
  if (st == HC_INTERRUPTED || st == HC_NO_MEMORY || grew) return st;
  const bool orbit_wanted = orbit_of > 0 || ti->how.steady == TRANSIENT_STEADY_SHOOTING;
  if (orbit_wanted && shoot_found_no_orbit(st) && st != HC_CHATTER)
    return st; /* where there is none, CVODE finds none */
  if (st == HC_OK || st == HC_NOT_SETTLED || st == HC_APERIODIC || st == HC_CREEPS) {
    const hc_status why = st;
    st = timeint_begin(ti, ti->omega, start);
    if (st == HC_OK) st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
    r->left_orbit = first.left_orbit;
    if (st == HC_OK) timeint_use_measured(ti, ti->closed_form);
    if (st == HC_OK && why == HC_OK) st = confirm_or_shoot(ti, start, &first, orbit_of == 0, monitor, r);
    else if (st == HC_OK) {
      ti->creeps = why == HC_CREEPS;
      if (ti->creeps) memcpy(ti->drift, ti->closed_form->drift, sizeof *ti->drift * (size_t)ti->n_dof);
      st = orbit_report_none(ti, why, r);
      r->lyapunov = first.lyapunov;
      r->second_frequency = first.second_frequency;
      r->closure = first.closure;
    }
    if (!shoot_found_no_orbit(st) || why != HC_OK) return st;
  }
  *done = false;
  return begin_again(ti, state, untouched, r);
}

hc_status closed_start_confirm(timeint *ti, int k, const hc_monitor *monitor, timeint_result *r, bool *done)
{
  shoot_report found = {.distance = INFINITY, .multiplier = NAN};
  *done = true;
  if (linear_regime_steady(ti, r)) return HC_OK;
  hc_status st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  if (st == HC_OK) st = regularised_begin(ti, k, monitor);
  if (st == HC_OK) st = confirm_orbit(ti, k, orbit_goal(ti), 0, monitor, &found, r);
  *done = !shoot_found_no_orbit(st);
  return *done ? st : HC_OK;
}
