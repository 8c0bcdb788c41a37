/* test_contact_watch.c - what contacts do along a steady state: the balance of work, and closed forms. */
#include "tests/closed_form.h"
#include "tests/hbm/structure_cases.h"
#include "tests/timeint/scenes.h"
#include "timeint/steady/contact_watch.h"

enum { MOST_N = 16, MOST_CONTACTS = 8, HIGHEST = 250, LENGTH = 2 * HIGHEST + 1 };

static const transient_settings closed = CLOSED_FORM(1e-10, 20000);

static transient_settings by_cvode(transient_law law)
{
  transient_settings how = closed;
  how.law = law;
  how.method = TRANSIENT_METHOD_CVODE;
  how.scout = true;
  return how;
}

typedef struct steady_contacts {
  timeint_result of[MOST_N]; /* each response */
  contact_period contact[MOST_CONTACTS];
} steady_contacts;

/* The steady state from rest. */
static void settle(const model *m, const transient_settings *how, double omega, steady_contacts *out)
{
  double state[2 * MOST_N + MOST_CONTACTS];
  assert_true(m->n <= MOST_N && m->n_contacts <= MOST_CONTACTS);
  timeint *ti = at_rest(m, how, state);
  assert_int_equal(timeint_steady(ti, omega, state, NULL, &out->of[0]), HC_OK);
  for (int i = 1; i < m->n_responses; ++i) {
    out->of[i] = out->of[0];
    assert_int_equal(timeint_response(ti, i, &out->of[i]), HC_OK);
  }
  assert_int_equal(timeint_contacts(ti, &out->of[0], out->contact), HC_OK);
  timeint_free(ti);
}

/* closed integral x' . C dx = pi omega sum h^2 (a . C a + b . C b), for a symmetric C. */
static double damped(const model *m, double omega, const steady_contacts *s)
{
  static double x[MOST_N][LENGTH];
  double sum = 0;
  for (int i = 0; i < m->n; ++i) {
    periodic_motion motion = {.mean = s->of[i].mean};
    memcpy(motion.samples, s->of[i].wave, sizeof motion.samples);
    motion_harmonics(&motion, HIGHEST, x[i]);
  }
  for (int c = 1; c < LENGTH; ++c)
    for (int i = 0; i < m->n; ++i)
      for (int k = 0; k < m->n; ++k)
        sum += PI * omega * ((c + 1) / 2) * ((c + 1) / 2) * x[i][c] * m->damping[k * m->n + i] * x[k][c];
  return sum;
}

/* What the loads put in is dissipated, by the dampers and the contacts, whatever the law: N does no work over a period,
 * and T does T du. */
static void check_balance(const char *name, const model *m, const transient_settings *how, double omega,
                          double tolerance)
{
  static steady_contacts s;
  double work = 0;
  settle(m, how, omega, &s);
  for (int j = 0; j < m->n_contacts; ++j) work += s.contact[j].work;
  /* closed integral p . dx over a period, of loads of harmonic 1: pi (p . b - q . a). */
  double in = 0;
  for (int l = 0; l < m->n_loads; ++l)
    for (int i = 0; i < m->n && m->loads[l].harmonic > 0; ++i) {
      assert_int_equal(m->loads[l].harmonic, 1);
      in += PI * (m->loads[l].cosine[i] * s.of[i].b1 - m->loads[l].sine[i] * s.of[i].a1);
    }
  assert_true(work > 1e-3 * in); /* or the test says nothing */
  CHECK_NEAR(in, work + damped(m, omega, &s), tolerance * in, "%s at %g", name, omega);
}

static const struct {
  const char *name;
  double omega;
} slipping[] = {{"jenkins2", 25.9068},        {"chain3", 1.2585}, {"chain3", 1.9},  {"tangent_normal_F50", 3.6},
                {"tangent_normal_F100", 3.6}, {"wedge_F2", 35},   {"wedge_F20", 34}};
enum { N_SLIPPING = sizeof slipping / sizeof *slipping };

static void check_structures(const transient_settings *how, double tolerance)
{
  for (int i = 0; i < N_SLIPPING; ++i) {
    const structure_case c = structure_case_named(slipping[i].name, 3);
    model *m = with_all_responses(c.model);
    check_balance(slipping[i].name, m, how, slipping[i].omega, tolerance);
    model_free(m);
    model_free(c.model);
  }
}

/* x''' jumps at transitions, so X_h falls like h^-4: in `damped` 250 harmonics leave sum h^2 X_h^2, of the order of
 * 250^-5 = 1e-12, and 512 samples alias X_h by X_(512 - h), 1e-10 at worst. Closure 1e-10; twice of it in a square. */
static void closed_form_balances(CHECK_STATE) { check_structures(&closed, 1e-9); }

/* CVODE's tolerance is 1e-13; a period scatters by some hundreds of it, and near a resonance the work of inertia is 100
 * times the input. */
static void events_balance(CHECK_STATE)
{
  const transient_settings how = by_cvode(TRANSIENT_LAW_EXACT);
  check_structures(&how, 1e-8);
}

/* The law's own T and N: what it loses to the regularisation it loses on both sides of the balance. Corners lie inside
 * steps: h^2 of them, with CVODE's steps there as short as 1e-4 rad. */
static void the_regularised_law_balances(CHECK_STATE)
{
  const transient_settings how = by_cvode(TRANSIENT_LAW_REGULARISED);
  check_structures(&how, 1e-7);
}

static void one_degree_of_freedom_balances(CHECK_STATE)
{
  static const double omegas[] = {7, 7.5};
  const transient_settings hows[] = {closed, by_cvode(TRANSIENT_LAW_EXACT), by_cvode(TRANSIENT_LAW_REGULARISED)};
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 3; ++k) {
      const scene sc = scene_b10();
      CHECK_MADE(model, m, scene_model(&sc, &m));
      check_balance("b10", m, &hows[k], omegas[i], k < 2 ? 1e-8 : 1e-7);
      model_free(m);
    }
}

/* A Jenkins element under N = const whose u has two turning points, at +-A: it slips 2 A - 2 f/kt after each, f = mu N.
 * The closed form is good to its closure. */
static void a_jenkins_element_loses_the_closed_form_work(CHECK_STATE)
{
  static steady_contacts s;
  const structure_case c = structure_case_named("jenkins2", 3);
  model *m = with_all_responses(c.model);
  settle(m, &closed, 25.9068, &s);
  const contact *law = &m->contacts[0].law;
  const double f = law->mu * law->load, A = s.of[1].amplitude, path = 4 * (A - f / law->kt);
  assert_int_equal(s.contact[0].regime, CONTACT_SLIPS);
  assert_true(s.contact[0].normal_min == law->load && s.contact[0].normal_max == law->load);
  CHECK_NEAR(s.contact[0].traction_max, f, 1e-12 * f, "T");
  CHECK_NEAR(s.contact[0].slip_distance, path, 1e-9 * A, "slip");
  CHECK_NEAR(s.contact[0].work, f * path, 1e-9 * f * A, "work");
  model_free(m);
  model_free(c.model);
}

/* Extrema between the ends of steps: of N = max(kn (x3 + gap), 0) at the largest x3, which the response has. */
static void extrema_are_between_the_steps(CHECK_STATE)
{
  static steady_contacts s;
  const structure_case c = structure_case_named("chain3", 3);
  const transient_settings ways[] = {closed, by_cvode(TRANSIENT_LAW_EXACT)};
  for (int k = 0; k < 2; ++k) {
    settle(c.model, &ways[k], 1.2585, &s);
    const contact *law = &c.model->contacts[2].law;
    assert_int_equal(s.contact[2].regime, CONTACT_SEPARATES);
    assert_true(s.contact[2].normal_min == 0 && s.contact[2].work == 0 && s.contact[2].traction_max == 0);
    const double most = law->kn * (s.of[2].max + law->gap);
    CHECK_NEAR(s.contact[2].normal_max, most, 1e-12 * most, "way %d", k);
  }
  model_free(c.model);
}

/* At 24 the slider of jenkins2 never slips: no work, not even of rounding. */
static void a_stuck_contact_does_no_work(CHECK_STATE)
{
  static steady_contacts s;
  const structure_case c = structure_case_named("jenkins2", 3);
  const transient_settings ways[] = {closed, by_cvode(TRANSIENT_LAW_REGULARISED)};
  for (int k = 0; k < 2; ++k) {
    settle(c.model, &ways[k], 24, &s);
    assert_int_equal(s.contact[0].regime, CONTACT_STUCK);
    assert_true(s.contact[0].work == 0 && s.contact[0].slip_distance == 0);
    assert_true(s.contact[0].traction_max > 0 && s.contact[0].traction_max < 5);
  }
  model_free(c.model);
}

/* Its slider follows the motion over no surface. */
static void a_separated_contact_has_no_path(CHECK_STATE)
{
  const transient_settings hows[] = {closed, by_cvode(TRANSIENT_LAW_EXACT), by_cvode(TRANSIENT_LAW_REGULARISED)};
  scene sc = scene_linear(1, 0.4, 40, 100);
  static steady_contacts s;
  scene_add(&sc, 100, 1000, 0.3, -50, 45); /* |x| is about 11 */
  CHECK_MADE(model, m, scene_model(&sc, &m));
  for (int k = 0; k < 3; ++k) {
    settle(m, &hows[k], 7, &s);
    assert_int_equal(s.contact[0].regime, CONTACT_LINEAR);
    assert_true(s.contact[0].slip_distance == 0 && s.contact[0].work == 0 && s.contact[0].traction_max == 0);
  }
  model_free(m);
}

CHECK_TESTS("timeint.contact_watch", 60, closed_form_balances, events_balance, the_regularised_law_balances,
            one_degree_of_freedom_balances, a_jenkins_element_loses_the_closed_form_work, extrema_are_between_the_steps,
            a_stuck_contact_does_no_work, a_separated_contact_has_no_path)
