/* test_structure_orders.c - on structures harmonic balance tends to time integration with the number of harmonics, and
 * the regularised law to the exact one with its parameter; the three ways of time integration meet. */
#include "compare/motion.h"
#include "tests/closed_form.h"
#include "tests/hbm/structure_cases.h"

enum { SIZES = 7, FREQUENCIES = 3 };

/* The numbers of harmonics: 8 to 64 by the square root of two. */
static double log2_size(int k) { return 3 + 0.5 * k; }

static const transient_settings in_closed_form = CLOSED_FORM(1e-12, 20000);

/* The steady state from rest, all its responses. */
static void steady_from_rest(const model *m, transient_settings how, double omega, timeint_result *r)
{
  double *state = calloc((size_t)(2 * m->n + m->n_contacts), sizeof *state);
  CHECK_MADE(timeint, ti, timeint_new(m, &how, &ti));
  timeint_rest(ti, state);
  assert_int_equal(timeint_steady(ti, omega, state, NULL, &r[0]), HC_OK);
  assert_int_equal(r[0].period_multiple, 1);
  assert_int_equal(r[0].free_sliders, 0);
  for (int i = m->n_responses; i-- > 0;) {
    r[i] = r[0];
    assert_int_equal(timeint_response(ti, i, &r[i]), HC_OK);
  }
  timeint_free(ti);
  free(state);
}

static double largest_amplitude(const model *m, const timeint_result *r)
{
  double most = 0;
  for (int i = 0; i < m->n_responses; ++i) most = larger(most, r[i].amplitude);
  return most;
}

/* Largest |x_H(t) - x(t)| of all responses, over the largest amplitude, of the nearest that HBM first finds. */
static double waveform_error(const structure_case *c, int H, double omega, const timeint_result *r)
{
  structure_case with = *c;
  double X[CASE_MAX_COEF], worst = 0;
  hbm_measures m;
  periodic_motion motion;
  with.how.harmonics = H;
  hbm_solver *s = structure_solver(&with);
  CHECK_FILLED(hbm_point, point, hbm_first_solution(s, omega, NULL, X, &point));
  for (int i = 0; i < c->model->n_responses; ++i) {
    assert_int_equal(motion_of_response(s, omega, X, i, &m, &motion), HC_OK);
    const periodic_motion exact = motion_of_transient(&r[i]);
    const double off = motion_discrepancy(&motion, &exact).waveform * r[i].amplitude / largest_amplitude(c->model, r);
    worst = larger(worst, off);
  }
  hbm_solver_free(s);
  return worst;
}

/* Forces are continuous with kinks, so that their harmonics h fall like h^-2, those of the motion of a mass like h^-4,
 * and what H leaves out of the motion like H^-3. Where the kinks lie in the period decides the factor, which scatters
 * from one H to the next, and much alike at neighbouring frequencies: a straight line through the means over these.
 * Four times the slope's own scatter is allowed (99 % of Student's t, SIZES - 2 = 5), and what terms of H^-4, up to
 * four times as large as those of H^-3, change of it about H = 16: 4/16. Both together must tell order 3 from 2, 4. */
static const double next_term = 0.25;

static void harmonics_tend_to_the_transient(CHECK_STATE)
{
  static const struct {
    const char *name;
    double from, to; /* all contacts slip or open there, and there is one solution */
  } at[] = {{"jenkins2", 25.87, 26},  {"chain3", 1.23, 1.35},  {"tangent_normal_F50", 3.5, 4.1},
            {"wedge_F2", 33.5, 35.2}, {"wedge_F10", 33, 34.5}, {"wedge_F20", 34, 36}};
  for (size_t q = 0; q < sizeof at / sizeof *at; ++q) {
    structure_case c = structure_case_named(at[q].name, 1);
    double error[SIZES] = {0}; /* log2, mean over the frequencies */
    for (int f = 0; f < FREQUENCIES; ++f) {
      static timeint_result r[4];
      const double omega = at[q].from + (at[q].to - at[q].from) * (f + 0.37) / FREQUENCIES;
      steady_from_rest(c.model, in_closed_form, omega, r);
      for (int k = 0; k < SIZES; ++k)
        error[k] += log2(waveform_error(&c, (int)lround(exp2(log2_size(k))), omega, r)) / FREQUENCIES;
    }
    double slope = 0, weight = 0, mean = 0, scatter = 0;
    for (int k = 0; k < SIZES; ++k) {
      const double x = log2_size(k) - log2_size(SIZES / 2);
      slope += x * error[k];
      weight += x * x;
      mean += error[k] / SIZES;
    }
    slope /= weight;
    for (int k = 0; k < SIZES; ++k) scatter += pow(error[k] - mean - slope * (log2_size(k) - log2_size(SIZES / 2)), 2);
    const double own = sqrt(scatter / (SIZES - 2) / weight);
    CHECK_LE(4 * own + next_term, 0.9, "%s: the slope is known well enough", at[q].name);
    CHECK_NEAR(slope, -3, 4 * own + next_term, "%s: scatter of the slope %g", at[q].name, own);
    model_free(c.model);
  }
}

/* Largest difference of amplitude, mean and first harmonic, relative to the largest amplitude. */
static double apart(const model *m, const timeint_result *a, const timeint_result *b)
{
  double most = 0;
  for (int i = 0; i < m->n_responses; ++i) {
    const double d[] = {a[i].amplitude - b[i].amplitude, a[i].mean - b[i].mean, a[i].harmonic_1 - b[i].harmonic_1};
    most = larger(most, norm_max(3, d));
  }
  return most / largest_amplitude(m, b);
}

/* None returns to contact in stick, so the law is of second order in its parameter (timeint.regularisation): e(h) = c
 * h^2 (1 + O(h)), O(h) some percent at 1e-2; CVODE's scatter at 1e-10 is below 1e-9, all that is left at 1e-5. */
static void the_three_meet(CHECK_STATE)
{
  static const struct {
    const char *name;
    double omega;
  } at[] = {{"jenkins2", 25.9068},        {"chain3", 1.2585}, {"chain3", 1.9},   {"tangent_normal_F50", 3.6},
            {"tangent_normal_F100", 3.6}, {"wedge_F2", 35},   {"wedge_F10", 33}, {"wedge_F20", 34}};
  static timeint_result exact[4], r[4];
  for (size_t q = 0; q < sizeof at / sizeof *at; ++q) {
    structure_case c = structure_case_named(at[q].name, 1);
    transient_settings how = in_closed_form;
    steady_from_rest(c.model, how, at[q].omega, exact);
    how.method = TRANSIENT_METHOD_CVODE;
    how.tolerance = 1e-10;
    steady_from_rest(c.model, how, at[q].omega, r);
    CHECK_LE(apart(c.model, r, exact), 1e-8, "%s at %g: exact law by CVODE", at[q].name, at[q].omega);
    how.law = TRANSIENT_LAW_REGULARISED;
    how.scout = true;
    double before = NAN;
    for (double h = 1e-2; h > 5e-6; h *= 0.1) {
      how.regularisation = h;
      steady_from_rest(c.model, how, at[q].omega, r);
      const double e = apart(c.model, r, exact);
      if (h < 5e-3 && h > 5e-5)
        CHECK_NEAR(log10(before / e), 2, 0.1 + 1e-9 / e, "%s at %g: regularisation %g", at[q].name, at[q].omega, h);
      before = e;
    }
    CHECK_LE(before, 1e-8, "%s at %g: regularised by 1e-5", at[q].name, at[q].omega);
    model_free(c.model);
  }
}

CHECK_TESTS("compare.structure_orders", 300, harmonics_tend_to_the_transient, the_three_meet)
