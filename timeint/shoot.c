/* shoot.c - see shoot.h. Newton itself is numerics/newton.h; here is the map, evaluated once a point. */
#include "timeint/shoot.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>

#include "numerics/floquet.h"
#include "numerics/newton.h"
#include "numerics/sundials_compat.h"
#include "timeint/internal.h"

enum {
  MAX_N = SCALED_MAX_STATES,
  NEWTON_ITERATIONS = 12,
  ANDERSON_ITERATIONS = 100,
  ANDERSON_DEPTH = 4,
  LAST_STEPS = 4
};

struct shoot { /* from shoot_new, to shoot_free */
  timeint *ti;
  int n, k;
  const hc_monitor *monitor;
  double z[MAX_N], f[MAX_N];         /* the last point, and F^k of it */
  double phi[MAX_N * MAX_N];         /* [n][n] column by column, dF^k/dz there */
  double start[MAX_N], first[MAX_N]; /* where the solve began, and F^k of that */
  bool known, begun;                 /* z, f, phi hold; start, first hold */
  newton *newton;
  floquet *floquet;
  SUNContext ctx; /* of what follows */
  N_Vector u, ones;
  void *kin; /* Anderson's */
  hc_status refusal;
};

static double norm(int n, const double *a)
{
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += a[i] * a[i];
  return sqrt(sum);
}

static double apart(int n, const double *a, const double *b)
{
  double d[MAX_N];
  for (int i = 0; i < n; ++i) d[i] = a[i] - b[i];
  return norm(n, d);
}

/* c = a b */
static void multiply(int n, const double *a, const double *b, double *c)
{
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int q = 0; q < n; ++q) sum += a[i + q * n] * b[q + j * n];
      c[i + j * n] = sum;
    }
}

/* k periods from s->f on, with their monodromy matrix. */
static hc_status run_periods(shoot *s)
{
  double one[MAX_N * MAX_N], before[MAX_N * MAX_N];
  const size_t bytes = sizeof *one * (size_t)(s->n * s->n);
  for (int i = 0; i < s->k; ++i) {
    if (s->ti->periods >= s->ti->how.max_periods - s->k) return HC_NOT_SETTLED; /* k are kept for the report */
    if (!hc_monitor_tick(s->monitor, -1)) return HC_INTERRUPTED;
    hc_status st = integrate_monodromy(s->ti->in, &s->ti->scaled, s->f, i == 0 ? s->phi : one);
    if (st != HC_OK) return st;
    ++s->ti->periods;
    if (i == 0) continue;
    memcpy(before, s->phi, bytes);
    multiply(s->n, one, before, s->phi);
  }
  return HC_OK;
}

/* F^k and its Jacobian at z: integrated only if z is not the last point asked. */
static hc_status evaluate(shoot *s, const double *z)
{
  const size_t bytes = sizeof *z * (size_t)s->n;
  if (s->known && memcmp(s->z, z, bytes) == 0) return HC_OK;
  memcpy(s->z, z, bytes);
  memcpy(s->f, z, bytes);
  hc_status st = run_periods(s);
  s->known = st == HC_OK;
  if (s->known && !s->begun) {
    memcpy(s->start, z, bytes);
    memcpy(s->first, s->f, bytes);
    s->begun = true;
  }
  return st;
}

/* Does slider i - SCALED_W repeat itself wherever it is? */
static bool is_free(const shoot *s, int i)
{
  /* cppcheck-suppress arrayIndexOutOfBoundsCond; it takes SCALED_W, 2, for the number of states */
  if (i < SCALED_W || s->f[i] != s->z[i]) return false;
  for (int j = 0; j < s->n; ++j)
    if (s->phi[i + j * s->n] != (i == j)) return false;
  return true;
}

static hc_status residual(void *self, const double *z, double *r)
{
  shoot *s = self;
  hc_status st = evaluate(s, z);
  for (int i = 0; i < s->n && st == HC_OK; ++i) r[i] = z[i] - s->f[i];
  return st;
}

static hc_status jacobian(void *self, const double *z, double *jac)
{
  shoot *s = self;
  hc_status st = evaluate(s, z);
  if (st != HC_OK) return st;
  for (int i = 0; i < s->n; ++i) {
    bool stays = is_free(s, i);
    for (int j = 0; j < s->n; ++j) jac[i + j * s->n] = (i == j) - (stays ? 0 : s->phi[i + j * s->n]);
  }
  return HC_OK;
}

/* Anderson's map u -> F^k(u). Out of memory is told as a fixed point, at which KINSOL ends: SUNDIALS 7 crashes where it
 * has no memory to tell of a failure (room.h). */
static int map(N_Vector u, N_Vector f, void *self)
{
  shoot *s = self;
  if (s->refusal != HC_NO_MEMORY) s->refusal = evaluate(s, NV_DATA_S(u));
  if (s->refusal == HC_NO_MEMORY) {
    memcpy(NV_DATA_S(f), NV_DATA_S(u), sizeof(double) * (size_t)s->n);
    return 0;
  }
  memcpy(NV_DATA_S(f), s->f, sizeof(double) * (size_t)s->n);
  return s->refusal == HC_OK ? 0 : 1;
}

static hc_status make_anderson(shoot *s)
{
  if (hc_sundials_context(&s->ctx)) return HC_NO_MEMORY;
  s->u = N_VNew_Serial(s->n, s->ctx);
  s->ones = N_VNew_Serial(s->n, s->ctx);
  s->kin = s->u && s->ones ? KINCreate(s->ctx) : NULL;
  if (!s->kin || !hc_room_for(0)) return HC_NO_MEMORY;
  N_VConst(1, s->ones);
  int bad = HC_KINSOL_QUIET(s->kin);
  bad |= KINSetUserData(s->kin, s);
  bad |= KINSetNumMaxIters(s->kin, ANDERSON_ITERATIONS);
  bad |= KINSetMAA(s->kin, ANDERSON_DEPTH < s->n ? ANDERSON_DEPTH : s->n); /* before KINInit, which makes room for it */
  bad |= KINInit(s->kin, map, s->u);
  return bad ? HC_NO_MEMORY : HC_OK;
}

hc_status shoot_new(timeint *ti, shoot **out)
{
  *out = NULL;
  shoot *s = calloc(1, sizeof *s); /* zeroed, so free works half-built */
  if (!s) return HC_NO_MEMORY;
  s->ti = ti;
  s->n = SCALED_W + ti->model->n_contacts;
  const newton_problem problem = {.n = s->n, .self = s, .residual = residual, .jacobian = jacobian};
  hc_status st = newton_new(&problem, &s->newton);
  if (st == HC_OK) st = floquet_new(s->n, &s->floquet);
  if (st == HC_OK) st = make_anderson(s);
  if (st == HC_OK) {
    *out = s;
    return HC_OK;
  }
  shoot_free(s);
  return st;
}

void shoot_free(shoot *s)
{
  if (!s) return;
  newton_free(s->newton);
  floquet_free(s->floquet);
  if (s->kin) KINFree(&s->kin);
  if (s->u) N_VDestroy(s->u);
  if (s->ones) N_VDestroy(s->ones);
  if (s->ctx) SUNContext_Free(&s->ctx);
  free(s);
}

static void begin(shoot *s, int k, const hc_monitor *monitor)
{
  s->k = k;
  s->monitor = monitor;
  s->known = s->begun = false;
}

/* What k periods scatter by: up to 250 times CVODE's tolerance with the regularised law (timeint.c), 400 seen next
 * to a fold (r2 at 708.5), and the rounding of some thousand steps. */
static double scatter(const shoot *s)
{
  const double of_steps = s->ti->how.law == TRANSIENT_LAW_EXACT ? 50 : 1000;
  return s->k * fmax(of_steps * s->ti->tolerance, 2e4 * DBL_EPSILON);
}

/* A residual r is an error of about r/(1 - rho): a tenth of the goal times that, but no less than what periods
 * scatter by. Newton's last step goes below; what is left is judged by finish(). */
static double small_residual(const shoot *s, double goal)
{
  return fmax(0.1 * goal * (1 - fmin(s->ti->contraction, 1)), scatter(s));
}

/* |F^k(z0) - z* - Phi (z0 - z*)| / |z0 - z*|, z* = z. */
static double nonlinear_part(const shoot *s, const double *z)
{
  const int n = s->n;
  double e[MAX_N], left[MAX_N];
  for (int i = 0; i < n; ++i) e[i] = s->start[i] - z[i];
  for (int i = 0; i < n; ++i) {
    left[i] = s->first[i] - s->f[i]; /* F(z*) is z*, and nearer to F(z0)'s own errors */
    for (int j = 0; j < n; ++j) left[i] -= s->phi[i + j * n] * e[j];
  }
  const double size = norm(n, e), rounding = 1e3 * s->ti->tolerance;
  return size > rounding ? fmax(norm(n, left) - rounding, 0) / size : 0;
}

static hc_status find_multiplier(shoot *s, shoot_report *r)
{
  double complex lambda[MAX_N];
  int active[MAX_N], m = 0;
  r->free_sliders = 0;
  for (int i = 0; i < s->n; ++i) {
    if (!is_free(s, i)) active[m++] = i;
    else if (s->ti->scaled.contact[i - SCALED_W].law.slides) ++r->free_sliders;
  }
  hc_status st = floquet_multipliers(s->floquet, s->phi, 1, s->n, m, active, lambda);
  r->multiplier = st == HC_OK ? floquet_largest(m, lambda) : NAN;
  return st;
}

/* Newton's step from z into step[n], and its length. */
static hc_status next_step(shoot *s, const double *z, double *step, double *length)
{
  hc_status st = newton_factor_at(s->newton, z);
  if (st != HC_OK) return st;
  for (int i = 0; i < s->n; ++i) step[i] = z[i] - s->f[i];
  st = newton_backsolve(s->newton, step);
  *length = norm(s->n, step);
  return st;
}

/* No orbit can be found to better than this: the scatter of periods, seen through (I - Phi)^-1 (Frobenius norm,
 * factors of the last step). */
static double attainable(shoot *s)
{
  double sum = 0, column[MAX_N];
  for (int j = 0; j < s->n; ++j) {
    for (int i = 0; i < s->n; ++i) column[i] = i == j;
    if (newton_backsolve(s->newton, column) != HC_OK) return INFINITY;
    sum += norm(s->n, column) * norm(s->n, column);
  }
  return sqrt(sum) * scatter(s);
}

/* From z, next to the orbit, as near to it as the goal asks or the scatter of periods allows; then what there is to
 * say of it. */
static hc_status finish(shoot *s, double *z, double goal, shoot_report *r)
{
  double step[MAX_N], best[MAX_N] = {0};
  hc_status st = HC_OK;
  for (int tries = 0; tries < LAST_STEPS && st == HC_OK; ++tries) {
    double length;
    if ((st = next_step(s, z, step, &length)) != HC_OK) break;
    if (length < r->distance) memcpy(best, z, sizeof best), r->distance = length;
    if (r->distance <= goal) break;
    for (int i = 0; i < s->n; ++i) z[i] -= step[i];
  }
  if (st == HC_OK && r->distance < INFINITY) st = evaluate(s, best);
  if (st != HC_OK || !(r->distance < INFINITY)) return st != HC_OK ? st : HC_NOT_CONVERGED;
  r->moved = apart(s->n, s->start, best);
  r->nonlinear = nonlinear_part(s, best);
  if ((st = find_multiplier(s, r)) != HC_OK) return st;
  memcpy(s->ti->y, best, sizeof *best * (size_t)s->n);
  return r->distance <= fmax(goal, attainable(s)) ? HC_OK : HC_NOT_CONVERGED;
}

hc_status shoot_newton(shoot *s, int k, double reach, double goal, const hc_monitor *monitor, shoot_report *report)
{
  double z[MAX_N], ones[MAX_N], before[MAX_N];
  newton_report iterations;
  memcpy(before, s->ti->y, sizeof before);
  memcpy(z, before, sizeof z);
  for (int i = 0; i < s->n; ++i) ones[i] = 1;
  begin(s, k, monitor);
  const newton_options options = {.z_scale = ones,
                                  .r_scale = ones,
                                  .tolerance = small_residual(s, goal),
                                  .max_step = reach,
                                  .max_iterations = NEWTON_ITERATIONS};
  *report = (shoot_report){.distance = INFINITY, .moved = INFINITY, .nonlinear = INFINITY, .multiplier = NAN};
  hc_status st = newton_solve(s->newton, z, &options, &iterations);
  if (st == HC_OK) st = finish(s, z, goal, report);
  if (st != HC_OK) memcpy(s->ti->y, before, sizeof before);
  return st;
}

hc_status shoot_anderson(shoot *s, int k, double goal, const hc_monitor *monitor, shoot_report *report)
{
  double before[MAX_N], z[MAX_N];
  memcpy(before, s->ti->y, sizeof before);
  begin(s, k, monitor);
  *report = (shoot_report){.distance = INFINITY, .moved = INFINITY, .nonlinear = INFINITY, .multiplier = NAN};
  s->refusal = HC_OK;
  if (KINSetFuncNormTol(s->kin, small_residual(s, goal)) != KIN_SUCCESS) return HC_BAD_INPUT;
  memcpy(NV_DATA_S(s->u), before, sizeof *before * (size_t)s->n);
  int flag = KINSol(s->kin, s->u, KIN_FP, s->ones, s->ones);
  memcpy(z, NV_DATA_S(s->u), sizeof *z * (size_t)s->n);
  if (s->refusal != HC_OK) return s->refusal;
  if (flag == KIN_MEM_FAIL) return HC_NO_MEMORY;
  hc_status st = finish(s, z, goal, report); /* whatever KINSOL says: the answer is judged by us */
  if (st != HC_OK) memcpy(s->ti->y, before, sizeof before);
  return st;
}

void shoot_direction(const shoot *s, double *z)
{
  double next[MAX_N];
  for (int i = 0; i < s->n; ++i) z[i] = 1 / sqrt(s->n);
  for (int step = 0; step < 64; ++step) {
    for (int i = 0; i < s->n; ++i) {
      next[i] = 0;
      for (int j = 0; j < s->n; ++j) next[i] += (is_free(s, i) ? 0 : s->phi[i + j * s->n]) * z[j];
    }
    double size = norm(s->n, next);
    if (!(size > 0)) return;
    for (int i = 0; i < s->n; ++i) z[i] = next[i] / size;
  }
}
