/* curves.c - a benchmark, not a test: every curve of the paper's figures with exact forces, traced from both ends
 * and with half the step.
 * usage: bench_curves [CASE.yaml...]   (default: the scenes of figures 7, 8, 9, 17, 18, 20, and figure 17 up to kn =
 * 1e7) One line a curve: how it ended, points, iterations, rejected steps, turning points, contact evaluations,
 * milliseconds, and the largest distance, relative to the amplitude, between its solutions at 16 frequencies and
 * those of the curve from the other end and with half the step. */
#include "study/scene_solvers.h"
#include "tests/bench/bench.h"

/* Largest relative distance of the solutions of `a` at omega from the nearest ones of `b`; NaN when `b` has none. */
static double mismatch(hbm_solver *s, const hbm_curve *a, const hbm_curve *b, double omega)
{
  hbm_curve at = {0}, bt = {0};
  double worst = 0;
  if (hbm_curve_at(s, a, omega, &at) != HC_OK || hbm_curve_at(s, b, omega, &bt) != HC_OK) worst = INFINITY;
  if (at.n != bt.n) worst = NAN;
  for (int i = 0; i < at.n && at.n == bt.n; ++i) {
    double best = INFINITY, size = 0;
    for (int j = 0; j < bt.n; ++j) {
      double sum = 0;
      size = 0;
      for (int k = 0; k < at.n_coef; ++k) {
        double d = at.X[i * at.n_coef + k] - bt.X[j * bt.n_coef + k];
        sum += d * d;
        size += at.X[i * at.n_coef + k] * at.X[i * at.n_coef + k];
      }
      best = fmin(best, sqrt(sum / size));
    }
    worst = fmax(worst, best);
  }
  hbm_curve_free(&at);
  hbm_curve_free(&bt);
  return worst;
}

/* Largest mismatch at 16 frequencies; *differ counts those where the two curves have different numbers of solutions. */
static double compare_curves(hbm_solver *s, const hbm_curve *a, const hbm_curve *b, double low, double high,
                             int *differ)
{
  double worst = 0;
  for (int i = 0; i < 16; ++i) {
    double d = mismatch(s, a, b, low + (high - low) * (i + 0.37) / 16);
    if (isnan(d)) ++*differ;
    else worst = fmax(worst, d);
  }
  return worst;
}

static int run_case(const char *path)
{
  scene sc = read_case(path, 0, NULL);
  int bad = 0;
  static const int harmonics[] = {1, 5, 10, 25};
  for (int h = 0; h < 4; ++h)
    for (int keep = 0; keep < 2; ++keep) {
      sc.hbm.harmonics = harmonics[h];
      sc.hbm.keep_mean = keep;
      sc.hbm.force = HBM_FORCE_EXACT;
      const char *name = file_name(path);
      hbm_solver *s = NULL;
      hbm_curve up = {0}, down = {0}, half = {0};
      double retrace = 0, halved = 0, t = cpu_ms(), low = fmin(sc.omega_from, sc.omega_to),
             high = fmax(sc.omega_from, sc.omega_to);
      hc_status st = scene_hbm_solver(&sc, &s), back = HC_OK;
      if (st == HC_OK) st = hbm_trace(s, low, high, NULL, &up);
      t = cpu_ms() - t;
      if (st == HC_OK) back = hbm_trace(s, high, low, NULL, &down);
      hc_status fine = HC_OK;
      int differ = 0, differ_half = 0;
      if (st == HC_OK) {
        hbm_scale_steps(s, 0.5);
        fine = hbm_trace(s, low, high, NULL, &half);
        hbm_scale_steps(s, 1);
      }
      if (st == HC_OK && back == HC_OK) retrace = compare_curves(s, &up, &down, low, high, &differ);
      if (st == HC_OK && fine == HC_OK) halved = compare_curves(s, &up, &half, low, high, &differ_half);
      double worst = 0;
      for (int k = 0; k < up.n; ++k) worst = fmax(worst, up.points[k].residual);
      printf("%-22s %3d %d %10g %5d %6ld %5d %3d %6ld %8.2f %8.1e  %8.1e  %8.1e", name, sc.hbm.harmonics,
             sc.hbm.keep_mean, up.n ? up.points[up.n - 1].omega : 0, up.n, up.iterations, up.rejected,
             up.turning_points, up.evaluations, t, worst, retrace, halved);
      if (differ) printf("  %d of 16 frequencies with other solutions from the other end", differ);
      if (differ_half) printf("  %d with half the step", differ_half);
      if (fine != HC_OK)
        printf("  HALF STEP at %g: %s", half.n ? half.points[half.n - 1].omega : 0, hc_status_text(fine));
      if (st != HC_OK) printf("  UP: %s", hc_status_text(st));
      if (back != HC_OK) printf("  DOWN at %g: %s", down.n ? down.points[down.n - 1].omega : 0, hc_status_text(back));
      printf("\n");
      hbm_curve_free(&up);
      hbm_curve_free(&down);
      hbm_curve_free(&half);
      hbm_solver_free(s);
      bad += st != HC_OK || back != HC_OK || fine != HC_OK || differ_half;
    }
  return bad;
}

int main(int argc, char **argv)
{
  int bad = 0;
  printf("%-22s %3s %s %10s %5s %6s %5s %3s %6s %8s %8s  %8s  %8s\n", "case", "H", "0", "end", "pts", "iter", "rej",
         "trn", "evals", "ms", "residual", "other end", "half step");
  for (int i = 1; i < argc; ++i) bad += run_case(argv[i]);
  printf("%d curves did not reach their end\n", bad);
  return 0;
}
