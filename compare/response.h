/* response.h - what is reported of an HBM response curve: one row for each solution, and a summary of the curve. */
#ifndef HC_RESPONSE_H
#define HC_RESPONSE_H

#include "compare/compare_settings.h"
#include "hbm/hbm.h"

/* The curve over the sweep, widened to the asked frequencies, into *curve as far as it goes; errors of hbm_trace. *hbm
 * is NULL where the solver could not be made. Free both in any case. */
hc_status response_trace(const compare_setup *setup, const number_list *asked, const hc_monitor *monitor,
                         hbm_solver **hbm, hbm_curve *curve);

enum { RESPONSE_NAME = 32 };

/* One solution, its measures and its stability. */
typedef struct response_row {
  char response[RESPONSE_NAME]; /* of a structure: which, in words; empty for an oscillator */
  hbm_point point;
  hbm_measures measures;
  bool stability_known;
  hbm_stability stability; /* valid when known */
} response_row;

/* Point k of the curve, by its first response. */
hc_status response_row_of(hbm_solver *s, const hbm_curve *c, int k, response_row *out);

/* *row becomes that of response r of the model, counted from 0: its measures. Errors of hbm_measure_response. */
hc_status response_row_turn(hbm_solver *s, const hbm_curve *c, int k, int r, response_row *row);

/* What one contact does in one solution. */
typedef struct contact_row {
  double omega;
  int branch, contact;      /* counted from 0 */
  char name[RESPONSE_NAME]; /* of the contact, or empty */
  contact_period period;
} contact_row;

/* All solutions at the asked frequencies, appended to *found. A frequency without any is a failure, the first of
 * which is returned with its omega, unless the curve says the branch never goes there. */
hc_status response_at(hbm_solver *s, const hbm_curve *curve, const number_list *at, hbm_curve *found,
                      double *failed_at);

/* A summary of the whole curve; the peak is NaN where there is none. */
typedef struct response_summary {
  int harmonics, samples, points, rejected, turning_points; /* samples: 0 for exact forces */
  long iterations, evaluations;
  double peak_amplitude, peak_omega, peak_harmonic_1; /* [length], [rad/time], [length] */
  bool reached_end, arclength, left_at_start;
} response_summary;
/* HC_NO_MEMORY, or HC_OK also where no peak was found: NaN. */
hc_status response_summarise(hbm_solver *s, const hbm_curve *c, response_summary *out);

#endif
