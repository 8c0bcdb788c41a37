/* method.h - settings of one method, and quartiles, for the tables over H and N (accuracy.c) and the benchmark at one
 * frequency (bench.c). */
#pragma once

#include "compare/accuracy/bench.h"
#include "compare/motion.h"
#include "hbm/hbm.h"
#include "timeint/steady/steady.h"

bool method_is_hbm(bench_method m);

/* A copy of *setup with the method's settings; samples 0: unchanged, regularisation NaN: the exact law. */
compare_setup method_setup(const compare_setup *setup, bench_method method, int harmonics, int samples,
                           double regularisation, double tolerance);

/* Median and quartiles of v[n], which gets sorted; NaN for n = 0. */
void method_quartiles(int n, double *v, double *low, double *median, double *high);
