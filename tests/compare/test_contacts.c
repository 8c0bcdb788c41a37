/* test_contacts.c - contacts compared: made up so that the answer is plain, and of structures. */
#include "tests/scene_runs.h"

/* ---- made up --------------------------------------------------------------------------------------- */

static const model_contact springs[3] = {{.law = {.kt = 10}}, {.law = {.kt = 10}}, {.pair = 0}}; /* ends empty */

/* Two contacts that slip, of work 2 and 1. */
static void slipping(contact_comparison c[2])
{
  for (int j = 0; j < 2; ++j) {
    const contact_period p = {
        .regime = CONTACT_SLIPS, .normal_min = 4, .normal_max = 8, .traction_max = 2, .work = 2 - j};
    c[j] = (contact_comparison){.contact = j, .one_orbit = true, .hbm = p, .transient = p};
  }
}

/* Relative to the largest work of either side, which is contact 0's: 0.02 of 2. */
static void work_is_measured_by_the_largest(CHECK_STATE)
{
  contact_comparison c[2];
  slipping(c);
  c[1].hbm.work = 1.02;
  contact_comparison_judge(2, springs, 0.0101, false, c);
  CHECK_NEAR(c[1].work_error, 0.01, 1e-15, "of the largest");
  assert_true(c[0].work_error == 0 && !c[0].differs && !c[1].differs);
  contact_comparison_judge(2, springs, 0.0099, false, c);
  assert_true(c[1].differs && !c[0].differs);
  c[1].one_orbit = false;
  contact_comparison_judge(2, springs, 0.0099, false, c);
  assert_false(c[1].differs);
  c[1].one_orbit = true, c[1].hbm.work = NAN;
  contact_comparison_judge(2, springs, 0.0099, false, c);
  assert_true(c[1].differs);
}

/* 1e-6 of T^2/kt = 0.4: less than that is no work, and a slip of so little no disagreement. */
static void a_graze_is_no_disagreement(CHECK_STATE)
{
  contact_comparison c[2];
  slipping(c);
  for (int j = 0; j < 2; ++j) c[j].hbm.work = c[j].transient.work = 0, c[j].hbm.regime = CONTACT_STUCK;
  c[0].transient.work = 1e-10;
  contact_comparison_judge(2, springs, 5e-3, false, c);
  CHECK_NEAR(c[0].work_error, 1e-10 / 4e-7, 1e-12, "of T^2/kt");
  assert_true(!c[0].differs && !c[1].differs);
  c[0].transient.work = 1e-8;
  contact_comparison_judge(2, springs, 5e-3, false, c);
  assert_true(c[0].differs && !c[1].differs);
}

static void normal_forces_count_unless_a_slider_is_free(CHECK_STATE)
{
  contact_comparison c[2];
  slipping(c);
  c[0].hbm.normal_min = 4.08;
  contact_comparison_judge(2, springs, 5e-3, false, c);
  CHECK_NEAR(c[0].normal_error, 0.01, 1e-15, "0.08 of 8");
  assert_true(c[0].differs && !c[1].differs);
  contact_comparison_judge(2, springs, 5e-3, true, c);
  assert_true(isnan(c[0].normal_error) && !c[0].differs);
}

static void to_touch_or_not_is_a_difference(CHECK_STATE)
{
  contact_comparison c[2];
  slipping(c);
  c[0].hbm = (contact_period){.regime = CONTACT_LINEAR};
  c[0].transient = (contact_period){.regime = CONTACT_SEPARATES, .normal_max = 1};
  contact_comparison_judge(2, springs, 5e-3, false, c);
  assert_true(c[0].differs && !c[1].differs);
  c[0].transient_status = HC_INTEGRATOR;
  contact_comparison_judge(2, springs, 5e-3, false, c);
  assert_true(isnan(c[0].work_error) && isnan(c[1].work_error) && !c[0].differs);
}

/* ---- structures ------------------------------------------------------------------------------------ */

/* The largest error of work and of normal forces at one frequency, of solutions on whose orbit the transient is. */
static void errors_of(const char *name, const char *at, const char *harmonics, double *work, double *normal)
{
  const char *const set[] = {harmonics, at, "transient.law=exact", "response=[1]"};
  scene sc = case_scene(name, strstr(name, "structures") ? 4 : 3, set);
  CHECK_FILLED(compare_setup, setup, scene_setup(&sc, &setup));
  setup.contacts = true;
  CHECK_FILLED(comparison, c, comparison_run(&setup, NULL, &c));
  assert_true(c.n_rows >= 1 && c.n_contacts == c.n_rows * setup.model->n_contacts);
  *work = *normal = 0;
  for (int i = 0; i < c.n_contacts; ++i)
    if (c.contacts[i].one_orbit) {
      *work = larger(*work, c.contacts[i].work_error);
      *normal = larger(*normal, c.contacts[i].normal_error);
    }
  assert_true(*work > 0);
  comparison_clear(&c);
  scene_setup_clear(&setup);
  case_clear(&sc);
}

/* Two programs with only the law in common: motions err by H^-3, and work, an integral, with them: (31/7)^3 = 87 from H
 * = 7 to 31. N is linear in the motion where it is least. CVODE leaves a thousandth of transient.tolerance. */
static void both_sides_meet_with_the_harmonics(CHECK_STATE)
{
  static const struct {
    const char *name, *at;
  } cases[] = {{"structures/wedge_F2", "compare.omega=[35]"},
               {"structures/chain3", "compare.omega=[1.9]"},
               {"structures/tangent_normal_F100", "compare.omega=[3.6]"},
               {"structures/jenkins2", "compare.omega=[25.9068]"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    double coarse, fine, normal, least;
    errors_of(cases[i].name, cases[i].at, "hbm.harmonics=7", &coarse, &normal);
    errors_of(cases[i].name, cases[i].at, "hbm.harmonics=31", &fine, &least);
    CHECK_LE(fine, coarse / 87 + 1e-9, "%s, work %g", cases[i].name, coarse);
    CHECK_LE(least, normal / 87 + 1e-9, "%s, normal force %g", cases[i].name, normal);
  }
}

CHECK_TESTS("compare.contacts", 60, work_is_measured_by_the_largest, a_graze_is_no_disagreement,
            normal_forces_count_unless_a_slider_is_free, to_touch_or_not_is_a_difference,
            both_sides_meet_with_the_harmonics)
