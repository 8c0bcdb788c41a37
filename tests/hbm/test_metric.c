/* test_metric.c - lengths of harmonic balance's motions, contact by contact; and what hangs on them: a curve is the
 * same beside a contact that moves more, about another rest, and in other coordinates. */
#include "hbm/curve/special_points.h"
#include "hbm/hbm.h"
#include "hbm/solver/metric.h"
#include "tests/check.h"

enum { H = 7, MOST = 32 };
static const hbm_settings how = {.harmonics = H,
                                 .keep_mean = true,
                                 .force = HBM_FORCE_EXACT,
                                 .continuation = HBM_CONTINUATION_AUTO,
                                 .tolerance = 1e-10,
                                 .skip_linear = true};

/* M x'' + C x' + K x = F cos on mass i of n, each alone. */
static model *masses(int n, int n_loads, int n_contacts)
{
  CHECK_MADE(model, m, model_new(n, n_loads, n_contacts, 1, &m));
  for (int i = 0; i < n; ++i) {
    const int at = i * (n + 1);
    m->mass[at] = 1, m->damping[at] = 0.4, m->stiffness[at] = 40;
  }
  for (int l = 0; l < n_loads; ++l) m->loads[l].harmonic = 1 - l;
  m->responses[0] = 1;
  return m;
}

/* ---- the metric itself -------------------------------------------------------------------------------------- */

typedef struct measured {
  model *m;
  condensation *c;
  metric *metric;
} measured;

static measured measure(model *m)
{
  measured out = {.m = m};
  assert_int_equal(condensation_new(m, 1, &out.c), HC_OK);
  assert_int_equal(metric_new(m, out.c, &out.metric), HC_OK);
  return out;
}

static void forget(measured *w)
{
  metric_free(w->metric);
  condensation_free(w->c);
  model_free(w->m);
}

/* Two masses, H = 1: a stop on the first (the response), a slider of slip length 0.3 * 8/4 = 0.6 on the second. */
static measured two_contacts(void)
{
  model *m = masses(2, 1, 2);
  m->contacts[0].law = (contact){.kn = 100, .gap = -5}, m->contacts[0].normal[0] = 1;
  m->contacts[1].law = (contact){.kt = 4, .mu = 0.3, .load = 8}, m->contacts[1].tangent[1] = 1;
  return measure(m);
}

static void the_largest_relative_change_decides(CHECK_STATE)
{
  measured w = two_contacts();
  const double X[6] = {1000, 700, 3, 0.001, 4, 0.002}; /* means 1000, 700; amplitudes 5 and sqrt(5)/1000 */
  const metric_at at = {w.metric, 6, X, NULL};
  const double first[6] = {0, 0, 0.5}, second[6] = {0, 0.03}, both[6] = {0, 0.03, 0.5};
  CHECK_NEAR(metric_length(&at, first), 0.1, 1e-15, "0.5 of 5");
  CHECK_NEAR(metric_length(&at, second), 0.03 / 0.6, 1e-15, "of the slip length: it vibrates by less");
  CHECK_NEAR(metric_length(&at, both), 0.1, 1e-15, "the larger one");
  CHECK_NEAR(metric_inner(&at, both, both), 0.1 * 0.1 + 0.05 * 0.05, 1e-15, "the sum");
  CHECK_NEAR(metric_distance(&at, both, first), 0.05, 1e-15, "between the two");
  CHECK_NEAR(metric_tail(&at, 4), fmax(4.0 / 5, 0.002 / 0.6), 1e-15, "the sines");
  double out[6], sum = 0;
  metric_apply(&at, both, out);
  for (int i = 0; i < 6; ++i) sum += out[i] * both[i];
  CHECK_NEAR(sum, metric_inner(&at, both, both), 1e-15, "out . b");
  forget(&w);
}

static void not_a_number_is_no_length(CHECK_STATE)
{
  measured w = two_contacts();
  const double X[6] = {0, 0, 1, 1}, bad[6] = {0, 0, 0, NAN, 0, 0};
  const metric_at at = {w.metric, 6, X, NULL};
  assert_true(isnan(metric_length(&at, bad)) && isnan(metric_distance(&at, X, bad)) &&
              isnan(metric_inner(&at, X, bad)));
  forget(&w);
}

/* A stop and a slider of one mass, which is the response, too: one line, measured by its vibration. */
static void what_moves_along_one_line_counts_once(CHECK_STATE)
{
  model *m = masses(1, 1, 2);
  m->contacts[0].law = (contact){.kn = 100, .gap = -5}, m->contacts[0].normal[0] = 1;
  m->contacts[1].law = (contact){.kt = 4, .mu = 0.3, .load = 8}, m->contacts[1].tangent[0] = -1;
  measured w = measure(m);
  const double X[3] = {9, 0.03, 0.04}, change[3] = {0, 0, 0.005};
  const metric_at at = {w.metric, 3, X, NULL};
  CHECK_NEAR(metric_length(&at, change), 0.1, 1e-15, "0.005 of 0.05");
  CHECK_NEAR(metric_inner(&at, change, change), 0.01, 1e-15, "once");
  forget(&w);
}

/* Lengths about rest: a load of 400 moves the mass by 10, and the gap of -15 is one of -5 there. */
static void own_lengths_are_those_about_rest(CHECK_STATE)
{
  model *m = masses(2, 2, 1);
  m->loads[1].cosine[1] = 400;
  m->contacts[0].law = (contact){.kn = 100, .gap = -15}, m->contacts[0].normal[1] = 1;
  measured w = measure(m);
  const double X[6] = {0, 10, 1}, change[6] = {0, 0.5};
  const metric_at at = {w.metric, 6, X, NULL};
  CHECK_NEAR(metric_rest(w.metric)[1], 10, 1e-13, "rest");
  CHECK_NEAR(metric_length(&at, change), 0.1, 1e-14, "0.5 of 5");
  forget(&w);
}

/* Newton's reach: as far as the most moved contact of the same part, at rest no less than the own lengths. */
static void newton_reaches_as_far_as_the_part_moves(CHECK_STATE)
{
  measured w = two_contacts();
  const double X[6] = {0, 0, 1000};
  const metric_at at = {w.metric, 6, X, NULL};
  double weight[2];
  metric_reach(&at, weight);
  CHECK_NEAR(weight[0], 1e-3, 1e-18, "moved");
  CHECK_NEAR(weight[1], 1 / 0.6, 1e-15, "another part: its slip length");
  forget(&w);
  model *m = masses(2, 1, 2);
  m->stiffness[1] = m->stiffness[2] = -1; /* joined */
  m->contacts[0].law = (contact){.kn = 100, .gap = -5}, m->contacts[0].normal[0] = 1;
  m->contacts[1].law = (contact){.kt = 4, .mu = 0.3, .load = 8}, m->contacts[1].tangent[1] = 1;
  w = measure(m);
  const metric_at joined = {w.metric, 6, X, NULL};
  metric_reach(&joined, weight);
  CHECK_NEAR(weight[1], 1e-3, 1e-18, "it may come to move as much");
  forget(&w);
}

/* ---- curves --------------------------------------------------------------------------------------------------- */

typedef struct seen {
  int n;
  hbm_special special[MOST];
  double peak, at[3]; /* the highest point; solutions at 8, the lowest branch first */
  int n_at;
} seen;

static double amplitude(hbm_solver *s, const double *X)
{
  CHECK_FILLED(hbm_measures, m, hbm_measure(s, X, &m));
  return m.amplitude;
}

static seen look(model *m)
{
  seen out = {0};
  hbm_curve curve = {0}, at = {0};
  CHECK_MADE(hbm_solver, s, hbm_solver_new(m, &how, &s));
  assert_int_equal(hbm_trace(s, 3, 20, NULL, &curve), HC_OK);
  hbm_special *special;
  assert_int_equal(hbm_specials(s, &curve, &special, &out.n), HC_OK);
  for (int i = 0; i < out.n && i < MOST; ++i) out.special[i] = special[i];
  free(special);
  for (int k = 0; k < curve.n; ++k) out.peak = fmax(out.peak, amplitude(s, hbm_curve_X(&curve, k)));
  assert_int_equal(hbm_curve_at(s, &curve, 8, &at), HC_OK);
  out.n_at = at.n;
  for (int k = 0; k < at.n && k < 3; ++k) out.at[k] = amplitude(s, hbm_curve_X(&at, k));
  hbm_curve_free(&at);
  hbm_curve_free(&curve);
  hbm_solver_free(s);
  model_free(m);
  return out;
}

/* Case 2 of the paper, in coordinates x/unit, its rest at `rest` by a static load. */
static void put_case_2(model *m, int dof, double unit, double rest)
{
  const int at = dof * (m->n + 1);
  m->mass[at] = unit * unit, m->damping[at] = 0.4 * unit * unit, m->stiffness[at] = 40 * unit * unit;
  m->loads[0].cosine[dof] = 100 * unit;
  if (m->n_loads > 1) m->loads[1].cosine[dof] = 40 * rest * unit;
  m->contacts[0].law = (contact){.kt = 100, .kn = 1000, .mu = 0.3, .gap = -5 - rest * sqrt(0.5)};
  m->contacts[0].tangent[dof] = m->contacts[0].normal[dof] = unit * sqrt(0.5);
  for (int i = 0; i < m->n; ++i) m->responses[i] = i == dof ? unit : 0;
}

/* Special points to 1e-8 of omega, solutions to 1e-9, the highest point to 1e-6: what both find is located to 1e-9 or
 * better, and the input numbers of a rest of 1e4 vibrations leave 1e-12. */
static void check_same(const seen *a, const seen *b, const char *what, double ratio)
{
  if (a->n != b->n) fail_msg("%s %g: %d special points for %d", what, ratio, b->n, a->n);
  for (int i = 0; i < a->n; ++i) {
    if (a->special[i].kind != b->special[i].kind) fail_msg("%s %g: special point %d is another", what, ratio, i);
    CHECK_NEAR(a->special[i].omega, b->special[i].omega, 1e-8 * a->special[i].omega, "%s %g: special point %d", what,
               ratio, i);
  }
  CHECK_NEAR(a->peak, b->peak, 1e-6 * a->peak, "%s %g: peak", what, ratio);
  assert_int_equal(a->n_at, b->n_at);
  for (int i = 0; i < a->n_at && i < 3; ++i)
    CHECK_NEAR(a->at[i], b->at[i], 1e-9 * a->at[i], "%s %g: solution %d at 8", what, ratio, i);
}

static seen plain(void)
{
  model *m = masses(1, 1, 1);
  put_case_2(m, 0, 1, 0);
  const seen out = look(m);
  assert_true(out.n >= 5); /* two contact changes, two folds, two period doublings with enough harmonics */
  return out;
}

static void a_curve_about_another_rest_is_the_same(CHECK_STATE)
{
  const seen is = plain();
  for (double rest = 10; rest < 2e6; rest *= 10) {
    model *m = masses(1, 2, 1);
    put_case_2(m, 0, 1, rest);
    const seen moved = look(m);
    check_same(&is, &moved, "rest", rest);
  }
}

/* A mass on a slider that is always stuck, or a stop that is reached, moves `ratio` times as much. */
static void a_curve_beside_another_contact_is_the_same(CHECK_STATE)
{
  const seen is = plain();
  for (double ratio = 1e-3; ratio < 2e5; ratio *= 10)
    for (int slides = 0; slides < 2; ++slides) {
      model *m = masses(2, 1, 2);
      put_case_2(m, 0, 1, 0);
      m->stiffness[3] = 2000, m->damping[3] = 2;
      m->loads[0].cosine[1] = 4000 * 10 * ratio;
      if (slides)
        m->contacts[1].law = (contact){.kt = 2000, .mu = 1, .load = 1e8 * ratio}, m->contacts[1].tangent[1] = 1;
      else m->contacts[1].law = (contact){.kn = 20, .gap = -1e9 * ratio}, m->contacts[1].normal[1] = 1;
      const seen beside = look(m);
      check_same(&is, &beside, slides ? "beside a slider" : "beside a stop", ratio);
    }
}

static void a_curve_in_other_coordinates_is_the_same(CHECK_STATE)
{
  const seen is = plain();
  for (double unit = 1e-5; unit < 2e5; unit *= 10) {
    model *m = masses(1, 1, 1);
    put_case_2(m, 0, unit, 0);
    const seen stretched = look(m);
    check_same(&is, &stretched, "unit", unit);
  }
}

CHECK_TESTS("hbm.metric", 100, the_largest_relative_change_decides, not_a_number_is_no_length,
            what_moves_along_one_line_counts_once, own_lengths_are_those_about_rest,
            newton_reaches_as_far_as_the_part_moves, a_curve_about_another_rest_is_the_same,
            a_curve_beside_another_contact_is_the_same, a_curve_in_other_coordinates_is_the_same)
