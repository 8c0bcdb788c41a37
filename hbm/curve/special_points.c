/* special_points.c - see special_points.h. Test functions are evaluated at every point of the curve; where one
 * changes between two points, the change is located on the segment between them. d omega along the tangent (turning
 * point) and the product of 1 + multiplier (period doubling) are smooth functions of sigma: their roots are found by
 * interpolation. The contact pattern is not: its change is bisected, with the pattern of the interpolant as a guess of
 * where (segment.h), and the rest of the segment searched for the next. Bisected, too, is the number of complex pairs
 * of multipliers outside the unit circle (Neimark-Sacker): where it changes without a pair on the circle, two real ones
 * have met, or multipliers jump with the pattern. Where a symmetry breaks the sign of the determinant changes, and the
 * curve does not turn: that is bisected, too. Two changes between neighbouring
 * points leave no trace at these: they are looked for where a test function falls towards 0 from either side. What is
 * too near to be told apart is one change: slip and separation that begin at once, two contacts that are alike. */
#include "hbm/curve/special_points.h"

#include <stdlib.h>
#include <string.h>

#include "hbm/curve/predict.h"
#include "hbm/curve/segment.h"
#include "hbm/solver/corrector.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "hbm/solver/stability.h"
#include "numerics/base/growing.h"
#include "numerics/norm.h"
#include "numerics/roots.h"

/* Tolerances of sigma. A segment spans a fraction of the sweep, so SIGMA_TOLERANCE is far less than the 1e-9 of omega
 * that special_points.h promises. For contact changes with many unknowns: SIGMA_OF_MANY, but at most OMEGA_OF_MANY of
 * omega, a tenth of the promise. */
static const double SIGMA_TOLERANCE = 1e-11, SIGMA_OF_MANY = 1e-8, OMEGA_OF_MANY = 1e-10;
enum { MAX_CONTACT_CHANGES = 64 /* on one segment */, MOST_CONTACTS_FOLLOWED = 24 };
/* Points that differ by less than this, relative to omega and to the amplitude (near a turning point omega alone says
 * little), cannot be told apart: special_points.h promises no more. */
static const double SAME_OMEGA = 1e-9, SAME_AMPLITUDE = 1e-8;

/* The test functions at a point. */
typedef struct test_values {
  double d_omega, flip;
  int branch_sign;
  int pairs_outside;
  double pair;           /* as in hbm_stability */
  contact_regime regime; /* with transitions: the contact pattern */
  int transitions;
  bool of_motion; /* as in hbm_stability: the multipliers depend on the motion */
} test_values;

/* A special point, with the number of transitions on either side for a contact change. */
typedef struct found_point {
  hbm_special special;
  double sigma; /* place on its segment */
  int transitions_before, transitions_after;
} found_point;

typedef struct detector {
  hbm_solver *s;
  const hbm_curve *c;
  hbm_candidate x;     /* the solution between points that was evaluated last */
  hbm_narrowing near;  /* the part of the segment around a contact change */
  contact_regime *was; /* [n_contacts] regime of each contact before a contact change */
  int n, first;        /* entries of found; index of the current segment's first one */
  found_point *found;  /* [n] */
} detector;

bool hbm_specials_follow_each(const hbm_solver *s) { return s->model->n_contacts <= MOST_CONTACTS_FOLLOWED; }

/* A sign that changes at branch points alone: of symmetric models with kinks the even harmonics' (hbm_even_sign),
 * without kinks that of det dR/dX times that of d_omega, whatever symmetry breaks. 0 of other models. */
static int branch_sign(const detector *d, const double *X, double omega, double d_omega)
{
  int det_sign = 0;
  if (model_has_kinks(d->s->model)) return d->s->symmetric ? hbm_even_sign(d->s, omega, X) : 0;
  return hbm_det_sign_at(d->s, omega, X, &det_sign) == HC_OK ? (d_omega > 0 ? det_sign : -det_sign) : 0;
}

/* with_multipliers: set only in searches for a period doubling or a Neimark-Sacker point; they cost more than all the
 * rest. */
static hc_status evaluate_tests(detector *d, double omega, double d_omega, const double *X, bool with_multipliers,
                                test_values *v)
{
  const contact_forces *orbit;
  contact_report report;
  hbm_stability stability = {.flip = NAN, .pair = NAN};
  hc_status st = hbm_located_orbit(d->s, X, &orbit, &report);
  if (st == HC_OK && with_multipliers) st = hbm_multipliers(d->s, orbit, omega, X, &stability);
  const int transitions = hbm_specials_follow_each(d->s) ? report.transitions : 0;
  if (st == HC_OK)
    *v = (test_values){d_omega,        stability.flip, 0,           stability.pairs_outside,
                       stability.pair, report.regime,  transitions, stability.of_motion};
  return st;
}

static hc_status evaluate_at_point(detector *d, int k, test_values *v)
{
  const hbm_point *p = &d->c->points[k];
  const double *X = hbm_curve_X(d->c, k);
  hc_status st = evaluate_tests(d, p->omega, p->d_omega, X, !hbm_stability_is_costly(d->s), v);
  const bool known = model_has_kinks(d->s->model); /* the curve stores the sign at its symmetric points */
  if (st == HC_OK) v->branch_sign = known ? p->even_sign : branch_sign(d, X, p->omega, p->d_omega);
  return st;
}

static bool same_pattern(const test_values *a, const test_values *b)
{
  return a->regime == b->regime && a->transitions == b->transitions;
}

/* Inserts the solution in d->x, at sigma, in the order of sigma among those of this segment. */
static hc_status insert_special(detector *d, double sigma, hbm_special_kind kind, const test_values *before,
                                const test_values *after)
{
  hbm_measures m;
  if (!GROW(d->found, d->n)) return HC_NO_MEMORY;
  const hc_status st = hbm_measure(d->s, d->x.X, &m);
  if (st != HC_OK) return st;
  int i = d->n++;
  for (; i > d->first && d->found[i - 1].sigma > sigma; --i) d->found[i] = d->found[i - 1];
  d->found[i] =
      (found_point){.special = {kind, d->x.point.omega, m.amplitude, d->x.point.branch, before->regime, after->regime},
                    .sigma = sigma,
                    .transitions_before = before->transitions,
                    .transitions_after = after->transitions};
  return HC_OK;
}

/* Index of the point among found[0..n-1] of p's kind and at p's place; -1 if there is none. */
static int twin_of(const found_point *found, int n, const found_point *p)
{
  for (int k = n - 1; k >= 0; --k) {
    const hbm_special *a = &found[k].special, *b = &p->special;
    const bool same_omega = fabs(a->omega - b->omega) <= SAME_OMEGA * a->omega;
    if (!same_omega || !(fabs(a->amplitude - b->amplitude) <= SAME_AMPLITUDE * a->amplitude)) return -1;
    if (a->kind == b->kind) return k;
  }
  return -1;
}

/* Merges *other into *one, at the same place. False if they cancel: two turning points or period doublings at one
 * place, or a contact pattern that is the same before and after both. */
static bool take_in(found_point *one, const found_point *other)
{
  if (one->special.kind != HBM_CONTACT_CHANGE) return false;
  one->special.after = other->special.after;
  one->transitions_after = other->transitions_after;
  return one->special.before != one->special.after || one->transitions_before != one->transitions_after;
}

/* A search along segment k. */
typedef struct segment_search {
  detector *d;
  int k;
  hbm_special_kind kind;     /* kind of point searched for */
  const test_values *before; /* test functions at the start of the search; NULL for roots of smooth functions */
  double sigma;              /* place of `here`, NaN if there is none */
  test_values here;          /* test functions at sigma */
} segment_search;

/* Sets d->x and s->here to sigma, if they are elsewhere; a contact change is solved for on the narrowed part around
 * it. */
static hc_status evaluate_at(segment_search *s, double sigma)
{
  detector *d = s->d;
  if (s->sigma == sigma) return HC_OK;
  hc_status st = s->kind == HBM_CONTACT_CHANGE ? hbm_narrowing_point(d->s, &d->near, sigma, &d->x)
                                               : hbm_segment_point(d->s, d->c, s->k, sigma, &d->x);
  const bool asked = s->kind == HBM_PERIOD_DOUBLING || s->kind == HBM_NEIMARK_SACKER;
  if (st == HC_OK) st = evaluate_tests(d, d->x.point.omega, d->x.point.d_omega, d->x.X, asked, &s->here);
  if (st == HC_OK && s->kind == HBM_SYMMETRY_BREAKING)
    s->here.branch_sign = branch_sign(d, d->x.X, d->x.point.omega, d->x.point.d_omega);
  s->sigma = st == HC_OK ? sigma : NAN;
  return st;
}

/* The test function of that kind. */
static double test_of(hbm_special_kind kind, const test_values *v)
{
  return kind == HBM_TURNING_POINT ? v->d_omega : kind == HBM_PERIOD_DOUBLING ? v->flip : v->pair - 1;
}

static hc_status smooth_test_at(void *self, double sigma, double *value)
{
  segment_search *s = self;
  hc_status st = evaluate_at(s, sigma);
  *value = test_of(s->kind, &s->here);
  return st;
}

static hc_status pattern_differs_at(void *self, double sigma, bool *differs)
{
  segment_search *s = self;
  hc_status st = evaluate_at(s, sigma);
  *differs = !same_pattern(&s->here, s->before);
  if (st == HC_OK) hbm_narrowing_move(&s->d->near, !*differs, sigma, &s->d->x);
  return st;
}

/* The same of the interpolant: no equations are solved. */
static hc_status pattern_may_differ_at(void *self, double sigma, bool *differs)
{
  segment_search *s = self;
  detector *d = s->d;
  double omega;
  test_values there;
  hbm_narrowing_guess(&d->near, sigma, d->x.guess, &omega, NULL);
  hbm_truncate(d->s, d->c->n_coef, d->x.guess);
  hc_status st = evaluate_tests(d, omega, 0, d->x.guess, false, &there);
  *differs = st == HC_OK && !same_pattern(&there, s->before);
  return st;
}

static hc_status pairs_outside_differ_at(void *self, double sigma, bool *differ)
{
  segment_search *s = self;
  hc_status st = evaluate_at(s, sigma);
  *differ = s->here.pairs_outside != s->before->pairs_outside;
  return st;
}

/* [rad/time] Distance from omega to the first point of the curve, from k on in that direction, whose stability is
 * known: the change of stability is not beyond it. 0 if that is point k itself. */
static double reach_of_unknown(detector *d, int k, int direction, double omega)
{
  double reach = 0;
  for (int first = k; k >= 0 && k < d->c->n; k += direction) {
    hbm_stability at;
    const double here = d->c->points[k].omega;
    const hc_status st = hbm_stability_with_error(d->s, here, hbm_curve_X(d->c, k), false, &at);
    const bool known = st == HC_OK && hbm_stability_verdict(&at) != 0;
    if (known && k == first) return 0;
    reach = fmax(reach, fabs(here - omega));
    if (known) break;
  }
  return reach;
}

/* Inserts the point found at sigma, where d->x is, with its error in omega: error of the test function, from the
 * solution with twice the harmonics, over its slope along the curve; at least the distance over which stability is
 * unknown, since the slope need not hold there. Evaluated beside the point, since at a broken symmetry the equations
 * are singular. */
static hc_status insert_with_error(segment_search *s, double sigma)
{
  const double beside = sigma < 0.5 ? sigma + 0.05 : sigma - 0.05;
  detector *d = s->d;
  const test_values at = s->here;
  const double omega = d->x.point.omega;
  hbm_stability finer;
  double factor = NAN, error = INFINITY;
  hc_status st = insert_special(d, sigma, s->kind, &at, &at);
  if (st != HC_OK || s->kind == HBM_TURNING_POINT) return st;
  st = hbm_stability_error_is_costly(d->s) ? HC_NOT_CONVERGED : evaluate_at(s, beside);
  const double slope = (test_of(s->kind, &s->here) - test_of(s->kind, &at)) / (d->x.point.omega - omega);
  if (st == HC_OK) st = hbm_finer_stability(d->s, d->x.point.omega, d->x.X, &finer, &factor);
  if (st == HC_NO_MEMORY) return st;
  if (st == HC_OK) {
    const test_values better = {.flip = finer.flip, .pair = finer.pair};
    error = fabs(factor * (test_of(s->kind, &better) - test_of(s->kind, &s->here)) / slope);
    error = fmax(isfinite(error) ? error : INFINITY, reach_of_unknown(d, s->k, -1, omega));
    error = fmax(error, reach_of_unknown(d, s->k + 1, 1, omega));
  }
  for (int i = d->first; i < d->n; ++i)
    if (d->found[i].sigma == sigma && d->found[i].special.kind == s->kind) d->found[i].special.omega_error = error;
  return HC_OK;
}

/* A sign change of a smooth test function on part of segment k, f0 and f1 at its ends. */
static hc_status locate_root(detector *d, int k, hbm_special_kind kind, double from, double f0, double to, double f1)
{
  segment_search s = {.d = d, .k = k, .kind = kind, .sigma = NAN};
  root_point root;
  hc_status st = root_between(smooth_test_at, &s, from, f0, to, f1, SIGMA_TOLERANCE, &root);
  if (st == HC_OK) st = evaluate_at(&s, root.x);
  if (st != HC_OK) return st;
  /* a turning point belongs to the branch that it ends */
  if (kind == HBM_TURNING_POINT) d->x.point.branch = d->c->points[k].branch;
  return insert_with_error(&s, root.x);
}

static hc_status is_broken(void *self, double sigma, bool *broken)
{
  segment_search *s = self;
  const hc_status st = evaluate_at(s, sigma);
  *broken = st == HC_OK && s->here.branch_sign != s->before->branch_sign;
  return st;
}

/* Locates the change of branch_sign on segment k: a branch point of the equations themselves, so omega_error is 0. */
static hc_status locate_breaking(detector *d, int k, const test_values *a)
{
  segment_search s = {.d = d, .k = k, .kind = HBM_SYMMETRY_BREAKING, .before = a, .sigma = NAN};
  root_point change;
  hc_status st = root_change(is_broken, &s, 0, 1, SIGMA_TOLERANCE, &change);
  if (st == HC_OK) st = evaluate_at(&s, change.x);
  return st == HC_OK ? insert_special(d, change.x, HBM_SYMMETRY_BREAKING, &s.here, &s.here) : st;
}

/* Solves at omega into d->x, from the first guess that converges. */
static hc_status solve_at_omega(detector *d, double *const guess[2], double omega)
{
  hc_status st = HC_NOT_CONVERGED;
  for (int i = 0; i < 2 && st != HC_OK; ++i) {
    memcpy(d->x.X, guess[i], (size_t)d->c->n_coef * sizeof(double));
    st = hbm_solve_fixed(d->s, omega, d->x.X, &d->x.point);
  }
  return st;
}

/* Planes across the interpolant may miss a join of rest and slip: the change on segment k by bisection of omega. Next
 * to the join Newton may fail for the slipping motion but not for the resting one: where it fails, within a step over a
 * join or within edges->located of omega, the motion is taken to slip. */
static hc_status locate_edge(detector *d, int k, const test_values *before, const test_values *end)
{
  const hbm_point *p = &d->c->points[k];
  const slip_edges *edges = d->s->edges;
  const bool rests_before = before->transitions < end->transitions;
  const double unsolved = p[1].over_join ? fabs(p[1].omega - p[0].omega) : edges->located * p[0].omega;
  double from = p[0].omega, to = p[1].omega;
  hc_status st = hbm_narrowing_start(&d->near, d->c, k);
  if (st != HC_OK) return st;
  double *const guess[2] = {hbm_curve_X(&d->near.ends, 0), hbm_curve_X(&d->near.ends, 1)};
  for (int i = 0; i < edges->bisections && fabs(to - from) > 0.5 * SAME_OMEGA * to; ++i) {
    const double middle = from + 0.5 * (to - from);
    test_values here = {0};
    st = solve_at_omega(d, guess, middle);
    if (st == HC_OK) st = evaluate_tests(d, middle, 0, d->x.X, false, &here);
    if (st != HC_OK && !(fabs(to - from) <= unsolved)) return st;
    const bool is_beyond = st == HC_OK ? !same_pattern(&here, before) : rests_before;
    *(is_beyond ? &to : &from) = middle;
    if (st == HC_OK) memcpy(guess[is_beyond], d->x.X, (size_t)d->c->n_coef * sizeof(double));
  }
  if (!(fabs(to - from) <= edges->located * to)) return HC_NOT_CONVERGED;
  d->x.point = p[0];
  d->x.point.omega = from;
  memcpy(d->x.X, guess[!rests_before], (size_t)d->c->n_coef * sizeof(double));
  return insert_special(d, 0.5, HBM_CONTACT_CHANGE, before, end);
}

/* The regimes reported for a contact change: the strongest among the contacts whose regime changes there; if no single
 * contact's does, that of all contacts, as in *before and *after already. */
static hc_status name_change(segment_search *s, const root_point *change, test_values *before, test_values *after)
{
  detector *d = s->d;
  const int n = hbm_specials_follow_each(d->s) ? d->s->model->n_contacts : 0;
  const contact_forces *orbit = d->s->orbit ? d->s->orbit : d->s->sys.contacts;
  contact_regime from = CONTACT_LINEAR, to = CONTACT_LINEAR;
  bool any = false;
  hc_status st = n > 0 ? evaluate_at(s, change->before) : HC_OK;
  for (int j = 0; j < n && st == HC_OK; ++j) d->was[j] = contact_forces_regime(orbit, j);
  if (st == HC_OK) st = evaluate_at(s, change->x);
  for (int j = 0; j < n && st == HC_OK; ++j) {
    const contact_regime now = contact_forces_regime(orbit, j);
    if (now == d->was[j]) continue;
    from = contact_regime_larger(from, d->was[j]);
    to = contact_regime_larger(to, now);
    any = true;
  }
  if (any) before->regime = from, after->regime = to;
  return st;
}

/* Every change of the contact pattern on segment k, from `before` at its start to `end` at its end. */
static hc_status locate_contact_changes(detector *d, int k, test_values before, const test_values *end)
{
  const hbm_point *p = &d->c->points[k];
  const double of_many = fmin(SIGMA_OF_MANY, OMEGA_OF_MANY * p->omega / fabs(p[1].omega - p->omega)),
               tolerance = hbm_has_many_unknowns(d->s) ? fmax(of_many, SIGMA_TOLERANCE) : SIGMA_TOLERANCE;
  double from = 0;
  for (int i = 0; i < MAX_CONTACT_CHANGES && from < 1 && !same_pattern(&before, end); ++i) {
    segment_search s = {.d = d, .k = k, .kind = HBM_CONTACT_CHANGE, .before = &before, .sigma = NAN};
    root_point change;
    hc_status st = hbm_narrowing_start(&d->near, d->c, k);
    if (st != HC_OK) return st;
    if (i > 0) hbm_narrowing_move(&d->near, true, from, &d->x);
    st = root_change_guided(pattern_differs_at, pattern_may_differ_at, &s, from, 1, tolerance, &change);
    test_values named = before, named_after = {0};
    if (st == HC_OK) st = evaluate_at(&s, change.x);
    const test_values after = change.x < 1 ? s.here : *end;
    const bool other = d->s->edges && same_pattern(&before, &after); /* solved again at a join, another solution */
    if (st == HC_OK && other) st = HC_NOT_CONVERGED;
    if (st == HC_OK) named_after = after, st = name_change(&s, &change, &named, &named_after);
    if (st == HC_OK) st = insert_special(d, change.x, HBM_CONTACT_CHANGE, &named, &named_after);
    if (st != HC_OK) return st;
    before = after;
    from = change.x;
  }
  return HC_OK;
}

/* Where the number of complex pairs outside the unit circle first changes on part of segment k, if a pair is on it
 * there. */
static hc_status locate_neimark_sacker(detector *d, int k, const test_values *before, double from, double to)
{
  const double on_circle = 1e-6; /* located to 1e-11 of the segment; a pair changes by less than 1e5 over a segment */
  segment_search s = {.d = d, .k = k, .kind = HBM_NEIMARK_SACKER, .before = before, .sigma = NAN};
  root_point change;
  hc_status st = root_change(pairs_outside_differ_at, &s, from, to, SIGMA_TOLERANCE, &change);
  if (st == HC_OK) st = evaluate_at(&s, change.x);
  if (st != HC_OK || !(fabs(s.here.pair - 1) <= on_circle)) return st;
  return insert_with_error(&s, change.x);
}

/* |test function|, negative beyond its zero, that is where its sign, or for pairs the number outside, differs from
 * `before`. NaN where it has no value. */
static double distance_of(hbm_special_kind kind, const test_values *before, const test_values *v)
{
  const double f = test_of(kind, v);
  if (kind == HBM_NEIMARK_SACKER) return v->pairs_outside == before->pairs_outside ? fabs(f) : -fabs(f);
  return test_of(kind, before) > 0 ? f : -f;
}

/* HC_STALLED ends root_minimum: a place beyond 0 is found. */
static hc_status distance_at(void *self, double sigma, double *value)
{
  segment_search *s = self;
  const hc_status st = evaluate_at(s, sigma);
  *value = distance_of(s->kind, s->before, &s->here);
  return st == HC_OK && *value < 0 ? HC_STALLED : st;
}

/* Two changes of that kind on segment k, at whose ends the test function has one sign. v: the test functions at the
 * points k - 1 to k + 2. A convex function lies above both lines through the neighbouring segments' ends: it can be
 * beyond 0 only where both lines are. */
static hc_status locate_pair(detector *d, int k, hbm_special_kind kind, const test_values *v)
{
  const double near_enough = 1e-3; /* [segment] two changes closer than this are missed */
  segment_search s = {.d = d, .k = k, .kind = kind, .before = &v[1], .sigma = NAN};
  double f[4], length[3];
  for (int i = 0; i < 4; ++i) f[i] = distance_of(kind, s.before, &v[i]);
  for (int i = 0; i < 3; ++i) length[i] = hbm_segment_between(d->c, k - 1 + i).length;
  const double fall = (f[0] - f[1]) / length[0], rise = (f[3] - f[2]) / length[2];
  if (!(f[1] > 0 && f[2] > 0 && fall > 0 && rise > 0 && isfinite(fall) && isfinite(rise))) return HC_OK;
  const double from = f[1] / (fall * length[1]), to = 1 - f[2] / (rise * length[1]), middle = 0.5 * (from + to);
  double there;
  if (!(from < to)) return HC_OK;
  hc_status st = distance_at(&s, middle, &there);
  root_point least = {.x = middle};
  if (st == HC_OK && there <= fmin(f[1], f[2]))
    st = root_minimum(distance_at, &s, 0, f[1], middle, there, 1, f[2], near_enough, &least);
  if (st != HC_STALLED) return st;
  const double beyond = s.sigma;
  const test_values here = s.here;
  if (kind == HBM_NEIMARK_SACKER) {
    st = locate_neimark_sacker(d, k, &v[1], 0, beyond);
    return st == HC_OK ? locate_neimark_sacker(d, k, &here, beyond, 1) : st;
  }
  const double value = test_of(kind, &here);
  st = locate_root(d, k, kind, 0, test_of(kind, &v[1]), beyond, value);
  return st == HC_OK ? locate_root(d, k, kind, beyond, value, 1, test_of(kind, &v[2])) : st;
}

/* True if the ends of segment k are closer than the tolerance of special_points.h: a change between them is then
 * located by that, and planes across so short a chord need not meet the curve (at a kink, where it also turns). */
static bool is_one_place(const detector *d, int k)
{
  const hbm_point *p = &d->c->points[k];
  const metric_at at = hbm_curve_metric(d->c, k);
  return fabs(p[1].omega - p[0].omega) <= SAME_OMEGA * p[0].omega &&
         metric_distance(&at, at.X, hbm_curve_X(d->c, k + 1)) <= SAME_AMPLITUDE;
}

/* Inserts the end of segment k as a special point, on the branch of the segment's start. */
static hc_status take_end(detector *d, int k, hbm_special_kind kind, const test_values *before,
                          const test_values *after)
{
  memcpy(d->x.X, hbm_curve_X(d->c, k + 1), (size_t)d->c->n_coef * sizeof(double));
  d->x.point = d->c->points[k + 1];
  d->x.point.branch = d->c->points[k].branch;
  return insert_special(d, 1, kind, before, after);
}

/* v[0] and v[1]: the test functions at the ends of segment k; of the points beside these too where there are both. */
static hc_status search_segment(detector *d, int k, const test_values *v)
{
  const test_values *a = v, *b = v + 1;
  const bool joined = k > 0 && hbm_curve_has_segment(d->c, k - 1) && hbm_curve_has_segment(d->c, k + 1);
  const bool inside = joined && (a->of_motion || b->of_motion) && !hbm_stability_error_is_costly(d->s);
  hc_status changes = HC_OK, turning = HC_OK, doubling = HC_OK, torus = HC_OK, breaking = HC_OK;
  const hbm_point *p = &d->c->points[k];
  d->first = d->n;
  if (!same_pattern(a, b)) changes = locate_contact_changes(d, k, *a, b);
  if (changes != HC_OK && d->n == d->first && d->s->edges) changes = locate_edge(d, k, a, b);
  /* A branch that is not symmetric ends where it comes to the symmetric one, on which that is named. */
  const bool ends = hbm_on_either_side(d->s, d->c->n_coef, hbm_curve_X(d->c, k), hbm_curve_X(d->c, k + 1)),
             smooth = !p[1].over_join && !ends;
  const bool turns = smooth && (a->d_omega > 0) != (b->d_omega > 0),
             breaks = smooth && a->branch_sign * b->branch_sign < 0;
  if (turns) turning = locate_root(d, k, HBM_TURNING_POINT, 0, a->d_omega, 1, b->d_omega);
  if ((a->flip > 0) != (b->flip > 0)) doubling = locate_root(d, k, HBM_PERIOD_DOUBLING, 0, a->flip, 1, b->flip);
  else if (inside) doubling = locate_pair(d, k, HBM_PERIOD_DOUBLING, v - 1);
  if (breaks) breaking = locate_breaking(d, k, a);
  if (a->pairs_outside != b->pairs_outside) torus = locate_neimark_sacker(d, k, a, 0, 1);
  else if (inside) torus = locate_pair(d, k, HBM_NEIMARK_SACKER, v - 1);
  const bool near = p[1].over_join && fabs(p[1].omega - p[0].omega) <= d->s->edges->located * p[0].omega;
  if (changes != HC_OK && d->n == d->first && near) changes = take_end(d, k, HBM_CONTACT_CHANGE, a, b);
  if (is_one_place(d, k)) {
    if (changes != HC_OK) changes = take_end(d, k, HBM_CONTACT_CHANGE, a, b);
    if (turning != HC_OK) turning = take_end(d, k, HBM_TURNING_POINT, b, b);
    if (doubling != HC_OK) doubling = take_end(d, k, HBM_PERIOD_DOUBLING, b, b);
    torus = HC_OK; /* a pair that jumps across the circle is not on it */
  }
  const hc_status each[] = {changes, turning, doubling, breaking};
  for (int i = 0; i < 4; ++i)
    if (each[i] != HC_OK) return each[i];
  return torus;
}

hc_status hbm_specials(hbm_solver *s, const hbm_curve *c, hbm_special **out, int *n)
{
  detector d = {.s = s, .c = c};
  *n = 0;
  *out = NULL;
  if (c->n == 0) return HC_OK;
  hc_status st = hbm_candidate_new(c->n_coef, &d.x), not_located = HC_OK;
  test_values *v = calloc((size_t)c->n, sizeof *v);
  d.was = calloc((size_t)s->model->n_contacts + 1, sizeof *d.was);
  if (st == HC_OK && (!d.was || !v)) st = HC_NO_MEMORY;
  int evaluated = 0;
  while (st == HC_OK && evaluated < c->n) {
    st = evaluate_at_point(&d, evaluated, &v[evaluated]);
    evaluated += st == HC_OK;
  }
  for (int k = 0; st != HC_NO_MEMORY && k + 1 < evaluated; ++k) {
    const hc_status found = hbm_curve_has_segment(c, k) ? search_segment(&d, k, &v[k]) : HC_OK;
    if (found == HC_NO_MEMORY) st = found;
    if (found != HC_OK) not_located = found; /* the search continues with the other segments */
  }
  /* Merge points that cannot be told apart. */
  int kept = 0;
  for (int i = 0; i < d.n; ++i) {
    const int k = twin_of(d.found, kept, &d.found[i]);
    if (k < 0) d.found[kept++] = d.found[i];
    else if (!take_in(&d.found[k], &d.found[i]))
      memmove(&d.found[k], &d.found[k + 1], (size_t)(--kept - k) * sizeof *d.found);
  }
  *out = malloc(((size_t)kept + 1) * sizeof **out);
  if (*out) *n = kept;
  else st = HC_NO_MEMORY;
  for (int i = 0; i < *n; ++i) (*out)[i] = d.found[i].special;
  hbm_curve_free(&d.near.ends);
  free(d.x.X);
  free(d.was);
  free(d.found);
  free(v);
  return st != HC_OK ? st : not_located;
}
