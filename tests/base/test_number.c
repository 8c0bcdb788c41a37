/* test_number.c - strict numbers: what is one, what is not, the same in a locale with a decimal comma, and back to
 * the same bits. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include <errno.h>
#include <float.h>
#include <limits.h>
#include <locale.h>
#include <sys/mman.h>

#include "tests/cases/case_text.h"

static void numbers_are_read_whole(CHECK_STATE)
{
  static const struct {
    const char *text;
    double value;
  } good[] = {
      {"0", 0},
      {"5", 5},
      {"+5", 5},
      {"-5", -5},
      {"5.", 5},
      {".5", 0.5},
      {"1.25e2", 125},
      {"1E+2", 100},
      {"1e-2", 0.01},
      {"007", 7},
      {"1.7976931348623157e308", DBL_MAX},
      {"4.9406564584124654e-324", 4.9406564584124654e-324},
      {"0e999", 0},
  };
  for (size_t i = 0; i < sizeof good / sizeof *good; ++i) {
    double x = -99;
    assert_int_equal(number_read(good[i].text, strlen(good[i].text), &x), NUMBER_FINE);
    if (x != good[i].value) print_error("%s: %.17g\n", good[i].text, x);
    assert_true(x == good[i].value);
  }
}

static void what_is_no_number_says_why(CHECK_STATE)
{
  static const struct {
    number_fault fault;
    const char *texts[23];
  } bad[] = {
      {NUMBER_NONE, {"",  "12,5", "1e5, 3", "0x10",  "1_000", "5 m", " 5",   "5 ", "1e",   "e5",     ".",
                     "+", "--5",  "1.2.3",  "1e5.0", "0b1",   "1f",  "five", "na", "nans", "nan(1)", "\u00A05"}},
      {NUMBER_NOT_FINITE, {"nan", "NaN", ".nan", "inf", "-.Inf", "+infinity"}},
      {NUMBER_TOO_LARGE, {"1e309", "-1e999"}},
      {NUMBER_TOO_SMALL, {"1e-999"}},
  };
  for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i)
    for (const char *const *text = bad[i].texts; *text; ++text) {
      double x = -99;
      number_fault fault = number_read(*text, strlen(*text), &x);
      if (fault != bad[i].fault) print_error("`%s`: %d\n", *text, (int)fault);
      assert_int_equal(fault, bad[i].fault);
      assert_true(x == -99);
    }
  double x = -99;
  assert_int_equal(number_read("5\0006", 3, &x), NUMBER_NONE);
  char long_text[1000];
  memset(long_text, '1', sizeof long_text);
  assert_int_equal(number_read(long_text, sizeof long_text, &x), NUMBER_NONE);
}

static void integers_are_digits(CHECK_STATE)
{
  static const struct {
    const char *text;
    number_fault fault;
    int value;
  } all[] = {
      {"1024", NUMBER_FINE, 1024},
      {"+7", NUMBER_FINE, 7},
      {"-7", NUMBER_FINE, -7},
      {"2147483647", NUMBER_FINE, INT_MAX},
      {"-2147483648", NUMBER_FINE, INT_MIN},
      {"2147483648", NUMBER_TOO_LARGE, 0},
      {"1e3", NUMBER_NOT_INTEGER, 0},
      {"1.0", NUMBER_NOT_INTEGER, 0},
      {"1.5", NUMBER_NOT_INTEGER, 0},
      {"", NUMBER_NONE, 0},
      {"x", NUMBER_NONE, 0},
      {"99999999999999999999", NUMBER_TOO_LARGE, 0},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
    int x = 0;
    assert_int_equal(number_read_integer(all[i].text, strlen(all[i].text), &x), all[i].fault);
    assert_int_equal(x, all[i].value);
  }
}

static void written_numbers_come_back(CHECK_STATE)
{
  char text[NUMBER_TEXT];
  assert_string_equal(number_write(0.1, text), "0.1");
  assert_string_equal(number_write(1e-9, text), "1e-9");
  assert_string_equal(number_write(1e20, text), "1e+20");
  assert_string_equal(number_write(1e100, text), "1e+100");
  assert_string_equal(number_write(-0.0, text), "-0");
  uint64_t s = 4;
  for (int i = 0; i < 20000; ++i) {
    uint64_t bits = random_bits(&s);
    double x, back = 0;
    memcpy(&x, &bits, sizeof x);
    if (!isfinite(x)) continue;
    number_write(x, text);
    assert_int_equal(number_read(text, strlen(text), &back), NUMBER_FINE);
    assert_memory_equal(&x, &back, sizeof x);
  }
}

/* Texts that end where a page ends, the next of which must not be read: a look at text[length] is a SIGSEGV. */
static void nothing_is_read_beyond_the_end(CHECK_STATE)
{
  static const char *const texts[] = {"5", "-", "+12", "1e5", "1.5", "1e", ".", "2147483648", "nan", "-inf", "x"};
  const size_t page = (size_t)sysconf(_SC_PAGESIZE);
  char *two = mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  assert_true(two != MAP_FAILED && mprotect(two + page, page, PROT_NONE) == 0);
  for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
    const size_t n = strlen(texts[i]);
    char *at = memcpy(two + page - n, texts[i], n);
    double x = 0, y = 0;
    int k = 0, m = 0;
    assert_int_equal(number_read(at, n, &x), number_read(texts[i], n, &y));
    assert_int_equal(number_read_integer(at, n, &k), number_read_integer(texts[i], n, &m));
    assert_true(x == y && k == m);
  }
  double x;
  assert_int_equal(number_read(two + page, 0, &x), NUMBER_NONE);
  munmap(two, 2 * page);
}

static void errno_is_left_alone(CHECK_STATE)
{
  double x;
  errno = 42;
  number_read("1e-310", 6, &x);
  number_read("1e999", 5, &x);
  assert_int_equal(errno, 42);
}

/* With a decimal comma for the host program, nothing changes; skipped where no such locale is installed. */
static void locale_does_not_matter(void **state)
{
  static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8", "fr_FR.utf8"};
  const char *set = NULL;
  for (size_t i = 0; i < sizeof names / sizeof *names && !set; ++i) set = setlocale(LC_ALL, names[i]);
  if (!set) skip();
  assert_string_equal(localeconv()->decimal_point, ","); /* or the test would prove nothing */
  numbers_are_read_whole(state);
  what_is_no_number_says_why(state);
  written_numbers_come_back(state);
  scene sc;
  accepted(SMALLEST "gate: {mean: 2.5e-3}\n", "hbm.tolerance=1.5e-9", &sc);
  assert_true(*sc.structure->damping.v == 0.4 && sc.gate.most.mean == 2.5e-3 && sc.hbm.tolerance == 1.5e-9);
  assert_string_equal(localeconv()->decimal_point, ","); /* and the host's locale is still its own */
  setlocale(LC_ALL, "C");
}

CHECK_TESTS("cases.number", 60, numbers_are_read_whole, what_is_no_number_says_why, integers_are_digits,
            written_numbers_come_back, errno_is_left_alone, locale_does_not_matter, nothing_is_read_beyond_the_end)
