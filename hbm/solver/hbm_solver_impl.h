/* hbm_solver_impl.h - what a solver consists of; private to hbm/ and to tests. */
#pragma once

#include <float.h>

#include "hbm/solver/hbm_solver.h"
#include "hbm/solver/ramp.h"
#include "hbm/solver/refine.h"
#include "hbm/solver/system.h"
#include "hbm/stability/monodromy.h"
#include "numerics/newton.h"

/* A solution's multipliers, by a fingerprint of it; a later one in the same place of the solver's table replaces it. */
enum { KNOWN_STABILITIES = 1024 };
typedef struct known_stability {
  uint64_t key;
  hbm_stability stability;
} known_stability;

/* The solution of finer equations next to one that was asked about; made at the first question. */
typedef struct finer_solution {
  refinement *by;           /* the equations; NULL until then */
  double *improved, *asked; /* [n] their solution, and the one asked about */
  int n;                    /* the larger one's coefficients */
  double least;             /* [1] the error is never less than this there */
  bool found;               /* Newton converged there, next to the one asked about */
} finer_solution;

/* What is known of the row of a curve that came before, for the next one. */
typedef struct row_before {
  contact_regime regime;
  int transitions;
  double multiplier, error; /* [1] its largest multiplier, and by how much it may be off; 0: there is none before */
  int since;                /* rows since that error was found */
} row_before;

struct hbm_solver {                 /* from hbm_solver_new, to hbm_solver_free; not shared between threads */
  model *model;                     /* a copy: the caller may drop theirs */
  hbm_settings how;                 /* a copy */
  hbm_system sys;                   /* the equations */
  int n_time;                       /* samples per period, for sampled forces */
  newton *fixed, *plane;            /* the two forms of corrector.h */
  bool symmetric, on_symmetric;     /* model_is_symmetric; and the last solution has no even harmonics */
  double *whole_block, *even_block; /* [n][n], [n_even][n_even] dR/dX of a symmetric model's, for hbm_even_sign */
  double *even_part;                /* [n_coef] of a solution of a symmetric model */
  int *even_index, *even_pivot;     /* [n_even] places of even harmonics among the unknowns; the factors' pivots */
  int n_even;
  const slip_edges *edges;          /* of the model's response curves; NULL: there are none */
  contact_forces *orbit;            /* locates the transitions of a solution of sampled equations; NULL when sys does */
  monodromy *monodromy;             /* NULL until it is needed */
  double *slider_starts;            /* [n_contacts] [length] */
  bool started;                     /* sliders were asked to begin elsewhere than at 0 (rests.h) */
  bool multipliers_unknown;         /* hbm_stability_is_unknown */
  known_stability *known_stability; /* [KNOWN_STABILITIES] of solutions asked about; NULL until the first */
  uint64_t multipliers_of;          /* fingerprint of the solution whose multipliers `monodromy` holds; 0: none's */
  double *moduli;                   /* [2][2 n + contacts] of predict.c; NULL until it is needed */
  refinement *finer_harmonics; /* tells auto the error of this many harmonics; NULL where the settings give a number */
  refinement *finer_samples;   /* the same of samples */
  finer_solution exact_finer;  /* hbm_predict's */
  finer_solution twice_finer;  /* hbm_stability_with_error's */
  row_before row_before;       /* of the same */
  hbm_guess guess;             /* .ask NULL: none */
  long solves;                 /* of either form, since it was made */
  const hbm_ramp *ramp;        /* the one that is followed; NULL: none is */
  bool predicted;              /* a step of a curve is under way */
  double step_scale;           /* of hbm_scale_steps */
  const hc_monitor *monitor;   /* of the curve under way, asked at each evaluation of many unknowns; else NULL */
  double done;                 /* of that curve, 0..1; negative: unknown */
  bool stopped;                /* it said stop */
  double omega;                /* of the fixed form; on a ramp, the place */
  double *X;                   /* [n_coef]  harmonics of a callback's unknowns */
  double *x;                   /* [2 HBM_MAX_HARMONICS + 1] series of a response */
  double *z;                   /* [n+1]     unknowns of a solve */
  double *z_scale, *r_scale;   /* [n+1]     weights for KINSOL */
  double *normal, *anchor;     /* [n+1]     of the plane form; the metric's weights are included in normal */
  double *truncated;           /* [n_coef]  a solution without half of its harmonics, of predict.c */
  workspace memory;            /* of these arrays */
};

/* An evaluation takes a millisecond or more. */
static inline bool hbm_has_many_unknowns(const hbm_solver *s) { return s->sys.n >= 200; }

/* [1] Where what moves is less than this part of the static forces, what is left of a residual is their rounding. */
static inline double hbm_least_share(const hbm_solver *s) { return fmin(1000 * DBL_EPSILON / s->how.tolerance, 1); }

/* The metric at X [n_coef of the present equations]. */
static inline metric_at hbm_metric_at(const hbm_solver *s, const double *X)
{
  return (metric_at){s->sys.metric, s->sys.n_coef, X, NULL};
}

/* Other numbers of harmonics and samples from here on. The solver is unusable, but may be freed, unless HC_OK. */
hc_status hbm_solver_resize(hbm_solver *s, int n_harm, int n_time);

/* Zero what X[n_coef] has beyond the harmonics the solver keeps now. */
void hbm_truncate(const hbm_solver *s, int n_coef, double *X);

/* The event-located orbit of X: *orbit is an exact evaluator of the solver's own, evaluated at X, *report what it
 * found. Errors of contact_forces_eval. */
hc_status hbm_located_orbit(hbm_solver *s, const double *X, const contact_forces **orbit, contact_report *report);

/* The multipliers along an orbit of hbm_located_orbit, X at omega: monodromy_stability, which is not asked again about
 * a solution that hbm_keep_stability was told about. */
void hbm_keep_stability(hbm_solver *s, double omega, const double *X, const hbm_stability *known);
hc_status hbm_multipliers(hbm_solver *s, const contact_forces *orbit, double omega, const double *X,
                          hbm_stability *out);

/* Those of any orbit of the model; moduli[2 n + contacts], the largest first, 0 beyond their number. */
hc_status hbm_moduli(hbm_solver *s, const contact_forces *orbit, double omega, hbm_stability *out, double *moduli);
/* The same of X, whose orbit is located only where `monodromy` has another's. */
hc_status hbm_moduli_of(hbm_solver *s, double omega, const double *X, double *moduli);
