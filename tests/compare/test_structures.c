/* test_structures.c - the comparison of structures: every response predicts its error, and a mistake in one side's
 * model is seen: the linker renames hbm_solver_new, so that harmonic balance can be given another structure. */
#include "tests/scene_runs.h"
#include "tests/wrap.h"

static void (*mistake)(model *m); /* made in the model that harmonic balance gets; NULL: none */

WRAP(hc_status, hbm_solver_new, (const model *m, const hbm_settings *how, hbm_solver **out))
{
  CHECK_MADE(model, wrong, model_copy(m, &wrong));
  if (mistake) mistake(wrong);
  const hc_status st = __real_hbm_solver_new(wrong, how, out);
  model_free(wrong);
  return st;
}

static void compare(const char *name, int n_set, const char *const *set, comparison *c)
{
  scene sc = case_scene(name, n_set, set);
  assert_int_equal(scene_comparison_run(&sc, NULL, c), HC_OK);
  case_clear(&sc);
}

static bool on_one_orbit(const comparison_row *r) { return comparison_one_orbit(r); }

/* ---- predictions ----------------------------------------------------------------------------------- */

/* In all but a row in ten of those that a contact makes err: each response's error is within three times what both
 * sides expected, and that within thirty times the error (of the waveform, which cannot agree by chance). */
static void every_response_predicts_its_error(CHECK_STATE)
{
  static const char *const names[] = {"structures/jenkins2", "structures/chain3", "structures/wedge_F2",
                                      "structures/wedge_F20", "structures/tangent_normal_F100"};
  static const char *const orders[] = {"hbm.harmonics=3", "hbm.harmonics=9"};
  int rows = 0, others = 0, pessimistic = 0, nonlinear = 0;
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
    for (int k = 0; k < 2; ++k) {
      comparison c;
      compare(names[i], 1, &orders[k], &c);
      for (int j = 0; j < c.n_rows; ++j) {
        const comparison_row *r = &c.rows[j];
        if (!on_one_orbit(r) || r->still || r->family) continue;
        const double expected = r->hbm_predicted.waveform + r->transient_predicted.waveform;
        if (r->unexpected)
          fail_msg("%s at %g, response %d: %g observed, %g expected", names[i], r->omega, r->response,
                   r->errors.waveform, expected);
        assert_true(expected > 0 && r->hbm_predicted.amplitude >= 0 && r->transient_predicted.harmonic_1 >= 0);
        assert_true(r->budget.known && r->budget.against_transient);
        CHECK_NEAR(r->budget.amplitude.observed, r->errors.amplitude, 1e-14, "%s, response %d", names[i], r->response);
        pessimistic += r->errors.waveform > 1e-6 && !(expected <= 30 * r->errors.waveform);
        nonlinear += r->errors.waveform > 1e-6;
        ++rows;
        others += r->response > 0;
      }
      comparison_clear(&c);
    }
  assert_true(rows > 50 && others > 30 && nonlinear > 40 && 10 * pessimistic <= nonlinear);
}

/* ---- mistakes -------------------------------------------------------------------------------------- */

/* Beside springs that are alike everywhere: a C that is not symmetric. */
#define SKEW "structure.damping=[[0.04, -0.05, 0], [0.01, 0.04, -0.02], [0, -0.02, 0.04]]"

/* HBM with the mistake at one frequency: how many rows, of how many, are beyond the gate and unexpected. */
static void see(const char *name, const char *at, void (*made)(model *m), int *differ, int *unexpected, int *rows)
{
  const char *const set[] = {"hbm.harmonics=15", at, "transient.law=exact", SKEW};
  comparison c;
  mistake = made;
  compare(name, 4, set, &c);
  mistake = NULL;
  *differ = *unexpected = 0;
  *rows = c.n_rows;
  for (int i = 0; i < c.n_rows; ++i) {
    *differ += !comparison_agrees(&c.rows[i]);
    *unexpected += c.rows[i].unexpected;
  }
  comparison_clear(&c);
}

static void no_mistake(model *m) { (void)m; }

/* u = x2 - x1 becomes x2 + x1. */
static void sign_in_the_scatter(model *m) { m->contacts[1].tangent[0] *= -1; }

static void ten_percent_of_friction(model *m) { m->contacts[0].law.mu *= 1.1; }

static void transposed_damping(model *m)
{
  for (int i = 0; i < m->n; ++i)
    for (int k = 0; k < i; ++k) {
      const double here = m->damping[k * m->n + i];
      m->damping[k * m->n + i] = m->damping[i * m->n + k];
      m->damping[i * m->n + k] = here;
    }
}

static void swap_vectors(int n, double *a, double *b)
{
  for (int i = 0; i < n; ++i) {
    const double here = a[i];
    a[i] = b[i];
    b[i] = here;
  }
}

/* The first two degrees of freedom, of the loads alone; and the last two responses. */
static void swapped_in_the_loads(model *m) { swap_vectors(1, &m->loads[0].cosine[0], &m->loads[0].cosine[1]); }

static void swapped_in_the_responses(model *m) { swap_vectors(m->n, m->responses + m->n, m->responses + 2 * m->n); }

static void a_mistake_on_one_side_is_seen(CHECK_STATE)
{
  static const struct {
    const char *what;
    void (*made)(model *m);
    int seen; /* rows of 3 that say so */
  } mistakes[] = {{"a sign in a contact's scatter", sign_in_the_scatter, 3},
                  {"a tenth of the friction", ten_percent_of_friction, 3},
                  {"a transposed C", transposed_damping, 3},
                  {"swapped in the loads", swapped_in_the_loads, 3},
                  {"swapped in the responses", swapped_in_the_responses, 2}};
  int differ, unexpected, rows;
  see("structures/chain3", "compare.omega=[1.9]", no_mistake, &differ, &unexpected, &rows);
  if (differ || unexpected || rows != 3) fail_msg("%d differ, %d unexpected of %d", differ, unexpected, rows);
  for (size_t i = 0; i < sizeof mistakes / sizeof *mistakes; ++i) {
    see("structures/chain3", "compare.omega=[1.9]", mistakes[i].made, &differ, &unexpected, &rows);
    if (differ != mistakes[i].seen || unexpected != mistakes[i].seen)
      fail_msg("%s: %d differ, %d unexpected of %d", mistakes[i].what, differ, unexpected, rows);
  }
}

CHECK_TESTS("compare.structures", 120, every_response_predicts_its_error, a_mistake_on_one_side_is_seen)
