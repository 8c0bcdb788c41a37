/* test_files.c - what is written where it cannot be: a full disk, a limit on file sizes, a closed pipe, a folder in
 * place of the file, no folder at all; and results files of studies that are empty, cut, overwritten, foreign,
 * locked or of a study that has changed. Exit 3 (or 2 for a results file) and the name of what failed; what stood
 * there before stays. Also as root, whom no permission stops. */
#include "tests/faults/shell.h"
#include "tests/faults/small.h"

/* Nothing written beside another file is left. */
#define CLEAN " ; c=$?; ls -a | grep -q '^[.]hbmcheck-' && exit 99; exit $c"

static void full_disk(CHECK_STATE)
{
  if (access("/dev/full", W_OK) != 0) skip();
  expect("$H frf small.yaml -q 2>&1 >/dev/full", 3, "standard output: No space left");
  expect("$H frf small.yaml -q -o /dev/full 2>&1", 3, "/dev/full: No space left");
  expect("$H frf small.yaml -q --format json -o /dev/full 2>&1", 3, "/dev/full: No space left");
  expect("$H compare small.yaml -q --format csv -o /dev/full 2>&1", 3, "/dev/full: No space left");
  expect("$H gate small.yaml -q --junit /dev/full 2>&1 >/dev/null", 3, "/dev/full: No space left");
  expect("$H describe -o /dev/full 2>&1", 3, "");
  expect("$H contact small.yaml -q --motion 0,1,0 2>&1 >/dev/full", 3, "standard output: No space left");
  expect("$H study study.yaml -q --results :memory: --export csv -o /dev/full 2>&1", 3, "/dev/full: No space left");
  expect("$H study study.yaml -q --results /dev/full 2>&1", 2, "/dev/full: not a regular file");
  /* also without gnuplot */
  expect("ln -sf /dev/full full.svg; $H frf small.yaml -q --plot full.svg 2>&1 >/dev/null", 3, "no drawing: ");
  /* 64: no Chart.js */
  expect("$H report small.yaml -q --harmonics 1 --samples 16 -o /dev/full 2>&1; c=$?; [ $c = 64 ] && exit 3; exit $c",
         3, "hbmcheck report: ");
  expect("$H verify small.yaml -q --against curve.csv --columns omega=1,amplitude=2 2>&1 >/dev/full", 3,
         "standard output: No space left");
}

/* A limit on the size of files, the signal for it ignored, is a disk that fills up in the middle. */
#define LIMITED "trap '' XFSZ; ulimit -f 1; "
static void disk_fills_up(CHECK_STATE)
{
  expect("echo before >old; (" LIMITED "$H describe -q -o old 2>&1)" CLEAN, 3, "");
  expect("cat old", 0, "before\n");
  expect("(" LIMITED "$H study study.yaml -q --results limited.sqlite 2>&1)", 2, "limited.sqlite");
  expect("$H study study.yaml -q --results limited.sqlite 2>&1", 0, "limited.sqlite");
}

static void wrong_places(CHECK_STATE)
{
  expect("mkdir -p there; $H frf small.yaml -q -o there 2>&1" CLEAN, 3, "there: Is a directory");
  expect("$H frf small.yaml -q -o missing/out 2>&1", 3, "missing/out: No such file");
  expect("$H frf small.yaml -q -o /proc/hbmcheck-out 2>&1", 3, "/proc/hbmcheck-out: ");
  expect("$H gate small.yaml -q --junit there 2>&1" CLEAN, 3, "there: Is a directory");
  expect("$H study study.yaml -q --results missing/r.sqlite 2>&1", 2, "missing/r.sqlite: cannot be opened");
  expect("$H frf . 2>&1", 2, ".: a directory");
  expect("$H verify small.yaml -q --against there --columns omega=1,amplitude=2 2>&1", 2, "there: ");
}

/* Descriptor 3 writes into a pipe that nobody reads any more. */
#define UNREAD "rm -f pipe; mkfifo pipe; exec 4<>pipe 3>pipe 4<&-; "

/* With SIGPIPE as it is by default and ignored: never a signal, and no message, for whoever reads has seen enough. */
static void closed_pipe(CHECK_STATE)
{
  expect("{ $H describe 2>err; echo $? >code; } | true; cat code err", 0, "");
  expect(UNREAD "$H describe 2>err >&3; echo $?; cat err", 0, "3\n");
  expect(UNREAD "$H frf small.yaml -q --format csv 2>err >&3; echo $?; wc -c <err", 0, "3\n0");
  expect("trap '' PIPE; " UNREAD "$H frf small.yaml -q 2>err >&3; echo $?; wc -c <err", 0, "3\n0");
  expect("$H frf small.yaml -q --format csv | head -1", 0, "# small: H = 3");
}

/* ---- results of a study ---- */

static void damaged_results(CHECK_STATE)
{
  expect("$H study study.yaml -q --results good.sqlite 2>&1", 0, "good.sqlite");
  /* as a crash before the first write leaves it */
  expect(": >empty.sqlite; $H study study.yaml -q --results empty.sqlite", 0, "empty.sqlite");
  expect("head -c 50 good.sqlite >cut.sqlite; cp cut.sqlite copy; $H study study.yaml -q --results cut.sqlite 2>&1; "
         "c=$?; cmp cut.sqlite copy && exit $c",
         2, "cut.sqlite: not an SQLite file");
  expect(
      "head -c 5000 good.sqlite >cut2.sqlite; cp cut2.sqlite copy; $H study study.yaml -q --results cut2.sqlite 2>&1; "
      "c=$?; cmp cut2.sqlite copy && exit $c",
      2, "cut2.sqlite: damaged");
  expect(
      "cp good.sqlite bad.sqlite; for at in 1 2 3; do head -c 4000 /dev/zero | tr '\\0' 'x' | dd of=bad.sqlite "
      "bs=4096 seek=$at conv=notrunc 2>/dev/null; "
      "done; cp bad.sqlite copy; $H study study.yaml -q --results bad.sqlite 2>&1; c=$?; cmp bad.sqlite copy && exit "
      "$c",
      2, "bad.sqlite: damaged");
  expect("echo precious >text.sqlite; $H study study.yaml -q --fresh --results text.sqlite 2>&1; cat text.sqlite", 0,
         "precious\n");
}

static void changed_study(CHECK_STATE)
{
  expect("sed 's/\\[2, 3\\]/[2, 3, 4]/' study.yaml >changed.yaml; $H study changed.yaml -q --results good.sqlite 2>&1",
         2, "good.sqlite: results of another study, or of this one before it was changed");
  expect("$H study study.yaml -q --results good.sqlite --set forcing.amplitude=21 2>&1", 2,
         "good.sqlite: results of another study");
  /* all of it is still there */
  expect("$H study study.yaml -q --results good.sqlite 2>&1", 0, "frf       2         0     2       0");
}

/* Held by another process for longer than we are ready to wait for the file's lock; the scenes are kept when it lets
 * go. */
static void locked_results(CHECK_STATE)
{
  expect("flock good.sqlite sh -c '$H study study.yaml -q --results good.sqlite 2>&1'", 2,
         "good.sqlite: another hbmcheck is writing these results");
}

int main(void)
{
  setenv("H", HBMCHECK_COMMAND, 1);
  return SMALL_MAIN("files", 200, full_disk, disk_fills_up, wrong_places, closed_pipe, damaged_results, changed_study,
                    locked_results);
}
