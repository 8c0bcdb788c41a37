/* same.h - numbers that the C API hands out against those of the functions it calls: equal bit for bit, or both NaN. */
#pragma once

#include "tests/check.h"

typedef struct number_pair {
  const char *name;
  double found, expected;
} number_pair;

static inline void check_same(const number_pair *all, size_t n, int line)
{
  for (size_t i = 0; i < n; ++i) {
    const double a = all[i].found, b = all[i].expected;
    if (!(a == b || (isnan(a) && isnan(b)))) fail_msg("line %d: %s = %.17g, expected %.17g", line, all[i].name, a, b);
  }
}

/* SAME(PAIR(found, expected), ...): real numbers, whole ones (a double holds those exactly), values of enums. */
#define PAIR(a, b) ((number_pair){#a, (double)(a), (double)(b)})
#define PAIRS(...) ((const number_pair[]){__VA_ARGS__})
#define SAME(...)  check_same(PAIRS(__VA_ARGS__), sizeof PAIRS(__VA_ARGS__) / sizeof(number_pair), __LINE__)
