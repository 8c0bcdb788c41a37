/* integrate_closed.c - see integrate_closed.h. The phases are phase.h's, as in integrate_exact.c; between them the mass
 * is one mode of modal_motion.h. A watched period is cut at the turning points of X, too, so that the peaks are ends of
 * steps. Proof: tests/timeint/test_closed.c. */
#include "timeint/integrate_closed.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/constants.h"
#include "timeint/integrate_private.h"
#include "timeint/modal_motion.h"
#include "timeint/phase.h"
#include "timeint/variations.h"

enum {
  MAX_SEGMENTS = 100000 /* per period */
};

enum { GUARD_UP, GUARD_DOWN, GUARD_TURN, GUARDS };

typedef struct closed_form { /* from integrate_new_closed, to integrate_free; not shared between threads */
  integrator base;
  int n;                 /* number of states */
  const scaled_model *m; /* of the period under way; the caller's */
  phase phase, before;   /* now; before the last transition */
  variations variations;
  /* the mass, a single mode, in the present segment, from its beginning to its end */
  modal_motion motion;
  mode mode;
  double q, p, d;
  double complex f;
  modal_point end, scratch;
  double room[2][4]; /* q, p, a, j of the two points */
} closed_form;

static modal_point point_in(double room[4])
{
  return (modal_point){.q = &room[0], .p = &room[1], .a = &room[2], .j = &room[3]};
}

/* The segment from theta on, in the phase as it is. */
static void begin_segment(closed_form *in, double theta, double x, double p)
{
  in->mode = mode_make(in->m->c, in->phase.k);
  in->q = x;
  in->p = p;
  in->d = -in->phase.d;
  in->f = in->m->f;
  in->motion =
      (modal_motion){.n = 1, .theta = theta, .mode = &in->mode, .q = &in->q, .p = &in->p, .d = &in->d, .f = &in->f};
}

/* What ends the segment: the ends of the phase, and P = 0 where a contact slips or the period is watched. P has the
 * sign of the phase's way; where it has not, since X crossed an end where it turns, by rounding behind the turn, the
 * segment ends at once. numbers[i]: which one guard i is. */
static int find_guards(const closed_form *in, bool watched, modal_guard *guards, int *numbers)
{
  static const double up = -1, down = 1;
  const phase *ph = &in->phase;
  int n = 0;
  if (ph->up < INFINITY) {
    numbers[n] = GUARD_UP;
    guards[n++] = (modal_guard){.by_q = &up, .constant = ph->up, .noise = DBL_EPSILON * fmax(1, fabs(ph->up))};
  }
  if (ph->down > -INFINITY) {
    numbers[n] = GUARD_DOWN;
    guards[n++] = (modal_guard){.by_q = &down, .constant = -ph->down, .noise = DBL_EPSILON * fmax(1, fabs(ph->down))};
  }
  if (ph->slips || watched) {
    numbers[n] = GUARD_TURN;
    guards[n++] = (modal_guard){.by_p = ph->way > 0 ? &down : &up, .noise = DBL_EPSILON};
  }
  return n;
}

/* The sign of P from the end of the segment on. Where P = 0 ended it, in->end.p becomes 0, but not where P was behind
 * that from the beginning: next to a turn X is flat, and a rounding of X is 1e-8 of P. */
static int way_on(closed_form *in, int guard)
{
  double *p = &in->end.p[0];
  if (guard != GUARD_TURN) return guard == GUARD_UP ? 1 : -1;
  if (in->end.tau == 0 && *p * in->phase.way < 0) return -in->phase.way;
  *p = 0;
  return in->end.a[0] > 0 ? 1 : -1;
}

/* The phase after the segment has ended at theta on that guard; *count transitions so far. */
static hc_status pass(closed_form *in, int guard, double theta, bool varies, int *count)
{
  const int most = integrate_most_transitions(in->m->n_contacts);
  phase_copy(&in->before, &in->phase);
  const int n = phase_next(&in->phase, in->end.q[0], way_on(in, guard), guard == GUARD_TURN);
  if (!n) return HC_OK;
  if ((*count += n) > most) return HC_CHATTER;
  if (varies) {
    variations_advance(&in->variations, &in->before, theta);
    variations_stick(&in->variations, &in->phase, &in->before);
  }
  return HC_OK;
}

/* From theta = 0 to the end of the period. */
static hc_status run(closed_form *in, bool varies, integrate_watch *watch, void *self, int *count)
{
  double theta = 0;
  for (int segments = 0; theta < TWO_PI; ++segments) {
    modal_guard guards[GUARDS];
    int numbers[GUARDS];
    const int n_guards = find_guards(in, watch != NULL, guards, numbers);
    const int hit =
        modal_first_crossing(&in->motion, TWO_PI - theta, n_guards, guards, &in->end, &in->scratch, &in->base.rhs);
    const double begun = theta;
    theta = hit < 0 ? TWO_PI : fmin(theta + in->end.tau, TWO_PI);
    if (!isfinite(in->end.q[0] + in->end.p[0] + in->end.a[0])) return HC_NOT_FINITE;
    if (segments > MAX_SEGMENTS) return HC_CHATTER;
    ++in->base.steps;
    hc_status st = watch && theta > begun ? watch(self, &in->base, begun, theta) : HC_OK;
    if (st == HC_OK && hit >= 0) st = pass(in, numbers[hit], theta, varies, count);
    if (st != HC_OK) return st;
    begin_segment(in, theta, in->end.q[0], in->end.p[0]);
  }
  return HC_OK;
}

static hc_status period(integrator *base, const scaled_model *m, double *y, double *monodromy, integrate_watch *watch,
                        void *self)
{
  closed_form *in = (closed_form *)base;
  if (m->n_states != in->n) return HC_BUG;
  in->m = m;
  int count = phase_begin(&in->phase, m, y);
  if (count < 0) return HC_NOT_FINITE;
  if (monodromy) variations_begin(&in->variations, &in->phase);
  begin_segment(in, 0, y[SCALED_X], y[SCALED_P]);
  hc_status st = run(in, monodromy != NULL, watch, self, &count);
  base->transitions += count;
  if (st != HC_OK) return st;
  y[SCALED_X] = in->q;
  y[SCALED_P] = in->p;
  phase_set_sliders(&in->phase, 0, y);
  if (monodromy) variations_end(&in->variations, &in->phase, monodromy);
  return HC_OK;
}

static hc_status dense(const integrator *base, double theta, int order, double *y)
{
  const closed_form *in = (const closed_form *)base;
  double room[4];
  modal_point at = point_in(room);
  modal_at(&in->motion, theta - in->motion.theta, &at);
  y[SCALED_X] = order == 0 ? at.q[0] : at.p[0];
  y[SCALED_P] = order == 0 ? at.p[0] : at.a[0];
  phase_set_sliders(&in->phase, order, y);
  return HC_OK;
}

static hc_status samples(const integrator *base, int r, double theta, double step, int count, double *x)
{
  (void)r;
  modal_samples(&((const closed_form *)base)->motion, 0, theta, step, count, x);
  return HC_OK;
}

static bool fourier(const integrator *base, int r, double out[3])
{
  (void)r;
  const closed_form *in = (const closed_form *)base;
  double room[4];
  modal_point at = point_in(room);
  at.q[0] = in->q;
  at.p[0] = in->p;
  at.tau = 0;
  return modal_fourier(&in->motion, 0, &at, &in->end, out);
}

static contact_state state(const integrator *base, int j, const double *y)
{
  (void)y; /* the phase has it */
  return ((const closed_form *)base)->phase.contact[j].state;
}

static hc_status tolerance(integrator *base, double ignored)
{
  (void)base, (void)ignored;
  return HC_OK;
}

static void release(integrator *base)
{
  closed_form *in = (closed_form *)base;
  free(in->phase.contact);
  free(in->before.contact);
  free(in->variations.matrix);
  free(in);
}

static const integrator_class class = {.period = period,
                                       .dense = dense,
                                       .samples = samples,
                                       .fourier = fourier,
                                       .state = state,
                                       .tolerance = tolerance,
                                       .free = release};

hc_status integrate_new_closed(int n_states, double ignored, integrator **out)
{
  (void)ignored;
  *out = NULL;
  if (n_states < SCALED_W) return HC_BAD_INPUT;
  closed_form *in = calloc(1, sizeof *in); /* zeroed, so free works half-built */
  if (!in) return HC_NO_MEMORY;
  const size_t n = (size_t)n_states, contacts = n - SCALED_W + 1; /* one more than there are: calloc(0) may be NULL */
  in->base.does = &class;
  in->n = n_states;
  in->end = point_in(in->room[0]);
  in->scratch = point_in(in->room[1]);
  in->phase.contact = calloc(contacts, sizeof *in->phase.contact);
  in->before.contact = calloc(contacts, sizeof *in->before.contact);
  in->variations = (variations){.n = n_states, .matrix = calloc(n * n, sizeof(double))};
  if (in->phase.contact && in->before.contact && in->variations.matrix) {
    *out = &in->base;
    return HC_OK;
  }
  release(&in->base);
  return HC_NO_MEMORY;
}
