/* test_hostile.c - files that are no case at all: huge, deep, binary, unreadable. Each ends soon, in one clean line. */
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>

#include "model/casefile/case_reader.h"
#include "tests/cases/case_text.h"

enum { MEGABYTE = 1 << 20 };

static double processor_seconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* head, then a megabyte of `piece`; must be refused for a reason that holds `words`. */
static void refuse_repeated(const char *head, const char *piece, const char *words)
{
  char *text = malloc(MEGABYTE);
  size_t n = strlen(head), step = strlen(piece);
  scene sc;
  case_error err;
  assert_non_null(text);
  memcpy(text, head, n);
  for (; n + step <= MEGABYTE; n += step) memcpy(text + n, piece, step);
  double start = processor_seconds();
  assert_int_equal(case_parse("f", text, n, 0, NULL, &sc, &err), HC_BAD_INPUT);
  /* processor time. Linear: under 1 s with sanitizers on a slow machine; quadratic: 1e12 steps, minutes on any. */
  CHECK_LE(processor_seconds() - start, 20, "%s %s", head, piece);
  check_message(&err);
  if (!strstr(err.message, words)) fail_msg("%s: %s", piece, err.message);
  free(text);
}

static void megabytes_end_quickly(CHECK_STATE)
{
  refuse_repeated("", "[", "nested too deeply");
  refuse_repeated("", "{a: ", "nested too deeply");
  refuse_repeated("", "- ", "nested too deeply");
  refuse_repeated("", "? ", "nested too deeply");
  refuse_repeated(SMALLEST "contacts: ", "[", "nested too deeply");
  refuse_repeated("%TAG !a! x\n", "%TAG !b! y\n", "%TAG");
  refuse_repeated("a: [", "1,", "not YAML");
  refuse_repeated("", "- &a x\n", "anchor");
  refuse_repeated("", "a", "the case is a single value");
  refuse_repeated("", "a: 1\n", "unknown key `a`");
  refuse_repeated("", "#\n", "nothing here");
  refuse_repeated("title: ", "\xC3\xA9", "too long");
}

static void anything_larger_is_not_even_parsed(CHECK_STATE)
{
  char *text = calloc(1, CASE_LARGEST + 1); /* NULs: the size is judged first */
  scene sc;
  case_error err;
  assert_int_equal(case_parse("f", text, CASE_LARGEST + 1, 0, NULL, &sc, &err), HC_BAD_INPUT);
  assert_string_equal(err.message, "f: larger than 16 MB, expected a case file (a few kB; large matrices in files)");
  assert_int_equal(case_parse("f", text, CASE_LARGEST, 0, NULL, &sc, &err), HC_BAD_INPUT);
  assert_string_equal(err.message, "f:1:1: control character 0x00, expected text");
  free(text);
  assert_int_equal(case_read("/dev/zero", 0, NULL, &sc, &err), HC_BAD_INPUT);
  assert_string_equal(err.message,
                      "/dev/zero: larger than 16 MB, expected a case file (a few kB; large matrices in files)");
}

static void what_is_no_file_is_an_io_error(CHECK_STATE)
{
  scene sc, before;
  case_error err;
  memset(&sc, 0x5A, sizeof sc);
  before = sc;
  assert_int_equal(case_read(SOURCE_DIR "/no/such/file.yaml", 0, NULL, &sc, &err), HC_IO);
  assert_non_null(strstr(err.message, "/no/such/file.yaml: cannot be opened: "));
  assert_int_equal(case_read(SOURCE_DIR, 0, NULL, &sc, &err), HC_IO);
  assert_non_null(strstr(err.message, "a directory, expected a case file"));
  char name[] = "/tmp/hbmcheck_XXXXXX";
  int fd = mkstemp(name);
  assert_true(fd >= 0);
  close(fd);
  chmod(name, 0);
  hc_status st = case_read(name, 0, NULL, &sc, &err);
  if (geteuid() != 0) assert_int_equal(st, HC_IO); /* root reads it anyway, and finds it empty */
  else assert_int_equal(st, HC_BAD_INPUT);
  check_message(&err);
  unlink(name);
  assert_memory_equal(&sc, &before, sizeof sc);
}

static void files_are_closed_again(CHECK_STATE)
{
  struct rlimit before, few;
  scene sc;
  case_error err;
  getrlimit(RLIMIT_NOFILE, &before);
  few = before, few.rlim_cur = 32;
  setrlimit(RLIMIT_NOFILE, &few);
  for (int i = 0; i < 40; ++i) {
    assert_int_equal(case_read(SOURCE_DIR "/cases/paper/case2.yaml", 0, NULL, &sc, &err), HC_OK);
    case_clear(&sc);
    assert_int_equal(case_read(SOURCE_DIR, 0, NULL, &sc, &err), HC_IO);
    assert_int_equal(case_read(SOURCE_DIR "/cases/README.md", 0, NULL, &sc, &err), HC_BAD_INPUT);
  }
  setrlimit(RLIMIT_NOFILE, &before);
}

static void input_is_never_echoed_raw(CHECK_STATE)
{
  scene sc;
  case_error err;
  const char *set[] = {"hbm.samples=\033]0;x\007\n\x80\xC2\x85\xE2\x80\xAE"};
  assert_int_equal(case_parse("bad\033[31m\nname", "x", 1, 0, NULL, &sc, &err), HC_BAD_INPUT);
  check_message(&err);
  assert_non_null(strstr(err.message, "bad\\x1B[31m\\x0Aname:1:1: "));
  assert_int_equal(case_parse("f", SMALLEST, strlen(SMALLEST), 1, set, &sc, &err), HC_BAD_INPUT);
  check_message(&err);
  assert_non_null(strstr(err.message, "\\x1B]0;x\\x07\\x0A\\x80\\xC2\\x85\\xE2\\x80\\xAE"));
  assert_null(strstr(err.message, "\xC2\x85"));
  assert_int_equal(parse(SMALLEST "\"\\e[31m\\0\": 1\n", &sc, &err), HC_BAD_INPUT);
  check_message(&err);
}

static void long_messages_are_cut_between_characters(CHECK_STATE)
{
  static char name[4000], text[4000];
  scene sc;
  case_error err;
  for (size_t i = 0; i + 2 < sizeof name; i += 2) memcpy(name + i, "\xC3\xA9", 2);
  for (size_t shift = 0; shift < 4; ++shift) {
    snprintf(text, sizeof text, "%.*s: 1", (int)(2 * (1000 + shift)), name);
    assert_int_equal(case_parse(name + 2 * shift, text, strlen(text), 0, NULL, &sc, &err), HC_BAD_INPUT);
    check_message(&err);
    for (const char *p = err.message; *p; ++p)
      if (*p == '\xC3') assert_true(*++p == '\xA9');
      else assert_true((unsigned char)*p < 0x80);
    assert_non_null(strstr(err.message, "..."));
  }
}

/* Two-byte characters into every size of buffer: terminated, whole, and "..." where something is missing. */
static void small_buffers_are_never_overrun(CHECK_STATE)
{
  static const char input[] = "\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9";
  for (size_t size = 8; size < 20; ++size) {
    char *text = malloc(size); /* its end is the sanitizer's */
    message m;
    message_start(&m, text, size);
    message_add_input(&m, input, sizeof input - 1, 100);
    size_t n = strlen(text), whole = n / 2 * 2 == n ? n : n - 3;
    assert_true(n < size && n == m.used);
    if (size > sizeof input - 1) assert_string_equal(text, input);
    else assert_string_equal(text + whole, "...");
    assert_true(whole % 2 == 0 && !memcmp(text, input, whole));
    free(text);
  }
}

/* Bytes of a good case changed at random: it is read, or refused in one clean line (sanitizers watch). */
static void mutants_are_read_or_refused(CHECK_STATE)
{
  static const char good[] = "title: \"T\"\n" SMALLEST "contacts:\n  - " CONTACT_1
                             "\nhbm: {harmonics: 3, samples: 64}\ncompare: {omega: [5, 6]}\n";
  static const char spice[] = "[]{}:,-?*&!|>'\"%@`#\n\t \\0159e.x~";
  uint64_t s = 5;
  int fine = 0, bad = 0;
  for (int i = 0; i < 20000; ++i) {
    char text[sizeof good];
    scene sc;
    case_error err;
    memcpy(text, good, sizeof good);
    for (int k = random_int(&s, 1, 4); k > 0; --k) {
      char c = random_bits(&s) % 4 ? spice[random_int(&s, 0, sizeof spice - 2)] : (char)random_int(&s, 0, 255);
      text[random_int(&s, 0, sizeof good - 2)] = c;
    }
    hc_status st = case_parse(
        "f", text, (size_t)random_int(&s, 0, 9) ? sizeof good - 1 : (size_t)random_int(&s, 0, sizeof good - 1), 0, NULL,
        &sc, &err);
    if (st == HC_OK) ++fine, case_clear(&sc);
    else ++bad, assert_int_equal(st, HC_BAD_INPUT), check_message(&err);
  }
  assert_true(fine > 100 && bad > 1000); /* both happen */
}

CHECK_TESTS("cases.hostile", 240, megabytes_end_quickly, anything_larger_is_not_even_parsed,
            what_is_no_file_is_an_io_error, files_are_closed_again, small_buffers_are_never_overrun,
            input_is_never_echoed_raw, long_messages_are_cut_between_characters, mutants_are_read_or_refused)
