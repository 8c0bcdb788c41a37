/* test_first_guess.c - a first solution from closed form: asked for only where quick ramps fail; its answers. */
#include "compare/first_guess.h"

#include "hbm/solver/ramp.h"
#include "tests/hbm/scenes.h"
#include "tests/wrap.h"
#include "timeint/steady/steady.h"

static bool endless; /* is a motion never to settle? */
static int ticks;    /* of its monitor */

WRAP(hc_status, timeint_steady,
     (timeint * ti, double omega, double *state, const hc_monitor *monitor, timeint_result *out))
{
  if (!endless) return __real_timeint_steady(ti, omega, state, monitor, out);
  while (hc_monitor_tick(monitor, -1)) assert_in_range(++ticks, 1, 1000);
  return HC_INTERRUPTED;
}

enum { QUICK_RAMPS = 2 };
static int failing; /* how many ramps to come begin nowhere */

WRAP(hbm_ramp, hbm_ramp_of, (hbm_ramp_kind kind, const hbm_system *sys, double omega))
{
  hbm_ramp r = __real_hbm_ramp_of(kind, sys, omega);
  if (failing > 0) --failing, r.from = NAN;
  return r;
}

/* Both quick ramps fail. */
static hc_status solve_first(hbm_solver *s, double omega, double *X)
{
  hbm_point point;
  failing = QUICK_RAMPS;
  return hbm_first_solution(s, omega, NULL, X, &point);
}

/* Somebody to ask: counts, and answers as told. */
typedef struct oracle {
  int asked, freed;
  hc_status answer;
  double X[64];
} oracle;

static hc_status ask(void *self, const model *m, double omega, int n_harm, const hc_monitor *monitor, double *X)
{
  oracle *o = self;
  assert_true(*m->mass > 0 && omega > 0 && n_harm > 0);
  (void)monitor;
  ++o->asked;
  if (o->answer == HC_OK) memcpy(X, o->X, (size_t)(2 * n_harm + 1) * sizeof *X);
  return o->answer;
}

static void release(void *self) { ++((oracle *)self)->freed; }

/* Little impacts on a stiff contact, which the linear response knows nothing of. */
static scene impacts(void)
{
  scene sc = scene_named("c2", 7, true, 64);
  sc.hbm.force = HBM_FORCE_EXACT;
  sc.structure->contacts[0].given.law = (contact){100, 1e6, 0.3, -0.5};
  *sc.structure->damping.v = 0.05;
  return sc;
}

static hbm_solver *plain(const scene *sc)
{
  CHECK_MADE(model, m, scene_model(sc, &m));
  CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &sc->hbm, &s));
  model_free(m);
  return s;
}

/* The first solution at omega, asking o. */
static hc_status first_with(const scene *sc, int failing_ramps, double omega, oracle *o)
{
  double X[64];
  hbm_point point;
  hbm_solver *s = plain(sc);
  hbm_solver_take_guess(s, &(hbm_guess){ask, release, o});
  failing = failing_ramps;
  const hc_status st = hbm_first_solution(s, omega, NULL, X, &point);
  hbm_solver_free(s);
  assert_int_equal(o->freed, 1);
  return st;
}

/* A frequency at which Newton fails from the linear response. */
static double hard_omega(void)
{
  const scene sc = impacts();
  for (double omega = 3; omega < 30; omega += 0.25) {
    oracle o = {.answer = HC_INTERRUPTED};
    const hc_status st = first_with(&sc, QUICK_RAMPS, omega, &o);
    if (o.asked == 1) {
      assert_int_equal(st, HC_INTERRUPTED); /* passed on, and no ramp */
      return omega;
    }
  }
  fail_msg("the linear response is a guess everywhere");
  return 0;
}

static void not_asked_where_linear_or_a_quick_ramp_will_do(CHECK_STATE)
{
  const scene linear = scene_named("c2", 7, true, 64), sc = impacts();
  const double omega = hard_omega();
  oracle o = {.answer = HC_BUG};
  assert_int_equal(first_with(&linear, QUICK_RAMPS, 12, &o), HC_OK);
  for (int ramps = 0; ramps < QUICK_RAMPS; ++ramps) {
    o.freed = 0;
    assert_int_equal(first_with(&sc, ramps, omega, &o), HC_OK);
  }
  assert_int_equal(o.asked, 0);
}

/* For its solution with exact forces. */
static void sampled_forces_ask_too(CHECK_STATE)
{
  scene sc = impacts();
  sc.hbm.force = HBM_FORCE_SAMPLED;
  oracle o = {.answer = HC_NOT_SETTLED};
  assert_int_equal(first_with(&sc, QUICK_RAMPS, hard_omega(), &o), HC_OK);
  assert_int_equal(o.asked, 1);
}

static void refusals_lead_to_ramps_or_out(CHECK_STATE)
{
  const scene sc = impacts();
  const double omega = hard_omega();
  static const hc_status answers[] = {HC_NOT_SETTLED, HC_NOT_CONVERGED, HC_CHATTER, HC_NO_MEMORY};
  for (int i = 0; i < 4; ++i) {
    oracle o = {.answer = answers[i]};
    assert_int_equal(first_with(&sc, QUICK_RAMPS, omega, &o), answers[i] == HC_NO_MEMORY ? HC_NO_MEMORY : HC_OK);
    assert_int_equal(o.asked, 1);
  }
}

/* A guess that is a solution is where Newton stays. */
static void a_guess_is_where_newton_begins(CHECK_STATE)
{
  const scene sc = impacts();
  const double omega = hard_omega();
  oracle o = {.answer = HC_NOT_SETTLED};
  double X[64];
  hbm_solver *s = plain(&sc);
  assert_int_equal(solve_first(s, omega, o.X), HC_OK);
  o.answer = HC_OK;
  hbm_solver_take_guess(s, &(hbm_guess){ask, release, &o});
  const long before = hbm_solves(s);
  assert_int_equal(solve_first(s, omega, X), HC_OK);
  assert_int_equal(o.asked, 1);
  assert_true(hbm_solves(s) == before + 2); /* from the linear response, from the guess */
  for (int i = 0; i < 15; ++i) CHECK_NEAR(X[i], o.X[i], 1e-8, "X[%d]", i);
  hbm_solver_free(s);
}

/* compare/'s guess: a solution near the motion from rest, with fewer systems to solve than a ramp takes. */
static void check_guesses(const model *m, const hbm_settings *how)
{
  int solved = 0, cheaper = 0;
  for (double omega = 3; omega < 30; omega += 0.25) {
    double X[64], Y[64];
    CHECK_MADE(hbm_solver, guided, guided_hbm_solver_new(m, how, &guided));
    CHECK_MADE(hbm_solver, alone, hbm_solver_new(m, how, &alone));
    if (solve_first(guided, omega, X) == HC_OK) {
      ++solved;
      CHECK_FILLED(hbm_point, point, hbm_solve(guided, omega, X, &point));
      CHECK_LE(point.residual, 1e-9, "residual at %g", omega);
      if (solve_first(alone, omega, Y) == HC_OK && hbm_solves(guided) < hbm_solves(alone)) ++cheaper;
    }
    hbm_solver_free(guided);
    hbm_solver_free(alone);
  }
  CHECK_LE(100, solved, "frequencies with a first solution");
  CHECK_LE(1, cheaper, "frequencies where the guess spares a ramp");
}

static void the_motion_from_rest_is_a_guess(CHECK_STATE)
{
  const scene sc = impacts();
  CHECK_MADE(model, m, scene_model(&sc, &m));
  check_guesses(m, &sc.hbm);
  model_free(m);
}

/* A motion that does not settle in the time of some hundred periods is no guess; a stop that was asked for is one. */
static void an_endless_motion_is_no_guess(CHECK_STATE)
{
  const scene sc = impacts();
  double X[64];
  const double omega = hard_omega();
  const hc_monitor stop = {check_stop, &(int){1}};
  CHECK_MADE(model, m, scene_model(&sc, &m));
  CHECK_MADE(hbm_solver, s, guided_hbm_solver_new(m, &sc.hbm, &s));
  endless = true;
  assert_int_equal(solve_first(s, omega, X), HC_OK); /* by a slow ramp */
  CHECK_LE(100, ticks, "ticks");
  hbm_point point;
  failing = QUICK_RAMPS;
  assert_int_equal(hbm_first_solution(s, omega, &stop, X, &point), HC_INTERRUPTED);
  endless = false;
  hbm_solver_free(s);
  model_free(m);
}

static void a_structure_is_guessed_whole(CHECK_STATE)
{
  const scene sc = impacts();
  /* The same oscillator as two halves that a stiff spring holds together, each with half of everything: their motion is
   * x = y. The guess is of all degrees of freedom, and leads to the oscillator's solution. */
  const double K = 1e3 * *sc.structure->stiffness.v;
  double tangent, normal;
  CHECK_MADE(model, m, model_new(2, 1, 1, 2, &m));
  for (int i = 0; i < 2; ++i) {
    m->mass[3 * i] = 0.5 * *sc.structure->mass.v;
    m->damping[3 * i] = 0.5 * *sc.structure->damping.v;
    m->stiffness[3 * i] = 0.5 * *sc.structure->stiffness.v + K;
    m->loads[0].cosine[i] = 0.5 * sc.structure->loads->amplitude;
    m->responses[3 * i] = 1;
  }
  m->stiffness[1] = m->stiffness[2] = -K;
  m->loads[0].harmonic = 1;
  model_direction(sc.structure->contacts[0].given.angle_deg, &tangent, &normal);
  for (int i = 0; i < 2; ++i) {
    m->contacts[0].tangent[i] = 0.5 * tangent;
    m->contacts[0].normal[i] = 0.5 * normal;
  }
  m->contacts[0].law = sc.structure->contacts[0].given.law;
  check_guesses(m, &sc.hbm);
  model_free(m);
}

CHECK_TESTS("compare.first_guess", 120, not_asked_where_linear_or_a_quick_ramp_will_do, sampled_forces_ask_too,
            refusals_lead_to_ramps_or_out, a_guess_is_where_newton_begins, an_endless_motion_is_no_guess,
            the_motion_from_rest_is_a_guess, a_structure_is_guessed_whole)
