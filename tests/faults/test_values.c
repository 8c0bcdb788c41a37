/* test_values.c - NaN and infinity at the n-th evaluation of the contact forces (hbm/forces/contact_forces.c) or of
 * the right-hand side of the regularised law (timeint/law/scaled.c), with the status of a good evaluation or the one
 * it owes: no hang, no wrong answer, and the handle is not poisoned: asked again it answers what a new one answers,
 * bit for bit. */
#include "compare/study/scene_solvers.h"
#include "hbm/forces/contact_forces.h"
#include "tests/faults/small.h"
#include "tests/wrap.h"
#include "timeint/cvode/structure_newton.h"

enum { H3 = 7 /* coefficients of three harmonics */ };

typedef struct poison { /* of an evaluation */
  long at;              /* 0: none */
  bool stays;           /* all after it, too */
  double value;
  bool jacobian; /* into the Jacobian instead of the force */
  bool honest;   /* answered as HC_NOT_FINITE or false */
  long calls;
  bool struck; /* the last evaluation */
} poison;

static poison now;

static bool strikes(void)
{
  ++now.calls;
  return now.at > 0 && (now.stays ? now.calls >= now.at : now.calls == now.at);
}

WRAP(hc_status, contact_forces_eval,
     (contact_forces * f, const double *X, double *F, bool derive, contact_report *report))
{
  hc_status st = __real_contact_forces_eval(f, X, F, derive, report);
  now.struck = strikes();
  if (!now.struck) return st;
  if (!now.jacobian) F[1] = now.value;
  return now.honest ? HC_NOT_FINITE : HC_OK;
}

/* That of a spoiled evaluation; the next evaluation makes it anew. */
WRAP(const double *, contact_forces_jacobian, (contact_forces * f))
{
  double *jac = (double *)__real_contact_forces_jacobian(f);
  if (now.struck && now.jacobian) jac[1] = now.value;
  return jac;
}

WRAP(bool, structure_newton_rate,
     (const structure_newton *s, const scaled_model *m, double theta, const double *y, double *dy,
      contact_state *state))
{
  bool finite = __real_structure_newton_rate(s, m, theta, y, dy, state);
  if (!strikes()) return finite;
  dy[m->n] = now.value;
  return !now.honest;
}

static void doing(const char *what)
{
  snprintf(small_doing, sizeof small_doing, "%s: evaluation %ld%s is %g%s%s\n", what, now.at,
           now.stays ? " and all after it" : "", now.value, now.jacobian ? " in the Jacobian" : "",
           now.honest ? ", and says so" : "");
}

/* ---- harmonic balance ---- */

static const char *const located[] = {NULL}, *const sampled[] = {"hbm.force=sampled", "hbm.samples=64", NULL};

static hc_status traced(hbm_solver *s, hbm_curve *c)
{
  *c = (hbm_curve){0};
  return hbm_trace(s, 6, 7, NULL, c);
}

/* Trace with the poison, then without. HC_OK only with the last point at the end and finite everywhere. */
static hc_status trace_with(const char *const *set, poison p, const hbm_curve *right)
{
  scene sc = small_scene(set);
  hbm_curve c;
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
  now = p;
  doing(set == located ? "exact forces" : "sampled forces");
  hc_status st = traced(s, &c);
  const long calls = now.calls;
  assert_true(calls >= p.at); /* it struck */
  now = (poison){0};
  for (int i = 0; i < c.n * c.n_coef; ++i) CHECK_LE(fabs(c.X[i]), 10, "%s", small_doing);
  if (st == HC_OK && right) { /* at the end of the sweep, where both have a point, residuals of 1e-9 apart (see
                                 test_solvers.c) */
    CHECK_NEAR(c.points[c.n - 1].omega, 7, 1e-12, "%s", small_doing);
    for (int i = 0; i < H3; ++i)
      CHECK_NEAR(c.X[(c.n - 1) * H3 + i], right->X[(right->n - 1) * H3 + i], 1e-7, "%s", small_doing);
  }
  hbm_curve_free(&c);
  if (right) {
    assert_int_equal(traced(s, &c), HC_OK);
    assert_int_equal(c.n, right->n);
    assert_memory_equal(c.X, right->X, sizeof(double) * (size_t)c.n * H3);
    hbm_curve_free(&c);
  }
  hbm_solver_free(s);
  now.calls = calls;
  return st;
}

static void poisoned_force(const char *const *set)
{
  scene sc = small_scene(set);
  now = (poison){0};
  CHECK_MADE(hbm_solver, s, scene_hbm_solver(&sc, &s));
  CHECK_FILLED(hbm_curve, right, traced(s, &right));
  const long most = now.calls, at[] = {1, 2, 3, 4, 5, most / 2, most / 2 + 1, most - 1, most};
  static const double values[] = {NAN, INFINITY, -INFINITY, 1e308};
  for (int i = 0; i < 9; ++i)
    for (int k = 0; k < 4; ++k)
      for (int how = 0; how < 8; ++how) {
        poison p = {.at = at[i], .stays = how & 1, .value = values[k], .jacobian = how & 2, .honest = how & 4};
        hc_status st = trace_with(set, p, &right);
        if (p.stays && (p.honest || (!p.jacobian && !isfinite(p.value))) && st == HC_OK)
          fail_msg("%s ended well", small_doing);
      }
  hbm_curve_free(&right);
  hbm_solver_free(s);
}

static void located_force(CHECK_STATE) { poisoned_force(located); }

static void sampled_force(CHECK_STATE) { poisoned_force(sampled); }

/* ---- time integration ---- */

static const char *const smoothly[] = {"transient.regularisation=0.01", "transient.tolerance=1e-4",
                                       "transient.scout=false", NULL};

/* By a handle of its own: one that has found an orbit remembers it. */
static hc_status settled(const scene *sc, scene_state from, timeint_result *r)
{
  CHECK_MADE(timeint, ti, scene_timeint(sc, &ti));
  hc_status st = timeint_steady(ti, 6.5, from.all, NULL, r);
  timeint_free(ti);
  assert_true(now.calls >= now.at);
  return st;
}

static void right_hand_side_of(scene sc)
{
  CHECK_MADE(timeint, ti, scene_timeint(&sc, &ti));
  scene_state orbit = {.x = 0};
  now = (poison){0};
  CHECK_FILLED(timeint_result, r, timeint_steady(ti, 6.5, orbit.all, NULL, &r));
  timeint_free(ti);
  orbit.x *= 1.001; /* next to it: from rest it would take a hundred periods */
  now = (poison){0};
  CHECK_FILLED(timeint_result, right, settled(&sc, orbit, &right));
  const long most = now.calls, at[] = {1, 2, 3, 10, 100, most / 2, most - 1, most};
  static const double values[] = {NAN, INFINITY, -INFINITY};
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k)
      for (int how = 0; how < 4; ++how) {
        now = (poison){.at = at[i], .stays = how & 1, .value = values[k], .honest = how & 2};
        doing("regularised law");
        hc_status st = settled(&sc, orbit, &r);
        const bool lasting = now.stays && at[i] < most - 1; /* the last ones belong to measuring a step that CVODE
                                                               has finished */
        if (lasting && st == HC_OK) fail_msg("%s ended well", small_doing);
        if (lasting && now.honest && st != HC_NOT_FINITE) fail_msg("%s: %s", small_doing, hc_status_text(st));
        now = (poison){0};
        /* twice the tolerance */
        if (st == HC_OK) CHECK_NEAR(r.amplitude, right.amplitude, 2e-4 * right.amplitude, "%s", small_doing);
        assert_int_equal(settled(&sc, orbit, &r), HC_OK);
        assert_true(r.amplitude == right.amplitude && r.closure == right.closure);
      }
}

static void right_hand_side(CHECK_STATE) { right_hand_side_of(small_scene(smoothly)); }

static void right_hand_side_with_a_scout(CHECK_STATE)
{
  scene sc = small_scene(smoothly);
  sc.transient.scout = true;
  right_hand_side_of(sc);
}
CHECK_ENTRY_FUNCTION
{
  small_watchdog(300);
  return CHECK_RUN("faults.values", NULL, NULL, located_force, sampled_force, right_hand_side,
                   right_hand_side_with_a_scout);
}
