/* acceleration.c - see acceleration.h. */
#include "compare/verify/truth/acceleration.h"

#include <math.h>
#include <string.h>

#include "base/constants.h"
#include "numerics/series.h"

enum { SAMPLES = 4096, SETTLING = 2 }; /* a period; periods before the one that counts */

/* An instant, with the sliders then. */
typedef struct instant {
  double th;
  series_jet x;
  double *w; /* [n_contacts] */
} instant;

static series_jet motion_at(const verify_motion *motion, double th)
{
  return series_at(motion->n_harm, motion->X, cos(th), sin(th));
}

/* The slider where the contact touches again between two instants: on the chord of u, where that of v + gap is 0. */
static double slider_at_touch(const model_contact *c, const instant *from, const instant *to)
{
  const double open = *c->normal * from->x.x + c->law.gap, closed = *c->normal * to->x.x + c->law.gap,
               part = open / (open - closed);
  return *c->tangent * (from->x.x + part * (to->x.x - from->x.x));
}

/* x'' at to->th, the sliders being from->w before; to->x and to->w get what they are then. */
static double follow(const model *m, const verify_motion *motion, const instant *from, instant *to)
{
  to->x = motion_at(motion, to->th);
  double force = model_force(m) * cos(to->th) - *m->damping * motion->omega * to->x.d1 - *m->stiffness * to->x.x;
  for (int j = 0; j < m->n_contacts; ++j) {
    const model_contact *c = &m->contacts[j];
    const double u = *c->tangent * to->x.x, v = *c->normal * to->x.x, v_before = *c->normal * from->x.x;
    double traction = 0, w = from->w[j];
    if (v_before + c->law.gap < 0 && v + c->law.gap > 0) w = slider_at_touch(c, from, to);
    if (contact_has_friction(&c->law)) contact_step(&c->law, u, v, &w, &traction);
    to->w[j] = w;
    force -= *c->tangent * traction + *c->normal * contact_normal_change(&c->law, v);
  }
  return force / *m->mass;
}

/* The largest sign x'' within a sample of `top`, from the instant `before` that; by golden sections, since x'' has one
 * maximum there, smooth or a kink. */
static double refine(const model *m, const verify_motion *motion, int sign, const instant *before, instant *try)
{
  const double golden = 0.6180339887498949;
  double low = before->th, high = low + 2 * TWO_PI / SAMPLES, most = -INFINITY;
  double a[2] = {high - golden * (high - low), low + golden * (high - low)}, f[2];
  for (int i = 0; i < 2; ++i) try->th = a[i], f[i] = sign * follow(m, motion, before, try);
  while (high - low > 1e-8 * TWO_PI / SAMPLES) {
    const int worse = f[0] < f[1] ? 0 : 1;
    if (worse == 0) low = a[0], a[0] = a[1], f[0] = f[1], a[1] = low + golden * (high - low);
    else high = a[1], a[1] = a[0], f[1] = f[0], a[0] = high - golden * (high - low);
    try->th = a[1 - worse];
    f[1 - worse] = sign * follow(m, motion, before, try);
    most = fmax(most, fmax(f[0], f[1]));
  }
  return most;
}

size_t acceleration_room(const model *m) { return 4 * (size_t)m->n_contacts + 1; }

double acceleration_amplitude(const model *m, const verify_motion *motion, double *room)
{
  const size_t n = (size_t)m->n_contacts, bytes = n * sizeof *room;
  instant here = {.th = 0, .x = motion_at(motion, 0), .w = room}, next = {.w = room + n};
  instant before[2] = {{.w = room + 2 * n}, {.w = room + 3 * n}}; /* the instants before the largest, the smallest */
  double most[2] = {-INFINITY, -INFINITY};                        /* of x'' and -x'' */
  for (int i = 1; i <= (SETTLING + 1) * SAMPLES; ++i) {
    next.th = TWO_PI * i / SAMPLES;
    const double a = follow(m, motion, &here, &next);
    for (int k = 0; k < 2 && i > SETTLING * SAMPLES; ++k) {
      if (!((k ? -a : a) > most[k])) continue;
      most[k] = k ? -a : a;
      before[k].th = here.th;
      before[k].x = here.x;
      memcpy(before[k].w, here.w, bytes);
    }
    double *const free_w = here.w;
    here = next;
    next.w = free_w;
  }
  for (int k = 0; k < 2; ++k) most[k] = fmax(most[k], refine(m, motion, k ? -1 : 1, &before[k], &next));
  return 0.5 * (most[0] + most[1]);
}
