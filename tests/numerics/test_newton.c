/* test_newton.c - KINSOL behind newton.h: iterates against Heron's, refusals, stalls, singular matrices; nothing
 * hangs, nothing lies. Each problem counts its calls and fails the test when they run away: a loop inside KINSOL
 * would otherwise only meet the watchdog. */
#include <kinsol/kinsol.h>

#include "numerics/newton.h"
#include "tests/hbm/scenes.h"
#include "tests/wrap.h"

enum { MAX_CALLS = 5000 };

typedef struct probe probe;
typedef hc_status equation(const probe *p, double z, double *r, double *slope);
#define EQUATION(name, value, derivative)                                                                              \
  static hc_status name(const probe *p, double z, double *r, double *slope)                                            \
  {                                                                                                                    \
    (void)p;                                                                                                           \
    *slope = (derivative);                                                                                             \
    *r = (value);                                                                                                      \
    return HC_OK;                                                                                                      \
  }

struct probe {
  int residuals, jacobians;
  double history[64][2]; /* z at each Jacobian */
  double limit;          /* some problems refuse |z_0| beyond this */
  equation *f;           /* of those in one unknown */
};

static const double ones[2] = {1, 1};
static const newton_options plain = {ones, ones, 1e-12, 100, 50, false};

static void count(probe *p)
{
  if (++p->residuals > MAX_CALLS) fail_msg("%d residuals: KINSOL is in a loop", p->residuals);
}

static void remember(probe *p, const double *z)
{
  if (p->jacobians < 64) memcpy(p->history[p->jacobians], z, 2 * sizeof(double));
  ++p->jacobians;
}

/* r = A (x^2 - 2, y^2 - 3), A = [3 1; 1 2]: Newton does not see A, and each component is Heron's x' = (x + 2/x)/2. */
static hc_status heron_residual(void *self, const double *z, double *r)
{
  count(self);
  double f = z[0] * z[0] - 2, g = z[1] * z[1] - 3;
  r[0] = 3 * f + g;
  r[1] = f + 2 * g;
  return HC_OK;
}

static hc_status heron_jacobian(void *self, const double *z, double *jac)
{
  remember(self, z);
  jac[0] = 6 * z[0];
  jac[1] = 2 * z[0];
  jac[2] = 2 * z[1];
  jac[3] = 4 * z[1];
  return HC_OK;
}

static newton *make(probe *p, int n, hc_status (*residual)(void *, const double *, double *),
                    hc_status (*jacobian)(void *, const double *, double *))
{
  *p = (probe){.limit = INFINITY};
  newton_problem problem = {n, p, residual, jacobian};
  CHECK_MADE(newton, nw, newton_new(&problem, &nw));
  return nw;
}

static hc_status scalar_residual(void *self, const double *z, double *r)
{
  probe *p = self;
  double slope;
  count(p);
  return p->f(p, *z, r, &slope);
}

static hc_status scalar_jacobian(void *self, const double *z, double *jac)
{
  const double pair[2] = {z[0], 0};
  double r;
  probe *p = self;
  remember(p, pair);
  p->f(p, *z, &r, jac);
  return HC_OK;
}

static newton *make_scalar(probe *p, equation *f)
{
  newton *nw = make(p, 1, scalar_residual, scalar_jacobian);
  p->f = f;
  return nw;
}

/* Full Newton evaluates the Jacobian at every iterate: these must be Heron's, to the rounding of a 2 x 2 solve with
 * condition number below 20 (z ~ 1..2) per step, 40 eps; Heron halves errors at least, so they add to twice that.
 * From (1, 1) the errors go 4e-1, 9e-2, 2e-3, 2e-6, 2e-12, rounding: five iterations reach 1e-12 |r|, one more
 * polishes. */
static void quadratic_like_heron(CHECK_STATE)
{
  probe p;
  newton *nw = make(&p, 2, heron_residual, heron_jacobian);
  double z[2] = {1, 1}, x = 1, y = 1;
  CHECK_FILLED(newton_report, report, newton_solve(nw, z, &plain, &report));
  for (int i = 0; i < p.jacobians && i < 64; ++i) {
    CHECK_NEAR(p.history[i][0], x, 80 * DBL_EPSILON * x, "iterate %d", i);
    CHECK_NEAR(p.history[i][1], y, 80 * DBL_EPSILON * y, "iterate %d", i);
    x = (x + 2 / x) / 2;
    y = (y + 3 / y) / 2;
  }
  CHECK_NEAR(z[0], sqrt(2), 80 * DBL_EPSILON, "root");
  CHECK_NEAR(z[1], sqrt(3), 80 * DBL_EPSILON, "root");
  CHECK_LE(report.residual, plain.tolerance, "residual");
  assert_in_range(report.iterations, 5, 7);
  assert_in_range(p.jacobians, report.iterations, report.iterations + 1);
  newton_free(nw);
}

/* Weights: the same system in other units takes the same path. Powers of two, so that nothing rounds differently. */
static void weights_are_units(CHECK_STATE)
{
  probe p;
  newton *nw = make(&p, 2, heron_residual, heron_jacobian);
  double z[2] = {1.5, 1.5}, z_scale[2] = {1024, 1024}, r_scale[2] = {1 / 4096.0, 1 / 4096.0};
  newton_options loose = {z_scale, r_scale, 1e-4, 1e6,
                          50,      false}; /* |r| <= 0.41: one Heron step from 1.5 gives 2e-2; then
                                                               one polishing step */
  CHECK_FILLED(newton_report, report, newton_solve(nw, z, &loose, &report));
  CHECK_LE(report.residual, 1e-4, "judged with its weight");
  CHECK_LE(fabs(z[0] - sqrt(2)), 3e-6, "start 8.6e-2 off, Heron: e'= e^2/(2x) = 2.5e-3, then 2.2e-6");
  newton_options strict = {z_scale, r_scale, 1e-15, 1e6, 50, false}; /* |r| <= 4e-12 */
  z[0] = z[1] = 1.5;
  assert_int_equal(newton_solve(nw, z, &strict, &report), HC_OK);
  CHECK_NEAR(z[0], sqrt(2), 80 * DBL_EPSILON, "root");
  newton_free(nw);
}

/* A Jacobian that is kept: from next to the root, e' = e (x0 - x)/x0 = 0.01 e, one is enough, and steps end at
 * rounding; from (1, 1), where the first step leaves 0.25 of f and 0.5 of g, it is renewed. */
static void a_jacobian_is_kept_while_it_serves(CHECK_STATE)
{
  probe p;
  newton *nw = make(&p, 2, heron_residual, heron_jacobian);
  newton_options kept = plain;
  double z[2] = {1.4, 1.72};
  kept.keeps = 0.1;
  CHECK_FILLED(newton_report, report, newton_solve(nw, z, &kept, &report));
  assert_int_equal(p.jacobians, 1);
  assert_in_range(report.iterations, 5, 10);
  for (int from_far = 0; from_far < 2; ++from_far) {
    CHECK_NEAR(z[0], sqrt(2), 80 * DBL_EPSILON, "root");
    CHECK_NEAR(z[1], sqrt(3), 80 * DBL_EPSILON, "root");
    CHECK_LE(report.residual, 80 * DBL_EPSILON, "residual");
    if (from_far) break;
    p.jacobians = 0;
    z[0] = z[1] = 1;
    assert_int_equal(newton_solve(nw, z, &kept, &report), HC_OK);
    assert_in_range(p.jacobians, 2, 4);
  }
  p.jacobians = 0, z[0] = 1.4, z[1] = 1.72;
  kept.ends_fresh = true;
  assert_int_equal(newton_solve(nw, z, &kept, &report), HC_OK);
  assert_int_equal(p.jacobians, 2);
  double image[2] = {6 * sqrt(2) + 2 * sqrt(3), 2 * sqrt(2) + 4 * sqrt(3)}; /* J (1, 1) at the root */
  assert_int_equal(newton_backsolve(nw, image), HC_OK);
  CHECK_NEAR(hypot(image[0] - 1, image[1] - 1), 0, 1e-9, "factors");
  p.jacobians = 0;
  z[0] = z[1] = 1;
  assert_int_equal(newton_solve(nw, z, &plain, &report), HC_OK); /* and no other solve keeps one */
  assert_in_range(p.jacobians, report.iterations, report.iterations + 1);
  newton_free(nw);
}

/* Without its last step a solve takes one Jacobian less, and leaves what the tolerance allows. */
static void unpolished_is_as_it_converged(CHECK_STATE)
{
  probe p;
  newton *nw = make(&p, 2, heron_residual, heron_jacobian);
  newton_options as_it_is = plain;
  double z[2] = {1, 1};
  CHECK_FILLED(newton_report, polished, newton_solve(nw, z, &plain, &polished));
  const int jacobians = p.jacobians;
  as_it_is.unpolished = true;
  as_it_is.tolerance = 1e-4;
  p.jacobians = 0;
  z[0] = z[1] = 1;
  CHECK_FILLED(newton_report, report, newton_solve(nw, z, &as_it_is, &report));
  assert_int_equal(p.jacobians, report.iterations);
  assert_true(p.jacobians < jacobians - 1);
  assert_true(report.residual <= as_it_is.tolerance && report.residual > 100 * polished.residual);
  newton_free(nw);
}

/* dx/db of A (x^2 - 2, y^2 - 3) = b at the root is J^-1; 2 x 2 inverse by hand, condition below 20. */
static void backsolve_is_the_inverse_at_the_end(CHECK_STATE)
{
  probe p;
  newton *nw = make(&p, 2, heron_residual, heron_jacobian);
  double z[2] = {1, 1}, b[2] = {1, -2}, jac[4];
  CHECK_FILLED(newton_report, report, newton_solve(nw, z, &plain, &report));
  assert_int_equal(newton_backsolve(nw, b), HC_OK);
  heron_jacobian(&p, z, jac);
  CHECK_NEAR(jac[0] * b[0] + jac[2] * b[1], 1, 1e-11,
             "polishing may leave the factors of the iterate before: 1e-12 off, times 6");
  CHECK_NEAR(jac[1] * b[0] + jac[3] * b[1], -2, 1e-11, "as above");
  newton_free(nw);
}

/* z + 0.1 z^3 = 1 from 0, where KINSOL's default longest step (1000 |z_0|) would be 0. */
EQUATION(cubic, z + 0.1 * z * z * z - 1, 1 + 0.3 * z * z)

static void starts_from_zero(CHECK_STATE)
{
  probe p;
  newton *nw = make_scalar(&p, cubic);
  double z = 0;
  CHECK_FILLED(newton_report, report, newton_solve(nw, &z, &plain, &report));
  CHECK_NEAR(z + 0.1 * z * z * z, 1, 4 * DBL_EPSILON, "root");
  /* and no step is longer than it may be. With weight 4 and max_step 1 that is 1/4, four steps to 0.92. KINSOL takes
   * max_step < 1 for 1, and left to itself 1000 |z_0|, here 40 */
  static const double four = 4;
  newton_options short_steps = plain;
  short_steps.z_scale = &four;
  short_steps.max_step = 1;
  z = 0.01;
  p.jacobians = 0;
  assert_int_equal(newton_solve(nw, &z, &short_steps, &report), HC_OK);
  for (int i = 1; i < p.jacobians; ++i)
    CHECK_LE(fabs(p.history[i][0] - p.history[i - 1][0]), 0.25 * (1 + 4 * DBL_EPSILON), "step %d", i);
  assert_true(report.iterations >= 4);
  newton_free(nw);
}

/* A root at the start: nothing to do, nothing to spoil. */
static void starts_at_the_root(CHECK_STATE)
{
  probe p;
  newton *nw = make_scalar(&p, cubic);
  double z = 0;
  CHECK_FILLED(newton_report, report, newton_solve(nw, &z, &plain, &report));
  double root = z;
  assert_int_equal(newton_solve(nw, &z, &plain, &report), HC_OK);
  CHECK_NEAR(z, root, 4 * DBL_EPSILON, "root");
  CHECK_LE(report.residual, 4 * DBL_EPSILON, "residual");
  newton_free(nw);
}

/* A solve that fails leaves z as it was given, bit by bit. */
static hc_status fails_untouched(newton *nw, int n, const double *start, const newton_options *opt,
                                 newton_report *report)
{
  double z[2] = {start[0], n > 1 ? start[1] : 0}, before[2];
  memcpy(before, z, sizeof z);
  hc_status st = newton_solve(nw, z, opt, report);
  assert_int_not_equal(st, HC_OK);
  assert_memory_equal(z, before, sizeof z);
  return st;
}

/* x^2 + 1: no root; Newton wanders chaotically, the line search settles at the minimum x = 0, where J = 0. */
EQUATION(no_root, z *z + 1, 2 * z)

static void no_root_is_never_ok(CHECK_STATE)
{
  /* the last has period 2 under Newton */
  static const double starts[] = {3, 0.5, -1, 1e-3, 1e-9, 0, 1e6, 1 / 1.7320508075688772};
  probe p;
  newton *nw = make_scalar(&p, no_root);
  for (size_t i = 0; i < sizeof starts / sizeof *starts; ++i) {
    newton_report report;
    p.residuals = 0;
    hc_status st = fails_untouched(nw, 1, &starts[i], &plain, &report);
    assert_true(st == HC_STALLED || st == HC_NOT_CONVERGED || st == HC_SINGULAR);
    CHECK_LE(1, report.residual, "start %g: x^2 + 1 >= 1 everywhere", starts[i]);
  }
  newton_free(nw);
}

/* atan x = 0 from 3: plain Newton runs away (it does beyond 1.39), the line search does not. */
EQUATION(atan_equation, atan(z), 1 / (1 + z * z))

static void the_line_search_helps_out(CHECK_STATE)
{
  probe p;
  newton *nw = make_scalar(&p, atan_equation);
  double z = 3;
  CHECK_FILLED(newton_report, report, newton_solve(nw, &z, &plain, &report));
  CHECK_LE(fabs(z), plain.tolerance, "root");
  newton_free(nw);
}

/* atan, until a line search has come near its root: from there on only the start is as good as it was. KINSOL then goes
 * back from a step that was too good to be true, and halves its way to it for ever. */
static hc_status forgetful_residual(void *self, const double *z, double *r)
{
  probe *p = self;
  count(p);
  *r = atan(*z);
  if (p->limit < INFINITY && fabs(*r) < 1) *r = 2;
  if (p->jacobians > 0 && fabs(*r) < 0.1) p->limit = 0;
  return HC_OK;
}

static hc_status forgetful_jacobian(void *self, const double *z, double *jac)
{
  remember(self, (double[2]){*z, 0});
  *jac = 1 / (1 + *z * *z);
  return HC_OK;
}

static void a_residual_that_is_another_the_second_time_ends_it(CHECK_STATE)
{
  int ended = 0;
  for (double z0 = 1.5; z0 < 30; z0 *= 1.1) {
    probe p;
    newton *nw = make(&p, 1, forgetful_residual, forgetful_jacobian);
    newton_report report;
    double z = z0;
    assert_int_not_equal(newton_solve(nw, &z, &plain, &report), HC_OK);
    ended += p.residuals > 200;
    newton_free(nw);
  }
  assert_true(ended > 0); /* else none came to that loop */
}

/* |x| + 1: ends in the kink, where no step lowers it. A stall, and said to be one. */
EQUATION(kink, fabs(z) + 1, z < 0 ? -1 : 1)

/* r = (x + y - 1, x + y - 2): every Jacobian is singular, exactly in floating point too. */
static hc_status parallel_residual(void *self, const double *z, double *r)
{
  count(self);
  r[0] = z[0] + z[1] - 1;
  r[1] = z[0] + z[1] - 2;
  return HC_OK;
}

static hc_status parallel_jacobian(void *self, const double *z, double *jac)
{
  (void)self, (void)z;
  for (int i = 0; i < 4; ++i) jac[i] = 1;
  return HC_OK;
}

static void singular_is_said(CHECK_STATE)
{
  probe p;
  newton *nw = make(&p, 2, parallel_residual, parallel_jacobian);
  newton_report report;
  assert_int_equal(fails_untouched(nw, 2, (double[]){0, 0}, &plain, &report), HC_SINGULAR);
  newton_free(nw);
}

/* ln z = -1, |z| <= limit, refused outside: Newton from 5 jumps to -8; from 0.2 it converges to 1/e. */
static hc_status logarithm(const probe *p, double z, double *r, double *slope)
{
  *slope = 1 / z;
  if (!(z > 0 && z <= p->limit)) return HC_NOT_FINITE;
  *r = log(z) + 1;
  return HC_OK;
}

/* The same, but leaving the NaN of log(-8) in r and saying all is well. */
EQUATION(nan_logarithm, log(z) + 1, 1 / z)

static void refusals_are_passed_on(CHECK_STATE)
{
  probe p;
  newton *nw = make_scalar(&p, logarithm);
  double z = 0.2;
  CHECK_FILLED(newton_report, report, newton_solve(nw, &z, &plain, &report));
  CHECK_NEAR(z, exp(-1), 4 * DBL_EPSILON, "root");
  z = 5; /* the full step to -8 is refused, a shorter one is not */
  assert_int_equal(newton_solve(nw, &z, &plain, &report), HC_OK);
  CHECK_NEAR(z, exp(-1), 4 * DBL_EPSILON, "root");
  /* at the start itself: both strategies */
  assert_int_equal(fails_untouched(nw, 1, (double[]){-1}, &plain, &report), HC_NOT_FINITE);
  p.limit = 0.1; /* the root lies beyond: every way to it is refused */
  assert_int_not_equal(fails_untouched(nw, 1, (double[]){0.05}, &plain, &report), HC_OK);
  newton_free(nw);
}

/* Only the start is allowed: each step of both strategies is refused, however short. The solve must return the
 * status of the refusal. */
static hc_status start_only(const probe *p, double z, double *r, double *slope)
{
  (void)p;
  *slope = 1 / z;
  if (z != 1) return HC_NOT_CLOSED;
  *r = 1;
  return HC_OK;
}

/* A NaN that the problem did not refuse must not count as convergence, nor keep the line search in a loop. */
static void nan_is_refused(CHECK_STATE)
{
  probe p;
  newton *nw = make_scalar(&p, nan_logarithm);
  newton_report report;
  assert_int_equal(fails_untouched(nw, 1, (double[]){-1}, &plain, &report), HC_NOT_FINITE); /* NaN at the start */
  p.residuals = 0;
  double z = 5; /* NaN at the first full step: fail or find the root, but neither hang nor answer NaN */
  hc_status st = newton_solve(nw, &z, &plain, &report);
  if (st == HC_OK) CHECK_NEAR(z, exp(-1), 4 * DBL_EPSILON, "root");
  else assert_true(z == 5 && st == HC_NOT_FINITE);
  newton_free(nw);
}

static hc_status nan_slope(const probe *p, double z, double *r, double *slope)
{
  const hc_status st = cubic(p, z, r, slope);
  *slope = NAN;
  return st;
}

static void failures_are_told(CHECK_STATE)
{
  const struct {
    equation *f;
    double start;
    hc_status st;
  } all[] = {{kink, 3, HC_STALLED}, {start_only, 1, HC_NOT_CLOSED}, {nan_slope, 0.5, HC_SINGULAR}};
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    probe p;
    newton_report report;
    newton *nw = make_scalar(&p, all[i].f);
    assert_int_equal(fails_untouched(nw, 1, &all[i].start, &plain, &report), all[i].st);
    if (i == 0) CHECK_NEAR(report.residual, 1, 1e-6, "the residual of the kink");
    newton_free(nw);
  }
}

/* A handle that failed is as good as new. */
static void works_on_after_failures(CHECK_STATE)
{
  probe p;
  newton *nw = make_scalar(&p, logarithm);
  newton_report report;
  for (int i = 0; i < 5; ++i) {
    assert_int_equal(fails_untouched(nw, 1, (double[]){-1}, &plain, &report), HC_NOT_FINITE);
    double z = 0.2;
    assert_int_equal(newton_solve(nw, &z, &plain, &report), HC_OK);
    CHECK_NEAR(z, exp(-1), 4 * DBL_EPSILON, "root");
  }
  newton_free(nw);
  newton_free(NULL);
}

/* Memory gone at the n-th evaluation, of the residual or of the Jacobian: told as such, z as it was, no evaluation
 * after it, and no failure that KINSOL tells of: it would need memory for that. */
typedef struct shortage {
  long calls, last, failed; /* from call `last` on there is none; the first call that noticed */
  bool in_jacobian;
} shortage;

static int last_flag; /* KINSOL's: the linker wraps KINSol */

WRAP(int, KINSol, (void *kin, N_Vector z, int strategy, N_Vector z_scale, N_Vector r_scale))
{
  return last_flag = __real_KINSol(kin, z, strategy, z_scale, r_scale);
}

static bool runs_short(shortage *s, bool in_jacobian)
{
  if (++s->calls < s->last || s->in_jacobian != in_jacobian) return false;
  if (!s->failed) s->failed = s->calls;
  return true;
}

static hc_status short_residual(void *self, const double *z, double *r)
{
  shortage *s = self;
  if (runs_short(s, false)) return HC_NO_MEMORY;
  r[0] = z[0] * z[0] * z[0] - 8;
  return HC_OK;
}

static hc_status short_jacobian(void *self, const double *z, double *jac)
{
  shortage *s = self;
  if (runs_short(s, true)) return HC_NO_MEMORY;
  jac[0] = 3 * z[0] * z[0];
  return HC_OK;
}

static void out_of_memory_ends_it(CHECK_STATE)
{
  for (int in_jacobian = 0; in_jacobian < 2; ++in_jacobian)
    for (long last = 1; last <= 6; ++last) {
      newton_report report;
      shortage s = {.last = last, .in_jacobian = in_jacobian};
      const newton_problem problem = {1, &s, short_residual, short_jacobian};
      double z = 5;
      CHECK_MADE(newton, nw, newton_new(&problem, &nw));
      assert_int_equal(newton_solve(nw, &z, &plain, &report), HC_NO_MEMORY);
      assert_true(z == 5);
      assert_int_equal(s.calls, s.failed);
      assert_true(last_flag >= 0);
      newton_free(nw);
    }
}

CHECK_TESTS("numerics.newton", 60, quadratic_like_heron, weights_are_units, a_jacobian_is_kept_while_it_serves,
            unpolished_is_as_it_converged, backsolve_is_the_inverse_at_the_end, starts_from_zero, starts_at_the_root,
            no_root_is_never_ok, the_line_search_helps_out, a_residual_that_is_another_the_second_time_ends_it,
            singular_is_said, refusals_are_passed_on, nan_is_refused, failures_are_told, works_on_after_failures,
            out_of_memory_ends_it)
