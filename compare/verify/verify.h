/* verify.h - a response curve of another program compared with ours, and the likely cause of what differs. The header
 * of this folder.
 *
 *     truth       the solutions of harmonic balance with exact forces and many harmonics at the file's omegas, compared
 *                 at some of them with the exact law's periodic orbits (the referee of comparison.h)
 *     verdict     per point, against the nearest of those solutions: match, differs, unstable, other_branch,
 *                 solver_failed
 *     hypotheses  our own harmonic balance with usual mistakes in it, and usual misreadings of the columns: the one
 *                 that the points lie on names the cause
 *
 * What is not connected to the branch that begins at the sweep's first omega is not seen. Nothing is printed. */
#ifndef HC_VERIFY_H
#define HC_VERIFY_H

#include "base/status.h"
#include "compare/compare_settings.h"
#include "compare/comparison.h"
#include "compare/verify/csv.h"

/* One bit each: a mistake, its word in csv and json, its meaning, its remedy. */
#define VERIFY_CAUSE_LIST(X)                                                                                           \
  X(CAUSE_NO_STATIC, "no_static_harmonic", "harmonic 0 is missing", "keep harmonic 0")                                 \
  X(CAUSE_HARMONICS, "too_few_harmonics", "too few harmonics", "keep more harmonics")                                  \
  X(CAUSE_SAMPLES, "too_few_samples", "too few samples", "take more samples per period, or exact forces")              \
  X(CAUSE_SLIDER, "slider_restart", "the slider restarts on a sample after a separation",                              \
    "restart it at the interpolated instant of touch")                                                                 \
  X(CAUSE_FREQUENCY, "frequency_unit", "rad per time and cycles per time are mixed up",                                \
    "name the column omega or frequency as it is")                                                                     \
  X(CAUSE_TWICE, "peak_to_peak", "the values are twice as large, as from peak to peak", "halve them")                  \
  X(CAUSE_HALF, "half_amplitude", "the values are half as large, as of one-sided coefficients", "double them")         \
  X(CAUSE_RMS, "rms", "the values are root mean squares", "give amplitudes")                                           \
  X(CAUSE_LENGTH, "length_unit", "the values are in another unit of length", "give them in the case's unit")           \
  X(CAUSE_QUANTITY, "other_quantity", "the values are another quantity", "name the column by what it holds")           \
  X(CAUSE_NO_CONTACT, "no_contact", "the contacts are missing",                                                        \
    "is the gap's sign right, and the contact force in the equations?")                                                \
  X(CAUSE_STUCK, "always_stuck", "the contacts neither slip nor separate",                                             \
    "is the contact force nonlinear in the equations?")                                                                \
  X(CAUSE_UNSTABLE, "unstable_branch", "the points run along an unstable branch",                                      \
    "follow the stable ones: no motion stays there")                                                                   \
  X(CAUSE_OTHER_BRANCH, "other_branch", "the points hop to another stable branch and back",                            \
    "start each point from its neighbour's solution")
#define VERIFY_CAUSE_NUMBER(code, word, meaning, remedy) code##_NUMBER,
enum { VERIFY_CAUSE_LIST(VERIFY_CAUSE_NUMBER) VERIFY_CAUSES };
#undef VERIFY_CAUSE_NUMBER
#define VERIFY_CAUSE_BIT(code, word, meaning, remedy) code = 1u << code##_NUMBER,
typedef enum verify_cause { VERIFY_CAUSE_LIST(VERIFY_CAUSE_BIT) } verify_cause;
#undef VERIFY_CAUSE_BIT

/* The words of all bits, joined by '+', "none" for none: in text[VERIFY_TEXT], which is returned. */
const char *verify_cause_words(unsigned causes, char text[VERIFY_TEXT]);

typedef enum verify_contact { VERIFY_CONTACT_AS_IT_IS, VERIFY_CONTACT_NONE, VERIFY_CONTACT_STUCK } verify_contact;

/* Equations that the other program may have solved. */
typedef struct verify_equations {
  verify_contact contact;
  bool keep_mean;
  int harmonics;
  int samples; /* 0: exact forces */
  int restart; /* hbm_restart_kind, for samples */
} verify_equations;

/* Equations, and how the columns are to be read: true omega = omega_factor times the file's, value = value_factor
 * times the quantity. */
typedef struct verify_hypothesis {
  verify_equations equations;
  double omega_factor, value_factor;
  verify_quantity quantity;
  unsigned causes; /* verify_cause bits; 0 is the truth itself */
  double distance; /* [1] nine of ten points that differ are within, and of ten that match */
  double score;    /* what they are ranked by: distance, times 3 for every cause */
} verify_hypothesis;

/* One point of the file, in its order. */
typedef struct verify_row {
  double omega, value; /* [rad/time], as in the file otherwise */
  long line;
  int solutions;    /* of the truth at omega */
  int branch;       /* of the nearest; -1: none */
  double nearest;   /* the quantity of that; NaN: none */
  double amplitude; /* [length] of that */
  int stable;       /* +1, -1, 0 unknown */
  bool stable_too;  /* some solution at omega is stable */
  double error;     /* [1] |value - nearest|/amplitude */
  verdict verdict;
} verify_row;

enum { VERIFY_SHOWN = 3, VERIFY_HYPOTHESES = 256 };

typedef struct verify_report {
  int n_rows;
  verify_row *rows; /* as far as they were done */
  int count[VERDICT_COUNT];
  double gate;            /* [1] of the quantity */
  int harmonics;          /* of the truth */
  hc_status curve_end;    /* why the truth's curve stops, HC_OK: it does not */
  double curve_omega;     /* and where */
  int checked, unchecked; /* points whose truth was held against the referee; where that has no orbit */
  double checked_error;   /* [1] the largest difference, relative to the amplitude */
  int n_hypotheses;
  verify_hypothesis hypotheses[VERIFY_HYPOTHESES]; /* best first */
  double truth_distance;                           /* [1] likewise, of the points as they stand from the truth */
  hc_status status;                                /* of verify_run */
  unsigned causes;                                 /* suspected; 0: none, or none found */
} verify_report;

/* HC_INTERRUPTED, HC_NO_MEMORY, or why there is no truth; rows found until then are kept. verify_clear in any case. */
hc_status verify_run(const compare_setup *setup, const verify_data *data, const hc_monitor *monitor,
                     verify_report *out);
void verify_clear(verify_report *r);

/* The cause in a sentence, or that there is none: in text[VERIFY_TEXT], which is returned. */
const char *verify_sentence(const verify_report *r, char text[VERIFY_TEXT]);

/* 0 every point lies on a solution and on the right one; 1 not; 3 some could not be judged. */
int verify_exit_code(const verify_report *r);

#endif
