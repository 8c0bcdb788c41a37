/* planar_monodromy.c - see monodromy.h and planar_flow.h: the period of a structure with circles, from th = 0. Of a
 * circle that sticks the rows of its two contacts are dheld = kt dw, of one that slips the first's is y = R d phi.
 * What they begin with, at fixed th (planar_force.h):
 *     touch-down   sticks dw = du - (dR/R') u', slips y = 0, since R = 0
 *     to slip      y = (du - dw).e_perp
 *     to rest      dw = du - dR e - y e_perp */
#include <math.h>
#include <string.h>

#include "base/constants.h"
#include "hbm/stability/monodromy_impl.h"

/* What contacts of a circle are to interval_flow.c while it sticks. */
static const contact_interval at_rest = {.from = 0, .to = TWO_PI, .state = CONTACT_STICK, .origin = -1};

static const planar_interval *planar_interval_at(const planar_cycle *c, double th)
{
  for (int i = 0; i < c->n; ++i) {
    const planar_interval *p = &c->interval[i];
    const bool covers = th >= p->from && th < p->to, covers_wrapped = th + TWO_PI >= p->from && th + TWO_PI < p->to;
    if (covers || covers_wrapped) return p;
  }
  return NULL;
}

static bool slips(const planar_interval *p) { return p && p->state != CONTACT_STICK; }
static bool sticks(const planar_interval *p) { return p && p->state == CONTACT_STICK; }

/* Stuck all period but for 1e-6 rad: monodromy.c says why. */
static bool planar_is_free(const planar_cycle *c)
{
  const double negligible_slip = 1e-6;
  double slipping = 0;
  for (int i = 0; i < c->n; ++i) slipping += slips(&c->interval[i]) ? c->interval[i].to - c->interval[i].from : 0;
  return c->always && slipping < negligible_slip;
}

static bool is_second(const monodromy *w, int j) { return j > 0 && w->track[j - 1].cycle; }

/* The intervals of all contacts on the interval from a to b. The number of circles that slip there, into
 * w->slipping. */
static int enter(monodromy *w, const model *m, const contact_forces *orbit, double a, double b)
{
  const double middle = 0.5 * (a + b);
  int n = 0;
  for (int j = 0; j < m->n_contacts; ++j) {
    planar_track *t = &w->track[j];
    if (is_second(w, j)) w->interval[j] = w->interval[j - 1];
    else if (!t->cycle) w->interval[j] = monodromy_interval_at(orbit, j, middle);
    else {
      t->before = t->interval;
      t->interval = planar_interval_at(t->cycle, middle);
      if (slips(t->interval) && planar_is_free(t->cycle)) t->interval = NULL; /* of 1e-6 rad: no time passes */
      w->interval[j] = sticks(t->interval) ? &at_rest : NULL;
      if (slips(t->interval)) w->slipping[n++] = (planar_slipping){j, t->cycle, t->interval};
    }
  }
  return n;
}

/* ---- changes of a circle ------------------------------------------------------------------------------- */

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

static void change_circles(monodromy *w, const model *m, double th)
{
  for (int j = 0; j < m->n_contacts; ++j) {
    const planar_track *t = &w->track[j];
    if (!t->cycle || !t->interval || planar_is_free(t->cycle)) continue;
    if (!t->before) {
      const planar_point at = planar_motion_at(t->cycle->m, th);
      touch_down(w, m, j, &at, sticks(t->interval));
    } else if (sticks(t->before) && slips(t->interval)) begin_slip(w, m, j, first_angle(t->cycle, t->interval));
    else if (slips(t->before) && sticks(t->interval)) come_to_rest(w, m, j, last_angle(t->cycle, t->before));
  }
}

/* ---- the period ------------------------------------------------------------------------------------------ */

static bool is_empty(const monodromy *w, int i) { return !(w->boundary[i + 1] > w->boundary[i]); }

/* The states that count at th = 0: of circles as they are on the last interval, of other contacts on the first. */
static int collect_states(monodromy *w, const model *m, const contact_forces *orbit, int n)
{
  int n_active = 0, first = 0, last = n - 2;
  while (last > 0 && is_empty(w, last)) --last;
  while (first < last && is_empty(w, first)) ++first;
  while (n_active < 2 * w->n) w->active[n_active] = n_active, ++n_active;
  enter(w, m, orbit, w->boundary[last], w->boundary[last + 1]);
  for (int j = 0; j < m->n_contacts; ++j) {
    const planar_track *t = &w->track[j];
    const double middle = 0.5 * (w->boundary[first] + w->boundary[first + 1]);
    const bool of_circle = t->cycle || is_second(w, j);
    w->interval[j] = of_circle ? NULL : monodromy_interval_at(orbit, j, middle);
    if (!t->cycle || !t->interval || planar_is_free(t->cycle)) continue;
    w->active[n_active++] = 2 * w->n + j;
    if (sticks(t->interval)) w->active[n_active++] = 2 * w->n + j + 1;
  }
  return monodromy_initial_sliders(w, m, orbit, n_active, 0);
}

/* A slider that moves by 1 is dheld = kt. */
static double size_of_state(const monodromy *w, const model *m, int state)
{
  const int j = state - 2 * w->n;
  if (j < 0 || slips(w->track[j].interval) || !(m->contacts[j].law.kt > 0)) return 1;
  return m->contacts[j].law.kt;
}

/* phi = 1, or back to it: each state in its size. */
static void begin(monodromy *w, const model *m)
{
  const size_t states = (size_t)w->n_states;
  w->columns = w->n_states;
  memset(w->phi, 0, states * states * sizeof *w->phi);
  for (size_t i = 0; i < states; ++i) w->phi[i * (states + 1)] = size_of_state(w, m, (int)i);
}

static void end(monodromy *w, const model *m)
{
  const size_t states = (size_t)w->n_states;
  for (size_t i = 0; i < states; ++i) {
    const double size = size_of_state(w, m, (int)i);
    for (size_t q = 0; q < states; ++q) w->phi[i * states + q] /= size;
  }
}

hc_status monodromy_follow_planar(monodromy *w, const model *m, const contact_forces *orbit, double omega, int n,
                                  int *n_active)
{
  hc_status st = HC_OK;
  for (int j = 0; j < m->n_contacts; ++j)
    w->track[j] = (planar_track){.cycle = is_second(w, j) ? NULL : contact_forces_planar(orbit, j)};
  *n_active = collect_states(w, m, orbit, n);
  begin(w, m);
  for (int i = 0; i + 1 < n && st == HC_OK; ++i) {
    const double from = w->boundary[i], to = w->boundary[i + 1];
    if (is_empty(w, i)) continue;
    const int slipping = enter(w, m, orbit, from, to);
    monodromy_set_sliders(w, m, orbit, from);
    change_circles(w, m, from);
    if (slipping)
      st = planar_flow_advance(w->circles, w->interval, slipping, w->slipping, from, to, omega, w->columns, w->phi);
    else st = interval_flow_advance(w->flow, w->interval, (to - from) / omega, w->columns, w->phi);
  }
  end(w, m);
  return st;
}
