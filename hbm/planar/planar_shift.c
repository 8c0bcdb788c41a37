/* planar_shift.c - see planar_shift.h. */
#include "hbm/planar/planar_shift.h"

#include <math.h>

enum { N = COLLOCATION_POINTS };

/* d phi = -e_perp.dw/length, where u - w has that length and direction. */
static double turn(double phi, double length, const double dw[2])
{
  return (dw[0] * sin(phi) - dw[1] * cos(phi)) / length;
}

/* d w = -R e_perp d phi. */
static void swing(double phi, double R, double dphi, double dw[2])
{
  dw[0] = R * sin(phi) * dphi;
  dw[1] = -R * cos(phi) * dphi;
}

static double angle_before(const planar_cycle *c, const planar_interval *p)
{
  return p->n_panels > 0 ? c->slip.panel[p->panel + p->n_panels - 1].phi[N - 1] : 0;
}

/* Passes lead no two sliders apart, so that none moves by more than the start. */
static bool is_near(const planar_cycle *c, double moved)
{
  for (int i = 0; i < c->n; ++i) {
    const planar_interval *p = &c->interval[i];
    if (p->state == CONTACT_STICK) continue;
    const double R = planar_motion_at(c->m, p->from).R;
    if (!(moved <= PLANAR_SHIFT_MOST * R)) return false;
  }
  return true;
}

/* From the start, or from the interval before, into interval i. */
static void begin(const planar_cycle *c, int i, double dw[2], double *dphi)
{
  const planar_interval *p = &c->interval[i];
  const bool slips = p->state != CONTACT_STICK;
  if (p->begin == PLANAR_STARTS) {
    const planar_point *at = &c->grid[0];
    const double t1 = at->u[0] - c->start[0], t2 = at->u[1] - c->start[1], length = hypot(t1, t2), phi = atan2(t2, t1);
    if (!slips && !(length > at->R)) return;
    *dphi = turn(phi, length, dw);
    if (!slips) swing(phi, at->R, *dphi, dw);
  } else if (p->state != p[-1].state) {
    const double R = planar_motion_at(c->m, p->from).R;
    if (slips) *dphi = turn(c->slip.panel[p->panel].phi0, R, dw);
    else swing(angle_before(c, p - 1), R, *dphi, dw);
  }
}

/* phi of a panel by dphi at its beginning; what that is at its end. */
static double move_panel(const collocation *c, planar_panel *p, double dphi)
{
  const double h = p->to - p->from;
  double grown[N];
  for (int i = 0; i < N; ++i) grown[i] = 1;
  for (int j = 0; j < N; ++j)
    for (int i = 0; i < N; ++i) grown[i] += h * c->by_point[j][i] * p->slope_growth[j];
  p->phi0 += dphi;
  for (int i = 0; i < N; ++i) {
    p->phi[i] += dphi * grown[i];
    p->slope[i] += dphi * p->slope_growth[i];
  }
  return dphi * p->growth;
}

bool planar_shift(planar_cycle *c, const double dw0[2])
{
  double dw[2] = {dw0[0], dw0[1]}, dphi = 0;
  if (!is_near(c, hypot(dw[0], dw[1]))) return false;
  for (int i = 0; i < c->n; ++i) {
    planar_interval *p = &c->interval[i];
    begin(c, i, dw, &dphi);
    for (int d = 0; d < 2 && p->state == CONTACT_STICK; ++d) p->w[d] += dw[d];
    for (int k = p->panel; k < p->panel + p->n_panels; ++k) dphi = move_panel(c->slip.c, &c->slip.panel[k], dphi);
  }
  for (int d = 0; d < 2; ++d) c->start[d] += dw0[d];
  return true;
}
