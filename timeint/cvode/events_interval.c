/* events_interval.c - see events_interval.h. */
#include "timeint/cvode/events_interval.h"

#include <math.h>
#include <string.h>

#include "numerics/sundials_compat.h"

/* ---- equations -------------------------------------------------------------------------------------- */

planar_contact_motion events_planar_at(const events *in, int j, const double *y)
{
  planar_contact_motion at;
  scaled_planar_motion(in->base.m, j, y, at.u, &at.v);
  scaled_planar_motion(in->base.m, j, y + in->n, at.du, &at.dv);
  return at;
}

/* T of the circles that slip, out of the forces dy + n, and the rates of all angles. */
static void subtract_planar(const events *in, const double *y, double *dy)
{
  for (int i = 0; i < in->n_planar; ++i) {
    const planar_angle *a = &in->angle[i];
    const int j = a->contact, n = in->n;
    const scaled_contact *c = &in->base.m->contact[j];
    const double phi = y[2 * n + i], *t = in->base.m->base->tangent + (size_t)j * (size_t)n;
    const planar_contact_motion at = events_planar_at(in, j, y);
    dy[2 * n + i] = planar_angle_rate(a, &in->track[j], c, &at, phi);
    if (!planar_track_turns(&in->track[j])) continue;
    const double limit = c->law.kt * planar_track_radius(c, at.v), pull[2] = {limit * cos(phi), limit * sin(phi)};
    for (int k = 0; k < n; ++k) dy[n + k] -= pull[0] * t[k] + pull[1] * t[n + k];
  }
}

void events_rate(const events *in, double theta, const double *y, double *dy)
{
  const scaled_model *m = in->base.m;
  const int n = in->n;
  scaled_linear_force(m, theta, y, dy + n);
  for (int j = 0; j < in->n_contacts; ++j) {
    const contact_forces_linear *f = &in->law[j];
    const double *t = m->base->tangent + (size_t)j * (size_t)n, *normal = m->base->normal + (size_t)j * (size_t)n;
    double u, v;
    scaled_contact_motion(m, j, y, &u, &v);
    const double along = f->t_u * u + f->t_v * v + f->t_0, across = f->n_v * v + f->n_0;
    for (int i = 0; i < n; ++i) dy[n + i] -= along * t[i] + across * normal[i];
  }
  subtract_planar(in, y, dy);
  memcpy(dy, y + n, (size_t)n * sizeof *dy);
}

int events_rhs(sunrealtype theta, N_Vector y, N_Vector dy, void *self)
{
  events *in = self;
  double sum = 0;
  if (!integrate_cvode_goes_on(&in->base)) return -1;
  events_rate(in, theta, NV_DATA_S(y), NV_DATA_S(dy));
  for (int i = 0; i < in->n_equations; ++i) sum += NV_Ith_S(dy, i);
  if (isfinite(sum)) return 0;
  in->base.not_finite = true;
  return -1;
}

static void fill_linear(const scaled_model *m, size_t ld, double *a)
{
  const modal_base *b = m->base;
  const size_t n = (size_t)m->n;
  memset(a, 0, ld * ld * sizeof *a);
  for (size_t col = 0; col < n; ++col) {
    double *by_x = a + col * ld + n, *by_p = a + (n + col) * ld;
    by_p[col] = 1;
    if (b->diagonal_K) by_x[col] = -m->by_K * b->K[col];
    if (b->diagonal_C) by_p[n + col] = -m->by_C * b->C[col];
    for (size_t row = 0; row < n && !b->diagonal_K; ++row) by_x[row] = -m->by_K * b->K[col * n + row];
    for (size_t row = 0; row < n && !b->diagonal_C; ++row) by_p[n + row] = -m->by_C * b->C[col * n + row];
  }
}

/* What circles that slip add. */
static void fill_planar(const events *in, const double *y, size_t ld, double *a)
{
  const scaled_model *m = in->base.m;
  const size_t n = (size_t)in->n;
  for (int i = 0; i < in->n_planar; ++i) {
    const int j = in->angle[i].contact;
    const size_t phi = 2 * n + (size_t)i;
    const double *t = m->base->tangent + (size_t)j * n, *normal = m->base->normal + (size_t)j * n;
    if (!planar_track_turns(&in->track[j])) continue;
    const planar_contact_motion at = events_planar_at(in, j, y);
    const angle_slopes s = planar_angle_slopes(&in->angle[i], &in->track[j], &m->contact[j], &at, y[phi]);
    for (size_t k = 0; k < 2; ++k)
      for (size_t row = 0; row < n; ++row) {
        for (size_t col = 0; col < n; ++col) a[col * ld + n + row] -= t[k * n + row] * s.t_v[k] * normal[col];
        a[phi * ld + n + row] -= t[k * n + row] * s.t_phi[k];
      }
    for (size_t col = 0; col < n; ++col) {
      a[col * ld + phi] = s.rate_v * normal[col];
      a[(n + col) * ld + phi] = s.rate_u[0] * t[col] + s.rate_u[1] * t[n + col];
    }
    a[phi * ld + phi] = s.rate_phi;
  }
}

int events_jacobian(sunrealtype theta, N_Vector y, N_Vector dy, SUNMatrix jac, void *self, N_Vector t1, N_Vector t2,
                    N_Vector t3)
{
  (void)theta, (void)dy, (void)t1, (void)t2, (void)t3;
  const events *in = self;
  const scaled_model *m = in->base.m;
  const size_t n = (size_t)in->n, ld = (size_t)in->n_equations;
  double *a = SM_DATA_D(jac);
  fill_linear(m, ld, a);
  for (int j = 0; j < in->n_contacts; ++j) {
    const contact_forces_linear *f = &in->law[j];
    const double *t = m->base->tangent + (size_t)j * n, *normal = m->base->normal + (size_t)j * n;
    for (size_t col = 0; col < n; ++col) {
      const double along = f->t_u * t[col] + f->t_v * normal[col], across = f->n_v * normal[col];
      if (along == 0 && across == 0) continue;
      for (size_t row = 0; row < n; ++row) a[col * ld + n + row] -= t[row] * along + normal[row] * across;
    }
  }
  fill_planar(in, NV_DATA_S(y), ld, a);
  return 0;
}

/* ---- guards ------------------------------------------------------------------------------------------- */

/* The guards of contact j at a motion: the value and rate of each; how many. With u'', v'' in bend. */
static int guards_at(const events *in, int j, const contact_motion *at, const double bend[2],
                     track_guard guard[TRACK_GUARDS])
{
  const double u[TRACK_ORDER + 1] = {at->u, at->du, 0.5 * bend[0]}, v[TRACK_ORDER + 1] = {at->v, at->dv, 0.5 * bend[1]};
  return contact_track_guards(&in->track[j], &in->base.m->contact[j], u, v, guard);
}

void events_motion_at(const events *in, int j, const double *y, const double *dy, contact_motion *at, double bend[2])
{
  const scaled_model *m = in->base.m;
  scaled_contact_motion(m, j, y, &at->u, &at->v);
  scaled_contact_motion(m, j, y + in->n, &at->du, &at->dv);
  if (dy) scaled_contact_motion(m, j, dy + in->n, &bend[0], &bend[1]);
}

angle_motion events_angle_motion_at(const events *in, int j, double theta, const double *y, const double *dy)
{
  angle_motion now = {.at = events_planar_at(in, j, y), .theta = theta, .phi = y[2 * in->n + in->angle_of[j]]};
  scaled_planar_motion(in->base.m, j, dy + in->n, now.bend, &now.normal_bend);
  return now;
}

int events_guards(const events *in, int j, double theta, const double *y, const double *dy,
                  track_guard guard[TRACK_GUARDS])
{
  const scaled_contact *c = &in->base.m->contact[j];
  contact_motion at;
  double bend[2] = {0};
  if (c->second) return 0;
  if (c->circle) {
    const angle_motion now = events_angle_motion_at(in, j, theta, y, dy);
    return planar_angle_guards(&in->angle[in->angle_of[j]], &in->track[j], c, &now, guard);
  }
  events_motion_at(in, j, y, dy, &at, bend);
  return guards_at(in, j, &at, bend, guard);
}

/* CVODE multiplies values on either side of a root: this must not underflow. */
static double never_zero(double g) { return g != 0 ? g : -1e-100; }

int events_roots(sunrealtype theta, N_Vector y, sunrealtype *g, void *self)
{
  events *in = self;
  const double *z = NV_DATA_S(y);
  events_rate(in, theta, z, in->rate);
  for (int i = 0; i < EVENTS_ROOTS * in->n_contacts; ++i) g[i] = 1;
  for (int j = 0; j < in->n_contacts; ++j, g += EVENTS_ROOTS) {
    track_guard guard[TRACK_GUARDS];
    const int n = events_guards(in, j, theta, z, in->rate, guard);
    for (int i = 0; i < n; ++i) {
      g[i] = never_zero(guard[i].g[0]);
      g[TRACK_GUARDS + i] = never_zero(guard[i].g[1]);
    }
  }
  return 0;
}
