/* frf.c - a benchmark, not a test: processor time of one response curve inside the process, for versus_peer.py.
 * usage: bench_frf CASE REPEATS [PATH=VALUE]...
 * A curve is what `hbmcheck frf` computes: the model and its solver, the trace, and of every point each response's
 * measures and the stability, then the special points. Reading the case file and printing are left out. Printed: the
 * median of REPEATS in seconds, and the points. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "casefile/case_file.h"
#include "casefile/structure.h"
#include "compare/response.h"
#include "study/scene_solvers.h"

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int by_size(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static hc_status measure(const scene *sc, hbm_solver *s, const hbm_curve *c)
{
  enum { SHOWN = 24 };
  hbm_special special[SHOWN];
  response_row row;
  const int responses = sc->structure ? structure_response_count(sc->structure) : 1;
  int n;
  hc_status st = HC_OK;
  for (int k = 0; k < c->n && st == HC_OK; ++k) {
    st = response_row_of(s, c, k, &row);
    for (int r = 1; r < responses && st == HC_OK; ++r) st = response_row_turn(s, c, k, r, &row);
  }
  return st == HC_OK ? hbm_specials(s, c, SHOWN, special, &n) : st;
}

static hc_status curve_once(const scene *sc, int *points)
{
  hbm_solver *s = NULL;
  hbm_curve c = {0};
  hc_status st = scene_hbm_solver(sc, &s);
  if (st == HC_OK) st = hbm_trace(s, sc->omega_from, sc->omega_to, NULL, &c);
  if (st == HC_OK) st = measure(sc, s, &c);
  *points = c.n;
  hbm_curve_free(&c);
  hbm_solver_free(s);
  return st;
}

int main(int argc, char **argv)
{
  enum { MOST = 1000 };
  static double seconds[MOST];
  scene sc;
  case_error err;
  int points = 0;
  const int repeats = argc > 2 ? atoi(argv[2]) : 0;
  if (repeats < 1 || repeats > MOST) {
    fprintf(stderr, "usage: %s CASE REPEATS [PATH=VALUE]...   (1 <= REPEATS <= %d)\n", argv[0], MOST);
    return 64;
  }
  if (case_read(argv[1], argc - 3, (const char *const *)argv + 3, &sc, &err) != HC_OK) {
    fprintf(stderr, "%s\n", err.message);
    return 2;
  }
  hc_status st = HC_OK;
  for (int i = 0; i < repeats && st == HC_OK; ++i) {
    const double began = now();
    st = curve_once(&sc, &points);
    seconds[i] = now() - began;
  }
  case_clear(&sc);
  if (st != HC_OK) {
    fprintf(stderr, "%s: %s\n", argv[1], hc_status_text(st));
    return 3;
  }
  qsort(seconds, (size_t)repeats, sizeof *seconds, by_size);
  printf("%.9g %d\n", seconds[repeats / 2], points);
  return 0;
}
