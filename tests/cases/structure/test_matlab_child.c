/* test_matlab_child.c - whatever becomes of the process that reads a MATLAB file: a matrix, or a line of words. */
#include <signal.h>
#include <sys/resource.h>
#include <time.h>

#include "casefile/matlab_variable.h"
#include "tests/cases/structure/matlab_files.h"

/* The linker puts this in the place of matlab_variable_read. */
static enum {
  AS_EVER,
  CRASHES,
  LOOPS,
  LEAVES,
  HUNGERS,
  TALKS,
  NAN_INSIDE,
  TOO_MANY,
  ENDLESS_WORDS,
  NO_WORDS,
  ODD_STATUS
} child;

hc_status __real_matlab_variable_read(const char *path, const char *variable, int expected, int *rows, double **values,
                                      message *m);
hc_status __wrap_matlab_variable_read(const char *path, const char *variable, int expected, int *rows, double **values,
                                      message *m);
hc_status __wrap_matlab_variable_read(const char *path, const char *variable, int expected, int *rows, double **values,
                                      message *m)
{
  hc_status st = __real_matlab_variable_read(path, variable, expected, rows, values, m);
  switch (child) {
  case AS_EVER: break;
  case CRASHES: raise(SIGSEGV); break;
  case LOOPS:
    for (volatile unsigned i = 0;; ++i) {}
  case LEAVES: _exit(0);
  case HUNGERS:
    if (malloc((size_t)3 << 30)) *rows = 1; /* then it is read */
    else st = HC_NO_MEMORY;
    break;
  case TALKS: fprintf(stderr, "a library talks\n"); break;
  case NAN_INSIDE: (*values)[3] = NAN; break;
  case TOO_MANY: *rows = 5000; break;
  case ENDLESS_WORDS: memset(m->text, '\n', m->size); return HC_BAD_INPUT;
  case NO_WORDS: return HC_BAD_INPUT;
  case ODD_STATUS: return (hc_status)77;
  }
  return st;
}

static void child_is_refused(int mode, const char *start)
{
  own_file f;
  snprintf(f.path, sizeof f.path, "tests/cases/structure/octave_v7.mat");
  child = mode;
  variable_is_refused(&f, "M", 2, start);
  child = AS_EVER;
}

static void children_that_go_wrong(void **state)
{
  (void)state;
  static const char *const no_answer = "cannot be read: libmatio gave no answer, expected a MATLAB file without damage";
  child_is_refused(CRASHES, "cannot be read: libmatio crashed (signal 11), expected a MATLAB file without damage");
  child_is_refused(LEAVES, no_answer);
  child_is_refused(NAN_INSIDE, no_answer);
  child_is_refused(TOO_MANY, no_answer);
  child_is_refused(NO_WORDS, no_answer);
  child_is_refused(ODD_STATUS, no_answer);
  child_is_refused(ENDLESS_WORDS, "\\x0A\\x0A");
  /* A program that does not care for its children is not told how they end. */
  signal(SIGCHLD, SIG_IGN);
  child_is_refused(CRASHES, no_answer);
  signal(SIGCHLD, SIG_DFL);
  own_file f;
  snprintf(f.path, sizeof f.path, "tests/cases/structure/octave_v7.mat");
  child = TALKS; /* to nobody: ctest shows what it says */
  const double diag[] = {2, -1, -1, 2};
  variable_reads(&f, "M", 2, diag);
  child = AS_EVER;
}

/* The pipe then gets the numbers of standard output and error. */
static void without_a_terminal(void **state)
{
  (void)state;
  double *v = NULL;
  int n = 0, saved[2];
  char words[512];
  message m;
  message_start(&m, words, sizeof words);
  for (int i = 0; i < 2; ++i) saved[i] = dup(1 + i);
  for (int i = 0; i < 2; ++i) close(1 + i);
  const hc_status st = matlab_file_read("tests/cases/structure/octave_v7.mat#M", 2, &n, &v, &m);
  for (int i = 0; i < 2; ++i) dup2(saved[i], 1 + i), close(saved[i]);
  assert_int_equal(st, HC_OK);
  assert_true(n == 2 && v[0] == 2 && v[3] == 2);
  free(v);
}

/* Its 20 s are more than a test has: it obeys a limit that is lower. */
static void a_child_without_end(void **state)
{
  (void)state;
  struct rlimit before, now;
  assert_int_equal(getrlimit(RLIMIT_CPU, &before), 0);
  now = before;
  now.rlim_cur = (rlim_t)(clock() / CLOCKS_PER_SEC) + 3;
  assert_int_equal(setrlimit(RLIMIT_CPU, &now), 0);
  child_is_refused(LOOPS, "cannot be read: libmatio did not end within 20 s");
  assert_int_equal(setrlimit(RLIMIT_CPU, &before), 0);
}

/* More than it may have: the sanitizers give memory otherwise. */
static void a_child_without_measure(void **state)
{
  (void)state;
#if !defined(__SANITIZE_ADDRESS__)
  double *v;
  int n;
  char words[512];
  message m;
  message_start(&m, words, sizeof words);
  child = HUNGERS;
  assert_int_equal(matlab_file_read("tests/cases/structure/octave_v7.mat#M", 2, &n, &v, &m), HC_NO_MEMORY);
  assert_true(!v && n == 0);
  child = AS_EVER;
#else
  (void)HUNGERS;
#endif
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(children_that_go_wrong),
    cmocka_unit_test(without_a_terminal),
    cmocka_unit_test(a_child_without_end),
    cmocka_unit_test(a_child_without_measure),
};

CHECK_MAIN("structure.matlab_child", tests, 30)
