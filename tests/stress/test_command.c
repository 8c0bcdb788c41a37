/* test_command.c - hbmcheck stress as people use it: 200 scenes without a finding, stopped and resumed, one scene
 * again. Runs the built command (HBMCHECK_COMMAND) in a shell, in a folder of its own. */
#include "tests/folder.h"
#include "tests/shell.h"

static char out[262144]; /* what the last run said */

static void expect(const char *args, int code, const char *fragment)
{
  char line[2048];
  snprintf(line, sizeof line, "$H stress -q %s", args);
  shell_check(args, shell_read(line, out, sizeof out), out, code, fragment);
}

static void two_hundred_scenes_without_a_finding(CHECK_STATE)
{
  expect("--scenes 200", 0, "200 scenes of seed 1 from 0 on: 0 findings, 0 scenes never classified");
}

/* And structures, which have a journal and case files of their own. */
static void structures_without_a_finding(CHECK_STATE)
{
  expect("--structures --scenes 60 --results $D/structures", 0,
         "60 scenes of seed 1 from 0 on: 0 findings, 0 scenes never classified");
  expect("--structures --scenes 61 --results $D/structures --format csv", 0, "rotated,");
  expect("--scenes 60 --results $D/structures 2>&1", 2, "scenes of this kind");
  expect("--structures --first 3 --case > $D/one.yaml && $H modes $D/one.yaml", 0, "omega_open");
}

/* And those in space, with a check of their own. */
static void structures_in_space_without_a_finding(CHECK_STATE)
{
  expect("--space --first 3 --scenes 20 --results $D/space --format csv", 0, "turned_tangents,");
  expect("--structures --first 3 --scenes 5 --results $D/space 2>&1", 2, "scenes of this kind");
  expect("--space --first 3 --case > $D/space.yaml && $H modes $D/space.yaml", 0, "omega_open");
}

/* Of a journal's scenes all but the times. */
#define UNTIMED                                                                                                        \
  "awk '!/^#/ {o = $1; for (i = 3; i < NF; i += 6) o = o \" \" $i \" \" $(i + 1) \" \" $(i + 2) \" \" $(i + 3) \" \" " \
  "$(i + 4); print o}'"

/* Killed while it wrote, and gone on with: the same scenes with the same results as in one go. */
static void what_was_stopped_goes_on(CHECK_STATE)
{
  static char whole[sizeof out];
  expect("--seed 5 --scenes 12 --seconds 60 --jobs 1 --results $D/whole > /dev/null; grep -vc '#' $D/whole", 0, "12");
  expect(
      "--seed 5 --scenes 5 --seconds 60 --jobs 1 --results $D/part > /dev/null; head -c -40 $D/part > $D/cut; grep -vc "
      "'#' $D/cut",
      0, "5");
  expect("--seed 5 --scenes 12 --seconds 60 --jobs 2 --results $D/cut > /dev/null; " UNTIMED " $D/cut | sort", 0,
         "11 1 0 0 ");
  strcpy(whole, out);
  expect("--seed 5 --scenes 1 --case > /dev/null; " UNTIMED " $D/whole | sort", 0, "11 1 0 0 ");
  assert_string_equal(out, whole);
  expect("--seed 6 --scenes 12 --seconds 60 --results $D/whole 2>&1", 2, "not the results of this seed");
}

/* A journal of one scene, changed by sed: exit 2 with the reason, and it is left as it was. */
static void refuse_changed(const char *change, const char *words)
{
  char args[512];
  snprintf(
      args, sizeof args,
      "--seed 5 --scenes 1 --case >/dev/null; cd $D; sed '%s' one >changed; cmp -s one changed && exit 98; cp changed "
      "kept; $H stress -q --seed 5 --scenes 2 --seconds 60 --results changed 2>&1; c=$?; "
      "cmp kept changed || exit 99; exit $c",
      change);
  expect(args, 2, words);
}

static void a_journal_that_does_not_fit_is_refused(CHECK_STATE)
{
  expect("--seed 5 --scenes 1 --seconds 60 --results $D/one", 0, "1 scenes of seed 5 from 0 on");
  static const char *const other[] = {"1s/stress 4/stress 1/",
                                      "1s/stress 4/stress 5/",
                                      "2s/ units/ other_units/",
                                      "2s/ permuted rotated/ rotated permuted/",
                                      "3s/ agreed explained/ explained agreed/",
                                      "4s/ STRESS_SMOOTHED//",
                                      "5s/ HC_IO//",
                                      "5d"};
  for (size_t i = 0; i < sizeof other / sizeof *other; ++i)
    refuse_changed(other[i], "changed: not the results of this version of hbmcheck");
  refuse_changed("1s/seed 5/seed 6/", "not the results of this seed");
  refuse_changed("1s/60 s/61 s/", "not the results of this seed");
  refuse_changed("1s/.*/precious notes/", "not the results of this seed");
  refuse_changed("6s/ [.]$/ 1 ./", "or damaged");
  refuse_changed("6s/  [0-9]/  9/", "or damaged"); /* an outcome beyond the list */
}

static void one_scene_is_printed_as_a_case_file(CHECK_STATE)
{
  expect("--seed 5 --first 3 --case", 0, "Stress scene 3 of seed 5");
  expect("--seed 5 --first 3 --case --output $D/three.yaml && $H frf --quiet $D/three.yaml > /dev/null && echo read", 0,
         "read");
  expect("--seed 5 --first 3 --scenes 1 --all --format csv", 0, "3,verdict,");
}

/* CVODE's tolerance is relative to the mean, too, of 66 amplitudes; a slider rests at its limit, where multipliers are
 * one-sided, 0.969 and 1.060. */
static void a_large_mean_and_a_slider_at_its_limit_are_no_findings(CHECK_STATE)
{
  expect("--structures --seed 81130 --first 21 --scenes 1 --all --format csv", 0,
         "21,orbit_multiplier,explained,family,");
  expect("--structures --seed 320026 --first 283 --scenes 1 --all --format csv", 0, "283,orbit_cvode,agreed");
}

static void what_cannot_be_is_said(CHECK_STATE)
{
  expect("--scenes 0 2>&1", 64, "is not an integer 1..");
  expect("--seconds nan 2>&1", 64, "is not a number > 0");
  expect("--set hbm.harmonics=3 2>&1", 64, "no case file");
  expect("--scenes 1 --results $D 2>&1", 3, "directory");
  expect("--scenes 1 --results /dev/null/x 2>&1", 3, "Not a directory");
}

CHECK_TESTS_WITH("stress.command", 900, folder_make, folder_remove, two_hundred_scenes_without_a_finding,
                 structures_without_a_finding, structures_in_space_without_a_finding, what_was_stopped_goes_on,
                 a_journal_that_does_not_fit_is_refused, one_scene_is_printed_as_a_case_file,
                 a_large_mean_and_a_slider_at_its_limit_are_no_findings, what_cannot_be_is_said)
