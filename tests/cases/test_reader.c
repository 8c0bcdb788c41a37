/* test_reader.c - a case file read right, and every class of mistake with its exact position and words. */
#include "tests/cases/case_text.h"

static void everything_lands_where_it_belongs(CHECK_STATE)
{
  scene sc;
  accepted("title: T\n"
           "units: {length: mm, force: kN, time: ms}\n"
           "oscillator: {mass: 1.5, damping: 0.25, stiffness: 0}\n"
           "forcing: {amplitude: 0}\n"
           "contacts:\n"
           "  - {tangential_stiffness: 1, normal_stiffness: 2, friction: 3, angle_deg: 90, gap: -5}\n"
           "  - tangential_stiffness: 6\n"
           "    normal_stiffness: 7\n"
           "    friction: 8\n"
           "    angle_deg: 9\n"
           "sweep: {omega: [20, 3]}\n"
           "hbm: {harmonics: auto, static: false, force: exact, samples: auto, slider_restart: sample, continuation: "
           "arclength, tolerance: "
           "1e-8}\n"
           "transient: {law: exact, regularisation: 1e-3, steady_state: shooting, start: down, tolerance: 1e-7, "
           "max_periods: 9}\n"
           "compare: {points: 7, harmonics: [2], samples: [5, 16]}\n"
           "gate: {amplitude: 1, harmonic_1: 2, mean: 3, waveform: 4}\n",
           NULL, &sc);
  assert_string_equal(sc.title, "T");
  assert_string_equal(sc.unit_length, "mm");
  assert_string_equal(sc.unit_force, "kN");
  assert_string_equal(sc.unit_time, "ms");
  assert_true(*sc.structure->mass.v == 1.5 && *sc.structure->damping.v == 0.25 && *sc.structure->stiffness.v == 0 &&
              sc.structure->loads->amplitude == 0 && sc.omega_from == 20 && sc.omega_to == 3);
  assert_int_equal(sc.structure->n_contacts, 2);
  const scene_contact *a = &sc.structure->contacts[0].given, *b = &sc.structure->contacts[1].given;
  assert_true(a->law.kt == 1 && a->law.kn == 2 && a->law.mu == 3 && a->angle_deg == 90 && a->law.gap == -5);
  assert_true(b->law.kt == 6 && b->law.kn == 7 && b->law.mu == 8 && b->angle_deg == 9 && b->law.gap == 0);
  assert_true(sc.hbm.harmonics == HBM_AUTO && !sc.hbm.keep_mean && sc.hbm.force == HBM_FORCE_EXACT &&
              sc.hbm.samples == HBM_AUTO);
  assert_true(sc.hbm.restart == HBM_RESTART_SAMPLE && sc.hbm.continuation == HBM_CONTINUATION_ARCLENGTH &&
              sc.hbm.tolerance == 1e-8);
  assert_true(sc.transient.law == TRANSIENT_LAW_EXACT && sc.transient.regularisation == 1e-3 &&
              sc.transient.max_periods == 9);
  assert_true(sc.transient.steady == TRANSIENT_STEADY_SHOOTING && sc.transient.start == TRANSIENT_START_DOWN &&
              sc.transient.tolerance == 1e-7);
  assert_true(sc.compare.points == 7 && sc.compare.harmonics.n == 1 && sc.compare.harmonics.v[0] == 2);
  assert_true(sc.compare.samples.n == 2 && sc.compare.samples.v[0] == 5 && sc.compare.samples.v[1] == 16);
  assert_true(sc.gate.most.amplitude == 1 && sc.gate.most.harmonic_1 == 2 && sc.gate.most.mean == 3 &&
              sc.gate.most.waveform == 4);
}

static void harmless_forms_are_read(CHECK_STATE)
{
  scene sc;
  accepted("\xEF\xBB\xBF%YAML 1.1\n---\n" SMALLEST "...\n", NULL, &sc);
  accepted("# note\r\nforcing: {amplitude: +5}\r\noscillator:\r\n  mass: 1\r\n  damping: 0\r\n  stiffness: 1\r\nsweep: "
           "{omega: [1, 2]}\r\n",
           NULL, &sc);
  assert_true(sc.structure->loads->amplitude == 5);
  accepted(SMALLEST "title: \"\"\ncontacts: []\n", NULL, &sc);
  assert_string_equal(sc.title, "");
  /* too few samples matter only when sampling */
  accepted(SMALLEST "hbm: {force: 'exact', harmonics: 7, samples: 3}\n", NULL, &sc);
  accepted(SMALLEST "hbm: {samples: 11}\n", NULL, &sc);
  accepted(SMALLEST "hbm: {}\n", NULL, &sc);
  case_error err;
  assert_int_equal(case_parse("dir.d/caf\xC3\xA9.v2.yaml", SMALLEST, strlen(SMALLEST), 0, NULL, &sc, &err), HC_OK);
  assert_string_equal(sc.title, "caf\xC3\xA9.v2");
  case_clear(&sc);
}

/* omega = 2 pi f, one rounding in the constant and one in the product */
static void frequency_becomes_omega(CHECK_STATE)
{
  scene sc;
  accepted(
      "oscillator: {mass: 1, damping: 0, stiffness: 1}\nforcing: {amplitude: 1}\nsweep: {frequency: [0.5, 3.25]}\n",
      NULL, &sc);
  CHECK_NEAR(sc.omega_from, PI, PI * 2 * 0x1p-52, "0.5");
  CHECK_NEAR(sc.omega_to, 6.5 * PI, 6.5 * PI * 2 * 0x1p-52, "3.25");
}

static void refused_after_the_smallest(const mistake *m)
{
  char text[4096];
  snprintf(text, sizeof text, SMALLEST "%s\n", m->text);
  refused(text, NULL, m->at, m->words);
}

static void refused_as_it_stands(const mistake *m) { refused(m->text, NULL, m->at, m->words); }

static void mistakes_are_named_where_they_stand(CHECK_STATE)
{
  each_mistake("lines", 103, refused_after_the_smallest);
  each_mistake("files", 19, refused_as_it_stands);
}

static void too_many_are_refused(CHECK_STATE)
{
  static char text[1 << 15];
  size_t n = (size_t)snprintf(text, sizeof text, "%scontacts:\n", SMALLEST);
  for (int i = 0; i < SCENE_MAX_CONTACTS; ++i) n += (size_t)snprintf(text + n, sizeof text - n, "  - %s\n", CONTACT_1);
  scene sc;
  accepted(text, NULL, &sc);
  assert_int_equal(sc.structure->n_contacts, SCENE_MAX_CONTACTS);
  snprintf(text + n, sizeof text - n, "  - %s\n", CONTACT_1);
  refused(text, NULL, "f:21:5: ", "one contact too many, expected at most 16");
  n = (size_t)snprintf(text, sizeof text, "%scompare:\n  omega: [1", SMALLEST);
  for (int i = 1; i < NUMBER_LIST_MAX; ++i) n += (size_t)snprintf(text + n, sizeof text - n, ", %d", i);
  snprintf(text + n, sizeof text - n, "]\n");
  accepted(text, NULL, &sc);
  assert_int_equal(sc.compare.omega.n, NUMBER_LIST_MAX);
  snprintf(text + n, sizeof text - n, ", 3]\n");
  refused(text, NULL, "f:5:10: ", "compare.omega is a list of 1025");
}

CHECK_TESTS("cases.reader", 60, everything_lands_where_it_belongs, harmless_forms_are_read, frequency_becomes_omega,
            mistakes_are_named_where_they_stand, too_many_are_refused)
