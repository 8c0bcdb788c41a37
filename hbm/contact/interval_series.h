/* interval_series.h - the Fourier series of a function that is 1 on a part of the period and 0 elsewhere. Its harmonics
 * are written with the part's middle m and half width w, sin(h w) cos(h m). As a difference of values at the ends they
 * would lose the relative accuracy of a short part. */
#pragma once

#include <math.h>
#include <stdbool.h>

#include "numerics/base/constants.h"
#include "numerics/series.h"

/* weight[h] = 2/(pi h), h = 1..n: what interval_series_fill multiplies with. */
static inline void interval_series_weights(int n, double *weight)
{
  for (int h = 1; h <= n; ++h) weight[h] = 2 / (PI * h);
}

/* I[2 n + 1] of the part [from, to], to <= from + 2 pi. */
static inline void interval_series_fill(int n, const double *weight, double from, double to, double *I)
{
  double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  I[0] = half / PI;
  double cm = cos(middle), sm = sin(middle), cw = cos(half), sw = sin(half);
  double cm_h = 1, sm_h = 0, cw_h = 1, sw_h = 0;
  bool whole = half >= PI;
  for (int h = 1; h <= n; ++h) {
    series_turn(cm, sm, &cm_h, &sm_h);
    series_turn(cw, sw, &cw_h, &sw_h);
    double size = whole ? 0 : weight[h] * sw_h;
    I[2 * h - 1] = size * cm_h;
    I[2 * h] = size * sm_h;
  }
}
