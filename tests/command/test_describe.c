/* test_describe.c - hbmcheck describe for programs: fields, values, where each is from, and what follows. */
#include "tests/shell.h"

#define CASE2 "cases/paper/case2.yaml"

static char out[65536];

static void expect(const char *args, int code, const char *fragment)
{
  char line[512];
  snprintf(line, sizeof line, "%s describe %s", HBMCHECK_COMMAND, args);
  int found = shell_read(line, out, sizeof out);
  shell_check(args, found, out, code, fragment);
}

static void every_field_is_there_for_programs(CHECK_STATE)
{
  expect("--format json", 0, "\"field\": \"hbm.samples\", \"symbol\": \"N\", \"unit\": \"1\", \"kind\": \"integer\"");
  expect("--format json", 0, "\"choices\": \"exact|sampled\"");
  expect("hbm.samples --format json", 0, "\"low\": 3.0, \"high\": 16777216.0, \"default\": \"1024\"");
  assert_null(strstr(out, "hbm.harmonics"));
  expect("contacts --format csv", 0, "field,symbol,unit,kind,expected,choices,low,high,default,required,meaning\n");
  expect("contacts --format csv", 0, "contacts[].friction,mu,1,number,a number >= 0,,0,,,yes,");
  expect("mass --format csv", 0, "oscillator.mass,M,");
  expect("transient.richardson 2>&1", 64, "transient.richardson was removed: law: exact is nearer");
  expect("hbm.sampls --format json 2>&1", 64, "did you mean `hbm.samples`?");
  expect("hbm.samples", 0, "hbm.samples: per period"); /* people still get a page */
}

static void a_case_says_where_its_values_are_from(CHECK_STATE)
{
  expect("--case " CASE2 " --format csv", 0, "\noscillator.mass,1,force time^2/length,file,4,20,,M,");
  expect("--case " CASE2 " --format csv", 0, "\nhbm.force,exact,,default,,,exact,");
  expect("--case " CASE2 " --format csv", 0, "\ncontacts[0].gap,-5,length,file,7,92,0,g,");
  expect("--case " CASE2 " --set contacts[0].gap=-4 --format csv", 0, "\ncontacts[0].gap,-4,length,--set,,,0,g,");
  expect("--case " CASE2 " --set hbm.force=sampled --format csv", 0, "\nhbm.force,sampled,,--set,,,exact,");
  /* a second contact's fields are its own, not the first one's */
  expect("--case " CASE2
         " --set 'contacts[1]={tangential_stiffness: 1, normal_stiffness: 2, friction: 0, angle_deg: 0}' --format csv",
         0, "\ncontacts[1].gap,0,length,default,,,0,g,");
  assert_non_null(strstr(out, "\ncontacts[1].normal_stiffness,2,force/length,--set,,,"));
  assert_non_null(strstr(out, "\ncontacts[0].gap,-5,length,file,7,92,0,g,"));
  /* of rivals the one in force */
  expect("--case " CASE2 " --set sweep.frequency=1,2 --format csv", 0,
         "\nsweep.frequency,\"[1, 2]\",cycles/time,--set,");
  assert_non_null(strstr(out, "\nsweep.omega,,rad/time,,,,,"));
  expect("--case " CASE2 " --set compare.frequency=1 --format csv", 0, "\ncompare.omega,[6.28318530");
  assert_non_null(strstr(out, "],rad/time,--set,"));
  expect("hbm.force --case " CASE2 " --format json", 0, "\"value\": \"exact\", \"unit\": null, \"from\": \"default\"");
  expect("--case " CASE2, 0, "hbm.harmonics                     10");
}

/* The value in the csv row of that quantity. */
static double derived(const char *quantity)
{
  char row[64];
  snprintf(row, sizeof row, "\n%s,", quantity);
  const char *at = strstr(out, row);
  if (!at) fail_msg("no %s in:\n%s", quantity, out);
  return strtod(at + strlen(row), NULL);
}

/* M = 1, C = 0.4, K = 40, F0 = 100; kt = 100, kn = 1000 at 45 degrees: 550 beside K while it sticks. To rounding. */
static void what_follows_is_what_the_formulas_say(CHECK_STATE)
{
  static const double rounding = 1e-14;
  expect("--case " CASE2 " --format csv", 0, "\n# Derived\n");
  CHECK_NEAR(derived("omega_open"), sqrt(40), 7 * rounding, "open");
  CHECK_NEAR(derived("omega_stuck"), sqrt(590), 25 * rounding, "stuck");
  CHECK_NEAR(derived("frequency_open"), sqrt(40) / TWO_PI, 2 * rounding, "open");
  CHECK_NEAR(derived("damping_ratio_open"), 0.4 / (2 * sqrt(40)), rounding, "open");
  CHECK_NEAR(derived("static_deflection"), 2.5, 3 * rounding, "F0/K");
  CHECK_NEAR(derived("contacts[0].preload"), 0, 0, "a clearance");
  CHECK_NEAR(derived("contacts[0].touches_at"), 5 * sqrt(2), 8 * rounding, "touches");
  expect("--case " CASE2 " --set contacts[0].gap=0.1 --format csv", 0, "");
  CHECK_NEAR(derived("contacts[0].preload"), 100, 100 * rounding, "kn gap");
  CHECK_NEAR(derived("contacts[0].friction_limit"), 30, 30 * rounding, "mu kn gap");
  CHECK_NEAR(derived("contacts[0].touches_at"), -0.1 * sqrt(2), rounding, "leaves");
  expect("--case " CASE2 " --set contacts[0].angle_deg=0 --format csv", 0, "\ncontacts[0].touches_at,,length,");
}

static void mistakes_are_named(CHECK_STATE)
{
  expect("--set hbm.force=sampled 2>&1", 64, "--set has no case file");
  expect("--case /nonexistent.yaml 2>&1", 2, "/nonexistent.yaml: cannot be opened");
  expect("--case " CASE2 " --set hbm.harmonics=0 2>&1", 2, "hbm.harmonics is `0`");
  expect(CASE2 " 2>&1", 64, "what that file says: hbmcheck describe --case " CASE2);
  expect("hbm.sampls --case " CASE2 " 2>&1", 64, "did you mean `hbm.samples`?");
}

CHECK_TESTS("command.describe", 60, every_field_is_there_for_programs, a_case_says_where_its_values_are_from,
            what_follows_is_what_the_formulas_say, mistakes_are_named)
