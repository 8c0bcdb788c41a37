/* bench.h - the benchmarks' clock, medians and case file, and their end, with words, where something fails. */
#pragma once

#include <string.h>
#include <time.h>

#include "casefile/case_file.h"

enum { BENCH_MOST_ROUNDS = 1001 };

static inline double cpu_ms(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static inline void must(hc_status st, const char *what)
{
  if (st == HC_OK) return;
  fprintf(stderr, "%s: %s\n", what, hc_status_text(st));
  exit(3);
}

/* v[round((n - 1) at)] of the sorted figures; v stays. */
static inline double quantile(int n, const double *v, double at)
{
  double sorted[BENCH_MOST_ROUNDS];
  memcpy(sorted, v, (size_t)n * sizeof *v);
  qsort(sorted, (size_t)n, sizeof *sorted, ascending);
  return sorted[(int)lround(at * (n - 1))];
}

/* Argument number i, or the fallback if there are fewer; 1..most, or the program ends with its usage. */
static inline int count_argument(int argc, char **argv, int i, int fallback, int most, const char *usage)
{
  const int n = argc > i ? atoi(argv[i]) : fallback;
  if (n >= 1 && n <= most) return n;
  fprintf(stderr, "usage: %s %s   (1..%d)\n", argv[0], usage, most);
  exit(64);
}

static inline scene read_case(const char *path, int n_set, const char *const *set)
{
  scene sc;
  case_error err;
  if (case_read(path, n_set, set, &sc, &err) == HC_OK) return sc;
  fprintf(stderr, "%s\n", err.message);
  exit(2);
}

static inline const char *file_name(const char *path)
{
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}
