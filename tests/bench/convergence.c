/* convergence.c - a benchmark, not a test: how fast the two sides come together, and with which order. usage:
 * bench_convergence 1. Harmonic balance with exact forces, H = 10, 20, 40, 80, against the exact law's orbit by
 * shooting at tolerance 1e-13. 2. The regularised law, 1e-1 .. 1e-5, against the same orbit. Errors are relative: of
 * |a1 + i b1|, of a1 + i b1 in the plane, of the amplitude (max - min)/2, and the largest of x over the period. An
 * order is log(error before/error)/log(ratio of H, or of the regularisation). */
#include "base/constants.h"
#include "tests/bench/orbits.h"

enum { MEASURES = 4, LEVELS = 4, DECADES = 5 };
static const int levels[LEVELS] = {10, 20, 40, 80};
typedef struct bench_case {
  const char *name;
  scene sc;
  double omega;
} bench_case;

static void errors_of_series(int H, const double *X, const hbm_measures *m, const timeint_result *ref, double *e)
{
  double worst = 0;
  for (int i = 0; i < TIMEINT_WAVE; ++i) {
    double th = TWO_PI * i / TIMEINT_WAVE;
    worst = fmax(worst, fabs(series_at(H, X, cos(th), sin(th)).x - ref->wave[i]));
  }
  e[0] = fabs(m->harmonic_1 / ref->harmonic_1 - 1);
  e[1] = hypot(X[1] - ref->a1, X[2] - ref->b1) / ref->harmonic_1;
  e[2] = fabs(m->amplitude / ref->amplitude - 1);
  e[3] = worst / ref->amplitude;
}

static void print_errors(const double *e, const double *before, double ratio)
{
  for (int k = 0; k < MEASURES; ++k) {
    printf(" %8.1e |", e[k]);
    if (before && e[k] > 0) printf(" %5.2f |", log(before[k] / e[k]) / log(ratio));
    else printf("       |");
  }
  printf("\n");
}

/* From the solution with fewer harmonics, the others 0. */
static void solve_with(scene sc, int H, double omega, double *X, hbm_measures *m)
{
  hbm_solver *s = NULL;
  hbm_point point;
  sc.hbm.harmonics = H;
  must(scene_hbm_solver(&sc, &s), "harmonic balance");
  must(hbm_solve(s, omega, X, &point), "harmonic balance");
  must(hbm_measure(s, X, m), "harmonic balance");
  hbm_solver_free(s);
}

static void harmonics_of(const bench_case *c)
{
  double X[2 * HBM_MAX_HARMONICS + 1] = {0}, e[LEVELS][MEASURES];
  hbm_measures m;
  scene_state start;
  largest_solution(&c->sc, c->omega, X, &m, &start);
  timeint_result ref = reference_orbit(c->sc, c->omega, start);
  for (int i = 0; i < LEVELS; ++i) {
    solve_with(c->sc, levels[i], c->omega, X, &m);
    errors_of_series(levels[i], X, &m, &ref, e[i]);
    printf("| %-3s at %-2g | %2d |", c->name, c->omega, levels[i]);
    print_errors(e[i], i ? e[i - 1] : NULL, 2);
  }
}

static void errors_of_transient(const timeint_result *r, const timeint_result *ref, double *e)
{
  double worst = 0;
  for (int i = 0; i < TIMEINT_WAVE; ++i) worst = fmax(worst, fabs(r->wave[i] - ref->wave[i]));
  e[0] = fabs(r->harmonic_1 / ref->harmonic_1 - 1);
  e[1] = hypot(r->a1 - ref->a1, r->b1 - ref->b1) / ref->harmonic_1;
  e[2] = fabs(r->amplitude / ref->amplitude - 1);
  e[3] = worst / ref->amplitude;
}

/* At tolerance 1e-11, or where rounding does not allow that, 1e-10. */
static timeint_result regularised_orbit(scene sc, double omega, scene_state start, double regularisation)
{
  hc_status st = HC_NOT_CONVERGED;
  timeint_result r;
  sc.transient = (transient_settings){.law = TRANSIENT_LAW_REGULARISED,
                                      .regularisation = regularisation,
                                      .steady = TRANSIENT_STEADY_SHOOTING,
                                      .tolerance = 1e-11,
                                      .start = TRANSIENT_START_HBM,
                                      .max_periods = 20000};
  for (; st == HC_NOT_CONVERGED && sc.transient.tolerance < 2e-10; sc.transient.tolerance *= 10) {
    timeint *ti = NULL;
    scene_state y = start;
    must(scene_timeint(&sc, &ti), "transient");
    st = timeint_steady(ti, omega, y.all, NULL, &r);
    timeint_free(ti);
    if (st == HC_OK && sc.transient.tolerance > 1.5e-11)
      fprintf(stderr, "regularisation %.0e: at tolerance %.0e\n", regularisation, sc.transient.tolerance);
  }
  must(st, "transient");
  return r;
}

static void regularisation_of(const bench_case *c)
{
  scene_state start = hbm_start(&c->sc, c->omega);
  timeint_result ref = reference_orbit(c->sc, c->omega, start);
  double e[DECADES][MEASURES];
  for (int i = 0; i < DECADES; ++i) {
    timeint_result r = regularised_orbit(c->sc, c->omega, start, pow(10, -1 - i));
    errors_of_transient(&r, &ref, e[i]);
    printf("| %-3s at %-2g | 1e-%d |", c->name, c->omega, i + 1);
    print_errors(e[i], i ? e[i - 1] : NULL, 10);
  }
}

int main(void)
{
  const char *columns = " \\|X1\\| | order | X1 | order | amplitude | order | waveform | order |\n";
  const bench_case first[] = {{"c2", with_hbm(scene_c2(), 5, 3, 20), 6},
                              {"a10", with_hbm(scene_a10(), 5, 3, 20), 13},
                              {"b10", with_hbm(scene_b10(), 5, 3, 20), 7}};
  const bench_case second[] = {{"c2", with_hbm(scene_c2(), 5, 3, 20), 7}, {"b10", with_hbm(scene_b10(), 5, 3, 20), 7}};
  printf("Harmonic balance, exact forces, against the exact law's orbit\n\n| case | H "
         "|%s|---|---|---|---|---|---|---|---|---|---|\n",
         columns);
  for (size_t i = 0; i < sizeof first / sizeof *first; ++i) harmonics_of(&first[i]);
  printf("\nThe regularised law against the exact law\n\n| case | regularisation "
         "|%s|---|---|---|---|---|---|---|---|---|---|\n",
         columns);
  for (size_t i = 0; i < sizeof second / sizeof *second; ++i) regularisation_of(&second[i]);
  return 0;
}
