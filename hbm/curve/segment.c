/* segment.c - see segment.h. */
#include "hbm/curve/segment.h"

#include <math.h>

#include "numerics/norm.h"
#include "numerics/roots.h"

/* Inner product in the segment's metric. */
static double inner(const hbm_segment *s, const double *aX, double a_omega, const double *bX, double b_omega)
{
  double sum = 0;
  for (int i = 0; i < s->n_coef; ++i) sum += aX[i] * bX[i];
  return sum / (s->x_scale * s->x_scale) + a_omega * b_omega / (s->omega_scale * s->omega_scale);
}

static double chord(const hbm_segment *s)
{
  double sum = 0;
  for (int i = 0; i < s->n_coef; ++i) sum += (s->X1[i] - s->X0[i]) * (s->X1[i] - s->X0[i]);
  double d = (s->omega1 - s->omega0) / s->omega_scale;
  return sqrt(sum / (s->x_scale * s->x_scale) + d * d);
}

hbm_segment hbm_segment_between(const hbm_curve *c, int k)
{
  const hbm_point *p = &c->points[k], *q = p + 1;
  hbm_segment s = {.n_coef = c->n_coef,
                   .X0 = hbm_curve_X(c, k),
                   .X1 = hbm_curve_X(c, k + 1),
                   .dX0 = hbm_curve_dX(c, k),
                   .dX1 = hbm_curve_dX(c, k + 1),
                   .omega0 = p->omega,
                   .omega1 = q->omega,
                   .omega_scale = c->omega_scale};
  s.x_scale = fmax(norm_2(c->n_coef, s.X0), norm_2(c->n_coef, s.X1));
  if (!(s.x_scale > 0)) s.x_scale = 1;
  double t0 = sqrt(inner(&s, s.dX0, p->d_omega, s.dX0, p->d_omega)),
         t1 = sqrt(inner(&s, s.dX1, q->d_omega, s.dX1, q->d_omega));
  double cosine = inner(&s, s.dX0, p->d_omega, s.dX1, q->d_omega) / (t0 * t1);
  double angle = acos(fmin(1, fmax(-1, cosine)));
  s.length = chord(&s) * (1 + angle * angle / 24); /* arc of a circle, to fourth order */
  s.scale0 = s.length / t0;
  s.scale1 = s.length / t1;
  s.d_omega0 = s.scale0 * p->d_omega;
  s.d_omega1 = s.scale1 * q->d_omega;
  return s;
}

void hbm_segment_at(const hbm_segment *s, double t, double *X, double *omega, double *dX, double *d_omega)
{
  double r = 1 - t;
  double h00 = (1 + 2 * t) * r * r, h10 = t * r * r, h01 = t * t * (3 - 2 * t), h11 = -t * t * r;
  double g00 = -6 * t * r, g10 = r * (1 - 3 * t), g11 = t * (3 * t - 2);
  for (int i = 0; i < s->n_coef; ++i)
    X[i] = h00 * s->X0[i] + h10 * s->scale0 * s->dX0[i] + h01 * s->X1[i] + h11 * s->scale1 * s->dX1[i];
  *omega = h00 * s->omega0 + h10 * s->d_omega0 + h01 * s->omega1 + h11 * s->d_omega1;
  if (dX)
    for (int i = 0; i < s->n_coef; ++i)
      dX[i] = g00 * (s->X0[i] - s->X1[i]) + g10 * s->scale0 * s->dX0[i] + g11 * s->scale1 * s->dX1[i];
  if (d_omega) *d_omega = g00 * (s->omega0 - s->omega1) + g10 * s->d_omega0 + g11 * s->d_omega1;
}

static double omega_at(const hbm_segment *s, double t)
{
  double r = 1 - t;
  return (1 + 2 * t) * r * r * s->omega0 + t * r * r * s->d_omega0 + t * t * (3 - 2 * t) * s->omega1 -
         t * t * r * s->d_omega1;
}

/* Has the interpolant passed omega at t? For root_change. */
typedef struct omega_passage {
  const hbm_segment *s;
  double omega;
  bool below; /* the side it comes from */
} omega_passage;

static hc_status has_passed(void *self, double t, bool *passed)
{
  const omega_passage *p = self;
  *passed = (omega_at(p->s, t) - p->omega < 0) != p->below;
  return HC_OK;
}

/* Interior extrema of omega(sigma), ascending: roots of A t^2 + B t + C. */
static int omega_extrema(const hbm_segment *s, double t[2])
{
  double jump = s->omega0 - s->omega1;
  double a = 6 * jump + 3 * (s->d_omega0 + s->d_omega1), b = -6 * jump - 4 * s->d_omega0 - 2 * s->d_omega1,
         c = s->d_omega0;
  double disc = b * b - 4 * a * c;
  if (!(disc > 0)) return 0;
  double q = -0.5 * (b + copysign(sqrt(disc), b)), r[2] = {a != 0 ? q / a : -1, q != 0 ? c / q : -1};
  if (r[0] > r[1]) {
    double swap = r[0];
    r[0] = r[1];
    r[1] = swap;
  }
  int n = 0;
  for (int i = 0; i < 2; ++i)
    if (r[i] > 0 && r[i] < 1) t[n++] = r[i];
  return n;
}

/* Between neighbouring knots, which are the ends and the extrema, omega(sigma) is monotone. */
int hbm_segment_find(const hbm_segment *s, double omega, bool include_end, double sigma[3])
{
  double knot[4] = {0}, extrema[2];
  int n_knots = 1, n = 0, n_extrema = omega_extrema(s, extrema);
  for (int i = 0; i < n_extrema; ++i) knot[n_knots++] = extrema[i];
  knot[n_knots++] = 1;
  for (int i = 0; i + 1 < n_knots; ++i) {
    double a = knot[i], b = knot[i + 1];
    /* at the ends omega is that of the points; the interpolant's may differ from it by rounding */
    double fa = (i == 0 ? s->omega0 : omega_at(s, a)) - omega,
           fb = (i + 2 == n_knots ? s->omega1 : omega_at(s, b)) - omega;
    if (fa == 0) {
      sigma[n++] = a;
      continue;
    }
    if (fb == 0) {
      if (include_end && i + 2 == n_knots) sigma[n++] = b;
      continue;
    }
    if ((fa < 0) == (fb < 0)) continue;
    omega_passage p = {s, omega, fa < 0};
    root_point change;
    root_change(has_passed, &p, a, b, 1e-15, &change); /* some fifty times a cubic: little beside the solve to come */
    sigma[n++] = 0.5 * (change.before + change.x);
  }
  return n;
}
