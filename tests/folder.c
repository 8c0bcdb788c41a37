/* folder.c - the test program of a folder: PROGRAM FILE [ARGUMENT...] runs the tests of test_FILE.c. */
#include <stdio.h>
#include <string.h>

#define TEST(file) int check_entry_##file(int argc, char **argv);
#include TESTS
#undef TEST

int main(int argc, char **argv)
{
  static const struct {
    const char *file;
    int (*run)(int argc, char **argv);
  } tests[] = {
#define TEST(file) {#file, check_entry_##file},
#include TESTS
  };
  for (size_t i = 0; i < sizeof tests / sizeof *tests; ++i)
    if (argc > 1 && strcmp(argv[1], tests[i].file) == 0) return tests[i].run(argc - 1, argv + 1);
  fprintf(stderr, "%s: expected the name of a file of tests:", argv[0]);
  for (size_t i = 0; i < sizeof tests / sizeof *tests; ++i) fprintf(stderr, " %s", tests[i].file);
  fputc('\n', stderr);
  return 2;
}
