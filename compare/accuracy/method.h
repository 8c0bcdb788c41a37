/* method.h - one method with one choice of settings: what it finds, how far that is from the reference, and what it
 * costs. The tables over H and N (accuracy.c) and the benchmark at one frequency (bench.c) are made of these. */
#pragma once

#include "compare/accuracy/bench.h"
#include "compare/motion.h"
#include "hbm/hbm.h"
#include "timeint/steady/steady.h"

bool method_is_hbm(bench_method m);

/* *setup with the method's settings; samples 0: as they are, regularisation NaN: the exact law. */
compare_setup method_setup(const compare_setup *setup, bench_method method, int harmonics, int samples,
                           double regularisation, double tolerance);

/* Median and quartiles of v[n], which is sorted; NaN of none. */
void method_quartiles(int n, double *v, double *low, double *median, double *high);
