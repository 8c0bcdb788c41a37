/* curve_parts.c - a benchmark, not a test: what the parts of a small structure's curve cost beside following it.
 * usage: bench_curve_parts REPEATS CASE.yaml...
 * The parts take turns, REPEATS times, in one run: case file to scene, scene to solver, the curve, stability and
 * responses at its points, special points. Columns: degrees of freedom, contacts, points; milliseconds of the curve
 * (median), and the other parts in terms of it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/ascending.h"
#include "casefile/case_file.h"
#include "compare/response.h"
#include "hbm/hbm.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "study/scene_solvers.h"

enum { MAX_REPEATS = 1001, SPECIALS = 256 };
enum { READ, SET_UP, CURVE, STABILITY, SPECIAL, PARTS };

static double now_ms(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

/* Milliseconds since *last, which becomes now. */
static double lap(double *last)
{
  const double before = *last;
  *last = now_ms();
  return *last - before;
}

typedef struct sizes {
  int n, contacts, points;
} sizes;

static hc_status run_parts(const char *path, double *ms, sizes *z)
{
  scene sc = {.structure = NULL};
  case_error err;
  hbm_solver *s = NULL;
  hbm_curve c = {0};
  hbm_special found[SPECIALS];
  int n;
  double t = now_ms();
  if (case_read(path, 0, NULL, &sc, &err) != HC_OK) {
    fprintf(stderr, "%s\n", err.message);
    return HC_BAD_INPUT;
  }
  ms[READ] = lap(&t);
  hc_status st = scene_hbm_solver(&sc, &s);
  ms[SET_UP] = lap(&t);
  if (st == HC_OK) st = hbm_trace(s, sc.omega_from, sc.omega_to, NULL, &c);
  ms[CURVE] = lap(&t);
  for (int k = 0; k < c.n && st == HC_OK; ++k) {
    response_row row;
    st = response_row_of(s, &c, k, &row);
    for (int r = 1; st == HC_OK && r < s->model->n_responses; ++r) st = response_row_turn(s, &c, k, r, &row);
  }
  ms[STABILITY] = lap(&t);
  if (st == HC_OK) st = hbm_specials(s, &c, SPECIALS, found, &n);
  ms[SPECIAL] = lap(&t);
  if (s) *z = (sizes){s->model->n, s->model->n_contacts, c.n};
  hbm_curve_free(&c);
  hbm_solver_free(s);
  case_clear(&sc);
  return st;
}

static int run_case(const char *path, int repeats)
{
  static double ms[PARTS][MAX_REPEATS];
  double median[PARTS];
  const char *slash = strrchr(path, '/');
  sizes z = {0};
  for (int i = 0; i < repeats; ++i) {
    double once[PARTS];
    const hc_status st = run_parts(path, once, &z);
    if (st != HC_OK) return fprintf(stderr, "%s: %s\n", path, hc_status_text(st)), 1;
    for (int p = 0; p < PARTS; ++p) ms[p][i] = once[p];
  }
  for (int p = 0; p < PARTS; ++p) {
    qsort(ms[p], (size_t)repeats, sizeof(double), ascending);
    median[p] = ms[p][repeats / 2];
  }
  printf("%-26s %4d %4d %5d %8.3f %8.2f %8.2f %9.2f %8.2f\n", slash ? slash + 1 : path, z.n, z.contacts, z.points,
         median[CURVE], median[READ] / median[CURVE], median[SET_UP] / median[CURVE], median[STABILITY] / median[CURVE],
         median[SPECIAL] / median[CURVE]);
  return 0;
}

int main(int argc, char **argv)
{
  const int repeats = argc > 2 ? atoi(argv[1]) : 0;
  int wrong = 0;
  if (repeats < 1 || repeats > MAX_REPEATS) {
    fprintf(stderr, "usage: %s REPEATS CASE.yaml...   (REPEATS 1..%d)\n", argv[0], MAX_REPEATS);
    return 64;
  }
  printf("%-26s %4s %4s %5s %8s %8s %8s %9s %8s\n", "case", "n", "con.", "pts", "curve ms", "read", "set up",
         "stability", "special");
  for (int i = 2; i < argc; ++i) wrong |= run_case(argv[i], repeats);
  return wrong;
}
