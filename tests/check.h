/* check.h - what every test needs on top of cmocka: comparisons that print both sides and fail on NaN, and a watchdog.
 * A test file has one group; its tests are named folder.file.what and run as one ctest. */
#pragma once

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "numerics/base/constants.h"
#include "numerics/norm.h"

/* The parameter of a test that does not use it: static void what_it_holds(CHECK_STATE). */
#define CHECK_STATE void **state __attribute__((unused))

/* value <= bound, or fail with both and the context printf-style; NaN fails. */
#define CHECK_LE(value, bound, ...)                                                                                    \
  do {                                                                                                                 \
    double v_ = (value), b_ = (bound);                                                                                 \
    if (!(v_ <= b_)) {                                                                                                 \
      print_error("%s:%d: %s = %.17g > %.17g: ", __FILE__, __LINE__, #value, v_, b_);                                  \
      print_error(__VA_ARGS__);                                                                                        \
      print_error("\n");                                                                                               \
      fail();                                                                                                          \
    }                                                                                                                  \
  } while (0)

/* |a - b| <= tol, NaN fails. */
#define CHECK_NEAR(a, b, tol, ...) CHECK_LE(fabs((a) - (b)), (tol), __VA_ARGS__)

/* TYPE NAME; filled in by the call, which is given &NAME and answers 0 (HC_OK, HBMCHECK_OK), or the test fails. */
#define CHECK_FILLED(type, name, call)                                                                                 \
  type name;                                                                                                           \
  assert_int_equal(call, 0)

/* Likewise TYPE *NAME; which the call makes. */
#define CHECK_MADE(type, name, call) CHECK_FILLED(type *, name, call)

/* The tick of a monitor whose self is an int: asks for a stop when it has counted that down to 0. */
static inline bool check_stop(void *left, double done)
{
  (void)done;
  return --*(int *)left > 0;
}

/* A hang is a failure: every test main calls this first, with the seconds after which nobody would wait any longer on a
 * slow machine with nothing else to do. A busy one may take ten times as long: the watchdog ends hangs, it measures
 * nothing. It comes before ctest's own limit of 1500 s, unless more than that is asked for. */
static inline void check_watchdog(unsigned seconds)
{
  const unsigned most = 1400;
  alarm(seconds >= most ? seconds : seconds < most / 10 ? 10 * seconds : most);
}

/* What a test skips shows in ctest's closing lines: a program of whose tests none failed and one was skipped ends with
 * the code that tests/CMakeLists.txt calls skipped. A failure counts for more. */
static int check_skipped;
static inline int check_ended(int failed)
{
  enum { SKIPPED = 77 };
  return failed ? 1 : check_skipped ? SKIPPED : 0;
}
#undef skip
#define skip() (++check_skipped, _skip(__FILE__, __LINE__))
#undef cmocka_run_group_tests
#define cmocka_run_group_tests(tests, setup, teardown) cmocka_run_group_tests_name(#tests, tests, setup, teardown)
#undef cmocka_run_group_tests_name
#define cmocka_run_group_tests_name(name, tests, setup, teardown)                                                      \
  check_ended(_cmocka_run_group_tests(name, tests, sizeof(tests) / sizeof *(tests), setup, teardown))

/* So many random trials; an eighth under a sanitizer, which makes each some five times as slow and looks for other
 * mistakes: those of memory, which do not hide in one scene of a thousand. */
#ifdef __SANITIZE_ADDRESS__
#define CHECK_TRIALS(n) ((n) / 8)
#else
#define CHECK_TRIALS(n) (n)
#endif

/* So many in the file's long run (CHECK_TESTS_AND_LONG), an eighth of them in the other. */
static bool check_long __attribute__((unused));
#define CHECK_LONG_TRIALS(n) (check_long ? CHECK_TRIALS(n) : (n) / 8)

/* The function that runs a file's tests, which returns what check_ended does: CHECK_ENTRY_FUNCTION { ... }. In a
 * program of several files tests/CMakeLists.txt names it, and tests/folder.c calls it; else it is main. */
#ifndef CHECK_ENTRY
#define CHECK_ENTRY main
#endif
#define CHECK_ENTRY_FUNCTION int CHECK_ENTRY(int argc __attribute__((unused)), char **argv __attribute__((unused)))

/* The entry of a file whose tests are a struct CMUnitTest tests[] (since some have a setup of their own): the
 * seconds after which it ends, their common setup and teardown or NULL. */
#define CHECK_MAIN_WITH(name, tests, seconds, setup, teardown)                                                         \
  CHECK_ENTRY_FUNCTION                                                                                                 \
  {                                                                                                                    \
    check_watchdog(seconds);                                                                                           \
    return cmocka_run_group_tests_name(name, tests, setup, teardown);                                                  \
  }
#define CHECK_MAIN(name, tests, seconds) CHECK_MAIN_WITH(name, tests, seconds, NULL, NULL)

/* Functions as tests under their names, which are listed in `names`, divided by commas. */
enum { CHECK_MOST_TESTS = 64 };
static inline int check_run(const char *group, char *names, size_t n, const CMUnitTestFunction *functions,
                            CMFixtureFunction setup, CMFixtureFunction teardown)
{
  struct CMUnitTest tests[CHECK_MOST_TESTS] = {{0}};
  for (size_t i = 0; i < n; ++i) {
    tests[i].name = strtok(i == 0 ? names : NULL, ", ");
    tests[i].test_func = functions[i];
  }
  return check_ended(_cmocka_run_group_tests(group, tests, n, setup, teardown));
}

/* Runs these functions as the tests of a group; as main does below, or one that has something to do before. */
#define CHECK_FUNCTIONS(...)                                                                                           \
  (CMUnitTestFunction[]) { __VA_ARGS__ }
#define CHECK_COUNT(...) (sizeof CHECK_FUNCTIONS(__VA_ARGS__) / sizeof(CMUnitTestFunction))
#define CHECK_RUN(name, setup, teardown, ...)                                                                          \
  check_run(name, (char[]){#__VA_ARGS__}, CHECK_COUNT(__VA_ARGS__), CHECK_FUNCTIONS(__VA_ARGS__), setup, teardown)

/* The entry of a file whose tests are these functions. */
#define CHECK_TESTS_WITH(name, seconds, setup, teardown, ...)                                                          \
  CHECK_ENTRY_FUNCTION                                                                                                 \
  {                                                                                                                    \
    _Static_assert(CHECK_COUNT(__VA_ARGS__) <= CHECK_MOST_TESTS, "more tests than check_run has room for");            \
    check_watchdog(seconds);                                                                                           \
    return CHECK_RUN(name, setup, teardown, __VA_ARGS__);                                                              \
  }
#define CHECK_TESTS(name, seconds, ...) CHECK_TESTS_WITH(name, seconds, NULL, NULL, __VA_ARGS__)

/* The same with a second list, of tests that take long, or of more trials: where the first argument is `long` it runs
 * instead of the first, as ctest's folder.file_long. Both lists in parentheses. */
#define CHECK_UNPACK(...)       __VA_ARGS__
#define CHECK_RUN_UNPACKED(...) CHECK_RUN(__VA_ARGS__)
#define CHECK_TESTS_AND_LONG_WITH(name, seconds, setup, teardown, tests, long_tests)                                   \
  CHECK_ENTRY_FUNCTION                                                                                                 \
  {                                                                                                                    \
    check_watchdog(seconds);                                                                                           \
    if ((check_long = argc > 1 && strcmp(argv[1], "long") == 0))                                                       \
      return CHECK_RUN_UNPACKED(name "_long", setup, teardown, CHECK_UNPACK long_tests);                               \
    return CHECK_RUN_UNPACKED(name, setup, teardown, CHECK_UNPACK tests);                                              \
  }
#define CHECK_TESTS_AND_LONG(name, seconds, tests, long_tests)                                                         \
  CHECK_TESTS_AND_LONG_WITH(name, seconds, NULL, NULL, tests, long_tests)
