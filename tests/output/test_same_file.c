/* test_same_file.c - one file under several names is known as one, two files are two. */
#include <errno.h>
#include <fcntl.h>

#include "compare/output/same_file.h"
#include "tests/folder.h"

static bool same(const char *a, const char *b)
{
  file_identity one, two;
  assert_true(file_identify(a, -1, &one) && file_identify(b, -1, &two));
  const bool found = file_same(&one, &two);
  assert_int_equal(found, file_same(&two, &one));
  file_forget(&one);
  file_forget(&two);
  return found;
}

static void files_that_are_there(CHECK_STATE)
{
  folder_put("a", "");
  folder_put("b", "");
  assert_int_equal(mkdir("d", 0777) | symlink("a", "soft") | symlink("soft", "softer") | link("a", "hard"), 0);
  assert_true(same("a", "a") && same("a", "./a") && same("a", "d/../a") && same("soft", "a") && same("softer", "hard"));
  assert_false(same("a", "b") || same("softer", "b"));
  assert_false(same("a", "new")); /* one is there, the other is not */
}

static void files_to_come(CHECK_STATE)
{
  char whole[128];
  snprintf(whole, sizeof whole, "%s/new", folder);
  assert_int_equal(symlink("new", "to_new") | symlink("../new", "d/up") | symlink(".", "here"), 0);
  assert_true(same("new", "./new") && same("new", "here/new") && same("new", whole));
  assert_true(same("to_new", "new") && same("d/up", "to_new"));
  assert_false(same("new", "newer") || same("new", "d/new"));
  assert_false(same("missing/new", "missing/new")); /* no folder: nothing will be written there */
}

static void what_is_no_regular_file(CHECK_STATE)
{
  assert_int_equal(mkfifo("pipe", 0666) | symlink("circle", "circle"), 0);
  assert_false(same("/dev/null", "/dev/null") || same("pipe", "pipe") || same("d", "d") || same("", ""));
  assert_false(same("circle", "circle"));
  errno = 0;
  assert_null(file_follow_links("circle"));
  assert_int_equal(errno, ELOOP);
}

static void open_descriptors(CHECK_STATE)
{
  int fd = open("a", O_RDONLY);
  file_identity open_one, named;
  assert_true(fd >= 0 && file_identify(NULL, fd, &open_one) && file_identify("soft", -1, &named));
  assert_true(file_same(&open_one, &named));
  close(fd);
  assert_true(file_identify(NULL, fd, &open_one));
  assert_false(file_same(&open_one, &open_one)); /* closed: no file */
}

static void right_in_a_folder(CHECK_STATE)
{
  assert_true(file_is_in("d/x", "d") && file_is_in("d/x", "./here/d") && file_is_in("x", ".") && file_is_in("/x", "/"));
  assert_false(file_is_in("x", "d") || file_is_in("d/x", ".") || file_is_in("missing/x", "missing"));
}

CHECK_TESTS_WITH("output.same_file", 20, folder_enter, folder_remove, files_that_are_there, files_to_come,
                 what_is_no_regular_file, open_descriptors, right_in_a_folder)
