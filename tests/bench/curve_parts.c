/* curve_parts.c - a benchmark, not a test: what a curve costs inside the process, and its parts.
 * usage: bench_curve_parts ROUNDS CASE.yaml...
 *        bench_curve_parts ROUNDS CASE.yaml --set PATH=VALUE...
 * The parts take turns, ROUNDS times, in one run: case file to scene, scene to solver, the curve, stability and
 * responses at its points, special points. Columns: degrees of freedom, contacts, points; processor milliseconds of
 * all but the case file (median), for versus_peer.py, and of the curve; the other parts in terms of the curve. */
#include <time.h>

#include "compare/response.h"
#include "compare/study/scene_solvers.h"
#include "hbm/solver/hbm_solver_impl.h"
#include "model/casefile/case_file.h"
#include "numerics/base/path.h"

enum { MOST_ROUNDS = 1001 };
enum { READ, SET_UP, CURVE, STABILITY, SPECIAL, WHOLE, PARTS };

/* Milliseconds since *last, which becomes now. */
static double lap(double *last)
{
  const double before = *last;
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  *last = 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
  return *last - before;
}

static void must(hc_status st, const char *what)
{
  if (st == HC_OK) return;
  fprintf(stderr, "%s: %s\n", what, hc_status_text(st));
  exit(3);
}

typedef struct sizes {
  int n, contacts, points;
} sizes;

static void run_case(const char *path, int n_set, char **set, int rounds)
{
  static double ms[PARTS][MOST_ROUNDS];
  double once[PARTS], median[PARTS];
  sizes z = {0};
  for (int i = 0; i < rounds; ++i) {
    hbm_solver *s = NULL;
    hbm_curve c = {0};
    hbm_special *found;
    int n;
    double t = 0;
    scene sc;
    case_error err;
    lap(&t);
    must(case_read(path, n_set, (const char *const *)set, &sc, &err), path);
    once[READ] = lap(&t);
    must(scene_hbm_solver(&sc, &s), path);
    once[SET_UP] = lap(&t);
    must(hbm_trace(s, sc.omega_from, sc.omega_to, NULL, &c), path);
    once[CURVE] = lap(&t);
    for (int k = 0; k < c.n; ++k) {
      response_row row;
      must(response_row_of(s, &c, k, &row), path);
      for (int r = 1; r < s->model->n_responses; ++r) must(response_row_turn(s, &c, k, r, &row), path);
    }
    once[STABILITY] = lap(&t);
    must(hbm_specials(s, &c, &found, &n), path);
    once[SPECIAL] = lap(&t);
    once[WHOLE] = once[SET_UP] + once[CURVE] + once[STABILITY] + once[SPECIAL];
    z = (sizes){s->model->n, s->model->n_contacts, c.n};
    free(found);
    hbm_curve_free(&c);
    hbm_solver_free(s);
    case_clear(&sc);
    for (int p = 0; p < PARTS; ++p) ms[p][i] = once[p];
  }
  for (int p = 0; p < PARTS; ++p) {
    qsort(ms[p], (size_t)rounds, sizeof *ms[p], ascending);
    median[p] = ms[p][rounds / 2];
  }
  printf("%-26s %4d %4d %5d %12.6f %8.3f %8.2f %8.2f %9.2f %8.2f\n", path_name(path, NULL), z.n, z.contacts, z.points,
         median[WHOLE], median[CURVE], median[READ] / median[CURVE], median[SET_UP] / median[CURVE],
         median[STABILITY] / median[CURVE], median[SPECIAL] / median[CURVE]);
}

int main(int argc, char **argv)
{
  const int rounds = argc > 1 ? atoi(argv[1]) : 0;
  if (rounds < 1 || rounds > MOST_ROUNDS) return 64;
  printf("%-26s %4s %4s %5s %12s %8s %8s %8s %9s %8s\n", "case", "n", "con.", "pts", "ms", "curve ms", "read", "set up",
         "stability", "special");
  if (argc > 4 && !strcmp(argv[3], "--set")) run_case(argv[2], argc - 4, argv + 4, rounds);
  else
    for (int i = 2; i < argc; ++i) run_case(argv[i], 0, NULL, rounds);
  return 0;
}
