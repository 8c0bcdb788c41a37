/* integrate_closed_form.c - see integrate.h. Proof: tests/timeint/test_structure.c. */
#include <stdlib.h>
#include <string.h>

#include "numerics/base/constants.h"
#include "timeint/closed_form/fundamental_matrix.h"
#include "timeint/closed_form/motion_modes.h"
#include "timeint/closed_form/motion_series.h"
#include "timeint/closed_form/motion_single.h"
#include "timeint/period/integrate_private.h"

enum {
  MAX_STEPS = 10000000 /* per period */
};

typedef struct by_series { /* from integrate_new_closed_form, to integrate_free; not shared between threads */
  integrator base;
  int n, n_contacts;
  const scaled_model *m; /* model of the current period; not owned */
  contact_track *track;  /* [n_contacts] current contact states */
  double theta, length;  /* [rad] start of the current step, and its length */
  double *y, *end;       /* [2 n] motion at its start and at its end */
  double *response;      /* [TRACK_ORDER + 1] series of one response */
  motion_series series;
  interval_modes *modes; /* or NULL */
  motion_modes stiff;    /* the motion since stiff.theta, if by_modes */
  bool fits_single;
  motion_single single; /* the motion of the current step, if by_single; made only if fits_single */
  bool by_modes, by_single;
  fundamental_matrix variations;
  workspace memory; /* of all arrays */
} by_series;

static hc_status begin(by_series *in, const double *y)
{
  double size = 0;
  for (int i = 0; i < in->m->n_states; ++i) size += fabs(y[i]);
  if (!isfinite(size)) return HC_NOT_FINITE;
  memcpy(in->y, y, 2 * (size_t)in->n * sizeof *y);
  for (int j = 0; j < in->n_contacts; j += scaled_directions(in->m, j)) {
    const contact_motion at = scaled_motion_at(in->m, j, y);
    contact_track_begin(&in->track[j], &in->m->contact[j], &at, y + 2 * in->n + j);
  }
  return HC_OK;
}

/* True if all guards are linear in the motion, hence sums of exponentials. */
static bool guards_are_linear(const by_series *in)
{
  for (int j = 0; j < in->n_contacts; ++j)
    if (!contact_track_is_linear(&in->track[j], &in->m->contact[j])) return false;
  return true;
}

/* Chooses the method of the next step: by_single, by_modes (the motion is then in in->stiff), else by series. */
static hc_status choose(by_series *in)
{
  const complex_modes *modes;
  const double omega = 1 / in->m->by_C;
  const bool linear = guards_are_linear(in);
  in->by_modes = false;
  in->by_single = in->fits_single && linear;
  if (in->by_single || !linear || !interval_modes_pay(in->modes, omega, INFINITY)) return HC_OK;
  hc_status st = interval_modes_of(in->modes, in->m, in->track, &modes);
  if (st == HC_OK && modes) in->by_modes = motion_modes_begin(&in->stiff, modes, in->m, in->track, in->theta, in->y);
  return st;
}

/* The first event within the step, which is shortened to it; returns its contact, -1: none. */
static int find_event(by_series *in, track_event *event)
{
  int first = -1;
  for (int j = 0; j < in->n_contacts; j += scaled_directions(in->m, j)) {
    track_guard guard[TRACK_GUARDS];
    const int n = motion_series_guards(&in->series, in->m, in->track, j, guard);
    for (int g = 0; g < n; ++g) {
      const double at = series_first_fall(&guard[g], in->length);
      if (!(at < in->length || (at == in->length && first < 0))) continue;
      in->length = at;
      first = j;
      *event = guard[g].event;
    }
  }
  return first;
}

/* The motion of contact j at the end of the step. */
static contact_motion contact_at_end(const by_series *in, int j)
{
  const int directions = scaled_directions(in->m, j);
  if (in->by_single) return scaled_motion_at(in->m, j, in->end);
  if (in->by_modes) return motion_modes_contact(&in->stiff, j, directions, in->theta + in->length - in->stiff.theta);
  return motion_series_contact(&in->series, j, directions, in->length);
}

/* Passes the event of contact j at the end of the step. */
static hc_status pass(by_series *in, int j, track_event event, bool varies, int *count)
{
  const scaled_contact *c = &in->m->contact[j];
  contact_track *t = &in->track[j];
  const contact_track before[2] = {t[0], t[c->kind->directions - 1]};
  const contact_motion at = contact_at_end(in, j);
  *count += c->kind->counts(t, event, in->theta + in->length);
  if (*count > integrate_most_transitions(in->n_contacts)) return HC_CHATTER;
  if (varies) {
    hc_status st = fundamental_matrix_advance(&in->variations, in->m, in->track, in->theta + in->length);
    if (st != HC_OK) return st;
  }
  contact_track_pass(t, c, event, &at);
  contact_track_note(t, c, &at);
  if (!varies) return HC_OK;
  fundamental_matrix_pass(&in->variations, in->m, j, before, t, &at);
  fundamental_matrix_follow(&in->variations, in->m, in->track, in->end);
  return HC_OK;
}

/* Passes the event of contact `changing` (-1: none) at the end of the step; the next step starts at theta. */
static hc_status end_step(by_series *in, int changing, track_event event, bool varies, double theta, int *count)
{
  hc_status st = changing >= 0 ? pass(in, changing, event, varies, count) : HC_OK;
  if (st != HC_OK) return st;
  memcpy(in->y, in->end, 2 * (size_t)in->n * sizeof *in->y);
  /* At the end of the step. */
  for (int j = 0; j < in->n_contacts; j += scaled_directions(in->m, j)) {
    if (!in->track[j].turns) continue;
    const contact_motion at = contact_at_end(in, j);
    contact_track_note(&in->track[j], &in->m->contact[j], &at);
  }
  in->theta = theta;
  return HC_OK;
}

/* One step by series, or to the first event within it. */
static hc_status step_by_series(by_series *in, bool varies, integrate_watch *watch, void *self, int *count)
{
  track_event event = TRACK_STICKS;
  const double left = TWO_PI - in->theta;
  double held;
  const double exact = motion_series_begin(&in->series, in->m, in->track, in->theta, in->y, &held);
  const double reach = fmin(held, exact);
  if (!(reach > 0)) return HC_NOT_FINITE;
  in->length = fmin(reach, left);
  const int changing = find_event(in, &event);
  const bool last = !(in->length < left);
  const double end = last ? TWO_PI : in->theta + in->length;
  motion_series_at(&in->series, in->length, 0, in->end);
  ++in->base.steps;
  ++in->base.rhs;
  hc_status st = watch && end > in->theta ? watch(self, &in->base, in->theta, end) : HC_OK;
  motion_series_turn(&in->series, in->length, in->track);
  return st == HC_OK ? end_step(in, changing, event, varies, end, count) : st;
}

/* By complex modes to the first event, in watched steps. */
static hc_status interval_by_modes(by_series *in, bool varies, integrate_watch *watch, void *self, int *count)
{
  track_event event = TRACK_STICKS;
  const double from = in->theta, left = TWO_PI - from;
  double span = left;
  const int changing = motion_modes_first_event(&in->stiff, in->m, in->track, &span, &event);
  const double end = span < left ? from + span : TWO_PI;
  const int steps = watch ? 1 + (int)(span / INTEGRATE_LONGEST_STEP) : 1;
  ++in->base.rhs;
  for (int i = 1; i <= steps; ++i) {
    const double to = i < steps ? from + span * i / steps : end;
    in->length = to - in->theta;
    ++in->base.steps;
    hc_status st = watch && to > in->theta ? watch(self, &in->base, in->theta, to) : HC_OK;
    if (st != HC_OK) return st;
    if (i < steps) in->theta = to;
  }
  motion_modes_at(&in->stiff, span, 0, in->end);
  return end_step(in, changing, event, varies, end, count);
}

/* In closed form to the first event; if watched, also to the first turn of X. */
static hc_status step_in_closed_form(by_series *in, bool varies, integrate_watch *watch, void *self, int *count)
{
  track_event event = TRACK_STICKS;
  const double left = TWO_PI - in->theta;
  int changing;
  in->length = left;
  hc_status st = motion_single_go(&in->single, in->m, in->track, in->theta, in->y, watch != NULL, &in->length,
                                  &changing, &event, &in->base.rhs);
  const double end = in->length < left ? in->theta + in->length : TWO_PI;
  in->end[0] = in->single.end.q;
  in->end[1] = in->single.end.p;
  ++in->base.steps;
  if (st == HC_OK && watch && end > in->theta) st = watch(self, &in->base, in->theta, end);
  return st == HC_OK ? end_step(in, changing, event, varies, end, count) : st;
}

/* From theta = 0 to the end of the period. */
static hc_status run(by_series *in, bool varies, integrate_watch *watch, void *self, int *count)
{
  in->theta = 0;
  for (int steps = 0; in->theta < TWO_PI; ++steps) {
    hc_status st = choose(in);
    if (st == HC_OK && in->by_single) st = step_in_closed_form(in, varies, watch, self, count);
    else if (st == HC_OK) st = (in->by_modes ? interval_by_modes : step_by_series)(in, varies, watch, self, count);
    if (st != HC_OK) return st;
    if (steps > MAX_STEPS) return HC_CHATTER;
    if (!integrate_goes_on(&in->base)) return HC_INTERRUPTED;
  }
  return HC_OK;
}

/* The direction of a slip that turns, at tau of the step. */
typedef struct turned_at {
  const motion_series *series;
  double tau;
} turned_at;

static void turn(const void *self, int j, contact_track *t)
{
  const turned_at *at = self;
  motion_series_direction(at->series, j, at->tau, t);
}

static hc_status period(integrator *base, const scaled_model *m, double *y, double *monodromy, integrate_watch *watch,
                        void *self)
{
  by_series *in = (by_series *)base;
  int count = 0;
  in->m = m;
  if (m->n != in->n || m->n_contacts != in->n_contacts) return HC_BUG;
  hc_status st = begin(in, y);
  if (st == HC_OK && monodromy) st = fundamental_matrix_begin(&in->variations, m, in->track, y, base->coarse);
  if (st == HC_OK) st = run(in, monodromy != NULL, watch, self, &count);
  if (st == HC_OK && monodromy) st = fundamental_matrix_advance(&in->variations, m, in->track, TWO_PI);
  base->transitions += count;
  if (st != HC_OK) return st;
  memcpy(y, in->y, 2 * (size_t)in->n * sizeof *y);
  integrate_sliders(in->track, m, 0, NULL, NULL, y);
  contact_track_end(in->track, in->n_contacts, y + 2 * in->n);
  if (monodromy) fundamental_matrix_end(&in->variations, m, in->track, y, monodromy);
  return HC_OK;
}

static hc_status dense(const integrator *base, double theta, int order, double *y)
{
  by_series *in = (by_series *)base; /* whose rooms for sums are used */
  if (in->by_single) motion_single_at(&in->single, theta - in->theta, order, y);
  else if (in->by_modes) motion_modes_at(&in->stiff, theta - in->stiff.theta, order, y);
  else motion_series_at(&in->series, theta - in->theta, order, y);
  const turned_at at = {&in->series, theta - in->theta};
  integrate_sliders(in->track, in->m, order, in->by_modes || in->by_single ? NULL : turn, &at, y);
  return HC_OK;
}

static void expand_response(const by_series *in, int i)
{
  motion_series_of(&in->series, in->m->base->response + (size_t)i * (size_t)in->n, in->response);
}

static hc_status samples(const integrator *base, int i, double theta, double step, int count, double *x)
{
  const by_series *in = (const by_series *)base;
  if (in->by_single) {
    const double r = in->m->base->response[i];
    modal_samples(&in->single.motion, theta, step, count, x);
    for (int k = 0; k < count && r != 1; ++k) x[k] *= r;
    return HC_OK;
  }
  for (int k = 0; k < count && in->by_modes; ++k)
    x[k] = motion_modes_response(&in->stiff, i, theta + k * step - in->stiff.theta);
  if (in->by_modes) return HC_OK;
  expand_response(in, i);
  for (int k = 0; k < count; ++k) x[k] = series_value(in->response, theta + k * step - in->theta);
  return HC_OK;
}

/* Integral of the product of two series over [0, h]. */
static double integral_of_product(const double *a, const double *b, double h)
{
  double sum = 0, power = h;
  for (int m = 0; m <= 2 * TRACK_ORDER; ++m, power *= h) {
    double c = 0;
    const int from = m > TRACK_ORDER ? m - TRACK_ORDER : 0, to = m < TRACK_ORDER ? m : TRACK_ORDER;
    for (int k = from; k <= to; ++k) c += a[k] * b[m - k];
    sum += c * power / (m + 1);
  }
  return sum;
}

static bool fourier(const integrator *base, int i, double out[3])
{
  const by_series *in = (const by_series *)base;
  const double h = in->length, since = in->theta - in->stiff.theta;
  if (in->by_single) {
    const bool known = motion_single_fourier(&in->single, out);
    for (int k = 0; k < 3; ++k) out[k] *= in->m->base->response[i];
    return known;
  }
  if (in->by_modes) {
    motion_modes_fourier(&in->stiff, i, since, since + h, out);
    return true;
  }
  double cosine[TRACK_ORDER + 1] = {cos(in->theta)}, sine[TRACK_ORDER + 1] = {sin(in->theta)}, power = h;
  expand_response(in, i);
  for (int k = 1; k <= TRACK_ORDER; ++k) {
    cosine[k] = -sine[k - 1] / k;
    sine[k] = cosine[k - 1] / k;
  }
  out[0] = 0;
  for (int k = 0; k <= TRACK_ORDER; ++k, power *= h) out[0] += in->response[k] * power / (k + 1);
  out[1] = integral_of_product(in->response, cosine, h);
  out[2] = integral_of_product(in->response, sine, h);
  return h <= 3; /* beyond, the truncated series of the cosine is inaccurate */
}

static bool extremes(const integrator *base, int i, double *max, double *min)
{
  by_series *in = (by_series *)base; /* whose rooms for sums are used */
  const double since = in->theta - in->stiff.theta;
  if (in->by_modes) motion_modes_extremes(&in->stiff, i, since, since + in->length, max, min);
  if (in->by_single) { /* the step ends where X turns */
    const double r = in->m->base->response[i], from = r * in->y[0], to = r * in->end[0];
    *max = fmax(from, to);
    *min = fmin(from, to);
  }
  return in->by_modes || in->by_single;
}

static void release(integrator *base)
{
  by_series *in = (by_series *)base;
  interval_modes_free(in->modes);
  workspace_free(&in->memory);
  free(in);
}

static const integrator_class class = {
    .period = period, .dense = dense, .samples = samples, .fourier = fourier, .extremes = extremes, .free = release};

hc_status integrate_new_closed_form(const modal_base *base, double stiff, integrator **out)
{
  const size_t n = (size_t)base->n, contacts = (size_t)base->n_contacts;
  *out = NULL;
  by_series *in = calloc(1, sizeof *in); /* zeroed, so free works half-built */
  if (!in) return HC_NO_MEMORY;
  in->base.does = &class;
  in->base.has_coarse = base->n_planar > 0; /* where slip turns, a matrix takes up to fifty times the time of a
                                               period */
  in->n = base->n;
  in->n_contacts = base->n_contacts;
  workspace *w = &in->memory;
  in->base.track = in->track = workspace_array(w, contacts, sizeof *in->track);
  in->y = workspace_doubles(w, 2 * n);
  in->end = workspace_doubles(w, 2 * n);
  in->response = workspace_doubles(w, TRACK_TERMS);
  in->fits_single = motion_single_fits(base);
  hc_status st = motion_series_make(&in->series, base, w);
  if (st == HC_OK) st = interval_modes_new(base, stiff, &in->modes);
  if (st == HC_OK) st = motion_modes_make(&in->stiff, base, w);
  if (st == HC_OK && in->fits_single) st = motion_single_make(&in->single, base, w);
  if (st == HC_OK) st = fundamental_matrix_make(&in->variations, base, in->modes, w);
  if (st == HC_OK) {
    *out = &in->base;
    return HC_OK;
  }
  release(&in->base);
  return st;
}
