/* test_files.c - no output replaces an input or another output, by name, links or other spellings: exit 64 before
 * anything is computed, a message with both names, and every file in the folder as it was, to the byte. */
#include "tests/folder.h"
#include "tests/shell.h"

static const char scene[] = "title: small\n"
                            "oscillator: {mass: 1, damping: 0.4, stiffness: 40}\n"
                            "forcing: {amplitude: 100}\n"
                            "sweep: {omega: [4, 8]}\n"
                            "compare: {omega: [5]}\n"
                            "hbm: {harmonics: 1}\n";

/* Exit code and both streams of a line for sh, in which $H is hbmcheck. */
static void expect(const char *line, int code, const char *fragment)
{
  static char said[1 << 16];
  shell_check(line, shell_read(line, said, sizeof said), said, code, fragment);
}

/* Every file and link in the folder, with checksums. */
#define LIST "find . ! -name listing\\* ! -path . -printf '%p %l %i\\n' -type f -exec cksum {} + | sort"

static void refused(const char *line, const char *fragment)
{
  expect(LIST " >listing.before", 0, "");
  expect(line, 64, fragment);
  expect(LIST " >listing.after; cmp listing.before listing.after", 0, "");
}

/* ---- the five that lost an input without a word ---- */

static void an_output_over_its_case(CHECK_STATE)
{
  refused("$H frf case.yaml -o case.yaml 2>&1", "--output case.yaml is the case file itself; give another name");
  refused("$H transient case.yaml -o case.yaml 2>&1", "--output case.yaml is the case file itself");
  refused("$H compare case.yaml -o case.yaml 2>&1", "--output case.yaml is the case file itself");
  refused("$H bench case.yaml --alone -o case.yaml 2>&1", "--output case.yaml is the case file itself");
  refused("$H contact case.yaml --motion 0,1,0 -o case.yaml 2>&1", "--output case.yaml is the case file itself");
  refused("$H gate other.yaml case.yaml -o case.yaml 2>&1", "--output case.yaml is the case file itself");
  refused("$H report case.yaml -o case.yaml 2>&1", "case.yaml");
  refused("$H verify case.yaml --against curve.csv --columns omega=1,amplitude=2 -o case.yaml 2>&1",
          "--output case.yaml is the case file itself");
}

static void an_output_over_its_study_or_base(CHECK_STATE)
{
  refused("$H study study.yaml --results new.sqlite -o study.yaml 2>&1", "--output study.yaml is the study itself");
  refused("$H study study.yaml --results new.sqlite --export csv -o case.yaml 2>&1",
          "--output case.yaml is the base case itself");
  refused("$H study study.yaml --results case.yaml 2>&1", "the results file case.yaml is the base case itself");
}

static void an_output_over_the_curve(CHECK_STATE)
{
  refused("$H verify case.yaml --against curve.csv --columns omega=1,amplitude=2 -o curve.csv 2>&1",
          "--output curve.csv is the curve itself");
}

static void an_output_over_the_results(CHECK_STATE)
{
  expect("$H study study.yaml -q --results kept.sqlite 2>&1", 0, "kept.sqlite");
  refused("$H study study.yaml --results kept.sqlite -o kept.sqlite 2>&1",
          "the results file kept.sqlite and --output kept.sqlite are the same file; give another name");
  refused("$H study study.yaml --results kept.sqlite -o kept.sqlite-wal 2>&1", "--output kept.sqlite-wal");
  refused("$H study study.yaml --export csv -o study.sqlite 2>&1", "study.sqlite and --output study.sqlite");
  refused("ln -sf kept.sqlite link.sqlite; cp study.yaml again.yaml; mkdir -p d; ln -sf ../kept.sqlite d/study.sqlite; "
          "ln -sf ../kept.sqlite d/again.sqlite; " LIST
          " >listing.before; $H study study.yaml again.yaml --results d 2>&1",
          "d/again.sqlite and the results file d/study.sqlite are the same file");
}

static void junit_plot_and_findings_over_another(CHECK_STATE)
{
  refused("$H gate case.yaml --junit case.yaml 2>&1", "--junit case.yaml is the case file itself");
  refused("$H gate case.yaml --junit new.xml -o new.xml 2>&1",
          "--junit new.xml and --output new.xml are the same file");
  refused("ln -sf case.yaml drawn.svg; " LIST " >listing.before; $H frf case.yaml --plot drawn.svg 2>&1",
          "--plot drawn.svg is the case file case.yaml itself");
  refused("cp case.yaml case.svg; " LIST " >listing.before; $H compare case.svg --plot case.svg 2>&1",
          "--plot case.svg is the case file itself");
  refused("$H frf case.yaml --plot new.svg -o new.svg 2>&1", "--plot new.svg and --output new.svg");
  refused("cp study.yaml study.svg; " LIST " >listing.before; "
          "$H study study.svg --results :memory: --plot study.svg 2>&1",
          "--plot study.svg is the study itself");
  refused("$H study study.yaml --results new.svg --plot new.svg 2>&1", "--plot new.svg and the results file new.svg");
}

/* ---- what else can be lost ---- */

static void a_journal_is_kept(CHECK_STATE)
{
  expect("$H stress --scenes 1 -q --results journal 2>&1 >/dev/null", 0, "");
  refused("$H stress --scenes 1 -q --results journal -o journal 2>&1", "--results journal and --output journal");
  refused("mkdir -p found; mv journal found/stress-1-0-linear.yaml; ln found/stress-1-0-linear.yaml journal; " LIST
          " >listing.before; $H stress --scenes 1 -q --results journal --findings ./found 2>&1",
          "--results journal is where --findings ./found keeps a case file");
  refused("$H stress --scenes 1 -q --findings found -o found/stress-1-9-linear.yaml 2>&1",
          "--output found/stress-1-9-linear.yaml is where --findings found keeps a case file");
  expect("$H stress --scenes 1 -q --findings case.yaml 2>&1", 3, "case.yaml: Not a directory");
}

static void a_page_named_after_its_case(CHECK_STATE)
{
  expect("cp case.yaml case.html", 0, "");
  refused(
      "out=$($H report case.html 2>&1); c=$?; echo \"$out\"; case $out in *'built without'*) echo 'the page case.html "
      "is the case file itself';; esac; exit $c",
      "the page case.html is the case file itself");
}

static void other_names_for_the_same_file(CHECK_STATE)
{
  refused("$H frf case.yaml -o ./case.yaml 2>&1", "--output ./case.yaml is the case file case.yaml itself");
  refused("$H frf $PWD/case.yaml -o d/../case.yaml 2>&1", "is the case file ");
  refused("ln -sf case.yaml soft; ln -sf soft softer; " LIST " >listing.before; $H frf case.yaml -o softer 2>&1",
          "--output softer is the case file case.yaml itself");
  refused("ln -f case.yaml hard; " LIST " >listing.before; $H frf case.yaml -o hard 2>&1",
          "--output hard is the case file case.yaml itself");
  refused("ln -sfn . here; " LIST " >listing.before; $H gate case.yaml --junit new.xml -o here/new.xml 2>&1",
          "--junit new.xml and --output here/new.xml are the same file");
  refused("ln -sfn nowhere.xml dangling; " LIST
          " >listing.before; $H gate case.yaml --junit nowhere.xml -o dangling 2>&1",
          "--junit nowhere.xml and --output dangling are the same file");
}

static void the_streams_of_the_shell(CHECK_STATE)
{
  refused("$H frf - -o case.yaml <case.yaml 2>&1", "--output case.yaml is the case file on standard input itself");
  refused("$H frf case.yaml 2>&1 >>case.yaml", "standard output is the case file case.yaml itself");
  refused("$H frf case.yaml -o /dev/stdout 2>&1 >>case.yaml", "is the case file case.yaml itself");
  refused("touch mixed; " LIST " >listing.before; $H gate case.yaml --junit mixed 2>&1 >mixed",
          "--junit mixed and standard output");
}

static void what_may_be_said_twice(CHECK_STATE)
{
  expect("$H gate case.yaml case.yaml --junit /dev/null -o /dev/null 2>&1", 0, "");
  expect("$H gate case.yaml -q --junit /dev/stdout -o /dev/stdout >both && grep -c testsuites both", 0, "");
  expect("$H gate case.yaml -q --junit /dev/stderr 2>&1 | grep -c '</testsuites>'", 0, "1");
  expect("$H frf case.yaml -q -o - >one && $H frf case.yaml -q >two && cmp one two && ! test -e ./-", 0, "");
  expect("$H gate case.yaml -q --junit ok.xml -o ok.txt && test -s ok.xml && test -s ok.txt", 0, "");
  expect("$H gate case.yaml -q --junit ok.xml -o ok.txt && test -s ok.xml && test -s ok.txt", 0,
         ""); /* again, over itself */
  expect(
      "$H study study.yaml -q --results again.sqlite -o again.csv && $H study study.yaml -q --results again.sqlite -o "
      "again.csv",
      0, "");
}

static int fill_folder(void **state)
{
  if (folder_enter(state) != 0) return -1;
  folder_put("case.yaml", scene);
  folder_put("other.yaml", scene);
  folder_put("curve.csv", "5,6.3\n6,15\n");
  folder_put("study.yaml", "study: two\nbase: case.yaml\nrun: frf\nvary: [{hbm.harmonics: [1, 2]}]\n");
  return 0;
}

CHECK_TESTS_WITH("command.files", 120, fill_folder, folder_remove, an_output_over_its_case,
                 an_output_over_its_study_or_base, an_output_over_the_curve, an_output_over_the_results,
                 junit_plot_and_findings_over_another, a_journal_is_kept, a_page_named_after_its_case,
                 other_names_for_the_same_file, the_streams_of_the_shell, what_may_be_said_twice)
