/* test_stop.c - a first SIGTERM ends the command wherever it is: reading a pipe that never says anything, writing to
 * one that nobody reads, inside one evaluation of 2^24 samples, amid thousands of scenes, waiting for gnuplot. Exit 3
 * with a remark, nothing left beside, files as they were, no process left behind. What does not end is killed after a
 * long time, which is exit 137; how long the rest takes is not measured. */
#include "tests/faults/shell.h"
#include "tests/faults/small.h"

/* A signal before the program has begun to listen would end it with 143, hence a second. */
#define TERM_IT "timeout --foreground --preserve-status -k 60 -s TERM 1 "

/* Each line of shell in `runs`, all at a time; NAME is where it is printed how it ended. */
#define RUN(name, line) "{ " line " >" name ".out 2>" name ".err; echo $? >" name ".code; } & "
#define ALL_ENDED(names)                                                                                               \
  "wait; for n in " names "; do echo $n $(cat $n.code) $(grep -c 'stopped on request' $n.err); "                       \
  "grep -v 'stopped on request' $n.err; done; ls -a | grep '^[.]hbmcheck-'; true"

static void check_all(const char *line, const char *expected)
{
  said s = shell(line);
  if (s.code == 0 && !strcmp(s.text, expected)) return;
  print_error("%s\nexit %d, expected\n%s--- and it says\n%s", line, s.code, expected, s.text);
  fail();
}

static void reading_or_writing_a_pipe(CHECK_STATE)
{
  /* 9 keeps both ends of the pipe open: reading waits for ever, and so does writing once it is full */
  check_all(
      "mkfifo silent alone full; exec 9<>silent; exec 8<>full; head -c 65536 /dev/zero >&8; " RUN("case", TERM_IT
                                                                                                  "$H frf silent")
          RUN("stdin", TERM_IT "$H compare - <&9") RUN("study", TERM_IT "$H study silent")
              RUN("curve", TERM_IT "$H verify small.yaml --against silent --columns omega=1,amplitude=2")
                  RUN("gate", TERM_IT "$H gate small.yaml silent --junit kept.xml")
                      RUN("unread", TERM_IT "$H frf small.yaml -o alone") RUN("page", TERM_IT "$H report silent")
                          RUN("bench", TERM_IT "$H bench silent") RUN("values", TERM_IT "$H describe --case silent")
                              RUN("rows", TERM_IT "sh -c 'exec $H compare small.yaml --format csv >full'")
                                  ALL_ENDED("case stdin study curve gate unread page bench values rows"),
      "case 3 1\nstdin 3 1\nstudy 3 1\ncurve 3 1\ngate 3 1\nunread 3 1\npage 3 1\nbench 3 1\nvalues 3 1\nrows 3 2\n");
  expect("test -e kept.xml", 1, "");
}

/* A second and more for one evaluation: no tick of the monitor comes in between. */
static void inside_one_evaluation(CHECK_STATE)
{
  small_file("kept", "before\n");
  check_all(RUN("contact", TERM_IT "$H contact small.yaml --motion 0,8,0 --samples 16777216,16777215,16777214 -o kept")
                ALL_ENDED("contact"),
            "contact 3 1\n");
  expect("cat kept", 0, "before\n");
}

/* Minutes of work, in several threads too. */
static void amid_thousands_of_scenes(CHECK_STATE)
{
  small_file("many.yaml", "study: many\nbase: small.yaml\nrun: compare\nvary:\n"
                          "  - contacts[0].gap: {from: -6, to: -1, count: 5000}\n");
  check_all(RUN("study", TERM_IT "$H study many.yaml --jobs 2 --results :memory: -q")
                RUN("stress", TERM_IT "$H stress --scenes 100000 --jobs 2 -q -o /dev/null")
                    RUN("bench",
                        TERM_IT "$H bench small.yaml --repeats 1000 -q") "wait; for n in study stress bench; do "
                                                                         "echo $n $(cat $n.code); "
                                                                         "grep -q stopped $n.err || echo silent; done",
            "study 3\nstress 3\nbench 3\n");
}

static void waiting_for_gnuplot(CHECK_STATE)
{
  small_file("gnuplot", "#!/bin/sh\necho $$ >gnuplot.pid\nexec sleep 1000\n");
  check_all("chmod +x gnuplot; PATH=.:$PATH; " RUN("drawn", TERM_IT "$H frf small.yaml -q --plot drawn.svg")
                ALL_ENDED("drawn"),
            "drawn 3 1\n");
  expect("test -e drawn.svg", 1, "");
  /* ended, whether or not its new parent has asked how */
  expect("test ! -e /proc/$(cat gnuplot.pid)/stat || grep -q ') [ZX] ' /proc/$(cat gnuplot.pid)/stat", 0, "");
}

/* JUnit is opened before anything runs, so its file beside is there when the signal comes. */
static void files_beside_are_removed(CHECK_STATE)
{
  small_file("kept.xml", "before\n");
  check_all(
      RUN("gate", TERM_IT "$H gate small.yaml --junit kept.xml --set hbm.force=sampled --set hbm.samples=16777216")
          ALL_ENDED("gate"),
      "gate 3 1\n");
  expect("cat kept.xml", 0, "before\n");
}

int main(void)
{
  setenv("H", HBMCHECK_COMMAND, 1);
  return SMALL_MAIN("stop", 600, reading_or_writing_a_pipe, inside_one_evaluation, amid_thousands_of_scenes,
                    waiting_for_gnuplot, files_beside_are_removed);
}
