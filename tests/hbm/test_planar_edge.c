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
 * the largest |u - w| - R over the period falls through 0 there is room for one w only, and slip begins. A search over w
 * of its own, by nested golden sections, has that zero at 12.77034103, to the 1e-9 of R that those are good to, which
 * is 3e-10 in omega. */
static void slip_begins_where_the_last_slider_is_stuck(CHECK_STATE)
{
  for (int fine = 0; fine < 2; ++fine) {
    space_curve k = trace_space(0.1, 5, 12.772, 12.769, fine ? 0.05 : 1);
    hbm_special special[8];
    int n, changes = 0;
    hbm_specials(k.s, &k.c, 8, special, &n);
    for (int i = 0; i < n && i < 8; ++i) {
      if (special[i].kind != HBM_CONTACT_CHANGE || special[i].before != CONTACT_STUCK) continue;
      CHECK_NEAR(special[i].omega, 12.77034103, fine ? 1e-8 : 1.3e-6, "slip begins, fine steps %d", fine);
      ++changes;
    }
    assert_int_equal(changes, 1);
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

CHECK_TESTS("hbm.planar_edge", 60, a_curve_passes_both_edges, slip_begins_where_the_last_slider_is_stuck,
            a_curve_does_not_go_round)
