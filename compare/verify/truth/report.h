/* report.h - what verify finds: each point's verdict, the hypotheses, the causes. */
#pragma once

#include "compare/comparison.h"
#include "compare/verify/curve_file/csv.h"
#include "compare/verify/equations/causes.h"
#include "compare/verify/equations/changes.h"
#include "numerics/base/status.h"

/* Equations that the other program may have solved. */
typedef struct verify_equations {
  verify_change change; /* of the model */
  double factor;        /* of a change that has one, else 1 */
  int which, n;         /* what of the model it changes: verify_changed.which; the model's DOFs, where that is > 0 */
  bool keep_mean, odd_only;
  int harmonics;
  int samples; /* 0: exact forces */
  int restart; /* how the slider is followed, for samples: verify_slider_kind; the first are hbm_restart */
} verify_equations;

static inline const verify_change_kind *verify_slider_kind(const verify_equations *e)
{
  return &verify_changes[VERIFY_MODEL_CHANGES + e->restart];
}

/* Have they no forces that harmonics or samples could be too few for? */
static inline bool verify_equations_linear(const verify_equations *e)
{
  return e->change == CHANGE_NO_CONTACT || e->change == CHANGE_STUCK;
}

/* Equations, and how the columns are to be read: true omega = omega_factor times the file's, value = value_factor
 * times the quantity. */
typedef struct verify_hypothesis {
  verify_equations equations;
  double omega_factor, value_factor;
  const char *omega_scale, *value_scale; /* what a free factor may be, "1/F0"; NULL: no name for it */
  verify_quantity quantity;
  bool decibel; /* values are in dB and the file says not, or the other way */
  bool fitted;  /* a factor of the equations was fitted */
  verify_causes causes;
  double distance; /* [1] nine of ten points that differ are no farther, and nine of ten that match */
  double score;    /* what they are ranked by: distance, times 3 for every cause */
} verify_hypothesis;

/* One point of the file, in its order. */
typedef struct verify_row {
  double omega, value; /* [rad/time], not in dB */
  long line;
  int solutions;     /* of the truth at omega */
  int branch;        /* of the nearest; -1: none */
  double nearest;    /* the quantity of that, not in dB; NaN: none */
  double scale;      /* what its difference is measured by (verify_quantity_scale) */
  int stable;        /* +1, -1, 0 unknown */
  bool skipped;      /* the quantity depends on where a slider rests that never slips: nothing to compare */
  bool free_sliders; /* the solution has sliders that never slip: where they rest is a matter of history */
  bool stable_too;   /* some solution at omega is stable */
  double error;      /* [1] |value - nearest|/scale */
  verdict verdict;
} verify_row;

static inline bool verify_row_differs(const verify_row *r)
{
  return !r->skipped && (r->verdict == VERDICT_DIFFERS || r->verdict == VERDICT_SOLVER_FAILED);
}

/* A point of the truth's curve. */
typedef struct verify_line {
  double omega, value; /* [rad/time]; the file's quantity, not in dB */
  int stable;          /* +1, -1, 0 unknown */
} verify_line;

enum { VERIFY_USUAL_REVERSALS = 8, VERIFY_SHOWN = 3, VERIFY_HYPOTHESES = 64 };

typedef struct verify_report {
  int n_rows;
  verify_row *rows; /* as far as they were done */
  int n_line;
  verify_line *line;        /* [n_line] along the truth's curve, if data->with_line */
  int count[VERDICT_COUNT]; /* of the rows that are not skipped */
  int skipped;
  int left_out;           /* points at omega <= 0 */
  int reversals;          /* of omega along the file */
  double gate;            /* [1] of the quantity */
  int harmonics;          /* of the truth */
  hc_status curve_end;    /* why the truth's curve stops, HC_OK: it does not */
  double curve_omega;     /* and where */
  int checked, unchecked; /* points whose truth was held against the referee; where that has no orbit */
  double checked_error;   /* [1] the largest difference, relative to the amplitude */
  int on_orbits;          /* points that are within the gate of the referee's orbit itself */
  int n_hypotheses;
  verify_hypothesis hypotheses[VERIFY_HYPOTHESES]; /* the best of every set of causes, best first */
  double truth_distance;                           /* [1] likewise, of the points as they stand from the truth */
  hc_status status;                                /* of verify_run */
  verify_causes causes;                            /* suspected; 0: none, or none found */
  verify_causes nearest_guess;                     /* where no cause is sure; 0: none */
  verify_causes unsolved; /* of hypotheses with no solution at some points, which fit at the others or have none */
  char tried[256], not_tried[256]; /* kinds of causes, by their words; not_tried: the patience ended before */
  double noise;                    /* [1] standard deviation from point to point around the truth; NaN: not estimated */
  double noise_said;               /* [1] what the values are said to scatter by */
} verify_report;

/* How long may be searched, and who hears of what is found until then. */
typedef struct verify_effort {
  double patience; /* [s] of processor time for the truth and the search, which has a quarter at least; 0:
                      VERIFY_PATIENCE */
  /* of the best so far, after VERIFY_FIRST_ANSWER and then after every stage that changes it; NULL */
  void (*say)(void *self, const verify_report *r);
  void *self;
} verify_effort;
enum { VERIFY_PATIENCE = 30, VERIFY_FIRST_ANSWER = 3 };
