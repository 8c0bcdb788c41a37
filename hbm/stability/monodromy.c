/* monodromy.c - see monodromy.h. The state is (dx, dx', dheld_1, ..., dheld_n); dheld_j counts only while contact j
 * is stuck. Row i of phi is state i, column q the initial state q. The period starts at the end of its longest
 * interval, since few motions outlast that (interval_flow.h); where contacts have two tangents with one limit, at th
 * = 0. */
#include "hbm/stability/monodromy.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/ascending.h"
#include "base/constants.h"
#include "hbm/stability/monodromy_impl.h"

static hc_status make_circles(const model *m, monodromy *w)
{
  w->track = calloc((size_t)m->n_contacts, sizeof *w->track);
  w->slipping = calloc((size_t)m->n_contacts, sizeof *w->slipping);
  return w->track && w->slipping ? planar_flow_new(m, &w->circles) : HC_NO_MEMORY;
}

hc_status monodromy_new(const model *m, monodromy **out)
{
  *out = calloc(1, sizeof **out);
  monodromy *w = *out;
  if (!w) return HC_NO_MEMORY;
  w->cap = 2;
  w->boundary = malloc((size_t)w->cap * sizeof(double));
  w->n = m->n;
  w->n_states = 2 * m->n + m->n_contacts;
  const size_t n = (size_t)w->n_states;
  w->phi = malloc(n * n * sizeof *w->phi);
  w->share = malloc(n * sizeof *w->share);
  w->interval = malloc(n * sizeof *w->interval);
  w->active = malloc(n * sizeof *w->active);
  w->slider = malloc(n * sizeof *w->slider);
  w->goes_on = malloc(n * sizeof *w->goes_on);
  w->lambda = malloc(n * sizeof *w->lambda);
  w->left = malloc(n * n * sizeof *w->left);
  const bool vectors = w->boundary && w->share && w->interval && w->active && w->slider && w->goes_on && w->lambda;
  const bool allocated = vectors && w->phi && w->left;
  hc_status st = allocated ? floquet_new(w->n_states, &w->floquet) : HC_NO_MEMORY;
  if (st == HC_OK) st = interval_flow_new(m, &w->flow);
  if (st == HC_OK && model_has_circle(m)) st = make_circles(m, w);
  if (st == HC_OK) return HC_OK;
  monodromy_free(w);
  *out = NULL;
  return st;
}

void monodromy_free(monodromy *w)
{
  if (!w) return;
  floquet_free(w->floquet);
  interval_flow_free(w->flow);
  planar_flow_free(w->circles);
  free(w->track);
  free(w->slipping);
  free(w->boundary);
  free(w->phi);
  free(w->left);
  free(w->share);
  free(w->interval);
  free(w->active);
  free(w->slider);
  free(w->goes_on);
  free(w->lambda);
  free(w);
}

static double wrap(double th) { return th >= TWO_PI ? th - TWO_PI : th; }

/* All angles of change in [0, 2 pi], where there are circles the ends included; their number or -1 without memory. */
static int collect_boundaries(monodromy *w, const contact_forces *orbit, int n_contacts)
{
  const bool ends = w->circles;
  int n = 2;
  for (int j = 0, intervals; j < n_contacts; ++j) {
    contact_forces_intervals(orbit, j, &intervals);
    n += 2 * intervals;
  }
  if (n > w->cap) {
    double *more = realloc(w->boundary, 2 * (size_t)n * sizeof(double));
    if (!more) return -1;
    w->boundary = more;
    w->cap = 2 * n;
  }
  const bool changes = n > 2;
  n = 0;
  if (ends || !changes) w->boundary[n++] = 0;
  if (ends) w->boundary[n++] = TWO_PI;
  for (int j = 0, intervals; j < n_contacts; ++j) {
    const contact_interval *p = contact_forces_intervals(orbit, j, &intervals);
    for (int k = 0; k < intervals; ++k) w->boundary[n++] = wrap(p[k].from), w->boundary[n++] = wrap(p[k].to);
  }
  qsort(w->boundary, (size_t)n, sizeof(double), ascending);
  return n;
}

/* Where the interval that begins at boundary i ends. */
static double end_of_interval(const monodromy *w, int n, int i)
{
  return i + 1 < n ? w->boundary[i + 1] : w->boundary[0] + TWO_PI;
}

const contact_interval *monodromy_interval_at(const contact_forces *orbit, int j, double th)
{
  int n;
  const contact_interval *p = contact_forces_intervals(orbit, j, &n);
  for (int i = 0; i < n; ++i) {
    bool covers = th >= p[i].from && th < p[i].to;
    bool covers_wrapped = th + TWO_PI >= p[i].from && th + TWO_PI < p[i].to;
    if (covers || covers_wrapped) return &p[i];
  }
  return NULL;
}

/* Is contact j's slider stuck all period? Slip intervals of less than 1e-6 rad in all count as stick: the slip path
 * goes with the square of their length, so 1e-6 rad move the slider by rounding only. They occur at shakedown: the
 * slider has moved until the largest |T| is just mu N, a graze. Such an orbit is the last of a family that differs
 * by where the slider rests; its one-sided derivative, as if it slipped at the graze, has the family's multiplier 1. */
static bool stuck_all_period(const contact_forces *orbit, int j)
{
  const double negligible_slip = 1e-6;
  double stuck = 0, touching = 0;
  int n;
  const contact_interval *p = contact_forces_intervals(orbit, j, &n);
  for (int i = 0; i < n; ++i) {
    touching += p[i].to - p[i].from;
    if (p[i].state == CONTACT_STICK) stuck += p[i].to - p[i].from;
  }
  return touching >= TWO_PI * (1 - 1e-15) && stuck >= touching - negligible_slip;
}

/* Is dheld_j a state of the system? Not if the slider is stuck all period, and not if every stick interval starts
 * with a touch-down that puts the slider at the same place whatever the motion: dheld_j is then 0 at all times. */
static bool slider_is_state(const contact_forces *orbit, int j)
{
  int n;
  const contact_interval *p = contact_forces_intervals(orbit, j, &n);
  for (int i = 0; i < n && !stuck_all_period(orbit, j); ++i) {
    double by[2];
    contact_forces_held_by(orbit, j, &p[i], by);
    if (p[i].state == CONTACT_STICK && (by[0] != 0 || by[1] != 0)) return true;
  }
  return false;
}

/* Does the slider of stick interval p come to rest at its start, which is th? */
static bool comes_to_rest_at(const contact_interval *p, double th)
{
  return p->from == p->origin && wrap(p->from) == th;
}

static bool rests_from_before(const contact_interval *p, double th)
{
  return p && p->state == CONTACT_STICK && !comes_to_rest_at(p, th);
}

static void set_slider(monodromy *w, const model *m, const contact_forces *orbit, int j, const contact_interval *p)
{
  const int n = w->n_states;
  const model_contact *c = &m->contacts[j];
  double *held = w->phi + (size_t)(2 * w->n + j) * (size_t)n, by[2];
  contact_forces_held_by(orbit, j, p, by);
  for (int q = 0; q < w->columns; ++q) held[q] = 0;
  for (int i = 0; i < w->n; ++i) {
    const double by_x = by[0] * c->tangent[i] + by[1] * c->normal[i];
    for (int q = 0; q < w->columns; ++q) held[q] += by_x * w->phi[(size_t)i * (size_t)n + (size_t)q];
  }
}

void monodromy_set_sliders(monodromy *w, const model *m, const contact_forces *orbit, double th)
{
  for (int j = 0; j < m->n_contacts; ++j) {
    const contact_interval *p = w->interval[j];
    bool rests = p && p->state == CONTACT_STICK && comes_to_rest_at(p, th);
    if (!rests || stuck_all_period(orbit, j)) continue;
    set_slider(w, m, orbit, j, p);
  }
}

/* Initial states: dx, dx', and dheld of each slider that is at rest when the period starts. Their number. */
int monodromy_initial_sliders(monodromy *w, const model *m, const contact_forces *orbit, int n_active, double th)
{
  for (int j = 0; j < m->n_contacts; ++j) {
    if (rests_from_before(w->interval[j], th) && slider_is_state(orbit, j)) w->active[n_active++] = 2 * w->n + j;
  }
  return n_active;
}

/* Of n states m have multipliers, those that outlast the longest interval: the others' are 0. */
static void summarise(int n, int m, const double complex *lambda, hbm_stability *out)
{
  double complex flip = 1, fold = 1, all = 1;
  const double complex largest = floquet_largest(m, lambda);
  for (int i = 0; i < m; ++i) {
    flip *= 1 + lambda[i];
    fold *= 1 - lambda[i];
    all *= lambda[i];
  }
  *out = (hbm_stability){.multiplier = cabs(largest), .re = creal(largest), .im = cimag(largest), .pair = NAN};
  for (int i = 0; i < m; ++i) {
    const double size = cabs(lambda[i]);
    if (!(cimag(lambda[i]) > 0)) continue; /* one of the two */
    out->pairs_outside += size > 1 + 1e-10;
    if (!(fabs(size - 1) >= fabs(out->pair - 1))) out->pair = size;
  }
  out->flip = creal(flip);
  out->fold = creal(fold);
  out->determinant = m < n ? 0 : creal(all);
}

/* Boundary at which the longest interval begins. */
static int find_longest(const monodromy *w, int n)
{
  int longest = 0;
  for (int i = 1; i < n; ++i)
    if (end_of_interval(w, n, i) - w->boundary[i] > end_of_interval(w, n, longest) - w->boundary[longest]) longest = i;
  return longest;
}

static bool is_empty(const monodromy *w, int n, int i) { return !(end_of_interval(w, n, i) > w->boundary[i]); }

/* The interval behind i; there may be boundaries twice. */
static int next_interval(const monodromy *w, int n, int i)
{
  int k = 1;
  while (k < n && is_empty(w, n, (i + k) % n)) ++k;
  return (i + k) % n;
}

static void enter_interval(monodromy *w, const model *m, const contact_forces *orbit, int n, int i)
{
  const double mid = 0.5 * (w->boundary[i] + end_of_interval(w, n, i));
  for (int j = 0; j < m->n_contacts; ++j) w->interval[j] = monodromy_interval_at(orbit, j, wrap(mid));
}

/* The sliders that are at rest over the interval `last`, and matter; and which of them still are on the one behind it.
 * Their number. */
static int collect_held_sliders(monodromy *w, const model *m, const contact_forces *orbit, int n, int last)
{
  const int behind = next_interval(w, n, last);
  int sliders = 0;
  enter_interval(w, m, orbit, n, last);
  for (int j = 0; j < m->n_contacts; ++j)
    if (w->interval[j] && w->interval[j]->state == CONTACT_STICK && slider_is_state(orbit, j)) w->slider[sliders++] = j;
  enter_interval(w, m, orbit, n, behind);
  for (int s = 0; s < sliders; ++s) w->goes_on[s] = rests_from_before(w->interval[w->slider[s]], w->boundary[behind]);
  return sliders;
}

/* Over the period that ends with the longest interval; the number of columns of w->left. */
static hc_status follow_period(monodromy *w, const model *m, const contact_forces *orbit, double omega, int n,
                               int *n_active)
{
  const int last = find_longest(w, n), sliders = collect_held_sliders(w, m, orbit, n, last);
  enter_interval(w, m, orbit, n, last);
  hc_status st = interval_flow_leave(w->flow, w->interval, (end_of_interval(w, n, last) - w->boundary[last]) / omega,
                                     sliders, w->slider, w->goes_on, w->phi, &w->columns);
  for (int k = 1; k <= n && st == HC_OK; ++k) {
    const int i = (last + k) % n;
    const double a = w->boundary[i], duration = (end_of_interval(w, n, i) - a) / omega;
    if (is_empty(w, n, i)) continue;
    enter_interval(w, m, orbit, n, i);
    monodromy_set_sliders(w, m, orbit, a);
    st = interval_flow_advance(w->flow, w->interval, duration, w->columns, w->phi);
  }
  if (st == HC_OK) st = interval_flow_left(w->flow, w->interval, w->slider, w->columns, w->phi, w->left);
  for (*n_active = 0; *n_active < w->columns; ++*n_active) w->active[*n_active] = *n_active;
  return st;
}

/* More than some minutes of eigenvectors: 30 (2 n)^3 operations an interval, each of its own combination of states. */
static bool is_too_much(const monodromy *w, int intervals)
{
  const double most = 4e11, states = 2.0 * w->n;
  return 30 * states * states * states * intervals > most;
}

hc_status monodromy_stability(monodromy *w, const model *m, const contact_forces *orbit, double omega,
                              hbm_stability *out)
{
  const int n = collect_boundaries(w, orbit, m->n_contacts);
  int n_active = 0;
  hc_status st = n < 0 ? HC_NO_MEMORY : is_too_much(w, n) ? HC_NOT_CONVERGED : HC_OK;
  if (st == HC_OK && w->circles) st = monodromy_follow_planar(w, m, orbit, omega, n, &n_active);
  else if (st == HC_OK) st = follow_period(w, m, orbit, omega, n, &n_active);
  const double *phi = w->circles ? w->phi : w->left;
  if (st == HC_OK) st = floquet_multipliers(w->floquet, phi, w->n_states, 1, n_active, w->active, w->lambda);
  if (st == HC_OK) summarise(2 * w->n, n_active, w->lambda, out);
  return st;
}
