/* bench.h - work-precision comparison: time and error of every method at one frequency.
 *
 *     reference    the exact law's periodic orbit at omega, by shooting as tight as rounding allows
 *     error        |amplitude - reference's| / reference's amplitude; error_harmonic_1 likewise of |a1 + i b1|; of
 *                  several responses the largest of these differences, relative to the largest amplitude
 *     cost         processor time of ONE solution at omega from the solution at a neighbouring frequency, as in a
 *                  sweep: an HBM method from its own solution there, time integration from the exact orbit's state
 *                  there. With its measures, without making the workspace.
 *
 * The branch is that of the largest stable response at omega. Methods take turns; nothing is printed. Not here: whole
 * curves over H and N (accuracy.h; tests/bench). */
#pragma once

#include "compare/compare_settings.h"
#include "numerics/base/status.h"

#define BENCH_METHOD_LIST(X)                                                                                           \
  X(BENCH_HBM_EXACT, "hbm_exact", "harmonic balance, exact forces")                                                    \
  X(BENCH_HBM_SAMPLED, "hbm_sampled", "harmonic balance, sampled forces")                                              \
  X(BENCH_CLOSED_SHOOTING, "closed_shooting", "the exact law in closed form, shooting")                                \
  X(BENCH_EXACT_SCOUTED, "exact_scouted", "time integration, exact law, the closed form's orbit confirmed")            \
  X(BENCH_EXACT_SHOOTING, "exact_shooting", "time integration, exact law, shooting")                                   \
  X(BENCH_EXACT_MARCHING, "exact_marching", "time integration, exact law, marching")                                   \
  X(BENCH_REGULARISED_SCOUTED, "regularised_scouted",                                                                  \
    "time integration, regularised law, from the closed form's orbit and with its matrix")                             \
  X(BENCH_REGULARISED_SHOOTING, "regularised_shooting", "time integration, regularised law, shooting")                 \
  X(BENCH_REGULARISED_MARCHING, "regularised_marching", "time integration, regularised law, marching")                 \
  X(BENCH_SCIPY_LSODA, "scipy_lsoda", "scipy's solve_ivp, LSODA, the exact law without events, marched")
#define BENCH_ENUM(code, name, meaning) code,
typedef enum bench_method { BENCH_METHOD_LIST(BENCH_ENUM) BENCH_METHODS } bench_method;
#undef BENCH_ENUM
const char *bench_method_name(bench_method m);

typedef enum bench_outcome {
  BENCH_WAITING, /* not run, since the bench was stopped */
  BENCH_SOLVED,
  BENCH_FAILED,      /* reason: status */
  BENCH_OTHER_ORBIT, /* a solution, but not the one next to the reference */
  BENCH_TOO_LONG     /* longer than bench_longest, or a coarser setting was*/
} bench_outcome;
const char *bench_outcome_name(bench_outcome o); /* "solved", ... */

extern const double bench_longest, bench_longest_shot; /* [s] most processor time of one solution; the same by
                                                          shooting */

/* One method with one choice of settings. */
typedef struct bench_row {
  bench_method method;
  double omega;
  int harmonics, samples;           /* 0: not a setting of this method */
  double regularisation, tolerance; /* NaN: not a setting of this method */
  bench_outcome outcome;
  hc_status status;
  double error, error_harmonic_1; /* [1] NaN unless solved */
  double error_finer;        /* [1] largest error at these or finer settings of the method, so that accuracy by chance
                                does not count */
  double seconds, low, high; /* [s] median and quartiles over `repeats` */
  int repeats;
  double curve_seconds; /* [s] hbm_exact: the whole response curve; else NaN */
  bool front;           /* Pareto front: no other row is at least as good in error_finer and seconds and better in
                           one */
} bench_row;

/* One frequency. */
typedef struct bench_frequency {
  double omega, neighbour;      /* [rad/time] */
  double amplitude, multiplier; /* of the reference: [length]; [1] largest modulus, per period */
  double floor;                 /* [1] error of the reference; smaller errors count as this */
  int first, n;                 /* index of its first row; number of rows */
  char scipy[96];               /* version of scipy, or the reason why there is no scipy_lsoda */
} bench_frequency;

typedef struct bench {
  int n_rows, n_frequencies;
  bench_row *rows;
  bench_frequency frequencies[NUMBER_LIST_MAX];
} bench;

typedef struct bench_options {
  number_list at; /* n = 0: the compared frequency with the largest response */
  int repeats;    /* > 0; slow rows are repeated less, see bench_row.repeats */
  bool alone;     /* without other programs */
} bench_options;

/* Runs the bench. HC_INTERRUPTED: rows measured before are kept; HC_NOT_CONVERGED: no stable orbit at *failed_at. Call
 * bench_clear in any case. */
hc_status bench_run(const compare_setup *setup, const bench_options *options, const hc_monitor *monitor, bench *out,
                    double *failed_at);
void bench_clear(bench *b);

/* Sets error_finer and front of the n rows of one frequency. */
void bench_judge(int n, bench_row *rows, double floor);

/* The fastest solved row with error_finer <= goal; *second: the fastest of other methods. NULL: none. */
const bench_row *bench_cheapest(int n, const bench_row *rows, double goal, const bench_row **second);

/* "H = 10, N = 1024", "regularisation 1e-4, tolerance 1e-6": into text[BENCH_TEXT], which is returned. */
enum { BENCH_TEXT = 64 };
const char *bench_settings(const bench_row *r, char text[BENCH_TEXT]);
