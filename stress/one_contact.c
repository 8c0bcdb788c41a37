/* one_contact.c - see one_contact.h. */
#include "stress/one_contact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "hbm/circle_force.h"
#include "hbm/circle_slider.h"
#include "hbm/exact_force.h"
#include "numerics/series.h"

void one_contact_clear(one_contact *c)
{
  free(c->motion);
  free(c->force);
}

size_t one_contact_length(const solved_structure *s, const one_contact *c)
{
  return (size_t)c->n_dof * (size_t)s->n_coef;
}

/* ---- located ------------------------------------------------------------------------------------------- */

/* What contact j is: without friction a circle's halves are two springs. */
static one_contact contact_of(const model *m, int j)
{
  const model_contact *mc = &m->contacts[j];
  const contact *law = &mc->law;
  if (!mc->circle || !contact_has_friction(law))
    return (one_contact){
        .law = law, .n_dof = 2, .direction = {mc->tangent, mc->normal}, .stiffness = {law->kt, law->kn}};
  if (mc->pair == CONTACT_SECOND) return (one_contact){.law = law, .circle = true};
  return (one_contact){.law = law,
                       .circle = true,
                       .n_dof = law->kn > 0 ? 3 : 2,
                       .direction = {mc->tangent, mc[1].tangent, mc->normal},
                       .stiffness = {law->kt, law->kt, 2 * law->kn}};
}

static hc_status locate_line(int n_harm, one_contact *c)
{
  const moving_contact alone = {.law = *c->law, .cu = {1, 0}, .cv = {0, 1}};
  exact_force *e;
  hc_status st = exact_force_new(n_harm, 2, 1, &alone, &e);
  if (st == HC_OK) st = exact_force_eval(e, c->motion, c->force, NULL, &c->report);
  exact_force_free(e);
  return st;
}

static hc_status locate_circle(int n_harm, one_contact *c)
{
  circle_force *f;
  hc_status st = circle_force_new(n_harm, c->n_dof, c->law, &f);
  if (st == HC_OK) st = circle_force_eval(f, c->motion, c->force, NULL, &c->report);
  circle_force_free(f);
  return st;
}

hc_status one_contact_locate(const solved_structure *s, int j, const double *x, one_contact *c)
{
  *c = contact_of(s->model, j);
  if (c->n_dof == 0) return HC_OK;
  c->motion = calloc(one_contact_length(s, c), sizeof(double));
  c->force = calloc(one_contact_length(s, c), sizeof(double));
  if (!c->motion || !c->force) return HC_NO_MEMORY;
  for (int d = 0; d < c->n_dof; ++d)
    for (int k = 0; k < s->n_coef; ++k)
      for (int i = 0; i < s->n; ++i) c->motion[d * s->n_coef + k] += c->direction[d][i] * x[k * s->n + i];
  return c->circle ? locate_circle(s->how.harmonics, c) : locate_line(s->how.harmonics, c);
}

/* ---- stepped through ----------------------------------------------------------------------------------- */

/* Angles are the h-fold ones of each other. */
void one_contact_turn(int N, double *turn)
{
  for (int i = 0; i < N; ++i) {
    turn[2 * i] = cos(TWO_PI * i / N);
    turn[2 * i + 1] = sin(TWO_PI * i / N);
  }
}

/* x at instant i of N. */
static double at_step(int n_harm, const double *x, int N, const double *turn, int i)
{
  double sum = x[0];
  for (int h = 1; h <= n_harm; ++h) {
    const double *cs = turn + 2 * (int)((long)h * i % N);
    sum += x[2 * h - 1] * cs[0] + x[2 * h] * cs[1];
  }
  return sum;
}

/* One instant's part of the harmonics F[2H+1] of f. */
static void add_instant(int n_harm, double f, int N, const double *turn, int i, double *F)
{
  F[0] += f / N;
  for (int h = 1; h <= n_harm; ++h) {
    const double *cs = turn + 2 * (int)((long)h * i % N);
    F[2 * h - 1] += 2 * f * cs[0] / N;
    F[2 * h] += 2 * f * cs[1] / N;
  }
}

/* The slider on its way: w, and of a circle the sample before. */
typedef struct stepper {
  double w[2];
  circle_sample before;
  bool begun;
} stepper;

/* f = T_1, T_2, N - N0 at the sample that is reached by motion = u_1, u_2, v. */
static void step_circle(const contact *law, const double *motion, stepper *s, double *f)
{
  const double v = motion[2], limit = law->mu * (law->kn * (v + law->gap) + law->load);
  const circle_sample to = {.u = {motion[0], motion[1]}, .r = limit / law->kt};
  circle_move move = CIRCLE_SLIPPED;
  if (s->begun) move = circle_slider_step(HBM_RESTART_INTERPOLATED, &s->before, &to, s->w, NULL);
  else move = circle_slider_enter(&to, s->w, NULL);
  for (int d = 0; d < 2; ++d) f[d] = move == CIRCLE_APART ? 0 : law->kt * (to.u[d] - s->w[d]);
  f[2] = 2 * contact_normal_change(law, v);
  s->before = to;
  s->begun = true;
}

static void step_line(const contact *law, const double *motion, stepper *s, double *f)
{
  contact_step(law, motion[0], motion[1], s->w, &f[0]);
  f[1] = contact_normal_change(law, motion[1]);
}

/* One period; its harmonics are added to force unless that is NULL. */
static void step_period(const one_contact *c, int n_harm, int N, const double *turn, stepper *s, double *force)
{
  const int n_coef = series_length(n_harm);
  for (int i = 0; i < N; ++i) {
    double motion[ONE_CONTACT_MOST] = {0}, f[ONE_CONTACT_MOST];
    for (int d = 0; d < c->n_dof; ++d) motion[d] = at_step(n_harm, c->motion + d * n_coef, N, turn, i);
    if (c->circle) step_circle(c->law, motion, s, f);
    else step_line(c->law, motion, s, f);
    for (int d = 0; d < c->n_dof && force; ++d) add_instant(n_harm, f[d], N, turn, i, force + d * n_coef);
  }
}

/* A slider on a line has settled after one period; one in the plane settles by a factor each, or creeps into a corner
 * between two circles, the slower the nearer. */
bool one_contact_step(const one_contact *c, int n_harm, int N, const double *turn, double *force)
{
  const int most = c->circle ? 1 << 23 : N; /* instants in all */
  const double settled = 1e-9;
  stepper s = {0};
  bool rests = !c->circle;
  for (int done = 0; done < most && (done == 0 || !rests); done += N) {
    const double before[2] = {s.w[0], s.w[1]};
    step_period(c, n_harm, N, turn, &s, NULL);
    rests = rests || hypot(s.w[0] - before[0], s.w[1] - before[1]) <= settled * hypot(s.w[0], s.w[1]);
  }
  memset(force, 0, (size_t)c->n_dof * (size_t)series_length(n_harm) * sizeof *force);
  step_period(c, n_harm, N, turn, &s, force);
  return rests;
}
