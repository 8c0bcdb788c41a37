/* planar_rows.c - rows of derivatives of a circle's slider where intervals begin, see planar_force_impl.h. */
#include <math.h>
#include <string.h>

#include "hbm/planar/planar_force_impl.h"
#include "numerics/series.h"

enum { N = COLLOCATION_POINTS };

void planar_row_base(int n_harm, double th, double *base, double *rate)
{
  const double c = cos(th), s = sin(th);
  double ch = 1, sh = 0;
  base[0] = 1, rate[0] = 0;
  for (int h = 1; h <= n_harm; ++h) {
    series_turn(c, s, &ch, &sh);
    base[2 * h - 1] = ch, base[2 * h] = sh;
    rate[2 * h - 1] = -h * sh, rate[2 * h] = h * ch;
  }
}

void planar_row_add(const planar_force *f, const double *base, double a, double b, double c, double *to)
{
  const int L = f->n_coef;
  for (int i = 0; i < L; ++i) to[i] += a * base[i];
  for (int i = 0; i < L; ++i) to[L + i] += b * base[i];
  for (int i = 0; i < L && f->n_dof == 3; ++i) to[2 * L + i] += c * base[i];
}

void planar_row_clear(const planar_force *f, double *row) { memset(row, 0, (size_t)f->n_col * sizeof *row); }

/* d phi = e_perp.(du - dw)/length where u - w has that length and direction. */
static void begin_slip(planar_force *f, const double *base, double phi, double length)
{
  const double a = -sin(phi) / length, b = cos(phi) / length;
  for (int i = 0; i < f->n_col; ++i) f->dphi[i] = -a * f->dw[0][i] - b * f->dw[1][i];
  planar_row_add(f, base, a, b, 0, f->dphi);
}

void planar_row_rest(planar_force *f, const double *base, double phi, double R)
{
  const double cosine = cos(phi), sine = sin(phi), per_v = f->motion.per_v;
  for (int i = 0; i < f->n_col; ++i) {
    f->dw[0][i] = R * sine * f->dphi[i];
    f->dw[1][i] = -R * cosine * f->dphi[i];
  }
  planar_row_add(f, base, 1, 0, -per_v * cosine, f->dw[0]);
  planar_row_add(f, base, 0, 1, -per_v * sine, f->dw[1]);
}

/* The angle of touch-down moves by -dR/R'. */
static void begin_contact(planar_force *f, const planar_interval *p, const planar_point *at, const double *base,
                          const double *rate)
{
  const double per_v = f->motion.per_v;
  if (p->state == CONTACT_STICK) {
    const double moved = at->dR > 0 ? -per_v / at->dR : 0;
    planar_row_clear(f, f->dw[0]);
    planar_row_clear(f, f->dw[1]);
    planar_row_add(f, base, 1, 0, moved * at->du[0], f->dw[0]);
    planar_row_add(f, base, 0, 1, moved * at->du[1], f->dw[1]);
    return;
  }
  const double phi = f->cycle.slip.panel[p->panel].phi0, speed = hypot(at->du[0], at->du[1]);
  planar_row_clear(f, f->dphi);
  planar_row_add(f, rate, -sin(phi) / speed, cos(phi) / speed, 0, f->dphi);
  planar_row_add(f, base, 0, 0, -planar_slip_slope(&f->motion, at, phi) * per_v / speed, f->dphi);
}

/* From w0 at th = 0, whose derivatives are in dw, into the circle. */
static void begin_period(planar_force *f, const planar_interval *p, const planar_point *at, const double *base)
{
  const double t1 = at->u[0] - f->cycle.start[0], t2 = at->u[1] - f->cycle.start[1], length = hypot(t1, t2),
               phi = atan2(t2, t1);
  const bool slips = p->state != CONTACT_STICK;
  if (!slips && !(length > at->R)) return;
  begin_slip(f, base, phi, length);
  if (!slips) planar_row_rest(f, base, phi, at->R);
}

void planar_row_begin(planar_force *f, int i, double *base, double *rate)
{
  const planar_cycle *c = &f->cycle;
  const planar_interval *p = &c->interval[i], *before = p - 1;
  const planar_point at = planar_motion_at(&f->motion, p->from);
  planar_row_base(f->n_harm, p->from, base, rate);
  if (p->begin == PLANAR_TOUCHES) begin_contact(f, p, &at, base, rate);
  else if (p->begin == PLANAR_STARTS) begin_period(f, p, &at, base);
  else if (p->state == before->state) return; /* stick goes on, its slider moved by rounding */
  else if (p->state == CONTACT_STICK)
    planar_row_rest(f, base, c->slip.panel[before->panel + before->n_panels - 1].phi[N - 1], at.R);
  else begin_slip(f, base, c->slip.panel[p->panel].phi0, at.R);
}
