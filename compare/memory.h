/* memory.h - how much memory a run will take at its height, told beforehand from the sizes of its largest arrays.
 *
 *     the structure     n^2: M, C, K, modes, what makes them                            n degrees of freedom
 *     harmonic balance  N^2: Jacobians, factors, what of them comes from the contacts   N = c (2H + 1) unknowns,
 *                       c <= n, three coordinates a pair in space
 *     predictions       N^2 of 2H or 14 harmonics, or of 1500 unknowns (at most 100 harmonics): the largest
 *     a transient       S^2: monodromy matrices, factors                                S states
 * How many arrays of a kind live at once was measured; the sum is right within a factor of two. Other memory of the
 * program, some MB, is included. Nothing is allocated, nothing can fail. */
#pragma once

#include "compare/compare_settings.h"

double memory_of_curve(const model *m, const hbm_settings *how); /* [bytes] */
double memory_of_comparison(const compare_setup *setup);         /* [bytes] */
