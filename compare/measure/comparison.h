/* comparison.h - the main job: the same frequencies solved by harmonic balance and by time integration, and how far apart they are.
 *
 * Per frequency and per HBM solution (branch) the transient starts, unless the scene says otherwise, on that solution's own orbit.
 * An error is |hbm - transient| / the transient's amplitude. Phases are never aligned: the forcing fixes them. */
#ifndef HC_COMPARISON_H
#define HC_COMPARISON_H

#include "cases/scene.h"
#include "cases/status.h"
#include "hbm/hbm.h"
#include "timeint/timeint.h"

/* Never a bare number: what a comparison can come to. Names are INTERFACE.md's. */
#define VERDICT_LIST(X)                                                                     \
  X(VERDICT_MATCH, "match", "every error is within the gate")                               \
  X(VERDICT_DIFFERS, "differs", "same orbit, but an error is beyond the gate")              \
  X(VERDICT_OTHER_BRANCH, "other_branch", "the transient left for another HBM solution")    \
  X(VERDICT_UNSTABLE, "unstable", "this HBM solution is unstable: the transient left it")   \
  X(VERDICT_PERIOD_K, "period_k", "the transient repeats only after k forcing periods")     \
  X(VERDICT_NOT_SETTLED, "not_settled", "the transient found no steady state in max_periods") \
  X(VERDICT_SOLVER_FAILED, "solver_failed", "one of the solvers gave up")
#define VERDICT_ENUM(code, name, meaning) code,
typedef enum verdict { VERDICT_LIST(VERDICT_ENUM) VERDICT_COUNT } verdict;
#undef VERDICT_ENUM
const char *verdict_name(verdict v); /* "period_k" for all k; a row's own is comparison_verdict_text */
const char *verdict_meaning(verdict v);

typedef struct comparison_errors { double amplitude, harmonic_1, mean, waveform; } comparison_errors; /* [1] */

typedef struct comparison_row {
  double omega;
  int branch;                 /* of the HBM solution; -1: HBM has none here */
  verdict verdict;
  hc_status hbm_status, transient_status;
  hbm_stability stability;    /* of the HBM solution; multiplier NaN when unknown */
  bool accounted;             /* the transient is within the gate of this or another HBM solution */
  hbm_measures hbm;           /* valid when hbm_status is HC_OK */
  timeint_result transient;   /* valid when transient_status is HC_OK or HC_NOT_SETTLED */
  comparison_errors errors;   /* NaN where there is nothing to compare */
} comparison_row;

typedef struct comparison {
  int n_rows, cap;
  comparison_row *rows;
  hbm_curve curve;            /* the response curve behind the rows; its `end` says how far it came */
  int count[VERDICT_COUNT];
  int harmonics, samples;     /* in use: for auto, the most the curve needed; samples 0 for exact forces */
} comparison;

/* Compare at the scene's frequencies (compare.omega, or compare.points chosen along the response curve). Rows found before an interrupt
 * or a failure are kept. HC_OK even when single rows failed: their verdicts say so. Free with comparison_clear in any case. */
hc_status comparison_run(const scene *sc, const hc_monitor *monitor, comparison *out);
void comparison_clear(comparison *c);

/* "match", "period_2", ...: the row's verdict in text[24], which is returned. */
const char *comparison_verdict_text(const comparison_row *row, char text[24]);

/* Exit code of INTERFACE.md: 0 agreed; 1 a transient differs from every HBM solution, or has another period; 3 something could not be compared. */
int comparison_exit_code(const comparison *c);

/* x(t), x'(t) and sliders at t = 0 of an HBM solution: where its transient starts. */
timeint_state comparison_orbit_start(const hbm_measures *m, int n_harm, const double *X, double omega);

#endif
