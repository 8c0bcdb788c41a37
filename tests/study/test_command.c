/* test_command.c - hbmcheck study killed, stopped and resumed: what is stopped at a certain place is a child
 * (tests/faults/moments.h). All else: claims.transcript. */
#include <signal.h>

#include "tests/faults/moments.h"
#include "tests/folder.h"
#include "tests/program.h"

#define MANY(title, steps)                                                                                             \
  "study: " title "\nrun: frf\n"                                                                                       \
  "case: {oscillator: {mass: 1, damping: 0.4, stiffness: 40}, forcing: {amplitude: 1}, sweep: {omega: [3, 9]}}\n"      \
  "set: {compare.omega: [5, 6]}\nvary:\n"                                                                              \
  "  - {oscillator.mass: {from: 0.5, to: 2, count: " steps                                                             \
  "}}\n  - {oscillator.damping: {from: 0.1, to: 0.9, count: 20}}\n"

static outcome last;

/* Ten kills at moments drawn from a fixed sequence, among SQLite's writes, too. An undisturbed run has 800 scenes and
 * two moments or more in each; a tenth of these moments a run, halved by the ten that are killed on the average, leave
 * scenes for all of them. Then every scene is there once, and the export is that of an undisturbed run. */
static void killed_and_resumed(CHECK_STATE)
{
  unsigned long long seed = 88172645463325252ull;
  folder_put("k.yaml", MANY("kills", "40"));
  moments_run("study k.yaml -q --results whole.sqlite --jobs 1", 0, 0, &last);
  assert_int_equal(last.code, 0);
  const long whole = last.count;
  assert_true(whole >= 2 * 800);
  for (int i = 0; i < 10; ++i) {
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    moments_run("study k.yaml -q --jobs 2", SIGKILL, 1 + (long)(seed % (unsigned long)(whole / 10)), &last);
    if (last.signal != SIGKILL) child_show(&last, "not killed");
    assert_int_equal(last.signal, SIGKILL);
  }
  expect("study k.yaml -q --export csv -o killed.csv", 0, "");
  /* a header, and two omegas a scene */
  expect("study k.yaml -q --export csv --results whole.sqlite -o whole.csv && cmp killed.csv whole.csv && "
         "wc -l <whole.csv",
         0, "1601\n");
}

static void stopped_by_a_signal(CHECK_STATE)
{
  folder_put("s.yaml", MANY("signals", "80"));
  moments_run("study s.yaml -q", SIGTERM, 200, &last);
  shell_check("stopped", last.code, last.err, 3, "scenes are in s.sqlite; the same command goes on from there");
  moments_run("study s.yaml -q --export csv --fresh", SIGTERM, 200, &last);
  assert_int_equal(last.code, 3);
  assert_string_equal(last.out, ""); /* half an export would look like a whole one */
  expect("study s.yaml -q", 0, "1600");
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
    if (!freopen("/dev/null", "w", stdout)) _exit(99);
    moments_expect(100, stand_still, &s);
    _exit(child_command("study p.yaml -q --jobs 1"));
  }
  close(there[1]);
  close(go[0]);
  assert_int_equal(read(there[0], &byte, 1), 1);
  expect("study p.yaml -q 2>&1", 2, "p.sqlite: another hbmcheck is writing these results");
  close(go[1]);
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  close(there[0]);
}

CHECK_TESTS_WITH("study.command", 300, folder_enter, folder_remove, killed_and_resumed, stopped_by_a_signal,
                 a_second_process_is_refused)
