/* monodromy.c - see monodromy.h. The state is (dx, dx', dheld_1, ..., dheld_n); dheld_j counts only while contact j
 * is stuck. Row i of phi is state i, column q the initial state q. The period starts at the end of its longest
 * interval. Few motions outlast that (interval_flow.h), and columns are made of them alone; where there is planar
 * friction, of all states there.
 *
 * While a planar contact sticks the rows of its two halves are dheld = kt dw, while it slips the first's is y = R d
 * phi (planar_flow.h). What they begin with, at fixed th (planar_force.h):
 *     touch-down   sticks dw = du - (dR/R') u', slips y = 0, since R = 0
 *     to slip      y = (du - dw).e_perp
 *     to rest      dw = du - dR e - y e_perp */
#include "hbm/stability/monodromy.h"

#include <string.h>

#include "hbm/planar/planar_flow.h"
#include "hbm/stability/interval_flow.h"
#include "hbm/stability/modal_flow.h"
#include "numerics/base/constants.h"
#include "numerics/base/number.h"
#include "numerics/base/workspace.h"
#include "numerics/dense.h"
#include "numerics/floquet.h"

/* What a law is to a perturbation, of its first contact j. */
typedef struct perturbed_law {
  int contacts; /* of the model that are followed together */
  /* w->interval[] on the interval around th. */
  void (*enter)(monodromy *w, const contact_forces *orbit, int j, double th);
  /* The rows of its sliders where that interval begins, at th. */
  void (*begin)(monodromy *w, const model *m, const contact_forces *orbit, int j, double th);
  /* Adds those of its states to w->active that the period begins with, at th. */
  void (*add_states)(monodromy *w, const contact_forces *orbit, int j, double th);
} perturbed_law;

/* A contact while a perturbation is followed; of a planar one the first half. */
typedef struct contact_track {
  const perturbed_law *law;
  const planar_cycle *cycle;                /* of a planar one, as below */
  const planar_interval *interval, *before; /* the current one and the one before; NULL while separated */
} contact_track;

struct monodromy {
  int n;            /* degrees of freedom */
  int n_states;     /* 2 n + contacts */
  size_t cap;       /* of boundary */
  double *boundary; /* [cap] [rad] every angle at which a contact changes state, ascending */
  int columns;      /* of phi that count */
  double *phi;      /* [n_states][n_states] by rows */
  double *left;     /* [n_states][n_states] of interval_flow_left */
  double *size;     /* [n_states] of a state, in the columns of phi */
  interval_flow *flow;
  modal_flow *modal;                 /* instead of flow and planar; else NULL */
  bool from_all;                     /* no survivors are looked for */
  double *factor;                    /* [n_states][n_states] of compress */
  double *squares;                   /* [n_states] of the sizes of compress's columns */
  double *carry;                     /* [n_states][n_states] the period's columns by those of phi, which are fewer */
  const contact_interval **interval; /* [n_states] of each contact, the current one; NULL while separated */
  int n_active, *active;             /* [n_states] the initial states that the multipliers are made of */
  contact_track *track;              /* [contacts] */
  bool bends;                        /* a contact follows a smooth law */
  planar_flow *planar;               /* NULL: the model has neither planar friction nor smooth laws */
  int n_slipping;                    /* planar contacts that slip on the current interval */
  planar_slipping *slipping;         /* [contacts] */
  int *slider;                       /* [n_states] of interval_flow_leave, and which of them go on */
  bool *goes_on;
  double complex *lambda; /* [n_states] */
  floquet *floquet;
  workspace memory; /* of all arrays but boundary */
};

/* ---- the intervals of a period ------------------------------------------------------------------ */

enum { PARTS = 16 }; /* of a period in modes */

static double wrap(double th) { return th >= TWO_PI ? th - TWO_PI : th; }

/* Does [from, to), which may begin before 2 pi and end behind it, cover th in [0, 2 pi)? */
static bool covers(double from, double to, double th)
{
  return (th >= from && th < to) || (th + TWO_PI >= from && th + TWO_PI < to);
}

/* All angles of change in [0, 2 pi), 0 if there are none; their number or -1 without memory. */
static int collect_boundaries(monodromy *w, const contact_forces *orbit, int n_contacts)
{
  int n = 0;
  for (int j = 0, intervals; j < n_contacts; ++j) {
    const contact_interval *p = contact_forces_intervals(orbit, j, &intervals);
    const size_t most = (size_t)n + 2 * (size_t)intervals + 1;
    double *more = most > w->cap ? realloc(w->boundary, 2 * most * sizeof *more) : w->boundary;
    if (!more) return -1;
    if (most > w->cap) w->boundary = more, w->cap = 2 * most;
    for (int k = 0; k < intervals; ++k) w->boundary[n++] = wrap(p[k].from), w->boundary[n++] = wrap(p[k].to);
  }
  if (n == 0) w->boundary[n++] = 0;
  if (w->modal) {
    double *more = realloc(w->boundary, (w->cap + PARTS) * sizeof *more);
    if (!more) return -1;
    w->boundary = more, w->cap += PARTS;
    for (int k = 0; k < PARTS; ++k) w->boundary[n++] = TWO_PI * k / PARTS;
  }
  qsort(w->boundary, (size_t)n, sizeof(double), ascending);
  return n;
}

/* Where the interval that begins at boundary i ends. */
static double end_of_interval(const monodromy *w, int n, int i)
{
  return i + 1 < n ? w->boundary[i + 1] : w->boundary[0] + TWO_PI;
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
  const double middle = wrap(0.5 * (w->boundary[i] + end_of_interval(w, n, i)));
  w->n_slipping = 0;
  for (int j = 0; j < m->n_contacts; j += w->track[j].law->contacts) w->track[j].law->enter(w, orbit, j, middle);
}

/* ---- one tangent ---------------------------------------------------------------------------------- */

static void enter_line(monodromy *w, const contact_forces *orbit, int j, double th)
{
  int n;
  const contact_interval *p = contact_forces_intervals(orbit, j, &n);
  w->interval[j] = NULL;
  for (int i = 0; i < n && !w->interval[j]; ++i)
    if (covers(p[i].from, p[i].to, th)) w->interval[j] = &p[i];
}

static const double NEGLIGIBLE_SLIP = 1e-6; /* [rad] */

/* Is contact j's slider stuck all period? Slip intervals of less than 1e-6 rad in all count as stick: the slip path
 * goes with the square of their length, so 1e-6 rad move the slider by rounding only. They occur at shakedown: the
 * slider has moved until the largest |T| is just mu N, a graze. Such an orbit is the last of a family that differs
 * by where the slider rests; its one-sided derivative, as if it slipped at the graze, has the family's multiplier 1. */
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

static void begin_line(monodromy *w, const model *m, const contact_forces *orbit, int j, double th)
{
  const contact_interval *p = w->interval[j];
  const bool rests = p && p->state == CONTACT_STICK && comes_to_rest_at(p, th);
  if (rests && !stuck_all_period(orbit, j)) set_slider(w, m, orbit, j, p);
}

static void add_states_of_line(monodromy *w, const contact_forces *orbit, int j, double th)
{
  if (rests_from_before(w->interval[j], th) && slider_is_state(orbit, j)) w->active[w->n_active++] = 2 * w->n + j;
}

/* ---- planar friction ------------------------------------------------------------------------------ */

/* What the halves of a planar contact are to interval_flow.c while it sticks. */
static const contact_interval at_rest = {.from = 0, .to = TWO_PI, .state = CONTACT_STICK, .origin = -1};

static bool slips(const planar_interval *p) { return p && p->state != CONTACT_STICK; }
static bool sticks(const planar_interval *p) { return p && p->state == CONTACT_STICK; }
static bool sticks_now(const monodromy *w, int j) { return w->interval[j] && w->interval[j]->state == CONTACT_STICK; }

/* Stuck all period but for 1e-6 rad, as in stuck_all_period. */
static bool planar_is_free(const planar_cycle *c)
{
  double slipping = 0;
  for (int i = 0; i < c->n; ++i) slipping += slips(&c->interval[i]) ? c->interval[i].to - c->interval[i].from : 0;
  return c->always && slipping < NEGLIGIBLE_SLIP;
}

static void enter_planar(monodromy *w, const contact_forces *orbit, int j, double th)
{
  contact_track *t = &w->track[j];
  t->cycle = contact_forces_planar(orbit, j);
  t->before = t->interval;
  t->interval = NULL;
  for (int i = 0; i < t->cycle->n && !t->interval; ++i)
    if (covers(t->cycle->interval[i].from, t->cycle->interval[i].to, th)) t->interval = &t->cycle->interval[i];
  if (slips(t->interval) && planar_is_free(t->cycle)) t->interval = NULL; /* of 1e-6 rad: no time passes */
  w->interval[j] = w->interval[j + 1] = sticks(t->interval) ? &at_rest : NULL;
  if (slips(t->interval)) w->slipping[w->n_slipping++] = (planar_slipping){j, t->cycle, t->interval};
}

/* Directional derivative of column q: direction . dx. */
static double along(const monodromy *w, const double *direction, int q)
{
  double sum = 0;
  for (int i = 0; i < w->n; ++i) sum += direction[i] * w->phi[(size_t)i * (size_t)w->n_states + (size_t)q];
  return sum;
}

static double *row_of(const monodromy *w, int j) { return w->phi + (size_t)(2 * w->n + j) * (size_t)w->n_states; }

static void begin_slip(monodromy *w, const model *m, int j, double phi)
{
  const double kt = m->contacts[j].law.kt, cosine = cos(phi), sine = sin(phi);
  double *first = row_of(w, j), *second = row_of(w, j + 1);
  for (int q = 0; q < w->columns; ++q) {
    const double d1 = along(w, m->contacts[j].tangent, q) - first[q] / kt,
                 d2 = along(w, m->contacts[j + 1].tangent, q) - second[q] / kt;
    first[q] = d2 * cosine - d1 * sine;
    second[q] = 0;
  }
}

static void come_to_rest(monodromy *w, const model *m, int j, double phi)
{
  const contact *law = &m->contacts[j].law;
  const double cosine = cos(phi), sine = sin(phi), by_v = law->mu * law->kn / law->kt;
  double *first = row_of(w, j), *second = row_of(w, j + 1);
  for (int q = 0; q < w->columns; ++q) {
    const double dR = by_v * along(w, m->contacts[j].normal, q), y = first[q];
    first[q] = law->kt * (along(w, m->contacts[j].tangent, q) - dR * cosine + y * sine);
    second[q] = law->kt * (along(w, m->contacts[j + 1].tangent, q) - dR * sine - y * cosine);
  }
}

static void touch_down(monodromy *w, const model *m, int j, const planar_point *at, bool to_rest)
{
  const contact *law = &m->contacts[j].law;
  const double by_v = law->mu * law->kn / law->kt;
  double *first = row_of(w, j), *second = row_of(w, j + 1);
  for (int q = 0; q < w->columns; ++q) {
    const double part = by_v * along(w, m->contacts[j].normal, q) / at->dR;
    first[q] = to_rest ? law->kt * (along(w, m->contacts[j].tangent, q) - part * at->du[0]) : 0;
    second[q] = to_rest ? law->kt * (along(w, m->contacts[j + 1].tangent, q) - part * at->du[1]) : 0;
  }
}

/* phi at the start or at the end of an interval of slip. */
static double first_angle(const planar_cycle *c, const planar_interval *p) { return c->slip.panel[p->panel].phi0; }
static double last_angle(const planar_cycle *c, const planar_interval *p)
{
  return c->slip.panel[p->panel + p->n_panels - 1].phi[COLLOCATION_POINTS - 1];
}

static void begin_planar(monodromy *w, const model *m, const contact_forces *orbit, int j, double th)
{
  const contact_track *t = &w->track[j];
  (void)orbit;
  if (!t->interval || planar_is_free(t->cycle)) return;
  if (!t->before) {
    const planar_point at = planar_motion_at(t->cycle->m, th);
    touch_down(w, m, j, &at, sticks(t->interval));
  } else if (sticks(t->before) && slips(t->interval)) begin_slip(w, m, j, first_angle(t->cycle, t->interval));
  else if (slips(t->before) && sticks(t->interval)) come_to_rest(w, m, j, last_angle(t->cycle, t->before));
}

/* Those it has on the interval before. */
static void add_states_of_planar(monodromy *w, const contact_forces *orbit, int j, double th)
{
  const contact_track *t = &w->track[j];
  (void)orbit, (void)th;
  if (!t->before || planar_is_free(t->cycle)) return;
  w->active[w->n_active++] = 2 * w->n + j;
  if (sticks(t->before)) w->active[w->n_active++] = 2 * w->n + j + 1;
}

enum { LINE, PLANAR };

static const perturbed_law laws[] = {
    [LINE] = {1, enter_line, begin_line, add_states_of_line},
    [PLANAR] = {2, enter_planar, begin_planar, add_states_of_planar},
};

/* ---- made and freed --------------------------------------------------------------------------------- */

hc_status monodromy_new(const model *m, monodromy_method how, monodromy **out)
{
  *out = calloc(1, sizeof **out);
  monodromy *w = *out;
  if (!w) return HC_NO_MEMORY;
  w->cap = 2;
  w->boundary = malloc(w->cap * sizeof(double));
  w->n = m->n;
  w->n_states = 2 * m->n + m->n_contacts;
  const size_t n = (size_t)w->n_states;
  w->phi = workspace_array(&w->memory, n * n, sizeof *w->phi);
  w->size = workspace_array(&w->memory, n, sizeof *w->size);
  w->interval = workspace_array(&w->memory, n, sizeof *w->interval);
  w->active = workspace_array(&w->memory, n, sizeof *w->active);
  w->slider = workspace_array(&w->memory, n, sizeof *w->slider);
  w->goes_on = workspace_array(&w->memory, n, sizeof *w->goes_on);
  w->lambda = workspace_array(&w->memory, n, sizeof *w->lambda);
  w->left = workspace_array(&w->memory, n * n, sizeof *w->left);
  w->track = workspace_array(&w->memory, (size_t)m->n_contacts + 1, sizeof *w->track);
  w->slipping = workspace_array(&w->memory, (size_t)m->n_contacts + 1, sizeof *w->slipping);
  hc_status st = w->boundary && !w->memory.failed ? floquet_new(w->n_states, &w->floquet) : HC_NO_MEMORY;
  for (int j = 0; j < m->n_contacts && st == HC_OK; j += w->track[j].law->contacts)
    w->track[j].law = &laws[placed_contact_of(m, j).planar ? PLANAR : LINE];
  w->from_all = how == MONODROMY_FROM_ALL_STATES;
  if (how != MONODROMY_BY_INTERVALS) {
    w->squares = workspace_array(&w->memory, n, sizeof *w->squares);
    w->carry = workspace_array(&w->memory, n * n, sizeof *w->carry);
    w->factor = workspace_array(&w->memory, n * n, sizeof *w->factor);
    if (st == HC_OK) st = !w->memory.failed ? modal_flow_new(m, &w->modal) : HC_NO_MEMORY;
  } else {
    if (st == HC_OK) st = interval_flow_new(m, &w->flow);
    w->bends = model_is_smooth(m);
    if (st == HC_OK && (w->bends || model_has_circle(m))) st = planar_flow_new(m, &w->planar);
  }
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
  planar_flow_free(w->planar);
  modal_flow_free(w->modal);
  workspace_free(&w->memory);
  free(w->boundary);
  free(w);
}

/* ---- a period ----------------------------------------------------------------------------------------- */

/* Columns of all states there are behind the interval `last`, which has been entered: each in its size, for a slider
 * that moves by 1 is dheld = kt. */
static void begin_with_all(monodromy *w, const model *m)
{
  const size_t states = (size_t)w->n_states;
  w->columns = w->n_states;
  memset(w->phi, 0, states * states * sizeof *w->phi);
  for (int i = 0; i < w->n_states; ++i) {
    const int j = i - 2 * w->n;
    const bool is_slider = j >= 0 && !slips(w->track[j].interval) && m->contacts[j].law.kt > 0;
    w->phi[(size_t)i * (states + 1)] = w->size[i] = is_slider ? m->contacts[j].law.kt : 1;
  }
}

/* The sliders that are at rest over the interval `last`, and matter; and which of them still are on the one behind it,
 * which is the current one. Their number. */
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

/* The states that the period begins with, behind the interval `last`, which is entered; the sliders held over it. */
static int collect_states(monodromy *w, const model *m, const contact_forces *orbit, int n, int last)
{
  const double at = w->boundary[next_interval(w, n, last)];
  const int sliders = collect_held_sliders(w, m, orbit, n, last);
  for (w->n_active = 0; w->n_active < 2 * w->n; ++w->n_active) w->active[w->n_active] = w->n_active;
  for (int j = 0; j < m->n_contacts; j += w->track[j].law->contacts) w->track[j].law->add_states(w, orbit, j, at);
  enter_interval(w, m, orbit, n, last);
  return sliders;
}

/* The columns of phi that the period begins with, behind the interval `last`, which is entered. */
static hc_status begin_period(monodromy *w, const model *m, const contact_forces *orbit, double omega, int n, int last)
{
  const int sliders = collect_states(w, m, orbit, n, last);
  if (w->planar) return begin_with_all(w, m), HC_OK;
  const double duration = (end_of_interval(w, n, last) - w->boundary[last]) / omega;
  const hc_status st =
      interval_flow_leave(w->flow, w->interval, duration, sliders, w->slider, w->goes_on, w->phi, &w->columns);
  for (w->n_active = 0; w->n_active < w->columns; ++w->n_active) w->active[w->n_active] = w->n_active;
  return st;
}

static bool slopes_of(const void *orbit, int j, double th, double omega, contact_slopes *out)
{
  if (!contact_forces_bends(orbit, j)) return false;
  *out = contact_forces_slopes(orbit, j, th, omega);
  return true;
}

/* w->left: what the states that the period begins with have become at its end. */
static hc_status follow_period(monodromy *w, const model *m, const contact_forces *orbit, double omega, int n)
{
  int last = 0; /* at which the longest interval begins */
  for (int i = 1; i < n; ++i)
    if (end_of_interval(w, n, i) - w->boundary[i] > end_of_interval(w, n, last) - w->boundary[last]) last = i;
  hc_status st = begin_period(w, m, orbit, omega, n, last);
  if (w->bends) planar_flow_bend(w->planar, slopes_of, orbit);
  for (int k = 1; k <= n && st == HC_OK; ++k) {
    const int i = (last + k) % n;
    const double a = w->boundary[i], b = end_of_interval(w, n, i);
    if (is_empty(w, n, i)) continue;
    enter_interval(w, m, orbit, n, i);
    for (int j = 0; j < m->n_contacts; j += w->track[j].law->contacts) w->track[j].law->begin(w, m, orbit, j, a);
    if (w->n_slipping || w->bends)
      st = planar_flow_advance(w->planar, w->interval, w->n_slipping, w->slipping, a, b, omega, w->columns, w->phi);
    else st = interval_flow_advance(w->flow, w->interval, (b - a) / omega, w->columns, w->phi);
  }
  if (st != HC_OK || !w->planar)
    return st == HC_OK ? interval_flow_left(w->flow, w->interval, w->slider, w->columns, w->phi, w->left) : st;
  const size_t states = (size_t)w->n_states;
  for (size_t i = 0; i < states; ++i) /* in terms of the columns' sizes */
    for (size_t q = 0; q < states; ++q) w->left[i * states + q] = w->phi[i * states + q] / w->size[i];
  return HC_OK;
}

/* Some minutes: of eigenvectors 30 (2 n)^3 operations an interval, each of its own combination of states. */
static const double MOST_OPERATIONS = 4e11;

/* ---- a period in modes ---------------------------------------------------------------------------------
 *
 * Of all columns few outlast the first part of the period. After each part phi is factored, with rows as roots of
 * energies, phi = basis carry, but for what rounding leaves, and the basis alone goes on. With phi of the basis at the
 * end, the map of the period is phi carry, and carry phi, smaller, has the same multipliers but for 0. */

static const double LOST = 1e-13; /* of the largest column: rounding */

/* Root of the energy of state i by what it is: lengths by their mode's frequency, sliders by kt. 0 where the state does
 * not count on the current interval. */
static double weight_of_state(const monodromy *w, const model *m, double omega, int i)
{
  const int j = i - 2 * w->n;
  if (i < w->n) return fmax(omega, sqrt(fmax(0, m->stiffness[(size_t)i * (size_t)(w->n + 1)])));
  if (j < 0) return 1;
  const double root = sqrt(m->contacts[j].law.kt);
  if (sticks_now(w, j)) return root > 0 ? 1 / root : 0;
  return w->track[j].law && slips(w->track[j].interval) ? root : 0;
}

/* For long vectors: four sums, which do not wait for each other. */
static double long_product(size_t n, const double *a, const double *b)
{
  double sum[4] = {0};
  size_t i = 0;
  for (; i + 4 <= n; i += 4)
    for (size_t k = 0; k < 4; ++k) sum[k] += a[i + k] * b[i + k];
  for (; i < n; ++i) sum[0] += a[i] * b[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

static void swap_columns(size_t n, double *A, int a, int b)
{
  for (size_t i = 0; i < n && a != b; ++i) {
    const double kept = A[(size_t)a * n + i];
    A[(size_t)a * n + i] = A[(size_t)b * n + i];
    A[(size_t)b * n + i] = kept;
  }
}

/* phi = basis factor by Gram and Schmidt, the largest column first, each as long as what it is of phi, so that in later
 * parts, too, LOST is of the largest; carry = factor carry. The basis need not be orthogonal to rounding: only the
 * product counts. */
static void compress(monodromy *w, const model *m, double omega)
{
  const size_t states = (size_t)w->n_states;
  double *Q = w->left, *R = w->factor, first = 0; /* columns of Q[columns][states], rows of R[states][columns] */
  double *left = w->squares;
  int rank = 0;
  memset(R, 0, states * states * sizeof *R);
  for (int q = 0; q < w->columns; ++q) w->slider[q] = q;
  for (size_t i = 0; i < states; ++i) {
    const double weight = weight_of_state(w, m, omega, (int)i);
    for (size_t q = 0; q < (size_t)w->columns; ++q) Q[q * states + i] = weight * w->phi[i * states + q];
  }
  for (int q = 0; q < w->columns; ++q) left[q] = long_product(states, Q + (size_t)q * states, Q + (size_t)q * states);
  for (; rank < w->columns; ++rank) {
    int pivot = rank;
    for (int q = rank + 1; q < w->columns; ++q)
      if (left[q] > left[pivot]) pivot = q;
    const double size = sqrt(left[pivot]);
    if (rank == 0) first = size;
    if (!(size > LOST * first)) break;
    swap_columns(states, Q, rank, pivot);
    const int moved = w->slider[rank];
    w->slider[rank] = w->slider[pivot], w->slider[pivot] = moved, left[pivot] = left[rank];
    double *now = Q + (size_t)rank * states, *row = R + (size_t)rank * states;
    for (size_t i = 0; i < states; ++i) now[i] /= size;
    row[w->slider[rank]] = 1, w->size[rank] = size;
    for (int q = rank + 1; q < w->columns; ++q) {
      double *restrict other = Q + (size_t)q * states;
      const double share = long_product(states, now, other);
      for (size_t i = 0; i < states; ++i) other[i] -= share * now[i];
      left[q] = long_product(states, other, other);
      row[w->slider[q]] = share / size;
    }
  }
  for (size_t i = 0; i < states; ++i) {
    const double weight = weight_of_state(w, m, omega, (int)i);
    for (size_t q = 0; q < (size_t)rank; ++q)
      w->phi[i * states + q] = weight > 0 ? w->size[q] * Q[q * states + i] / weight : 0;
  }
  dense_add_product(w->n_active, rank, w->columns, 1, w->carry, w->n_states, R, w->n_states, 0, w->left, w->n_states);
  for (size_t r = 0; r < (size_t)rank; ++r)
    memcpy(w->carry + r * states, w->left + r * states, (size_t)w->n_active * sizeof *w->carry);
  w->columns = rank;
}

/* Steps for this orbit, held against the contacts' states in the middle of each part of the period. */
static hc_status choose_steps(monodromy *w, const contact_forces *orbit, double omega, int n)
{
  hc_status st = HC_OK;
  int changes = 0;
  for (int i = 0; i < n; ++i) changes += !is_empty(w, n, i);
  modal_flow_begin(w->modal, omega, changes - PARTS);
  for (int part = 0, i = 0; part < PARTS && st == HC_OK; ++part) {
    const double th = TWO_PI * (part + 0.5) / PARTS;
    while (!(end_of_interval(w, n, i) > th)) ++i;
    enter_interval(w, modal_flow_model(w->modal), orbit, n, i);
    st = modal_flow_check(w->modal, w->interval, w->n_slipping, w->slipping, th);
  }
  return st == HC_OK && modal_flow_operations(w->modal) > MOST_OPERATIONS ? HC_NOT_CONVERGED : st;
}

/* phi over intervals first..end-1, of n. */
static hc_status follow_intervals(monodromy *w, const contact_forces *orbit, double omega, int n, int first, int end,
                                  bool compressed)
{
  const model *m = modal_flow_model(w->modal);
  int every = n > PARTS ? n / PARTS : 1, next = first + every;
  hc_status st = HC_OK;
  for (int i = first; i < end && st == HC_OK; ++i) {
    if (is_empty(w, n, i)) continue;
    enter_interval(w, m, orbit, n, i);
    for (int j = 0; j < m->n_contacts; j += w->track[j].law->contacts)
      w->track[j].law->begin(w, m, orbit, j, w->boundary[i]);
    st = modal_flow_advance(w->modal, w->interval, w->n_slipping, w->slipping, w->boundary[i], end_of_interval(w, n, i),
                            omega, w->columns, w->phi);
    if (st != HC_OK || !compressed || i + 1 < next) continue;
    const int before = w->columns;
    compress(w, m, omega);
    if (2 * w->columns > before && before == w->n_active) every *= 2; /* hardly anything is lost so soon */
    next += every;
  }
  return st;
}

static void carry_nothing(monodromy *w)
{
  const size_t states = (size_t)w->n_states;
  memset(w->carry, 0, states * states * sizeof *w->carry);
  for (size_t q = 0; q < (size_t)w->columns; ++q) w->carry[q * states + q] = 1;
}

/* All active states as columns. */
static void begin_with_active(monodromy *w, const model *m, double omega)
{
  const size_t states = (size_t)w->n_states;
  w->columns = w->n_active;
  memset(w->phi, 0, states * states * sizeof *w->phi);
  for (size_t q = 0; q < (size_t)w->n_active; ++q) {
    const size_t state = (size_t)w->active[q];
    w->phi[state * states + q] = 1 / weight_of_state(w, m, omega, (int)state);
  }
  carry_nothing(w);
}

/* ---- of large structures: what outlasts a part of the period is fewer than a hundredth of all states, and is found
 * from as many random ones. The period then begins behind that part, with a basis of it, and its map is that of the
 * basis's coordinates: cyclic products have the same multipliers but for 0. */

enum { FIRST = 3, MANY_STATES = 400, SPARE = 16 };

/* The first intervals, as long as one of PARTS. */
static int first_part(const monodromy *w, int n)
{
  int end = 0;
  while (end < n - 1 && w->boundary[end] - w->boundary[0] < 0.99 * TWO_PI * FIRST / PARTS) ++end;
  return end;
}

/* phi = a basis of what is behind interval end - 1; false where it takes all states. */
static hc_status find_survivors(monodromy *w, const contact_forces *orbit, double omega, int n, int end, bool *found)
{
  const model *m = modal_flow_model(w->modal);
  const size_t states = (size_t)w->n_states;
  const int active = w->n_active;
  unsigned long long random = 1;
  hc_status st = HC_OK;
  *found = false;
  for (int columns = MANY_STATES; st == HC_OK && !*found && columns < active / 2; columns *= 2) {
    enter_interval(w, m, orbit, n, n - 1);
    memset(w->phi, 0, states * states * sizeof *w->phi);
    for (int a = 0; a < active; ++a)
      for (int q = 0; q < columns; ++q) {
        random = random * 6364136223846793005ULL + 1442695040888963407ULL;
        w->phi[(size_t)w->active[a] * states + (size_t)q] =
            ((double)(random >> 11) * 0x1p-52 - 1) / weight_of_state(w, m, omega, w->active[a]);
      }
    w->columns = columns;
    st = follow_intervals(w, orbit, omega, n, 0, end, false);
    w->n_active = 0;
    if (st == HC_OK) compress(w, m, omega);
    w->n_active = active;
    *found = st == HC_OK && w->columns + SPARE <= columns;
  }
  if (!*found) return st;
  for (size_t i = 0; i < states; ++i)
    for (size_t q = 0; q < (size_t)w->columns; ++q) w->phi[i * states + q] /= w->size[q];
  carry_nothing(w);
  return st;
}

/* columns[w->columns][states] = phi times the weights of its states. */
static void weigh_columns(const monodromy *w, const model *m, double omega, double *columns)
{
  const size_t states = (size_t)w->n_states;
  for (size_t i = 0; i < states; ++i) {
    const double weight = weight_of_state(w, m, omega, (int)i);
    for (size_t q = 0; q < (size_t)w->columns; ++q) columns[q * states + i] = weight * w->phi[i * states + q];
  }
}

/* w->factor[rank][columns] by rows: coordinates of phi, after the first part once more, in basis[rank][states]. */
static hc_status close_period(monodromy *w, const contact_forces *orbit, double omega, int n, int end, int rank,
                              const double *basis)
{
  const model *m = modal_flow_model(w->modal);
  const size_t states = (size_t)w->n_states, square = (size_t)rank * (size_t)rank;
  workspace own = {0};
  double *turned = workspace_doubles(&own, (size_t)rank * states), *gram = workspace_doubles(&own, square),
         *C = workspace_doubles(&own, square);
  bool *kept = workspace_array(&own, states, sizeof *kept);
  int *pivot = workspace_array(&own, (size_t)rank, sizeof *pivot);
  hc_status st = own.failed ? HC_NO_MEMORY : HC_OK;
  for (int a = 0; a < w->n_active && st == HC_OK; ++a) kept[w->active[a]] = true;
  for (size_t i = 0; i < states && st == HC_OK; ++i)
    if (!kept[i]) memset(w->phi + i * states, 0, states * sizeof *w->phi);
  if (st == HC_OK) st = follow_intervals(w, orbit, omega, n, 0, end, false);
  if (st == HC_OK) {
    weigh_columns(w, m, omega, w->left);
    dense_transpose((int)states, rank, basis, turned);
    dense_multiply(rank, rank, (int)states, turned, basis, gram);
    dense_multiply(rank, w->columns, (int)states, turned, w->left, C);
    st = dense_factor(rank, gram, pivot);
  }
  if (st == HC_OK) {
    dense_solve(rank, gram, pivot, w->columns, C);
    for (size_t a = 0; a < (size_t)rank; ++a)
      for (size_t q = 0; q < (size_t)w->columns; ++q) w->factor[a * states + q] = C[q * (size_t)rank + a];
  }
  workspace_free(&own);
  return st;
}

/* Do all contacts stay stuck or apart all period, and none follows a law that bends? */
static bool nothing_changes(const contact_forces *orbit, int n_contacts)
{
  for (int j = 0, intervals; j < n_contacts; ++j) {
    const contact_interval *p = contact_forces_intervals(orbit, j, &intervals);
    const bool stays = intervals == 1 && p->state == CONTACT_STICK && p->to - p->from >= TWO_PI * (1 - 1e-15);
    if ((intervals > 0 && !stays) || contact_forces_bends(orbit, j)) return false;
  }
  return true;
}

/* exp(s T) of the roots s of the structure as its contacts hold it. */
static hc_status multipliers_of_roots(monodromy *w, double period)
{
  const hc_status st = modal_flow_roots(w->modal, w->interval, w->lambda);
  w->n_active = 2 * w->n;
  for (int i = 0; i < w->n_active && st == HC_OK; ++i) w->lambda[i] = cexp(w->lambda[i] * period);
  return st;
}

/* w->lambda[n_active]. */
static hc_status follow_in_modes(monodromy *w, const contact_forces *orbit, double omega, int n)
{
  const model *m = modal_flow_model(w->modal);
  hc_status st = choose_steps(w, orbit, omega, n);
  if (st != HC_OK) return st;
  const bool by_roots = modal_flow_operations_of_roots(w->modal) < modal_flow_operations(w->modal);
  if (by_roots && !w->from_all && nothing_changes(orbit, m->n_contacts))
    return multipliers_of_roots(w, TWO_PI / omega); /* choose_steps entered an interval */
  const size_t states = (size_t)w->n_states;
  const int end = first_part(w, n);
  bool few = false;
  double *basis = NULL;
  collect_states(w, m, orbit, n, n - 1);
  if (end > 0 && !w->from_all) st = find_survivors(w, orbit, omega, n, end, &few);
  const int rank = w->columns;
  if (st == HC_OK && few && !(basis = malloc(((size_t)rank * states + 1) * sizeof *basis))) st = HC_NO_MEMORY;
  if (st == HC_OK && few) {
    const int active = w->n_active;
    weigh_columns(w, m, omega, basis);
    w->n_active = rank; /* columns of carry */
    st = follow_intervals(w, orbit, omega, n, end, n, true);
    w->n_active = active;
    if (st == HC_OK) st = close_period(w, orbit, omega, n, end, rank, basis);
    w->n_active = rank;
  } else if (st == HC_OK) {
    enter_interval(w, m, orbit, n, n - 1);
    begin_with_active(w, m, omega);
    st = follow_intervals(w, orbit, omega, n, 0, n, true);
    for (size_t a = 0; a < (size_t)w->n_active && st == HC_OK; ++a) {
      const double weight = weight_of_state(w, m, omega, w->active[a]);
      for (size_t q = 0; q < (size_t)w->columns; ++q)
        w->factor[a * states + q] = weight * w->phi[(size_t)w->active[a] * states + q];
    }
  }
  free(basis);
  if (st != HC_OK) return st;
  dense_add_product(w->columns, w->columns, w->n_active, 1, w->factor, w->n_states, w->carry, w->n_states, 0, w->left,
                    w->n_states);
  w->n_active = w->columns;
  for (size_t q = 0; q < (size_t)w->columns; ++q)
    memcpy(w->factor + q * (size_t)w->columns, w->left + q * states, (size_t)w->columns * sizeof *w->factor);
  return dense_eigen(w->columns, w->factor, w->lambda, NULL, NULL);
}

/* m of n states have multipliers, those that outlast the longest interval: the others' are 0. */
static void summarise(int n, int m, const double complex *lambda, hbm_stability *out)
{
  double complex flip = 1, fold = 1, all = 1;
  const double complex largest = floquet_largest(m, lambda);
  for (int i = 0; i < m; ++i) {
    flip *= 1 + lambda[i];
    fold *= 1 - lambda[i];
    all *= lambda[i];
  }
  const double size_of_largest = cabs(largest);
  *out = (hbm_stability){.multiplier = size_of_largest,
                         .re = creal(largest),
                         .im = cimag(largest),
                         .pair = NAN,
                         .low = size_of_largest,
                         .high = size_of_largest};
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

hc_status monodromy_stability(monodromy *w, const model *m, const contact_forces *orbit, double omega,
                              hbm_stability *out)
{
  const int n = collect_boundaries(w, orbit, m->n_contacts);
  hc_status st = n < 0 ? HC_NO_MEMORY : HC_OK;
  if (st == HC_OK && w->modal) {
    st = follow_in_modes(w, orbit, omega, n);
  } else if (st == HC_OK) {
    const bool too_long = 30 * pow(2.0 * w->n, 3) * n > MOST_OPERATIONS;
    st = too_long ? HC_NOT_CONVERGED : follow_period(w, m, orbit, omega, n);
    if (st == HC_OK) st = floquet_multipliers(w->floquet, w->left, w->n_states, 1, w->n_active, w->active, w->lambda);
  }
  if (st == HC_OK) summarise(2 * w->n, w->n_active, w->lambda, out);
  if (st == HC_OK) out->of_motion = !nothing_changes(orbit, m->n_contacts);
  return st;
}

int monodromy_multipliers(const monodromy *w, const double complex **lambda)
{
  *lambda = w->lambda;
  return w->n_active;
}
