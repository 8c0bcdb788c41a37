/* test_families.c - steady states that are members of a family: a slider that never slips rests where the start put it.
 * From rest, and swept up and down, against an independent program. */
#include "tests/hbm/structure_cases.h"
#include "timeint/steady/steady.h"
#include "timeint/steady/sweep.h"

enum { STATES = 16 };
#define REST TRANSIENT_START_REST
#define UP   TRANSIENT_START_UP
#define DOWN TRANSIENT_START_DOWN

/* The program of tests/timeint/test_structure.c, from rest at each frequency, or the state carried on through those
 * that are listed: what all members of the family have in common of a sweep, all of a start from rest. Left out are
 * sweeps of chain3 between 1.485 and 1.52, of wedge_F0.5 at 35 and of wedge_F2 at 37, where members differ in
 * everything (from rest these are unique, and stand here), or two branches are stable: where a sweep leaves one of
 * them depends on its steps. Period 2 at 32 of wedge_F10. */
static const struct row {
  const char *name;
  transient_start start;
  double omega;
  int response;
  double amplitude, harmonic_1, mean; /* NAN: the family's members differ */
  int free_sliders, multiple;
} rows[] = {
    /* clang-format off */
    {"jenkins2", REST, 24, 0, 0.0103068931958761, 0.0103068931958761, 2.76487504066789e-16, 1, 1},
    {"jenkins2", REST, 25.0275, 0, 0.0214396925794696, 0.0214396925794696, -2.20942740759622e-15, 1, 1},
    {"jenkins2", REST, 25.8, 0, 0.131220521372965, 0.131220521372965, -3.52248997588515e-07, 1, 1},
    {"jenkins2", REST, 26.1004, 0, 0.11657937269798, 0.11657937269798, 1.00873331781783e-07, 1, 1},
    {"jenkins2", REST, 26.4006, 0, 0.0413806675146192, 0.0413806675146192, 9.18795040955715e-15, 1, 1},
    {"jenkins2", REST, 27, 0, 0.0178132340293363, 0.0178132340293362, -1.33126185308977e-15, 1, 1},
    {"wedge_F0.5", REST, 33, 0, 0.00411938227038447, 0.00411938227038449, 0.00337373420776125, 2, 1},
    {"wedge_F0.5", REST, 35, 0, 0.0105133671194303, 0.0105283470307946, 0.00384908893142685, 1, 1},
    {"wedge_F0.5", REST, 37, 0, 0.00304925985259428, 0.00304925985259437, 0.00263866203677611, 2, 1},
    {"wedge_F2", REST, 37, 0, 0.0104902075788906, 0.0105162583048187, 0.00378936273578675, 1, 1},
    {"chain3", REST, 1.5, 0, 0.0530128127476279, 0.0384929691411498, -0.0694115941342612, 1, 1},
    {"chain3", REST, 1.5, 2, 1.06900929463573, 1.06507904667561, -0.145619776788162, 1, 1},
    {"chain3", REST, 1.514, 0, 0.0445166327959759, 0.0445163508953475, -0.0282150381079422, 2, 1},
    {"chain3", REST, 1.514, 2, 0.282696401545999, 0.282683084198219, -0.0301785633203047, 2, 1},
    {"jenkins2", UP, 24, 0, 0.0103068931958761, 0.0103068931958761, NAN, 1, 1},
    {"jenkins2", UP, 25.0275, 0, 0.0214396925794696, 0.0214396925794696, NAN, 1, 1},
    {"jenkins2", UP, 25.8, 0, 0.131220521372965, 0.131220521372965, NAN, 1, 1},
    {"jenkins2", UP, 25.9068, 0, 0.150348871884704, 0.15037127692166, 7.83787232117174e-17, 0, 1},
    {"jenkins2", UP, 26.1004, 0, 0.11657937269798, 0.11657937269798, NAN, 1, 1},
    {"jenkins2", UP, 26.4006, 0, 0.0413806675146191, 0.0413806675146192, NAN, 1, 1},
    {"jenkins2", UP, 27, 0, 0.0178132340293363, 0.0178132340293363, NAN, 1, 1},
    {"jenkins2", DOWN, 27, 0, 0.0178132340293362, 0.0178132340293362, NAN, 1, 1},
    {"jenkins2", DOWN, 26.4006, 0, 0.0413806675146191, 0.0413806675146191, NAN, 1, 1},
    {"jenkins2", DOWN, 26.1004, 0, 0.116579372697981, 0.116579372697981, NAN, 1, 1},
    {"jenkins2", DOWN, 25.9068, 0, 0.150348871884704, 0.15037127692166, 8.12438683374491e-17, 0, 1},
    {"jenkins2", DOWN, 25.8, 0, 0.131220521372966, 0.131220521372965, NAN, 1, 1},
    {"jenkins2", DOWN, 25.0275, 0, 0.0214396925794696, 0.0214396925794696, NAN, 1, 1},
    {"jenkins2", DOWN, 24, 0, 0.0103068931958761, 0.0103068931958761, NAN, 1, 1},
    {"wedge_F0.5", DOWN, 37, 0, 0.00304925985259424, 0.00304925985259436, NAN, 2, 1},
    {"wedge_F0.5", DOWN, 33, 0, 0.00411938227038446, 0.00411938227038447, NAN, 2, 1},
    {"wedge_F2", DOWN, 35, 0, 0.0154498887333161, 0.015472858153297, 0.00387865689237189, 0, 1},
    {"wedge_F2", DOWN, 32, 0, 0.010957546762243, 0.0109674844364442, 0.00402775110293925, 0, 1},
    {"wedge_F10", DOWN, 34, 0, 0.0586432158349456, 0.0586148707983119, 0.00379908780396795, 0, 1},
    {"wedge_F10", DOWN, 33, 0, 0.0896197026231503, 0.0896859351250358, 0.00387957424948942, 0, 1},
    {"wedge_F10", DOWN, 32, 0, 0.197669198727749, 0.197156598075532, 0.00458109856644862, 0, 2},
    {"wedge_F20", DOWN, 36, 0, 0.0651822850379418, 0.065089317012894, 0.00383154228017979, 0, 1},
    {"wedge_F20", DOWN, 34, 0, 0.114562214991359, 0.114538702745644, 0.00379121018368096, 0, 1},
    {"chain3", UP, 0.8, 0, 0.0529414883538889, 0.0512747388048564, 1.72156667609371e-15, 0, 1},
    {"chain3", UP, 0.8, 2, 0.0738152653722873, 0.0741397600606953, 9.35918593156244e-16, 0, 1},
    {"chain3", UP, 1.2585, 0, 0.249044036309041, 0.237952036245923, -0.0134258836088602, 0, 1},
    {"chain3", UP, 1.2585, 2, 0.50326391634254, 0.501472638774051, -0.03882525032083, 0, 1},
    {"chain3", UP, 1.2684, 0, 0.247832534886173, 0.237070913583328, -0.0141929017743365, 0, 1},
    {"chain3", UP, 1.2684, 2, 0.518753533226735, 0.51686740116487, -0.0413954297766206, 0, 1},
    {"chain3", UP, 1.485, 0, 0.0678723923599731, 0.0650646847375303, -0.147790776471915, 0, 1},
    {"chain3", UP, 1.485, 2, 1.26134437067519, 1.25688334408792, -0.226331366363284, 0, 1},
    {"chain3", UP, 1.9, 0, 0.180492902053465, 0.162287912778369, 4.44459901096075e-16, 0, 1},
    {"chain3", UP, 1.9, 2, 0.146765057048231, 0.146894778165765, 2.87156326354922e-17, 0, 1},
    {"chain3", DOWN, 1.9, 0, 0.180492902053465, 0.162287912778369, 1.15027995698356e-16, 0, 1},
    {"chain3", DOWN, 1.9, 2, 0.146765057048231, 0.146894778165765, -2.61273580143019e-17, 0, 1},
    {"chain3", DOWN, 1.2684, 0, 0.247832534886173, 0.237070913583328, -0.0141929017743363, 0, 1},
    {"chain3", DOWN, 1.2684, 2, 0.518753533226735, 0.51686740116487, -0.0413954297766207, 0, 1},
    {"chain3", DOWN, 1.2585, 0, 0.249044036309042, 0.237952036245924, -0.0134258836088604, 0, 1},
    {"chain3", DOWN, 1.2585, 2, 0.503263916342539, 0.50147263877405, -0.0388252503208298, 0, 1},
    {"chain3", DOWN, 0.8, 0, 0.0529414883538889, 0.0512747388048564, 1.83197154242911e-15, 0, 1},
    {"chain3", DOWN, 0.8, 2, 0.0738152653722873, 0.0741397600606953, 1.04494387319182e-15, 0, 1},
    /* clang-format on */
};
enum { N_ROWS = sizeof rows / sizeof *rows };

static const transient_settings closed_form = {.law = TRANSIENT_LAW_EXACT,
                                               .method = TRANSIENT_METHOD_CLOSED_FORM,
                                               .regularisation = 1e-4,
                                               .steady = TRANSIENT_STEADY_AUTO,
                                               .tolerance = 1e-10,
                                               .max_periods = 20000};

/* The reference's marching stops at 1e-9 of the state or better where a mean creeps. */
static void check_rows(timeint *ti, const char *name, transient_start start, double omega, timeint_result *r)
{
  const double tolerance = 2e-9;
  double largest = 0;
  for (int i = 0; i < N_ROWS; ++i)
    if (!strcmp(rows[i].name, name) && rows[i].omega == omega) largest = fmax(largest, rows[i].amplitude);
  for (int i = 0; i < N_ROWS; ++i) {
    const struct row *row = &rows[i];
    if (strcmp(row->name, name) != 0 || row->start != start || row->omega != omega) continue;
    assert_int_equal(timeint_response(ti, row->response, r), HC_OK);
    assert_int_equal(r->free_sliders, row->free_sliders);
    assert_int_equal(r->period_multiple, row->multiple);
    CHECK_NEAR(r->amplitude, row->amplitude, tolerance * largest, "%s at %g, start %d", name, omega, start);
    CHECK_NEAR(r->harmonic_1, row->harmonic_1, tolerance * largest, "%s at %g, start %d", name, omega, start);
    if (!isnan(row->mean))
      CHECK_NEAR(r->mean, row->mean, tolerance * largest, "%s at %g, start %d: mean", name, omega, start);
  }
}

/* All rows of a case with that start. */
static void check_start(const char *name, transient_start start)
{
  const structure_case c = structure_case_named(name, 3);
  transient_settings how = closed_form;
  double omega[N_ROWS], state[STATES] = {0}, swept[STATES] = {0};
  how.start = start;
  timeint *ti;
  timeint_result r;
  /* The frequencies of a case's rows with that start, ascending; how many. */
  int n = 0;
  for (int i = 0; i < N_ROWS; ++i) {
    if (strcmp(rows[i].name, name) != 0 || rows[i].start != start) continue;
    int at = n;
    while (at > 0 && omega[at - 1] > rows[i].omega) --at;
    if (at > 0 && omega[at - 1] == rows[i].omega) continue;
    memmove(omega + at + 1, omega + at, (size_t)(n - at) * sizeof *omega);
    omega[at] = rows[i].omega;
    ++n;
  }
  assert_int_equal(timeint_new(c.model, &how, &ti), HC_OK);
  for (int i = 0; i < n; ++i) {
    const double at = omega[start == DOWN ? n - 1 - i : i], from = i > 0 ? omega[start == DOWN ? n - i : i - 1] : at;
    if (start == REST) timeint_rest(ti, state);
    else {
      assert_int_equal(timeint_sweep(ti, from, at, swept, NULL), HC_OK);
      memcpy(state, swept, sizeof state);
    }
    assert_int_equal(timeint_steady(ti, at, state, NULL, &r), HC_OK);
    check_rows(ti, name, start, at, &r);
  }
  timeint_free(ti);
  model_free(c.model);
}

static void from_rest(CHECK_STATE)
{
  const char *const named[] = {"jenkins2", "chain3", "wedge_F0.5", "wedge_F2"};
  for (size_t k = 0; k < sizeof named / sizeof *named; ++k) check_start(named[k], REST);
}

static void swept_up(CHECK_STATE)
{
  check_start("jenkins2", UP);
  check_start("chain3", UP);
}

static void swept_down(CHECK_STATE)
{
  const char *const named[] = {"jenkins2", "chain3", "wedge_F0.5", "wedge_F2", "wedge_F10", "wedge_F20"};
  for (size_t k = 0; k < sizeof named / sizeof *named; ++k) check_start(named[k], DOWN);
}

/* At 1.485 two motions of chain3 are stable, and a sweep down in small steps stays on the other one: the reference
 * finds it from two of its three HBM solutions, x3 = 1.1445, and the first from rest and from the third. */
static void two_stable_motions(CHECK_STATE)
{
  const structure_case c = structure_case_named("chain3", 3);
  transient_settings how = closed_form;
  how.start = DOWN;
  timeint *ti;
  timeint_result r;
  double y[STATES] = {0};
  assert_int_equal(timeint_new(c.model, &how, &ti), HC_OK);
  assert_int_equal(timeint_sweep(ti, 1.9, 1.485, y, NULL), HC_OK);
  assert_int_equal(timeint_steady(ti, 1.485, y, NULL, &r), HC_OK);
  CHECK_LE(r.multiplier, 1 - 1e-3, "down at 1.485");
  CHECK_NEAR(r.amplitude, 0.0530509414153658, 2e-9, "down at 1.485, x1");
  assert_int_equal(timeint_response(ti, 2, &r), HC_OK);
  CHECK_NEAR(r.amplitude, 1.14453458651279, 2e-9, "down at 1.485, x3");
  timeint_free(ti);
  model_free(c.model);
}

/* Marched from rest, without the multipliers that tell free sliders where an orbit is solved for. */
static void marching_counts_them_too(CHECK_STATE)
{
  static const struct {
    const char *name;
    double omega;
    int free_sliders;
  } marched[] = {{"wedge_F0.5", 37, 2}, {"wedge_F2", 37, 1}, {"wedge_F2", 35, 0}};
  for (size_t i = 0; i < sizeof marched / sizeof *marched; ++i) {
    const structure_case c = structure_case_named(marched[i].name, 3);
    transient_settings how = closed_form;
    how.steady = TRANSIENT_STEADY_MARCH;
    timeint *ti;
    timeint_result r;
    double y[STATES] = {0};
    assert_int_equal(timeint_new(c.model, &how, &ti), HC_OK);
    timeint_rest(ti, y);
    assert_int_equal(timeint_steady(ti, marched[i].omega, y, NULL, &r), HC_OK);
    assert_int_equal(r.method, TIMEINT_BY_MARCHING);
    assert_int_equal(r.free_sliders, marched[i].free_sliders);
    timeint_free(ti);
    model_free(c.model);
  }
}

CHECK_TESTS("timeint.families", 100, from_rest, swept_up, swept_down, two_stable_motions, marching_counts_them_too)
