/* test_output.c - a file is there whole or not at all, and lost bytes are noticed. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "compare/output/output.h"
#include "tests/check.h"

enum { BIG = 1 << 20 /* more than any stdio buffer */ };

static char folder[64], path[128], other[128];

/* A fresh folder a test; path and other are names in it, of nothing yet. */
static int make_folder(CHECK_STATE)
{
  strcpy(folder, "/tmp/hbmcheck-test-XXXXXX");
  if (!mkdtemp(folder)) return -1;
  snprintf(path, sizeof path, "%s/out.csv", folder);
  snprintf(other, sizeof other, "%s/other", folder);
  return 0;
}

/* How many files are in the folder; removes them if asked to. */
static int files(bool remove_them)
{
  int n = 0;
  DIR *d = opendir(folder);
  assert_non_null(d);
  for (struct dirent *e; (e = readdir(d));) {
    if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0) continue;
    ++n;
    char name[512];
    snprintf(name, sizeof name, "%s/%s", folder, e->d_name);
    if (remove_them) remove(name);
  }
  closedir(d);
  return n;
}

static int remove_folder(CHECK_STATE)
{
  files(true);
  return rmdir(folder);
}

static void expect_content(const char *name, const char *expected)
{
  char text[256];
  FILE *from = fopen(name, "r");
  assert_non_null(from);
  text[fread(text, 1, sizeof text - 1, from)] = 0;
  fclose(from);
  assert_string_equal(text, expected);
}

static void put_content(const char *name, const char *text)
{
  FILE *to = fopen(name, "w");
  assert_non_null(to);
  fputs(text, to);
  assert_int_equal(fclose(to), 0);
}

static unsigned mode_of(const char *name)
{
  CHECK_FILLED(struct stat, st, stat(name, &st));
  return st.st_mode & 0777;
}

static output *opened(const char *name)
{
  CHECK_MADE(output, o, output_open(name, &o));
  assert_non_null(o);
  return o;
}

static void write_big(output *o)
{
  for (int i = 0; i < BIG; ++i) putc('x', output_stream(o));
}

static void expect_no_open(const char *name, int why)
{
  output *o = (output *)1;
  errno = 0;
  hc_status st = output_open(name, &o);
  assert_int_equal(errno, why);
  assert_int_equal(st, HC_IO);
  assert_null(o);
}

static void nothing_appears_until_commit(CHECK_STATE)
{
  output *o = opened(path);
  write_big(o);
  assert_int_equal(fflush(output_stream(o)), 0);
  assert_int_equal(access(path, F_OK), -1);
  assert_int_equal(output_commit(o), HC_OK);
  CHECK_FILLED(struct stat, st, stat(path, &st));
  assert_int_equal(st.st_size, BIG);
  assert_int_equal(files(false), 1);
}

static void abandon_leaves_nothing(CHECK_STATE)
{
  output *o = opened(path);
  write_big(o);
  output_abandon(o);
  assert_int_equal(files(false), 0);
  output_abandon(NULL);
}

static void an_existing_file_stays_until_commit(CHECK_STATE)
{
  put_content(path, "old\n");
  output *o = opened(path);
  write_big(o);
  expect_content(path, "old\n");
  output_abandon(o);
  expect_content(path, "old\n");
  assert_int_equal(files(false), 1);
  o = opened(path);
  fputs("new\n", output_stream(o));
  assert_int_equal(output_commit(o), HC_OK);
  expect_content(path, "new\n");
  assert_int_equal(files(false), 1);
}

static void permissions_follow_the_umask_or_the_file(CHECK_STATE)
{
  mode_t before = umask(027);
  assert_int_equal(output_commit(opened(path)), HC_OK);
  umask(before);
  assert_int_equal(mode_of(path), 0640);
  assert_int_equal(chmod(path, 0604), 0);
  assert_int_equal(output_commit(opened(path)), HC_OK);
  assert_int_equal(mode_of(path), 0604);
}

static void two_at_once_do_not_mix(CHECK_STATE)
{
  output *a = opened(path), *b = opened(other), *c = opened(path);
  fputs("a", output_stream(a));
  fputs("b", output_stream(b));
  fputs("c", output_stream(c));
  assert_int_equal(output_commit(a), HC_OK);
  assert_int_equal(output_commit(b), HC_OK);
  expect_content(path, "a");
  assert_int_equal(output_commit(c), HC_OK);
  expect_content(path, "c");
  expect_content(other, "b");
  assert_int_equal(files(false), 2);
}

static void a_link_keeps_pointing(CHECK_STATE)
{
  char second[128];
  struct stat st;
  snprintf(second, sizeof second, "%s/second", folder);
  put_content(other, "old\n");
  assert_int_equal(symlink("second", path), 0); /* relative to the link's folder */
  assert_int_equal(symlink(other, second), 0);
  for (int i = 0; i < 2; ++i) { /* the second time round the link dangles */
    output *o = opened(path);
    fputs("new\n", output_stream(o));
    assert_int_equal(output_commit(o), HC_OK);
    assert_int_equal(lstat(path, &st), 0);
    assert_true(S_ISLNK(st.st_mode));
    assert_int_equal(lstat(other, &st), 0);
    assert_true(S_ISREG(st.st_mode));
    expect_content(other, "new\n");
    assert_int_equal(remove(other), 0);
  }
  assert_int_equal(remove(path), 0);
  assert_int_equal(symlink("out.csv", path), 0); /* to itself */
  expect_no_open(path, ELOOP);
}

static void names_in_the_current_folder(CHECK_STATE)
{
  char before[1024];
  assert_non_null(getcwd(before, sizeof before));
  assert_int_equal(chdir(folder), 0);
  output *o = opened("out.csv");
  fputs("here", output_stream(o));
  hc_status st = output_commit(o);
  assert_int_equal(chdir(before), 0);
  assert_int_equal(st, HC_OK);
  expect_content(path, "here");
}

static void a_long_name_is_fine(CHECK_STATE)
{
  char longest[512];
  int n = snprintf(longest, sizeof longest, "%s/", folder);
  memset(longest + n, 'n', 255); /* NAME_MAX */
  longest[n + 255] = 0;
  assert_int_equal(output_commit(opened(longest)), HC_OK);
  assert_int_equal(access(longest, F_OK), 0);
  longest[n + 255] = 'n';
  longest[n + 256] = 0;
  output *o;
  hc_status st = output_open(longest, &o);
  if (st == HC_OK) st = output_commit(o); /* at the latest */
  assert_int_equal(st, HC_IO);
  assert_int_equal(files(false), 1);
}

static void what_cannot_be_opened_says_so(CHECK_STATE)
{
  char name[256];
  expect_no_open(folder, EISDIR);
  expect_no_open("", ENOENT);
  snprintf(name, sizeof name, "%s/nowhere/out.csv", folder);
  expect_no_open(name, ENOENT);
  snprintf(name, sizeof name, "%s/", path);
  expect_no_open(name, ENOENT);
  put_content(path, "old\n");
  expect_no_open(name, ENOTDIR);
  assert_int_equal(files(false), 1);
}

static void a_failed_rename_leaves_nothing_behind(CHECK_STATE)
{
  output *o = opened(path);
  assert_int_equal(mkdir(path, 0777), 0);
  assert_int_equal(output_commit(o), HC_IO);
  assert_int_equal(errno, EISDIR);
  assert_int_equal(files(false), 1);
}

enum { NOT_POSSIBLE = 77 };

/* Exit code of `work` in a child, as nobody if we are root: no bug renames over a device, and permissions count. */
static int as_nobody(int (*work)(void))
{
  fflush(NULL);
  pid_t child = fork();
  if (child == 0) _exit(geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0) ? NOT_POSSIBLE : work());
  int status = 0;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFEXITED(status));
  if (WEXITSTATUS(status) == NOT_POSSIBLE) skip(); /* a user namespace with root alone */
  return WEXITSTATUS(status);
}

/* Lost in the commit, lost before it with more still to come, and lost before it with nothing left to flush. */
static int write_to_devices(void)
{
  output *o;
  for (int how = 0; how < 3; ++how) {
    if (output_open("/dev/full", &o) != HC_OK) return 1;
    if (how == 2) setvbuf(output_stream(o), NULL, _IONBF, 0);
    if (how == 1) write_big(o);
    else fputs("x", output_stream(o));
    if (output_commit(o) != HC_IO) return 2;
    if (errno != (how == 2 ? EIO : ENOSPC)) return 3;
  }
  if (output_open("/dev/null", &o) != HC_OK) return 4;
  write_big(o);
  return output_commit(o) == HC_OK ? 0 : 5;
}

static void a_full_disk_is_noticed(CHECK_STATE) { assert_int_equal(as_nobody(write_to_devices), 0); }

static void a_fifo_is_written_straight_and_its_end_noticed(CHECK_STATE)
{
  char text[8] = "";
  assert_int_equal(mkfifo(path, 0600), 0);
  int reader = open(path, O_RDONLY | O_NONBLOCK);
  output *o = opened(path);
  fputs("hello", output_stream(o));
  assert_int_equal(output_commit(o), HC_OK);
  assert_int_equal(read(reader, text, sizeof text - 1), 5);
  assert_string_equal(text, "hello");
  o = opened(path);
  fputs("hello", output_stream(o));
  close(reader);
  void (*before)(int) = signal(SIGPIPE, SIG_IGN);
  assert_int_equal(output_commit(o), HC_IO);
  assert_int_equal(errno, EPIPE);
  signal(SIGPIPE, before);
  assert_int_equal(files(false), 1);
}

/* In a child whose standard output is `to`: "first", then "second" through an output of that name. */
static int commit_in_child(const char *to, const char *name)
{
  fflush(NULL);
  pid_t child = fork();
  if (child == 0) {
    output *o;
    int fd = open(to, O_WRONLY | O_CREAT, 0666);
    if (fd < 0 || dup2(fd, STDOUT_FILENO) < 0) _exit(100);
    if (fputs("first\n", stdout) < 0 || output_open(name, &o) != HC_OK) _exit(101);
    fputs("second\n", output_stream(o));
    _exit((int)output_commit(o));
  }
  int status = 0;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFEXITED(status));
  return WEXITSTATUS(status);
}

static void standard_output_is_checked_too(CHECK_STATE)
{
  assert_int_equal(commit_in_child("/dev/full", NULL), HC_IO);
  assert_int_equal(commit_in_child(path, NULL), HC_OK);
  expect_content(path, "first\nsecond\n");
  assert_int_equal(remove(path), 0);
  assert_int_equal(symlink("/dev/stdout", other), 0); /* a link of ours, should anything be renamed over it */
  assert_int_equal(commit_in_child(path, other), HC_OK);
  expect_content(path, "first\nsecond\n");
  output_abandon(opened(NULL));
  assert_int_equal(fflush(stdout), 0); /* still open */
}

static int open_read_only(void)
{
  output *o;
  return output_open(path, &o) == HC_IO && errno == EACCES ? 0 : 1;
}

/* A rename would replace a file its owner made read-only. */
static void a_read_only_file_is_respected(CHECK_STATE)
{
  put_content(path, "old\n");
  assert_int_equal(chmod(path, 0444), 0);
  assert_int_equal(chmod(folder, 0777), 0);
  assert_int_equal(as_nobody(open_read_only), 0);
  expect_content(path, "old\n");
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)
static const struct CMUnitTest tests[] = {
    IN_FOLDER(nothing_appears_until_commit),
    IN_FOLDER(abandon_leaves_nothing),
    IN_FOLDER(an_existing_file_stays_until_commit),
    IN_FOLDER(permissions_follow_the_umask_or_the_file),
    IN_FOLDER(two_at_once_do_not_mix),
    IN_FOLDER(a_link_keeps_pointing),
    IN_FOLDER(names_in_the_current_folder),
    IN_FOLDER(a_long_name_is_fine),
    IN_FOLDER(what_cannot_be_opened_says_so),
    IN_FOLDER(a_failed_rename_leaves_nothing_behind),
    IN_FOLDER(a_full_disk_is_noticed),
    IN_FOLDER(a_fifo_is_written_straight_and_its_end_noticed),
    IN_FOLDER(standard_output_is_checked_too),
    IN_FOLDER(a_read_only_file_is_respected),
};

CHECK_MAIN("compare.output", tests, 60)
