/* segment.c - see segment.h. Newton at a fixed omega may converge to a solution other than the one meant, since others
 * are close near turning points. Its answer counts only if it is next to the interpolant, measured by the segment's
 * length, and if it was not found already from another sigma. */
#include "hbm/curve/segment.h"

#include <stdlib.h>
#include <string.h>

#include "hbm/solver/corrector.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "hbm/solver/linear_solution.h"
#include "model/periodic_motion.h"
#include "numerics/norm.h"
#include "numerics/roots.h"
#include "numerics/series.h"

/* ---- the interpolant ------------------------------------------------------------------------------- */

/* Length and inner product in the segment's metric. */
static double length_of(const hbm_segment *s, const double *aX, double a_omega)
{
  return hypot(metric_length(&s->at, aX), a_omega / s->omega_scale);
}

static double inner(const hbm_segment *s, const double *aX, double a_omega, const double *bX, double b_omega)
{
  return metric_inner(&s->at, aX, bX) + a_omega * b_omega / (s->omega_scale * s->omega_scale);
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
  s.at = (metric_at){c->metric, c->n_coef, s.X0, s.X1};
  const double t0 = length_of(&s, s.dX0, p->d_omega), t1 = length_of(&s, s.dX1, q->d_omega),
               across = inner(&s, s.dX0, p->d_omega, s.dX1, q->d_omega),
               turned = across / sqrt(inner(&s, s.dX0, p->d_omega, s.dX0, p->d_omega) *
                                      inner(&s, s.dX1, q->d_omega, s.dX1, q->d_omega)),
               angle = acos(fmin(1, fmax(-1, turned))),
               chord = hypot(metric_distance(&s.at, s.X1, s.X0), (s.omega1 - s.omega0) / s.omega_scale);
  s.length = chord * (1 + angle * angle / 24); /* arc of a circle, to fourth order */
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

/* For root_change: true if the interpolant has passed omega at t. */
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

double hbm_segment_farthest(const hbm_segment *s, double direction)
{
  double t[2], most = fmax(direction * s->omega0, direction * s->omega1);
  const int n = omega_extrema(s, t);
  for (int i = 0; i < n; ++i) most = fmax(most, direction * omega_at(s, t[i]));
  return direction * most;
}

/* The sigma in [0, 1) where the interpolant passes omega, ascending; at most 3. include_end: sigma = 1 counts too.
 * Between neighbouring knots, which are the ends and the extrema, omega(sigma) is monotone. */
static int find_omega(const hbm_segment *s, double omega, bool include_end, double sigma[3])
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

/* ---- solutions -------------------------------------------------------------------------------------- */

enum { MAX_HALVINGS = 40 };

/* SAME: solutions nearer than this in the metric are one; Newton's usual tolerance is 1e-10 of the forces. NEAR: a
 * solution belongs to the segment if it is off the interpolant by no more than this part of its length (plus ROUNDING);
 * the step's controller allows 1e-4. */
static const double SAME = 1e-9, NEAR = 0.1, ROUNDING = 1e-8;

hc_status hbm_candidate_new(int n_coef, hbm_candidate *out)
{
  size_t n = (size_t)n_coef + 1;
  double *block = calloc(3 * n, sizeof *block);
  if (!block) return HC_NO_MEMORY;
  *out = (hbm_candidate){.X = block, .dX = block + n, .guess = block + 2 * n};
  return HC_OK;
}

/* The branch of a solution next to segment k that moves in the direction d_omega. */
static int branch_on_segment(const hbm_curve *c, int k, double d_omega)
{
  const hbm_point *a = &c->points[k];
  return (d_omega > 0) == (a->d_omega > 0) ? a->branch : a[1].branch;
}

/* Newton at omega from the interpolant at sigma. HC_NOT_CONVERGED: no solution next to it. */
static hc_status solve_at(hbm_solver *s, const hbm_curve *c, int k, const hbm_segment *seg, double sigma, double omega,
                          hbm_candidate *x)
{
  double at, d_omega;
  size_t bytes = (size_t)c->n_coef * sizeof(double);
  x->point = (hbm_point){.omega = omega};
  hbm_segment_at(seg, sigma, x->X, &at, x->dX, &d_omega);
  hbm_truncate(s, c->n_coef, x->X);
  hbm_truncate(s, c->n_coef, x->dX);
  memcpy(x->guess, x->X, bytes);
  hc_status st = hbm_solve_fixed(s, omega, x->X, &x->point);
  if (st == HC_OK && !(metric_distance(&seg->at, x->X, x->guess) <= NEAR * seg->length + ROUNDING))
    st = HC_NOT_CONVERGED;
  if (st == HC_OK) st = hbm_tangent_fixed(s, x->X, x->dX);
  if (st != HC_OK) return st;
  double sign = d_omega < 0 ? -1 : 1;
  for (int i = 0; i < c->n_coef; ++i) x->dX[i] *= sign;
  x->point.d_omega = sign;
  x->point.branch = branch_on_segment(c, k, d_omega);
  x->point.part = c->points[k].part;
  return HC_OK;
}

hc_status hbm_segment_point(hbm_solver *s, const hbm_curve *c, int k, double sigma, hbm_candidate *x)
{
  hbm_segment between = hbm_segment_between(c, k), *seg = &between;
  double d_omega, *normal = x->guess;
  int n = s->sys.n, first = s->sys.first;
  hbm_segment_at(seg, sigma, x->X, &x->point.omega, x->dX, &d_omega);
  hbm_truncate(s, c->n_coef, x->X);
  hbm_truncate(s, c->n_coef, x->dX);
  metric_apply(&seg->at, x->dX, normal);
  memmove(normal, normal + first, (size_t)n * sizeof *normal);
  normal[n] = d_omega / (seg->omega_scale * seg->omega_scale);
  double omega = x->point.omega;
  hc_status st = hbm_solve_plane(s, normal, seg->omega_scale, x->X, &omega, &x->point);
  if (st == HC_OK) st = hbm_tangent_plane(s, x->dX, &x->point.d_omega);
  x->point.branch = branch_on_segment(c, k, x->point.d_omega);
  x->point.part = c->points[k].part;
  return st;
}

/* A curve of three points: the ends of segment k and one between them. */
static hc_status halve(hbm_solver *s, const hbm_curve *c, int k, const hbm_segment *seg, hbm_candidate *x,
                       hbm_curve *halves)
{
  hc_status st = hbm_segment_point(s, c, k, 0.5, x);
  hbm_curve_measure_by(halves, c->metric, c->omega_scale);
  if (st == HC_OK) st = hbm_curve_append(halves, c->n_coef, seg->X0, seg->dX0, &c->points[k]);
  if (st == HC_OK) st = hbm_curve_append(halves, c->n_coef, x->X, x->dX, &x->point);
  return st == HC_OK ? hbm_curve_append(halves, c->n_coef, seg->X1, seg->dX1, &c->points[k + 1]) : st;
}

/* True if the interpolant turns back so near omega that the curve itself may turn beyond it: at an extremum the
 * interpolant errs by less than NEAR of its range of omega. */
static bool may_turn_at(const hbm_segment *s, double omega)
{
  double extrema[2], low = fmin(s->omega0, s->omega1), high = fmax(s->omega0, s->omega1);
  const int n = omega_extrema(s, extrema);
  bool near = false;
  for (int i = 0; i < n; ++i) low = fmin(low, omega_at(s, extrema[i])), high = fmax(high, omega_at(s, extrema[i]));
  for (int i = 0; i < n; ++i) near |= fabs(omega_at(s, extrema[i]) - omega) <= NEAR * (high - low);
  return near;
}

/* True if X equals one of the points first..c->n - 1 of c. */
static bool has_point(const hbm_curve *c, int first, const double *X)
{
  const metric_at at = {c->metric, c->n_coef, X, NULL};
  for (int j = first; j < c->n; ++j)
    if (!(metric_distance(&at, X, hbm_curve_X(c, j)) > SAME)) return true;
  return false;
}

/* The solutions on segment k of c, which is the curve or, after a halving, three points of it. */
static hc_status search_solutions(hbm_solver *s, const hbm_curve *c, int k, double omega, bool include_end,
                                  int halvings_left, hbm_candidate *x, hbm_curve *out)
{
  hbm_segment seg = hbm_segment_between(c, k);
  double sigma[3];
  int crossings = find_omega(&seg, omega, include_end, sigma), before = out->n;
  bool all_found = crossings > 0 || halvings_left == 0 || !may_turn_at(&seg, omega);
  for (int i = 0; i < crossings && all_found; ++i) {
    all_found = solve_at(s, c, k, &seg, sigma[i], omega, x) == HC_OK && !has_point(out, before, x->X);
    if (all_found && hbm_curve_append(out, c->n_coef, x->X, x->dX, &x->point) != HC_OK) return HC_NO_MEMORY;
  }
  if (all_found) return HC_OK;
  out->n = before;
  if (halvings_left == 0) return HC_NOT_CONVERGED;
  hbm_curve halves = {0};
  hc_status st = halve(s, c, k, &seg, x, &halves);
  if (st == HC_OK) st = search_solutions(s, &halves, 0, omega, false, halvings_left - 1, x, out);
  if (st == HC_OK) st = search_solutions(s, &halves, 1, omega, include_end, halvings_left - 1, x, out);
  hbm_curve_free(&halves);
  return st;
}

hc_status hbm_segment_solutions(hbm_solver *s, const hbm_curve *c, int k, double omega, bool include_end,
                                hbm_curve *out)
{
  hbm_candidate x;
  hc_status st = hbm_candidate_new(c->n_coef, &x);
  if (st != HC_OK) return st;
  hbm_curve_measure_by(out, c->metric, c->omega_scale);
  st = search_solutions(s, c, k, omega, include_end, MAX_HALVINGS, &x, out);
  free(x.X);
  return st;
}

/* Distance in the metric within which solutions found by Newton from two sides, each to 1e-10 of the forces, are one:
 * allows for a condition number a thousand times the usual. */
static const double MET = 1e-7;

/* Where the number of harmonics has changed since, a point is on the segment if the interpolant, whose error is some
 * 2e-4, is within this distance plus hbm.accuracy. */
static const double NEAR_OTHER = 1e-3;

hc_status hbm_curve_passes(hbm_solver *s, const hbm_curve *c, int segments, const hbm_curve *of, int point,
                           bool same_way, int *segment)
{
  const double omega = of->points[point].omega, *X = hbm_curve_X(of, point);
  const bool other_equations = s->sys.n_coef != c->n_coef || of->n_coef != c->n_coef; /* adaptive harmonics */
  const int n_coef = c->n_coef < of->n_coef ? c->n_coef : of->n_coef;
  hbm_candidate x = {0};
  int found = -1;
  *segment = -1;
  hc_status st = HC_OK;
  for (int k = 0; k < segments && found < 0 && st != HC_NO_MEMORY; ++k) {
    double sigma[3];
    if (!hbm_curve_has_segment(c, k)) continue;
    const bool between = (c->points[k].omega - omega) * (c->points[k + 1].omega - omega) <= 0,
               turns = (c->points[k].d_omega > 0) != (c->points[k + 1].d_omega > 0); /* omega may lie beyond both */
    if (!between && !turns) continue;
    if (same_way && (c->points[k].d_omega > 0) != (of->points[point].d_omega > 0)) continue;
    const hbm_segment seg = hbm_segment_between(c, k);
    const int n = find_omega(&seg, omega, true, sigma);
    for (int i = 0; i < n && found < 0; ++i) {
      if (!x.X && hbm_candidate_new(c->n_coef, &x) != HC_OK) return HC_NO_MEMORY;
      double at;
      hbm_segment_at(&seg, sigma[i], x.X, &at, NULL, NULL);
      const metric_at apart = {c->metric, n_coef, hbm_curve_X(c, k), hbm_curve_X(c, k + 1)};
      const double distance = metric_distance(&apart, x.X, X);
      if (other_equations && distance <= NEAR_OTHER + s->how.accuracy) found = k;
      if (other_equations || !(distance <= NEAR * seg.length + ROUNDING)) continue;
      st = solve_at(s, c, k, &seg, sigma[i], omega, &x);
      if (st == HC_OK && metric_distance(&apart, x.X, X) <= MET) found = k;
    }
  }
  free(x.X);
  *segment = found;
  return st == HC_NO_MEMORY ? st : HC_OK;
}

/* ---- of the whole curve: at an omega -------------------------------------------------------------------- */

/* Appends a solution at omega, found from guess or, if that is NULL, by hbm_first_solution, unless it is one of
 * at[before..]. */
static hc_status append_solution(hbm_solver *s, const hbm_curve *c, const double *guess, double omega, int before,
                                 hbm_curve *at)
{
  hbm_candidate x;
  hc_status st = hbm_candidate_new(c->n_coef, &x);
  if (st != HC_OK) return st;
  if (guess) memcpy(x.X, guess, (size_t)c->n_coef * sizeof *guess);
  memset(x.dX, 0, (size_t)c->n_coef * sizeof *x.dX);
  st = guess ? hbm_solve_fixed(s, omega, x.X, &x.point) : hbm_first_solution(s, omega, NULL, x.X, &x.point);
  if (st == HC_OK && !has_point(at, before, x.X)) st = hbm_curve_append(at, c->n_coef, x.X, x.dX, &x.point);
  free(x.X);
  return st;
}

/* Newton at omega from both ends of segment k, for joins of rest and slip, where planes across the interpolant may miss
 * the curve. */
static hc_status solve_from_ends(hbm_solver *s, const hbm_curve *c, int k, double omega, int before, hbm_curve *at)
{
  for (int end = k; end <= k + 1; ++end)
    if (append_solution(s, c, hbm_curve_X(c, end), omega, before, at) == HC_NO_MEMORY) return HC_NO_MEMORY;
  return at->n > before ? HC_OK : HC_NOT_CONVERGED;
}

/* True if point i, or its mirror image in a symmetric model, equals one of the points before..end - 1. Within one part
 * the tolerance is SAME, not MET: next to a fold two solutions are close. */
static bool is_twin(const hbm_solver *s, const hbm_curve *at, int before, int end, int i)
{
  double *X = hbm_curve_X(at, i);
  const metric_at m = {at->metric, at->n_coef, X, NULL};
  bool twin = false;
  for (int j = before; j < end && !twin; ++j) {
    twin = !(metric_distance(&m, X, hbm_curve_X(at, j)) > (at->points[i].part == at->points[j].part ? SAME : MET));
    if (twin || !hbm_mirror(s, X)) continue;
    twin = !(metric_distance(&m, X, hbm_curve_X(at, j)) > MET);
    hbm_mirror(s, X); /* restores X */
  }
  return twin;
}

/* Removes duplicates: interpolants of steep segments may overshoot into the next one, parts of a curve may end on one
 * another, and a branch of a symmetric model has its mirror image. */
static void drop_twins(const hbm_solver *s, int before, hbm_curve *at)
{
  const size_t row = (size_t)at->n_coef * sizeof(double);
  int n = before;
  for (int i = before; i < at->n; ++i) {
    if (is_twin(s, at, before, n, i)) continue;
    at->points[n] = at->points[i];
    memmove(hbm_curve_X(at, n), hbm_curve_X(at, i), row);
    memmove(hbm_curve_dX(at, n), hbm_curve_dX(at, i), row);
    ++n;
  }
  at->n = n;
}

static bool is_within(const hbm_curve *c, double omega)
{
  bool below = false, above = false;
  for (int k = 0; k < c->n; ++k) below |= c->points[k].omega <= omega, above |= c->points[k].omega >= omega;
  return below && above;
}

/* Appends the motion in which no contact changes state, where it solves the equations: closed form, at any omega that
 * the curve spans, whether or not a part contains it. */
static hc_status append_linear(hbm_solver *s, const hbm_curve *c, double omega, hbm_curve *at)
{
  hbm_candidate x;
  if (!is_within(c, omega)) return HC_OK;
  hc_status st = hbm_candidate_new(s->sys.n_coef > c->n_coef ? s->sys.n_coef : c->n_coef, &x);
  if (st != HC_OK) return st;
  if (hbm_linear_point(s, omega, INFINITY, x.X, x.dX, &x.point)) {
    x.point.d_omega = 1;
    x.point.branch = c->points[c->n - 1].branch + 1;
    x.point.part = c->n_parts;
    st = hbm_curve_append(at, c->n_coef, x.X, x.dX, &x.point);
  }
  free(x.X);
  return st;
}

hc_status hbm_curve_at(hbm_solver *s, const hbm_curve *c, double omega, hbm_curve *at)
{
  const int before = at->n;
  hc_status worst = HC_OK;
  hbm_curve_measure_by(at, c->metric, c->omega_scale);
  at->asked = true;
  for (int k = 0; k + 1 < c->n; ++k) {
    if (!hbm_curve_has_segment(c, k)) continue;
    hc_status st = hbm_segment_solutions(s, c, k, omega, !hbm_curve_has_segment(c, k + 1), at);
    if (st != HC_OK && s->edges) st = solve_from_ends(s, c, k, omega, before, at);
    if (st != HC_OK) worst = st;
  }
  if (c->n_parts > 0 && c->n > 0 && append_linear(s, c, omega, at) == HC_NO_MEMORY) return HC_NO_MEMORY;
  drop_twins(s, before, at);
  const bool stopped = at->n == before && c->n > 0 && c->end != HC_OK;
  return stopped && s->edges ? append_solution(s, c, NULL, omega, before, at) : worst;
}

/* ---- a part of a segment that shrinks ---------------------------------------------------------------- */

static const double SHORTEST_PART = 1e-7; /* [segment] ends are right to 1e-13 of the segment, which is then 1e-6 of the
                                             part */

hc_status hbm_narrowing_start(hbm_narrowing *p, const hbm_curve *c, int k)
{
  hc_status st = HC_OK;
  p->ends.n = 0;
  hbm_curve_measure_by(&p->ends, c->metric, c->omega_scale);
  p->from = 0;
  p->to = 1;
  for (int end = k; end <= k + 1 && st == HC_OK; ++end)
    st = hbm_curve_append(&p->ends, c->n_coef, hbm_curve_X(c, end), hbm_curve_dX(c, end), &c->points[end]);
  return st;
}

static double part_of(const hbm_narrowing *p, double sigma) { return (sigma - p->from) / (p->to - p->from); }

void hbm_narrowing_guess(const hbm_narrowing *p, double sigma, double *X, double *omega, double *dX)
{
  const hbm_segment between = hbm_segment_between(&p->ends, 0);
  hbm_segment_at(&between, part_of(p, sigma), X, omega, dX, NULL);
}

hc_status hbm_narrowing_point(hbm_solver *s, const hbm_narrowing *p, double sigma, hbm_candidate *x)
{
  return hbm_segment_point(s, &p->ends, 0, part_of(p, sigma), x);
}

void hbm_narrowing_move(hbm_narrowing *p, bool first, double sigma, const hbm_candidate *x)
{
  const int end = first ? 0 : 1;
  const size_t bytes = (size_t)p->ends.n_coef * sizeof(double);
  if (!((first ? p->to - sigma : sigma - p->from) >= SHORTEST_PART)) return;
  *(first ? &p->from : &p->to) = sigma;
  p->ends.points[end] = x->point;
  memcpy(hbm_curve_X(&p->ends, end), x->X, bytes);
  memcpy(hbm_curve_dX(&p->ends, end), x->dX, bytes);
}

/* ---- of the whole curve: the peak ------------------------------------------------------------------------ */

/* Search on the two segments that meet at the highest point, by a position: -1 is the point before, 0 the highest, 1
 * the point after. */
typedef struct peak_search {
  hbm_solver *s;
  const hbm_curve *c;
  int top;          /* index of the highest point */
  hbm_candidate *x; /* the solution at the last position */
  hbm_narrowing near;
  hbm_candidate between; /* a point of the interpolant */
} peak_search;

double hbm_amplitude_at(hbm_solver *s, const double *X)
{
  double max, min;
  hbm_system_response(&s->sys, s->sys.n_harm, X, s->x);
  series_extrema(s->sys.n_harm, s->x, &max, &min);
  return motion_amplitude(max, min);
}

static hc_status minus_amplitude_at(void *self, double position, double *minus_amplitude)
{
  const peak_search *p = self;
  const int k = position < 0 ? p->top - 1 : p->top;
  const hc_status st = hbm_segment_point(p->s, p->c, k, position - (k - p->top), p->x);
  *minus_amplitude = st == HC_OK ? -hbm_amplitude_at(p->s, p->x->X) : NAN;
  return st;
}

/* Derivative of the amplitude [length] along dX at X, by a central difference, whose error is 1e-10 of the amplitude.
 * Since the response is stationary at its extrema, their shifts do not count, and the amplitude is as smooth as the
 * curve. */
static double amplitude_slope(hbm_solver *s, int n, const double *X, const double *dX, double *moved)
{
  const metric_at at = {s->sys.metric, n, X, NULL};
  const double way = metric_length(&at, dX), step = way > 0 ? 1e-5 / way : 0;
  double amplitude[2];
  for (int k = 0; k < 2; ++k) {
    for (int i = 0; i < n; ++i) moved[i] = X[i] + (k ? step : -step) * dX[i];
    amplitude[k] = hbm_amplitude_at(s, moved);
  }
  return step > 0 ? (amplitude[1] - amplitude[0]) / (2 * step) : 0;
}

/* Derivative by sigma of the interpolant's amplitude between the ends of the narrowed part. */
static hc_status guessed_slope(void *self, double sigma, double *slope)
{
  peak_search *p = self;
  hbm_candidate *x = &p->between;
  hbm_narrowing_guess(&p->near, sigma, x->X, &x->point.omega, x->dX);
  *slope = amplitude_slope(p->s, p->c->n_coef, x->X, x->dX, x->guess) / (p->near.to - p->near.from);
  return HC_OK;
}

static double guessed_amplitude(peak_search *p, double sigma)
{
  hbm_narrowing_guess(&p->near, sigma, p->between.X, &p->between.point.omega, NULL);
  return hbm_amplitude_at(p->s, p->between.X);
}

/* The summit beside the highest point, where the amplitude ceases to rise, for many unknowns: narrows the segment by
 * solutions at the interpolant's summit or, where these do not help (a corner, as sampled forces have), where the
 * tangents at its ends meet; returns the higher end. root_minimum takes several times as many solves, but sees more of
 * a curve of sampled forces, with adjacent summits. NULL: few unknowns, or not found. */
static const hbm_point *peak_by_slope(peak_search *p, double highest, double **X, double **dX)
{
  enum { SUMMIT_TRIES = 20 };      /* corners of the plates took 2 to 16, with 24 to 196 samples */
  const double least_gain = 1e-11; /* [amplitude] a part of the shortest length gains a tenth of that */
  double end[2], slope[2], before = INFINITY;
  bool encloses = false, shortest = false; /* shortest: the part can be narrowed no more */
  for (int k = p->top - 1; k <= p->top && hbm_has_many_unknowns(p->s) && !encloses; ++k) {
    if (hbm_narrowing_start(&p->near, p->c, k) != HC_OK) return NULL;
    guessed_slope(p, 0, &slope[0]), guessed_slope(p, 1, &slope[1]);
    encloses = slope[0] > 0 && slope[1] <= 0;
  }
  for (int tries = 0; encloses && tries < SUMMIT_TRIES; ++tries) {
    const double from = p->near.from, to = p->near.to;
    root_point summit;
    guessed_slope(p, from, &slope[0]), guessed_slope(p, to, &slope[1]);
    if (root_between(guessed_slope, p, from, slope[0], to, slope[1], 1e-7 * (to - from), &summit) != HC_OK) return NULL;
    end[0] = guessed_amplitude(p, from), end[1] = guessed_amplitude(p, to);
    const int higher = end[1] > end[0];
    const double gain = guessed_amplitude(p, summit.x) - end[higher];
    if (shortest && hbm_amplitude_at(p->s, p->x->X) > fmax(end[higher], highest)) return &p->x->point;
    if (shortest || gain <= least_gain * end[higher]) {
      if (!(end[higher] >= highest)) return NULL;
      *X = hbm_curve_X(&p->near.ends, higher), *dX = hbm_curve_dX(&p->near.ends, higher);
      return &p->near.ends.points[higher];
    }
    const double corner = from + (end[1] - end[0] - slope[1] * (to - from)) / (slope[0] - slope[1]);
    const double sigma = gain > 0.1 * before && corner > from && corner < to ? corner : summit.x;
    before = gain;
    if (hbm_narrowing_point(p->s, &p->near, sigma, p->x) != HC_OK) return NULL;
    const double rise = amplitude_slope(p->s, p->c->n_coef, p->x->X, p->x->dX, p->between.guess);
    hbm_narrowing_move(&p->near, rise > 0, sigma, p->x);
    shortest = p->near.from == from && p->near.to == to;
  }
  return NULL;
}

/* amplitude[3]: of the highest point and its neighbours. */
static hc_status refine_peak(hbm_solver *s, const hbm_curve *c, int top, const double *amplitude, hbm_candidate *x,
                             hbm_curve *peak)
{
  const double tolerance = 1e-7; /* at a maximum an amplitude changes with the square: by 1e-14 */
  peak_search p = {.s = s, .c = c, .top = top, .x = x};
  root_point found;
  double value;
  hc_status st = hbm_candidate_new(c->n_coef, &p.between);
  if (st != HC_OK) return st;
  double *X = x->X, *dX = x->dX;
  const hbm_point *point = peak_by_slope(&p, amplitude[1], &X, &dX);
  if (!point) {
    st = root_minimum(minus_amplitude_at, &p, -1, -amplitude[0], 0, -amplitude[1], 1, -amplitude[2], tolerance, &found);
    /* any other failure is that of a solve between the points: found.x is then the highest one solved for before */
    if (st != HC_BAD_INPUT) st = minus_amplitude_at(&p, found.x, &value) == HC_OK ? HC_OK : HC_NOT_CONVERGED;
  }
  if (st == HC_OK) st = hbm_curve_append(peak, c->n_coef, X, dX, point ? point : &x->point);
  hbm_curve_free(&p.near.ends);
  free(p.between.X);
  return st;
}

hc_status hbm_curve_peak(hbm_solver *s, const hbm_curve *c, hbm_curve *peak)
{
  int top = -1;
  double beside[3] = {NAN, -1, NAN}; /* amplitudes around the highest point */
  for (int k = 0; k < c->n; ++k) {
    double reach = 0; /* no less than the amplitude */
    hbm_system_response(&s->sys, s->sys.n_harm, hbm_curve_X(c, k), s->x);
    for (int h = 1; h <= s->sys.n_harm; ++h) reach += hypot(s->x[2 * h - 1], s->x[2 * h]);
    if (reach < beside[1]) continue;
    const double amplitude = hbm_amplitude_at(s, hbm_curve_X(c, k));
    if (amplitude > beside[1]) beside[1] = amplitude, top = k;
  }
  if (top < 0) return HC_BAD_INPUT;
  hbm_curve_measure_by(peak, c->metric, c->omega_scale);
  if (top == 0 || !hbm_curve_has_segment(c, top - 1) ||
      !hbm_curve_has_segment(c, top)) /* an end of the sweep: the peak may lie outside */
    return hbm_curve_append(peak, c->n_coef, hbm_curve_X(c, top), hbm_curve_dX(c, top), &c->points[top]);
  for (int side = -1; side <= 1; side += 2) beside[1 + side] = hbm_amplitude_at(s, hbm_curve_X(c, top + side));
  hbm_candidate x;
  hc_status st = hbm_candidate_new(c->n_coef, &x);
  if (st != HC_OK) return st;
  st = refine_peak(s, c, top, beside, &x, peak);
  free(x.X);
  return st;
}

/* ---- summits become points ------------------------------------------------------------------------------- */

/* The summit of the curve on segment k into x: solved at the interpolant's summit and, for few unknowns, once more on
 * the part narrowed by that solution. True if it is higher than `highest`. */
static bool find_summit(peak_search *p, int k, double highest)
{
  const int times_most = hbm_has_many_unknowns(p->s) ? 1 : 2;
  double rise[2];
  root_point summit;
  if (hbm_narrowing_start(&p->near, p->c, k) != HC_OK) return false;
  for (int times = 0; times < times_most; ++times) {
    const double from = p->near.from, to = p->near.to;
    guessed_slope(p, from, &rise[0]), guessed_slope(p, to, &rise[1]);
    if (!(rise[0] > 0 && rise[1] < 0)) return times > 0 && hbm_amplitude_at(p->s, p->x->X) > highest;
    if (root_between(guessed_slope, p, from, rise[0], to, rise[1], 1e-7 * (to - from), &summit) != HC_OK) return false;
    if (hbm_narrowing_point(p->s, &p->near, summit.x, p->x) != HC_OK) return false;
    const double onward = amplitude_slope(p->s, p->c->n_coef, p->x->X, p->x->dX, p->between.guess);
    hbm_narrowing_move(&p->near, onward > 0, summit.x, p->x);
  }
  return hbm_amplitude_at(p->s, p->x->X) > highest;
}

/* x between points k and k + 1. */
static hc_status insert_point(hbm_curve *c, int k, const hbm_candidate *x)
{
  const size_t row = (size_t)c->n_coef * sizeof(double), behind = (size_t)(c->n - k - 1);
  hc_status st = hbm_curve_append(c, c->n_coef, x->X, x->dX, &x->point);
  if (st != HC_OK) return st;
  memmove(&c->points[k + 2], &c->points[k + 1], behind * sizeof *c->points);
  memmove(hbm_curve_X(c, k + 2), hbm_curve_X(c, k + 1), behind * row);
  memmove(hbm_curve_dX(c, k + 2), hbm_curve_dX(c, k + 1), behind * row);
  c->points[k + 1] = x->point;
  c->points[k + 1].error = fmax(c->points[k].error, c->points[k + 2].error);
  memcpy(hbm_curve_X(c, k + 1), x->X, row);
  memcpy(hbm_curve_dX(c, k + 1), x->dX, row);
  return HC_OK;
}

/* The summit beside point *top, whose amplitude and its neighbours' are high[3], becomes a point, after which *top is
 * the later one of the two. */
static hc_status add_summit(hbm_solver *s, hbm_curve *c, const double *high, int *top)
{
  hbm_candidate x;
  peak_search p = {.s = s, .c = c, .x = &x};
  hc_status st = hbm_candidate_new(c->n_coef, &x);
  if (st != HC_OK) return st;
  st = hbm_candidate_new(c->n_coef, &p.between);
  if (st == HC_OK) st = hbm_narrowing_start(&p.near, c, 0); /* allocates, so that find_summit cannot fail by that */
  if (st == HC_OK) {
    const int k = find_summit(&p, *top - 1, high[1]) ? *top - 1 : find_summit(&p, *top, high[1]) ? *top : -1;
    /* No point is inserted where it would add two turning points with only the summit between them, as sampled forces
     * have. */
    const bool turns = k >= 0 && (x.point.d_omega > 0) != (c->points[k].d_omega > 0) &&
                       (x.point.d_omega > 0) != (c->points[k + 1].d_omega > 0);
    if (k >= 0 && !turns) st = insert_point(c, k, &x), ++*top;
  }
  hbm_curve_free(&p.near.ends);
  free(p.between.X);
  free(x.X);
  return st;
}

hc_status hbm_curve_add_summits(hbm_solver *s, hbm_curve *c, int left, int *top)
{
  hc_status st = HC_OK;
  if (*top == 0 && c->n > left) *top = 1;
  for (; *top + 1 + left < c->n && st == HC_OK; ++*top) {
    double high[3];
    for (int i = 0; i < 3; ++i) high[i] = hbm_amplitude_at(s, hbm_curve_X(c, *top - 1 + i));
    if (high[1] >= high[0] && high[1] >= high[2]) st = add_summit(s, c, high, top);
  }
  return st;
}
