/* motion_single.c - see motion_single.h. Proof: tests/timeint/test_closed.c. */
#include "timeint/closed_form/motion_single.h"

#include <float.h>

bool motion_single_fits(const modal_base *base)
{
  bool fits = base->n == 1;
  for (int l = 0; l < base->n_loads; ++l) fits = fits && base->harmonic[l] <= 1;
  return fits;
}

hc_status motion_single_make(motion_single *s, const modal_base *base, workspace *w)
{
  const size_t guards = TRACK_GUARDS * (size_t)base->n_contacts + 1;
  s->guard = workspace_array(w, guards, sizeof *s->guard);
  s->of = workspace_array(w, guards, sizeof *s->of);
  s->event = workspace_array(w, guards, sizeof *s->event);
  return w->failed ? HC_NO_MEMORY : HC_OK;
}

static int sign_of(double a) { return (a > 0) - (a < 0); }

/* Sets the mode, its load and the sign of X' in these contact states. */
static void begin(motion_single *s, const scaled_model *m, const contact_track *track, double theta, const double *y)
{
  const modal_base *b = m->base;
  double k = m->by_K * b->K[0], d = 0;
  double complex load = 0;
  for (int l = 0; l < b->n_loads; ++l) {
    if (b->harmonic[l] == 0) d += scaled_by_load(m, l) * b->cosine[l];
    else load += scaled_by_load(m, l) * (b->cosine[l] - I * b->sine[l]);
  }
  for (int j = 0; j < m->n_contacts; ++j) {
    const contact_forces_linear f = contact_track_forces(&track[j], &m->contact[j]);
    const double t = b->tangent[j], n = b->normal[j];
    k += t * (f.t_u * t + f.t_v * n) + n * f.n_v * n;
    d -= t * f.t_0 + n * f.n_0;
  }
  s->motion =
      (modal_motion){.mode = mode_make(m->by_C * b->C[0], k), .theta = theta, .q = y[0], .p = y[1], .d = d, .f = load};
  s->way = sign_of(y[1]);
  if (s->way == 0) s->way = sign_of(d + creal(load) * cos(theta) - cimag(load) * sin(theta) - k * y[0]);
}

/* True if the guard by q + constant of stick reaches 0 where N does, to rounding: where u is a multiple of v and stick
 * began with a touch, T and N vanish together, and the event is separation. */
static bool falls_with_normal_force(const track_condition *g, const scaled_contact *c, double normal, double by,
                                    double constant)
{
  if (g->event != TRACK_SLIPS_PLUS && g->event != TRACK_SLIPS_MINUS) return false;
  if (!(c->law.kn > 0) || c->law.load != 0 || !(by * normal > 0)) return false;
  const double q = -c->law.gap / normal, rounding = 8 * DBL_EPSILON * (fabs(by * q) + fabs(constant));
  return fabs(by * q + constant) <= rounding;
}

/* All guards of the contacts, and, if to_turn, that of the turn of X; returns their number. */
static int find_guards(motion_single *s, const scaled_model *m, const contact_track *track, bool to_turn)
{
  int n = 0;
  for (int j = 0; j < m->n_contacts; j += scaled_directions(m, j)) {
    track_condition conditions[TRACK_GUARDS];
    const double t = m->base->tangent[j], normal = m->base->normal[j];
    const double q = s->motion.q, p = s->motion.p;
    const contact_motion at = {{t * q}, normal * q, {t * p}, normal * p};
    const int more = contact_track_conditions(&track[j], &m->contact[j], conditions);
    for (int i = 0; i < more; ++i) {
      const track_condition *g = &conditions[i];
      const double by = g->by_u * t + g->by_v * normal;
      const double constant = g->of_rates ? 0 : g->by_v * g->gap + g->constant - g->by_u * g->from_u;
      const double noise = contact_track_noise(g, &m->contact[j], &at);
      if (falls_with_normal_force(g, &m->contact[j], normal, by, constant)) continue;
      s->guard[n] = (modal_guard){g->of_rates ? 0 : by, g->of_rates ? by : 0, constant, noise};
      s->of[n] = j;
      s->event[n++] = g->event;
    }
  }
  if (!to_turn) return n;
  s->of[n] = -1;
  s->guard[n++] = (modal_guard){.by_p = s->way > 0 ? 1 : -1, .noise = DBL_EPSILON};
  return n;
}

hc_status motion_single_go(motion_single *s, const scaled_model *m, const contact_track *track, double theta,
                           const double *y, bool to_turn, double *span, int *whose, track_event *event,
                           long *evaluations)
{
  begin(s, m, track, theta, y);
  const int n = find_guards(s, m, track, to_turn);
  const int hit = modal_first_crossing(&s->motion, *span, n, s->guard, &s->end, evaluations);
  *whose = hit < 0 ? -1 : s->of[hit];
  if (!isfinite(s->end.q + s->end.p + s->end.a)) return HC_NOT_FINITE;
  if (hit < 0) return HC_OK;
  *span = s->end.tau;
  *event = s->event[hit];
  if (s->of[hit] < 0) s->end.p = 0;
  return HC_OK;
}

void motion_single_at(const motion_single *s, double tau, int order, double out[2])
{
  const modal_point at = modal_at(&s->motion, tau);
  out[0] = order ? at.p : at.q;
  out[1] = order ? at.a : at.p;
}

bool motion_single_integrals(const scaled_model *m, const contact_track *track, double theta0, const double *y0,
                             double theta1, const double *y1, double out[3])
{
  motion_single s;
  begin(&s, m, track, theta0, y0);
  s.end = (modal_point){.tau = theta1 - theta0, .q = y1[0], .p = y1[1]};
  return motion_single_fourier(&s, out);
}

bool motion_single_fourier(const motion_single *s, double out[3])
{
  const modal_point from = {.q = s->motion.q, .p = s->motion.p};
  return modal_fourier(&s->motion, &from, &s->end, out);
}
