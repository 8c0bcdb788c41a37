/* test_solvers.c - KINSOL and CVODE that fail at their n-th call, with every flag they document and one they do not,
 * or that lie: success with nothing solved, with a wrong or NaN answer, with no step taken. Each ends as an honest
 * status or as a right answer, never as a wrong one, and the handle answers the next question like a new one. The
 * two are wrapped by the linker (--wrap). */
#include <cvodes/cvodes.h>
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>

#include "compare/study/scene_solvers.h"
#include "tests/faults/child.h"
#include "tests/faults/small.h"
#include "tests/wrap.h"

typedef enum {
  RETURN_FLAG /* and do nothing else */,
  SPOIL /* work, then 0.1 % off */,
  SPOIL_NAN,
  STAND_STILL /* the time, too */
} lie;

typedef struct fault { /* of one of the two solvers */
  long at;             /* the call that fails, 0: none */
  bool stays;          /* so do all after it */
  int flag;
  lie how;
  long calls;
} fault;

static fault kin, cv;

static bool strikes(fault *f)
{
  ++f->calls;
  return f->at > 0 && (f->stays ? f->calls >= f->at : f->calls == f->at);
}

static void spoil(N_Vector v, lie how)
{
  double *x = NV_DATA_S(v);
  for (sunindextype i = 0; i < NV_LENGTH_S(v); ++i) x[i] = how == SPOIL_NAN ? NAN : 1.001 * x[i];
}

WRAP(int, KINSol, (void *mem, N_Vector u, int strategy, N_Vector u_scale, N_Vector f_scale))
{
  if (!strikes(&kin)) return __real_KINSol(mem, u, strategy, u_scale, f_scale);
  if (kin.how != RETURN_FLAG) __real_KINSol(mem, u, strategy, u_scale, f_scale);
  if (kin.how != RETURN_FLAG) spoil(u, kin.how);
  return kin.flag;
}

WRAP(int, CVode, (void *mem, sunrealtype to, N_Vector y, sunrealtype *t, int task))
{
  if (!strikes(&cv)) return __real_CVode(mem, to, y, t, task);
  if (cv.how == RETURN_FLAG || cv.how == STAND_STILL) return cv.flag;
  __real_CVode(mem, to, y, t, task);
  spoil(y, cv.how);
  return cv.flag;
}

static void doing(const char *what, const fault *f)
{
  snprintf(small_doing, sizeof small_doing, "%s: call %ld%s, flag %d, lie %d\n", what, f->at,
           f->stays ? " and all after it" : "", f->flag, (int)f->how);
}

/* ---- harmonic balance ---- */

static const char *const exactly[] = {"transient.law=exact", NULL}, *const smoothly[] = {
                                                                        "transient.regularisation=0.01",
                                                                        "transient.tolerance=1e-4", NULL};

/* Every point of the curve solves the equations: a new solver started there stays there. Residuals are within 10
 * tolerances, 1e-9 of the forces; the Jacobian's condition is about 10 in this scene: 1e-7 leaves a factor of 10. */
static void check_curve(const hbm_curve *c)
{
  enum { MOST = 7 };
  scene sc = small_scene(NULL);
  CHECK_MADE(hbm_solver, fresh, scene_hbm_solver(&sc, &fresh));
  for (int k = 0; k < c->n; ++k) {
    double X[MOST], size = 0, moved = 0;
    assert_true(c->n_coef == MOST);
    memcpy(X, c->X + (size_t)k * MOST, sizeof X);
    CHECK_FILLED(hbm_point, point, hbm_solve(fresh, c->points[k].omega, X, &point));
    for (int i = 0; i < MOST; ++i) size += fabs(X[i]), moved += fabs(X[i] - c->X[(size_t)k * MOST + (size_t)i]);
    CHECK_LE(moved, 1e-7 * size, "%s point %d", small_doing, k);
  }
  hbm_solver_free(fresh);
}

static void solved_at_6_5(hbm_solver *s, double X[7])
{
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, 6.5, NULL, X, &point));
}

/* A trace with that fault; then the same solver without it. Answers the status, and what it found into *n. */
static hc_status trace_with(fault f, int *n)
{
  scene sc = small_scene(NULL);
  hbm_curve curve = {0};
  double X[7], Y[7];
  doing("hbm_trace", &f);
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
  kin = f;
  hc_status st = hbm_trace(s, 6, 7, NULL, &curve);
  long calls = kin.calls;
  kin = (fault){0};
  check_curve(&curve);
  if (st == HC_OK) CHECK_NEAR(curve.points[curve.n - 1].omega, 7, 1e-12, "%s", small_doing);
  CHECK_MADE(hbm_solver, fresh, scene_hbm_solver(&sc, &fresh));
  solved_at_6_5(s, X);
  solved_at_6_5(fresh, Y);
  assert_memory_equal(X, Y, sizeof X);
  *n = curve.n;
  hbm_curve_free(&curve);
  hbm_solver_free(fresh);
  hbm_solver_free(s);
  assert_true(calls >= f.at); /* it struck */
  kin.calls = calls;
  return st;
}

static void kinsol_fails(CHECK_STATE)
{
  int n, points;
  assert_int_equal(trace_with((fault){0}, &points), HC_OK);
  const long at[] = {1, 2, kin.calls};
  for (int i = 0; i < 3; ++i)
    for (int flag = -20; flag <= KIN_STEP_LT_STPTOL; ++flag)
      for (int stays = 0; stays < 2; ++stays) {
        hc_status st = trace_with((fault){at[i], stays, flag, RETURN_FLAG, 0}, &n);
        /* a guess that is good enough, and our own last Newton step, may do without KINSOL: check_curve has seen
         * that they did */
        bool residual_decides =
            flag == KIN_MAXITER_REACHED || flag == KIN_LSETUP_FAIL || flag == KIN_LINESEARCH_NONCONV || flag >= 0;
        if (stays && st == HC_OK && !residual_decides) fail_msg("%s ended well", small_doing);
        if (stays && flag == KIN_MEM_FAIL && st != HC_NO_MEMORY) fail_msg("%s: %s", small_doing, hc_status_text(st));
        if (!stays && flag != KIN_MEM_FAIL && st != HC_OK)
          fail_msg("%s: one failure is to be survived: %s", small_doing, hc_status_text(st));
      }
}

static void kinsol_lies(CHECK_STATE)
{
  int n;
  static const int flags[] = {KIN_SUCCESS, KIN_INITIAL_GUESS_OK, KIN_STEP_LT_STPTOL, KIN_WARNING, -999};
  assert_int_equal(trace_with((fault){0}, &n), HC_OK);
  for (long at = 1, most = kin.calls; at <= most; at += 3)
    for (int k = 0; k < 5; ++k)
      for (lie how = SPOIL; how <= SPOIL_NAN; ++how) {
        trace_with((fault){at, false, flags[k], how, 0}, &n); /* right or refused: trace_with sees to it */
        hc_status st = trace_with((fault){at, true, flags[k], how, 0}, &n);
        if (st == HC_OK) fail_msg("%s ended well", small_doing);
      }
}

/* ---- time integration ---- */

/* For the two laws, 0 regularised, 1 exact: what is right, and a start next to the orbit: from rest it would take a
 * hundred periods. */
static double right_amplitude[2];
static scene_state near_orbit[2];

/* The steady state with these faults, in a handle that is asked again without. */
static hc_status steady_with(int law, fault f, fault *which, timeint_result *r)
{
  scene sc = small_scene(law ? exactly : smoothly);
  CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
  scene_state y = near_orbit[law], start = y;
  *which = f;
  hc_status st = timeint_steady(ti, 6.5, y.all, NULL, r);
  const long calls = which->calls;
  *which = (fault){0};
  CHECK_FILLED(timeint_result, again, timeint_steady(ti, 6.5, start.all, NULL, &again));
  /* transient.tolerance, of the amplitude, is the distance to the orbit that a settled motion may have, on either
   * side */
  CHECK_NEAR(again.amplitude, right_amplitude[law], st == HC_OK ? 2 * sc.transient.tolerance * right_amplitude[law] : 0,
             "%s asked again", small_doing);
  if (st == HC_OK)
    CHECK_NEAR(r->amplitude, right_amplitude[law], 2 * sc.transient.tolerance * right_amplitude[law], "%s",
               small_doing);
  for (int i = 0; i < TIMEINT_WAVE && st == HC_OK; ++i)
    CHECK_LE(fabs(r->wave[i]), 1.2 * right_amplitude[law], "%s wave", small_doing);
  timeint_free(ti);
  assert_true(calls >= f.at);
  which->calls = calls;
  return st;
}

static void cvode_fails(CHECK_STATE)
{
  timeint_result r;
  for (int law = 0; law < 2; ++law) {
    assert_int_equal(steady_with(law, (fault){0}, &cv, &r), HC_OK);
    const long at[] = {1, 2, cv.calls};
    for (int i = 0; i < 3; ++i)
      for (int flag = -60; flag < 0; flag += i == 1 && flag > -35 ? 1 : 9)
        for (int stays = 0; stays < 2; ++stays) {
          fault f = {at[i], stays, flag, RETURN_FLAG, 0};
          doing(law ? "exact law" : "regularised law", &f);
          hc_status st = steady_with(law, f, &cv, &r);
          hc_status expected = flag == CV_MEM_FAIL ? HC_NO_MEMORY : HC_INTEGRATOR;
          if (stays ? st != expected : st != HC_OK && st != expected)
            fail_msg("%s: %s", small_doing, hc_status_text(st));
          if (stays) assert_int_equal(r.cvode_flag, flag);
        }
  }
}

/* Success where nothing was done, or with a NaN; a root, a warning or a stop that are none. */
static void cvode_lies(CHECK_STATE)
{
  timeint_result r;
  static const int flags[] = {CV_SUCCESS, CV_TSTOP_RETURN, CV_ROOT_RETURN, CV_WARNING};
  for (int law = 0; law < 2; ++law) {
    assert_int_equal(steady_with(law, (fault){0}, &cv, &r), HC_OK);
    const long at[] = {1, 7, cv.calls};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 4; ++k)
        for (lie how = SPOIL_NAN; how <= STAND_STILL; ++how)
          for (int stays = 0; stays < 2; ++stays) {
            fault f = {at[i], stays, flags[k], how, 0};
            doing(law ? "exact law" : "regularised law", &f);
            hc_status st = steady_with(law, f, &cv, &r);
            if (stays && st == HC_OK) fail_msg("%s ended well", small_doing);
          }
  }
}

/* Shooting and Anderson's iteration run on KINSOL, too. */
static void shooting_fails(CHECK_STATE)
{
  timeint_result r;
  for (int law = 0; law < 2; ++law) {
    assert_int_equal(steady_with(law, (fault){0}, &kin, &r), HC_OK);
    for (int flag = -20; flag <= KIN_STEP_LT_STPTOL; flag += law ? 1 : 5)
      for (lie how = RETURN_FLAG; how <= SPOIL_NAN; ++how)
        for (int stays = 0; stays < 2; ++stays) {
          fault f = {1, stays, flag, how, 0};
          doing(law ? "shooting, exact law" : "shooting, regularised law", &f);
          steady_with(law, f, &kin, &r);
        }
  }
}

/* ---- the commands ---- */

typedef struct order {
  const char *line;
  fault kin, cv;
} order;

static int command(void *self)
{
  const order *o = self;
  kin = o->kin;
  cv = o->cv;
  return child_command(o->line);
}

/* Exit 3; which solver, at which omega, what to try. */
static void failures_are_told(CHECK_STATE)
{
  const fault bad = {1, true, KIN_LSOLVE_FAIL, RETURN_FLAG, 0}, stuck = {1, true, CV_ERR_FAILURE, RETURN_FLAG, 0};
  const struct {
    order o;
    const char *words[3];
  } all[] = {
      {{"frf small.yaml -q", bad, {0}},
       {"harmonic balance stopped at omega = 6:", "the Newton residual stayed above tolerance", "try "}},
      {{"transient small.yaml -q --set transient.start=rest", {0}, stuck},
       {"time integration stopped at omega = 6.5:", "the time integrator gave up", "try "}},
      {{"transient small.yaml -q --set transient.law=exact", {0}, stuck},
       {"time integration stopped at omega = 6.5:", "the time integrator gave up", "try "}},
      {{"compare small.yaml -q", {0}, stuck},
       {"time integration stopped at omega = 6.5:", "the time integrator gave up", "try "}},
      {{"compare small.yaml -q", bad, {0}}, {"harmonic balance", "the Newton residual stayed above tolerance", "try "}},
      {{"gate small.yaml -q", {0}, stuck}, {"", "", ""}},
      {{"study study.yaml -q --jobs 1 --results :memory:", bad, {0}}, {"", "", ""}},
  };
  static outcome o;
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    child_run(command, (void *)&all[i].o, 300, &o);
    bool said = true;
    for (int k = 0; k < 3; ++k) said = said && strstr(o.err, all[i].words[k]);
    if (o.code == 3 && said) continue;
    child_show(&o, all[i].o.line);
    fail();
  }
}

CHECK_ENTRY_FUNCTION
{
  for (int law = 0; law < 2; ++law) {
    scene sc = small_scene(law ? exactly : smoothly);
    CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
    near_orbit[law] = (scene_state){.x = 0};
    CHECK_FILLED(timeint_result, r, timeint_steady(ti, 6.5, near_orbit[law].all, NULL, &r));
    near_orbit[law].x *= 1.001;
    timeint_free(ti); /* one that has found an orbit remembers it */
    assert_int_equal(scene_timeint(&sc, &ti), HC_OK);
    scene_state start = near_orbit[law];
    assert_int_equal(timeint_steady(ti, 6.5, start.all, NULL, &r), HC_OK);
    right_amplitude[law] = r.amplitude;
    timeint_free(ti);
  }
  return SMALL_MAIN("solvers", 300, kinsol_fails, kinsol_lies, cvode_fails, cvode_lies, shooting_fails,
                    failures_are_told);
}
