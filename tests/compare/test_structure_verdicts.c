/* test_structure_verdicts.c - what compare says of the cases in cases/structures, with harmonics enough, and that it is
 * so: every verdict is tried by marching, period after period in plain closed form, from beside the motion it is of. */
#include "compare/comparison.h"
#include "tests/scene_runs.h"

enum { STATES = 64, HARMONICS = 31 };

/* Solutions of each verdict, counted by their first responses; all other cases match throughout. */
static const struct expected {
  const char *name;
  int match, unstable, period_2, aperiodic;
} expected[] = {
    {"structures/jenkins2", 7, 0, 0, 0},
    {"structures/chain3", 9, 2, 0, 0},
    {"structures/tangent_normal_F50", 2, 0, 0, 0},
    {"structures/tangent_normal_F100", 2, 0, 0, 0},
    {"structures/beam16", 7, 0, 0, 0},
    {"structures/wedge_F0.5", 3, 0, 0, 0},
    {"structures/wedge_F2", 3, 0, 0, 0},
    {"structures/wedge_F10", 3, 0, 4, 0},
    {"structures/wedge_F20", 2, 0, 0, 0},
    {"structures/stop2", 4, 1, 0, 1},
    {"structures/brake", 2, 1, 0, 0},
};

/* Where the motion goes from y, a little beside which it begins; x and v move, sliders stay. */
static hc_status march_from(const compare_setup *setup, double omega, const double *y, timeint_result *r)
{
  transient_settings how = setup->transient;
  const int n = setup->model->n;
  double z[STATES], size = 0;
  how.law = TRANSIENT_LAW_EXACT;
  how.method = TRANSIENT_METHOD_CLOSED_FORM;
  how.steady = TRANSIENT_STEADY_MARCH;
  how.scout = false;
  how.max_periods = 5000;
  CHECK_MADE(timeint, ti, timeint_new(setup->model, &how, &ti));
  memcpy(z, y, (size_t)timeint_n_states(ti) * sizeof *z);
  for (int i = 0; i < n; ++i) size = fmax(size, hypot(y[i], y[n + i] / omega));
  for (int i = 0; i < n; ++i) z[i] += (i % 2 ? -1e-5 : 1e-5) * size;
  hc_status st = timeint_steady(ti, omega, z, NULL, r);
  timeint_free(ti);
  return st;
}

/* A match stays what it is within twice the gate, but for sliders that come to rest elsewhere; what is unstable ends
 * elsewhere, or escapes; what leads to two periods does, or ends on another orbit; what never repeats settles not. */
static void check_row(const compare_setup *setup, const comparison *c, int i)
{
  const comparison_row *row = &c->rows[i];
  const double gate = gate_limits_at(setup->limits, row->omega).amplitude;
  timeint_result r;
  double y[STATES];
  /* y: where the transient of the row's HBM solution starts. */
  hbm_curve at = {0};
  bool found = false;
  CHECK_MADE(hbm_solver, h, hbm_solver_new(setup->model, &setup->hbm, &h));
  assert_int_equal(hbm_curve_at(h, &c->curve, row->omega, &at), HC_OK);
  for (int k = 0; k < at.n && !found; ++k) {
    if (at.points[k].branch != row->branch) continue;
    assert_int_equal(comparison_orbit_start(h, hbm_curve_X(&at, k), row->omega, y), HC_OK);
    found = true;
  }
  assert_true(found);
  hbm_curve_free(&at);
  hbm_solver_free(h);
  const hc_status st = march_from(setup, row->omega, y, &r);
  const double moved = fabs(r.amplitude - row->hbm.amplitude) / row->hbm.amplitude;
  switch (row->verdict) {
  case VERDICT_MATCH:
    assert_int_equal(st, HC_OK);
    assert_int_equal(r.period_multiple, 1);
    CHECK_LE(moved, r.free_sliders > 0 ? 1e-2 : 2 * gate, "match at %g", row->omega);
    break;
  case VERDICT_FAMILY: /* it may come to rest anywhere in the band */
    assert_int_equal(st, HC_OK);
    assert_int_equal(r.period_multiple, 1);
    CHECK_LE(row->band.low * (1 - gate), r.amplitude, "family at %g", row->omega);
    CHECK_LE(r.amplitude, row->band.high * (1 + gate), "family at %g", row->omega);
    break;
  case VERDICT_UNSTABLE:
    assert_true(hbm_stability_verdict(&row->stability) <= 0 && st == row->transient_status);
    if (st == HC_UNBOUNDED) break;
    CHECK_LE(10 * gate, moved, "unstable at %g", row->omega);
    break;
  case VERDICT_PERIOD_K:
    assert_int_equal(st, HC_OK);
    if (r.period_multiple == row->transient.period_multiple) break;
    CHECK_LE(2 * gate, moved, "period_k at %g, to another orbit", row->omega);
    break;
  case VERDICT_APERIODIC: assert_int_equal(st, HC_NOT_SETTLED); break;
  default: fail_msg("%s at %g", verdict_name(row->verdict), row->omega);
  }
}

static void check_case(const struct expected *e)
{
  char set[32];
  const char *const sets[] = {set};
  snprintf(set, sizeof set, "hbm.harmonics=%d", HARMONICS);
  scene sc = case_scene(e->name, 1, sets);
  int seen[VERDICT_COUNT] = {0};
  CHECK_FILLED(compare_setup, setup, scene_setup(&sc, &setup));
  setup.spare = setup.multipliers = true;
  CHECK_FILLED(comparison, c, comparison_run(&setup, NULL, &c));
  for (int i = 0; i < c.n_rows; ++i) {
    if (c.rows[i].response > 0) continue;
    ++seen[c.rows[i].verdict];
    check_row(&setup, &c, i);
  }
  if (seen[VERDICT_MATCH] + seen[VERDICT_FAMILY] != e->match || seen[VERDICT_UNSTABLE] != e->unstable ||
      seen[VERDICT_PERIOD_K] != e->period_2 || seen[VERDICT_APERIODIC] != e->aperiodic)
    fail_msg("%s: %d match, %d unstable, %d period_k, %d aperiodic, %d differ", e->name, seen[VERDICT_MATCH],
             seen[VERDICT_UNSTABLE], seen[VERDICT_PERIOD_K], seen[VERDICT_APERIODIC], seen[VERDICT_DIFFERS]);
  comparison_clear(&c);
  scene_setup_clear(&setup);
  case_clear(&sc);
}

static void verdicts_hold(CHECK_STATE)
{
  for (size_t i = 0; i < sizeof expected / sizeof *expected; ++i) check_case(&expected[i]);
}

CHECK_TESTS("compare.structure_verdicts", 300, verdicts_hold)
