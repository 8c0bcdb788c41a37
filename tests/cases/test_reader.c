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
  assert_true(sc.mass == 1.5 && sc.damping == 0.25 && sc.stiffness == 0 && sc.force == 0 && sc.omega_from == 20 &&
              sc.omega_to == 3);
  assert_int_equal(sc.n_contacts, 2);
  const scene_contact *a = &sc.contacts[0], *b = &sc.contacts[1];
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
  assert_true(sc.force == 5);
  accepted(SMALLEST "title: \"\"\ncontacts: []\n", NULL, &sc);
  assert_string_equal(sc.title, "");
  /* too few samples matter only when sampling */
  accepted(SMALLEST "hbm: {force: 'exact', harmonics: 7, samples: 3}\n", NULL, &sc);
  accepted(SMALLEST "hbm: {samples: 11}\n", NULL, &sc);
  accepted(SMALLEST "hbm: {}\n", NULL, &sc);
  case_error err;
  assert_int_equal(case_parse("dir.d/caf\xC3\xA9.v2.yaml", SMALLEST, strlen(SMALLEST), 0, NULL, &sc, &err), HC_OK);
  assert_string_equal(sc.title, "caf\xC3\xA9.v2");
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

/* In lines after SMALLEST, from line 4 on. */
static const mistake extra[] = {
    /* unknown keys */
    {"hbm: {sample: 3}", "f:4:7: ", "unknown key `sample` in `hbm`, did you mean `samples`?"},
    {"hbm:\n  samples: 64\n  harmonic: 3", "f:6:3: ", "did you mean `harmonics`?"},
    {"transient: {law: exact, richardson: false}",
     "f:4:25: ", "transient.richardson was removed: law: exact is nearer to the limit at less cost"},
    {"samples: 3", "f:4:1: ", "unknown key `samples`, did you mean `hbm.samples`?"},
    {"hbms: {}", "f:4:1: ", "did you mean `hbm`?"},
    {"contact: []", "f:4:1: ", "did you mean `contacts`?"},
    {"contacts: [{kt: 1}]", "f:4:13: ", "did you mean `tangential_stiffness`?"},
    {"hbm: {max_periods: 3}", "f:4:7: ", "did you mean `transient.max_periods`?"},
    {"hbm: {gate: 3}", "f:4:7: ", "did you mean `gate` at the top level?"},
    {"transient: {regularization: 1e-4}", "f:4:13: ", "did you mean `regularisation`?"},
    {"zzz: 1", "f:4:1: ",
     "expected one of title, response, units, oscillator, structure, forcing, contacts, sweep, hbm, transient, "
     "compare, gate"},
    {"hbm: {zzz: 1}", "f:4:7: ", "expected one of harmonics, static, force"},
    /* two letters start too many names */
    {"hbm: {st: 1}", "f:4:7: ", "unknown key `st` in `hbm`, expected one of harmonics"},
    {"hbm: {stat: 1}", "f:4:7: ", "did you mean `static`?"},
    {"[1]: 2", "f:4:1: ", "a list stands where a key should"},
    /* duplicates and rivals */
    {"forcing: {amplitude: 1}", "f:4:1: ", "duplicate key `forcing`, expected it once (first on line 2)"},
    {"title: a\ntitle: b", "f:5:1: ", "duplicate key `title`"},
    {"hbm: {samples: 64, samples: 64}", "f:4:20: ", "duplicate key `samples`"},
    {"contacts: [" CONTACT_1 ", {gap: 1, gap: 2}]", "f:4:113: ", "duplicate key `gap`"},
    {"compare: {omega: [5], points: 3}", "f:4:23: ", "both `omega` (line 4) and `points` in `compare`"},
    /* wrong types */
    {"hbm: 5", "f:4:6: ", "hbm is a single value, expected a mapping such as {harmonics: ..., static: ..., ...}"},
    {"hbm:", "f:4:5: ", "hbm is empty"},
    {"hbm: [1]", "f:4:6: ", "hbm is a list, expected a mapping"},
    {"contacts: {gap: 1}", "f:4:11: ", "contacts is a mapping, expected a list of contacts"},
    {"contacts: [1]", "f:4:12: ", "contacts[0] is a single value, expected a mapping"},
    {"hbm: {samples: [64]}", "f:4:16: ", "hbm.samples is a list, expected an integer 3..16777216 or auto"},
    {"hbm: {samples: {n: 64}}", "f:4:16: ", "hbm.samples is a mapping, expected an integer"},
    {"hbm: {samples: }", "f:4:16: ", "hbm.samples is empty"},
    {"compare: {omega: 5}", "f:4:18: ", "compare.omega is `5`, expected a list of numbers > 0"},
    {"compare: {omega: [1, [2]]}", "f:4:22: ", "compare.omega has a list inside"},
    {"compare: {omega: []}",
     "f:4:18: ", "compare.omega is a list of 0, expected a list of numbers > 0 (1 to 1024 of them)"},
    {"title: [a]", "f:4:8: ", "title is a list, expected text"},
    {"title:", "f:4:7: ", "title is empty"},
    {"title: \"a\\nb\"", "f:4:8: ", "title is `a\\x0Ab`, expected text of at most 127 bytes (on one line"},
    {"units: {length: sixteen_letters_}", "f:4:17: ", "expected text of at most 15 bytes (too long)"},
    /* numbers, integers, flags, choices */
    {"hbm:\n  tolerance: 12,5",
     "f:5:14: ", "hbm.tolerance is `12,5`, expected a number 1e-14..0.01 (the decimal sign is a point)"},
    {"hbm:\n  tolerance: 1e5, 3", "f:5:14: ", "hbm.tolerance is `1e5, 3`"},
    {"hbm: {tolerance: nan}", "f:4:18: ", "(it must be finite)"},
    {"hbm: {tolerance: -.inf}", "f:4:18: ", "(it must be finite)"},
    {"gate: {mean: 1e999}", "f:4:14: ", "expected a number > 0 (too large"},
    {"gate: {mean: 1e-999}", "f:4:14: ", "expected a number > 0 (too small"},
    {"hbm: {tolerance: 0x10}", "f:4:18: ", "`0x10`"},
    {"hbm: {samples: 1_000}", "f:4:16: ", "`1_000`"},
    {"hbm: {samples: \"1024\"}", "f:4:16: ", "(in quotes it is text)"},
    {"hbm: {samples: 1e3}", "f:4:16: ", "(write it in digits only)"},
    {"hbm: {samples: 99999999999}", "f:4:16: ", "(too large to be held)"},
    {"hbm: {static: yes}", "f:4:15: ", "hbm.static is `yes`, expected true or false"},
    {"hbm: {static: off}", "f:4:15: ", "expected true or false"},
    {"hbm: {static: 1}", "f:4:15: ", "expected true or false"},
    {"hbm: {static: 'true'}", "f:4:15: ", "(in quotes it is text)"},
    {"hbm: {force: Exact}", "f:4:14: ", "hbm.force is `Exact`, expected exact or sampled"},
    {"hbm: {continuation: newton}", "f:4:21: ", "expected auto, natural, arclength or fixed_step"},
    {"hbm: {continuation: fixed_step, harmonics: auto}", "f:4:21: ",
     "hbm.harmonics: auto adapts the step, too, expected a number of harmonics with hbm.continuation: fixed_step"},
    {"hbm: {samples: auto, force: sampled, continuation: fixed_step}", "f:4:52: ", "expected a number of samples"},
    {"hbm: {step: 0}", "f:4:13: ", "hbm.step is `0`"},
    {"hbm: {iterations: 0}", "f:4:19: ", "1..1000"},
    /* ranges */
    {"hbm: {harmonics: 0}", "f:4:18: ", "hbm.harmonics is `0`, expected an integer 1..200 or auto"},
    {"hbm: {harmonics: 201}", "f:4:18: ", "1..200"},
    {"hbm: {samples: 2}", "f:4:16: ", "3..16777216"},
    {"hbm: {tolerance: 9e-15}", "f:4:18: ", "1e-14..0.01"},
    {"transient: {regularisation: 0.2}", "f:4:29: ", "1e-8..0.1"},
    {"transient: {tolerance: 0.02}", "f:4:24: ", "1e-13..0.01"},
    {"transient: {max_periods: 10000001}", "f:4:26: ", "1..10000000"},
    {"compare: {omega: [1, 0, 2]}", "f:4:22: ", "compare.omega has the entry `0`, expected a list of numbers > 0"},
    {"compare: {harmonics: [1, 201]}", "f:4:26: ", "integers 1..200"},
    {"compare: {samples: [2]}", "f:4:21: ", "integers 3.."},
    {"compare: {points: 0}", "f:4:19: ", "1..1024"},
    {"compare: {points: 1025}", "f:4:19: ", "1..1024"}, /* as many as a number_list holds */
    {"gate: {waveform: 0}", "f:4:18: ", "expected a number > 0"},
    {"gate: {iterations: -1}", "f:4:20: ", "gate.iterations is `-1`, expected an integer 0.."},
    {"gate: {amplitud: 1e-3}", "f:4:8: ", "did you mean `amplitude`?"},
    {"gate: {range_mean: 1e-3}", "f:4:20: ", "expected a list of numbers > 0"},
    {"gate:\n  ranges: [7, 9, 12]\n  range_mean: [1]",
     "f:5:11: ", "ends in a single 12, expected FROM, TO, FROM, TO, ..."},
    {"gate: {ranges: [9, 7], range_mean: [1]}", "f:4:16: ", "a range from 9 to 7, expected FROM <= TO"},
    {"gate: {ranges: [7, 9], range_mean: [1, 2]}",
     "f:4:36: ", "gate.range_mean has 2 limits for 1 range in gate.ranges, expected one for each"},
    {"gate: {range_waveform: [1]}", "f:4:24: ", "gate.range_waveform has 1 limit for 0 ranges"},
    {"gate: {ranges: [7, 9]}", "f:4:16: ", "gate.ranges without limits"},
    {"contacts: [{tangential_stiffness: -1}]",
     "f:4:35: ", "contacts[0].tangential_stiffness is `-1`, expected a number >= 0"},
    {"contacts:\n  - " CONTACT_1 "\n  - {angle_deg: 90.5}",
     "f:6:17: ", "contacts[1].angle_deg is `90.5`, expected a number 0..90"},
    /* missing */
    {"contacts: [{gap: 1}]", "f:4:12: ", "missing key `tangential_stiffness` in `contacts[0]`, expected a number >= 0"},
    /* across fields */
    {"hbm: {samples: 10, force: sampled}",
     "f:4:16: ", "10 samples cannot tell 5 harmonics apart, expected hbm.samples >= 11"},
    {"transient: {method: closed_form}",
     "f:4:21: ", "only the exact law has a closed form, expected transient.law: exact"},
    {"transient: {law: regularised, method: closed_form}", "f:4:39: ", "only the exact law has a closed form"},
    {"transient: {method: closed_form, law: regularised}", "f:4:21: ", "only the exact law has a closed form"},
    {"transient: {method: closed}", "f:4:21: ", "closed_form"},
    {"transient: {scout: maybe}", "f:4:20: ", "true"},
    {"hbm:\n  harmonics: 8\n  samples: 16\n  force: sampled", "f:6:12: ", "expected hbm.samples >= 17"},
    /* not YAML, or more of it than a case needs */
    {"title: a: b", "f:4:9: ", "not YAML: mapping values are not allowed"},
    {"\ttitle: a", "f:4:1: ", "not YAML"},
    {"hbm: {samples: 64", "f:5:1: ", "not YAML"},
    {"---\ntitle: a", "f:4:1: ", "a second YAML document, expected one scene a file"},
    {"title: &a b", "f:4:8: ", "a YAML anchor"},
    {"title: *a", "f:4:8: ", "a YAML alias"},
    {"title: !!str b", "f:4:8: ", "a YAML tag"},
    {"%TAG ! x", "f:4:1: ", "a %TAG line"},
    {"title: a\x01", "f:4:9: ", "control character 0x01"},
    {"title: \xC3\xA9\xFF", "f:4:9: ", "byte 0xFF is not UTF-8"},
    {"title: \xC0\x80", "f:4:8: ", "byte 0xC0 is not UTF-8"},
    {"title: \xED\xA0\x80", "f:4:8: ", "byte 0xED is not UTF-8"},
};

/* Whole files. */
static const mistake whole[] = {
    {"", "f:1:1: ", "nothing here, expected a case with `oscillator`, `forcing` and `sweep`"},
    {"# only a comment\n", "f:1:1: ", "nothing here"},
    {"---\n", "f:2:1: ", "the case is empty, expected a mapping"},
    {"hello", "f:1:1: ", "the case is a single value, expected a mapping"},
    {"- 1\n", "f:1:1: ", "the case is a list"},
    {"{}", "f:1:1: ", "missing section `oscillator`, expected `oscillator: {mass: ..., damping: ..., stiffness: ...}`"},
    {"# c\noscillator: {mass: 1, damping: 0, stiffness: 1}\nsweep: {omega: [1, 2]}\n",
     "f:2:1: ", "missing section `forcing`, expected `forcing: {amplitude: ...}`"},
    {"oscillator: {mass: 1, damping: 0, stiffness: 1}\nforcing: {amplitude: 1}\n",
     "f:1:1: ", "missing section `sweep`, expected `sweep: {omega: ...}`"},
    {"oscillator: {mass: 1, stiffness: 1}\n",
     "f:1:13: ", "missing key `damping` in `oscillator`, expected a number >= 0"},
    {"sweep: {}\n", "f:1:8: ", "missing key `omega` in `sweep`, expected two numbers > 0, [FROM, TO], or `frequency`"},
    {"sweep: {omega: [1, 2], frequency: [1, 2]}\n", "f:1:24: ", "both `omega` (line 1) and `frequency`"},
    {"sweep: {omega: [1]}\n", "f:1:16: ", "sweep.omega is a list of 1, expected two numbers > 0, [FROM, TO]"},
    {"sweep: {omega: [1, 2, 3]}\n", "f:1:16: ", "sweep.omega is a list of 3"},
    {"sweep: {omega: [0, 2]}\n", "f:1:17: ", "sweep.omega has the entry `0`"},
    {"sweep: {frequency: [1, 1e308]}\n", "f:1:24: ", "too large"},
    {"oscillator: {mass: 0}\n", "f:1:20: ", "oscillator.mass is `0`, expected a number > 0"},
    {"oscillator: {mass: 12,5, damping: 1, stiffness: 1}\n", "f:1:23: ",
     "unknown key `5` in `oscillator`, expected one of mass, damping, stiffness (a comma ends a value: the decimal "
     "sign is a point)"},
    {"oscillator: {mass: 1, damping: -1}\n", "f:1:32: ", "oscillator.damping is `-1`, expected a number >= 0"},
    {"oscillator: {mass: 1, damping: 0, stiffness: 1}\nforcing: {amplitude: 1}\nsweep:\n  omega: [7, 7]\n",
     "f:4:10: ", "the sweep ends where it starts"},
};

static void mistakes_are_named_where_they_stand(CHECK_STATE)
{
  char text[1024];
  for (size_t i = 0; i < sizeof extra / sizeof *extra; ++i) {
    snprintf(text, sizeof text, SMALLEST "%s\n", extra[i].text);
    refused(text, NULL, extra[i].at, extra[i].words);
  }
  for (size_t i = 0; i < sizeof whole / sizeof *whole; ++i) refused(whole[i].text, NULL, whole[i].at, whole[i].words);
}

static void too_many_are_refused(CHECK_STATE)
{
  static char text[1 << 15];
  size_t n = (size_t)snprintf(text, sizeof text, "%scontacts:\n", SMALLEST);
  for (int i = 0; i < SCENE_MAX_CONTACTS; ++i) n += (size_t)snprintf(text + n, sizeof text - n, "  - %s\n", CONTACT_1);
  scene sc;
  accepted(text, NULL, &sc);
  assert_int_equal(sc.n_contacts, SCENE_MAX_CONTACTS);
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
