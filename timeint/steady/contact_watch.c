/* contact_watch.c - see contact_watch.h. Lengths, forces and angles are the scaled model's until report(). Proof:
 * tests/timeint/test_contact_watch.c. */
#include "timeint/steady/contact_watch.h"

#include <float.h>
#include <string.h>

#include "numerics/gauss.h"
#include "numerics/roots.h"
#include "timeint/law/contact_rows.h"
#include "timeint/steady/timeint_private.h"

/* A contact at one instant. */
typedef struct contact_instant {
  contact_state state;
  double du, dv;              /* u', v'; of a circle (u - w).u', which has the sign of |T|' while it sticks */
  double normal, pull;        /* N, T; of a circle's first direction |T| */
  double room[2], narrows[2]; /* mu N - T, mu N + T, and their rates; of a circle mu N - |T| twice */
  double slip, loss;          /* |w'| while it slips; the rate of work */
} contact_instant;

typedef struct contact_sums {
  unsigned char seen;
  contact_instant last, now; /* where the step has come to, and comes to */
  double normal_min, normal_max, traction_max, slip, work, room[2];
} contact_sums;

typedef struct contact_watch {
  const timeint *ti;
  const integrator *in; /* of the step under way */
  bool rooms;           /* are asked for, too */
  int n_contacts;
  double stiffest; /* [rad/rad] the highest frequency of a linear state, over omega */
  double *y, *dy;  /* [n] the state and its derivative where it is looked at */
  contact_rows rows;
  double *q, *dq;   /* [rows.count] the contacts' motion there, and its rate */
  contact_sums *of; /* [n_contacts] */
} contact_watch;

/* u and v, or their rates, of contact j in the directions that share its law from j on. */
static double motion_of(const contact_watch *w, const double *q, int j, double u[2])
{
  u[0] = contact_rows_at(q, w->rows.along[j]);
  u[1] = j + 1 < w->n_contacts ? contact_rows_at(q, w->rows.along[j + 1]) : 0;
  return contact_rows_at(q, w->rows.across[j]);
}

/* In stick T' = kt u', and of a circle |T|' = kt (u - w).u'/|u - w|, the product being at->du. */
static void find_rooms(const law_regularised *law, bool circle, const planar_value *value, contact_instant *at)
{
  const double limit = law->mu * value->n, of_limit = law->mu * law->kn * at->dv;
  const double pull = circle ? at->pull : value->t[0], rate = !circle    ? law->kt * at->du
                                                              : pull > 0 ? law->kt * law->kt * at->du / pull
                                                                         : 0;
  for (int s = 0; s < 2; ++s) {
    const double sign = circle || s == 0 ? 1 : -1;
    at->room[s] = limit - sign * pull;
    at->narrows[s] = of_limit - sign * rate;
  }
}

static contact_instant contact_at(const contact_watch *w, int j)
{
  const scaled_model *m = &w->ti->scaled;
  const int first = scaled_first(m, j), directions = scaled_directions(m, j);
  const scaled_contact *c = &m->contact[first];
  const double *slider = w->y + 2 * m->n + first, *slides = w->dy + 2 * m->n + first;
  const bool exact = w->ti->how.law == TRANSIENT_LAW_EXACT;
  contact_motion moves;
  moves.v = motion_of(w, w->q, first, moves.u), moves.dv = motion_of(w, w->dq, first, moves.du);
  const double *u = moves.u, *du = moves.du, v = moves.v, dv = moves.dv;
  const planar_value value = c->kind->evaluate(&c->law, &moves, slider);
  contact_instant at = {.du = du[j - first], .dv = dv, .normal = value.n};
  at.state = exact ? integrate_contact(w->in, j, w->y) : scaled_state_of(m, first, v, &value);
  if (j > first) { /* the first has all but N */
    at.normal = law_regularised_eval(&m->contact[j].law, 0, v, 0).n;
    return at;
  }
  if (directions > 1) at.du = (u[0] - slider[0]) * du[0] + (u[1] - slider[1]) * du[1];
  if (c->kind->smooth) {
    at.pull = value.t[0];
    at.slip = value.n > 0 ? fabs(at.du) : 0;
    at.loss = value.t[0] * at.du;
  }
  if (!c->law.has_friction || at.state == CONTACT_SEPARATED) return at;
  const bool slips = at.state != CONTACT_STICK;
  const double *rate = exact ? slides : value.rate;
  at.pull = hypot(value.t[0], value.t[1]); /* of one tangent t[1] = 0 */
  if (exact) find_rooms(&c->law, directions > 1, &value, &at);
  if (slips) at.slip = directions > 1 ? hypot(rate[0], rate[1]) : fabs(rate[0]);
  at.loss = exact ? c->law.mu * value.n * at.slip : value.t[0] * du[0] + (directions > 1 ? value.t[1] * du[1] : 0);
  return at;
}

static void extend(contact_sums *s, const contact_instant *at)
{
  s->seen |= measure_seen(at->state);
  s->normal_min = fmin(s->normal_min, at->normal);
  s->normal_max = fmax(s->normal_max, at->normal);
  s->traction_max = fmax(s->traction_max, fabs(at->pull));
  for (int i = 0; i < 2; ++i) s->room[i] = fmin(s->room[i], at->room[i]);
}

static hc_status look(contact_watch *w, double theta)
{
  hc_status st = integrate_dense(w->in, theta, 0, w->y);
  if (st == HC_OK) st = integrate_dense(w->in, theta, 1, w->dy);
  contact_rows_motion(&w->rows, w->y, w->q);
  contact_rows_motion(&w->rows, w->dy, w->dq);
  return st;
}

/* What of a contact has an extremum where its rate changes sign: T, N, or the room up to either limit. */
typedef enum contact_turn { TURN_PULL, TURN_NORMAL, TURN_ROOM, TURN_OTHER_ROOM, TURNS } contact_turn;

static double turn_rate(const contact_instant *at, contact_turn of)
{
  const double rates[] = {at->du, at->dv, at->narrows[0], at->narrows[1]};
  return rates[of];
}

/* Such a rate along the step. */
typedef struct contact_rate {
  contact_watch *w;
  int contact;
  contact_turn of;
} contact_rate;

static hc_status rate_at(void *self, double theta, double *rate)
{
  const contact_rate *of = self;
  const scaled_model *m = &of->w->ti->scaled;
  double du[2], dv;
  if (of->of >= TURN_ROOM || (scaled_directions(m, of->contact) > 1 && of->of == TURN_PULL)) {
    hc_status st = look(of->w, theta);
    const contact_instant at = contact_at(of->w, of->contact);
    *rate = st == HC_OK ? turn_rate(&at, of->of) : NAN;
    return st;
  }
  hc_status st = integrate_dense(of->w->in, theta, 1, of->w->dy);
  scaled_contact_motion(m, of->contact, of->w->dy, du, &dv);
  *rate = of->of == TURN_NORMAL ? dv : du[0];
  return st;
}

/* Between theta0, where the contact was as in `last`, and theta1, where it is as in `now`. */
static hc_status add_turn(contact_watch *w, int j, contact_turn of, double theta0, double theta1)
{
  contact_rate rate = {w, j, of};
  const double before = turn_rate(&w->of[j].last, of), after = turn_rate(&w->of[j].now, of);
  root_point turn;
  if ((before > 0) == (after > 0)) return HC_OK;
  hc_status st = root_between(rate_at, &rate, theta0, before, theta1, after, 4 * DBL_EPSILON * theta1, &turn);
  if (st == HC_OK) st = look(w, turn.x);
  if (st != HC_OK) return st;
  const contact_instant at = contact_at(w, j);
  extend(&w->of[j], &at);
  return HC_OK;
}

/* All contacts at theta, coming from theta0; the rates of work and slip count with `weight`. */
static hc_status go_to(contact_watch *w, double theta0, double theta, double weight)
{
  hc_status st = look(w, theta);
  for (int j = 0; j < w->n_contacts && st == HC_OK; ++j) {
    contact_sums *s = &w->of[j];
    const contact_instant at = s->now = contact_at(w, j);
    extend(s, &at);
    s->slip += weight * at.slip;
    s->work += weight * at.loss;
  }
  for (int j = 0; j < w->n_contacts && st == HC_OK; ++j) { /* look() again: w->y is lost */
    contact_sums *s = &w->of[j];
    const int turns = w->rooms ? TURNS : TURN_ROOM;
    for (int of = 0; of < turns && theta > theta0 && st == HC_OK; ++of)
      st = add_turn(w, j, (contact_turn)of, theta0, theta);
    s->last = s->now;
  }
  return st;
}

/* [rad of the stiffest state] Four points are off by (h/2)^9 f^(8) 4!^4 2^9/(9 8!^3), 1e-14 of h f there. */
static const double short_step = 0.25;

static hc_status watch_step(void *self, const integrator *in, double theta0, double theta1)
{
  contact_watch *w = self;
  const double oscillates = (theta1 - theta0) * w->stiffest;
  double integrals[3];
  const bool any_length = integrate_fourier(in, 0, integrals); /* else a step is a polynomial */
  const int panels = 1 + (any_length ? (int)fmin(oscillates, 1000) : 0),
            points = oscillates <= short_step ? GAUSS_FEW : GAUSS_POINTS;
  const double half = 0.5 * (theta1 - theta0) / panels;
  /* Only events of the exact law change contact states between the end of a step and the start of the next. */
  const bool evaluated = w->in && w->ti->how.law != TRANSIENT_LAW_EXACT;
  w->in = in;
  hc_status st = evaluated ? HC_OK : go_to(w, theta0, theta0, 0);
  double here = theta0;
  for (int p = 0; p < panels; ++p)
    for (int i = 0; i < points && st == HC_OK; ++i) {
      const double theta = theta0 + half * (2 * p + 1 + gauss_node(points, i));
      st = go_to(w, here, theta, half * gauss_weight(points, i));
      here = theta;
    }
  return st == HC_OK ? go_to(w, here, theta1, 0) : st;
}

/* w->of[contacts] along the k periods of the last result. w.memory is the caller's to free. */
static hc_status watch_periods(timeint *ti, int k, contact_watch *w, workspace *memory)
{
  const int n_contacts = w->n_contacts = ti->scaled.n_contacts;
  double *y = ti->point[2];
  w->ti = ti;
  w->y = ti->point[0], w->dy = ti->point[1];
  w->stiffest = ti->base->highest / ti->omega;
  hc_status st = contact_rows_make(&w->rows, ti->base, memory);
  w->of = workspace_array(memory, (size_t)n_contacts, sizeof *w->of);
  w->q = workspace_doubles(memory, (size_t)w->rows.count);
  w->dq = workspace_doubles(memory, (size_t)w->rows.count);
  if (memory->failed) return HC_NO_MEMORY;
  for (int j = 0; j < n_contacts; ++j) w->of[j] = (contact_sums){.normal_min = INFINITY, .room = {INFINITY, INFINITY}};
  memcpy(y, ti->y, (size_t)ti->n * sizeof *y);
  if (st == HC_OK) st = timeint_set_tolerance(ti, timeint_final_tolerance(ti));
  for (int i = 0; i < k && st == HC_OK; ++i) st = integrate_period(ti->in, &ti->scaled, y, watch_step, w);
  return st;
}

/* [force] a unit of the scaled model's. */
static double force_of(const timeint *ti) { return scaled_force_unit(&ti->scaled, ti->omega, ti->length); }

hc_status timeint_contacts(timeint *ti, const timeint_result *r, contact_period *out)
{
  const int k = r->period_multiple > 0 ? r->period_multiple : 1;
  contact_watch w = {.rooms = false};
  workspace memory = {0};
  const hc_status st = watch_periods(ti, k, &w, &memory);
  const double length = ti->length, force = force_of(ti);
  for (int j = 0; j < w.n_contacts && st == HC_OK; ++j) {
    const contact_sums *s = &w.of[j];
    const bool slipped = s->seen & SEEN_SLIPPING || ti->scaled.contact[j].kind->smooth; /* else it is rounding */
    out[j] = (contact_period){.regime = measure_seen_regime(s->seen, &ti->model->contacts[j].law),
                              .normal_min = s->normal_min * force,
                              .normal_max = s->normal_max * force,
                              .traction_max = s->traction_max * force,
                              .slip_distance = s->slip * length / k,
                              .work = slipped ? s->work * force * length / k : 0};
  }
  workspace_free(&memory);
  return st;
}

hc_status timeint_slider_rooms(timeint *ti, const timeint_result *r, double (*room)[2])
{
  contact_watch w = {.rooms = true};
  workspace memory = {0};
  const hc_status st = watch_periods(ti, r->period_multiple > 0 ? r->period_multiple : 1, &w, &memory);
  for (int j = 0; j < w.n_contacts && st == HC_OK; ++j)
    for (int s = 0; s < 2; ++s) room[j][s] = w.of[j].room[s] * force_of(ti);
  workspace_free(&memory);
  return st;
}
