/* phase.c - see phase.h. Proof: tests/timeint/test_phase.c. */
#include "timeint/phase.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double rounding = 16 * DBL_EPSILON; /* of sums of a few terms, relative to their sizes */

static contact law_of(const scaled_contact *mc)
{
  return (contact){.kt = mc->law.kt, .kn = mc->law.kn, .mu = mc->law.mu, .gap = mc->law.gap};
}

static contact_state slip(int sign) { return sign > 0 ? CONTACT_SLIP_PLUS : CONTACT_SLIP_MINUS; }
static double blur(double x) { return rounding * fmax(1, fabs(x)); } /* X is of the order of 1 */

/* Rounding of contact_guard_stick: states are of the order of 1, and so is what w was computed from. */
static double guard_noise(const contact *c, double u, double v, double w)
{
  return rounding * (c->kt * (1 + fabs(u) + fabs(w)) + c->mu * c->kn * (1 + fabs(v) + fabs(c->gap)));
}

static int sign_of(double a) { return (a > 0) - (a < 0); }

/* The slider in slip(sign): w = u - sign mu N/kt, N unclipped. */
static void slipping_slider(const scaled_contact *mc, int sign, double *rest, double *by_x)
{
  const double share = sign * mc->law.mu * mc->law.kn / mc->law.kt;
  *rest = -share * mc->law.gap;
  *by_x = mc->cosine - share * mc->sine;
}

void phase_slider(const phase *ph, int j, double *rest, double *by_x)
{
  const scaled_contact *mc = &ph->m->contact[j];
  const phase_contact *pc = &ph->contact[j];
  *rest = 0;
  *by_x = mc->cosine;
  if (!mc->law.has_friction || pc->state == CONTACT_SEPARATED) return;
  if (pc->state != CONTACT_STICK) {
    slipping_slider(mc, contact_slip_sign(pc->state), rest, by_x);
    return;
  }
  *rest = pc->rest;
  *by_x = 0;
}

void phase_set_sliders(const phase *ph, int order, double *y)
{
  for (int j = 0; j < ph->m->n_contacts; ++j) {
    double rest, by_x;
    phase_slider(ph, j, &rest, &by_x);
    y[SCALED_W + j] = (order == 0 ? rest : 0) + by_x * y[SCALED_X];
  }
}

double phase_slider_stiffness(const phase *ph, int j)
{
  const scaled_contact *mc = &ph->m->contact[j];
  return mc->law.has_friction && ph->contact[j].state == CONTACT_STICK ? mc->law.kt * mc->cosine : 0.0;
}

static void stick(phase_contact *pc, double rest, double rest_by_x)
{
  pc->state = CONTACT_STICK;
  pc->since_start = false;
  pc->rest = rest;
  pc->rest_by_x = rest_by_x;
}

/* From slip(sign) at x. The guard s kt u' - mu kn v' vanishes there, and it is kt times the rate of u - s mu N/kt, so a
 * change of the instant has no effect on w to first order: dw = du - s mu dN/kt. */
static void stick_from_slip(phase_contact *pc, const scaled_contact *mc, int sign, double x)
{
  double rest, by_x;
  slipping_slider(mc, sign, &rest, &by_x);
  stick(pc, rest + by_x * x, by_x);
}

/* v + gap rises through 0 at the instant t*: w = u(t*), so dw = du + u' dt* with dt* = -dv/v'. u and v are proportional
 * to X, so that is cos dX - cos P (sin dX)/(sin P) = 0: the slider comes to rest at the same place whatever the motion.
 * Only the ratio of the velocities enters contact_on_touch. */
static void touch(phase_contact *pc, const scaled_contact *mc)
{
  const contact law = law_of(mc);
  stick(pc, mc->cosine * pc->up, 0);
  if (mc->law.has_friction) pc->state = contact_on_touch(&law, mc->cosine, mc->sine);
}

/* Where the guard of stick against slip(sign) vanishes; it is linear in X. */
static void bound_by_slip(phase_contact *pc, const scaled_contact *mc, int sign, double x, double edge)
{
  const contact law = law_of(mc);
  const double u = mc->cosine * x, v = mc->sine * x;
  const double falls = contact_guard_slip(&law, sign, mc->cosine, mc->sine); /* minus the guard's derivative to X */
  if (!(fabs(falls) > rounding * (law.kt * mc->cosine + law.mu * law.kn * mc->sine))) return; /* constant */
  const double at = x + contact_guard_stick(&law, sign, u, v, pc->rest) / falls;
  const bool with_separation = fabs(at - edge) <= guard_noise(&law, u, v, pc->rest) / fabs(falls);
  if (falls > 0 && at < pc->up) {
    pc->up = at;
    pc->after_up = slip(sign);
  } else if (falls < 0 && at > pc->down && !with_separation) {
    pc->down = at;
    pc->after_down = slip(sign);
  }
}

static void bound(phase_contact *pc, const scaled_contact *mc, double x)
{
  const double edge = mc->law.kn > 0 && mc->sine > 0 ? -mc->law.gap / mc->sine : -INFINITY; /* v + gap = 0 */
  pc->up = INFINITY;
  pc->down = -INFINITY;
  if (pc->state == CONTACT_SEPARATED) {
    if (edge > -INFINITY) pc->up = edge;
    return;
  }
  pc->down = edge;
  pc->after_down = CONTACT_SEPARATED;
  if (pc->state != CONTACT_STICK || !mc->law.has_friction) return;
  bound_by_slip(pc, mc, 1, x, edge);
  bound_by_slip(pc, mc, -1, x, edge);
}

/* Does the state of contact j end at x, P having the sign ph->way? If so the contact is in its next state. */
static bool cross(phase *ph, int j, double x)
{
  phase_contact *pc = &ph->contact[j];
  const double close = blur(x);
  if (ph->way > 0 && x >= pc->up - close) {
    if (pc->state == CONTACT_SEPARATED) touch(pc, &ph->m->contact[j]);
    else pc->state = pc->after_up;
    return true;
  }
  if (ph->way < 0 && x <= pc->down + close) {
    pc->state = pc->after_down;
    return true;
  }
  return false;
}

/* Every contact in the state it has just after x. The ends are those found when the state began: found again at x, an
 * end would differ by the guard's rounding over its slope, and where kt cos is next to mu kn sin the end that X has
 * reached would not be seen. The inner loop ends: while X moves one way, a contact passes at most through stick, slip,
 * separated in this order, or separated, stick, slip. */
static int cross_all(phase *ph, double x)
{
  int n = 0;
  for (int j = 0; j < ph->m->n_contacts; ++j)
    for (; cross(ph, j, x); ++n) bound(&ph->contact[j], &ph->m->contact[j], x);
  return n;
}

static void add_contact(phase *ph, int j)
{
  const scaled_contact *mc = &ph->m->contact[j];
  const law_regularised *law = &mc->law;
  const phase_contact *pc = &ph->contact[j];
  if (pc->state == CONTACT_SEPARATED) {
    ph->d -= mc->preload * mc->sine;
    return;
  }
  const double friction = contact_slip_sign(pc->state) * law->mu * mc->cosine, n0 = law->kn * law->gap;
  ph->k += (mc->sine + friction) * law->kn * mc->sine;
  ph->d += friction * n0 + (law->gap > 0 ? 0 : mc->sine * n0); /* N - N0: N0 is left out, not added and
                                                                  subtracted */
  const double kt = phase_slider_stiffness(ph, j);
  ph->k += kt * mc->cosine;
  ph->d -= kt * pc->rest;
}

/* Coefficients and ends from the contacts' states. */
static void gather(phase *ph, double x)
{
  ph->k = ph->m->k;
  ph->d = 0;
  ph->up = INFINITY;
  ph->down = -INFINITY;
  ph->slips = false;
  for (int j = 0; j < ph->m->n_contacts; ++j) {
    add_contact(ph, j);
    ph->up = fmin(ph->up, ph->contact[j].up);
    ph->down = fmax(ph->down, ph->contact[j].down);
    ph->slips = ph->slips || contact_slip_sign(ph->contact[j].state);
  }
  ph->up = fmax(ph->up, x + blur(x)); /* x on a guard, moving away from it */
  ph->down = fmin(ph->down, x - blur(x));
}

int phase_next(phase *ph, double x, int way, bool turned)
{
  int n = 0;
  for (int j = 0; turned && way != ph->way && j < ph->m->n_contacts; ++j) {
    phase_contact *pc = &ph->contact[j];
    if (!contact_slip_sign(pc->state)) continue;
    stick_from_slip(pc, &ph->m->contact[j], contact_slip_sign(pc->state), x);
    bound(pc, &ph->m->contact[j], x);
    ++n;
  }
  ph->way = way;
  n += cross_all(ph, x);
  if (n) gather(ph, x);
  return n;
}

void phase_copy(phase *to, const phase *from)
{
  phase_contact *own = to->contact;
  memcpy(own, from->contact, sizeof *own * (size_t)from->m->n_contacts);
  *to = *from;
  to->contact = own;
}

/* P' at theta = 0 by the law itself. */
static double force_at_start(const scaled_model *m, const double *y)
{
  double force = m->f - m->c * y[SCALED_P] - m->k * y[SCALED_X];
  for (int j = 0; j < m->n_contacts; ++j) {
    const scaled_contact *mc = &m->contact[j];
    const contact law = law_of(mc);
    double w = y[SCALED_W + j], t = 0, v = mc->sine * y[SCALED_X];
    if (mc->law.has_friction) contact_step(&law, mc->cosine * y[SCALED_X], v, &w, &t);
    force -= t * mc->cosine + contact_normal_change(&law, v) * mc->sine;
  }
  return force;
}

static void classify(phase_contact *pc, const scaled_contact *mc, double x, double w, int way)
{
  const contact law = law_of(mc);
  const double u = mc->cosine * x, v = mc->sine * x;
  *pc = (phase_contact){.state = CONTACT_SEPARATED};
  if (!(contact_normal(&law, v) > 0)) return;
  stick(pc, w, 0);
  if (!mc->law.has_friction) return;
  const int sign = u > w ? 1 : -1;
  pc->since_start = contact_guard_stick(&law, sign, u, v, w) > guard_noise(&law, u, v, w);
  if (pc->since_start) return;
  stick_from_slip(pc, mc, sign, x);
  if (contact_guard_slip(&law, sign, way * mc->cosine, way * mc->sine) > 0) pc->state = slip(sign);
}

int phase_begin(phase *ph, const scaled_model *m, const double *y)
{
  const double force = force_at_start(m, y), x = y[SCALED_X];
  double sliders = 0;
  for (int j = 0; j < m->n_contacts; ++j) sliders += y[SCALED_W + j];
  if (!isfinite(force + x + y[SCALED_P] + sliders)) return -1;
  ph->m = m;
  ph->way = y[SCALED_P] != 0 ? sign_of(y[SCALED_P]) : sign_of(force);
  for (int j = 0; j < m->n_contacts; ++j) {
    classify(&ph->contact[j], &m->contact[j], x, y[SCALED_W + j], ph->way);
    bound(&ph->contact[j], &m->contact[j], x);
  }
  const int n = cross_all(ph, x);
  gather(ph, x);
  return n;
}
