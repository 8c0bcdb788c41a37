/* test_planar_edge.c - a structure whose contact with two tangents sticks, slips all round and sticks again over the
 * sweep: its curve goes on through both edges of slip, from either end. */
#include "tests/hbm/structure_cases.h"

typedef struct space_curve {
  model *m;
  hbm_solver *s;
  hbm_curve c;
} space_curve;

static space_curve trace_space(double F, int harmonics, double from, double to, double scale)
{
  const hbm_settings how = {
      .harmonics = harmonics, .keep_mean = true, .force = HBM_FORCE_EXACT, .tolerance = 1e-10, .accuracy = 1e-4};
  space_curve k = {.m = structure_case_named("space", harmonics).model};
  scale_dynamic_loads(k.m, F / 3);
  assert_int_equal(hbm_solver_new(k.m, &how, &k.s), HC_OK);
  hbm_scale_steps(k.s, scale);
  assert_int_equal(hbm_trace(k.s, from, to, NULL, &k.c), HC_OK);
  return k;
}

static void clear(space_curve *k)
{
  hbm_curve_free(&k->c);
  hbm_solver_free(k->s);
  model_free(k->m);
}

/* Amplitude and mean of x1 at 12.5, H = 3: reference hbm.csv (an independent program; located transitions). 1e-9: what
 * the reference asks of exact forces. */
static void a_curve_passes_both_edges(CHECK_STATE)
{
  const double amplitude = 0.0136788720187776, mean = 0.000723689017065682, ends[2] = {9.45, 15.4};
  for (int down = 0; down < 2; ++down) {
    space_curve k = trace_space(0.1, 3, ends[down], ends[1 - down], 1);
    hbm_curve at = {0};
    assert_true(k.c.points[k.c.n - 1].omega == ends[1 - down]);
    assert_in_range(k.c.edges, 1, 10); /* and it says by how much: up to 1e-3 of omega, 3 % of X */
    assert_true(k.c.edge_omega > 0 && k.c.edge_omega <= 1e-3);
    assert_true(k.c.edge_motion > 0 && k.c.edge_motion <= 3e-2);
    assert_int_equal(hbm_curve_at(k.s, &k.c, 12.5, &at), HC_OK);
    assert_int_equal(at.n, 1);
    CHECK_FILLED(hbm_measures, found, hbm_measure_response(k.s, 12.5, at.X, 0, &found));
    CHECK_NEAR(found.amplitude, amplitude, 1e-9 * amplitude, "amplitude, down %d", down);
    CHECK_NEAR(found.mean, mean, 1e-9 * amplitude, "mean, down %d", down);
    hbm_curve_free(&at);
    clear(&k);
  }
}

/* Stuck motions, by the linear structure with the contact's springs, their slider w anywhere: where the least over w of
 * the largest |u - w| - R over the period falls through 0 there is room for one w only, and slip begins. A search over
 * w of its own, by nested golden sections, has that zero at 12.77034103, to the 1e-9 of R that those are good to, which
 * is 3e-10 in omega. Motions that slip go on beside it for 1.2e-6 before they turn: its place is told to 2e-6. */
static void slip_begins_where_the_last_slider_is_stuck(CHECK_STATE)
{
  for (int fine = 0; fine < 2; ++fine) {
    space_curve k = trace_space(0.1, 5, 12.772, 12.769, fine ? 0.05 : 1);
    hbm_special *special;
    int n, changes = 0;
    hbm_specials(k.s, &k.c, &special, &n);
    for (int i = 0; i < n; ++i) {
      if (special[i].kind != HBM_CONTACT_CHANGE || special[i].before != CONTACT_STUCK) continue;
      CHECK_NEAR(special[i].omega, 12.77034103, 2e-6, "slip begins, fine steps %d", fine);
      ++changes;
    }
    assert_int_equal(changes, 1);
    free(special);
    clear(&k);
  }
}

/* Driven somewhat more, stuck motions lead back along slipping ones, for 5e-6 of omega: a step across an edge must not
 * lead to where the curve has been, or it goes round for ever. */
static void a_curve_does_not_go_round(CHECK_STATE)
{
  space_curve k = trace_space(0.16, 5, 9.45, 15.4, 1);
  assert_true(k.c.points[k.c.n - 1].omega == 15.4);
  assert_in_range(k.c.n, 50, 1000);
  clear(&k);
}

/* A block of three degrees of freedom in a V groove, pressed into it by a static load: over the sweep its two contacts
 * rest, slip and lift off. */
static const char groove[] =
    "title: groove\n"
    "structure:\n"
    "  mass: [1, 1, 1]\n"
    "  damping: [0.5, 0.5, 0.4]\n"
    "  stiffness: [0, 0, 50]\n"
    "forcing:\n"
    "  - {direction: {2: 1}, amplitude: -10, harmonic: 0}\n"
    "  - {direction: {1: 1}, amplitude: 3}\n"
    "  - {direction: {3: 1}, amplitude: 3, phase_deg: -90}\n"
    "  - {direction: {2: 1}, amplitude: 2, phase_deg: 20}\n"
    "contacts:\n"
    "  - {friction: 0.3, tangential_stiffness: 200, normal_stiffness: 300, gap: 0, tangent_2: {3: 1},\n"
    "     normal: {1: 0.7071067811865476, 2: -0.7071067811865476},\n"
    "     tangent: {1: 0.7071067811865476, 2: 0.7071067811865476}}\n"
    "  - {friction: 0.3, tangential_stiffness: 200, normal_stiffness: 300, gap: 0, tangent_2: {3: 1},\n"
    "     normal: {1: -0.7071067811865476, 2: -0.7071067811865476},\n"
    "     tangent: {1: 0.7071067811865476, 2: -0.7071067811865476}}\n"
    "response: [{1: 1}, {2: 1}, {3: 1}]\n"
    "sweep: {omega: [8, 26]}\n";

/* Settled motions of a Runge-Kutta integration with small fixed steps, which shares no code with this: two from 8.66 to
 * 15.04, where the curve turns, else one; amplitudes of response 1 at 13.4, and at 18.8 on the only branch. H = 7
 * truncates: 1e-3 of the amplitude, 1e-4 of omega, the digits that the turns are given to. */
static void a_block_in_a_groove_is_followed_from_either_end(CHECK_STATE)
{
  const double ends[] = {8, 26}, turns[] = {15.0443, 8.6645}, omega[] = {13.4, 18.8},
               amplitude[] = {0.0113374, 0.0372220};
  const hbm_settings how = {
      .harmonics = 7, .keep_mean = true, .force = HBM_FORCE_EXACT, .tolerance = 1e-10, .accuracy = 1e-4};
  scene sc;
  case_error err;
  assert_int_equal(case_parse("groove", groove, sizeof groove - 1, 0, NULL, &sc, &err), HC_OK);
  for (int down = 0; down < 2; ++down) {
    space_curve k = {0};
    hbm_special *special;
    int n, found = 0;
    assert_int_equal(scene_model(&sc, &k.m), HC_OK);
    assert_int_equal(hbm_solver_new(k.m, &how, &k.s), HC_OK);
    assert_int_equal(hbm_trace(k.s, ends[down], ends[1 - down], NULL, &k.c), HC_OK);
    assert_int_equal(hbm_specials(k.s, &k.c, &special, &n), HC_OK);
    for (int i = 0; i < n; ++i) {
      if (special[i].kind != HBM_TURNING_POINT) continue;
      assert_in_range(found, 0, 1);
      CHECK_NEAR(special[i].omega, turns[down ? 1 - found : found], 1e-4, "turning point, down %d", down);
      ++found;
    }
    free(special);
    assert_int_equal(found, 2);
    for (int i = 0; i < 2; ++i) {
      hbm_curve at = {0};
      double nearest = INFINITY;
      assert_int_equal(hbm_curve_at(k.s, &k.c, omega[i], &at), HC_OK);
      assert_int_equal(at.n, i == 0 ? 3 : 1);
      for (int q = 0; q < at.n; ++q) {
        CHECK_FILLED(hbm_measures, m, hbm_measure_response(k.s, omega[i], hbm_curve_X(&at, q), 0, &m));
        nearest = fmin(nearest, fabs(m.amplitude / amplitude[i] - 1));
      }
      CHECK_LE(nearest, 1e-3, "amplitude at %g, down %d", omega[i], down);
      hbm_curve_free(&at);
    }
    clear(&k);
  }
  case_clear(&sc);
}

CHECK_TESTS("hbm.planar_edge", 60, a_curve_passes_both_edges, slip_begins_where_the_last_slider_is_stuck,
            a_curve_does_not_go_round, a_block_in_a_groove_is_followed_from_either_end)
