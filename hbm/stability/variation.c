/* variation.c - see variation.h. */
#include "hbm/stability/variation.h"

#include <string.h>

#include "numerics/base/constants.h"
#include "numerics/base/number.h"

/* What a law is to a perturbation, of its first contact j. */
struct perturbed_law {
  int contacts;                                       /* of the model that are followed together */
  void (*enter)(variation *v, int j, double th);      /* v->interval[] on the interval around th */
  void (*start)(variation *v, int j, double th);      /* the rows of its sliders where that interval begins, at th */
  void (*add_states)(variation *v, int j, double th); /* to v->active, its states that the period begins with, at th */
};

/* ---- the intervals of a period ------------------------------------------------------------------ */

static double wrap(double th) { return th >= TWO_PI ? th - TWO_PI : th; }

/* True if [from, to), which may begin before 2 pi and end behind it, covers th in [0, 2 pi). */
static bool covers(double from, double to, double th)
{
  return (th >= from && th < to) || (th + TWO_PI >= from && th + TWO_PI < to);
}

/* Room for so many more boundaries than n. */
static bool has_room(variation *v, int n, int more)
{
  const size_t most = (size_t)n + (size_t)more;
  if (most <= v->cap) return true;
  double *room = realloc(v->boundary, 2 * most * sizeof *room);
  if (room) v->boundary = room, v->cap = 2 * most;
  return room != NULL;
}

hc_status variation_begin(variation *v, const contact_forces *orbit, double omega)
{
  int n = 0;
  v->orbit = orbit;
  v->omega = omega;
  for (int j = 0, intervals; j < v->m->n_contacts; ++j) {
    const contact_interval *p = contact_forces_intervals(orbit, j, &intervals);
    if (!has_room(v, n, 2 * intervals)) return HC_NO_MEMORY;
    for (int k = 0; k < intervals; ++k) v->boundary[n++] = wrap(p[k].from), v->boundary[n++] = wrap(p[k].to);
  }
  if (!has_room(v, n, 1 + v->parts)) return HC_NO_MEMORY;
  if (n == 0) v->boundary[n++] = 0;
  for (int k = 0; k < v->parts; ++k) v->boundary[n++] = TWO_PI * k / v->parts;
  qsort(v->boundary, (size_t)n, sizeof(double), ascending);
  v->n_intervals = n;
  return HC_OK;
}

double variation_end(const variation *v, int i)
{
  return i + 1 < v->n_intervals ? v->boundary[i + 1] : v->boundary[0] + TWO_PI;
}

bool variation_is_empty(const variation *v, int i) { return !(variation_end(v, i) > v->boundary[i]); }

/* The interval behind i that is not empty. */
static int next_interval(const variation *v, int i)
{
  const int n = v->n_intervals;
  int k = 1;
  while (k < n && variation_is_empty(v, (i + k) % n)) ++k;
  return (i + k) % n;
}

void variation_enter(variation *v, int i)
{
  const double middle = wrap(0.5 * (v->boundary[i] + variation_end(v, i)));
  v->n_slipping = 0;
  for (int j = 0; j < v->m->n_contacts; j += v->track[j].law->contacts) v->track[j].law->enter(v, j, middle);
}

void variation_start(variation *v, int i)
{
  variation_enter(v, i);
  for (int j = 0; j < v->m->n_contacts; j += v->track[j].law->contacts) v->track[j].law->start(v, j, v->boundary[i]);
}

/* ---- one tangent ---------------------------------------------------------------------------------- */

static void enter_line(variation *v, int j, double th)
{
  int n;
  const contact_interval *p = contact_forces_intervals(v->orbit, j, &n);
  v->interval[j] = NULL;
  for (int i = 0; i < n && !v->interval[j]; ++i)
    if (covers(p[i].from, p[i].to, th)) v->interval[j] = &p[i];
}

static const double NEGLIGIBLE_SLIP = 1e-6; /* [rad] */

/* True if contact j's slider is stuck all period. Slip intervals of less than 1e-6 rad in all count as stick: the
 * slip path goes with the square of their length, so 1e-6 rad move the slider by rounding only. They occur at
 * shakedown: the slider has moved until the largest |T| is just mu N, a graze. Such an orbit is the last of a family
 * that differs by where the slider rests; its one-sided derivative, as if it slipped at the graze, has the family's
 * multiplier 1. */
static bool stuck_all_period(const contact_forces *orbit, int j)
{
  double stuck = 0, touching = 0;
  int n;
  const contact_interval *p = contact_forces_intervals(orbit, j, &n);
  for (int i = 0; i < n; ++i) {
    touching += p[i].to - p[i].from;
    if (p[i].state == CONTACT_STICK) stuck += p[i].to - p[i].from;
  }
  return touching >= TWO_PI * (1 - 1e-15) && stuck >= touching - NEGLIGIBLE_SLIP;
}

/* True if dheld_j is a state of the system. Not if the slider is stuck all period, and not if every stick interval
 * starts with a touch-down that puts the slider at the same place whatever the motion: dheld_j is then 0 at all times.
 */
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

/* True if the slider of stick interval p comes to rest at its start, which is th. */
static bool comes_to_rest_at(const contact_interval *p, double th)
{
  return p->from == p->origin && wrap(p->from) == th;
}

static bool rests_from_before(const contact_interval *p, double th)
{
  return p && p->state == CONTACT_STICK && !comes_to_rest_at(p, th);
}

static void set_slider(variation *v, int j, const contact_interval *p)
{
  const int n = v->n_states;
  const model_contact *c = &v->m->contacts[j];
  double *held = v->phi + (size_t)(2 * v->n + j) * (size_t)n, by[2];
  contact_forces_held_by(v->orbit, j, p, by);
  for (int q = 0; q < v->columns; ++q) held[q] = 0;
  for (int i = 0; i < v->n; ++i) {
    const double by_x = by[0] * c->tangent[i] + by[1] * c->normal[i];
    for (int q = 0; q < v->columns; ++q) held[q] += by_x * v->phi[(size_t)i * (size_t)n + (size_t)q];
  }
}

static void start_line(variation *v, int j, double th)
{
  const contact_interval *p = v->interval[j];
  const bool rests = p && p->state == CONTACT_STICK && comes_to_rest_at(p, th);
  if (rests && !stuck_all_period(v->orbit, j)) set_slider(v, j, p);
}

static void add_states_of_line(variation *v, int j, double th)
{
  if (rests_from_before(v->interval[j], th) && slider_is_state(v->orbit, j)) v->active[v->n_active++] = 2 * v->n + j;
}

/* ---- planar friction ------------------------------------------------------------------------------ */

/* What the halves of a planar contact are to interval_flow.c while it sticks. */
static const contact_interval at_rest = {.from = 0, .to = TWO_PI, .state = CONTACT_STICK, .origin = -1};

static bool slips(const planar_interval *p) { return p && p->state != CONTACT_STICK; }
static bool sticks(const planar_interval *p) { return p && p->state == CONTACT_STICK; }

/* Stuck all period but for 1e-6 rad, as in stuck_all_period. */
static bool planar_is_free(const planar_cycle *c)
{
  double slipping = 0;
  for (int i = 0; i < c->n; ++i) slipping += slips(&c->interval[i]) ? c->interval[i].to - c->interval[i].from : 0;
  return c->always && slipping < NEGLIGIBLE_SLIP;
}

static void enter_planar(variation *v, int j, double th)
{
  tracked_contact *t = &v->track[j];
  t->cycle = contact_forces_planar(v->orbit, j);
  t->before = t->interval;
  t->interval = NULL;
  for (int i = 0; i < t->cycle->n && !t->interval; ++i)
    if (covers(t->cycle->interval[i].from, t->cycle->interval[i].to, th)) t->interval = &t->cycle->interval[i];
  if (slips(t->interval) && planar_is_free(t->cycle)) t->interval = NULL; /* of 1e-6 rad: no time passes */
  v->interval[j] = v->interval[j + 1] = sticks(t->interval) ? &at_rest : NULL;
  if (slips(t->interval)) v->slipping[v->n_slipping++] = (planar_slipping){j, t->cycle, t->interval};
}

/* Directional derivative of column q: direction . dx. */
static double variation_along(const variation *v, const double *direction, int q)
{
  double sum = 0;
  for (int i = 0; i < v->n; ++i) sum += direction[i] * v->phi[(size_t)i * (size_t)v->n_states + (size_t)q];
  return sum;
}

static double *slider_row(const variation *v, int j) { return v->phi + (size_t)(2 * v->n + j) * (size_t)v->n_states; }

static void start_slip(variation *v, int j, double phi)
{
  const double kt = v->m->contacts[j].law.kt, cosine = cos(phi), sine = sin(phi);
  double *first = slider_row(v, j), *second = slider_row(v, j + 1);
  for (int q = 0; q < v->columns; ++q) {
    const double d1 = variation_along(v, v->m->contacts[j].tangent, q) - first[q] / kt,
                 d2 = variation_along(v, v->m->contacts[j + 1].tangent, q) - second[q] / kt;
    first[q] = d2 * cosine - d1 * sine;
    second[q] = 0;
  }
}

static void start_stick(variation *v, int j, double phi)
{
  const contact *law = &v->m->contacts[j].law;
  const double cosine = cos(phi), sine = sin(phi), by_v = law->mu * law->kn / law->kt;
  double *first = slider_row(v, j), *second = slider_row(v, j + 1);
  for (int q = 0; q < v->columns; ++q) {
    const double dR = by_v * variation_along(v, v->m->contacts[j].normal, q), y = first[q];
    first[q] = law->kt * (variation_along(v, v->m->contacts[j].tangent, q) - dR * cosine + y * sine);
    second[q] = law->kt * (variation_along(v, v->m->contacts[j + 1].tangent, q) - dR * sine - y * cosine);
  }
}

static void touch_down(variation *v, int j, const planar_point *at, bool to_rest)
{
  const contact *law = &v->m->contacts[j].law;
  const double by_v = law->mu * law->kn / law->kt;
  double *first = slider_row(v, j), *second = slider_row(v, j + 1);
  for (int q = 0; q < v->columns; ++q) {
    const double part = by_v * variation_along(v, v->m->contacts[j].normal, q) / at->dR;
    first[q] = to_rest ? law->kt * (variation_along(v, v->m->contacts[j].tangent, q) - part * at->du[0]) : 0;
    second[q] = to_rest ? law->kt * (variation_along(v, v->m->contacts[j + 1].tangent, q) - part * at->du[1]) : 0;
  }
}

/* phi at the start or at the end of an interval of slip. */
static double first_angle(const planar_cycle *c, const planar_interval *p) { return c->slip.panel[p->panel].phi0; }
static double last_angle(const planar_cycle *c, const planar_interval *p)
{
  return c->slip.panel[p->panel + p->n_panels - 1].phi[COLLOCATION_POINTS - 1];
}

static void start_planar(variation *v, int j, double th)
{
  const tracked_contact *t = &v->track[j];
  if (!t->interval || planar_is_free(t->cycle)) return;
  if (!t->before) {
    const planar_point at = planar_motion_at(t->cycle->m, th);
    touch_down(v, j, &at, sticks(t->interval));
  } else if (sticks(t->before) && slips(t->interval)) start_slip(v, j, first_angle(t->cycle, t->interval));
  else if (slips(t->before) && sticks(t->interval)) start_stick(v, j, last_angle(t->cycle, t->before));
}

/* Those it has on the interval before. */
static void add_states_of_planar(variation *v, int j, double th)
{
  const tracked_contact *t = &v->track[j];
  (void)th;
  if (!t->before || planar_is_free(t->cycle)) return;
  v->active[v->n_active++] = 2 * v->n + j;
  if (sticks(t->before)) v->active[v->n_active++] = 2 * v->n + j + 1;
}

enum { LINE, PLANAR };

static const perturbed_law laws[] = {
    [LINE] = {1, enter_line, start_line, add_states_of_line},
    [PLANAR] = {2, enter_planar, start_planar, add_states_of_planar},
};

/* ---- made and freed --------------------------------------------------------------------------------- */

hc_status variation_make(variation *v, const model *m, int parts)
{
  const size_t states = 2 * (size_t)m->n + (size_t)m->n_contacts, contacts = (size_t)m->n_contacts + 1;
  *v = (variation){.m = m, .n = m->n, .n_states = (int)states, .parts = parts};
  v->phi = workspace_array(&v->memory, states * states, sizeof *v->phi);
  v->interval = workspace_array(&v->memory, contacts, sizeof *v->interval);
  v->active = workspace_array(&v->memory, states, sizeof *v->active);
  v->track = workspace_array(&v->memory, contacts, sizeof *v->track);
  v->slipping = workspace_array(&v->memory, contacts, sizeof *v->slipping);
  for (int j = 0; j < m->n_contacts && !v->memory.failed; j += v->track[j].law->contacts)
    v->track[j].law = &laws[placed_contact_of(m, j).planar ? PLANAR : LINE];
  return v->memory.failed ? HC_NO_MEMORY : HC_OK;
}

void variation_free(variation *v)
{
  workspace_free(&v->memory);
  free(v->boundary);
}

/* ---- states --------------------------------------------------------------------------------------------- */

void variation_find_states(variation *v, int last)
{
  const int behind = next_interval(v, last);
  variation_enter(v, last);
  variation_enter(v, behind);
  for (v->n_active = 0; v->n_active < 2 * v->n; ++v->n_active) v->active[v->n_active] = v->n_active;
  for (int j = 0; j < v->m->n_contacts; j += v->track[j].law->contacts)
    v->track[j].law->add_states(v, j, v->boundary[behind]);
  variation_enter(v, last);
}

int variation_held_sliders(variation *v, int last, int *slider, bool *sticks_on)
{
  const int behind = next_interval(v, last);
  int sliders = 0;
  variation_enter(v, last);
  for (int j = 0; j < v->m->n_contacts; ++j)
    if (variation_sticks(v, j) && slider_is_state(v->orbit, j)) slider[sliders++] = j;
  variation_enter(v, behind);
  for (int s = 0; s < sliders; ++s) sticks_on[s] = rests_from_before(v->interval[slider[s]], v->boundary[behind]);
  variation_enter(v, last);
  return sliders;
}

bool variation_sticks(const variation *v, int j) { return v->interval[j] && v->interval[j]->state == CONTACT_STICK; }
bool variation_slips(const variation *v, int j) { return slips(v->track[j].interval); }

bool variation_never_changes(const variation *v)
{
  for (int j = 0, intervals; j < v->m->n_contacts; ++j) {
    const contact_interval *p = contact_forces_intervals(v->orbit, j, &intervals);
    const bool stays = intervals == 1 && p->state == CONTACT_STICK && p->to - p->from >= TWO_PI * (1 - 1e-15);
    if ((intervals > 0 && !stays) || contact_forces_bends(v->orbit, j)) return false;
  }
  return true;
}
