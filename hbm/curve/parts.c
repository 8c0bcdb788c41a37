/* parts.c - further parts of a response curve that have a cheap start. A curve followed from one end of the sweep
 * contains only what is connected to that end; more parts begin
 *
 *     at the other end        from the solution that Newton finds there from the linear response, which is the solution
 *                             itself where no contact changes state; where no part has come there, as hbm_trace begins
 *     where symmetry breaks   at each branch point of a symmetric part, which is passed on the symmetric branch: where
 *                             the determinant of the even harmonics' block changes its sign. The kernel of that block
 *                             is the other branch's direction there; its mirror image is not followed.
 *
 * At an end that a part has reached already Newton runs without a line search. A start on a known part is not followed;
 * a part ends where it reaches a known one. If one reaches the place at which the first part had to stop, from the
 * other side, the curve counts as whole (end = HC_OK). */
#include <string.h>

#include "hbm/curve/continuation.h"
#include "hbm/curve/path.h"
#include "hbm/curve/segment.h"
#include "hbm/solver/corrector.h"
#include "hbm/solver/linear_solution.h"
#include "numerics/base/workspace.h"

enum { MOST_PARTS = 64 };

typedef struct part_search {
  hbm_solver *s;
  hbm_curve *curve;
  double from, to; /* [rad/time] the sweep */
  const hc_monitor *monitor;
} part_search;

static bool must_end(hc_status st) { return st == HC_INTERRUPTED || st == HC_NO_MEMORY; }

/* Entries of a row of X: for the solver's harmonics, or the most that adaptive ones may reach. */
static size_t row_length(const hbm_solver *s)
{
  return (size_t)hbm_system_length(&s->sys,
                                   s->sys.n_harm > REFINE_MOST_HARMONICS ? s->sys.n_harm : REFINE_MOST_HARMONICS);
}

/* True if the first part stops early, on the given segment or one of the NEXT behind it. segment < 0: false. */
static bool leads_to_stop(const hbm_curve *c, int segment)
{
  enum { NEXT = 3 };
  const hbm_curve_part *first = c->parts;
  if (c->n_parts == 0 || first->start != HBM_PART_FROM_FIRST || first->end == HC_OK) return false;
  return segment >= 0 && segment < first->n && segment + NEXT >= first->n;
}

/* Follows a course and adds it to the curve as a part. Errors HC_INTERRUPTED and HC_NO_MEMORY only: other ends are in
 * the part's record. */
static hc_status add_part(part_search *p, const path_course *course, hbm_part_start start)
{
  hbm_curve part = {0};
  hc_status st = path_trace(p->s, course, p->monitor, &part);
  if (st == HC_OK) st = path_settle(p->s, &part, 0);
  hbm_curve *first = p->curve;
  const bool bridges = part.met && leads_to_stop(first, part.met_segment);
  if (part.n > 1 && !(st == HC_NO_MEMORY)) {
    hc_status added = hbm_curve_add_part(first, &part, start);
    if (added == HC_OK) added = hbm_curve_settle(first, first->n);
    if (added != HC_OK) st = added;
  }
  if (bridges) first->end = first->parts[0].end = HC_OK;
  hbm_curve_free(&part);
  return must_end(st) ? st : HC_OK;
}

/* *known: the solution X at omega is on the curve, or of a symmetric model its mirror image is. HC_NO_MEMORY. */
static hc_status is_known(part_search *p, double omega, const double *X, const double *dX, bool *known)
{
  hbm_curve one = {0};
  const hbm_curve *c = p->curve;
  const hbm_point point = {.omega = omega, .d_omega = 1};
  int segment = -1;
  hbm_curve_measure_by(&one, c->metric, c->omega_scale);
  hc_status st = hbm_curve_append(&one, c->n_coef, X, dX, &point);
  if (st == HC_OK) st = hbm_curve_passes(p->s, c, c->n, &one, 0, false, &segment);
  if (st == HC_OK && segment < 0 && hbm_mirror(p->s, one.X))
    st = hbm_curve_passes(p->s, c, c->n, &one, 0, false, &segment);
  *known = segment >= 0;
  hbm_curve_free(&one);
  return st;
}

/* ---- from the other end ----------------------------------------------------------------------------------- */

static bool comes_to(const hbm_curve *c, double omega)
{
  for (int i = 0; i < c->n_parts; ++i)
    if (c->parts[i].end == HC_OK && c->parts[i].ends_at == omega) return true;
  return false;
}

static hc_status start_at(part_search *p, double omega, double *X, double *dX)
{
  hbm_point point;
  const bool thorough = !comes_to(p->curve, omega);
  if (hbm_linear_point(p->s, omega, INFINITY, X, dX, &point)) return HC_OK;
  hbm_linear_response(&p->s->sys, omega, X);
  return thorough ? hbm_first_solution(p->s, omega, p->monitor, X, &point) : hbm_solve_plainly(p->s, omega, X, &point);
}

static hc_status from_the_other_end(part_search *p)
{
  workspace rows = {0};
  const size_t n = row_length(p->s);
  double *X = workspace_doubles(&rows, n), *dX = workspace_doubles(&rows, n);
  bool known = false;
  hc_status st = rows.failed ? HC_NO_MEMORY : start_at(p, p->to, X, dX);
  if (st == HC_OK) st = is_known(p, p->to, X, dX, &known);
  if (st == HC_OK && !known) {
    const path_seed seed = {.X = X};
    const path_course course = {p->to, p->from, .behind = p->to, .seed = &seed, .known = p->curve};
    st = add_part(p, &course, HBM_PART_FROM_LAST);
  }
  workspace_free(&rows);
  return must_end(st) ? st : HC_OK;
}

/* ---- where symmetry breaks --------------------------------------------------------------------------------- */

/* LOCATED: a branch point is located to this part of the segment by halving, and its kernel is off by as much.
 * FIRST_AWAY: distance along the kernel, in the metric, at which the other branch begins: more than the 1e-7 that tells
 * solutions apart; omega differs by its square. FURTHER times as far, up to MOST_AWAY, where Newton returns to the
 * symmetric branch. */
static const double LOCATED = 1e-6, FIRST_AWAY = 1e-3, MOST_AWAY = 0.1, FURTHER = 4;
enum { MOST_HALVINGS = 40 };

/* hbm_even_sign of the solution on segment k at sigma, which is left in x. 0: not found, or not symmetric. */
static int sign_at(part_search *p, int k, double sigma, hbm_candidate *x)
{
  if (hbm_segment_point(p->s, p->curve, k, sigma, x) != HC_OK || !p->s->on_symmetric) return 0;
  return hbm_even_sign(p->s, x->point.omega, x->X);
}

/* The solution in x where the sign changes on segment k; false if it was not found. */
static bool locate_branch(part_search *p, int k, hbm_candidate *x)
{
  double from = 0, to = 1;
  const int before = p->curve->points[k].even_sign;
  for (int i = 0; i < MOST_HALVINGS && to - from > LOCATED; ++i) {
    const double middle = 0.5 * (from + to);
    const int sign = sign_at(p, k, middle, x);
    if (sign == 0) return false;
    *(sign == before ? &from : &to) = middle;
  }
  return sign_at(p, k, to, x) != 0;
}

/* The other branch from the branch point in x, first a step along its kernel. */
static hc_status follow_branch(part_search *p, const hbm_candidate *x)
{
  hbm_solver *s = p->s;
  const int n = s->sys.n, first = s->sys.first;
  workspace rows = {0};
  double *phi = workspace_doubles(&rows, row_length(s)), *X = workspace_doubles(&rows, row_length(s)),
         *dX = workspace_doubles(&rows, row_length(s)), *normal = workspace_doubles(&rows, row_length(s) + 1);
  hc_status st = rows.failed ? HC_NO_MEMORY : hbm_even_kernel(s, x->point.omega, x->X, phi);
  bool away = false;
  double omega = x->point.omega, d_omega = 0;
  hbm_point point = {0};
  const metric_at at = hbm_metric_at(s, x->X);
  for (double h = FIRST_AWAY; st == HC_OK && h <= MOST_AWAY && !away; h *= FURTHER) {
    for (int i = 0; i < s->sys.n_coef; ++i) X[i] = x->X[i] + h * phi[i];
    metric_apply(&at, phi, normal);
    memmove(normal, normal + first, (size_t)n * sizeof *normal);
    normal[n] = 0;
    omega = x->point.omega;
    away = hbm_solve_plane(s, normal, p->curve->omega_scale, X, &omega, &point) == HC_OK && !s->on_symmetric &&
           hbm_tangent_plane(s, dX, &d_omega) == HC_OK;
  }
  if (away) {
    const path_seed seed = {X, dX, d_omega, newton_sign(s->plane)};
    const double low = fmin(p->from, p->to), high = fmax(p->from, p->to);
    const path_course course = {omega, d_omega > 0 ? high : low, d_omega > 0 ? low : high, .seed = &seed,
                                .known = p->curve};
    bool known;
    st = is_known(p, omega, X, dX, &known);
    if (st == HC_OK && !known) st = add_part(p, &course, HBM_PART_FROM_BRANCH);
  }
  workspace_free(&rows);
  return must_end(st) ? st : HC_OK;
}

static hc_status from_branch_points(part_search *p, int part)
{
  hbm_candidate x;
  const int first = p->curve->parts[part].first, end = first + p->curve->parts[part].n;
  hc_status st = hbm_candidate_new((int)row_length(p->s), &x);
  if (st != HC_OK) return st;
  for (int k = first; k + 1 < end && st == HC_OK && p->curve->n_parts < MOST_PARTS; ++k) {
    const int sign = p->curve->points[k].even_sign * p->curve->points[k + 1].even_sign;
    if (sign < 0 && locate_branch(p, k, &x)) st = follow_branch(p, &x);
  }
  free(x.X);
  return st;
}

/* ---- all ----------------------------------------------------------------------------------------------------- */

hc_status hbm_trace_all(hbm_solver *s, double from, double to, const hc_monitor *monitor, hbm_curve *curve)
{
  hbm_curve first = {0};
  part_search p = {s, curve, from, to, monitor};
  if (curve->n) return HC_BAD_INPUT;
  first.watch = curve->watch;
  const hc_status main = hbm_trace(s, from, to, monitor, &first);
  if (main == HC_BAD_INPUT) {
    hbm_curve_free(&first);
    return main;
  }
  hbm_curve_measure_by(curve, first.metric, first.omega_scale);
  curve->n_coef = first.n_coef;
  hc_status st = first.n > 0 ? hbm_curve_add_part(curve, &first, HBM_PART_FROM_FIRST) : HC_OK;
  curve->settled = curve->n; /* hbm_trace has reported these to the watch */
  curve->end = main, curve->ends_at = first.ends_at, curve->left_at_start = first.left_at_start;
  hbm_curve_free(&first);
  if (st == HC_OK && !must_end(main) && from != to && s->how.continuation == HBM_CONTINUATION_AUTO) {
    s->monitor = monitor; /* ticks inside long solves, too */
    s->done = -1;
    st = from_the_other_end(&p);
    for (int i = 0; i < curve->n_parts && st == HC_OK && s->symmetric; ++i) st = from_branch_points(&p, i);
    const int most = (curve->n_coef / s->sys.dim - 1) / 2;
    if (st == HC_OK && most > s->sys.n_harm) st = hbm_solver_resize(s, most, s->n_time);
    s->monitor = NULL;
    s->stopped = false;
  }
  if (must_end(st)) curve->end = st;
  return curve->end;
}
