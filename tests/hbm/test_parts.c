/* test_parts.c - the parts of a response curve: what begins at the sweep's other end, and where symmetry breaks. */
#include "hbm/curve/segment.h"
#include "hbm/solver/corrector.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "tests/hbm/traced.h"

typedef struct whole {
  hbm_solver *s;
  hbm_curve curve;
} whole;

static whole trace_whole(const scene *sc, double from, double to)
{
  whole w = {0};
  assert_int_equal(scene_hbm_solver(sc, &w.s), HC_OK);
  assert_int_equal(hbm_trace_all(w.s, from, to, NULL, &w.curve), HC_OK);
  return w;
}

static void free_whole(whole *w)
{
  hbm_curve_free(&w->curve);
  hbm_solver_free(w->s);
}

/* Amplitudes of the solutions at omega, ascending; how many. */
static int amplitudes_at(const whole *w, double omega, double *amplitude, int room)
{
  hbm_curve at = {0};
  assert_int_equal(hbm_curve_at(w->s, &w->curve, omega, &at), HC_OK);
  const int n = at.n;
  assert_true(n <= room);
  for (int k = 0; k < n; ++k) {
    hbm_measures m;
    assert_int_equal(hbm_measure(w->s, hbm_curve_X(&at, k), &m), HC_OK);
    int i = k;
    for (; i > 0 && amplitude[i - 1] > m.amplitude; --i) amplitude[i] = amplitude[i - 1];
    amplitude[i] = m.amplitude;
  }
  hbm_curve_free(&at);
  return n;
}

enum { ROOM = 16 };

/* Case 2 of the paper swept from 6.5 to 9 leaves the sweep on its upper branch. Beyond 7.337 nothing touches in the
 * linear motion, |x| = F0/|K - M w^2 + i C w|, which the upper branch only meets at its fold, 9.21. */
static void the_motion_in_which_nothing_touches_is_a_part_of_its_own(CHECK_STATE)
{
  const scene sc = exact_scene("c2", 10, true);
  whole up = trace_whole(&sc, 6.5, 9), down = trace_whole(&sc, 9, 6.5);
  assert_int_equal(up.curve.n_parts, 2);
  assert_int_equal(up.curve.parts[1].start, HBM_PART_FROM_LAST);
  for (double omega = 7.6; omega < 8.9; omega += 0.4) {
    double a[ROOM], b[ROOM],
        linear =
            sc.structure->loads->amplitude /
            hypot(*sc.structure->stiffness.v - *sc.structure->mass.v * omega * omega, *sc.structure->damping.v * omega);
    const int n = amplitudes_at(&up, omega, a, ROOM), m = amplitudes_at(&down, omega, b, ROOM);
    assert_int_equal(n, 3);
    assert_int_equal(m, 3);
    CHECK_NEAR(a[0], linear, 1e-9 * linear, "omega = %g", omega); /* the residual's tolerance is 1e-10 */
    for (int i = 0; i < n; ++i) CHECK_NEAR(a[i], b[i], 1e-8 * a[i], "solution %d at omega = %g", i, omega);
  }
  free_whole(&up);
  free_whole(&down);
}

/* A mass between stops at +0.5 and -(0.5 + off). */
static scene between_stops(double off)
{
  scene sc = scene_oscillator(1, 0.1, 1, 1);
  sc.omega_from = 0.4, sc.omega_to = 1.2;
  scene_add_contact(&sc, (scene_contact){{.kn = 5, .gap = -0.5}, 90});
  scene_add_contact(&sc, (scene_contact){{.kn = 5, .gap = -0.5 - off}, -90});
  sc.hbm = (hbm_settings){.harmonics = 7, .keep_mean = true, .tolerance = 1e-10};
  return sc;
}

static int count_symmetric(const whole *w, double omega, bool symmetric)
{
  hbm_curve at = {0};
  int n = 0;
  assert_int_equal(hbm_curve_at(w->s, &w->curve, omega, &at), HC_OK);
  for (int k = 0; k < at.n; ++k) n += (fabs(hbm_curve_X(&at, k)[0]) < 1e-9) == symmetric;
  hbm_curve_free(&at);
  return n;
}

/* Between equal stops a symmetric motion loses its symmetry and gets it back; each motion in between that is not
 * symmetric has a mirror image, and one of the two is listed. Where one stop is 1e-6 off the curve is one without
 * branch points: there both images are, each off by a part of 1e-6 that grows towards the branch points (as the root of
 * the distance from them, where 1e-3 is reached 1e-6 away). */
static void a_symmetric_curve_has_its_other_branch_from_either_end(CHECK_STATE)
{
  const scene equal = between_stops(0), unequal = between_stops(1e-6);
  whole up = trace_whole(&equal, 0.4, 1.2), down = trace_whole(&equal, 1.2, 0.4), off = trace_whole(&unequal, 0.4, 1.2);
  bool broken = false;
  assert_int_equal(up.curve.n_parts, down.curve.n_parts);
  for (double omega = 0.45; omega < 1.19; omega += 0.05) {
    double a[ROOM], b[ROOM], c[ROOM];
    const int n = amplitudes_at(&up, omega, a, ROOM), m = amplitudes_at(&down, omega, b, ROOM);
    assert_int_equal(n, m);
    for (int i = 0; i < n; ++i) CHECK_NEAR(a[i], b[i], 1e-7 * a[i], "solution %d at omega = %g", i, omega);
    for (int i = 1; i < n; ++i)
      CHECK_LE(1e-6 * a[i], a[i] - a[i - 1], "an image of solution %d at omega = %g", i, omega);
    const int unsymmetric = count_symmetric(&up, omega, false), all = amplitudes_at(&off, omega, c, ROOM);
    broken |= unsymmetric > 0;
    /* The images of the unequal pair that its curve from this end comes to are among the equal pair's. */
    for (int k = 0; k < all; ++k) {
      double nearest = INFINITY;
      for (int i = 0; i < n; ++i) nearest = fmin(nearest, fabs(a[i] - c[k]));
      CHECK_LE(nearest, 1e-4, "solution %d of unequal stops at omega = %g", k, omega);
    }
    assert_int_equal(count_symmetric(&up, omega, true) % 2, 1);
  }
  assert_true(broken);
  free_whole(&up);
  free_whole(&down);
  free_whole(&off);
}

/* -x(t + T/2): of the mean and of even harmonics the sign turns; the mirror image of a solution is one. */
static void the_mirror_image_of_a_solution_is_one(CHECK_STATE)
{
  const scene sc = between_stops(0);
  whole w = trace_whole(&sc, 0.4, 1.2);
  int unsymmetric = 0;
  double *X = calloc((size_t)w.curve.n_coef, sizeof *X);
  assert_non_null(X);
  for (int k = 0; k < w.curve.n; ++k) {
    hbm_point point;
    memcpy(X, hbm_curve_X(&w.curve, k), (size_t)w.curve.n_coef * sizeof *X);
    if (fabs(X[0]) < 1e-3) continue;
    hbm_mirror(w.s, X);
    const double mean = X[0];
    assert_int_equal(hbm_solve(w.s, w.curve.points[k].omega, X, &point), HC_OK);
    CHECK_NEAR(X[0], mean, 1e-8, "point %d", k);
    ++unsymmetric;
  }
  assert_true(unsymmetric > 10);
  free(X);
  free_whole(&w);
}

/* Symmetric are stops that face each other and friction under a constant load; not: one stop, two of unlike gaps, a
 * static load. */
static void symmetric_models_are_told(CHECK_STATE)
{
  for (int kind = 0; kind < 4; ++kind) {
    scene sc = between_stops(kind == 1 ? 1e-6 : 0);
    if (kind >= 2) scene_keep_contacts(&sc, 1);
    if (kind == 3) sc.structure->contacts[0].given = (scene_contact){{.kt = 1, .mu = 0.3, .load = 1}, 0};
    hbm_solver *s;
    assert_int_equal(scene_hbm_solver(&sc, &s), HC_OK);
    assert_int_equal(s->symmetric, kind == 0 || kind == 3);
    hbm_solver_free(s);
  }
}

CHECK_TESTS("hbm.parts", 60, the_motion_in_which_nothing_touches_is_a_part_of_its_own,
            a_symmetric_curve_has_its_other_branch_from_either_end, the_mirror_image_of_a_solution_is_one,
            symmetric_models_are_told)
