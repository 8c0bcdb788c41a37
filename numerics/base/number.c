/* number.c - see number.h. The grammar is checked here by hand, so strtod only ever sees plain decimal numbers. */
#include "numerics/base/number.h"

#include <errno.h>
#include <limits.h>
#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST = 256 }; /* characters; 17 digits and an exponent are enough for any double */

static size_t digits(const char *s)
{
  size_t n = 0;
  while (s[n] >= '0' && s[n] <= '9') ++n;
  return n;
}

static const char *skip_sign(const char *s) { return *s == '+' || *s == '-' ? s + 1 : s; }

static bool is_decimal(const char *s)
{
  s = skip_sign(s);
  size_t whole = digits(s), fraction = 0;
  s += whole;
  if (*s == '.') fraction = digits(++s), s += fraction;
  if (whole + fraction == 0) return false;
  if (*s == 'e' || *s == 'E') {
    s = skip_sign(s + 1);
    size_t exponent = digits(s);
    if (exponent == 0) return false;
    s += exponent;
  }
  return *s == '\0';
}

/* nan, inf and infinity as C and YAML spell them. They are refused, with a message of their own. */
static bool is_not_finite(const char *s)
{
  static const char *const words[] = {"nan", "inf", "infinity"};
  s = skip_sign(s);
  if (*s == '.') ++s;
  for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
    const char *a = s, *b = words[i];
    while (*a && (*a | 0x20) == *b) ++a, ++b;
    if (!*a && !*b) return true;
  }
  return false;
}

/* strtod with a decimal point whatever the locale. False if it stops before the end of the text. */
static bool convert(const char *text, double *value)
{
  locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0), before = uselocale(c);
  char *end;
  *value = strtod(text, &end);
  uselocale(before);
  if (c) freelocale(c);
  return *end == '\0';
}

number_fault number_read(const char *text, size_t length, double *value)
{
  char copy[LONGEST];
  double x;
  int before = errno;
  if (length >= LONGEST || memchr(text, '\0', length)) return NUMBER_NONE;
  memcpy(copy, text, length);
  copy[length] = '\0';
  if (is_not_finite(copy)) return NUMBER_NOT_FINITE;
  if (!is_decimal(copy) || !convert(copy, &x)) return NUMBER_NONE;
  errno = before; /* strtod sets ERANGE for subnormal numbers, which are accepted */
  if (!isfinite(x)) return NUMBER_TOO_LARGE;
  if (x == 0 && strcspn(copy, "123456789") < strcspn(copy, "eE")) return NUMBER_TOO_SMALL; /* a digit is not 0 */
  *value = x;
  return NUMBER_FINE;
}

/* Without printf's leading zero of the exponent: e-09 -> e-9, e+20 stays. */
static void shorten_exponent(char *text)
{
  char *e = strchr(text, 'e'), *zeros = e ? e + 2 : NULL;
  size_t n = 0;
  if (!e) return;
  while (zeros[n] == '0') ++n;
  memmove(zeros, zeros + n, strlen(zeros + n) + 1);
}

number_fault number_read_integer(const char *text, size_t length, int *value)
{
  double x;
  number_fault fault = number_read(text, length, &x);
  if (fault != NUMBER_FINE) return fault;
  /* An integer has only digits after its sign. */
  for (size_t i = text[0] == '+' || text[0] == '-'; i < length; ++i)
    if (text[i] < '0' || text[i] > '9') return NUMBER_NOT_INTEGER;
  if (!(x >= INT_MIN && x <= INT_MAX)) return NUMBER_TOO_LARGE;
  *value = (int)x;
  return NUMBER_FINE;
}

const char *number_write(double value, char text[NUMBER_TEXT])
{
  locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0), before = uselocale(c);
  for (int precision = 15; precision <= 17; ++precision) {
    double back;
    snprintf(text, NUMBER_TEXT, "%.*g", precision, value);
    if (number_read(text, strlen(text), &back) == NUMBER_FINE && memcmp(&back, &value, sizeof value) == 0) break;
  }
  uselocale(before);
  if (c) freelocale(c);
  shorten_exponent(text);
  return text;
}
