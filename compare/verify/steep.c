/* steep.c - a point held against the curve around its omega: at a turning point, where the slope is infinite, the least
 * shift of omega would leave a right point without a solution near. */
#include <math.h>

#include "compare/verify/truth_impl.h"

/* A frequency counts as right to this part of the gate, relative. */
static const double omega_part = 0.1;

/* A piece of the curve within that of a point's omega: the values on it, from its ends. */
typedef struct piece {
  double low, high;
  const hbm_curve *at; /* the solutions at one end */
  int k;               /* the number of the one whose value is nearest the point's */
  measured end;        /* of that */
} piece;

/* Is the branch walked towards higher omegas, and its upper end a turning point to the next one? */
static bool walked_upwards(const truth *t, int branch) { return (branch % 2 == 0) == (t->to > t->from); }

static int number_of_branch(const hbm_curve *at, int branch)
{
  for (int k = 0; k < at->n; ++k)
    if (at->points[k].branch == branch) return k;
  return -1;
}

/* The piece from solution a of *at to solution b of *other, if it is nearer to the row's value than *best. */
static void try_piece(truth *t, const verify_row *row, const hbm_curve *at, int a, const hbm_curve *other, int b,
                      double *least, piece *best)
{
  measured ma, mb;
  if (truth_measure(t, at->points[a].omega, at->X + (size_t)a * at->n_coef, &ma) != HC_OK) return;
  if (truth_measure(t, other->points[b].omega, other->X + (size_t)b * other->n_coef, &mb) != HC_OK) return;
  const double low = fmin(ma.value, mb.value), high = fmax(ma.value, mb.value),
               away = fmax(fmax(low - row->value, row->value - high), 0);
  if (!(away < *least)) return;
  const bool first = fabs(ma.value - row->value) <= fabs(mb.value - row->value);
  *least = away;
  *best = (piece){low, high, first ? at : other, first ? a : b, first ? ma : mb};
}

/* The nearest piece between the solutions `below` and `above` the row's omega; false: there is none. */
static bool nearest_piece(truth *t, const verify_row *row, const hbm_curve *below, const hbm_curve *above, piece *best)
{
  double least = INFINITY;
  for (int k = 0; k < below->n; ++k) {
    const int branch = below->points[k].branch, across = number_of_branch(above, branch),
              next = number_of_branch(below, branch + 1);
    if (across >= 0) try_piece(t, row, below, k, above, across, &least, best);
    else if (next >= 0 && walked_upwards(t, branch)) try_piece(t, row, below, k, below, next, &least, best);
  }
  for (int k = 0; k < above->n; ++k) {
    const int branch = above->points[k].branch, next = number_of_branch(above, branch + 1);
    if (number_of_branch(below, branch) < 0 && next >= 0 && !walked_upwards(t, branch))
      try_piece(t, row, above, k, above, next, &least, best);
  }
  return least < INFINITY;
}

hc_status truth_look_around(truth *t, verify_row *row)
{
  const double part = omega_part * t->out->gate;
  hbm_curve below = {0}, above = {0};
  piece best = {.at = &below};
  hc_status st = truth_at(t, row->omega * (1 - part), &below);
  if (st == HC_OK) st = truth_at(t, row->omega * (1 + part), &above);
  if (st == HC_OK && nearest_piece(t, row, &below, &above, &best)) {
    const double nearest = fmin(fmax(row->value, best.low), best.high),
                 error = discrepancy_relative(row->value - nearest, best.end.scale);
    if (error <= t->out->gate) {
      const hbm_point *p = &best.at->points[best.k];
      row->nearest = nearest;
      row->scale = best.end.scale;
      row->error = error;
      row->branch = p->branch;
      row->stable = truth_stable(t, p->omega, best.at->X + (size_t)best.k * best.at->n_coef, &st);
    }
  }
  hbm_curve_free(&below);
  hbm_curve_free(&above);
  return st;
}
