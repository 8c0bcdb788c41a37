/* orbit_events.c - see orbit_events.h. Proof: tests/timeint/test_orbit_events.c. */
#include "timeint/steady/orbit_events.h"

#include <stdlib.h>
#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/base/growing.h"
#include "timeint/law/contact_track.h"
#include "timeint/steady/timeint_private.h"

static const double one_event = 1e-11; /* [1] of a period: closer events are one */
enum { LOOKS = 256 }; /* a period, for the extrema of the sliders' limits: off by (pi/256)^2/2 of their range */

typedef struct events_watch {
  const timeint *ti;
  orbit_events *out;
  double turned; /* [rad] periods before this one */
  double *y;     /* [n_states] where it is looked at */
} events_watch;

/* Room for one more event. */
static bool grow(orbit_events *e)
{
  const size_t row = (size_t)e->n_dof * sizeof *e->x, states = (size_t)e->n_contacts * sizeof *e->states;
  void *x = growing(e->x, e->n, row), *v = growing(e->v, e->n, row), *s = growing(e->states, e->n, states + 1);
  if (x) e->x = x;
  if (v) e->v = v;
  if (s) e->states = s;
  return GROW(e->t, e->n) && x && v && s;
}

static contact_state *states_of(const orbit_events *e, int i) { return e->states + (size_t)i * (size_t)e->n_contacts; }

static bool same_states(const orbit_events *e, int i, int k)
{
  return !memcmp(states_of(e, i), states_of(e, k), (size_t)e->n_contacts * sizeof *e->states);
}

/* Event `from` with all that is said of it becomes event `to`. */
static void move(orbit_events *e, int to, int from)
{
  const size_t n = (size_t)e->n_dof;
  e->t[to] = e->t[from];
  memmove(e->x + n * (size_t)to, e->x + n * (size_t)from, n * sizeof *e->x);
  memmove(e->v + n * (size_t)to, e->v + n * (size_t)from, n * sizeof *e->v);
  memmove(states_of(e, to), states_of(e, from), (size_t)e->n_contacts * sizeof *e->states);
}

static hc_status add_event(events_watch *w, const integrator *in, double theta)
{
  orbit_events *e = w->out;
  const timeint *ti = w->ti;
  const size_t at = (size_t)e->n * (size_t)e->n_dof;
  if (!grow(e)) return HC_NO_MEMORY;
  hc_status st = integrate_dense(in, theta, 0, w->y);
  modal_base_to_model(ti->base, w->y, e->x + at);
  modal_base_to_model(ti->base, w->y + e->n_dof, e->v + at);
  for (int i = 0; i < e->n_dof; ++i) {
    e->x[at + (size_t)i] = e->x[at + (size_t)i] * ti->length + ti->rest[i];
    e->v[at + (size_t)i] *= ti->length * ti->omega;
  }
  e->t[e->n] = (w->turned + theta) / ti->omega;
  for (int j = 0; j < e->n_contacts; ++j) states_of(e, e->n)[j] = integrate_contact(in, j, w->y);
  ++e->n;
  return st;
}

/* What the slider of a contact that sticks may be, at this instant. */
static void note_limits(events_watch *w, const integrator *in)
{
  const scaled_model *m = &w->ti->scaled;
  orbit_events *e = w->out;
  for (int j = 0; j < e->n_contacts; ++j) {
    const scaled_contact *c = &m->contact[j];
    double u[2], v;
    if (!c->law.has_friction || integrate_contact(in, j, w->y) != CONTACT_STICK) e->rest[j] = NAN;
    if (isnan(e->rest[j])) continue;
    scaled_contact_motion(m, j, w->y, u, &v);
    const double radius = contact_track_radius(c, v);
    e->lowest[j] = fmax(e->lowest[j], (u[0] - radius) * w->ti->length + w->ti->rest_u[j]);
    e->highest[j] = fmin(e->highest[j], (u[0] + radius) * w->ti->length + w->ti->rest_u[j]);
  }
}

static hc_status watch_step(void *self, const integrator *in, double theta0, double theta1)
{
  events_watch *w = self;
  orbit_events *e = w->out;
  bool changed = e->n == 0;
  for (int j = 0; j < e->n_contacts && !changed; ++j)
    changed = states_of(e, e->n - 1)[j] != integrate_contact(in, j, w->y);
  hc_status st = changed ? add_event(w, in, theta0) : HC_OK;
  const int looks = 1 + (int)((theta1 - theta0) * LOOKS / TWO_PI);
  for (int i = 0; i <= looks && st == HC_OK; ++i) {
    st = integrate_dense(in, theta0 + (theta1 - theta0) * i / looks, 0, w->y);
    note_limits(w, in);
  }
  return st;
}

/* Only changes remain, each once: the first entry of the list was the cut at t = 0, which is none unless the last
 * state is another one. */
static void keep_changes(orbit_events *e, double period, double span)
{
  int kept = 0;
  for (int i = 0; i < e->n; ++i) { /* of events that are one, the last tells the state */
    const double until = i + 1 < e->n ? e->t[i + 1] : span;
    if (i + 1 < e->n && until - e->t[i] < one_event * period) continue;
    if (kept > 0 && same_states(e, kept - 1, i)) continue;
    move(e, kept++, i);
  }
  e->n = kept;
  if (e->n > 1 && span - e->t[e->n - 1] < one_event * period) --e->n;
  if (e->n > 1 && same_states(e, 0, e->n - 1)) {
    for (int i = 1; i < e->n; ++i) move(e, i - 1, i);
    --e->n;
  }
}

static hc_status make(const timeint *ti, orbit_events *out)
{
  const size_t n_contacts = (size_t)ti->model->n_contacts;
  *out = (orbit_events){.n_dof = ti->n_dof, .n_contacts = ti->model->n_contacts};
  out->rest = calloc(3 * n_contacts + 1, sizeof *out->rest);
  if (!out->rest) return HC_NO_MEMORY;
  out->lowest = out->rest + n_contacts;
  out->highest = out->lowest + n_contacts;
  for (size_t j = 0; j < n_contacts; ++j) {
    out->rest[j] = ti->y[2 * ti->n_dof + (int)j] * ti->length + ti->rest_u[j];
    out->lowest[j] = -INFINITY;
    out->highest[j] = INFINITY;
  }
  return HC_OK;
}

/* The events of k periods from ti->y, after others. */
static hc_status watch(timeint *ti, int after, int k, orbit_events *out)
{
  const double period = TWO_PI / ti->omega;
  double *y = ti->point[2];
  events_watch w = {.ti = ti, .out = out, .y = ti->point[0]};
  hc_status st = make(ti, out);
  if (ti->how.law != TRANSIENT_LAW_EXACT || model_has_circle(ti->model)) return HC_UNSUPPORTED;
  memcpy(y, ti->y, (size_t)ti->n * sizeof *y);
  if (st == HC_OK) st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  for (int i = -after; i < k && st == HC_OK; ++i) {
    w.turned = TWO_PI * fmax(i, 0);
    if (i <= 0) out->n = 0;
    st = integrate_period(ti->in, &ti->scaled, y, watch_step, &w);
  }
  if (st == HC_OK) keep_changes(out, period, k * period);
  return st;
}

hc_status timeint_events(timeint *ti, int k, orbit_events *out) { return watch(ti, 0, k > 0 ? k : 1, out); }

hc_status timeint_motion_events(timeint *ti, double omega, const double *state, int after, orbit_events *out)
{
  const hc_status st = timeint_begin(ti, omega, state);
  return st == HC_OK ? watch(ti, after, 1, out) : st;
}

void orbit_events_free(orbit_events *e)
{
  free(e->t);
  free(e->x);
  free(e->v);
  free(e->states);
  free(e->rest);
  *e = (orbit_events){0};
}
