/* curve_reference.h - tests/reference/hbm_exact.csv and its peaks, and whole curves to hold against them. */
#pragma once

#include "tests/hbm/traced.h"

static reference_row rows[MAX_REFERENCE];
static reference_peak peaks[MAX_REFERENCE];
static int n_rows, n_peaks;

/* For a program's setup. */
static int read_references(CHECK_STATE)
{
  n_rows = read_reference_rows(rows);
  n_peaks = read_reference_peaks(peaks);
  return 0;
}

static traced whole(const scene *sc, double from, double to, const char *what)
{
  traced t = trace(sc, from, to, what);
  if (t.status != HC_OK || t.curve.left_at_start)
    fail_msg("%s H=%d static=%d from %g: %s at %.9g%s", what, sc->hbm.harmonics, sc->hbm.keep_mean, from,
             hc_status_text(t.status), t.curve.points[t.curve.n - 1].omega,
             t.curve.left_at_start ? ", turned back" : "");
  return t;
}
