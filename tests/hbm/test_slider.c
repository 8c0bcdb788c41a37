/* test_slider.c - the slider followed interval by interval, the second period only in part, against contact_step at
 * every sample of two whole periods: bit for bit. */
#include "hbm/contact/slider.h"
#include "tests/hbm/slow_aft.h"

enum { MAX_H = 12, MAX_N = 1100 };

/* The second of two periods, sample by sample. */
typedef struct whole {
  double x[MAX_N], f[MAX_N];
  contact_state state[MAX_N];
  double w[MAX_N];
  slider_origin origin[MAX_N];
  double settled;
  int transitions;
} whole;

static whole full; /* too large for a stack */
static double f[MAX_N], again[MAX_N];
static sampled_interval found[MAX_N], settling[MAX_N];

static void check_the_same(const moving_contact *c, hbm_restart restart, int n, int seen[4])
{
  const contact *law = &c->law;
  contact_state state = contact_normal(law, c->cv[0] * full.x[n - 1]) > 0 ? CONTACT_STICK : CONTACT_SEPARATED;
  slider_origin origin = {0};
  double w = 0, traction;
  for (int period = 0; period < 2; ++period) {
    full.settled = w;
    full.transitions = 0;
    for (int i = 0; i < n; ++i) {
      const contact_state last = state;
      int before = i ? i - 1 : n - 1;
      double u = c->cu[0] * full.x[i], v = c->cv[0] * full.x[i];
      if (state == CONTACT_SEPARATED && contact_normal(law, v) > 0) {
        bool interpolated = restart == HBM_RESTART_INTERPOLATED;
        w = interpolated ? -law->gap * c->cu[0] / c->cv[0] : c->cu[0] * full.x[before];
        origin = (slider_origin){before, {interpolated ? 0 : c->cu[0]}, {0}};
      }
      state = contact_step(law, u, v, &w, &traction);
      int slip = contact_slip_sign(state);
      if (slip) origin = (slider_origin){i, {c->cu[0]}, {-slip * law->mu * law->kn * c->cv[0] / law->kt}};
      full.f[i] = traction * c->cu[0] + contact_normal_change(law, v) * c->cv[0];
      full.state[i] = state;
      full.w[i] = w;
      full.origin[i] = origin;
      full.transitions += state != last;
    }
  }
  const slider_motion motion = {full.x, full.x, c->cu[0], c->cv[0], c->cu[0], c->cv[0]};
  const slider_rule rule = {.restart = restart};
  slider_report r = slider_follow(&c->law, &rule, n, &motion, f, again, found, settling);
  int touching = 0, slipping = 0;
  for (int k = 0; k < r.n_intervals; ++k) {
    const int end = k + 1 < r.n_intervals ? found[k + 1].first : n;
    assert_true(found[k].first < end && (k > 0 || found[k].first == 0));
    assert_true(k == 0 || found[k].state != found[k - 1].state);
    assert_true(found[k].w == full.w[found[k].first]);
    for (int i = found[k].first; i < end; ++i) {
      assert_int_equal(found[k].state, full.state[i]);
      assert_true(f[i] == full.f[i]);
      if (found[k].state != CONTACT_STICK) continue;
      assert_true(found[k].w == full.w[i]);
      assert_true(found[k].origin.i == full.origin[i].i);
      for (int s = 0; s < 2; ++s) {
        assert_true(found[k].origin.by_along[s] == full.origin[i].by_along[s]);
        assert_true(found[k].origin.by_across[s] == full.origin[i].by_across[s]);
      }
    }
    touching += found[k].state != CONTACT_SEPARATED;
    slipping += contact_slip_sign(found[k].state) != 0;
  }
  assert_true(r.w == full.w[n - 1] && r.settled == full.settled);
  assert_int_equal(r.transitions, full.transitions);
  ++seen[touching == 0 ? 0 : touching < r.n_intervals ? 1 : slipping == 0 ? 2 : slipping == r.n_intervals ? 3 : 2];
}

static void equals_two_whole_periods(CHECK_STATE)
{
  static const int sizes[] = {5, 16, 17, 33, 64, 250, 1024, 1099};
  uint64_t seed = 5;
  int seen[4] = {0}; /* never touches, separates, stays in contact, slips all the time */
  for (int trial = 0; trial < 4000; ++trial) {
    double X[2 * MAX_H + 1];
    const int n = sizes[trial % 8], most = (n - 1) / 2, H = 1 + trial / 8 % (most < MAX_H ? most : MAX_H);
    scene sc = random_contacts(&seed, 3);
    random_motion(&seed, H, 1, 1 + trial % 3, X);
    for (int i = 0; i < n; ++i)
      full.x[i] = series_at(H, X, cos(2 * PI * i / n), sin(2 * PI * i / n)).x * (trial % 5 ? 1 : 0.05);
    for (int j = 0; j < sc.structure->n_contacts; ++j) {
      moving_contact c = scene_moving_contact(&sc.structure->contacts[j].given);
      /* Where a contact slips at every sample its reversal must not stick: hardly any friction, a stiff spring. */
      if (trial % 7 == 0) {
        c.law.mu = 1e-6;
        c.law.kt = 1e3;
        c.law.gap = 3;
      }
      check_the_same(&c, trial / 2 % 2 ? HBM_RESTART_SAMPLE : HBM_RESTART_INTERPOLATED, n, seen);
    }
  }
  for (int k = 0; k < 4; ++k) assert_true(seen[k] > 200);
}

/* Samples exactly at the limits: at the gap, at the friction limit, at rest; no friction, no stiffness. */
static void equals_them_at_the_limits(CHECK_STATE)
{
  uint64_t seed = 6;
  int seen[4] = {0};
  for (int trial = 0; trial < 4000; ++trial) {
    const int n = 5 + trial % 60;
    moving_contact c = {.law = {1, 1, 0.5, floor(2.999 * random_signed(&seed))}, .cu = {1}, .cv = {trial % 3 - 1}};
    if (trial % 11 == 0) c.law.kt = 0;
    if (trial % 13 == 0) c.law.mu = 0;
    if (trial % 17 == 0) c.law.kn = 0;
    for (int i = 0; i < n; ++i)
      full.x[i] = i && random_signed(&seed) > 0.2 ? full.x[i - 1] : floor(3.999 * random_signed(&seed));
    check_the_same(&c, trial / 2 % 2 ? HBM_RESTART_SAMPLE : HBM_RESTART_INTERPOLATED, n, seen);
  }
  assert_true(seen[0] > 100 && seen[1] > 100 && seen[2] > 100);
}

CHECK_TESTS("hbm.slider", 120, equals_two_whole_periods, equals_them_at_the_limits)
