/* test_command.c - the command as people and scripts use it: exit codes, columns, messages, files written whole or
 * not at all. Runs the built hbmcheck (HBMCHECK_COMMAND) in a shell; what it computes is tested elsewhere. */
#include "tests/folder.h"
#include "tests/program.h"

#define CASE2 "cases/paper/case2.yaml "

static void columns_are_the_interface(CHECK_STATE)
{
  expect("frf " CASE2 "--at 6 --format csv -q", 0, "omega,branch,amplitude,max,min,rms,mean,harmonic_1,");
  expect("transient " CASE2 "--at 6 --format csv -q", 0,
         "omega,verdict,amplitude,max,min,rms,mean,harmonic_1,periods,closure,period_multiple,steps");
  expect("compare " CASE2 "--at 5 --format csv -q", 0,
         "omega,branch,verdict,hbm_amplitude,transient_amplitude,amplitude_error,harmonic_1_error,"
         "mean_error,waveform_error");
  expect("compare " CASE2 "--at 6 --format csv -q", 0,
         ",largest_part,hbm_predicted,transient_predicted,hbm_predicted_harmonic_1,hbm_predicted_waveform,"
         "transient_predicted_harmonic_1,transient_predicted_waveform,unexpected,mean_free\n");
  expect("compare " CASE2 "--at 6 --format json -q", 0, "\"hbm_predicted_waveform\": 0.00");
  expect("contact " CASE2 "--motion 0,8,0 --samples 64 --format csv", 0, "harmonic,cos,sin,cos_64,sin_64");
  expect("contact " CASE2 "--motion 0,8,0", 0, "contact 0: sticks from 5.79649035"); /* 2 pi - arccos(5 sqrt(2)/8) */
  expect("compare " CASE2 "--at 5 --format json -q", 0, "\"verdict\": \"match\"");
}

static void verdicts_reach_the_exit_code(CHECK_STATE)
{
  expect("frf " CASE2 "--at 5 --at 6 2>&1", 64, "--at is given twice");
  expect("frf " CASE2 "--at 6,5,6 --format csv -q 2>&1", 0, "--at: 6 stands there twice, taken once");
  expect("frf " CASE2 "--at $(seq -s, 3 0.05 19) --format csv -q | tail -1", 0, "19,");
  expect("compare " CASE2 "--at 6.5 -q", 0, "match");
  expect("compare " CASE2 "--at 6.5 -q --set hbm.static=false", 1, "differs");
  expect("compare " CASE2 "--at 6.5 -q --set transient.max_periods=3 2>&1", 3, "not_settled");
  expect("frf " CASE2 "-q --set hbm.continuation=natural 2>&1 >/dev/null", 3, "stopped at omega = 9.");
  expect("transient " CASE2 "--at 6.5 -q --set transient.max_periods=3 2>&1 >/dev/null", 3, "omega = 6.5");
}

static void the_closed_form_is_of_the_exact_law(CHECK_STATE)
{
  expect("transient " CASE2 "--at 6.5 -q --set transient.method=closed_form 2>&1", 2,
         "--set transient.method=closed_form: only the exact law has a closed form");
  expect("transient " CASE2 "--at 6.5 -q --set transient.method=closed_form --set transient.law=exact", 0, "8.87144");
  expect("transient " CASE2 "--at 6.5 -q --set transient.scout=false --set transient.law=exact", 0, "8.87144");
  expect("compare " CASE2 "--at 6.5 -q --set transient.method=closed_form --set transient.law=exact", 0, "match");
}

/* Not agreed unless everything asked for was compared and every transient is accounted for by some HBM solution. */
static void agreement_is_not_claimed_lightly(CHECK_STATE)
{
  expect("compare " CASE2 "-q --set hbm.continuation=natural 2>&1", 3, "STOPPED at omega = 9.2");
  expect("frf " CASE2 "-q --at 8 --set hbm.continuation=natural 2>&1 >/dev/null", 3, "stopped at omega = 9.2");
  /* two contacts, one harmonic: the only HBM solution at 6.9 is unstable, and the transient is 20 % away from it */
  expect(
      "compare " CASE2
      "-q --at 6.9 --set hbm.harmonics=1 --set sweep.omega=4,20 --set 'contacts=[{tangential_stiffness: 100, "
      "normal_stiffness: "
      "200, friction: 0.3, angle_deg: 30, gap: 0.5}, {tangential_stiffness: 60, normal_stiffness: 300, friction: 0.5, "
      "angle_deg: 10, gap: 0.2}]'",
      1, "NO HBM solution");
  expect("compare " CASE2 "-q --set compare.points=10000 2>&1", 2, "compare.points");
  expect("compare " CASE2 "-q --at 9", 0, "unstable"); /* the transient from the unstable orbit lands on another,
                                                          found, one */
  expect("compare " CASE2 "-q --at 5.56", 1, "period_2");
}

/* Between two stable orbits of a blade that forgets 0.1 % a period: the motion crawls away from the saddle,
 * neighbours drifting apart as it goes, and settles all the same. It was called aperiodic once. */
static void leaving_a_saddle_is_not_chaos(CHECK_STATE)
{
  expect("compare cases/paper/table10_case2.yaml -q --at 707.201842866 --set transient.law=exact", 0, "unstable");
}

/* An overdamped scene decays as exp((w - a) t), not as 0 times infinity; and without damping nobody can say. */
static void stability_is_said_or_unknown(CHECK_STATE)
{
  expect("frf " CASE2
         "-q --format csv --at 3.5 --set contacts=[] --set oscillator.damping=40 --set oscillator.stiffness=0.5",
         0, ",yes,");
  expect("frf " CASE2 "-q --format csv --at 3.5 --set contacts=[] --set oscillator.damping=0 --set sweep.omega=3,6", 0,
         ",unknown,");
  expect("frf " CASE2
         "-q --format csv --at 0.1 --set contacts=[] --set oscillator.damping=40 --set oscillator.stiffness=0.5 --set "
         "sweep.omega=0.1,1",
         0, ",0.455826"); /* exp((-20 + sqrt(20^2 - 0.5)) 2 pi/0.1) */
}

/* The number in a csv's first row of data, in the column of that name. */
static double first_row(const char *csv, const char *name)
{
  const char *header = strstr(csv, "omega,"), *at = strstr(header ? header : "", name),
             *row = strchr(at ? at : "", '\n');
  assert_non_null(row);
  int columns = 0;
  for (const char *c = header; c < at; ++c) columns += *c == ',';
  for (++row; columns > 0 && row; --columns) row = strchr(row, ',') + 1;
  return strtod(row, NULL);
}

/* What dropping harmonic 0 costs on case 2, docs/measurements/case2.md: 18 %, 42 %, 63 % of the fundamental at
 * 6.5, 8, 9 in the limit of many harmonics and samples. Figures given to a whole percent, hence half a percent, and
 * 1e-3 for H = 10. */
static void dropping_the_mean_costs_what_it_costs(CHECK_STATE)
{
  static const double expected[][2] = {{6.5, 0.18}, {8, 0.42}, {9, 0.63}};
  for (int i = 0; i < 3; ++i) {
    char args[128];
    double hbm, transient;
    snprintf(args, sizeof args, "compare " CASE2 "--at %g -q --format csv --set hbm.static=false", expected[i][0]);
    run(args);
    hbm = first_row(out, "hbm_harmonic_1");
    transient = first_row(out, "transient_harmonic_1");
    CHECK_NEAR(1 - hbm / transient, expected[i][1], 0.005 + 1e-3, "omega = %g", expected[i][0]);
  }
}

static void mistakes_are_named(CHECK_STATE)
{
  expect("frf /nonexistent.yaml 2>&1", 2, "/nonexistent.yaml: ");
  expect("frf " CASE2 "--set hbm.harmonic=3 2>&1", 2, "harmonics");
  expect("frf " CASE2 "--set oscillator.mass=nan 2>&1", 2, "--set oscillator.mass=nan");
  expect("frf " CASE2 "--format xml 2>&1", 64, "table, csv or json");
  expect("frf " CASE2 "--at 5,,6 2>&1", 64, "--at");
  expect("frf 2>&1", 64, "CASE");
  expect("fry 2>&1", 64, "not a command");
  expect("frf a.yaml b.yaml 2>&1", 64, "one argument too many");
  expect("stress a.yaml 2>&1", 64, "one argument too many");
  expect("2>&1", 64, "usage");
  expect("contact " CASE2 "--motion 0,1 2>&1", 64, "odd number");
  expect("contact " CASE2 "--motion 0,x,1 2>&1", 64, "'x'");
  expect("describe hbm.sample 2>&1", 64, "samples");
  expect("describe '' 2>&1", 64, "no field or section ``");
  expect("gate 2>&1", 64, "no CASE given\n");
  expect("stress --scenes 0 2>&1", 64, "--scenes: '0' is not an integer 1..100000000");
  expect("contact " CASE2 "--motion 0,8,0 --samples 99999999999 2>&1", 64,
         "--samples: 99999999999 is not a whole number 3..16777216");
  expect("contact " CASE2 "--motion 0,1e400,0 2>&1", 64, "'1e400' is not a finite number");
  /* it was a force of 0 once: no transitions were found among products that overflow */
  expect("contact " CASE2 "--motion 0,1e300,0 2>&1", 3, "not finite; numbers became too large or too small");
  expect("frf " CASE2 "-q --set forcing.amplitude=1e300 2>&1", 3, "are units, force and frequency right?");
  if (access("/dev/full", W_OK) == 0) expect("--help 2>&1 >/dev/full", 3, "standard output");
}

/* What is nearly right is answered with what was meant; what is near to nothing is not guessed. */
static void nearly_right_words_get_a_suggestion(CHECK_STATE)
{
  expect("comapre " CASE2 "2>&1", 64, "'comapre' is not a command, did you mean 'compare'?");
  expect("transiet " CASE2 "2>&1", 64, "did you mean 'transient'?");
  expect("xyzzy 2>&1", 64, "'xyzzy' is not a command\n\nusage");
  expect("frf " CASE2 "--formt csv 2>&1", 64, "unrecognized option '--formt', did you mean '--format'?");
  expect("compare " CASE2 "--tabels 2>&1", 64, "did you mean '--tables'?");
  expect("compare " CASE2 "--xyzzy 2>&1", 64, "unrecognized option '--xyzzy'\n");
  expect("frf " CASE2 "--set --formt=1 2>&1", 2, "--set --formt=1"); /* a value, not an option */
  expect("frf " CASE2 "--format cvs 2>&1", 64, "expected table, csv or json, did you mean 'csv'?");
  expect("verify " CASE2 "--against cases/verify/no_static.csv --quantity amplitud 2>&1", 64,
         "did you mean amplitude?");
  expect("frf " CASE2 "--set hbm.force=exakt 2>&1", 2, "expected exact or sampled, did you mean `exact`?");
}

static int longest_line(const char *text)
{
  int longest = 0;
  for (const char *end; *text; text = *end ? end + 1 : end) {
    end = text + strcspn(text, "\n");
    if (end - text > longest) longest = (int)(end - text);
  }
  return longest;
}

/* Rows end at an empty line; the remarks after it are sentences, which may be longer. */
static void rows_fit(const char *environment, const char *args, int width)
{
  char line[512];
  snprintf(line, sizeof line, "%s %s %s", environment, HBMCHECK_COMMAND, args);
  CHECK_LE(shell_read(line, out, sizeof out), 1, "%s", args);
  char *end = strstr(out, "\n\n");
  if (end) *end = 0;
  CHECK_LE(longest_line(out), width, "%s %s:\n%s", environment, args, out);
}

/* 100 columns where there is no terminal and COLUMNS says nothing. */
static void tables_fit_the_screen(CHECK_STATE)
{
  static const char *const commands[] = {
      "compare " CASE2 "-q",
      "compare " CASE2 "-q --set sweep.frequency=[0.7,2] --set compare.points=12",
      "compare " CASE2 "--at 6 --harmonics 1,5 --samples 32 -q",
      "frf " CASE2 "-q",
      "transient " CASE2 "--at 6,9 -q",
      "gate " CASE2 "-q",
      "gate " CASE2 "cases/paper/case1.yaml --at 6 -q",
      "verify cases/verify/case2.yaml --against cases/verify/no_static.csv --columns omega=1,harmonic_1=2 -q",
      "contact " CASE2 "--motion 0,8,0 --samples 32,64,256,1024 -q",
      "stress --scenes 2 -q",
      "study cases/paper/studies/guideline3.yaml --results :memory: -q"};
  for (size_t i = 0; i < sizeof commands / sizeof *commands; ++i) {
    rows_fit("env -u COLUMNS", commands[i], 100);
    rows_fit("COLUMNS=60", commands[i], 60);
  }
  expect("compare " CASE2 "--at 6 -q", 0, " columns shown; --wide shows all");
  expect("compare " CASE2 "--at 6 -q --wide", 0, "  from_integration  from_settling  ");
  expect("compare " CASE2 "--at 6 -q --format csv", 0, ",from_integration,from_settling,");
}

/* Each command takes its own options and the common ones, and no other's. */
static void options_belong_to_their_command(CHECK_STATE)
{
  expect("frf " CASE2 "--motion 0,8,0 2>&1", 64, "motion");
  expect("describe --at 6 2>&1", 64, "--at");
  expect("describe hbm.samples --format csv -q", 0, "samples");
  expect("describe -q", 0, "hbm: harmonic balance");
  expect("gate " CASE2 "--plot x.svg 2>&1", 64, "plot");
  expect("stress --case --seed 3 --first 7", 0, "oscillator");
  expect("bench " CASE2 "--repeats 1001 2>&1", 64, "1..1000");
  expect("frf " CASE2 "--at 6 --format csv --plot - 2>&1", 64, "--plot - would mix a drawing into csv or json");
  expect("contact " CASE2 "--motion 0,8,0 --set hbm.force=sampled --set hbm.samples=auto 2>&1", 3, "hbm.samples=N");
}

/* The advice names settings of the side that failed. */
static void advice_is_about_the_side_that_failed(CHECK_STATE)
{
  expect("frf " CASE2 "-q --set hbm.continuation=natural 2>&1 >/dev/null", 3, "try --set hbm.continuation=auto");
  expect("transient " CASE2 "--at 6.5 -q --set transient.max_periods=3 2>&1 >/dev/null", 3,
         "try a larger --set transient.max_periods=");
}

static void help_works_everywhere(CHECK_STATE)
{
  static const char *const commands[] = {"compare", "frf",    "transient", "study", "bench",   "advise",  "gate",
                                         "verify",  "stress", "report",    "lab",   "contact", "describe"};
  for (size_t i = 0; i < sizeof commands / sizeof *commands; ++i) {
    char args[64];
    int lines = 0;
    snprintf(args, sizeof args, "%s --help", commands[i]);
    expect(args, 0, "example");
    for (const char *c = out; *c; ++c) lines += *c == '\n';
    CHECK_LE(lines, 50, "%s --help is a screen", commands[i]);
  }
  expect("--help", 0, "compare");
  expect("help frf", 0, "Usage: hbmcheck frf [OPTION...] CASE");
  expect("help fry 2>&1", 64, "did you mean 'frf'?");
  expect("--version", 0, "SUNDIALS");
}

static void a_failed_run_touches_no_file(CHECK_STATE)
{
  folder_put("old", "before");
  expect("frf " CASE2 "--set hbm.harmonics=0 -o $D/old 2>&1", 2, "hbm.harmonics");
  char *text = folder_read("old", NULL);
  assert_string_equal(text, "before");
  free(text);
  FILE *before = folder_open("old", "r");
  expect("frf " CASE2 "-q --at 6 -o $D/old", 0, "");
  assert_int_equal(fgetc(before), 'b'); /* the name leads to a new file now */
  fclose(before);
  text = folder_read("old", NULL);
  assert_int_equal(strncmp(text, "Response", 8), 0);
  free(text);
  if (access("/dev/full", W_OK) == 0) expect("frf " CASE2 "-q --at 6 2>&1 >/dev/full", 3, "standard output");
}

CHECK_TESTS_WITH("compare.command", 300, folder_make, folder_remove, columns_are_the_interface,
                 the_closed_form_is_of_the_exact_law, verdicts_reach_the_exit_code,
                 dropping_the_mean_costs_what_it_costs, mistakes_are_named, nearly_right_words_get_a_suggestion,
                 tables_fit_the_screen, options_belong_to_their_command, advice_is_about_the_side_that_failed,
                 agreement_is_not_claimed_lightly, leaving_a_saddle_is_not_chaos, stability_is_said_or_unknown,
                 help_works_everywhere, a_failed_run_touches_no_file)
