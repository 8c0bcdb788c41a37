/* test_set.c - assignments: what they reach, in which order, and what they say when they are wrong. */
#include "tests/cases/case_text.h"

#define ONE SMALLEST "contacts: [" CONTACT_1 "]\n"

static void every_kind_can_be_set(CHECK_STATE)
{
  scene sc;
  accepted(ONE, "oscillator.mass=2.5", &sc);
  assert_true(*sc.structure->mass.v == 2.5);
  accepted(ONE, " hbm.harmonics = 10 ", &sc);
  assert_int_equal(sc.hbm.harmonics, 10);
  accepted(ONE, "hbm.harmonics=auto", &sc);
  assert_int_equal(sc.hbm.harmonics, HBM_AUTO);
  accepted(ONE, "hbm.static=false", &sc);
  assert_false(sc.hbm.keep_mean);
  accepted(ONE, "hbm.force=exact", &sc);
  assert_int_equal(sc.hbm.force, HBM_FORCE_EXACT);
  accepted(ONE, "title=a: [b] = \"c\" ", &sc); /* text is taken as it is */
  assert_string_equal(sc.title, "a: [b] = \"c\" ");
  accepted(ONE, "title=", &sc);
  assert_string_equal(sc.title, "");
}

static void lists_with_or_without_brackets(CHECK_STATE)
{
  static const char *const forms[] = {"compare.harmonics=[1,3,5]", "compare.harmonics=1,3,5",
                                      "compare.harmonics= [ 1 , 3, 5 ] "};
  scene sc;
  for (size_t i = 0; i < sizeof forms / sizeof *forms; ++i) {
    accepted(ONE, forms[i], &sc);
    assert_int_equal(sc.compare.harmonics.n, 3);
    assert_true(sc.compare.harmonics.v[0] == 1 && sc.compare.harmonics.v[1] == 3 && sc.compare.harmonics.v[2] == 5);
    assert_true(sc.compare.harmonics.v[3] == 0); /* nothing of the longer default is left behind */
  }
  accepted(ONE, "sweep.omega=30,2", &sc);
  assert_true(sc.omega_from == 30 && sc.omega_to == 2);
  accepted(ONE, "compare.omega=5", &sc);
  assert_true(sc.compare.omega.n == 1 && sc.compare.omega.v[0] == 5);
}

static void contacts_are_reached_replaced_and_appended(CHECK_STATE)
{
  scene sc;
  accepted(ONE, "contacts[0].gap=-1", &sc);
  assert_true(sc.structure->contacts[0].given.law.gap == -1 && sc.structure->contacts[0].given.law.kt == 100);
  accepted(ONE, "contacts=[]", &sc);
  assert_int_equal(sc.structure->n_contacts, 0);
  accepted(ONE, "contacts[0]={tangential_stiffness: 1, normal_stiffness: 2, friction: 3, angle_deg: 4}", &sc);
  assert_true(sc.structure->n_contacts == 1 && sc.structure->contacts[0].given.law.kt == 1 &&
              sc.structure->contacts[0].given.law.gap == 0);
  accepted(ONE, "contacts[1]=" CONTACT_1, &sc);
  assert_int_equal(sc.structure->n_contacts, 2);
  assert_memory_equal(&sc.structure->contacts[0].given, &sc.structure->contacts[1].given,
                      sizeof sc.structure->contacts[0].given);
  accepted(ONE, "contacts=[" CONTACT_1 ", " CONTACT_1 ", " CONTACT_1 "]", &sc);
  assert_int_equal(sc.structure->n_contacts, 3);
}

static void a_contact_may_be_appended_field_by_field(CHECK_STATE)
{
  const char *set[] = {"contacts[0].tangential_stiffness=1", "contacts[0].normal_stiffness=2", "contacts[0].friction=0",
                       "contacts[0].angle_deg=0"};
  case_error err;
  CHECK_FILLED(scene, sc, case_parse("f", SMALLEST, strlen(SMALLEST), 4, set, &sc, &err));
  scene_kept(sc);
  assert_true(sc.structure->n_contacts == 1 && sc.structure->contacts[0].given.law.kt == 1 &&
              sc.structure->contacts[0].given.law.kn == 2 && sc.structure->contacts[0].given.law.gap == 0);
  assert_int_equal(case_parse("f", SMALLEST, strlen(SMALLEST), 3, set, &sc, &err), HC_BAD_INPUT);
  assert_string_equal(err.message,
                      "--set contacts[0].tangential_stiffness=1: this appends a contact without `angle_deg`, expected "
                      "contacts[0].angle_deg=VALUE too: a number -90..90");
}

static void later_ones_win_and_rivals_give_way(CHECK_STATE)
{
  const char *set[] = {"sweep.frequency=1,2", "sweep.omega=4,5", "compare.points=9", "compare.omega=7",
                       "compare.points=11",   "hbm.samples=8",   "hbm.samples=64"};
  case_error err;
  const char *text = SMALLEST "compare: {omega: [1, 2]}\n";
  CHECK_FILLED(scene, sc, case_parse("f", text, strlen(text), 1, set, &sc, &err));
  scene_kept(sc);
  assert_true(sc.omega_from > 6.28 && sc.omega_from < 6.29 && sc.compare.omega.n == 2);
  assert_int_equal(case_parse("f", text, strlen(text), 3, set, &sc, &err), HC_OK);
  scene_kept(sc);
  assert_true(sc.omega_from == 4 && sc.omega_to == 5 && sc.compare.omega.n == 0 && sc.compare.points == 9);
  assert_int_equal(case_parse("f", text, strlen(text), 4, set, &sc, &err), HC_OK);
  scene_kept(sc);
  assert_true(sc.compare.omega.n == 1 && sc.compare.omega.v[0] == 7 && sc.compare.points == 20);
  /* 8 samples in between are nobody's business */
  assert_int_equal(case_parse("f", text, strlen(text), 7, set, &sc, &err), HC_OK);
  scene_kept(sc);
  assert_true(sc.compare.omega.n == 0 && sc.compare.points == 11 && sc.hbm.samples == 64);
}

static void refused_or_accepted(const mistake *m)
{
  char message[1024];
  const char *set = m->text;
  case_error err;
  scene sc;
  if (!strcmp(m->message, "-")) {
    accepted(ONE, set, &sc);
    return;
  }
  snprintf(message, sizeof message, "--set %.400s: %s", set, m->message);
  refused(ONE, set, message, "");
  case_parse("f", ONE, strlen(ONE), 1, &set, &sc, &err);
  assert_string_equal(err.message, message);
}

static void mistakes_name_the_assignment(CHECK_STATE) { each_mistake("assignments", 27, refused_or_accepted); }

/* The samples came from the file, the harmonics from the assignment: it is the assignment that broke it. */
static void the_one_given_last_is_blamed(CHECK_STATE)
{
  refused(SMALLEST "hbm: {samples: 16, force: sampled}\n", "hbm.harmonics=8",
          "--set hbm.harmonics=8: 16 samples cannot tell 8 harmonics apart", "");
  refused(SMALLEST "hbm: {samples: 9, force: sampled}\n", "oscillator.mass=8", "f:4:16: 9 samples", "");
  refused(SMALLEST "hbm: {force: sampled}\n", "hbm.samples=10",
          "--set hbm.samples=10: 10 samples cannot tell 5 harmonics apart, expected hbm.samples >= 11", "");
  const char *set[] = {"hbm.samples=9", "hbm.harmonics=4", "hbm.harmonics=5"},
             *sampled = SMALLEST "hbm: {force: sampled}\n";
  case_error err;
  CHECK_FILLED(scene, sc, case_parse("f", sampled, strlen(sampled), 2, set, &sc, &err));
  scene_kept(sc);
  assert_int_equal(case_parse("f", sampled, strlen(sampled), 3, set, &sc, &err), HC_BAD_INPUT);
  assert_int_equal(strncmp(err.message, "--set hbm.harmonics=5: 9 samples", 32), 0);
}

static void a_wrong_file_is_not_mended_by_assignments(CHECK_STATE)
{
  refused("oscillator: {mass: 0, damping: 0, stiffness: 1}\n", "oscillator.mass=1",
          "f:1:20: ", "oscillator.mass is `0`");
}

static void sixteen_contacts_and_no_more(CHECK_STATE)
{
  char set[17][128];
  const char *list[17];
  case_error err;
  for (int i = 0; i < 17; ++i) {
    snprintf(set[i], sizeof set[i], "contacts[%d]=%s", i, CONTACT_1);
    list[i] = set[i];
  }
  CHECK_FILLED(scene, sc, case_parse("f", SMALLEST, strlen(SMALLEST), 16, list, &sc, &err));
  scene_kept(sc);
  assert_int_equal(sc.structure->n_contacts, 16);
  assert_int_equal(case_parse("f", SMALLEST, strlen(SMALLEST), 17, list, &sc, &err), HC_BAD_INPUT);
  assert_non_null(strstr(err.message, "the case has 16 contacts, expected an index 0..15"));
}

CHECK_TESTS("cases.set", 60, every_kind_can_be_set, lists_with_or_without_brackets,
            contacts_are_reached_replaced_and_appended, a_contact_may_be_appended_field_by_field,
            later_ones_win_and_rivals_give_way, mistakes_name_the_assignment, the_one_given_last_is_blamed,
            a_wrong_file_is_not_mended_by_assignments, sixteen_contacts_and_no_more)
