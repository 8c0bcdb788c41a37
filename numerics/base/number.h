/* number.h - numbers as text, strictly and the same in every locale: reading a whole text as one finite number, and the
 * shortest text that reads back to the same bits. Safe from several threads; the host program's locale is neither used
 * nor changed. A text need not be terminated: text[length] and beyond is not read. */
#pragma once

#include <stddef.h>

typedef enum number_fault {
  NUMBER_FINE,
  NUMBER_NONE,       /* not a number as a whole: empty, `12,5`, `0x10`, `1_000`, `5 m` */
  NUMBER_NOT_FINITE, /* nan or inf */
  NUMBER_TOO_LARGE,  /* larger than any double (or int) */
  NUMBER_TOO_SMALL,  /* not zero, but zero as a double */
  NUMBER_NOT_INTEGER /* not an integer where one is required: `1.0`, `1e3` */
} number_fault;

/* The whole of text[length] as [+-]digits[.digits][e[+-]digits] in decimal, or a fault with *value untouched. */
number_fault number_read(const char *text, size_t length, double *value);

/* The whole of text[length] as [+-]digits, or a fault with *value untouched. */
number_fault number_read_integer(const char *text, size_t length, int *value);

/* The shortest of %.15g, %.16g and %.17g that reads back to the same bits (1e-9, not 1e-09). value must be finite.
 * Returns text. */
enum { NUMBER_TEXT = 32 };
const char *number_write(double value, char text[NUMBER_TEXT]);

/* A list of numbers, copied by value, from options and case files. */
enum { NUMBER_LIST_MAX = 1024 };

typedef struct number_list {
  int n;
  double v[NUMBER_LIST_MAX];
} number_list;

/* Comparison for qsort of doubles, ascending; a, b: const double *. Not for NaN. */
static inline int ascending(const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}
