/* response.h - the response curve, the frequencies to compare at, a row a solution, and a summary. */
#pragma once

#include "compare/band.h"
#include "compare/compare_settings.h"
#include "hbm/hbm.h"

/* The sweep, widened where an asked omega lies outside it. */
void comparison_sweep(double omega_from, double omega_to, const number_list *asked, double *from, double *to);

/* compare.omega, sorted and each once; or compare.points of them, equally spaced in the arc length of the curve plotted
 * as amplitude over omega, both scaled to 1: dense where the amplitude changes, as at peaks. */
hc_status comparison_frequencies(const compare_settings *where, double omega_from, hbm_solver *hbm,
                                 const hbm_curve *curve, number_list *out);

/* A response curve and its price. */
typedef struct response_curve {
  hbm_solver *hbm; /* NULL where it could not be made */
  hbm_curve curve;
  hc_status status; /* how it ended */
  double seconds;   /* of processor time */
} response_curve;

/* By harmonic balance over the sweep, widened to the asked frequencies (NULL: none). HC_NO_MEMORY, HC_INTERRUPTED; else
 * HC_OK, with the curve as far as it goes. response_curve_free in any case. */
hc_status response_trace(const compare_setup *setup, const number_list *asked, const hc_monitor *monitor,
                         response_curve *out);
void response_curve_free(response_curve *c);

enum { RESPONSE_NAME = 32 };

/* One solution, its measures and its stability. */
typedef struct response_row {
  char response[RESPONSE_NAME]; /* of a structure: which, in words; empty for an oscillator */
  hbm_point point;
  hbm_measures measures;
  bool stability_known;
  hbm_stability stability; /* valid when known */
  band band;               /* where it was asked for */
  const double *series;    /* [2 H + 1] [length] of the response: the caller's, where it fills them; NULL: not known */
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
 * which is returned with its omega, unless the curve says the branch never goes there. found->watch is called after
 * each frequency, and its failure is returned at once. */
hc_status response_at(hbm_solver *s, const hbm_curve *curve, const number_list *at, hbm_curve *found,
                      double *failed_at);

/* A summary of the whole curve; the peak is NaN where there is none. */
typedef struct response_summary {
  int harmonics, samples, points, rejected, turning_points; /* samples: 0 for exact forces */
  long iterations, evaluations;
  double peak_amplitude, peak_omega, peak_harmonic_1; /* [length], [rad/time], [length] */
  bool reached_end, arclength, left_at_start;
  bool inaccurate; /* somewhere the most that auto takes did not meet hbm.accuracy */
} response_summary;
/* HC_NO_MEMORY, or HC_OK also where no peak was found: NaN. */
hc_status response_summarise(hbm_solver *s, const hbm_curve *c, response_summary *out);
