/* special_points.c - see special_points.h. Test functions are evaluated at every point of the curve; where one changes
 * between two points, the change is located on the segment between them. d omega along the tangent (turning point) and
 * the product of 1 + multiplier (period doubling) are smooth functions of sigma: their roots are found by
 * interpolation. The contact pattern is not: its change is bisected, and the rest of the segment searched for the
 * next. */
#include "hbm/special_points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hbm/hbm_solver_impl.h"
#include "hbm/segment_solutions.h"
#include "numerics/roots.h"

/* A segment spans a fraction of the sweep, so this part of it is far less than the 1e-9 of omega that
 * special_points.h promises. */
static const double SIGMA_TOLERANCE = 1e-11;
enum { MAX_CONTACT_CHANGES = 64 /* on one segment */ };

/* The test functions at a point. */
typedef struct test_values {
  double d_omega, flip;
  contact_regime regime; /* regime and number of transitions: the contact pattern */
  int transitions;
} test_values;

typedef struct detector {
  hbm_solver *s;
  const hbm_curve *c;
  hbm_candidate x; /* the solution on a segment that was evaluated last */
  int cap, n;      /* of out */
  int first;       /* index in out of the first special point of the current segment */
  double *sigma;   /* [cap] where on its segment each lies */
  hbm_special *out;
} detector;

static hc_status evaluate_tests(detector *d, double omega, double d_omega, const double *X, test_values *v)
{
  const contact_forces *orbit;
  contact_report report;
  hbm_stability stability;
  hc_status st = hbm_located_orbit(d->s, X, &orbit, &report);
  if (st == HC_OK) st = monodromy_stability(d->s->monodromy, d->s->model, orbit, omega, &stability);
  if (st == HC_OK) *v = (test_values){d_omega, stability.flip, report.regime, report.transitions};
  return st;
}

static hc_status evaluate_at_point(detector *d, int k, test_values *v)
{
  const hbm_point *p = &d->c->points[k];
  return evaluate_tests(d, p->omega, p->d_omega, hbm_curve_X(d->c, k), v);
}

static bool same_pattern(const test_values *a, const test_values *b)
{
  return a->regime == b->regime && a->transitions == b->transitions;
}

/* The solution in d->x, at sigma, into out, behind those of this segment that come before it. */
static hc_status insert_special(detector *d, double sigma, hbm_special_kind kind, contact_regime before,
                                contact_regime after)
{
  hbm_measures m;
  hc_status st = hbm_measure(d->s, d->x.X, &m);
  if (st != HC_OK) return st;
  if (d->n++ >= d->cap) return HC_OK;
  int i = d->n - 1;
  for (; i > d->first && d->sigma[i - 1] > sigma; --i) {
    d->out[i] = d->out[i - 1];
    d->sigma[i] = d->sigma[i - 1];
  }
  d->out[i] = (hbm_special){kind, d->x.point.omega, m.amplitude, d->x.point.branch, before, after};
  d->sigma[i] = sigma;
  return HC_OK;
}

/* A search along segment k. */
typedef struct segment_search {
  detector *d;
  int k;
  hbm_special_kind kind;     /* of locate_root */
  const test_values *before; /* of locate_contact_changes: the pattern that is left */
  double sigma;              /* where the search was last, NaN at first */
  test_values here;          /* the test functions there */
} segment_search;

static hc_status evaluate_on_segment(segment_search *s, double sigma)
{
  detector *d = s->d;
  s->sigma = sigma;
  hc_status st = hbm_segment_point(d->s, d->c, s->k, sigma, &d->x);
  return st == HC_OK ? evaluate_tests(d, d->x.point.omega, d->x.point.d_omega, d->x.X, &s->here) : st;
}

static hc_status smooth_test_at(void *self, double sigma, double *value)
{
  segment_search *s = self;
  hc_status st = evaluate_on_segment(s, sigma);
  *value = s->kind == HBM_TURNING_POINT ? s->here.d_omega : s->here.flip;
  return st;
}

static hc_status pattern_differs_at(void *self, double sigma, bool *differs)
{
  segment_search *s = self;
  hc_status st = evaluate_on_segment(s, sigma);
  *differs = !same_pattern(&s->here, s->before);
  return st;
}

/* d->x and s->here at sigma, which need not be where the search was last. */
static hc_status return_to(segment_search *s, double sigma)
{
  return s->sigma == sigma ? HC_OK : evaluate_on_segment(s, sigma);
}

/* A sign change of a smooth test function on segment k, from f0 at its start to f1 at its end. */
static hc_status locate_root(detector *d, int k, hbm_special_kind kind, double f0, double f1)
{
  segment_search s = {.d = d, .k = k, .kind = kind, .sigma = NAN};
  root_point root;
  hc_status st = root_between(smooth_test_at, &s, 0, f0, 1, f1, SIGMA_TOLERANCE, &root);
  if (st == HC_OK) st = return_to(&s, root.x);
  if (st != HC_OK) return st;
  /* a turning point belongs to the branch that it ends */
  if (kind == HBM_TURNING_POINT) d->x.point.branch = d->c->points[k].branch;
  return insert_special(d, root.x, kind, s.here.regime, s.here.regime);
}

/* Every change of the contact pattern on segment k, from `before` at its start to `end` at its end. */
static hc_status locate_contact_changes(detector *d, int k, test_values before, const test_values *end)
{
  double from = 0;
  for (int i = 0; i < MAX_CONTACT_CHANGES && from < 1 && !same_pattern(&before, end); ++i) {
    segment_search s = {.d = d, .k = k, .before = &before, .sigma = NAN};
    root_point change;
    hc_status st = root_change(pattern_differs_at, &s, from, 1, SIGMA_TOLERANCE, &change);
    if (st == HC_OK) st = return_to(&s, change.x);
    if (st != HC_OK) return st;
    test_values after = change.x < 1 ? s.here : *end;
    st = insert_special(d, change.x, HBM_CONTACT_CHANGE, before.regime, after.regime);
    if (st != HC_OK) return st;
    before = after;
    from = change.x;
  }
  return HC_OK;
}

static hc_status search_segment(detector *d, int k, const test_values *a, const test_values *b)
{
  hc_status changes = HC_OK, turning = HC_OK, doubling = HC_OK;
  d->first = d->n;
  if (!same_pattern(a, b)) changes = locate_contact_changes(d, k, *a, b);
  if ((a->d_omega > 0) != (b->d_omega > 0)) turning = locate_root(d, k, HBM_TURNING_POINT, a->d_omega, b->d_omega);
  if ((a->flip > 0) != (b->flip > 0)) doubling = locate_root(d, k, HBM_PERIOD_DOUBLING, a->flip, b->flip);
  return changes != HC_OK ? changes : turning != HC_OK ? turning : doubling;
}

hc_status hbm_specials(hbm_solver *s, const hbm_curve *c, int cap, hbm_special *out, int *n)
{
  detector d = {.s = s, .c = c, .cap = cap, .out = out};
  test_values before = {0}, here = {0};
  *n = 0;
  if (c->n == 0) return HC_OK;
  d.sigma = malloc((size_t)(cap > 0 ? cap : 1) * sizeof *d.sigma);
  hc_status st = d.sigma ? hbm_candidate_new(c->n_coef, &d.x) : HC_NO_MEMORY, not_located = HC_OK;
  if (st == HC_OK) st = evaluate_at_point(&d, 0, &before);
  for (int k = 0; st == HC_OK && k + 1 < c->n; ++k) {
    st = evaluate_at_point(&d, k + 1, &here);
    hc_status found = st == HC_OK ? search_segment(&d, k, &before, &here) : st;
    if (found != HC_OK) not_located = found; /* the search goes on: the others are still to be found */
    before = here;
  }
  free(d.x.X);
  free(d.sigma);
  *n = d.n;
  return st != HC_OK ? st : not_located;
}
