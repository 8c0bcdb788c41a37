/* band.c - see band.h. Lengths along a line: of a slider by its own slip length, mu N/kt with the mean of its largest
 * and its least N. */
#include "compare/band.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/referee.h"
#include "model/parts.h"
#include "numerics/base/workspace.h"
#include "numerics/dense.h"
#include "numerics/series.h"
#include "timeint/steady/contact_watch.h"

enum {
  MOST_SETS = 16,     /* sets of free sliders whose lines are followed */
  MOST_LINES = 4,     /* free sliders of a set that are followed one by one; of more, gradients alone */
  MOST_STEPS = 100,   /* of a line */
  MOST_CLIMBS = 12,   /* lines along the gradient, a response and direction */
  MOST_REFINED = 16,  /* solutions that locate an extremum between two */
  MOST_HELD = 8,      /* sliders at their limit that are located there by the exact law */
  MOST_CONFIRMED = 12 /* orbits that locate an end */
};

/* Steps along a line [slip length]. */
static const double first_step = 0.25;  /* where nothing is known of the family's bends */
static const double longest_step = 1;   /* the largest between two members, where extrema are looked for by rates */
static const double linear_step = 8;    /* while no contact changes its state: limits are linear in rests */
static const double least_step = 1e-5;  /* a line that needs shorter ones is given up */
static const double corner_step = 1e-2; /* over a corner: an extremum nearer to it than that is missed */
static const double plane_step = 0.05;  /* the same at the limits of two tangents, which are all corners */

/* [metric] A step that moves contacts by more than three times what was predicted, and by more than this, is to another
 * solution, or over a corner: it is made shorter. */
static const double near_enough = 0.05;
/* [slip length] Distance to a limit where it counts as reached: by orbits of the closed form; by any. */
static const double at_limit = 1e-11, about_at_limit = 1e-8;
static const double flat = 1e-9;        /* [amplitude] an extremum is located to this; truncation is larger */
static const double little_gain = 0.01; /* [band] climbing ends with a line that gains less */

/* A steady state of the family. */
typedef struct member {
  double *X, *along; /* [n_coef] its harmonics, and their rate along the line */
  double *w, *asked; /* [contacts] where its sliders are at th = 0, and where they were asked to begin */
  double *A, *rate;  /* [responses] amplitudes, and their rates along the line */
  bool *free;        /* [contacts] */
  int n_free;
  bool linear; /* no contact changes its state: amplitudes do not depend on rests */
  double step; /* along the line, from its start */
} member;

struct band_search {
  const model *model;
  hbm_solver *s;
  timeint *exact;
  int n_coef, n_contacts, n_responses;
  double omega;
  const hc_monitor *monitor;
  bool whole;     /* every line came to its end */
  int dimensions; /* the most free sliders of a member where lines do not see all (is_polygon) */
  long solves;
  member here, next, inside, origin;
  member *best;    /* [responses][2] least, largest */
  member *waiting; /* [MOST_SETS] members with a set of free sliders that was met */
  int n_sets, n_done;
  double *size;           /* [contacts] [length] slip length */
  double *direction;      /* [contacts] of the line */
  bool *is_located;       /* [responses][2] */
  double *located;        /* [responses][2][contacts] where the exact law has the sliders at an end that is located */
  double *x, *dx, *moved; /* [2 HBM_MAX_HARMONICS + 1] twice, [n_coef] */
  double *state;          /* [n_states] of the exact law */
  double (*room)[2];      /* [contacts] */
  contact_period *periods;
  bool *varies;     /* [contacts] in a part whose amplitudes may depend on rests */
  workspace memory; /* of all of these; members' arrays in `members` */
  workspace members;
};

const char *band_kind_name(band_kind kind)
{
  static const char *const names[] = {"", "none", "exact", "at least"};
  return names[kind];
}

double band_width(const band *b) { return b->low == b->high ? 0 * b->low : (b->high - b->low) / (b->high + b->low); }

double band_from_history(const band *b, double amplitude)
{
  if (b->kind != BAND_EXACT && b->kind != BAND_AT_LEAST) return NAN;
  return fmax(fmax(b->high - amplitude, amplitude - b->low), 0) / amplitude;
}

/* ---- made and freed ----------------------------------------------------------------------------- */

static void make_member(band_search *b, member *m)
{
  workspace *w = &b->members;
  const size_t n = (size_t)b->n_coef, contacts = (size_t)b->n_contacts, responses = (size_t)b->n_responses;
  m->X = workspace_doubles(w, n);
  m->along = workspace_doubles(w, n);
  m->w = workspace_doubles(w, contacts);
  m->asked = workspace_doubles(w, contacts);
  m->A = workspace_doubles(w, responses);
  m->rate = workspace_doubles(w, responses);
  m->free = workspace_array(w, contacts, sizeof *m->free);
}

/* `auto` has changed the number of harmonics, or there are no members yet. */
static hc_status make_members(band_search *b)
{
  const int n_coef = hbm_n_coefficients(b->s);
  if (n_coef == b->n_coef) return HC_OK;
  workspace_free(&b->members);
  b->members = (workspace){0};
  b->n_coef = n_coef;
  member *const own[] = {&b->here, &b->next, &b->inside, &b->origin};
  for (size_t i = 0; i < sizeof own / sizeof *own; ++i) make_member(b, own[i]);
  for (int i = 0; i < 2 * b->n_responses; ++i) make_member(b, &b->best[i]);
  for (int i = 0; i < MOST_SETS; ++i) make_member(b, &b->waiting[i]);
  b->moved = workspace_doubles(&b->members, (size_t)n_coef);
  if (b->members.failed) b->n_coef = 0;
  return b->members.failed ? HC_NO_MEMORY : HC_OK;
}

static bool is_constant(const contact *law) { return law->smooth == CONTACT_KINKED && !(law->kn > 0); }

/* varies[j]: the amplitude of contact j's part may depend on where sliders rest. It does only if the part has two
 * contacts at least, and one of them a normal force or a gap that a mean moves, or a law that is not one of friction.
 * */
static void find_what_varies(band_search *b, const int *part)
{
  const model *m = b->model;
  for (int j = 0; j < m->n_contacts; ++j) {
    int contacts = 0;
    bool moves = false;
    for (int k = 0; k < m->n_contacts; ++k) {
      if (part[k] != part[j]) continue;
      const model_contact *c = &m->contacts[k];
      contacts += !contact_goes_on(c->pair) || (c->pair == CONTACT_SECOND && !c->circle); /* of a square each tangent */
      moves |= !is_constant(&m->contacts[k].law);
    }
    b->varies[j] = moves && contacts > 1;
  }
}

hc_status band_search_new(const model *m, hbm_solver *s, timeint *exact, band_search **out)
{
  band_search *b = calloc(1, sizeof *b);
  *out = NULL;
  if (!b) return HC_NO_MEMORY;
  *b = (band_search){.model = m, .s = s, .exact = exact, .n_contacts = m->n_contacts, .n_responses = m->n_responses};
  const size_t contacts = (size_t)m->n_contacts;
  workspace *w = &b->memory;
  b->best = workspace_array(w, 2 * (size_t)m->n_responses, sizeof *b->best);
  b->waiting = workspace_array(w, MOST_SETS, sizeof *b->waiting);
  b->size = workspace_doubles(w, contacts);
  b->direction = workspace_doubles(w, contacts);
  b->is_located = workspace_array(w, 2 * (size_t)m->n_responses, sizeof *b->is_located);
  b->located = workspace_doubles(w, 2 * (size_t)m->n_responses * contacts);
  b->x = workspace_doubles(w, 2 * HBM_MAX_HARMONICS + 1);
  b->dx = workspace_doubles(w, 2 * HBM_MAX_HARMONICS + 1);
  b->room = workspace_array(w, contacts, sizeof *b->room);
  b->periods = workspace_array(w, contacts, sizeof *b->periods);
  b->varies = workspace_array(w, contacts, sizeof *b->varies);
  b->state = workspace_doubles(w, exact ? (size_t)timeint_n_states(exact) : 0);
  int *part = workspace_array(w, contacts, sizeof *part);
  hc_status st = w->failed ? HC_NO_MEMORY : model_parts_of_contacts(m, part);
  if (st == HC_OK) find_what_varies(b, part);
  if (st == HC_OK) *out = b;
  else band_search_free(b);
  return st;
}

void band_search_free(band_search *b)
{
  if (!b) return;
  workspace_free(&b->members);
  workspace_free(&b->memory);
  free(b);
}

static void copy_member(const band_search *b, const member *from, member *to)
{
  const size_t n = (size_t)b->n_coef, contacts = (size_t)b->n_contacts, responses = (size_t)b->n_responses;
  memcpy(to->X, from->X, n * sizeof *to->X);
  memcpy(to->along, from->along, n * sizeof *to->along);
  memcpy(to->w, from->w, contacts * sizeof *to->w);
  memcpy(to->asked, from->asked, contacts * sizeof *to->asked);
  memcpy(to->A, from->A, responses * sizeof *to->A);
  memcpy(to->rate, from->rate, responses * sizeof *to->rate);
  memcpy(to->free, from->free, contacts * sizeof *to->free);
  to->n_free = from->n_free, to->linear = from->linear, to->step = from->step;
}

static void swap_members(member *a, member *b)
{
  const member c = *a;
  *a = *b, *b = c;
}

/* ---- one member ---------------------------------------------------------------------------------- */

/* Amplitude of response r of X, where not NULL, and its rate as X moves along dX. */
static hc_status differentiate(band_search *b, const double *X, const double *dX, int r, double *A, double *rate)
{
  const int n_harm = hbm_n_harmonics(b->s);
  double max, min;
  hc_status st = hbm_response(b->s, b->omega, X, r, b->x);
  for (int i = 0; i < b->n_coef; ++i) b->moved[i] = X[i] + dX[i];
  if (st == HC_OK) st = hbm_response(b->s, b->omega, b->moved, r, b->dx);
  for (int i = 0; i < 2 * n_harm + 1; ++i) b->dx[i] -= b->x[i];
  series_extrema(n_harm, b->x, &max, &min);
  if (A) *A = 0.5 * (max - min);
  *rate = series_amplitude_rate(n_harm, b->x, b->dx);
  return st;
}

/* What there is to know of m->X, which hbm_solve has just found: its sliders, amplitudes, and rates along the line. */
static hc_status look_at(band_search *b, member *m)
{
  hbm_solver *s = b->s;
  hbm_measures measures;
  hc_status st = hbm_free_sliders(s, m->X, m->w, m->free);
  if (st == HC_OK) st = hbm_measure(s, m->X, &measures);
  if (st != HC_OK) return st;
  m->linear = measures.contact.regime <= CONTACT_STUCK;
  m->n_free = 0;
  memset(m->along, 0, (size_t)b->n_coef * sizeof *m->along);
  for (int j = 0; j < b->n_contacts && st == HC_OK; ++j) {
    m->n_free += m->free[j];
    if (!m->free[j] || b->direction[j] == 0) continue;
    st = hbm_rest_tangent(s, j, b->moved);
    for (int i = 0; i < b->n_coef; ++i) m->along[i] += b->direction[j] * b->moved[i];
  }
  for (int r = 0; r < b->n_responses && st == HC_OK; ++r)
    st = differentiate(b, m->X, m->along, r, &m->A[r], &m->rate[r]);
  return st;
}

/* *to: the member at `from` and so far along the line. HC_NOT_CONVERGED: another solution, too far away. */
static hc_status solve_along(band_search *b, const member *from, double step, member *to)
{
  hbm_point point;
  for (int j = 0; j < b->n_contacts; ++j) { /* who is not moved stays at the limit beyond which it was asked */
    const bool moved = from->free[j] && b->direction[j] != 0;
    to->asked[j] = moved ? from->w[j] + step * b->direction[j] : from->asked[j];
  }
  for (int i = 0; i < b->n_coef; ++i) to->X[i] = from->X[i] + step * from->along[i];
  const double predicted = hbm_distance(b->s, from->X, to->X);
  hbm_start_sliders(b->s, to->asked);
  hc_status st = hbm_solve(b->s, b->omega, to->X, &point);
  if (st == HC_OK && !(hbm_distance(b->s, from->X, to->X) <= fmax(near_enough, 3 * predicted))) st = HC_NOT_CONVERGED;
  if (st == HC_OK) st = look_at(b, to);
  to->step = from->step + step;
  return st;
}

/* ---- what was met ---------------------------------------------------------------------------------- */

static member *best_of(band_search *b, int r, bool high) { return &b->best[2 * r + high]; }

/* Do lines along each rest show all members with these free sliders, while no contact changes its state? With two
 * sliders of one tangent and no other contact the rests fill a polygon, since limits are linear in them; amplitudes are
 * the same all over it, and it is left where the two limits of one slider meet. A line along the other rest comes
 * there: it goes on along the border, the first slider being dragged. */
static bool is_polygon(const band_search *b, const member *m)
{
  bool circle = false;
  for (int j = 0; j < b->n_contacts; ++j) circle |= b->model->contacts[j].circle;
  return !circle && m->n_free <= 2 && b->n_contacts == m->n_free;
}

/* A member: is it the best of a response, or the first with its free sliders? */
static void take(band_search *b, const member *m)
{
  for (int r = 0; r < b->n_responses; ++r) {
    if (m->A[r] < best_of(b, r, false)->A[r]) copy_member(b, m, best_of(b, r, false));
    if (m->A[r] > best_of(b, r, true)->A[r]) copy_member(b, m, best_of(b, r, true));
  }
  if (!(m->linear && is_polygon(b, m)) && m->n_free > b->dimensions) b->dimensions = m->n_free;
  for (int i = 0; i < b->n_sets; ++i)
    if (!memcmp(b->waiting[i].free, m->free, (size_t)b->n_contacts * sizeof *m->free)) return;
  if (b->n_sets == MOST_SETS) b->whole = false;
  else copy_member(b, m, &b->waiting[b->n_sets++]);
}

/* Could an extremum between the two, by amplitudes and rates at both, beat the best? */
static bool pays(band_search *b, const member *from, const member *to, int r, bool high)
{
  const double span = to->step - from->step, sign = high ? 1 : -1;
  const double rise =
      fmin(sign * from->rate[r], -sign * to->rate[r]) * span; /* > 0: the rate changes its sign inside */
  const double most = sign * (high ? fmax(from->A[r], to->A[r]) : fmin(from->A[r], to->A[r])) +
                      0.5 * fmax(sign * from->rate[r], -sign * to->rate[r]) * span;
  return rise > 0 && most > sign * best_of(b, r, high)->A[r] + 1e-13 * fabs(to->A[r]);
}

/* An extremum of response r between two neighbours of the line: its rate's root, by false position of Illinois. */
static hc_status locate(band_search *b, const member *from, const member *to, int r)
{
  double low = 0, high_end = to->step - from->step, f_low = from->rate[r], f_high = to->rate[r];
  int side = 0;
  for (int i = 0; i < MOST_REFINED; ++i) {
    const double at = (low * f_high - high_end * f_low) / (f_high - f_low);
    const hc_status st = solve_along(b, from, at, &b->inside);
    if (st != HC_OK) return st;
    take(b, &b->inside);
    const double f = b->inside.rate[r], width = high_end - low;
    if (fabs(f) * width <= flat * b->inside.A[r] || width <= 1e-9) return HC_OK;
    if ((f > 0) == (f_low > 0)) {
      low = at, f_low = f;
      if (side == -1) f_high *= 0.5;
      side = -1;
    } else {
      high_end = at, f_high = f;
      if (side == 1) f_low *= 0.5;
      side = 1;
    }
  }
  b->whole = false;
  return HC_OK;
}

static hc_status locate_all(band_search *b, const member *from, const member *to)
{
  hc_status st = HC_OK;
  for (int r = 0; r < b->n_responses && st == HC_OK; ++r)
    for (int high = 0; high < 2 && st == HC_OK; ++high)
      if (pays(b, from, to, r, high)) {
        st = locate(b, from, to, r);
        if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) return st;
        if (st != HC_OK) b->whole = false, st = HC_OK;
      }
  return st;
}

/* ---- lines ------------------------------------------------------------------------------------------- */

/* How far sliders that are to move have moved, of how far they were asked to, by the one that did most. */
static double part_moved(const band_search *b, const member *from, const member *to, double step)
{
  double most = 0;
  for (int j = 0; j < b->n_contacts; ++j) {
    if (b->direction[j] == 0 || !to->free[j]) continue;
    most = fmax(most, fabs((to->w[j] - from->w[j]) / (step * b->direction[j])));
  }
  return most;
}

static bool same_set(const band_search *b, const member *m, const member *n)
{
  return m->linear == n->linear && !memcmp(m->free, n->free, (size_t)b->n_contacts * sizeof *m->free);
}

/* Does a slider of two tangents move? One that is asked beyond its limit does not rest at the limit but farther in
 * (planar_rest.h), so that ends are approached in short steps. */
static bool moves_in_plane(const band_search *b)
{
  bool any = false;
  for (int j = 0; j < b->n_contacts; ++j) any |= b->direction[j] != 0 && b->model->contacts[j].circle;
  return any;
}

/* From *start along b->direction to its end, where its sliders cannot be moved on, or slip. Where other sliders begin
 * or cease to be free amplitudes have a corner, next to which an extremum may lie: it is passed in a short step. r,
 * high: only as long as that amplitude grows or falls; r < 0: all the way. */
static hc_status follow(band_search *b, const member *start, int r, bool high)
{
  const bool in_plane = moves_in_plane(b);
  double step = first_step, corner = INFINITY; /* no farther away than this */
  copy_member(b, start, &b->here);
  b->here.step = 0;
  hc_status st = solve_along(b, start, 0, &b->here); /* with this line's rates */
  if (start->linear && !in_plane) step = linear_step;
  for (int i = 0; i < MOST_STEPS && st == HC_OK; ++i) {
    st = solve_along(b, &b->here, step, &b->next);
    if (st == HC_NO_MEMORY || st == HC_INTERRUPTED) return st;
    if (!hc_monitor_tick(b->monitor, -1)) return HC_INTERRUPTED;
    if (st != HC_OK) {
      step *= 0.25;
      st = step < least_step ? st : HC_OK;
      continue;
    }
    const double moved = part_moved(b, &b->here, &b->next, step), sign = high ? 1 : -1;
    const bool passed = !same_set(b, &b->here, &b->next) || (in_plane && moved < 0.999);
    take(b, &b->next);
    if (passed && step > (in_plane ? plane_step : corner_step)) {
      corner = step;
      step *= in_plane ? 0.25 : 0.5;
      continue;
    }
    if (moved > 1e-6 && (st = locate_all(b, &b->here, &b->next)) != HC_OK) return st;
    if (r >= 0 && !(sign * b->next.rate[r] > 0 && sign * (b->next.A[r] - b->here.A[r]) > 0)) return HC_OK;
    if (moved < 0.999) return HC_OK; /* at the limit, or none of them is free any more */
    swap_members(&b->here, &b->next);
    corner = passed ? INFINITY : corner - step;
    step = passed ? first_step : fmin(1.5 * step, longest_step);
    if (b->here.linear && !in_plane) step = linear_step;
    if (step >= corner) step = fmax(0.5 * corner, corner_step);
  }
  b->whole = false;
  return HC_OK;
}

/* Both ways along each of the free sliders of a member. */
static hc_status follow_set(band_search *b, const member *from)
{
  hc_status st = HC_OK;
  if (from->n_free > MOST_LINES) return b->whole = false, HC_OK;
  for (int j = 0; j < b->n_contacts && st == HC_OK; ++j)
    for (int to = -1; to <= 1 && from->free[j] && b->varies[j] && st == HC_OK; to += 2) {
      memset(b->direction, 0, (size_t)b->n_contacts * sizeof *b->direction);
      b->direction[j] = to * b->size[j];
      copy_member(b, from, &b->origin);
      st = follow(b, &b->origin, -1, false);
    }
  return st;
}

/* Is slider j of *m at its limit, beyond which `to` (> 0: larger w) leads? */
static bool is_held(const band_search *b, const member *m, int j, double to)
{
  const double beyond = m->asked[j] - m->w[j];
  return fabs(beyond) > 1e-9 * b->size[j] && beyond * to > 0;
}

/* b->direction: by which amplitude r of *m, from now on b->origin, grows fastest, or falls, of length 1 in slip
 * lengths: a back-substitution a slider. *found: there is one. */
static hc_status climb_direction(band_search *b, const member *m, int r, bool high, bool *found)
{
  double length = 0;
  *found = false;
  memset(b->direction, 0, (size_t)b->n_contacts * sizeof *b->direction);
  hc_status st = solve_along(b, m, 0, &b->origin); /* for its factors */
  const member *at = &b->origin;
  for (int j = 0; j < b->n_contacts && st == HC_OK; ++j) {
    double rate = 0;
    if (!at->free[j] || !b->varies[j]) continue;
    st = hbm_rest_tangent(b->s, j, b->origin.along);
    if (st == HC_OK) st = differentiate(b, at->X, at->along, r, NULL, &rate);
    rate *= (high ? 1 : -1) * b->size[j];
    b->direction[j] = is_held(b, at, j, rate) ? 0 : rate;
    length = hypot(length, b->direction[j]);
  }
  for (int j = 0; j < b->n_contacts && length > 0; ++j) b->direction[j] *= b->size[j] / length;
  *found = st == HC_OK && length > 1e-9 * at->A[r];
  return st;
}

static hc_status climb(band_search *b, int r, bool high)
{
  hc_status st = HC_OK;
  const member *best = best_of(b, r, high);
  for (int i = 0; i < MOST_CLIMBS && st == HC_OK; ++i) {
    const double before = best->A[r], other = best_of(b, r, !high)->A[r];
    bool found;
    st = climb_direction(b, best, r, high, &found);
    if (st != HC_OK || !found) break;
    st = follow(b, &b->origin, r, high);
    if (fabs(best->A[r] - before) <= little_gain * fabs(best->A[r] - other)) break;
  }
  return st == HC_NO_MEMORY || st == HC_INTERRUPTED ? st : HC_OK;
}

/* ---- by the exact law ------------------------------------------------------------------------------------ */

/* Contacts with a free slider: of two tangents under one limit one. */
static int count_free_contacts(const band_search *b, const member *m)
{
  int n = 0;
  for (int j = 0; j < b->n_contacts; ++j)
    n += m->free[j] && !(b->model->contacts[j].circle && b->model->contacts[j].pair == CONTACT_SECOND);
  return n;
}

/* Amplitude of response r on the exact law's orbit next to b->state, where its sliders are at w; NaN: there is none on
 * which all of them are free. b->state becomes a point on it; room: of its free sliders. */
static double exact_amplitude(band_search *b, const member *m, const double *w, int r, bool rooms, hc_status *st)
{
  timeint_result found;
  const int n = 2 * b->model->n;
  for (int j = 0; j < b->n_contacts; ++j)
    if (m->free[j]) b->state[n + j] = w[j];
  hc_status sought = timeint_orbit(b->exact, b->omega, 1, b->state, b->monitor, &found);
  if (sought == HC_OK && rooms) sought = timeint_slider_rooms(b->exact, &found, b->room);
  if (sought == HC_OK && r > 0) sought = timeint_response(b->exact, r, &found);
  if (sought == HC_NO_MEMORY || sought == HC_INTERRUPTED) *st = sought;
  const bool same = sought == HC_OK && found.period_multiple == 1 && found.free_sliders >= count_free_contacts(b, m) &&
                    fabs(found.amplitude - m->A[r]) <= 0.2 * m->A[r];
  return same ? found.amplitude : NAN;
}

/* The sliders of one tangent at their limit, those asked beyond it; how many, most at most. */
static int list_held(const band_search *b, const member *m, int most, int *held)
{
  int n = 0;
  for (int j = 0; j < b->n_contacts && n < most; ++j)
    if (m->free[j] && !b->model->contacts[j].circle && fabs(m->asked[j] - m->w[j]) > 1e-9 * b->size[j]) held[n++] = j;
  return n;
}

/* Broyden's update J += (f - J s) s^T/(s.s), for a step s that has changed the rooms by f. */
static void update_slopes(int n, const double *s, const double *f, double *J)
{
  double square = 0;
  for (int j = 0; j < n; ++j) square += s[j] * s[j];
  for (int i = 0; i < n && square > 0; ++i) {
    double miss = f[i];
    for (int j = 0; j < n; ++j) miss -= J[i + n * j] * s[j];
    for (int j = 0; j < n; ++j) J[i + n * j] += miss * s[j] / square;
  }
}

/* Moves the sliders at their limit to where the exact law has it: the room left to each, in slip lengths, is brought to
 * 0 by Broyden's method, from slopes of -1 towards the limit. A slider beyond its limit is dragged back to it, and
 * counts where it is. */
static double locate_end(band_search *b, const member *m, int r, double *w, hc_status *st)
{
  int held[MOST_HELD], pivot[MOST_HELD];
  double J[MOST_HELD * MOST_HELD] = {0}, lu[MOST_HELD * MOST_HELD], at[2][MOST_HELD], room[2][MOST_HELD],
                       step[MOST_HELD], change[MOST_HELD], A = NAN;
  const int n = list_held(b, m, MOST_HELD, held), first = 2 * b->model->n;
  memcpy(w, m->w, (size_t)b->n_contacts * sizeof *w);
  bool reached = false, lower[MOST_HELD]; /* T is at -mu N: w is at its largest */
  for (int i = 0; i < n; ++i) {
    lower[i] = m->asked[held[i]] > m->w[held[i]];
    J[i + n * i] = lower[i] ? -1 : 1;
  }
  for (int k = 0; k < MOST_CONFIRMED && *st == HC_OK; ++k) {
    double *here = at[k % 2], *left = room[k % 2], most = 0;
    A = exact_amplitude(b, m, w, r, true, st);
    if (isnan(A)) return A;
    for (int i = 0; i < n; ++i) {
      const int j = held[i];
      here[i] = b->state[first + j] / b->size[j];
      left[i] = b->room[j][lower[i]] / (b->model->contacts[j].law.kt * b->size[j]);
      most = fmax(most, left[i]);
    }
    if (most <= at_limit) return A;
    reached = most <= about_at_limit;
    if (k + 1 == MOST_CONFIRMED) break;
    for (int i = 0; i < n && k > 0; ++i) {
      step[i] = here[i] - at[(k + 1) % 2][i];
      change[i] = left[i] - room[(k + 1) % 2][i];
    }
    if (k > 0) update_slopes(n, step, change, J);
    memcpy(lu, J, sizeof lu);
    for (int i = 0; i < n; ++i) step[i] = -left[i];
    if (dense_factor(n, lu, pivot) != HC_OK) break;
    dense_solve(n, lu, pivot, 1, step);
    for (int i = 0; i < n; ++i) w[held[i]] = b->size[held[i]] * (here[i] + step[i]);
  }
  return reached ? A : NAN;
}

/* The extremum between limits, of one free slider: parabolas through three orbits, each narrower than the one before;
 * the best of all orbits. Of several sliders the orbit at the member's rests: what they are off by moves the extremum
 * in second order. */
static double locate_inside(band_search *b, const member *m, int r, bool high, double *w, hc_status *st)
{
  int free = -1;
  memcpy(w, m->w, (size_t)b->n_contacts * sizeof *w);
  for (int j = 0; j < b->n_contacts; ++j)
    if (m->free[j]) free = free < 0 ? j : b->n_contacts;
  double best = exact_amplitude(b, m, w, r, false, st);
  if (free < 0 || free >= b->n_contacts) return best;
  double middle = w[free], by = 0.03 * b->size[free];
  for (int i = 0; i < 3 && *st == HC_OK && !isnan(best); ++i, by /= 8) {
    double A[3] = {NAN, NAN, NAN};
    for (int k = -1; k <= 1 && *st == HC_OK; ++k) {
      w[free] = middle + k * by;
      A[k + 1] = exact_amplitude(b, m, w, r, false, st);
      if (!isnan(A[k + 1])) best = high ? fmax(best, A[k + 1]) : fmin(best, A[k + 1]);
    }
    const double bend = A[0] - 2 * A[1] + A[2], shift = 0.5 * (A[0] - A[2]) / bend;
    if (!(fabs(shift) <= 8 && (bend < 0) == high)) return best;
    middle += shift * by;
  }
  return best;
}

/* An earlier response whose extremum is the same end of the family, and was located: 2 q + high of it; -1: none. */
static int same_end(const band_search *b, const member *m)
{
  for (const member *n = b->best; n < m; ++n) {
    bool same = b->is_located[n - b->best];
    for (int j = 0; j < b->n_contacts && same; ++j) same = fabs(m->w[j] - n->w[j]) <= 1e-9 * b->size[j];
    if (same) return (int)(n - b->best);
  }
  return -1;
}

/* *amplitude: of the exact law at the least or largest member of response r; NaN: it has none there. */
static hc_status confirm(band_search *b, int r, bool high, double *amplitude)
{
  const member *m = best_of(b, r, high);
  const bool held = list_held(b, m, 1, &(int){0}) > 0;
  const int known = held ? same_end(b, m) : -1;
  const size_t contacts = (size_t)b->n_contacts, place = (size_t)(m - b->best);
  double *located = b->located + place * contacts;
  hc_status st = HC_OK;
  b->is_located[place] = false;
  hbm_start_sliders(b->s, m->asked);
  *amplitude = NAN;
  if (comparison_orbit_start(b->s, m->X, b->omega, b->state) != HC_OK) return HC_OK;
  if (known >= 0) memcpy(located, b->located + (size_t)known * contacts, contacts * sizeof *located);
  if (known >= 0) *amplitude = exact_amplitude(b, m, located, r, false, &st);
  else if (held) *amplitude = locate_end(b, m, r, located, &st);
  else *amplitude = locate_inside(b, m, r, high, located, &st);
  b->is_located[place] = held && !isnan(*amplitude);
  return st;
}

/* ---- the search -------------------------------------------------------------------------------------------- */

/* b->origin: the solution itself, with its sliders where they are. */
static hc_status begin(band_search *b, double omega, const double *X)
{
  hc_status st = make_members(b);
  if (st != HC_OK) return st;
  b->omega = omega;
  b->whole = true;
  b->dimensions = b->n_sets = b->n_done = 0;
  memset(b->direction, 0, (size_t)b->n_contacts * sizeof *b->direction);
  for (int j = 0; j < b->n_contacts; ++j) b->origin.asked[j] = b->model->contacts[j].rest;
  memcpy(b->origin.X, X, (size_t)b->n_coef * sizeof *X);
  b->origin.step = 0;
  hbm_start_sliders(b->s, NULL);
  return look_at(b, &b->origin);
}

/* Slip lengths, by the mean of the largest and the least normal force. */
static hc_status find_sizes(band_search *b)
{
  const hc_status st = hbm_measure_contacts(b->s, b->omega, b->origin.X, b->periods);
  const model *m = b->model;
  for (int j = 0, whole = -1; j < b->n_contacts && st == HC_OK; ++j) {
    const contact *law = &m->contacts[j].law;
    whole += !contact_goes_on(m->contacts[j].pair);
    const contact_period *p = &b->periods[whole];
    const double share = m->contacts[j].pair == CONTACT_FIRST || m->contacts[j].pair == CONTACT_SECOND ? 0.5 : 1;
    b->size[j] = law->kt > 0 ? law->mu * share * 0.5 * (p->normal_min + p->normal_max) / law->kt : 0;
  }
  return st;
}

static bool may_vary(const band_search *b)
{
  for (int j = 0; j < b->n_contacts; ++j)
    if (b->origin.free[j] && b->varies[j]) return true;
  return false;
}

static hc_status search_members(band_search *b)
{
  for (int i = 0; i < 2 * b->n_responses; ++i) copy_member(b, &b->origin, &b->best[i]);
  take(b, &b->origin);
  hc_status st = HC_OK;
  while (b->n_done < b->n_sets && st == HC_OK) st = follow_set(b, &b->waiting[b->n_done++]);
  if (b->dimensions < 2 && b->whole) return st;
  for (int r = 0; r < b->n_responses && st == HC_OK; ++r)
    for (int high = 0; high < 2 && st == HC_OK; ++high) st = climb(b, r, high);
  return st;
}

hc_status band_find(band_search *b, double omega, const double *X, const hc_monitor *monitor, band *out)
{
  const long before = hbm_solves(b->s);
  b->monitor = monitor;
  hc_status st = begin(b, omega, X);
  for (int r = 0; r < b->n_responses && st == HC_OK; ++r)
    out[r] =
        (band){.kind = b->origin.n_free > 0 ? BAND_EXACT : BAND_NONE, .low = b->origin.A[r], .high = b->origin.A[r]};
  if (st == HC_OK && b->origin.n_free > 0 && may_vary(b)) {
    st = find_sizes(b);
    if (st == HC_OK) st = search_members(b);
    const bool exact = b->whole && b->dimensions < 2;
    for (int r = 0; r < b->n_responses && st == HC_OK; ++r) {
      out[r] = (band){exact ? BAND_EXACT : BAND_AT_LEAST, best_of(b, r, false)->A[r], best_of(b, r, true)->A[r], false};
      double ends[2] = {NAN, NAN};
      for (int high = 0; high < 2 && b->exact && st == HC_OK; ++high) st = confirm(b, r, high, &ends[high]);
      out[r].confirmed = !isnan(ends[0]) && !isnan(ends[1]);
      if (out[r].confirmed) out[r].low = fmin(ends[0], ends[1]), out[r].high = fmax(ends[0], ends[1]);
      else if (b->exact) out[r].kind = BAND_AT_LEAST;
    }
  }
  if (st != HC_OK && st != HC_NO_MEMORY && st != HC_INTERRUPTED) { /* nothing is known */
    for (int r = 0; r < b->n_responses; ++r) out[r] = (band){.kind = BAND_NOT_ASKED, .low = NAN, .high = NAN};
    st = HC_OK;
  }
  hbm_start_sliders(b->s, NULL);
  b->solves += hbm_solves(b->s) - before;
  return st;
}

long band_solves(const band_search *b) { return b->solves; }
