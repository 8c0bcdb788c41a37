/* lab_curve.c - see lab.h: the curve, its solutions at an omega, sampled ones beside, special points. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare/response.h"
#include "interfaces/lab/lab_inside.h"
#include "numerics/norm.h"

/* Solution k of *c as a row. */
static hc_status add_solution(lab *l, hbm_solver *s, const hbm_curve *c, int k)
{
  response_row r;
  hc_status st = response_row_of(s, c, k, &r);
  if (st != HC_OK) return st;
  r.series = hbm_curve_X(c, k);
  return lab_add_result(l, ROWS_FRF, &r);
}

/* All of them: how the search ended, unless a row fails. */
static hc_status add_solutions(lab *l, hbm_solver *s, const hbm_curve *c, hc_status searched)
{
  hc_status st = HC_OK;
  lab_begin_results(l, ROWS_FRF, c->n_coef);
  for (int k = 0; k < c->n && st == HC_OK; ++k) st = add_solution(l, s, c, k);
  return st == HC_OK ? searched : st;
}

int lab_curve(lab *l, int force)
{
  scene sc;
  lab_begin(l, 0);
  hc_status st = lab_scene(l, force, &sc);
  if (st != HC_OK) return lab_answer(l, st);
  lab_kept *kept = &l->kept[force];
  hbm_solver_free(kept->solver);
  hbm_curve_free(&kept->curve);
  *kept = (lab_kept){0};
  st = lab_solver(&sc, &kept->solver);
  if (st == HC_OK) st = hbm_trace(kept->solver, sc.omega_from, sc.omega_to, NULL, &kept->curve);
  if (kept->solver) st = add_solutions(l, kept->solver, &kept->curve, st);
  return lab_answer(l, st);
}

static lab_kept *kept_curve(lab *l, int force)
{
  return force >= 0 && force < LAB_FORCES && l->kept[force].solver ? &l->kept[force] : NULL;
}

int lab_curve_at(lab *l, int force, double omega)
{
  lab_kept *kept = kept_curve(l, force);
  lab_begin(l, 0);
  if (!kept || !(isfinite(omega) && omega > 0)) return lab_answer(l, HC_BAD_INPUT);
  hbm_curve at = {0};
  hc_status st = hbm_curve_at(kept->solver, &kept->curve, omega, &at);
  st = add_solutions(l, kept->solver, &at, st);
  hbm_curve_free(&at);
  return lab_answer(l, st);
}

/* ---- samples next to exact forces ---- */

/* Is it the same motion, moved by sampling? Two solutions at one omega differ by their own size; NaN is not near. */
static bool is_near(int n, const double *X, const double *exact)
{
  double off[LAB_MOST_COEF];
  for (int i = 0; i < n; ++i) off[i] = X[i] - exact[i];
  return norm_2(n, off) <= 0.5 * norm_2(n, exact);
}

/* Newton from the exact solution at point->omega; where jumps lead it in circles, from sampled solutions next to it. */
static hc_status solve_next_to(hbm_solver *s, int n, const double *exact, double *X, hbm_point *point)
{
  static const double detours[] = {0, 5e-3, -5e-3, 2e-2, -2e-2, 4e-2, -4e-2}; /* [1] of omega */
  const double omega = point->omega;
  hc_status st = HC_NOT_CONVERGED;
  for (size_t i = 0; i < sizeof detours / sizeof *detours; ++i) {
    memcpy(X, exact, (size_t)n * sizeof *X);
    st = detours[i] == 0 ? HC_OK : hbm_solve(s, omega * (1 + detours[i]), X, point);
    if (st == HC_OK) st = hbm_solve(s, omega, X, point);
    if (st == HC_NO_MEMORY || (st == HC_OK && is_near(n, X, exact))) return st;
  }
  return st == HC_OK ? HC_NOT_CONVERGED : st;
}

/* The neighbour of point k of the exact curve *c; s has samples. */
static hc_status add_neighbour(lab *l, hbm_solver *s, const hbm_curve *c, int k)
{
  double X[LAB_MOST_COEF];
  hbm_point point = c->points[k];
  const hc_status st = solve_next_to(s, c->n_coef, hbm_curve_X(c, k), X, &point);
  if (st == HC_NO_MEMORY) return st;
  point.branch = c->points[k].branch;
  const hbm_curve one = {.n = 1, .n_coef = c->n_coef, .points = &point, .X = X};
  if (st == HC_OK) return add_solution(l, s, &one, 0);
  double *row = lab_row(l);
  if (!row) return HC_NO_MEMORY;
  row[lab_column(l, "omega")] = c->points[k].omega;
  row[lab_column(l, "branch")] = point.branch;
  return HC_OK;
}

/* The neighbours of all points of *c. */
static hc_status add_neighbours(lab *l, const hbm_curve *c)
{
  scene sc;
  hbm_solver *s = NULL;
  lab_begin_results(l, ROWS_FRF, c->n_coef);
  hc_status st = c->n ? lab_scene(l, LAB_SAMPLED, &sc) : HC_OK;
  if (c->n) sc.hbm.harmonics = (c->n_coef - 1) / 2; /* those that `auto` has found */
  if (c->n && st == HC_OK) st = lab_solver(&sc, &s);
  for (int k = 0; k < c->n && st == HC_OK; ++k) st = add_neighbour(l, s, c, k);
  hbm_solver_free(s);
  return st;
}

int lab_neighbours(lab *l)
{
  const lab_kept *kept = kept_curve(l, LAB_EXACT);
  lab_begin(l, 0);
  return lab_answer(l, kept ? add_neighbours(l, &kept->curve) : HC_BAD_INPUT);
}

int lab_neighbours_at(lab *l, double omega)
{
  lab_kept *kept = kept_curve(l, LAB_EXACT);
  lab_begin(l, 0);
  if (!kept || !(isfinite(omega) && omega > 0)) return lab_answer(l, HC_BAD_INPUT);
  hbm_curve at = {0};
  hc_status found = hbm_curve_at(kept->solver, &kept->curve, omega, &at);
  hc_status st = add_neighbours(l, &at);
  hbm_curve_free(&at);
  return lab_answer(l, st == HC_OK ? found : st);
}

/* ---- special points ---- */

int lab_specials(lab *l, int force)
{
  lab_kept *kept = kept_curve(l, force);
  lab_begin_results(l, ROWS_SPECIALS, 0);
  if (!kept) return lab_answer(l, HC_BAD_INPUT);
  int found = 0;
  hbm_special *list;
  hc_status st = hbm_specials(kept->solver, &kept->curve, &list, &found);
  for (int i = 0; i < found && st != HC_NO_MEMORY; ++i)
    if (lab_add_result(l, ROWS_SPECIALS, &list[i]) != HC_OK) st = HC_NO_MEMORY;
  free(list);
  return lab_answer(l, st);
}
