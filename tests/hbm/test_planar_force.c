/* test_planar_force.c - located forces of contacts with two tangents under the law of the circle: on one line the law
 * of one tangent, closed forms on a circle, the sampled forces' limit, invariances, and the Jacobian against
 * differences. */

#include <float.h>

#include "hbm/planar/planar_slip.h"
#include "tests/hbm/planar_scenes.h"
#include "tests/wrap.h"

static double jac[CIRCLE_MAX_X * CIRCLE_MAX_X];

static planar_force *make(const contact *whole, int H)
{
  const contact half = circle_half(*whole);
  CHECK_MADE(planar_force, f, planar_force_new(H, whole->kn > 0 ? 3 : 2, &half, &f));
  return f;
}

/* On one line both locate the same transitions to rounding; 1e-12 of the forces is what a few dozen roundings of the
 * largest terms come to where N is small beside what it is the difference of. */
static const planar_way way = {&planar_force_evaluator, &exact_force_evaluator, false, 1e-12};

static void a_line_is_one_tangent(CHECK_STATE) { check_on_line(&way); }
static void turns_and_shifts(CHECK_STATE) { check_turns_and_shifts(&way); }
static void jacobian_equals_differences(CHECK_STATE) { check_planar_jacobian(&way); }

/* ---- on a circle ----------------------------------------------------------------------------------- */

/* u = a (cos th, sin th), constant N: the slider follows on a circle of radius sqrt(a^2 - r^2), r = mu N/kt, and T has
 * mu N r/a along u and mu N sqrt(1 - r^2/a^2) ahead of it. It dissipates 2 pi mu N sqrt(a^2 - r^2) a cycle. */
static void a_circle_by_its_closed_form(CHECK_STATE)
{
  const contact law = {.kt = 3, .mu = 0.4, .load = 2.5};
  const double mu_N = 1, r = mu_N / 3;
  for (int k = 0; k < 8; ++k) {
    const double a = r * (1 + pow(10, 1 - k)), along = mu_N * r / a, ahead = mu_N * sqrt((1 - r / a) * (1 + r / a));
    const double X[6] = {0, a, 0, 0, 0, a};
    double F[6];
    planar_force *of = make(&law, 1);
    CHECK_FILLED(contact_report, report, planar_force_eval(of, X, F, NULL, &report));
    assert_int_equal(report.regime, CONTACT_SLIPS);
    assert_int_equal(report.transitions, 0);
    planar_force_free(of);
    /* where `ahead` is small it is known to (rounding of a)/ahead */
    const double tolerance = 1e-13 + 1e-15 / ahead;
    CHECK_NEAR(F[0], 0, tolerance, "mean, a/r = %g", a / r);
    CHECK_NEAR(F[3], 0, tolerance, "mean, a/r = %g", a / r);
    CHECK_NEAR(F[1], along, tolerance, "a/r = %g", a / r);
    CHECK_NEAR(F[2], -ahead, tolerance, "a/r = %g", a / r);
    CHECK_NEAR(F[4], ahead, tolerance, "a/r = %g", a / r);
    CHECK_NEAR(F[5], along, tolerance, "a/r = %g", a / r);
    CHECK_NEAR(PI * a * (F[4] - F[2]), 2 * PI * mu_N * sqrt(a * a - r * r), 10 * tolerance, "loss, a/r = %g", a / r);
  }
}

/* ---- the sampled forces' limit -------------------------------------------------------------------------- */

static double distance_to_sampled(const contact *law, int H, const double *X, int N)
{
  const contact half = circle_half(*law);
  const int rows = (law->kn > 0 ? 3 : 2) * series_length(H);
  double F[CIRCLE_MAX_X], G[CIRCLE_MAX_X], sum = 0;
  planar_force *f = make(law, H);
  CHECK_MADE(void, a, make_sampled(H, N, HBM_RESTART_INTERPOLATED, rows / series_length(H), &half, &a));
  assert_int_equal(planar_aft_evaluator.evaluate(a, X, G, NULL, NULL), HC_OK);
  assert_int_equal(planar_force_eval(f, X, F, NULL, NULL), HC_OK);
  for (int i = 0; i < rows; ++i) sum += (F[i] - G[i]) * (F[i] - G[i]);
  planar_aft_evaluator.free(a);
  planar_force_free(f);
  return sqrt(sum);
}

/* Scenes of all kinds, to the error of sampling: order 2 of 2^14 samples is 1e-7 of what the largest harmonic makes,
 * and corners within a sample a few times that. */
static void random_scenes_meet_the_sampled_ones(CHECK_STATE)
{
  uint64_t seed = 34;
  double X[CIRCLE_MAX_X], worst = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const int H = 1 + trial % 5;
    const contact law = random_circle(&seed);
    random_plane_motion(&seed, H, 1, X);
    const double size = circle_force_size(&law, sum_abs(3 * series_length(H), X));
    const double away = distance_to_sampled(&law, H, X, 16384) / size;
    CHECK_LE(away, 3e-6, "trial %d", trial);
    worst = fmax(worst, away);
  }
  print_message("120 scenes: at most %.1e of the force from 16384 samples\n", worst);
}

/* With a Jacobian the orbit is closed by a last step to first order, without one by passes alone: the same forces, to
 * 1e-12 of them; and the same slider, to 1e-7: what phi is good to between a panel's points. */
static void with_jacobian_the_force_is_the_same(CHECK_STATE)
{
  uint64_t seed = 35;
  double X[CIRCLE_MAX_X], F[CIRCLE_MAX_X], G[CIRCLE_MAX_X], worst = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const int H = 1 + trial % 7, n = series_length(H);
    const contact law = random_circle(&seed);
    const int rows = (law.kn > 0 ? 3 : 2) * n;
    planar_force *a = make(&law, H);
    double w[2], v[2];
    random_plane_motion(&seed, H, 1, X);
    const double motion = sum_abs(3 * n, X), size = circle_force_size(&law, motion);
    assert_int_equal(planar_force_eval(a, X, F, NULL, NULL), HC_OK);
    planar_force_slider(a, w);
    assert_int_equal(planar_force_eval(a, X, G, jac, NULL), HC_OK);
    planar_force_slider(a, v);
    for (int i = 0; i < rows; ++i) {
      worst = fmax(worst, fabs(G[i] - F[i]) / size);
      CHECK_NEAR(G[i], F[i], 1e-12 * size, "trial %d row %d", trial, i);
    }
    for (int d = 0; d < 2; ++d) CHECK_NEAR(v[d], w[d], 1e-7 * (motion + size / law.kt), "trial %d slider %d", trial, d);
    planar_force_free(a);
  }
  print_message("with a Jacobian: worst difference %.1e of the force\n", worst);
}

/* ---- a lens ------------------------------------------------------------------------------------------ */

/* u = (a cos th, Y), R = r + b sin th: with l^2 = a^2 + b^2 the circles share a lens where r > l, whose largest disc
 * has the centre (0, Y), where |u - c| - R = a |cos th| - b sin th - r is l - r at most, and the radius r - l: from w =
 * 0 below it the slider rests at Y - (r - l). T_2 = kt (r - l) there, whose derivatives follow. Where r < l it slips
 * for ever, by symmetry about Y, to as many roundings of R over the part of a radius that it slips. */
static void a_slider_rests_in_the_largest_disc_of_a_lens(CHECK_STATE)
{
  const double Y = 3, a = 1, room[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, -1e-2, -1e-4}, rounding = 64 * DBL_EPSILON * Y;
  for (int k = 0; k < 14; ++k) {
    const double b = k < 7 ? 0 : 0.4, l = hypot(a, b), part = room[k % 7], r = l * (1 + part);
    const double X[9] = {0, a, 0, Y, 0, 0, 0, 0, b};
    const contact constant = {.kt = 2, .mu = 0.5, .load = 4 * r}, varies = {.kt = 2, .kn = 4, .mu = 0.5, .gap = r};
    const int n = b > 0 ? 9 : 6;
    double F[9], w[2];
    planar_force *f = make(b > 0 ? &varies : &constant, 1);
    CHECK_FILLED(contact_report, report, planar_force_eval(f, X, F, jac, &report));
    planar_force_slider(f, w);
    CHECK_NEAR(w[1], Y - fmax(0, r - l), part > 0 ? rounding : rounding * r / (l - r), "b %g, room %g", b, part);
    assert_int_equal(report.regime, part > 0 ? CONTACT_STUCK : CONTACT_SLIPS);
    if (part > 0) {
      const double by[] = {-a / l, 0, 1, -b / l};
      static const int of[] = {1, 3, 6, 8}; /* a, Y, r, b */
      CHECK_NEAR(w[0], 0, rounding, "b %g, room %g", b, part);
      CHECK_NEAR(F[3], 2 * (r - l), 2 * rounding, "b %g, room %g", b, part);
      for (int i = 0; i < 4 && of[i] < n; ++i)
        CHECK_NEAR(jac[3 + n * of[i]], 2 * by[i], rounding, "b %g, room %g, %d", b, part, of[i]);
    }
    planar_force_free(f);
  }
}

/* u = C + a (2 cos th + cos 2 th, 2 sin th - sin 2 th) is farthest from C at th = 0 and +-2 pi/3, 3 a: with a constant
 * R the largest disc of all places of rest is that about C of the radius R - 3 a, held by three. */
static void three_discs_hold_it(CHECK_STATE)
{
  const double a = 0.1, R = 0.5, C[2] = {0.6, -0.8}, room = R - 3 * a;
  const contact law = {.kt = 2, .mu = 0.5, .load = 4 * R};
  const double X[10] = {C[0], 2 * a, 0, a, 0, C[1], 0, 2 * a, 0, -a};
  double F[10], w[2];
  planar_force *f = make(&law, 2);
  assert_int_equal(planar_force_eval(f, X, F, jac, NULL), HC_OK);
  planar_force_slider(f, w);
  assert_int_equal(planar_force_cycle(f)->rest.n, 3);
  for (int d = 0; d < 2; ++d) {
    CHECK_NEAR(w[d], (1 - room) * C[d], 16 * DBL_EPSILON, "w_%d", d + 1);
    /* T = kt room C/|C|: by the mean, across C alone */
    for (int e = 0; e < 2; ++e)
      CHECK_NEAR(jac[5 * d + 10 * (5 * e)], 2 * room * ((d == e) - C[d] * C[e]), 64 * DBL_EPSILON, "%d by %d", d, e);
  }
  planar_force_free(f);
}

/* ---- limits and refusals ------------------------------------------------------------------------------- */

/* Far too little pull to slip: kt (u - 0), a free slider; and never in contact: nothing. */
static void stuck_and_open_are_linear(CHECK_STATE)
{
  const contact stuck = {.kt = 3, .kn = 2, .mu = 0.5, .gap = 100}, open = {.kt = 3, .kn = 2, .mu = 0.5, .gap = -100};
  const double X[9] = {0.1, 1, 0.2, 0.3, -0.4, 0.9, 0.2, 0.5, 0.1};
  double F[9];
  planar_force *f = make(&stuck, 1);
  CHECK_FILLED(contact_report, report, planar_force_eval(f, X, F, jac, &report));
  assert_int_equal(report.regime, CONTACT_STUCK);
  assert_int_equal(report.free_sliders, 1);
  for (int i = 0; i < 9; ++i) CHECK_NEAR(F[i], (i < 6 ? 3 : 2) * X[i], 1e-14, "stuck, row %d", i);
  for (int i = 0; i < 81; ++i) CHECK_NEAR(jac[i], i % 10 ? 0 : i < 54 ? 3 : 2, 1e-14, "stuck, entry %d", i);
  planar_force_free(f);
  f = make(&open, 1);
  assert_int_equal(planar_force_eval(f, X, F, jac, &report), HC_OK);
  assert_int_equal(report.regime, CONTACT_LINEAR);
  for (int i = 0; i < 9; ++i) assert_true(F[i] == 0);
  for (int i = 0; i < 81; ++i) assert_true(jac[i] == 0);
  planar_force_free(f);
}

static void refuses(CHECK_STATE)
{
  const contact law = {.kt = 1, .mu = 1, .load = 1}, smooth = {.kt = 1, .load = 1};
  planar_force *f;
  assert_int_equal(planar_force_new(0, 2, &law, &f), HC_BAD_INPUT);
  assert_int_equal(planar_force_new(HBM_MAX_HARMONICS + 1, 2, &law, &f), HC_BAD_INPUT);
  assert_int_equal(planar_force_new(2, 1, &law, &f), HC_BAD_INPUT);
  assert_int_equal(planar_force_new(2, 2, &smooth, &f), HC_BAD_INPUT);
  assert_null(f);
  const double bad[] = {NAN, INFINITY, -INFINITY, 1e300};
  f = make(&law, 1);
  for (int k = 0; k < 4; ++k) {
    double X[6] = {0, 1, 2, 0, bad[k], 0}, F[6];
    assert_int_equal(planar_force_eval(f, X, F, jac, NULL), HC_NOT_FINITE);
  }
  planar_force_free(f);
}

/* Slip that cannot be followed, as if it had run out of room, at that call; before, it is off by `noise` to a side,
 * so that Newton does not end. */
static int calls, fails_at;
static double noise;
WRAP(hc_status, planar_slip_follow,
     (planar_slip * s, const planar_point *from, double phi, double to, bool lifts_off, slip_end *end))
{
  const hc_status st = __real_planar_slip_follow(s, from, phi, to, lifts_off, end);
  end->phi += ++calls % 2 ? noise : -noise;
  return calls == fails_at ? HC_CHATTER : st;
}

/* In whichever pass slip fails, the force says so: in the two that begin, Newton's 20, those that follow when Newton
 * has not ended, and Newton's again. */
static void a_failure_in_any_pass_is_told(CHECK_STATE)
{
  const contact law = {.kt = 3, .mu = 0.4, .load = 2.5};
  const double X[6] = {0, 1, 0, 0, 0, 1};
  double F[6];
  planar_force *f = make(&law, 1);
  noise = 1e-3;
  for (fails_at = 1; fails_at <= 40; ++fails_at) {
    calls = 0;
    assert_int_equal(planar_force_eval(f, X, F, NULL, NULL), HC_CHATTER);
    assert_int_equal(calls, fails_at);
  }
  noise = fails_at = 0;
  planar_force_free(f);
}

CHECK_TESTS("hbm.planar_force", 300, a_line_is_one_tangent, a_circle_by_its_closed_form,
            random_scenes_meet_the_sampled_ones, turns_and_shifts, with_jacobian_the_force_is_the_same,
            jacobian_equals_differences, stuck_and_open_are_linear, a_slider_rests_in_the_largest_disc_of_a_lens,
            three_discs_hold_it, refuses, a_failure_in_any_pass_is_told)
