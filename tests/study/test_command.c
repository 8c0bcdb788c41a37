/* test_command.c - hbmcheck study as people use it: killed and resumed, in one thread or several, refused, claimed.
 * Runs the built command in its own folder; what is stopped at a certain place: a child (tests/faults/moments.h). */
#include <signal.h>

#include "tests/faults/child.h"
#include "tests/faults/moments.h"
#include "tests/folder.h"
#include "tests/shell.h"

enum { HANGS = 600 /* [s] of a child, to end hangs */ };

typedef struct reply {
  int code;
  char *out;
} reply; /* out: to free */

/* Run "hbmcheck study ARGS" in the folder. */
static reply run(const char *args)
{
  enum { MOST = 1 << 22 };
  reply o = {-1, malloc(MOST)};
  char line[1024];
  snprintf(line, sizeof line, "cd $D; $H study %s", args);
  assert_non_null(o.out);
  o.code = shell_read(line, o.out, MOST);
  return o;
}

static void expect(const char *args, int code, const char *fragment)
{
  reply o = run(args);
  shell_check(args, o.code, o.out, code, fragment);
  free(o.out);
}

#define LINEAR                                                                                                         \
  "case: {oscillator: {mass: 1, damping: 0.4, stiffness: 40}, forcing: {amplitude: 1}, sweep: {omega: [3, 9]}}\n"
#define MANY(title, steps)                                                                                             \
  "study: " title "\n" LINEAR "run: frf\nset: {compare.omega: [5, 6]}\nvary:\n"                                        \
  "  - {oscillator.mass: {from: 0.5, to: 2, count: " steps                                                             \
  "}}\n  - {oscillator.damping: {from: 0.1, to: 0.9, count: 20}}\n"

/* "hbmcheck study ARGS" in the folder, with `signal` at its n-th moment. */
typedef struct order {
  const char *args;
  int signal;
  long n;
} order;

static int obey(void *self)
{
  const order *o = self;
  char line[256];
  snprintf(line, sizeof line, "study %s", o->args);
  if (chdir(folder) != 0) return 99;
  if (o->signal) signal(o->signal, SIG_DFL); /* who started the tests may ignore it */
  moments_expect(o->n, moments_raise, (void *)(size_t)&o->signal);
  return child_command(line);
}

static outcome last;

static void run_inside(const char *args, int signal, long n)
{
  order o = {args, signal, n};
  child_run(obey, &o, HANGS, &last);
}

/* Ten kills at moments drawn from a fixed sequence, among SQLite's writes, too. An undisturbed run has 800 scenes and
 * two moments or more in each; a tenth of these moments a run, halved by the ten that are killed on the average, leave
 * scenes for all of them. Then every scene is there once, and the export is that of an undisturbed run. */
static void killed_and_resumed(CHECK_STATE)
{
  unsigned long long seed = 88172645463325252ull;
  folder_put("k.yaml", MANY("kills", "40"));
  run_inside("k.yaml -q --results whole.sqlite --jobs 1", 0, 0);
  assert_int_equal(last.code, 0);
  const long whole = last.count;
  assert_true(whole >= 2 * 800);
  for (int i = 0; i < 10; ++i) {
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    run_inside("k.yaml -q --jobs 2", SIGKILL, 1 + (long)(seed % (unsigned long)(whole / 10)));
    if (last.signal != SIGKILL) child_show(&last, "not killed");
    assert_int_equal(last.signal, SIGKILL);
  }
  reply a = run("k.yaml -q --export csv"), b = run("k.yaml -q --export csv --results whole.sqlite");
  assert_int_equal(a.code, 0);
  assert_int_equal(b.code, 0);
  assert_string_equal(a.out, b.out);
  long lines = 0;
  for (const char *p = a.out; *p; ++p) lines += *p == '\n';
  assert_int_equal(lines, 1 + 2 * 800); /* a header, and two omegas a scene */
  free(a.out);
  free(b.out);
}

static void threads_change_nothing(CHECK_STATE)
{
  static const char *const formats[] = {"csv", "json"};
  folder_put("t.yaml", MANY("threads", "10"));
  for (int i = 0; i < 2; ++i) {
    char args[128];
    snprintf(args, sizeof args, "t.yaml -q --results :memory: --export %s --jobs 1", formats[i]);
    reply a = run(args);
    snprintf(args, sizeof args, "t.yaml -q --results :memory: --export %s --jobs 3", formats[i]);
    reply b = run(args);
    assert_int_equal(a.code, 0);
    assert_true(strlen(a.out) > 1000);
    assert_string_equal(a.out, b.out);
    free(a.out);
    free(b.out);
  }
}

static void stopped_by_a_signal(CHECK_STATE)
{
  folder_put("s.yaml", MANY("signals", "80"));
  run_inside("s.yaml -q", SIGTERM, 200);
  shell_check("stopped", last.code, last.err, 3, "scenes are in s.sqlite; the same command goes on from there");
  run_inside("s.yaml -q --export csv --fresh", SIGTERM, 200);
  assert_int_equal(last.code, 3);
  assert_string_equal(last.out, ""); /* half an export would look like a whole one */
  expect("s.yaml -q", 0, "1600");
}

/* A child that stands still, with its results file locked: tells so on one pipe, goes on when the other one closes. */
typedef struct standstill {
  int tells, waits;
} standstill;

static void stand_still(void *self)
{
  const standstill *s = self;
  char byte = 0;
  if (write(s->tells, &byte, 1) != 1 || read(s->waits, &byte, 1) != 0) _exit(99);
}

static void a_second_process_is_refused(CHECK_STATE)
{
  int there[2], go[2], status;
  char byte;
  folder_put("p.yaml", MANY("processes", "10"));
  assert_true(pipe(there) == 0 && pipe(go) == 0);
  fflush(NULL);
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    standstill s = {there[1], go[0]};
    close(go[1]);
    if (chdir(folder) != 0 || !freopen("/dev/null", "w", stdout)) _exit(99);
    moments_expect(100, stand_still, &s);
    _exit(child_command("study p.yaml -q --jobs 1"));
  }
  close(there[1]);
  close(go[0]);
  assert_int_equal(read(there[0], &byte, 1), 1);
  expect("p.yaml -q 2>&1", 2, "p.sqlite: another hbmcheck is writing these results");
  close(go[1]);
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  close(there[0]);
}

static void changed_and_foreign(CHECK_STATE)
{
  folder_put("c.yaml", "study: c\n" LINEAR "run: frf\nvary: [{oscillator.mass: [1, 2]}]\n");
  expect("c.yaml -q", 0, "c.sqlite");
  folder_put("c.yaml", "study: c\n" LINEAR "run: frf\nvary: [{oscillator.mass: [1, 2, 3]}]\n");
  expect("c.yaml -q 2>&1", 2,
         "c.sqlite: results of another study, or of this one before it was changed; --fresh throws them away");
  expect("c.yaml -q --set oscillator.damping=0.5 2>&1", 2, "c.sqlite: results of another study");
  expect("c.yaml -q --fresh", 0, "c.sqlite");
  folder_put("c.sqlite", "precious notes, not a database\n");
  expect("c.yaml -q --fresh 2>&1; cat c.sqlite", 0, "precious notes, not a database\n");
  expect("c.yaml -q 2>&1", 2, "c.sqlite: not an SQLite file");
}

static void claims_are_held(CHECK_STATE)
{
  folder_put(
      "m.yaml",
      "study: m\n" LINEAR "run: frf\nvary: [{oscillator.mass: [1, 2, 4]}]\nclaims:\n"
      "  - {source: text, says: heavier is slower, found: SELECT min(peak_omega) FROM scene, holds: "
      "\"SELECT count(*) = 0 FROM scene a JOIN scene b ON a.\\\"oscillator.mass\\\" < b.\\\"oscillator.mass\\\" AND "
      "a.peak_omega <= b.peak_omega\"}\n"
      "  - {says: no rows, holds: SELECT count(*) > 0 FROM row}\n");
  /* M = 4: omega^2 = K/M - C^2/(2 M^2) = 9.995 */
  expect("m.yaml -q --results :memory:", 0, "heavier is slower  3.16148");
  expect("m.yaml -q --results :memory: --format csv", 0, ",agrees\n,no rows,,does not agree\n");
  folder_put("e.yaml",
             "study: e\n" LINEAR
             "run: frf\nvary: [{oscillator.mass: [1, 2]}]\nclaims:\n  - {says: x, holds: SELECT 0, expect: agree}\n");
  expect("m.yaml e.yaml -q --results :memory:", 1, "does not agree");
  folder_put("w.yaml", "study: w\n" LINEAR
                       "run: frf\nvary: [{oscillator.mass: [1, 2]}]\nclaims:\n  - {says: x, holds: SELECT y}\n");
  expect("w.yaml -q 2>&1; ls w.sqlite 2>/dev/null", 2, "w.yaml:6:22: `holds`: no such column: y");
}

/* Two answers a claim; views; what the source took beside what it takes here; totals. */
static void claims_have_two_sides(CHECK_STATE)
{
  folder_put(
      "d.yaml",
      "study: d\n" LINEAR
      "run: frf\nvary: [{oscillator.mass: [1, 4]}]\nviews:\n  light: 'SELECT *, \"oscillator.mass\" AS m FROM scene "
      "WHERE m < 2'\n"
      "  light_id: SELECT id FROM light\nclaims:\n  - source: text\n    says: it is light\n    seconds: 12.5\n"
      "    paper: {found: SELECT m FROM light, holds: SELECT count(*) = 2 FROM light, seconds: SELECT 0.25}\n"
      "    ours: {found: \"SELECT 'id ' || id FROM light_id\", holds: SELECT m < 2 FROM light, expect: agree}\n"
      "  - {says: silence, paper: {holds: SELECT NULL}}\n");
  expect("d.yaml -q --results :memory: --format csv", 0,
         "text,it is light,1,does not agree,id 0,agrees\n,silence,,cannot be said,,\n");
  expect("d.yaml -q --results :memory: --format csv", 0, "text,12.5,0.25,,it is light\n");
  expect("d.yaml -q --results :memory:", 0,
         "0 claims agree with the settings of their source, 1 do not, of 1 it cannot be said");
  /* views are of a run, not of the file */
  expect("d.yaml -q --results d.sqlite --fresh && $H study d.yaml -q --results d.sqlite", 0, "it is light");
  folder_put("v.yaml",
             "study: v\n" LINEAR "run: frf\nvary: [{oscillator.mass: [1, 4]}]\nviews: {a: SELECT y FROM scene}\n");
  expect("v.yaml -q 2>&1", 2, "v.yaml:5:12: `a`: no such column: y");
  folder_put("v.yaml", "study: v\n" LINEAR
                       "run: frf\nvary: [{oscillator.mass: [1, 4]}]\nviews: {a: SELECT 1; DROP TABLE scene}\n");
  expect("v.yaml -q 2>&1", 2, "is more than one query");
  folder_put(
      "u.yaml",
      "study: u\n" LINEAR
      "run: frf\nvary: [{oscillator.mass: [1, 4]}]\nclaims:\n  - {source: s, says: x, ours: {holds: SELECT 0, expect: "
      "agree}}\n");
  expect("u.yaml -q --results :memory:", 1, "not as expected with ours: s: x");
}

/* Fixed steps have a table of their own, with the other two verdicts; "cannot be said" may be expected. */
static void claims_are_answered_in_fixed_steps(CHECK_STATE)
{
  folder_put("f.yaml", "study: f\n" LINEAR
                       "run: frf\nvary: [{oscillator.mass: [1, 4]}]\nclaims:\n  - source: text\n    says: it fails\n"
                       "    paper: {holds: SELECT NULL, expect: unsaid}\n"
                       "    ours: {holds: SELECT 0, expect: disagree}\n"
                       "    fixed_step: {found: SELECT 'stops', holds: SELECT 1, expect: agree}\n"
                       "  - {says: only there, fixed_step: {holds: SELECT 0}}\n");
  expect("f.yaml -q --results :memory: --format csv", 0,
         "source,says,fixed_step_found,fixed_step_holds,paper_holds,ours_holds\n"
         "text,it fails,stops,agrees,cannot be said,does not agree\n,only there,,does not agree,,\n");
  expect("f.yaml -q --results :memory:", 0, "1 claims agree in fixed steps, 1 do not, of 0 it cannot be said");
  expect("f.yaml -q --results :memory:", 0, "0 claims agree with ours, 1 do not, of 0 it cannot be said");
  folder_put("x.yaml", "study: x\n" LINEAR "run: frf\nvary: [{oscillator.mass: [1, 4]}]\nclaims:\n"
                       "  - {source: s, says: y, fixed_step: {holds: SELECT 1, expect: unsaid}}\n");
  expect("x.yaml -q --results :memory:", 1, "not as expected in fixed steps: s: y");
}

/* Long texts are carried over, not cut; no line is longer than the page. */
static void long_claims_are_wrapped(CHECK_STATE)
{
  char word[] = "abcdefghi ", text[700] = "";
  for (int i = 0; i < 30; ++i) strcat(text, word);
  char file[2000];
  snprintf(file, sizeof file,
           "study: l\n" LINEAR
           "run: frf\nvary: [{oscillator.mass: [1, 4]}]\nclaims:\n  - {source: s, says: x, found: \"SELECT '%send'\", "
           "holds: SELECT 1}\n",
           text);
  folder_put("l.yaml", file);
  reply o = run("l.yaml -q --results :memory: | sed -n '/^Claims/,$p'");
  int words = 0;
  assert_int_equal(o.code, 0);
  for (const char *p = o.out; (p = strstr(p, "abcdefghi")); ++p) ++words;
  assert_int_equal(words, 30);
  for (char *line = strtok(o.out, "\n"); line; line = strtok(NULL, "\n")) assert_true(strlen(line) <= 80);
  free(o.out);
}

static void a_failure_is_a_row(CHECK_STATE)
{
  folder_put("f.yaml", "study: f\n" LINEAR "run: frf\nset: {hbm.force: sampled}\nvary: [{hbm.samples: [32, 8]}]\n");
  expect("f.yaml -q", 3, "8 samples cannot tell 5 harmonics apart");
  expect("f.yaml -q --export csv", 3, "\n1,8,failed,");
  expect("f.yaml -q >/dev/null; echo 'may_fail: true' >>f.yaml; $H study f.yaml -q", 0,
         "8 samples cannot tell 5 harmonics apart");
  folder_put("r.yaml", "study: r\n" LINEAR "run: transient\nvary: [{compare.omega: [[5], [6]]}]\n");
  expect("r.yaml -q --export csv", 0, "\n1,[6],done,,6,settled,");
  expect("r.yaml -q --export csv --timings", 0, "status,reason,seconds,omega");
  folder_put("q.yaml", "study: q\n" LINEAR "set: {compare.omega: [5]}\nvary: [{oscillator.mass: [1, 2]}]\n");
  expect("q.yaml -q", 0, "match");
}

static void usage_is_checked(CHECK_STATE)
{
  expect("2>&1", 64, "STUDY");
  expect("t.yaml --jobs 0 2>&1", 64, "--jobs: '0'");
  expect("t.yaml --export table 2>&1", 64, "expected csv or json");
  expect("t.yaml m.yaml --export csv 2>&1", 64, "one study at a time");
  expect("t.yaml m.yaml --results x.sqlite 2>&1", 64, "would share the results file x.sqlite");
  expect("t.yaml --timings 2>&1", 64, "--timings goes with --export");
  expect("t.yaml --results /nonexistent/r 2>&1", 2, "/nonexistent/r: cannot be opened for writing");
  expect("--help", 0, "example");
  expect("m.yaml -q --results . && ls m.sqlite", 0, "./m.sqlite");
  setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
#ifndef HBMCHECK_HAS_MPI
  expect("m.yaml 2>&1", 64, "built without MPI");
#endif
  unsetenv("OMPI_COMM_WORLD_SIZE");
}

static int make_folder(void **state) { return setenv("COLUMNS", "80", 1) == 0 ? folder_make(state) : -1; }

CHECK_TESTS_WITH("study.command", 300, make_folder, folder_remove, killed_and_resumed, threads_change_nothing,
                 stopped_by_a_signal, a_second_process_is_refused, changed_and_foreign, claims_are_held,
                 claims_have_two_sides, claims_are_answered_in_fixed_steps, long_claims_are_wrapped, a_failure_is_a_row,
                 usage_is_checked)
