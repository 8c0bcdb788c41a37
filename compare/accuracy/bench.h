/* bench.h - work against precision: time and error of every method at one frequency.
 *
 *     reference    the exact law's periodic orbit at omega, by shooting as tight as rounding allows
 *     error        |amplitude - reference's| / reference's amplitude; error_harmonic_1 likewise of |a1 + i b1|; of
 *                  several responses the largest of these differences, relative to the largest amplitude
 *     cost         processor time of ONE solution at omega from the solution at a neighbouring frequency, as in a
 *                  sweep: an HBM method from its own solution there, time integration from the exact orbit's state
 *                  there. With its measures, without making the workspace.
 *
 * The branch is that of the largest stable response at omega. Methods take turns; nothing is printed. Not here:
 * whole curves over H and N (accuracy.h; tests/bench). */
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
  BENCH_WAITING, /* not run: stopped before            */
  BENCH_SOLVED,
  BENCH_FAILED,      /* why: status                        */
  BENCH_OTHER_ORBIT, /* a solution, but not the one next to the reference */
  BENCH_TOO_LONG     /* than bench_longest, or a coarser setting did*/
} bench_outcome;
const char *bench_outcome_name(bench_outcome o); /* "solved", ... */

extern const double bench_longest, bench_longest_shot; /* [s] of processor time that one solution may take; by
                                                          shooting */

/* One method with one choice of settings. */
typedef struct bench_row {
  bench_method method;
  double omega;
  int harmonics, samples;           /* 0: this method has none */
  double regularisation, tolerance; /* NaN: none */
  bench_outcome outcome;
  hc_status status;
  double error, error_harmonic_1; /* [1] NaN unless solved */
  double error_finer;        /* [1] the largest error at these or finer settings of the method: a coarse setting that is
                         accurate by chance does not count */
  double seconds, low, high; /* [s] median and quartiles over `repeats` */
  int repeats;
  double curve_seconds; /* [s] hbm_exact: the whole response curve; else NaN */
  bool front;           /* Pareto front: no row has error_finer and seconds no larger, and one of them smaller */
} bench_row;

/* One frequency. */
typedef struct bench_frequency {
  double omega, neighbour;      /* [rad/time] */
  double amplitude, multiplier; /* of the reference: [length], [1] a period */
  double floor;                 /* [1] errors below are taken for it: the reference is no better */
  int first, n;                 /* its rows */
  char scipy[96];               /* version, or why there is no scipy_lsoda */
} bench_frequency;

typedef struct bench {
  int n_rows, n_frequencies;
  bench_row *rows;
  bench_frequency frequencies[NUMBER_LIST_MAX];
} bench;

typedef struct bench_options {
  number_list at; /* n = 0: of the compared frequencies the one where the response is largest */
  int repeats;    /* > 0; rows that take long are repeated less, as their `repeats` says */
  bool alone;     /* no other programs */
} bench_options;

/* HC_INTERRUPTED keeps what was measured; HC_NOT_CONVERGED: no stable orbit at *failed_at. bench_clear in any case. */
hc_status bench_run(const compare_setup *setup, const bench_options *options, const hc_monitor *monitor, bench *out,
                    double *failed_at);
void bench_clear(bench *b);

/* error_finer and front of the n rows of one frequency. */
void bench_judge(int n, bench_row *rows, double floor);

/* The fastest solved row with error_finer within the goal, and of the other methods *second; or NULL. */
const bench_row *bench_cheapest(int n, const bench_row *rows, double goal, const bench_row **second);

/* "H = 10, N = 1024", "regularisation 1e-4, tolerance 1e-6": in text[BENCH_TEXT], which is returned. */
enum { BENCH_TEXT = 64 };
const char *bench_settings(const bench_row *r, char text[BENCH_TEXT]);
