/* duration.h - how much processor time a run will take, told beforehand: what a step of Newton and what periods take on
 * a solution at one of its frequencies is measured, and multiplied by how many of them there will be.
 *
 *     a response curve   CURVE_ITERATIONS t_newton (2 H + 1)^3 / (2 H' + 1)^3          H' of the measured step
 *     a solution         CVODE_PERIODS t_cvode + CHORD_PERIODS t_closed + CHORD_MATRICES t_matrix        chord steps
 *                        CVODE_PERIODS t_cvode + MATRICES t_matrix                                       otherwise
 * How many: duration.c. Where all solutions are like the measured one, and each frequency has one, that is right
 * within a factor of three. Not foreseen: motions that have no periodic orbit, or leave it; several solutions a
 * frequency; what `verify` searches where points differ. */
#pragma once

#include "compare/compare_settings.h"
#include "timeint/steady/period_times.h"

/* Structures of fewer degrees of freedom are not measured: chain3 (3, with 3 contacts) takes 0.1 s a frequency. */
enum { DURATION_FEWEST = 8 };

typedef struct duration_units {
  double newton; /* [s] of a Newton step of harmonic balance */
  int harmonics; /* in it */
  int reference; /* harmonics of the tables' reference, at least */
  period_times period;
} duration_units;

/* Measures in the middle of the frequencies, in less than a tenth of what one takes, periods for some seconds at most.
 * All zero, at once, below DURATION_FEWEST degrees of freedom, and where nothing can be said. */
void duration_measure(const compare_setup *setup, duration_units *out);

/* How many frequencies the setup has. */
int duration_frequencies(const compare_setup *setup);

/* [s] of processor time; n frequencies, or points of a curve. */
double duration_of_curve(const duration_units *u, int harmonics);
double duration_of_comparison(const duration_units *u, int n);
double duration_of_steady_states(const duration_units *u, int n);
double duration_of_tables(const duration_units *u, const compare_settings *how);
double duration_of_report(const duration_units *u, int n, const compare_settings *how);
double duration_of_verification(const duration_units *u, int n);
