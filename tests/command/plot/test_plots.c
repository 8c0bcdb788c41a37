/* test_plots.c - hbmcheck ... --plot as people use it: files of every kind and ending, well-formed and with what
 * they should show; what can go wrong; texts that try to be commands. Runs the built hbmcheck (HBMCHECK_COMMAND) in
 * a shell, in a folder of its own. Needs gnuplot, or is skipped; xmllint checks that svg is XML where it is
 * installed. That pictures please the eye is not tested. */
#include <stdbool.h>

#include "tests/folder.h"
#include "tests/shell.h"

#define CASE2 "cases/paper/case2.yaml "
#define WEDGE "cases/structures/wedge_F2.yaml "
#define CHAIN "cases/structures/chain3.yaml "
#define SPACE "cases/structures/space.yaml "
#define PLANE "cases/structures/plane.yaml "
enum { MOST = 1 << 20 };

static char text[MOST]; /* what a line for sh printed, or a file */

static void expect(const char *line, int code, const char *fragment)
{
  shell_check(line, shell_read(line, text, sizeof text), text, code, fragment);
}

/* The file in our folder, into text; its length. */
static size_t slurp(const char *name)
{
  FILE *f = folder_open(name, "rb");
  const size_t n = fread(text, 1, sizeof text - 1, f);
  fclose(f);
  text[n] = 0;
  return n;
}

static void expect_words(const char *name, const char *const *words)
{
  for (; *words; ++words)
    if (!strstr(text, *words)) fail_msg("%s does not say '%s'", name, *words);
}

/* Draw into NAME.svg: XML with these words (to NULL), and so many items, for each of which gnuplot writes a <title>. */
static void check_svg_of(const char *name, const char *args, int code, int plots, const char *const *words)
{
  char line[2048], file[64];
  snprintf(line, sizeof line, "$H %s --plot $D/%s.svg -q 2>&1 >/dev/null", args, name);
  expect(line, code, "");
  snprintf(line, sizeof line, "! command -v xmllint >/dev/null || xmllint --noout $D/%s.svg 2>&1", name);
  expect(line, 0, "");
  snprintf(file, sizeof file, "%s.svg", name);
  assert_true(slurp(file) > 2000);
  expect_words(file, words);
  const char *what = "id=\"gnuplot_plot_";
  int drawn = 0;
  for (const char *at = text; (at = strstr(at, what)); at += strlen(what)) ++drawn;
  if (drawn != plots) fail_msg("%s: %d things drawn, expected %d", name, drawn, plots);
}

static void check_svg(const char *name, const char *args, int plots, const char *const *words)
{
  check_svg_of(name, args, 0, plots, words);
}

#define WORDS(...) ((const char *const[]){__VA_ARGS__, NULL})

/* Case 2: a stable and an unstable part, turning points, period doublings, changes of contact: five items. */
static void response_curves(CHECK_STATE)
{
  check_svg("frf", "frf " CASE2, 5,
            WORDS("Case 2, intermittent contact", "H = 10, exact forces", "harmonic balance: stable", "unstable",
                  "turning point", "period doubling", "contact changes", "ω [rad/s]", "amplitude of x [m]"));
  check_svg("at", "frf " CASE2 "--at 8,9", 6, WORDS("solutions asked for"));
  check_svg("units", "frf " CASE2 "--set units.length=mm --set units.time=ms", 5, WORDS("[mm]", "rad/ms"));
}

/* All of it is stable, with changes of contact: a line and its marks for each response, named in the key. */
static void responses_of_a_structure(CHECK_STATE)
{
  check_svg("three", "frf " WEDGE, 6, WORDS("blade", "damper_x", "damper_y", "contact changes", "amplitude [m]"));
  assert_null(strstr(text, "amplitude of"));
  check_svg("three-at", "frf " WEDGE "--at 37", 7, WORDS("solutions asked for"));
  check_svg("one", "frf " WEDGE "--response damper_x", 2,
            WORDS("harmonic balance: stable", "amplitude of damper_x [m]"));
  check_svg("number", "frf " CHAIN "--response 3 --set sweep.omega=0.5,1", 2, WORDS("amplitude of DOF 3 [m]"));
  check_svg("loop", "contact " CHAIN "--contact ground --motion-u 0,0.1,0", 6,
            WORDS("contact ground; exact law", "slips"));
}

static void transients(CHECK_STATE)
{
  check_svg("compare", "compare " CASE2 "--at 6,8", 8,
            WORDS("transient: match (3)", "transient: unstable (1)", "where the transient went"));
  check_svg("points", "transient " CASE2 "--at 6,8", 3, WORDS("time integration: settled (4)"));
  check_svg("wave", "transient " CASE2 "--at 6", 2,
            WORDS("t / T", "ω = 6 rad/s", "start: hbm branch 0; settled", "contact 0 closes above"));
}

/* Ours, stable and unstable; theirs, right and wrong. tmdsimpy's wandering curve has 33 points at omega > 0. */
static void curves_of_others(CHECK_STATE)
{
#define WANDERED "verify cases/verify/case2.yaml --against cases/verify/tmdsimpy_case2_wandered.csv --quantity norm "
  check_svg_of("verify", WANDERED, 1, 4,
               WORDS("ours: H = 20, exact forces; cause: too_few_harmonics+too_few_samples", "ours: stable", "unstable",
                     "theirs: match (9)", "theirs: differs (24)", "norm [m]", "ω [rad/s]"));
  check_svg_of("verify_cycles", WANDERED "--set sweep.frequency=0.5,3", 1, 4, WORDS("frequency [cycles/s]"));
}

/* Four panels: 8 items; 2 orders, 2 guides; exact forces, 2 sample counts, 2 guides; cells, 2 sets of labels. */
static void accuracy(CHECK_STATE)
{
  check_svg("tables", "compare " CASE2 "--at 6,8 --harmonics 1,3 --samples 32,64", 8 + 4 + 5 + 3,
            WORDS("Aliasing: sampled against exact forces", "H = 1", "N = 64", "slope of 1/N²", "slope of 1/H⁴",
                  "over N and H", "exact"));
}

static void contacts(CHECK_STATE)
{
  check_svg("contact", "contact cases/paper/table10_case2.yaml --motion 0,0.29,0", 3 + 4,
            WORDS("sticks", "slips", "separated", "tangential force T [N]", "normal force N", "± μ N"));
  check_svg("touch", "contact " CASE2 "--motion 0,8,0", 2 + 4, WORDS("sticks", "separated"));
}

/* Two tangents: what it does, the limit (two where N varies and stays), the ways of motion and slider, its rest. */
static void contacts_in_a_plane(CHECK_STATE)
{
  check_svg("circle", "contact " SPACE "--motion-u 0,0.1,0.02 --motion-u2 0,0,0.07 --motion-v 0,0.04,0.03", 3 + 2,
            WORDS("contact foot; exact law, limit: circle", "traction T_1 [N]", "motion u_2 [m]", "slips", "separated",
                  "limit μ N at most", "slider w"));
  check_svg("square",
            "contact " SPACE "--set contacts[0].limit=square --motion-u 0,0.1,0.02 --motion-u2 0,0,0.07 --motion-v "
            "0.05,0.04,0.03",
            4 + 3, WORDS("limit: square", "sticks", "limit μ N at most", "limit μ N at least"));
  check_svg("rests", "contact " PLANE "--motion-u 0.01,0.1,0 --motion-u2 0,0.05,0", 3 + 3,
            WORDS("contact rub", "sticks", "slips", "limit μ N", "slider at rest"));
  expect("$H contact " PLANE "--motion-u 0,0.1,0 --motion-u2 0,0,0.1 --plot -", 0, "traction T_1 [N]");
  expect("$H contact " SPACE "--set contacts[0].friction=0 --motion-u 0,0.1,0 --plot $D/x.svg 2>&1 >/dev/null", 3,
         "no friction");
}

#define DRAWN "study: Drawn\nbase: " SOURCE_DIR "/cases/paper/case2.yaml\nrun: frf\nset: {hbm.harmonics: 3}\nvary:\n"

static void studies(CHECK_STATE)
{
  folder_put("lines.yaml", DRAWN "  - hbm.static: [true, false]\n  - contacts[0].gap: [-5, -4, -3]\n");
  check_svg("lines", "study $D/lines.yaml --results :memory:", 2,
            WORDS("Drawn", "contacts[0].gap [m]", "peak_amplitude [m]", "static = true", "static = false"));
  folder_put("heat.yaml", DRAWN "  - contacts[0].gap: [-5, -4, -3, -2]\n  - forcing.amplitude: [70, 80, 90, 100]\n");
  check_svg("heat", "study $D/heat.yaml --results :memory: --plot-y turning_points", 3,
            WORDS("forcing.amplitude [N]", "turning_points [1]"));
  expect("$H study $D/lines.yaml --results :memory: --plot $D/x.svg --plot-y peek 2>&1", 64, "peak_amplitude");
  expect("$H study $D/lines.yaml $D/heat.yaml --results $D --plot $D/x.svg 2>&1", 64, "one study at a time");
}

static void benchmarks(CHECK_STATE)
{
  expect("$H bench " CASE2
         "--at 6.5 --repeats 1 --alone -q --set transient.max_periods=500 --plot $D/bench.svg 2>&1 >/dev/null",
         0, "");
  slurp("bench.svg");
  expect_words("bench.svg",
               WORDS("hbm_exact", "hbm_sampled", "exact_shooting", "nothing is nearer and faster", "ω = 6.5 rad/s"));
}

static void endings_make_the_kind(CHECK_STATE)
{
  expect("$H frf " CASE2 "-q --plot $D/a.png 2>&1 >/dev/null && $H frf " CASE2 "-q --plot $D/a.pdf 2>&1 >/dev/null", 0,
         "");
  assert_true(slurp("a.png") > 2000);
  assert_memory_equal(text, "\x89PNG\r\n\x1a\n", 8);
  size_t n = slurp("a.pdf");
  assert_true(n > 2000);
  assert_memory_equal(text, "%PDF-", 5);
  assert_non_null(strstr(text + n - 32, "%%EOF"));
  expect("$H frf " CASE2 "--plot $D/a.bmp 2>&1", 64, ".svg, .png or .pdf");
}

/* In the terminal: after the table, as wide as COLUMNS says; not into the midst of what a program reads. */
static void letters(CHECK_STATE)
{
  expect("COLUMNS=70 $H frf " CASE2 "-q --plot -", 0, "harmonic balance: stable");
  const char *table = strstr(text, "period doubling at omega"), *drawing = strstr(text, "omega [rad/s]");
  assert_true(table && drawing && table < drawing);
  for (const char *line = strstr(text, "omega [rad/s]"); line && *line; line = strchr(line + 1, '\n'))
    assert_true(strcspn(line + 1, "\n") <= 71);
  expect("$H frf " CASE2 "-q --plot - --format csv 2>&1", 64, "csv or json");
  expect("$H frf " CASE2 "-q --plot - --format csv -o $D/a.csv 2>&1", 0, "omega [rad/s]");
  expect("$H compare " CASE2 "-q --at 6,8 --plot -", 0, "transient: match (3)");
  expect("$H compare " CASE2 "-q --at 6 --harmonics 1,3 --samples 32,64 --plot -", 0, "samples per period N");
  expect("$H contact " CASE2 "--motion 0,12,0 --plot -", 0, "tangential motion u [m]");
  expect("$H transient " CASE2 "-q --at 6 --plot -", 0, "t / T");
  expect("$H study $D/heat.yaml --results :memory: -q --plot -", 0, "amplitude = 80");
}

/* The results are there, the old file stays, and the exit code says that something is missing. */
static void what_can_go_wrong(CHECK_STATE)
{
  expect("echo before >$D/old.svg; PATH=$D $H frf " CASE2 "-q --plot $D/old.svg 2>&1", 3, "gnuplot is not installed");
  assert_non_null(strstr(text, "apt install gnuplot-nox"));
  assert_non_null(strstr(text, "Response curve"));
  slurp("old.svg");
  assert_string_equal(text, "before\n");
  expect("mkdir $D/bin && printf '#!/bin/sh\\necho some words >&2\\nexit 5\\n' >$D/bin/gnuplot && chmod +x "
         "$D/bin/gnuplot; "
         "PATH=$D/bin $H frf " CASE2 "-q --plot $D/old.svg 2>&1 >/dev/null",
         3, "gnuplot failed (5): some words");
  expect("printf '#!/bin/sh\\nkill -9 $$\\n' >$D/bin/gnuplot; PATH=$D/bin $H frf " CASE2
         "-q --plot $D/old.svg 2>&1 >/dev/null",
         3, "signal 9");
  expect("printf '#!/bin/sh\\nexit 0\\n' >$D/bin/gnuplot; PATH=$D/bin $H frf " CASE2
         "-q --plot $D/old.svg 2>&1 >/dev/null",
         3, "no drawing");
  /* SIGCHLD ignored by the parent: the exit code is known all the same */
  expect("printf '#!/bin/sh\\nexit 6\\n' >$D/bin/gnuplot; env --ignore-signal=CHLD PATH=$D/bin $H frf " CASE2
         "-q --plot $D/old.svg 2>&1 >/dev/null",
         3, "gnuplot failed (6)");
  slurp("old.svg");
  assert_string_equal(text, "before\n");
  expect("$H frf " CASE2 "-q --plot $D/no/such.svg 2>&1 >/dev/null", 3, "No such file");
  expect("mkdir $D/is.svg; $H frf " CASE2 "-q --plot $D/is.svg 2>&1 >/dev/null", 3, "is.svg: ");
  /* the verdict goes first */
  expect("$H compare " CASE2 "-q --at 6.5 --set hbm.static=false --plot $D/no/such.svg 2>&1 >/dev/null", 1,
         "No such file");
  expect("$H contact " CASE2 "--set contacts=[] --motion 0,1,0 --plot $D/x.svg 2>&1 >/dev/null", 3, "no contact");
  expect("ls -A $D | grep -c hbmcheck-; true", 0, "");
  assert_string_equal(text, "0\n"); /* nothing is left beside */
}

/* No title or label is obeyed: quotes, backticks, gnuplot's and the shell's commands, markup of any kind. */
static void hostile_words_are_words(CHECK_STATE)
{
  folder_put(
      "hostile.yaml",
      "title: \"q\\\" . system('touch RAN') `touch RAN` $(touch RAN) \\\\n\\\\ {/=40 big} a_b^c @d & <b>x</b> 'e' "
      "%d é ω\"\n"
      "oscillator: {mass: 1, damping: 0.4, stiffness: 40}\nforcing: {amplitude: 100}\nsweep: {omega: [3, 20]}\n"
      "units: {length: '`a`_{b}\"', force: \"N\\\\\", time: 's@^&<i>%s'}\n");
  expect("cd $D && $H frf hostile.yaml -q --plot hostile.svg 2>&1 >/dev/null; ls RAN 2>/dev/null; xmllint --noout "
         "hostile.svg 2>&1; $H frf hostile.yaml -q --plot h.png 2>&1 >/dev/null; $H frf hostile.yaml -q --plot h.pdf "
         "2>&1 >/dev/null; ls RAN 2>/dev/null; true",
         0, "");
  assert_string_equal(text, "");
  slurp("hostile.svg");
  expect_words("hostile.svg",
               WORDS("q\" . system('touch RAN') `touch RAN` $(touch RAN)", "{/=40 big} a_b^c @d &amp; &lt;b>x&lt;/b>",
                     "'e' %d é ω", "`a`_{b}\"", "s@^&amp;&lt;i>%s"));
  expect("$H frf $D/hostile.yaml -q --plot -", 0, "`touch RAN`");
  expect("$H frf $D/hostile.yaml -q --plot \"$D/a'b \\$(id).svg\" >/dev/null; ls $D", 0, "a'b $(id).svg");
}

int main(void)
{
  if (system("command -v gnuplot >/dev/null") != 0) {
    printf("skipped: gnuplot is not installed\n");
    return 77;
  }
  check_watchdog(600);
  return CHECK_RUN("compare.plot", folder_make, folder_remove, response_curves, responses_of_a_structure, transients,
                   curves_of_others, accuracy, contacts, contacts_in_a_plane, studies, benchmarks,
                   endings_make_the_kind, letters, what_can_go_wrong, hostile_words_are_words);
}
