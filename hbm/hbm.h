/* hbm.h - harmonic balance of a model: response curves, and every solution at a frequency. The way into this folder.
 *
 *     x(t) ~ X[0] + sum_{h=1..H} X[2h-1] cos(h omega t) + X[2h] sin(h omega t)         (numerics/series.h)
 *
 * solved from R(X, omega) = 0 (system.h) by KINSOL (newton.h), followed along omega (continuation.c). Handles are
 * opaque, one a thread; nothing is printed. Not here: time integration, verdicts. */
#ifndef HC_HBM_H
#define HC_HBM_H

#include "base/status.h"
#include "hbm/contact_report.h"
#include "hbm/hbm_settings.h"
#include "hbm/stability.h"
#include "model/model.h"

typedef struct hbm_solver hbm_solver;

typedef struct hbm_point {
  double omega;    /* [rad/time] */
  double residual; /* [1] |R|, largest component, relative to the forces that make it up */
  double d_omega;  /* [rad/time] tangent of the curve with respect to its parameter, beside hbm_curve's dX */
  int branch;      /* turning points passed since the start of the curve */
  int iterations;  /* Newton iterations spent on this point; 0: taken from the linear closed form */
  int harmonics;   /* kept at this point: changes along the curve for hbm.harmonics: auto */
  double error;    /* [1] estimated relative error for auto harmonics or samples, NaN when a number was given */
} hbm_point;

typedef struct hbm_curve {
  int n, cap, n_coef; /* points; room; 2H+1 */
  hbm_point *points;  /* [n] */
  double *X, *dX;     /* [n][n_coef] [length]; dX: tangent, same parameter as d_omega */
  double omega_scale; /* [rad/time] what omega is measured by along the curve; harmonics are measured by their norm */
  hc_status end;      /* HC_OK: the whole sweep was covered; else why the curve stops at the last point */
  bool left_at_start; /* ended because the branch turned back past the start of the sweep */
  bool arclength;     /* arc-length continuation was needed */
  bool inaccurate;    /* auto: somewhere not even the most harmonics or samples met hbm.accuracy */
  int linear;         /* points taken from the linear closed form */
  int turning_points, rejected;
  long iterations, evaluations; /* Newton iterations and contact force evaluations, rejected steps included */
} hbm_curve;

/* Measures of one solution. */
typedef struct hbm_measures {
  double amplitude, max, min, rms, mean, harmonic_1; /* [length], docs/interface.md, 3 */
  contact_report contact;
} hbm_measures;

/* A workspace for m and how it is to be solved (both copied). HC_BAD_INPUT, HC_NO_MEMORY: *out is
 * NULL. */
hc_status hbm_solver_new(const model *m, const hbm_settings *how, hbm_solver **out);
void hbm_solver_free(hbm_solver *s);
int hbm_n_harmonics(const hbm_solver *s); /* in use now; after a trace with auto, the most the curve needed */
int hbm_n_samples(const hbm_solver *s);

/* Solve at a fixed omega from the guess X[2H+1]; X is the solution on HC_OK and untouched otherwise. */
hc_status hbm_solve(hbm_solver *s, double omega, double *X, hbm_point *point);

/* Solve at a fixed omega from nothing: from the linear response, else by ramping the force, else by ramping the
 * contact. */
hc_status hbm_solve_first(hbm_solver *s, double omega, double *X, hbm_point *point);

/* The response curve from omega `from` to `to`, appended to an empty *curve. What was found is kept whatever the
 * status. */
hc_status hbm_trace(hbm_solver *s, double from, double to, const hc_monitor *monitor, hbm_curve *curve);

/* Continuation steps `scale` times as long as they would be, 0 < scale <= 1: a curve must not depend on them, and
 * this is how to see. */
void hbm_scale_steps(hbm_solver *s, double scale);

/* Every solution of the curve at omega, appended to *at in the curve's order. The status is that of the worst one. */
hc_status hbm_curve_at(hbm_solver *s, const hbm_curve *curve, double omega, hbm_curve *at);

/* The point of largest amplitude of the curve, refined between its points, appended to *peak. */
hc_status hbm_curve_peak(hbm_solver *s, const hbm_curve *curve, hbm_curve *peak);

hc_status hbm_measure(hbm_solver *s, const double *X, hbm_measures *out);

/* w[n_contacts] [length]: the sliders at t = 0 of the motion X. Errors of the contact force. */
hc_status hbm_sliders(hbm_solver *s, const double *X, double *w);

/* Floquet multipliers of the solution X at omega, along its own exactly located transitions also where forces are
 * sampled. */
hc_status hbm_stability_at(hbm_solver *s, double omega, const double *X, hbm_stability *out);

/* What to tell a person: +1 stable, -1 unstable, 0 unknown (a multiplier within 1e-9 of 1 in size, or the truncated
 * equations disagree). */
int hbm_stability_verdict(const hbm_stability *st);

/* Where the curve changes its nature. */
typedef enum hbm_special_kind { HBM_TURNING_POINT, HBM_PERIOD_DOUBLING, HBM_CONTACT_CHANGE } hbm_special_kind;
typedef struct hbm_special {
  hbm_special_kind kind;
  double omega, amplitude;
  int branch;
  contact_regime before, after; /* along the curve; the same where only the number of transitions changes */
} hbm_special;

/* All of them in the curve's order, located to 1e-9 of omega or better, into out[cap]; *n is how many there are,
 * which may exceed cap. */
hc_status hbm_specials(hbm_solver *s, const hbm_curve *curve, int cap, hbm_special *out, int *n);

/* A curve is made empty with {0} and freed here. */
void hbm_curve_free(hbm_curve *curve);

#endif
