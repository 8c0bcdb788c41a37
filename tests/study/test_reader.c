/* test_reader.c - every mistake in a study file is one message with its place, what is wrong and what was expected. */
#include "tests/study/study_text.h"

typedef struct mistake {
  const char *text, *place, *words;
} mistake;

static void refuse(const mistake *m, int n_set, const char *const *set)
{
  case_error err;
  study *s = study_from_text(m->text, n_set, set, &err);
  const char *place = strstr(err.message, m->place);
  if (!s && place && strstr(err.message, m->words)) return;
  print_error("%s\nexpected '%s' and '%s', got: %s\n", m->text, m->place, m->words, s ? "no error" : err.message);
  study_free(s);
  fail();
}

#define STUDY "study: t\n"
#define VARY  "vary: [{hbm.samples: [32, 64]}]\n"
#define V     STUDY CASE "vary:\n  - "
#define C     STUDY CONTACT_CASE "vary:\n  - "
#define K     STUDY CASE VARY "claims:\n  - "

static void in_the_file(CHECK_STATE)
{
  static const mistake all[] = {
      /* the frame */
      {"", ":1:1: ", "nothing here, expected a study with `study`, `base` or `case`, and `vary`"},
      {"[1]\n", ":1:1: ", "the study is a list, expected a mapping with"},
      {CASE VARY, ":1:1: ", "missing key `study`, expected the study's title"},
      {STUDY VARY, ":1:1: ", "missing key `base`"},
      {STUDY CASE, ":1:1: ", "missing key `vary`"},
      {STUDY "base: a.yaml\n" CASE VARY, ":3:1: ", "both `base` and `case`, expected one of them"},
      {STUDY STUDY CASE VARY, ":2:1: ", "duplicate key `study`, expected it once (first on line 1)"},
      {STUDY CASE "varry: []\n", ":3:1: ", "unknown key `varry` in a study, did you mean `vary`?"},
      {STUDY CASE "hbm: {}\n" VARY,
       ":3:1: ", "unknown key `hbm` in a study, expected fields of the case in `case`, `set` or `vary`"},
      {STUDY CASE "colour: 1\n" VARY,
       ":3:1: ", "expected one of study, base, case, run, set, vary, views, claims, may_fail"},
      {STUDY CASE "[a]: 1\n" VARY, ":3:1: ", "stands where a key should"},
      {"study: [a]\n" CASE VARY, ":1:8: ", "study is a list, expected text"},
      {STUDY CASE "run: fast\n" VARY, ":3:6: ", "run is `fast`, expected frf, transient or compare"},
      {STUDY CASE "run: [frf]\n" VARY, ":3:6: ", "run is a list, expected frf, transient or compare"},
      {STUDY "base: /nonexistent/c.yaml\n" VARY, ":2:7: ", "the base case: /nonexistent/c.yaml: cannot be opened"},
      {STUDY "base: {a: b}\n" VARY, ":2:7: ", "base is a mapping, expected text"},
      {STUDY "case: {oscillator: {mass: -1}}\n" VARY, ":2:27: ", "oscillator.mass is `-1`, expected a number > 0"},
      {STUDY "case: 5\n" VARY, ":2:7: ", "the case is a single value"},
      {STUDY CONTACT_CASE "vary:\n  - {contacts[0].gap: [1, 2]}\n", ":4:", "in braces quote an indexed name"},
      /* `set` */
      {STUDY CASE "set: 5\n" VARY, ":3:6: ", "set is a single value, expected a mapping such as"},
      {STUDY CASE "set: {hbm.harmonic: 3}\n" VARY,
       ":3:7: ", "unknown field `hbm.harmonic`, did you mean `hbm.harmonics`?"},
      {STUDY CASE "set: {hbm.harmonics: 0}\n" VARY,
       ":3:22: ", "hbm.harmonics is `0`, expected an integer 1..200 or auto"},
      {STUDY CASE "set: {hbm.tolerance: \"1e-9\"}\n" VARY, ":3:22: ", "in quotes it is text"},
      {STUDY CASE "set: {hbm.samples: 3}\n" VARY,
       ":4:9: ", "`hbm.samples` is given twice, expected it once (also `hbm.samples` on line 3)"},
      {STUDY CASE "set: {hbm.harmonics: 3, hbm.harmonics: 4}\n" VARY, ":3:25: ", "`hbm.harmonics` is given twice"},
      {STUDY CASE "set: {compare.points: 3}\nvary: [{compare.omega: [[5], [6]]}]\n",
       ":4:9: ", "(also `compare.points` on line 3)"},
      /* the axes of `vary` */
      {STUDY CASE "vary: []\n", ":3:7: ", "vary is an empty list, expected a list of axes"},
      {STUDY CASE "vary: {hbm.samples: [3]}\n", ":3:7: ", "vary is a mapping, expected a list of axes"},
      {V "{}\n", ":4:5: ", "an axis is empty"},
      {V "5\n", ":4:5: ", "an axis is a single value, expected {FIELD: [VALUE, ...]}"},
      {V "{hbm.sample: [3, 4]}\n", ":4:6: ", "unknown field `hbm.sample`, did you mean `hbm.samples`?"},
      {V "{hbm: [3, 4]}\n", ":4:6: ", "`hbm` is a section, expected one of its fields"},
      {V "{hbm.samples: 32}\n",
       ":4:19: ", "`hbm.samples` varies over a single value, expected a list of values or {from: A, to: B, count: N}"},
      {V "{hbm.samples: []}\n", ":4:19: ", "`hbm.samples` varies over an empty list"},
      {V "{hbm.samples: [32, 2]}\n", ":4:24: ", "hbm.samples is `2`, expected an integer 3..16777216 or auto"},
      {V "{hbm.samples: [32, 1e2]}\n", ":4:24: ", "hbm.samples is `1e2`, expected an integer"},
      {V "{hbm.samples: [32, [64]]}\n", ":4:24: ", "hbm.samples is a list"},
      {V "{hbm.samples: [32, {a: 1}]}\n", ":4:24: ", "hbm.samples is a mapping"},
      {V "{oscillator.mass: [1, nan]}\n", ":4:27: ", "it must be finite"},
      {V "{hbm.force: [exact, sample]}\n", ":4:25: ", "hbm.force is `sample`, expected exact or sampled"},
      {V "{sweep.omega: [3, 20]}\n", ":4:20: ", "sweep.omega is `3`, expected two numbers"},
      {V "{hbm.samples: [32, 64, 32]}\n",
       ":4:28: ", "`hbm.samples` has the value `32` twice, expected different values"},
      {V "{oscillator.mass: [1, 2, 1.0]}\n", ":4:30: ", "`oscillator.mass` has the value `1` twice"},
      {V "{oscillator.mass: [1, 1], hbm.static: [true, true]}\n", ":4:27: ", "twice with the same companions"},
      {V "{oscillator.mass: [1, 2], hbm.static: [true, false, true]}\n",
       ":4:43: ", "`hbm.static` has 3 values but `oscillator.mass` on the same axis has 2, expected as many"},
      {V "{oscillator.mass: [1, 2]}\n  - {oscillator.mass: [3]}\n", ":5:6: ", "`oscillator.mass` is given twice"},
      {V "{oscillator.mass: [1, 2], oscillator.mass: [3, 4]}\n", ":4:31: ", "`oscillator.mass` is given twice"},
      {V "{sweep.omega: [[1, 2]], sweep.frequency: [[1, 2]]}\n", ":4:29: ", "(also `sweep.omega` on line 4)"},
      {C "\"contacts[1].gap\": [1]\n", ":4:5: ", "cannot vary, expected a field of a contact that the base case has"},
      {C "\"contacts[2].gap\": [1]\n", ":4:5: ", "the case has 1 contacts"},
      {C "contacts: [[]]\n", ":4:5: ", "`contacts` cannot vary"},
      {C "contacts.gap: [1]\n", ":4:5: ", "unknown field `contacts.gap`"},
      {V
       "{oscillator.mass: {from: 1, to: 100, count: 1001}}\n  - {oscillator.damping: {from: 1, to: 2, count: 1000}}\n",
       ":5:5: ", "the grid has 1001000 scenes up to here, expected at most 1000000"},
      /* their ranges */
      {V "{oscillator.mass: {from: 1, to: 2}}\n",
       ":4:23: ", "has an incomplete range, expected {from: A, to: B, count: N}"},
      {V "{oscillator.mass: {}}\n", ":4:23: ", "has an incomplete range"},
      {V "{oscillator.mass: {from: 1, to: 2, count: 0}}\n",
       ":4:47: ", "oscillator.mass: `count` is `0`, expected an integer 1..1000000"},
      {V "{oscillator.mass: {from: 1, to: 2, count: 1.5}}\n", ":4:47: ", "expected an integer 1..1000000"},
      {V "{oscillator.mass: {from: 1, to: 2, count: 1000001}}\n", ":4:47: ", "expected an integer 1..1000000"},
      {V "{oscillator.mass: {from: 1, to: x, count: 2}}\n",
       ":4:37: ", "oscillator.mass: `to` is `x`, expected a number"},
      {V "{oscillator.mass: {from: 1, to: [2], count: 2}}\n", ":4:37: ", "`to` is a list, expected a number"},
      {V "{oscillator.mass: {from: 1, to: 2, count: 2, scale: cubic}}\n",
       ":4:57: ", "`scale` is `cubic`, expected linear or log"},
      {V "{oscillator.mass: {from: 1, to: 2, counts: 2}}\n",
       ":4:40: ", "unknown key `counts` in the range of `oscillator.mass`, did you mean `count`?"},
      {V "{oscillator.mass: {from: 1, from: 2, count: 2}}\n", ":4:33: ", "duplicate key `from`"},
      {V "{forcing.amplitude: {from: 0, to: 2, count: 2, scale: log}}\n",
       ":4:25: ", "log range that does not stay above 0"},
      {C "\"contacts[0].gap\": {from: -5, to: -1, count: 2, scale: log}\n",
       ":4:24: ", "log range that does not stay above 0"},
      {V "{oscillator.mass: {from: 1, to: 2, count: 1}}\n", ":4:23: ", "has a range of one value with two ends"},
      {V "{oscillator.mass: {from: 2, to: 2, count: 3}}\n", ":4:23: ", "has a range whose ends are equal"},
      {V "{oscillator.mass: {from: -1, to: 1, count: 3}}\n",
       ":4:23: ", "oscillator.mass is `-1`, expected a number > 0 (value 1 of 3 of the range)"},
      {V "{hbm.harmonics: {from: 1, to: 10, count: 3}}\n",
       ":4:21: ", "hbm.harmonics is `5.5`, expected an integer 1..200 or auto"},
      {V "{hbm.static: {from: 0, to: 1, count: 2}}\n", ":4:18: ", "`hbm.static` is no number, expected a list"},
      /* `claims`, `views` */
      {STUDY CASE VARY "claims: 3\n", ":4:9: ", "claims is a single value, expected a list of"},
      {K "a\n", ":5:5: ", "a claim is a single value"},
      {K "{say: a}\n", ":5:6: ", "unknown key `say` in a claim, did you mean `says`?"},
      {K "{says: a}\n", ":5:5: ", "missing key `holds` in a claim, expected an SQL query"},
      {K "{holds: SELECT 1}\n", ":5:5: ", "missing key `says` in a claim"},
      {K "{says: a, says: b, holds: SELECT 1}\n", ":5:15: ", "duplicate key `says`"},
      {K "{says: a, holds: [SELECT 1]}\n", ":5:22: ", "holds is a list, expected text"},
      {K "{says: a, holds: SELECT 1, expect: maybe}\n", ":5:40: ", "expected agree, disagree or unsaid"},
      {K "{says: a, paper: SELECT 1}\n", ":5:22: ", "paper is a single value, expected {found: \"SELECT ...\""},
      {K "{says: a, paper: {found: SELECT 1}}\n", ":5:22: ", "missing key `holds` in `paper`"},
      {K "{says: a, ours: {hold: SELECT 1}}\n",
       ":5:22: ", "unknown key `hold` in the answer to a claim, did you mean `holds`?"},
      {K "{says: a, found: SELECT 1, ours: {holds: SELECT 1}}\n",
       ":5:15: ", "`found` beside `paper`, `ours` or `fixed_step`, expected it within them"},
      {K "{says: a, seconds: -1, ours: {holds: SELECT 1}}\n",
       ":5:24: ", "seconds is `-1`, expected how many the source reports, a number >= 0"},
      {STUDY CASE VARY "may_fail: perhaps\n", ":4:11: ", "expected true or false"},
      {STUDY CASE VARY "views: SELECT 1\n", ":4:8: ", "views is a single value, expected a mapping"},
      {STUDY CASE VARY "views: {scene: SELECT 1}\n", ":4:9: ", "a view is called `scene`, expected lower-case letters"},
      {STUDY CASE VARY "views: {a: SELECT 1, a: SELECT 2}\n",
       ":4:22: ", "a view is called `a`, expected a name of its own"},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) refuse(&all[i], 0, NULL);
}

static void options(CHECK_STATE)
{
  static const char *const twice[] = {"hbm.samples=3"}, *const unknown[] = {"hbm.sample=3"},
                           *const wrong[] = {"hbm.harmonics=x"};
  refuse(&(mistake){STUDY CASE VARY, ":3:9: ", "(also `hbm.samples` by --set)"}, 1, twice);
  refuse(&(mistake){STUDY CASE VARY, "--set hbm.sample=3: ", "did you mean `hbm.samples`?"}, 1, unknown);
  refuse(&(mistake){STUDY CASE VARY, "--set hbm.harmonics=x: ", "hbm.harmonics is `x`"}, 1, wrong);
}

/* A base file's own mistakes are told with its own name; its name is seen from the study's folder. */
static void a_base_beside_the_study(CHECK_STATE)
{
  char path[64];
  case_error err = {{0}};
  study *s = NULL;
  snprintf(path, sizeof path, "%s/s.yaml", folder);
  folder_put("s.yaml", "study: t\nbase: b.yaml\nvary: [{oscillator.mass: [1, 2]}]\n");
  folder_put("b.yaml", "oscillator: {mass: 1, damping: 0.4, stiffness: 4x}\n");
  assert_int_equal(study_read(path, 0, NULL, &s, &err), HC_BAD_INPUT);
  assert_non_null(strstr(err.message, "/b.yaml:1:48: oscillator.stiffness is `4x`"));
  folder_put("b.yaml",
             "oscillator: {mass: 1, damping: 0.4, stiffness: 40}\nforcing: {amplitude: 1}\nsweep: {omega: [3, 9]}\n");
  assert_int_equal(study_read(path, 0, NULL, &s, &err), HC_OK);
  assert_int_equal(s->n_scenes, 2);
  study_free(s);
}

CHECK_TESTS_WITH("study.reader", 60, folder_make, folder_remove, in_the_file, options, a_base_beside_the_study)
