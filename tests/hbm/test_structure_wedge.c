/* test_structure_wedge.c - a damper that has no spring of its own (cases/structures/wedge_*): whole curves while it
 * sticks, slips and separates, under half, once and twice its static load. The equations of motion of all degrees of
 * freedom hold along them, by means of the test's own; it sticks where the closed form says so; nothing but ratios of
 * the loads matters; and without what holds it, it is refused. */
#include "tests/hbm/full_equations.h"
#include "tests/hbm/structure_cases.h"
#include "tests/hbm/stuck_response.h"

enum { H = 7 };

/* The case with loads of `force` on the blade and `press` on the damper, every DOF a response; its curve. */
typedef struct wedge {
  model *model;
  hbm_solver *s;
  hbm_curve curve;
} wedge;

static void trace(const char *name, double force, double press, wedge *w)
{
  structure_case c = structure_case_named(name, H);
  *w = (wedge){.model = with_all_responses(c.model)};
  model_free(c.model);
  c.model = w->model;
  scale_dynamic_loads(w->model, force);
  for (int i = 0; i < 3; ++i) w->model->loads[0].cosine[i] *= press;
  w->s = structure_solver(&c);
  assert_int_equal(hbm_trace(w->s, c.from, c.to, NULL, &w->curve), HC_OK);
  assert_int_equal(w->curve.end, HC_OK);
  assert_false(w->curve.left_at_start);
  assert_true(w->curve.points[w->curve.n - 1].omega == c.to);
}

static void free_wedge(wedge *w)
{
  hbm_curve_free(&w->curve);
  hbm_solver_free(w->s);
  model_free(w->model);
}

static contact_regime regime_at(const wedge *w, int k)
{
  CHECK_FILLED(hbm_measures, m, hbm_measure(w->s, hbm_curve_X(&w->curve, k), &m));
  return m.contact.regime;
}

/* How far a wedge that is stuck all period is from leaving that, < 0: it cannot be. At rest friction does not
 * suffice, so both sliders have gone to their limits, s T0 + A = mu N0 (shake_down). They stay if the other limit is
 * not reached, A + B < 2 mu N0 with A, B = |s kt u1 -+ mu kn v1|, nor N = 0, kn |v1| < N0. In units of N0. */
static double stuck_margin(const model *m, double omega)
{
  const bool stuck[2] = {true, true};
  number x0[3], x1[3];
  double least = INFINITY;
  closed_form(m, stuck, omega, 0, 0, x0);
  closed_form(m, stuck, omega, 1, 0, x1);
  const number rest[3] = {x0[0], x0[1], x0[2]};
  shake_down(m, stuck, x1, x0);
  for (int j = 0; j < 2; ++j) {
    const model_contact *c = &m->contacts[j];
    const double sign = creall(along(m, c->tangent, rest)) > 0 ? 1 : -1;
    const double N0 = (double)(c->law.kn * creall(along(m, c->normal, x0)));
    const number T1 = sign * c->law.kt * along(m, c->tangent, x1), N1 = c->law.kn * along(m, c->normal, x1);
    const double A = (double)cabsl(T1 - c->law.mu * N1), B = (double)cabsl(T1 + c->law.mu * N1);
    least = fmin(least, fmin(2 * c->law.mu - (A + B) / N0, 1 - (double)cabsl(N1) / N0));
  }
  return least;
}

/* 1e-12 of the largest force: Newton's tolerance 1e-13 of the sum of them, and rounding of the reduction. */
static void check_equations(const wedge *w, int every, const char *what)
{
  static full_motion f;
  f = (full_motion){.m = w->model, .n_harm = H};
  for (int k = 0; k < w->curve.n; k += every) {
    f.omega = w->curve.points[k].omega;
    for (int i = 0; i < 3; ++i)
      assert_int_equal(hbm_response(w->s, f.omega, hbm_curve_X(&w->curve, k), i, f.x[i]), HC_OK);
    CHECK_LE(full_residual(&f), 1e-12, "%s, point %d at %.12g", what, k, f.omega);
  }
}

/* Forces 0.5, 2, 10, 20 and a twentieth of the first, each with half, once and twice the static load of 10. With it as
 * in the case files, the wedge never slips, slips, slips, separates, separates. */
static void whole_curves(CHECK_STATE)
{
  static const struct {
    const char *name;
    double force;
    contact_regime worst;
  } loads[] = {{"wedge_F0.5", 0.05, CONTACT_STUCK},
               {"wedge_F0.5", 1, CONTACT_SLIPS},
               {"wedge_F2", 1, CONTACT_SLIPS},
               {"wedge_F10", 1, CONTACT_SEPARATES},
               {"wedge_F20", 1, CONTACT_SEPARATES}};
  for (int i = 0; i < 5; ++i)
    for (int press = -1; press <= 1; ++press) {
      wedge w;
      char what[64];
      contact_regime worst = CONTACT_LINEAR;
      trace(loads[i].name, loads[i].force, ldexp(1, press), &w);
      snprintf(what, sizeof what, "%s x %g, static load x %g", loads[i].name, loads[i].force, ldexp(1, press));
      check_equations(&w, 5, what);
      /* Where the curve is a function of omega it sticks if and only if it can; elsewhere it can where it does.
       * Points within 1e-9 of the limit may be either. */
      for (int k = 0; k < w.curve.n; ++k) {
        const double omega = w.curve.points[k].omega, margin = stuck_margin(w.model, omega);
        const bool sticks = regime_at(&w, k) == CONTACT_STUCK;
        if (fabs(margin) <= 1e-9 || (w.curve.turning_points > 0 && !sticks)) continue;
        if (sticks != (margin > 0)) fail_msg("%s at %.10g: sticks %d, margin %g", what, omega, sticks, margin);
      }
      for (int k = 0; k < w.curve.n; ++k)
        if (regime_at(&w, k) > worst) worst = regime_at(&w, k);
      if (press == 0 && worst != loads[i].worst) fail_msg("%s: %s", what, contact_regime_name(worst));
      free_wedge(&w);
    }
}

/* Without gaps and clearances all forces are proportional to all loads: four times these, four times the motion, to
 * the last bit where nothing is compared with 1. Rounding of 1e-12 is allowed. */
static void only_ratios_of_loads_matter(CHECK_STATE)
{
  wedge one, four;
  trace("wedge_F10", 1, 1, &one);
  trace("wedge_F10", 4, 4, &four);
  for (double omega = 32; omega < 35; omega += 0.5) {
    hbm_curve a = {0}, b = {0};
    assert_int_equal(hbm_curve_at(one.s, &one.curve, omega, &a), HC_OK);
    assert_int_equal(hbm_curve_at(four.s, &four.curve, omega, &b), HC_OK);
    assert_int_equal(a.n, b.n);
    assert_true(a.n % 2 == 1); /* a curve from end to end crosses a frequency an odd number of times */
    for (int k = 0; k < a.n; ++k)
      for (int c = 0; c < a.n_coef; ++c)
        CHECK_NEAR(hbm_curve_X(&b, k)[c], 4 * hbm_curve_X(&a, k)[c], 1e-12, "%g, solution %d, %d", omega, k, c);
    hbm_curve_free(&a);
    hbm_curve_free(&b);
  }
  free_wedge(&one);
  free_wedge(&four);
}

/* By its file, and where a program makes the model. */
static void without_contacts_it_is_refused(CHECK_STATE)
{
  scene sc;
  case_error err;
  const char *const none[] = {"contacts=[]"};
  assert_int_equal(case_read(SOURCE_DIR "/cases/structures/wedge_F2.yaml", 1, none, &sc, &err), HC_BAD_INPUT);
  if (!strstr(err.message, "nothing holds the motion {damper_x: 1, damper_y: ")) fail_msg("%s", err.message);
  structure_case c = structure_case_named("wedge_F2", H);
  c.model->n_contacts = 0;
  hbm_solver *s;
  assert_int_equal(hbm_solver_new(c.model, &c.how, &s), HC_SINGULAR);
  assert_null(s);
  c.model->n_contacts = 2;
  model_free(c.model);
}

/* Not touched at rest, nothing presses it on: where it rests is open. No solution is made up. */
static void out_of_reach_it_is_refused(CHECK_STATE)
{
  structure_case c = structure_case_named("wedge_F2", H);
  hbm_point point;
  double X[CASE_MAX_COEF] = {0};
  for (int i = 0; i < 3; ++i) c.model->loads[0].cosine[i] = 0;
  for (int j = 0; j < 2; ++j) c.model->contacts[j].law.gap = -1;
  hbm_solver *s = structure_solver(&c);
  assert_int_equal(hbm_first_solution(s, 35, NULL, X, &point), HC_SINGULAR);
  hbm_solver_free(s);
  model_free(c.model);
}

/* A static load along a motion that K holds by rounding alone: R is small beside K X with a mean of 1e13 and more. */
static void held_by_rounding_alone_it_is_refused(CHECK_STATE)
{
  static const char *const springs[] = {"structure.stiffness=[[0.7,-0.7,0],[-0.7,0.8,-0.1],[0,-0.1,0.1]]",
                                        "structure.stiffness=[[0.3,-0.3,0],[-0.3,0.37,-0.07],[0,-0.07,0.07]]",
                                        "structure.stiffness=[[12.3,-12.3,0],[-12.3,29.6,-17.3],[0,-17.3,17.3]]"};
  for (int k = 0; k < 6; ++k) {
    const char *const set[] = {springs[k / 2], "contacts=[{normal_stiffness: 1, gap: -0.25, normal: {3: -1}}]",
                               "forcing=[{dof: 1, amplitude: 1, harmonic: 0}, {dof: 2, amplitude: 1}]"};
    structure_case c = structure_case_with("chain3", 3, 3, set);
    hbm_point point;
    double X[CASE_MAX_COEF] = {0};
    c.how.skip_linear = k % 2 == 0;
    c.how.tolerance = 1e-10;
    hbm_solver *s = structure_solver(&c);
    assert_int_not_equal(hbm_first_solution(s, 1.9, NULL, X, &point), HC_OK);
    assert_int_equal(hbm_solve(s, 1.9, X, &point), HC_SINGULAR);
    hbm_solver_free(s);
    model_free(c.model);
  }
}

CHECK_TESTS("hbm.structure_wedge", 120, whole_curves, only_ratios_of_loads_matter, without_contacts_it_is_refused,
            out_of_reach_it_is_refused, held_by_rounding_alone_it_is_refused)
